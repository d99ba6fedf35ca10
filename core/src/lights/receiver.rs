//! What is lit, and what a set of lights returns for it.

use crate::real::Real;
use crate::vector::Vec3;

/// A light of a set, or a part of a group in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Which {
    /// The index of the light, as the set was given.
    pub light: u32,
    /// The index of the part in a group, such as a triangle of a mesh; 0 of other lights.
    pub part: u32,
}

impl From<u32> for Which {
    fn from(light: u32) -> Self {
        Self { light, part: 0 }
    }
}

/// From which sides a receiver gathers light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side<R> {
    /// From above a surface, on the side of this unit normal.
    Surface(Vec3<R>),
    /// From both sides of a surface, such as a leaf or glass.
    Both,
    /// From all around: a point of fog, or of hair.
    None,
}

/// What is lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver<R> {
    /// The point, in the coordinates of the scene.
    pub point: Vec3<R>,
    /// From where it gathers light.
    pub side: Side<R>,
    /// The light that the point lies on, if it does. It is skipped, and so is a light of whose surface, or plane, the point is within
    /// the rounding of its own computation: a flat or convex light does not light itself, but rounding may put a point of it in front
    /// of it. Of a group only the part is skipped.
    pub on: Option<Which>,
}

impl<R: Real> Receiver<R> {
    /// The normal for a choice: 0 where there is none.
    #[inline(always)]
    pub(super) fn normal(&self) -> Vec3<R> {
        match self.side {
            Side::Surface(normal) => normal,
            Side::Both | Side::None => Vec3::ZERO,
        }
    }
}

/// A sample of a set of lights.
///
/// The estimator is f · L · cosθ · [`weight`](Self::weight), with the radiance L of the light `which`, or what stands for it, once a shadow
/// ray along `direction` has got as far as [`reach`](Self::reach).
#[derive(Clone, Copy, Debug)]
pub struct LightsSample<R> {
    /// The light.
    pub which: Which,
    /// Unit direction from the receiver to the light.
    pub direction: Vec3<R>,
    /// Distance along it, in the unit of the coordinates; [`FAR`](crate::light::FAR) of lights at infinity.
    pub distance: R,
    /// The point of the light, in the coordinates of the scene.
    pub point: Vec3<R>,
    /// How far that point is at most from the surface of the light, or from the plane of a flat one, through rounding: tests allow no
    /// more. 0 of lights without a surface.
    pub bound: R,
    /// Unit normal there, on the side that emits; of lights without a surface, the direction back.
    pub normal: Vec3<R>,
    /// Probability of the light times the density of the direction, per steradian; of point, spot and directional lights the probability
    /// alone; of lines in their [measure](crate::Line). 0 where there is no sample.
    pub pdf: R,
    /// Probability with which the light was chosen, which is a factor of `pdf`: a host that first chooses a light and then weighs the two ways
    /// to meet that one divides pdfs by it.
    pub pmf: R,
    /// What the radiance of the light is to be multiplied by: 1, of a point light 1/distance², of a spot light that times its falloff;
    /// 0 where the light does not emit towards the receiver.
    pub factor: R,
    /// True where no other technique can hit the light, so that its weight in multiple importance sampling is 1.
    pub delta: bool,
}

impl<R: Real<Scalar = R>> LightsSample<R> {
    /// factor/pdf; 0 where there is no sample. Always finite.
    #[inline]
    pub fn weight(&self) -> R {
        let some = self.pdf.gt(R::lit(1e-37)) & self.factor.gt(R::lit(0.0));
        let weight = self.factor / R::blend(some, self.pdf, R::lit(1.0));
        weight.lesser(R::lit(f64::from(f32::MAX))).keep(some)
    }
    /// How far a shadow ray along `direction` must get unhindered: the distance, less what the rounding of the sample and of `bound` may
    /// take from it. A ray that meets the light's own surface before that is not hindered by it.
    #[inline]
    pub fn reach(&self) -> R {
        let (zero, unit) = (R::lit(0.0), R::lit(if R::DOUBLE { f64::EPSILON } else { f64::from(f32::EPSILON) }));
        let cos = self.direction.dot(self.normal).abs().greater(unit);
        let slack = (self.bound + self.distance * (unit * R::lit(8.0))) / cos;
        (self.distance - slack).greater(zero)
    }
}
