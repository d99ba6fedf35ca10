//! Blockers as they are seen from points: the planes and outlines that bound what they hide.

use super::cap::Cap;
use super::flat::{Flat, corner, exactly};
use super::line::Line;
use super::shapes::{Convex, Edge, Polyhedron};
use super::{FACES, Occlusion, TooMany};
use crate::real::{Mask, Real};
use crate::vector::Vec3;

impl<R: Real> Occlusion<R> {
    /// Prepares a flat shape, which has just been taken, as blocker `k`.
    #[inline]
    pub(super) fn see_flat(&mut self, k: usize, shape: &Convex<R::Scalar>, point: Vec3<R>) -> Result<(), TooMany> {
        let Self { flat, seen, stack, base, light, .. } = self;
        let seen = &mut seen[k];
        let Flat { ref edges, scale, normal: across, height, .. } = *flat;
        let corners = flat.corners();
        let sign = R::lit(1.0).copysign(height);
        let (zero, (front, least)) = (R::lit(0.0), (self.front.0, self.front.1 * scale));
        seen.cap = None;
        seen.count = corners.len();
        let (mut before, mut behind) = (R::Mask::splat(false), R::Mask::splat(false));
        for (i, (&from, &edge)) in corners.iter().zip(edges).enumerate() {
            seen.planes[i] = from.cross(edge) * sign;
            let is_before = front.dot(from).ge(least);
            (before, behind) = (before | is_before, behind | !is_before);
        }
        seen.lanes = before & height.abs().gt(zero);
        for i in 0..seen.count {
            let from = corner(shape, i);
            let line = Line {
                from,
                edge: corner(shape, if i + 1 < seen.count { i + 1 } else { 0 }) - from,
                scales: [scale, scale * sign],
                reach: corners[i].max_abs() * edges[i].max_abs(),
            };
            seen.heights[i] = if light.is_some() { zero } else { line.height(seen.planes[i], &stack[0], *base, point) };
        }
        let crosses = seen.lanes & behind;
        if crosses.any() {
            // through the point and the line in which the planes of the blocker and before the light meet: the edge itself can be shorter
            // than its rounding
            seen.planes[seen.count] = (front * height.abs() + across * (-least * sign)).keep(crosses);
            seen.heights[seen.count] = seen.planes[seen.count].dot(stack[0].base());
            seen.count += 1;
        }
        seen.outline.start(Vec3::default(), corners, seen.lanes);
        if light.is_some() {
            seen.outline.clip(front, least)?;
        }
        Ok(())
    }

    /// Prepares a polyhedron as blocker `k`: its outline consists of the edges between a face that faces the point and one that does not.
    #[inline]
    pub(super) fn see_polyhedron(
        &mut self,
        k: usize,
        body: &Polyhedron<'_, R::Scalar>,
        point: Vec3<R>,
    ) -> Result<(), TooMany> {
        let Self { seen, stack, base, light, .. } = self;
        let seen = &mut seen[k];
        let mut away = [R::Mask::splat(false); FACES];
        for (away, [normal, on]) in away.get_mut(..body.faces.len()).ok_or(TooMany)?.iter_mut().zip(body.faces) {
            *away = (Vec3::splat(*on) - point).dot(Vec3::splat(*normal)).ge(R::lit(0.0));
        }
        let center = Vec3::splat(body.center) - point;
        let (normal, least) = self.front;
        let scale = center.max_abs().pow2_scale();
        (seen.cap, seen.count, seen.lanes) = (None, 0, R::Mask::splat(true));
        seen.outline.start(Vec3::default(), &[], seen.lanes);
        let mut before = seen.lanes;
        for Edge { ends, faces: [i, j] } in body.edges {
            let [from, to] = ends.map(Vec3::splat);
            let edge = to - from;
            let (from, to) = (from - point, to - point);
            before = before & normal.dot(from).ge(least) & normal.dot(to).ge(least);
            let (Some(&i), Some(&j)) = (away.get(*i), away.get(*j)) else { return Err(TooMany) };
            let outer = i ^ j;
            if outer.any() {
                // not by both ends, whose rounding can exceed the length of the edge
                let unit = edge.max_abs().pow2_scale();
                let plane = (from * scale).cross(edge * unit);
                let reach = ((from * scale).max_abs() * (edge * unit).max_abs()).keep(outer);
                let towards = R::lit(1.0).copysign(plane.dot(center));
                let plane = (plane * towards).keep(outer);
                *seen.planes.get_mut(seen.count).ok_or(TooMany)? = plane;
                let [from, to] = ends.map(exactly);
                let line = Line { from, edge: to - from, scales: [scale, unit * towards], reach };
                let height = if light.is_some() { R::lit(0.0) } else { line.height(plane, &stack[0], *base, point) };
                seen.heights[seen.count] = height.keep(outer);
                seen.count += 1;
            }
        }
        if (before | !stack[0].some()).all() { Ok(()) } else { Err(TooMany) }
    }

    /// Prepares a sphere as blocker `k`.
    #[inline]
    pub(super) fn see_sphere(&mut self, k: usize, center: Vec3<R>, radius: R) -> Result<(), TooMany> {
        let cap = Cap::new(center, radius);
        let (normal, least) = self.front;
        let nearest = normal.dot(center) - least;
        let behind = nearest.lt(-radius);
        if !(behind | nearest.ge(radius) | !self.stack[0].some()).all() {
            return Err(TooMany);
        }
        self.seen[k].lanes = !behind;
        self.seen[k].cap = Some(cap);
        Ok(())
    }
}
