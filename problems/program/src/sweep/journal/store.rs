//! One file of chunks. Each has its place in it, and a seal that only rows which were written whole fit:
//!
//! ```text
//! seal of the shard's chunk 0 │ its rows │ seal of chunk 1 │ its rows │ …       8 bytes, 1024 rows; numbers in little endian
//! ```
//!
//! Whatever happens to a file — a process killed while it writes, a full disk, a flipped bit, a copy that broke off — the chunks it
//! happens to are not there, and the others are.

use crate::sweep::{CHUNK, Shard, Sweep};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use twox_hash::XxHash64;

/// Bytes of a seal.
const SEAL: usize = 8;

/// A file with the chunks of a shard.
pub(super) struct Store {
    file: File,
    shard: Shard,
}

impl Store {
    pub(super) fn new(file: File, shard: Shard) -> Self {
        Self { file, shard }
    }

    pub(super) fn shard(&self) -> Shard {
        self.shard
    }

    /// Calls `found` with each chunk that is there whole.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn scan(&mut self, sweep: &Sweep, mut found: impl FnMut(usize)) -> io::Result<()> {
        let length = self.file.metadata()?.len();
        for index in 0.. {
            let chunk = self.shard.chunk(index);
            if self.place(sweep, chunk) >= length || chunk >= sweep.chunks() {
                break;
            }
            if self.read(sweep, chunk)?.is_some() {
                found(chunk);
            }
        }
        Ok(())
    }

    /// The rows of a chunk, if they are there as they were written.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn read(&mut self, sweep: &Sweep, chunk: usize) -> io::Result<Option<Vec<f64>>> {
        let mut bytes = vec![0; SEAL + sweep.chunk(chunk).len() * sweep.width() * 8];
        self.file.seek(SeekFrom::Start(self.place(sweep, chunk)))?;
        match self.file.read_exact(&mut bytes) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(None),
            other => other?,
        }
        let (kept, rows) = bytes.split_at(SEAL);
        if kept != seal(chunk, rows) {
            return Ok(None);
        }
        let (numbers, _) = rows.as_chunks::<8>();
        Ok(Some(
            numbers.iter().map(|x| f64::from_le_bytes(*x)).collect(),
        ))
    }

    /// Writes the rows of a chunk at their place.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(super) fn write(&mut self, sweep: &Sweep, chunk: usize, rows: &[f64]) -> io::Result<()> {
        let rows: Vec<u8> = rows.iter().flat_map(|x| x.to_le_bytes()).collect();
        let bytes = [&seal(chunk, &rows)[..], &rows].concat();
        self.file.seek(SeekFrom::Start(self.place(sweep, chunk)))?;
        self.file.write_all(&bytes)
    }

    /// Where a chunk of the shard begins.
    fn place(&self, sweep: &Sweep, chunk: usize) -> u64 {
        let index = chunk / self.shard.of();
        index as u64 * (SEAL + CHUNK * sweep.width() * 8) as u64
    }
}

/// A number that other bytes, or these as another chunk, hardly ever have. Where nothing was written there is zero, which is the seal
/// of nothing.
fn seal(chunk: usize, rows: &[u8]) -> [u8; SEAL] {
    XxHash64::oneshot(chunk as u64, rows).max(1).to_le_bytes()
}
