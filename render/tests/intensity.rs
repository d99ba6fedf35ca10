//! Intensity profiles against definitions in double precision, and by quadrature.

use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::V3;
use etendue_oracle::tier::cases;
use etendue_render::packet::V8;
use etendue_render::scene::intensity::{Profile, ProfileError};
use std::f64::consts::{PI, TAU};

/// A table that owns its numbers.
#[derive(Debug)]
pub(crate) struct IntensityTable {
    polar: Vec<f32>,
    azimuth: Vec<f32>,
    pub(crate) values: Vec<f32>,
}

impl IntensityTable {
    /// By steps of 5° from the pole and of 15° around it.
    pub(crate) fn even(value: impl Fn(f64, f64) -> f64) -> Self {
        let steps = |count: u16, step: u16| -> Vec<f32> { (0..count).map(|i| f32::from(i * step)).collect() };
        let (polar, azimuth) = (steps(37, 5), steps(25, 15));
        let values = azimuth.iter().flat_map(|&a| polar.iter().map(move |&p| (p, a)));
        let values = values.map(|(p, a)| value(f64::from(p), f64::from(a % 360.0)) as f32).collect();
        Self { polar, azimuth, values }
    }
    pub(crate) fn profile(&self) -> Profile {
        Profile::new(self.polar.clone(), self.azimuth.clone(), self.values.clone()).unwrap()
    }
    /// Some table; of every third, the azimuths do not go all around.
    fn random(random: &mut Random, kind: usize) -> Self {
        let mut angles = |low: f64, high: f64, most: f64| {
            let count = random.range(0.0, most) as usize;
            let mut all: Vec<f32> = (0..count).map(|_| random.range(low, high) as f32).collect();
            all.extend([low as f32, high as f32]);
            all.sort_by(f32::total_cmp);
            all.dedup();
            all
        };
        let polar = match kind % 4 {
            0 => angles(0.0, 180.0, 9.0),
            1 => angles(0.0, 90.0, 5.0),
            2 => angles(90.0, 180.0, 5.0),
            _ => angles(20.0, 71.0, 3.0),
        };
        let azimuth = match kind % 3 {
            0 => vec![0.0],
            1 => angles(0.0, 360.0, 9.0),
            _ => angles(-90.0, 90.0, 4.0),
        };
        let mut values: Vec<f32> =
            (0..polar.len() * azimuth.len()).map(|_| (random.range(-1.0, 2.0) as f32).max(0.0)).collect();
        values[0] = 1.0;
        Self { polar, azimuth, values }
    }
    /// Value at angles in degrees, by a search from the start.
    fn at(&self, polar: f64, azimuth: f64) -> f64 {
        let between = |angles: &[f32], angle: f64| {
            let j = angles.windows(2).position(|pair| f64::from(pair[0]) <= angle && angle <= f64::from(pair[1]))?;
            let [low, high] = [j, j + 1].map(|j| f64::from(angles[j]));
            Some((j, (angle - low) / (high - low)))
        };
        let Some((j, t)) = between(&self.polar, polar) else { return 0.0 };
        let row = |i: usize| &self.values[i * self.polar.len() + j..][..2];
        let value = |i: usize| f64::from(row(i)[0]) * (1.0 - t) + f64::from(row(i)[1]) * t;
        if self.azimuth.len() == 1 {
            return value(0);
        }
        let found = [azimuth, azimuth - 360.0].into_iter().find_map(|azimuth| between(&self.azimuth, azimuth));
        found.map_or(0.0, |(i, s)| value(i) * (1.0 - s) + value(i + 1) * s)
    }
    /// Value in a direction.
    pub(crate) fn towards(&self, w: V3) -> f64 {
        let [polar, azimuth] = Self::angles(w);
        self.at(polar, azimuth)
    }
    fn angles(w: V3) -> [f64; 2] {
        [w[0].hypot(w[1]).atan2(w[2]).to_degrees(), w[1].atan2(w[0]).to_degrees().rem_euclid(360.0)]
    }
    /// ∫ I dω, by the midpoint rule between the angles of the table.
    fn integral(&self) -> f64 {
        let cut = |most: f64, at: &[f32], steps: usize| {
            let mut cuts: Vec<f64> = at.iter().flat_map(|&a| [f64::from(a), f64::from(a) + 360.0]).collect();
            cuts.extend([0.0, most]);
            cuts.retain(|a| (0.0..=most).contains(a));
            cuts.sort_by(f64::total_cmp);
            let pairs: Vec<[f64; 2]> = cuts.windows(2).map(|pair| [pair[0], pair[1]]).collect();
            pairs.into_iter().flat_map(move |[a, b]| {
                (0..steps).map(move |k| (a + (b - a) * (k as f64 + 0.5) / steps as f64, (b - a) / steps as f64))
            })
        };
        let mut sum = 0.0;
        for (theta, height) in cut(180.0, &self.polar, 400) {
            let across: f64 = cut(360.0, &self.azimuth, 1).map(|(phi, width)| width * self.at(theta, phi)).sum();
            sum += across * height * theta.to_radians().sin();
        }
        sum * (PI / 180.0).powi(2)
    }
}

fn directions(random: &mut Random, count: usize) -> Vec<V3> {
    let mut all = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [1.0, -0.0, 0.0], [-1.0, -0.0, 0.0]];
    all.extend((0..count).map(|_| random.direction().map(|x| f64::from(x as f32))));
    all
}

/// Bilinear between angles, also at poles and seams, and the same in any lane.
#[test]
fn intensity_is_that_of_the_table() {
    let mut random = Random::new(3);
    for kind in 0..cases(60, 600) {
        let table = IntensityTable::random(&mut random, kind);
        let profile = table.profile();
        for packet in directions(&mut random, 203).chunks(8) {
            let found = profile.intensity(Coordinates::gather(packet)).to_array();
            let turned: Vec<V3> = (0..8).map(|lane| packet[(lane + 3) % 8]).collect();
            let again = profile.intensity(Coordinates::gather(&turned)).to_array();
            for (lane, &w) in packet.iter().enumerate() {
                assert_eq!(found[lane].to_bits(), again[(lane + 5) % 8].to_bits());
                let [polar, azimuth] = IntensityTable::angles(w);
                // the value, and those within the rounding of the angles: at its edges, a table is not continuous
                let slack = 1e-6_f64.to_degrees();
                let across = slack / polar.to_radians().sin().max(slack.to_radians());
                let azimuths = [-across.min(180.0), 0.0, across.min(180.0)].map(|d| (azimuth + d).rem_euclid(360.0));
                let near: Vec<f64> = [-slack, 0.0, slack]
                    .into_iter()
                    .flat_map(|d| azimuths.map(|a| table.at((polar + d).clamp(0.0, 180.0), a)))
                    .collect();
                let [low, high] = [f64::min, f64::max].map(|f| near.iter().copied().reduce(f).unwrap());
                let (low, high, value) = (low - 8e-7, high + 8e-7, f64::from(found[lane]));
                assert!((low..=high).contains(&value), "{value} at {w:?}, expected {low} to {high}: {table:?}");
            }
        }
    }
}

/// The power has a closed form for tables that are linear in the polar angle; elsewhere quadrature tells it.
#[test]
fn powers_are_integrals() {
    let all_around = Profile::new(vec![0.0, 180.0], vec![0.0], vec![2.0, 2.0]).unwrap();
    assert!((all_around.power() - 8.0 * PI).abs() < 1e-13);
    // ∫ (1 − θ/b) sinθ dθ from 0 to b is 1 − sin b/b
    for b in [1.0_f32, 20.0, 90.0, 135.0, 180.0] {
        let cone = Profile::new(vec![0.0, b], vec![0.0], vec![3.0, 0.0]).unwrap();
        let radians = f64::from(b).to_radians();
        let truth = 3.0 * TAU * (1.0 - radians.sin() / radians);
        assert!((cone.power() / truth - 1.0).abs() < 1e-12, "{b}: {} for {truth}", cone.power());
    }
    let mut random = Random::new(5);
    for kind in 0..cases(12, 60) {
        let table = IntensityTable::random(&mut random, kind);
        let (power, truth) = (table.profile().power(), table.integral());
        assert!((power / truth - 1.0).abs() < 1e-5, "{power} for {truth}: {table:?}");
    }
}

/// Beyond the cone all is dark; within, the last angle counts.
#[test]
fn cones_contain_the_light() {
    let mut random = Random::new(9);
    for kind in 0..cases(60, 600) {
        let table = IntensityTable::random(&mut random, kind);
        let profile = table.profile();
        for packet in directions(&mut random, 203).chunks(8) {
            let w: V8 = Coordinates::gather(packet);
            for (value, z) in profile.intensity(w).to_array().into_iter().zip(w.z.to_array()) {
                assert!(value == 0.0 || z >= profile.cos_cone(), "{value} at {z}: {table:?}");
            }
        }
    }
    let cone =
        |polar: &[f32], values: &[f32]| Profile::new(polar.to_vec(), vec![0.0], values.to_vec()).unwrap().cos_cone();
    assert_eq!(cone(&[0.0, 90.0], &[1.0, 1.0]), 0.0);
    assert_eq!(cone(&[0.0, 60.0, 90.0], &[1.0, 0.0, 0.0]), 0.5);
    assert_eq!(cone(&[0.0, 60.0, 180.0], &[1.0, 1.0, 0.0]), -1.0);
    assert_eq!(cone(&[0.0, 60.0], &[0.0, 0.0]), 1.0);
}

#[test]
fn tables_that_are_none_are_refused() {
    let error = |polar: &[f32], azimuth: &[f32], values: &[f32]| {
        Profile::new(polar.to_vec(), azimuth.to_vec(), values.to_vec()).err()
    };
    let one = [1.0; 4];
    assert_eq!(error(&[0.0], &[0.0], &one[..1]), Some(ProfileError::Length));
    assert_eq!(error(&[0.0, 1.0], &[], &[]), Some(ProfileError::Length));
    assert_eq!(error(&[0.0, 1.0], &[0.0], &one), Some(ProfileError::Length));
    for polar in [[0.0, 0.0], [1.0, 0.0], [-1.0, 2.0], [0.0, 181.0], [f32::NAN, 1.0], [0.0, f32::NAN]] {
        assert_eq!(error(&polar, &[0.0], &one[..2]), Some(ProfileError::Angle), "{polar:?}");
    }
    for azimuth in [[0.0, 0.0], [1.0, 2.0], [-360.0, 0.0], [-1.0, 359.5], [f32::NAN, 1.0], [0.0, f32::NAN]] {
        assert_eq!(error(&[0.0, 1.0], &azimuth, &one), Some(ProfileError::Angle), "{azimuth:?}");
    }
    for value in [-1.0, f32::NAN, f32::INFINITY, 2e37] {
        assert_eq!(error(&[0.0, 1.0], &[0.0], &[0.0, value]), Some(ProfileError::Value));
    }
}
