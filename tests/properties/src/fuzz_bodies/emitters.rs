//! Lights that emit other than evenly: profiles, projected images, and spreads.

use super::Input;
use crate::properties::{squares_of, vectors_of};
use etendue::light::{
    EnvironmentMap, ImageEnvironment, LuminousOpening, Profile, ProfileError, ProjectedImage, Projector, Spread,
};
use etendue::{Disk, LightSampler, Parallelogram, Rectangle, SpotLight, Vec3, Warp, f32x8};

/// One of three kinds of light, of any numbers.
pub(super) fn emitters(input: &mut Input<'_>) {
    match input.below(3) {
        0 => profile(input),
        1 => projected(input),
        _ => spread(input),
    }
}

/// Angles that are often valid.
fn angles(input: &mut Input<'_>, low: f32, high: f32) -> Vec<f32> {
    let mut angles: Vec<f32> = (0..input.below(6)).map(|_| low + (high - low) * input.unit()).collect();
    angles.extend([low, high]);
    angles.sort_by(f32::total_cmp);
    angles.dedup();
    match input.below(8) {
        0 => angles.reverse(),
        1 => angles.truncate(1),
        2 => angles[0] = input.number(),
        3 => angles[0] = f32::NAN,
        _ => {}
    }
    angles
}

/// Spot lights and flat lights with a profile: no density and no factor is infinite or below 0, in all lanes alike.
fn lamps(input: &mut Input<'_>, profile: &Profile<'_>) {
    let axis = input.direction();
    let point = input.vector(&[]);
    let cones = [input.number(), input.number()];
    let spot = |lane: bool| {
        let light = SpotLight {
            position: vectors_of::<f32x8>(|_| [0.5, -1.0, 0.25]),
            axis: vectors_of(|_| axis),
            one_minus_cos_inner: f32x8::splat(cones[0]),
            one_minus_cos_outer: f32x8::splat(cones[1]),
        };
        let sample =
            light.by_profile(vectors_of(|i| if lane || i == 3 { point } else { axis }), |w| profile.intensity(w));
        sample.sample(squares_of(&[[0.5; 2]; 8])).pdf.as_array()[3]
    };
    let pdf = spot(true);
    assert!(pdf >= 0.0 && pdf.is_finite(), "{pdf} along {axis:?} from {point:?}, {cones:?}");
    assert_eq!(pdf.to_bits(), spot(false).to_bits());
    // a sum over many directions
    if input.below(64) != 0 {
        return;
    }
    let normal = axis.map(f64::from).into();
    let Some(opening) = LuminousOpening::<f32>::new(normal, input.below(2) == 1, |w: Vec3<f32x8>| profile.intensity(w))
    else {
        return;
    };
    let any = input.direction();
    let w: Vec3<f32> = vectors_of(|_| any);
    let factor = opening.factor(w.dot(vectors_of(|_| axis)), profile.intensity(w));
    assert!(
        opening.gain > 0.0 && factor >= 0.0 && factor.is_finite(),
        "{factor} by {opening:?} along {w:?} from {axis:?}"
    );
}

/// Tables that are no profile are refused; others have finite values between those of the table, and their emission can be drawn.
fn profile(input: &mut Input<'_>) {
    let [low, high] = [[0.0, 180.0], [0.0, 90.0], [90.0, 180.0], [30.0, 31.0]][input.below(4) as usize];
    let polar = angles(input, low, high);
    let [low, high] = [[0.0, 360.0], [-90.0, 90.0], [-270.0, 90.0]][input.below(3) as usize];
    let azimuth = angles(input, low, high);
    let mut values: Vec<f32> = (0..polar.len() * azimuth.len()).map(|_| input.weight()).collect();
    if input.below(6) == 0 {
        values[0] = -input.number();
    }
    let ascend = |angles: &[f32]| angles.iter().zip(&angles[1..]).all(|(a, b)| a < b);
    let [first, last] = [azimuth[0], azimuth[azimuth.len() - 1]];
    let is_turn = first > -360.0 && first <= 0.0 && last - first <= 360.0;
    let error = if polar.len() < 2 {
        Some(ProfileError::Length)
    } else if !(polar.iter().all(|x| (0.0..=180.0).contains(x)) && ascend(&polar) && ascend(&azimuth) && is_turn) {
        Some(ProfileError::Angle)
    } else if values.iter().any(|x| !(0.0..=1e37).contains(x)) {
        Some(ProfileError::Value)
    } else {
        None
    };
    let built = Profile::new(&polar, &azimuth, &values);
    assert_eq!(built.as_ref().err().copied(), error, "{polar:?} {azimuth:?} {values:?}");
    let Ok(profile) = built else { return };
    let greatest = values.iter().fold(0.0_f32, |most, &x| most.max(x));
    let power = profile.power();
    assert!((0.0..=f64::from(greatest) * 12.6).contains(&power), "{power} of {greatest}");
    lamps(input, &profile);
    let (width, mut means) = (3, [0.0; 15]);
    profile.means(width, &mut means).unwrap_or_else(|error| panic!("{error}"));
    assert!(means.iter().all(|mean| (0.0..=greatest * 1.000_001 + 2e-38).contains(mean)), "{means:?} of {greatest}");
    let mut buffer = [0.0; ImageEnvironment::buffer(3, 5)];
    let emission = ImageEnvironment::build(&means, width, EnvironmentMap::Equirectangular, &mut buffer).ok();
    assert!(emission.is_some() || power < 1e-36, "{power}: {means:?}");
    for _ in 0..4 {
        let any = [input.direction(), input.vector(&[])][input.below(2) as usize];
        let w: Vec3<f32> = vectors_of(|_| any);
        let value = profile.intensity(w);
        assert!((0.0..=greatest * 1.000_001).contains(&value), "{value} of {greatest} at {any:?}");
        let eight = profile.intensity::<f32x8>(vectors_of(|_| any));
        assert_eq!(eight.as_array()[6].to_bits(), value.to_bits());
        if let Some(emission) = &emission {
            let drawn = emission.draw::<f32>(squares_of(&[input.square()]));
            assert!(drawn.light.pdf > 0.0 && drawn.light.pdf.is_finite());
        }
    }
}

/// Any tangents and weights: results are finite, and places and directions agree.
fn projected(input: &mut Input<'_>) {
    let tan_half = [input.weight(), input.weight()];
    let projector = Projector { tan_half };
    let weights = input.weights(30);
    let width = 1 + input.below(weights.len() as u8) as usize;
    let height = weights.len() / width;
    let weights = &weights[..width * height];
    let mut buffer = vec![0.0; ProjectedImage::buffer(width, height)];
    let image = ProjectedImage::build(projector, weights, width, &mut buffer).ok();
    assert!((0.0..=1.0).contains(&projector.cos_cone()), "{tan_half:?}");
    let fair = tan_half.iter().all(|t| (1e-3..1e3).contains(t));
    for _ in 0..4 {
        let (u, any) = (squares_of::<f32>(&[input.square()]), input.vector(&[]));
        let w: Vec3<f32> = vectors_of(|_| any);
        let (uv, inside) = projector.place(w);
        assert!([uv.x, uv.y].iter().all(|x| (0.0..1.0).contains(x)), "{tan_half:?} at {any:?}: {uv:?} {inside}");
        let (eight, _) = projector.place::<f32x8>(vectors_of(|_| any));
        assert_eq!((eight.x.as_array()[2], eight.y.as_array()[5]), (uv.x, uv.y));
        let Some(image) = &image else { continue };
        let pdf = image.pdf(w);
        assert!(pdf >= 0.0 && pdf.is_finite(), "{tan_half:?} at {any:?}: {pdf}");
        let back = image.invert(w);
        assert!([back.x, back.y].iter().all(|x| (0.0..1.0).contains(x)), "{back:?}");
        let w = image.sample(u);
        if fair {
            let (uv, inside) = projector.place(w);
            let edge = [uv.x, uv.y].iter().any(|x| !(1e-3..0.999).contains(x));
            assert!(inside || edge, "{tan_half:?} at {u:?}: {w:?}");
            assert!((w.length() - 1.0).abs() < 1e-6 && w.z >= projector.cos_cone(), "{tan_half:?} at {u:?}: {w:?}");
        }
    }
}

/// Lights, points and spreads of any numbers: results are finite, in every lane the same, and a part is no larger than the light.
fn spread(input: &mut Input<'_>) {
    let spread = Spread::<f32>::new(3.2 * f64::from(input.unit()));
    let p = input.vector(&[]);
    let a = input.vector(&[p]);
    let b = input.vector(&[a, p]);
    let c = input.vector(&[a, b]);
    let (n, radius, u) = (input.direction(), input.number(), input.square());
    let one = |v: [f32; 3]| -> Vec3<f32> { vectors_of(|_| v) };
    let eight = |v: [f32; 3]| -> Vec3<f32x8> { vectors_of(|_| v) };
    let factor = spread.attenuation(one(n), one(input.direction()));
    assert!(factor >= 0.0 && factor.is_finite(), "{factor}");
    let wide = Spread::splat(spread);
    let check = |narrow: &dyn LightSampler<f32>, packet: &dyn LightSampler<f32x8>| {
        let s = narrow.sample(squares_of(&[u]));
        let finite = [s.pdf, s.distance, s.direction.x, s.direction.y, s.direction.z, s.uv.x, s.uv.y, s.weight()];
        assert!(finite.iter().all(|x| x.is_finite()) && s.pdf >= 0.0, "{s:?}");
        assert_eq!(packet.sample(squares_of(&[u])).pdf.as_array()[3].to_bits(), s.pdf.to_bits());
    };
    let (light, lights) =
        (Parallelogram::new(one(a), one(b), one(c)), Parallelogram::new(eight(a), eight(b), eight(c)));
    check(&light.by_spread(one(p), &spread), &lights.by_spread(eight(p), &wide));
    let part = light.visible_part(one(p), &spread);
    assert!(part.edge_s.max_abs() <= light.edge_s.max_abs() && part.edge_t.max_abs() <= light.edge_t.max_abs());
    let (light, lights) = (Rectangle::new(one(a), one(b), one(c)), Rectangle::new(eight(a), eight(b), eight(c)));
    check(&light.by_spread(one(p), &spread), &lights.by_spread(eight(p), &wide));
    let (light, lights) = (Disk::new(one(a), one(n), radius), Disk::new(eight(a), eight(n), f32x8::splat(radius)));
    check(&light.by_spread(one(p), &spread), &lights.by_spread(eight(p), &wide));
}
