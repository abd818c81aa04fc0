//! Random declarations through the engine and the core: whatever is declared, what is derived says the same, interpreted and compiled.

mod bare;
mod compiled;
#[rustfmt::skip]
mod written;

use lagrange_core::prelude::*;
use lagrange_engine::ast::Form;
use lagrange_engine::parse::{FUNCTIONS, KEYWORDS};
use lagrange_program::file::{self, Refused};
use lagrange_program::scene::Scene;
use lagrange_tests::Random;
use lagrange_tests::declarations::{Declared, declaration};

/// How many declarations are drawn.
const DRAWN: u64 = 240;

/// The scene of a declaration that is right.
fn scene(number: u64, declared: &Declared) -> &'static dyn Scene {
    let path = format!("drawn-{number}.lagrange");
    match file::scene(&path, &declared.text) {
        Ok(scene) => scene,
        Err(refused) => panic!("{refused}\n{}", declared.text),
    }
}

/// What a declaration says of its first start and its outputs is what is derived from it; along a run everything else that it says
/// is checked by the certificate, which evaluates the declaration in series.
fn check(number: u64, declared: &Declared) -> Option<String> {
    let system = scene(number, declared).system();
    let start = system.at(StartId(0));
    let leaves = declared.leaves_at_start(0.0);
    for (moves, coordinate, factor, term) in &declared.started {
        let list = if *moves { &start.v } else { &start.q };
        let (found, expected) = (list[*coordinate], factor * term.at(&leaves).value);
        assert!(
            near(found, expected),
            "start of {coordinate}: {found} is not {expected}\n{}",
            declared.text
        );
    }
    let simulation = Simulation::new(&system)
        .project_start(true)
        .max_steps(2_000);
    let (run, error) = match simulation.run(start, 0.0..0.5) {
        Ok(run) => (run, None),
        Err(failure) => (*failure.trajectory, Some(failure.error.to_string())),
    };
    let mut sampler = run.sampler();
    let times = run.step_times().collect::<Vec<_>>();
    for pair in times.windows(2) {
        let Ok(now) = sampler.at(0.3 * pair[0] + 0.7 * pair[1]) else {
            continue;
        };
        let leaves = declared.leaves(&now);
        for (name, factor, term) in &declared.observed {
            let observes = run.description().observes;
            let place = observes
                .iter()
                .position(|o| o.name == name)
                .expect("an output");
            let (found, expected) = (now.observes[place], factor * term.at(&leaves).value);
            assert!(
                near(found, expected),
                "{name} at {}: {found} is not {expected} = {}\n{}",
                now.time,
                term.text,
                declared.text
            );
        }
    }
    if let Ok(certificate) = run.verify(number) {
        assert!(
            certificate.holds(),
            "{number}: {certificate}\n{error:?}\n{}",
            declared.text
        );
    }
    error
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-10 * b.abs().max(1.0)
}

#[test]
fn what_is_derived_is_what_is_declared() {
    let mut errors = Vec::new();
    for number in 0..DRAWN {
        let error = check(number, &declaration(number));
        errors.extend(error.map(|error| format!("{number}: {error}")));
    }
    // Forces that jump with a velocity, friction that would have to slip at the start: few runs end early.
    assert!(errors.len() < DRAWN as usize / 15, "{}", errors.join("\n"));
}

/// All that the macro does: code, and the derivation to be read.
#[test]
fn every_declaration_expands() {
    for number in (0..DRAWN).step_by(5) {
        let declared = declaration(number);
        let text = scene(number, &declared).derivation().declaration;
        let tokens = text.parse().expect("tokens");
        let expansion = lagrange_engine::expand(tokens);
        assert!(!expansion.to_string().contains("compile_error"), "{text}");
        // The tokens are handed over: parsing would copy all that are shared.
        let file = syn::parse2::<syn::File>(expansion);
        assert!(file.is_ok(), "{text}");
    }
}

/// Whatever is damaged, there is a scene or a mistake.
#[test]
fn damaged_declarations_are_read_or_refused() {
    let mut random = Random::new(5);
    for number in 0..DRAWN {
        let (text, other) = (declaration(number).text, declaration(number + 1).text);
        let words = |text: &str| -> Vec<String> {
            let tokens = text.split_inclusive(|c: char| !c.is_alphanumeric());
            tokens.map(str::to_owned).collect()
        };
        let (mut damaged, spare) = (words(&text), words(&other));
        for _ in 0..1 + random.below(3) {
            let at = random.below(damaged.len());
            match random.below(3) {
                0 => drop(damaged.remove(at)),
                1 => damaged[at].clone_from(&spare[random.below(spare.len())]),
                _ => {
                    let other = random.below(damaged.len());
                    damaged.swap(at, other);
                }
            }
        }
        let damaged = damaged.concat();
        if let Err(Refused::Bug(reason)) = file::scene("damaged.lagrange", &damaged) {
            panic!("{reason}\n{damaged}");
        }
    }
}

/// Nothing of the language is forgotten: what the parser knows is drawn.
#[test]
fn everything_in_the_language_is_drawn() {
    let texts: String = (0..DRAWN).map(|number| declaration(number).text).collect();
    let forms = Form::ALL.map(|(word, _)| word);
    let others = [
        "where",
        "while",
        "poisson",
        "at",
        "along",
        "on",
        "sum",
        "list",
        "if",
        "and",
        "positive",
        "nonnegative",
    ];
    for word in KEYWORDS
        .iter()
        .chain(FUNCTIONS)
        .chain(&forms)
        .chain(&others)
    {
        let mut words = texts.split(|c: char| !c.is_alphanumeric() && c != '_');
        assert!(words.any(|found| found == *word), "`{word}` is never drawn");
    }
}

/// What is emitted needs no name of its surroundings.
#[test]
#[allow(deprecated)]
fn a_module_without_a_prelude_has_its_equations() {
    let bare = bare::Bare {
        mass: 2.0,
        arm: 0.5,
        gravity: 9.81,
        stiffness: 100.0,
        bounce: 0.5,
        mu: 0.3,
        strength: 0.0,
    };
    let run = Simulation::new(&bare)
        .run(bare.at(bare::Bare::REST), 0.0..1.0)
        .expect("falls");
    let hits = lagrange_tests::event(&run, "floor", "impact").time;
    // The arms hang straight down and take their weight with them.
    lagrange_tests::agree("hits", hits, (2.0 * 0.5 / 9.81_f64).sqrt(), 1e-9);
}
