//! Shapes with pictures, sampled by their radiance.

use super::chosen::{Chosen, Drawn};
use super::kinds::sample_shape;
use super::record::PICTURED;
use super::{parallelogram, triangle};
use crate::geometry::Geometry;
use crate::light_picture::LightPicture;
use crate::packet::{M8, V8, X8, each_group};
use crate::scene::Shape;
use crate::technique::Measure;
use etendue::light::{Picture, Region};
use etendue::{LightSample, LightSampler, Mask, Real, Sphere, Vec2, Vec3};
use rayon::prelude::*;

/// The most cells along a side of a shape.
const MOST_ALONG: usize = 1024;
/// The most cells of all shapes.
const MOST: usize = 1 << 24;
/// A triangle with fewer cells along its sides is sampled as a whole: cells on its third side are sampled in vain half of the time.
const FEWEST_OF_TRIANGLE: usize = 8;
/// Pictures that vary by less are not worth a table.
const LEAST_CONTRAST: f64 = 1.1;

/// A picture on a shape as a table of the radiance of its cells.
#[derive(Clone, Debug)]
struct Table {
    buffer: Vec<f32>,
    /// Cells along both coordinates; of an interpolated picture, texels.
    size: [usize; 2],
    /// What is interpolated, if the shape shows all of a picture and its coordinates are those of the surface.
    values: Option<Vec<f32>>,
}

/// The tables of shapes, by the index of the shape; none where the shape is sampled without regard to its picture.
#[derive(Clone, Debug, Default)]
pub(super) struct Tables {
    of_shapes: Vec<u32>,
    tables: Vec<Table>,
}

/// Index of a shape without a table.
const NO_TABLE: u32 = u32::MAX;

/// Cells along both coordinates of a shape's surface: as many as there are texels, but not too many.
fn size(picture: &LightPicture, geometry: &Geometry, share: usize) -> [usize; 2] {
    let texels = &picture.picture.texels;
    let (w, h) = (texels.width as f32, texels.height as f32);
    let most = (share as f64).sqrt().min(MOST_ALONG as f64) as usize;
    let cells = |texels: f32| (texels.ceil() as usize).clamp(1, most.max(1));
    let rows = picture.picture.mapping.0;
    let along = |k: usize| cells((rows[0][k] * w).abs().max((rows[1][k] * h).abs()));
    match geometry {
        // heights, and azimuths
        Geometry::Sphere { .. } => [cells(h), cells(w)],
        Geometry::Triangle(_) => [along(0).max(along(1)); 2],
        Geometry::Parallelogram { .. } => [along(0), along(1)],
    }
}

impl Table {
    /// None where the shape is as good without.
    fn new(picture: &LightPicture, geometry: &Geometry, share: usize) -> Option<Self> {
        if let Some(values) = interpolated(picture, geometry).filter(|values| values.len() <= share) {
            return Self::of_values(values, picture.picture.texels.width);
        }
        let [w, h] = size(picture, geometry, share);
        if matches!(geometry, Geometry::Triangle(_)) && w < FEWEST_OF_TRIANGLE {
            return None;
        }
        let cell = |i: usize| {
            let [s, t] = [(i % w, w), (i / w, h)].map(|(i, n)| [i, i + 1].map(|i| i as f64 / n as f64));
            picture.mean_of_cell(geometry, s, t)
        };
        let weights: Option<Vec<f64>> = (0..w * h).into_par_iter().map(cell).collect();
        let weights = weights?;
        let weights = relative(&weights)?;
        let mut buffer = vec![0.0; Picture::buffer(w, h)];
        Picture::build(&weights, w, region(geometry), &mut buffer).ok()?;
        Some(Self { buffer, size: [w, h], values: None })
    }
    fn of_values(values: Vec<f64>, width: usize) -> Option<Self> {
        let values = relative(&values)?;
        let height = values.len() / width;
        let mut buffer = vec![0.0; Picture::buffer(width + 1, height + 1)];
        Picture::interpolated(&values, width, &mut buffer).ok()?;
        Some(Self { buffer, size: [width, height], values: Some(values) })
    }
    #[inline]
    fn picture(&self, geometry: &Geometry) -> Picture<'_> {
        let picture = match &self.values {
            None => Picture::from_buffer(&self.buffer, self.size, region(geometry)),
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

fn region(geometry: &Geometry) -> Region {
    if matches!(geometry, Geometry::Triangle(_)) { Region::Triangle } else { Region::Square }
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
            if let Some(table) = Table::new(&pictures[picture as usize], &shape.geometry, MOST / count) {
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
pub(super) struct TableOf<'a>(&'a Table);

/// Calls a method of the sampler of a shape with a picture by a measure. A sphere is sampled in the axes of its picture.
macro_rules! with_sampler {
    ($self:ident, $shape:ident, $p:ident, $normal:ident, $measure:ident, |$sampler:ident| $flat:expr, |$axes:ident, $round:ident| $of_sphere:expr) => {{
        let (geometry, axes) = $shape;
        let picture = $self.0.picture(geometry);
        macro_rules! flat {
            ($light:expr) => {{
                let light = picture.on($light);
                match $measure {
                    Measure::Area => {
                        let $sampler = light.by_area($p);
                        $flat
                    }
                    Measure::SolidAngle => {
                        let $sampler = light.by_solid_angle($p);
                        $flat
                    }
                    Measure::Projected => {
                        let $sampler = light.by_projected_solid_angle($p, $normal);
                        $flat
                    }
                }
            }};
        }
        match *geometry {
            Geometry::Triangle(_) => flat!(triangle::splat(geometry)),
            Geometry::Parallelogram { .. } => flat!(parallelogram::splat(geometry)),
            Geometry::Sphere { center, radius } => {
                let $axes = Axes(axes.map(V8::from));
                let sphere = Sphere::new($axes.inwards(V8::from(center) - $p), X8::splat(radius));
                let $round = picture.on(sphere).by_visible_area(Vec3::default());
                $of_sphere
            }
        }
    }};
}

/// Rows of a rotation.
struct Axes([V8; 3]);

impl Axes {
    #[inline]
    fn inwards(&self, v: V8) -> V8 {
        let [x, y, z] = self.0.map(|row| row.dot(v));
        Vec3::new(x, y, z)
    }
    #[inline]
    fn outwards(&self, v: V8) -> V8 {
        let [x, y, z] = self.0;
        x.mul_add(v.x, y.mul_add(v.y, z * v.z))
    }
}

impl TableOf<'_> {
    /// Samples the shape in proportion to its radiance, from points `p` on surfaces with this normal. From outside, the far side of a sphere
    /// is behind the near one.
    pub(super) fn sample(
        self,
        shape: (&Geometry, &[[f32; 3]; 3]),
        measure: Measure,
        p: V8,
        normal: V8,
        u: Vec2<X8>,
    ) -> LightSample<X8> {
        with_sampler!(self, shape, p, normal, measure, |sampler| sampler.draw(u).light, |axes, sampler| {
            let drawn = sampler.draw(u).light;
            let Geometry::Sphere { center, radius } = *shape.0 else { unreachable!("a sphere") };
            let inside = (V8::from(center) - p).length_squared().lt(X8::splat(radius * radius));
            LightSample {
                direction: axes.outwards(drawn.direction),
                normal: axes.outwards(drawn.normal),
                pdf: drawn.pdf.keep(drawn.emits | inside),
                ..drawn
            }
        })
    }
    /// Pdf per steradian with which [`sample`](Self::sample) by solid angle draws the direction `w`.
    pub(super) fn pdf(self, shape: (&Geometry, &[[f32; 3]; 3]), p: V8, w: V8) -> X8 {
        let (measure, normal) = (Measure::SolidAngle, w);
        with_sampler!(self, shape, p, normal, measure, |sampler| sampler.pdf(w), |axes, sampler| {
            sampler.pdf(axes.inwards(w))
        })
    }
}

impl Tables {
    /// Samples shapes of one kind, some of which show pictures, and puts the radiance of the sampled points into the lanes `here`.
    // not inlined, so that it does not burden scenes without pictures
    #[inline(never)]
    #[allow(clippy::too_many_arguments, reason = "those of a sample, and which lanes show which pictures")]
    pub(super) fn sample(
        &self,
        (shapes, pictures): (&[Shape], &[LightPicture]),
        kind: u32,
        here: M8,
        chosen: &mut Chosen,
        measure: Measure,
        p: V8,
        normal: V8,
        u: Vec2<X8>,
    ) -> Drawn {
        let pictured = here & chosen.has(PICTURED);
        let by_shape = || -> LightSample<X8> { sample_shape(kind, chosen, measure, p, normal, u) };
        let mut sample = None;
        each_group(chosen.shape, pictured, |index, lanes| {
            let shape = &shapes[index as usize];
            let Some(picture) = shape.emission.and_then(|emission| emission.picture) else { return };
            let picture = &pictures[picture as usize];
            if let Some(table) = self.of(index as usize) {
                let drawn = table.sample((&shape.geometry, &picture.axes), measure, p, normal, u);
                // in a packet of one light, no other map is needed
                let others = sample.unwrap_or_else(|| if lanes.all() { drawn } else { by_shape() });
                sample = Some(LightSample::blend(lanes, drawn, others));
            }
        });
        let sample = sample.unwrap_or_else(by_shape);
        let indices = chosen.shape;
        each_group(indices, pictured, |index, lanes| {
            let shape = &shapes[index as usize];
            if let Some(picture) = shape.emission.and_then(|emission| emission.picture) {
                let picture = &pictures[picture as usize];
                picture.show(&shape.geometry, lanes, sample.uv, sample.normal, &mut chosen.radiance);
            }
        });
        sample.into()
    }
}
