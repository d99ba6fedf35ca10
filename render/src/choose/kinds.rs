//! Lamps, suns, sky and narrow spot lights are chosen by the irradiance that each kind can cause at the point, then one of them by a tree: the
//! core's [`Mixture`].

use super::choose_light::{ChooseLight, bounds};
use super::light_tree::{Threads, build_error};
use crate::bvh::BuildError;
use crate::lights::sky::Sky;
use crate::lights::{Far, LightRecord};
use crate::packet::{V8, X8};
use etendue::Real;
use etendue::lights::{Mixture, MixtureAt, Source};
use etendue::select::{Choice, Gloss};
use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

/// Tables of any number of lights.
#[derive(Debug)]
pub(super) struct Kinds {
    lights: Mixture,
    /// The sky, and by what to multiply its irradiance, so that it is in the unit of the others.
    sky: Option<(Arc<Sky>, f32)>,
}

impl Kinds {
    /// Builds the tables of lights and their powers.
    ///
    /// # Errors
    /// Fails if there are more lights than a tree can index.
    pub(super) fn new(all: &[LightRecord], sky: Option<&Arc<Sky>>) -> Result<Self, BuildError> {
        let greatest = all.iter().fold(f64::MIN_POSITIVE, |most, light| most.max(light.power));
        let source = |light: &LightRecord| match (light.far(), light.beam()) {
            // a light of less than this power would not be in the tree
            (Some(Far::Sun), _) => {
                let power = (light.power / greatest).max(f64::from(f32::MIN_POSITIVE)) as f32;
                Source::Sun(light.direction(), 0.0, power)
            }
            (Some(Far::Sky), _) => Source::Sky,
            (None, Some((light, intensity))) => Source::Beam(light.map(f64::from), (intensity / greatest) as f32),
            (None, None) => Source::Lamp,
        };
        let lights = Mixture::new(bounds(all), all.iter().map(source), &Threads).map_err(|_| build_error(all.len()))?;
        Ok(Self { lights, sky: sky.map(|sky| (Arc::clone(sky), (FRAC_1_PI / greatest) as f32)) })
    }
}

impl ChooseLight for Kinds {
    type At<'a> = MixtureAt<'a, X8>;
    #[inline]
    fn at(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>) -> MixtureAt<'_, X8> {
        self.lights.at(p, normal, gloss, || {
            let Some((sky, unit)) = &self.sky else { return X8::lit(0.0) };
            let factor = gloss.map_or(X8::lit(1.0), Gloss::albedo);
            sky.irradiance(p, normal) * (factor * X8::splat(*unit))
        })
    }
    #[inline]
    fn choose(at: &MixtureAt<'_, X8>, [u, second]: [X8; 2]) -> Choice<X8> {
        at.choose(u, second)
    }
    #[inline]
    fn pmf(at: &MixtureAt<'_, X8>, light: u32) -> X8 {
        at.pmf(light)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::{point, spot, sun};
    use etendue::sequence::{Independent, Sequence};
    use etendue::{Uint, Vec2, u32x8};
    use etendue_oracle::tier::cases;

    fn of_power(mut light: LightRecord, power: f64) -> LightRecord {
        light.power = power;
        light
    }
    fn lamp(place: [f32; 3], power: f64) -> LightRecord {
        of_power(point::record(place, [1.0; 3]), power)
    }
    fn sun(direction: [f32; 3], power: f64) -> LightRecord {
        of_power(sun::record(direction, [1.0; 3]), power)
    }

    /// With and without distant lights: the pmf sums to 1, a choice has the pmf of its light, and lights are chosen as often as their
    /// pmf says, also the weakest together.
    #[test]
    fn lights_of_any_power_are_chosen() {
        for (count, far) in [(2_usize, 1_usize), (2, 2), (7, 0), (7, 3), (4000, 0), (4000, 2)] {
            let powers: Vec<f64> = (0..count).map(|i| [1.0, 1e-3, 1e-9, 0.0, 50.0][i * 7 % 5]).collect();
            let place = |i: usize| [(i * 37 % 101) as f32, (i * 61 % 113) as f32, 3.0 + (i % 7) as f32];
            let all: Vec<LightRecord> = (0..count)
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
            let all: Vec<LightRecord> = vec![lamp([0.0, 0.0, 1.0], of_lamp), sun([0.0, 0.0, 1.0], of_sun)];
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
        let all: Vec<LightRecord> = vec![lamp([0.0, 0.0, 1.0], 1e-9), sun([0.0, 0.0, -1.0], 1.0)];
        let lights = Kinds::new(&all, None).unwrap();
        let at = lights.at(V8::default(), V8::lit([0.0, 0.0, 1.0]), None);
        assert_eq!([0, 1].map(|light| at.pmf(light).as_array()[0]), [1.0, 0.0]);
    }

    /// A dim lamp keeps its equal part of the samples, however bright a second lamp is, since that one may be hidden.
    #[test]
    fn dim_lamps_beside_a_bright_one_are_not_lost() {
        let all: Vec<LightRecord> = vec![lamp([0.0, 0.0, 1.0], 1e12), lamp([30.0, 0.0, 1.0], 1.0)];
        let lights = Kinds::new(&all, None).unwrap();
        let at = lights.at(V8::default(), V8::lit([0.0, 0.0, 1.0]), None);
        let [bright, dim] = [0, 1].map(|light| f64::from(at.pmf(light).as_array()[0]));
        assert!((dim - 0.5 * 0.225).abs() < 1e-4 && (bright + dim - 1.0).abs() < 1e-6, "{bright} {dim}");
    }

    /// A spot light of a hundredth of a degree takes no samples of a lamp of the same power at a point beside its cone, although a tree cannot
    /// tell that point from the axis; within its cone it has most of them, however many lamps there are.
    #[test]
    fn beams_are_chosen_where_they_are_seen() {
        let versine = 1.5e-8_f32;
        for count in [1, 3000] {
            let mut all: Vec<LightRecord> = (0..count).map(|i| lamp([1.0 + i as f32, 0.0, 2.0], 1.0)).collect();
            let intensity = [1.0 / versine; 3];
            all.insert(1, spot::record([0.0, 0.0, 2.0], [0.0, 0.0, -1.0], [versine; 2], intensity));
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
        let all: Vec<LightRecord> = (0..3).map(|i| lamp([i as f32, 0.0, 1.0], 1.0)).collect();
        let lights = Kinds::new(&all, None).unwrap();
        let choice = lights.at(V8::default(), V8::lit([0.0, 0.0, -1.0]), None).choose(X8::lit(0.3), X8::lit(0.6));
        assert_eq!((choice.pmf, choice.index), (X8::lit(0.0), u32x8::splat(0)));
    }
}
