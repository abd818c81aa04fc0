//! Which run of a scene is meant: arguments that several commands share.

use super::values::{named, positive};
use clap::Args;
use lagrange_problems::request::Request;

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
    /// End of the run, s [default: the scene's].
    #[arg(long, value_name = "T", value_parser = positive, allow_hyphen_values = true)]
    until: Option<f64>,
}

impl Course {
    /// A request for this run, everything else as usual.
    pub(super) fn request(self) -> Request {
        Request {
            parameters: self.set,
            from: self.from,
            start: self.start,
            until: self.until,
            ..Request::default()
        }
    }
}
