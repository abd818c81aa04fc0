//! Expressions by precedence, weakest first:
//!
//! ```text
//! sum     := product (('+' | '-') product)*
//! product := signed (('*' | '/') signed)*
//! signed  := ('-' | '+')* power
//! power   := postfix ('^' signed)?                    right associative, tighter than the sign before it
//! postfix := atom ('[' sum ']' | '.' name)*
//! atom    := number | name | name '(' … ')' | '(' sum, … ')' | '[' sum, … ']'
//! ```

use super::cursor::Cursor;
use super::leftover::leftover;
use super::number::number;
use super::words::{FUNCTIONS, RELATIONS};
use crate::ast::{Comparison, Expr, ExprKind, Factor, Index, Name, Range, Relation, Sign};
use crate::diagnostics::{Code, Diagnostics, Extent};
use proc_macro2::{Delimiter, TokenTree};

/// An expression that fills the rest of the cursor.
pub(super) fn whole(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Expr> {
    let expr = expression(cursor, sink)?;
    leftover(cursor, sink)?;
    Some(expr)
}

/// An expression as far as it goes.
pub(super) fn expression(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Expr> {
    let mut terms = vec![(Sign::Plus, product(cursor, sink)?)];
    loop {
        let sign = match cursor.operator() {
            Some("+") => Sign::Plus,
            Some("-") => Sign::Minus,
            _ => break,
        };
        cursor.next();
        terms.push((sign, product(cursor, sink)?));
    }
    Some(flat(terms, ExprKind::Sum))
}

fn product(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Expr> {
    let mut factors = vec![(Factor::Times, signed(cursor, sink)?)];
    loop {
        let side = match cursor.operator() {
            Some("*") => Factor::Times,
            Some("/") => Factor::Over,
            _ => break,
        };
        cursor.next();
        factors.push((side, signed(cursor, sink)?));
    }
    Some(flat(factors, ExprKind::Product))
}

/// A chain of one is its element.
fn flat<S>(mut chain: Vec<(S, Expr)>, kind: fn(Vec<(S, Expr)>) -> ExprKind) -> Expr {
    if chain.len() == 1 {
        return chain.remove(0).1;
    }
    let extent = Extent::new(chain[0].1.extent, chain[chain.len() - 1].1.extent);
    Expr {
        kind: kind(chain),
        extent,
    }
}

fn signed(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Expr> {
    let start = cursor.here();
    let mut negative = false;
    while let Some(sign @ ("-" | "+")) = cursor.operator() {
        negative ^= sign == "-";
        cursor.next();
    }
    let value = power(cursor, sink)?;
    if !negative {
        return Some(value);
    }
    let extent = Extent::new(start, value.extent);
    Some(Expr {
        kind: ExprKind::Negative(Box::new(value)),
        extent,
    })
}

fn power(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Expr> {
    let base = postfix(cursor, sink)?;
    if let ExprKind::Name(name) = &base.kind
        && FUNCTIONS.contains(&name.text.as_str())
        && cursor.operator() == Some("^")
    {
        sink.report(Code::FunctionPower, name, &[&name.text]);
        return None;
    }
    if let Some(stars) = cursor.take("**") {
        sink.report(Code::PowerStars, stars, &[]);
    } else if cursor.take("^").is_none() {
        return Some(base);
    }
    cursor.deeper(sink)?;
    let exponent = signed(cursor, sink)?;
    cursor.shallower();
    let extent = Extent::new(base.extent, exponent.extent);
    Some(Expr {
        kind: ExprKind::Power(Box::new(base), Box::new(exponent)),
        extent,
    })
}

fn postfix(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Expr> {
    let mut value = atom(cursor, sink)?;
    let mut levels = 0;
    loop {
        // What is taken of a value nests as parentheses do.
        if cursor.group(Delimiter::Bracket).is_some() || cursor.operator() == Some(".") {
            cursor.deeper(sink)?;
            levels += 1;
        }
        if let Some(group) = cursor.take_group(Delimiter::Bracket) {
            let index = whole(&mut cursor.inside(&group, sink)?, sink)?;
            value = Expr {
                extent: Extent::new(value.extent, group.span_close()),
                kind: ExprKind::Element(Box::new(value), Box::new(index)),
            };
        } else if cursor.operator() == Some(".") {
            cursor.next();
            let name = cursor.name("a member", sink)?;
            if let Some(group) = cursor.group(Delimiter::Parenthesis) {
                return method(value, &name, &group, cursor, sink);
            }
            value = Expr {
                extent: Extent::new(value.extent, &name),
                kind: ExprKind::Member(Box::new(value), name),
            };
        } else {
            (0..levels).for_each(|_| cursor.shallower());
            return Some(value);
        }
    }
}

/// What functions belong to in other languages.
const MODULES: [&str; 4] = ["math", "Math", "np", "numpy"];

/// `theta.cos()` is reported with what to write instead.
fn method(
    value: Expr,
    name: &Name,
    group: &proc_macro2::Group,
    cursor: &Cursor,
    sink: &mut Diagnostics,
) -> Option<Expr> {
    let mut arguments = vec![value.to_string()];
    for mut part in cursor.inside(group, sink)?.parts("an argument", sink) {
        arguments.push(part.rest().to_string());
    }
    let better = match (name.text.as_str(), arguments.as_slice()) {
        ("powi" | "powf" | "pow", [base, exponent]) => format!("{base}^{exponent}"),
        ("log" | "log10", [argument, ..]) => format!("ln({argument})"),
        ("signum", [argument]) => format!("sign({argument})"),
        // A module of functions in other languages.
        (function, [module, rest @ ..]) if MODULES.contains(&module.as_str()) => {
            format!("{function}({})", rest.join(", "))
        }
        (function, arguments) => format!("{function}({})", arguments.join(", ")),
    };
    sink.report(
        Code::MethodCall,
        Extent::new(name, group.span_close()),
        &[&name.text, &better],
    );
    None
}

fn atom(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Expr> {
    let here = cursor.here();
    match cursor.peek().cloned() {
        Some(TokenTree::Literal(literal)) => {
            cursor.next();
            let kind = ExprKind::Number(number(&literal, sink)?);
            Some(Expr { kind, extent: here })
        }
        Some(TokenTree::Ident(ident)) => {
            cursor.next();
            named(Name::new(&ident), cursor, sink)
        }
        Some(TokenTree::Group(group)) => match group.delimiter() {
            Delimiter::Brace => {
                cursor.expected("a value", sink);
                None
            }
            delimiter => {
                cursor.next();
                let inside = cursor.inside(&group, sink)?;
                bracketed(delimiter, here, inside, sink)
            }
        },
        _ => {
            no_value(cursor, sink);
            None
        }
    }
}

/// `(a)`, `(a, b)`, `[a, b]`, or an invisible group.
fn bracketed(
    delimiter: Delimiter,
    extent: Extent,
    mut inside: Cursor,
    sink: &mut Diagnostics,
) -> Option<Expr> {
    if delimiter == Delimiter::None {
        return whole(&mut inside, sink);
    }
    if inside.is_at_end() {
        sink.report(Code::EmptyPart, extent, &[&"a value"]);
        return None;
    }
    let elements = expressions(inside, "a value", sink)?;
    if let (Delimiter::Parenthesis, [_]) = (delimiter, elements.as_slice()) {
        let [inner] = <[Expr; 1]>::try_from(elements).ok()?;
        return Some(Expr { extent, ..inner });
    }
    Some(Expr {
        kind: ExprKind::List(elements),
        extent,
    })
}

/// Expressions between commas; mistakes in all of them are reported.
pub(super) fn expressions(inside: Cursor, what: &str, sink: &mut Diagnostics) -> Option<Vec<Expr>> {
    let before = sink.count();
    let elements: Vec<Option<Expr>> = inside
        .parts(what, sink)
        .iter_mut()
        .map(|part| whole(part, sink))
        .collect();
    if sink.count() > before {
        return None;
    }
    elements.into_iter().collect()
}

/// A name, or a call.
fn named(name: Name, cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Expr> {
    if cursor.operator() == Some("::") {
        path(&name, cursor, sink);
        return None;
    }
    if name.text == "self" && cursor.operator() == Some(".") {
        sink.report(
            Code::RustNotation,
            &name,
            &[&"self.", &"parameters are written by their name alone"],
        );
        cursor.next();
        return postfix(cursor, sink);
    }
    let Some(group) = cursor.take_group(Delimiter::Parenthesis) else {
        let form = match name.text.as_str() {
            "if" => "if(a >= b, x, y)",
            "sum" => "sum(i in 0..n: …)",
            "list" => "list(i in 0..n: …)",
            _ => "",
        };
        if !form.is_empty() {
            let hint = format!("write `{form}`");
            sink.report(Code::RustNotation, &name, &[&name.text, &hint]);
            return None;
        }
        let extent = (&name).into();
        return Some(Expr {
            kind: ExprKind::Name(name),
            extent,
        });
    };
    let extent = Extent::new(&name, group.span_close());
    let inside = cursor.inside(&group, sink)?;
    if inside.is_at_end() {
        sink.report(Code::EmptyPart, extent, &[&"an argument"]);
        return None;
    }
    let kind = match name.text.as_str() {
        "if" => conditional(inside, extent, sink)?,
        "sum" => over(inside, sink, ExprKind::SumOver)?,
        "list" => over(inside, sink, ExprKind::ListOver)?,
        _ => ExprKind::Call(name, expressions(inside, "an argument", sink)?),
    };
    Some(Expr { kind, extent })
}

/// `if(a >= b, then, otherwise)`
fn conditional(inside: Cursor, extent: Extent, sink: &mut Diagnostics) -> Option<ExprKind> {
    let mut parts = inside.parts("an argument", sink);
    let [condition, then, otherwise] = parts.as_mut_slice() else {
        let count = parts.len();
        sink.report(
            Code::ArgumentCount,
            extent,
            &[&"if", &"3 arguments: `if(a >= b, x, y)`", &count],
        );
        return None;
    };
    let condition = comparison(condition, CONDITION, sink).and_then(|found| {
        leftover(condition, sink)?;
        Some(found)
    });
    let (then, otherwise) = (whole(then, sink), whole(otherwise, sink));
    Some(ExprKind::If(
        Box::new(condition?),
        Box::new(then?),
        Box::new(otherwise?),
    ))
}

/// `sum(i in a..b: body)` or `list(i in a..b: body)`
fn over(
    mut inside: Cursor,
    sink: &mut Diagnostics,
    kind: fn(Box<Index>, Box<Expr>) -> ExprKind,
) -> Option<ExprKind> {
    let index = index(&mut inside, sink)?;
    if let Some(comma @ ",") = inside.operator() {
        let hint = "they stand inside each other, `sum(i in 0..3: sum(j in 0..3: …))`";
        sink.report(Code::Operator, inside.here(), &[&comma, &hint]);
        return None;
    }
    inside.require(":", sink)?;
    let body = whole(&mut inside, sink)?;
    Some(kind(Box::new(index), Box::new(body)))
}

/// `i in a..b`
pub(super) fn index(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Index> {
    let name = cursor.name("an index: `i in a..b`", sink)?;
    if cursor.take_word("in").is_none() {
        cursor.expected("`in`, as in `i in a..b`", sink);
        return None;
    }
    let from = expression(cursor, sink)?;
    if let Some(inclusive) = cursor.take("..=") {
        sink.report(Code::InclusiveRange, inclusive, &[]);
    } else {
        cursor.require("..", sink)?;
    }
    let to = expression(cursor, sink)?;
    Some(Index {
        name,
        range: Range { from, to },
    })
}

/// `std::f64::consts::PI` and the like.
fn path(first: &Name, cursor: &mut Cursor, sink: &mut Diagnostics) {
    let mut last = first.clone();
    let mut text = first.text.clone();
    while cursor.take("::").is_some() {
        let Some(next) = cursor.word() else { break };
        cursor.next();
        text = format!("{text}::{}", next.text);
        last = next;
    }
    let hint = match last.text.as_str() {
        "PI" => "write `pi`".to_string(),
        name if FUNCTIONS.contains(&name) => format!("write `{name}(…)`"),
        _ => "the language knows parameters, coordinates and names of the declaration only"
            .to_string(),
    };
    sink.report(
        Code::RustNotation,
        Extent::new(first, &last),
        &[&text, &hint],
    );
}

/// Reports what stands where a value is expected.
fn no_value(cursor: &Cursor, sink: &mut Diagnostics) {
    let hint = match cursor.operator() {
        Some("|" | "||") => "an absolute value is written `abs(x)`",
        Some("!" | "&" | "&&") => "conditions are comparisons, joined by `and`",
        Some(".") if let Some(TokenTree::Literal(digits)) = cursor.second() => {
            let text = format!(".{digits}");
            return sink.report(Code::NumberForm, cursor.here(), &[&text]);
        }
        _ => return cursor.expected("a value", sink),
    };
    let operator = cursor.operator().unwrap_or_default();
    sink.report(Code::Operator, cursor.here(), &[&operator, &hint]);
}

/// What to write where there is no comparison, and where there is a chain of them.
pub(super) type Advice = (&'static str, &'static str);

/// Of `if`.
const CONDITION: Advice = (
    "`a >= b`",
    "for `a <= x <= b` write `min(x - a, b - x) >= 0`",
);

/// `left >= right` or `left <= right`
pub(super) fn comparison(
    cursor: &mut Cursor,
    advice: Advice,
    sink: &mut Diagnostics,
) -> Option<Comparison> {
    let (example, of_chain) = advice;
    if let Some(mut inside) = invisible(cursor, sink) {
        let found = comparison(&mut inside, advice, sink)?;
        leftover(&mut inside, sink)?;
        return Some(found);
    }
    let left = expression(cursor, sink)?;
    let (operator, at) = (cursor.operator(), cursor.here());
    let relation = match operator {
        Some(">=") => Relation::AtLeast,
        Some("<=") => Relation::AtMost,
        Some(strict @ (">" | "<")) => {
            sink.report(Code::StrictComparison, at, &[&strict]);
            return None;
        }
        Some(equal @ ("==" | "=" | "!=")) => {
            let hint = format!("write {example}; equations stand in `constraint`");
            sink.report(Code::WrongRelation, at, &[&equal, &"comparison", &hint]);
            return None;
        }
        _ if cursor.is_at_end() => {
            sink.report(Code::ComparisonExpected, left.extent, &[&example]);
            return None;
        }
        _ => {
            cursor.expected("`>=` or `<=`", sink);
            return None;
        }
    };
    cursor.take(operator.unwrap_or_default());
    let right = expression(cursor, sink)?;
    unchained(cursor, of_chain, sink)?;
    Some(Comparison {
        left,
        relation,
        right,
    })
}

/// Reports a second relation behind a comparison or equation.
pub(super) fn unchained(cursor: &Cursor, hint: &str, sink: &mut Diagnostics) -> Option<()> {
    if cursor
        .operator()
        .is_some_and(|operator| RELATIONS.contains(&operator))
    {
        sink.report(Code::ChainedComparison, cursor.here(), &[&hint]);
        return None;
    }
    Some(())
}

/// An invisible group here that holds a whole relation is entered.
pub(super) fn invisible(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Cursor> {
    let inside = cursor.inside(&cursor.group(Delimiter::None)?, sink)?;
    if !inside.has_operator(RELATIONS) {
        return None;
    }
    cursor.next();
    Some(inside)
}
