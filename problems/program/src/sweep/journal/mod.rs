//! Chunks that are done, kept: in memory, or in a folder from which a sweep goes on after it was killed.
//!
//! ```text
//! FILE.part/sweep.toml     the sweep in words
//! FILE.part/lock           held by who works on all of it; shared by who works on a shard
//! FILE.part/rows-3-of-8    what is done of a shard; rows-1-of-1: of the sweep as a whole
//! ```

mod store;
mod trouble;

pub use trouble::{Missing, Trouble};

use super::{CHUNK, Shard, Sweep};
use crate::catalogue::Catalogue;
use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use store::Store;

/// How the name of a file ends that is not yet whole.
const UNFINISHED: &str = ".unfinished";

/// Most bytes of results that are kept in memory.
const MOST_IN_MEMORY: f64 = 2e9;

/// What has been done of a sweep.
pub struct Journal {
    keep: Keep,
}

enum Keep {
    Memory(Mutex<Vec<Option<Vec<f64>>>>),
    Folders(Mutex<Folders>),
}

/// Files of chunks.
struct Folders {
    stores: Vec<(PathBuf, Store)>,
    /// Per chunk: the store that has it.
    found: Vec<Option<usize>>,
    /// The store to write to is the last, if there is one; and who works on the folder.
    writing: Option<Writing>,
}

/// What is held while a folder is written to.
struct Writing {
    folder: PathBuf,
    _lock: File,
}

impl Journal {
    /// A journal that is lost with the process.
    ///
    /// # Errors
    /// The results take more memory than is used for that.
    pub fn in_memory(sweep: &Sweep) -> Result<Self, Trouble> {
        let bytes = 8.0 * sweep.points.size() * sweep.width() as f64;
        if bytes > MOST_IN_MEMORY {
            return Err(Trouble::Memory(bytes));
        }
        Ok(Self {
            keep: Keep::Memory(Mutex::new(vec![None; sweep.chunks()])),
        })
    }

    /// The journal in a folder, which is made if it is not there, to work on a shard of the sweep.
    ///
    /// # Errors
    /// It holds another sweep, another process works on it, it cannot be written, or the disk is too small.
    pub fn in_folder(sweep: &Sweep, folder: &Path, shard: Shard) -> Result<Self, Trouble> {
        let cannot = |path: &Path| {
            let path = path.to_owned();
            move |error| Trouble::File(path, error)
        };
        fits(sweep, folder, shard)?;
        fs::create_dir_all(folder).map_err(cannot(folder))?;
        let path = folder.join("lock");
        let lock = open(&path)?;
        let all = shard == Shard::WHOLE;
        hold(&lock, all).map_err(|()| Trouble::Busy(folder.to_owned()))?;
        let path = folder.join("sweep.toml");
        let recipe = sweep
            .recipe()
            .map_err(|reason| Trouble::NoSweep(folder.to_owned(), reason))?;
        match fs::read_to_string(&path) {
            Ok(known) if known == recipe => {}
            Ok(_) => return Err(Trouble::Other(folder.to_owned())),
            Err(_) => match replace(&path, recipe.as_bytes()) {
                // Another shard on another machine was faster.
                Err(_) if fs::read_to_string(&path).is_ok_and(|known| known == recipe) => {}
                other => other.map_err(cannot(&path))?,
            },
        }
        let mut folders = Folders::new(sweep);
        let ours = name(shard);
        for (path, shard) in files(folder)? {
            if !path.ends_with(&ours) {
                folders.add(sweep, path, shard)?;
            }
        }
        let path = folder.join(ours);
        let file = open(&path)?;
        hold(&file, true).map_err(|()| Trouble::Busy(folder.to_owned()))?;
        folders.take(sweep, path, file, shard)?;
        folders.writing = Some(Writing {
            folder: folder.to_owned(),
            _lock: lock,
        });
        Ok(Self {
            keep: Keep::Folders(Mutex::new(folders)),
        })
    }

    /// What is in folders of the same sweep, of a scene of a catalogue, to be read; and the sweep.
    ///
    /// # Errors
    /// They hold no sweep, or not the same; they cannot be read.
    pub fn gather(folders: &[PathBuf], catalogue: &Catalogue) -> Result<(Sweep, Self), Trouble> {
        let mut gathered: Option<(String, Sweep, Folders)> = None;
        for folder in folders {
            let none = |reason: String| Trouble::NoSweep(folder.clone(), reason);
            let path = folder.join("sweep.toml");
            let text = fs::read_to_string(&path)
                .map_err(|error| none(format!("cannot read its sweep.toml: {error}")))?;
            let (_, sweep, found) = match &mut gathered {
                Some((first, _, _)) if *first != text => {
                    return Err(Trouble::Other(folder.clone()));
                }
                Some(same) => same,
                none_yet => {
                    let sweep = Sweep::from_recipe(&text, catalogue).map_err(none)?;
                    // Made by a version of the program that did it another way.
                    if sweep.recipe().map_err(none)? != text {
                        return Err(Trouble::Other(folder.clone()));
                    }
                    let found = Folders::new(&sweep);
                    none_yet.insert((text, sweep, found))
                }
            };
            for (path, shard) in files(folder)? {
                found.add(sweep, path, shard)?;
            }
        }
        match gathered {
            None => Err(Trouble::NoSweep(PathBuf::new(), "none is given".to_owned())),
            Some((_, sweep, folders)) => Ok((
                sweep,
                Self {
                    keep: Keep::Folders(Mutex::new(folders)),
                },
            )),
        }
    }

    /// Whether a chunk is done.
    pub fn has(&self, _: &Sweep, chunk: usize) -> bool {
        match &self.keep {
            Keep::Memory(chunks) => locked(chunks)[chunk].is_some(),
            Keep::Folders(folders) => locked(folders).found[chunk].is_some(),
        }
    }

    /// Keeps a chunk.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn put(&self, sweep: &Sweep, chunk: usize, rows: Vec<f64>) -> Result<(), Trouble> {
        match &self.keep {
            Keep::Memory(chunks) => locked(chunks)[chunk] = Some(rows),
            Keep::Folders(folders) => {
                let folders = &mut *locked(folders);
                let last = folders.stores.len().saturating_sub(1);
                if let Some((path, store)) = folders.stores.last_mut() {
                    store
                        .write(sweep, chunk, &rows)
                        .map_err(|error| Trouble::Kept(path.clone(), error))?;
                    folders.found[chunk] = Some(last);
                }
            }
        }
        Ok(())
    }

    /// What is missing, if anything is.
    pub fn missing(&self, sweep: &Sweep) -> Option<Missing> {
        let begun: BTreeSet<Shard> = match &self.keep {
            Keep::Memory(_) => BTreeSet::new(),
            Keep::Folders(folders) => {
                let folders = locked(folders);
                folders
                    .stores
                    .iter()
                    .map(|(_, store)| store.shard())
                    .collect()
            }
        };
        Missing::new(sweep, &begun, |chunk| self.has(sweep, chunk))
    }

    /// Calls `each` with the chunks in order: number of the first point, and the rows.
    ///
    /// # Errors
    /// A chunk is missing or cannot be read; those of `each`.
    pub fn read<E: From<Trouble>>(
        &self,
        sweep: &Sweep,
        mut each: impl FnMut(usize, &[f64]) -> Result<(), E>,
    ) -> Result<(), E> {
        if let Some(missing) = self.missing(sweep) {
            return Err(Trouble::Incomplete(missing).into());
        }
        for chunk in 0..sweep.chunks() {
            let rows = match &self.keep {
                Keep::Memory(chunks) => locked(chunks)[chunk].clone().unwrap_or_default(),
                Keep::Folders(folders) => locked(folders).rows(sweep, chunk)?,
            };
            each(chunk * CHUNK, &rows)?;
        }
        Ok(())
    }

    /// Removes the folder that was written to, when what is in it is no longer needed.
    ///
    /// # Errors
    /// It cannot be removed.
    pub fn remove(self) -> Result<(), Trouble> {
        let Keep::Folders(folders) = self.keep else {
            return Ok(());
        };
        let folders = folders.into_inner().unwrap_or_else(PoisonError::into_inner);
        // The lock is let go when nothing is left to be locked.
        let Some(Writing { folder, _lock }) = folders.writing else {
            return Ok(());
        };
        let gone = |path: &Path| {
            fs::remove_file(path).map_err(|error| Trouble::File(path.to_owned(), error))
        };
        let unfinished = entries(&folder)?.into_iter().filter(|path| {
            let name = path.file_name().and_then(|name| name.to_str());
            name.is_some_and(|name| name.starts_with("sweep.") && name.ends_with(UNFINISHED))
        });
        let rows = files(&folder)?.into_iter().map(|(path, _)| path);
        for path in rows.chain(unfinished) {
            gone(&path)?;
        }
        gone(&folder.join("sweep.toml"))?;
        gone(&folder.join("lock"))?;
        // What else somebody put there stays.
        let _ = fs::remove_dir(&folder);
        Ok(())
    }
}

impl Folders {
    fn new(sweep: &Sweep) -> Self {
        Self {
            stores: Vec::new(),
            found: vec![None; sweep.chunks()],
            writing: None,
        }
    }

    /// Adds what is in a file.
    fn add(&mut self, sweep: &Sweep, path: PathBuf, shard: Shard) -> Result<(), Trouble> {
        let file = File::open(&path).map_err(|error| Trouble::File(path.clone(), error))?;
        self.take(sweep, path, file, shard)
    }

    fn take(
        &mut self,
        sweep: &Sweep,
        path: PathBuf,
        file: File,
        shard: Shard,
    ) -> Result<(), Trouble> {
        let mut store = Store::new(file, shard);
        let number = self.stores.len();
        let found = &mut self.found;
        store
            .scan(sweep, |chunk| found[chunk] = Some(number))
            .map_err(|error| Trouble::File(path.clone(), error))?;
        self.stores.push((path, store));
        Ok(())
    }

    /// The rows of a chunk that was found.
    fn rows(&mut self, sweep: &Sweep, chunk: usize) -> Result<Vec<f64>, Trouble> {
        let store = self.found[chunk].and_then(|number| self.stores.get_mut(number));
        let Some((path, store)) = store else {
            return Ok(Vec::new());
        };
        store
            .read(sweep, chunk)
            .map_err(|error| Trouble::File(path.clone(), error))?
            .ok_or_else(|| Trouble::Damaged(path.clone()))
    }
}

/// What a lock guards, also after a panic elsewhere: it is never left half changed.
fn locked<T>(guarded: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    guarded.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Opens a file to be read and written, as it is.
fn open(path: &Path) -> Result<File, Trouble> {
    let mut options = OpenOptions::new();
    let options = options.read(true).write(true).create(true).truncate(false);
    options
        .open(path)
        .map_err(|error| Trouble::File(path.to_owned(), error))
}

/// Holds a file as long as it is open, for itself or with others; it is let go also if the process is killed.
fn hold(file: &File, alone: bool) -> Result<(), ()> {
    let held = match alone {
        true => file.try_lock(),
        false => file.try_lock_shared(),
    };
    match held {
        Err(TryLockError::WouldBlock) => Err(()),
        // A file system that knows no locks: the user has to take care.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// Name of the file of a shard.
fn name(shard: Shard) -> String {
    format!("rows-{shard}").replace('/', "-of-")
}

/// The files of shards in a folder, by shard.
fn files(folder: &Path) -> Result<Vec<(PathBuf, Shard)>, Trouble> {
    let mut files: Vec<_> = entries(folder)?
        .into_iter()
        .filter_map(|path| {
            let name = path.file_name()?.to_str()?.strip_prefix("rows-")?;
            let shard = name.replace("-of-", "/").parse().ok()?;
            Some((path, shard))
        })
        .collect();
    files.sort();
    Ok(files)
}

/// What is in a folder.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, Trouble> {
    let paths =
        fs::read_dir(folder).and_then(|entries| entries.map(|entry| Ok(entry?.path())).collect());
    paths.map_err(|error| Trouble::File(folder.to_owned(), error))
}

/// Writes a file so that it is there whole, or not at all.
fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    // Shards may begin at the same time: each has a name of its own for it, and what they write is the same.
    // One that was killed before the second step leaves it; it goes with the folder.
    let unfinished = path.with_extension(format!("{}{UNFINISHED}", std::process::id()));
    fs::write(&unfinished, bytes)?;
    fs::rename(&unfinished, path)
}

/// Refuses what has no room on the disk: what is kept of a shard and, of a sweep as a whole, the file that is made of it.
fn fits(sweep: &Sweep, folder: &Path, shard: Shard) -> Result<(), Trouble> {
    let numbers = match shard == Shard::WHOLE {
        true => 2 * sweep.width() + sweep.points.axes.len(),
        false => sweep.width(),
    };
    let needed = 8.0 * sweep.points.size() / shard.of() as f64 * numbers as f64;
    let there: u64 = fs::read_dir(folder).map_or(0, |files| {
        let lengths = files.flatten().flat_map(|file| file.metadata());
        lengths.map(|known| known.len()).sum()
    });
    let above = folder
        .ancestors()
        .find(|above| above.is_dir())
        .unwrap_or(Path::new("."));
    match fs4::available_space(above) {
        Ok(free) if needed > there as f64 + free as f64 => Err(Trouble::Disk {
            needed,
            free: free as f64,
        }),
        // Where nobody knows, writing will tell.
        _ => Ok(()),
    }
}
