//! Portals in double precision: what is seen of them, and their density by its definition.

use core::f64::consts::PI;
use etendue::light::{Portal, PortalEnvironment, PortalTable};
use etendue_judge::generators::Random;
use etendue_oracle::{V3, add, cross, dot, length, narrow, sub, times, wide};

/// A parallelogram with the texels of its map.
#[derive(Clone)]
pub(crate) struct Opening {
    pub(crate) corner: [f32; 3],
    pub(crate) s: [f32; 3],
    pub(crate) t: [f32; 3],
    pub(crate) weights: Vec<f32>,
    pub(crate) width: usize,
}

impl Opening {
    pub(crate) fn new(random: &mut Random, corner: V3, s: V3, t: V3, [width, height]: [usize; 2]) -> Self {
        let weights = (0..width * height)
            .map(|i| match i % 7 {
                0 => 0.0,
                3 => 50.0 * random.unit(),
                _ => random.unit(),
            })
            .collect();
        Self { corner: narrow(corner), s: narrow(s), t: narrow(t), weights, width }
    }
    pub(crate) fn height(&self) -> usize {
        self.weights.len() / self.width
    }
    /// Where a ray passes the parallelogram, in units of its edges, if it goes that way.
    pub(crate) fn passed(&self, p: V3, w: V3) -> Option<[f64; 2]> {
        let (s, t) = (wide(self.s), wide(self.t));
        let n = cross(s, t);
        let ahead = dot(sub(wide(self.corner), p), n);
        let toward = dot(w, n);
        if ahead <= 0.0 || toward <= 0.0 {
            return None;
        }
        let at = sub(add(p, times(w, ahead / toward)), wide(self.corner));
        let square = dot(n, n);
        Some([dot(cross(at, t), n) / square, dot(cross(s, at), n) / square])
    }
    /// Angles of a vector about both edges, in units of the map.
    pub(crate) fn place(&self, v: V3) -> [f64; 2] {
        let (s, t) = (wide(self.s), wide(self.t));
        let n = cross(s, t);
        let square = dot(n, n);
        let (x, y) = (dot(cross(v, t), n) / square * length(s), dot(cross(s, v), n) / square * length(t));
        let z = dot(v, n) / length(n);
        [x.atan2(z) / PI + 0.5, y.atan2(z) / PI + 0.5]
    }
    /// Corners of what is seen in the map.
    pub(crate) fn window(&self, p: V3) -> [[f64; 2]; 2] {
        let low = sub(wide(self.corner), p);
        let high = add(low, add(wide(self.s), wide(self.t)));
        [self.place(low), self.place(high)]
    }
    /// Weight of what is seen, and that of a place over its area.
    pub(crate) fn weight(&self, p: V3) -> f64 {
        let [low, high] = self.window(p);
        let (w, h) = (self.width, self.height());
        let part = |k: usize, i: usize, n: usize| {
            let [a, b] = [i, i + 1].map(|i| i as f64 / n as f64);
            (b.min(high[k]) - a.max(low[k])).max(0.0) * n as f64
        };
        let texel = |i: usize| f64::from(self.weights[i]) * part(0, i % w, w) * part(1, i / w, h);
        (0..w * h).map(texel).sum()
    }
    pub(crate) fn texel(&self, w: V3) -> [usize; 2] {
        let ([x, y], [columns, rows]) = (self.place(w), [self.width, self.height()]);
        [((x * columns as f64) as usize).min(columns - 1), ((y * rows as f64) as usize).min(rows - 1)]
    }
    /// Weight per steradian of a direction.
    pub(crate) fn density(&self, w: V3) -> f64 {
        let [i, j] = self.texel(w);
        f64::from(self.weights[j * self.width + i]) * self.area(w) * (self.width * self.height()) as f64
    }
    /// What six steps of u weigh at most, per steradian.
    pub(crate) fn step(&self, p: V3, w: V3) -> f64 {
        let [low, high] = self.window(p);
        let (at, sizes) = (self.texel(w), [self.width as f64, self.height() as f64]);
        let part = |k: usize| {
            let [a, b] = [at[k], at[k] + 1].map(|i| i as f64 / sizes[k]);
            b.min(high[k]) - a.max(low[k])
        };
        6.0 / 16_777_216.0 / (part(0) * part(1)) * self.area(w)
    }
    /// Area of the map per steradian.
    pub(crate) fn area(&self, w: V3) -> f64 {
        // by differences of the map in two directions of the tangent plane
        let a = if w[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let u = cross(w, a);
        let u = times(u, 1.0 / length(u));
        let v = cross(w, u);
        let e = 1e-5;
        let difference = |d: V3| {
            let [a, b] = [e, -e].map(|e| self.place(add(w, times(d, e))));
            [(a[0] - b[0]) / (2.0 * e), (a[1] - b[1]) / (2.0 * e)]
        };
        let (a, b) = (difference(u), difference(v));
        (a[0] * b[1] - a[1] * b[0]).abs()
    }
}

pub(crate) fn portals_of(openings: &[Opening]) -> Vec<Portal> {
    openings.iter().map(|o| Portal::new(o.corner, o.s, o.t).unwrap()).collect()
}

/// Calls `run` with the portals.
pub(crate) fn with<T>(openings: &[Opening], run: impl FnOnce(&PortalEnvironment<'_>) -> T) -> T {
    let mut buffers: Vec<_> = openings.iter().map(|o| vec![0; PortalTable::buffer(o.width, o.height())]).collect();
    let both = openings.iter().zip(&mut buffers);
    let tables: Vec<_> = both.map(|(o, buffer)| PortalTable::build(&o.weights, o.width, buffer).unwrap()).collect();
    run(&PortalEnvironment::new(&portals_of(openings), &tables).unwrap())
}

/// Openings, and points that see something of them.
pub(crate) fn scenes() -> Vec<(&'static str, Vec<Opening>, Vec<V3>)> {
    let mut random = Random::new(5);
    let r = &mut random;
    let window = |r: &mut Random, size| Opening::new(r, [3.0, -1.0, 0.5], [0.0, 2.0, 0.0], [0.0, 0.0, 1.5], size);
    let near: Vec<V3> = vec![[0.0, 0.0, 1.0], [2.9, 0.3, 1.0], [2.0, -3.0, 4.0], [-20.0, 5.0, 0.0]];
    let skew = Opening::new(r, [1.0, 0.5, 2.0], [1.0, 0.2, 0.0], [0.4, 1.3, 0.2], [9, 14]);
    let below: Vec<V3> = vec![[1.2, 1.0, 0.0], [0.0, 0.0, 1.9], [4.0, -2.0, -1.0]];
    let three = vec![
        window(r, [16, 16]),
        Opening::new(r, [3.0, 1.5, 0.5], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5], [16, 16]),
        Opening::new(r, [-1.0, -1.0, 3.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [5, 30]),
    ];
    // one behind the other: every direction through the smaller passes both
    let behind = vec![window(r, [12, 12]), Opening::new(r, [4.0, -0.5, 0.8], [0.0, 1.0, 0.1], [0.0, 0.0, 0.7], [8, 8])];
    let one = Opening { weights: vec![2.0], width: 1, ..window(r, [1, 1]) };
    vec![
        ("window", vec![window(r, [16, 12])], near.clone()),
        ("fine", vec![window(r, [256, 128])], near.clone()),
        ("one texel", vec![one], near.clone()),
        ("skew", vec![skew], below),
        ("three", three, vec![[0.0, 0.0, 1.0], [2.5, 1.0, 2.5], [-0.5, 0.0, 2.8]]),
        ("one behind the other", behind, near),
    ]
}
