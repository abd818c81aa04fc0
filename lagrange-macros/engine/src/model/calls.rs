//! Calls: `der`, functions of a number, functions of lists, and what only outputs have.

use super::depth::{Context, Depth, Reach};
use super::elaboration::Elaboration;
use super::meaning::Kind;
use super::value::{Value, area, cross, dot, norm};
use crate::ast::{Expr, ModeWord, Name};
use crate::diagnostics::{Code, nearest};
use crate::parse::{DEGREES, FUNCTIONS, is_degree};
use crate::symbolic::{ExprId, Function};

/// What other languages call the functions of this one.
const ALIASES: &[(&str, &str)] = &[
    ("log", "ln(…)"),
    ("arcsin", "asin(…)"),
    ("arccos", "acos(…)"),
    ("arctan", "atan(…)"),
    ("tg", "tan(…)"),
    ("sgn", "sign(…)"),
    ("signum", "sign(…)"),
    ("pow", "a^b"),
    ("powi", "a^b"),
    ("powf", "a^b"),
    ("sqr", "x^2"),
    ("diff", "der(…)"),
    ("d", "der(…)"),
    ("D", "der(…)"),
    ("ddt", "der(…)"),
    ("dt", "der(…)"),
    ("length", "norm(…)"),
];

impl Elaboration<'_> {
    /// `name(arguments)`
    pub fn call(
        &mut self,
        expr: &Expr,
        name: &Name,
        arguments: &[Expr],
        context: Context,
    ) -> Option<Value> {
        let text = name.text.as_str();
        if let Some(function) = Function::from_name(text) {
            let takes = match function.arity() {
                1 => "1 argument",
                _ => "2 arguments",
            };
            self.arity(name, arguments, function.arity()..=function.arity(), takes)?;
            let mut arguments = self.scalars(arguments, context)?;
            // The others have a value at 0.
            if matches!(function, Function::Ln | Function::Atan2) {
                for argument in &mut arguments {
                    *argument = self.zero_or_not(*argument);
                }
            }
            if !self.has_value(text, &arguments) {
                self.sink.report(Code::NoValue, expr.extent, &[expr]);
                return None;
            }
            return Some(Value::Scalar(self.system.pool.call(function, &arguments)));
        }
        match text {
            "der" => {
                self.arity(name, arguments, 1..=1, "1 argument")?;
                self.derivative(expr, name, &arguments[0], context)
            }
            "sqrt" | "abs" | "sign" => {
                self.arity(name, arguments, 1..=1, "1 argument")?;
                let u = self.scalar(&arguments[0], context)?;
                let u = self.zero_or_not(u);
                if !self.has_value(text, &[u]) {
                    self.sink.report(Code::NoValue, expr.extent, &[expr]);
                    return None;
                }
                Some(Value::Scalar(match text {
                    "sqrt" => self.system.pool.sqrt(u),
                    "abs" => self.absolute(u, &arguments[0]),
                    _ => self.sign(u, &arguments[0]),
                }))
            }
            "min" | "max" => {
                self.arity(name, arguments, 2..=usize::MAX, "2 or more arguments")?;
                let values = self.scalars(arguments, context)?;
                let extreme = self.extreme(text, arguments, &values, expr.extent);
                Some(Value::Scalar(extreme))
            }
            "dot" | "cross" | "norm" => self.of_lists(name, arguments, context),
            "gap" | "slip" | "momentum" => self.of_item(name, arguments, context),
            "sum" | "list" | "if" => None, // the parser gives these a form of their own
            _ => {
                self.not_a_function(name);
                None
            }
        }
    }

    /// Whether a function has a value at an argument that is a number.
    fn has_value(&self, function: &str, arguments: &[ExprId]) -> bool {
        let Some(number) = arguments
            .first()
            .and_then(|&u| self.system.pool.as_number(u))
        else {
            return true;
        };
        match function {
            "sqrt" => !number.is_negative(),
            "ln" => !number.is_negative() && !number.is_zero(),
            "asin" | "acos" => number.to_f64().abs() <= 1.0,
            _ => true,
        }
    }

    fn not_a_function(&mut self, name: &Name) {
        let text = name.text.as_str();
        if ModeWord::ALL.iter().any(|(word, _)| *word == text) {
            return self.sink.report(Code::ConditionHere, name, &[&text]);
        }
        let hint = if text == "poisson" {
            "it stands in a contact: `restitution = poisson(e)`".to_string()
        } else if is_degree(text) {
            DEGREES.to_string()
        } else if self.names.contains_key(text)
            || self.indices.iter().any(|(index, _)| index == text)
        {
            format!("a product is written with `*`: `{text}*(…)`; an element `{text}[…]`")
        } else if let Some((_, known)) = ALIASES.iter().find(|(alias, _)| *alias == text) {
            format!("write `{known}`")
        } else if let Some(known) = nearest(
            text,
            FUNCTIONS
                .iter()
                .copied()
                .chain(["sum", "list", "if", "poisson"]),
        ) {
            format!("did you mean `{known}`?")
        } else {
            format!("functions are {}", FUNCTIONS.join(", "))
        };
        self.sink.report(Code::NotAFunction, name, &[&text, &hint]);
    }

    fn arity(
        &mut self,
        name: &Name,
        arguments: &[Expr],
        range: std::ops::RangeInclusive<usize>,
        takes: &str,
    ) -> Option<()> {
        if range.contains(&arguments.len()) {
            return Some(());
        }
        self.sink.report(
            Code::ArgumentCount,
            name,
            &[&name.text, &takes, &arguments.len()],
        );
        None
    }

    fn scalars(&mut self, arguments: &[Expr], context: Context) -> Option<Vec<ExprId>> {
        let values: Vec<Option<ExprId>> = arguments
            .iter()
            .map(|argument| self.scalar(argument, context))
            .collect();
        values.into_iter().collect()
    }

    /// d/dt along q̇ = v, v̇ = a, ṫ = 1.
    fn derivative(
        &mut self,
        expr: &Expr,
        der: &Name,
        argument: &Expr,
        context: Context,
    ) -> Option<Value> {
        // The rate of what moves by itself is as deep as that is: where no velocity may stand, the rate tells.
        let at_rest = context.reach <= Reach::Positions;
        let inside = match at_rest {
            true => Context {
                reach: Reach::Definition,
                ..context
            },
            false => context,
        };
        let value = self.value(argument, inside)?;
        let inner = self.depth(&value.scalars());
        if inner >= Depth::Acceleration {
            self.sink.report(Code::HigherDerivative, der, &[]);
            return None;
        }
        let derivative = value.map(&mut |e| self.time_rate(e));
        let depth = self.depth(&derivative.scalars());
        if at_rest {
            self.admit(depth.min(Depth::Velocity), context, &expr, der.into())?;
        } else if inner == Depth::Velocity {
            self.admit(depth, context, &expr, der.into())?;
        }
        Some(derivative)
    }

    /// `dot(a, b)`, `cross(a, b)`, `norm(a)`
    fn of_lists(&mut self, name: &Name, arguments: &[Expr], context: Context) -> Option<Value> {
        let (count, takes) = match name.text.as_str() {
            "norm" => (1, "1 list"),
            "dot" if arguments.len() == 1 => (2, "2 lists (a velocity is `der(x)`)"),
            _ => (2, "2 lists"),
        };
        self.arity(name, arguments, count..=count, takes)?;
        let lists: Vec<Option<Vec<ExprId>>> =
            arguments.iter().map(|e| self.vector(e, context)).collect();
        let lists: Vec<Vec<ExprId>> = lists.into_iter().collect::<Option<_>>()?;
        let pool = &mut self.system.pool;
        match (name.text.as_str(), lists.as_slice()) {
            ("norm", [a]) => Some(Value::Scalar(norm(pool, a))),
            ("dot", [a, b]) if a.len() == b.len() => Some(Value::Scalar(dot(pool, a, b))),
            ("cross", [a, b]) => match (a.as_slice(), b.as_slice()) {
                (&[a0, a1], &[b0, b1]) => Some(Value::Scalar(area(pool, [a0, a1], [b0, b1]))),
                (&[a0, a1, a2], &[b0, b1, b2]) => {
                    let product = cross(pool, [a0, a1, a2], [b0, b1, b2]);
                    Some(Value::List(product.map(Value::Scalar).into()))
                }
                _ => {
                    self.sink.report(Code::Lengths, name, &[&a.len(), &b.len()]);
                    None
                }
            },
            (_, lists) => {
                self.sink
                    .report(Code::Lengths, name, &[&lists[0].len(), &lists[1].len()]);
                None
            }
        }
    }

    /// A list of scalars.
    pub fn vector(&mut self, expr: &Expr, context: Context) -> Option<Vec<ExprId>> {
        let value = self.value(expr, context)?;
        let vector = value.vector();
        if vector.is_none() {
            let hint = "write a list of single values: `[a, b]`";
            self.sink.report(Code::ScalarForList, expr.extent, &[&hint]);
        }
        vector
    }

    /// `gap(c)`, `slip(f)`, `momentum(x)`
    fn of_item(&mut self, name: &Name, arguments: &[Expr], context: Context) -> Option<Value> {
        self.arity(name, arguments, 1..=1, "1 name")?;
        if context.reach != Reach::Outputs {
            self.sink.report(Code::OutputOnly, name, &[&name.text]);
            return None;
        }
        let reference = self.reference(&arguments[0])?;
        match name.text.as_str() {
            "gap" => {
                let (_, contact) = self.item(&reference, &[Kind::Contact])?;
                Some(Value::Scalar(self.system.contacts[contact].gap))
            }
            "slip" => {
                let (_, friction) = self.item(&reference, &[Kind::Friction])?;
                let slip = &self.system.frictions[friction].slip;
                Some(match slip.as_slice() {
                    [(only, _)] => Value::Scalar(*only),
                    components => Value::List(
                        components
                            .iter()
                            .map(|(slip, _)| Value::Scalar(*slip))
                            .collect(),
                    ),
                })
            }
            // Where rates are symbols nothing can be differentiated by a velocity.
            _ if self.rates.is_some() => None,
            _ => {
                let coordinate = self.coordinate(&reference)?;
                let velocity = self.system.coordinates[coordinate].velocity;
                let lagrangian = self.lagrangian();
                Some(Value::Scalar(
                    self.system.pool.differentiate(lagrangian, velocity),
                ))
            }
        }
    }
}
