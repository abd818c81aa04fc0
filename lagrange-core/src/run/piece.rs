//! What a number does in a piece of a step, as a cubic: from its values and its changes over the piece at both ends.

/// A value at an end of a piece, and its change over the piece at the rate there.
pub(super) type Ends = [f64; 2];

/// Least |z| of the cubic with these values and changes at both ends of a piece, or of what is bent in between as |s| is, up to where its tangents
/// meet.
pub(super) fn least_size(before: Ends, after: Ends) -> f64 {
    let ([first, falls], [last, rises]) = (before, after);
    if first * last <= 0.0 {
        return 0.0;
    }
    let side = first.signum();
    let mut least = first.abs().min(last.abs());
    if side * falls < 0.0 && side * rises > 0.0 {
        let meet = (last - rises - first) / (falls - rises);
        least = least.min((side * (first + falls * meet)).max(0.0));
    }
    extremes(before, after).fold(least, |least, (_, z)| match z * first <= 0.0 {
        true => 0.0,
        false => least.min(z.abs()),
    })
}

/// Largest |z| of the cubic with these values and changes at both ends of a piece.
pub(super) fn largest_size(before: Ends, after: Ends) -> f64 {
    let largest = before[0].abs().max(after[0].abs());
    extremes(before, after).fold(largest, |largest, (_, z)| largest.max(z.abs()))
}

/// A root and its change, by those of what is under it.
pub(super) fn of_root([base, change]: Ends) -> Ends {
    let root = base.max(0.0).sqrt();
    [root, change / (2.0 * root)]
}

/// Whether a root with these values and changes at both ends of a piece goes on with the other sign: then the change is the mean of those at
/// the ends.
pub(super) fn passes_zero(before: Ends, after: Ends) -> bool {
    let misfit = |sign: f64| {
        let grows = 0.5 * (before[1] + sign * after[1]);
        (sign * after[0] - before[0] - grows).abs()
    };
    misfit(-1.0) < misfit(1.0)
}

/// Where an angle between ±`range`/2 is beyond its cut in a piece, and how often it has jumped up there: once, or −1 times, or not where it has come back.
pub(super) fn passes_cut(range: f64, before: Ends, after: Ends) -> Option<(f64, f64)> {
    let grows = (before[1] + after[1]) / 2.0;
    let jumps = ((after[0] - before[0] - grows) / range).round();
    if jumps != 0.0 {
        return Some((1.0, jumps));
    }
    let mut extremes = extremes(before, after);
    extremes.find_map(|(s, z)| (2.0 * z.abs() > range).then_some((s, 0.0)))
}

/// Where the slope of the cubic with these values and changes at both ends of a piece vanishes in it, and its values there.
pub(super) fn extremes(
    [first, falls]: Ends,
    [last, rises]: Ends,
) -> impl Iterator<Item = (f64, f64)> {
    // z = first + falls·s + b s² + c s³, whose slope vanishes at two places at most.
    let change = last - first;
    let (b, c) = (
        3.0 * change - 2.0 * falls - rises,
        falls + rises - 2.0 * change,
    );
    // With slopes of up to three times the change at both ends a cubic goes one way (Fritsch & Carlson 1980).
    let goes_on = |slope: f64| slope * change > 0.0 && slope.abs() < 3.0 * change.abs();
    let places = if goes_on(falls) && goes_on(rises) {
        [f64::NAN; 2]
    } else {
        let root = (b * b - 3.0 * c * falls).max(0.0).sqrt();
        let q = -(b + root.copysign(b));
        [q / (3.0 * c), falls / q]
    };
    let inside = places.into_iter().filter(|&s| s > 0.0 && s < 1.0);
    inside.map(move |s| (s, first + s * (falls + s * (b + s * c))))
}

#[cfg(test)]
mod tests {
    use super::{extremes, least_size, passes_cut, passes_zero};
    use core::f64::consts::{PI, TAU};

    #[test]
    fn angles_pass_their_cut_at_an_end_of_a_piece_or_in_between() {
        assert_eq!(passes_cut(TAU, [1.0, 0.5], [1.5, 0.5]), None);
        assert_eq!(
            passes_cut(TAU, [3.0, 0.4], [3.4 - TAU, 0.4]),
            Some((1.0, -1.0))
        );
        assert_eq!(
            passes_cut(TAU, [-3.0, -0.4], [TAU - 3.4, -0.4]),
            Some((1.0, 1.0))
        );
        // π − 0.1 + s − s² is highest in the middle, 0.15 beyond the cut.
        let returns = passes_cut(TAU, [PI - 0.1, 1.0], [PI - 0.1, -1.0]);
        assert_eq!(returns, Some((0.5, 0.0)));
        assert_eq!(passes_cut(TAU, [PI - 0.3, 1.0], [PI - 0.3, -1.0]), None);
        // Of an angle between ±π/2 the cut is nearer.
        assert_eq!(
            passes_cut(PI, [1.5, 0.4], [1.9 - PI, 0.4]),
            Some((1.0, -1.0))
        );
        assert_eq!(passes_cut(PI, [1.5, 1.0], [1.5, -1.0]), Some((0.5, 0.0)));
    }

    #[test]
    fn least_sizes_of_cubics_are_found_between_the_ends() {
        // (s − ½)² + 1 and |s − ½| + 1, by their values and slopes at 0 and 1: both are 3/4 or more.
        assert_eq!(least_size([1.25, -1.0], [1.25, 1.0]), 0.75);
        assert_eq!(least_size([1.5, -1.0], [1.5, 1.0]), 1.0);
        // −2 + s, s − ½, and 1 − 6s + 6s², which is negative in the middle.
        assert_eq!(least_size([-2.0, 1.0], [-1.0, 1.0]), 1.0);
        assert_eq!(least_size([-0.5, 1.0], [0.5, 1.0]), 0.0);
        assert_eq!(least_size([1.0, -6.0], [1.0, 6.0]), 0.0);
        // 1 + s − s³/4 rises and is least at its beginning.
        assert_eq!(least_size([1.0, 1.0], [1.75, 0.25]), 1.0);
        assert_eq!(least_size([3.0, 0.0], [3.0, 0.0]), 3.0);
    }

    #[test]
    fn zeros_of_a_root_are_told_from_curves_that_pass_near() {
        // |s − 0.3|, |(s − 0.3)(s − 2)|, and what falls without passing zero.
        assert!(passes_zero([0.3, -1.0], [0.7, 1.0]));
        assert!(passes_zero([0.6, -2.3], [0.7, 0.3]));
        assert!(!passes_zero([1.0, -0.5], [0.5, -0.5]));
        // √((s − ½)² + 0.09), and (s − ½)² − 0.04, which is negative between its zeros.
        let near = 0.34_f64.sqrt();
        let ends = ([near, -0.5 / near], [near, 0.5 / near]);
        assert!(!passes_zero(ends.0, ends.1));
        assert!(extremes(ends.0, ends.1).all(|(_, root)| root > 0.0));
        let dip = ([0.21, -1.0], [0.21, 1.0]);
        assert!(!passes_zero(dip.0, dip.1));
        let least = extremes(dip.0, dip.1).find(|(_, root)| *root < 0.0);
        assert!(least.is_some_and(|(place, _)| (place - 0.5).abs() < 1e-12));
    }
}
