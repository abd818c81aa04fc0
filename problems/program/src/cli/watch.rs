//! `--watch`: the same again whenever a file changes.

use super::{Trouble, complain, terminal};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Time between two looks at the files.
const PAUSE: Duration = Duration::from_millis(200);

/// Does `work` once, or, to be watched, again and again whenever one of the files that `names` stand for changes.
pub(super) fn watched(
    watch: bool,
    names: &[String],
    work: impl Fn() -> Result<(), Trouble>,
) -> Result<(), Trouble> {
    if !watch {
        return work();
    }
    if !names.iter().any(|name| Path::new(name).is_file()) {
        return Err(Trouble::usage("nothing to watch: no scene is a file"));
    }
    terminal::end_at_once("the file is not watched any more");
    loop {
        let files: Vec<PathBuf> = names.iter().flat_map(|name| files(name)).collect();
        let before = changed(&files);
        if let Err(trouble) = work() {
            complain(&trouble);
        }
        while changed(&files) == before {
            std::thread::sleep(PAUSE);
        }
    }
}

/// When each file was changed; a file that is being replaced is not there for a moment.
fn changed(files: &[PathBuf]) -> Vec<Option<SystemTime>> {
    let changed = |file: &PathBuf| file.metadata().and_then(|data| data.modified()).ok();
    files.iter().map(changed).collect()
}

/// The file itself, and the declaration that a scene file names.
fn files(name: &str) -> Vec<PathBuf> {
    let named = || {
        let text = fs::read_to_string(name).ok()?;
        let table: toml::Table = text.parse().ok()?;
        Some(PathBuf::from(table.get("scene")?.as_str()?))
    };
    let named = name.ends_with(".toml").then(named).flatten();
    [PathBuf::from(name)].into_iter().chain(named).collect()
}
