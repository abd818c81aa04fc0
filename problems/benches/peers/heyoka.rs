//! heyoka, a C++ library with a Python interface: a process of its own, asked by lines of JSON, that takes its turns with the others.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers/with_heyoka.py");

/// The process; it ends with this.
pub struct Heyoka {
    process: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
}

/// A run that the process has made ready.
#[derive(Clone, Copy)]
pub struct Run(u64);

impl Heyoka {
    /// Starts it with the Python that the environment variable `HEYOKA_PYTHON` names, one that can import heyoka. An empty name counts as none.
    pub fn start() -> Option<Heyoka> {
        let python = std::env::var_os("HEYOKA_PYTHON").filter(|python| !python.is_empty())?;
        let mut process = Command::new(&python)
            .arg(SCRIPT)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap_or_else(|e| panic!("HEYOKA_PYTHON = {}: {e}", python.display()));
        let (questions, answers) = (process.stdin.take(), process.stdout.take());
        let (Some(questions), Some(answers)) = (questions, answers) else {
            unreachable!("both are piped");
        };
        Some(Heyoka {
            process,
            questions,
            answers: BufReader::new(answers),
        })
    }

    fn ask(&mut self, question: &Value) -> Value {
        writeln!(self.questions, "{question}").expect("the script reads");
        let mut answer = String::new();
        self.answers
            .read_line(&mut answer)
            .expect("the script writes");
        serde_json::from_str(&answer).expect("the script answers with a line of JSON")
    }

    /// Compiles a scene and runs it once: what it finds.
    pub fn prepare(&mut self, scene: &str, tolerance: f64) -> (Run, Vec<f64>) {
        let answer = self.ask(&json!({ "scene": scene, "tolerance": tolerance }));
        let found = answer["found"].as_array().into_iter().flatten();
        let found = found.map(|x| x.as_f64().unwrap_or(f64::NAN)).collect();
        (Run(answer["run"].as_u64().unwrap_or_default()), found)
    }

    /// What one run takes, by the clock of the script.
    pub fn time(&mut self, run: Run) -> Duration {
        let answer = self.ask(&json!({ "run": run.0 }));
        Duration::from_secs_f64(answer["seconds"].as_f64().unwrap_or(f64::MAX))
    }
}

impl Drop for Heyoka {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
