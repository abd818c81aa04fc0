//! Apache Parquet: a column per axis and observation (null where a run does not have it), and whether the run failed.

use super::{Failure, lines, names};
use crate::sweep::{Journal, Sweep};
use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::data_type::{BoolType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::io::{self, Write};
use std::sync::Arc;

/// Rows of a row group.
const GROUP: usize = 1 << 16;

/// Writes all runs in order.
///
/// # Errors
/// The journal is not complete; those of `out`.
pub fn parquet(sweep: &Sweep, journal: &Journal, out: impl Write + Send) -> Result<(), Failure> {
    let properties = WriterProperties::builder()
        .set_compression(Compression::UNCOMPRESSED)
        .set_created_by(concat!("lagrange ", env!("CARGO_PKG_VERSION")).to_owned())
        .build();
    let mut writer = SerializedFileWriter::new(out, Arc::new(schema(sweep)?), Arc::new(properties))
        .map_err(file)?;
    let mut group = Group::new(names(sweep).count());
    lines(sweep, journal, |point, observed, failed| {
        group.push(point.iter().chain(observed), failed);
        match group.failed.len() {
            GROUP => group.write(&mut writer, point.len()),
            _ => Ok(()),
        }
    })?;
    if !group.failed.is_empty() {
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
    columns.push(column("failed", Physical::BOOLEAN, Repetition::REQUIRED)?);
    let schema = Type::group_type_builder("runs").with_fields(columns);
    schema.build().map_err(file)
}

/// Rows that are not written yet, by column.
struct Group {
    /// What there is; of a column with nulls, without them.
    numbers: Vec<Vec<f64>>,
    /// Per row: 1 where there is a number.
    levels: Vec<Vec<i16>>,
    failed: Vec<bool>,
}

impl Group {
    fn new(columns: usize) -> Self {
        Self {
            numbers: vec![Vec::new(); columns],
            levels: vec![Vec::new(); columns],
            failed: Vec::new(),
        }
    }

    fn push<'a>(&mut self, row: impl Iterator<Item = &'a f64>, failed: bool) {
        let columns = self.numbers.iter_mut().zip(&mut self.levels);
        for ((numbers, levels), x) in columns.zip(row) {
            levels.push(i16::from(!x.is_nan()));
            if !x.is_nan() {
                numbers.push(*x);
            }
        }
        self.failed.push(failed);
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
            let typed = column.typed::<BoolType>();
            typed.write_batch(&self.failed, None, None).map_err(file)?;
            column.close().map_err(file)?;
        }
        self.failed.clear();
        group.close().map_err(file)?;
        Ok(())
    }
}

fn file(error: ParquetError) -> Failure {
    Failure::File(io::Error::other(error))
}
