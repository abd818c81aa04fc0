//! Colours by name, for light and dark pages; text stands out from its ground by a factor of 4.5 at least (WCAG 2.2, AA).

/// Name, on light pages, on dark pages.
const COLOURS: [(&str, [&str; 2]); 23] = [
    ("page", ["#ffffff", "#14171b"]),
    ("card", ["#f6f7f9", "#1d2126"]),
    ("ink", ["#1b1f24", "#e8eaed"]),
    ("quiet", ["#525a64", "#b0b7c0"]),
    ("line", ["#c3c9d1", "#434a54"]),
    ("ground", ["#d9dde3", "#30363e"]),
    ("edge", ["#6b7480", "#9aa3ae"]),
    ("body", ["#cfe0f5", "#2a4366"]),
    ("c0", ["#0b5cad", "#7ab8ff"]),
    ("c1", ["#b3420c", "#ffa06b"]),
    ("c2", ["#1b7338", "#7fd99a"]),
    ("c3", ["#7a3fa0", "#d1a3f0"]),
    ("c4", ["#806000", "#e6c65c"]),
    ("c5", ["#0f6f78", "#6fd3dc"]),
    ("c6", ["#a8186a", "#ff9ad0"]),
    ("c7", ["#566300", "#c3d04a"]),
    ("c8", ["#10316b", "#b9d4ff"]),
    ("c9", ["#5e2b0c", "#ffd0b0"]),
    ("c10", ["#0c3d1e", "#c4f3d2"]),
    ("c11", ["#4a4458", "#d6d0e4"]),
    ("focus", ["#0b5cad", "#7ab8ff"]),
    ("bad", ["#a40e26", "#ff8d9b"]),
    ("halo", ["#ffffffcc", "#14171bcc"]),
];

/// How many colours forces, curves and modes take in turn: c0, c1, … The second six are darker on light pages, and lighter on dark ones.
pub(crate) const TURN: usize = 12;

/// The look of pictures, in terms of the names.
const PICTURE: &str = include_str!("picture.css");

/// For a page that is light or dark as its reader likes it: the look of pictures, and the colours as variables.
pub(crate) fn for_pages() -> String {
    let variables = |shade: usize| -> String {
        let list = COLOURS.iter();
        list.map(|(name, values)| format!("--{name}:{};", values[shade]))
            .collect()
    };
    format!(
        ":root {{ {} }}\n@media screen and (prefers-color-scheme: dark) {{ :root {{ {} }} }}\n{PICTURE}",
        variables(0),
        variables(1)
    )
}

/// For a picture that stands alone: light, and without variables, which some programs do not know.
pub(crate) fn for_pictures() -> String {
    let list = COLOURS.iter();
    list.fold(PICTURE.to_owned(), |css, (name, [light, _])| {
        css.replace(&format!("var(--{name})"), light)
    })
}

/// A colour by name, in light, so many times as bright.
pub(crate) fn shaded(name: &str, bright: f64) -> String {
    let found = COLOURS.iter().find(|(other, _)| *other == name);
    let colour = found.map_or("#000000", |(_, [light, _])| light);
    let part = |i: usize| {
        let value = u8::from_str_radix(&colour[i..i + 2], 16).unwrap_or(0);
        (f64::from(value) * bright).round().clamp(0.0, 255.0) as u8
    };
    format!("#{:02x}{:02x}{:02x}", part(1), part(3), part(5))
}

/// The colour number `index`, in light.
pub(crate) fn colour(index: usize) -> &'static str {
    let name = format!("c{}", index % TURN);
    let found = COLOURS.iter().find(|(other, _)| *other == name);
    found.map_or("#000000", |(_, [light, _])| light)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of `#rrggbb` (WCAG 2.2).
    fn luminance(colour: &str) -> f64 {
        let part = |i: usize| {
            let byte = u8::from_str_radix(&colour[i..i + 2], 16).expect("two digits");
            let c = f64::from(byte) / 255.0;
            match c <= 0.04045 {
                true => c / 12.92,
                false => ((c + 0.055) / 1.055).powf(2.4),
            }
        };
        0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
    }

    #[test]
    fn text_and_curves_stand_out() {
        let find = |name: &str| COLOURS.iter().find(|(n, _)| *n == name).expect("a name").1;
        for shade in [0, 1] {
            let turn: Vec<String> = (0..TURN).map(|i| format!("c{i}")).collect();
            let turn = turn.iter().map(String::as_str);
            for text in ["ink", "quiet", "bad"].into_iter().chain(turn) {
                for ground in ["page", "card", "ground", "body"] {
                    let [a, b] = [text, ground].map(|name| luminance(find(name)[shade]) + 0.05);
                    let least = if ["page", "card"].contains(&ground) {
                        4.5
                    } else {
                        3.0
                    };
                    assert!(
                        a.max(b) / a.min(b) >= least,
                        "{text} on {ground}: {}",
                        a.max(b) / a.min(b)
                    );
                }
            }
        }
        let turn: std::collections::BTreeSet<&str> = (0..TURN).map(colour).collect();
        assert_eq!(turn.len(), TURN);
        assert!(!for_pictures().contains("var("));
        assert_eq!(shaded("page", 0.5), "#808080");
    }
}
