//! Light from infinitely far away, looked up and sampled in packets.

mod daylight;
mod moments;
mod portals;

use crate::packet::{M8, V8, X8};
use crate::scene;
use crate::technique::Measure;
pub use daylight::GeneralSky;
use etendue::light::{FAR, ImageEnvironment, SunBySolidAngle, Texel};
use etendue::{ConstantEnvironment, LightSample, LightSampler, Mask, Real, Sun, Uint, Vec2, Vec3, Warp, u32x8};
use moments::Moments;
use portals::SkyPortals;

/// An environment and the table by which it is sampled.
#[derive(Clone, Debug)]
pub struct Sky {
    /// Rows of the rotation from the world to the light.
    rows: [[f32; 3]; 3],
    kind: SkyKind,
    /// The moments of the sky without its sun, summed over channels, in the coordinates of the light.
    moments: Moments,
    portals: Option<SkyPortals>,
    sun: Option<SunBefore>,
    /// Whether no part of it is so much brighter than the rest that directions at random would hardly ever meet what matters: a sun.
    pub(crate) is_soft: bool,
}

/// A texel of a soft sky has at most so many times the mean.
const SOFT: f64 = 50.0;

#[derive(Clone, Debug)]
enum SkyKind {
    Constant([f32; 3]),
    Image { width: usize, map: etendue::light::EnvironmentMap, texels: Vec<[f32; 3]>, table: Vec<f32> },
}

/// A sun, and the share of the samples that it has in a sky without portals: a multiple of 2⁻²⁴.
#[derive(Clone, Copy, Debug)]
struct SunBefore {
    disk: scene::SunDisk,
    share: f32,
}

impl SunBefore {
    fn new(disk: scene::SunDisk, sky: f64) -> Self {
        let own = flux_of(&disk);
        // what hides one of them does not hide the other
        let share = (own / (own + sky)).clamp(0.125, 0.875);
        Self { disk, share: ((share * 16_777_216.0).round() / 16_777_216.0) as f32 }
    }
    #[inline]
    fn sampler(&self) -> SunBySolidAngle<X8> {
        Sun::new(self.disk.direction.into(), X8::splat(self.disk.one_minus_cos)).by_solid_angle()
    }
    /// Its radiance from a direction.
    #[inline]
    fn radiance(&self, direction: V8) -> V8 {
        V8::from(self.disk.radiance).keep(self.sampler().pdf(direction).gt(X8::lit(0.0)))
    }
}

/// A sun that is sampled besides its sky, since the sky comes through portals: where one shows the sun, that is most of the light, and
/// elsewhere it takes no ray.
#[derive(Clone, Copy)]
pub struct SunBeside<'a> {
    sun: &'a SunBefore,
    portals: &'a SkyPortals,
}

impl SunBeside<'_> {
    /// Samples a direction from `p`; returns it with its pdf per steradian, and the radiance of the sun alone.
    #[inline]
    pub fn sample(&self, p: V8, u: Vec2<X8>) -> (LightSample<X8>, V8) {
        let sample = self.sun.sampler().sample(u);
        let visible = self.portals.all(|all| all.sees(p, sample.direction));
        let sample = LightSample { distance: X8::lit(FAR), pdf: sample.pdf.keep(visible), emits: visible, ..sample };
        (sample, self.sun.disk.radiance.into())
    }
    /// The radiance of the sun alone from a direction, as `p` sees it, and the pdf per steradian with which [`sample`](Self::sample)
    /// draws it.
    #[inline]
    pub fn radiance_and_pdf(&self, p: V8, direction: V8) -> (V8, X8) {
        let pdf = self.sun.sampler().pdf(direction);
        let is_sun = pdf.gt(X8::lit(0.0));
        if !is_sun.any() {
            return Default::default();
        }
        let visible = is_sun & self.portals.all(|all| all.sees(p, direction));
        (V8::from(self.sun.disk.radiance).keep(visible), pdf.keep(visible))
    }
}

/// ∫L dω of a sun, summed over channels.
fn flux_of(disk: &scene::SunDisk) -> f64 {
    let sum: f64 = disk.radiance.iter().map(|&x| f64::from(x)).sum();
    sum * 2.0 * std::f64::consts::PI * f64::from(disk.one_minus_cos)
}

impl Sky {
    /// Builds the table.
    pub fn new(environment: &scene::Environment) -> Self {
        let mut is_soft = environment.sun.is_none();
        let kind = match &environment.sky {
            scene::SkyRadiance::Constant(radiance) => SkyKind::Constant(*radiance),
            scene::SkyRadiance::Image { width, map, texels } => {
                let weights: Vec<f32> = texels.iter().map(|t| t.iter().sum()).collect();
                let sum: f64 = weights.iter().copied().map(f64::from).sum();
                let greatest = weights.iter().fold(0.0, |most: f32, &x| most.max(x));
                is_soft &= f64::from(greatest) * weights.len() as f64 <= SOFT * sum;
                let mut table = vec![0.0; ImageEnvironment::buffer(*width, texels.len() / width)];
                ImageEnvironment::build(&weights, *width, *map, &mut table)
                    .expect("the scene reader has checked the texels");
                SkyKind::Image { width: *width, map: *map, texels: texels.clone(), table }
            }
        };
        let mut own =
            Self { rows: environment.to_light, kind, moments: Moments::default(), portals: None, sun: None, is_soft };
        own.sun = environment.sun.map(|disk| SunBefore::new(disk, own.flux()));
        own.portals = SkyPortals::new(&environment.portals, own.texel(), |w| own.sum(w));
        if own.portals.is_none() {
            own.moments = own.moments();
        }
        own
    }
    /// Angle that a texel spans, in radians.
    fn texel(&self) -> f64 {
        match &self.kind {
            // as if it had this many
            SkyKind::Constant(_) => std::f64::consts::PI / 64.0,
            SkyKind::Image { width, map, texels, .. } => {
                let height = texels.len() / width;
                (0..height).map(|y| map.texel_solid_angle(*width, height, y)).fold(0.0, f64::max).sqrt()
            }
        }
    }
    /// Radiance of the sky without its sun from a direction, wherever it is seen from, summed over channels.
    fn sum(&self, direction: V8) -> X8 {
        let radiance = self.of_sky(direction);
        radiance.x + radiance.y + radiance.z
    }
    /// ∫L dω of sky and sun, summed over channels, as if there were no portals.
    pub fn flux(&self) -> f64 {
        let sum = |rgb: &[f32; 3]| rgb.iter().map(|&x| f64::from(x)).sum::<f64>();
        let sun = self.sun.as_ref().map_or(0.0, |sun| flux_of(&sun.disk));
        sun + match &self.kind {
            SkyKind::Constant(radiance) => 4.0 * std::f64::consts::PI * sum(radiance),
            SkyKind::Image { width, map, texels, .. } => {
                let height = texels.len() / width;
                let rows = texels.chunks(*width).enumerate();
                rows.map(|(y, row)| row.iter().map(sum).sum::<f64>() * map.texel_solid_angle(*width, height, y)).sum()
            }
        }
    }
    /// The moments of the sky without its sun.
    fn moments(&self) -> Moments {
        match &self.kind {
            SkyKind::Constant(_) => {
                Moments::constant(self.flux() - self.sun.as_ref().map_or(0.0, |sun| flux_of(&sun.disk)))
            }
            SkyKind::Image { width, map, texels, .. } => {
                let (image, size) = (self.image(), [*width, texels.len() / width]);
                Moments::of_image(size, |first, y, offset| {
                    let x = u32x8::from_fn(|lane| (first + lane).min(width - 1) as u32);
                    let y = u32x8::splat(y as u32);
                    let radiance = gather(texels, *width, x, y);
                    let solid_angle = X8::lit(map.texel_solid_angle(size[0], size[1], y.lane(0) as usize));
                    (image.direction(&Texel { x, y, offset }), (radiance.x + radiance.y + radiance.z) * solid_angle)
                })
            }
        }
    }
    /// About the irradiance from what [`sample`](Self::sample) samples, summed over channels, at points of surfaces with these normals, as
    /// if only walls around portals hid any of it. It is 0 only where no portal shows the sky.
    #[inline]
    pub fn irradiance(&self, p: V8, normal: V8) -> X8 {
        if let Some(portals) = &self.portals {
            return portals.irradiance(p, normal);
        }
        let of_sky = self.moments.irradiance(self.to_light(normal));
        match &self.sun {
            Some(sun) => {
                let cos = normal.dot(sun.disk.direction.into()).greater(X8::lit(0.0));
                cos.mul_add(X8::lit(flux_of(&sun.disk)), of_sky)
            }
            None => of_sky,
        }
    }
    /// The direction to the sun, its angular radius in radians, and its radiance.
    pub fn sun(&self) -> Option<([f32; 3], f64, [f32; 3])> {
        let disk = self.sun.as_ref()?.disk;
        // 1 − cosσ = 2 sin²(σ/2)
        let radius = 2.0 * (0.5 * f64::from(disk.one_minus_cos)).sqrt().asin();
        Some((disk.direction, radius, disk.radiance))
    }
    /// The sun, if it is sampled besides the sky.
    pub fn sun_beside(&self) -> Option<SunBeside<'_>> {
        Some(SunBeside { sun: self.sun.as_ref()?, portals: self.portals.as_ref()? })
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
    /// Radiance of a ray from `p` in this direction.
    #[inline]
    pub fn radiance(&self, p: V8, direction: V8) -> V8 {
        self.of_both(direction).keep(self.shows(p, direction))
    }
    /// The same without a [sun beside](Self::sun_beside), and where it is not known to be dark: outside of portals, no ray is needed.
    #[inline]
    pub fn sampled_radiance(&self, p: V8, direction: V8) -> (V8, M8) {
        let shown = self.shows(p, direction);
        let radiance = if shown.any() { self.of_sampled(direction).keep(shown) } else { V8::default() };
        (radiance, shown)
    }
    /// Whether a portal shows the sky, if there are any.
    #[inline]
    fn shows(&self, p: V8, direction: V8) -> M8 {
        self.portals.as_ref().map_or(M8::splat(true), |portals| portals.all(|all| all.sees(p, direction)))
    }
    /// Radiance of sky and sun, as if there were no portals.
    #[inline]
    fn of_both(&self, direction: V8) -> V8 {
        let of_sky = self.of_sky(direction);
        match &self.sun {
            Some(sun) => of_sky + sun.radiance(direction),
            None => of_sky,
        }
    }
    /// The part of it that [`sample`](Self::sample) samples.
    #[inline]
    fn of_sampled(&self, direction: V8) -> V8 {
        if self.portals.is_some() { self.of_sky(direction) } else { self.of_both(direction) }
    }
    #[inline]
    fn of_sky(&self, direction: V8) -> V8 {
        match &self.kind {
            SkyKind::Constant(radiance) => (*radiance).into(),
            SkyKind::Image { width, texels, .. } => {
                let texel = self.image().texel(self.to_light(direction));
                gather(texels, *width, texel.x, texel.y)
            }
        }
    }
    /// Samples a direction from `p`; returns it with its pdf per steradian, and the radiance from there without a
    /// [sun beside](Self::sun_beside).
    #[inline]
    pub fn sample(&self, measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> (LightSample<X8>, V8) {
        let sample = match (&self.portals, &self.sun) {
            (None, None) => return self.sample_sky(measure, normal, u),
            (None, Some(sun)) => self.sample_both(sun, measure, normal, u),
            (Some(portals), _) => portals.all(|all| all.by_radiance_above(p, normal).sample(u)),
        };
        (sample, self.of_sampled(sample.direction))
    }
    /// Samples the sun or the sky.
    #[inline]
    fn sample_both(&self, sun: &SunBefore, measure: Measure, normal: V8, u: Vec2<X8>) -> LightSample<X8> {
        let (zero, one) = (X8::lit(0.0), X8::lit(1.0));
        let share = X8::splat(sun.share);
        let is_sun = u.x.lt(share);
        let (start, size) = (Real::blend(is_sun, zero, share), Real::blend(is_sun, share, one - share));
        let u = Vec2::new((u.x - start) / size, u.y);
        let (of_sky, sampler) = (self.sample_sky(measure, normal, u).0, sun.sampler());
        let direction = V8::blend(is_sun, sampler.sample(u).direction, of_sky.direction);
        let pdf = || self.pdf_of_sky(measure, normal, direction);
        let sky_pdf = if is_sun.any() { Real::blend(is_sun, pdf(), of_sky.pdf) } else { of_sky.pdf };
        let pdf = share * sampler.pdf(direction) + (one - share) * sky_pdf;
        LightSample { direction, distance: X8::lit(FAR), pdf, emits: M8::splat(true), ..of_sky }
    }
    #[inline]
    fn sample_sky(&self, measure: Measure, normal: V8, u: Vec2<X8>) -> (LightSample<X8>, V8) {
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
    /// Pdf per steradian with which [`sample`](Self::sample) draws a direction from `p`.
    #[inline]
    pub fn pdf(&self, measure: Measure, p: V8, normal: V8, direction: V8) -> X8 {
        if let Some(portals) = &self.portals {
            return portals.all(|all| all.by_radiance_above(p, normal).pdf(direction));
        }
        let of_sky = self.pdf_of_sky(measure, normal, direction);
        match &self.sun {
            Some(sun) => {
                let share = X8::splat(sun.share);
                share * sun.sampler().pdf(direction) + (X8::lit(1.0) - share) * of_sky
            }
            None => of_sky,
        }
    }
    #[inline]
    fn pdf_of_sky(&self, measure: Measure, normal: V8, direction: V8) -> X8 {
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
