//! What a renderer computes where a certificate allows it, against the truth.
//!
//! The error of a light at a point is allowed to be 10⁻⁵ of what the light contributes there if nothing occludes it. A point that receives
//! less than a hundredth of what another one of the patch does counts as a point that receives that hundredth.

use super::pinned::Pinned;
use super::truth::Truth;
use super::views::{Fit, View, World};
use crate::attack::judge::read;
use crate::attack::regimes::Regime;
use crate::occlusion::truth::depth;
use crate::random::Random;
use etendue::{Real, Vec3, f32x8, f64x4};
use etendue_oracle::{V3, along, dot, narrow, sub, wide};
use etendue_render::know::{Bodies, Certifier};
use etendue_render::scene::{Geometry, Parallelogram, Scene, Shape, Sphere};
use etendue_render::surfaces::Surfaces;
use etendue_visible::{Occlusion, Polyhedron, Precision, Proof, Solid};
use std::fmt;

/// Greatest error, relative to the light without occluders, and the share of the brightest point that each point counts as.
const ALLOWED: f64 = 1e-5;
const FAINT: f64 = 1e-2;
/// Greatest number of occluders that the renderer computes with.
const CLIPPED: usize = 8;
/// Points of a patch that are compared.
const POINTS: usize = 4;

/// Greatest errors by what a certificate says.
#[derive(Clone, Copy, Debug, Default)]
struct WorstErrors {
    shafts: u64,
    compared: u64,
    worst: f64,
}

impl WorstErrors {
    fn add(&mut self, other: &Self) {
        self.shafts += other.shafts;
        self.compared += other.compared;
        self.worst = self.worst.max(other.worst);
    }
}

/// What the shafts of one regime have shown.
#[derive(Clone, Debug, Default)]
pub(crate) struct Values {
    pub(crate) shafts: u64,
    /// Lit in single and in double precision, dark, and occluders in single and in double precision.
    known: [WorstErrors; 5],
    /// Closed forms that are not accurate enough, crowded or overlapping occluders, and what is unknown.
    imprecise: u64,
    crowded: u64,
    unknown: u64,
    /// Points without a known truth or on the surface of a body, and points of which the light is visible in part.
    untold: u64,
    partial: u64,
    /// Greatest error, relative to the allowed one, and where it is.
    pub(crate) worst: f64,
    pub(crate) place: String,
    /// Greatest error relative to the angle around the light and the number of occluders, for polygons, before a sphere, and behind spheres, in
    /// single and double precision: whatever the certificate says.
    most: [[f64; 2]; 3],
    pub(crate) fit: Fit,
}

const NAMES: [&str; 5] = ["lit", "lit in double", "dark", "occluders", "occluders in double"];

impl Values {
    /// Includes the figures of another part of the same regime.
    pub(crate) fn add(&mut self, other: Self) {
        self.shafts += other.shafts;
        self.known.iter_mut().zip(&other.known).for_each(|(row, other)| row.add(other));
        self.imprecise += other.imprecise;
        self.crowded += other.crowded;
        self.unknown += other.unknown;
        self.untold += other.untold;
        self.partial += other.partial;
        for (i, j) in (0..3).flat_map(|i| [(i, 0), (i, 1)]) {
            self.most[i][j] = self.most[i][j].max(other.most[i][j]);
        }
        self.fit.add(other.fit);
        if other.worst > self.worst || other.worst.is_nan() {
            (self.worst, self.place) = (other.worst, other.place);
        }
    }
}

impl Values {
    /// Notes the errors of values in single and in double precision, relative to an angle, whatever a certificate says.
    fn note_errors(&mut self, spheres: usize, both: [Option<f64>; 2], truth: f64, angle: f64) {
        for (most, value) in self.most[spheres].iter_mut().zip(both) {
            *most = value.map_or(*most, |value| most.max((value - truth).abs() / angle));
        }
    }
}

impl fmt::Display for Values {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:9} shafts", self.shafts)?;
        for (name, row) in NAMES.iter().zip(&self.known) {
            write!(f, " | {name} {} ({:.3})", row.shafts, row.worst)?;
        }
        write!(f, " | imprecise {}, crowded {}, unknown {}", self.imprecise, self.crowded, self.unknown)?;
        writeln!(f, " | points: {} in part, {} untold, {:?}", self.partial, self.untold, self.fit)?;
        for (name, [single, double]) in ["polygons", "before a sphere", "behind spheres"].iter().zip(self.most) {
            writeln!(f, "    {name}: at most {single:.1e} of the angle in single precision, {double:.1e} in double")?;
        }
        Ok(())
    }
}

/// On the surface of a polyhedron, points are inside or outside by the rounding of its corners.
fn has_on_surface(solids: &[Solid], p: V3) -> bool {
    let greatest = |body: &Polyhedron| {
        let corners = body.edges().iter().flat_map(|edge| edge.ends).map(V3::from);
        corners.chain([p]).flatten().fold(0.0, |most: f64, x| most.max(x.abs()))
    };
    solids.iter().any(|solid| match solid {
        Solid::Polyhedron(body) => depth(body, p) < 3e-7 * greatest(body),
        _ => false,
    })
}

/// Closed forms in both precisions, as the renderer computes them.
#[derive(Default)]
struct Forms {
    single: Box<Occlusion<f32x8>>,
    double: Box<Occlusion<f64x4>>,
}

impl Forms {
    /// What closed forms in single precision and in double precision give at the points.
    fn visible(&mut self, points: &[(V3, V3)], light: &Solid, listed: &[Solid]) -> [Option<[f64; POINTS]>; 2] {
        let at = |lane: usize, of: fn(&(V3, V3)) -> V3, k: usize| of(&points[lane % points.len()])[k];
        let single = |of: fn(&(V3, V3)) -> V3| {
            let axis = |k: usize| f32x8::from_fn(|lane| at(lane, of, k) as f32);
            Vec3::new(axis(0), axis(1), axis(2))
        };
        let double = |of: fn(&(V3, V3)) -> V3| {
            let axis = |k: usize| f64x4::from(std::array::from_fn(|lane| at(lane, of, k)));
            Vec3::new(axis(0), axis(1), axis(2))
        };
        let (p, n) = (single(|point| point.0), single(|point| point.1));
        let narrow = self.single.visible(p, n, light, listed);
        let (p, n) = (double(|point| point.0), double(|point| point.1));
        let wide = self.double.visible(p, n, light, listed);
        // the renderer goes on in single precision
        let narrow = narrow.map(|x| std::array::from_fn(|lane| f64::from(x.as_array()[lane])));
        [narrow, wide.map(|x| x.to_array())]
    }
}

impl World {
    /// Compares the certificates of all lights for a view.
    fn values(&self, view: &View, bodies: &Bodies, forms: &mut Forms, values: &mut Values) {
        let rounded = |v: V3| wide(narrow(v));
        let corner = view.patch.corners().next().unwrap_or_default();
        // where a point off a flat patch is rounded, it stays above the plane
        let is_above = |p: V3| view.patch.normal().is_none_or(|n| dot(n, sub(p, corner)) >= view.patch.least_height());
        let points = view.points.iter().map(|&(p, normal)| (rounded(p), rounded(normal)));
        let points: Vec<(V3, V3)> = points.filter(|(p, _)| is_above(*p)).collect();
        let step = points.len().div_ceil(POINTS).max(1);
        let points: Vec<(V3, V3)> = points.into_iter().step_by(step).take(POINTS).collect();
        if points.is_empty() {
            return;
        }
        let mut certifier = Certifier::new(&self.surfaces, bodies, self.surfaces.light_shapes());
        for (index, light) in self.surfaces.light_shapes().enumerate() {
            let certificate = certifier.certify(view.receiver, &view.patch, index);
            values.shafts += 1;
            self.compare_values(certificate, view, &points, light, forms, values);
        }
    }
    /// The greatest light of the corners and the centre of a flat patch.
    fn brightest(&self, view: &View, light: u32) -> f64 {
        let Some(normal) = view.patch.normal() else { return 0.0 };
        let corners: Vec<V3> = view.patch.corners().collect();
        let center = corners.iter().fold([0.0; 3], |sum, &p| along(sum, p, 1.0 / corners.len() as f64));
        let all = corners.into_iter().chain([center]);
        all.map(|p| self.truth(p, normal, view.receiver, light).all).fold(0.0, f64::max)
    }
    fn compare_values(
        &self,
        certificate: (Proof<'_>, Precision),
        view: &View,
        points: &[(V3, V3)],
        light: u32,
        forms: &mut Forms,
        values: &mut Values,
    ) {
        let form = self.scene.shapes[light as usize].geometry.outline().solid();
        let mut listed: &[Solid] = &[];
        let (proof, precision) = certificate;
        let is_double = usize::from(precision == Precision::Double);
        let row = match proof {
            Proof::Open => {
                values.unknown += 1;
                return;
            }
            Proof::Dark => 2,
            Proof::Lit => is_double,
            Proof::Behind(solids) => {
                listed = solids;
                if solids.len() > CLIPPED || form.is_sphere() && listed.iter().any(Solid::is_sphere) {
                    values.crowded += 1;
                    return;
                }
                3 + is_double
            }
        };
        let both = if row == 2 { [Some([0.0; POINTS]); 2] } else { forms.visible(points, &form, listed) };
        let chosen = both[is_double];
        let Some(chosen) = chosen else {
            values.crowded += 1;
            return;
        };
        let truth = points.iter().map(|&(p, n)| self.truth(p, n, view.receiver, light));
        let truth: Vec<Truth> = truth.collect();
        let most = truth.iter().fold(self.brightest(view, light), |most, truth| most.max(truth.all));
        let count = listed.len().max(1) as f64;
        let spheres = if listed.iter().any(Solid::is_sphere) { 2 } else { usize::from(form.is_sphere()) };
        if precision == Precision::Neither {
            values.imprecise += 1;
        } else {
            values.known[row].shafts += 1;
        }
        for (lane, (truth, &(p, _))) in truth.iter().zip(points).enumerate() {
            let Some(left) = truth.left.filter(|_| !has_on_surface(listed, p)) else {
                values.untold += 1;
                continue;
            };
            values.partial += u64::from(left > 0.01 * truth.all && left < 0.99 * truth.all);
            if row >= 3 {
                values.note_errors(spheres, both.map(|v| v.map(|v| v[lane])), left, truth.around * count);
            }
            if precision == Precision::Neither {
                continue;
            }
            let value = if precision == Precision::Double { f64::from(chosen[lane] as f32) } else { chosen[lane] };
            let allowed = ALLOWED * truth.all.max(FAINT * most);
            let error = (value - left).abs();
            let ratio = if error > 0.0 { error / allowed } else { 0.0 };
            let worst = &mut values.known[row];
            worst.compared += 1;
            worst.worst = worst.worst.max(ratio);
            if ratio > values.worst || ratio.is_nan() {
                values.worst = ratio;
                values.place = format!(
                    "{}: {value:e} instead of {left:e} of {:e} at {:?}: {certificate:?}, light {light}, receiver {:?}, both {:?}, {:?}",
                    self.name,
                    truth.all,
                    points[lane],
                    view.receiver,
                    both.map(|v| v.map(|v| v[lane])),
                    self.scene.shapes[light as usize].geometry,
                );
            }
        }
    }
}

/// A scene in another unit of length.
fn scaled(scene: Scene, scale: f32) -> Scene {
    let times = |v: [f32; 3]| v.map(|x| x * scale);
    let shape = |shape: &Shape| {
        let geometry = match shape.geometry {
            Geometry::Sphere(Sphere { center, radius }) => {
                Geometry::Sphere(Sphere { center: times(center), radius: radius * scale })
            }
            Geometry::Triangle(corners) => Geometry::Triangle(corners.map(times)),
            Geometry::Parallelogram(Parallelogram { p, u, v }) => {
                Geometry::Parallelogram(Parallelogram { p: times(p), u: times(u), v: times(v) })
            }
            ref other => panic!("{other:?} is not scaled"),
        };
        Shape { geometry, ..shape.clone() }
    };
    Scene {
        triangles: scene.triangles.iter().map(|triangle| triangle.map(times)).collect(),
        shapes: scene.shapes.iter().map(shape).collect(),
        ..scene
    }
}

/// Tests about `shafts` shafts of a regime, in scenes of these seeds.
pub(crate) fn campaign(regime: &Regime, shafts: u64, seeds: impl IntoIterator<Item = u64>) -> Values {
    let (mut values, mut forms) = (Values::default(), Forms::default());
    for seed in seeds {
        if values.shafts >= shafts {
            break;
        }
        let draft = regime.draft(seed);
        let mut random = Random::new(!seed);
        let scale = random.of(&[1.0, 1.0, 1e-3, 1e3]);
        let scene = scaled(read(&draft).unwrap(), scale);
        let name = format!("{} × {scale}", draft.name);
        let world = World { name, surfaces: Surfaces::new(&scene).unwrap(), scene };
        let found = Bodies::new(&world.surfaces.bvh);
        let none = Bodies::default();
        // the first part is the floor
        let floors = draft.parts[0].form.triangles().len();
        for _ in 0..16 {
            let Some(view) = world.look_past_edges(floors, &mut random, &mut values.fit) else { continue };
            let bodies = if random.one_in(4) { &none } else { &found };
            world.values(&view, bodies, &mut forms, &mut values);
        }
    }
    values
}

/// Tests all lights of a scene for a view, with and without bodies.
pub(crate) fn pinned(pinned: &Pinned) -> Values {
    let (mut values, mut forms) = (Values::default(), Forms::default());
    let scene = crate::kit::read(pinned.scene);
    let world = World { name: "pinned".to_owned(), surfaces: Surfaces::new(&scene).unwrap(), scene };
    let view = world.pinned(pinned).unwrap();
    for bodies in [Bodies::default(), Bodies::new(&world.surfaces.bvh)] {
        world.values(&view, &bodies, &mut forms, &mut values);
    }
    values
}
