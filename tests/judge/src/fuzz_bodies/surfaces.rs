//! Surfaces in space.

use super::Input;
use crate::fixture::Subject;
use crate::fixtures::PatchSurface;
use crate::properties;

/// A length from 2⁻²⁰ to 2²⁰, and how far away a thing of that size may be: up to a thousand times its size.
fn units(input: &mut Input<'_>) -> (f32, f32) {
    let size = (f32::from(input.below(41)) - 20.0).exp2();
    (size * (0.5 + input.unit()), size * f32::from(input.below(11)).exp2())
}
fn place(input: &mut Input<'_>, reach: f32) -> [f32; 3] {
    [(); 3].map(|()| input.ordinary() * 0.5 * reach)
}

/// Bilinear patches of any numbers, and ones of ordinary size and distance, for which all properties hold. The ordinary ones are slightly twisted near-squares, convex as seen along the normal of their middle.
pub(super) fn patch_surface(input: &mut Input<'_>) {
    let p = input.vector(&[]);
    let u = input.vector(&[p]);
    let v = input.vector(&[p, u]);
    let any = PatchSurface { p, u, v, w: input.vector(&[u, v]) };
    let (size, reach) = units(input);
    let (a, b) = etendue_oracle::basis(input.direction().map(f64::from));
    let n = etendue_oracle::cross(a, b);
    let mut mix = |x: f32, y: f32| -> [f32; 3] {
        let shear = 0.1 * input.ordinary();
        let lift = 0.1 * input.ordinary();
        core::array::from_fn(|k| {
            let [a, b, n] = [a[k], b[k], n[k]].map(|x| x as f32);
            size * ((x + shear * y) * a + (y + shear * x) * b + lift * n)
        })
    };
    let (u, v, w) = (mix(1.0, 0.0), mix(0.0, 1.0), mix(1.0, 1.0));
    let fair = PatchSurface { p: place(input, reach), u, v, w };
    let u = input.square();
    properties::any_bits(&any, u);
    properties::pointwise(&Subject::new(&fair), u, &mut input.points());
}
