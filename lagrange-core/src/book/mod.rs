//! The book: how to write systems down, what is computed from them, and how far it can be trusted.
//!
//! Begin with [`language`] and [`results`]; read the others when you need them. Every Rust example is run as a test, and so is every
//! command of the program that is shown.
//!
//! | chapter | what it answers |
//! |---|---|
//! | **Systems** | |
//! | [`language`] | How do I write a system down? Vectors, rigid bodies in space, arrays, forces, starts, outputs. |
//! | [`files`] | The same in a text file, without a compiler. |
//! | [`units`] | Which units are checked, and which signs do forces have? |
//! | [`errors`] | What does this message mean, and what is there to do? |
//! | [`large_systems`] | How many bodies can a system have? |
//! | **Mechanics** | |
//! | [`contacts`] | Contacts, friction, modes: when does a contact open, when does a slip begin, and what if there are two answers? |
//! | [`impacts`] | What happens in an impact, in several at once, in infinitely many? |
//! | **Runs** | |
//! | [`results`] | How do I run a system from code, and read positions, forces, events and energies? |
//! | [`accuracy`] | How exact is a run, which method is the right one, what does accuracy cost? |
//! | [`certificates`] | Is this run right? |
//! | [`effects`] | What happens without friction, without the spring, without the floor? |
//! | [`sensitivities`] | How does the result depend on a parameter? |
//! | [`derivation`] | What was derived, and is it what I have derived by hand? |
//! | **The program** | |
//! | [`program`] | The commands of `lagrange`, its files and formats, a scene of one's own. |
//! | [`reports`] | Pages and pictures that move. |
//! | [`sweeps`] | Thousands and millions of runs. |
//! | [`clusters`] | The same on many machines. |
//! | **Inside** | |
//! | [`inside`] | How it works, room by room, and how to add to it. |

/// A chapter is a file. Where its links to others lead in the documentation is said before it: in the file itself they lead to
/// files, for who reads it there, and of two definitions Markdown takes the first.
macro_rules! chapters {
    ($links:literal $($name:ident)*) => {$(
        #[doc = $links]
        #[doc = include_str!(concat!(stringify!($name), ".md"))]
        pub mod $name {}
    )*};
}

chapters! {
"[accuracy]: mod@accuracy
[certificates]: mod@certificates
[clusters]: mod@clusters
[contacts]: mod@contacts
[derivation]: mod@derivation
[effects]: mod@effects
[errors]: mod@errors
[files]: mod@files
[impacts]: mod@impacts
[inside]: mod@inside
[language]: mod@language
[large_systems]: mod@large_systems
[program]: mod@program
[reports]: mod@reports
[results]: mod@results
[sensitivities]: mod@sensitivities
[sweeps]: mod@sweeps
[units]: mod@units
"
    language
    files
    units
    errors
    large_systems
    contacts
    impacts
    results
    accuracy
    certificates
    effects
    sensitivities
    derivation
    program
    reports
    sweeps
    clusters
    inside
}

/// The examples of the README are run with those of the book.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
mod readme {}
