//! Rectangles of pixels, and values for their pixels, row by row.

/// A rectangle of pixels: its first column and row, and the column and row after its last, in pixels of the image.
pub type Area = [u32; 4];

/// Side of the squares of pixels that a thread renders at a time.
pub const TILE: u32 = 16;

/// Where an image is in a larger one, of which it is a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "exr", derive(serde::Serialize))]
pub struct PlaceInImage {
    /// The column and row of its first pixel.
    pub start: [u32; 2],
    /// Columns and rows of the whole image.
    pub whole: [u32; 2],
}

/// Numbers of columns and rows of an area.
fn size([x0, y0, x1, y1]: Area) -> [usize; 2] {
    [(x1 - x0) as usize, (y1 - y0) as usize]
}

/// Number of pixels of an area.
pub fn count(area: Area) -> usize {
    let [across, down] = size(area);
    across * down
}

/// The columns and rows of the pixels of an area, row by row.
pub fn pixels([x0, y0, x1, y1]: Area) -> impl Iterator<Item = [u32; 2]> {
    (y0..y1).flat_map(move |y| (x0..x1).map(move |x| [x, y]))
}

/// Replaces the values of the pixels of `part`, which the area of `values` contains.
pub fn paste<T>(values: &mut [T], area: Area, part: Area, from: impl IntoIterator<Item = T>) {
    let (width, [across, down]) = (size(area)[0], size(part));
    let [left, top] = [part[0] - area[0], part[1] - area[1]].map(|at| at as usize);
    let mut from = from.into_iter();
    for y in 0..down {
        let row = &mut values[(top + y) * width + left..][..across];
        row.iter_mut().zip(&mut from).for_each(|(to, from)| *to = from);
    }
}
