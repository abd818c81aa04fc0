//! What a right-hand side costs: operations per mode, and of each effect beside what it stands on.

use super::{Cost, Emitted, ModeWork};
use crate::derive::{NeedId, Stage};
use crate::model::{Normal, System};
use crate::modes::{FrictionState, Mode};
use crate::plan::Program;
use crate::plan::mode::Phase;
use crate::plan::mode::products::Plan;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Pool};

/// Effects that are shown.
const MOST_SHOWN: usize = 24;

/// A need mask on its way.
struct Mask(Vec<u64>);

impl Mask {
    fn hold(&mut self, need: NeedId) {
        self.0[need.0 / 64] |= 1 << (need.0 % 64);
    }

    fn holds(&self, need: NeedId) -> bool {
        self.0[need.0 / 64] >> (need.0 % 64) & 1 == 1
    }
}

/// Counts the operations of what runs.
pub(super) struct Counts<'a> {
    pub program: &'a Program,
}

impl Counts<'_> {
    fn system(&self) -> &System {
        &self.program.equations.system
    }

    /// What a mode costs.
    pub fn of_mode(&self, mode: &Mode) -> ModeWork {
        let mut mask = self.energies_and_loads();
        self.hold_mode(mode, &mut mask);
        let operations = self.program.operations(Stage::Motion, &mask.0);
        self.hold_guards(mode, &mut mask);
        let with_guards = self.program.operations(Stage::Motion, &mask.0);
        let mut modes = self.program.modes.iter();
        let own = modes.find(|own| same_structure(&own.mode, mode));
        ModeWork {
            operations,
            with_guards,
            emitted: own.map(|own| Emitted {
                constants: own.constants.outputs,
                unknowns: own.results.system.matrix.len(),
                accelerations: own.operations(Phase::Accelerations),
                whole: own.operations(Phase::Outputs),
                convolutions: Plan::new(own).convolutions(),
            }),
        }
    }

    /// Operations of energies and loads, then of each item that can act beside them.
    pub fn costs(&self, pool: &Pool) -> Vec<Cost> {
        let system = &self.program.equations.system;
        let structure = &self.program.equations.structure;
        let base = self.energies_and_loads();
        let mut costs = Vec::new();
        let mut core = self.empty();
        let named = structure.kinetic.iter().chain(&structure.potential);
        named.for_each(|&need| core.hold(need));
        self.cost(pool, "energies", &self.empty(), &core, &mut costs);
        let loads = structure.forces.iter().map(|f| f.need);
        let loads = loads.chain(structure.dissipations.iter().map(|d| d.need));
        let names = system.forces.iter().map(|f| &f.name.text);
        let names = names.chain(system.dissipations.iter().map(|d| &d.name.text));
        for (name, need) in names.zip(loads) {
            let mut with = Mask(core.0.clone());
            with.hold(need);
            self.cost(pool, name, &core, &with, &mut costs);
        }
        for (i, constraint) in system.constraints.iter().enumerate() {
            let mut with = Mask(base.0.clone());
            self.hold_row(i, &mut with);
            self.cost(pool, &constraint.name.text, &base, &with, &mut costs);
        }
        for (i, contact) in system.contacts.iter().enumerate() {
            let name = &contact.name.text;
            let mut gap = Mask(base.0.clone());
            gap.hold(structure.rows[self.system().contact_row(i)].needs[2]);
            self.cost(pool, &format!("{name} open"), &base, &gap, &mut costs);
            let mut with = Mask(base.0.clone());
            self.hold_row(self.system().contact_row(i), &mut with);
            self.cost(pool, &format!("{name} closed"), &base, &with, &mut costs);
        }
        for (i, friction) in system.frictions.iter().enumerate() {
            let mut pressed = Mask(base.0.clone());
            if let Normal::Contact(contact) = friction.normal {
                self.hold_row(self.system().contact_row(contact), &mut pressed);
            }
            for (verb, state) in [
                ("sticks", FrictionState::Stick),
                ("slips", FrictionState::FORWARD),
            ] {
                let mut with = Mask(pressed.0.clone());
                self.hold_friction(i, state, &mut with);
                let name = format!("{} {verb}", friction.name.text);
                self.cost(pool, &name, &pressed, &with, &mut costs);
            }
        }
        costs.truncate(MOST_SHOWN);
        costs
    }

    fn empty(&self) -> Mask {
        let words = self.program.equations.needs.len().div_ceil(64).max(1);
        let mut mask = Mask(vec![0; words]);
        mask.hold(NeedId(0));
        mask
    }

    fn energies_and_loads(&self) -> Mask {
        let structure = &self.program.equations.structure;
        let mut mask = self.empty();
        let energies = structure.kinetic.iter().chain(&structure.potential);
        energies.for_each(|&need| mask.hold(need));
        let loads = structure.forces.iter().chain(&structure.dissipations);
        loads.for_each(|load| mask.hold(load.need));
        mask
    }

    /// Jacobian and bias of a row.
    fn hold_row(&self, row: usize, mask: &mut Mask) {
        let [jacobian, bias, _, _] = self.program.equations.structure.rows[row].needs;
        mask.hold(jacobian);
        mask.hold(bias);
    }

    fn hold_friction(&self, friction: usize, state: FrictionState, mask: &mut Mask) {
        let structure = &self.program.equations.structure;
        let rows = self.system().slip_rows(friction);
        match state {
            FrictionState::Inactive => {}
            FrictionState::Stick => rows.for_each(|row| self.hold_row(row, mask)),
            FrictionState::Slip(_) => {
                let two = rows.len() > 1;
                mask.hold(structure.frictions[friction].coefficients_need);
                for row in rows {
                    mask.hold(structure.rows[row].needs[0]);
                    if two {
                        mask.hold(structure.rows[row].needs[3]);
                    }
                }
            }
        }
    }

    fn hold_mode(&self, mode: &Mode, mask: &mut Mask) {
        for row in mode.acting_rows(self.system()) {
            self.hold_row(row, mask);
        }
        for (i, state) in mode.frictions.iter().enumerate() {
            self.hold_friction(i, *state, mask);
        }
    }

    fn hold_guards(&self, mode: &Mode, mask: &mut Mask) {
        let structure = &self.program.equations.structure;
        for (i, contact) in structure.contacts.iter().enumerate() {
            if !mode.contacts[i] || contact.region.is_some() {
                mask.hold(structure.rows[contact.row].needs[2]);
            }
        }
        for (i, state) in mode.frictions.iter().enumerate() {
            match state {
                FrictionState::Inactive => {}
                FrictionState::Stick => mask.hold(structure.frictions[i].coefficients_need),
                FrictionState::Slip(_) => {
                    for row in self.system().slip_rows(i) {
                        mask.hold(structure.rows[row].needs[3]);
                    }
                }
            }
        }
        loop {
            let branches = structure.branches.iter();
            let asked: Vec<NeedId> = branches
                .filter(|b| !mask.holds(b.need) && b.users.iter().any(|&user| mask.holds(user)))
                .map(|b| b.need)
                .collect();
            if asked.is_empty() {
                return;
            }
            asked.into_iter().for_each(|need| mask.hold(need));
        }
    }

    /// What the second mask costs beyond the first.
    fn cost(&self, pool: &Pool, name: &str, without: &Mask, with: &Mask, costs: &mut Vec<Cost>) {
        let after = |mask: &Mask| self.program.operations(Stage::Motion, &mask.0);
        // Need 0 alone is where energies without a name stand.
        let base = if name == "energies" {
            0
        } else {
            after(without)
        };
        let after = after(with).saturating_sub(base);
        let mut before = 0_u64;
        let mut sizes = SortedMap::new();
        for output in &self.program.equations.outputs {
            if output.stage != Stage::Motion {
                continue;
            }
            for &(need, term) in &output.terms {
                if with.holds(need) && (name == "energies" || !without.holds(need)) {
                    let size = tree(pool, term, &mut sizes);
                    before = before.saturating_add(size);
                }
            }
        }
        costs.push(Cost {
            name: name.to_owned(),
            before,
            after,
        });
    }
}

/// Whether two modes differ in directions of slips only: functions serve all directions.
fn same_structure(a: &Mode, b: &Mode) -> bool {
    let kind = std::mem::discriminant::<FrictionState>;
    let mut frictions = a.frictions.iter().zip(&b.frictions);
    a.contacts == b.contacts && frictions.all(|(a, b)| kind(a) == kind(b))
}

/// Operations of an expression as a tree: every use of a part counts again.
fn tree(pool: &Pool, e: ExprId, known: &mut SortedMap<ExprId, u64>) -> u64 {
    if let Some(&size) = known.get(&e) {
        return size;
    }
    let mut parts = 0_u64;
    let mut children = Vec::new();
    pool.node(e).for_each_child(|child| children.push(child));
    for child in children {
        parts = parts.saturating_add(tree(pool, child, known));
    }
    let own = match pool.node(e) {
        Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Group(_) => 0,
        Node::Sum { constant, terms } => {
            let scaled = terms.iter().filter(|(_, c)| !c.is_unit()).count();
            terms.len() - usize::from(constant.is_zero()) + scaled
        }
        Node::Product(factors) => {
            let powers = factors.iter().map(|(_, r)| {
                let whole = r.numerator().unsigned_abs() / r.denominator().unsigned_abs();
                let steps = usize::try_from(whole).unwrap_or(1).max(1).ilog2() as usize;
                steps + usize::from(!r.is_integer())
            });
            factors.len() - 1 + powers.sum::<usize>()
        }
        Node::Power(..) => 3,
        Node::Call(..) | Node::Select { .. } => 1,
    };
    let size = parts.saturating_add(own as u64);
    known.insert(e, size);
    size
}
