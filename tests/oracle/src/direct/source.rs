//! Lights without a surface: points, cones, parallel light and skies.

use crate::random::{LATTICE, Random};
use crate::vectors::{V3, along, cross, dot, length, sub, unit};
use core::f64::consts::{FRAC_PI_4, PI, TAU};

/// A light without a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum SurfacelessLight {
    /// A point that shines in all directions, or within a cone.
    Point {
        /// Position.
        position: V3,
        /// Radiant intensity, of a cone on its axis.
        intensity: f64,
        /// Where it shines, if not in all directions.
        cone: Option<Cone>,
    },
    /// Parallel light.
    Distant {
        /// Unit vector towards the light.
        towards: V3,
        /// Irradiance of a surface that faces it.
        irradiance: f64,
    },
    /// Light from all around, which rays see that hit nothing.
    Sky(Sky),
}

/// A cone of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Unit vector along which the light travels.
    pub axis: V3,
    /// The angle in radians up to which the intensity is constant, and the one from which on it is 0. Between them it is a smoothstep of
    /// the cosine.
    pub angles: [f64; 2],
}

/// A picture of all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    axes: [V3; 3],
    size: [usize; 2],
    texels: Vec<f64>,
    /// Sums of radiance times solid angle, each with that of its texel.
    sums: Vec<f64>,
}

/// Light that comes along one direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beam {
    /// From the surface towards the light.
    pub(super) to: V3,
    /// Where the light is, in units of `to`.
    pub(super) end: f64,
    /// Irradiance of a surface that faces it.
    pub(super) irradiance: f64,
    /// The same if all of the light came along one direction.
    pub(super) most: f64,
}

impl Cone {
    /// The part of the intensity in the direction of a vector.
    fn falloff(&self, d: V3) -> f64 {
        // by 1 − cos, which small angles have, too
        let angle = length(cross(d, self.axis)).atan2(dot(d, self.axis));
        let versine = |angle: f64| 2.0 * (0.5 * angle).sin().powi(2);
        let [inner, outer] = self.angles.map(versine);
        let x = match versine(angle) {
            less if less <= inner => 1.0,
            more if more >= outer => 0.0,
            between => (outer - between) / (outer - inner),
        };
        x * x * (3.0 - 2.0 * x)
    }
}

impl Sky {
    /// A sky with these axes, of which +z is the pole of the picture; texels are row by row, from +z on. A square picture has them by the
    /// equal-area map of octahedra, where columns are about +x and rows about +y, and any other by the azimuth from +x and the angle to +z.
    #[must_use]
    pub fn new(axes: [V3; 3], columns: usize, texels: Vec<f64>) -> Self {
        let mut sky = Self { axes, size: [columns, texels.len() / columns], texels, sums: Vec::new() };
        let mut sum = 0.0;
        for (i, texel) in sky.texels.iter().enumerate() {
            sum += texel * sky.solid_angle(i / columns);
            sky.sums.push(sum);
        }
        sky
    }
    /// ∫L dω.
    #[must_use]
    pub fn flux(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }
    fn is_square(&self) -> bool {
        self.size[0] == self.size[1]
    }
    /// The cosine of the angle to the pole where a row of longitudes and latitudes begins.
    fn edge(&self, row: f64) -> f64 {
        (PI * row / self.size[1] as f64).cos()
    }
    fn solid_angle(&self, row: usize) -> f64 {
        let [columns, rows] = self.size.map(|n| n as f64);
        match self.is_square() {
            true => 4.0 * PI / (columns * rows),
            false => TAU / columns * (self.edge(row as f64) - self.edge(row as f64 + 1.0)),
        }
    }
    /// The direction, in the sky's space, of a place in a texel that is uniform by solid angle.
    fn direction(&self, texel: usize, [s, t]: [f64; 2]) -> V3 {
        let [columns, rows] = self.size.map(|n| n as f64);
        let (x, y) = ((texel % self.size[0]) as f64, (texel / self.size[0]) as f64);
        if !self.is_square() {
            let (from, to) = (self.edge(y), self.edge(y + 1.0));
            let z = from + (to - from) * t;
            let (turn, r) = (TAU * (x + s) / columns, (1.0 - z * z).max(0.0).sqrt());
            return [r * turn.cos(), r * turn.sin(), z];
        }
        let [u, v] = [(x + s) / columns, (y + t) / rows].map(|x| 2.0 * x - 1.0);
        // along rings about the pole, which is in the middle, and the other pole, which is at the corners
        let inside = 1.0 - u.abs() - v.abs();
        let ring = 1.0 - inside.abs();
        let turn = if ring > 0.0 { FRAC_PI_4 * ((v.abs() - u.abs()) / ring + 1.0) } else { 0.0 };
        let r = ring * (2.0 - ring * ring).max(0.0).sqrt();
        [(r * turn.cos()).copysign(u), (r * turn.sin()).copysign(v), (1.0 - ring * ring).copysign(inside)]
    }
    /// The texel of a direction in world space.
    fn texel(&self, d: V3) -> usize {
        let [x, y, z] = self.axes.map(|axis| dot(axis, d));
        let ring = (1.0 - z.abs()).max(0.0).sqrt();
        let place = if self.is_square() {
            let share = y.abs().atan2(x.abs()) / (2.0 * FRAC_PI_4);
            let (u, v) = (ring * (1.0 - share), ring * share);
            let (u, v) = if z < 0.0 { (1.0 - v, 1.0 - u) } else { (u, v) };
            [u.copysign(x), v.copysign(y)].map(|x| 0.5 * (x + 1.0))
        } else {
            [(y.atan2(x) / TAU).rem_euclid(1.0), z.clamp(-1.0, 1.0).acos() / PI]
        };
        let [x, y] = [0, 1].map(|k| ((place[k] * self.size[k] as f64) as usize).min(self.size[k] - 1));
        y * self.size[0] + x
    }
}

impl SurfacelessLight {
    /// The radiance that a ray sees which hits nothing, along a unit vector.
    pub(super) fn radiance(&self, d: V3) -> f64 {
        if let Self::Sky(sky) = self { sky.texels[sky.texel(d)] } else { 0.0 }
    }
    /// The light that reaches a point which nothing hides; that of a sky by so many samples.
    pub(super) fn beams(&self, from: V3, count: usize, random: &mut Random) -> Vec<Beam> {
        match self {
            Self::Point { position, intensity, cone } => {
                let to = sub(*position, from);
                let part = cone.map_or(1.0, |cone| cone.falloff(unit(to.map(|x| -x))));
                let irradiance = intensity * part / dot(to, to);
                vec![Beam { to, end: 1.0, irradiance, most: irradiance }]
            }
            Self::Distant { towards, irradiance } => {
                vec![Beam { to: *towards, end: f64::INFINITY, irradiance: *irradiance, most: *irradiance }]
            }
            Self::Sky(sky) => {
                let all = sky.flux();
                let (offset, shift) = (random.unit(), [random.unit(), random.unit()]);
                let beam = |i: usize| {
                    let target = (i as f64 + offset) / count as f64 * all;
                    let texel = sky.sums.partition_point(|sum| *sum <= target).min(sky.texels.len() - 1);
                    let d = sky.direction(texel, [0, 1].map(|k| (shift[k] + LATTICE[k] * i as f64).fract()));
                    let to = (0..3).fold([0.0; 3], |sum, k| along(sum, sky.axes[k], d[k]));
                    Beam { to, end: f64::INFINITY, irradiance: all / count as f64, most: all }
                };
                (0..count).map(beam).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions of texels are within their texels, and as even as their solid angle.
    #[test]
    fn skies_know_their_texels() {
        let mut random = Random(1);
        for size in [[1, 1], [4, 4], [5, 5], [6, 3], [3, 7]] {
            let sky =
                Sky::new([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], size[0], vec![1.0; size[0] * size[1]]);
            let all = sky.flux();
            assert!((all - 4.0 * PI).abs() < 1e-12, "{size:?}: {all}");
            let mut mean = [0.0; 4];
            for texel in 0..sky.texels.len() {
                for _ in 0..1000 {
                    let d = sky.direction(texel, [random.unit(), random.unit()]);
                    assert!((length(d) - 1.0).abs() < 1e-12);
                    let world = (0..3).fold([0.0; 3], |sum, k| along(sum, sky.axes[k], d[k]));
                    assert_eq!(sky.texel(world), texel, "{size:?} {d:?}");
                    let share = sky.solid_angle(texel / size[0]) / 1000.0;
                    let terms = [d[0] * d[0], d[1] * d[1], d[2] * d[2], d[2]];
                    mean = std::array::from_fn(|k| mean[k] + share * terms[k]);
                }
            }
            for (found, right) in mean.into_iter().zip([all / 3.0, all / 3.0, all / 3.0, 0.0]) {
                assert!((found - right).abs() < 0.25, "{size:?}: {mean:?}");
            }
        }
    }
}
