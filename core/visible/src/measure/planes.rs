//! Occluders as they are seen from points: the planes and outlines that bound what they hide.

use super::cap::Cap;
use super::capacity::{EDGES, MOST, TooMany};
use super::flat::{Flat, corner, rounded};
use super::line::Line;
use super::outline::Outline;
use crate::polyhedron::{Edge, FACES, Polyhedron};
use crate::solid::Solid;
use etendue::{Mask, Real, Vec3};

/// A light for which occluders are prepared.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target<'a, R: Real> {
    /// The outline of a flat light above the horizon.
    pub(super) outline: &'a Outline<R, MOST>,
    /// The point of a flat light from which its outline is measured, and the reciprocal of its unit. A sphere has none.
    pub(super) base: Option<(Vec3<f64>, R)>,
    /// Only what has x with normal · x ≥ least lies before the light.
    pub(super) front: (Vec3<R>, R),
}

impl<R: Real> Target<'_, R> {
    /// The height of the base of a flat light over the plane through a point and a line.
    #[inline(always)]
    fn height(&self, line: &Line<R>, plane: Vec3<R>, point: Vec3<R>) -> R {
        self.base.map_or(R::lit(0.0), |base| line.height(plane, self.outline, base, point))
    }
}

/// An occluder as seen from the points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planes<R: Real> {
    /// The outline of a polygon in front of the light, if that is a sphere.
    pub(super) outline: Outline<R, 5>,
    /// Normals of the planes through the point and the edges of the outline, towards the inside.
    pub(super) planes: [Vec3<R>; EDGES],
    /// Heights of the base of the light over these planes, in units of the light and the normal.
    pub(super) heights: [R; EDGES],
    /// Number of planes.
    pub(super) count: usize,
    /// A sphere.
    pub(super) cap: Option<Cap<R>>,
    /// Lanes in which it hides part of the light.
    pub(super) lanes: R::Mask,
}

impl<R: Real> Default for Planes<R> {
    fn default() -> Self {
        Self {
            outline: Outline::default(),
            planes: [Vec3::default(); EDGES],
            heights: [R::lit(0.0); EDGES],
            count: 0,
            cap: None,
            lanes: R::Mask::splat(false),
        }
    }
}

impl<R: Real> Planes<R> {
    /// Prepares a flat shape, which has just been taken.
    #[inline]
    pub(super) fn flat(
        &mut self,
        flat: &Flat<R>,
        shape: &Solid,
        point: Vec3<R>,
        target: &Target<'_, R>,
    ) -> Result<(), TooMany> {
        let Flat { ref edges, scale, normal: across, height, .. } = *flat;
        let corners = flat.corners();
        let sign = R::lit(1.0).copysign(height);
        let (zero, (front, least)) = (R::lit(0.0), (target.front.0, target.front.1 * scale));
        self.cap = None;
        self.count = corners.len();
        let (mut before, mut behind) = (R::Mask::splat(false), R::Mask::splat(false));
        for (i, (&from, &edge)) in corners.iter().zip(edges).enumerate() {
            self.planes[i] = from.cross(edge) * sign;
            let is_before = front.dot(from).ge(least);
            (before, behind) = (before | is_before, behind | !is_before);
        }
        self.lanes = before & height.abs().gt(zero);
        for i in 0..self.count {
            let from = corner(shape, i);
            let line = Line {
                from,
                edge: corner(shape, if i + 1 < self.count { i + 1 } else { 0 }) - from,
                scales: [scale, scale * sign],
                reach: corners[i].max_abs() * edges[i].max_abs(),
            };
            self.heights[i] = target.height(&line, self.planes[i], point);
        }
        let crosses = self.lanes & behind;
        if crosses.any() {
            // through the point and the line in which the planes of the occluder and before the light meet: the edge itself can be shorter
            // than its rounding
            self.planes[self.count] = (front * height.abs() + across * (-least * sign)).keep(crosses);
            self.heights[self.count] = self.planes[self.count].dot(target.outline.base());
            self.count += 1;
        }
        if target.base.is_none() {
            self.outline.start(Vec3::default(), corners, self.lanes);
            self.outline.clip(front, least)?;
        }
        Ok(())
    }

    /// Prepares a polyhedron: its outline consists of the edges between a face that faces the point and one that does not.
    #[inline]
    pub(super) fn polyhedron(
        &mut self,
        body: &Polyhedron,
        point: Vec3<R>,
        target: &Target<'_, R>,
    ) -> Result<(), TooMany> {
        let mut away = [R::Mask::splat(false); FACES];
        for (away, [normal, on]) in away.get_mut(..body.faces.len()).ok_or(TooMany)?.iter_mut().zip(&body.faces) {
            *away = (rounded(*on) - point).dot(rounded(*normal)).ge(R::lit(0.0));
        }
        let center = rounded(body.center) - point;
        let (normal, least) = target.front;
        let scale = center.max_abs().pow2_scale();
        (self.cap, self.count, self.lanes) = (None, 0, R::Mask::splat(true));
        self.outline.start(Vec3::default(), &[], self.lanes);
        let mut before = self.lanes;
        for &corner in &body.corners {
            before = before & normal.dot(rounded(corner) - point).ge(least);
        }
        for Edge { ends, faces: [i, j] } in &body.edges {
            let (Some(&i), Some(&j)) = (away.get(*i), away.get(*j)) else { return Err(TooMany) };
            let outer = i ^ j;
            if outer.any() {
                let [from, to] = ends.map(rounded);
                let (edge, from) = (to - from, from - point);
                // not by both ends, whose rounding can exceed the length of the edge
                let unit = edge.max_abs().pow2_scale();
                let plane = (from * scale).cross(edge * unit);
                let reach = ((from * scale).max_abs() * (edge * unit).max_abs()).keep(outer);
                let towards = R::lit(1.0).copysign(plane.dot(center));
                let plane = (plane * towards).keep(outer);
                *self.planes.get_mut(self.count).ok_or(TooMany)? = plane;
                let [from, to] = *ends;
                let line = Line { from, edge: to - from, scales: [scale, unit * towards], reach };
                self.heights[self.count] = target.height(&line, plane, point).keep(outer);
                self.count += 1;
            }
        }
        if (before | !target.outline.some()).all() { Ok(()) } else { Err(TooMany) }
    }

    /// Prepares a sphere.
    #[inline]
    pub(super) fn sphere(&mut self, center: Vec3<R>, radius: R, target: &Target<'_, R>) -> Result<(), TooMany> {
        let cap = Cap::new(center, radius);
        let (normal, least) = target.front;
        let nearest = normal.dot(center) - least;
        let behind = nearest.lt(-radius);
        if !(behind | nearest.ge(radius) | !target.outline.some()).all() {
            return Err(TooMany);
        }
        (self.lanes, self.cap) = (!behind, Some(cap));
        Ok(())
    }
}
