//! Shapes with pictures, sampled by their radiance.

use super::chosen::{Chosen, LightDirection};
use super::record::PICTURED;
use crate::geometry::{self, Chart, Geometry};
use crate::packet::{M8, V8, X8};
use crate::scene::Shape;
use crate::scene::light_picture::LightPicture;
use crate::technique::Measure;
use etendue::light::{Picture, Region};
use etendue::{LightSample, Mask, Vec2};
use rayon::prelude::*;

/// The most cells along a side of a shape.
const MOST_ALONG: usize = 1024;
/// The most cells of all shapes.
const MOST: usize = 1 << 22;
/// Cells that show more texels are looked at by blocks of texels.
const MOST_EXACT: f64 = 2.5;
/// A triangle with fewer cells along its sides is sampled as a whole: cells on its third side are sampled in vain half of the time.
const FEWEST_OF_TRIANGLE: usize = 8;
/// Pictures that vary by less are not worth a table.
const LEAST_CONTRAST: f64 = 1.1;

/// A picture on a shape as a table of the radiance of its cells.
#[derive(Clone, Debug)]
struct RadianceTable {
    buffer: Vec<f32>,
    /// Cells along both coordinates; of an interpolated picture, texels.
    size: [usize; 2],
    region: Region,
    /// What is interpolated, if the shape shows all of a picture and its coordinates are those of the surface.
    values: Option<Vec<f32>>,
}

/// The tables of shapes, by the index of the shape; none where the shape is sampled without regard to its picture.
#[derive(Clone, Debug, Default)]
pub(super) struct Tables {
    of_shapes: Vec<u32>,
    tables: Vec<RadianceTable>,
}

/// Index of a shape without a table.
const NO_TABLE: u32 = u32::MAX;

/// Cells along both coordinates of a shape's surface: as many as there are texels, but not too many.
fn size(picture: &LightPicture, chart: Chart, share: usize) -> [usize; 2] {
    let texels = &picture.picture.texels;
    let (w, h) = (texels.width as f32, texels.height as f32);
    let most = (share as f64).sqrt().min(MOST_ALONG as f64) as usize;
    let cells = |texels: f32| (texels.ceil() as usize).clamp(1, most.max(1));
    let rows = picture.picture.mapping.0;
    let along = |k: usize| cells((rows[0][k] * w).abs().max((rows[1][k] * h).abs()));
    match chart {
        // heights, and azimuths
        Chart::Sphere => [cells(h), cells(w)],
        Chart::Triangle => [along(0).max(along(1)); 2],
        Chart::Parallelogram => [along(0), along(1)],
    }
}

impl RadianceTable {
    /// None where the shape is as good without.
    fn new(picture: &LightPicture, geometry: &Geometry, share: usize) -> Option<Self> {
        if let Some(values) = interpolated(picture, geometry).filter(|values| values.len() <= share) {
            return Self::of_values(values, picture.picture.texels.width);
        }
        let chart = geometry.chart()?;
        let [w, h] = size(picture, chart, share);
        if chart == Chart::Triangle && w < FEWEST_OF_TRIANGLE {
            return None;
        }
        let ranges = |i: usize| [(i % w, w), (i / w, h)].map(|(i, n)| [i, i + 1].map(|i| i as f64 / n as f64));
        let middle = ranges(w * h / 2 + w / 2);
        let weights: Option<Vec<f64>> = if picture.texels_of_cell(chart, middle[0], middle[1]) > MOST_EXACT {
            let coarse = picture.coarse(chart);
            let weight = |i: usize| {
                let [s, t] = ranges(i);
                Some(coarse(s, t)).filter(|x| x.is_finite())
            };
            (0..w * h).into_par_iter().map(weight).collect()
        } else {
            let cell = |i: usize| {
                let [s, t] = ranges(i);
                picture.mean_of_cell(chart, s, t)
            };
            (0..w * h).into_par_iter().map(cell).collect()
        };
        let weights = weights?;
        let weights = relative(&weights)?;
        let mut buffer = vec![0.0; Picture::buffer(w, h)];
        let region = if chart == Chart::Triangle { Region::Triangle } else { Region::Square };
        Picture::build(&weights, w, region, &mut buffer).ok()?;
        Some(Self { buffer, size: [w, h], region, values: None })
    }
    fn of_values(values: Vec<f64>, width: usize) -> Option<Self> {
        let values = relative(&values)?;
        let height = values.len() / width;
        let mut buffer = vec![0.0; Picture::buffer(width + 1, height + 1)];
        Picture::interpolated(&values, width, &mut buffer).ok()?;
        Some(Self { buffer, size: [width, height], region: Region::Square, values: Some(values) })
    }
    #[inline]
    fn picture(&self) -> Picture<'_> {
        let picture = match &self.values {
            None => Picture::from_buffer(&self.buffer, self.size, self.region),
            Some(values) => Picture::interpolated_from_buffer(values, self.size[0], &self.buffer),
        };
        picture.expect("a table of its own size")
    }
}

/// Weights relative to the greatest, above 0 where there is light; none where they hardly differ.
fn relative(weights: &[f64]) -> Option<Vec<f32>> {
    let (sum, most) = weights.iter().fold((0.0, 0.0), |(sum, most), w| (sum + w, w.max(most)));
    let relative = |w: &f64| if *w > 0.0 { ((w / most) as f32).max(f32::MIN_POSITIVE) } else { 0.0 };
    (most * weights.len() as f64 > sum * LEAST_CONTRAST).then(|| weights.iter().map(relative).collect())
}

/// The sums of the channels of all texels, in the order of the surface's coordinates, if a parallelogram shows all of an interpolated
/// picture.
fn interpolated(shown: &LightPicture, geometry: &Geometry) -> Option<Vec<f64>> {
    let mirrored = shown.whole(geometry).filter(|_| shown.picture.bilinear)?;
    let (w, h) = (shown.picture.texels.width, shown.picture.texels.height);
    let sum = |i: usize| shown.whole_texel(mirrored, [i % w, i / w]).map(f64::from).iter().sum();
    Some((0..w * h).map(sum).collect())
}

impl Tables {
    /// The tables of the shapes that show these pictures.
    pub(super) fn new(shapes: &[Shape], pictures: &[LightPicture]) -> Self {
        let shows = |shape: &Shape| shape.emission.and_then(|emission| emission.picture);
        let count = shapes.iter().filter(|shape| shows(shape).is_some()).count();
        if count == 0 {
            return Self::default();
        }
        let (mut of_shapes, mut tables) = (vec![NO_TABLE; shapes.len()], Vec::new());
        for (index, shape) in shapes.iter().enumerate() {
            let Some(picture) = shows(shape) else { continue };
            if let Some(table) = RadianceTable::new(&pictures[picture as usize], &shape.geometry, MOST / count) {
                of_shapes[index] = tables.len() as u32;
                tables.push(table);
            }
        }
        Self { of_shapes, tables }
    }
    /// The table of a shape.
    #[inline]
    pub(super) fn of(&self, shape: usize) -> Option<TableOf<'_>> {
        let table = self.tables.get(*self.of_shapes.get(shape)? as usize)?;
        Some(TableOf(table))
    }
}

/// The table of a shape.
#[derive(Clone, Copy)]
pub(super) struct TableOf<'a>(&'a RadianceTable);

impl TableOf<'_> {
    /// Samples the shape in proportion to its radiance, from points `p` on surfaces with this normal.
    pub(super) fn sample(
        self,
        (shape, axes): (&Geometry, &[[f32; 3]; 3]),
        measure: Measure,
        place: [V8; 2],
        u: Vec2<X8>,
    ) -> LightSample<X8> {
        shape.sample_picture(&self.0.picture(), axes, measure, place, u)
    }
    /// Pdf per steradian with which [`sample`](Self::sample) by solid angle draws the direction `w`.
    pub(super) fn pdf(self, (shape, axes): (&Geometry, &[[f32; 3]; 3]), p: V8, w: V8) -> X8 {
        shape.pdf_of_picture(&self.0.picture(), axes, p, w)
    }
}

impl Tables {
    /// Samples shapes of one kind, some of which show pictures, and puts the radiance of the sampled points into the lanes `here`.
    // not inlined, so that it does not burden scenes without pictures
    #[inline(never)]
    pub(super) fn sample(
        &self,
        (shapes, pictures): (&[Shape], &[LightPicture]),
        (kind, here): (u32, M8),
        chosen: &Chosen,
        (measure, u): (Measure, Vec2<X8>),
        [p, normal]: [V8; 2],
        radiance: &mut V8,
    ) -> LightDirection {
        let pictured = here & chosen.has(PICTURED);
        let by_shape = || -> LightSample<X8> { geometry::sample(kind, chosen.vectors(), measure, p, normal, u) };
        let mut sample = None;
        chosen.primitives.each(pictured, |primitive, lanes| {
            let Some(index) = primitive.shape() else { return };
            let shape = &shapes[index];
            let Some(picture) = shape.emission.and_then(|emission| emission.picture) else { return };
            let picture = &pictures[picture as usize];
            if let Some(table) = self.of(index) {
                let drawn = table.sample((&shape.geometry, &picture.axes), measure, [p, normal], u);
                // in a packet of one light, no other map is needed
                let others = sample.unwrap_or_else(|| if lanes.all() { drawn } else { by_shape() });
                sample = Some(LightSample::blend(lanes, drawn, others));
            }
        });
        let sample = sample.unwrap_or_else(by_shape);
        chosen.primitives.each(pictured, |primitive, lanes| {
            let Some(shape) = primitive.shape().map(|index| &shapes[index]) else { return };
            let shown = shape.emission.and_then(|emission| emission.picture).zip(shape.geometry.chart());
            if let Some((picture, chart)) = shown {
                let picture = &pictures[picture as usize];
                picture.show(chart, lanes, sample.uv, sample.normal, radiance);
            }
        });
        sample.into()
    }
}
