//! Pictures, which are drawn as SVG, into the files that people ask for: SVG, PNG and PDF of one, PNG, GIF and MP4 of many that
//! follow each other. What a file becomes is said by the end of its name.
//!
//! Letters are drawn as shapes, from a font that the program carries: a picture looks the same on every machine. Without the
//! feature `export` there is SVG alone.

#[cfg(feature = "export")]
mod gif;
#[cfg(feature = "export")]
mod letters;
#[cfg(feature = "export")]
mod moving;
#[cfg(feature = "export")]
mod patch;
#[cfg(feature = "export")]
mod raster;

#[cfg(feature = "export")]
use raster::Raster;

use crate::format::{Still, WITHOUT};
use std::io::{self, Write};
use std::path::Path;
use std::process::Command;

impl Still {
    /// Writes a picture, with so many pixels per unit if it becomes pixels.
    ///
    /// # Errors
    /// Of `out`; what the picture cannot become.
    #[cfg_attr(not(feature = "export"), expect(unused_variables))]
    pub fn write(self, svg: &str, scale: f32, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Still::Svg => out.write_all(svg.as_bytes()),
            #[cfg(feature = "export")]
            Still::Png => Raster::draw(svg, scale)?.png(out),
            #[cfg(feature = "export")]
            Still::Pdf => pdf(svg, out),
            #[cfg(not(feature = "export"))]
            Still::Png | Still::Pdf => Err(io::Error::other(WITHOUT)),
        }
    }
}

/// What pictures that follow each other can become together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moving {
    /// An animated PNG: all colours.
    Png,
    /// A GIF: 256 colours, which every program shows.
    Gif,
    /// An MP4 film (H.264), for slides and the web.
    Mp4,
}

/// How pictures follow each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// How many there are.
    pub count: usize,
    /// Pictures a second.
    pub rate: f64,
    /// Pixels per unit of a picture.
    pub scale: f32,
}

/// Most pictures a second of a GIF: programs show those that are asked for faster at a tenth of the speed.
const MOST_OF_A_GIF: f64 = 50.0;

impl Moving {
    /// Whether it can be made here.
    ///
    /// # Errors
    /// A sentence that says what is missing.
    pub fn ready(self, rate: f64) -> Result<(), String> {
        let ffmpeg = || Command::new("ffmpeg").arg("-version").output();
        match self {
            _ if !cfg!(feature = "export") => Err(WITHOUT.to_owned()),
            Moving::Gif if rate > MOST_OF_A_GIF => Err(format!(
                "a GIF shows at most {MOST_OF_A_GIF} pictures a second; give --fps {MOST_OF_A_GIF}, or write .png or .mp4"
            )),
            Moving::Mp4 if ffmpeg().is_err() => Err(
                "an .mp4 needs the program ffmpeg, which is not on the PATH; write .gif or .png instead".to_owned(),
            ),
            _ => Ok(()),
        }
    }

    /// Writes a file of pictures, which may be asked for more than once.
    ///
    /// # Errors
    /// The file cannot be written; ffmpeg fails.
    #[cfg(feature = "export")]
    pub fn write<I: Iterator<Item = String>>(
        self,
        pictures: impl Fn() -> I,
        pace: Pace,
        path: &Path,
    ) -> io::Result<()> {
        moving::write(self, pictures, pace, path)
    }

    /// Refuses.
    ///
    /// # Errors
    /// Always.
    #[cfg(not(feature = "export"))]
    pub fn write<I: Iterator<Item = String>>(
        self,
        _: impl Fn() -> I,
        _: Pace,
        _: &Path,
    ) -> io::Result<()> {
        Err(io::Error::other(WITHOUT))
    }
}

#[cfg(feature = "export")]
fn pdf(svg: &str, out: &mut dyn Write) -> io::Result<()> {
    let tree = raster::tree(svg)?;
    let options = svg2pdf::ConversionOptions::default();
    let page = svg2pdf::PageOptions::default();
    let file = svg2pdf::to_pdf(&tree, options, page);
    out.write_all(&file.map_err(|error| io::Error::other(error.to_string()))?)
}
