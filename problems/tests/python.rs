//! The Python of the README reads what the program writes. Needs a Python with pandas and polars (`PYTHON`, else python3 of the
//! path); without, it says so and passes.

mod program;

use program::{folder, lagrange_in, text};
use std::process::Command;

const README: &str = include_str!("../../README.md");

/// Blocks of the README that read a run.
fn blocks() -> Vec<&'static str> {
    let blocks = README.split("```python\n").skip(1);
    let blocks = blocks.filter_map(|block| block.split("```").next());
    blocks
        .filter(|block| block.contains("wheel.parquet"))
        .collect()
}

#[test]
fn the_examples_of_the_readme_work() {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let run = |code: &str, folder: &std::path::Path| {
        let mut python = Command::new(&python);
        python.current_dir(folder).args(["-c", code]).output()
    };
    let folder = folder("python");
    let ready = run("import pandas, pyarrow, polars", &folder);
    if !ready.is_ok_and(|output| output.status.success()) {
        println!("skipped: {python} has no pandas, pyarrow and polars");
        return;
    }
    let output = lagrange_in(
        &folder,
        &["run", "mass-on-wheel", "--output", "wheel.parquet"],
    );
    assert_eq!(output.status.code(), Some(0));
    let blocks = blocks();
    assert_eq!(blocks.len(), 2);
    for (block, words) in blocks
        .into_iter()
        .zip([["0.6 rad/s", "floor stop"], ["rim open", "1e-09"]])
    {
        let output = run(block, &folder).expect("Python starts");
        let said = text(&output.stdout);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
    }
}
