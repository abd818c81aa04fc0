//! Chunks that are done, kept: in memory, or in a folder from which a sweep goes on after it was killed.
//!
//! A chunk is written under another name and then renamed: it is there whole, or not at all.

use super::{CHUNK, Sweep};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Why a journal cannot be used.
#[derive(Debug)]
#[non_exhaustive]
pub enum Trouble {
    /// A file could not be read or written.
    File(PathBuf, io::Error),
    /// The folder holds another sweep.
    Other(PathBuf),
    /// Chunks are missing.
    Incomplete {
        /// How many are there.
        done: usize,
        /// How many there should be.
        chunks: usize,
    },
}

impl core::fmt::Display for Trouble {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Trouble::File(path, error) => write!(f, "{}: {error}", path.display()),
            Trouble::Other(path) => write!(
                f,
                "{} holds the beginning of another sweep; remove it, or choose another output",
                path.display()
            ),
            Trouble::Incomplete { done, chunks } => write!(
                f,
                "{done} of {chunks} chunks are done; run the other shards, or the sweep itself, first"
            ),
        }
    }
}

impl core::error::Error for Trouble {}

/// What has been done of a sweep.
pub struct Journal {
    keep: Keep,
    width: usize,
}

enum Keep {
    Memory(Mutex<Vec<Option<Vec<f64>>>>),
    Folder(PathBuf),
}

impl Journal {
    /// A journal that is lost with the process.
    pub fn in_memory(sweep: &Sweep) -> Self {
        Self {
            keep: Keep::Memory(Mutex::new(vec![None; sweep.chunks()])),
            width: sweep.width(),
        }
    }

    /// The journal in a folder, which is made if it is not there.
    ///
    /// # Errors
    /// It holds another sweep, or cannot be written.
    pub fn in_folder(sweep: &Sweep, folder: &Path) -> Result<Self, Trouble> {
        fs::create_dir_all(folder).map_err(|e| Trouble::File(folder.to_owned(), e))?;
        let path = folder.join("sweep.txt");
        let signature = sweep.signature();
        match fs::read_to_string(&path) {
            Ok(known) if known == signature => {}
            Ok(_) => return Err(Trouble::Other(folder.to_owned())),
            Err(_) => replace(&path, signature.as_bytes())?,
        }
        Ok(Self {
            keep: Keep::Folder(folder.to_owned()),
            width: sweep.width(),
        })
    }

    /// Whether a chunk is done.
    pub fn has(&self, sweep: &Sweep, chunk: usize) -> bool {
        match &self.keep {
            Keep::Memory(chunks) => chunks.lock().is_ok_and(|chunks| chunks[chunk].is_some()),
            Keep::Folder(folder) => {
                let bytes = sweep.chunk(chunk).len() * self.width * 8;
                fs::metadata(file(folder, chunk)).is_ok_and(|file| file.len() == bytes as u64)
            }
        }
    }

    /// Keeps a chunk.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn put(&self, chunk: usize, rows: Vec<f64>) -> Result<(), Trouble> {
        match &self.keep {
            Keep::Memory(chunks) => {
                if let Ok(mut chunks) = chunks.lock() {
                    chunks[chunk] = Some(rows);
                }
                Ok(())
            }
            Keep::Folder(folder) => {
                let bytes: Vec<u8> = rows.iter().flat_map(|x| x.to_le_bytes()).collect();
                replace(&file(folder, chunk), &bytes)
            }
        }
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
        let chunks = sweep.chunks();
        let done = (0..chunks).filter(|&chunk| self.has(sweep, chunk)).count();
        if done < chunks {
            return Err(Trouble::Incomplete { done, chunks }.into());
        }
        for chunk in 0..chunks {
            let rows = match &self.keep {
                Keep::Memory(chunks) => {
                    let chunks = chunks.lock().ok();
                    chunks
                        .and_then(|chunks| chunks[chunk].clone())
                        .unwrap_or_default()
                }
                Keep::Folder(folder) => {
                    let path = file(folder, chunk);
                    let bytes = fs::read(&path).map_err(|e| Trouble::File(path, e))?;
                    let (numbers, _) = bytes.as_chunks::<8>();
                    numbers
                        .iter()
                        .map(|bytes| f64::from_le_bytes(*bytes))
                        .collect()
                }
            };
            each(chunk * CHUNK, &rows)?;
        }
        Ok(())
    }

    /// Removes the folder, when what is in it is no longer needed.
    ///
    /// # Errors
    /// It cannot be removed.
    pub fn remove(self) -> Result<(), Trouble> {
        match self.keep {
            Keep::Memory(_) => Ok(()),
            Keep::Folder(folder) => {
                fs::remove_dir_all(&folder).map_err(|e| Trouble::File(folder, e))
            }
        }
    }
}

fn file(folder: &Path, chunk: usize) -> PathBuf {
    folder.join(format!("{chunk:08}"))
}

/// Writes a file so that it is there whole, or not at all.
fn replace(path: &Path, bytes: &[u8]) -> Result<(), Trouble> {
    // Two processes may write the same chunk: each has a name of its own for it, and what they write is the same.
    let unfinished = path.with_extension(format!("{}.unfinished", std::process::id()));
    fs::write(&unfinished, bytes)
        .and_then(|()| fs::rename(&unfinished, path))
        .map_err(|e| Trouble::File(path.to_owned(), e))
}
