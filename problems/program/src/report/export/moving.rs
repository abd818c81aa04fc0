//! Pictures that follow each other → one file that moves: animated PNG, GIF, and MP4 where the program ffmpeg is there.
//!
//! Of each picture a PNG or GIF holds the rectangle alone in which it differs from the one before.

use super::patch::Patch;
use super::raster::{MOST, Raster};
use super::{Moving, Pace, gif};
use rayon::prelude::*;
use std::io::{self, Write};
use std::path::Path;
use std::process::{Command, Stdio};

/// Seconds that the last picture stays.
const PAUSE: f64 = 1.0;
/// Pictures that are drawn at the same time, at most.
const BATCH: usize = 32;

/// Writes a file of pictures, which may be asked for more than once.
pub(super) fn write<I: Iterator<Item = String>>(
    kind: Moving,
    pictures: impl Fn() -> I,
    pace: Pace,
    path: &Path,
) -> io::Result<()> {
    let rasters = rasters(pictures(), pace.scale);
    match kind {
        Moving::Png => animated_png(rasters, pace, &mut file(path)?),
        Moving::Gif => {
            let some = pictures().step_by(pace.count.div_ceil(BATCH));
            let palette = gif::Palette::of(self::rasters(some, pace.scale))?;
            gif::write(rasters, &palette, pace, &mut file(path)?)
        }
        Moving::Mp4 => film(rasters, pace, path),
    }
}

fn file(path: &Path) -> io::Result<io::BufWriter<std::fs::File>> {
    Ok(io::BufWriter::new(std::fs::File::create(path)?))
}

/// Pictures drawn in their order, on all cores.
fn rasters(
    mut pictures: impl Iterator<Item = String>,
    scale: f32,
) -> impl Iterator<Item = io::Result<Raster>> {
    // The first one tells how many fit into memory.
    let mut fit = 1;
    let batches = core::iter::from_fn(move || {
        let batch: Vec<String> = pictures.by_ref().take(fit).collect();
        let drawn = batch.into_par_iter().map(|svg| Raster::draw(&svg, scale));
        let drawn: Vec<io::Result<Raster>> = drawn.collect();
        if let Some(Ok(raster)) = drawn.first() {
            fit = (MOST / (raster.width() * raster.height())).clamp(1, BATCH);
        }
        Some(drawn).filter(|batch| !batch.is_empty())
    });
    batches.flatten()
}

impl Pace {
    /// When picture number `index` ends, s.
    fn end(&self, index: usize) -> f64 {
        let pause = if index + 1 == self.count { PAUSE } else { 0.0 };
        (index + 1) as f64 / self.rate + pause
    }

    /// How long picture number `index` is shown, in parts of a second: rounding does not add up over many.
    pub(super) fn shown(&self, index: usize, parts: f64) -> u16 {
        let end = |k: usize| (parts * self.end(k)).round();
        let begin = if index == 0 { 0.0 } else { end(index - 1) };
        (end(index) - begin) as u16
    }
}

fn animated_png(
    mut rasters: impl Iterator<Item = io::Result<Raster>>,
    pace: Pace,
    out: &mut impl Write,
) -> io::Result<()> {
    let Some(first) = rasters.next().transpose()? else {
        return Ok(());
    };
    let mut encoder = png::Encoder::new(out, first.width() as u32, first.height() as u32);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_compression(png::Compression::Best);
    encoder.set_animated(pace.count as u32, 0)?;
    encoder.set_blend_op(png::BlendOp::Over)?;
    let mut writer = encoder.write_header()?;
    let mut before: Option<Raster> = None;
    for (index, raster) in core::iter::once(Ok(first)).chain(rasters).enumerate() {
        let raster = raster?;
        let patch = Patch::between(before.as_ref(), &raster);
        writer.set_frame_delay(pace.shown(index, 1000.0), 1000)?;
        writer.reset_frame_position()?;
        writer.set_frame_dimension(patch.width as u32, patch.height as u32)?;
        writer.set_frame_position(patch.left as u32, patch.top as u32)?;
        let colours = patch.colours(before.as_ref(), &raster);
        let colours: Vec<u8> = colours
            .flat_map(|colour| colour.map_or([0; 4], |[r, g, b]| [r, g, b, 255]))
            .collect();
        writer.write_image_data(&colours)?;
        before = Some(raster);
    }
    writer.finish()?;
    Ok(())
}

/// Writes the colours of all pictures, the last one again and again until the pause is over.
fn feed(
    rasters: impl Iterator<Item = io::Result<Raster>>,
    pace: Pace,
    mut out: impl Write,
) -> io::Result<()> {
    let mut last = Vec::new();
    for raster in rasters {
        last = raster?.colours().flatten().collect();
        out.write_all(&last)?;
    }
    for _ in 0..(PAUSE * pace.rate).ceil() as usize {
        out.write_all(&last)?;
    }
    Ok(())
}

/// Lets ffmpeg make a film.
fn film(
    mut rasters: impl Iterator<Item = io::Result<Raster>>,
    pace: Pace,
    path: &Path,
) -> io::Result<()> {
    let Some(first) = rasters.next().transpose()? else {
        return Ok(());
    };
    let size = format!("{}x{}", first.width(), first.height());
    let rate = pace.rate.to_string();
    // Players know half as many colours as pixels each way only, so that sizes are even.
    let filter = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
    let mut ffmpeg = Command::new("ffmpeg")
        .args([
            "-loglevel",
            "error",
            "-y",
            "-f",
            "rawvideo",
            "-pix_fmt",
            "rgb24",
        ])
        .args(["-video_size", &size, "-framerate", &rate, "-i", "-"])
        .args([
            "-vf",
            filter,
            "-pix_fmt",
            "yuv420p",
            "-movflags",
            "+faststart",
            "-f",
            "mp4",
        ])
        .arg(path)
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let fed = match ffmpeg.stdin.take() {
        Some(frames) => feed(core::iter::once(Ok(first)).chain(rasters), pace, frames),
        None => Ok(()),
    };
    let ended = ffmpeg.wait_with_output()?;
    match ended.status.success() {
        true => fed,
        false => {
            let said = String::from_utf8_lossy(&ended.stderr);
            let said = said
                .lines()
                .next()
                .unwrap_or("it does not say why")
                .to_owned();
            Err(io::Error::other(format!("ffmpeg failed: {said}")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_a_film_do_not_drift() {
        let pace = Pace {
            count: 90,
            rate: 30.0,
            scale: 1.0,
        };
        let sum: u32 = (0..90).map(|k| u32::from(pace.shown(k, 100.0))).sum();
        assert_eq!(sum, 300 + 100);
        assert_eq!(pace.shown(0, 100.0), 3);
    }

    #[test]
    fn what_moves_is_all_that_differs() {
        let square = |x: f64| {
            let svg = format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"30\"><rect x=\"{x}\" y=\"5\" width=\"4\" height=\"3\"/></svg>"
            );
            Raster::draw(&svg, 1.0).expect("a raster")
        };
        let (a, b) = (square(10.0), square(12.0));
        let patch = Patch::between(Some(&a), &b);
        assert_eq!(
            (patch.left, patch.top, patch.width, patch.height),
            (10, 5, 6, 3)
        );
        // Of 12 pixels 6 stay black, 6 become black and 6 white again.
        let count = |colour| patch.colours(Some(&a), &b).filter(|c| *c == colour).count();
        assert_eq!([None, Some([0; 3]), Some([255; 3])].map(count), [6, 6, 6]);
        assert_eq!(Patch::between(Some(&a), &a).width, 1);
    }
}
