//! A camera that turns about what it looks at.

use crate::scene::CameraSettings;
use etendue::Vec3;

/// A camera that looks up or down keeps this angle to the axis of the scene in radians, so that its horizon stays level.
const LEAST: f64 = 0.02;

/// How far a camera has turned from where the scene has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// The angle about the scene's upward axis in radians; positive towards the right of the image.
    pub around: f64,
    /// The angle upwards in radians.
    pub over: f64,
    /// Its distance, in units of the one in the scene.
    pub distance: f64,
}

impl CameraSettings {
    /// The camera after it has turned about the point that it sees at this distance along its axis. The scene's upward axis is the axis of
    /// coordinates that is nearest to the camera's own.
    #[must_use]
    pub fn orbited(&self, distance: f64, orbit: Orbit) -> Self {
        let Orbit { around, over, distance: factor } = orbit;
        let up = self.upward();
        let [forward, right] = [self.forward, self.right].map(Vec3::<f64>::from);
        // the camera goes up as its axis comes down
        let steep = forward.dot(up).clamp(-1.0, 1.0).acos();
        let over = (steep + over).clamp(LEAST, std::f64::consts::PI - LEAST) - steep;
        let level = up.cross(forward);
        let level = if level.length() > 1e-9 { level / level.length() } else { right / right.length() };
        let turned = |v: [f64; 3]| rotated(rotated(v.into(), level, over), up, around);
        let pivot = Vec3::from(self.origin) + forward * distance;
        let origin = pivot - turned(self.forward) * (distance * factor);
        let [forward, right, up] = [self.forward, self.right, self.up].map(|v| turned(v).to_array());
        Self { origin: origin.to_array(), forward, right, up, ..self.clone() }
    }

    fn upward(&self) -> Vec3<f64> {
        let most = (0..3).max_by(|&a, &b| self.up[a].abs().total_cmp(&self.up[b].abs())).unwrap_or(1);
        Vec3::from(std::array::from_fn(|k| if k == most { 1.0_f64.copysign(self.up[k]) } else { 0.0 }))
    }
}

/// A vector after a turn about a unit vector by an angle in radians, by Rodrigues's formula.
fn rotated(v: Vec3<f64>, axis: Vec3<f64>, angle: f64) -> Vec3<f64> {
    let (sin, cos) = angle.sin_cos();
    v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Screen;

    fn camera() -> CameraSettings {
        let (sin, cos) = 0.5_f64.sin_cos();
        CameraSettings {
            origin: [0.0, 6.0, 7.0],
            forward: [0.0, -sin, -cos],
            right: [2.0, 0.0, 0.0],
            up: [0.0, 2.0 * cos, -2.0 * sin],
            is_orthographic: false,
            screen: Screen::Half(0.5),
            lens: None,
        }
    }
    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn the_camera_looks_at_the_same_point_from_all_sides_with_a_level_horizon() {
        let pivot = |c: &CameraSettings, at: f64| std::array::from_fn(|k| c.origin[k] + at * c.forward[k]);
        for (around, over, distance) in [(0.0, 0.0, 1.0), (1.0, 0.3, 2.0), (-4.0, 9.0, 0.5), (0.2, -9.0, 1.0)] {
            let turned = camera().orbited(3.0, Orbit { around, over, distance });
            assert!(near(pivot(&camera(), 3.0), pivot(&turned, 3.0 * distance)), "{turned:?}");
            assert!(turned.right[1].abs() < 1e-12 && turned.up[1] > 0.0, "{turned:?}");
            let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!((length(turned.forward) - 1.0).abs() < 1e-12 && (length(turned.up) - 2.0).abs() < 1e-12);
        }
        let same = camera().orbited(3.0, Orbit { around: 0.0, over: 0.0, distance: 1.0 });
        assert!(near(same.origin, camera().origin) && near(same.up, camera().up));
    }

    #[test]
    fn a_turn_to_the_right_moves_the_camera_to_the_right_and_one_upwards_moves_it_up() {
        let right = camera().orbited(3.0, Orbit { around: 0.1, over: 0.0, distance: 1.0 });
        assert!(right.origin[0] > 0.1 && (right.origin[1] - 6.0).abs() < 1e-12, "{right:?}");
        let over = camera().orbited(3.0, Orbit { around: 0.0, over: 0.1, distance: 1.0 });
        assert!(over.origin[1] > 6.1 && over.origin[0].abs() < 1e-12, "{over:?}");
    }
}
