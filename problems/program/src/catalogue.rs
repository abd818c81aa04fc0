//! What a program knows by name: its scenes, and its hard cases.

use crate::file::{self, ENDING};
use crate::request::Refusal;
use crate::scene::Scene;
use crate::stability::Case;

/// What a [`Program`](crate::Program) knows.
#[derive(Default)]
pub struct Catalogue {
    /// Scenes, in the order of `lagrange list`.
    pub scenes: Vec<&'static dyn Scene>,
    /// Cases of `lagrange stability`, in the order of its table. Without any there is no such command.
    pub cases: &'static [Case],
}

impl Catalogue {
    /// Names of the scenes.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.scenes.iter().map(|scene| scene.name())
    }

    /// The scene of this name, or that of the file if it is the path of one (`….lagrange`).
    ///
    /// # Errors
    /// There is none, or what the file declares has mistakes.
    pub fn find(&self, name: &str) -> Result<&'static dyn Scene, Refusal> {
        if name.ends_with(ENDING) {
            return file::load(name).map_err(|refused| Refusal::Declaration {
                reason: refused.to_string(),
            });
        }
        let mut scenes = self.scenes.iter().copied();
        scenes
            .find(|scene| scene.name() == name)
            .ok_or_else(|| Refusal::unknown("scene", name, self.names()))
    }
}
