//! Lines through points in time, without the points that a picture does not need.

/// The points of a line without those that it passes, straight and evenly from the last to the next one that is kept, at no more than `off` in any of their
/// numbers; `place` tells when each is, and its numbers.
pub(crate) fn straightened<P: Copy, const N: usize>(
    line: &[P],
    off: f64,
    place: impl Fn(&P) -> (f64, [f64; N]),
) -> Vec<P> {
    const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
    let mut kept: Vec<P> = line.first().copied().into_iter().collect();
    // Slopes with which all points after the last one that is kept are passed.
    let mut slopes = [ANY; N];
    for pair in line.windows(2) {
        let (before, after) = (pair[0], pair[1]);
        let (time, numbers) = place(&after);
        let slope = |from: &P, n: usize, off: f64| {
            let (begin, start) = place(from);
            (numbers[n] + off - start[n]) / (time - begin)
        };
        let mut from = kept[kept.len() - 1];
        let passes = |n: usize| (slopes[n][0]..=slopes[n][1]).contains(&slope(&from, n, 0.0));
        if !(0..N).all(passes) {
            kept.push(before);
            (from, slopes) = (before, [ANY; N]);
        }
        for (n, [low, high]) in slopes.iter_mut().enumerate() {
            *low = low.max(slope(&from, n, -off));
            *high = high.min(slope(&from, n, off));
        }
    }
    kept.extend(line.get(1..).and_then(<[_]>::last));
    kept
}

#[cfg(test)]
mod tests {
    use super::straightened;

    /// Every point of a spiral lies no farther than asked from the line that is kept, at its time.
    #[test]
    fn a_spiral_is_passed_at_no_more_than_asked() {
        let spiral = |k: u32| {
            let time = f64::from(k) * 1e-3;
            (time, [time * (3.0 * time).cos(), time * (3.0 * time).sin()])
        };
        let line: Vec<(f64, [f64; 2])> = (0..200_000).map(spiral).collect();
        let off = 0.05;
        let kept = straightened(&line, off, |point| *point);
        assert!(kept.len() < line.len() / 2, "{}", kept.len());
        assert_eq!(
            (kept[0], kept[kept.len() - 1]),
            (line[0], line[line.len() - 1])
        );
        let mut next = 1;
        for (time, at) in &line {
            while kept[next].0 < *time {
                next += 1;
            }
            let ((from, start), (to, end)) = (kept[next - 1], kept[next]);
            let part = (time - from) / (to - from);
            for n in 0..2 {
                let passed = start[n] + part * (end[n] - start[n]);
                assert!((passed - at[n]).abs() <= off * (1.0 + 1e-9), "{time}");
            }
        }
    }
}
