//! Accuracy → which method and tolerance reach an error in the shortest time.

use super::{duration, reference};
use crate::accuracy::{Accuracy, Row, Setting};
use std::io::{self, Write};

/// Writes the answer, how much longer the other methods take, and `run`, the command that was measured, with what is the fastest; nothing if
/// nothing reaches the target.
pub fn write(accuracy: &Accuracy, target: f64, run: &str, mut out: impl Write) -> io::Result<()> {
    let fastest = accuracy.fastest_of_each(target);
    let Some((setting, best)) = fastest.first() else {
        return Ok(());
    };
    writeln!(
        out,
        "{setting} is the fastest way to errors below {target:e}: {}, {} steps, error {:.1e}.",
        duration(best.time.best),
        best.work.steps,
        accuracy.resolved(best)
    )?;
    for (setting, measured) in &fastest[1..] {
        writeln!(
            out,
            "{setting} takes {:.2} times as long: {}, {} steps, error {:.1e}.",
            measured.time.best / best.time.best,
            duration(measured.time.best),
            measured.work.steps,
            accuracy.resolved(measured)
        )?;
    }
    writeln!(out, "{}", reference(accuracy))?;
    writeln!(out, "\n{run} {}", options(*setting))
}

/// The options of `lagrange run` that mean a setting.
fn options(setting: Setting) -> String {
    match setting.step() {
        None => format!(
            "--method {} --tolerance {:e}",
            setting.method, setting.tolerance
        ),
        Some(_) => format!("--method {}", setting.method),
    }
}

/// Whether some method has a result, and one that reaches `target` if there is one.
///
/// # Errors
/// Why there is no result, or what to try if nothing reaches it.
pub fn verdict(accuracy: &Accuracy, target: Option<f64>) -> Result<(), String> {
    let Some((setting, best)) = accuracy.most_exact() else {
        let failed = |row: &Row| row.result.clone().err().map(|why| (row.setting, why));
        return match accuracy.rows.iter().find_map(failed) {
            Some((setting, why)) => Err(format!("no method has a result; {setting}: {why}")),
            None => Err("no method has a result".to_owned()),
        };
    };
    let Some(target) = target.filter(|target| accuracy.fastest(*target).is_none()) else {
        return Ok(());
    };
    let floor = accuracy.reference.floor;
    if target < floor {
        return Err(format!(
            "errors below {floor:.1e} cannot be told apart in this run ({}; {} differs by {:.1e}); ask for more than that",
            accuracy.reference.by, accuracy.reference.checked_by, accuracy.reference.difference
        ));
    }
    Err(format!(
        "nothing reaches {target:e}; the best is {setting} with {:.1e}: allow more methods or smaller tolerances",
        accuracy.resolved(best)
    ))
}
