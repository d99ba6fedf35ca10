//! Lights behind occluders, and the properties of their visible parts that hold for any numbers.

use etendue::{Real, Vec3, f32x4, f32x8, f32x16};
use etendue_judge::packets::{twice, vectors_of};
use etendue_oracle::{V3, along, cross, dot, narrow, sub, unit, wide};
use etendue_visible::{Edge, Occlusion, Polyhedron, Solid, V64};
use std::sync::Arc;

/// A light, occluders, and eight points with the normals of their surfaces.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    /// The light.
    pub(crate) light: Solid,
    /// The occluders.
    pub(crate) occluders: Vec<Solid>,
    /// Polyhedra as further occluders.
    pub(crate) solids: Vec<Faceted>,
    /// The shading points.
    pub(crate) points: [[f32; 3]; 8],
    /// Unit normals.
    pub(crate) normals: [[f32; 3]; 8],
}

/// A convex polyhedron, in single precision.
#[derive(Clone, Debug)]
pub(crate) struct Faceted {
    /// A point inside.
    pub(crate) center: Vec3<f32>,
    /// Normals and points of its faces.
    pub(crate) faces: Vec<[Vec3<f32>; 2]>,
    /// Its edges: their ends, and the two faces that meet there.
    pub(crate) edges: Vec<([Vec3<f32>; 2], [usize; 2])>,
    /// The corners of each face in order around.
    pub(crate) outlines: Vec<Vec<Vec3<f32>>>,
}

impl Faceted {
    /// From its corners, and the corners of each face in order around.
    pub(crate) fn new(corners: &[[f32; 3]], faces: &[Vec<usize>]) -> Self {
        let at = |i: usize| wide(corners[i]);
        let center = (0..corners.len()).fold([0.0; 3], |sum, i| along(sum, at(i), 1.0 / corners.len() as f64));
        let sides = |face: &[usize]| -> Vec<[usize; 2]> {
            (0..face.len()).map(|k| [face[k], face[(k + 1) % face.len()]]).collect()
        };
        let plane = |face: &Vec<usize>| {
            let from = at(face[0]);
            let areas = sides(face).into_iter().map(|[a, b]| cross(sub(at(a), from), sub(at(b), from)));
            let normal = unit(areas.fold([0.0; 3], |sum: V3, area| along(sum, area, 1.0)));
            let outwards = if dot(normal, sub(from, center)) < 0.0 { -1.0 } else { 1.0 };
            [narrow(normal.map(|x| x * outwards)).into(), corners[face[0]].into()]
        };
        let mut edges = Vec::new();
        for (j, face) in faces.iter().enumerate() {
            for (i, other) in faces[..j].iter().enumerate() {
                for [a, b] in sides(face) {
                    if sides(other).iter().any(|side| *side == [a, b] || *side == [b, a]) {
                        edges.push(([corners[a].into(), corners[b].into()], [i, j]));
                    }
                }
            }
        }
        let outline = |face: &Vec<usize>| face.iter().map(|&i| corners[i].into()).collect();
        Self {
            center: narrow(center).into(),
            faces: faces.iter().map(plane).collect(),
            edges,
            outlines: faces.iter().map(outline).collect(),
        }
    }
    /// The same with other points; normals stay.
    pub(crate) fn map(&self, f: impl Fn(Vec3<f32>) -> Vec3<f32>) -> Self {
        Self {
            center: f(self.center),
            faces: self.faces.iter().map(|&[normal, on]| [normal, f(on)]).collect(),
            edges: self.edges.iter().map(|&(ends, faces)| (ends.map(&f), faces)).collect(),
            outlines: self.outlines.iter().map(|face| face.iter().map(|&v| f(v)).collect()).collect(),
        }
    }
}

/// The exact value of a point.
pub(crate) fn exact(v: Vec3<f32>) -> V64 {
    v.map(f64::from)
}

impl Faceted {
    fn polyhedron(&self) -> Solid {
        let faces = self.faces.iter().map(|face| face.map(exact)).collect();
        let edges = self.edges.iter().map(|&(ends, faces)| Edge { ends: ends.map(exact), faces }).collect();
        Solid::Polyhedron(Arc::new(Polyhedron::from_parts(exact(self.center), faces, edges)))
    }
}

impl Scene {
    /// Ω⊥ of the visible part from the points `first` and after, in any precision and width. Sixteen lanes have the points [`twice`].
    pub(crate) fn found<R: Real>(&self, first: usize) -> Option<R> {
        let polyhedra = self.solids.iter().map(Faceted::polyhedron);
        let occluders: Vec<Solid> = polyhedra.chain(self.occluders.iter().cloned()).collect();
        let (points, normals) = (twice(&self.points), twice(&self.normals));
        Occlusion::new().visible(
            vectors_of::<R>(|i| points[first + i]),
            vectors_of::<R>(|i| normals[first + i]),
            &self.light,
            &occluders,
        )
    }
    /// The results are finite, at least 0, and at most what there is without occluders.
    pub(crate) fn total(&self) {
        let bare = Self { occluders: Vec::new(), solids: Vec::new(), ..self.clone() };
        let all = bare.found::<f32x8>(0).expect("there are no occluders");
        let left = self.found::<f32x8>(0).unwrap_or_default();
        for (all, left) in all.as_array().iter().zip(left.as_array()) {
            assert!(all.is_finite() && (0.0..=core::f32::consts::PI).contains(all), "{all}: {self:?}");
            assert!((0.0..=*all).contains(left), "{left} of {all}: {self:?}");
        }
    }
    /// f32, f32x4, f32x8 and f32x16 give the same bits. What eight lanes can compute, each can alone; four may have too many corners.
    pub(crate) fn lanes(&self) {
        let Some(eight) = self.found::<f32x8>(0) else { return };
        let sixteen = self.found::<f32x16>(0).map(|x| x.to_array().map(f32::to_bits));
        let expected = twice(&eight.to_array().map(f32::to_bits));
        assert_eq!(sixteen, Some(expected), "{self:?}");
        for lane in 0..8 {
            let four = self.found::<f32x4>(lane / 4 * 4).map(|x| x.lane(lane % 4).to_bits());
            let one = self.found::<f32>(lane).map(f32::to_bits);
            let expected = Some(eight.lane(lane).to_bits());
            let four_agree = four.is_none() || four == expected;
            assert!(one == expected && four_agree, "lane {lane}: {one:?} {four:?} {expected:?}: {self:?}");
        }
    }
    /// Multiplying all lengths by a power of two changes no bit.
    pub(crate) fn scale(&self, exponent: i32) {
        let factor = 2.0_f32.powi(exponent);
        let times = |shape: &Solid| shape.scaled(factor.into());
        let scaled = Self {
            light: times(&self.light),
            occluders: self.occluders.iter().map(times).collect(),
            solids: self.solids.iter().map(|solid| solid.map(|v| v * factor)).collect(),
            points: self.points.map(|p| p.map(|x| x * factor)),
            normals: self.normals,
        };
        let [one, other] = [self, &scaled].map(|scene| scene.found::<f32x8>(0).map(|x| x.as_array().map(f32::to_bits)));
        assert_eq!(one, other, "times 2^{exponent}: {self:?}");
    }
}
