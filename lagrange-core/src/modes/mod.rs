//! Which mode comes next: contacts, friction, impact.
//!
//! [`guard`] says what ends a mode and [`composite`] where forces that are open do, [`facts`] what is known at a switch, [`decide`](mod@decide) finds the mode that goes on, [`impact`](mod@impact) what velocities do when
//! a contact is hit, [`disjoint`] what has nothing to do with one another, [`held`] which branches stay at their border, [`domain`](mod@domain) which numbers are legal, [`start`] what holds at the beginning, [`status`] what a state is like, [`redundant`] how
//! forces that the motion leaves open are shared out.

pub(crate) mod composite;
pub(crate) mod decide;
pub(crate) mod disjoint;
pub(crate) mod domain;
pub(crate) mod exact;
pub(crate) mod facts;
pub(crate) mod guard;
pub(crate) mod held;
pub(crate) mod impact;
pub(crate) mod reading;
pub(crate) mod redundant;
pub(crate) mod scale;
pub(crate) mod start;
pub(crate) mod status;
pub(crate) mod table;
