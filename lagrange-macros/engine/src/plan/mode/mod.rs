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
mod extras;
mod linear;
mod masked;
pub mod powers;
pub mod products;
mod program;
mod reduce;
mod sheet;
mod solution;
mod stages;
mod whole;

use super::constants::Constants;
use crate::ast::Emit;
use crate::derive::{Equations, Stage};
use crate::model::System;
use crate::modes::{self, Mode};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Symbol};
use masked::Masked;
use sheet::Sheet;

pub use program::{Extra, Inputs, LinearSystem, ModeProgram, Results};
pub use stages::Phase;

/// Systems with more operations in a mode are interpreted, unless the declaration says otherwise.
const MOST_OPERATIONS: usize = 220;
/// Systems with more unknowns are interpreted, unless the declaration says otherwise.
const MOST_UNKNOWNS: usize = 8;
/// Systems with more unknowns than these are interpreted in any case.
const MOST_ELIMINATED: usize = 24;
/// More modes than these are not listed.
const MOST_MODES: usize = 16;

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
    let known = modes::pinned(equations, &mut pool, &pins);
    equations.system.pool = pool;
    let state = super::inputs(&equations.system, Stage::Motion);
    let balances = balance::balances(equations, mode, &acting, &known, signs)?;
    let reduced = reduce::reduce(equations, &balances, &acting, &known, &state)?;
    let size = reduced.free.len() + reduced.kept.len();
    if size > unknowns.len() {
        return None;
    }
    let whole = match form {
        Form::Elements => None,
        Form::Balance => Some(whole::whole_balance(
            equations, &balances, &reduced, &acting, unknowns,
        )?),
    };

    // The sums of which it is made.
    let pool = &mut equations.system.pool;
    let system = linear::linear_system(pool, &reduced, whole, &state)?;
    let w: Vec<ExprId> = unknowns.iter().map(|&w| pool.leaf(w)).collect();
    let accelerations = solution::accelerations(pool, &reduced, &w)?;
    let rows = equations.structure.rows.len();
    let forces = solution::forces(pool, &reduced, &balances.slides, &w, rows)?;
    let divisors = reduced.divisors.iter();
    let divisors = divisors.map(|divisor| divisor.sums(pool)).collect();
    let pins = pins.iter();
    let pins = pins.map(|pin| (pin.coordinate, Masked::always(pool, pin.value)));
    let results = Results {
        system,
        accelerations,
        forces,
        divisors,
        pins: pins.collect(),
        extras: extras::extras(equations, &acting, &known, &state),
    };

    // One tape for all of them.
    let mut sheet = Sheet::default();
    let results = results.map(|phase, sum| sheet.add(phase, &sum));
    let inputs = numbered(&equations.system, &state, &unknowns[..size]);
    let mut constants = Constants::new(SortedMap::new());
    let pool = &mut equations.system.pool;
    let planned = sheet.plan(pool, &inputs, &mut constants);
    let operations = planned.tape.blocks.iter().map(|b| b.steps.len());
    if form == Form::Elements
        && operations.sum::<usize>() > MOST_OPERATIONS
        && equations.system.emit == Emit::BySize
    {
        return None;
    }
    Some(ModeProgram {
        mode: mode.clone(),
        constants: super::constants_tape(pool, constants, fixed),
        inputs: Inputs {
            coordinates: equations.system.coordinates.len(),
            unknowns: size,
        },
        kept: reduced.kept.iter().map(|(row, ..)| *row).collect(),
        results: results.map(|_, output| planned.place(output)),
        tape: planned.tape,
        phases: planned.phases,
    })
}

/// Numbers of the inputs: t, q, v, w, v̇, λ.
fn numbered(system: &System, state: &[Symbol], unknowns: &[Symbol]) -> SortedMap<Symbol, usize> {
    let mut inputs = super::inputs(system, Stage::Report);
    inputs.splice(state.len()..state.len(), unknowns.iter().copied());
    super::numbered(inputs.into_iter())
}
