//! A sweep written down in TOML, and made again from that: what a folder holds the beginning of, and what its parts have in common.

use super::{CHUNK, Points, Sampling, Sweep};
use crate::catalogue::Catalogue;
use crate::file::ENDING;
use crate::scene::Scene;
use crate::scene_file::{self, Outputs};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What is written down. Two sweeps that say the same have the same results.
#[derive(Deserialize, Serialize)]
struct Recipe {
    /// Version of the program.
    version: String,
    /// Points of a chunk.
    chunk: usize,
    vary: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sample: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u32>,
    observe: Vec<String>,
    /// What the file of the scene declares, if it is in one: it may change.
    #[serde(skip_serializing_if = "Option::is_none")]
    declaration: Option<String>,
    /// What all runs have in common, as a scene file.
    run: String,
}

impl Sweep {
    /// The sweep in words.
    ///
    /// # Errors
    /// What cannot be written in TOML.
    pub(crate) fn recipe(&self) -> Result<String, String> {
        let run = scene_file::write(
            self.scene,
            &self.request,
            &Outputs::default(),
            Path::new(""),
        );
        let sampling = self.points.sampling;
        let recipe = Recipe {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            chunk: CHUNK,
            vary: self.points.axes.iter().map(ToString::to_string).collect(),
            sample: (sampling != Sampling::Grid).then(|| sampling.to_string()),
            seed: sampling.seed(),
            observe: self.observed.iter().map(|o| o.name.clone()).collect(),
            declaration: declaration(self.scene),
            run: run.map_err(|error| error.to_string())?,
        };
        toml::to_string(&recipe).map_err(|error| error.to_string())
    }

    /// The sweep of a scene of a catalogue that the words stand for.
    ///
    /// # Errors
    /// Why they stand for none.
    pub(super) fn from_recipe(text: &str, catalogue: &Catalogue) -> Result<Self, String> {
        let recipe: Recipe = toml::from_str(text).map_err(|error| error.message().to_owned())?;
        let file = scene_file::read(&recipe.run, Path::new(""), catalogue)
            .map_err(|mistake| mistake.to_string())?;
        let axes: Result<_, String> = recipe.vary.iter().map(|axis| axis.parse()).collect();
        let sampling = match &recipe.sample {
            None => Sampling::Grid,
            Some(sample) => sample
                .parse::<Sampling>()?
                .seeded(recipe.seed.unwrap_or_default()),
        };
        let points = Points {
            axes: axes?,
            sampling,
        };
        Sweep::new(file.scene, file.request, points, &recipe.observe)
            .map_err(|refusal| refusal.to_string())
    }
}

/// What a scene in a file declares.
fn declaration(scene: &dyn Scene) -> Option<String> {
    let in_file = scene.name().ends_with(ENDING);
    in_file.then(|| scene.derivation().declaration.to_owned())
}
