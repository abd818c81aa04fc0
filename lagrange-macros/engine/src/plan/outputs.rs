//! Outputs of the equations → what a tape must deliver, and where each output will be found.

use super::ValueRef;
use super::constants::{Constants, Source};
use super::form::Former;
use super::graph::NodeId;
use super::needs::OutputMask;
use super::tape::Mode;
use crate::derive::{NeedId, Output, OutputId, Stage};
use crate::sorted::{SortedMap, SortedSet};
use crate::symbolic::{ExprId, Pool, Symbol};

/// An output of a tape: the sum of those terms that are asked for.
pub(super) struct Target {
    /// What the sum starts from, a constant that is always there.
    start: Option<ExprId>,
    terms: Vec<(OutputMask, ExprId)>,
    /// Whether it is 0 where none of the terms is asked for.
    from_zero: bool,
}

/// A node that enters an output.
pub(super) struct Entry {
    pub output: usize,
    pub needs: OutputMask,
    pub node: NodeId,
    pub mode: Mode,
}

impl Target {
    /// One expression that is always computed.
    pub fn always(e: ExprId) -> Target {
        Target {
            start: None,
            terms: vec![(OutputMask::always(), e)],
            from_zero: false,
        }
    }

    /// A constant that the tapes ask for.
    pub fn of_constant((source, needs): (Source, OutputMask)) -> Target {
        match source {
            Source::Whole(e) => Target {
                start: None,
                terms: vec![(needs, e)],
                from_zero: false,
            },
            Source::Masked(terms) => {
                let terms = terms
                    .into_iter()
                    .map(|(need, e)| (OutputMask::single(need), e))
                    .collect();
                Target {
                    start: None,
                    terms,
                    from_zero: true,
                }
            }
        }
    }

    /// What enters the output, in order.
    pub fn entries(&self, output: usize, former: &mut Former) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(self.terms.len() + 1);
        let begun = self
            .terms
            .first()
            .is_some_and(|(needs, _)| needs.is_always());
        if self.from_zero && !begun {
            let node = match self.start {
                Some(start) => former.fixed(start),
                None => former.zero(),
            };
            entries.push(Entry {
                output,
                needs: OutputMask::always(),
                node,
                mode: Mode::Set,
            });
        }
        for (needs, e) in &self.terms {
            let form = former.form(*e);
            let (node, mode) = match (entries.is_empty(), self.start) {
                (true, Some(start)) => (former.offset(start, form), Mode::Set),
                (true, None) => (former.node(form), Mode::Set),
                _ => {
                    let (negative, node) = former.signed_node(form);
                    (node, if negative { Mode::Sub } else { Mode::Add })
                }
            };
            entries.push(Entry {
                output,
                needs: needs.clone(),
                node,
                mode,
            });
        }
        entries
    }
}

/// The terms of an output, one for each need.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Terms {
    /// Without zeros.
    terms: Vec<(NeedId, ExprId)>,
    /// Whether the output is read whatever is held, so that it must be 0 where nothing is.
    total: bool,
}

impl Terms {
    fn new(pool: &mut Pool, output: &Output, always_read: bool) -> Terms {
        let mut needs: SortedMap<NeedId, Vec<ExprId>> = SortedMap::new();
        for (need, e) in &output.terms {
            needs.get_or_default(*need).push(*e);
        }
        let total = always_read || needs.len() > 1;
        let mut terms: Vec<_> = needs
            .into_iter()
            .map(|(need, terms)| (need, pool.sum(&terms)))
            .collect();
        terms.retain(|(_, e)| !pool.is_zero(*e));
        Terms { terms, total }
    }
}

/// Targets of a stage; equal outputs share a place. `always_read`: outputs that are read whatever is held.
pub(super) fn targets(
    pool: &mut Pool,
    outputs: &[Output],
    (stage, always_read): (Stage, &SortedSet<OutputId>),
    inputs: &SortedMap<Symbol, usize>,
    constants: &mut Constants,
    places: &mut [ValueRef],
) -> Vec<Target> {
    let mut targets = Vec::new();
    let mut known: SortedMap<Terms, ValueRef> = SortedMap::new();
    for (index, (output, place)) in outputs.iter().zip(places).enumerate() {
        if output.stage != stage {
            continue;
        }
        let terms = Terms::new(pool, output, always_read.contains(&OutputId(index)));
        *place = *known.get_or_insert_with(terms.clone(), || {
            let (varying, fixed): (Vec<_>, Vec<_>) = terms
                .terms
                .into_iter()
                .partition(|(_, e)| varies(pool, inputs, *e));
            if varying.is_empty() {
                return constant(constants, &fixed, terms.total);
            }
            targets.push(target(pool, constants, varying, fixed, terms.total));
            ValueRef::Node(targets.len() - 1)
        });
    }
    targets
}

/// The place of an output of parameters only.
fn constant(constants: &mut Constants, terms: &[(NeedId, ExprId)], total: bool) -> ValueRef {
    match *terms {
        [] => ValueRef::Zero,
        [(need, e)] if !total || need.0 == 0 => {
            let index = constants.constant(Source::Whole(e));
            constants.sources[index].1.join(&OutputMask::single(need));
            ValueRef::Constant(index)
        }
        _ => ValueRef::Constant(constants.constant(Source::Masked(terms.to_vec()))),
    }
}

fn target(
    pool: &mut Pool,
    constants: &mut Constants,
    varying: Vec<(NeedId, ExprId)>,
    fixed: Vec<(NeedId, ExprId)>,
    total: bool,
) -> Target {
    let terms = varying
        .into_iter()
        .map(|(need, e)| (OutputMask::single(need), e))
        .collect();
    // What is fixed is where the sum starts; a masked sum of the constants program if any of it can be left out.
    let start = match fixed[..] {
        [] => None,
        [(need, e)] if need.0 == 0 => Some(e),
        _ => Some(constants.masked(pool, fixed)),
    };
    Target {
        start,
        terms,
        from_zero: total,
    }
}

/// Whether an expression changes during a run.
fn varies(pool: &Pool, inputs: &SortedMap<Symbol, usize>, e: ExprId) -> bool {
    !pool.branches(e).is_empty()
        || pool
            .symbols(e)
            .iter()
            .any(|symbol| inputs.contains_key(symbol))
}
