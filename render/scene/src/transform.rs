//! Affine maps in f64, for the current transformation matrix of a scene file.

/// The affine map `p ↦ linear · p + shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform {
    /// Rows of the linear part.
    pub(super) linear: [[f64; 3]; 3],
    /// The image of the origin.
    pub(super) shift: [f64; 3],
}

/// The difference `a − b`.
pub(super) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The sum `a + b`.
pub(super) fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// The product `s a`.
pub(super) fn scaled(a: [f64; 3], s: f64) -> [f64; 3] {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// Dot product.
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Cross product.
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Euclidean length.
pub(super) fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// `a` scaled to length 1; `None` if its length is zero or not finite.
pub(super) fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    // divided by the greatest component first, so that the squares neither overflow nor underflow
    let greatest = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let b = a.map(|x| x / greatest);
    let b = scaled(b, 1.0 / length(b));
    b.iter().all(|x| x.is_finite()).then_some(b)
}

/// 1 − cosθ of an angle in radians, without the difference.
pub(super) fn one_minus_cos(angle: f64) -> f64 {
    2.0 * libm::sin(0.5 * angle).powi(2)
}

impl Transform {
    /// The identity.
    pub(super) const IDENTITY: Transform =
        Transform { linear: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], shift: [0.0; 3] };

    /// Translation by `d`.
    pub(super) fn translate(d: [f64; 3]) -> Self {
        Transform { shift: d, ..Self::IDENTITY }
    }

    /// Scale along the axes.
    pub(super) fn scale(s: [f64; 3]) -> Self {
        Transform { linear: [[s[0], 0.0, 0.0], [0.0, s[1], 0.0], [0.0, 0.0, s[2]]], shift: [0.0; 3] }
    }

    /// Right-handed rotation about `axis`; `None` if the axis has no direction.
    pub(super) fn rotate(degrees: f64, axis: [f64; 3]) -> Option<Self> {
        let a = unit(axis)?;
        let (sin, cos) = libm::sincos(degrees.to_radians());
        // cos · I + (1 − cos) · a aᵀ + sin · [a]×
        let outer = |i: usize, j: usize| (1.0 - cos) * a[i] * a[j];
        let linear = [
            [outer(0, 0) + cos, outer(0, 1) - sin * a[2], outer(0, 2) + sin * a[1]],
            [outer(1, 0) + sin * a[2], outer(1, 1) + cos, outer(1, 2) - sin * a[0]],
            [outer(2, 0) - sin * a[1], outer(2, 1) + sin * a[0], outer(2, 2) + cos],
        ];
        Some(Transform { linear, shift: [0.0; 3] })
    }

    /// World space to the left-handed camera space at `eye`: x right, y up, z towards `target`. `None` if the view is not defined.
    pub(super) fn look_at(eye: [f64; 3], target: [f64; 3], up: [f64; 3]) -> Option<Self> {
        let forward = unit(sub(target, eye))?;
        let right = unit(cross(unit(up)?, forward))?;
        let linear = [right, cross(forward, right), forward];
        let shift = linear.map(|row| -dot(row, eye));
        Some(Transform { linear, shift })
    }

    /// The map of the 16 numbers of `Transform`, by columns; `None` if it is not affine. The last number divides all others.
    pub(super) fn from_columns(m: &[f64; 16]) -> Option<Self> {
        let weight = m[15];
        let affine = [m[3], m[7], m[11]] == [0.0; 3] && weight != 0.0 && weight.is_finite();
        let row = |i: usize| [m[i], m[4 + i], m[8 + i]].map(|x| x / weight);
        affine.then(|| Transform { linear: [row(0), row(1), row(2)], shift: [m[12], m[13], m[14]].map(|x| x / weight) })
    }

    /// The composition that applies `other` first, then `self`.
    pub(super) fn after(&self, other: &Transform) -> Self {
        let column = |j: usize| self.vector([other.linear[0][j], other.linear[1][j], other.linear[2][j]]);
        let (x, y, z) = (column(0), column(1), column(2));
        let linear = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
        Transform { linear, shift: self.point(other.shift) }
    }

    /// The image of a point.
    pub(super) fn point(&self, p: [f64; 3]) -> [f64; 3] {
        add(self.vector(p), self.shift)
    }

    /// The image of a vector.
    pub(super) fn vector(&self, v: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.linear;
        [dot(x, v), dot(y, v), dot(z, v)]
    }

    /// The unit vector along the image of a vector; `None` if that is so short, at most `least` times as long as it might be, that it may be
    /// rounding noise.
    pub(super) fn direction(&self, v: [f64; 3], least: f64) -> Option<[f64; 3]> {
        let greatest = |numbers: &[f64]| numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let image = self.vector(v);
        let most = greatest(self.linear.as_flattened()) * greatest(&v);
        if greatest(&image) > least * most { unit(image) } else { None }
    }

    /// Takes normals to those of the transformed surface, of length 1, on the side that this has; those that are not finite become 0.
    pub(super) fn normals(&self) -> impl Fn([f64; 3]) -> [f64; 3] + use<> {
        // the inverse transpose, but for its length: the rows are cross products of the others
        let [a, b, c] = self.linear;
        let sign = if self.determinant() < 0.0 { -1.0 } else { 1.0 };
        let rows = [cross(b, c), cross(c, a), cross(a, b)].map(|row| scaled(row, sign));
        move |n| unit(rows.map(|row| dot(row, n))).unwrap_or([0.0; 3])
    }

    /// The determinant of the linear part: negative if the map swaps handedness.
    pub(super) fn determinant(&self) -> f64 {
        dot(self.linear[0], cross(self.linear[1], self.linear[2]))
    }

    /// Whether every entry is finite.
    pub(super) fn is_finite(&self) -> bool {
        self.linear.iter().flatten().chain(&self.shift).all(|x| x.is_finite())
    }

    /// The inverse; `None` if the map is singular to the precision of f64.
    pub(super) fn inverse(&self) -> Option<Self> {
        let [a, b, c] = self.linear;
        let det = self.determinant();
        // |det| ≤ the product of the row lengths, with equality for orthogonal rows; likewise for columns.
        let column = |j: usize| length([a[j], b[j], c[j]]);
        let bound = (length(a) * length(b) * length(c)).min(column(0) * column(1) * column(2));
        if det.abs() <= 1e-14 * bound {
            return None;
        }
        let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
        let row = |i: usize| [bc[i] / det, ca[i] / det, ab[i] / det];
        let mut inverse = Transform { linear: [row(0), row(1), row(2)], shift: [0.0; 3] };
        inverse.shift = inverse.vector(self.shift).map(|x| -x);
        inverse.is_finite().then_some(inverse)
    }

    /// Rows of the orthogonal matrix from world space to the space of a similarity, in single precision; `None` for another map.
    pub(super) fn axes(&self) -> Option<[[f32; 3]; 3]> {
        let factor = self.similarity()?;
        // the inverse of an orthogonal matrix is its transpose
        Some(std::array::from_fn(|i| std::array::from_fn(|j| (self.linear[j][i] / factor) as f32)))
    }

    /// The scale factor of a similarity (rotation, uniform scale, reflection); `None` if lengths differ by more than 1 in 10⁵.
    pub(super) fn similarity(&self) -> Option<f64> {
        let column = |j: usize| [self.linear[0][j], self.linear[1][j], self.linear[2][j]];
        let (x, y, z) = (column(0), column(1), column(2));
        let factor = libm::cbrt(self.determinant().abs());
        let near = |value: f64, wanted: f64| (value - wanted).abs() <= 2e-5 * factor * factor;
        let lengths = [x, y, z].iter().all(|&v| near(dot(v, v), factor * factor));
        let angles = near(dot(x, y), 0.0) && near(dot(y, z), 0.0) && near(dot(z, x), 0.0);
        (factor > 0.0 && lengths && angles).then_some(factor)
    }
}
