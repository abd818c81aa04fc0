//! SVG → pixels, on white paper.

use super::letters::as_shapes;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};
use std::io::{self, Write};

/// Pixels that are drawn at the same time at most, which take 400 MB: what no memory holds would end the program.
pub(super) const MOST: usize = 100_000_000;

/// Pixels from left to right and downward: red, green, blue and opacity, which is full.
pub(super) struct Raster {
    map: Pixmap,
}

/// A picture, understood.
pub(super) fn tree(svg: &str) -> io::Result<Tree> {
    Tree::from_str(&as_shapes(svg)?, &Options::default()).map_err(io::Error::other)
}

impl Raster {
    /// A picture with so many pixels per unit.
    ///
    /// # Errors
    /// What is no picture, or too large a one.
    pub(super) fn draw(svg: &str, scale: f32) -> io::Result<Self> {
        let tree = tree(svg)?;
        let pixels = |length: f32| (scale * length).round().max(1.0) as u32;
        let (width, height) = (pixels(tree.size().width()), pixels(tree.size().height()));
        let few = (width as usize).saturating_mul(height as usize) <= MOST;
        let map = few.then(|| Pixmap::new(width, height)).flatten();
        let mut map =
            map.ok_or_else(|| io::Error::other(format!("{width} × {height} pixels are too many")))?;
        map.fill(Color::WHITE);
        resvg::render(
            &tree,
            Transform::from_scale(scale, scale),
            &mut map.as_mut(),
        );
        Ok(Self { map })
    }

    /// Pixels across.
    pub(super) fn width(&self) -> usize {
        self.map.width() as usize
    }

    /// Pixels from top to bottom.
    pub(super) fn height(&self) -> usize {
        self.map.height() as usize
    }

    /// Red, green, blue of all pixels.
    pub(super) fn colours(&self) -> impl Iterator<Item = [u8; 3]> + '_ {
        self.map
            .data()
            .chunks_exact(4)
            .map(|pixel| [pixel[0], pixel[1], pixel[2]])
    }

    /// Red, green, blue of one.
    pub(super) fn colour(&self, x: usize, y: usize) -> [u8; 3] {
        let first = 4 * (y * self.width() + x);
        let pixel = &self.map.data()[first..first + 3];
        [pixel[0], pixel[1], pixel[2]]
    }

    /// Writes a PNG file.
    ///
    /// # Errors
    /// Those of `out`.
    pub(super) fn png(&self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(&self.map.encode_png().map_err(io::Error::other)?)
    }
}
