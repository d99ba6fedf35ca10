//! Segments.

use super::{Case, Random, combine, frame, narrow};
use crate::fixtures::Segment;
use std::collections::BTreeMap;
use std::sync::Mutex;

/// `name, place` as a string, allocated once per pair.
fn joined(name: &'static str, place: &'static str) -> &'static str {
    static NAMES: Mutex<BTreeMap<[&str; 2], &str>> = Mutex::new(BTreeMap::new());
    let mut names = NAMES.lock().expect("nothing panics here");
    names.entry([name, place]).or_insert_with(|| Box::leak(format!("{name}, {place}").into_boxed_str()))
}

/// Line segments in every regime, alone and relative to a horizon. The table has an end and the edge from it in a plane with the viewpoint, and
/// the inner table the tilt of the normal and the first end's height over the horizon.
#[must_use]
pub fn segments(each: usize, numbers: impl Into<Random>) -> [Vec<Case<Segment>>; 2] {
    let mut random: Random = numbers.into();
    let (mut plain, mut projected) = (Vec::new(), Vec::new());
    for _ in 0..each {
        for (name, a, edge) in [
            ("ordinary", [1.0, -0.3], [0.2, 0.9]),
            ("oblique", [1.0, 0.2], [1.5, 0.4]),
            ("small 1e-3", [1.0, 0.3], [4e-4, 1e-3]),
            ("tiny 1e-5", [1.0, 0.3], [4e-6, 1e-5]),
            ("tiny 1e-9", [1.0, 0.3], [4e-10, 1e-9]),
            ("far 1e9", [1e12, 3e11], [400.0, 1e3]),
            ("end-on 1e-2", [1.0, 0.0], [1.0, 1e-2]),
            ("end-on 1e-4", [1.0, 0.0], [1.0, 1e-4]),
            ("long 1e2", [1.0, -40.0], [3.0, 100.0]),
            ("long 1e5", [1.0, -4e4], [1e3, 1e5]),
            ("long 1e5, from its end", [1.0, -0.1], [1e3, 1e5]),
            ("close 1e-3", [1e-3, -0.5], [1e-3, 1.0]),
            ("close 1e-6", [1e-6, -0.5], [0.0, 1.0]),
            ("touching an end 1e-3", [1e-3, 0.0], [3e-4, 1.0]),
        ] {
            let axes = frame(&mut random);
            let [p, e] = [a, edge].map(|v| narrow(combine(&axes, v[0], v[1], 0.0)));
            plain.push((name, Segment { ends: [p, e], normal: None }));
            // relative to the distance, so that small segments cross the horizon too
            let size = libm::hypot(edge[0], edge[1]).min(1.0) / libm::hypot(a[0], a[1]).max(1.0);
            for (place, tilt, lift) in [
                ("overhead", 0.7, 0.7),
                ("turned", -0.5, 0.6),
                ("cut", 0.6, -0.1 * size),
                ("cut at the other end", -0.6, 0.2 * size),
                ("low 1e-2", 0.3, 1e-2),
            ] {
                // the first end's height is the normal's component along its direction
                let unit = etendue_oracle::unit([a[0], a[1], 0.0]);
                let side = [-unit[1], unit[0], 0.0];
                let towards = side[0] * edge[0] + side[1] * edge[1] > 0.0;
                let tilt = if towards { tilt } else { -tilt };
                let rest = f64::sqrt((1.0 - lift * lift - tilt * tilt).max(0.01));
                let mix = |k: usize| unit[k] * lift + side[k] * tilt;
                let normal = combine(&axes, mix(0), mix(1), rest);
                projected.push((joined(name, place), Segment { ends: [p, e], normal: Some(narrow(normal)) }));
            }
        }
    }
    for (name, ends) in [
        ("an end on the horizon", [[1.0, 0.5, 0.0], [0.5, 1.0, 2.0]]),
        ("half the sky", [[-1e4, 0.0, 1.0], [2e4, 0.0, 0.0]]),
        ("a sliver of sky", [[1.0, 0.0, -1.0], [1e3, 0.0, 3.0]]),
    ] {
        projected.push((name, Segment { ends, normal: Some([0.0, 0.0, 1.0]) }));
    }
    [plain, projected]
}
