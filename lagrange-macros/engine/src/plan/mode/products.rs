//! Which series an expansion keeps: the factors of products, four products side by side, and in rows what the core reads.
//!
//! Coefficient k of a product is a sum over the earlier coefficients of its factors; everything else is linear and needs
//! only coefficient k itself.

use super::powers::{Power, powers};
use super::{Extra, ModeProgram, Phase};
use crate::plan::needs::OutputMask;
use crate::plan::{Block, Mode, Operation, Step, Value, ValueRef};
use crate::sorted::SortedMap;
use std::cmp::Reverse;

/// A series that the core reads.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Row {
    /// Of a value.
    Value(Value),
    /// Of an output that several writes enter.
    Sum(usize),
    /// A number that does not change, of an extra output.
    Fixed(usize),
}

/// A series that is multiplied.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Factor {
    /// Of a value.
    Value(Value),
    /// k times coefficient k of a value.
    Weighted(Value),
    /// The auxiliary series of a function: u of tan, asin, ….
    Auxiliary(Value),
    /// Of an output that several writes enter.
    Sum(usize),
}

/// A sum over earlier coefficients: Σ xⱼ yₖ₋ⱼ for 0 < j < k.
pub type Product = (Factor, Factor);

/// The rows and products of a mode.
///
/// Four products make a group: the first those that always count, then those of blocks under needs, which may be of several blocks: a sum
/// that nobody asks for costs nothing beside others.
pub struct Plan {
    /// Whether each value of the tape changes with time, and series need it.
    pub varying: Vec<bool>,
    /// Values whose series are those of powers, whatever operations make them.
    powers: SortedMap<Value, Power>,
    /// Outputs that several writes enter, and whether they change with time.
    pub sums: SortedMap<usize, bool>,
    /// The value of each output that one write sets.
    pub set: SortedMap<usize, Value>,
    rows_of: SortedMap<Row, usize>,
    /// Number of rows.
    pub rows: usize,
    products: usize,
    /// Number of groups of four products.
    pub groups: usize,
    /// The last of these groups: those of blocks under needs.
    pub optional: Vec<Group>,
}

/// Products of blocks under needs that are summed side by side.
pub struct Group {
    /// The needs of which one asks for it.
    pub needs: OutputMask,
    /// The products, each with its value and its number among those of this value.
    pub products: Vec<(Value, usize, Product)>,
}

/// Products that are summed side by side.
pub const GROUP: usize = 4;

/// The row of the force `r`: positions, velocities and forces come first.
pub fn force_row(mode: &ModeProgram, r: usize) -> usize {
    2 * mode.inputs.coordinates + r
}

/// The row after the forces, which stays zero.
pub fn zero_row(mode: &ModeProgram) -> usize {
    force_row(mode, mode.results.forces.len())
}

impl Plan {
    /// What the series of a mode keep.
    pub fn new(mode: &ModeProgram) -> Plan {
        let powers = powers(mode);
        let serves = mode.serves_series(|step| operands(&powers, step));
        let varying = mode.varying().into_iter().zip(serves);
        let mut plan = Plan {
            powers,
            varying: varying.map(|(varies, serves)| varies && serves).collect(),
            sums: SortedMap::new(),
            set: SortedMap::new(),
            rows_of: SortedMap::new(),
            rows: 0,
            products: 0,
            groups: 0,
            optional: Vec::new(),
        };
        for write in mode.tape.blocks.iter().flat_map(|block| &block.writes) {
            let varies = plan.varying[write.value.0];
            if write.mode == Mode::Set {
                plan.set.insert(write.output, write.value);
            } else {
                let set = plan
                    .set
                    .get(&write.output)
                    .is_some_and(|v| plan.varying[v.0]);
                *plan.sums.get_or_insert(write.output, set) |= varies;
            }
        }
        let n = mode.inputs.coordinates;
        for j in 0..n {
            plan.rows_of.insert(Row::Value(mode.inputs.position(j)), j);
            plan.rows_of
                .insert(Row::Value(mode.inputs.velocity(j)), n + j);
        }
        for (r, force) in mode.results.forces.iter().enumerate() {
            if force.is_some() {
                plan.rows_of
                    .insert(Row::Value(mode.inputs.force(r)), force_row(mode, r));
            }
        }
        plan.rows = zero_row(mode) + 1;
        let always = plan.always(mode).len() + plan.system_products(mode).len();
        (plan.products, plan.groups) = (always, always.div_ceil(GROUP));
        plan.optional = plan.optional_groups(mode);
        plan.groups += plan.optional.len();
        let optional = plan.optional.iter().map(|group| group.products.len());
        plan.products += optional.sum::<usize>();
        for extra in &mode.results.extras {
            let row = match extra.place {
                ValueRef::Node(output) => plan.row_of_output(output),
                ValueRef::Constant(at) => Row::Fixed(at),
                ValueRef::Zero => continue,
            };
            plan.keep(row);
        }
        plan
    }

    fn keep(&mut self, row: Row) {
        let next = self.rows;
        if *self.rows_of.get_or_insert(row, next) == next {
            self.rows += 1;
        }
    }

    /// Sums over earlier coefficients for each new one.
    pub fn convolutions(&self) -> usize {
        self.products
    }

    /// Where a series is kept, if it is.
    pub fn row(&self, row: Row) -> Option<usize> {
        self.rows_of.get(&row).copied()
    }

    /// All series that are kept, and where.
    pub fn kept(&self) -> impl Iterator<Item = (&Row, &usize)> {
        self.rows_of.iter()
    }

    /// The groups of blocks under needs, what is most often asked for first, so that they are full where something is left out.
    fn optional_groups(&self, mode: &ModeProgram) -> Vec<Group> {
        let blocks = mode.tape.blocks.iter();
        let mut blocks: Vec<&Block> = blocks.filter(|block| !block.needs.is_always()).collect();
        blocks.sort_by_key(|block| (Reverse(block.needs.len()), &block.needs));
        let products = blocks.iter().flat_map(|block| {
            let own = self.products_of(block).into_iter();
            own.map(|product| (&block.needs, product))
        });
        let products: Vec<_> = products.collect();
        let groups = products.chunks(GROUP).map(|group| {
            let mut needs = OutputMask::default();
            group.iter().for_each(|(own, _)| needs.join(own));
            let products = group.iter().map(|(_, product)| *product).collect();
            Group { needs, products }
        });
        groups.collect()
    }

    /// The values whose series the products of blocks under needs multiply.
    pub fn optional_factors(&self) -> impl Iterator<Item = Value> + '_ {
        let products = self.optional.iter().flat_map(|group| &group.products);
        let factors = products.flat_map(|&(_, _, (x, y))| [x, y]);
        factors.filter_map(|factor| match factor {
            Factor::Value(value) | Factor::Weighted(value) => Some(value),
            Factor::Auxiliary(_) | Factor::Sum(_) => None,
        })
    }

    /// The products that always count, each with its value and its number among those of this value.
    pub fn always(&self, mode: &ModeProgram) -> Vec<(Value, usize, Product)> {
        let blocks = mode.tape.blocks.iter();
        let always = blocks.filter(|block| block.needs.is_always());
        always.flat_map(|block| self.products_of(block)).collect()
    }

    /// The same for the products of a block.
    pub fn products_of(&self, block: &Block) -> Vec<(Value, usize, Product)> {
        let steps = block.steps.iter();
        let products = steps.flat_map(|step| {
            let products = self.products(step).into_iter().enumerate();
            products.map(|(at, product)| (step.value, at, product))
        });
        products.collect()
    }

    /// Whether each value of the tape enters a product, or is read by what follows the balance.
    pub fn multiplied(&self, mode: &ModeProgram) -> Vec<bool> {
        let mut multiplied = vec![false; mode.tape.values];
        let products = self.always(mode).into_iter();
        for factor in products.flat_map(|(_, _, (x, y))| [x, y]) {
            if let Factor::Value(value) | Factor::Weighted(value) | Factor::Auxiliary(value) =
                factor
            {
                multiplied[value.0] = true;
            }
        }
        let blocks = mode.tape.blocks.iter().zip(&mode.phases);
        for (block, _) in blocks.filter(|(_, phase)| **phase > Phase::Balance) {
            let written = block.writes.iter().map(|write| write.value);
            let read = block
                .steps
                .iter()
                .flat_map(|step| step.operation.operands());
            written
                .chain(read)
                .for_each(|value| multiplied[value.0] = true);
        }
        mode.with_operands(multiplied, |step| operands(&self.powers, step))
    }

    /// The power whose series a value has.
    pub fn power(&self, value: Value) -> Option<Power> {
        self.powers.get(&value).copied()
    }

    /// The numbers that do not change and are kept.
    pub fn fixed(&self) -> impl Iterator<Item = usize> + '_ {
        self.rows_of.keys().filter_map(|row| match row {
            Row::Fixed(constant) => Some(*constant),
            _ => None,
        })
    }

    /// The series of an output of the tape.
    pub fn row_of_output(&self, output: usize) -> Row {
        if self.sums.contains_key(&output) {
            Row::Sum(output)
        } else {
            Row::Value(self.set[&output])
        }
    }

    /// Where an extra output is kept; none if it is always zero.
    pub fn extra_row(&self, mode: &ModeProgram, extra: &Extra) -> Option<usize> {
        match extra.place {
            ValueRef::Node(output) => self.row(self.row_of_output(output)),
            ValueRef::Constant(at) => self.row(Row::Fixed(at)),
            ValueRef::Zero => Some(zero_row(mode)),
        }
    }

    /// Whether an output of the tape changes with time.
    pub fn output_varies(&self, output: usize) -> bool {
        match self.sums.get(&output) {
            Some(varies) => *varies,
            None => self.varying[self.set[&output].0],
        }
    }

    /// The products of a step, in the order in which its rule of differentiation names them.
    fn products(&self, step: &Step) -> Vec<Product> {
        use Factor::{Auxiliary, Value as Plain, Weighted};
        if !self.varying[step.value.0] {
            return Vec::new();
        }
        let z = step.value;
        let u = Value(z.0 + 1);
        if let Some(Power { base: x, .. }) = self.power(z) {
            return vec![(Weighted(z), Plain(x)), (Weighted(x), Plain(z))];
        }
        match step.operation {
            Operation::Mul(x, y) if self.varying[x.0] && self.varying[y.0] => {
                vec![(Plain(x), Plain(y))]
            }
            Operation::Square(x) => vec![(Plain(x), Plain(x))],
            Operation::Div(_, y) if self.varying[y.0] => vec![(Plain(z), Plain(y))],
            Operation::Ratio(_, y) => vec![(Plain(z), Plain(y))],
            Operation::Sqrt(_) => vec![(Plain(z), Plain(z))],
            Operation::Exp(x) => vec![(Weighted(x), Plain(z))],
            Operation::Ln(x) => vec![(Weighted(z), Plain(x))],
            Operation::SinCos(x) | Operation::SinhCosh(x) => {
                vec![(Weighted(x), Plain(u)), (Weighted(x), Plain(z))]
            }
            Operation::Tan(x) | Operation::Tanh(x) => {
                vec![(Weighted(x), Auxiliary(z)), (Plain(z), Plain(z))]
            }
            Operation::Asin(x) | Operation::Acos(x) => vec![
                (Weighted(z), Auxiliary(z)),
                (Plain(x), Plain(x)),
                (Auxiliary(z), Auxiliary(z)),
            ],
            Operation::Atan(x) => vec![(Weighted(z), Auxiliary(z)), (Plain(x), Plain(x))],
            Operation::Atan2(y, x) => vec![
                (Weighted(z), Auxiliary(z)),
                (Weighted(y), Plain(x)),
                (Weighted(x), Plain(y)),
                (Plain(y), Plain(y)),
                (Plain(x), Plain(x)),
            ],
            _ => Vec::new(),
        }
    }

    /// The products of the linear system: (row, column, Kᵢⱼ ∗ wⱼ).
    pub fn system_products(&self, mode: &ModeProgram) -> Vec<(usize, usize, Product)> {
        let mut products = Vec::new();
        for (i, row) in mode.results.system.matrix.iter().enumerate() {
            for (j, place) in row.iter().enumerate() {
                if !mode.results.system.is_balanced(i, j)
                    && let ValueRef::Node(output) = *place
                    && self.output_varies(output)
                {
                    let element = match self.row_of_output(output) {
                        Row::Sum(output) => Factor::Sum(output),
                        Row::Value(value) => Factor::Value(value),
                        Row::Fixed(_) => continue,
                    };
                    let unknown = Factor::Value(mode.inputs.unknown(j));
                    products.push((i, j, (element, unknown)));
                }
            }
        }
        products
    }
}

/// What the series of a step is made of.
fn operands(powers: &SortedMap<Value, Power>, step: &Step) -> Vec<Value> {
    match powers.get(&step.value) {
        Some(power) => vec![power.base],
        None => step.operation.operands(),
    }
}
