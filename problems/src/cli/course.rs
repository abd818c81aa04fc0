//! Which run of a scene is meant: arguments that several commands share.

use super::Trouble;
use super::values::{named, positive};
use clap::Args;
use lagrange_problems::catalogue::find;
use lagrange_problems::request::Request;
use lagrange_problems::scene_file::{self, Outputs, SceneFile};

/// The scene of this name, or what a file says if it is the path of one (`….toml`).
pub(super) fn scene(name: &str) -> Result<SceneFile, Trouble> {
    if !name.ends_with(".toml") {
        return Ok(SceneFile {
            scene: find(name).map_err(Trouble::usage)?,
            request: Request::default(),
            outputs: Outputs::default(),
        });
    }
    let text = std::fs::read_to_string(name)
        .map_err(|error| Trouble::usage(format_args!("cannot read {name}: {error}")))?;
    scene_file::read(&text).map_err(|mistake| Trouble::usage(format_args!("{name}:{mistake}")))
}

#[derive(Args)]
pub(super) struct Course {
    /// Set a parameter; may be repeated.
    #[arg(long, value_name = "NAME=VALUE", value_parser = named, allow_hyphen_values = true)]
    set: Vec<(String, f64)>,
    /// The named start to begin from [default: the first].
    #[arg(long, value_name = "START")]
    from: Option<String>,
    /// Hold a coordinate (theta=0.1) or velocity ("der(theta)=2") at the start; the others follow from the named
    /// start: constraints hold, contacts closed there stay closed, slips zero there stay zero. May be repeated.
    #[arg(long, value_name = "NAME=VALUE", value_parser = named, allow_hyphen_values = true)]
    start: Vec<(String, f64)>,
    /// Switch an effect on that the scene file has switched off; may be repeated.
    #[arg(long, value_name = "ITEM")]
    with: Vec<String>,
    /// Leave an item of the declaration out: a force, a friction, a contact with all that hangs on it, a stop. It costs
    /// nothing then. May be repeated.
    #[arg(long, value_name = "ITEM")]
    without: Vec<String>,
    /// End of the run, s [default: the scene's].
    #[arg(long, value_name = "T", value_parser = positive, allow_hyphen_values = true)]
    until: Option<f64>,
}

impl Course {
    /// This run: what the arguments leave open is as in `base`.
    pub(super) fn request(&self, base: Request) -> Request {
        let effects = self.without.iter().map(|name| (name.clone(), false));
        let effects = effects.chain(self.with.iter().map(|name| (name.clone(), true)));
        Request {
            parameters: instead(base.parameters, &self.set),
            from: self.from.clone().or(base.from),
            effects: base.effects.into_iter().chain(effects).collect(),
            start: instead(base.start, &self.start),
            until: self.until.or(base.until),
            ..base
        }
    }
}

/// The values of `base`, but for those `given`.
fn instead(base: Vec<(String, f64)>, given: &[(String, f64)]) -> Vec<(String, f64)> {
    let stays = |(name, _): &(String, f64)| given.iter().all(|(other, _)| other != name);
    let base = base.into_iter().filter(stays);
    base.chain(given.iter().cloned()).collect()
}
