//! Direct lighting in double precision: exhaustive over all bodies, without any offset of points from their surfaces.
//!
//! A point of a flat body is never hidden by that body, nor by one in the same plane; a sphere hides nothing from its outside, and from
//! its inside what is outside. Flat lights emit on the side of their normal, unless they are two-sided. Lights occlude. All surfaces
//! reflect on both of their sides. A smooth surface receives only light that is above both its flat triangle and its own normal's horizon.
//! What has holes lets a part of each ray pass, all of which are followed to the light and to the camera. Skies and lights with pictures are
//! sampled. The rest is exact, up to the rounding of f64: closed forms over what blockers leave of a light, at
//! points that sample the pixel and the lens.

mod light;
mod metal;
mod pattern;
mod scene;
mod source;

pub use metal::{fresnel, microfacets};
pub use pattern::{Beyond, Pattern, Picture, PositionMap};
pub use scene::{Body, Detail, Emission, Finish, Form, Lens, Opacity, View};
pub use source::{Cone, Sky, SurfacelessLight};

use crate::random::Random;
use crate::vectors::{V3, along, dot, sub, unit};
use light::{Receiver, SeenLight, transmittance};
use metal::brdf;
use scene::{Hit, Prepared, hits};

/// How much to compute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Independent estimates per pixel, at least 2, from whose differences errors are known.
    pub replicates: usize,
    /// Points per pixel and estimate: the square of this.
    pub side: usize,
    /// Points per light where no closed form is known.
    pub points: usize,
    /// Greatest number of perfect mirrors along a ray.
    pub depth: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Moves points that reflect off their surface, by this fraction of the greatest coordinate of the point and of the ray's origin, and
    /// positions in pictures: 0, or the error of another renderer's, to find what comes of it.
    pub lift: f64,
    /// The end of the way from a point to a light, as a fraction of it, that is never occluded: surfaces flush with a light do not hide it.
    /// [`SPARED`], or more, to find what comes of it.
    pub spared: f64,
}

/// Points of a sky, relative to those of a light.
const SKY: usize = 16;

/// The least end of a way to a light that is never occluded, as a fraction of it.
pub const SPARED: f64 = 1.0 / 1_048_576.0;

/// The mean over a block of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Block {
    /// Radiance.
    pub mean: f64,
    /// Standard error of the mean.
    pub error: f64,
    /// Radiance if nothing hid the lights from the surfaces.
    pub unoccluded: f64,
    /// Greatest value, among the points that were sampled, of one sample of a light by solid angle or by area, and the radiance of lights
    /// that may be seen: far above the mean where few points receive light, where little of the light is above the horizon, or where it is
    /// tiny.
    pub greatest: f64,
}

/// Renders the blocks of `side` × `side` pixels of an image, row by row from the top left; the last ones of a row or column may be smaller.
#[must_use]
pub fn render(bodies: &[Body], sources: &[SurfacelessLight], view: &View, side: usize, effort: &Effort) -> Vec<Block> {
    let bodies: Vec<Prepared> = bodies.iter().map(|body| Prepared::new(body.clone())).collect();
    let lights = (0..bodies.len()).filter(|&i| bodies[i].body.emission.is_some()).collect();
    let tracer = Tracer { bodies, lights, sources, effort };
    let [columns, rows] = view.size.map(|size| size.div_ceil(side));
    let mut blocks = vec![Block::default(); columns * rows];
    let mut counts = vec![0.0; blocks.len()];
    for y in 0..view.size[1] {
        for x in 0..view.size[0] {
            let mut random = Random(effort.seed ^ ((y * view.size[0] + x) as u64).wrapping_mul(0xd134_2543_de82_ef95));
            let block = &mut blocks[y / side * columns + x / side];
            let (mut sum, mut squares, mut unoccluded) = (0.0, 0.0, 0.0);
            for _ in 0..effort.replicates {
                let [seen, all, greatest] = tracer.pixel(view, [x, y], &mut random);
                sum += seen;
                squares += seen * seen;
                unoccluded += all;
                block.greatest = block.greatest.max(greatest);
            }
            let n = effort.replicates as f64;
            block.mean += sum / n;
            block.error += (squares / n - (sum / n).powi(2)).max(0.0) / (n - 1.0);
            block.unoccluded += unoccluded / n;
            counts[y / side * columns + x / side] += 1.0;
        }
    }
    let emitting = tracer.lights.iter().map(|&light| &tracer.bodies[light].body);
    for (body, [from, to]) in emitting.filter_map(|body| Some((body, view.around(&body.form)?))) {
        // what is seen of a light may be as rare as samples of it
        for (x, y) in (from[1]..=to[1]).flat_map(|y| (from[0]..=to[0]).map(move |x| (x, y))) {
            let block = &mut blocks[y / side * columns + x / side];
            block.greatest = block.greatest.max(body.emission.map_or(0.0, |emission| emission.radiance));
        }
    }
    for (block, count) in blocks.iter_mut().zip(counts) {
        block.mean /= count;
        block.error = block.error.sqrt() / count;
        block.unoccluded /= count;
    }
    blocks
}

struct Tracer<'a> {
    bodies: Vec<Prepared>,
    lights: Vec<usize>,
    sources: &'a [SurfacelessLight],
    effort: &'a Effort,
}

impl Tracer<'_> {
    /// One estimate of a pixel's radiance, of what it would be if nothing hid the lights, and the greatest value of one sample of a light.
    fn pixel(&self, view: &View, [x, y]: [usize; 2], random: &mut Random) -> [f64; 3] {
        let side = self.effort.side;
        let (mut sum, mut greatest) = ([0.0; 2], 0.0_f64);
        for i in 0..side * side {
            let at = |k: usize, stratum: usize, random: &mut Random| {
                [x, y][k] as f64 + (stratum as f64 + random.unit()) / side as f64
            };
            let film = [at(0, i % side, random), at(1, i / side, random)];
            let lens = if view.lens.is_some() { random.disk() } else { [0.0; 2] };
            let (origin, direction) = view.ray(film, lens);
            let [seen, all, most] = self.radiance([origin, unit(direction)], None, 0, random);
            sum = [sum[0] + seen, sum[1] + all];
            greatest = greatest.max(most);
        }
        let [seen, all] = sum.map(|x| x / (side * side) as f64);
        [seen, all, greatest]
    }
    /// The radiance that comes along a ray from its origin, on the body `own` if on any, after so many mirrors.
    fn radiance(&self, ray: [V3; 2], own: Option<usize>, depth: usize, random: &mut Random) -> [f64; 3] {
        let (mut sum, mut left) = ([0.0; 3], 1.0);
        for (hit, chance) in hits(&self.bodies, ray[0], ray[1], own, self.effort.lift) {
            let [seen, all, greatest] = self.leaving(hit, ray, depth, random);
            sum = [sum[0] + chance * seen, sum[1] + chance * all, sum[2].max(greatest)];
            left -= chance;
        }
        let beyond = self.sources.iter().map(|source| source.radiance(ray[1])).sum::<f64>() * left;
        [sum[0] + beyond, sum[1] + beyond, sum[2].max(beyond)]
    }
    /// The radiance that leaves a body against a ray.
    fn leaving(&self, hit: Hit, [origin, direction]: [V3; 2], depth: usize, random: &mut Random) -> [f64; 3] {
        let met = &self.bodies[hit.index];
        let mut point = along(origin, direction, hit.t);
        let outward = match met.body.form {
            Form::Sphere { center, radius } => {
                let outward = unit(sub(point, center));
                point = along(center, outward, radius);
                outward
            }
            Form::Flat { .. } => met.normal,
        };
        let front = dot(outward, direction) < 0.0;
        let emission = met.body.emission.filter(|emission| front || emission.two_sided);
        let own = emission.map_or(0.0, |emission| emission.radiance);
        let flat = if front { outward } else { outward.map(|x| -x) };
        let smooth = met.smooth(point, flat, direction);
        let normal = smooth.unwrap_or(flat);
        let finish = met.finish(point, self.effort.lift);
        let cos = -dot(normal, direction);
        let greatest = point.iter().chain(&origin).fold(0.0, |m: f64, x| m.max(x.abs()));
        point = along(point, flat, self.effort.lift * greatest);
        let reflectance = match finish {
            Finish::Mirror(reflectance) => reflectance,
            Finish::Metal { eta, k, alpha: 0.0 } => fresnel(cos, eta, k),
            _ => {
                let receiver = Receiver { point, normal, flat, own: hit.index };
                return self.reflected(finish, receiver, direction, random).map(|x| own + x);
            }
        };
        let mirrored = unit(along(direction, normal, 2.0 * cos));
        // the mirror image of a smooth normal may be below the triangle
        if depth == self.effort.depth || reflectance == 0.0 || dot(mirrored, flat) <= 0.0 {
            return [own; 3];
        }
        self.radiance([point, mirrored], Some(hit.index), depth + 1, random).map(|x| own + reflectance * x)
    }
    /// The light that a surface reflects, with and without what hides the lights, and the greatest value of one sample of a light.
    fn reflected(&self, finish: Finish, at: Receiver, direction: V3, random: &mut Random) -> [f64; 3] {
        let mut sum = [0.0; 3];
        if finish == Finish::Diffuse(0.0) {
            return sum;
        }
        let toward = direction.map(|x| -x);
        for beam in self.sources.iter().flat_map(|source| source.beams(at.point, SKY * self.effort.points, random)) {
            let cos = dot(unit(beam.to), at.normal);
            if cos > 0.0 && dot(beam.to, at.flat) > 0.0 {
                let factor = cos * brdf(finish, toward, unit(beam.to), at.normal);
                let all = beam.irradiance * factor;
                let left = transmittance(&self.bodies, 0..self.bodies.len(), &at, beam.to, beam.end, self.effort.lift);
                sum = [sum[0] + all * left, sum[1] + all, sum[2].max(beam.most * factor)];
            }
        }
        for &light in &self.lights {
            let Some(seen) = SeenLight::new(&self.bodies, at, light, [self.effort.spared, self.effort.lift]) else {
                continue;
            };
            let radiance = self.bodies[light].body.emission.map_or(0.0, |emission| emission.radiance);
            let count = self.effort.points;
            let [left, all, most] = match finish {
                Finish::Diffuse(albedo) | Finish::Mirror(albedo) => {
                    let factor = albedo * core::f64::consts::FRAC_1_PI;
                    let [left, all] = seen.both(count, random);
                    [left, all, seen.most].map(|x| x * factor)
                }
                _ => {
                    let mut parts = [0.0; 3];
                    for point in seen.points(4 * count, random) {
                        let reflected = brdf(finish, toward, unit(point.to), at.normal);
                        let part = point.weight * reflected;
                        parts[1] += part;
                        parts[0] += part * seen.transmittance(point.to);
                        parts[2] = parts[2].max(seen.most * reflected);
                    }
                    parts
                }
            };
            sum = [sum[0] + radiance * left, sum[1] + radiance * all, sum[2].max(radiance * most)];
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed forms against segments, in random scenes of triangles and spheres.
    #[test]
    fn closed_forms_agree_with_segments() {
        let mut random = Random(1);
        let mut worst = 0.0_f64;
        for scene in 0..4000 {
            let point = |random: &mut Random| [0; 3].map(|_| 2.0 * random.unit() - 1.0);
            let flat = |random: &mut Random| {
                let corner = point(random);
                Form::Flat { corner, edges: [point(random), point(random)], is_triangle: random.unit() < 0.5 }
            };
            let ball = |random: &mut Random| Form::Sphere { center: point(random), radius: 0.5 * random.unit() };
            let mut forms = vec![if scene % 2 == 0 { flat(&mut random) } else { ball(&mut random) }];
            for _ in 0..3 {
                forms.push(if random.unit() < 0.5 { flat(&mut random) } else { ball(&mut random) });
            }
            let bodies: Vec<Prepared> = forms
                .into_iter()
                .map(|form| {
                    let emission = Some(Emission { radiance: 1.0, two_sided: true });
                    Prepared::new(Body { form, finish: Finish::Diffuse(0.5), emission, detail: None })
                })
                .collect();
            // on one of the bodies, or nowhere
            let own = (random.unit() * 5.0) as usize;
            let mut at = point(&mut random);
            let mut normal = unit(point(&mut random));
            if let Some(body) = bodies.get(own).filter(|_| own > 0) {
                match body.body.form {
                    Form::Sphere { center, radius } => {
                        at = along(center, normal, radius);
                        if random.unit() < 0.5 {
                            normal = normal.map(|x| -x);
                        }
                    }
                    Form::Flat { corner, edges, .. } => {
                        at = along(along(corner, edges[0], 0.4), edges[1], 0.3);
                        normal = body.normal;
                    }
                }
            }
            let receiver = Receiver { point: at, normal, flat: normal, own };
            let Some(seen) = SeenLight::new(&bodies, receiver, 0, [SPARED, 0.0]) else { continue };
            let exact = seen.visible(10_000, &mut random);
            let mean = seen.sampled(10_000, &mut random);
            // a light at the horizon is small, and its points few
            let difference = (exact - mean).abs() / seen.all.max(1e-3);
            assert!(difference < 0.02, "{exact} and {mean} of {}: {receiver:?}, {bodies:?}", seen.all);
            worst = worst.max(difference);
        }
        println!("greatest difference {worst:.4}");
    }
}
