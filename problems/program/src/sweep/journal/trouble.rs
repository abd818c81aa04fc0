//! Why a journal cannot be used.

use crate::sweep::{CHUNK, Shard, Sweep};
use core::fmt;
use std::collections::BTreeSet;
use std::io;
use std::path::PathBuf;

/// Why a journal cannot be used.
#[derive(Debug)]
#[non_exhaustive]
pub enum Trouble {
    /// A file could not be read or written.
    File(PathBuf, io::Error),
    /// Results could not be kept.
    Kept(PathBuf, io::Error),
    /// The folder holds another sweep, or one of another version of the program.
    Other(PathBuf),
    /// Another process works on it.
    Busy(PathBuf),
    /// The folder holds no sweep.
    NoSweep(PathBuf, String),
    /// A chunk was there and can no longer be read.
    Damaged(PathBuf),
    /// The results take more memory than is used for that: so many bytes.
    Memory(f64),
    /// The results take more room than there is on the disk.
    Disk {
        /// Bytes that they take.
        needed: f64,
        /// Bytes that are free.
        free: f64,
    },
    /// Chunks are missing.
    Incomplete(Missing),
}

/// Chunks that are missing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// Number of runs in them.
    runs: usize,
    /// Number of all runs.
    of: usize,
    /// Shards they belong to, and whether these were begun; empty if the sweep was not shared out evenly.
    shards: Vec<(Shard, bool)>,
}

impl Missing {
    /// What `has` does not have, where shards of these were begun.
    pub(super) fn new(
        sweep: &Sweep,
        begun: &BTreeSet<Shard>,
        has: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let missing: Vec<usize> = (0..sweep.chunks()).filter(|&chunk| !has(chunk)).collect();
        let parts: BTreeSet<usize> = begun.iter().map(|shard| shard.of()).collect();
        let parts: Vec<usize> = parts.into_iter().filter(|of| *of > 1).collect();
        let shards: BTreeSet<Shard> = match parts[..] {
            [of] => missing
                .iter()
                .map(|&chunk| Shard::with(chunk, of))
                .collect(),
            _ => BTreeSet::new(),
        };
        (!missing.is_empty()).then(|| Self {
            runs: missing.iter().map(|&chunk| sweep.chunk(chunk).len()).sum(),
            of: sweep.points.len(),
            shards: shards
                .into_iter()
                .map(|shard| (shard, begun.contains(&shard)))
                .collect(),
        })
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { runs, of, shards } = self;
        write!(f, "{runs} of {of} runs are missing")?;
        if shards.is_empty() {
            return write!(f, "; run the sweep itself, without --shard, to do the rest");
        }
        let names = |begun: bool| {
            let names = shards.iter().filter(|(_, b)| *b == begun);
            let names: Vec<String> = names.map(|(shard, _)| shard.to_string()).collect();
            names.join(", ")
        };
        for (words, begun) in [
            ("shards not here: ", false),
            ("shards not finished: ", true),
        ] {
            let names = names(begun);
            if !names.is_empty() {
                write!(f, "; {words}{names}")?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trouble::File(path, error) => write!(f, "{}: {error}", path.display()),
            Trouble::Kept(path, error) => write!(
                f,
                "cannot write {}: {error}; what was done before is kept, and the same command goes on from there",
                path.display()
            ),
            Trouble::Other(path) => write!(
                f,
                "{} holds the beginning of another sweep, or of another version of this program; remove it, or choose another output",
                path.display()
            ),
            Trouble::Busy(path) => write!(
                f,
                "another process works on {}; wait for it, or choose another output",
                path.display()
            ),
            Trouble::NoSweep(path, reason) => {
                write!(
                    f,
                    "{} is not the folder of a sweep: {reason}",
                    path.display()
                )
            }
            Trouble::Damaged(path) => write!(
                f,
                "{} was changed while it was read; the same command again does the {CHUNK} runs concerned once more",
                path.display()
            ),
            Trouble::Memory(bytes) => write!(
                f,
                "the results take {bytes:.1e} bytes, too many for memory; keep them in a file with --output"
            ),
            Trouble::Disk { needed, free } => write!(
                f,
                "the results take {needed:.1e} bytes and the disk has {free:.1e} left; do fewer points, or a --shard on each of several disks"
            ),
            Trouble::Incomplete(missing) => missing.fmt(f),
        }
    }
}

impl core::error::Error for Trouble {}
