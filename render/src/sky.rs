//! Light from infinitely far away, looked up and sampled in packets.

use crate::packet::{V8, X8};
use crate::scene;
use crate::technique::Measure;
use etendue::light::ImageEnvironment;
use etendue::{ConstantEnvironment, LightSample, LightSampler, Vec2, Vec3, Warp, u32x8};

/// An environment and the table by which it is sampled.
#[derive(Clone, Debug)]
pub struct Sky {
    /// Rows of the rotation from the world to the light.
    rows: [[f32; 3]; 3],
    kind: SkyKind,
}

#[derive(Clone, Debug)]
enum SkyKind {
    Constant([f32; 3]),
    Image { width: usize, map: etendue::light::EnvironmentMap, texels: Vec<[f32; 3]>, table: Vec<f32> },
}

impl Sky {
    /// Builds the table.
    pub fn new(environment: &scene::Environment) -> Self {
        let kind = match &environment.sky {
            scene::SkyRadiance::Constant(radiance) => SkyKind::Constant(*radiance),
            scene::SkyRadiance::Image { width, map, texels } => {
                let weights: Vec<f32> = texels.iter().map(|t| t.iter().sum()).collect();
                let mut table = vec![0.0; ImageEnvironment::buffer(*width, texels.len() / width)];
                ImageEnvironment::build(&weights, *width, *map, &mut table)
                    .expect("the scene reader has checked the texels");
                SkyKind::Image { width: *width, map: *map, texels: texels.clone(), table }
            }
        };
        Self { rows: environment.to_light, kind }
    }
    /// ∫L dω, summed over channels.
    pub fn flux(&self) -> f64 {
        let sum = |rgb: &[f32; 3]| rgb.iter().map(|&x| f64::from(x)).sum::<f64>();
        match &self.kind {
            SkyKind::Constant(radiance) => 4.0 * std::f64::consts::PI * sum(radiance),
            SkyKind::Image { width, map, texels, .. } => {
                let height = texels.len() / width;
                let rows = texels.chunks(*width).enumerate();
                rows.map(|(y, row)| row.iter().map(sum).sum::<f64>() * map.texel_solid_angle(*width, height, y)).sum()
            }
        }
    }
    #[inline]
    fn to_light(&self, w: V8) -> V8 {
        let [x, y, z] = self.rows.map(|row| V8::from(row).dot(w));
        Vec3::new(x, y, z)
    }
    #[inline]
    fn to_world(&self, w: V8) -> V8 {
        let [x, y, z] = self.rows.map(V8::from);
        x.mul_add(w.x, y.mul_add(w.y, z * w.z))
    }
    /// Radiance from a direction.
    #[inline]
    pub fn radiance(&self, direction: V8) -> V8 {
        match &self.kind {
            SkyKind::Constant(radiance) => (*radiance).into(),
            SkyKind::Image { width, texels, .. } => {
                let texel = self.image().texel(self.to_light(direction));
                gather(texels, *width, texel.x, texel.y)
            }
        }
    }
    /// Samples a direction; returns it with its pdf per steradian, and the radiance from there.
    #[inline]
    pub fn sample(&self, measure: Measure, normal: V8, u: Vec2<X8>) -> (LightSample<X8>, V8) {
        match &self.kind {
            SkyKind::Constant(radiance) => {
                let sample = match measure {
                    Measure::Projected => ConstantEnvironment.by_projected_solid_angle(normal).sample(u),
                    _ => ConstantEnvironment.by_solid_angle().sample(u),
                };
                (sample, (*radiance).into())
            }
            SkyKind::Image { width, texels, .. } => {
                let mut drawn = self.image().draw(u);
                drawn.light.direction = self.to_world(drawn.light.direction);
                (drawn.light, gather(texels, *width, drawn.x, drawn.y))
            }
        }
    }
    /// Pdf per steradian with which [`sample`](Self::sample) draws a direction.
    #[inline]
    pub fn pdf(&self, measure: Measure, normal: V8, direction: V8) -> X8 {
        match (&self.kind, measure) {
            (SkyKind::Constant(_), Measure::Projected) => {
                ConstantEnvironment.by_projected_solid_angle(normal).pdf(direction)
            }
            (SkyKind::Constant(_), _) => ConstantEnvironment.by_solid_angle().pdf(direction),
            (SkyKind::Image { .. }, _) => self.image().pdf(self.to_light(direction)),
        }
    }
    #[inline]
    fn image(&self) -> ImageEnvironment<'_> {
        match &self.kind {
            SkyKind::Image { width, map, table, .. } => {
                ImageEnvironment::from_buffer(table, *width, *map).expect("a table of its own size")
            }
            SkyKind::Constant(_) => unreachable!("a constant sky has no image"),
        }
    }
}

#[inline]
fn gather(texels: &[[f32; 3]], width: usize, x: u32x8, y: u32x8) -> V8 {
    let (x, y) = (x.to_array(), y.to_array());
    let each: [[f32; 3]; 8] = std::array::from_fn(|i| texels[y[i] as usize * width + x[i] as usize]);
    let channel = |k: usize| X8::from(each.map(|t| t[k]));
    Vec3::new(channel(0), channel(1), channel(2))
}
