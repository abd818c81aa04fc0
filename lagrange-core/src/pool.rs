//! A list that keeps the memory of what is taken out of it: elements that own vectors are written over, not made anew.

use core::ops::{Deref, DerefMut};

/// A growing list of reused elements; reads as a slice.
#[derive(Debug)]
pub(crate) struct Pool<T> {
    items: Vec<T>,
    length: usize,
}

impl<T: Clone> Clone for Pool<T> {
    fn clone(&self) -> Self {
        Self {
            items: self.to_vec(),
            length: self.length,
        }
    }
}

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self {
            items: Vec::new(),
            length: 0,
        }
    }
}

impl<T: Clone> Pool<T> {
    /// Takes everything out.
    pub(crate) fn clear(&mut self) {
        self.length = 0;
    }

    /// Appends a copy.
    pub(crate) fn push(&mut self, item: &T) {
        match self.items.get_mut(self.length) {
            Some(old) => old.clone_from(item),
            None => self.items.push(item.clone()),
        }
        self.length += 1;
    }

    /// Appends an element that still holds what it last did, or a new one.
    pub(crate) fn reuse(&mut self, new: impl FnOnce() -> T) -> &mut T {
        if self.length == self.items.len() {
            self.items.push(new());
        }
        self.length += 1;
        &mut self.items[self.length - 1]
    }
}

impl<T> Deref for Pool<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.items[..self.length]
    }
}

impl<T> DerefMut for Pool<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.items[..self.length]
    }
}
