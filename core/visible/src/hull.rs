//! Convex hulls of points, inflated by a radius.

use etendue::Vec3;

/// A point or a vector in double precision.
pub type V64 = Vec3<f64>;

/// Greatest number of corners.
pub(crate) const CORNERS: usize = 8;

/// Greatest magnitude of a coordinate.
pub(crate) fn magnitude(points: &[V64]) -> f64 {
    points.iter().fold(0.0, |m: f64, p| m.max(p.x.abs()).max(p.y.abs()).max(p.z.abs()))
}

/// The unit vector in a direction; not finite if there is none.
pub(crate) fn unit(v: V64) -> V64 {
    v * (1.0 / v.length())
}

/// A corner of a box by its index, whose bits choose the high side of each axis.
pub(crate) fn corner_of_box([low, high]: [V64; 2], k: usize) -> V64 {
    let of = |bit: usize, low: f64, high: f64| if k >> bit & 1 == 0 { low } else { high };
    V64::new(of(0, low.x, high.x), of(1, low.y, high.y), of(2, low.z, high.z))
}
/// The corners of each face of a box, in order around.
pub(crate) const FACES_OF_BOX: [[usize; 4]; 6] =
    [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];

/// All points within `radius` of the convex hull of some points.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hull {
    corners: [V64; CORNERS],
    count: usize,
    /// Inflation.
    pub(crate) radius: f64,
    /// Centre of a ball around the corners.
    pub(crate) center: V64,
    /// Radius of that ball and the inflation.
    pub(crate) extent: f64,
}

/// Points nearer to an edge than this fraction of its length count as this near: double precision is accurate enough even there.
const TOUCHING: f64 = 1e-6;

/// Each corner of a polygon with the next one.
pub(crate) fn edges(corners: &[V64]) -> impl Iterator<Item = (V64, V64)> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

impl Hull {
    /// The hull of 1 to [`CORNERS`] points.
    pub(crate) fn new(points: &[V64], radius: f64) -> Self {
        let mut corners = [V64::default(); CORNERS];
        corners[..points.len()].copy_from_slice(points);
        let sum = points.iter().fold(V64::default(), |sum, &p| sum + p);
        let center = sum * (1.0 / points.len() as f64);
        let mut hull = Self { corners, count: points.len(), radius: 0.0, center, extent: 0.0 };
        hull.inflate(radius);
        hull
    }
    /// Adds to the inflation.
    pub(crate) fn inflate(&mut self, by: f64) {
        self.radius += by;
        let ball = self.corners().iter().map(|&p| (p - self.center).length()).fold(0.0, f64::max);
        self.extent = ball * (1.0 + 1e-9) + self.radius;
    }
    /// By how much more the rounding of the ends of edges counts where a point of the hull sees an edge under nearly 180°: at least 1/sine
    /// of that angle, from 1 to 5 · 10⁵. Under less than 90°, which is what other edges and those without length count as, it is 1:
    /// angle/sine is at most π/2 there.
    pub(crate) fn stretch(&self, edges: impl Iterator<Item = (V64, V64)>) -> f64 {
        let of_edge = |(a, b): (V64, V64)| {
            let (edge, from) = (b - a, self.center - a);
            let size = edge.length();
            // inside of the sphere about an edge, the product of the distances to its ends is at most half of its square
            if (self.center - (a + b) * 0.5).length() - self.extent >= 0.5 * size || size == 0.0 {
                return 1.0;
            }
            let along = (from.dot(edge) / (size * size)).clamp(0.0, 1.0);
            let distance = (from - edge * along).length() - self.extent;
            (0.5 * size / distance.max(TOUCHING * size)).max(1.0)
        };
        edges.map(of_edge).fold(1.0, f64::max)
    }
    pub(crate) fn corners(&self) -> &[V64] {
        &self.corners[..self.count]
    }
    /// Least and greatest n·x of the corners.
    pub(crate) fn range(&self, n: V64) -> [f64; 2] {
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for &p in self.corners() {
            let along = n.dot(p);
            // a NaN spoils both
            range =
                [if along >= range[0] { range[0] } else { along }, if along <= range[1] { range[1] } else { along }];
        }
        range
    }
    /// Greatest n·x of the hull for a vector of at most unit length.
    pub(crate) fn support(&self, n: V64) -> f64 {
        self.range(n)[1] + self.radius
    }
}
