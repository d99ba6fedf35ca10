//! Sets of up to five lights of any kinds with any numbers, for any receiver: what is sampled, evaluated and emitted is finite, and the pdf of a
//! sample is that of its direction.

use super::Input;
use etendue::light::{Affine, EnvironmentMap, Rotated};
use etendue::lights::{Emitter, Lights, Number, Receiver, Side, Which};
use etendue::owned::OwnedEnvironment;
use etendue::{
    BilinearPatch, ConstantEnvironment, DirectionalLight, Disk, Frame, Line, Parallelogram, PointLight, Polygon, Real,
    Rectangle, Sphere, SpotLight, Sun, Triangle, Vec3,
};

fn vector<R: Real>(input: &mut Input<'_>) -> Vec3<R> {
    Vec3::lit([(); 3].map(|()| f64::from(input.number())))
}

fn emitter<R: Real<Scalar = R>>(input: &mut Input<'_>) -> (Emitter<R>, bool) {
    let v = |input: &mut Input<'_>| vector::<R>(input);
    let (a, b, c) = (v(input), v(input), v(input));
    let (x, y) = (R::lit(f64::from(input.number())), R::lit(f64::from(input.number())));
    let kind = input.below(16);
    let light: Emitter<R> = match kind {
        0 => Sphere::new(a, x).into(),
        1 => Triangle::new(a, b, c).into(),
        2 => Parallelogram::new(a, b, c).into(),
        3 => Rectangle::new(a, b, c).into(),
        4 => Disk::new(a, b, x).into(),
        5 => Polygon::new([a, b, c, v(input), v(input)]).into(),
        6 => BilinearPatch::new(a, b, c, v(input)).into(),
        7 => Line::new(a, b).into(),
        8 => Affine::new(Sphere::new(a, x), [b, c, v(input)], v(input)).into(),
        9 => Affine::new(Disk::new(a, b, x), [c, v(input), v(input)], v(input)).into(),
        10 => PointLight::new(a).into(),
        11 => SpotLight::new(a, b, [x, y]).into(),
        12 => DirectionalLight::new(a).into(),
        13 => Sun::new(a, x).into(),
        14 => ConstantEnvironment.into(),
        _ => {
            let weights = [(); 6].map(|()| input.unit());
            match OwnedEnvironment::new(&weights, 3, EnvironmentMap::Equirectangular) {
                Ok(sampler) => Rotated { sampler, frame: Frame::new(b.unit_and_length().0) }.into(),
                // without any light
                Err(_) => ConstantEnvironment.into(),
            }
        }
    };
    let light = match input.below(4) {
        0 => light.two_sided(),
        1 => light.facing(b),
        _ => light,
    };
    // vectors at random are no rectangle, and no flat polygon; a rounded direction of a patch, or of a line, does not determine the point
    (light, !matches!(kind, 3 | 5..=7))
}

fn check<R: Number>(input: &mut Input<'_>) {
    let count = 1 + input.below(5);
    let mut is_exact = Vec::new();
    let mut lights = Vec::new();
    for _ in 0..count {
        let (light, exact) = emitter::<R>(input);
        is_exact.push(exact);
        lights.push((light, R::lit(f64::from(input.number()))));
    }
    let set = Lights::new(lights).expect("five lights");
    let side = match input.below(3) {
        0 => Side::Surface(vector(input).unit_and_length().0),
        1 => Side::Both,
        _ => Side::None,
    };
    let at = set.at(Receiver { point: vector(input), side, on: None });
    let finite = |x: R| x.lane_f64(0).is_finite();
    let finite_vector = |v: Vec3<R>| v.to_array().into_iter().all(finite);
    let number = |input: &mut Input<'_>| R::lit(f64::from(input.unit()));
    for _ in 0..4 {
        let s = at.sample([(); 3].map(|()| number(input)));
        let is_whole = [s.distance, s.bound, s.pdf, s.pmf, s.factor, s.weight(), s.reach()].into_iter().all(finite);
        assert!(is_whole && [s.direction, s.point, s.normal].into_iter().all(finite_vector), "{s:?}");
        assert!(s.pdf.lane_f64(0) >= 0.0 && s.weight().lane_f64(0) >= 0.0 && s.reach().lane_f64(0) >= 0.0, "{s:?}");
        let pdf = at.pdf(s.which, s.direction);
        assert!(finite(pdf) && pdf.lane_f64(0) >= 0.0, "{s:?}: {pdf:?}");
        if !s.delta && s.pdf.lane_f64(0) > 0.0 && is_exact[s.which.light as usize] {
            assert!(pdf.lane_f64(0).to_bits() == s.pdf.lane_f64(0).to_bits(), "{s:?}: {pdf:?}");
        }
        let any = at.pdf(Which { light: u32::from(input.below(6)), part: u32::from(input.below(3)) }, vector(input));
        assert!(finite(any), "{any:?}");
        let scene = Sphere::new(vector(input), number(input));
        let ray = set.emit(u32::from(input.below(6)), [(); 4].map(|()| number(input)), scene);
        assert!([ray.origin, ray.direction, ray.normal].into_iter().all(finite_vector), "{ray:?}");
        assert!(finite(ray.pdf) && finite(ray.weight) && ray.pdf.lane_f64(0) >= 0.0, "{ray:?}");
    }
}

pub(super) fn set_of_lights(input: &mut Input<'_>) {
    if input.below(2) == 0 {
        check::<f32>(input);
    } else {
        check::<f64>(input);
    }
}
