//! `lagrange export`: a declaration in a file as a struct of Rust.

use super::Trouble;
use super::output::{file, ready, to_file};
use crate::file::{ENDING, Exported, export, read};
use clap::Args;
use std::path::{Path, PathBuf};

/// Write a declaration as Rust: the struct with its derive, and its default values.
///
/// In a crate with lagrange-core rustc compiles its equations, which then run faster, and with other numbers than f64 too.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange export pendulum.lagrange
  lagrange export pendulum.lagrange --output pendulum.rs")]
pub(super) struct Export {
    /// The declaration (….lagrange).
    file: String,
    /// Write the Rust to a file instead of stdout.
    #[arg(long, value_name = "FILE.rs")]
    output: Option<PathBuf>,
}

impl Export {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        if !self.file.ends_with(ENDING) {
            return Err(Trouble::usage(format_args!(
                "{} is no declaration in a file: its name ends in {ENDING}",
                self.file
            )));
        }
        let path = file(self.output.as_deref());
        if path.is_some_and(|path| path.ends_with("main.rs")) {
            let reason = "what is exported is a module beside main.rs; choose another name, as --output system.rs";
            return Err(Trouble::usage(reason));
        }
        if let Some(path) = path.filter(|path| path.extension().is_none_or(|ending| ending != "rs"))
        {
            return Err(Trouble::usage(format_args!(
                "the name {} is not that of Rust: let it end in .rs",
                path.display()
            )));
        }
        ready(path, std::slice::from_ref(&self.file))?;
        let exported = read(&self.file).and_then(|text| export(&self.file, &text));
        let exported = exported.map_err(Trouble::usage)?;
        let Some(path) = path else {
            return super::print(|out| out.write_all(exported.rust.as_bytes()));
        };
        to_file(path, |out| out.write_all(exported.rust.as_bytes()))?;
        super::print(|out| writeln!(out, "{}", hint(path, &self.file, &exported)))
    }
}

/// What to write in `main.rs`, where the struct stands in `path`.
fn hint(path: &Path, file: &str, Exported { system, until, .. }: &Exported) -> String {
    let scene = stem(Path::new(file));
    let (line, module) = module(path);
    format!(
        "{} is written; for a program with it, write in main.rs\n    {line}\n    \
         .scene(Entry::<{module}::{system}>::new({scene:?}, {until:?}))",
        path.display()
    )
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().display().to_string()
}

/// The line that declares a file as a module, and the name of the module: that of the file where Rust takes it.
fn module(path: &Path) -> (String, String) {
    let stem = stem(path);
    let is_name = |name: &String| syn::parse_str::<syn::Ident>(name).is_ok();
    if is_name(&stem) {
        return (format!("mod {stem};"), stem);
    }
    let plain = stem.replace(|c: char| !c.is_alphanumeric(), "_");
    let name = [plain.clone(), format!("system_{plain}")]
        .into_iter()
        .find(is_name);
    let name = name.unwrap_or_else(|| "system".to_owned());
    let file = path.file_name().unwrap_or_default().display().to_string();
    (format!("#[path = {file:?}] mod {name};"), name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_any_name_becomes_a_module() {
        let declared = |path: &str| module(Path::new(path)).0;
        assert_eq!(declared("src/arm.rs"), "mod arm;");
        assert_eq!(
            declared("src/my-arm.rs"),
            "#[path = \"my-arm.rs\"] mod my_arm;"
        );
        assert_eq!(
            declared("2link.rs"),
            "#[path = \"2link.rs\"] mod system_2link;"
        );
        assert_eq!(
            declared("move.rs"),
            "#[path = \"move.rs\"] mod system_move;"
        );
    }
}
