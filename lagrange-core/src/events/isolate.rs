//! All real roots of a polynomial in (0, 1]: Bernstein subdivision with Descartes' rule of signs.
//!
//! An interval whose Bernstein coefficients change sign once holds one root, which Newton's iteration refines. With two
//! changes and one extremum the sign at the extremum decides between two roots, none, and a touch. Everything else is
//! halved. Coefficients below the rounding noise of their computation have no sign, so that a polynomial which never
//! leaves one sign by more than rounding has no roots.
//!
//! Collins & Akritas (1976); Lane & Riesenfeld, "Bounds on a polynomial", BIT 21 (1981).

use core::ops::ControlFlow::{self, Continue};

use super::bernstein::{Coefficients, MAX_DEGREE, from_powers, split, variations};
use super::refine::{Powers, extremum, noise_factor, root};
use super::root_filter::{RootFilter, root_filter};
use super::{Direction, Root, RootList};

/// Halving stops here: what has not been told apart is one multiple root.
const MIN_WIDTH: f64 = 1.0 / (1u64 << 44) as f64;

/// All roots of Σ cₖ sᵏ in (0, 1], ascending, into `out`. Multiple roots are reported once.
///
/// A value at s = 1 that is zero within rounding counts as a root at s = 1; the one at s = 0 belongs to the step before.
/// A polynomial that is zero within rounding everywhere, or has a coefficient that is not finite, has no roots. Costs a few nanoseconds for most
/// polynomials without roots.
///
/// # Panics
/// If the degree is above [`MAX_DEGREE`].
pub fn roots(c: &[f64], out: &mut RootList) {
    out.clear();
    let _: ControlFlow<()> = visit_roots(c, &mut |root| {
        out.push(root);
        Continue(())
    });
}

/// Shows the roots of Σ cₖ sᵏ in (0, 1] to `judge` in ascending order, until it breaks; with what, if it does. Later roots are not looked for.
///
/// # Panics
/// If the degree is above [`MAX_DEGREE`].
pub fn find_root<R>(c: &[f64], mut judge: impl FnMut(Root) -> ControlFlow<R>) -> Option<R> {
    visit_roots(c, &mut judge).break_value()
}

/// The same up to `end` only: coefficients of a step that goes on beyond may be so large that their rounding hides what is before.
pub fn find_root_until<R>(
    c: &[f64],
    end: f64,
    mut judge: impl FnMut(Root) -> ControlFlow<R>,
) -> Option<R> {
    if end >= 1.0 {
        return find_root(c, judge);
    }
    let mut part: Coefficients = [0.0; MAX_DEGREE + 1];
    let mut power = 1.0;
    for (part, c) in part.iter_mut().zip(c) {
        *part = c * power;
        power *= end;
    }
    find_root(&part[..c.len()], |root| {
        judge(Root {
            s: root.s * end,
            width: root.width * end,
            ..root
        })
    })
}

/// Where Σ cₖ sᵏ turns in (0, 1], ascending, into `out`.
///
/// # Panics
/// If the degree is above [`MAX_DEGREE`] + 1.
pub fn turns(c: &[f64], out: &mut RootList) {
    let mut slope = [0.0; MAX_DEGREE + 1];
    let rates = c.iter().enumerate().skip(1);
    for (slope, (k, c)) in slope.iter_mut().zip(rates) {
        *slope = k as f64 * c;
    }
    roots(&slope[..c.len().saturating_sub(1)], out);
}

/// Where Σ cₖ sᵏ turns next to its falling root at `root`, and how far below zero; nothing if it falls by more than `most`.
pub fn dip(c: &[f64], root: f64, most: f64) -> Option<(f64, f64)> {
    /// Newton's iteration is as good as exact after so many steps, where the curve is a parabola but for a little.
    const STEPS: usize = 4;
    let (mut turn, mut depth) = (root, 0.0);
    for _ in 0..STEPS {
        let [value, slope, curvature] = Powers(c).taylor(turn);
        turn -= slope / curvature;
        depth = 0.5 * slope * slope / curvature - value;
        if !(curvature > 0.0 && depth <= most) {
            return None;
        }
    }
    (turn > root).then_some((turn, depth))
}

/// By how much Σ cₖ sᵏ may be off on [0, 1] without another number of roots there: its smallest size at the ends and where it turns.
///
/// # Panics
/// If the degree is above [`MAX_DEGREE`] + 1.
pub fn clearance(c: &[f64]) -> f64 {
    let mut all = RootList::new();
    turns(c, &mut all);
    let places = all.iter().map(|root| root.s).chain([0.0, 1.0]);
    let sizes = places.map(|s| Powers(c).newton(s).0.abs());
    sizes.fold(f64::INFINITY, f64::min)
}

/// Division by sᵐ of a polynomial whose zero at s = 0 is known to have order `m`: its residues c₀ … cₘ₋₁ are not read.
pub fn deflate(c: &[f64], m: usize) -> &[f64] {
    &c[m.min(c.len())..]
}

/// Calls `visit` for each root in ascending order until it breaks.
fn visit_roots<R, F>(c: &[f64], visit: &mut F) -> ControlFlow<R>
where
    F: FnMut(Root) -> ControlFlow<R>,
{
    let size = match root_filter(c) {
        RootFilter::NoRoots => return Continue(()),
        RootFilter::Monotone { size } => {
            return match monotone_root(c, size) {
                Some(root) => visit(root),
                None => Continue(()),
            };
        }
        RootFilter::Unclear { size } if size.is_finite() => size,
        RootFilter::Unclear { .. } => return Continue(()),
    };
    // Coefficients that cannot be seen in any value only cost time.
    let negligible = f64::EPSILON * f64::EPSILON * size;
    let length = c
        .iter()
        .rposition(|c| c.abs() > negligible)
        .map_or(0, |k| k + 1);
    if length < 2 {
        return Continue(());
    }
    assert!(
        length <= MAX_DEGREE + 1,
        "guard of degree {} is above {MAX_DEGREE}",
        length - 1
    );

    let powers = Powers(&c[..length]);
    let b = from_powers(powers.0);
    let search = Search {
        powers,
        noise: noise_factor(c.len()) * size,
    };
    search.interval(&b, 0.0, 1.0, visit)?;
    let before = b[..length].iter().rfind(|b| b.abs() > search.noise);
    match before.and_then(|before| search.root_at_end(*before > 0.0)) {
        Some(root) => visit(root),
        None => Continue(()),
    }
}

/// The root of a polynomial that only rises or only falls over [0, 1]; `size` = Σ|cₖ|.
#[inline(never)]
fn monotone_root(c: &[f64], size: f64) -> Option<Root> {
    let search = Search {
        powers: Powers(c),
        noise: noise_factor(c.len()) * size,
    };
    let (start, end) = (c[0], search.powers.newton(1.0).0);
    if start.abs() <= search.noise {
        return None;
    }
    if end.abs() <= search.noise {
        return search.root_at_end(start > 0.0);
    }
    if (start > 0.0) == (end > 0.0) {
        return None;
    }
    // The parabola through both ends, with the slope at the start.
    let (below, above) = (start.abs(), end.abs());
    let slope = c[1].abs();
    let bend = above + below - slope;
    let guess = 2.0 * below / (slope + (slope * slope + 4.0 * below * bend).max(0.0).sqrt());
    Some(search.crossing(0.0, 1.0, start > 0.0, guess.min(1.0)))
}

/// What stays the same while one polynomial is subdivided.
struct Search<'a> {
    powers: Powers<'a>,
    noise: f64,
}

impl Search<'_> {
    /// Visits the roots in (lo, hi), where the polynomial has the Bernstein coefficients `b`.
    fn interval<R, F>(&self, b: &Coefficients, lo: f64, hi: f64, visit: &mut F) -> ControlFlow<R>
    where
        F: FnMut(Root) -> ControlFlow<R>,
    {
        let b = &b[..self.powers.0.len()];
        let signs = variations(b.iter().copied(), self.noise);
        let positive = match (signs.count, signs.first_positive) {
            (0, _) | (_, None) => return Continue(()),
            (_, Some(positive)) => positive,
        };
        if signs.count == 1 {
            return visit(self.crossing(
                lo,
                hi,
                positive,
                lo + (hi - lo) * polygon_zero(b, positive, self.noise),
            ));
        }
        let differences = b.windows(2).map(|pair| pair[1] - pair[0]);
        let turns = variations(differences, 2.0 * self.noise).count;
        if signs.count == 2 && turns == 1 {
            return self.turning(lo, hi, positive, visit);
        }
        if hi - lo < MIN_WIDTH || turns == 0 {
            return visit(self.unresolved(lo, hi, positive, signs.count % 2 == 1));
        }
        // A root on the border between two intervals would have a sign in neither: move the border.
        for t in [0.5, 0.4375, 0.5625, 0.3125, 0.6875] {
            let (left, right) = split(b, t);
            if right[0].abs() > self.noise {
                let middle = lo + t * (hi - lo);
                self.interval(&left, lo, middle, visit)?;
                return self.interval(&right, middle, hi, visit);
            }
        }
        visit(self.unresolved(lo, hi, positive, signs.count % 2 == 1))
    }

    /// The one root of an interval in which the sign changes, `positive` at its start.
    fn crossing(&self, lo: f64, hi: f64, positive: bool, guess: f64) -> Root {
        let (s, slope) = root(self.powers, lo..hi, !positive, guess);
        Root {
            s,
            direction: direction(positive),
            grazing: false,
            width: (2.0 * self.powers.noise(s) / slope.abs())
                .min(hi - lo)
                .max(2.0 * f64::EPSILON * s),
        }
    }

    /// An interval with one extremum, of the sign opposite to that of its ends or close to zero.
    fn turning<R, F>(&self, lo: f64, hi: f64, positive: bool, visit: &mut F) -> ControlFlow<R>
    where
        F: FnMut(Root) -> ControlFlow<R>,
    {
        let (s, _) = extremum(self.powers, lo..hi, positive, 0.5 * (lo + hi));
        let [value, _, curvature] = self.powers.taylor(s);
        let noise = self.powers.noise(s);
        if value.abs() <= noise {
            return visit(Root {
                s,
                direction: direction(positive),
                grazing: true,
                width: (2.0 * (2.0 * noise / curvature.abs()).sqrt()).min(hi - lo),
            });
        }
        if (value > 0.0) == positive {
            return Continue(());
        }
        // Near the extremum p ≈ value + curvature/2 (s − s₀)².
        let reach = (2.0 * value / curvature).abs().sqrt();
        let inside = |guess: f64, lo: f64, hi: f64| {
            if guess > lo && guess < hi {
                guess
            } else {
                0.5 * (lo + hi)
            }
        };
        visit(self.crossing(lo, s, positive, inside(s - reach, lo, s)))?;
        visit(self.crossing(s, hi, !positive, inside(s + reach, s, hi)))
    }

    /// A multiple root, or a cluster that rounding does not resolve.
    fn unresolved(&self, lo: f64, hi: f64, positive: bool, changes: bool) -> Root {
        if changes {
            let root = self.crossing(lo, hi, positive, 0.5 * (lo + hi));
            return Root {
                width: hi - lo,
                ..root
            };
        }
        Root {
            s: 0.5 * (lo + hi),
            direction: direction(positive),
            grazing: true,
            width: hi - lo,
        }
    }

    /// A root at s = 1 that rounding cannot tell from it, `positive` before.
    fn root_at_end(&self, positive: bool) -> Option<Root> {
        let (value, slope) = self.powers.newton(1.0);
        if value.abs() > self.noise {
            return None;
        }
        let width = 2.0 * self.noise / slope.abs();
        Some(Root {
            s: 1.0,
            direction: direction(positive),
            grazing: slope.abs() <= self.powers.0.len() as f64 * self.noise,
            width: width.clamp(2.0 * f64::EPSILON, 1.0),
        })
    }
}

/// Where the control polygon of coefficients that change sign once, from `positive`, passes zero: between the last that has the first sign
/// and the first that has the other. Those between them are noise, and so may those before them be.
fn polygon_zero(b: &[f64], positive: bool, noise: f64) -> f64 {
    let has = |b: &f64, sign: bool| b.abs() > noise && (*b > 0.0) == sign;
    let after = b.iter().position(|b| has(b, !positive));
    let after = after.unwrap_or(b.len() - 1);
    let before = b[..after].iter().rposition(|b| has(b, positive));
    let before = before.unwrap_or(0);
    let fraction = b[before] / (b[before] - b[after]);
    (before as f64 + fraction * (after - before) as f64) / (b.len() - 1) as f64
}

/// The way to pass zero from the side given.
fn direction(positive_before: bool) -> Direction {
    if positive_before {
        Direction::Falling
    } else {
        Direction::Rising
    }
}
