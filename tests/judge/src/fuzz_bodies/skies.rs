//! The sky through portals.

use super::Input;
use crate::packets::{squares_of, vectors_of};
use crate::properties;
use etendue::light::{Portal, PortalEnvironment, PortalTable};
use etendue::{LightSampler, Real, Vec3, f32x8};
use etendue_oracle::{cross, length, wide};

/// One to three portals of any place and shape, seen from anywhere: finite everywhere, and each sample is one that the pdf tells of.
pub(super) fn portals(input: &mut Input<'_>) {
    let mut vectors = Vec::new();
    let mut openings = Vec::new();
    let mut are_plain = true;
    for _ in 0..1 + input.below(3) {
        let [corner, s, t] = [(); 3].map(|()| {
            let v = input.vector(&vectors);
            vectors.push(v);
            v
        });
        let weights = input.weights(30);
        let width = 1 + input.below(weights.len() as u8) as usize;
        let weights = weights[..weights.len() / width * width].to_vec();
        let (a, b) = (length(wide(s)), length(wide(t)));
        let ordinary = |x: f64| (1e-3..1e3).contains(&x);
        are_plain &= ordinary(a) && ordinary(b) && length(cross(wide(s), wide(t))) > 0.3 * a * b;
        are_plain &= length(wide(corner)) < 1e3;
        openings.push((corner, s, t, weights, width));
    }
    let mut buffers: Vec<_> = openings
        .iter()
        .map(|(_, _, _, weights, width)| vec![0; PortalTable::buffer(*width, weights.len() / width)])
        .collect();
    let (mut all, mut tables) = (Vec::new(), Vec::new());
    for ((corner, s, t, weights, width), buffer) in openings.iter().zip(&mut buffers) {
        let Ok(portal) = Portal::new(*corner, *s, *t) else {
            assert!(!are_plain, "{openings:?}");
            return;
        };
        let Ok(table) = PortalTable::build(weights, *width, buffer) else {
            assert!(weights.iter().all(|w| *w == 0.0), "{weights:?}");
            return;
        };
        all.push(portal);
        tables.push(table);
    }
    let sky = PortalEnvironment::new(&all, &tables).expect("few portals");
    let place = input.vector(&vectors);
    are_plain &= length(wide(place)) < 1e3;
    let p: Vec3<f32> = vectors_of(|_| place);
    let (sampler, wide) = (sky.by_radiance(p), sky.by_radiance::<f32x8>(vectors_of(|_| place)));
    let faces = all.iter().any(|portal| portal.faces(p));
    let said = (&openings, place);
    let sound = |one: &dyn LightSampler<f32>, eight: &dyn LightSampler<f32x8>, u: [f32; 2]| {
        properties::total_at(&said, [1.0 - 5e-7, 1.0 + 5e-7], one, u);
        properties::same(&said, &[u; 8], &[one; 8], eight, "a packet");
        let s = one.sample(squares_of(&[u]));
        assert_eq!((s.pdf > 0.0, one.pdf(s.direction)), (s.emits, s.pdf), "{said:?} {u:?}");
        s
    };
    for _ in 0..4 {
        let u = input.square();
        let s = sound(&sampler, &wide, u);
        assert!(s.pdf > 0.0 || !(are_plain && faces), "a lost sample: {said:?} {u:?}");
        assert!(s.pdf == 0.0 || sky.sees(p, s.direction), "{said:?} {u:?}");
    }
    let normal = input.direction();
    let (above, wide_above) = (
        sky.by_radiance_above(p, vectors_of(|_| normal)),
        sky.by_radiance_above::<f32x8>(vectors_of(|_| place), vectors_of(|_| normal)),
    );
    let u = input.square();
    let s = sound(&above, &wide_above, u);
    assert!(s.pdf == 0.0 || sampler.pdf(s.direction) > 0.0, "{said:?} {normal:?} {u:?}: {s:?}");
    let any = input.direction();
    let w: Vec3<f32> = vectors_of(|_| any);
    let pdf = sampler.pdf(w);
    assert!(pdf >= 0.0 && pdf.is_finite() && (pdf == 0.0 || sky.sees(p, w)), "{said:?} {any:?}");
    let back = sampler.invert(w);
    assert!([back.x, back.y].iter().all(|x| (0.0..1.0).contains(x)), "{said:?} {any:?}: {back:?}");
    assert_eq!(wide.pdf(vectors_of(|_| any)).lane(3).to_bits(), pdf.to_bits());
}
