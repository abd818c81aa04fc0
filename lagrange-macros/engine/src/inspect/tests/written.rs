//! Letters and expressions as a person writes them.

use super::derivation;
use crate::inspect::formula::Formula;
use crate::inspect::letter::Letter;
use crate::inspect::print;
use proc_macro2::TokenStream;
use quote::quote;

#[test]
fn names_become_letters() {
    let text = |name: &str| print::text::formula(&Formula::Letter(Letter::new(name)));
    let names = [
        "theta",
        "theta1",
        "mu_s",
        "mu_static",
        "theta[3]",
        "theta[12]",
        "m_1[3]",
    ];
    assert_eq!(
        names.map(text),
        ["θ", "θ₁", "μₛ", "μ_static", "θ₃", "θ₁₂", "m_1,3"]
    );
    assert_eq!(
        ["mass", "upper_mass", "x", "px"].map(text),
        ["mass", "upper_mass", "x", "px"]
    );
    let rate = |name: &str, rate| Formula::Letter(Letter::new(name).rate(rate));
    assert_eq!(print::text::formula(&rate("theta2", 1)), "θ\u{307}₂");
    assert_eq!(print::text::formula(&rate("slider", 2)), "der(der(slider))");
    assert_eq!(
        print::latex::formula(&rate("theta2", 2)),
        "\\ddot{\\theta}_{2}"
    );
    assert_eq!(
        print::mathml::formula(&rate("theta2", 1)),
        "<math><msub><mover><mi>θ</mi><mo>˙</mo></mover><mn>2</mn></msub></math>"
    );
}

/// Letters that pdflatex does not have in its mathematics become commands of amsmath, or text.
#[test]
fn every_letter_of_latex_is_one_that_it_knows() {
    let latex = |name: &str| print::latex::formula(&Formula::Letter(Letter::new(name)));
    assert_eq!(
        ["ℓ", "ħ1", "θ_ℓ", "µ", "ϕ", "é", "vₓ", "Χ", "ı"].map(latex),
        [
            "\\ell",
            "\\hbar_{1}",
            "\\theta_{\\ell}",
            "\\mu",
            "\\phi",
            "\\text{é}",
            "\\mathrm{v{}_{x}}",
            "\\mathrm{X}",
            "\\imath",
        ]
    );
    // As text: rustc warns of letters that look alike.
    let declared =
        "#[lagrange(coordinates(x), kinetic = ħ*ℓ^2 * der(x)^2, potential = größe_ϕ * cos(x))]
        struct Letters { ħ: f64, ℓ: f64, größe_ϕ: f64 }";
    let d = derivation(declared.parse().expect("tokens"));
    let paper = print::paper(&d);
    let unknown = |c: &char| !c.is_ascii() && !"öß–".contains(*c);
    assert_eq!(paper.chars().find(unknown), None, "{paper}");
    for said in ["\\hbar \\, \\ell^{2}", "$\\ell$", "\\text{ö}"] {
        assert!(paper.contains(said), "{said}: {paper}");
    }
}

/// Names that would be one letter are two, of coordinates, fields, definitions, forces and energies.
#[test]
fn a_letter_stands_for_one_thing() {
    let d = derivation(quote! {
        #[lagrange(
            coordinates(x_1, x1),
            define(m_1 = m1 + lambda_tie),
            kinetic = m_1/2 * (der(x_1)^2 + der(x1)^2),
            potential = V * x_1 * x1,
            constraint(tie: x_1 == 2 * x1),
        )]
        struct Pair { m1: f64, lambda_tie: f64, V: f64 }
    });
    assert_eq!(
        print::text::statement(&d.kinetic),
        "T = ½ (m₁ + lambda_tie) (x\u{307}₁² + der(x1)²)"
    );
    assert_eq!(print::text::statement(&d.potential), "E_pot = V x₁ x1");
    assert_eq!(
        print::text::statement(&d.conserved[0].quantity),
        "E = T + E_pot"
    );
    assert_eq!(
        print::text::statement(&d.motion[1].statement),
        "(m₁ + lambda_tie) der(der(x1)) = −V x₁ − 2 λ_tie"
    );
}

/// Of a charge in a magnetic field, which does no work, neither T nor V tells.
#[test]
fn a_lagrangian_may_have_terms_linear_in_velocities() {
    let d = derivation(quote! {
        #[lagrange(
            coordinates(x, y),
            lagrangian = m/2 * (der(x)^2 + der(y)^2) + q*B/2 * (x*der(y) - y*der(x)) - k/2 * x^2,
        )]
        struct Charge { m: f64, q: f64, B: f64, k: f64 }
    });
    let told: Vec<String> = d.energies().map(print::text::statement).collect();
    assert_eq!(
        told,
        [
            "T = ½ m (x\u{307}² + y\u{307}²)",
            "V = ½ k x²",
            "L = T − V + ½ q B (x y\u{307} − y x\u{307})"
        ]
    );
    let alone = derivation(quote! {
        #[lagrange(coordinates(x), lagrangian = m/2 * der(x)^2 - k/2 * x^2)]
        struct Spring { m: f64, k: f64 }
    });
    assert!(alone.lagrangian.is_none());
}

/// A particle whose potential is whatever is to be written.
fn potential(expression: TokenStream) -> String {
    let d = derivation(quote! {
        #[lagrange(coordinates(x, y), kinetic = m/2 * (der(x)^2 + der(y)^2), potential = #expression)]
        struct Particle { m: f64, a: f64, b: f64, g: f64 }
    });
    print::text::formula(&d.potential.right)
}

/// A row of a table is as high as its highest cell: the brace as all the cases beside it.
#[test]
fn a_brace_stands_in_one_row_with_its_cases() {
    let d = derivation(quote! {
        #[lagrange(coordinates(x), kinetic = m/2 * der(x)^2, potential = if(x >= 0, a, if(x >= -b, b, x)))]
        struct Particle { m: f64, a: f64, b: f64 }
    });
    let page = print::mathml::formula(&d.potential.right);
    let (brace, cases) = page.split_once(">{</mo></mtd>").expect("a brace");
    assert_eq!(
        [brace, cases].map(|part| part.matches("<mtr>").count()),
        [1, 3]
    );
    assert_eq!(
        cases.matches("<mtext>if\u{a0}</mtext>").count(),
        2,
        "{cases}"
    );
    assert!(
        cases.ends_with("</mtr></mtable></mtd></mtr></mtable></math>"),
        "{cases}"
    );
}

#[test]
fn expressions_as_a_person_writes_them() {
    let check =
        |expression: TokenStream, expected: &str| assert_eq!(potential(expression), expected);
    check(quote!(g * m * y), "m g y");
    check(quote!(-x + y), "y − x");
    check(quote!(m * g * x + m * g * y), "m g (x + y)");
    check(quote!(a / 2 * x ^ 2 - b * x), "x (½ a x − b)");
    check(quote!(2 * a * x / (7 * b)), "2 a x/(7 b)");
    check(quote!(sin(x) * a / (a + b)), "a sin(x)/(a + b)");
    check(quote!(a * sqrt(x ^ 2 + y ^ 2)), "a √(x² + y²)");
    check(quote!(a / sqrt(x ^ 2 + y ^ 2)), "a/√(x² + y²)");
    check(quote!(cos(x) ^ 2 * a), "a cos² x");
    check(quote!(sin(2 * x) * sin(y)), "sin(2 x) sin y");
    check(quote!(abs(x - y)), "|x − y|");
    check(quote!(max(x, y)), "max(x, y)");
    check(quote!(if(x >= 0, a*x, b*y)), "{a x if x ≥ 0, else b y}");
    check(
        quote!(if(x >= 1, a, if(y >= 2, b, if(x >= 0, g, x)))),
        "{a if x − 1 ≥ 0, b if y − 2 ≥ 0, g if x ≥ 0, else x}",
    );
    check(quote!(0.98 * a * x), "0.98 a x");
    check(quote!(9.81 * x ^ 1.35), "9.81 x^(1.35)");
    check(quote!(0.7 * a * x), "(7/10) a x");
    check(quote!(a * x / 29), "(1/29) a x");
    check(quote!(exp(-a * x)), "exp(−a x)");
    check(quote!(pi * x), "π x");
    check(quote!(x ^ a), "x^a");
    check(quote!((a + b) * x + (a + b) * y), "(a + b) (x + y)");
}

#[test]
fn long_formulas_are_shortened() {
    let letters = (0..300).map(|i| Formula::Letter(Letter::new(&format!("x{i}"))));
    let long = Formula::sum(letters);
    let short = long.shortened(20);
    assert!(short.size() < 30);
    assert!(print::text::formula(&short).ends_with("… (290 more terms)"));
}

#[test]
fn what_is_declared_keeps_its_decimals() {
    let d = derivation(quote! {
        #[lagrange(coordinates(x), kinetic = m/2 * der(x)^2, potential = 0.5 * k * x^2 + 1/3 * k * x^2, start(a: x = 0.3))]
        struct Spring { m: f64, k: f64 }
    });
    let text = print::plain(&d);
    for line in ["0.5 k x² + ⅓ k x²", "x = 0.3"] {
        assert!(text.contains(line), "{line}\n{text}");
    }
}

/// A bead on a hoop that is turned: T + V is not conserved, and what is has a name.
#[test]
fn the_jacobi_integral_is_called_so() {
    let says = |kinetic: TokenStream| {
        let d = derivation(quote! {
            #[lagrange(coordinates(theta), kinetic = #kinetic, potential = -g * cos(theta), start(a: theta = 1))]
            struct Hoop { g: f64, rate: f64 }
        });
        print::plain(&d)
    };
    let turned = says(quote!((der(theta) ^ 2 + (rate * sin(theta)) ^ 2) / 2));
    assert!(turned.contains("\n  Jacobi integral  h = "), "{turned}");
    assert!(turned.contains("h is the sum of v ∂L/∂v"), "{turned}");
    let still = says(quote!(rate * der(theta) ^ 2));
    assert!(!still.contains("Jacobi"), "{still}");
    // A piston on a crank: the root has no value where the rod is shorter than the crank.
    let crank = says(quote!(
        (rate * der(cos(theta) + sqrt(g ^ 2 - sin(theta) ^ 2))) ^ 2
    ));
    assert!(!crank.contains("Jacobi"), "{crank}");
    assert!(
        !crank.contains("g g") && !crank.contains("rate rate"),
        "{crank}"
    );
}
