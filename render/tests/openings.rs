//! Flat lights with profiles: factors and powers by their definitions, summed in double precision.

use crate::intensity::IntensityTable;
use etendue_oracle::{V3, along, basis, unit};
use etendue_render::packet::X8;
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
