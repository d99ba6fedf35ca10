//! The contract of proofs and of what remains visible: total, sound, bounded, the same in any unit of length, and the same in every lane.

use etendue::{Real, Vec3, f32x8};
use etendue_oracle::visible::{Shape, visible};
use etendue_oracle::{V3, along, cross, dot, length, sub, unit};
use etendue_visible::{ENDS, Irradiance, Light, Occluder, Occlusion, Patch, Proof, Prover, Solid};
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

/// A solid relative to a point, by the faces of a polyhedron.
fn shapes(solid: &Solid, p: V) -> Vec<Shape> {
    let from = |q: V| sub(q.into(), p.into());
    match solid {
        Solid::Sphere { center, radius } => vec![Shape::Sphere(from(*center), *radius)],
        Solid::Polygon { corners, count, .. } => {
            vec![Shape::Polygon(corners[..*count].iter().map(|&q| from(q)).collect())]
        }
        Solid::Parallelogram { corner, edges: [u, v] } => {
            vec![Shape::Polygon([*corner, *corner + *u, *corner + *u + *v, *corner + *v].map(from).to_vec())]
        }
        Solid::Polyhedron(body) => {
            let face = |k: usize| {
                let [normal, on] = body.faces()[k];
                let edges = body.edges().iter().filter(|edge| edge.faces.contains(&k));
                let mut ends: Vec<V3> = edges.flat_map(|edge| edge.ends).map(from).collect();
                // in order around the middle
                let middle = ends.iter().fold([0.0; 3], |sum, &q| along(sum, q, 1.0 / ends.len() as f64));
                let first = unit(sub(from(on), middle));
                let second = cross(normal.into(), first);
                let angle = |q: &V3| angle_of(dot(sub(*q, middle), second), dot(sub(*q, middle), first));
                ends.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
                ends.dedup_by(|a, b| length(sub(*a, *b)) < 1e-12);
                Shape::Polygon(ends)
            };
            (0..body.faces().len()).map(face).collect()
        }
    }
}

/// What part of the way from a point to the plane of a light, given relative to it, is level with its end, as documented.
fn ends(light: &Shape, p: V) -> f64 {
    let Shape::Polygon(corners) = light else { return 0.0 };
    let normal = unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])));
    let absolute = corners.iter().map(|&corner| along(corner, p.into(), 1.0)).chain([p.into()]);
    let greatest = absolute.flatten().fold(0.0, |most: f64, x: f64| most.max(x.abs()));
    (ENDS * greatest / dot(normal, corners[0]).abs()).min(1.0)
}

fn angle_of(y: f64, x: f64) -> f64 {
    Real::atan2(y, x)
}

/// What is proved is what the oracle finds, and the irradiance differs from its truth by no more than it says.
#[test]
fn proofs_are_sound_and_errors_are_bounds() {
    let mut random = Random(1);
    let (mut counts, mut worst) = ([0; 4], 0.0_f64);
    for _ in 0..3000 {
        let room = Room::new(&mut random);
        let points = room.points(&mut random);
        room.prove(1.0, &points, |proof, values| {
            counts[match proof {
                Proof::Lit => 0,
                Proof::Dark => 1,
                Proof::Behind(_) => 2,
                Proof::Open => 3,
            }] += 1;
            for (&p, value) in points.iter().zip(values) {
                let light = shapes(&room.light, p).swap_remove(0);
                let blockers: Vec<Shape> = room.solids.iter().flat_map(|solid| shapes(solid, p)).collect();
                let Some(truth) = visible(&light, &blockers, [0.0, 1.0, 0.0], ends(&light, p)) else { continue };
                match proof {
                    Proof::Lit => assert!(truth.occluders == 0, "{truth:?} is lit from {p:?}"),
                    Proof::Dark => assert!(truth.left < 1e-12, "{truth:?} is dark from {p:?}"),
                    _ => {}
                }
                let Some(Irradiance { value, error: Some(error) }) = value else { continue };
                let off = (value - truth.left).abs();
                assert!(off <= error + 1e-15, "{value} ± {error} instead of {truth:?} from {p:?}: {proof:?}");
                worst = worst.max(if error > 0.0 { off / error } else { 0.0 });
            }
        });
    }
    println!("lit, dark, behind, open: {counts:?}; greatest error {worst:.1e} of what is stated");
    assert!(counts.iter().all(|&count| count > 60), "{counts:?}");
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
