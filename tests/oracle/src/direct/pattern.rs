//! Numbers that vary over a triangle.

/// What is beyond an edge of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// The picture again.
    Repeats,
    /// The picture again, every second time mirrored.
    Mirrors,
    /// The texel at the edge.
    Stays,
    /// 0.
    Ends,
}

/// Factors of u, v and 1 of both coordinates of a position.
pub type PositionMap = [[f64; 3]; 2];

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns and rows, at least 1.
    pub size: [usize; 2],
    /// Texels, row by row.
    pub texels: Vec<f64>,
    /// From (u, v) to the picture: (0, 0) is the outer corner of the first texel, (1, 1) that of the last.
    pub place: PositionMap,
    /// What is beyond the edges, across and down.
    pub beyond: [Beyond; 2],
    /// Whether values are linear between the middles of texels, or else constant over each.
    pub is_smooth: bool,
}

/// A number as a function of texture coordinates.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// The same everywhere.
    Constant(f64),
    /// A picture.
    Picture(Picture),
    /// One pattern in squares where ⌊s⌋ + ⌊t⌋ is even, the other one elsewhere.
    Board(Box<[Pattern; 2]>, PositionMap),
    /// The product of two patterns.
    Product(Box<[Pattern; 2]>),
    /// 1 less a pattern, but at least 0.
    Inverse(Box<Pattern>),
    /// a + (b − a) t.
    Mix(Box<[Pattern; 3]>),
}

/// A position, moved by this fraction of the terms of its sum.
fn position(place: &PositionMap, [u, v]: [f64; 2], lift: f64) -> [f64; 2] {
    place.map(|[a, b, c]| a * u + b * v + c + lift * ((a * u).abs() + (b * v).abs() + c.abs()))
}

impl Picture {
    /// The value of a texel, which may be beyond the edges.
    fn texel(&self, at: [f64; 2]) -> f64 {
        let mut index = [0; 2];
        for axis in 0..2 {
            let (n, i) = (self.size[axis] as f64, at[axis]);
            let again = i - n * (i / n).floor();
            index[axis] = match self.beyond[axis] {
                Beyond::Ends if i < 0.0 || i >= n => return 0.0,
                Beyond::Ends => i,
                Beyond::Stays => i.max(0.0).min(n - 1.0),
                Beyond::Repeats => again,
                Beyond::Mirrors if (i / n).floor().rem_euclid(2.0) == 0.0 => again,
                Beyond::Mirrors => n - 1.0 - again,
            } as usize;
        }
        self.texels[index[1] * self.size[0] + index[0]]
    }
    fn at(&self, uv: [f64; 2], lift: f64) -> f64 {
        let [s, t] = position(&self.place, uv, lift);
        let (x, y) = (s * self.size[0] as f64, t * self.size[1] as f64);
        if !self.is_smooth {
            return self.texel([x.floor(), y.floor()]);
        }
        // each texel is a hat that is two texels wide
        let (left, top) = ((x - 0.5).floor(), (y - 0.5).floor());
        let hat = |x: f64| 1.0 - x.abs();
        let around = [[left, top], [left + 1.0, top], [left, top + 1.0], [left + 1.0, top + 1.0]];
        around.iter().map(|&[i, j]| hat(x - i - 0.5) * hat(y - j - 0.5) * self.texel([i, j])).sum()
    }
}

impl Pattern {
    /// The value at texture coordinates, with positions moved by the fraction `lift`.
    pub(super) fn at(&self, uv: [f64; 2], lift: f64) -> f64 {
        match self {
            Self::Constant(x) => *x,
            Self::Picture(picture) => picture.at(uv, lift),
            Self::Board(of, place) => {
                let [s, t] = position(place, uv, lift).map(f64::floor);
                of[usize::from((s + t).rem_euclid(2.0) != 0.0)].at(uv, lift)
            }
            Self::Product(of) => of[0].at(uv, lift) * of[1].at(uv, lift),
            Self::Inverse(of) => (1.0 - of.at(uv, lift)).max(0.0),
            Self::Mix(of) => {
                let [a, b, t] = [0, 1, 2].map(|k| of[k].at(uv, lift));
                a + (b - a) * t
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_go_on_beyond_their_edges() {
        let texels = vec![1.0, 2.0, 4.0];
        let picture = |beyond, is_smooth| Picture {
            size: [3, 1],
            texels: texels.clone(),
            place: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            beyond: [beyond, Beyond::Stays],
            is_smooth,
        };
        let row = |beyond| {
            let picture = picture(beyond, false);
            (-4..7).map(|i| picture.at([(f64::from(i) + 0.5) / 3.0, 7.0], 0.0)).collect::<Vec<_>>()
        };
        assert_eq!(row(Beyond::Repeats), [4.0, 1.0, 2.0, 4.0, 1.0, 2.0, 4.0, 1.0, 2.0, 4.0, 1.0]);
        assert_eq!(row(Beyond::Mirrors), [4.0, 4.0, 2.0, 1.0, 1.0, 2.0, 4.0, 4.0, 2.0, 1.0, 1.0]);
        assert_eq!(row(Beyond::Stays), [1.0, 1.0, 1.0, 1.0, 1.0, 2.0, 4.0, 4.0, 4.0, 4.0, 4.0]);
        assert_eq!(row(Beyond::Ends), [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 4.0, 0.0, 0.0, 0.0, 0.0]);
        // the middle of the first texel, its outer edge, and half of the way to the second
        let at = |beyond, u: f64| picture(beyond, true).at([u, 0.3], 0.0);
        for (beyond, edge) in
            [(Beyond::Repeats, 2.5), (Beyond::Mirrors, 1.0), (Beyond::Stays, 1.0), (Beyond::Ends, 0.5)]
        {
            let found = [0.5 / 3.0, 0.0, 1.0 / 3.0].map(|u| at(beyond, u));
            assert!(found.iter().zip([1.0, edge, 1.5]).all(|(x, y)| (x - y).abs() < 1e-12), "{beyond:?}: {found:?}");
        }
    }
}
