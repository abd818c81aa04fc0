//! Units that may be unknown: a dimension times powers of unknowns, and the equations between them.
//!
//! Every quantity whose unit is not given is an unknown u. What is added or compared has one unit, which is a linear
//! equation between exponents; it is solved for one of its unknowns, so each later unit is read in what is left free.

use super::dimension::{Dimension, superscript};
use crate::symbolic::Rational;

/// dimension · Π uᵢ^rᵢ
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Quantity {
    pub dimension: Dimension,
    /// Ascending, without zeros.
    unknowns: Vec<(usize, Rational)>,
}

impl From<Dimension> for Quantity {
    fn from(dimension: Dimension) -> Quantity {
        Quantity {
            dimension,
            unknowns: Vec::new(),
        }
    }
}

impl Quantity {
    /// The dimension, if no unknown is in it.
    pub fn known(&self) -> Option<Dimension> {
        self.unknowns.is_empty().then_some(self.dimension)
    }

    /// self · otherʳ; `None` if an exponent does not fit.
    fn times(&self, other: &Quantity, r: Rational) -> Option<Quantity> {
        let mut unknowns = self.unknowns.clone();
        for &(unknown, power) in &other.unknowns {
            let power = power.checked_mul(r)?;
            match unknowns.binary_search_by_key(&unknown, |&(known, _)| known) {
                Ok(at) => unknowns[at].1 = unknowns[at].1.checked_add(power)?,
                Err(at) => unknowns.insert(at, (unknown, power)),
            }
        }
        unknowns.retain(|(_, power)| !power.is_zero());
        Some(Quantity {
            dimension: self.dimension.times(other.dimension, r)?,
            unknowns,
        })
    }
}

/// The unknowns, and what has been found of them.
#[derive(Default)]
pub(super) struct Unknowns {
    /// What each is, for messages.
    labels: Vec<String>,
    solutions: Vec<Option<Quantity>>,
}

impl Unknowns {
    /// A quantity of which nothing is known; the label names it in messages.
    pub fn fresh(&mut self, label: &str) -> Quantity {
        self.labels.push(label.to_string());
        self.solutions.push(None);
        Quantity {
            dimension: Dimension::ONE,
            unknowns: vec![(self.solutions.len() - 1, Rational::ONE)],
        }
    }

    /// a · bʳ. Exponents that do not fit give a quantity of which nothing is known.
    pub fn times(&mut self, a: &Quantity, b: &Quantity, r: Rational) -> Quantity {
        a.times(b, r).unwrap_or_else(|| self.fresh("?"))
    }

    /// aʳ
    pub fn power(&mut self, a: &Quantity, r: Rational) -> Quantity {
        self.times(&Dimension::ONE.into(), a, r)
    }

    /// With everything put in that has been found.
    pub fn read(&self, quantity: &Quantity) -> Option<Quantity> {
        let mut left = quantity.clone();
        // A solution contains unknowns that were free when it was found, which may have been solved since.
        while let Some((solution, unknown, power)) = left
            .unknowns
            .iter()
            .find_map(|&(unknown, power)| Some((self.solutions[unknown].as_ref()?, unknown, power)))
        {
            left.unknowns.retain(|(other, _)| *other != unknown);
            left = left.times(solution, power)?;
        }
        Some(left)
    }

    /// The dimension of a quantity, if it has been found.
    pub fn dimension(&self, quantity: &Quantity) -> Option<Dimension> {
        self.read(quantity)?.known()
    }

    /// As text, as far as it is known: `m [k]` is m times the unit of k. Empty for a plain number.
    pub fn text(&self, quantity: &Quantity) -> String {
        let read = self.read(quantity).unwrap_or_else(|| quantity.clone());
        let mut parts = vec![read.dimension.text()];
        parts.extend(
            read.unknowns.iter().map(|&(unknown, power)| {
                format!("[{}]{}", self.labels[unknown], superscript(power))
            }),
        );
        parts.retain(|part| !part.is_empty());
        parts.join(" ")
    }

    /// Takes a = b for true; if that cannot be, gives both as far as they are known.
    pub fn conflict(&mut self, a: &Quantity, b: &Quantity) -> Option<(Quantity, Quantity)> {
        let (a, b) = (self.read(a)?, self.read(b)?);
        let mut rest = a.times(&b, Rational::MINUS_ONE)?;
        // The youngest unknown is solved for: older ones are the user's own quantities.
        let Some((unknown, power)) = rest.unknowns.pop() else {
            return (!rest.dimension.is_one()).then_some((a, b));
        };
        let exponent = Rational::MINUS_ONE.checked_div(power)?;
        self.solutions[unknown] = Quantity::from(Dimension::ONE).times(&rest, exponent);
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::grammar::unit;
    use super::{Dimension, Quantity, Unknowns};
    use crate::symbolic::Rational;

    fn of(text: &str) -> Quantity {
        unit(text).unwrap().dimension.into()
    }

    /// T = ½ m v², V = m g y, V = ½ k y^n with v in m/s and y in m: m, g and k follow, and a second equation for m is
    /// true or is not.
    #[test]
    fn unknown_units_follow() {
        let mut unknowns = Unknowns::default();
        let [mass, gravity, stiffness] = ["m", "g", "k"].map(|label| unknowns.fresh(label));
        let kinetic = unknowns.times(&mass, &of("m/s"), Rational::integer(2));
        let height = unknowns.times(&mass, &gravity, Rational::ONE);
        let height = unknowns.times(&height, &of("m"), Rational::ONE);
        let spring = unknowns.times(&of("m^2"), &stiffness, Rational::ONE);
        assert!(unknowns.conflict(&height, &spring).is_none());
        assert_eq!(unknowns.dimension(&mass), None);
        assert!(unknowns.conflict(&kinetic, &height).is_none());
        assert!(unknowns.conflict(&spring, &of("J")).is_none());
        let found =
            [&mass, &gravity, &stiffness].map(|q| unknowns.dimension(q).map(Dimension::text));
        assert_eq!(
            found,
            ["kg", "m/s²", "kg/s²"].map(|text| Some(text.to_string()))
        );
        assert!(unknowns.conflict(&mass, &of("kg")).is_none());
        assert!(unknowns.conflict(&mass, &of("s")).is_some());
    }
}
