//! The choice among lights of all kinds: those that have a place, and those that are infinitely far away.

use crate::light::{LightSampler, SpotLight};
use crate::owned::OwnedTree;
use crate::real::{Mask, Real, Uint};
use crate::select::{Choice, Gloss, Join, LightBound, LightChoice, LightsAt, LightsError, SpatialLights, TreeAt};
use crate::vector::{Vec2, Vec3};
use alloc::vec::Vec;

/// What a light of a [`Mixture`] is.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// A light that has a place, and is chosen by its bound.
    Lamp,
    /// A spot light of which a tree cannot tell which points it lights, with its intensity. It is chosen by what it sends to the point,
    /// unless there are more than 32.
    Beam(SpotLight<f64>, f32),
    /// A light infinitely far away, as a light on the unit sphere around the point: the vector towards it, the distance from its end to the
    /// farthest one, and the power of a point light there that causes its irradiance, which is 4π times that.
    Sun([f32; 3], f32, f32),
    /// A sky, of which there is at most one; its irradiance is given with the point.
    Sky,
}

/// Chooses among any number of lights of all kinds by what each can contribute to a point: first among lamps, suns, sky and narrow spot lights by
/// the irradiance of each kind, then one of them by a [`LightTree`](crate::select::LightTree).
///
/// - Formula: a kind of irradiance E has the probability (1 − n/(2n − 1)) E/ΣE + 1/(2n − 1), for n kinds that can contribute. Of 2 to 64 lamps,
///   each has 0.225/count besides 0.775 times its pmf in the tree, where that is positive.
/// - Why: one of the kinds, and one of the lamps, may be hidden. A kind that gives all of the light, without noise of its own, has at most
///   twice the variance that it would have with a chance of 1/n; and a bright lamp behind a wall does not take all samples of the others.
/// - Domain: as for the tree. Powers of lights are fluxes relative to the strongest, at most 1, and irradiances in the unit of those.
/// - Exact: the pmf of a choice has the bits of [`MixtureAt::pmf`]. Every light that can contribute has a positive one.
/// - Degenerate: where no light can contribute, the pmf is 0, and the index is that of some light.
#[derive(Clone, Debug)]
pub struct Mixture {
    /// The lights that are somewhere; those that are infinitely far away have no power in it.
    lamps: OwnedTree,
    /// Their indices among all lights, if they are few; else empty.
    few: Vec<u32>,
    beams: Vec<Beam>,
    /// The distant lights, as points of the unit sphere around the shading point.
    suns: OwnedTree,
    /// The indices of the distant lights among all.
    distant: Vec<u32>,
    /// The index of the sky.
    sky: Option<u32>,
}

/// A spot light of which a tree cannot tell which points it lights.
#[derive(Clone, Copy, Debug)]
struct Beam {
    /// Its index among all lights.
    index: u32,
    light: SpotLight<f64>,
    intensity: f32,
}

impl Beam {
    /// The irradiance at points of surfaces; where there is no normal, on surfaces that face the light.
    #[inline]
    fn irradiance<R: Real>(&self, p: Vec3<R>, normal: Vec3<R>) -> R {
        let sample = self.light.map(R::lit).by_delta(p).sample(Vec2::default());
        let (zero, one, some) = (R::lit(0.0), R::lit(1.0), sample.pdf.gt(R::lit(0.0)));
        // of a light without an area, the pdf is the squared distance over the falloff
        let cos = sample.direction.dot(normal).greater(zero) + one.keep(normal.max_abs().le(zero));
        (cos * R::lit(f64::from(self.intensity)) / R::blend(some, sample.pdf, one)).keep(some)
    }
}

/// The part of the chance of lamps that is the same for all of them, if they are few. It is no fraction of a power of two: where one lamp
/// gives all the light, the numbers of samples of stratified sets would be the same in nearly all sets, and their variance would not tell
/// the error of the rare ones.
const EQUAL: f64 = 0.225;
/// Up to so many lamps are few: with more, so small a part of each would rarely find one, and all of it would be lost to the tree's choice.
const MOST_EQUAL: usize = 64;

/// The greatest number of beams.
const FEW: usize = SpatialLights::MOST;
// kinds of lights
const LAMPS: u32 = 0;
const SUNS: u32 = 1;
const SKIES: u32 = 2;
const BEAMS: u32 = 3;

/// Where the words are the same.
#[inline(always)]
fn equal<R: Real>(a: R::Uint, b: R::Uint) -> R::Mask {
    !R::has_bits(a ^ b)
}

impl Mixture {
    /// Builds the tables of lights from their bounds, of which those of suns and skies are not used, on the threads of `join`; `()` is one
    /// thread.
    ///
    /// # Errors
    /// If there are more lights than a tree takes.
    pub fn new(
        mut bounds: Vec<LightBound>,
        sources: impl IntoIterator<Item = Source>,
        join: &impl Join,
    ) -> Result<Self, LightsError> {
        let (mut few, mut beams, mut distant, mut suns, mut sky) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new(), None);
        for (index, source) in (0..).zip(sources) {
            match source {
                Source::Lamp => few.push(index),
                Source::Beam(light, intensity) => beams.push(Beam { index, light, intensity }),
                Source::Sun(center, radius, power) => {
                    distant.push(index);
                    suns.push(LightBound { center, radius, power, ..LightBound::default() });
                }
                Source::Sky => sky = Some(index),
            }
        }
        let mut dark = |index: u32| bounds.get_mut(index as usize).into_iter().for_each(|bound| bound.power = 0.0);
        if beams.len() > FEW {
            few.extend(beams.drain(..).map(|beam| beam.index));
            few.sort_unstable();
        }
        distant.iter().copied().chain(sky).chain(beams.iter().map(|beam| beam.index)).for_each(&mut dark);
        if !(2..=MOST_EQUAL).contains(&few.len()) {
            few.clear();
        }
        Ok(Self { lamps: OwnedTree::new(&bounds, join)?, few, beams, suns: OwnedTree::new(&suns, join)?, distant, sky })
    }
    /// Whether all lights are lamps, so that a choice among kinds needs no preparation.
    pub(super) fn has_lamps_alone(&self) -> bool {
        self.sky.is_none() && self.distant.is_empty() && self.beams.is_empty()
    }
    /// The choice for points `p` of surfaces with unit normals, on the side of the normal; or for points that light reaches from all around,
    /// where the normal is 0. `gloss` is what glossy surfaces reflect, and `sky` returns the irradiance of the sky there.
    #[inline]
    pub fn at<R: Real>(
        &self,
        p: Vec3<R>,
        normal: Vec3<R>,
        gloss: Option<&Gloss<R>>,
        sky: impl FnOnce() -> R,
    ) -> MixtureAt<'_, R> {
        let [lamps, suns] = [(&self.lamps, p), (&self.suns, Vec3::ZERO)].map(|(tree, p)| {
            let tree = tree.get();
            gloss.map_or_else(|| tree.at(p, normal), |gloss| tree.at_glossy(p, normal, gloss))
        });
        let beams = (!self.beams.is_empty()).then(|| self.beams_at(p, normal));
        let kinds = (!self.has_lamps_alone()).then(|| {
            let of_sky = self.sky.map_or(R::lit(0.0), |_| sky());
            let of_beams = beams.as_ref().map_or(R::lit(0.0), |(_, irradiance)| *irradiance);
            among_kinds([self.lamps.irradiance(&lamps), self.suns.irradiance(&suns), of_sky, of_beams])
        });
        MixtureAt { lights: self, lamps, suns, beams: beams.map(|(choice, _)| choice), kinds }
    }
    /// The choice of lamps alone, at points as [`at`](Self::at).
    #[inline(always)]
    pub(super) fn lamps_at<R: Real>(&self, p: Vec3<R>, normal: Vec3<R>) -> TreeAt<'_, R> {
        self.lamps.get().at(p, normal)
    }
    /// Chooses a lamp. If there are few, each has the same chance in a part of the choices, so that a much brighter lamp that is hidden does
    /// not take the samples of the others.
    #[inline]
    pub(super) fn choose_lamp<R: Real>(&self, lamps: &TreeAt<'_, R>, u: R, second: R) -> Choice<R> {
        let few = &self.few;
        if few.is_empty() {
            return lamps.choose_with(u, second);
        }
        let (part, below_one) = (R::lit(EQUAL), R::ONE_MINUS_EPSILON);
        let is_equal = u.lt(part);
        let stretched = R::blend(is_equal, u * R::lit(1.0 / EQUAL), (u - part) * R::lit(1.0 / (1.0 - EQUAL)));
        let u = stretched.lesser(below_one);
        let mut choice = if is_equal.all() {
            Choice { index: R::Uint::splat(0), pmf: R::lit(0.0), u }
        } else {
            lamps.choose_with(u, second)
        };
        let place = u * R::lit(few.len() as f64);
        let k = place.to_uint();
        let index = R::Uint::from_fn(|lane| few[(k.lane(lane) as usize).min(few.len() - 1)]);
        choice.index = R::blend_uint(is_equal, index, choice.index);
        choice.u = R::blend(is_equal, (place - R::from_uint(k)).lesser(below_one), choice.u);
        // where the tree has found none, there is none
        let none = !is_equal & choice.pmf.le(R::lit(0.0));
        // the tree's choices have their pmf
        let [of_tree] = R::where_any(is_equal, [choice.pmf], || [lamps.pmf(choice.index)]);
        choice.pmf = self.shared(of_tree).keep(!none);
        choice
    }
    /// The pmf of a lamp that has this one in the tree.
    #[inline]
    pub(super) fn shared<R: Real>(&self, of_tree: R) -> R {
        match self.few.len() {
            0 => of_tree,
            count => {
                let (part, rest) = (R::lit(EQUAL / count as f64), R::lit(1.0 - EQUAL));
                of_tree.mul_add(rest, part).keep(of_tree.gt(R::lit(0.0)))
            }
        }
    }
    /// The choice among beams, and the irradiance from all of them. Not inlined, so that it does not burden scenes without beams.
    #[inline(never)]
    fn beams_at<R: Real>(&self, p: Vec3<R>, normal: Vec3<R>) -> (LightsAt<R>, R) {
        let mut irradiances = [R::lit(0.0); FEW];
        let mut sum = R::lit(0.0);
        for (irradiance, beam) in irradiances.iter_mut().zip(&self.beams) {
            *irradiance = beam.irradiance(p, normal);
            sum += *irradiance;
        }
        (LightsAt::by_weights(&irradiances[..self.beams.len()]), sum)
    }
}

/// The choice among kinds of lights that can cause these irradiances.
#[inline]
fn among_kinds<R: Real>(irradiances: [R; 4]) -> LightsAt<R> {
    let (zero, one, least) = (R::lit(0.0), R::lit(1.0), R::lit(f64::from(f32::MIN_POSITIVE)));
    let irradiances = irradiances.map(|e| e.greater(least).lesser(R::lit(1e37)).keep(e.gt(zero)));
    let [a, b, c, d] = irradiances;
    let sum = (a + b + c + d).greater(least);
    let count = irradiances.iter().fold(zero, |count, e| count + one.keep(e.gt(zero)));
    let part = one / (count + count - one);
    LightsAt::by_weights(&irradiances.map(|e| (e / sum * (one - part * count) + part).keep(e.gt(zero))))
}

/// The choice of a [`Mixture`] at the shading point of each lane.
#[derive(Clone, Copy, Debug)]
pub struct MixtureAt<'a, R: Real> {
    lights: &'a Mixture,
    lamps: TreeAt<'a, R>,
    suns: TreeAt<'a, R>,
    /// Among the beams, if there are any.
    beams: Option<LightsAt<R>>,
    /// Among the kinds, if there are others than lamps.
    kinds: Option<LightsAt<R>>,
}

impl<R: Real> MixtureAt<'_, R> {
    /// Chooses by `u`, whose strata are kept, and by the digits of `second`, each in [0, 1).
    #[inline]
    pub fn choose(&self, u: R, second: R) -> Choice<R> {
        let Some(kinds) = &self.kinds else { return self.lights.choose_lamp(&self.lamps, u, second) };
        let first = kinds.choose(u);
        // the sky needs no more choice
        let mut choice = Choice { index: R::Uint::splat(self.lights.sky.unwrap_or(0)), ..first };
        for kind in [LAMPS, SUNS, BEAMS] {
            let here = equal::<R>(first.index, R::Uint::splat(kind)) & first.pmf.gt(R::lit(0.0));
            if here.any() {
                let own = match kind {
                    LAMPS => self.lights.choose_lamp(&self.lamps, first.u, second),
                    SUNS => self.distant_light(first.u, second),
                    _ => self.beam(first.u),
                };
                choice.index = R::blend_uint(here, own.index, choice.index);
                choice.pmf = R::blend(here, first.pmf * own.pmf, choice.pmf);
                choice.u = R::blend(here, own.u, choice.u);
            }
        }
        choice
    }
    /// Chooses a distant light.
    #[inline]
    fn distant_light(&self, u: R, second: R) -> Choice<R> {
        let own = self.suns.choose_with(u, second);
        // a lane without a light has the index 0, which is in the table, since there is a distant light
        Choice { index: R::Uint::from_fn(|lane| self.lights.distant[own.index.lane(lane) as usize]), ..own }
    }
    /// Chooses a beam.
    #[inline]
    fn beam(&self, u: R) -> Choice<R> {
        let own = self.beams.as_ref().unwrap_or_else(|| unreachable!("there are beams")).choose(u);
        Choice { index: R::Uint::from_fn(|lane| self.lights.beams[own.index.lane(lane) as usize].index), ..own }
    }
    /// The pmf of a light; 0 for an index past the last one.
    #[inline]
    pub fn pmf(&self, light: u32) -> R {
        let of_lamp = || self.lights.shared(self.lamps.pmf_of(light));
        let Some(kinds) = &self.kinds else { return of_lamp() };
        if self.lights.sky == Some(light) {
            return kinds.pmf_of(SKIES);
        }
        if let (Some(beams), Ok(k)) = (&self.beams, self.lights.beams.binary_search_by_key(&light, |beam| beam.index)) {
            return kinds.pmf_of(BEAMS) * beams.pmf_of(k as u32);
        }
        match self.lights.distant.binary_search(&light) {
            Ok(k) => kinds.pmf_of(SUNS) * self.suns.pmf_of(k as u32),
            Err(_) => kinds.pmf_of(LAMPS) * of_lamp(),
        }
    }
}
