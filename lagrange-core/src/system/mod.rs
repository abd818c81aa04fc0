//! What the derive macro implements: one tape of equations, and a table that says what its numbers mean.
//!
//! The equations of motion in a mode are, with the rows `i` that act in it,
//!
//! ```text
//! M(q,t) v̇ = f(q,v,t) + Σᵢ (aᵢᵀ + couplings) λᵢ        aᵢ v̇ + γᵢ = 0
//! ```
//!
//! Every number is an *output* of a tape or a parameter-only *constant*; a [`ValueRef`] says which.

mod erased;

use crate::arithmetic::{Number, Scalar};
use crate::declaration::Declaration;
use crate::derivation::Derivation;
use crate::equations::{LaneSeriesFn, ModeStructure, SeriesFn, ValueFn};
use crate::program::Encoded;
pub use crate::program::{Needs, Selection, ValueRef};
use core::fmt;
use core::str::FromStr;
pub use erased::AnySystem;
pub(crate) use erased::{Erased, ErasedSystem};

/// A mechanical system: what `#[derive(Lagrangian)]` implements, with [`Derived`].
///
/// What its equations are made of stands in its description, as [programs](crate::program).
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a mechanical system",
    note = "derive it, `#[derive(Lagrangian)]`, from what stands in `#[lagrange(…)]`; the numbers in it are `f64`, `f32` or `Dual`"
)]
pub trait System: Sized + Send + Sync + 'static {
    /// The number type of parameters and state.
    type Scalar: Scalar;

    /// The same system once more, which is what a run keeps.
    fn copy(&self) -> Self;

    /// The table of names, places and needs.
    fn description(&self) -> &'static Description;

    /// What was declared, as numbers to be evaluated; [`Declaration::NONE`] of a system written by hand.
    fn declaration(&self) -> &'static Declaration {
        &Declaration::NONE
    }

    /// What was derived, to be read; [`Derivation::NONE`] of a system written by hand.
    fn derivation(&self) -> &'static Derivation {
        &Derivation::NONE
    }

    /// Parameter `index` of the description.
    fn parameter(&self, index: usize) -> Self::Scalar;

    /// Sets parameter `index` of the description.
    fn set_parameter(&mut self, index: usize, value: Self::Scalar);

    /// Positions `q` and velocities `v` of start `index`, at time `t`.
    fn start(&self, index: usize, t: Self::Scalar, q: &mut [Self::Scalar], v: &mut [Self::Scalar]);

    /// The modes whose equations are emitted: [values](Self::mode_values) and [series](Self::mode_series).
    const MODES: &'static [ModeStructure] = &[];

    /// Everything that depends on parameters only in mode `mode` of [`Self::MODES`]; `signs` are, per friction, those of its slip
    /// and of the multiplier that presses. False if the parameters do not allow the pivots that were chosen at build time.
    fn mode_constants(
        &self,
        mode: usize,
        held: &Selection,
        signs: &[Self::Scalar],
        c: &mut [Self::Scalar],
    ) -> bool {
        let _ = (mode, held, signs, c);
        false
    }

    /// Right-hand sides of the modes, in the order of [`Self::MODES`].
    fn mode_values<N: Number>() -> &'static [ValueFn<N>] {
        &[]
    }

    /// Taylor series of the modes, in the order of [`Self::MODES`].
    fn mode_series<N: Number>() -> &'static [SeriesFn<N>] {
        &[]
    }

    /// The system without its type, which is all that a run sees of it.
    #[doc(hidden)]
    fn erased(&self) -> AnySystem<Self::Scalar> {
        AnySystem::alone(self.copy())
    }

    /// The Taylor series of the modes, of several motions side by side.
    #[doc(hidden)]
    fn lane_series(&self) -> &'static [LaneSeriesFn<Self::Scalar>] {
        Self::mode_series()
    }
}

/// A system whose tables are known when the program is built: those of all values of its type are the same. A system that is read
/// from a file when the program runs is a [`System`] only.
pub trait Derived: System {
    /// What [`System::description`] returns.
    const DESCRIPTION: &'static Description;

    /// What [`System::declaration`] returns.
    const DECLARATION: &'static Declaration;
}

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
    pub needs: usize,
    /// Everything that depends on parameters only, from the parameters.
    pub constants: Encoded,
    /// What the equations of motion are made of, from (t, q…, v…).
    pub motion: Encoded,
    /// What is read after they are solved, from (t, q…, v…, v̇…, λ… one per row, 0 for rows that do not act).
    pub report: Encoded,
    /// Lower triangle of the mass matrix, structural zeros left out: (row, column ≤ row, where). Motion.
    pub mass: &'static [(usize, usize, ValueRef)],
    /// Parameters that the mass matrix contains, if it is that of a kinetic energy, which must be positive; `None` for a
    /// Lagrangian, whose part of second order in the velocities may have any sign.
    pub inertia: Option<&'static [usize]>,
    /// f, one per coordinate. Motion.
    pub forcing: &'static [ValueRef],
    /// All rows: constraints first, then contacts, then the slip components of frictions. Motion.
    pub rows: &'static [Row],
    /// Forces proportional to a row's multiplier, beside aᵀλ: `Q[coordinate] += place · λ[row]`. Motion.
    pub couplings: &'static [Coupling],
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
    /// Applied forces.
    pub forces: &'static [Load],
    /// Rayleigh dissipations.
    pub dissipations: &'static [Load],
    /// Piecewise branches; guard ≥ 0 on the `then` side.
    pub branches: &'static [Branch],
    /// Energies. Report.
    pub energy: Energy,
    /// Generalized momenta ∂L/∂v, one per coordinate. Report.
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

/// One scalar equation aᵢ v̇ + γᵢ = 0 with multiplier λᵢ.
#[derive(Debug)]
pub struct Row {
    /// aᵢ: (coordinate, where), structural zeros left out. Need [`RowNeeds::jacobian`].
    pub jacobian: &'static [(usize, ValueRef)],
    /// γᵢ. Need [`RowNeeds::bias`].
    pub bias: ValueRef,
    /// g(q,t), for rows of position level (constraints, contacts). Need [`RowNeeds::position`].
    pub position: Option<ValueRef>,
    /// aᵢ v + bᵢ: the rate of g, or the velocity-level residual, or the slip. Need [`RowNeeds::velocity`].
    pub velocity: ValueRef,
    /// What to hold to have each of these.
    pub needs: RowNeeds,
}

/// Needs of a row.
#[derive(Clone, Copy, Debug)]
pub struct RowNeeds {
    /// For the Jacobian (and the couplings of this row).
    pub jacobian: usize,
    /// For the acceleration bias γ.
    pub bias: usize,
    /// For the position residual or gap.
    pub position: usize,
    /// For the velocity residual or slip.
    pub velocity: usize,
}

/// A force proportional to a multiplier.
#[derive(Clone, Copy, Debug)]
pub struct Coupling {
    /// Coordinate that it acts on.
    pub coordinate: usize,
    /// Row whose multiplier scales it.
    pub row: usize,
    /// The factor.
    pub factor: ValueRef,
    /// Need of the force item that it belongs to.
    pub need: usize,
}

/// A named term of the energies.
#[derive(Debug)]
pub struct Effect {
    /// Name.
    pub name: &'static str,
    /// Need of its contributions.
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
    pub row: usize,
    /// The contact without which it does not hold.
    pub while_contact: Option<usize>,
}

/// A one-sided contact: gap = `rows[row].position` ≥ 0.
#[derive(Debug)]
pub struct Contact {
    /// Name.
    pub name: &'static str,
    /// Index into the rows.
    pub row: usize,
    /// |∂gap/∂p| where `at` is declared: N = λ · factor. None: 1. Motion, need `rows[row].needs.jacobian`.
    pub normal_factor: Option<ValueRef>,
    /// Law of impact. Motion, need `restitution_need`.
    pub restitution: Restitution,
    /// Need of the restitution.
    pub restitution_need: usize,
    /// Parameters that it contains.
    pub restitution_parameters: &'static [usize],
    /// ≥ 0 where the contact exists. Motion, need `rows[row].needs.position`.
    pub region: Option<ValueRef>,
}

/// Law of impact.
#[derive(Clone, Copy, Debug)]
pub enum Restitution {
    /// v⁺ = −e v⁻.
    Newton(ValueRef),
    /// Impulse of restitution = e · impulse of compression.
    Poisson(ValueRef),
}

/// Coulomb friction.
#[derive(Debug)]
pub struct Friction {
    /// Name.
    pub name: &'static str,
    /// First of its rows (slip components); `rows[row].velocity` is the slip.
    pub row: usize,
    /// Number of slip components, 1 or 2.
    pub components: usize,
    /// Where the normal force comes from.
    pub normal: Normal,
    /// μs. Motion, need `coefficients_need`.
    pub static_coefficient: ValueRef,
    /// μk. Motion, need `coefficients_need`.
    pub kinetic_coefficient: ValueRef,
    /// Need of the coefficients (and of a given normal force).
    pub coefficients_need: usize,
    /// Parameters that μs contains.
    pub static_parameters: &'static [usize],
    /// Parameters that μk contains.
    pub kinetic_parameters: &'static [usize],
}

/// Source of a friction's normal force.
#[derive(Clone, Copy, Debug)]
pub enum Normal {
    /// λ · factor of this contact.
    Contact(usize),
    /// |λ| of this constraint.
    Constraint(usize),
    /// An expression (`normal = …`; 1 for `limit = …`, whose limits are the coefficients).
    Given(ValueRef),
}

/// An applied force or a dissipation.
#[derive(Debug)]
pub struct Load {
    /// Name.
    pub name: &'static str,
    /// Need of its contribution to the forcing.
    pub need: usize,
    /// Its value (for a dissipation R itself; for a vector force its magnitude). Report, need `report_need`.
    pub value: ValueRef,
    /// Q · v, W. Report, need `report_need`.
    pub power: ValueRef,
    /// Need of value and power.
    pub report_need: usize,
}

/// A piecewise branch.
#[derive(Debug)]
pub struct Branch {
    /// `then` while ≥ 0. Motion if [`Self::after_solve`] is false, else report.
    pub guard: ValueRef,
    /// Need of the guard.
    pub need: usize,
    /// Whether the guard uses accelerations or forces, so only outputs of the report can use the branch.
    pub after_solve: bool,
    /// Needs of which any one makes the branch matter.
    pub users: &'static [usize],
    /// As the user wrote it.
    pub text: &'static str,
}

/// Energies; all in the report tape.
///
/// What a scene can leave out stands under its own need ([`Effect::need`]), here as in the motion tape, so that
/// these add up what acts: hold the needs of the active effects beside [`Energy::need`].
#[derive(Debug)]
pub struct Energy {
    /// T as declared.
    pub kinetic: ValueRef,
    /// V as declared.
    pub potential: ValueRef,
    /// v·∂L/∂v − L.
    pub jacobi: ValueRef,
    /// −∂L/∂t: the rate of the Jacobi integral that explicit time causes.
    pub time_power: ValueRef,
    /// Need of the unnamed energies' part of all of them.
    pub need: usize,
}

/// Generalized momenta; needs as for [`Energy`].
#[derive(Debug)]
pub struct Momenta {
    /// ∂L/∂v, one per coordinate. Report.
    pub places: &'static [ValueRef],
    /// Need of the unnamed energies' part of all of them.
    pub need: usize,
}

/// An extra output.
#[derive(Debug)]
pub struct Observe {
    /// Name.
    pub name: &'static str,
    /// Where. Report.
    pub place: ValueRef,
    /// Its need.
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
    pub terms: &'static [ValueRef],
    /// Conditions on the mode.
    pub conditions: &'static [Condition],
    /// Its need.
    pub need: usize,
    /// `mark(name: e)`: every zero of the single term, in both directions.
    pub zeros: bool,
}

/// A condition on the mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// This contact is closed.
    Closed(usize),
    /// This contact is open.
    Open(usize),
    /// This friction sticks.
    Sticks(usize),
    /// This friction slips.
    Slips(usize),
}
