//! What the renderer asks of the form of a shape. Each form is a file, which answers all of it.

use super::ends::{End, Segment};
use super::points::Points;
use super::spread::Spread;
use crate::packet::{M8, V8, X8, each_bit};
use crate::technique::Measure;
use etendue::light::Picture;
use etendue::{LightSample, Mask, Real, Vec2, Vec3};
use etendue_visible::{Occluder, Solid};

/// The form of a shape: where it is, how rays meet it, how it is sampled as a light, and what stands for it in closed forms.
///
/// A light is kept as three vectors, whose meaning each form chooses, so that the lanes of a packet hold lights of any form.
pub(crate) trait Form: Sized {
    /// The form, prepared for rays.
    type Hittable: Hittable;
    /// How its points are found in a picture that it shows; `None` if it shows none, and emits the mean of a picture everywhere.
    const CHART: Option<Chart> = None;
    /// Its greatest area as seen from far away, as a part of the area of its surface.
    const SILHOUETTE: f64 = 1.0;
    /// That area, in units of the product of its [halves](Self::halves).
    const SHARE: f64;

    /// Least and greatest corner of the bounding box.
    fn bounds(&self) -> [[f32; 3]; 2];
    /// Area of the surface, in squared scene units.
    fn area(&self) -> f64;
    /// A point of a flat form and its unit normal; `None` for a curved one.
    fn plane(&self) -> Option<[Vec3<f64>; 2]>;
    /// The middle of the form.
    fn middle(&self) -> Vec3<f64>;
    /// Half edges or radii of the form, as it is seen in this direction.
    fn halves(&self, direction: Vec3<f64>) -> [Vec3<f64>; 2];

    /// Prepares the form for rays.
    fn hittable(&self) -> Self::Hittable;
    /// The outward normals at points of the surface, of any length.
    #[cfg(feature = "analytic")]
    #[inline(always)]
    fn outwards(&self, _points: V8) -> V8 {
        V8::from(self.normal())
    }
    /// The outward unit normals where rays, given by their origins and directions, hit it, at these distances.
    #[inline(always)]
    fn outward_at(&self, _rays: [V8; 2], _distance: X8) -> V8 {
        V8::from(self.normal())
    }
    /// Where these rays hit it, at the intersections that are nearest to these distances: shading points.
    fn points(&self, rays: [V8; 2], distance: X8, reach: f32) -> Points;

    /// The vectors of a light.
    fn vectors(&self) -> [[f32; 3]; 3];
    /// The extent of a light with these vectors.
    fn extent(vectors: [Vec3<f64>; 3]) -> Extent;
    /// The normals of lights with these vectors, of any length; 0 for curved ones.
    #[inline(always)]
    fn normals([_, first, second]: [V8; 3]) -> V8 {
        first.cross(second)
    }
    /// Samples lights with these vectors from the points `p` on surfaces with this normal.
    fn sample<D: From<LightSample<X8>>>(vectors: [V8; 3], measure: Measure, p: V8, normal: V8, u: Vec2<X8>) -> D;
    /// Pdf per steradian with which the form, or what the points see of one with a spread, is sampled by solid angle in the direction
    /// `w`, in which it is hit from `p`.
    fn pdf(&self, spread: Option<Spread<f32>>, p: V8, w: V8) -> X8;

    /// The coordinates (s, t) of points on a flat form; 0 for a sphere.
    #[inline]
    fn coordinates(&self, _point: V8) -> Vec2<X8> {
        Vec2::new(X8::lit(0.0), X8::lit(0.0))
    }
    /// Samples the form in proportion to the picture that it shows. `axes` are the rows of a matrix from world space to the axes of the
    /// picture on a curved form.
    fn sample_picture(
        &self,
        _picture: &Picture<'_>,
        _axes: &[[f32; 3]; 3],
        measure: Measure,
        [p, normal]: [V8; 2],
        u: Vec2<X8>,
    ) -> LightSample<X8> {
        Self::sample(self.vectors().map(V8::from), measure, p, normal, u)
    }
    /// Pdf per steradian with which [`sample_picture`](Self::sample_picture) by solid angle draws the direction `w`.
    fn pdf_of_picture(&self, _picture: &Picture<'_>, _axes: &[[f32; 3]; 3], p: V8, w: V8) -> X8 {
        self.pdf(None, p, w)
    }

    /// What closed forms take it for. By default nothing is known but a ball around the form.
    fn outline(&self) -> Occluder<'static> {
        let [low, high] = self.bounds().map(|corner| Vec3::<f64>::from(corner.map(f64::from)));
        // wider than the rounding of its centre and radius
        let (center, radius) = ((low + high) * 0.5, (high - low).length() * 0.5);
        let radius = (radius + center.max_abs() * 1e-6) * (1.0 + 1e-6);
        Occluder::Within(Solid::Sphere {
            center: center.map(|x| f64::from(x as f32)),
            radius: f64::from(radius as f32),
        })
    }

    /// The unit normal of a flat form; 0 for a curved one.
    #[inline]
    fn normal(&self) -> [f32; 3] {
        self.plane().map_or([0.0; 3], |[_, normal]| [normal.x as f32, normal.y as f32, normal.z as f32])
    }
}

/// How a picture lies on a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chart {
    /// By the coordinates (s, t) of the point p + s u + t v of a parallelogram with these edges.
    Parallelogram,
    /// By the same of a triangle.
    Triangle,
    /// By azimuth and height about the axes of a sphere.
    Sphere,
}

/// A sphere around a light, and the normal of a flat light, of any length.
pub(crate) struct Extent {
    pub(crate) center: Vec3<f64>,
    pub(crate) radius: f64,
    pub(crate) normal: Vec3<f64>,
}

/// Hits nearer to the origin or to the limit of a ray than this fraction of a primitive's size are computed in double precision. The
/// error in single precision is some 2⁻²¹ of the size, and thus at most 2⁻¹⁶ of the other distances.
pub(crate) const NEAR: f64 = 1.0 / 32.0;

/// Distances beyond this part of the way to the limit are compared with it in double precision, where hits before it occlude. At nearly all
/// angles, that includes all surfaces that are [level](End::Level) with the end.
pub(crate) const NEAR_LIMIT: f64 = 1.0 / 256.0;

/// Eight rays, as a shape meets them.
#[derive(Clone, Copy)]
pub(crate) struct Approach<'a> {
    pub(crate) origin: V8,
    /// Unit directions.
    pub(crate) direction: V8,
    /// Lanes that matter.
    pub(crate) lanes: M8,
    /// Lanes of rays that begin on the shape.
    pub(crate) own: M8,
    /// Distances beyond which nothing counts.
    pub(crate) limit: X8,
    /// For segments, ends that of a lane [on what it reaches](Hittable::reached_by).
    pub(crate) reaching: &'a dyn Fn(usize, Segment) -> Segment,
}

/// How rays meet a form.
pub(crate) struct Meeting {
    /// Distances along the rays.
    pub(crate) distance: X8,
    /// Lanes where these are positive and less than the limit; for segments, lanes in which the form [hides](End::Hidden) the end.
    pub(crate) hit: M8,
    /// Of segments, lanes whose ends are [level](End::Level) with the form, and within its outline.
    pub(crate) level: M8,
}

/// A form, prepared for rays.
pub(crate) trait Hittable {
    /// How the rays meet it. With `ANY`, they are segments that end at the limit.
    fn meet<const ANY: bool>(&self, rays: &Approach<'_>) -> Meeting;
    /// Lanes in which rays meet the front at these distances.
    fn fronts(&self, rays: [V8; 2], distance: X8) -> M8;
    /// A segment that ends on the form but for rounding, with its end there.
    fn reached_by(&self, segment: Segment) -> Segment;
}

impl Approach<'_> {
    /// Lanes of segments that meet a form so near to their ends, if all that is nearer than `near` is computed in double precision, that single
    /// precision does not tell whether it hides these.
    #[inline(always)]
    pub(crate) fn near_limit<const ANY: bool>(&self, distance: X8, near: f32) -> M8 {
        let band = (self.limit * X8::lit(NEAR_LIMIT)).greater(X8::splat(near / 4096.0));
        if ANY { (distance - self.limit).abs().lt(band) } else { M8::splat(false) }
    }
    /// The meeting with these lanes as double precision finds them: `of` tells of a segment, and whether it begins on the form, at which
    /// distance it meets the form, and where its end lies.
    ///
    /// Rays come by value, so that they are in registers where nothing is unclear.
    #[cold]
    #[inline(never)]
    pub(crate) fn closely<const ANY: bool>(
        self,
        lanes: M8,
        mut meeting: Meeting,
        of: impl Fn(Segment, bool) -> (Option<f64>, End),
    ) -> Meeting {
        each_bit(lanes.bits(), |lane| {
            let (found, end) = of(self.segment(lane), self.own.lane(lane));
            let limit = self.limit.as_array()[lane];
            meeting.distance.as_mut_array()[lane] = match found {
                Some(found) if !ANY => found as f32,
                // before the limit, whatever the rounding
                Some(found) if end == End::Hidden => (found as f32).min(limit * (1.0 - f32::EPSILON)),
                _ => -1.0,
            };
            if ANY && end == End::Level && found.is_some() {
                meeting.level = meeting.level | M8::from_bits(1 << lane);
            }
        });
        meeting
    }
    /// A lane as a segment, in double precision.
    fn segment(&self, lane: usize) -> Segment {
        let [origin, direction] = [self.origin, self.direction].map(|v| v.lane(lane).map(f64::from));
        (self.reaching)(lane, Segment { origin, direction, length: self.limit.as_array()[lane].into() })
    }
}

/// Not inlined, so that its registers do not burden the cheaper measures.
#[inline(never)]
pub(crate) fn projected<D>(sample: impl Fn() -> D) -> D {
    sample()
}

/// A point or direction in double precision.
pub(crate) fn wide(v: [f32; 3]) -> Vec3<f64> {
    v.map(f64::from).into()
}
