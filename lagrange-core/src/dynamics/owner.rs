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
        let depends = self
            .program(Extent::Series)
            .dependents(result, self.registers);
        let among = |nodes: &[Register], place: ValueRef| match place {
            ValueRef::Node(node) => nodes.get(node).is_some_and(|r| depends[r.index()]),
            ValueRef::Zero | ValueRef::Constant(_) => false,
        };
        let watches = d.stops.iter().chain(d.marks).find(|watch| {
            let mut terms = watch.terms.iter();
            terms.any(|term| among(&self.report_nodes, *term))
        });
        let branches = d.branches.iter();
        let mut branches = branches.filter(|branch| among(&self.nodes, branch.guard));
        let mut of_motion = numbers(d).filter(|(_, place)| among(&self.nodes, *place));
        let motion = of_motion.next().map(|(name, _)| name);
        let branch = branches.next().map(|branch| branch.then);
        motion.or(branch).or(watches.map(|watch| watch.name))
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
