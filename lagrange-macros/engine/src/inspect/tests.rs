//! Formulas say what expressions are worth, in every scene; names become the letters that a person would write.

use super::formula::{Formula, Relation, Statement};
use super::letter::Letter;
use super::names::Names;
use super::print;
use super::readable::Reader;
use super::work::Work;
use crate::ast::Declaration;
use crate::diagnostics::Diagnostics;
use crate::plan::Program;
use crate::symbolic::{ExprId, Pool, Rational, Symbol};
use expect_test::expect_file;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// All scenes, as the derive macro is given them.
fn scenes() -> Vec<(String, TokenStream)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../problems/src/scenes");
    let mut files: Vec<PathBuf> = Vec::new();
    for folder in [root.clone(), root.join("hard")] {
        let entries = std::fs::read_dir(folder).expect("the scenes");
        files.extend(entries.map(|entry| entry.expect("a file").path()));
    }
    files.retain(|file| file.extension().is_some_and(|e| e == "rs"));
    files.sort();
    let mut scenes = Vec::new();
    for file in files {
        let source = std::fs::read_to_string(&file).expect("a scene");
        let parsed = syn::parse_file(&source).expect("Rust");
        for item in parsed.items {
            if let syn::Item::Struct(mut item) = item
                && item.attrs.iter().any(|a| a.path().is_ident("lagrange"))
            {
                item.attrs.retain(|a| !a.path().is_ident("derive"));
                scenes.push((item.ident.to_string(), item.into_token_stream()));
            }
        }
    }
    assert!(scenes.len() >= 20);
    scenes
}

fn planned(tokens: TokenStream) -> (Declaration, Program) {
    let mut sink = Diagnostics::new();
    let declaration = crate::parse::declaration(tokens, &mut sink).expect("a declaration");
    let program = crate::planned(&declaration, &mut sink);
    (declaration, program.unwrap_or_else(|| panic!("{sink}")).0)
}

fn derivation(tokens: TokenStream) -> super::Derivation {
    crate::inspect(tokens, None).unwrap_or_else(|refusal| panic!("{refusal}"))
}

/// What a formula is worth, where nothing is left out.
fn worth(f: &Formula, at: &BTreeMap<String, f64>) -> Option<f64> {
    let of = |a: &Formula| worth(a, at);
    Some(match f {
        Formula::Number(n) => n.to_f64(),
        Formula::Pi => std::f64::consts::PI,
        Formula::Letter(_) => at[&print::text::formula(f)],
        Formula::Sum(terms) => {
            let mut sum = 0.0;
            for (minus, term) in terms {
                sum += if *minus { -of(term)? } else { of(term)? };
            }
            sum
        }
        Formula::Product(factors) => {
            let mut product = 1.0;
            for factor in factors {
                product *= of(factor)?;
            }
            product
        }
        Formula::Negative(a) => -of(a)?,
        Formula::Fraction(a, b) => of(a)? / of(b)?,
        Formula::Power(a, b) => of(a)?.powf(of(b)?),
        Formula::Root(a) => of(a)?.sqrt(),
        Formula::Absolute(a) => of(a)?.abs(),
        Formula::Call(name, arguments) => {
            let x = of(&arguments[0])?;
            let y = || of(&arguments[1]);
            match name.as_str() {
                "sin" => x.sin(),
                "cos" => x.cos(),
                "tan" => x.tan(),
                "tanh" => x.tanh(),
                "exp" => x.exp(),
                "sgn" => x.signum(),
                "max" => x.max(y()?),
                "min" => x.min(y()?),
                other => panic!("{other}"),
            }
        }
        Formula::Cases(condition, a, b) => match of(&condition.left)? >= 0.0 {
            true => of(a)?,
            false => of(b)?,
        },
        Formula::More(_) => return None,
        other => panic!("{other:?} is for declarations"),
    })
}

/// A point: a number for each symbol, the same for each letter.
fn point(program: &Program, names: &Names) -> (BTreeMap<Symbol, f64>, BTreeMap<String, f64>) {
    let mut by_symbol = BTreeMap::new();
    let mut by_letter = BTreeMap::new();
    let system = &program.equations.system;
    let mut symbols = vec![system.time];
    symbols.extend(system.parameters.iter().map(|p| p.symbol));
    for c in &system.coordinates {
        symbols.extend([c.position, c.velocity, c.acceleration]);
    }
    symbols.extend(system.constraints.iter().map(|c| c.force));
    symbols.extend(system.contacts.iter().map(|c| c.force));
    let slips = system.frictions.iter().flat_map(|f| &f.slip);
    symbols.extend(slips.map(|&(_, force)| force));
    symbols.extend(system.forces.iter().map(|f| f.force));
    for (i, symbol) in symbols.into_iter().enumerate() {
        let value = 0.3 + (0.618 * (i + 1) as f64).fract();
        by_symbol.insert(symbol, value);
        let letter = print::text::formula(&Formula::Letter(names.letter(symbol)));
        let before = by_letter.insert(letter.clone(), value);
        assert_eq!(before, None, "{letter} stands for two things");
    }
    (by_symbol, by_letter)
}

fn number(pool: &Pool, e: ExprId, at: &dyn Fn(Symbol) -> f64, then: &dyn Fn(usize) -> bool) -> f64 {
    pool.evaluate(&[e], at, then)[0]
}

#[track_caller]
fn close(a: f64, b: f64, what: &str) {
    assert!((a - b).abs() <= 1e-9 * (1.0 + a.abs()), "{what}: {a} {b}");
}

/// Whatever form was chosen for reading, its value is that of the expression that is emitted.
#[test]
fn formulas_are_worth_what_their_expressions_are() {
    let mut compared = 0;
    for (name, tokens) in scenes() {
        let (declaration, mut program) = planned(tokens);
        let mut pool = std::mem::take(&mut program.equations.system.pool);
        let names = Names::of(&declaration, &program.equations.system);
        let (by_symbol, by_letter) = point(&program, &names);
        let guards: Vec<_> = program
            .equations
            .system
            .branches
            .iter()
            .map(|b| b.guard)
            .collect();
        for output in &program.equations.outputs {
            for &(_, e) in &output.terms {
                let mut reader = Reader::new(&mut pool, &names, guards.clone());
                let formula = reader.formula(e);
                let Some(worth) = worth(&formula, &by_letter) else {
                    continue;
                };
                let (pool, at) = (&pool, |symbol| by_symbol[&symbol]);
                let side = |branch: usize| number(pool, guards[branch], &at, &|_| true) >= 0.0;
                let value = number(pool, e, &at, &side);
                close(
                    value,
                    worth,
                    &format!("{name}, {}: {formula:?}", output.label),
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

/// The equations of motion are M v̇ = f + Σ aᵀλ of the outputs.
#[test]
fn equations_of_motion_balance() {
    for (name, tokens) in scenes() {
        let (declaration, mut program) = planned(tokens);
        let mut pool = std::mem::take(&mut program.equations.system.pool);
        let names = Names::of(&declaration, &program.equations.system);
        let (by_symbol, by_letter) = point(&program, &names);
        let guards: Vec<_> = program
            .equations
            .system
            .branches
            .iter()
            .map(|b| b.guard)
            .collect();
        let mut work = Work {
            program: &program,
            names: &names,
            reader: Reader::new(&mut pool, &names, guards.clone()),
            solves: true,
        };
        let motion = work.motion();
        let multipliers = work.multipliers();
        let at = |symbol| by_symbol[&symbol];
        let mut value = |output| {
            let e = work.output(output);
            let pool: &Pool = work.pool();
            let side = |branch: usize| number(pool, guards[branch], &at, &|_| true) >= 0.0;
            number(pool, e, &at, &side)
        };
        let structure = &program.equations.structure;
        for (i, equation) in motion.iter().enumerate() {
            let mut balance = -value(structure.forcing[i]);
            for &(row, column, entry) in &structure.mass {
                let coordinates = &program.equations.system.coordinates;
                if row == i {
                    balance += value(entry) * at(coordinates[column].acceleration);
                } else if column == i {
                    balance += value(entry) * at(coordinates[row].acceleration);
                }
            }
            for (row, numbers) in structure.rows.iter().enumerate() {
                for &(j, entry) in &numbers.jacobian {
                    if j == i {
                        balance -= value(entry) * at(multipliers[row]);
                    }
                }
            }
            for coupling in structure.couplings.iter().filter(|c| c.coordinate == i) {
                balance -= value(coupling.factor) * at(multipliers[coupling.row]);
            }
            let Statement { left, right, .. } = &equation.statement;
            if let (Some(left), Some(right)) = (worth(left, &by_letter), worth(right, &by_letter)) {
                close(left - right, balance, &format!("{name}, equation {i}"));
            }
        }
    }
}

#[test]
fn what_is_read_does_not_reach_what_is_emitted() {
    for (name, tokens) in scenes() {
        let (declaration, mut program) = planned(tokens);
        let before = crate::emit::emit(&program, &[]).to_string();
        super::derivation(&declaration, &mut program, &[], None).expect("all modes");
        assert!(
            before == crate::emit::emit(&program, &[]).to_string(),
            "{name}"
        );
    }
}

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

/// A particle whose potential is whatever is to be written.
fn potential(expression: TokenStream) -> String {
    let d = derivation(quote! {
        #[lagrange(coordinates(x, y), kinetic = m/2 * (der(x)^2 + der(y)^2), potential = #expression)]
        struct Particle { m: f64, a: f64, b: f64, g: f64 }
    });
    print::text::formula(&d.potential)
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
    check(quote!(sin(x) * a / (a + b)), "a/(a + b) sin x");
    check(quote!(a * sqrt(x ^ 2 + y ^ 2)), "a √(x² + y²)");
    check(quote!(a / sqrt(x ^ 2 + y ^ 2)), "a/√(x² + y²)");
    check(quote!(cos(x) ^ 2 * a), "a cos² x");
    check(quote!(sin(2 * x) * sin(y)), "sin(2 x) sin y");
    check(quote!(abs(x - y)), "|x − y|");
    check(quote!(max(x, y)), "max(x, y)");
    check(quote!(if(x >= 0, a*x, b*y)), "{a x if x ≥ 0, else b y}");
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
fn the_same_byte_for_byte() {
    for (_, tokens) in scenes().into_iter().take(6) {
        let [a, b] = [(); 2].map(|()| crate::expand(tokens.clone()).to_string());
        assert!(a == b);
    }
}

#[test]
fn modes_are_found_by_name() {
    let tokens = quote! {
        #[lagrange(
            coordinates(x, y),
            kinetic = m/2 * (der(x)^2 + der(y)^2),
            potential = m * g * y,
            contact(floor: y >= 0, restitution = 1/2),
            friction(rub on floor: slip = der(x), static = mu),
        )]
        struct Puck { m: f64, g: f64, mu: f64 }
    };
    let one = |mode: &str| crate::inspect(tokens.clone(), Some(mode));
    let mode = one(" floor closed,rub  sticks ")
        .expect("a mode")
        .modes
        .remove(0);
    assert_eq!(mode.name, "floor closed, rub sticks");
    let lines: Vec<String> = mode.equations.iter().map(print::text::statement).collect();
    assert_eq!(
        lines,
        ["m x\u{308} = F_rub", "N_floor = m g", "x\u{308} = 0"]
    );
    assert_eq!(mode.known[0].relation, Relation::Equal);
    for wrong in [
        "floor closed",
        "rub sticks",
        "floor closed, rub sticks, rub slips",
        "roof open",
    ] {
        assert!(one(wrong).is_err(), "{wrong}");
    }
    let all = crate::inspect(tokens, None).expect("all modes");
    assert_eq!((all.modes.len(), all.mode_count), (4, 4));
    let bounce = print::text::statement(all.impacts[0].equations.last().expect("a law"));
    assert_eq!(bounce, "y\u{307}⁺ = −½ y\u{307}⁻");
    let half = Formula::number(Rational::HALF);
    assert_eq!(half, Formula::Number(Rational::HALF));
}

#[test]
fn many_contacts_are_shown_in_part() {
    let d = derivation(quote! {
        #[lagrange(
            coordinates(x[30]),
            kinetic = sum(k in 0..30: m/2 * der(x[k])^2),
            contact(pair[k in 0..29]: x[k + 1] - x[k] >= 2*a),
        )]
        struct Row { m: f64, a: f64 }
    });
    assert_eq!(d.mode_count, 1 << 29);
    assert!(d.modes.len() < 10 && d.notes.len() == 2, "{:?}", d.notes);
    assert!(print::plain(&d).len() < 40_000);
}

/// Results that textbooks derive by hand.
#[test]
fn modes_are_solved_where_the_solution_is_short() {
    let solved = |scene: &str, mode: &str| {
        let (_, tokens) = scenes()
            .into_iter()
            .find(|(name, _)| name == scene)
            .expect("a scene");
        let found = crate::inspect(tokens, Some(mode)).unwrap_or_else(|e| panic!("{e}"));
        let lines = found.modes[0].solution.iter().map(print::text::statement);
        lines.collect::<Vec<_>>().join("\n")
    };
    let check = |scene, mode, expected: &[&str]| {
        let found = solved(scene, mode);
        for line in expected {
            assert!(
                found.lines().any(|own| own == *line),
                "{line}\nis not in\n{found}"
            );
        }
    };
    check(
        "RollingSphere",
        "shell closed",
        &[
            "θ\u{308} = 5 g/(7 (R + a)) sin θ",
            "λ_rolling = −(2/7) m g sin θ",
        ],
    );
    check(
        "SphereInBowl",
        "bowl closed, grip sticks",
        &[
            "θ\u{308} = −5 g/(7 (R − a)) sin θ",
            "F_grip = (2/7) m g sin θ",
        ],
    );
    check(
        "Ladder",
        "wall closed, floor closed",
        &["θ\u{308} = −3 g/(2 l) cos θ"],
    );
    check("MassOnWheel", "rim open", &["x\u{308} = 0", "φ\u{308} = 0"]);
    // Nothing to be read: nothing is said.
    check("FiveLinkChain", "smooth", &[]);
}

/// The derivations of the textbook scenes, and of a smooth one, as they stand in `golden/`. `UPDATE_EXPECT=1 cargo test`
/// accepts what reads better.
#[test]
fn derivations_of_the_textbook_scenes() {
    let textbook = [
        "MassOnShell",
        "RollingSphere",
        "RollingSlippingSphere",
        "MassOnWheel",
        "SphereInBowl",
        "DoublePendulum",
    ];
    for (name, tokens) in scenes() {
        if textbook.contains(&name.as_str()) {
            let d = derivation(tokens);
            expect_file![format!("golden/{name}.txt")].assert_eq(&print::plain(&d));
            expect_file![format!("golden/{name}.tex")].assert_eq(&print::paper(&d));
        }
    }
}

#[test]
fn mathml_is_well_formed() {
    for (name, tokens) in scenes() {
        let d = derivation(tokens);
        let equations = print::equations(&d);
        assert!(!equations.contains('\n'));
        for text in [print::page(&d), equations] {
            let document =
                roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(document.descendants().any(|node| node.has_tag_name("math")));
            for node in document.descendants() {
                let children = node.children().filter(|child| child.is_element()).count();
                let expected = match node.tag_name().name() {
                    "mfrac" | "msub" | "msup" | "mover" => 2,
                    "msubsup" | "munderover" => 3,
                    _ => children,
                };
                assert_eq!(children, expected, "{name}: {node:?}");
            }
        }
    }
}

#[test]
fn braces_of_latex_balance() {
    for (name, tokens) in scenes() {
        let latex = print::paper(&derivation(tokens));
        let mut depth = 0;
        let mut escaped = false;
        for c in latex.chars() {
            match c {
                '{' if !escaped => depth += 1,
                '}' if !escaped => depth -= 1,
                _ => {}
            }
            assert!(depth >= 0, "{name}");
            escaped = c == '\\' && !escaped;
        }
        assert_eq!(depth, 0, "{name}");
        for pair in [("\\left", "\\right"), ("\\begin{", "\\end{")] {
            let count = |word| latex.matches(word).count();
            assert_eq!(count(pair.0), count(pair.1), "{name}");
        }
    }
}
