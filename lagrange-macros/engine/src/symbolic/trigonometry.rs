//! sin²u + cos²u = 1 and cosh²u − sinh²u = 1 in sums.
//!
//! Terms a·X·sin²u, b·X·cos²u and d·X of a sum form a group; it has three equal forms with one of the three terms
//! gone. A form is taken if it has fewer terms, or as many and fewer squares; so the rules end, and a scaled sum is
//! treated alike. Of equally short forms the one without cancellation is taken.

use super::square::Square;
use super::{ExprId, Function, Node, Pool, Rational};

/// Coefficients of X·sin²u, X·cos²u and X.
type Group = [Rational; 3];

impl Pool {
    /// The squares in a product.
    fn squares_of(&mut self, e: ExprId) {
        if self.squares.contains_key(&e) {
            return;
        }
        let Node::Product(factors) = self.node(e) else {
            return;
        };
        let factors = factors.clone();
        let mut squares = Vec::new();
        for (i, &(base, exponent)) in factors.iter().enumerate() {
            let (hyperbolic, cosine, argument) = match self.node(base) {
                Node::Call(Function::Sin, a) => (false, false, a[0]),
                Node::Call(Function::Cos, a) => (false, true, a[0]),
                Node::Call(Function::Sinh, a) => (true, false, a[0]),
                Node::Call(Function::Cosh, a) => (true, true, a[0]),
                _ => continue,
            };
            if exponent.is_integer() && exponent.numerator() >= 2 {
                let mut rest = factors.clone();
                rest[i].1 = self.plus(exponent, Rational::integer(-2));
                let rest = self.monomial(Rational::ONE, &rest);
                squares.push(Square {
                    rest,
                    argument,
                    hyperbolic,
                    cosine,
                });
            }
        }
        self.squares.insert(e, squares);
    }

    /// Applies the rules to collected terms; returns the constant.
    pub(super) fn reduce_squares(
        &mut self,
        constant: Rational,
        terms: &mut Vec<(ExprId, Rational)>,
    ) -> Rational {
        let mut constant = constant;
        loop {
            let mut found: Vec<(Square, usize)> = Vec::new();
            for (i, &(e, _)) in terms.iter().enumerate() {
                if self.has_square(e) {
                    self.squares_of(e);
                    found.extend(self.squares[&e].iter().map(|&square| (square, i)));
                }
            }
            found.sort();
            let sorted = terms.len();
            let mut changed = false;
            let mut at = 0;
            while at < found.len() {
                let (square, first) = found[at];
                at += 1;
                let mut places = [None, None];
                places[usize::from(square.cosine)] = Some(first);
                if let Some(&(next, second)) = found.get(at)
                    && (next.rest, next.argument, next.hyperbolic)
                        == (square.rest, square.argument, square.hyperbolic)
                {
                    places[1] = Some(second);
                    at += 1;
                }
                changed |= self.reduce_group(square, places, &mut constant, terms, sorted);
            }
            if !changed {
                return constant;
            }
            // X can itself be a sum; its terms join in.
            for (e, c) in std::mem::take(terms) {
                constant = self.append(constant, terms, e, c);
            }
            terms.sort_by_key(|&(e, _)| e);
            self.collect(terms);
        }
    }

    /// Rewrites one group if that makes it shorter. Spent terms stay with coefficient 0, new ones are appended.
    fn reduce_group(
        &mut self,
        square: Square,
        places: [Option<usize>; 2],
        constant: &mut Rational,
        terms: &mut Vec<(ExprId, Rational)>,
        sorted: usize,
    ) -> bool {
        let at = |place: Option<usize>| place.map_or(Rational::ZERO, |i| terms[i].1);
        let one = self.is_one(square.rest);
        // Appended terms are not among the sorted ones; a later round sees them.
        let plain = terms[..sorted]
            .binary_search_by_key(&square.rest, |&(e, _)| e)
            .ok();
        let group = [
            at(places[0]),
            at(places[1]),
            if one { *constant } else { at(plain) },
        ];
        let Some(best) = self.shortest(group, square.hyperbolic) else {
            return false;
        };
        let functions = match square.hyperbolic {
            false => [Function::Sin, Function::Cos],
            true => [Function::Sinh, Function::Cosh],
        };
        for i in 0..2 {
            match places[i] {
                Some(place) => terms[place].1 = best[i],
                None if best[i].is_zero() => {}
                None => {
                    let f = self.call(functions[i], &[square.argument]);
                    let factors = [(square.rest, Rational::ONE), (f, Rational::integer(2))];
                    let e = self.monomial(Rational::ONE, &factors);
                    terms.push((e, best[i]));
                }
            }
        }
        match plain {
            _ if one => *constant = best[2],
            Some(place) => terms[place].1 = best[2],
            None if best[2].is_zero() => {}
            None => terms.push((square.rest, best[2])),
        }
        true
    }

    /// The best other form of a group, if it is better than the present one.
    fn shortest(&mut self, [a, b, d]: Group, hyperbolic: bool) -> Option<Group> {
        // With sin² = s(1 − …): cos² = 1 − s·sin², s = 1, or −1 for the hyperbolic pair.
        let sign = if hyperbolic {
            Rational::MINUS_ONE
        } else {
            Rational::ONE
        };
        let (sa, sb) = (self.times(a, sign), self.times(b, sign));
        let negative = [self.negative(sa), self.negative(sb), self.negative(d)];
        let sd = self.times(d, sign);
        let without_cosine = [self.plus(a, negative[1]), Rational::ZERO, self.plus(d, b)];
        let without_sine = [Rational::ZERO, self.plus(b, negative[0]), self.plus(d, sa)];
        let without_plain = [self.plus(a, sd), self.plus(b, d), Rational::ZERO];
        let mut best: Option<(usize, Group)> = None;
        for form in [without_cosine, without_sine, without_plain] {
            if cost(form) < cost([a, b, d]) {
                let key = cost(form) * 2 + usize::from(cancels(form));
                if best.is_none_or(|(least, _)| key < least) {
                    best = Some((key, form));
                }
            }
        }
        best.map(|(_, form)| form)
    }
}

/// Number of terms, then number of squares.
fn cost(form: Group) -> usize {
    let present = form.map(|c| usize::from(!c.is_zero()));
    4 * (present[0] + present[1] + present[2]) + present[0] + present[1]
}

/// Whether coefficients of both signs occur.
fn cancels(form: Group) -> bool {
    form.iter().any(|c| c.is_negative()) && form.iter().any(|c| !c.is_negative() && !c.is_zero())
}
