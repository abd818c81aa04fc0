//! Gaps that cannot close: distances without size, and squares.

use crate::model::Hint;
use crate::model::elaboration::Elaboration;

impl Elaboration<'_> {
    /// Remarks on contacts whose gaps are never negative.
    pub(super) fn one_sided(&mut self) {
        let system = &self.system;
        let never = system.contacts.iter();
        let never = never.filter(|contact| system.pool.is_never_negative(contact.gap));
        let hints: Vec<Hint> = never
            .map(|contact| Hint {
                text: format!(
                    "the gap of `{}` is never negative, whatever the motion does, so that it keeps nothing apart; write one that changes its sign, `b - a >= 0`, or give what meets a size, `norm(p - q) >= radius`",
                    contact.name.text
                ),
                extent: contact.name.span.into(),
            })
            .collect();
        self.system.hints.extend(hints);
    }
}
