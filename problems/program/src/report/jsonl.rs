//! Outcome → JSON lines: what was run, then samples and events in order of time, then what it came to. Every line is an object
//! whose `type` is `header`, `sample`, `event` or `end`.
//!
//! A sample has the columns of [`csv`](super::csv) as its fields, without units; an event has the state and the forces before and after.

use super::json::{Ending, Header, Switch, ending, header, switch};
use super::rows::{Cell, Column, Row, Table};
use crate::outcome::Outcome;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::io::{self, Write};

/// Writes `outcome`, an object a line.
pub fn write(outcome: &Outcome, mut out: impl Write) -> io::Result<()> {
    let table = Table::new(outcome);
    let columns = table.columns();
    line(&mut out, &Line::Header(header(outcome)))?;
    for row in table.rows() {
        match row {
            Row::Sample(..) => {
                let cells = table.cells(&row);
                line(&mut out, &Line::Sample(Fields(&columns, cells)))?;
            }
            Row::Before(index, event) => {
                let switch = switch(outcome, index, event);
                line(
                    &mut out,
                    &Line::Event(Instant {
                        t: event.time,
                        what: switch,
                    }),
                )?;
            }
            Row::After(..) => {}
        }
    }
    let t = outcome.last().map_or(0.0, |last| last.time);
    line(
        &mut out,
        &Line::End(Instant {
            t,
            what: ending(outcome),
        }),
    )
}

fn line(out: &mut impl Write, line: &Line) -> io::Result<()> {
    serde_json::to_writer(&mut *out, line)?;
    writeln!(out)
}

#[derive(Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Line<'a> {
    Header(Header),
    Sample(Fields<'a>),
    Event(Instant<Switch>),
    End(Instant<Ending>),
}

#[derive(Serialize)]
struct Instant<W> {
    t: f64,
    #[serde(flatten)]
    what: W,
}

/// Columns and cells of a row.
struct Fields<'a>(&'a [Column], Vec<Cell>);

impl Serialize for Fields<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (column, cell) in self.0.iter().zip(&self.1) {
            match cell {
                Cell::Number(number) => map.serialize_entry(&column.name, number)?,
                Cell::Text(text) => map.serialize_entry(&column.name, text)?,
                Cell::Nothing => {}
            }
        }
        map.end()
    }
}
