//! What a system is made of: the names, units and meanings of everything that was declared.
//!
//! What runs need beside that, such as where a number is found after a program has run, stands in hidden fields and in
//! [`places`](super::places).

use super::places::{Branch, Condition, Coupling, Energy, Momenta, Normal, Restitution, Row};
use crate::program::{Encoded, ValueRef};
use core::fmt;
use core::ops::Range;
use core::str::FromStr;

/// Everything the core knows of a system. Indices run in order of declaration.
#[derive(Debug)]
pub struct Description {
    /// Name of the struct.
    pub name: &'static str,
    /// Doc comment of the struct.
    pub documentation: &'static str,
    /// Fields of the struct (arrays flattened).
    pub parameters: &'static [Parameter],
    /// Generalized coordinates.
    pub coordinates: &'static [Coordinate],
    /// Number of needs; sets have ⌈needs / 64⌉ words. Need 0 is always held.
    #[doc(hidden)]
    pub needs: usize,
    /// Everything that depends on parameters only, from the parameters.
    #[doc(hidden)]
    pub constants: Encoded,
    /// What the equations of motion are made of, from (t, q…, v…).
    #[doc(hidden)]
    pub motion: Encoded,
    /// What is read after they are solved, from (t, q…, v…, v̇…, λ… one per row, 0 for rows that do not act).
    #[doc(hidden)]
    pub report: Encoded,
    /// Lower triangle of the mass matrix, structural zeros left out: (row, column ≤ row, where). Motion.
    #[doc(hidden)]
    pub mass: &'static [(usize, usize, ValueRef)],
    /// Parameters that the mass matrix contains, if it is that of a kinetic energy, which must be positive; `None` for a
    /// Lagrangian, whose part of second order in the velocities may have any sign.
    #[doc(hidden)]
    pub inertia: Option<&'static [usize]>,
    /// f, one per coordinate. Motion.
    #[doc(hidden)]
    pub forcing: &'static [ValueRef],
    /// All rows: constraints first, then contacts, then the slip components of frictions. Motion.
    #[doc(hidden)]
    pub rows: &'static [Row],
    /// Forces proportional to a row's multiplier, beside aᵀλ: `Q[coordinate] += place · λ[row]`. Motion.
    #[doc(hidden)]
    pub couplings: &'static [Coupling],
    /// Rows whose forces stops, marks and branches read, and of frictions among them those that press.
    #[doc(hidden)]
    pub watched_rows: &'static [usize],
    /// Named kinetic energies.
    pub kinetic: &'static [Effect],
    /// Named potential energies.
    pub potential: &'static [Effect],
    /// Equality constraints.
    pub constraints: &'static [Constraint],
    /// One-sided contacts.
    pub contacts: &'static [Contact],
    /// Frictions.
    pub frictions: &'static [Friction],
    /// Constraints whose forces press frictions together, as those of a bearing.
    #[doc(hidden)]
    pub resultants: &'static [&'static [usize]],
    /// Applied forces.
    pub forces: &'static [Load],
    /// Rayleigh dissipations.
    pub dissipations: &'static [Load],
    /// Piecewise branches; guard ≥ 0 on the `then` side.
    #[doc(hidden)]
    pub branches: &'static [Branch],
    /// Energies. Report.
    #[doc(hidden)]
    pub energy: Energy,
    /// Generalized momenta ∂L/∂v, one per coordinate. Report.
    #[doc(hidden)]
    pub momenta: Momenta,
    /// Extra outputs. Report.
    pub observes: &'static [Observe],
    /// What ends a run.
    pub stops: &'static [Watch],
    /// What is logged.
    pub marks: &'static [Watch],
    /// Named starts.
    pub starts: &'static [&'static str],
    /// Units of energies and forces.
    pub units: Units,
    /// How contacts are solved that are hit at the same instant.
    pub impacts: Impacts,
}

impl Description {
    /// The frictions that are pressed while a contact is closed, by its force or by those of constraints that it has hold.
    pub(crate) fn frictions_on(&self, contact: usize) -> impl Iterator<Item = usize> + '_ {
        let frictions = self.frictions.iter().enumerate();
        let pressed = move |normal: Normal| normal.contact(self) == Some(contact);
        frictions.filter_map(move |(f, friction)| pressed(friction.normal).then_some(f))
    }

    /// Whether anything but outputs, stops and marks contains branch `index`.
    pub(crate) fn branch_moves(&self, index: usize) -> bool {
        let reported = |user: &usize| {
            let outputs = self.observes.iter().map(|output| output.need);
            let watches = self.stops.iter().chain(self.marks).map(|watch| watch.need);
            outputs.chain(watches).any(|need| need == *user)
        };
        !self.branches[index].users.iter().all(reported)
    }
}

/// Units of what a run reports, beside those of parameters, coordinates and [`Observe`]: derived at build time from the
/// declared ones. An empty text is a plain number, or a unit that does not follow; all are empty if no unit is declared.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// Of kinetic and potential energy: `J`, unless all of them are declared per unit of mass.
    pub energy: &'static str,
    /// Of multipliers, one per row: `N` for a gap in m, `N m` for an angle, `N/m` for a constraint in m².
    pub rows: &'static [&'static str],
    /// Of the values of force items.
    pub forces: &'static [&'static str],
    /// Of the values of dissipations.
    pub dissipations: &'static [&'static str],
}

impl Units {
    /// No unit is declared.
    pub const NONE: Units = Units {
        energy: "",
        rows: &[],
        forces: &[],
        dissipations: &[],
    };

    /// Of the multiplier of this row.
    pub fn row(&self, row: usize) -> &'static str {
        self.rows.get(row).copied().unwrap_or_default()
    }
}

/// How contacts are solved that are hit at the same instant, or while others are closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Impacts {
    /// All in one solution.
    Together,
    /// One after the other in order of declaration, again and again, until none approaches.
    InTurn,
}

impl fmt::Display for Impacts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Impacts::Together => "together",
            Impacts::InTurn => "in_turn",
        })
    }
}

impl FromStr for Impacts {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "together" => Ok(Impacts::Together),
            "in_turn" => Ok(Impacts::InTurn),
            _ => Err("`together` or `in_turn`"),
        }
    }
}

/// A field of the struct.
#[derive(Debug)]
pub struct Parameter {
    /// Name, `mass` or `length[2]`.
    pub name: &'static str,
    /// Doc comment.
    pub documentation: &'static str,
    /// Unit as declared or inferred; empty for a plain number and where nothing is known.
    pub unit: &'static str,
    /// TeX symbol as declared, or empty.
    pub tex: &'static str,
    /// What its value may be.
    pub domain: Domain,
}

/// What the value of a parameter may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Any finite number.
    Any,
    /// Above 0.
    Positive,
    /// 0 or above.
    NonNegative,
}

impl Domain {
    /// Whether a number is in it.
    pub fn contains(self, value: f64) -> bool {
        match self {
            Domain::Any => true,
            Domain::Positive => value > 0.0,
            Domain::NonNegative => value >= 0.0,
        }
    }
}

impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Domain::Any => "finite",
            Domain::Positive => "positive",
            Domain::NonNegative => "at least 0",
        })
    }
}

/// A generalized coordinate.
#[derive(Debug)]
pub struct Coordinate {
    /// Name, `theta` or `theta[2]`.
    pub name: &'static str,
    /// Unit as declared or inferred; empty for a plain number and where nothing is known.
    pub unit: &'static str,
    /// Whether no energy, row or force depends on it.
    pub cyclic: bool,
}

/// A named term of the energies.
#[derive(Debug)]
pub struct Effect {
    /// Name.
    pub name: &'static str,
    /// Need of its contributions.
    #[doc(hidden)]
    pub need: usize,
    /// Whether it can be left out (named by the user).
    pub optional: bool,
}

/// An equality constraint.
#[derive(Debug)]
pub struct Constraint {
    /// Name.
    pub name: &'static str,
    /// Index into the rows.
    #[doc(hidden)]
    pub row: usize,
    /// The contact without which it does not hold.
    pub while_contact: Option<usize>,
    /// The first of the four coordinates of a body's `attitude`, if it only keeps their quaternion at unit length: its multiplier
    /// is then no force that anything could feel.
    pub attitude: Option<usize>,
}

/// A one-sided contact: gap = `rows[row].position` ≥ 0.
#[derive(Debug)]
pub struct Contact {
    /// Name.
    pub name: &'static str,
    /// Index into the rows.
    #[doc(hidden)]
    pub row: usize,
    /// |∂gap/∂p| where `at` is declared: N = λ · factor. None: 1. Motion, need `rows[row].needs.jacobian`.
    #[doc(hidden)]
    pub normal_factor: Option<ValueRef>,
    /// Law of impact. Motion, need `restitution_need`.
    #[doc(hidden)]
    pub restitution: Restitution,
    /// Need of the restitution.
    #[doc(hidden)]
    pub restitution_need: usize,
    /// Parameters that it contains.
    #[doc(hidden)]
    pub restitution_parameters: &'static [usize],
    /// ≥ 0 where the contact exists. Motion, need `rows[row].needs.position`.
    #[doc(hidden)]
    pub region: Option<ValueRef>,
}

/// Coulomb friction.
#[derive(Debug)]
pub struct Friction {
    /// Name.
    pub name: &'static str,
    /// First of its rows (slip components); `rows[row].velocity` is the slip.
    #[doc(hidden)]
    pub row: usize,
    /// Number of slip components, 1 or 2.
    pub components: usize,
    /// Where the normal force comes from.
    #[doc(hidden)]
    pub normal: Normal,
    /// μs. Motion, need `coefficients_need`.
    #[doc(hidden)]
    pub static_coefficient: ValueRef,
    /// μk. Motion, need `coefficients_need`.
    #[doc(hidden)]
    pub kinetic_coefficient: ValueRef,
    /// Need of the coefficients (and of a given normal force).
    #[doc(hidden)]
    pub coefficients_need: usize,
    /// Parameters that μs contains.
    #[doc(hidden)]
    pub static_parameters: &'static [usize],
    /// Parameters that μk contains.
    #[doc(hidden)]
    pub kinetic_parameters: &'static [usize],
}

impl Friction {
    /// Its rows, one per slip component.
    pub(crate) fn rows(&self) -> Range<usize> {
        self.row..self.row + self.components
    }
}

/// An applied force or a dissipation.
#[derive(Debug)]
pub struct Load {
    /// Name.
    pub name: &'static str,
    /// Need of its contribution to the forcing.
    #[doc(hidden)]
    pub need: usize,
    /// Its value (for a dissipation R itself; for a vector force its magnitude). Report, need `report_need`.
    #[doc(hidden)]
    pub value: ValueRef,
    /// Q · v, W. Report, need `report_need`.
    #[doc(hidden)]
    pub power: ValueRef,
    /// Need of value and power.
    #[doc(hidden)]
    pub report_need: usize,
}

/// An extra output.
#[derive(Debug)]
pub struct Observe {
    /// Name.
    pub name: &'static str,
    /// Where. Report.
    #[doc(hidden)]
    pub place: ValueRef,
    /// Its need.
    #[doc(hidden)]
    pub need: usize,
    /// Unit as declared or inferred; empty for a plain number and where nothing is known.
    pub unit: &'static str,
}

/// A stop or a mark: true when all `terms` are ≥ 0 and all `conditions` hold.
#[derive(Debug)]
pub struct Watch {
    /// Name.
    pub name: &'static str,
    /// Guards; report.
    #[doc(hidden)]
    pub terms: &'static [ValueRef],
    /// Conditions on the mode.
    #[doc(hidden)]
    pub conditions: &'static [Condition],
    /// Its need.
    #[doc(hidden)]
    pub need: usize,
    /// `mark(name: e)`: every zero of the single term, in both directions.
    #[doc(hidden)]
    pub zeros: bool,
}
