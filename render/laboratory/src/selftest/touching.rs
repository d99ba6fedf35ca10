//! Whether a light touches a surface that it illuminates.
//!
//! Next to such a contact, the contribution of a point that is sampled uniformly over the light, L cosθ cosθ' A / d², is unbounded, and
//! its variance is infinite: at a distance a from an edge where light and surface meet at an angle, the second moment grows as a⁻².

use etendue::Vec3;
use etendue_render::scene::{Geometry, Material, Scene};

type Point = Vec3<f64>;

/// A surface this close to a light, relative to the size of the light, counts as touching it: the variance is then finite, but far too
/// rare samples dominate it.
const NEAR: f64 = 1e-3;
/// A surface must rise this far above the plane of a light, relative to its size, to be illuminated by it.
const ABOVE: f64 = 1e-5;
/// The rounding of coordinates, relative to their size.
const ROUNDING: f64 = 4e-7;

/// Whether a light of the scene touches a diffuse or rough surface that it illuminates, its own surface aside.
pub(super) fn touches(scene: &Scene) -> bool {
    let reflects: Vec<bool> = scene.materials.iter().map(|m: &Material| !m.is_black() && !m.is_mirror()).collect();
    let shapes = scene.shapes.iter().map(|s| (&s.geometry, reflects[s.material as usize]));
    let shapes: Vec<&Geometry> = shapes.filter_map(|(geometry, reflects)| reflects.then_some(geometry)).collect();
    let lights = scene.shapes.iter().filter_map(|s| s.emission.map(|emission| (&s.geometry, emission.two_sided)));
    let triangles = scene.triangles.iter().zip(&scene.triangle_materials);
    let triangles = triangles.filter_map(|(t, m)| reflects[*m as usize].then_some(t)).collect();
    any_touches(&mut lights.collect::<Vec<_>>(), triangles, shapes)
}

/// Whether a light touches one of these triangles and shapes. Halves of many lights have fewer of these near them.
fn any_touches(
    lights: &mut [(&Geometry, bool)],
    mut triangles: Vec<&[[f32; 3]; 3]>,
    mut shapes: Vec<&Geometry>,
) -> bool {
    const FEW: usize = 8;
    if lights.len() <= FEW {
        return lights.iter().any(|&(light, two_sided)| {
            let light = Light::new(light, two_sided);
            triangles.iter().any(|t| light.touches_polygon(&t.map(wide)))
                || shapes.iter().any(|shape| !std::ptr::eq(*shape, light.geometry) && light.touches(shape))
        });
    }
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for (light, _) in &*lights {
        let bounds = light.bounds().map(|corner| corner.map(f64::from));
        let (near, _) = tolerances(bounds);
        low = std::array::from_fn(|k| low[k].min(bounds[0][k] - near));
        high = std::array::from_fn(|k| high[k].max(bounds[1][k] + near));
    }
    let is_near =
        |[least, most]: [[f32; 3]; 2]| (0..3).all(|k| f64::from(least[k]) <= high[k] && f64::from(most[k]) >= low[k]);
    triangles.retain(|t| is_near(Geometry::Triangle(**t).bounds()));
    shapes.retain(|shape| is_near(shape.bounds()));
    if triangles.is_empty() && shapes.is_empty() {
        return false;
    }
    let axis = (0..3).max_by(|&i, &j| (high[i] - low[i]).total_cmp(&(high[j] - low[j]))).unwrap_or(0);
    let place = |light: &Geometry| light.bounds().iter().map(|corner| f64::from(corner[axis])).sum::<f64>();
    lights.select_nth_unstable_by(lights.len() / 2, |a, b| place(a.0).total_cmp(&place(b.0)));
    let (left, right) = lights.split_at_mut(lights.len() / 2);
    any_touches(left, triangles.clone(), shapes.clone()) || any_touches(right, triangles, shapes)
}

/// How near is near, and how far above is above, for a light with these bounds.
fn tolerances(bounds: [[f64; 3]; 2]) -> (f64, f64) {
    let size = (Point::from(bounds[1]) - Point::from(bounds[0])).length();
    let furthest = bounds.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let above = (ABOVE * size).max(ROUNDING * furthest);
    ((NEAR * size).max(2.0 * above), above)
}

fn wide(p: [f32; 3]) -> Point {
    Point::from(p.map(f64::from))
}

/// The corners of a flat shape.
fn corners(geometry: &Geometry) -> Vec<Point> {
    match *geometry {
        Geometry::Sphere { .. } => Vec::new(),
        Geometry::Triangle(corners) => corners.map(wide).to_vec(),
        Geometry::Parallelogram { p, u, v } => {
            let [p, u, v] = [p, u, v].map(wide);
            vec![p, p + u, p + u + v, p + v]
        }
    }
}

struct Light<'a> {
    geometry: &'a Geometry,
    corners: Vec<Point>,
    /// Unit normals of the sides that emit; empty for a sphere.
    sides: Vec<Point>,
    bounds: [[f64; 3]; 2],
    near: f64,
    above: f64,
}

impl<'a> Light<'a> {
    fn new(geometry: &'a Geometry, two_sided: bool) -> Self {
        let bounds = geometry.bounds().map(|corner| corner.map(f64::from));
        let (near, above) = tolerances(bounds);
        let corners = corners(geometry);
        let normal = wide(geometry.normal());
        let sides = match (corners.is_empty(), two_sided) {
            (true, _) => Vec::new(),
            (false, false) => vec![normal],
            (false, true) => vec![normal, -normal],
        };
        Self { geometry, corners, sides, bounds, near, above }
    }

    /// Whether a bounding box comes near that of the light.
    fn is_near(&self, least: [f64; 3], most: [f64; 3]) -> bool {
        (0..3).all(|k| least[k] <= self.bounds[1][k] + self.near && most[k] >= self.bounds[0][k] - self.near)
    }

    fn touches(&self, shape: &Geometry) -> bool {
        match (shape, self.geometry) {
            (&Geometry::Sphere { center, radius }, &Geometry::Sphere { center: c, radius: r }) => {
                let (distance, r, radius) = ((wide(center) - wide(c)).length(), f64::from(r), f64::from(radius));
                (r - radius).abs() - self.near <= distance && distance <= r + radius + self.near
            }
            (&Geometry::Sphere { center, radius }, _) => {
                let (center, radius) = (wide(center), f64::from(radius));
                let height = |side: &Point| side.dot(center - self.corners[0]) + radius;
                self.sides.iter().any(|side| height(side) > self.above)
                    && meets_sphere(&self.corners, center, radius, self.near)
            }
            _ => self.touches_polygon(&corners(shape)),
        }
    }

    fn touches_polygon(&self, polygon: &[Point]) -> bool {
        let extreme = |of: fn(f64, f64) -> f64| {
            [|p: &Point| p.x, |p: &Point| p.y, |p: &Point| p.z]
                .map(|axis| polygon.iter().map(axis).reduce(of).unwrap_or(0.0))
        };
        if !self.is_near(extreme(f64::min), extreme(f64::max)) {
            return false;
        }
        if let &Geometry::Sphere { center, radius } = self.geometry {
            return meets_sphere(polygon, wide(center), f64::from(radius), self.near);
        }
        self.sides.iter().any(|side| {
            let front = clipped(polygon, |p| side.dot(p - self.corners[0]) - self.above);
            front.len() > 2 && is_within(&front, &self.corners, self.near)
        })
    }
}

/// Whether a polygon comes within `near` of the surface of a sphere.
fn meets_sphere(polygon: &[Point], center: Point, radius: f64, near: f64) -> bool {
    let furthest = polygon.iter().map(|&p| (p - center).length()).fold(0.0, f64::max);
    distance_to_polygon(center, polygon) <= radius + near && furthest >= radius - near
}

/// The part of a convex polygon where `height` is at least 0 (Sutherland and Hodgman 1974).
fn clipped(polygon: &[Point], height: impl Fn(Point) -> f64) -> Vec<Point> {
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for [a, b] in edges(polygon) {
        let (ha, hb) = (height(a), height(b));
        if ha >= 0.0 {
            part.push(a);
        }
        if (ha >= 0.0) != (hb >= 0.0) {
            part.push(a + (b - a) * (ha / (ha - hb)));
        }
    }
    part
}

fn edges(polygon: &[Point]) -> impl Iterator<Item = [Point; 2]> {
    (0..polygon.len()).map(|i| [polygon[i], polygon[(i + 1) % polygon.len()]])
}

/// Whether two convex polygons are at most `near` apart: the least distance is that of a corner from a polygon, or that of two edges,
/// unless an edge of one passes through the other.
fn is_within(a: &[Point], b: &[Point], near: f64) -> bool {
    a.iter().any(|&p| distance_to_polygon(p, b) <= near)
        || b.iter().any(|&p| distance_to_polygon(p, a) <= near)
        || edges(a).any(|p| edges(b).any(|q| distance_of_segments(p, q) <= near))
        || edges(a).any(|edge| pierces(edge, b))
        || edges(b).any(|edge| pierces(edge, a))
}

fn normal(polygon: &[Point]) -> Point {
    let around = (1..polygon.len() - 1).map(|i| (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]));
    around.fold(Point::from([0.0; 3]), |sum, n| sum + n)
}

/// Whether the projection of a point onto the plane of a convex polygon lies inside.
fn is_over(p: Point, polygon: &[Point], normal: Point) -> bool {
    edges(polygon).all(|[a, b]| normal.dot((b - a).cross(p - a)) >= 0.0)
}

fn distance_to_polygon(p: Point, polygon: &[Point]) -> f64 {
    let normal = normal(polygon);
    if is_over(p, polygon, normal) && normal.length() > 0.0 {
        return (normal.dot(p - polygon[0]) / normal.length()).abs();
    }
    edges(polygon).map(|[a, b]| distance_of_segments([a, b], [p, p])).fold(f64::INFINITY, f64::min)
}

fn pierces([a, b]: [Point; 2], polygon: &[Point]) -> bool {
    let normal = normal(polygon);
    let [ha, hb] = [a, b].map(|p| normal.dot(p - polygon[0]));
    ha * hb < 0.0 && is_over(a + (b - a) * (ha / (ha - hb)), polygon, normal)
}

/// The distance of two segments (Ericson, Real-Time Collision Detection, 5.1.9); either may be a point.
fn distance_of_segments([a, b]: [Point; 2], [c, d]: [Point; 2]) -> f64 {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let place = |x: f64, length: f64| if length > 0.0 { (x / length).clamp(0.0, 1.0) } else { 0.0 };
    let s = place(uv * vw - vv * uw, uu * vv - uv * uv);
    let t = place(uv * s + vw, vv);
    let s = place(uv * t - uw, uu);
    (w + u * s - v * t).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_render::scene;
    use std::path::Path;

    fn touching(world: &str) -> bool {
        let text = format!("Camera \"perspective\" WorldBegin {world}");
        touches(&scene::parse(&text, "touching.pbrt", Path::new("")).unwrap())
    }

    #[test]
    fn lights_that_touch_what_they_illuminate() {
        let light = |shape: &str| format!("AttributeBegin AreaLightSource \"diffuse\" {shape} AttributeEnd ");
        let floor = "Shape \"trianglemesh\" \"point3 P\" [-9 0 9 9 0 9 0 0 -9] ";
        let sphere = |y: f64| light(&format!("Translate 0 {y} 0 Shape \"sphere\""));
        // an upright square over the floor
        let wall = |y: f64| {
            let top = y + 1.0;
            light(&format!("Shape \"bilinearmesh\" \"point3 P\" [0 {y} 0 1 {y} 0 0 {top} 0 1 {top} 0]"))
        };
        for (height, expected) in [(2.0, false), (1.01, false), (1.0, true), (0.3, true), (-0.5, true), (-1.5, false)] {
            assert_eq!(touching(&(sphere(height) + floor)), expected, "a sphere at {height}");
        }
        for (height, expected) in [(1.0, false), (0.01, false), (0.0, true), (-0.4, true), (-1.5, false)] {
            assert_eq!(touching(&(wall(height) + floor)), expected, "a square at {height}");
        }
        // what a light does not illuminate may touch it
        assert!(!touching(&(sphere(1.0) + "Material \"mirror\" " + floor)));
        assert!(!touching(&(sphere(1.0) + "Material \"diffuse\" \"rgb reflectance\" [0 0 0] " + floor)));
        let lying = light("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 0 1 1 0 1]");
        assert!(!touching(&(lying.clone() + floor)));
        // a ball that rests on a light, in front of it or behind it
        let ball = |y: f64| format!("Translate 0.5 {y} 0.5 Shape \"sphere\" \"float radius\" 0.25");
        assert_ne!(touching(&(lying.clone() + &ball(0.25))), touching(&(lying.clone() + &ball(-0.25))));
        assert!(!touching(&(lying.clone() + &ball(0.3))) && !touching(&(lying + &ball(-0.3))));
        // balls side by side
        let beside = |x: f64| sphere(0.0) + &format!("Translate {x} 0 0 Shape \"sphere\" \"float radius\" 0.5");
        assert_eq!([1.6, 1.5, 1.0, 0.5, 0.3].map(|x| touching(&beside(x))), [false, true, true, true, false]);
    }

    #[test]
    fn no_light_of_a_built_in_scene_touches_anything() {
        for (name, _) in scene::builtin() {
            assert!(!touches(&scene::load(name).unwrap()), "{name}");
        }
    }
}
