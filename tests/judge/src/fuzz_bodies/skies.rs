//! The sky through portals.

use super::Input;
use crate::packets::{squares_of, vectors_of};
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
    for _ in 0..4 {
        let u = input.square();
        let s = sampler.sample(squares_of(&[u]));
        let w = s.direction;
        assert!(
            s.pdf >= 0.0 && s.pdf.is_finite() && w.length_squared().is_finite(),
            "{openings:?} {place:?} {u:?}: {s:?}"
        );
        assert_eq!((s.pdf > 0.0, sampler.pdf(w)), (s.emits, s.pdf), "{openings:?} {place:?} {u:?}");
        let eight = wide.sample(squares_of(&[u]));
        assert_eq!(
            (eight.pdf.lane(5).to_bits(), eight.direction.lane(5)),
            (s.pdf.to_bits(), w),
            "{openings:?} {place:?} {u:?}"
        );
        if are_plain && faces {
            assert!(s.pdf > 0.0, "a lost sample: {openings:?} {place:?} {u:?}");
        }
        if s.pdf > 0.0 {
            assert!(sky.sees(p, w), "{openings:?} {place:?} {u:?}");
            assert!((w.length_squared() - 1.0).abs() < 1e-6, "{openings:?} {place:?} {u:?}");
        }
        let back = sampler.invert(w);
        assert!([back.x, back.y].iter().all(|x| (0.0..1.0).contains(x)), "{openings:?} {place:?} {u:?}: {back:?}");
    }
    let normal = input.direction();
    let (above, wide_above) = (
        sky.by_radiance_above(p, vectors_of(|_| normal)),
        sky.by_radiance_above::<f32x8>(vectors_of(|_| place), vectors_of(|_| normal)),
    );
    let u = input.square();
    let s = above.sample(squares_of(&[u]));
    let w = s.direction;
    assert_eq!((s.pdf > 0.0, above.pdf(w)), (s.emits, s.pdf), "{openings:?} {place:?} {normal:?} {u:?}");
    assert!(
        s.pdf.is_finite() && (s.pdf == 0.0 || sampler.pdf(w) > 0.0),
        "{openings:?} {place:?} {normal:?} {u:?}: {s:?}"
    );
    let eight = wide_above.sample(squares_of(&[u]));
    assert_eq!((eight.pdf.lane(6).to_bits(), eight.direction.lane(6)), (s.pdf.to_bits(), w));
    let any = input.direction();
    let w: Vec3<f32> = vectors_of(|_| any);
    let pdf = sampler.pdf(w);
    assert!(pdf >= 0.0 && pdf.is_finite() && (pdf == 0.0 || sky.sees(p, w)), "{openings:?} {place:?} {any:?}");
    let back = sampler.invert(w);
    assert!([back.x, back.y].iter().all(|x| (0.0..1.0).contains(x)), "{openings:?} {place:?} {any:?}: {back:?}");
    assert_eq!(wide.pdf(vectors_of(|_| any)).lane(3).to_bits(), pdf.to_bits());
}
