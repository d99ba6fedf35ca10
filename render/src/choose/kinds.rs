//! Kinds of lights are chosen by the irradiance that each can cause at the point: lamps, which are somewhere, beams, which are spot lights too
//! narrow for a tree, suns, and the sky. Then a lamp or a sun is chosen by a tree.

use super::choose_light::{ChooseLight, bounds};
use crate::allocation::FEW;
use crate::bvh::BuildError;
use crate::light_tree::{OwnedTree, Threads};
use crate::lights::{Candidate, Far};
use crate::packet::{V8, X8, equal, pick, select};
use crate::sky::Sky;
use etendue::select::{Choice, Gloss, LightBound, LightChoice, LightsAt, TreeAt};
use etendue::{LightSampler, Mask, Real, SpotLight, Vec2, u32x8};
use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

/// Tables of any number of lights.
#[derive(Debug, Default)]
pub(super) struct Kinds {
    /// The lights that are somewhere; those that are infinitely far away have no power in it.
    lamps: OwnedTree,
    /// Their indices among all lights, if they are few; else empty.
    few: Vec<u32>,
    beams: Vec<Beam>,
    /// The distant lights, as points of the unit sphere around the shading point.
    suns: OwnedTree,
    /// The indices of the distant lights among all.
    distant: Vec<u32>,
    /// The sky, its index among all lights, and by what to multiply its irradiance, so that it is in the unit of the others.
    sky: Option<(Arc<Sky>, u32, f32)>,
}

/// A spot light of which a tree cannot tell which points it lights.
#[derive(Debug)]
struct Beam {
    /// Its index among all lights.
    index: u32,
    light: SpotLight<f32>,
    /// The sum of the channels of its intensity, in the unit of the others.
    intensity: f32,
}

impl Beam {
    /// The irradiance at points of surfaces.
    #[inline]
    fn irradiance(&self, p: V8, normal: V8) -> X8 {
        let sample = SpotLight::splat(self.light).by_delta(p).sample(Vec2::default());
        let (zero, some) = (X8::lit(0.0), sample.pdf.gt(X8::lit(0.0)));
        // of a light without an area, the pdf is the squared distance over the falloff
        let cos = sample.direction.dot(normal).greater(zero);
        (cos * X8::splat(self.intensity) / select(some, sample.pdf, X8::lit(1.0))).keep(some)
    }
}

/// The part of the chance of lamps that is the same for all of them, if they are few. It is no fraction of a power of two: where one lamp
/// gives all the light, the numbers of samples of stratified sets would be the same in nearly all sets, and their variance would not tell
/// the error of the rare ones.
const EQUAL: f64 = 0.225;
/// Up to so many lamps are few: with more, so small a part of each would rarely find one, and all of it would be lost to the tree's choice.
const MOST_EQUAL: usize = 64;

// kinds of lights
const LAMPS: u32 = 0;
const SUNS: u32 = 1;
const SKIES: u32 = 2;
const BEAMS: u32 = 3;

impl Kinds {
    /// Builds the tables of lights and their powers.
    ///
    /// # Errors
    /// Fails if there are more lights than a tree can index.
    pub(super) fn new(all: &[Candidate], sky: Option<&Arc<Sky>>) -> Result<Self, BuildError> {
        let greatest = all.iter().fold(f64::MIN_POSITIVE, |most, light| most.max(light.power));
        let (distant, suns): (Vec<u32>, Vec<_>) = (0..)
            .zip(all)
            .filter(|(_, light)| light.far == Some(Far::Sun))
            .map(|(index, light)| {
                // a sphere of less than this power would not be in the tree
                let power = (light.power / greatest).max(f64::from(f32::MIN_POSITIVE)) as f32;
                (index, LightBound { center: light.direction(), power, ..LightBound::default() })
            })
            .unzip();
        let index = all.iter().position(|light| light.far == Some(Far::Sky));
        let sky = sky.zip(index).map(|(sky, index)| (Arc::clone(sky), index as u32, (FRAC_1_PI / greatest) as f32));
        let mut lamps = bounds(all);
        let beam = |(index, light): (u32, &Candidate)| {
            let (light, intensity) = light.beam()?;
            Some(Beam { index, light, intensity: (intensity / greatest) as f32 })
        };
        let mut beams: Vec<Beam> = (0..).zip(all).filter_map(beam).take(FEW + 1).collect();
        if beams.len() > FEW {
            beams.clear();
        }
        beams.iter().for_each(|beam| lamps[beam.index as usize].power = 0.0);
        let is_beam = |index: &u32| beams.binary_search_by_key(index, |beam| beam.index).is_ok();
        let somewhere = (0..).zip(all).filter(|(_, light)| light.far.is_none()).map(|(index, _)| index);
        let somewhere = somewhere.filter(|index| !is_beam(index));
        let mut few: Vec<u32> = somewhere.take(MOST_EQUAL + 1).collect();
        if !(2..=MOST_EQUAL).contains(&few.len()) {
            few.clear();
        }
        let [lamps, suns] = [lamps, suns].map(|bounds| OwnedTree::new(&bounds, &Threads));
        Ok(Self { lamps: lamps?, few, beams, suns: suns?, distant, sky })
    }
    /// The choice among beams, and the irradiance from all of them. Not inlined, so that it does not burden scenes without beams.
    #[inline(never)]
    fn beams_at(&self, p: V8, normal: V8) -> (LightsAt<X8>, X8) {
        let mut irradiances = [X8::lit(0.0); FEW];
        let mut sum = X8::lit(0.0);
        for (irradiance, beam) in irradiances.iter_mut().zip(&self.beams) {
            *irradiance = beam.irradiance(p, normal);
            sum += *irradiance;
        }
        (LightsAt::by_weights(&irradiances[..self.beams.len()]), sum)
    }
}

impl ChooseLight for Kinds {
    type At<'a> = KindsAt<'a>;
    #[inline]
    fn at(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>) -> KindsAt<'_> {
        let [lamps, suns] = [(&self.lamps, p), (&self.suns, V8::default())].map(|(tree, p)| tree.at(p, normal, gloss));
        let beams = (!self.beams.is_empty()).then(|| self.beams_at(p, normal));
        let is_far = self.sky.is_some() || !self.distant.is_empty();
        let kinds = (is_far || beams.is_some()).then(|| {
            let of_sky = self.sky.as_ref().map_or(X8::lit(0.0), |(sky, _, unit)| {
                let factor = gloss.map_or(X8::lit(1.0), Gloss::albedo);
                sky.irradiance(p, normal) * (factor * X8::splat(*unit))
            });
            let of_beams = beams.as_ref().map_or(X8::lit(0.0), |(_, irradiance)| *irradiance);
            among_kinds([self.lamps.irradiance(&lamps), self.suns.irradiance(&suns), of_sky, of_beams])
        });
        KindsAt { lights: self, lamps, suns, beams: beams.map(|(choice, _)| choice), kinds }
    }
    #[inline]
    fn choose(at: &KindsAt<'_>, [u, second]: [X8; 2]) -> Choice<X8> {
        at.choose(u, second)
    }
    #[inline]
    fn pmf(at: &KindsAt<'_>, light: u32) -> X8 {
        at.pmf(light)
    }
}

/// The choice among kinds of lights that can cause these irradiances. A part of the chance is the same for all kinds that can contribute,
/// since one of them may be hidden; the rest is in proportion to them. That part is 1/(2n − 1) for each of n kinds: a kind that gives all of
/// the light, without noise of its own, then has at most twice the variance that it would have with a chance of 1/n.
#[inline]
fn among_kinds(irradiances: [X8; 4]) -> LightsAt<X8> {
    let (zero, one, least) = (X8::lit(0.0), X8::lit(1.0), X8::splat(f32::MIN_POSITIVE));
    let irradiances = irradiances.map(|e| e.greater(least).lesser(X8::lit(1e37)).keep(e.gt(zero)));
    let [a, b, c, d] = irradiances;
    let sum = (a + b + c + d).greater(least);
    let count = irradiances.iter().fold(zero, |count, e| count + one.keep(e.gt(zero)));
    let part = one / (count + count - one);
    LightsAt::by_weights(&irradiances.map(|e| (e / sum * (one - part * count) + part).keep(e.gt(zero))))
}

/// The choice for the points of a packet.
pub struct KindsAt<'a> {
    lights: &'a Kinds,
    lamps: TreeAt<'a, X8>,
    suns: TreeAt<'a, X8>,
    /// Among the beams, if there are any.
    beams: Option<LightsAt<X8>>,
    /// Among the kinds, if there are others than lamps.
    kinds: Option<LightsAt<X8>>,
}

impl KindsAt<'_> {
    /// Chooses by `u`, whose strata are kept, and by the digits of `second`.
    #[inline]
    fn choose(&self, u: X8, second: X8) -> Choice<X8> {
        let Some(kinds) = &self.kinds else { return self.lamp(u, second) };
        let first = kinds.choose(u);
        // the sky needs no more choice
        let mut choice = Choice { index: u32x8::splat(0), ..first };
        if let Some((_, index, _)) = &self.lights.sky {
            choice.index = u32x8::splat(*index);
        }
        for kind in [LAMPS, SUNS, BEAMS] {
            let here = equal(first.index, u32x8::splat(kind)) & first.pmf.gt(X8::lit(0.0));
            if here.any() {
                let own = match kind {
                    LAMPS => self.lamp(first.u, second),
                    SUNS => self.distant_light(first.u, second),
                    _ => self.beam(first.u),
                };
                choice.index = pick(here, own.index, choice.index);
                choice.pmf = select(here, first.pmf * own.pmf, choice.pmf);
                choice.u = select(here, own.u, choice.u);
            }
        }
        choice
    }
    /// Chooses a distant light.
    #[inline]
    fn distant_light(&self, u: X8, second: X8) -> Choice<X8> {
        let own = OwnedTree::choose(&self.suns, [u, second]);
        // a lane without a light has the index 0, which is in the table, since there is a distant light
        Choice { index: u32x8::new(own.index.to_array().map(|k| self.lights.distant[k as usize])), ..own }
    }
    /// Chooses a beam.
    #[inline]
    fn beam(&self, u: X8) -> Choice<X8> {
        let own = self.beams.as_ref().unwrap_or_else(|| unreachable!("there are beams")).choose(u);
        Choice { index: u32x8::new(own.index.to_array().map(|k| self.lights.beams[k as usize].index)), ..own }
    }
    /// Chooses a lamp. If there are few, each has the same chance in a part of the choices, so that a much brighter lamp that is hidden does
    /// not take the samples of the others.
    #[inline]
    fn lamp(&self, u: X8, second: X8) -> Choice<X8> {
        let few = &self.lights.few;
        if few.is_empty() {
            return OwnedTree::choose(&self.lamps, [u, second]);
        }
        let (part, below_one) = (X8::lit(EQUAL), X8::lit(1.0 - 1.0 / 16_777_216.0));
        let is_equal = u.lt(part);
        let stretched = select(is_equal, u * X8::lit(1.0 / EQUAL), (u - part) * X8::lit(1.0 / (1.0 - EQUAL)));
        let u = stretched.lesser(below_one);
        let mut choice = OwnedTree::choose(&self.lamps, [u, second]);
        let place = u * X8::lit(few.len() as f64);
        let k = place.to_uint();
        let index = u32x8::new(k.to_array().map(|k| few[(k as usize).min(few.len() - 1)]));
        choice.index = pick(is_equal, index, choice.index);
        choice.u = select(is_equal, (place - X8::from_uint(k)).lesser(below_one), choice.u);
        // where the tree has found none, there is none
        let none = !is_equal & choice.pmf.le(X8::lit(0.0));
        choice.pmf = self.shared(LightChoice::pmf(&self.lamps, choice.index)).keep(!none);
        choice
    }
    /// The pmf of a lamp that has this one in the tree.
    #[inline]
    fn shared(&self, of_tree: X8) -> X8 {
        match self.lights.few.len() {
            0 => of_tree,
            count => {
                let (part, rest) = (X8::lit(EQUAL / count as f64), X8::lit(1.0 - EQUAL));
                of_tree.mul_add(rest, part).keep(of_tree.gt(X8::lit(0.0)))
            }
        }
    }
    /// The pmf of a light.
    #[inline]
    fn pmf(&self, light: u32) -> X8 {
        let of_lamp = || self.shared(self.lamps.pmf_of(light));
        let Some(kinds) = &self.kinds else { return of_lamp() };
        if self.lights.sky.as_ref().is_some_and(|(_, index, _)| *index == light) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::{point, spot, sun};
    use etendue::Uint;
    use etendue::sequence::{Independent, Sequence};
    use etendue_oracle::tier::cases;

    fn of_power(mut light: Candidate, power: f64) -> Candidate {
        light.power = power;
        light
    }
    fn lamp(place: [f32; 3], power: f64) -> Candidate {
        of_power(point::candidate(place, [1.0; 3]), power)
    }
    fn sun(direction: [f32; 3], power: f64) -> Candidate {
        of_power(sun::candidate(direction, [1.0; 3]), power)
    }

    /// With and without distant lights: the pmf sums to 1, a choice has the pmf of its light, and lights are chosen as often as their
    /// pmf says, also the weakest together.
    #[test]
    fn lights_of_any_power_are_chosen() {
        for (count, far) in [(2_usize, 1_usize), (2, 2), (7, 0), (7, 3), (4000, 0), (4000, 2)] {
            let powers: Vec<f64> = (0..count).map(|i| [1.0, 1e-3, 1e-9, 0.0, 50.0][i * 7 % 5]).collect();
            let place = |i: usize| [(i * 37 % 101) as f32, (i * 61 % 113) as f32, 3.0 + (i % 7) as f32];
            let all: Vec<Candidate> = (0..count)
                .map(|i| match i < count - far {
                    true => lamp(place(i), powers[i]),
                    false => sun([0.6, 0.0, 0.8], powers[i]),
                })
                .collect();
            let lights = Kinds::new(&all, None).unwrap();
            let at = lights.at(V8::lit([50.0, 50.0, 0.0]), V8::lit([0.0, 0.0, 1.0]), None);
            let pmf: Vec<f64> = (0..count as u32).map(|i| f64::from(at.pmf(i).as_array()[0])).collect();
            assert!((pmf.iter().sum::<f64>() - 1.0).abs() < 1e-5, "{count}: {}", pmf.iter().sum::<f64>());
            assert!(pmf.iter().all(|pmf| *pmf > 0.0));
            let (mut weak, draws) = (0.0, cases(1_u32 << 14, 1 << 18));
            for i in (0..draws).step_by(8) {
                let lanes = u32x8::from_fn(|k| i + k as u32);
                let u: Vec2<X8> = Independent::new(5).pair(u32x8::splat(0), lanes, 0);
                let choice = at.choose(u.x, u.y);
                for lane in 0..8 {
                    let light = choice.index.lane(lane);
                    assert_eq!(choice.pmf.lane(lane), at.pmf(light).lane(lane), "light {light} of {count}");
                    weak += f64::from(u8::from(powers[light as usize] < 0.5));
                }
            }
            let expected: f64 = powers.iter().zip(&pmf).filter(|(power, _)| **power < 0.5).map(|(_, pmf)| pmf).sum();
            let deviation = (expected * (1.0 - expected) / f64::from(draws)).sqrt();
            assert!(
                (weak / f64::from(draws) - expected).abs() <= 5.0 * deviation + 1e-9,
                "{count}: {weak} of {draws}, {expected}"
            );
        }
    }

    /// A lamp and a sun each get at least a third of the samples where they can contribute, two thirds where they are much brighter than the
    /// other, and none below the horizon, whatever their powers are.
    #[test]
    fn lamps_and_suns_share_by_what_they_can_contribute() {
        for [of_lamp, of_sun] in [[1.0, 1.0], [1e-9, 1.0], [1.0, 1e-9], [1e9, 1e-12]] {
            // irradiances of lamp/4 and sun/4
            let all: Vec<Candidate> = vec![lamp([0.0, 0.0, 1.0], of_lamp), sun([0.0, 0.0, 1.0], of_sun)];
            let lights = Kinds::new(&all, None).unwrap();
            let pmf = |normal: [f64; 3]| {
                let at = lights.at(V8::default(), V8::lit(normal), None);
                [0, 1].map(|light| f64::from(at.pmf(light).as_array()[0]))
            };
            let expected = (1.0 + of_lamp / (of_lamp + of_sun)) / 3.0;
            let [of_lamp, of_sun] = pmf([0.0, 0.0, 1.0]);
            assert!((of_lamp - expected).abs() < 0.03 && (of_lamp + of_sun - 1.0).abs() < 1e-6, "{of_lamp} {expected}");
            assert_eq!(pmf([0.0, 0.0, -1.0]), [0.0; 2]);
        }
        // a sun below the horizon takes nothing from a lamp above it
        let all: Vec<Candidate> = vec![lamp([0.0, 0.0, 1.0], 1e-9), sun([0.0, 0.0, -1.0], 1.0)];
        let lights = Kinds::new(&all, None).unwrap();
        let at = lights.at(V8::default(), V8::lit([0.0, 0.0, 1.0]), None);
        assert_eq!([0, 1].map(|light| at.pmf(light).as_array()[0]), [1.0, 0.0]);
    }

    /// A dim lamp keeps its equal part of the samples, however bright a second lamp is, since that one may be hidden.
    #[test]
    fn dim_lamps_beside_a_bright_one_are_not_lost() {
        let all: Vec<Candidate> = vec![lamp([0.0, 0.0, 1.0], 1e12), lamp([30.0, 0.0, 1.0], 1.0)];
        let lights = Kinds::new(&all, None).unwrap();
        let at = lights.at(V8::default(), V8::lit([0.0, 0.0, 1.0]), None);
        let [bright, dim] = [0, 1].map(|light| f64::from(at.pmf(light).as_array()[0]));
        assert!((dim - 0.5 * EQUAL).abs() < 1e-4 && (bright + dim - 1.0).abs() < 1e-6, "{bright} {dim}");
    }

    /// A spot light of a hundredth of a degree takes no samples of a lamp of the same power at a point beside its cone, although a tree cannot
    /// tell that point from the axis; within its cone it has most of them, however many lamps there are.
    #[test]
    fn beams_are_chosen_where_they_are_seen() {
        let versine = 1.5e-8_f32;
        for count in [1, 3000] {
            let mut all: Vec<Candidate> = (0..count).map(|i| lamp([1.0 + i as f32, 0.0, 2.0], 1.0)).collect();
            let intensity = [1.0 / versine; 3];
            all.insert(1, spot::candidate([0.0, 0.0, 2.0], [0.0, 0.0, -1.0], [versine; 2], intensity));
            let lights = Kinds::new(&all, None).unwrap();
            let (x, mut pmfs) = (X8::new(std::array::from_fn(|lane| if lane == 0 { 0.0 } else { 0.1 })), [0.0; 2]);
            let at = lights.at(V8::new(x, X8::default(), X8::default()), V8::lit([0.0, 0.0, 1.0]), None);
            for light in 0..=count as u32 {
                let pmf = at.pmf(light);
                pmfs[0] += f64::from(pmf.lane(0));
                pmfs[1] += f64::from(pmf.lane(1));
            }
            assert!(pmfs.iter().all(|sum| (sum - 1.0).abs() < 1e-4), "{pmfs:?}");
            let own = at.pmf(1);
            assert!(own.lane(0) > 0.6 && own.lane(1) == 0.0, "{own:?}");
            let choice = at.choose(X8::lit(0.5), X8::lit(0.3));
            assert_eq!((choice.index.lane(0), choice.pmf.lane(0)), (1, own.lane(0)));
            assert_ne!(choice.index.lane(1), 1);
        }
    }

    /// A point that no light can reach gets no light, and an index that is valid all the same.
    #[test]
    fn below_all_lights_there_is_none() {
        let all: Vec<Candidate> = (0..3).map(|i| lamp([i as f32, 0.0, 1.0], 1.0)).collect();
        let lights = Kinds::new(&all, None).unwrap();
        let choice = lights.at(V8::default(), V8::lit([0.0, 0.0, -1.0]), None).choose(X8::lit(0.3), X8::lit(0.6));
        assert_eq!((choice.pmf, choice.index), (X8::lit(0.0), u32x8::splat(0)));
    }
}
