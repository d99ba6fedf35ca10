//! Compares certificates with segments, and bodies with their triangles.

use super::counts::Counts;
use super::scenes::{emits, light_point};
use super::segments::{EXACT, Meets, corners, depths, exact, may_occlude, meets_solid, meets_triangle};
use super::views::{Point, View, World};
use crate::meshes::{Random, Triangle};
use etendue::occlusion::{Convex, Occlusion, Polyhedron};
use etendue::{Real, Vec3, f32x8};
use etendue_oracle::{V3, along, cross, dot, length, sub, unit, wide};
use etendue_render::certify::{Blocker, Bodies, Certificate, Certifier};
use etendue_render::scene::{Geometry, Shape};

/// A light as the library takes it, and the angle around it as seen from p.
fn convex(geometry: &Geometry, p: V3) -> (Convex<f32>, f64) {
    let around = |corners: &[V3]| {
        let directions: Vec<V3> = corners.iter().map(|&v| unit(sub(v, p))).collect();
        let next = directions.iter().cycle().skip(1);
        directions.iter().zip(next).map(|(&a, &b)| length(cross(a, b)).atan2(dot(a, b))).sum()
    };
    let form = geometry.convex();
    let angle = match form {
        Convex::Sphere { center, radius } => std::f64::consts::TAU * f64::from(radius) / length(sub(exact(center), p)),
        _ => around(&corners(&form)),
    };
    (form, angle)
}

impl World {
    /// Tests the certificates of all lights.
    pub(crate) fn test(&self, view: &View, random: &mut Random, c: &mut Counts) {
        let found = Bodies::new(&self.surfaces.bvh);
        let none = Bodies::default();
        let own = found.is_empty() || random.below(3) == 0;
        for bodies in [(!found.is_empty()).then_some(&found), own.then_some(&none)].into_iter().flatten() {
            let mut certifier = Certifier::new(&self.surfaces, bodies, self.surfaces.light_shapes());
            let all = self.surfaces.light_shapes().enumerate();
            for (index, light) in all.filter(|(_, light)| view.light.is_none_or(|only| only == *light)) {
                let certificate = certifier.certify(&view.patch, index);
                self.compare(certificate, bodies, view, light, random, c);
                if let Certificate::Blockers(blockers, _) = certificate {
                    self.compare_bodies(blockers, bodies, &view.points, light, random, c);
                }
            }
        }
    }
    /// The triangles of a body.
    fn triangles<'a>(&'a self, bodies: &'a Bodies, body: u32) -> impl Iterator<Item = Triangle> + 'a {
        let places = (0..).zip(self.surfaces.bvh.order()).filter(move |(place, _)| bodies.of(*place) == Some(body));
        places.map(|(_, id)| self.scene.triangles[*id as usize])
    }
    /// Compares the bodies of a certificate with their triangles: single segments, and how much of the light they hide.
    fn compare_bodies(
        &self,
        blockers: &[Blocker],
        bodies: &Bodies,
        points: &[Point],
        light: u32,
        random: &mut Random,
        c: &mut Counts,
    ) {
        let shape = &self.scene.shapes[light as usize];
        let listed = blockers.iter().filter_map(|b| if let Blocker::Body(body) = b { Some(*body) } else { None });
        let listed: Vec<u32> = listed.collect();
        c.with_bodies += u64::from(!listed.is_empty());
        for body in listed {
            let (solid, triangles) = (bodies.polyhedron(body), self.triangles(bodies, body).collect::<Vec<_>>());
            for &Point { p, .. } in points {
                for _ in 0..3 {
                    let y = light_point(&shape.geometry, p, random);
                    let met: Vec<_> = triangles.iter().map(|t| meets_triangle([p, y], t.map(wide), EXACT)).collect();
                    let met = [Meets::Yes, Meets::Unclear].into_iter().find(|kind| met.contains(kind));
                    let (met, hidden) = (met.unwrap_or(Meets::No), meets_solid([p, y], &solid));
                    c.solid += 1;
                    if met == Meets::Unclear || hidden == Meets::Unclear {
                        c.solid_unclear += 1;
                        continue;
                    }
                    c.solid_met += u64::from(met == Meets::Yes);
                    assert_eq!(met, hidden, "{}: {p:?} → {y:?}, {solid:?}", self.name);
                }
            }
            self.compare_shadows(&solid, &triangles, points, shape, c);
        }
    }
    /// Compares how much a body hides in single precision with how much its triangles hide in double precision.
    fn compare_shadows(
        &self,
        solid: &Polyhedron<'_, f32>,
        triangles: &[Triangle],
        points: &[Point],
        light: &Shape,
        c: &mut Counts,
    ) {
        let lanes = |of: &dyn Fn(&Point) -> V3| {
            let axis = |k: usize| f32x8::from_fn(|lane| of(&points[lane % points.len()])[k] as f32);
            Vec3::new(axis(0), axis(1), axis(2))
        };
        let (p, normal) = (lanes(&|point| point.p), lanes(&|point| point.normal));
        let mut occlusion = Occlusion::<f32x8>::new();
        let (form, _) = convex(&light.geometry, points[0].p);
        let all = occlusion.visible(p, normal, &form, &[]).unwrap();
        let Some(by_body) = occlusion.visible_past(p, normal, &form, &[], &[*solid]) else {
            c.bodies_fail += 1;
            return;
        };
        let flat = |&[a, b, d]: &Triangle| Convex::Polygon { corners: [a, b, d, d].map(|v| wide(v).into()), count: 3 };
        let triangles: Vec<Convex<f64>> = triangles.iter().map(flat).collect();
        let form = form.map(f64::from);
        let mut occlusion = Occlusion::<f64>::new();
        for (lane, point) in points.iter().enumerate().take(8) {
            let (all, by_body) = (f64::from(all.lane(lane)), f64::from(by_body.lane(lane)));
            assert!((0.0..=all).contains(&by_body), "{by_body} of {all}");
            let (p, normal) = (p.lane(lane).map(f64::from), normal.lane(lane).map(f64::from));
            let Some(by_triangles) = occlusion.visible(p, normal, &form, &triangles) else {
                c.triangles_fail += 1;
                continue;
            };
            // on the surface, points are inside or outside by rounding
            let (rounding, depths) = depths(point.p, solid);
            if depths.iter().fold(f64::INFINITY, |m, x| m.min(*x)).abs() < rounding {
                c.on_surface += 1;
                continue;
            }
            c.shadows += 1;
            c.partial += u64::from(by_body > 0.01 * all && by_body < 0.99 * all);
            let bound = 1e-5 * all + 4e-7 * convex(&light.geometry, point.p).1;
            let error = (by_body - by_triangles).abs() / bound;
            let what =
                || format!("{triangles:?}: {by_body} and {by_triangles} of {all}, {point:?}, {solid:?}, {light:?}");
            assert!(error < 1.0, "{}: {}", self.name, what());
            c.worst = c.worst.max(error);
        }
    }
    /// Compares one certificate with pairs of points.
    fn compare(
        &self,
        certificate: Certificate<'_>,
        bodies: &Bodies,
        view: &View,
        light: u32,
        random: &mut Random,
        c: &mut Counts,
    ) {
        c.corridors += 1;
        let shape = &self.scene.shapes[light as usize];
        *match certificate {
            Certificate::Lit(_) => &mut c.lit,
            Certificate::Dark => &mut c.dark,
            Certificate::Blockers(..) => &mut c.blockers,
            Certificate::Unknown => &mut c.unknown,
        } += 1;
        if matches!(certificate, Certificate::Unknown) {
            return;
        }
        for &Point { p, normal, traced, to } in &view.points {
            if let Certificate::Blockers(blockers, _) = certificate {
                for blocker in blockers {
                    assert_front(blocker, bodies, &shape.geometry, p, &self.name);
                }
            }
            for k in 0..3 {
                let y = to.filter(|_| k == 0).unwrap_or_else(|| light_point(&shape.geometry, p, random));
                if !(dot(normal, sub(y, p)) > 0.0 && emits(shape, y, p)) {
                    continue;
                }
                c.pairs += 1;
                let segment = [p, along(p, sub(y, p), 1.0 - 1.0 / 131_072.0)];
                let met = self.occluded(p, y, view.receiver, light as usize);
                c.visible += u64::from(met == Meets::No);
                c.covered += u64::from(met == Meets::Yes && matches!(certificate, Certificate::Dark));
                c.unclear += u64::from(met == Meets::Unclear);
                let what = || {
                    format!("{}: {certificate:?}, {p:?} → {y:?}, light {light}, receiver {}", self.name, view.receiver)
                };
                match certificate {
                    Certificate::Lit(_) => assert!(met != Meets::Yes, "occluded: {}", what()),
                    Certificate::Dark => assert!(met != Meets::No, "visible: {}", what()),
                    Certificate::Blockers(blockers, _) if met == Meets::Yes => {
                        assert!(
                            blockers.iter().any(|b| may_occlude(segment, b, bodies)),
                            "a blocker is missing: {}",
                            what()
                        );
                    }
                    _ => {}
                }
                if traced && !matches!(certificate, Certificate::Blockers(..)) {
                    let open = self.sees(p, y, light);
                    c.rays += 1;
                    c.ray_differs += u64::from(open != matches!(certificate, Certificate::Lit(_)));
                }
            }
        }
    }
}

/// A blocker that does not cross the light is in front of it, as seen from p.
fn assert_front(blocker: &Blocker, bodies: &Bodies, light: &Geometry, p: V3, name: &str) {
    let (points, radius) = match *blocker {
        Blocker::Convex { crosses_light: true, .. } => return,
        Blocker::Convex { form: Convex::Sphere { center, radius }, .. } => (vec![exact(center)], f64::from(radius)),
        Blocker::Convex { form, .. } => (corners(&form), 0.0),
        Blocker::Body(body) => {
            let ends = bodies.polyhedron(body).edges.iter().flat_map(|edge| edge.ends);
            (ends.map(|v| wide([v.x, v.y, v.z])).collect(), 0.0)
        }
    };
    let is_front = |x: V3| match *light {
        Geometry::Sphere { center, radius: r } => {
            let (c, r) = (wide(center), f64::from(r));
            dot(sub(x, c), sub(p, c)) - radius * length(sub(p, c)) >= r * r
        }
        Geometry::Triangle(corners) => {
            let [a, b, c] = corners.map(wide);
            let normal = unit(cross(sub(b, a), sub(c, a)));
            dot(normal, sub(x, a)) * dot(normal, sub(p, a)).signum() >= radius
        }
        Geometry::Parallelogram { p: a, u, v } => {
            let normal = unit(cross(wide(u), wide(v)));
            dot(normal, sub(x, wide(a))) * dot(normal, sub(p, wide(a))).signum() >= radius
        }
    };
    assert!(points.into_iter().all(is_front), "{name}: {blocker:?} is behind {light:?} from {p:?}");
}
