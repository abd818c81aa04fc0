//! Apache Parquet: rows of numbers and texts, some of which may be missing (null), in groups.

use super::Kind;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use std::io::{self, Write};
use std::sync::Arc;

/// Rows of a group.
const GROUP: usize = 1 << 16;

/// Rows on their way into a file.
pub(super) struct Rows<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    columns: Vec<Column>,
    /// Rows that are not written yet.
    waiting: usize,
}

/// What is not written yet of a column; of one with nulls, without them.
struct Column {
    values: Values,
    /// Per row: 1 where there is a value; nothing for a column without nulls.
    levels: Option<Vec<i16>>,
}

enum Values {
    Numbers(Vec<f64>),
    Texts(Vec<ByteArray>),
}

impl<W: Write + Send> Rows<W> {
    /// A file with these columns, and texts by key that readers show as metadata of the file.
    pub(super) fn new(
        out: W,
        columns: &[(&str, Kind)],
        metadata: &[(&str, &str)],
    ) -> io::Result<Self> {
        let texts = metadata
            .iter()
            .map(|(key, text)| KeyValue::new((*key).to_owned(), Some((*text).to_owned())));
        let properties = WriterProperties::builder()
            .set_compression(Compression::UNCOMPRESSED)
            .set_created_by(concat!("lagrange ", env!("CARGO_PKG_VERSION")).to_owned())
            .set_key_value_metadata(Some(texts.collect()))
            .build();
        let schema = Arc::new(schema(columns).map_err(file)?);
        let column = |&(_, kind): &(&str, Kind)| Column {
            values: match kind {
                Kind::Number | Kind::MaybeNumber => Values::Numbers(Vec::new()),
                Kind::Text | Kind::MaybeText => Values::Texts(Vec::new()),
            },
            levels: matches!(kind, Kind::MaybeNumber | Kind::MaybeText).then(Vec::new),
        };
        Ok(Self {
            writer: SerializedFileWriter::new(out, schema, Arc::new(properties)).map_err(file)?,
            columns: columns.iter().map(column).collect(),
            waiting: 0,
        })
    }

    /// A number in a column of this row.
    pub(super) fn number(&mut self, column: usize, number: f64) {
        let column = &mut self.columns[column];
        column.level(1);
        if let Values::Numbers(numbers) = &mut column.values {
            numbers.push(number);
        }
    }

    /// A text in a column of this row.
    pub(super) fn text(&mut self, column: usize, text: &str) {
        let column = &mut self.columns[column];
        column.level(1);
        if let Values::Texts(texts) = &mut column.values {
            texts.push(ByteArray::from(text));
        }
    }

    /// Nothing in a column of this row.
    pub(super) fn nothing(&mut self, column: usize) {
        self.columns[column].level(0);
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
        self.writer.close().map_err(file)?;
        Ok(())
    }

    fn write_group(&mut self) -> io::Result<()> {
        let mut group = self.writer.next_row_group().map_err(file)?;
        for column in &mut self.columns {
            column.write(&mut group).map_err(file)?;
        }
        group.close().map_err(file)?;
        self.waiting = 0;
        Ok(())
    }
}

impl Column {
    fn level(&mut self, level: i16) {
        if let Some(levels) = &mut self.levels {
            levels.push(level);
        }
    }

    fn write<W: Write + Send>(
        &mut self,
        group: &mut SerializedRowGroupWriter<'_, W>,
    ) -> Result<(), ParquetError> {
        let Some(mut column) = group.next_column()? else {
            return Ok(());
        };
        let levels = self.levels.as_deref();
        match &mut self.values {
            Values::Numbers(numbers) => {
                let typed = column.typed::<DoubleType>();
                typed.write_batch(numbers, levels, None)?;
                numbers.clear();
            }
            Values::Texts(texts) => {
                let typed = column.typed::<ByteArrayType>();
                typed.write_batch(texts, levels, None)?;
                texts.clear();
            }
        }
        if let Some(levels) = &mut self.levels {
            levels.clear();
        }
        column.close()
    }
}

fn schema(columns: &[(&str, Kind)]) -> Result<Type, ParquetError> {
    let column = |&(name, kind): &(&str, Kind)| {
        let (physical, logical) = match kind {
            Kind::Number | Kind::MaybeNumber => (Physical::DOUBLE, None),
            Kind::Text | Kind::MaybeText => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let repetition = match kind {
            Kind::Number | Kind::Text => Repetition::REQUIRED,
            Kind::MaybeNumber | Kind::MaybeText => Repetition::OPTIONAL,
        };
        Type::primitive_type_builder(name, physical)
            .with_repetition(repetition)
            .with_logical_type(logical)
            .build()
            .map(Arc::new)
    };
    let fields = columns.iter().map(column).collect::<Result<_, _>>()?;
    Type::group_type_builder("rows").with_fields(fields).build()
}

fn file(error: ParquetError) -> io::Error {
    io::Error::other(error)
}
