//! Bodies of the fuzz targets: plain functions of bytes that assert properties. The fuzzer supplies the bytes; a test runs the same
//! functions on the committed seeds and on random bytes.
//!
//! Every body reads its bytes as numbers at which methods break ([`Input`]): signed zeros, subnormal numbers, ulps about 1, the ends of the
//! f32 range; vectors that are equal, opposite, collinear, or a few ulps from that.

mod light_tree;
mod lights;
mod numbers;
mod pictures;
mod reflections;
pub mod run;
mod sequences;
mod sets;
mod shapes;
mod skies;
mod surfaces;

use crate::area_lights::{LightShape::*, Measure::*};
use crate::generators::{self, EDGES, NASTY, Random};
use arbitrary::Unstructured;

/// A fuzz target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Name of the binary and of the folder with its seeds.
    pub name: &'static str,
    /// The function that runs one input.
    pub body: fn(&[u8]),
    /// Weight of this target in tests: the more work an input is, the lower.
    pub share: u32,
}

macro_rules! targets {
    ($($module:ident: $($name:ident $share:literal $(= $function:ident($($argument:expr),+))?)+;)+) => {
        $($(
            #[doc = concat!("The body of the target `", stringify!($name), "`, which its module describes.")]
            ///
            /// # Panics
            /// If a property is broken.
            pub fn $name(bytes: &[u8]) {
                targets!(@call $module $name &mut Input::new(bytes) $(, $function $($argument)+)?);
            }
        )+)+
        /// All targets except those of files, which are the renderer's.
        pub const TARGETS: &[Target] = &[$($(Target { name: stringify!($name), body: $name, share: $share }),+),+];
    };
    (@call $module:ident $name:ident $input:expr) => { $module::$name($input) };
    (@call $module:ident $name:ident $input:expr, $function:ident $($argument:expr)+) => { $module::$function($($argument,)+ $input) };
}
targets! {
    shapes: cone 700 fixed_warps 700 bilinear 700 visible_normals 400 spherical_cap 400 = seen(Sphere, SolidAngle)
        projected_cap 30 = seen(Sphere, ProjectedSolidAngle) spherical_triangle 150 = seen(Triangle, SolidAngle)
        spherical_parallelogram 100 = seen(Parallelogram, SolidAngle) spherical_rectangle 150 = seen(Rectangle, SolidAngle)
        spherical_polygon 100 spherical_disk 100 = seen(Disk, SolidAngle) spherical_segment 150 = segment(0)
        projected_segment 100 = segment(1) projected_triangle 50 = seen(Triangle, ProjectedSolidAngle) projected_polygon 50;
    surfaces: patch_surface 20;
    lights: sphere_light 90 = area_light(Sphere) triangle_light 90 = area_light(Triangle) parallelogram_light 90 = area_light(Parallelogram)
        rectangle_light 90 = area_light(Rectangle) disk_light 90 = area_light(Disk) polygon_light 90 = area_light(Polygon)
        patch_light 90 = area_light(Patch) line_light 90 = area_light(Line) point_light 140 = distant_light(PointLight, Delta)
        spot_light 140 = distant_light(SpotLight, Delta) directional_light 140 = distant_light(DirectionalLight, Delta)
        sun_light 140 = distant_light(Sun, SolidAngle) constant_light 140;
    numbers: environment 300 piecewise_constant 500 light_choice 500 bits 600;
    pictures: pictures 200;
    skies: portals 30;
    light_tree: light_tree 20;
    reflections: reflection 200;
    sets: set_of_lights 60;
    sequences: sequence 500;
}

/// The fuzzer's bytes, read as numbers at which methods break. Missing bytes are zeros.
#[derive(Debug)]
pub struct Input<'a>(Unstructured<'a>);

impl<'a> Input<'a> {
    /// Reads from `bytes`.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(Unstructured::new(bytes))
    }
    /// An integer below `n`.
    pub fn below(&mut self, n: u8) -> u8 {
        self.0.arbitrary::<u8>().unwrap_or(0) % n
    }
    /// 32 bits.
    pub fn word(&mut self) -> u32 {
        self.0.arbitrary().unwrap_or(0)
    }
    /// 64 bits.
    pub fn seed(&mut self) -> u64 {
        self.0.arbitrary().unwrap_or(0)
    }
    /// Numbers that are bytes of the input themselves, eight each; after its end, any.
    fn numbers(&mut self, count: usize) -> Random {
        let there = self.0.len() / size_of::<u64>();
        Random::of((0..count.min(there)).map(|_| self.seed()).collect())
    }
    /// A multiple of 2⁻²⁴ in [0, 1), often one of [`EDGES`].
    pub fn unit(&mut self) -> f32 {
        if self.below(3) == 0 {
            EDGES[self.below(EDGES.len() as u8) as usize]
        } else {
            (self.word() >> 8) as f32 / 16_777_216.0
        }
    }
    /// A point of the unit square.
    pub fn square(&mut self) -> [f32; 2] {
        [self.unit(), self.unit()]
    }
    /// A number in [−2, 2).
    pub fn ordinary(&mut self) -> f32 {
        (self.word() >> 8) as f32 / 4_194_304.0 - 2.0
    }
    /// Any finite number, biased towards those that break methods.
    pub fn number(&mut self) -> f32 {
        let sign = |word: u32, x: f32| if word & 1 == 1 { -x } else { x };
        match self.below(8) {
            0 => NASTY[self.below(NASTY.len() as u8) as usize],
            1 => {
                let word = self.word();
                sign(word, f32::from_bits(1.0_f32.to_bits() - 4 + (word >> 1) % 9))
            }
            2 => {
                let word = self.word();
                sign(word, f32::from_bits(word >> 9))
            }
            3 | 4 => {
                let exponent = f32::from(self.below(60)) - 30.0;
                self.ordinary() * (2.0 * exponent).exp2()
            }
            5 => {
                let x = f32::from_bits(self.word());
                if x.is_finite() { x } else { 0.0 }
            }
            _ => self.ordinary(),
        }
    }
    /// A finite number ≥ 0, biased in the same way.
    pub fn weight(&mut self) -> f32 {
        self.number().abs()
    }
    /// A vector, often related to one of `before`.
    pub fn vector(&mut self, before: &[[f32; 3]]) -> [f32; 3] {
        let kind = self.below(10);
        if let (true, false) = (kind < 5, before.is_empty()) {
            let v = before[self.below(before.len() as u8) as usize];
            return match kind {
                0 => v,
                1 => v.map(|x| -x),
                2 => {
                    let scale = self.ordinary();
                    v.map(|x| x * scale).map(|x| if x.is_finite() { x } else { f32::MAX })
                }
                3 => v.map(|x| if x.abs() < 1e38 { f32::from_bits(x.to_bits() ^ u32::from(self.below(4))) } else { x }),
                _ => {
                    let w = before[self.below(before.len() as u8) as usize];
                    let sum = [v[0] + w[1], v[1] + w[2], v[2] + w[0]];
                    if sum.iter().all(|x| x.is_finite()) { sum } else { v }
                }
            };
        }
        match kind {
            0 | 5 => [self.number(), self.number(), self.number()],
            1 | 6 => {
                let mut v = [0.0; 3];
                v[self.below(3) as usize] = self.number();
                v
            }
            2 | 7 => {
                // the whole vector is far or tiny
                let scale = (2.0 * (f32::from(self.below(80)) - 40.0)).exp2();
                [(); 3].map(|()| self.ordinary() * scale)
            }
            _ => [(); 3].map(|()| self.ordinary()),
        }
    }
    /// A unit vector, up to rounding.
    pub fn direction(&mut self) -> [f32; 3] {
        let v = self.vector(&[]).map(f64::from);
        let length = etendue_oracle::length(v);
        if length > 0.0 { v.map(|x| (x / length) as f32) } else { [0.0, 0.0, 1.0] }
    }
    /// Between 1 and `most` weights.
    pub fn weights(&mut self, most: u8) -> Vec<f32> {
        let n = 1 + self.below(most);
        (0..n).map(|_| self.weight()).collect()
    }
    /// One of the cases that a generator makes, of numbers of the input.
    fn case<S: Copy>(&mut self, cases: impl Fn(usize, Random) -> Vec<generators::Case<S>>) -> generators::Case<S> {
        let which = self.below(u8::MAX) as usize;
        let all = cases(1, self.numbers(18));
        all[which % all.len()]
    }
    /// What [`properties::pointwise`](crate::properties::pointwise) draws.
    fn points(&mut self) -> Random {
        self.numbers(16)
    }
}

/// Whether all lengths are 0 or within this factor of 1, so that a factor of 2^±20 neither overflows nor underflows.
pub fn scalable(lengths: &[f32], within: f32) -> bool {
    lengths.iter().all(|x| *x == 0.0 || (1.0 / within..within).contains(&x.abs()))
}
