//! Tokens in, tree or mistakes out.

use super::declaration;
use crate::ast::{Declaration, Expr, ItemKind};
use crate::diagnostics::Diagnostics;
use crate::diagnostics::tests::mistakes_are_at;

fn read(text: &str) -> Result<Declaration, String> {
    let mut sink = Diagnostics::new();
    match declaration(text.parse().unwrap(), &mut sink) {
        Some(declaration) => {
            assert!(sink.is_empty(), "{sink}");
            Ok(declaration)
        }
        None => {
            assert!(!sink.is_empty(), "no declaration and no mistake: {text}");
            Err(sink.to_string().trim_end().to_string())
        }
    }
}

/// Reads `define(e = …)`.
fn expression(text: &str) -> Result<Expr, String> {
    let mut read = read(&format!("#[lagrange(define(e =\n{text}))] struct S {{}}"))?;
    match read.items.remove(0).kind {
        ItemKind::Define(mut definitions) => Ok(definitions.remove(0).value),
        other => panic!("{other:?}"),
    }
}

#[track_caller]
fn prints(text: &str, printed: &str) {
    let expr = expression(text).unwrap();
    assert_eq!(expr.to_string(), printed);
    assert_eq!(
        expression(printed).unwrap().to_string(),
        printed,
        "print and parse again"
    );
}

#[test]
fn power_binds_tightest_and_to_the_right() {
    prints("-x^2", "-x^2");
    prints("(-x)^2", "(-x)^2");
    prints("a^b^c", "a^b^c");
    prints("(a^b)^c", "(a^b)^c");
    prints("x^-2*y", "x^-2*y");
    prints("2*-x", "2*-x");
    prints("a/b/c*d", "a/b/c*d");
    prints("a/(b*c)", "a/(b*c)");
    prints("a - (b - c) + d", "a - (b - c) + d");
    prints("a*(b + c)", "a*(b + c)");
    prints("--x", "x");
    prints("-(a + b)", "-(a + b)");
    prints("(a*b)^2", "(a*b)^2");
}

#[test]
fn numbers_are_exact() {
    prints(
        "1e-3 + 2. + 0.10 + 1_000 + 12e2",
        "0.001 + 2 + 0.1 + 1000 + 1200",
    );
    assert_eq!(
        expression("1f64").unwrap_err(),
        "2:1 E007 `1f64` is not a number; numbers are exact and have no type: write `1`"
    );
    assert_eq!(
        expression("2x").unwrap_err(),
        "2:1 E007 `2x` is not a number; a product is written with `*`: `2*x`"
    );
    assert!(expression("0x1f").unwrap_err().contains("E008"));
    assert!(expression("1e999").unwrap_err().contains("E009"));
    assert!(expression("1e-400").unwrap_err().contains("E009"));
}

#[test]
fn whole_language_reads() {
    prints(
        "sum(i in 0..n+1: l[i]*sin(theta[i]))",
        "sum(i in 0..n + 1: l[i]*sin(theta[i]))",
    );
    prints("[a, b, (c, d)]", "[a, b, [c, d]]");
    prints(
        "dot(p, q) + norm(cross(p, q))",
        "dot(p, q) + norm(cross(p, q))",
    );
    prints("if(a <= b, x, der(der(y)))", "if(a <= b, x, der(der(y)))");
    prints("body.axes[0][i + 1]", "body.axes[0][i + 1]");
    prints("static*r#while + type", "static*while + type");
}

/// What `macro_rules!` hands over: `$e` of `2 * $e` is an invisible group.
#[test]
fn invisible_groups_are_entered() {
    use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
    let hidden = |text: &str| TokenTree::from(Group::new(Delimiter::None, text.parse().unwrap()));
    let wrap = |before: &str, inside: TokenTree, after: &str| -> TokenStream {
        let mut tokens: TokenStream = before.parse().unwrap();
        tokens.extend([inside]);
        tokens.extend(after.parse::<TokenStream>().unwrap());
        tokens
    };
    let declare = |items: TokenStream| {
        let mut tokens: TokenStream = "#".parse().unwrap();
        let list = wrap(
            "lagrange",
            Group::new(Delimiter::Parenthesis, items).into(),
            "",
        );
        tokens.extend([TokenTree::from(Group::new(Delimiter::Bracket, list))]);
        tokens.extend("struct S {}".parse::<TokenStream>().unwrap());
        let mut sink = Diagnostics::new();
        declaration(tokens, &mut sink).unwrap_or_else(|| panic!("{sink}"))
    };
    let typed = |ty: TokenTree| {
        let field = wrap("a:", ty, "");
        let body = Group::new(Delimiter::Brace, field).into();
        let mut sink = Diagnostics::new();
        let tokens = wrap("#[lagrange(coordinates(x))] struct S<T>", body, "");
        declaration(tokens, &mut sink).unwrap_or_else(|| panic!("{sink}"))
    };
    assert_eq!(typed(hidden("T")).fields[0].length, None);
    let array: TokenStream = wrap("T;", hidden("3"), "");
    assert_eq!(
        typed(Group::new(Delimiter::Bracket, array).into()).fields[0].length,
        Some(3)
    );
    let energy = |declaration: &Declaration| match &declaration.items[0].kind {
        ItemKind::Kinetic(energy) => energy.value.to_string(),
        other => panic!("{other:?}"),
    };
    assert_eq!(
        energy(&declare(wrap("kinetic = 2 *", hidden("a + b"), "^ 2"))),
        "2*(a + b)^2"
    );
    assert_eq!(
        energy(&declare(wrap("kinetic = ", hidden("der(x)"), "^ 2"))),
        "der(x)^2"
    );
    assert_eq!(
        energy(&declare(wrap("", hidden("kinetic = a + b"), ""))),
        "a + b"
    );
    let relation = Group::new(
        Delimiter::Parenthesis,
        wrap("rod:", hidden("a == b + 1"), ""),
    );
    let read = declare(wrap("constraint", relation.into(), ""));
    let ItemKind::Constraint(constraint) = &read.items[0].kind else {
        panic!()
    };
    assert_eq!(constraint.right.to_string(), "b + 1");
}

#[test]
fn mass_on_wheel_reads() {
    let read = read(crate::model::tests::MASS_ON_WHEEL).unwrap();
    assert_eq!(read.name, "MassOnWheel");
    assert_eq!(read.scalar.as_ref().unwrap(), "T");
    assert!(read.documentation.starts_with("A small mass"));
    assert_eq!(read.fields.len(), 7);
    assert_eq!(read.fields[0].unit.as_ref().unwrap().text, "kg");
    assert_eq!(read.items.len(), 10);
}

#[test]
fn all_forms_of_items_read() {
    let read = read(
        r#"#[lagrange(coordinates(x[8], r: "m"), lagrangian = r, crate = crate::core,
            constraint(a: x[0] == r), constraint(b while c[2]: der(r) == 0),
            contact(c[k in 0..7]: x[k+1] - x[k] >= 1 at (r, 0), restitution = poisson(1/2), where r >= 0),
            contact(d: r <= 1, restitution = 0.5))]
        #[lagrange(
            friction(f on a: slip = (der(r), der(x[0])), static = 1, kinetic = 1/2),
            friction(g: slip = der(r), normal = 3, static = 1),
            friction(h: slip = der(r), limit = (2, 1)),
            force(i: r = 1), force(j: (1, 0) at (r, x[0])), force(k: 3*a along der(r)), force(l: x[3] = t),
            dissipation(m: der(r)^2), start(n), start(o: r = 1, der(r) = 2, x[k in 0..8] = k, der(x[0]) = 1,),
            observe(p = r, q[k in 0..2] = x[k], r), stop(u: r >= 1 and r <= 2 and closed(c[0])),
            mark(v: r), mark(w: slips(f)), attitude(body: z), impacts = together,
        )]
        struct S { mass: f64, length: [f64; 3] }"#,
    )
    .unwrap();
    assert_eq!(read.items.len(), 22);
    assert_eq!(read.core.unwrap().to_string(), "crate :: core");
    assert_eq!(read.fields[1].length, Some(3));
}

/// (declaration, mistakes as `line:col code`). Items stand on line 2 and below.
#[test]
fn mistakes_point_at_their_token() {
    let wrong = [
        ("kinetic = x ** 2", "2:13 E004"),
        ("kinetic = theta.cos()", "2:17 E005"),
        ("kinetic = x.powi(2)", "2:13 E005"),
        ("constraint(a: x = y)", "2:17 E006"),
        ("constraint(a: x >= y)", "2:17 E015"),
        ("constraint(a: x)", "2:15 E001"),
        ("constraint(a: x == y == z)", "2:22 E014"),
        ("contact(a: x == y)", "2:14 E015"),
        ("contact(a: x > y)", "2:14 E013"),
        ("contact(a: x)", "2:12 E011"),
        ("contact(a: x >= y restitution = 0)", "2:19 E003"),
        ("contact(a: x >= y, elasticity = 0)", "2:20 E016"),
        (
            "contact(a: x >= y, restitution = 0, restitution = 1)",
            "2:37 E017",
        ),
        ("coordinates(x) kinetic = x", "2:16 E003"),
        ("kinetic = x potential = y", "2:13 E003"),
        ("kinetic = x y", "2:13 E026"),
        ("coordinates()", "2:1 E002"),
        ("coordinates(x,,y)", "2:15 E002"),
        ("kinetic = ", "2:11 E001"),
        ("kinetic = sin()", "2:11 E002"),
        ("contat(a: x >= y)", "2:1 E010"),
        ("kinetic = x >= y", "2:13 E012"),
        ("kinetic = |x|", "2:11 E024"),
        ("stop(a: x >= 1 && y >= 1)", "2:16 E024"),
        ("kinetic = self.mass", "2:11 E021"),
        ("kinetic = std::f64::consts::PI", "2:11 E021"),
        ("kinetic = sum(i in 0..=3: x[i])", "2:21 E020"),
        ("kinetic = if(x, y, z)", "2:14 E011"),
        ("kinetic = if(x >= 1, y)", "2:11 E301"),
        ("check(a: x)", "2:10 E001"),
        ("check(x == y closed(c))", "2:14 E026"),
        ("friction(f on c: slip = x)", "2:10 E018"),
        ("friction(f on c: static = x)", "2:10 E018"),
        ("friction(f on (): slip = x, static = 1)", "2:16 E001"),
        ("friction(f on (a, b c): slip = x, static = 1)", "2:21 E026"),
        ("friction(f: slip = x, static = 1)", "2:10 E018"),
        ("friction(f: slip = x, static = 1, limit = 2)", "2:1 E023"),
        ("friction(f on c: slp = x, static = 1)", "2:18 E016"),
        ("force(f: 1)", "2:10 E001"),
        ("force(f: x + y = 1)", "2:10 E001"),
        ("start(a: x == 1)", "2:12 E001"),
        ("start(a: )", "2:10 E001"),
        ("impacts = sometimes", "2:11 E001"),
        ("coordinates = x", "2:13 E001"),
        ("kinetic = \"text\"", "2:11 E021"),
        ("kinetic = 1 % 2", "2:13 E024"),
        ("kinetic = sum(i in 0..3, j in 0..3: x[i])", "2:24 E024"),
        ("contact(hit[i in 0..3, j in 0..3]: x >= 0)", "2:22 E024"),
        ("kinetic = x[0, 1]", "2:14 E024"),
        ("kinetic = if(x >= 1 and y >= 1, x, y)", "2:21 E024"),
        ("contact(a: x >= y, at (x, y))", "2:20 E016"),
    ];
    mistakes_are_at(&wrong, |items| {
        read(&format!("#[lagrange(\n{items})] struct S {{}}")).map(|_| ())
    });
}

#[test]
fn all_mistakes_are_found_at_once() {
    let found = read(
        "#[lagrange(\nkinetic = x**2,\ncontat(a: b),\nfriction(f on c: slip = 2x, statik = y))] struct S {}",
    );
    let codes: Vec<String> = found
        .unwrap_err()
        .lines()
        .map(|line| line[..8].to_string())
        .collect();
    assert_eq!(codes, ["2:12 E00", "3:1 E010", "4:25 E00", "4:29 E01"]);
}

#[test]
fn structs_that_are_none() {
    let check = |text: &str, expected: &str| {
        let found = read(text).map(|_| ()).unwrap_err();
        assert!(found.starts_with(expected), "{text}\n{found}");
    };
    check("#[lagrange(coordinates(x))] enum E { A }", "1:34 E101");
    check("#[lagrange(coordinates(x))] struct S(f64);", "1:36 E101");
    check(
        "#[lagrange(coordinates(x))] struct S { a: f32 }",
        "1:43 E103",
    );
    check(
        "#[lagrange(coordinates(x))] struct S<T> { a: f64 }",
        "1:46 E103",
    );
    check(
        "#[lagrange(coordinates(x))] struct S<T, U> { a: T }",
        "1:41 E102",
    );
    check(
        "#[lagrange(coordinates(x))] struct S<'a, T> { a: T }",
        "1:38 E102",
    );
    check(
        "#[lagrange(coordinates(x))] struct S<T> { a: [T; N] }",
        "1:50 E103",
    );
    check("struct S { a: f64 }", "1:8 E105");
    check("#[lagrange] struct S { a: f64 }", "1:3 E104");
    check(
        "#[lagrange(coordinates(x))] struct S { #[lagrange(unt = \"kg\")] a: f64 }",
        "1:51 E016",
    );
}

#[test]
fn deep_nesting_is_a_mistake() {
    let deep = format!("{}x{}", "(".repeat(3000), ")".repeat(3000));
    assert!(expression(&deep).unwrap_err().contains("E022"));
    let long = vec!["x"; 3000].join("^");
    assert!(expression(&long).unwrap_err().contains("E022"));
    assert!(expression(&vec!["x"; 3000].join(" + ")).is_ok());
}
