//! `lagrange list`: what there is to run.

use super::run_args::scene;
use super::{Trouble, print};
use crate::catalogue::Catalogue;
use crate::scene::Scene;
use clap::Args;
use lagrange_core::system::Parameter;
use std::io::{self, Write};

/// List the scenes, or everything that one of them can be given.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange list
  lagrange list mass-on-wheel")]
pub(super) struct List {
    /// A scene (or declaration, or scene file), to see its parameters, coordinates, starts and forces.
    scene: Option<String>,
}

impl List {
    pub(super) fn execute(&self, catalogue: &Catalogue) -> Result<(), Trouble> {
        match &self.scene {
            None => print(|out| all(catalogue, out)),
            Some(name) => {
                let scene = scene(name, catalogue)?.scene;
                print(|out| one(scene, out))
            }
        }
    }
}

fn all(catalogue: &Catalogue, out: &mut dyn Write) -> io::Result<()> {
    let width = catalogue.names().map(str::len).max().unwrap_or(0);
    let mut scenes = catalogue.scenes.iter();
    scenes.try_for_each(|scene| writeln!(out, "{:width$}  {}", scene.name(), scene.summary()))
}

fn one(scene: &dyn Scene, out: &mut dyn Write) -> io::Result<()> {
    let description = scene.description();
    writeln!(out, "{}\n", scene.name())?;
    for line in description.documentation.trim().lines() {
        writeln!(out, "  {}", line.trim_end())?;
    }
    writeln!(out, "\nparameters (--set name=value)")?;
    let widest = |text: fn(&Parameter) -> &str| {
        let parameters = description.parameters.iter();
        let widths = parameters.map(|parameter| text(parameter).chars().count());
        widths.max().unwrap_or(0)
    };
    let (width, units) = (widest(|p| p.name), widest(|p| p.unit));
    for (parameter, default) in description.parameters.iter().zip(scene.defaults()) {
        let said = parameter.documentation.trim().lines().next();
        let line = format!(
            "  {:width$} = {default:<6}  {:units$}  {}",
            parameter.name,
            parameter.unit,
            said.unwrap_or_default().trim()
        );
        writeln!(out, "{}", line.trim_end())?;
    }
    let line = |out: &mut dyn Write, title: &str, names: Vec<&str>| match names.is_empty() {
        true => Ok(()),
        false => writeln!(out, "{title}\n  {}", names.join(", ")),
    };
    line(
        out,
        "coordinates (--start name=value, --start \"der(name)=value\")",
        names(description.coordinates, |c| c.name),
    )?;
    line(
        out,
        "starts (--from NAME; the first is the default)",
        description.starts.to_vec(),
    )?;
    let constraints = description.constraints.iter();
    let constraints = constraints.filter(|constraint| constraint.attitude.is_none());
    line(out, "constraints", constraints.map(|c| c.name).collect())?;
    line(out, "contacts", names(description.contacts, |c| c.name))?;
    line(out, "frictions", names(description.frictions, |f| f.name))?;
    line(out, "forces", names(description.forces, |f| f.name))?;
    line(
        out,
        "dissipations",
        names(description.dissipations, |d| d.name),
    )?;
    line(out, "stops", names(description.stops, |s| s.name))?;
    line(out, "marks", names(description.marks, |m| m.name))?;
    line(
        out,
        "outputs (run --show NAME, sweep --observe NAME)",
        names(description.observes, |o| o.name),
    )?;
    let results = scene.results().iter().map(|(name, _)| *name);
    line(out, "results (sweep --observe NAME)", results.collect())?;
    writeln!(
        out,
        "ends at t = {} s if nothing ends it before (--until)",
        scene.until()
    )
}

fn names<T>(items: &'static [T], name: impl Fn(&'static T) -> &'static str) -> Vec<&'static str> {
    items.iter().map(name).collect()
}
