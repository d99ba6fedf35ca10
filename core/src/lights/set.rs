//! The set, its choice and its samples.

use super::emission::{self, Emission, Face};
use super::emitter::{Emitter, Piece, Plane, Shape};
use super::mixture::{Mixture, MixtureAt, Source};
use super::prepared::{self, Drawn, Prepared};
use super::receiver::{LightsSample, Receiver, Side, Which};
use crate::light::{EnvironmentBySolidAngle, Sphere};
use crate::math::quotient;
use crate::real::{Mask, Real, Uint, unit_interval};
use crate::select::{LightBound, LightChoice, LightsError, TreeAt};
use crate::vector::{Vec2, Vec3};
use alloc::vec::Vec;
use core::cell::RefCell;
use core::f64::consts::PI;

/// A part of a set as the choice knows it.
#[derive(Clone, Debug)]
struct Part<R: Real<Scalar = R>> {
    shape: Shape<R>,
    /// The plane of the light, if it is flat.
    plane: Option<Plane<R>>,
    which: Which,
    two_sided: bool,
    /// Emits from the other side than the shape's.
    reversed: bool,
}

impl<R: Real<Scalar = R>> Part<R> {
    /// Whether a point is on it, to within the rounding of its own computation.
    #[inline(always)]
    fn holds(&self, p: Vec3<R>) -> bool {
        match (&self.shape, &self.plane) {
            (Shape::Ellipse(_), _) | (_, None) => self.shape.on_surface(p),
            (_, Some(plane)) => plane.holds(p).any(),
        }
    }
    /// The unit normal where a sample is, on the side of the shape's.
    #[inline(always)]
    fn normal(&self, p: Vec3<R>, sample: &Drawn<R>) -> Vec3<R> {
        match (&self.shape, &self.plane) {
            (_, Some(plane)) => plane.normal,
            (Shape::Sphere(light), None) => {
                sample.direction.mul_add(sample.distance, p - light.center).unit_and_length().0
            }
            _ => sample.normal,
        }
    }
}

/// A set of lights of any kind.
///
/// A choice among them is that of a [`Mixture`], by what each can contribute at the receiver. The light is then sampled by solid angle;
/// a bilinear patch by area, a line by angle, a constant sky above a surface by projected solid angle, and an image of the sky by the weights
/// of its texels.
///
/// - Domain: up to 2²⁷ lights and triangles of meshes together. A radiance that is not positive makes a light dark. The choice works in
///   single precision: in double precision, a light that is above the horizon of a surface by less than the rounding of a place to
///   single precision may be missed.
/// - Exact: [`pdf`](LightsAt::pdf) of the direction of a sample has the bits of its `pdf`, but of patches and lines, of which a rounded
///   direction determines it only to rounding.
/// - Degenerate: without lights, for a receiver that none reaches, and of numbers that are not finite, the pdf is 0.
/// - Sizes: each light and each triangle of a mesh takes 104 bytes in single precision and 184 in double, besides 58 of the tree;
///   [`LightsAt`], which lives on the stack, 2 kB in single precision and 4 kB in double.
#[derive(Clone, Debug)]
pub struct Lights<R: Real<Scalar = R>> {
    parts: Vec<Part<R>>,
    /// The index of the first part of each light, and the number of parts.
    first: Vec<u32>,
    choice: Mixture,
    /// The radiance of the first sky, in the unit of the other lights.
    sky: f64,
}

impl<R: Number> Lights<R> {
    /// The set of these lights with their radiances: see [`Emitter`] for what a light may be.
    ///
    /// # Errors
    /// If there are more than [`LightTree::MOST`](crate::select::LightTree::MOST) lights and triangles.
    pub fn new<E: Into<Emitter<R>>>(lights: impl IntoIterator<Item = (E, R)>) -> Result<Self, LightsError> {
        let lights: Vec<(Emitter<R>, R)> =
            lights.into_iter().map(|(light, radiance)| (light.into(), radiance)).collect();
        R::build(lights)
    }
    /// Prepares the choice for a receiver.
    #[inline]
    pub fn at(&self, receiver: Receiver<R>) -> LightsAt<'_, R> {
        R::at(self, receiver)
    }
    /// A ray that leaves the light `which`, by four numbers in [0, 1), for methods that trace from the lights. `scene` is a sphere around
    /// all that is lit, through which lights infinitely far away send theirs. Without such a light, and of numbers that are not finite,
    /// the pdf is 0.
    ///
    /// - Formula: uniform over the surface, and in proportion to the cosine above it, so that all rays of a light carry the same power; of
    ///   two sides either has half of the rays. A spot light sends rays uniformly into its outer cone, point lights and lines to all sides.
    /// - Choose a light by its power, which is the mean of the [`weight`](Emission::weight) times its radiance.
    #[must_use]
    pub fn emit(&self, which: impl Into<Which>, u: [R; 4], scene: Sphere<R>) -> Emission<R> {
        R::emit(self, which.into(), u, scene)
    }
    /// Number of lights.
    #[must_use]
    pub fn len(&self) -> usize {
        self.first.len() - 1
    }
    /// Whether there is no light.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// [`Lights`] prepared for a receiver. It remembers the light that was sampled last, so that its pdf needs no second preparation.
#[derive(Clone, Debug)]
pub struct LightsAt<'a, R: Real<Scalar = R>> {
    lights: &'a Lights<R>,
    receiver: Receiver<R>,
    /// Where that takes more than to look up a tree.
    choice: Option<MixtureAt<'a, R>>,
    last: RefCell<Last<R>>,
}

/// The light that was sampled last.
#[derive(Clone, Debug)]
struct Last<R: Real<Scalar = R>> {
    /// Its index; at first that of none.
    index: u32,
    /// Whether the receiver is on it.
    is_on: bool,
    /// The probability of its choice; negative while that is not known.
    pmf: R,
    prepared: Prepared<R>,
}

impl<R: Number> LightsAt<'_, R> {
    /// Chooses a light and samples it by three numbers in [0, 1): the first one chooses the light, the others a direction to it.
    #[inline]
    pub fn sample(&self, u: [R; 3]) -> LightsSample<R> {
        R::sample(self, u)
    }
    /// The pdf with which [`sample`](Self::sample) draws the unit direction `w` as one of the light `which`: 0 where the light is not
    /// there, where no other technique can hit it, and of the light that the receiver is on.
    #[inline]
    pub fn pdf(&self, which: impl Into<Which>, w: Vec3<R>) -> R {
        R::pdf(self, which.into(), w)
    }
}

/// The numbers of a set of lights, for each of which its routines are compiled in this library.
pub trait Number: Compiled {}
impl Number for f32 {}
impl Number for f64 {}

/// The routines for one number type. Nothing outside names it, so that there are no others.
#[allow(unreachable_pub, reason = "a public trait has it above it")]
pub trait Compiled: Real<Scalar = Self> {
    fn build(lights: Vec<(Emitter<Self>, Self)>) -> Result<Lights<Self>, LightsError>;
    fn at(lights: &Lights<Self>, receiver: Receiver<Self>) -> LightsAt<'_, Self>;
    fn sample(at: &LightsAt<'_, Self>, u: [Self; 3]) -> LightsSample<Self>;
    fn pdf(at: &LightsAt<'_, Self>, which: Which, w: Vec3<Self>) -> Self;
    fn emit(lights: &Lights<Self>, which: Which, u: [Self; 4], scene: Sphere<Self>) -> Emission<Self>;
}
macro_rules! compiled {
    ($($number:ident)+) => {$(
        impl Compiled for $number {
            fn build(lights: Vec<(Emitter<Self>, Self)>) -> Result<Lights<Self>, LightsError> {
                build(lights)
            }
            fn at(lights: &Lights<Self>, receiver: Receiver<Self>) -> LightsAt<'_, Self> {
                at(lights, receiver)
            }
            fn sample(at: &LightsAt<'_, Self>, u: [Self; 3]) -> LightsSample<Self> {
                sample(at, u)
            }
            fn pdf(at: &LightsAt<'_, Self>, which: Which, w: Vec3<Self>) -> Self {
                pdf(at, which, w)
            }
            fn emit(lights: &Lights<Self>, which: Which, u: [Self; 4], scene: Sphere<Self>) -> Emission<Self> {
                emit(lights, which, u, scene)
            }
        }
    )+};
}
compiled!(f32 f64);

fn build<R: Real<Scalar = R>>(lights: Vec<(Emitter<R>, R)>) -> Result<Lights<R>, LightsError> {
    let count = lights.iter().map(|(light, _)| light.pieces.len()).sum();
    let (mut parts, mut first) = (Vec::with_capacity(count), Vec::with_capacity(lights.len() + 1));
    let mut bounds: Vec<(LightBound, Source, f64)> = Vec::with_capacity(count);
    for (light, (emitter, radiance)) in (0_u32..).zip(lights) {
        first.push(parts.len() as u32);
        for (part, Piece { shape, two_sided, facing }) in (0_u32..).zip(emitter.pieces) {
            let (mut bound, source) = shape.bound();
            let plane = shape.plane();
            let against = |to: Vec3<R>| plane.is_some_and(|plane| plane.normal.dot(to).lt(R::lit(0.0)).any());
            let reversed = facing.is_some_and(against);
            if reversed {
                bound.normal = bound.normal.map(|x| -x);
            }
            bound.two_sided = two_sided && bound.normal != [0.0; 3] && !matches!(shape, Shape::Spot(_));
            let power = f64::from(bound.power) * radiance.lane_f64(0);
            // what is no number is dark
            let power = if power > 0.0 && power < f64::INFINITY { power } else { 0.0 };
            bounds.push((bound, source, power));
            parts.push(Part { shape, plane, which: Which { light, part }, two_sided, reversed });
        }
    }
    first.push(parts.len() as u32);
    let greatest = bounds.iter().fold(f64::MIN_POSITIVE, |most, (.., power)| most.greater(*power));
    let relative = |power: f64| {
        let least = f64::from(f32::MIN_POSITIVE);
        if power > 0.0 { (power / greatest).greater(least) as f32 } else { 0.0 }
    };
    let mut sky = None;
    let mut sources = Vec::with_capacity(count);
    for &(bound, source, power) in &bounds {
        // intensity and radiance are in the ratio of the powers
        let unit = power / f64::from(bound.power) / greatest;
        sources.push(match source {
            Source::Beam(light, _) => Source::Beam(light, unit as f32),
            Source::Sun(direction, reach, _) => Source::Sun(direction, reach, relative(power)),
            // others than the first are suns that cover all directions
            Source::Sky if sky.is_some() => Source::Sun([0.0, 0.0, 1.0], 2.0, relative(power)),
            Source::Sky => {
                sky = Some(unit);
                source
            }
            Source::Lamp => source,
        });
    }
    let bounds = bounds.iter().map(|&(bound, _, power)| LightBound { power: relative(power), ..bound }).collect();
    Ok(Lights { parts, first, choice: Mixture::new(bounds, sources, &())?, sky: sky.unwrap_or(0.0) })
}

#[inline(always)]
fn at<R: Real<Scalar = R>>(lights: &Lights<R>, receiver: Receiver<R>) -> LightsAt<'_, R> {
    let of_sky = if matches!(receiver.side, Side::Surface(_)) { PI } else { 4.0 * PI };
    let sky = || R::lit(lights.sky * of_sky);
    // each in its place, so that kilobytes are not moved
    macro_rules! none {
        () => {
            RefCell::new(Last {
                index: u32::MAX,
                is_on: false,
                pmf: R::lit(-1.0),
                prepared: Prepared::Sky(EnvironmentBySolidAngle),
            })
        };
    }
    if lights.choice.has_lamps_alone() {
        return LightsAt { lights, receiver, choice: None, last: none!() };
    }
    let choice = Some(lights.choice.at(receiver.point, receiver.normal(), None, sky));
    LightsAt { lights, receiver, choice, last: none!() }
}

impl<R: Real<Scalar = R>> LightsAt<'_, R> {
    /// The light that two numbers choose, and its pmf.
    #[inline(always)]
    fn choose(&self, u: R, second: R) -> (u32, R) {
        let choice = match &self.choice {
            Some(choice) => choice.choose(u, second),
            None if self.lights.parts.len() == 1 => return (0, R::lit(1.0)),
            None => self.lights.choice.choose_lamp(&self.lamps(), u, second),
        };
        (choice.index.lane(0), choice.pmf)
    }
    /// The pmf of the light that is prepared, which has this index.
    #[inline(always)]
    fn pmf(&self, index: u32) -> R {
        let mut last = self.last.borrow_mut();
        if last.pmf.lt(R::lit(0.0)).any() {
            last.pmf = match &self.choice {
                Some(choice) => choice.pmf(index),
                None if self.lights.parts.len() == 1 => R::lit(1.0),
                None => self.lights.choice.shared(self.lamps().pmf_of(index)),
            };
        }
        last.pmf
    }
    #[inline(always)]
    fn lamps(&self) -> TreeAt<'_, R> {
        self.lights.choice.lamps_at(self.receiver.point, self.receiver.normal())
    }
    /// What `f` makes of the prepared sampler of a part, and whether the receiver is on that.
    #[inline(always)]
    fn with<T>(&self, index: u32, part: &Part<R>, f: impl FnOnce(&Prepared<R>) -> T) -> (T, bool) {
        let Receiver { point, side, on } = self.receiver;
        let mut last = self.last.borrow_mut();
        let Last { index: of, is_on, pmf, prepared } = &mut *last;
        if *of != index {
            *of = index;
            *pmf = R::lit(-1.0);
            *is_on = on == Some(part.which) || part.holds(point);
            prepared.prepare(&part.shape, point, side);
        }
        (f(prepared), *is_on)
    }
}

#[inline(always)]
fn sample<R: Real<Scalar = R>>(at: &LightsAt<'_, R>, [u, v, w]: [R; 3]) -> LightsSample<R> {
    let (zero, one) = (R::lit(0.0), R::lit(1.0));
    // among more lights than the first number has digits, a hash of the others decides, which are as good as new for the light
    let [a, b] = [v, w].map(|u| (unit_interval(u) * R::lit(16_777_216.0)).to_uint().lane(0));
    let hash = (a.wrapping_mul(0x9e37_79b9) ^ b.rotate_left(16)).wrapping_mul(0x85eb_ca6b);
    let (index, pmf) = at.choose(unit_interval(u), R::unit(R::Uint::splat(hash)));
    // what cannot contribute is not prepared
    let Some(part) = at.lights.parts.get(index as usize).filter(|_| pmf.gt(zero).any()) else { return nothing() };
    let (mut sample, is_on): (Drawn<R>, bool) =
        at.with(index, part, |light| light.sample(&part.shape, Vec2::new(v, w)));
    at.last.borrow_mut().pmf = pmf;
    let normal = part.normal(at.receiver.point, &sample);
    // of numbers that overflow there is none
    sample.normal = normal.keep(normal.is_within(R::lit(2.0)));
    let delta = sample.delta && !matches!(part.shape, Shape::Line(_));
    let emits = part.two_sided || sample.emits != part.reversed;
    let some = !is_on && sample.pdf.gt(zero).any();
    // of lights without an area, the pdf of a sample is 1 over what the intensity is to be multiplied by
    let (pdf, factor) = if delta { (pmf, quotient(one, sample.pdf)) } else { (pmf * sample.pdf, one) };
    let mask = |truth: bool| R::Mask::splat(truth);
    let (point, bound) = prepared::point(&part.shape, at.receiver.point, &sample);
    let is_behind = part.two_sided && sample.direction.dot(sample.normal).gt(zero).any();
    let normal = if is_behind || part.reversed && !part.two_sided { -sample.normal } else { sample.normal };
    LightsSample {
        which: part.which,
        direction: sample.direction,
        distance: sample.distance,
        point,
        bound,
        normal,
        pdf: pdf.keep(mask(some)),
        pmf,
        factor: R::blend(mask(some && emits), factor, zero),
        delta: sample.delta,
    }
}

/// No sample.
fn nothing<R: Real>() -> LightsSample<R> {
    let (zero, which) = (R::lit(0.0), Which::default());
    let [direction, point, normal] = [Vec3::ZERO; 3];
    let [distance, bound, pdf, pmf, factor] = [zero; 5];
    LightsSample { which, direction, distance, point, bound, normal, pdf, pmf, factor, delta: false }
}

/// A part of a light and its index, if there is one.
#[inline(always)]
fn part_of<R: Real<Scalar = R>>(lights: &Lights<R>, which: Which) -> Option<(u32, &Part<R>)> {
    let [first, end] = lights.first.get(which.light as usize..)?.first_chunk()?;
    let index = first.saturating_add(which.part);
    lights.parts.get(index as usize).filter(|_| index < *end).map(|part| (index, part))
}

#[inline(always)]
fn emit<R: Real<Scalar = R>>(lights: &Lights<R>, which: Which, u: [R; 4], scene: Sphere<R>) -> Emission<R> {
    let Some((_, part)) = part_of(lights, which) else {
        let ([origin, direction, normal], zero) = ([Vec3::ZERO; 3], R::lit(0.0));
        return Emission { origin, direction, normal, pdf: zero, weight: zero };
    };
    let face = match (part.two_sided, part.reversed) {
        (true, _) => Face::Both,
        (_, true) => Face::Back,
        _ => Face::Front,
    };
    emission::emit(&part.shape, face, u, scene)
}

#[inline(always)]
fn pdf<R: Real<Scalar = R>>(at: &LightsAt<'_, R>, which: Which, w: Vec3<R>) -> R {
    let Some((index, part)) = part_of(at.lights, which) else { return R::lit(0.0) };
    if matches!(part.shape, Shape::Line(_) | Shape::Point(_) | Shape::Spot(_) | Shape::Directional(_)) {
        return R::lit(0.0);
    }
    let (pdf, is_on) = at.with(index, part, |light| light.pdf(&part.shape, w));
    // most directions of other techniques miss the light; of one whose length overflows there is none
    let zero = R::lit(0.0);
    if is_on || !(pdf.gt(zero) & pdf.lt(R::lit(f64::INFINITY))).any() { zero } else { at.pmf(index) * pdf }
}

#[cfg(test)]
mod tests {
    use super::{LightsAt, Part};

    /// What the documentation of [`Lights`](super::Lights) says.
    #[test]
    fn sizes_are_as_stated() {
        let sizes = [size_of::<Part<f32>>(), size_of::<Part<f64>>(), size_of::<LightsAt<'_, f32>>()];
        assert_eq!(sizes, [104, 184, 2152]);
    }
}
