//! Scenes in another unit of length.

use super::description::{CameraSettings, Lens, Scene, Screen, Shape};
use super::lights::DeltaLight;
use crate::geometry::{Disk, Geometry, Parallelogram, Sphere};

/// The exponent of the greatest coordinate that is rendered as it is: squares of it are numbers in single precision.
const MOST: i32 = 60;

impl Scene {
    /// The same scene in a unit of length in which squares of coordinates are numbers in single precision, if those of this one are not: a
    /// power of two, so that its image is the same. Skies with portals are left as they are.
    pub(crate) fn in_range(&self) -> Option<Self> {
        if self.environment.as_ref().is_some_and(|environment| !environment.portals.is_empty()) {
            return None;
        }
        let corners = self.triangles.as_flattened().iter().flatten();
        let shifts = self.instances.iter().flat_map(|instance| instance.to_world.0.map(|row| row[3]));
        let bounds: Vec<_> = self.shapes.iter().map(|shape| shape.geometry.bounds()).collect();
        let all = corners.copied().chain(shifts).chain(bounds.as_flattened().iter().flatten().copied());
        let reach = all.fold(0.0_f32, |most, x| most.max(x.abs()));
        let exponent = (reach.to_bits() >> 23) as i32 - 127;
        (exponent > MOST).then(|| self.times(f32::from_bits(((127 + MOST - exponent) as u32) << 23)))
    }
    /// The scene with all lengths multiplied by a power of two.
    fn times(&self, by: f32) -> Self {
        let mut scene = self.clone();
        let point = |v: [f32; 3]| v.map(|x| x * by);
        // triangles of objects are in the spaces of these
        let own = scene.objects.first().map_or(scene.triangles.len(), |range| range.start);
        scene.triangles[..own].iter_mut().flatten().for_each(|corner| *corner = point(*corner));
        for row in scene.instances.iter_mut().flat_map(|instance| &mut instance.to_world.0) {
            *row = row.map(|x| x * by);
        }
        let shape = |shape: &Shape| {
            let geometry = match shape.geometry {
                Geometry::Sphere(Sphere { center, radius }) => {
                    Geometry::Sphere(Sphere { center: point(center), radius: radius * by })
                }
                Geometry::Triangle(corners) => Geometry::Triangle(corners.map(point)),
                Geometry::Parallelogram(Parallelogram { p, u, v }) => {
                    Geometry::Parallelogram(Parallelogram { p: point(p), u: point(u), v: point(v) })
                }
                Geometry::Disk(Disk { center, normal, radius }) => {
                    Geometry::Disk(Disk { center: point(center), normal, radius: radius * by })
                }
            };
            Shape { geometry, ..shape.clone() }
        };
        scene.shapes = self.shapes.iter().map(shape).collect();
        for light in &mut scene.delta_lights {
            if let DeltaLight::Point { position, intensity }
            | DeltaLight::Spot { position, intensity, .. }
            | DeltaLight::Directed { position, intensity, .. } = light
            {
                (*position, *intensity) = (point(*position), intensity.map(|x| x * by * by));
            }
        }
        let by = f64::from(by);
        let CameraSettings { origin, screen, lens, is_orthographic, .. } = &mut scene.camera;
        *origin = origin.map(|x| x * by);
        if *is_orthographic {
            *screen = match *screen {
                Screen::Half(half) => Screen::Half(half * by),
                Screen::Edges(edges) => Screen::Edges(edges.map(|x| x * by)),
            };
        }
        *lens = lens.map(|lens| Lens { unit: lens.unit * by, ..lens });
        scene
    }
}
