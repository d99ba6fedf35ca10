//! Flat lights and spot lights with profiles: factors and powers by their definitions, summed in double precision.

use crate::intensity::IntensityTable;
use etendue::{SpotLight, Vec3};
use etendue_judge::generators::Random;
use etendue_judge::packets::Coordinates;
use etendue_oracle::tier::cases;
use etendue_oracle::{V3, along, basis, unit};
use etendue_render::packet::{V8, X8};
use etendue_render::scene::intensity::Intensity;
use etendue_render::scene::light_profile::LuminousOpening;
use std::f64::consts::{PI, TAU};

/// A lamp that shines all around, a narrow beam, one that is dark on half its sides, and one that shines upwards alone.
fn tables() -> [IntensityTable; 4] {
    [
        IntensityTable::even(|polar, azimuth| 2.0 + polar.to_radians().cos() + azimuth.to_radians().sin()),
        IntensityTable::even(|polar, _| f64::max(10.0 - polar, 0.0)),
        IntensityTable::even(|polar, azimuth| if azimuth > 100.0 { 0.0 } else { polar * (180.0 - polar) }),
        IntensityTable::even(|polar, azimuth| if polar > 90.0 { 1.0 + azimuth / 360.0 } else { 0.0 }),
    ]
}

/// Where the intensity begins to fall.
fn least() -> f64 {
    85_f64.to_radians().cos()
}

/// ∫ f(w, cosθ) dω over the angles θ to the axis up to `most` degrees, by small steps.
fn sum(axis: V3, most: f64, f: impl Fn(V3, f64) -> f64) -> f64 {
    let (s, t) = basis(axis);
    // about the axis of the tables, azimuths are linear between the steps
    let columns = if axis == [0.0, 0.0, 1.0] { 144 } else { 720 };
    // two points of Gauss and Legendre in each half degree, but for narrow cones
    let rows = (2.0 * most).max(40.0).ceil();
    let mut all = 0.0;
    for i in 0..2 * rows as u32 {
        let off = if i % 2 == 0 { -0.5 } else { 0.5 } / 3.0_f64.sqrt();
        let theta = (f64::from(i / 2) + 0.5 + off) / rows * most.to_radians();
        let mut row = 0.0;
        for j in 0..columns {
            let turn = (f64::from(j) + 0.5) / f64::from(columns) * TAU;
            let across = along(s.map(|x| x * turn.cos()), t, turn.sin());
            row += f(along(axis.map(|x| x * theta.cos()), across, theta.sin()), theta.cos());
        }
        all += row * theta.sin();
    }
    all * TAU / f64::from(columns) * most.to_radians() / (2.0 * rows)
}

/// Whatever the table and however it is turned, the power is that of the light without it, and the factor that of the formula.
#[test]
fn openings_keep_the_power() {
    let normals = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], unit([0.3, -0.5, -0.7])];
    let mut dark = 0;
    for (kind, table) in tables().iter().enumerate() {
        let intensity = Intensity::Angles(table.profile());
        for (normal, two_sided) in normals.into_iter().flat_map(|n| [(n, false), (n, true)]) {
            let (most, sides) = if two_sided { (180.0, 2.0) } else { (90.0, 1.0) };
            let flux = sum(normal, most, |w, cos| table.towards(w) * (cos.abs() / least()).min(1.0));
            let Some(opening) = LuminousOpening::new(normal, two_sided, &intensity) else {
                assert!(flux == 0.0 && !two_sided, "{kind} {normal:?}: {flux}");
                dark += 1;
                continue;
            };
            let (gain, found) = (sides * PI / flux, f64::from(opening.gain));
            let most_off = if normal == normals[0] { 2e-6 } else { 1e-3 };
            assert!((found / gain - 1.0).abs() < most_off, "{kind} {normal:?}: {found} for {gain}");
            for cos in [1.0_f32, -0.7, 0.2, 0.09, 0.08, -1e-3, 0.0] {
                let factor = f64::from(opening.factor(X8::splat(cos), X8::splat(0.75)).to_array()[0]);
                let wanted = 0.75 * found / f64::from(cos).abs().max(least());
                assert!((factor / wanted - 1.0).abs() < 3e-7, "{kind} at {cos}: {factor} for {wanted}");
            }
        }
    }
    // a beam that is behind, and what shines upwards alone
    assert_eq!(dark, 2);
}

/// From far away an opening is the luminaire that was measured: its radiance times the area that is seen is the intensity, but for the last
/// degrees next to its plane, where that falls in proportion to the cosine.
#[test]
fn openings_have_the_intensities_of_their_table() {
    let mut random = Random::new(3);
    let table = &tables()[0];
    let intensity = Intensity::Angles(table.profile());
    let opening = LuminousOpening::new([0.0, 0.0, 1.0], false, &intensity).unwrap();
    let of = |directions: &[V3]| {
        let w: V8 = Coordinates::gather(directions);
        (opening.factor(w.z, intensity.at(w)) * w.z.abs()).to_array().map(f64::from)
    };
    let scale = of(&[[0.0, 0.0, 1.0]])[0] / table.towards([0.0, 0.0, 1.0]);
    for _ in 0..cases(1000, 100_000) / 8 {
        let directions = [(); 8].map(|()| random.direction());
        for (w, found) in directions.into_iter().zip(of(&directions)) {
            let wanted = table.towards(w) * (w[2].abs() / least()).min(1.0);
            assert!((found / scale - wanted).abs() < 1e-5 * wanted.max(0.1), "{w:?}: {found} for {wanted}");
        }
    }
}

/// The power of a spot light with a profile is that of its falloff and its intensity together.
#[test]
fn spot_lights_take_profiles() {
    let mut random = Random::new(5);
    for (kind, table) in tables().iter().enumerate() {
        let intensity = Intensity::Angles(table.profile());
        for (inner, outer) in [(10.0_f64, 30.0_f64), (0.0, 5.0), (40.0, 40.0), (70.0, 150.0)] {
            let axis = if kind == 1 { [0.0, 0.0, 1.0] } else { random.direction() };
            let [cos_inner, cos_outer] = [inner, outer].map(|degrees| degrees.to_radians().cos());
            let light = SpotLight {
                position: Vec3::<f64>::from([1.0, 2.0, 3.0]),
                axis: axis.into(),
                one_minus_cos_inner: 1.0 - cos_inner,
                one_minus_cos_outer: 1.0 - cos_outer,
            };
            let falloff = |cos: f64| {
                if inner == outer {
                    return f64::from(u8::from(cos >= cos_inner));
                }
                let t = ((cos - cos_outer) / (cos_inner - cos_outer)).clamp(0.0, 1.0);
                t * t * (3.0 - 2.0 * t)
            };
            let wanted = sum(axis, outer, |w, cos| table.towards(w) * falloff(cos));
            let most =
                sum(axis, outer, |_, cos| falloff(cos)) * table.values.iter().fold(0.0, |m: f32, x| m.max(*x)) as f64;
            let power = intensity.flux_of_spot(&light.map(|x| x as f32));
            assert!(
                (power - wanted).abs() <= 1e-3 * wanted.max(0.01 * most),
                "{kind} {inner} {outer}: {power} for {wanted}"
            );
        }
    }
}
