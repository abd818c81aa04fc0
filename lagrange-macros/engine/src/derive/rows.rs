//! Constraints, contacts and slips → rows `a v̇ + γ = 0`.
//!
//! ```text
//! position level    g(q,t) = 0          a = ∂g/∂q, b = ∂g/∂t      (holonomic; one-sided: gap g ≥ 0)
//! velocity level    s(q,v,t) = 0        a = ∂s/∂v, b = s at v = 0 (linear: nonholonomic, or a slip)
//! both              a v + b = 0         γ = d/dt (a v + b) at v̇ = 0
//! ```
//!
//! The row's multiplier λ adds aᵀλ to the equations of motion (Lanczos 1970, sections II.5 and V.8; Goldstein, Poole
//! & Safko 2002, section 2.4), for one-sided rows with 0 ≤ λ ⟂ g ≥ 0 (Brogliato 2016, section 5.1; Glocker 2001,
//! chapter 5).

use super::forms::{Variables, cheapest};
use super::sheet::Sheet;
use super::{Contact, NeedId, OutputId, Row};
use crate::model::{ItemName, Level, Restitution};
use crate::symbolic::{ExprId, Pool};

/// The expressions of one row.
struct Form {
    jacobian: Vec<(usize, ExprId)>,
    bias: ExprId,
    position: Option<ExprId>,
    velocity: ExprId,
    rheonomic: bool,
}

/// All rows: constraints, contacts, slip components.
pub(super) fn rows(sheet: &mut Sheet) -> Vec<Row<OutputId>> {
    enum Source {
        Position(ExprId),
        Velocity(ExprId),
    }
    let mut sources: Vec<(ItemName, String, &str, Source)> = Vec::new();
    for c in &sheet.system.constraints {
        let source = match c.level {
            Level::Position => Source::Position(c.residual),
            Level::Velocity => Source::Velocity(c.residual),
        };
        sources.push((c.name.clone(), c.name.text.clone(), "rate", source));
    }
    for c in &sheet.system.contacts {
        let source = Source::Position(c.gap);
        sources.push((c.name.clone(), c.name.text.clone(), "rate", source));
    }
    for f in &sheet.system.frictions {
        for (k, &(slip, _)) in f.slip.iter().enumerate() {
            let name = match f.slip.len() {
                1 => f.name.text.clone(),
                _ => format!("{}.{k}", f.name.text),
            };
            sources.push((f.name.clone(), name, "slip", Source::Velocity(slip)));
        }
    }
    let mut rows = Vec::new();
    for (index, (item, name, velocity, source)) in sources.into_iter().enumerate() {
        let (pool, x) = (&mut sheet.system.pool, &sheet.x);
        let form = match source {
            Source::Position(g) => position_level(pool, x, g),
            Source::Velocity(s) => velocity_level(pool, x, s),
        };
        rows.push(write(sheet, &name, velocity, sheet.needs.rows[index], form));
        sheet.derived_of(item);
    }
    rows
}

/// The numbers of the contacts beside their rows.
pub(super) fn contacts(sheet: &mut Sheet) -> Vec<Contact<OutputId>> {
    let mut contacts = Vec::new();
    for i in 0..sheet.system.contacts.len() {
        let row = sheet.system.constraints.len() + i;
        let [jacobian, _, position, _] = sheet.needs.rows[row];
        let restitution_need = sheet.needs.restitution[i];
        let contact = &sheet.system.contacts[i];
        let name = contact.name.text.clone();
        let (normal_factor, region) = (contact.normal_factor, contact.region);
        let (Restitution::Newton(e) | Restitution::Poisson(e)) = contact.restitution;
        let mut simple = |kind: &str, need: NeedId, e: ExprId| {
            let e = sheet.system.pool.simplify(e);
            sheet.motion(format!("{kind}[{name}]"), need, e)
        };
        contacts.push(Contact {
            row,
            normal_factor: normal_factor.map(|e| simple("normal_factor", jacobian, e)),
            restitution: simple("restitution", restitution_need, e),
            restitution_need,
            region: region.map(|e| simple("region", position, e)),
        });
        sheet.derived_of(sheet.system.contacts[i].name.clone());
    }
    contacts
}

fn position_level(pool: &mut Pool, x: &Variables, g: ExprId) -> Form {
    let position = pool.simplify(g);
    let jacobian: Vec<(usize, ExprId)> = x
        .positions_in(pool, position)
        .into_iter()
        .map(|i| (i, x.slope(pool, position, i)))
        .collect();
    let drift = pool.differentiate(position, x.time);
    let declared = x.rate(pool, position);
    Form {
        position: Some(position),
        ..form(pool, x, jacobian, drift, declared)
    }
}

fn velocity_level(pool: &mut Pool, x: &Variables, s: ExprId) -> Form {
    let jacobian: Vec<(usize, ExprId)> = x
        .velocities_in(pool, s)
        .into_iter()
        .map(|i| (i, pool.differentiate(s, x.velocities[i])))
        .collect();
    let drift = x.at_rest(pool, s);
    form(pool, x, jacobian, drift, s)
}

/// Velocity and bias from a, b and a declared form of a v + b, each in its cheapest form.
fn form(
    pool: &mut Pool,
    x: &Variables,
    mut jacobian: Vec<(usize, ExprId)>,
    drift: ExprId,
    declared: ExprId,
) -> Form {
    for (_, a) in &mut jacobian {
        *a = pool.simplify(*a);
    }
    jacobian.retain(|&(_, a)| !pool.is_zero(a));
    let company: Vec<ExprId> = jacobian.iter().map(|&(_, a)| a).collect();
    let drift = pool.simplify(drift);

    let along = x.along_velocity(pool, &jacobian);
    let rebuilt = pool.add(along, drift);
    let velocity_forms = [rebuilt, declared].map(|e| pool.simplify(e));
    let velocity = cheapest(
        pool,
        &company,
        velocity_forms.iter().map(|&e| vec![e]).collect(),
    )[0];

    let turning: Vec<(usize, ExprId)> = jacobian
        .iter()
        .map(|&(i, a)| {
            let rate = x.rate(pool, a);
            (i, pool.simplify(rate))
        })
        .collect();
    let turning = x.along_velocity(pool, &turning);
    let drifting = x.rate(pool, drift);
    let rebuilt = pool.add(turning, drifting);
    let direct = x.rate(pool, velocity);
    let bias_forms = [rebuilt, direct].map(|e| vec![pool.simplify(e)]);
    let bias = cheapest(pool, &company, bias_forms.into())[0];
    Form {
        jacobian,
        bias,
        position: None,
        velocity,
        rheonomic: !pool.is_zero(drift),
    }
}

fn write(
    sheet: &mut Sheet,
    name: &str,
    velocity: &str,
    needs: [NeedId; 4],
    form: Form,
) -> Row<OutputId> {
    let mut jacobian = Vec::new();
    for (i, a) in form.jacobian {
        let label = format!("jacobian[{name}, {}]", sheet.coordinate(i));
        jacobian.push((i, sheet.motion(label, needs[0], a)));
    }
    Row {
        jacobian,
        bias: sheet.motion(format!("bias[{name}]"), needs[1], form.bias),
        position: form
            .position
            .map(|g| sheet.motion(format!("position[{name}]"), needs[2], g)),
        velocity: sheet.motion(format!("{velocity}[{name}]"), needs[3], form.velocity),
        rheonomic: form.rheonomic,
        needs,
    }
}
