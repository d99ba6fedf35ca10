//! Pictures that shapes emit.

mod mean;
mod repeats;

use super::limits::MOST_RADIANCE;
use super::texture::{Mapping, Picture, Wrap};
use crate::geometry::{Chart, Geometry};
use crate::packet::{M8, V8, X8, each_bit};
use etendue::{Mask, Real, Vec2};
use repeats::Pyramid;
use std::f32::consts::{FRAC_1_PI, PI};

/// A picture that a shape emits.
#[derive(Clone, Debug, PartialEq)]
pub struct LightPicture {
    /// The picture. Its mapping takes the coordinates of the surface: (s, t) of the point v0 + s (v1 − v0) + t (v2 − v0) of a triangle
    /// or p + s u + t v of a parallelogram; (φ/2π, 1 − θ/π) of a sphere.
    pub picture: Picture,
    /// Radiance where the picture is 1, linear RGB.
    pub factor: [f32; 3],
    /// Rows of the orthogonal matrix from world space to the axes of a sphere, where θ is the angle to +z, and φ that about it, from +x
    /// towards +y; the identity for flat shapes.
    pub axes: [[f32; 3]; 3],
}

/// World axes.
pub const WORLD: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The mapping from coordinates of a flat surface to texture coordinates, which are given for (0, 0), (1, 0) and (0, 1).
pub fn affine([origin, first, second]: [[f64; 2]; 3]) -> Mapping {
    Mapping([0, 1].map(|k| [first[k] - origin[k], second[k] - origin[k], origin[k]].map(|x| x as f32)))
}

/// The range of texture coordinates of a cell.
fn in_uv(chart: Chart, s: [f64; 2], t: [f64; 2]) -> [[f64; 2]; 2] {
    match chart {
        Chart::Sphere => {
            let row = |s: f64| 1.0 - libm::acos(1.0 - 2.0 * s) * std::f64::consts::FRAC_1_PI;
            [t, [row(s[1]), row(s[0])]]
        }
        Chart::Triangle | Chart::Parallelogram => [s, t],
    }
}

impl LightPicture {
    /// The mean radiance over a shape, linear RGB: that of the interpolated picture over the shape's area, but for rounding. It is 0 only
    /// where all of the shape is dark.
    ///
    /// `most` is the greatest number of cells between texels to look at, and what remains of it afterwards. If the shape has more, or shows
    /// no pictures, the mean of the whole picture stands for its own.
    pub fn mean_over(&self, geometry: &Geometry, most: &mut u64) -> [f64; 3] {
        let mut over = |corners: &[[f64; 2]]| mean::over_polygon(&self.picture, corners, most);
        let mean = match geometry.chart() {
            Some(Chart::Triangle) => over(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
            Some(Chart::Parallelogram) => over(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
            Some(Chart::Sphere) => Some(mean::over_sphere(&self.picture)),
            None => None,
        };
        let mean = mean.unwrap_or_else(|| self.picture.texels.average());
        std::array::from_fn(|k| mean[k] * f64::from(self.factor[k]))
    }

    /// The mean of the sum of the channels over a cell of a shape, from `s[0]` to `s[1]` and from `t[0]` to `t[1]` in its coordinates: of a flat
    /// shape (s, t), of a sphere (1 − z)/2 and φ/2π about its axes. Of a cell of a sphere it is the mean over angles. `None` if the picture
    /// is repeated too often.
    pub fn mean_of_cell(&self, chart: Chart, s: [f64; 2], t: [f64; 2]) -> Option<f64> {
        /// The most cells between texels.
        const MOST: u64 = 1 << 14;
        let [s, t] = in_uv(chart, s, t);
        let corners = [[s[0], t[0]], [s[1], t[0]], [s[1], t[1]], [s[0], t[1]]];
        let mean = mean::over_polygon(&self.picture, &corners, &mut { MOST })?;
        Some((0..3).map(|k| mean[k] * f64::from(self.factor[k])).sum())
    }

    /// Where a cell of a shape is in its picture, in units of texels: the least and the greatest position.
    fn span(&self, chart: Chart, s: [f64; 2], t: [f64; 2]) -> [[f64; 2]; 2] {
        let [s, t] = in_uv(chart, s, t);
        let size = [self.picture.texels.width, self.picture.texels.height].map(|n| n as f64);
        let ends = |of: fn(f64, f64) -> f64, start: f64| -> [f64; 2] {
            std::array::from_fn(|axis| {
                let [a, b, c] = self.picture.mapping.0[axis].map(f64::from);
                let at = |s: f64, t: f64| (a * s + b * t + c) * size[axis];
                [at(s[0], t[0]), at(s[1], t[0]), at(s[0], t[1]), at(s[1], t[1])].into_iter().fold(start, of)
            })
        };
        [ends(f64::min, f64::INFINITY), ends(f64::max, f64::NEG_INFINITY)]
    }

    /// About the means of the sum of the channels over cells of a shape, as [`mean_of_cell`](Self::mean_of_cell) has them, but by blocks of texels about the
    /// cells, which takes a time that does not depend on how many texels they show. They are 0 only where all is dark.
    pub(crate) fn coarse<'a>(&'a self, chart: Chart) -> impl Fn([f64; 2], [f64; 2]) -> f64 + Sync + 'a {
        let pyramid = Pyramid::new(&self.picture);
        let factor: f64 = self.factor.iter().map(|&x| f64::from(x)).sum();
        move |s, t| {
            let [low, high] = self.span(chart, s, t);
            pyramid.about(low, high) * factor / 3.0
        }
    }

    /// The number of texels that a cell of a shape shows, or is about to.
    pub(crate) fn texels_of_cell(&self, chart: Chart, s: [f64; 2], t: [f64; 2]) -> f64 {
        let [low, high] = self.span(chart, s, t);
        (high[0] - low[0]).max(1.0) * (high[1] - low[1]).max(1.0)
    }

    /// Along both coordinates, whether the picture is mirrored, if a parallelogram shows all of it, and its edges are clamped or do not
    /// matter.
    #[must_use]
    pub fn whole(&self, geometry: &Geometry) -> Option<[bool; 2]> {
        let Picture { wrap, bilinear, mapping: Mapping([[a, b, c], [d, e, f]]), .. } = self.picture;
        let is_clamped = !bilinear || wrap == [Wrap::Clamp; 2];
        if geometry.chart() != Some(Chart::Parallelogram) || !is_clamped || [b, d] != [0.0; 2] {
            return None;
        }
        let mirrored = |scale: f32, start: f32| match [scale, start] {
            [1.0, 0.0] => Some(false),
            [-1.0, 1.0] => Some(true),
            _ => None,
        };
        Some([mirrored(a, c)?, mirrored(e, f)?])
    }

    /// Radiance of the texel in a column and a row as a parallelogram shows them that shows the [`whole`](Self::whole) picture.
    #[must_use]
    pub fn whole_texel(&self, mirrored: [bool; 2], at: [usize; 2]) -> [f32; 3] {
        let size = [self.picture.texels.width, self.picture.texels.height];
        let [x, y] = [0, 1].map(|k| (if mirrored[k] { size[k] - 1 - at[k] } else { at[k] }) as i64);
        let color = self.picture.texel(x, y);
        std::array::from_fn(|k| color[k] * self.factor[k])
    }

    /// Radiance of a point on a flat shape with these coordinates.
    fn on_flat(&self, st: [f32; 2]) -> [f32; 3] {
        let color = self.picture.at(st);
        // floating-point images may hold any numbers
        std::array::from_fn(|k| (color[k] * self.factor[k]).min(MOST_RADIANCE))
    }

    /// Radiance of the point of a sphere with this outward normal in world space.
    fn on_sphere(&self, normal: [f32; 3]) -> [f32; 3] {
        let [x, y, z] = self.axes.map(|row| row[0] * normal[0] + row[1] * normal[1] + row[2] * normal[2]);
        let turns = libm::atan2f(y, x) * (0.5 * FRAC_1_PI);
        // more accurate near the poles than by the arc cosine of z
        let above = libm::atan2f(z, libm::sqrtf(x * x + y * y));
        self.on_flat([if turns < 0.0 { turns + 1.0 } else { turns }, (above + 0.5 * PI) * FRAC_1_PI])
    }

    /// Puts the radiance of points on a shape into these lanes: of a flat one by their coordinates, of a sphere by its outward normals.
    #[inline]
    pub fn show(&self, chart: Chart, lanes: M8, st: Vec2<X8>, outward: V8, radiance: &mut V8) {
        each_bit(lanes.bits(), |lane| {
            let [r, g, b] = match chart {
                Chart::Sphere => self.on_sphere([outward.x, outward.y, outward.z].map(|x| x.lane(lane))),
                Chart::Triangle | Chart::Parallelogram => self.on_flat([st.x.lane(lane), st.y.lane(lane)]),
            };
            radiance.x.as_mut_array()[lane] = r;
            radiance.y.as_mut_array()[lane] = g;
            radiance.z.as_mut_array()[lane] = b;
        });
    }
}
