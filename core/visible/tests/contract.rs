//! The contract of proofs and of what remains visible: total, the same in any unit of length, and the same in every lane. That they are sound
//! and their errors bounded is judged by `tests/judge`.

use etendue::{Real, Vec3, f32x8};
use etendue_visible::{Irradiance, Light, Occluder, Occlusion, Patch, Proof, Prover, Solid};
use std::f64::consts::PI;

type V = Vec3<f64>;

/// Numbers from a seed (Steele, Lea and Flood 2014: SplitMix).
struct Random(u64);

impl Random {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// In [low, high), in single precision.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        f64::from((low + (high - low) * (self.word() >> 11) as f64 / (1_u64 << 53) as f64) as f32)
    }
    fn point(&mut self, low: f64, high: f64) -> V {
        Vec3::new(self.between(low, high), self.between(low, high), self.between(low, high))
    }
    fn below(&mut self, n: u64) -> u64 {
        self.word() % n
    }
}

/// A patch of a floor at y = 0, a light above it, and solids between them.
struct Room {
    corners: [V; 4],
    light: Solid,
    solids: Vec<Solid>,
}

impl Room {
    fn new(random: &mut Random) -> Self {
        let (from, size) = (random.point(-1.0, 1.0), random.between(0.02, 0.5));
        let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
        let corners = corners.map(|[i, j]| Vec3::new(from.x + i * size, 0.0, from.z + j * size));
        let at =
            |random: &mut Random, low, high| Vec3::new(0.0, random.between(low, high), 0.0) + random.point(-1.0, 1.0);
        let corner = at(random, 3.5, 4.5);
        let light = match random.below(3) {
            0 => Solid::Sphere { center: corner, radius: random.between(0.05, 0.5) },
            1 => Solid::triangle([corner, corner + random.point(-1.0, 1.0), corner + random.point(-1.0, 1.0)]),
            _ => Solid::Parallelogram { corner, edges: [random.point(-1.0, 1.0), random.point(-1.0, 1.0)] },
        };
        let solids = (0..random.below(4)).map(|_| {
            let middle = at(random, 1.2, 1.8);
            match random.below(4) {
                0 => Solid::Sphere { center: middle, radius: random.between(0.05, 0.7) },
                1 => Solid::triangle([middle, middle + random.point(-1.0, 1.0), middle + random.point(-1.0, 1.0)]),
                2 => {
                    let edges =
                        [random.point(-3.0, 3.0), random.point(-3.0, 3.0)].map(|e| Vec3::new(e.x, 0.05 * e.y, e.z));
                    Solid::Parallelogram { corner: middle - (edges[0] + edges[1]) * 0.5, edges }
                }
                _ => {
                    let size = Vec3::new(random.between(0.1, 1.0), random.between(0.01, 0.5), random.between(0.1, 1.0));
                    Solid::block(middle, middle + size).expect("it has a volume")
                }
            }
        });
        Self { corners, light, solids: solids.collect() }
    }
    fn scaled(&self, factor: f64) -> Self {
        Self {
            corners: self.corners.map(|p| p * factor),
            light: self.light.scaled(factor),
            solids: self.solids.iter().map(|solid| solid.scaled(factor)).collect(),
        }
    }
    /// What is proved, and the irradiance of points of the patch.
    fn prove<T>(
        &self,
        unit: f64,
        points: &[V],
        take: impl FnOnce(Proof<'_>, Vec<Option<Irradiance>>) -> T,
    ) -> Option<T> {
        let patch = Patch::polygon(&self.corners, 1e-7 * unit, 0.0)?;
        let light = Light::new(self.light.clone(), true)?;
        let mut prover = Prover::new(8.0 * unit);
        let mut seen = prover
            .prove(&patch, &light, |_, found| self.solids.iter().all(|solid| found(Occluder::Whole(solid.clone()))));
        let values = points.iter().map(|&p| seen.irradiance(p, Vec3::new(0.0, 1.0, 0.0))).collect();
        Some(take(seen.proof, values))
    }
    fn points(&self, random: &mut Random) -> Vec<V> {
        let [a, b, _, d] = self.corners;
        (0..4).map(|_| a + (b - a) * random.between(0.0, 1.0) + (d - a) * random.between(0.0, 1.0)).collect()
    }
}

/// Nothing depends on the unit of length: times a power of two, proofs and bits stay.
#[test]
fn no_unit_of_length_is_special() {
    let mut random = Random(2);
    for _ in 0..300 {
        let room = Room::new(&mut random);
        let points = room.points(&mut random);
        let names = |proof: Proof<'_>, values: Vec<Option<Irradiance>>, unit: f64| {
            let solids: Vec<Solid> = match proof {
                Proof::Behind(solids) => solids.iter().map(|solid| solid.scaled(1.0 / unit)).collect(),
                _ => Vec::new(),
            };
            (proof == Proof::Lit, proof == Proof::Dark, solids, values)
        };
        let one = room.prove(1.0, &points, |proof, values| names(proof, values, 1.0));
        for unit in [1_048_576.0, 1.0 / 1_048_576.0] {
            let points: Vec<V> = points.iter().map(|&p| p * unit).collect();
            let other = room.scaled(unit).prove(unit, &points, |proof, values| names(proof, values, unit));
            assert_eq!(one, other, "times {unit}");
        }
    }
}

/// No finite input makes a panic, or an irradiance beyond [0, π].
#[test]
fn any_numbers_have_an_answer() {
    const NASTY: [f64; 8] = [0.0, -0.0, 1.0, -1.0, 1e-310, 1e300, -1e300, f64::MAX];
    let mut random = Random(3);
    let vector = |random: &mut Random| {
        let mut x = || {
            if random.below(3) == 0 { NASTY[random.below(8) as usize] } else { random.between(-2.0, 2.0) }
        };
        Vec3::new(x(), x(), x())
    };
    let solid = |random: &mut Random| match random.below(5) {
        0 => Solid::Sphere { center: vector(random), radius: vector(random).x },
        1 => Solid::triangle([(); 3].map(|()| vector(random))),
        2 => Solid::quadrilateral([(); 4].map(|()| vector(random))),
        3 => Solid::Parallelogram { corner: vector(random), edges: [(); 2].map(|()| vector(random)) },
        _ => Solid::block(vector(random), vector(random)).unwrap_or_else(|| Solid::triangle([vector(random); 3])),
    };
    for _ in 0..20_000 {
        let corners = [(); 4].map(|()| vector(&mut random));
        let (light, solids) = (solid(&mut random), (0..random.below(20)).map(|_| solid(&mut random)).collect());
        let room = Room { corners, light, solids };
        let points = [vector(&mut random), corners[0]];
        room.prove(vector(&mut random).x, &points, |_, values| {
            for Irradiance { value, error } in values.into_iter().flatten() {
                assert!((0.0..=PI).contains(&value), "{value} of {:?} behind {:?}", room.light, room.solids);
                assert!(error.is_none_or(|error| error >= 0.0), "{error:?}");
            }
        });
    }
}

/// A packet has the bits of its lanes alone.
#[test]
fn lanes_have_the_bits_of_numbers() {
    let mut random = Random(4);
    let mut compared = 0;
    for _ in 0..500 {
        let room = Room::new(&mut random);
        let points: Vec<V> = (0..2).flat_map(|_| room.points(&mut random)).collect();
        let axis = |of: fn(&V) -> f64| f32x8::from_fn(|lane| of(&points[lane]) as f32);
        let (p, up) = (Vec3::new(axis(|p| p.x), axis(|p| p.y), axis(|p| p.z)), Vec3::lit([0.0, 1.0, 0.0]));
        let Some(eight) = Occlusion::<f32x8>::new().visible(p, up, &room.light, &room.solids) else { continue };
        for (lane, point) in points.iter().enumerate() {
            let (p, up) = (point.map(|x| x as f32), Vec3::lit([0.0, 1.0, 0.0]));
            let one = Occlusion::<f32>::new().visible(p, up, &room.light, &room.solids).map(f32::to_bits);
            assert_eq!(one, Some(eight.lane(lane).to_bits()), "lane {lane}");
            compared += 1;
        }
    }
    assert!(compared > 2000, "{compared}");
}
