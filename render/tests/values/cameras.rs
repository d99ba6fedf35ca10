//! Where the rays of cameras begin and go.

use super::row::{Row, grey};
use etendue_oracle::{V3, length};
use std::f64::consts::PI;

/// A floor z = 0 below a point light at (0.2, −0.1, 3), within a room whose ceiling is at 4.
const ROOM: &str = "WorldBegin Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\n\
    Shape \"bilinearmesh\" \"point3 P\" [-9 -9 0 9 -9 0 -9 9 0 9 9 0]\n\
    Shape \"bilinearmesh\" \"point3 P\" [-9 -9 4 -9 9 4 9 -9 4 9 9 4]\n\
    LightSource \"point\" \"point3 from\" [.2 -.1 3]";

/// Radiance of the floor at (x, y).
fn floor(x: f64, y: f64) -> V3 {
    let to_light = [0.2 - x, -0.1 - y, 3.0];
    grey(0.5 / PI * 3.0 / length(to_light).powi(3))
}

/// A screen that is hardly more than a point.
fn at(x: f64, y: f64) -> String {
    let size = 1e-5;
    format!("\"float screenwindow\" [{} {} {} {}]", x - size, x + size, y - size, y + size)
}

/// From (0, 0, 2) downwards: with +y up, +x of the screen is −x of the world, as in pbrt without a mirror.
pub(super) fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    let view = "LookAt 0 0 2 0 0 0 0 1 0";
    let square = "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1";
    for (before, [sx, sy]) in [
        ("", [-1.0, 1.0]),
        ("Scale -1 1 1", [1.0, 1.0]),
        ("Scale 1 -1 1", [-1.0, -1.0]),
        ("Scale .5 .5 .5", [-1.0, 1.0]),
    ] {
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.5, -1.5), (-2.0, 1.0)] {
            // a scale of the whole camera space changes an orthographic camera, and no perspective one
            let unit = if before.contains(".5") { 2.0 } else { 1.0 };
            let flat = format!("{before} {view} {square} Camera \"orthographic\" {} {ROOM}", at(x, y));
            let right = floor(sx * x * unit, sy * y * unit);
            rows.push(Row::new(format!("orthographic {before} at {x}, {y}"), flat, right).within(1e-4));
            // of 90 degrees, the screen at distance 1 is half as far as the floor
            let deep = format!("{before} {view} {square} Camera \"perspective\" {} {ROOM}", at(x, y));
            rows.push(
                Row::new(format!("perspective {before} at {x}, {y}"), deep, floor(2.0 * sx * x, 2.0 * sy * y))
                    .within(1e-4),
            );
            let narrow =
                format!("{before} {view} {square} Camera \"perspective\" \"float fov\" 60 {} {ROOM}", at(x, y));
            let [far, near] = [sx * x, sy * y].map(|at| at * 2.0 * 30_f64.to_radians().tan());
            rows.push(Row::new(format!("60 degrees {before} at {x}, {y}"), narrow, floor(far, near)).within(1e-4));
            // with a lens, both see the plane of focus, in which the floor lies
            let lens = "\"float lensradius\" .01 \"float focaldistance\" 2";
            let flat = format!("{view} {square} Camera \"orthographic\" {} {lens} {ROOM}", at(x, y));
            rows.push(Row::new(format!("orthographic with a lens at {x}, {y}"), flat, floor(-x, y)).within(1e-4));
        }
    }
    // the pixel (3, 2) of a crop, whose columns are 1 wide
    let crop = "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 4 \"integer pixelbounds\" [3 4 2 3]";
    for (kind, half) in [("orthographic", 0.5), ("perspective", 1.0)] {
        let text = format!("{view} {crop} Camera \"{kind}\" {ROOM}");
        // its middle is at (−1/4, −1/4) of the screen, and it is half a unit wide, times 2 at the floor of a perspective camera
        let n = 64;
        let mean = (0..n * n).map(|k| {
            let [x, y] = [k % n, k / n].map(|k| (f64::from(k) + 0.5) / f64::from(n) - 0.5);
            floor(2.0 * half * (0.25 - 0.5 * x), 2.0 * half * (-0.25 + 0.5 * y))[0]
        });
        let right = grey(mean.sum::<f64>() / f64::from(n * n));
        rows.push(Row::new(format!("a pixel of {kind}"), text, right).within(1e-4).samples(1 << 14));
    }
    rows
}
