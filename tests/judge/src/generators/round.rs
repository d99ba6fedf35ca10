//! Spheres and disks.

use super::{Case, Random, combine, frame, narrow};

/// A centre, a radius and a normal.
type Round = ([f32; 3], f32, [f32; 3]);

/// Centre and radius of spheres in every regime.
pub(super) fn spheres(each: usize, mut random: Random) -> Vec<Case<([f32; 3], f32)>> {
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, ratio, unit) in [
            ("ordinary", 0.3, 1.0),
            ("small 1e-3", 1e-3, 1.0),
            ("tiny 1e-7", 1e-7, 1.0),
            ("tiny 1e-9", 1e-9, 1.0),
            ("far 1e9", 1e-9, 1e12),
            ("small units", 0.2, 1e-12),
            ("close", 0.9, 1.0),
            ("touching 1e-3", 0.999, 1.0),
            ("touching 1e-5", 0.99999, 1.0),
            ("inside, near the surface", 1.0001, 1.0),
            ("inside", 1.5, 1.0),
            ("deep inside", 1e3, 1.0),
        ] {
            random.begin();
            let center = narrow(random.direction().map(|x| x * unit));
            all.push((name, (center, (ratio * unit) as f32)));
        }
        random.begin();
        let size = random.magnitude(1e-9, 1e-2);
        all.push(("on the axis", ([0.0, 0.0, 1.0], size as f32)));
    }
    all
}

/// Centre and radius of spheres relative to a horizon, and the normal, in every regime: the ratio of radius to distance, and the cosine
/// between the normal and the axis.
pub(super) fn spheres_over_horizon(each: usize, mut random: Random) -> Vec<Case<Round>> {
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, ratio, cos) in [
            ("ordinary", 0.3, 0.8),
            ("tiny 1e-6", 1e-6, 0.8),
            ("large, whole", 0.9, 0.95),
            ("nearly tangent to the horizon", 0.3, 0.3001),
            ("nearly tangent from below", 0.3, 0.2999),
            ("tiny, over the horizon", 1e-6, 3e-6),
            ("cut", 0.5, 0.3),
            ("cut, large", 0.95, 0.6),
            ("cut, nearly touching", 0.99999, 0.5),
            ("cut, tiny 1e-3", 1e-3, 4e-4),
            ("cut, tiny 1e-6", 1e-6, 4e-7),
            ("axis near the horizon", 0.4, 1e-5),
            ("axis below", 0.5, -0.2),
            ("axis below, large", 0.9, -0.5),
            ("axis below, tiny 1e-3", 1e-3, -4e-4),
            ("axis below, tiny 1e-6", 1e-6, -4e-7),
            ("sliver of a lune", 0.5, -0.45),
            ("axis far below, large", 0.95, -0.8),
        ] {
            let a = frame(&mut random);
            let center = narrow(combine(&a, f64::sqrt(1.0 - cos * cos), 0.0, cos));
            all.push((name, (center, ratio as f32, narrow(a[2]))));
        }
        random.begin();
        let normal = narrow(random.direction());
        // exactly along the normal: if rounding alone separated the axis from it, the azimuth would be that of the rounding
        all.push(("along the normal", ([0.0, 0.0, 3.0], random.range(0.1, 3.0) as f32, [0.0, 0.0, 1.0])));
        let beside = [1e-4, 3e-4, 1.0].map(|x: f32| x * random.range(0.5, 1.0) as f32);
        all.push(("nearly along the normal", (beside, 0.3, [0.0, 0.0, 1.0])));
        all.push(("inside", (narrow(random.direction()), 1.5, normal)));
        let about = [0.3, 0.1, 1e-7].map(|x: f32| x * random.range(-1.0, 1.0) as f32);
        all.push(("horizon of coordinates", (about, 1e-3, [0.0, 0.0, 1.0])));
    }
    all
}

/// Centre, radius and normal of disks in every regime: the radius, the height of the viewpoint over the plane, and its offset from the axis.
pub(super) fn disks(each: usize, mut random: Random) -> Vec<Case<Round>> {
    let mut all = Vec::new();
    for _ in 0..each {
        for (name, radius, height, offset) in [
            ("ordinary", 0.6, 1.0, 0.4),
            ("oblique", 1.0, 1.0, 2.0),
            ("small 1e-3", 1e-3, 1.0, 0.7),
            ("tiny 1e-7", 1e-7, 1.0, 0.7),
            ("tiny 1e-9", 1e-9, 1.0, 0.7),
            ("far 1e9", 1e3, 1e12, 7e11),
            ("on the axis", 0.8, 1.0, 0.0),
            ("nearly on the axis", 0.8, 1.0, 1e-4),
            ("grazing 1e-2", 1.0, 1e-2, 2.5),
            ("grazing 1e-4", 1.0, 1e-4, 2.5),
            ("grazing and far", 1.0, 1e-3, 1e3),
            ("close over it", 1.0, 1e-2, 0.6),
            ("close 1e-4", 1.0, 1e-4, 0.6),
            ("near-hemisphere 1e3", 1e3, 1.0, 30.0),
            ("near-hemisphere 1e5", 1e5, 1.0, 3e4),
            ("over the rim 1e-2", 1.0, 1e-2, 1.0),
            ("over the rim 1e-4", 1.0, 1e-4, 1.0),
            ("beside the rim 1e-2", 1.0, 1e-3, 1.01),
            ("beside the rim 1e-4", 1.0, 1e-3, 1.0001),
            ("within the rim 1e-3", 1.0, 1e-4, 0.999),
        ] {
            let axes = frame(&mut random);
            let center = narrow(combine(&axes, offset, 0.0, height));
            all.push((name, (center, radius as f32, narrow(axes[2]))));
        }
        random.begin();
        all.push(("exactly on the axis", ([0.0, 0.0, -2.0], random.range(0.1, 4.0) as f32, [0.0, 0.0, 1.0])));
    }
    all
}
