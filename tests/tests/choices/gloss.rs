//! Choices of lights in view of what glossy surfaces reflect: probabilities, and what they are worth.

use crate::reflection::ReflectingSurface;
use core::f64::consts::{PI, TAU};
use etendue::select::{Gloss, LightBound, LightChoice, SpatialLights};
use etendue::{Mask, Real, Uint, Vec3, f32x8};
use etendue_judge::generators::Random;
use etendue_judge::light_tree::{Grove, PointAndNormal, Regime, place};
use etendue_judge::packets::{lanes_of, vectors_of};
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, dot, length, narrow, sub, unit, wide};

/// A surface with a diffuse part and a rough one.
#[derive(Clone, Copy, Debug)]
struct Surface {
    p: V3,
    rough: ReflectingSurface,
    /// Albedos of the diffuse and of the rough part.
    albedos: [f64; 2],
}

impl Surface {
    fn new((p, n): PointAndNormal, random: &mut Random) -> Self {
        let rough = ReflectingSurface::on(unit(wide(n)), random);
        let albedos = [[0.0, 1.0], [1.0, 0.0], [0.3, 0.04], [1e-3, 0.9]][random.below(4)];
        Self { p: wide(p), rough, albedos }
    }
    fn gloss(&self) -> Gloss<f32> {
        let [diffuse, rough] = self.albedos.map(|x| x as f32);
        Gloss::new(diffuse, rough, &self.rough.reflection())
    }
    /// f cosθ, with the albedo of the rough part as its Fresnel factor.
    fn reflected(&self, w: V3) -> f64 {
        let [diffuse, rough] = self.albedos;
        diffuse / PI * dot(w, self.rough.normal).max(0.0) + rough * self.rough.reflected(w)
    }
}

fn vector(v: V3) -> Vec3<f32> {
    narrow(v).into()
}

/// In all regimes, the pmfs sum to at most 1, exactly the lights that have one without gloss have one with it, and a choice has the pmf of
/// its light, in every lane.
#[test]
fn gloss_loses_no_light() {
    for (seed, regime) in (0..).zip(Regime::ALL) {
        let mut random = Random::new(seed);
        for count in [1, 8, 9, 65, 300] {
            let lamps = regime.lamps(count, &mut random);
            let grove = Grove::of(&lamps);
            let tree = grove.tree();
            let few = (count <= SpatialLights::MOST).then(|| SpatialLights::new(&grove.bounds).unwrap());
            for _ in 0..cases(1, 10) {
                let surfaces: [Surface; 8] =
                    core::array::from_fn(|_| Surface::new(place(regime, &lamps, &mut random).0, &mut random));
                let gloss = surfaces.map(|surface| surface.gloss());
                let eight = Gloss::splat(gloss[0]);
                let eight = (1..8).fold(eight, |all, k| {
                    let lane = <f32x8 as Real>::Mask::from_bits(1 << k);
                    Gloss::blend(lane, Gloss::splat(gloss[k]), all)
                });
                let [p, n] = [
                    vectors_of::<f32x8>(|i| narrow(surfaces[i].p)),
                    vectors_of::<f32x8>(|i| narrow(surfaces[i].rough.normal)),
                ];
                let us: [f32; 8] = core::array::from_fn(|_| random.unit());
                let u = lanes_of::<f32x8>(|i| f64::from(us[i]));
                let by_tree = tree.at_glossy(p, n, &eight).choose(u);
                let by_few = few.as_ref().map(|few| few.at_glossy(p, n, &eight).choose(u));
                for (k, surface) in surfaces.iter().enumerate() {
                    let (p, n) = (vector(surface.p), vector(surface.rough.normal));
                    grove.glossy((narrow(surface.p), narrow(surface.rough.normal)), &gloss[k], us[k]);
                    let glossy = tree.at_glossy(p, n, &gloss[k]);
                    let sum: f64 = (0..count as u32).map(|light| f64::from(glossy.pmf(light))).sum();
                    assert!(sum < 1.0 + 1e-5, "{regime:?}: {sum}, {surface:?}");
                    let choice = glossy.choose(us[k]);
                    let lane = (by_tree.index.lane(k), by_tree.pmf.lane(k).to_bits());
                    assert_eq!(lane, (choice.index, choice.pmf.to_bits()), "lane {k}: {surface:?}");
                    let (Some(few), Some(by_few)) = (&few, &by_few) else { continue };
                    let (matt, glossy) = (few.at::<f32>(p, n), few.at_glossy(p, n, &gloss[k]));
                    let lit = |light| (matt.pmf(light) > 0.0, glossy.pmf(light) > 0.0);
                    assert!((0..count as u32).all(|light| lit(light).0 == lit(light).1), "{regime:?}: {surface:?}");
                    let choice = glossy.choose(us[k]);
                    assert_eq!(by_few.index.lane(k), choice.index, "lane {k}: {surface:?}");
                    assert_eq!(by_few.pmf.lane(k).to_bits(), choice.pmf.to_bits(), "lane {k}: {surface:?}");
                }
            }
        }
    }
}

/// Without a rough part, all bits are those without gloss.
#[test]
fn diffuse_surfaces_have_the_same_bits() {
    let mut random = Random::new(5);
    let lamps = Regime::Room.lamps(300, &mut random);
    let grove = Grove::of(&lamps);
    for _ in 0..300 {
        let (p, n) = place(Regime::Room, &lamps, &mut random).0;
        let mut surface = Surface::new((p, n), &mut random);
        surface.albedos = [1.0, 0.0];
        let (p, n, u) = (p.into(), vector(surface.rough.normal), random.unit());
        let [a, b] =
            [grove.tree().at::<f32>(p, n), grove.tree().at_glossy(p, n, &surface.gloss())].map(|at| at.choose(u));
        assert_eq!((a.index, a.pmf.to_bits(), a.u.to_bits()), (b.index, b.pmf.to_bits(), b.u.to_bits()));
    }
}

/// The variance of reflected light, without visibility, by choices with and without gloss: relative to its square.
fn variances(grove: &Grove, surface: &Surface) -> [f64; 2] {
    let (p, n) = (vector(surface.p), vector(surface.rough.normal));
    let (matt, glossy) = (grove.tree().at::<f32>(p, n), grove.tree().at_glossy(p, n, &surface.gloss()));
    let (mut sum, mut squares) = (0.0, [0.0; 2]);
    for (light, bound) in (0..).zip(&grove.bounds) {
        let to = sub(wide(bound.center), surface.p);
        let reflected = surface.reflected(unit(to)) * f64::from(bound.power) / length(to).powi(2);
        if reflected > 0.0 {
            sum += reflected;
            for (square, pmf) in squares.iter_mut().zip([matt.pmf(light), glossy.pmf(light)]) {
                *square += reflected * reflected / f64::from(pmf);
            }
        }
    }
    squares.map(|square| square / (sum * sum) - 1.0)
}

/// Lamps above a wet street and a metal floor: the variance of a choice with gloss is less than that of one without, up to some forty times.
#[test]
fn choices_are_worth_their_gloss() {
    let mut random = Random::new(9);
    let mut lamp = || {
        let [x, y] = [(); 2].map(|()| 100.0 * random.unit() - 50.0);
        let bright = random.magnitude(0.1, 10.0) as f32;
        LightBound { center: [x, y, 2.0 + 20.0 * random.unit()], radius: 0.05, power: bright, ..LightBound::default() }
    };
    let grove = Grove::new((0..4096).map(|_| lamp()).collect());
    println!("variance of the choice among 4,096 lamps over the squared mean: without gloss, and with it");
    for albedos in [[0.2, 0.05], [0.0, 0.9]] {
        for alpha in [0.05, 0.1, 0.2, 0.4, 0.8].into_iter().step_by(cases(2, 1)) {
            for cos in [0.9, 0.5, 0.2] {
                let mut sums = [0.0; 2];
                let count = cases(10, 40);
                for _ in 0..count {
                    let [x, y] = [(); 2].map(|()| 40.0 * random.unit_f64() - 20.0);
                    let turn = TAU * random.unit_f64();
                    let sine = (1.0_f64 - cos * cos).sqrt();
                    let view = [sine * turn.cos(), sine * turn.sin(), cos];
                    let rough = ReflectingSurface { alpha, normal: [0.0, 0.0, 1.0], view };
                    let surface = Surface { p: [x, y, 0.0], rough, albedos };
                    let both = variances(&grove, &surface);
                    (0..2).for_each(|k| sums[k] += both[k] / count as f64);
                }
                let [matt, glossy] = sums;
                // where the lobe is narrow, the choice without gloss fails
                let most = if albedos[0] == 0.0 && alpha < 0.3 { 0.25 } else { 1.1 };
                assert!(glossy < most * matt, "{albedos:?}, alpha {alpha}, cosine {cos}: {matt}, {glossy}");
                println!(
                    "albedos {albedos:?}, alpha {alpha}, cosine {cos}: {matt:.3} {glossy:.3}, {:.1} times",
                    matt / glossy
                );
            }
        }
    }
}
