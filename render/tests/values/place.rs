//! Transforms as text and as numbers.

use etendue_oracle::{V3, along, cross, dot, unit};

/// A transform, as a pbrt file writes it and in double precision.
#[derive(Clone, Debug)]
pub(super) struct NamedTransform {
    pub(super) name: String,
    pub(super) text: String,
    /// Where the axes go.
    axes: [V3; 3],
    shift: V3,
}

impl NamedTransform {
    pub(super) fn new() -> Self {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Self { name: "as it is".into(), text: String::new(), axes, shift: [0.0; 3] }
    }
    fn then(self, name: &str, text: &str, axes: [V3; 3], shift: V3) -> Self {
        Self {
            name: name.to_owned(),
            text: format!("{} {text}", self.text),
            axes: axes.map(|axis| self.vector(axis)),
            shift: self.point(shift),
        }
    }
    pub(super) fn translate(self, by: V3) -> Self {
        let axes = Self::new().axes;
        self.then("moved", &format!("Translate {} {} {}", by[0], by[1], by[2]), axes, by)
    }
    pub(super) fn scale(self, by: V3) -> Self {
        let axes = [[by[0], 0.0, 0.0], [0.0, by[1], 0.0], [0.0, 0.0, by[2]]];
        self.then(&format!("scaled by {by:?}"), &format!("Scale {} {} {}", by[0], by[1], by[2]), axes, [0.0; 3])
    }
    pub(super) fn rotate(self, degrees: f64, about: V3) -> Self {
        let (n, (sin, cos)) = (unit(about), degrees.to_radians().sin_cos());
        let turned = |v: V3| {
            let parallel = n.map(|x| x * dot(n, v));
            let rest: V3 = std::array::from_fn(|k| v[k] - parallel[k]);
            along(along(parallel, rest, cos), cross(n, v), sin)
        };
        let axes = Self::new().axes.map(turned);
        let text = format!("Rotate {degrees} {} {} {}", about[0], about[1], about[2]);
        self.then(&format!("turned by {degrees}"), &text, axes, [0.0; 3])
    }
    pub(super) fn vector(&self, v: V3) -> V3 {
        std::array::from_fn(|k| (0..3).map(|i| self.axes[i][k] * v[i]).sum())
    }
    pub(super) fn point(&self, p: V3) -> V3 {
        along(self.vector(p), self.shift, 1.0)
    }
    fn determinant(&self) -> f64 {
        let [a, b, c] = self.axes;
        dot(a, cross(b, c))
    }
    /// The rows of the inverse of the linear part, times the determinant.
    fn cofactors(&self) -> [V3; 3] {
        let [a, b, c] = self.axes;
        [cross(b, c), cross(c, a), cross(a, b)]
    }
    /// The unit normal of a transformed surface with this normal.
    pub(super) fn normal(&self, n: V3) -> V3 {
        let (rows, sign) = (self.cofactors(), self.determinant().signum());
        unit(std::array::from_fn(|k| sign * (0..3).map(|i| rows[i][k] * n[i]).sum::<f64>()))
    }
    pub(super) fn inverse_vector(&self, v: V3) -> V3 {
        self.cofactors().map(|row| dot(row, v) / self.determinant())
    }
    pub(super) fn inverse_point(&self, p: V3) -> V3 {
        self.inverse_vector(along(p, self.shift, -1.0))
    }
    /// What a file has in this place.
    pub(super) fn holds(&self, what: &str) -> String {
        format!("AttributeBegin{} {what} AttributeEnd\n", self.text)
    }
}

/// Similarities after `base`.
pub(super) fn similar(base: &NamedTransform) -> Vec<NamedTransform> {
    let at = || base.clone();
    vec![
        NamedTransform { name: "as it is".into(), ..at() },
        at().translate([0.3, -0.2, 0.1]),
        at().scale([2.0; 3]),
        at().scale([-1.0, 1.0, 1.0]),
        at().scale([1.0, 1.0, -1.0]),
        at().rotate(40.0, [1.0, 2.0, 3.0]),
        NamedTransform {
            name: "moved, turned, mirrored".into(),
            ..at().translate([-0.1, 0.2, 0.3]).rotate(-15.0, [1.0, 0.0, 1.0]).scale([-1.5, 1.5, 1.5])
        },
    ]
}

/// Transforms of every kind after `base`.
pub(super) fn all(base: &NamedTransform) -> Vec<NamedTransform> {
    let at = || base.clone();
    let mut all = similar(base);
    all.extend([
        at().scale([1.0, 2.0, 0.5]),
        at().scale([-1.0, 2.0, 0.5]),
        NamedTransform {
            name: "sheared".into(),
            ..at().rotate(30.0, [0.0, 1.0, 0.5]).scale([0.5, 1.5, 1.0]).rotate(20.0, [1.0, 0.0, 0.0])
        },
    ]);
    all
}
