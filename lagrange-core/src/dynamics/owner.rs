//! Which item of the declaration a number of the equations belongs to, for error messages.

use super::shape::{Extent, Shape};
use crate::program::Register;
use crate::system::{Description, Normal, ValueRef};

impl Shape {
    /// The item, else the coordinate, whose numbers depend on what goes to this register.
    #[cold]
    pub(super) fn item_of(
        &self,
        result: Register,
        d: &'static Description,
    ) -> Option<&'static str> {
        let reaches = self.reached(&self.report_nodes, result);
        let watches = d.stops.iter().chain(d.marks);
        let mut watches = watches.filter(|watch| watch.terms.iter().any(|term| reaches(*term)));
        let motion = self.item_of_motion(result, d);
        motion.or_else(|| watches.next().map(|watch| watch.name))
    }

    /// The same of what moves or ends a mode: stops and marks are left out.
    #[cold]
    pub(super) fn item_of_motion(
        &self,
        result: Register,
        d: &'static Description,
    ) -> Option<&'static str> {
        let reaches = self.reached(&self.nodes, result);
        let motion = numbers(d).find(|(_, place)| reaches(*place));
        let branch = || d.branches.iter().find(|branch| reaches(branch.guard));
        let motion = motion.map(|(name, _)| name);
        motion.or_else(|| branch().map(|branch| branch.then))
    }

    /// Tells of a place in these nodes whether it depends on what goes to a register.
    fn reached(&self, nodes: &[Register], result: Register) -> impl Fn(ValueRef) -> bool {
        let program = self.program(Extent::Series);
        let depends = program.dependents(result, self.registers);
        move |place| match place {
            ValueRef::Node(node) => nodes.get(node).is_some_and(|r| depends[r.index()]),
            ValueRef::Zero | ValueRef::Constant(_) => false,
        }
    }
}

/// The numbers of the motion program with the items that they belong to, those that belong to one alone before those that several
/// make.
fn numbers(d: &'static Description) -> impl Iterator<Item = (&'static str, ValueRef)> {
    let frictions = d.frictions.iter().flat_map(|f| {
        let normal = match f.normal {
            Normal::Given(place) => place,
            _ => ValueRef::Zero,
        };
        [f.static_coefficient, f.kinetic_coefficient, normal].map(|place| (f.name, place))
    });
    let regions = d.contacts.iter().filter_map(|c| Some((c.name, c.region?)));
    let rows = d.rows.iter().enumerate().flat_map(move |(k, row)| {
        let jacobian = row.jacobian.iter().map(|(_, place)| *place);
        let own = [row.velocity, row.bias].into_iter().chain(row.position);
        let name = super::row_name(d, k);
        own.chain(jacobian).map(move |place| (name, place))
    });
    let forcing = d.forcing.iter().enumerate();
    let forcing = forcing.map(|(i, place)| (d.coordinates[i].name, *place));
    let mass = d.mass.iter();
    let mass = mass.map(|&(i, _, place)| (d.coordinates[i].name, place));
    frictions
        .chain(regions)
        .chain(rows)
        .chain(mass)
        .chain(forcing)
}
