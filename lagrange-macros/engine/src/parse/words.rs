//! The words and signs of the language.

/// Functions of the language that take values.
pub const FUNCTIONS: &[&str] = &[
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "ln",
    "sqrt", "abs", "sign", "min", "max", "dot", "cross", "norm", "der",
];

/// What is said of angles in degrees.
pub const DEGREES: &str = "angles are in radians: 30° is `pi/6`";

/// Whether a word is one for degrees, or for what makes them radians.
pub fn is_degree(word: &str) -> bool {
    ["deg", "degree", "degrees", "radians", "deg2rad", "rad2deg"].contains(&word)
}

/// What is said of texts in single quotation marks.
pub(super) const SINGLE_QUOTES: &str =
    "`'` is no character of the language; units stand in double quotation marks: `\"kg\"`";

/// Signs between two sides.
pub(super) const RELATIONS: &[&str] = &["==", ">=", "<=", "=", ">", "<", "!="];

/// Words that begin an item.
pub const KEYWORDS: &[&str] = &[
    "coordinates",
    "define",
    "kinetic",
    "potential",
    "lagrangian",
    "constraint",
    "contact",
    "friction",
    "force",
    "dissipation",
    "start",
    "observe",
    "stop",
    "mark",
    "draw",
    "attitude",
    "impacts",
    "emit",
    "check",
    "crate",
];

/// Words that begin an item of a file alone.
pub(super) const FILE_KEYWORDS: [&str; 2] = ["parameters", "until"];

/// Words that Rust does not take as a name of a field even behind `r#`.
pub(super) const NO_FIELDS: [&str; 5] = ["_", "self", "Self", "super", "crate"];

/// Whether the word begins an item, of a struct or of a file.
pub(super) fn is_keyword(word: &str) -> bool {
    KEYWORDS.contains(&word) || FILE_KEYWORDS.contains(&word)
}
