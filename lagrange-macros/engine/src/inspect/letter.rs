//! Names of declarations → letters: `theta1` is θ₁, `mu_s` is μₛ, `upper_mass` stays.

/// A symbol on paper.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Letter {
    /// `θ`, `m`, `upper_mass`.
    pub base: String,
    /// `1`, `s`, `rim`; or empty.
    pub subscript: String,
    /// As declared by `tex = "…"`, or empty.
    pub tex: String,
    /// Which derivative by time it stands for.
    pub rate: u8,
    /// Which one it stands for without dots: 1 for the rate ω of a body.
    pub undotted: u8,
    /// What is said beside it.
    pub mark: Mark,
}

/// Which of the values around an impact.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Mark {
    /// No impact.
    #[default]
    None,
    /// Before: ẋ⁻
    Before,
    /// After: ẋ⁺
    After,
    /// After minus before: Δẋ
    Jump,
}

/// Name, letter and TeX of the Greek letters that are not Latin ones.
const GREEK: [(&str, &str, &str); 34] = [
    ("alpha", "α", "\\alpha"),
    ("beta", "β", "\\beta"),
    ("gamma", "γ", "\\gamma"),
    ("delta", "δ", "\\delta"),
    ("epsilon", "ε", "\\varepsilon"),
    ("zeta", "ζ", "\\zeta"),
    ("eta", "η", "\\eta"),
    ("theta", "θ", "\\theta"),
    ("iota", "ι", "\\iota"),
    ("kappa", "κ", "\\kappa"),
    ("lambda", "λ", "\\lambda"),
    ("mu", "μ", "\\mu"),
    ("nu", "ν", "\\nu"),
    ("xi", "ξ", "\\xi"),
    ("pi", "π", "\\pi"),
    ("rho", "ρ", "\\rho"),
    ("sigma", "σ", "\\sigma"),
    ("tau", "τ", "\\tau"),
    ("upsilon", "υ", "\\upsilon"),
    ("phi", "φ", "\\varphi"),
    ("chi", "χ", "\\chi"),
    ("psi", "ψ", "\\psi"),
    ("omega", "ω", "\\omega"),
    ("Gamma", "Γ", "\\Gamma"),
    ("Delta", "Δ", "\\Delta"),
    ("Theta", "Θ", "\\Theta"),
    ("Lambda", "Λ", "\\Lambda"),
    ("Xi", "Ξ", "\\Xi"),
    ("Pi", "Π", "\\Pi"),
    ("Sigma", "Σ", "\\Sigma"),
    ("Upsilon", "Υ", "\\Upsilon"),
    ("Phi", "Φ", "\\Phi"),
    ("Psi", "Ψ", "\\Psi"),
    ("Omega", "Ω", "\\Omega"),
];

/// TeX of letters that no name stands for: other forms of Greek ones, those that look like Latin ones, and some of physics.
const OTHERS: [(&str, &str); 27] = [
    ("ℓ", "\\ell"),
    ("ħ", "\\hbar"),
    ("ℏ", "\\hbar"),
    ("ı", "\\imath"),
    ("ȷ", "\\jmath"),
    ("µ", "\\mu"),
    ("ϵ", "\\epsilon"),
    ("ϑ", "\\vartheta"),
    ("ϰ", "\\kappa"),
    ("ϖ", "\\varpi"),
    ("ϱ", "\\varrho"),
    ("ς", "\\varsigma"),
    ("ϕ", "\\phi"),
    ("ο", "o"),
    ("Α", "\\mathrm{A}"),
    ("Β", "\\mathrm{B}"),
    ("Ε", "\\mathrm{E}"),
    ("Ζ", "\\mathrm{Z}"),
    ("Η", "\\mathrm{H}"),
    ("Ι", "\\mathrm{I}"),
    ("Κ", "\\mathrm{K}"),
    ("Μ", "\\mathrm{M}"),
    ("Ν", "\\mathrm{N}"),
    ("Ο", "\\mathrm{O}"),
    ("Ρ", "\\mathrm{P}"),
    ("Τ", "\\mathrm{T}"),
    ("Χ", "\\mathrm{X}"),
];

impl Letter {
    /// The letter of a name; a name that is no letter with a subscript stays whole. `length[2]` is `length` with
    /// subscript 2.
    pub fn new(name: &str) -> Letter {
        let (name, element) = match name.split_once('[') {
            Some((name, element)) => (name, element.trim_end_matches(']')),
            None => (name, ""),
        };
        let at = name
            .find(|c: char| c == '_' || c.is_ascii_digit())
            .unwrap_or(name.len());
        let (head, tail) = name.split_at(at);
        let (base, subscript) = match greek(head) {
            Some(letter) => (letter.to_owned(), tail.trim_start_matches('_')),
            None if head.chars().count() == 1 => (head.to_owned(), tail.trim_start_matches('_')),
            None => (name.to_owned(), ""),
        };
        let mut letter = Letter {
            base,
            subscript: subscript.to_owned(),
            tex: String::new(),
            rate: 0,
            undotted: 0,
            mark: Mark::None,
        };
        if !element.is_empty() {
            letter = letter.element(element);
        }
        letter
    }

    /// A letter with a subscript: `N` of `rim`.
    pub fn of(base: &str, subscript: &str) -> Letter {
        let subscript = match subscript.split_once('[') {
            Some((name, element)) => format!("{name},{}", element.trim_end_matches(']')),
            None => subscript.to_owned(),
        };
        Letter {
            base: base.to_owned(),
            subscript,
            tex: String::new(),
            rate: 0,
            undotted: 0,
            mark: Mark::None,
        }
    }

    /// Its element with this index.
    pub fn element(mut self, index: &str) -> Letter {
        self.subscript = match self.subscript.as_str() {
            "" => index.to_owned(),
            own => format!("{own},{index}"),
        };
        if !self.tex.is_empty() {
            self.tex = format!("{{{}}}_{{{index}}}", self.tex);
        }
        self
    }

    /// The derivative of this order.
    pub fn rate(mut self, rate: u8) -> Letter {
        self.rate = rate;
        self
    }

    /// Whether a reader would take one for the other.
    pub fn looks_like(&self, other: &Letter) -> bool {
        (&self.base, &self.subscript) == (&other.base, &other.subscript)
    }

    /// Number of dots.
    pub fn dots(&self) -> u8 {
        self.rate.saturating_sub(self.undotted)
    }

    /// The rate about axis `k` of a body, which is named where there are others.
    pub fn body_rate(body: &str, k: usize) -> Letter {
        let letter = Letter {
            rate: 1,
            undotted: 1,
            ..Letter::of("ω", body)
        };
        letter.element(&k.to_string())
    }

    /// Component `j` in space of axis `i` of a body: e₀₁.
    pub fn axis(body: &str, i: &str, j: &str) -> Letter {
        let digits = [i, j].iter().all(|index| index.len() == 1);
        let comma = if digits { "" } else { "," };
        Letter::of("e", body).element(&format!("{i}{comma}{j}"))
    }

    /// Whether it is one character, which products write side by side.
    pub fn is_single(&self) -> bool {
        self.base.chars().count() == 1
    }

    /// The command of TeX for the base, if it is a letter that has one.
    pub fn command(&self) -> Option<&'static str> {
        let greek = GREEK.iter().map(|(_, letter, tex)| (*letter, *tex));
        let mut known = greek.chain(OTHERS);
        known
            .find(|(letter, _)| *letter == self.base)
            .map(|(_, tex)| tex)
    }
}

fn greek(name: &str) -> Option<&'static str> {
    GREEK
        .iter()
        .find(|(known, _, _)| *known == name)
        .map(|(_, letter, _)| *letter)
}

/// Small digits and letters below the line, where Unicode has them.
pub fn lowered(text: &str) -> Option<String> {
    text.chars()
        .map(|c| {
            Some(match c {
                '0'..='9' => char::from_u32('₀' as u32 + c as u32 - '0' as u32)?,
                '+' => '₊',
                '-' => '₋',
                'a' => 'ₐ',
                'e' => 'ₑ',
                'h' => 'ₕ',
                'i' => 'ᵢ',
                'j' => 'ⱼ',
                'k' => 'ₖ',
                'l' => 'ₗ',
                'm' => 'ₘ',
                'n' => 'ₙ',
                'o' => 'ₒ',
                'p' => 'ₚ',
                'r' => 'ᵣ',
                's' => 'ₛ',
                't' => 'ₜ',
                'u' => 'ᵤ',
                'v' => 'ᵥ',
                'x' => 'ₓ',
                _ => return None,
            })
        })
        .collect()
}

/// The letter whose small form below the line this is.
pub fn from_below(c: char) -> Option<char> {
    ('a'..='z')
        .find(|letter| lowered(&letter.to_string()).is_some_and(|small| small == c.to_string()))
}

/// Small digits above the line.
pub fn raised(text: &str) -> Option<String> {
    text.chars()
        .map(|c| {
            Some(match c {
                '0' => '⁰',
                '1' => '¹',
                '2' => '²',
                '3' => '³',
                '4'..='9' => char::from_u32('⁴' as u32 + c as u32 - '4' as u32)?,
                '-' | '−' => '⁻',
                _ => return None,
            })
        })
        .collect()
}
