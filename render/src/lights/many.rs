//! Choice among many lights: by a tree of those that are somewhere, and by power among those that are infinitely far away.

use super::tree::{OwnedTree, Threads};
use crate::bvh::BuildError;
use crate::packet::{V8, X8, equal, pick, select};
use etendue::select::{Choice, Gloss, LightBound, LightChoice, PowerLights, TreeAt};
use etendue::{Real, u32x8};

/// Tables of any number of lights.
#[derive(Debug, Default)]
pub(super) struct ManyLights {
    tree: OwnedTree,
    /// Sums of powers: of all lights in the tree, then of each light that is infinitely far away. Empty if there is none.
    sums: Vec<f32>,
    /// The lights that are infinitely far away.
    distant: Vec<u32>,
}

impl ManyLights {
    /// Builds the tables from a bound and the power of each light. A light that is infinitely far away has a bound without power.
    ///
    /// # Errors
    /// Fails if there are more lights than a tree can index.
    pub(super) fn new(
        bounds: &[LightBound],
        powers: &[f64],
        is_distant: impl Fn(usize) -> bool,
    ) -> Result<Self, BuildError> {
        let count = bounds.len();
        let distant: Vec<u32> = (0..count as u32).filter(|&light| is_distant(light as usize)).collect();
        let mut sums = Vec::new();
        if !distant.is_empty() {
            let far = distant.iter().map(|&light| powers[light as usize]);
            let near: f64 = powers.iter().sum::<f64>() - far.clone().sum::<f64>();
            let all: Vec<f64> = std::iter::once(near.max(0.0)).chain(far).collect();
            let greatest = all.iter().fold(f64::MIN_POSITIVE, |m, &p| m.max(p));
            let all: Vec<f32> = all.iter().map(|p| (p / greatest) as f32).collect();
            sums = vec![0.0; all.len()];
            PowerLights::new(&all, &mut sums)
                .map_err(|_| BuildError { count: distant.len(), most: PowerLights::MOST - 1 })?;
        }
        Ok(Self { tree: OwnedTree::new(bounds, &Threads)?, sums, distant })
    }
    /// The choice for points of surfaces.
    #[inline]
    pub(super) fn at(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>) -> ManyAt<'_> {
        let tree = self.tree.get();
        let tree = gloss.map_or_else(|| tree.at(p, normal), |gloss| tree.at_glossy(p, normal, gloss));
        ManyAt { lights: self, tree }
    }
}

/// The choice for the points of a packet.
pub struct ManyAt<'a> {
    lights: &'a ManyLights,
    tree: TreeAt<'a, X8>,
}

impl ManyAt<'_> {
    /// Chooses by `u`, whose strata are kept, and by the digits of `second`.
    #[inline]
    pub(super) fn choose(&self, u: X8, second: X8) -> Choice<X8> {
        let ManyLights { sums, distant, .. } = self.lights;
        if distant.is_empty() {
            return self.near(u, second);
        }
        let first: Choice<X8> = PowerLights::from_buffer(sums).choose(u);
        let is_near = equal(first.index, u32x8::splat(0));
        let near = self.near(first.u, second);
        let far = u32x8::new(first.index.to_array().map(|k| distant[k.saturating_sub(1) as usize]));
        Choice {
            index: pick(is_near, near.index, far),
            pmf: first.pmf * select(is_near, near.pmf, X8::lit(1.0)),
            u: select(is_near, near.u, first.u),
        }
    }
    /// Chooses in the tree.
    #[inline]
    fn near(&self, u: X8, second: X8) -> Choice<X8> {
        let [high, low] = [u, second].map(|u| (u * X8::lit(16_777_216.0)).to_uint());
        // where there is no second number, the digits below are a hash of the first
        let low = (low ^ (high * u32x8::splat(0x9e37_79b9))) * u32x8::splat(0x85eb_ca6b);
        let choice = self.tree.choose_by([high << 8 | low >> 24, low]);
        // a lane without a light has the pmf 0, but its index must be one
        Choice { index: pick(choice.pmf.gt(X8::lit(0.0)), choice.index, u32x8::splat(0)), ..choice }
    }
    /// The pmf of a light.
    #[inline]
    pub(super) fn pmf(&self, light: u32) -> X8 {
        let sums = PowerLights::from_buffer(&self.lights.sums);
        match self.lights.distant.binary_search(&light) {
            Ok(k) => LightChoice::<X8>::pmf_of(&sums, k as u32 + 1),
            Err(_) if self.lights.distant.is_empty() => self.tree.pmf_of(light),
            Err(_) => LightChoice::<X8>::pmf_of(&sums, 0) * self.tree.pmf_of(light),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue::sequence::{Independent, Sequence};
    use etendue::{Uint, Vec2};
    use etendue_oracle::tier::cases;

    /// With and without lights at infinity: the pmf sums to 1, a choice has the pmf of its light, and lights are chosen as often as their
    /// pmf says, also the weakest together.
    #[test]
    fn lights_of_any_power_are_chosen() {
        for (count, far) in [(2_usize, 1_usize), (2, 2), (7, 0), (7, 3), (4000, 0), (4000, 2)] {
            let powers: Vec<f64> = (0..count).map(|i| [1.0, 1e-3, 1e-9, 0.0, 50.0][i * 7 % 5]).collect();
            let is_distant = |i: usize| i >= count - far;
            let bound = |i: usize| LightBound {
                center: [(i * 37 % 101) as f32, (i * 61 % 113) as f32, 3.0 + (i % 7) as f32],
                radius: 0.25,
                power: if is_distant(i) { 0.0 } else { powers[i] as f32 },
                ..LightBound::default()
            };
            let bounds: Vec<_> = (0..count).map(bound).collect();
            let lights = ManyLights::new(&bounds, &powers, is_distant).unwrap();
            let at = lights.at(V8::lit([50.0, 50.0, 0.0]), V8::lit([0.0, 0.0, 1.0]), None);
            let pmf: Vec<f64> = (0..count as u32).map(|i| f64::from(at.pmf(i).as_array()[0])).collect();
            assert!((pmf.iter().sum::<f64>() - 1.0).abs() < 1e-5, "{count}: {}", pmf.iter().sum::<f64>());
            assert!(powers.iter().zip(&pmf).all(|(power, pmf)| (*power > 0.0) == (*pmf > 0.0)));
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

    /// A point that no light can reach gets no light, and an index that is valid all the same.
    #[test]
    fn below_all_lights_there_is_none() {
        let bound = |i: usize| LightBound { center: [i as f32, 0.0, 1.0], power: 1.0, ..LightBound::default() };
        let lights = ManyLights::new(&[0, 1, 2].map(bound), &[1.0; 3], |_| false).unwrap();
        let choice = lights.at(V8::default(), V8::lit([0.0, 0.0, -1.0]), None).choose(X8::lit(0.3), X8::lit(0.6));
        assert_eq!((choice.pmf, choice.index), (X8::lit(0.0), u32x8::splat(0)));
    }
}
