//! Batches against the core: the same bits with the instructions of every level, for any count, at any alignment, for any numbers.

mod every;

use etendue::light::{EnvironmentMap, ImageEnvironment, PortalTable};
use etendue::listed::warp::Coordinates;
use etendue::real::SAME_BITS;
use etendue::reflection::Reflection;
use etendue::select::{LightBound, LightChoice, LightTree, Node8};
use etendue::sequence::Independent;
use etendue::{LightSample, LightSampler, Vec2, Vec3, Warp};
use etendue_batch::memory::{ImageMemory, PortalMemory, PortalShape, PortalSums, TreeMemory};
use etendue_batch::technique::ImageByRadiance;
use etendue_batch::*;
use every::Visitor;

/// Less than a packet, whole packets, and what is left of them.
const COUNTS: [usize; 9] = [0, 1, 2, 7, 8, 15, 16, 17, 100];

fn levels() -> Vec<Batch> {
    // without the feature `same-bits`, the others round a product and a sum once, and the build may not
    let of_build = |level: &Level| SAME_BITS || *level == Level::Build;
    let levels: Vec<_> =
        [Level::Build, Level::V3, Level::V4].into_iter().filter(of_build).filter_map(Batch::at).collect();
    println!("{levels:?}");
    levels
}

/// Calls `f` for each level, with numbers in [0, 1) and hostile ones, for each count.
fn each(mut f: impl FnMut(Batch, &Columns, usize)) {
    let inputs = [false, true].map(Columns::new);
    for (batch, input) in levels().into_iter().flat_map(|batch| inputs.each_ref().map(|input| (batch, input))) {
        COUNTS.into_iter().for_each(|n| f(batch, input, n));
    }
}

/// Columns of numbers: uniform in [0, 1), or hostile ones.
struct Columns(Vec<Vec<f32>>);

impl Columns {
    fn new(hostile: bool) -> Self {
        const ODD: [f32; 12] = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            0.999_999_94,
            f32::MIN_POSITIVE,
            1e-45,
            f32::MAX,
            f32::MIN,
            f32::INFINITY,
            f32::NAN,
            1e20,
        ];
        let number = |k: u32, i: u32| {
            let [x, y, ..] = Independent::new(5).words(k, i, 0);
            let uniform = (x >> 8) as f32 / 16_777_216.0;
            if hostile && y % 4 == 0 { ODD[(y / 4 % 12) as usize] } else { uniform }
        };
        Self((0..64).map(|k| (0..100).map(|i| number(k, i)).collect()).collect())
    }
    fn of(&self, k: usize, n: usize) -> &[f32] {
        &self.0[k][..n]
    }
    fn three(&self, k: usize, n: usize) -> Vec3<&[f32]> {
        Vec3::new(self.of(k, n), self.of(k + 1, n), self.of(k + 2, n))
    }
}

fn at(v: Vec3<&[f32]>, i: usize) -> Vec3<f32> {
    v.map(|column| column[i])
}

/// The numbers of a sample; NaNs, of whose bits nothing is promised, count as one.
fn figures(s: &LightSample<f32>) -> [u32; 12] {
    let truth = f32::from(u8::from(s.emits));
    let [w, n] = [s.direction, s.normal];
    [w.x, w.y, w.z, s.distance, s.pdf, s.weight(), n.x, n.y, n.z, s.uv.x, s.uv.y, truth].map(bits)
}
/// The same of a sample of one element.
fn of_one(s: &OneSample) -> [u32; 12] {
    let [w, n] = [s.direction, s.normal];
    let truth = f32::from(s.emits);
    [w.x, w.y, w.z, s.distance, s.pdf, s.weight, n.x, n.y, n.z, s.uv.x, s.uv.y, truth].map(bits)
}
fn bits(x: f32) -> u32 {
    if x.is_nan() { f32::NAN.to_bits() } else { x.to_bits() }
}

/// What a batch has written.
#[derive(Default)]
struct Written {
    columns: Vec<Vec<f32>>,
    emits: Vec<u8>,
}

impl Written {
    fn new(n: usize) -> Self {
        Self { columns: vec![vec![-7.0; n]; 11], emits: vec![9; n] }
    }
    fn samples(&mut self) -> Samples<'_> {
        let [x, y, z, distance, pdf, weight, nx, ny, nz, s, t] = &mut self.columns[..] else { unreachable!() };
        Samples {
            direction: [x, y, z],
            distance,
            pdf,
            weight,
            normal: [nx, ny, nz],
            uv: [s, t],
            emits: &mut self.emits,
        }
    }
    fn figures(&self, i: usize) -> [u32; 12] {
        core::array::from_fn(|k| if k < 11 { bits(self.columns[k][i]) } else { bits(f32::from(self.emits[i])) })
    }
}

/// Compares a sampler with the core's. Returns the numbers and the directions that were used.
fn assert_sampler<'a, P: Prepared>(
    batch: Batch,
    input: &'a Columns,
    n: usize,
    name: &str,
    sampler: &P,
    alone: &impl LightSampler<f32>,
) -> (Vec2<&'a [f32]>, [Vec<f32>; 3]) {
    let u = Vec2::new(input.of(0, n), input.of(1, n));
    let one = |i: usize| Vec2::new(u.x[i], u.y[i]);
    let say = |i: usize| format!("{name}, {batch:?}, element {i} of {n}");

    let mut written = Written::new(n);
    batch.sample(sampler, u, written.samples());
    let drawn: Vec<_> = (0..n).map(|i| alone.sample(one(i))).collect();
    for (i, s) in drawn.iter().enumerate() {
        assert_eq!(written.figures(i), figures(s), "sample: {}", say(i));
        assert_eq!(of_one(&batch.sample_one(sampler, one(i))), figures(s), "sample one: {}", say(i));
    }

    // half of the directions hit, half are any numbers
    let directions: [Vec<f32>; 3] = core::array::from_fn(|axis| {
        let coordinate = |i: usize| match axis {
            _ if i % 2 == 1 => input.of(2 + axis, n)[i],
            0 => drawn[i].direction.x,
            1 => drawn[i].direction.y,
            _ => drawn[i].direction.z,
        };
        (0..n).map(coordinate).collect()
    });
    let w = Vec3::new(&directions[0][..], &directions[1][..], &directions[2][..]);
    let mut pdf = vec![-7.0; n];
    batch.pdf(sampler, w, &mut pdf);
    let mut inverse = [vec![-7.0; n], vec![-7.0; n]];
    let [x, y] = &mut inverse;
    batch.invert(sampler, w, Vec2::new(x, y));
    let mut written = Written::new(n);
    batch.hit(sampler, w, written.samples());
    for i in 0..n {
        assert_eq!(bits(pdf[i]), bits(alone.pdf(at(w, i))), "pdf: {}", say(i));
        let u = alone.invert(at(w, i));
        assert_eq!([inverse[0][i], inverse[1][i]].map(bits), [u.x, u.y].map(bits), "inverse: {}", say(i));
        assert_eq!(written.figures(i), figures(&alone.hit(at(w, i))), "hit: {}", say(i));
        assert_eq!(bits(batch.pdf_one(sampler, at(w, i))), bits(pdf[i]), "pdf of one: {}", say(i));
        let u = batch.invert_one(sampler, at(w, i));
        assert_eq!([u.x, u.y].map(bits), [inverse[0][i], inverse[1][i]].map(bits), "inverse of one: {}", say(i));
        assert_eq!(of_one(&batch.hit_one(sampler, at(w, i))), written.figures(i), "hit of one: {}", say(i));
    }
    (u, directions)
}

#[test]
fn image_lights_have_the_bits_of_the_core() {
    let weights: Vec<f32> = (0..24).map(|i| [0.0, 1.0, 0.3, 1e-3, 7.0][i % 5]).collect();
    for map in [EnvironmentMap::EqualArea, EnvironmentMap::Equirectangular] {
        let mut buffer = [0.0; ImageEnvironment::buffer(6, 4)];
        ImageEnvironment::build(&weights, 6, map, &mut buffer).unwrap();
        let memory = ImageMemory::new(&buffer, 6, map).unwrap();
        let alone = ImageEnvironment::from_buffer(&buffer, 6, map).unwrap().by_radiance();
        each(|batch, input, n| {
            let sky = batch.prepare::<ImageByRadiance<'_>>(&memory, Vec3::default(), ());
            assert_sampler(batch, input, n, "image", &sky, &alone);
        });
    }
}

/// Compares a map with itself over single numbers, which is the core.
fn assert_map<M: BatchMap>(name: &str, map: &M) {
    each(|batch, input, n| {
        let numbers: Vec<_> = (0..M::NUMBERS).map(|k| input.of(k, n)).collect();
        let mut out = vec![vec![-7.0; n]; M::RESULTS];
        let mut holds = vec![9; n];
        batch.map(map, &numbers, &mut out.iter_mut().map(Vec::as_mut_slice).collect::<Vec<_>>(), &mut holds);
        for i in 0..n {
            let one = core::array::from_fn(|k| if k < M::NUMBERS { numbers[k][i] } else { 0.0 });
            let (expected, truth) = map.with(|view| M::map::<f32>(view, one));
            let found: Vec<u32> = out.iter().map(|column| bits(column[i])).collect();
            assert_eq!(found, expected[..M::RESULTS].iter().map(|&x| bits(x)).collect::<Vec<_>>(), "{name}, {i}");
            assert_eq!(holds[i], u8::from(truth), "{name}, {batch:?}, element {i} of {n}");
        }
    });
}

#[test]
fn maps_have_the_bits_of_the_core() {
    let floor = Reflection::new(0.2, Vec3::new(0.0, 1.0, 0.0), Vec3::new(-0.6, 0.8, 0.0));
    assert_map("reflected sphere", &ReflectedSphere(floor));
    let (edge_s, edge_t) = ([0.0, 2.0, 0.5], [0.0, 0.0, 2.0]);
    let portals = [[2.0, -1.0, -1.0], [2.0, 1.5, 0.0]].map(|corner| PortalShape { corner, edge_s, edge_t });
    let mut buffer = [0; PortalTable::buffer(2, 2)];
    PortalTable::build(&[1.0, 2.0, 0.0, 3.0], 2, &mut buffer).unwrap();
    let tables = [PortalSums::new(&buffer, 2).unwrap(); 2];
    assert_map("portal map", &PortalDirection::new(edge_s, edge_t).unwrap());
    assert_map("seen through portals", &SeenThroughPortals(PortalMemory::new(&portals, &tables).unwrap()));
}

#[test]
fn reflections_have_the_bits_of_the_core() {
    each(|batch, input, n| {
        let (alpha, normal, view) = (input.of(0, n), input.three(1, n), input.three(4, n));
        let mut written = vec![vec![-7.0; n]; 16];
        let mut columns = written.iter_mut();
        let out = Reflection::<f32>::default().map(|_| &mut columns.next().unwrap()[..]);
        batch.reflections(alpha, normal, view, out);
        for i in 0..n {
            let mut found = written.iter().map(|column| bits(column[i]));
            Reflection::new(alpha[i], at(normal, i), at(view, i)).map(|number| {
                assert_eq!(found.next(), Some(bits(number)), "{batch:?}, element {i} of {n}");
            });
        }
    });
}

struct Equal {
    compared: usize,
}

impl Visitor for Equal {
    fn technique<T: Technique>(&mut self, name: &str, light: T::Light<f32>, with: T::With<f32>) {
        each(|batch, input, n| {
            let p = Vec3::new(0.1, 0.2, 0.3);
            let sampler = batch.prepare::<T>(&light, p, with);
            let (u, directions) =
                T::prepared::<f32, _>(light, p, with, |alone| assert_sampler(batch, input, n, name, &sampler, alone));
            let w = Vec3::new(&directions[0][..], &directions[1][..], &directions[2][..]);
            let one = |i: usize| Vec2::new(u.x[i], u.y[i]);
            let say = |i: usize| format!("{name}, {batch:?}, element {i} of {n}");

            let mut k = 5;
            let mut next = || {
                k += 1;
                input.of(k, n)
            };
            let (lights, p) = (T::map_light(light, |_| next()), input.three(30, n));
            k = 32;
            let withs = T::map_with(with, |_| {
                k += 1;
                input.of(k, n)
            });
            let mut written = Written::new(n);
            batch.sample_each::<T>(lights, p, withs, u, written.samples());
            let drawn = written;
            let at_element = |i: usize| {
                let light = T::map_light(lights, |column| column[i]);
                (light, at(p, i), T::map_with(withs, |column| column[i]))
            };
            for i in 0..n {
                let (light, p, with) = at_element(i);
                let expected = T::prepared::<f32, _>(light, p, with, |alone| figures(&alone.sample(one(i))));
                assert_eq!(drawn.figures(i), expected, "sample each: {}", say(i));
            }
            let (mut pdf, mut x, mut y) = (vec![-7.0; n], vec![-7.0; n], vec![-7.0; n]);
            let mut written = Written::new(n);
            let out = Evaluations { pdf: &mut pdf, u: [&mut x, &mut y], hit: written.samples() };
            batch.evaluate_each::<T>(lights, p, withs, w, out);
            let mut only = vec![-7.0; n];
            let out = Evaluations { pdf: &mut only, ..Evaluations::default() };
            batch.evaluate_each::<T>(lights, p, withs, w, out);
            for i in 0..n {
                let ((light, p, with), w) = (at_element(i), at(w, i));
                let (expected, u, met) = T::prepared::<f32, _>(light, p, with, |alone| {
                    (alone.pdf(w), alone.invert(w), figures(&alone.hit(w)))
                });
                assert_eq!([pdf[i], only[i]].map(bits), [expected; 2].map(bits), "pdf each: {}", say(i));
                assert_eq!([x[i], y[i]].map(bits), [u.x, u.y].map(bits), "invert each: {}", say(i));
                assert_eq!(written.figures(i), met, "hit each: {}", say(i));
            }
            self.compared += n;
        });
    }
    fn warp<W: BatchWarp>(&mut self, name: &str, warp: W) {
        each(|batch, input, n| {
            let (alone, coordinates) = (warp.over::<f32>(), W::ENTRY.coordinates);
            let u = [input.of(0, n), input.of(1, n)];
            let mut points = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
            batch.warp(&warp, u, points.each_mut().map(|column| &mut column[..]));
            for i in 0..n {
                let expected = alone.sample(Vec2::new(u[0][i], u[1][i])).coordinates();
                let one = batch.warp_one(&warp, Vec2::new(u[0][i], u[1][i]));
                assert_eq!(one.map(bits), expected.map(bits), "{name}, {batch:?}, one element");
                for k in 0..coordinates {
                    assert_eq!(bits(points[k][i]), bits(expected[k]), "{name}, {batch:?}, element {i} of {n}");
                }
            }
            let points = points.each_ref().map(|column| &column[..]);
            let mut pdf = vec![0.0; n];
            batch.warp_pdf(&warp, points, &mut pdf);
            let mut inverse = [vec![0.0; n], vec![0.0; n]];
            batch.warp_invert(&warp, points, inverse.each_mut().map(|column| &mut column[..]));
            for i in 0..n {
                let point = core::array::from_fn(|k| if k < coordinates { points[k][i] } else { 0.0 });
                assert_eq!(
                    bits(pdf[i]),
                    bits(alone.pdf(Coordinates::from_coordinates(point))),
                    "{name}, {batch:?}, element {i} of {n}"
                );
                let u = alone.invert(Coordinates::from_coordinates(point));
                let found = [inverse[0][i], inverse[1][i]];
                assert_eq!(found.map(bits), [u.x, u.y].map(bits), "{name}, {batch:?}, element {i} of {n}");
                assert_eq!(bits(batch.warp_pdf_one(&warp, &point)), bits(pdf[i]), "{name}, {batch:?}, one element");
                let one = batch.warp_invert_one(&warp, &point);
                assert_eq!([one.x, one.y].map(bits), [u.x, u.y].map(bits), "{name}, {batch:?}, one element");
            }
            self.compared += n;
        });
    }
    fn sequence<S: BatchSequence>(&mut self, name: &str, sequence: S) {
        for batch in levels() {
            for n in COUNTS {
                let mut u = [vec![0.0; n], vec![0.0; n]];
                let [x, y] = &mut u;
                let counters = Counters { pixel: 11, sample: u32::MAX - 20, dimension: 2, ..Counters::default() };
                batch.pairs(&sequence, counters, Vec2::new(x, y));
                for (i, (&x, &y)) in u[0].iter().zip(&u[1]).enumerate() {
                    let expected = sequence.pair::<f32>(11, (u32::MAX - 20).wrapping_add(i as u32), 2);
                    assert_eq!([x, y].map(bits), [expected.x, expected.y].map(bits), "{name}, {batch:?}, {i} of {n}");
                }
                self.compared += n;
            }
        }
    }
}

#[test]
fn every_level_gives_the_bits_of_the_core() {
    let mut equal = Equal { compared: 0 };
    every::visit(&mut equal);
    println!("{} elements", equal.compared);
    assert!(equal.compared > 10_000);
}

#[test]
fn the_levels_of_this_processor_were_compiled() {
    #[cfg(all(target_arch = "x86_64", feature = "dispatch"))]
    {
        let v3 = std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma");
        assert_eq!(Batch::at(Level::V3).is_some(), v3);
        assert_eq!(Batch::at(Level::V4).is_some(), v3 && std::arch::is_x86_feature_detected!("avx512dq"));
    }
    let best = [Level::V4, Level::V3, Level::Build].into_iter().find_map(Batch::at).unwrap();
    assert_eq!(Batch::new().level(), best.level());
}

#[test]
fn a_tree_chooses_alike_at_every_level() {
    let input = Columns::new(false);
    let lamp = |i: usize| {
        let place = |k: usize| input.of(k, 100)[i] * 9.0;
        LightBound { center: [place(0), 3.0, place(1)], radius: 0.1, power: 1.0 + place(2), ..LightBound::default() }
    };
    let lamps: Vec<_> = (0..100).map(lamp).collect();
    let mut nodes = vec![Node8::default(); LightTree::nodes_for(lamps.len())];
    let mut places = vec![0; lamps.len()];
    LightTree::build(&lamps, &mut nodes, &mut places).unwrap();
    let (tree, memory) = (LightTree::from_buffers(&nodes, &places), TreeMemory::new(&nodes, &places));
    for batch in levels() {
        for n in COUNTS {
            let (p, normals, u) = (input.three(3, n), input.three(6, n), input.of(9, n));
            let (mut light, mut pmf, mut rest) = (vec![0; n], vec![0.0; n], vec![0.0; n]);
            batch.choose(&memory, p, normals, u, Choices { light: &mut light, pmf: &mut pmf, u: &mut rest });
            let mut again = vec![-7.0; n];
            batch.pmf(&memory, p, normals, &light, &mut again);
            assert_eq!(again, pmf, "{batch:?}, {n}");
            for i in 0..n {
                let one = tree.at::<f32>(at(p, i), at(normals, i)).choose(u[i]);
                assert_eq!((light[i], pmf[i], rest[i]), (one.index, one.pmf, one.u), "{batch:?}, element {i} of {n}");
            }
        }
    }
}

#[test]
#[should_panic(expected = "a column of 3 elements in a batch of 4")]
fn columns_of_other_lengths_panic() {
    let light = etendue::Sphere::new(Vec3::new(0.0, 2.0, 0.0), 0.5).by_solid_angle(Vec3::new(0.0, 0.0, 0.0));
    Batch::new().sample(&light, Vec2::new(&[0.0; 4], &[0.0; 3]), Samples::default());
}
