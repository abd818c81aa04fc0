//! Apache Parquet: rows of numbers and texts, some of which may be missing (null), in groups.
//!
//! ```text
//! "PAR1"  group …  metadata  length of the metadata  "PAR1"
//! group:  of each column one page: header, levels, values
//! ```
//!
//! Values are plain and not compressed. A level says of a row whether it has a value.
//!
//! Reference: Apache Parquet, "File format" and `parquet.thrift`, where the numbers of fields and members are from.

use super::Kind;
use super::thrift::{Struct, varint};
use std::io::{self, Write};
use std::mem;

/// Rows of a group.
const GROUP: usize = 1 << 16;

/// What a file begins and ends with.
const MAGIC: &[u8] = b"PAR1";

const DOUBLE: i32 = 5;
const BYTE_ARRAY: i32 = 6;
const REQUIRED: i32 = 0;
const OPTIONAL: i32 = 1;
const PLAIN: i32 = 0;
const RUN_LENGTHS: i32 = 3;
const UNCOMPRESSED: i32 = 0;
const DATA_PAGE: i32 = 0;
/// The text of a column in UTF-8, as older readers are told.
const UTF8: i32 = 0;

/// Rows on their way into a file.
pub(super) struct Rows<W: Write> {
    out: W,
    /// Bytes written so far.
    written: usize,
    columns: Vec<Column>,
    /// Rows that are not written yet.
    waiting: usize,
    groups: Vec<Group>,
    metadata: Vec<(String, String)>,
}

/// What is not written yet of a column.
struct Column {
    name: String,
    kind: Kind,
    /// The values that there are, as the page has them.
    values: Vec<u8>,
    /// Rows in succession of which all or none have a value.
    runs: Vec<(usize, bool)>,
}

/// A group that is written.
struct Group {
    rows: usize,
    /// Of each column, where its page begins and its length in bytes.
    pages: Vec<(usize, usize)>,
}

impl<W: Write> Rows<W> {
    /// A file with these columns, and texts by key that readers show as metadata of the file.
    ///
    /// # Errors
    /// Those of `out`, here and below.
    pub(super) fn new(
        mut out: W,
        columns: &[(&str, Kind)],
        metadata: &[(&str, &str)],
    ) -> io::Result<Self> {
        out.write_all(MAGIC)?;
        let column = |&(name, kind): &(&str, Kind)| Column {
            name: name.to_owned(),
            kind,
            values: Vec::new(),
            runs: Vec::new(),
        };
        let pair = |&(key, text): &(&str, &str)| (key.to_owned(), text.to_owned());
        Ok(Self {
            out,
            written: MAGIC.len(),
            columns: columns.iter().map(column).collect(),
            waiting: 0,
            groups: Vec::new(),
            metadata: metadata.iter().map(pair).collect(),
        })
    }

    /// A number in a column of this row.
    pub(super) fn number(&mut self, column: usize, number: f64) {
        let column = &mut self.columns[column];
        column.level(true);
        column.values.extend(number.to_le_bytes());
    }

    /// A text in a column of this row.
    pub(super) fn text(&mut self, column: usize, text: &str) {
        let column = &mut self.columns[column];
        column.level(true);
        column.values.extend((text.len() as u32).to_le_bytes());
        column.values.extend(text.as_bytes());
    }

    /// Nothing in a column of this row.
    pub(super) fn nothing(&mut self, column: usize) {
        self.columns[column].level(false);
    }

    /// Ends a row.
    pub(super) fn end_row(&mut self) -> io::Result<()> {
        self.waiting += 1;
        match self.waiting {
            GROUP => self.write_group(),
            _ => Ok(()),
        }
    }

    /// Writes what is left.
    pub(super) fn close(mut self) -> io::Result<()> {
        if self.waiting > 0 {
            self.write_group()?;
        }
        let metadata = self.metadata().end();
        self.out.write_all(&metadata)?;
        self.out.write_all(&length(metadata.len())?.to_le_bytes())?;
        self.out.write_all(MAGIC)
    }

    fn write_group(&mut self) -> io::Result<()> {
        let rows = mem::take(&mut self.waiting);
        let mut pages = Vec::with_capacity(self.columns.len());
        for column in &mut self.columns {
            let levels = column.levels()?;
            let body = length(levels.len() + column.values.len())?;
            let header = page_header(length(rows)?, body).end();
            for part in [&header, &levels, &column.values] {
                self.out.write_all(part)?;
            }
            let size = header.len() + levels.len() + column.values.len();
            pages.push((self.written, size));
            self.written += size;
            column.values.clear();
            column.runs.clear();
        }
        self.groups.push(Group { rows, pages });
        Ok(())
    }

    /// `FileMetaData`
    fn metadata(&self) -> Struct {
        let root = Struct::default()
            .text(4, "rows")
            .i32(5, self.columns.len() as i32);
        let schema: Vec<_> = [root]
            .into_iter()
            .chain(self.columns.iter().map(Column::schema))
            .collect();
        let groups = self.groups.iter().map(|group| self.group(group));
        let pair = |(key, text): &(String, String)| Struct::default().text(1, key).text(2, text);
        let rows: usize = self.groups.iter().map(|group| group.rows).sum();
        Struct::default()
            .i32(1, 1)
            .list(2, schema.into_iter())
            .i64(3, rows as i64)
            .list(4, groups)
            .list(5, self.metadata.iter().map(pair))
            .text(6, concat!("lagrange ", env!("CARGO_PKG_VERSION")))
    }

    /// `RowGroup`
    fn group(&self, group: &Group) -> Struct {
        let chunks = self.columns.iter().zip(&group.pages);
        let chunk = |(column, &(start, size)): (&Column, &(usize, usize))| {
            let metadata = Struct::default()
                .i32(1, column.physical())
                .i32s(2, &[PLAIN, RUN_LENGTHS])
                .texts(3, &[&column.name])
                .i32(4, UNCOMPRESSED)
                .i64(5, group.rows as i64)
                .i64(6, size as i64)
                .i64(7, size as i64)
                .i64(9, start as i64);
            Struct::default().i64(2, start as i64).nested(3, metadata)
        };
        let size: usize = group.pages.iter().map(|&(_, size)| size).sum();
        Struct::default()
            .list(1, chunks.map(chunk))
            .i64(2, size as i64)
            .i64(3, group.rows as i64)
    }
}

impl Column {
    fn level(&mut self, present: bool) {
        match self.runs.last_mut() {
            Some((rows, same)) if *same == present => *rows += 1,
            _ => self.runs.push((1, present)),
        }
    }

    fn is_optional(&self) -> bool {
        matches!(self.kind, Kind::MaybeNumber | Kind::MaybeText)
    }

    /// `Type`
    fn physical(&self) -> i32 {
        match self.kind {
            Kind::Number | Kind::MaybeNumber => DOUBLE,
            Kind::Text | Kind::MaybeText => BYTE_ARRAY,
        }
    }

    /// `SchemaElement`
    fn schema(&self) -> Struct {
        let repetition = if self.is_optional() {
            OPTIONAL
        } else {
            REQUIRED
        };
        let element = Struct::default()
            .i32(1, self.physical())
            .i32(3, repetition)
            .text(4, &self.name);
        match self.physical() {
            BYTE_ARRAY => {
                let string = Struct::default().nested(1, Struct::default());
                element.i32(6, UTF8).nested(10, string)
            }
            _ => element,
        }
    }

    /// The levels of a page, their length in bytes before them; a column that is not optional has none.
    fn levels(&self) -> io::Result<Vec<u8>> {
        if !self.is_optional() {
            return Ok(Vec::new());
        }
        let mut runs = Vec::new();
        for &(rows, present) in &self.runs {
            // The lowest bit is zero: a level that is repeated, not levels one by one.
            varint(&mut runs, (rows as u64) << 1);
            runs.push(u8::from(present));
        }
        let mut levels = length(runs.len())?.to_le_bytes().to_vec();
        levels.extend(runs);
        Ok(levels)
    }
}

/// `PageHeader` of a page with so many rows, and so many bytes after the header.
fn page_header(rows: i32, bytes: i32) -> Struct {
    let data = Struct::default()
        .i32(1, rows)
        .i32(2, PLAIN)
        .i32(3, RUN_LENGTHS)
        .i32(4, RUN_LENGTHS);
    Struct::default()
        .i32(1, DATA_PAGE)
        .i32(2, bytes)
        .i32(3, bytes)
        .nested(5, data)
}

/// A length as the format has it.
fn length(bytes: usize) -> io::Result<i32> {
    i32::try_from(bytes)
        .map_err(|_| io::Error::other(format!("a page of {bytes} bytes is too long for Parquet")))
}
