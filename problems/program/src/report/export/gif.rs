//! Rasters → GIF, with one palette for all: the colours that cover most of the paper, exactly. Flat shapes keep their colours and
//! do not flicker; only the soft edges of shapes take the nearest.

use super::Pace;
use super::patch::Patch;
use super::raster::Raster;
use gif::{Encoder, Frame, Repeat};
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, Write};

/// Colours of a GIF, beside the number for what stays as it was.
const COLOURS: u8 = 255;

/// The colours of a film.
pub(super) struct Palette(Vec<[u8; 3]>);

impl Palette {
    /// The most frequent colours of some pictures; equally frequent ones in their order.
    pub(super) fn of(rasters: impl Iterator<Item = io::Result<Raster>>) -> io::Result<Self> {
        let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
        for raster in rasters {
            // Neighbours mostly have one colour, which is looked up once.
            let colours: Vec<[u8; 3]> = raster?.colours().collect();
            for alike in colours.chunk_by(|one, next| one == next) {
                *counts.entry(alike[0]).or_default() += alike.len();
            }
        }
        let mut counts: Vec<([u8; 3], usize)> = counts.into_iter().collect();
        counts.sort_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));
        let colours = counts.into_iter().map(|(colour, _)| colour);
        let mut colours: Vec<[u8; 3]> = colours.take(COLOURS.into()).collect();
        colours.resize(usize::from(COLOURS) + 1, [0; 3]);
        Ok(Self(colours))
    }

    /// Number of the nearest colour.
    fn nearest(&self, colour: [u8; 3]) -> u8 {
        let apart = |other: &[u8; 3]| -> u32 {
            let parts = colour.iter().zip(other);
            parts.map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum()
        };
        let numbered = (0..COLOURS).zip(&self.0);
        numbered
            .min_by_key(|(_, other)| apart(other))
            .map_or(0, |(index, _)| index)
    }
}

/// Writes a file that repeats itself.
pub(super) fn write(
    mut rasters: impl Iterator<Item = io::Result<Raster>>,
    palette: &Palette,
    pace: Pace,
    out: &mut impl Write,
) -> io::Result<()> {
    let Some(first) = rasters.next().transpose()? else {
        return Ok(());
    };
    let (width, height) = (first.width() as u16, first.height() as u16);
    let mut encoder =
        Encoder::new(out, width, height, palette.0.as_flattened()).map_err(io::Error::other)?;
    encoder
        .set_repeat(Repeat::Infinite)
        .map_err(io::Error::other)?;
    let mut known: HashMap<[u8; 3], u8> = HashMap::new();
    let mut before: Option<Raster> = None;
    for (index, raster) in core::iter::once(Ok(first)).chain(rasters).enumerate() {
        let raster = raster?;
        let patch = Patch::between(before.as_ref(), &raster);
        let mut number = |colour| {
            *known
                .entry(colour)
                .or_insert_with(|| palette.nearest(colour))
        };
        let numbers = patch.colours(before.as_ref(), &raster);
        let numbers = numbers
            .map(|colour| colour.map_or(COLOURS, &mut number))
            .collect();
        let frame = Frame {
            left: patch.left as u16,
            top: patch.top as u16,
            width: patch.width as u16,
            height: patch.height as u16,
            delay: pace.shown(index, 100.0),
            transparent: Some(COLOURS),
            buffer: Cow::Owned(numbers),
            ..Frame::default()
        };
        encoder.write_frame(&frame).map_err(io::Error::other)?;
        before = Some(raster);
    }
    Ok(())
}
