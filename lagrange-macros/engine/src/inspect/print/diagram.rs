//! The graph of the modes, for Mermaid and for Graphviz.

use crate::inspect::{Derivation, Switch};

/// Edges between one pair of modes, with all their labels.
fn edges(derivation: &Derivation) -> Vec<(usize, usize, String)> {
    let mut edges: Vec<(usize, usize, String)> = Vec::new();
    for Switch { from, to, label } in &derivation.switches {
        edges.push((*from, *to, label.clone()));
    }
    edges
}

/// A flowchart of Mermaid: modes, and what leads from one to another.
pub fn mermaid(derivation: &Derivation) -> String {
    let mut out = String::from("flowchart LR\n");
    for (i, mode) in derivation.modes.iter().enumerate() {
        out.push_str(&format!("    m{i}[\"{}\"]\n", mode.name.replace('"', "'")));
    }
    for (from, to, label) in edges(derivation) {
        out.push_str(&format!("    m{from} -->|\"{label}\"| m{to}\n"));
    }
    out
}

/// A directed graph of Graphviz.
pub fn dot(derivation: &Derivation) -> String {
    let mut out = format!("digraph \"{}\" {{\n", derivation.name);
    out.push_str("    rankdir=LR;\n    node [shape=box];\n");
    for (i, mode) in derivation.modes.iter().enumerate() {
        out.push_str(&format!("    m{i} [label=\"{}\"];\n", mode.name));
    }
    for (from, to, label) in edges(derivation) {
        out.push_str(&format!("    m{from} -> m{to} [label=\"{label}\"];\n"));
    }
    out.push_str("}\n");
    out
}
