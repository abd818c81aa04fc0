//! The programs that are emitted as data, to be read: one line for each operation, blocks under what asks for them.

use crate::derive::Stage;
use crate::plan::{Coefficient, Mode, Operation, Program, Tape, Value, ValueRef};
use std::fmt::Write;

/// Constants, motion and report as comments.
pub fn listing(program: &Program) -> String {
    let system = &program.equations.system;
    let parameters: Vec<String> = system.parameters.iter().map(|p| p.name.clone()).collect();
    let states = |stage| -> Vec<String> {
        let symbols = program.inputs(stage).into_iter();
        let names = symbols.map(|symbol| system.pool.name(symbol).to_string());
        names.collect()
    };
    let constants: Vec<String> = (0..program.constants.outputs)
        .map(|at| format!("c{at}"))
        .collect();
    let tapes = [
        (
            "constants",
            &program.constants,
            parameters.clone(),
            constants,
        ),
        (
            "motion",
            &program.motion,
            states(Stage::Motion),
            labels(program, Stage::Motion, program.motion.outputs),
        ),
        (
            "report",
            &program.report,
            states(Stage::Report),
            labels(program, Stage::Report, program.report.outputs),
        ),
    ];
    let mut text = String::new();
    for (name, tape, inputs, outputs) in tapes {
        let _ = writeln!(text, "\n// Program of `{name}`:");
        let lister = Lister {
            parameters: &parameters,
            inputs,
            outputs,
        };
        lister.tape(tape, &mut text);
    }
    text
}

/// What the outputs of a stage are.
fn labels(program: &Program, stage: Stage, count: usize) -> Vec<String> {
    let mut labels = vec![String::new(); count];
    for (output, place) in program.equations.outputs.iter().zip(&program.places) {
        if let (true, ValueRef::Node(at)) = (output.stage == stage, place) {
            labels[*at].clone_from(&output.label);
        }
    }
    labels
}

struct Lister<'a> {
    parameters: &'a [String],
    inputs: Vec<String>,
    outputs: Vec<String>,
}

impl Lister<'_> {
    fn tape(&self, tape: &Tape, text: &mut String) {
        for block in &tape.blocks {
            let _ = match block.needs.is_always() {
                true => writeln!(text, "// always:"),
                false => {
                    let words: Vec<String> = block
                        .needs
                        .words()
                        .iter()
                        .map(|w| format!("{w:#x}"))
                        .collect();
                    let (words, first) = (words.join(" "), 64 * block.needs.first());
                    writeln!(
                        text,
                        "// if one of the needs {words} from {first} on is held:"
                    )
                }
            };
            for step in &block.steps {
                let first = step.value;
                let results: Vec<String> = (0..step.operation.values())
                    .map(|offset| self.value(Value(first.0 + offset)))
                    .collect();
                let _ = writeln!(
                    text,
                    "//     {} = {}",
                    results.join(", "),
                    self.operation(step.operation)
                );
            }
            for write in &block.writes {
                let sign = match write.mode {
                    Mode::Set => "=",
                    Mode::Add => "+=",
                    Mode::Sub => "-=",
                };
                let (output, value) = (&self.outputs[write.output], self.value(write.value));
                let _ = writeln!(text, "//     {output} {sign} {value}");
            }
        }
    }

    fn value(&self, value: Value) -> String {
        let input = self.inputs.get(value.0).cloned();
        input.unwrap_or_else(|| format!("n{}", value.0))
    }

    fn coefficient(&self, coefficient: Coefficient) -> String {
        match coefficient {
            Coefficient::Number(number) => number.to_string(),
            Coefficient::Pi(multiple) => format!("{multiple} pi"),
            Coefficient::Parameter(at) => self.parameters[at].clone(),
            Coefficient::Constant(at) => format!("c{at}"),
        }
    }

    fn operation(&self, operation: Operation) -> String {
        use Operation::*;
        let n = |value| self.value(value);
        let c = |coefficient| self.coefficient(coefficient);
        match operation {
            Constant(x) => c(x),
            Add(x, y) => format!("{} + {}", n(x), n(y)),
            Sub(x, y) => format!("{} - {}", n(x), n(y)),
            Neg(x) => format!("-{}", n(x)),
            Offset(x, y) => format!("{} + {}", c(x), n(y)),
            Scale(x, y) => format!("{} * {}", c(x), n(y)),
            Mul(x, y) => format!("{} * {}", n(x), n(y)),
            Square(x) => format!("{0} * {0}", n(x)),
            Div(x, y) => format!("{} / {}", n(x), n(y)),
            Ratio(x, y) => format!("{} / {}", c(x), n(y)),
            Sqrt(x) => format!("sqrt({})", n(x)),
            Powf(x, y) => format!("{}^({y})", n(x)),
            Exp(x) => format!("exp({})", n(x)),
            Ln(x) => format!("ln({})", n(x)),
            SinCos(x) => format!("sin, cos({})", n(x)),
            SinhCosh(x) => format!("sinh, cosh({})", n(x)),
            Tan(x) => format!("tan({})", n(x)),
            Tanh(x) => format!("tanh({})", n(x)),
            Asin(x) => format!("asin({})", n(x)),
            Acos(x) => format!("acos({})", n(x)),
            Atan(x) => format!("atan({})", n(x)),
            Atan2(y, x) => format!("atan2({}, {})", n(y), n(x)),
            Select(branch, x, y) => format!("if branch {branch}: {}, else {}", n(x), n(y)),
            Choose(g, x, y) => format!("if {} >= 0: {}, else {}", n(g), n(x), n(y)),
        }
    }
}
