//! The known name nearest to an unknown one.

use strsim::osa_distance;

/// The candidate with the fewest edits (insert, delete, replace, swap of neighbours) from `name`, if they are at most a
/// third of its length (at least 1; of one letter only the case may differ). Ties go to the first candidate.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Any two names of one letter are one edit apart: that is no likeness.
    let budget = match name.chars().count() {
        0 | 1 => 0,
        count => (count / 3).max(1),
    };
    let edits = |candidate: &str| match candidate.eq_ignore_ascii_case(name) {
        true => 0,
        false => osa_distance(name, candidate),
    };
    let candidates = candidates.into_iter().map(|known| (edits(known), known));
    let near = candidates.filter(|(edits, _)| *edits <= budget);
    near.min_by_key(|(edits, _)| *edits).map(|(_, known)| known)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_the_likely_meaning() {
        let known = ["theta", "phi", "r", "mass", "gravity", "radius"];
        assert_eq!(nearest("thetta", known), Some("theta"));
        assert_eq!(nearest("gavrity", known), Some("gravity"));
        assert_eq!(nearest("Mass", known), Some("mass"));
        assert_eq!(nearest("velocity", known), None);
    }
}
