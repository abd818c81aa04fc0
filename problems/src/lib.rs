//! Textbook scenes and hard cases, each declared once on a struct, with what is known of them by other means. The program that runs and
//! reports them is [`lagrange_program`].
//!
//! A scene is one file in [`scenes`] and one line in [`catalogue`].

pub mod catalogue;
mod closed_form;
pub mod reference;
pub mod scenes;
pub mod stability;
