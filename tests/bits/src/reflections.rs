//! The light that rough surfaces reflect.

use crate::figures::{Figures, List, Routine};
use crate::lights::sampler;
use etendue::light::Polygon;
use etendue::reflection::Reflection;
use etendue::{Parallelogram, Real, Sphere, Triangle, Vec3, Warp};
use etendue_judge::generators::{self, Random};
use etendue_judge::packets::{lanes_of, squares_of, vectors_of};

/// Lobes of surfaces, and lights of ordinary and extreme places.
struct Rough;

impl Routine for Rough {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let mut random = Random::new(960);
        figures.packets::<R>(20 * Figures::MOST, |_, lanes| {
            let places: Vec<_> = (0..R::LANES)
                .map(|_| {
                    let extreme = random.word().is_multiple_of(4);
                    let p = if extreme { generators::nasty(&mut random) } else { [0.0, 0.1, 0.2] };
                    let vectors = [(); 6].map(|()| random.direction().map(|x| x as f32));
                    (p, vectors, [random.unit(), random.unit()], random.unit())
                })
                .collect();
            let vector = |k: usize| vectors_of::<R>(|i| places[i].1[k]);
            let (normal, view, a, b, c) = (vector(0), vector(1), vector(2), vector(3), vector(4));
            let p = vectors_of(|i| places[i].0);
            let us: Vec<_> = places.iter().map(|place| place.2).collect();
            let ws: Vec<_> = places.iter().map(|place| place.1[5]).collect();
            let size = lanes_of::<R>(|i| places[i].3.into());
            let lobe = Reflection::new(size * size, normal, view);
            lanes.reals([lobe.albedo(), lobe.schlick(), lobe.pdf(a), lobe.sphere(a - p, size)]);
            lanes.vector(lobe.sample(squares_of(&us)));
            lanes.pair(lobe.invert(a));
            sampler(lanes, &Triangle { v0: a, e1: b, e2: c }.by_reflection(p, &lobe), &us, &ws);
            sampler(lanes, &Parallelogram::new(a, b, c).by_reflection(p, &lobe), &us, &ws);
            sampler(lanes, &Polygon::new([a, b, c]).by_reflection(p, &lobe), &us, &ws);
        });
    }
}

/// Spheres of all sizes, some of which the horizon cuts.
struct Balls;

impl Routine for Balls {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let mut random = Random::new(961);
        figures.packets::<R>(20 * Figures::MOST, |_, lanes| {
            let places: Vec<_> = (0..R::LANES)
                .map(|_| {
                    let extreme = random.word().is_multiple_of(4);
                    let center =
                        if extreme { generators::nasty(&mut random) } else { random.direction().map(|x| x as f32) };
                    let vectors = [(); 3].map(|()| random.direction().map(|x| x as f32));
                    (center, random.magnitude(1e-6, 1.5), vectors, [random.unit(), random.unit()], random.unit())
                })
                .collect();
            let vector = |k: usize| vectors_of::<R>(|i| places[i].2[k]);
            let us: Vec<_> = places.iter().map(|place| place.3).collect();
            let ws: Vec<_> = places.iter().map(|place| place.2[2]).collect();
            let rough = lanes_of::<R>(|i| places[i].4.into());
            let lobe = Reflection::new(rough * rough, vector(0), vector(1));
            let light = Sphere::new(vectors_of(|i| places[i].0), lanes_of::<R>(|i| places[i].1));
            sampler(lanes, &light.by_reflection(Vec3::default(), &lobe), &us, &ws);
        });
    }
}

pub(crate) fn add(list: &mut List<'_>) {
    list.add("reflection", &Rough);
    list.add("reflection/sphere", &Balls);
}
