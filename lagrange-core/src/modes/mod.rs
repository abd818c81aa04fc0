//! Which mode comes next: contacts, friction, impact.
//!
//! [`guard`] says what ends a mode, [`decide`](mod@decide) finds the mode that goes on, [`impact`](mod@impact) what velocities do when
//! a contact is hit, [`domain`](mod@domain) which numbers are legal, [`start`] what holds at the beginning, [`survey`] what a state is like, [`sharing`] how
//! forces that the motion leaves open are shared out.

pub(crate) mod decide;
pub(crate) mod domain;
pub(crate) mod exact;
pub(crate) mod guard;
pub(crate) mod impact;
pub(crate) mod reading;
pub(crate) mod scale;
pub(crate) mod sharing;
pub(crate) mod start;
pub(crate) mod survey;
pub(crate) mod table;
