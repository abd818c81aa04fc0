//! Equations × mode → [`ModeProgram`]: the equations of one mode as a straight line, its linear system in the middle.
//!
//! What the mode says is put in first: pinned coordinates are numbers, constant rows are eliminated (`reduce`), so most
//! terms are gone before anything is shared. What is left is
//!
//! ```text
//! assembly         K, b of (t, q, v)
//! solve            K w = b,   w = (u, −λ of the rows that stay)
//! accelerations    v̇ of w
//! forces           λ of (t, q, v, w)
//! outputs          of (t, q, v, v̇, λ), each under its need
//! ```

mod balance;
mod masked;
pub mod powers;
pub mod products;
mod reduce;
mod stages;
mod whole;

use super::constants::Constants;
use super::form::Fixed;
use super::outputs::Target;
use super::tape::{Block, Step, Tape, Value};
use super::{ValueRef, outputs, tape as plan_tape};
use crate::ast::Emit;
use crate::derive::{Equations, Output, OutputId, Stage};
use crate::model::System;
use crate::modes::{self, Mode};
use crate::sorted::{SortedMap, SortedSet};
use crate::symbolic::{ExprId, Symbol};
use masked::Masked;

pub use stages::Phase;

/// Systems with more operations in a mode are interpreted, unless the declaration says otherwise.
const MOST_OPERATIONS: usize = 220;
/// Systems with more unknowns are interpreted, unless the declaration says otherwise.
const MOST_UNKNOWNS: usize = 8;
/// Systems with more unknowns than these are interpreted in any case.
const MOST_ELIMINATED: usize = 24;
/// More modes than these are not listed.
const MOST_MODES: usize = 16;

/// The linear system K w = b.
pub struct LinearSystem {
    /// The first unknowns are accelerations, the others −λ of the rows that stay.
    pub accelerations: usize,
    /// Whether K is symmetric among the accelerations.
    pub symmetric: bool,
    /// K, row by row.
    pub matrix: Vec<Vec<ValueRef>>,
    /// b
    pub right: Vec<ValueRef>,
    /// 1/Kₚₚ where it depends on parameters only.
    pub reciprocals: Vec<Option<ValueRef>>,
    /// Unknowns that stand alone, already divided by their inertia.
    pub units: Vec<bool>,
    /// The part of K w − b that is of accelerations, with what it shares kept whole, where series have fewer products by that.
    pub balance: Option<Vec<ValueRef>>,
}

impl LinearSystem {
    /// Arithmetic operations of the solution, of a full matrix.
    pub fn operations(&self) -> usize {
        let n = self.matrix.len();
        n * (n + 1) * (2 * n + 1) / 6
    }

    /// Whether series have a balance in the place of the products with an element of K.
    pub fn is_balanced(&self, row: usize, column: usize) -> bool {
        self.balance.is_some() && row.max(column) < self.accelerations
    }
}

/// What a program gives besides accelerations and forces.
pub struct Extra {
    /// Whose number it is.
    pub output: OutputId,
    /// Where it is.
    pub place: ValueRef,
    /// Whether its series is read as well.
    pub has_series: bool,
}

/// The equations of one mode.
pub struct ModeProgram {
    /// The mode.
    pub mode: Mode,
    /// Inputs: parameters, then per friction the sign of its slip and of the multiplier that presses.
    pub constants: Tape,
    /// Inputs: see [`Inputs`]. Blocks in the order of [`Self::phases`].
    pub tape: Tape,
    /// Which phase each block of the tape belongs to.
    pub phases: Vec<Phase>,
    /// Numbers of the inputs.
    pub inputs: Inputs,
    /// The system in the middle.
    pub system: LinearSystem,
    /// The rows whose −λ are unknowns, in their order.
    pub kept: Vec<usize>,
    /// v̇, one per coordinate.
    pub accelerations: Vec<ValueRef>,
    /// λ, one per row; none where a row has no force.
    pub forces: Vec<Option<ValueRef>>,
    /// Gaps, slips, coefficients, guards, terms of stops and marks; then what a projection onto the rows that act takes.
    pub extras: Vec<Extra>,
    /// Coordinates that stand still, and where.
    pub pins: Vec<(usize, ValueRef)>,
    /// Constants that are divided by, and those that they must not be small against.
    pub divisors: Vec<(ValueRef, Vec<ValueRef>)>,
    /// Inertias of parameters alone, which must be positive.
    pub positive: Vec<ValueRef>,
}

/// Where the inputs of a mode's tape begin: t, q, v, w, v̇, λ.
#[derive(Clone, Copy, Debug)]
pub struct Inputs {
    /// Number of coordinates.
    pub coordinates: usize,
    /// Number of unknowns.
    pub unknowns: usize,
}

impl Inputs {
    /// Position of coordinate `j`.
    pub fn position(self, j: usize) -> Value {
        Value(1 + j)
    }
    /// Velocity of coordinate `j`.
    pub fn velocity(self, j: usize) -> Value {
        Value(1 + self.coordinates + j)
    }
    /// Unknown `i`.
    pub fn unknown(self, i: usize) -> Value {
        Value(1 + 2 * self.coordinates + i)
    }
    /// Acceleration of coordinate `j`.
    pub fn acceleration(self, j: usize) -> Value {
        Value(1 + 2 * self.coordinates + self.unknowns + j)
    }
    /// Force of row `r`.
    pub fn force(self, r: usize) -> Value {
        Value(1 + 3 * self.coordinates + self.unknowns + r)
    }
}

/// The programs of the modes that can be listed.
pub(super) fn programs(equations: &mut Equations) -> Vec<ModeProgram> {
    if equations.system.emit == Emit::Data {
        return Vec::new();
    }
    let parameters: Vec<Symbol> = equations
        .system
        .parameters
        .iter()
        .map(|p| p.symbol)
        .collect();
    let frictions = equations.system.frictions.len();
    let pool = &mut equations.system.pool;
    let signs: Vec<[Symbol; 2]> = (0..frictions)
        .map(|i| {
            [
                pool.symbol(&format!("direction{i}")),
                pool.symbol(&format!("pressing{i}")),
            ]
        })
        .collect();
    pool.fix(&signs.concat());
    let fixed = super::numbered(parameters.into_iter().chain(signs.concat()));
    let (modes, _) = modes::structures(&equations.system, MOST_MODES);
    let most = match equations.system.emit {
        Emit::BySize => MOST_UNKNOWNS,
        Emit::Unrolled | Emit::Loops | Emit::Data => MOST_ELIMINATED,
    };
    let unknowns: Vec<Symbol> = (0..most)
        .map(|i| equations.system.pool.symbol(&format!("w{i}")))
        .collect();
    modes
        .into_iter()
        .filter_map(|mode| {
            let mut make = |form| specialise(equations, &mode, &signs, &fixed, &unknowns, form);
            let elements = make(Form::Elements)?;
            let products = |program: &ModeProgram| products::Plan::new(program).convolutions();
            let most = products(&elements) * 3 / 4;
            let whole = (most >= WORTHWHILE).then(|| make(Form::Balance)).flatten();
            let whole = whole.filter(|whole| products(whole) <= most);
            Some(whole.unwrap_or(elements))
        })
        .collect()
}

/// A balance has a quarter fewer products than the elements, and so many at least, or what it has of linear operations costs more.
const WORTHWHILE: usize = 12;

/// What the series of the accelerations are made of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    /// The elements of K and b.
    Elements,
    /// K w − b, with what it shares kept whole.
    Balance,
}

/// The program of a mode; none where numbers must decide how to solve it, where it is too long, or where it has more than these `unknowns`.
fn specialise(
    equations: &mut Equations,
    mode: &Mode,
    signs: &[[Symbol; 2]],
    fixed: &SortedMap<Symbol, usize>,
    unknowns: &[Symbol],
    form: Form,
) -> Option<ModeProgram> {
    let acting = mode.acting_rows(&equations.system);
    let mut pool = std::mem::take(&mut equations.system.pool);
    let pins = modes::pins(equations, &mut pool, &acting);
    let known = modes::pinned(&equations.system, &mut pool, &pins);
    equations.system.pool = pool;
    let coordinates = &equations.system.coordinates;
    let positions = coordinates.iter().map(|c| c.position);
    let velocities = coordinates.iter().map(|c| c.velocity);
    let state: Vec<Symbol> = std::iter::once(equations.system.time)
        .chain(positions)
        .chain(velocities)
        .collect();
    let balances = balance::balances(equations, mode, &acting, &known, signs)?;
    let reduced = reduce::reduce(equations, &balances, &acting, &known, &state)?;
    let free = reduced.free.len();
    let size = free + reduced.kept.len();
    if size > unknowns.len() {
        return None;
    }
    let mut whole = match form {
        Form::Elements => None,
        Form::Balance => Some(whole::whole_balance(
            equations, &balances, &reduced, &acting, unknowns,
        )?),
    };
    let mut sheet = Sheet::default();
    let pool = &mut equations.system.pool;

    // K and b.
    let mut matrix = vec![vec![Masked::default(); size]; size];
    let mut right = Vec::with_capacity(size);
    let index = |k: &usize| reduced.free.iter().position(|f| f == k);
    for (i, balance) in reduced.balances.iter().enumerate() {
        for (k, entry) in reduced.inertia(pool, &balance.mass) {
            matrix[i][index(&k)?] = entry;
        }
        for (m, (row, ..)) in reduced.kept.iter().enumerate() {
            if let Some(force) = balance.forces.get(row) {
                matrix[i][free + m] = force.simplified(pool);
            }
        }
        right.push(balance.load.simplified(pool));
    }
    if let Some(whole) = &whole {
        for (row, own) in matrix.iter_mut().zip(&whole.matrix) {
            row[..free].clone_from_slice(own);
        }
        right.clone_from(&whole.right);
    }
    for (m, (_, along, bias)) in reduced.kept.iter().enumerate() {
        for (k, &a) in along {
            matrix[free + m][index(k)?] = Masked::always(pool, a);
        }
        let minus = pool.neg(*bias);
        right.push(Masked::always(pool, minus));
    }
    if reduced.symmetric {
        // Equal elements are written alike.
        for i in 0..free {
            let (above, below) = matrix.split_at_mut(i);
            let upper = above.iter_mut().zip(&below[0]);
            upper.for_each(|(row, entry)| row[i] = entry.clone());
        }
    }
    let one = pool.integer(1);
    let mut positive = Vec::new();
    let mut units = vec![false; size];
    let mut reciprocals = vec![None; size];
    for i in 0..free {
        let diagonal = matrix[i][i].whole(pool).filter(|&e| {
            !pool.is_zero(e) && !pool.depends_on_any(e, &state) && pool.branches(e).is_empty()
        });
        let Some(inverse) = diagonal.and_then(|e| pool.div(one, e)) else {
            continue;
        };
        positive.extend(diagonal);
        let mut others = (0..size).filter(|&j| j != i);
        if others.all(|j| matrix[i][j].is_zero() && matrix[j][i].is_zero()) {
            let mut quotient = Masked::default();
            quotient.add_scaled(pool, inverse, &right[i]);
            right[i] = quotient.simplified(pool);
            units[i] = true;
            if let Some(whole) = &mut whole {
                let mut quotient = Masked::default();
                quotient.add_scaled(pool, inverse, &whole.balance[i]);
                whole.balance[i] = quotient;
            }
        } else {
            reciprocals[i] = Some(inverse);
        }
    }
    let matrix: Vec<Vec<OutputId>> = matrix
        .iter()
        .map(|row| row.iter().map(|entry| sheet.add("K", entry)).collect())
        .collect();
    let right: Vec<OutputId> = right.iter().map(|load| sheet.add("b", load)).collect();
    let reciprocals: Vec<Option<OutputId>> = reciprocals
        .into_iter()
        .map(|inverse| Some(sheet.add("1/K", &Masked::always(pool, inverse?))))
        .collect();
    let positive: Vec<OutputId> = positive
        .into_iter()
        .map(|e| sheet.add("K", &Masked::always(pool, e)))
        .collect();
    let solved = sheet.list.len();
    let whole: Option<Vec<OutputId>> = whole.map(|whole| {
        let terms = whole.balance.iter();
        terms.map(|sum| sheet.add("K w - b", sum)).collect()
    });
    let balanced = sheet.list.len();

    // v̇ of w
    let w: Vec<ExprId> = unknowns.iter().map(|&w| pool.leaf(w)).collect();
    let mut accelerations = Vec::new();
    for combination in &reduced.accelerations {
        let mut terms = Vec::new();
        for (k, &z) in combination {
            terms.push(pool.mul(z, w[index(k)?]));
        }
        let sum = pool.sum(&terms);
        accelerations.push(sheet.add("acceleration", &Masked::always(pool, sum)));
    }
    let accelerated = sheet.list.len();

    // λ of (t, q, v, w), the last eliminated first.
    let rows = equations.structure.rows.len();
    let mut forces: Vec<Option<Masked>> = vec![None; rows];
    for (m, &(row, ..)) in reduced.kept.iter().enumerate() {
        let minus = pool.neg(w[free + m]);
        forces[row] = Some(Masked::always(pool, minus));
    }
    let one = pool.integer(1);
    let minus_one = pool.integer(-1);
    for solved in reduced.solved.iter().rev() {
        let inverse = pool.div(one, solved.coefficient)?;
        let mut sum = Masked::default();
        for (k, entry) in &reduced.inertia(pool, &solved.balance.mass) {
            sum.add_scaled(pool, w[index(k)?], entry);
        }
        sum.add_scaled(pool, minus_one, &solved.balance.load);
        for (row, factor) in solved
            .balance
            .forces
            .iter()
            .filter(|(row, _)| **row != solved.row)
        {
            let factor = factor.whole(pool)?;
            let factor = pool.neg(factor);
            sum.add_scaled(pool, factor, forces[*row].as_ref()?);
        }
        let mut force = Masked::default();
        force.add_scaled(pool, inverse, &sum);
        forces[solved.row] = Some(force.simplified(pool));
    }
    for slide in &balances.slides {
        let mut force = Masked::default();
        match slide.source {
            Some(source) => force.add_scaled(pool, slide.factor, forces[source].as_ref()?),
            None => force = Masked::always(pool, slide.factor),
        }
        forces[slide.row] = Some(force);
    }
    let forces: Vec<Option<OutputId>> = forces
        .iter()
        .map(|force| Some(sheet.add("force", force.as_ref()?)))
        .collect();
    let forced = sheet.list.len();
    let total: SortedSet<OutputId> = (0..forced).map(OutputId).collect();

    // Pins, divisors, and what guards, stops and marks read.
    let mut divisors = Vec::new();
    for divisor in &reduced.divisors {
        let pivot = sheet.add("divisor", &Masked::always(pool, divisor.pivot));
        let against = divisor.against.iter();
        let against = against.map(|&e| sheet.add("beside", &Masked::always(pool, e)));
        divisors.push((pivot, against.collect::<Vec<_>>()));
    }
    let pinned: Vec<(usize, OutputId)> = pins
        .iter()
        .map(|pin| {
            (
                pin.coordinate,
                sheet.add("pin", &Masked::always(pool, pin.value)),
            )
        })
        .collect();
    let read = extras_of(equations).into_iter();
    let read = read.map(|output| (output, true));
    let projected = projected(equations, &acting, &known, &state).into_iter();
    let projected = projected.map(|output| (output, false));
    let mut extras = Vec::new();
    for (output, has_series) in read.chain(projected) {
        let pool = &mut equations.system.pool;
        let mut terms = Vec::new();
        for &(need, e) in &equations.outputs[output.0].terms {
            let e = pool.substitute(e, &known);
            terms.push((need, pool.simplify(e)));
        }
        terms.retain(|&(_, e)| !pool.is_zero(e));
        sheet.list.push(Output {
            stage: Stage::Motion,
            label: equations.outputs[output.0].label.clone(),
            terms,
        });
        extras.push((output, OutputId(sheet.list.len() - 1), has_series));
    }

    // One tape for all of them.
    let inputs = Inputs {
        coordinates: equations.system.coordinates.len(),
        unknowns: size,
    };
    let numbered = numbered(&equations.system, &state, &unknowns[..size]);
    let pool = &mut equations.system.pool;
    let mut constants = Constants::new(SortedMap::new());
    let mut places = vec![ValueRef::Zero; sheet.list.len()];
    let targets = outputs::targets(
        pool,
        &sheet.list,
        (Stage::Motion, &total),
        &numbered,
        &mut constants,
        &mut places,
    );
    let mut tape = plan_tape(
        pool,
        &mut constants,
        &numbered,
        Fixed::Parameters,
        None,
        &targets,
    );
    let operations = tape.blocks.iter().map(|b| b.steps.len()).sum::<usize>();
    if form == Form::Elements
        && operations > MOST_OPERATIONS
        && equations.system.emit == Emit::BySize
    {
        return None;
    }
    let sources: Vec<Target> = constants
        .sources
        .into_iter()
        .map(Target::of_constant)
        .collect();
    let constants = plan_tape(
        pool,
        &mut Constants::closed(),
        fixed,
        Fixed::Numbers,
        None,
        &sources,
    );
    let node = |id: &OutputId| match places[id.0] {
        ValueRef::Node(node) => Some(node),
        ValueRef::Zero | ValueRef::Constant(_) => None,
    };
    let group = |range: std::ops::Range<usize>| -> SortedSet<usize> {
        range.filter_map(|i| node(&OutputId(i))).collect()
    };
    let goals = [
        group(0..solved),
        group(solved..balanced),
        group(balanced..accelerated),
        group(accelerated..forced),
    ];
    let phases = stages::arrange(&mut tape, &goals);
    let place = |id: &OutputId| places[id.0];
    Some(ModeProgram {
        mode: mode.clone(),
        constants,
        phases,
        inputs,
        system: LinearSystem {
            accelerations: free,
            symmetric: reduced.symmetric,
            matrix: matrix
                .iter()
                .map(|row| row.iter().map(place).collect())
                .collect(),
            right: right.iter().map(place).collect(),
            reciprocals: reciprocals.iter().map(|r| r.as_ref().map(place)).collect(),
            units,
            balance: whole.map(|whole| whole.iter().map(place).collect()),
        },
        kept: reduced.kept.iter().map(|(row, ..)| *row).collect(),
        accelerations: accelerations.iter().map(place).collect(),
        forces: forces.iter().map(|f| f.as_ref().map(place)).collect(),
        extras: extras
            .iter()
            .map(|(output, id, has_series)| Extra {
                output: *output,
                place: place(id),
                has_series: *has_series,
            })
            .collect(),
        pins: pinned.iter().map(|(j, id)| (*j, place(id))).collect(),
        divisors: divisors
            .iter()
            .map(|(pivot, against)| (place(pivot), against.iter().map(place).collect()))
            .collect(),
        positive: positive.iter().map(place).collect(),
        tape,
    })
}

/// The outputs of a mode, before they have places.
#[derive(Default)]
struct Sheet {
    list: Vec<Output>,
}

impl Sheet {
    fn add(&mut self, label: impl Into<String>, sum: &Masked) -> OutputId {
        self.list.push(Output {
            stage: Stage::Motion,
            label: label.into(),
            terms: sum.terms(),
        });
        OutputId(self.list.len() - 1)
    }
}

/// Numbers of the inputs: t, q, v, w, v̇, λ.
fn numbered(system: &System, state: &[Symbol], unknowns: &[Symbol]) -> SortedMap<Symbol, usize> {
    let accelerations = system.coordinates.iter().map(|c| c.acceleration);
    let constraints = system.constraints.iter().map(|c| c.force);
    let contacts = system.contacts.iter().map(|c| c.force);
    let slips = system
        .frictions
        .iter()
        .flat_map(|f| f.slip.iter().map(|(_, force)| *force));
    let inputs = state.iter().copied().chain(unknowns.iter().copied());
    super::numbered(
        inputs
            .chain(accelerations)
            .chain(constraints)
            .chain(contacts)
            .chain(slips),
    )
}

/// What guards, stops and marks read of a series.
fn extras_of(equations: &Equations) -> Vec<OutputId> {
    let structure = &equations.structure;
    let mut list = Vec::new();
    for row in &structure.rows {
        list.extend(row.position);
        list.push(row.velocity);
    }
    for contact in &structure.contacts {
        list.extend(contact.normal_factor);
        list.extend(contact.region);
    }
    for friction in &structure.frictions {
        list.extend(friction.given_normal);
        list.push(friction.static_coefficient);
        list.push(friction.kinetic_coefficient);
    }
    list.extend(structure.branches.iter().map(|branch| branch.guard));
    list.extend(structure.stops.iter().flat_map(|(terms, _)| terms));
    list.extend(structure.marks.iter().flat_map(|(terms, _)| terms));
    list
}

/// Inertia and the Jacobians of the rows that act, if a step can leave one of them by more than rounding: then each step ends with a
/// projection.
fn projected(
    equations: &mut Equations,
    acting: &[usize],
    known: &[(Symbol, ExprId)],
    state: &[Symbol],
) -> Vec<OutputId> {
    let structure = &equations.structure;
    let rows = acting.iter().map(|&row| &structure.rows[row]);
    let jacobians = rows.flat_map(|row| row.jacobian.iter().map(|(_, output)| *output));
    let jacobians: Vec<OutputId> = jacobians.collect();
    let pool = &mut equations.system.pool;
    let outputs = &equations.outputs;
    let varies = |output: &OutputId| {
        outputs[output.0].terms.iter().any(|&(_, e)| {
            let e = pool.substitute(e, known);
            let e = pool.simplify(e);
            pool.depends_on_any(e, state)
        })
    };
    if !jacobians.iter().any(varies) {
        return Vec::new();
    }
    let inertia = structure.mass.iter().map(|(_, _, output)| *output);
    inertia.chain(jacobians).collect()
}

impl ModeProgram {
    /// Whether a projection onto the rows that act finds among the extras what it takes.
    pub fn gives_rows(&self) -> bool {
        self.extras.iter().any(|extra| !extra.has_series)
    }

    /// Whether the linear system is also that of a projection of velocities, [M Aᵀ; A 0], of all coordinates and all rows that act.
    pub fn projects_velocities(&self) -> bool {
        let matrix = &self.system.matrix;
        let free = self.system.accelerations;
        let is_mirrored = |(i, row): (usize, &Vec<ValueRef>)| {
            let mut pairs = row.iter().zip(matrix);
            pairs.all(|(x, other)| *x == other[i])
        };
        let mut rows = matrix[free..].iter();
        self.gives_rows()
            && free == self.inputs.coordinates
            && matrix.iter().enumerate().all(is_mirrored)
            && rows.all(|row| row[free..].iter().all(|x| *x == ValueRef::Zero))
    }

    /// The operations of a phase, block by block.
    pub fn blocks(&self, phase: Phase) -> impl Iterator<Item = &Block> {
        let blocks = self.tape.blocks.iter().zip(&self.phases);
        blocks
            .filter(move |(_, p)| **p == phase)
            .map(|(block, _)| block)
    }

    /// Arithmetic operations up to the end of a phase, the solution of the linear system included.
    pub fn operations(&self, last: Phase) -> usize {
        let blocks = self.tape.blocks.iter().zip(&self.phases);
        let needed = blocks.filter(|(_, phase)| **phase <= last);
        let serves = self.serves_values();
        let steps = needed.flat_map(|(block, _)| &block.steps);
        let steps = steps.filter(|step| step.operation.is_work() && serves[step.value.0]);
        steps.count() + self.system.operations()
    }

    /// Whether each value of the tape is needed where no series are: for other outputs than the balance.
    pub fn serves_values(&self) -> Vec<bool> {
        let balance = self.system.balance.iter().flatten();
        let balance: Vec<ValueRef> = balance.copied().collect();
        let serves = |output| !balance.contains(&ValueRef::Node(output));
        self.needed(serves, |step| step.operation.operands())
    }

    /// Whether each value of the tape is needed by series: for other outputs than the elements that the balance replaces and the extras
    /// that are read as values alone. `operands` says what the series of a step is made of.
    fn serves_series(&self, operands: impl Fn(&Step) -> Vec<Value>) -> Vec<bool> {
        let system = &self.system;
        // The elements among the accelerations, which the balance replaces.
        let free = match system.balance {
            Some(_) => system.accelerations,
            None => 0,
        };
        let elements = system.matrix[..free].iter().flat_map(|row| &row[..free]);
        let values = self.extras.iter().filter(|extra| !extra.has_series);
        let replaced: Vec<ValueRef> = elements
            .chain(&system.right[..free])
            .copied()
            .chain(values.map(|extra| extra.place))
            .collect();
        let kept = system.matrix.iter().enumerate().flat_map(|(i, row)| {
            let elements = row.iter().enumerate();
            elements.filter(move |(j, _)| i >= free || *j >= free)
        });
        let extras = self.extras.iter().filter(|extra| extra.has_series);
        let results = self.accelerations.iter().copied();
        let kept: Vec<ValueRef> = kept
            .map(|(_, place)| *place)
            .chain(system.right[free..].iter().copied())
            .chain(extras.map(|extra| extra.place))
            .chain(results.chain(self.forces.iter().flatten().copied()))
            .collect();
        let serves = |output| {
            let place = ValueRef::Node(output);
            !replaced.contains(&place) || kept.contains(&place)
        };
        self.needed(serves, operands)
    }

    /// Whether each value of the tape is needed for these outputs, given what each step is made of. A value of several is needed if
    /// one of them is.
    fn needed(
        &self,
        output: impl Fn(usize) -> bool,
        operands: impl Fn(&Step) -> Vec<Value>,
    ) -> Vec<bool> {
        let mut needed = vec![false; self.tape.values];
        needed[..self.tape.inputs].fill(true);
        for write in self.tape.blocks.iter().flat_map(|block| &block.writes) {
            needed[write.value.0] |= output(write.output);
        }
        self.with_operands(needed, operands)
    }

    /// These values of the tape and all that they are made of, as `operands` says. A value of several is among them if one of them is.
    fn with_operands(
        &self,
        mut values: Vec<bool>,
        operands: impl Fn(&Step) -> Vec<Value>,
    ) -> Vec<bool> {
        let blocks = self.tape.blocks.iter().rev();
        for step in blocks.flat_map(|block| block.steps.iter().rev()) {
            let own = step.value.0..step.value.0 + step.operation.values();
            if values[own.clone()].contains(&true) {
                values[own].fill(true);
                for operand in operands(step) {
                    values[operand.0] = true;
                }
            }
        }
        values
    }

    /// These inputs of the tape and all that is made of one of them.
    fn with_results(&self, mut values: Vec<bool>) -> Vec<bool> {
        for step in self.tape.blocks.iter().flat_map(|block| &block.steps) {
            let any = step.operation.operands().iter().any(|x| values[x.0]);
            values[step.value.0..step.value.0 + step.operation.values()].fill(any);
        }
        values
    }

    /// Whether each value of the tape depends on the unknowns of the linear system.
    pub fn follows_unknowns(&self) -> Vec<bool> {
        let mut unknowns = vec![false; self.tape.values];
        for i in 0..self.inputs.unknowns {
            unknowns[self.inputs.unknown(i).0] = true;
        }
        self.with_results(unknowns)
    }

    /// Whether each value of the tape changes with time.
    pub fn varying(&self) -> Vec<bool> {
        let mut varies = vec![false; self.tape.values];
        varies[..self.tape.inputs].fill(true);
        for &(j, _) in &self.pins {
            varies[self.inputs.position(j).0] = false;
            varies[self.inputs.velocity(j).0] = false;
        }
        for (j, place) in self.accelerations.iter().enumerate() {
            varies[self.inputs.acceleration(j).0] = matches!(place, ValueRef::Node(_));
        }
        for (r, place) in self.forces.iter().enumerate() {
            varies[self.inputs.force(r).0] = matches!(place, Some(ValueRef::Node(_)));
        }
        self.with_results(varies)
    }
}
