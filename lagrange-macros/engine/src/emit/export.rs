//! A declaration in a file → the text of a Rust file that declares the same on a struct.

use crate::ast::{Domain, Field};
use crate::parse::File;
use core::fmt::Write;

/// The struct with its derive and its default values.
pub fn export(file: &File, text: &str, defaults: &[f64]) -> String {
    let name = &file.declaration.name;
    let (generics, scalar) = match file.declaration.fields.is_empty() {
        true => ("", "f64"),
        false => ("<T = f64>", "T"),
    };
    let (attributes, fields) = (attributes(file, text), fields(file, scalar));
    let mut values = defaults.iter();
    let mut lines = String::new();
    for field in &file.declaration.fields {
        let ident = identifier(field);
        let value = match field.length {
            None => format!("{:?}", values.next().copied().unwrap_or_default()),
            Some(length) => format!("{:?}", values.by_ref().take(length).collect::<Vec<_>>()),
        };
        let _ = writeln!(lines, "            {ident}: {value},");
    }
    let capital = |field: &Field| field.name.text.chars().any(char::is_uppercase);
    let allow = match file.declaration.fields.iter().any(capital) {
        true => "#[allow(non_snake_case)]\n",
        false => "",
    };
    format!(
        "use lagrange_core::prelude::*;\n\n\
         {attributes}pub struct {name}{generics} {{\n{fields}}}\n\n\
         impl Default for {name} {{\n    fn default() -> Self {{\n        Self {{\n{lines}        }}\n    }}\n}}\n"
    )
    .replacen(
        "#[lagrange(",
        &format!("#[derive(Lagrangian, Clone, Debug)]\n{allow}#[lagrange("),
        1,
    )
}

/// The struct alone, with plain numbers.
pub fn declared_struct(file: &File, text: &str) -> String {
    let (attributes, name, fields) = (
        attributes(file, text),
        &file.declaration.name,
        fields(file, "f64"),
    );
    format!("{attributes}pub struct {name} {{\n{fields}}}\n")
}

/// Documentation and items.
fn attributes(file: &File, text: &str) -> String {
    let mut lines = documentation(&file.declaration.documentation, "");
    lines.push_str("#[lagrange(\n");
    let items: String = file
        .items
        .iter()
        .filter_map(|range| text.get(range.clone()))
        .collect();
    for line in items.trim().lines() {
        let line = format!("    {line}");
        let _ = writeln!(lines, "{}", line.trim_end());
    }
    lines.push_str(")]\n");
    lines
}

fn fields(file: &File, scalar: &str) -> String {
    file.declaration
        .fields
        .iter()
        .map(|field| one(field, scalar))
        .collect()
}

/// `#[lagrange(unit = "kg")] pub mass: T,`
fn one(field: &Field, scalar: &str) -> String {
    let unit = field.unit.as_ref().map_or("", |unit| &unit.text);
    let domain = field.domain.map_or("", Domain::word);
    let said = [
        ("unit", unit),
        ("domain", domain),
        ("tex", field.tex.as_str()),
        ("symbol", field.letter.as_str()),
    ];
    let said: Vec<String> = said
        .iter()
        .filter(|(_, text)| !text.is_empty())
        .map(|(key, text)| format!("{key} = {text:?}"))
        .collect();
    let mut lines = documentation(&field.documentation, "    ");
    if !said.is_empty() {
        let _ = writeln!(lines, "    #[lagrange({})]", said.join(", "));
    }
    let ident = identifier(field);
    let _ = match field.length {
        None => writeln!(lines, "    pub {ident}: {scalar},"),
        Some(length) => writeln!(lines, "    pub {ident}: [{scalar}; {length}],"),
    };
    lines
}

/// The name of a field, `r#type` where Rust has a meaning for it.
fn identifier(field: &Field) -> String {
    let name = &field.name.text;
    match syn::parse_str::<syn::Ident>(name) {
        Ok(_) => name.clone(),
        Err(_) => format!("r#{name}"),
    }
}

/// `/// …`
fn documentation(text: &str, indent: &str) -> String {
    let line = |line: &str| format!("{}\n", format!("{indent}/// {line}").trim_end());
    text.lines().map(line).collect()
}
