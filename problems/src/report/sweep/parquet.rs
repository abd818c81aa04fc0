//! Apache Parquet: a column per axis and observation (null where a run does not have it), and why the run failed (null
//! where it did not). The sweep itself is in the metadata of the file.

use super::{Failure, lines, names};
use crate::sweep::{Journal, Sweep};
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::io::{self, Write};
use std::sync::Arc;

/// Under this key of the file's metadata the sweep is written down: scene, parameters, points, tolerance, method, version.
const RECIPE: &str = "lagrange.sweep";

/// Rows of a row group.
const GROUP: usize = 1 << 16;

/// Writes all runs in order.
///
/// # Errors
/// The journal is not complete; those of `out`.
pub fn parquet(sweep: &Sweep, journal: &Journal, out: impl Write + Send) -> Result<(), Failure> {
    let recipe = sweep
        .recipe()
        .map_err(|reason| Failure::File(io::Error::other(reason)))?;
    let properties = WriterProperties::builder()
        .set_key_value_metadata(Some(vec![KeyValue::new(RECIPE.to_owned(), recipe)]))
        .set_compression(Compression::UNCOMPRESSED)
        .set_created_by(concat!("lagrange ", env!("CARGO_PKG_VERSION")).to_owned())
        .build();
    let mut writer = SerializedFileWriter::new(out, Arc::new(schema(sweep)?), Arc::new(properties))
        .map_err(file)?;
    let mut group = Group::new(names(sweep).count());
    lines(sweep, journal, |point, observed, failure| {
        group.push(point.iter().chain(observed), failure);
        match group.failures.len() {
            GROUP => group.write(&mut writer, point.len()),
            _ => Ok(()),
        }
    })?;
    if !group.failures.is_empty() {
        group.write(&mut writer, sweep.points.axes.len())?;
    }
    writer.close().map_err(file)?;
    Ok(())
}

fn schema(sweep: &Sweep) -> Result<Type, Failure> {
    let axes = sweep.points.axes.len();
    let column = |name: &str, kind, repetition| {
        let column = Type::primitive_type_builder(name, kind).with_repetition(repetition);
        column.build().map(Arc::new).map_err(file)
    };
    let mut columns = Vec::new();
    for (index, name) in names(sweep).enumerate() {
        let repetition = match index < axes {
            true => Repetition::REQUIRED,
            false => Repetition::OPTIONAL,
        };
        columns.push(column(name, Physical::DOUBLE, repetition)?);
    }
    let failure = Type::primitive_type_builder("failure", Physical::BYTE_ARRAY)
        .with_logical_type(Some(LogicalType::String))
        .with_repetition(Repetition::OPTIONAL);
    columns.push(Arc::new(failure.build().map_err(file)?));
    let schema = Type::group_type_builder("runs").with_fields(columns);
    schema.build().map_err(file)
}

/// Rows that are not written yet, by column.
struct Group {
    /// What there is; of a column with nulls, without them.
    numbers: Vec<Vec<f64>>,
    /// Per row: 1 where there is a number.
    levels: Vec<Vec<i16>>,
    failures: Vec<Option<&'static str>>,
}

impl Group {
    fn new(columns: usize) -> Self {
        Self {
            numbers: vec![Vec::new(); columns],
            levels: vec![Vec::new(); columns],
            failures: Vec::new(),
        }
    }

    fn push<'a>(&mut self, row: impl Iterator<Item = &'a f64>, failure: Option<&'static str>) {
        let columns = self.numbers.iter_mut().zip(&mut self.levels);
        for ((numbers, levels), x) in columns.zip(row) {
            levels.push(i16::from(!x.is_nan()));
            if !x.is_nan() {
                numbers.push(*x);
            }
        }
        self.failures.push(failure);
    }

    /// Writes a row group; the first `axes` columns have no nulls.
    fn write<W: Write + Send>(
        &mut self,
        writer: &mut SerializedFileWriter<W>,
        axes: usize,
    ) -> Result<(), Failure> {
        let mut group = writer.next_row_group().map_err(file)?;
        let columns = self.numbers.iter_mut().zip(&mut self.levels).enumerate();
        for (index, (numbers, levels)) in columns {
            let Some(mut column) = group.next_column().map_err(file)? else {
                break;
            };
            let levels_of = (index >= axes).then_some(&levels[..]);
            let typed = column.typed::<DoubleType>();
            typed.write_batch(numbers, levels_of, None).map_err(file)?;
            column.close().map_err(file)?;
            numbers.clear();
            levels.clear();
        }
        if let Some(mut column) = group.next_column().map_err(file)? {
            let there = self.failures.iter().flatten();
            let there: Vec<ByteArray> = there.map(|&failure| failure.into()).collect();
            let levels = self.failures.iter().map(|f| i16::from(f.is_some()));
            let levels: Vec<i16> = levels.collect();
            let typed = column.typed::<ByteArrayType>();
            typed
                .write_batch(&there, Some(&levels), None)
                .map_err(file)?;
            column.close().map_err(file)?;
        }
        self.failures.clear();
        group.close().map_err(file)?;
        Ok(())
    }
}

fn file(error: ParquetError) -> Failure {
    Failure::File(io::Error::other(error))
}
