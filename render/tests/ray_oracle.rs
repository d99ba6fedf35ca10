//! Compares all traversals, bit for bit, with an exhaustive test of every leaf, on meshes and rays designed to lose hits.
//!
//! The test of a single triangle is checked in `rays.rs`, in double precision; there are no tolerances here.
//!
//! The cases include those that obvhs's own traversal gets wrong: −0 in a direction and rays in the plane of a box (kinds 3, 4 and 5),
//! distances below 10⁻⁴ (scale 10⁻⁶), a tree deeper than its stack ("nested"), coincident primitives ("alike"; 100,000 of them in
//! `rays.rs`), and gaps between adjacent triangles (`closed_meshes_do_not_leak`).

use crate::meshes::{Triangle, add, cube, meshes, point};
use crate::random::Random;
use etendue::{Mask, Real, Vec3, f32x8};
use etendue_render::bvh::{Bvh, GROUP, Hits, PrimitiveId, PrimitiveIds, Rays, Scratch, ShapeSet, Traversal};
use etendue_render::packet::M8;

/// Origin and direction.
pub(crate) type Ray = ([f32; 3], [f32; 3]);

/// A group of rays in packets.
pub(crate) fn packets(bvh: &Bvh, rays: &[Ray]) -> Vec<Rays> {
    let axis = |eight: &[Ray], k: usize, of: fn(&Ray) -> [f32; 3]| f32x8::from_fn(|lane| of(&eight[lane])[k]);
    let vector = |eight: &[Ray], of: fn(&Ray) -> [f32; 3]| {
        let [x, y, z] = [0, 1, 2].map(|k| axis(eight, k, of));
        Vec3::new(x, y, z)
    };
    rays.chunks(8).map(|eight| bvh.rays(vector(eight, |ray| ray.0), vector(eight, |ray| ray.1))).collect()
}

/// A ray of a kind: in a random direction; towards a corner; towards a point of an edge; along an axis through the lattice, with −0; in
/// the plane of a side of a triangle's box; from a corner.
fn ray(kind: usize, mesh: &[Triangle], random: &mut Random) -> Ray {
    let t = mesh[random.below(mesh.len())];
    let origin = point(random).map(|x| 2.0 * x);
    let towards = |o: [f32; 3], p: [f32; 3]| (o, add(p, o, -1.0));
    let (a, b) = (t[random.below(3)], t[random.below(3)]);
    match kind {
        0 => (origin, point(random)),
        1 => towards(origin, a),
        2 => towards(origin, add(a.map(|x| 0.5 * x), b, 0.5)),
        3 | 4 => {
            let (axis, sign) = (random.below(3), if random.unit() < 0.5 { 1.0 } else { -1.0 });
            let zero = if random.unit() < 0.5 { 0.0 } else { -0.0 };
            let mut o = if kind == 3 { a } else { add(a.map(|x| 0.5 * x), b, 0.5) };
            o[axis] = -3.0 * sign;
            (o, std::array::from_fn(|k| if k == axis { sign } else { zero }))
        }
        5 => {
            let axis = random.below(3);
            let (mut o, mut p) = (origin, point(random));
            let plane = t.iter().map(|v| v[axis]).fold(f32::INFINITY, f32::min);
            (o[axis], p[axis]) = (plane, plane);
            towards(o, p)
        }
        _ => (a, point(random)),
    }
}

/// Seven kinds of rays, and two kinds of coherent groups.
const KINDS: usize = 9;

fn group(kind: usize, mesh: &[Triangle], random: &mut Random) -> Vec<Ray> {
    if kind < 7 {
        return (0..8 * GROUP).map(|_| ray(kind, mesh, random)).collect();
    }
    // narrow enough for a frustum, or just too wide
    let (o, d) = ray(1, mesh, random);
    let spread = if kind == 7 { 0.005 } else { 0.03 };
    (0..8 * GROUP).map(|_| (add(o, point(random), 0.001), add(d, point(random), spread))).collect()
}

/// The hits of a group, and which rays are unoccluded up to half of the hit distance, up to it, and slightly beyond.
#[derive(Debug, PartialEq)]
struct GroupHits {
    /// Bits of the distance, and the primitive.
    hits: Vec<(u32, PrimitiveId)>,
    free: Vec<u32>,
}

fn trace(bvh: &Bvh, rays: &[Ray], active: &[M8], stack: &mut Scratch) -> GroupHits {
    let packets = packets(bvh, rays);
    let mut hits = [Hits::none(f32x8::splat(f32::INFINITY)); GROUP];
    bvh.closest(&packets, active, &mut hits, stack);
    let bits = |x: f32x8, i: usize| x.to_array()[i].to_bits();
    let each = (0..8 * GROUP).map(|i| {
        let (h, i) = (&hits[i / 8], i % 8);
        (bits(h.distance, i), h.primitives.lane(i))
    });
    let each: Vec<_> = each.collect();
    // limits before, at and behind the hits
    let limits = [0.5, 1.0, 1.000_001].map(|c| hits.map(|h| h.distance * f32x8::splat(c)));
    let free = limits.iter().flat_map(|limit| {
        let mut open: Vec<_> = active.to_vec();
        bvh.occluded(&packets, &mut open, limit, &[PrimitiveIds::none(); GROUP], stack);
        open.into_iter().map(|m| m.bits()).collect::<Vec<_>>()
    });
    let free = free.collect();
    // closest hits with limits at the hits
    let mut until = hits.map(|h| Hits::none(h.distance));
    bvh.closest(&packets, active, &mut until, stack);
    assert!(until.iter().zip(active).all(|(u, &a)| !(u.any() & a).any()), "a hit at the limit counts");
    GroupHits { hits: each, free }
}

/// Traces groups of all kinds on all meshes, scaled and shifted. Returns the numbers of compared rays and of hits.
fn campaign(groups: usize, seed: u32) -> [u64; 2] {
    let mut random = Random::new(seed.into());
    let mut stack = Scratch::default();
    let mut counts = [0; 2];
    for (name, mesh) in meshes(&mut random) {
        for (scale, shift) in [(1.0_f32, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 100.0), (1e-3, 1.0)] {
            let place = |v: [f32; 3]| v.map(|x| x * scale + shift);
            let placed: Vec<Triangle> = mesh.iter().map(|t| t.map(place)).collect();
            let tree = |way| Bvh::new(&placed, ShapeSet::none()).unwrap().with_traversal(way);
            let oracle = tree(Traversal::Exhaustive);
            let ways = [Traversal::Choose, Traversal::Stream, Traversal::Single];
            let ways = ways.map(|way| (way, tree(way)));
            for index in 0..groups * KINDS {
                let kind = index % KINDS;
                let rays = group(kind, &mesh, &mut random).into_iter().filter_map(|(o, d)| {
                    let length = d.iter().map(|&x| f64::from(x) * f64::from(x)).sum::<f64>().sqrt() as f32;
                    (length > 0.0).then(|| (place(o), d.map(|x| x / length)))
                });
                let mut rays: Vec<_> = rays.collect();
                let Some(&first) = rays.first() else { continue };
                rays.resize(8 * GROUP, first);
                // some lanes and packets are inactive
                let all = M8::splat(true);
                let mask =
                    |p: usize| if index % 3 == 0 { M8::from_bits((index * 37 + p * 91) as u32 & 0xff) } else { all };
                let active: Vec<_> = (0..GROUP).map(mask).collect();
                let expected = trace(&oracle, &rays, &active, &mut stack);
                for (way, bvh) in &ways {
                    let found = trace(bvh, &rays, &active, &mut stack);
                    for (i, (f, e)) in found.hits.iter().zip(&expected.hits).enumerate() {
                        let f32::INFINITY = f32::from_bits(e.0) else {
                            assert_eq!(f, e, "{way:?}, {name} × {scale} + {shift}, kind {kind}: ray {i} {:?}", rays[i]);
                            continue;
                        };
                        assert_eq!(
                            f.1,
                            PrimitiveId::NONE,
                            "{way:?}, {name} × {scale} + {shift}, kind {kind}: ray {i} {:?}",
                            rays[i]
                        );
                    }
                    assert_eq!(found, expected, "{way:?}, {name} × {scale} + {shift}, kind {kind}");
                }
                counts[0] += 8 * GROUP as u64;
                counts[1] += expected.hits.iter().filter(|h| h.1 != PrimitiveId::NONE).count() as u64;
            }
        }
    }
    counts
}

#[test]
fn ways_agree_with_every_leaf_tested() {
    let [rays, hits] = campaign(4, 1);
    assert!(rays > 100_000 && hits * 3 > rays, "{hits} of {rays} hit");
}

#[test]
#[ignore = "ten million rays"]
fn ways_agree_with_every_leaf_tested_at_length() {
    let [rays, hits] = campaign(440, 1_000_000);
    println!("{rays} rays, {hits} of them hit, no disagreement");
    assert!(rays >= 10_000_000, "{rays}");
}

/// Every ray from inside a closed mesh hits it, also at corners and edges.
#[test]
fn closed_meshes_do_not_leak() {
    let mut random = Random::new(77);
    let mut stack = Scratch::default();
    for scale in [1e-6_f32, 1.0, 1e6] {
        let mesh: Vec<Triangle> = cube(7).iter().map(|t| t.map(|v| v.map(|x| x * scale))).collect();
        for way in [Traversal::Choose, Traversal::Stream, Traversal::Single] {
            let bvh = Bvh::new(&mesh, ShapeSet::none()).unwrap().with_traversal(way);
            for index in 0..300 {
                let center = point(&mut random).map(|x| 0.9 * x * scale);
                let rays = (0..8 * GROUP).map(|_| {
                    let t = mesh[random.below(mesh.len())];
                    let (a, b) = (t[random.below(3)], t[random.below(3)]);
                    let mix = if index % 2 == 0 { 0.5 } else { random.unit() as f32 };
                    let d = add(add(a, add(b, a, -1.0), mix), center, -1.0).map(f64::from);
                    let length = d.iter().map(|x| x * x).sum::<f64>().sqrt();
                    (center, d.map(|x| (x / length) as f32))
                });
                let found = trace(&bvh, &rays.collect::<Vec<_>>(), &[M8::splat(true); GROUP], &mut stack);
                assert!(found.hits.iter().all(|h| h.1 != PrimitiveId::NONE), "a leak at scale {scale}, {way:?}");
            }
        }
    }
}
