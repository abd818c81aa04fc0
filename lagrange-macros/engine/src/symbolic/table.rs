//! Tables by expression: pages of plain words, far faster than a hash map in the unoptimised builds that macros
//! run in, and small where few expressions of a large pool have an entry.

use super::ExprId;

/// Words on a page.
const PAGE: usize = 64;

/// A word per expression, `EMPTY` where none has been set.
#[derive(Clone, Default)]
pub(super) struct Words<const EMPTY: u32> {
    pages: Vec<Option<Box<[u32; PAGE]>>>,
}

impl<const EMPTY: u32> Words<EMPTY> {
    pub(super) fn get(&self, e: ExprId) -> u32 {
        match self.pages.get(e.index() / PAGE) {
            Some(Some(page)) => page[e.index() % PAGE],
            _ => EMPTY,
        }
    }

    pub(super) fn set(&mut self, e: ExprId, word: u32) {
        let page = e.index() / PAGE;
        if page >= self.pages.len() {
            self.pages.resize(page + 1, None);
        }
        self.pages[page].get_or_insert_with(|| Box::new([EMPTY; PAGE]))[e.index() % PAGE] = word;
    }
}

/// A set of small numbers per expression.
pub(super) type Flags = Words<0>;

impl Flags {
    /// Adds the number; whether it is new. Numbers from 31 on count as 31.
    pub(super) fn raise(&mut self, e: ExprId, number: u32) -> bool {
        let (before, flag) = (self.get(e), 1 << number.min(31));
        self.set(e, before | flag);
        before & flag == 0
    }
}

/// Expression → expression.
#[derive(Clone, Default)]
pub(super) struct Table(Words<{ u32::MAX }>);

impl Table {
    pub(super) fn get(&self, e: ExprId) -> Option<ExprId> {
        let word = self.0.get(e);
        if word == u32::MAX {
            None
        } else {
            Some(ExprId(word))
        }
    }

    pub(super) fn holds(&self, e: ExprId) -> bool {
        self.0.get(e) != u32::MAX
    }

    pub(super) fn set(&mut self, e: ExprId, to: ExprId) {
        self.0.set(e, to.0);
    }
}
