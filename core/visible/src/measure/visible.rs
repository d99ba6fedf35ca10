//! What occluders leave of a light, by intersections of all of them.

use super::cap::Cap;
use super::capacity::{DEPTH, EDGES, MOST, OCCLUDERS, TERMS, TooMany};
use super::flat::{Flat, corner, exactly, rounded};
use super::outline::Outline;
use super::planes::{Planes, Target};
use crate::solid::Solid;
use etendue::reflection::Reflection;
use etendue::{Mask, Real, Vec3};

/// What is so near to the plane of a flat light does not occlude it, relative to the greatest of the coordinates of the point and of the
/// light's corners: 8 · 2⁻²⁴, for the rounding of corners. Shadow rays agree with that.
pub const ENDS: f64 = 1.0 / 2_097_152.0;

/// Computes visible parts, and holds the memory for it.
#[derive(Clone, Debug, Default)]
pub struct Occlusion<R: Real> {
    /// The flat shape that is being prepared.
    flat: Flat<R>,
    planes: [Planes<R>; OCCLUDERS],
    /// The light, and its intersections with one occluder, with two, and so on.
    stack: [Outline<R, MOST>; DEPTH + 1],
    /// An outline that is needed for a moment.
    spare: Outline<R, MOST>,
    normal: Vec3<R>,
    /// What parts are measured by, if not by the cosine.
    lobe: Option<Reflection<R>>,
    /// The light if it is a sphere.
    light: Option<Cap<R>>,
    /// The point of a flat light from which its outline is measured, and the reciprocal of its unit.
    base: Option<(Vec3<f64>, R)>,
    /// Only what has x with normal · x ≥ least lies before the light.
    front: (Vec3<R>, R),
    terms: u32,
}

/// A part of the light: the sphere that bounds it, if one does, and its Ω⊥.
type Part<R> = (Option<Cap<R>>, R);

/// What the occluders so far leave of a light.
struct Left<R: Real> {
    /// Ω⊥ of the light, and of what is left of it.
    all: R,
    visible: R,
    /// Lanes in which one occluder hides the whole light.
    covered: R::Mask,
    /// Number of occluders that hide part of it.
    kept: usize,
}

impl<R: Real> Occlusion<R> {
    /// Empty memory.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of intersections that the last computation measured: its time grows with it.
    #[must_use]
    pub const fn terms(&self) -> u32 {
        self.terms
    }

    /// The projected solid angle Ω⊥ in [0, π] of the part of the light that the occluders leave visible at each point, on a surface with the
    /// unit normal `normal`. Both sides of a flat light count. `None` if there are more than [`OCCLUDERS`] occluders, if too many of them
    /// overlap as seen from a point, if the part is bounded by two spheres that overlap, if a polyhedron does not lie before the light as a
    /// whole, or if the light is one: then it must be sampled.
    ///
    /// In a packet, `None` concerns all lanes: one of them may be the only one with too many. What a packet of 8 can compute, each of its
    /// lanes can alone, with the same bits.
    ///
    /// Greatest error: 1e−6 times the angle around the light, in radians, for each of the occluders that occlude it (6e−7 measured, and 2e−7
    /// among polygons; in double precision 1e−7). The error is absolute: where the occluders leave little, it may be as large as what is
    /// left. It grows by the reciprocals of the sine of an edge that is seen under more than a right angle, and of the cosine of the
    /// half-angle of a sphere. A point that lies over a flat occluder, nearer to its plane than 1e−6 of its extent, may be on either side.
    /// Measured by `cargo test -p etendue-render-tests occlusion -- --nocapture --include-ignored`.
    ///
    /// A flat light whose corners are all nearer to their mean than half of its distance is computed from small differences: there the
    /// error is 1e−7 times the square of half of its perimeter over its distance, alone and behind one flat occluder (7e−8 measured), and
    /// as much again for each further one: it stays relative to the light however small that is. Measured by
    /// `cargo test -p etendue-render-tests occlusion::compact -- --nocapture`.
    ///
    /// Behind polyhedra the error is 3e−6 times the angle around the light where the point is nearer to the plane of a face than 1e−2 of
    /// the distance, since the rounding of the normal decides which side it is on, and otherwise as above (1e−7 measured everywhere). To that
    /// comes the angle by which their outlines are displaced for the point, by their [deviation](crate::Polyhedron::deviation): a polyhedron
    /// no wider than the rounding of its coordinates may hide nothing. A point on its surface may be inside or outside.
    #[inline]
    pub fn visible(&mut self, point: Vec3<R>, normal: Vec3<R>, light: &Solid, occluders: &[Solid]) -> Option<R> {
        self.lobe = None;
        self.part(point, normal, light, occluders)
    }

    /// The projected solid angle in [0, π] of the visible part after the map of a reflection at each point, whose normal must be `normal`: a
    /// surface reflects about F · [albedo](Reflection::albedo) · L/π times this of a light with the radiance L. Like
    /// [`visible`](Self::visible) otherwise; `None` also if a sphere blocks, or is blocked.
    ///
    /// Parts are clipped before the map, and measured after it. Greatest error of a light without occluders in single precision: 3e−5 of the
    /// result plus 0.01 (measured by `cargo test -p etendue-render-tests occlusion::lobes -- --nocapture`); of spheres as [`Reflection::sphere`].
    #[inline]
    pub fn reflected(
        &mut self,
        point: Vec3<R>,
        normal: Vec3<R>,
        reflection: &Reflection<R>,
        light: &Solid,
        occluders: &[Solid],
    ) -> Option<R> {
        self.lobe = Some(*reflection);
        self.part(point, normal, light, occluders)
    }

    /// What is visible, by the cosine or the lobe.
    #[inline]
    fn part(&mut self, point: Vec3<R>, normal: Vec3<R>, light: &Solid, occluders: &[Solid]) -> Option<R> {
        if occluders.len() > OCCLUDERS {
            return None;
        }
        self.normal = normal;
        self.terms = 0;
        let all = match *light {
            Solid::Polyhedron(_) => return None,
            Solid::Sphere { center, radius } => {
                let (center, radius) = (rounded(center) - point, R::lit(radius));
                let cap = Cap::new(center, radius);
                self.front = (-cap.axis, -cap.tangents);
                (self.light, self.base) = (Some(cap), None);
                let all = match &self.lobe {
                    Some(lobe) => lobe.sphere(center, radius),
                    None => unoccluded(&cap, center, radius, normal),
                };
                self.stack[0].start(Vec3::default(), &[], R::Mask::splat(true));
                all
            }
            _ => {
                self.flat.take(light, point);
                let flat = &self.flat;
                let towards = R::lit(-1.0).copysign(-flat.height);
                let far = (0..flat.count).map(|i| corner(light, i).max_abs()).fold(0.0, f64::max);
                let end = point.max_abs().greater(R::lit(far)) * R::lit(ENDS);
                let least = (flat.height * towards / flat.scale + end).lesser(R::lit(0.0));
                self.front = (flat.normal * towards, least);
                self.light = None;
                self.base = Some((corner(light, 0) + exactly(flat.middle), flat.scale));
                self.stack[0].start(
                    flat.middle.mul_add(flat.scale, flat.corners[0]),
                    &flat.offsets[..flat.count],
                    flat.height.abs().gt(R::lit(0.0)),
                );
                if self.stack[0].clip(normal, R::lit(0.0)).is_err() || self.stack[0].is_empty() {
                    return Some(R::lit(0.0));
                }
                measure(self.lobe.as_ref(), &self.stack[0], normal, &mut self.spare)
            }
        };
        self.beside(all.clamped(R::lit(0.0), R::lit(core::f64::consts::PI)), point, occluders).ok()
    }

    /// What the occluders leave of `all`.
    #[inline]
    fn beside(&mut self, all: R, point: Vec3<R>, occluders: &[Solid]) -> Result<R, TooMany> {
        let mut left = Left { all, visible: all, covered: !all.gt(R::lit(0.0)), kept: 0 };
        self.stack[0].keep(!left.covered);
        for occluder in occluders {
            if left.covered.all() {
                break;
            }
            self.flat.take(occluder, point);
            let (planes, flat, target) = self.next(left.kept);
            match *occluder {
                Solid::Polyhedron(ref body) => planes.polyhedron(body, point, &target)?,
                Solid::Sphere { center, radius } => {
                    planes.sphere(rounded(center) - point, R::lit(radius), &target)?;
                }
                _ => planes.flat(flat, occluder, point, &target)?,
            }
            self.hide(&mut left)?;
        }
        Ok(left.visible.clamped(R::lit(0.0), all).keep(!left.covered))
    }

    /// The place of occluder `k`, the flat shape that was taken last, and the light.
    #[inline(always)]
    fn next(&mut self, k: usize) -> (&mut Planes<R>, &Flat<R>, Target<'_, R>) {
        let Self { planes, flat, stack, base, front, .. } = self;
        (&mut planes[k], flat, Target { outline: &stack[0], base: *base, front: *front })
    }

    /// Takes away what the occluder that was prepared last hides, and keeps the occluder if it hides anything.
    #[inline]
    fn hide(&mut self, left: &mut Left<R>) -> Result<(), TooMany> {
        let k = left.kept;
        if let Some((cap, hidden)) = self.intersect(0, k, self.light)? {
            self.planes[k].lanes = self.stack[1].some();
            left.covered = left.covered | hidden.ge(left.all);
            left.visible -= self.less(1, k, cap, hidden)?;
            left.kept += 1;
        }
        Ok(())
    }

    /// Puts what occluder `k` hides of intersection `depth` on the stack. Returns the sphere that bounds it and its Ω⊥, or `None` if
    /// there is no such part in any lane. `cap` is the sphere that bounds the intersection, if there is one.
    #[inline]
    fn intersect(&mut self, depth: usize, k: usize, cap: Option<Cap<R>>) -> Result<Option<Part<R>>, TooMany> {
        let (seen, normal, lobe, spare) = (&self.planes[k], self.normal, self.lobe.as_ref(), &mut self.spare);
        let (below, above) = self.stack.split_at_mut(depth + 1);
        let (from, Some(to)) = (&below[depth], above.first_mut()) else { return Err(TooMany) };
        let whole = depth == 0 && self.light.is_some();
        let mut lanes = from.some() & seen.lanes;
        if let Some(own) = &seen.cap {
            return match cap {
                Some(cap) if cap.is_apart_from(own, lanes) => Ok(None),
                Some(_) => Err(TooMany),
                None if lobe.is_some() => Err(TooMany),
                None => {
                    to.start(from.base(), from.corners(), lanes);
                    let part = own.projected_solid_angle_within(to, normal, spare)?;
                    to.keep(part.gt(R::lit(0.0)));
                    self.terms += 1;
                    Ok((!to.is_empty()).then_some((Some(*own), part)))
                }
            };
        }
        let planes = || seen.planes[..seen.count].iter().zip(&seen.heights);
        if let Some(cap) = &cap {
            for (plane, _) in planes() {
                lanes = lanes & plane.dot(cap.axis).ge(-(cap.sin * plane.length()));
            }
        }
        if !lanes.any() {
            return Ok(None);
        }
        if whole && !seen.outline.corners().is_empty() {
            to.start(Vec3::default(), seen.outline.corners(), lanes);
            to.clip(normal, R::lit(0.0))?;
        } else {
            let from = if whole {
                spare.start(Vec3::default(), &cap.ok_or(TooMany)?.square()?, lanes);
                spare.clip(normal, R::lit(0.0))?;
                lanes = spare.some();
                &*spare
            } else {
                from
            };
            // most occluders are beside the light, and most planes do not cut it
            let mut cut = [R::Mask::splat(false); EDGES];
            for (cut, (&plane, &height)) in cut.iter_mut().zip(planes()) {
                let (any, all) = from.inside(plane, height);
                *cut = !all;
                lanes = lanes & any;
                if !lanes.any() {
                    return Ok(None);
                }
            }
            to.start(from.base(), from.corners(), lanes);
            for (&cut, (&plane, &height)) in cut.iter().zip(planes()) {
                if (cut & to.some()).any() {
                    to.clip_in(cut, plane, -height)?;
                }
            }
        }
        if to.is_empty() {
            return Ok(None);
        }
        self.terms += 1;
        if self.terms > TERMS {
            return Err(TooMany);
        }
        let part = match &cap {
            Some(_) if lobe.is_some() => return Err(TooMany),
            Some(cap) => cap.projected_solid_angle_within(to, normal, spare)?,
            None => measure(lobe, to, normal, spare),
        };
        Ok(Some((cap, part)))
    }

    /// Ω⊥ of the part of intersection `depth`, which has `all`, that the occluders before `end` leave.
    fn less(&mut self, depth: usize, end: usize, cap: Option<Cap<R>>, all: R) -> Result<R, TooMany> {
        let mut left = all;
        for k in 0..end {
            if let Some((cap, part)) = self.intersect(depth, k, cap)? {
                left -= self.less(depth + 1, k, cap, part)?;
            }
        }
        Ok(left)
    }
}

/// Ω⊥ of an outline above the horizon, after the map of a lobe if there is one: it keeps heights.
#[inline(always)]
fn measure<R: Real>(
    lobe: Option<&Reflection<R>>,
    outline: &Outline<R, MOST>,
    normal: Vec3<R>,
    spare: &mut Outline<R, MOST>,
) -> R {
    match lobe {
        Some(lobe) => {
            spare.take(outline, |v| lobe.to_cosine(v));
            spare.projected_solid_angle(Vec3::lit([0.0, 0.0, 1.0]))
        }
        None => outline.projected_solid_angle(normal),
    }
}

/// Ω⊥ of a sphere without occluders.
#[inline]
fn unoccluded<R: Real>(cap: &Cap<R>, center: Vec3<R>, radius: R, normal: Vec3<R>) -> R {
    let cos = cap.axis.dot(normal);
    // a reserve keeps caps that touch the horizon out
    let above = cos.gt(cap.sin * R::lit(1.000_01)) & cap.tangents.gt(R::lit(0.0));
    let whole = R::lit(core::f64::consts::PI) * cap.sin * cap.sin * cos;
    if above.all() {
        return whole;
    }
    let sphere = etendue::Sphere::new(center, radius).by_projected_solid_angle(Vec3::default(), normal);
    R::blend(above, whole, sphere.projected_solid_angle())
}
