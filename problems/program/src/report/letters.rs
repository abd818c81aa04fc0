//! Names of a declaration as letters: `mu_static`, declared with `symbol = "mu_s"`, is μₛ.

use lagrange_core::prelude::Derivation;
use lagrange_engine::inspect::print::text;
use lagrange_engine::inspect::{Formula, Letter, Meaning};

/// The letters of a declaration.
pub(crate) struct Letters(Vec<Meaning>);

impl Letters {
    /// Read from what was declared; none where nothing was.
    pub(crate) fn of(derivation: &Derivation) -> Self {
        let tokens = derivation.declaration.parse().ok();
        let meanings = tokens.and_then(|tokens| lagrange_engine::meanings(tokens).ok());
        Self(meanings.unwrap_or_default())
    }

    /// A field, a coordinate, its rate or an element of one; a name that is no letter stays.
    pub(crate) fn letter(&self, name: &str) -> String {
        let rate = name
            .strip_prefix("der(")
            .and_then(|rest| rest.strip_suffix(')'));
        if let Some(name) = rate {
            return format!("d{}/dt", self.letter(name));
        }
        let known = |name: &str| {
            let found = self.0.iter().find(|meaning| meaning.name == name);
            found.map(|meaning| meaning.letter.clone())
        };
        let element = || {
            let (array, index) = name.split_once('[')?;
            Some(known(array)?.element(index.trim_end_matches(']')))
        };
        written(
            &known(name)
                .or_else(element)
                .unwrap_or_else(|| Letter::new(name)),
        )
    }
}

fn written(letter: &Letter) -> String {
    text::formula(&Formula::Letter(letter.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lagrange_core::prelude::*;

    #[derive(Lagrangian, Clone, Debug)]
    #[lagrange(
        coordinates(theta),
        define(px = theta),
        kinetic = mu_static/2 * der(theta)^2,
        potential = gravity * px,
    )]
    struct Declared {
        #[lagrange(symbol = "mu_s")]
        mu_static: f64,
        #[lagrange(symbol = "g")]
        gravity: f64,
    }

    #[test]
    fn names_become_the_letters_of_their_declaration() {
        let declared = Declared {
            mu_static: 1.0,
            gravity: 1.0,
        };
        let letters = Letters::of(declared.derivation());
        let names = ["mu_static", "theta", "der(theta)", "gravity", "px"];
        assert_eq!(
            names.map(|name| letters.letter(name)),
            ["μₛ", "θ", "dθ/dt", "g", "px"]
        );
    }
}
