//! Spot lights with profiles, by every technique, against closed forms.

use crate::kit::{BLACK, Folder, PLANE, exactly, narrow, nearly};
use std::f64::consts::PI;

/// A spot light that is aimed obliquely at the plane, and not at the origin: its profile is turned along with it.
#[test]
fn spots_with_profiles_over_a_plane() {
    let folder = Folder::new();
    // 90 cd at the nadir, 30 cd at 60 degrees and azimuth 0, nothing there at 180
    folder.ies("c.ies", "0 60", "0 180", "90 30 90 0");
    let shows = |light: &str, irradiance: f64| {
        exactly(&folder.world(&narrow("1 .3 2", &format!("{PLANE}{light}"))), [irradiance; 3]);
    };
    // the spot is at (0, 2, 0) and aimed to the side of +x, by 20 degrees; the origin is on the other side of the axis, towards −x
    let angle = 20.0_f64;
    let t = (angle.to_radians().cos() - 30_f64.to_radians().cos())
        / (10_f64.to_radians().cos() - 30_f64.to_radians().cos());
    let falloff = t * t * (3.0 - 2.0 * t);
    let spot = |name: &str, more: &str| {
        let x = 2.0 * angle.to_radians().tan();
        format!(
            "LightSource \"spot\" \"point3 from\" [0 2 0] \"point3 to\" [{x} 0 0] \"float coneangle\" 30 \
             \"float conedeltaangle\" 20 \"string profile\" \"{name}\" {more}"
        )
    };
    let at = |far: f64| falloff / 4.0 * (90.0 + (far - 90.0) * angle / 60.0);
    shows(&spot("c.ies", ""), at(0.0));
    shows(&spot("c.ies", "\"float scale\" 3 \"rgb I\" [2 2 2]"), 6.0 * at(0.0));
    // turned about the axis by half a turn, with +x of the light at −x of the world
    let turned = |light: &str| format!("AttributeBegin Rotate 180 0 1 0 {light} AttributeEnd");
    let x = -2.0 * angle.to_radians().tan();
    let back = turned(&spot("c.ies", "")).replace(&format!("[{} 0 0]", -x), &format!("[{x} 0 0]"));
    shows(&back, at(30.0));
    // outside of the cone
    shows(
        &spot("c.ies", "").replace("coneangle\" 30", "coneangle\" 15").replace("deltaangle\" 20", "deltaangle\" 0.001"),
        0.0,
    );
    // among other lights, one of which has an area
    let ball =
        "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Translate 0 4 0 Shape \"sphere\" AttributeEnd";
    let both = narrow("1 .3 2", &format!("{PLANE}{BLACK}{}\n{ball}", spot("c.ies", "")));
    nearly(&folder.world(&both), [at(0.0) + 5.0 * PI / 16.0; 3], 1e-4, 1 << 14, "a spot and a ball");
}

/// The power of a spot light is what its profile and its falloff emit together.
#[test]
fn spots_with_profiles_have_the_power_that_they_are_given() {
    let folder = Folder::new();
    folder.ies("c.ies", "0 60", "0", "1 0");
    let light = "LightSource \"spot\" \"point3 from\" [0 2 0] \"point3 to\" [0 0 0] \"float coneangle\" 40 \
                 \"float conedeltaangle\" 40 \"string profile\" \"c.ies\" \"float power\" 50 \"rgb I\" [7 7 7]";
    let n = 100_000;
    let most = 40_f64.to_radians();
    let flux: f64 = (0..n)
        .map(|i| {
            let theta = (f64::from(i) + 0.5) / f64::from(n) * most;
            let t = (theta.cos() - most.cos()) / (1.0 - most.cos());
            2.0 * PI * theta.sin() * t * t * (3.0 - 2.0 * t) * (1.0 - theta.to_degrees() / 60.0) * most / f64::from(n)
        })
        .sum();
    exactly(&folder.world(&narrow("1 .3 2", &format!("{PLANE}{light}"))), [50.0 / flux / 4.0; 3]);
}
