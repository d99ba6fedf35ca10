//! Compares packets with a test of each triangle in double precision, and builds trees over difficult meshes.

use crate::ray_oracle::{Ray, packets};
use etendue::sequence::{Independent, Sequence};
use etendue::{Mask, Real, Vec2, Vec3, f32x8};
use etendue_oracle::{V3, cross, dot, sub};
use etendue_render::bvh::{Bvh, Hits, LitSides, PrimitiveId, PrimitiveIds, Scratch, ShapeSet, Traversal};
use etendue_render::scene::{Affine, Disk, Geometry, Instance};

/// Distance and least barycentric coordinate (Möller and Trumbore), if the ray hits the plane.
fn meet(t: &[[f32; 3]; 3], o: V3, d: V3) -> Option<(f64, f64)> {
    let [a, b, c] = t.map(|v| v.map(f64::from));
    let (e1, e2, s) = (sub(b, a), sub(c, a), sub(o, a));
    let p = cross(d, e2);
    let det = dot(e1, p);
    let q = cross(s, e1);
    let (u, v, t) = (dot(s, p) / det, dot(d, q) / det, dot(e2, q) / det);
    (t > 0.0).then_some((t, u.min(v).min(1.0 - u - v)))
}

fn random(i: u32, dimension: u32) -> [f32; 2] {
    let u: Vec2<f32> = Independent::new(5).pair(i, 0, dimension);
    [u.x * 2.0 - 1.0, u.y * 2.0 - 1.0]
}

/// A point of the cube from −1 to 1.
fn point(i: u32, k: u32) -> [f32; 3] {
    let ([x, y], [z, _]) = (random(i, 2 * k), random(i, 2 * k + 1));
    [x, y, z]
}

/// Checks a group of eight packets; returns the number of hits. Distances are accurate to 1e−6 of the scene's `scale`, 8 roundings of its
/// coordinates.
fn check(triangles: &[[[f32; 3]; 3]], bvh: &Bvh, rays: &[Ray], scale: f32) -> usize {
    let packets = packets(bvh, rays);
    let all = [<f32x8 as Real>::Mask::splat(true); 8];
    let (far, mut stack) = (f32x8::splat(f32::INFINITY), Scratch::default());
    let mut hits = [Hits::none(far); 8];
    bvh.closest(&packets, &all, &mut hits, &mut stack);
    let mut open = all;
    bvh.occluded(&packets, &mut open, &[far; 8], &[PrimitiveIds::none(); 8], &mut stack);
    let mut count = 0;
    for (i, (o, d)) in rays.iter().enumerate() {
        let (o, d) = (o.map(f64::from), d.map(f64::from));
        let met: Vec<_> = triangles.iter().filter_map(|t| meet(t, o, d)).collect();
        // within 1e−5 of an edge, either result is valid in single precision
        let surely = met.iter().filter(|m| m.1 > 1e-5).map(|m| m.0).fold(f64::INFINITY, f64::min);
        let perhaps = met.iter().filter(|m| m.1 > -1e-5).map(|m| m.0).fold(f64::INFINITY, f64::min);
        let found = f64::from(hits[i / 8].distance.lane(i % 8));
        assert_eq!(found < f64::INFINITY, !open[i / 8].lane(i % 8), "closest and occluded differ on ray {i}");
        let slack = 1e-6 * f64::from(scale);
        assert!(found <= surely * (1.0 + 1e-5) + slack, "ray {i} {o:?} {d:?}: found {found}, expected {surely}");
        assert!(
            found >= perhaps * (1.0 - 1e-5) - slack || found == perhaps,
            "ray {i} {o:?} {d:?}: found {found}, nearer than {perhaps}"
        );
        count += usize::from(found < f64::INFINITY);
    }
    count
}

fn tree(triangles: &[[[f32; 3]; 3]]) -> Bvh {
    Bvh::new(triangles, ShapeSet::none()).unwrap()
}

#[test]
fn packets_find_what_is_there() {
    for scale in [1e-6_f32, 1.0, 1e6] {
        let triangles: Vec<[[f32; 3]; 3]> = (0..600)
            .map(|i| {
                let center = point(i, 0);
                [1, 2, 3].map(|k| std::array::from_fn(|a| (center[a] + 0.2 * point(i, k)[a]) * scale))
            })
            .collect();
        let bvh = tree(&triangles);
        let mut hits = 0;
        for group in 0..40_u32 {
            let tilt = [1.0, -1.0, 0.0][group as usize / 4 % 3];
            let rays: Vec<_> = (0..64)
                .map(|i| {
                    let (o, d) = (point(group * 64 + i, 5), point(group * 64 + i, 6));
                    // one origin and a narrow beam, tilted or not, along an axis (with −0), or random directions
                    let (o, d) = match group % 4 {
                        0 => {
                            ([1.5 * tilt, -0.9 * tilt, 3.0], [0.01 * d[0] - 0.5 * tilt, 0.01 * d[1] + 0.3 * tilt, -1.0])
                        }
                        1 => ([o[0], o[1], 3.0], [-0.0, 0.0, -1.0]),
                        2 => ([o[0], -3.0, o[2]], [0.0, 1.0, -0.0]),
                        _ => (o, d),
                    };
                    let length = d.iter().map(|x| x * x).sum::<f32>().sqrt();
                    (o.map(|x| x * scale), d.map(|x| x / length))
                })
                .collect();
            hits += check(&triangles, &bvh, &rays, scale);
        }
        assert!((400..2500).contains(&hits), "{hits} of 2560 rays hit at scale {scale}");
    }
}

/// Rays meet disks where they meet their planes within the radius, and nowhere else; both sides are hit.
#[test]
fn disks_are_round() {
    let disk = |i: u32| {
        let ([x, y], [z, a], [b, c]) = (random(i, 0), random(i, 1), random(i, 2));
        let length = (a * a + b * b + c * c).sqrt();
        let normal = [a, b, c].map(|x| x / length);
        Disk { center: [x, y, z], normal, radius: [0.3, 0.05, 0.01][i as usize % 3] }
    };
    let disks: Vec<Disk> = (0..60).map(disk).collect();
    let shapes: Vec<Geometry> = disks.iter().map(|&disk| Geometry::Disk(disk)).collect();
    let bvh = Bvh::new(&[], ShapeSet::new(shapes.iter().map(|shape| (shape, LitSides::Neither))).unwrap()).unwrap();
    let (mut hits, mut stack, mut counts) = ([Hits::none(f32x8::splat(f32::INFINITY))], Scratch::default(), [0; 2]);
    for packet in 0..500 {
        let lanes = |f: &dyn Fn(u32) -> [f32; 3]| {
            let axis = |k: usize| f32x8::from_fn(|lane| f(1000 + 8 * packet + lane as u32)[k]);
            Vec3::new(axis(0), axis(1), axis(2))
        };
        let origin = lanes(&|i| [random(i, 3)[0], random(i, 3)[1], random(i, 4)[0]].map(|x| 3.0 * x));
        let to = lanes(&|i| disks[i as usize % disks.len()].center);
        let off = lanes(&|i| [random(i, 5)[0], random(i, 5)[1], random(i, 6)[0]].map(|x| 0.2 * x));
        let direction = (to + off - origin).normalize();
        hits[0] = Hits::none(f32x8::splat(f32::INFINITY));
        bvh.closest(&[bvh.rays(origin, direction)], &[Mask::splat(true)], &mut hits, &mut stack);
        for lane in 0..8 {
            let exact = |v: Vec3<f32x8>| [v.x, v.y, v.z].map(|x| f64::from(x.lane(lane)));
            let (o, d) = (exact(origin), exact(direction));
            // the distance to the plane, and how far within the rim that is
            let met = disks.iter().map(|disk| {
                let [center, normal] = [disk.center, disk.normal].map(|v| v.map(f64::from));
                let t = dot(normal, sub(center, o)) / dot(normal, d);
                let place = sub(std::array::from_fn(|k| o[k] + t * d[k]), center);
                (t, f64::from(disk.radius) - dot(place, place).sqrt(), dot(normal, d).abs())
            });
            let met: Vec<_> = met.filter(|met| met.0 > 0.0).collect();
            let nearest = |least: f64| {
                let within = met.iter().filter(|(_, inside, slope)| *inside > least / slope);
                within.map(|met| met.0).fold(f64::INFINITY, f64::min)
            };
            let (surely, perhaps) = (nearest(2e-6), nearest(-2e-6));
            let found = f64::from(hits[0].distance.lane(lane));
            assert!(found <= surely * (1.0 + 1e-4) && found >= perhaps * (1.0 - 1e-4), "{found}: {surely}, {perhaps}");
            counts[usize::from(found < f64::INFINITY)] += 1;
        }
    }
    assert!(counts.iter().all(|&count| count > 400), "misses and hits: {counts:?}");
}

/// A rotation about a random axis, after a scale of each axis, one of them mirrored or not, and before a shift.
fn affine(i: u32, stretch: f64, far: f64) -> Affine {
    let number = |k: u32| f64::from(random(i, k)[0]);
    let axis = [number(1), number(2), number(3) + 1e-3];
    let axis = axis.map(|x| x / dot(axis, axis).sqrt());
    let (sin, cos) = (3.0 * number(4)).sin_cos();
    let scale = [5, 6, 7].map(|k| stretch.powf(number(k)) * if i % 3 == k - 5 { -1.0 } else { 1.0 });
    Affine(std::array::from_fn(|r| {
        std::array::from_fn(|c| {
            if c == 3 {
                return (far * number(8 + r as u32)) as f32;
            }
            let cyclic = (c + 3 - r) % 3;
            let across = [0.0, -axis[(r + 2) % 3], axis[(r + 1) % 3]][cyclic];
            let same = if r == c { cos } else { 0.0 };
            ((same + (1.0 - cos) * axis[r] * axis[c] + sin * across) * scale[c]) as f32
        })
    }))
}

/// Instances are hit as copies of their triangles are, bit for bit, and these where double precision finds them.
#[test]
fn instances_are_hit_as_copies() {
    let mut hits = 0;
    for round in 0..24_u32 {
        let (stretch, far) = ([1.0, 30.0, 1000.0][round as usize % 3], [0.5, 1.5, 400.0][round as usize / 3 % 3]);
        let point = |i: u32, k: u32| point(900 * round + i, k);
        let triangle = |i: u32| {
            let center = point(i, 0);
            [1, 2, 3].map(|k| std::array::from_fn(|a| 0.4 * center[a] + 0.2 * point(i, k)[a]))
        };
        let triangles: Vec<[[f32; 3]; 3]> = (0..300).map(triangle).collect();
        // some of their own, and two objects, the second of which is empty in every fourth round
        let objects = [100..if round % 4 == 0 { 300 } else { 180 }, if round % 4 == 0 { 300..300 } else { 180..300 }];
        let instance = |i: u32| Instance { object: i % 2, to_world: affine(50 * round + i, stretch, far) };
        let instances: Vec<_> = (0..9).map(instance).collect();
        let mut copies = triangles[..100].to_vec();
        for Instance { object, to_world } in &instances {
            let own = &triangles[objects[*object as usize].clone()];
            copies.extend(own.iter().map(|t| t.map(|p| <[f32; 3]>::from(to_world.point(Vec3::from(p))))));
        }
        let build = || {
            let shapes = ShapeSet::none();
            Bvh::with_instances(triangles.clone(), &objects, &instances, shapes).unwrap()
        };
        let (flat, all) = (tree(&copies), build());
        let ways = [Traversal::Stream, Traversal::Single, Traversal::Exhaustive];
        let others = ways.map(|way| build().with_traversal(way));
        for group in 0..8_u32 {
            let ray = |i: u32| {
                let (o, d) = (point(group * 64 + i, 5), point(group * 64 + i, 6));
                let (o, d) = match group % 4 {
                    // past a corner of a triangle, at the edge of the boxes around it
                    3 => {
                        let which = (random(i, group)[0].abs() * copies.len() as f32) as usize;
                        let [a, b, c] = copies[which.min(copies.len() - 1)];
                        let near: [f32; 3] = std::array::from_fn(|k| 0.998 * a[k] + 0.001 * (b[k] + c[k]));
                        (std::array::from_fn(|k| near[k] - 2.0 * d[k]), d)
                    }
                    0 => ([0.1, 0.2, 4.0], [0.3 * d[0], 0.3 * d[1], -1.0]),
                    1 => ([o[0], o[1], 3.0], [-0.0, 0.0, -1.0]),
                    _ => (o, d),
                };
                let length = d.iter().map(|x| x * x).sum::<f32>().sqrt();
                (o, d.map(|x| x / length))
            };
            let rays: Vec<_> = (0..64).map(ray).collect();
            // strong stretches make slivers, whose distances single precision does not know
            if stretch < 10.0 {
                hits += check(&copies, &all, &rays, all.reach());
            }
            let expected = found(&flat, &rays);
            let own = found(&all, &rays);
            for (i, ((distance, place), (wanted, copy))) in own.iter().zip(&expected).enumerate() {
                assert_eq!(distance, wanted, "ray {i} of group {group} of round {round}");
                let corners = |bvh: &Bvh, place: PrimitiveId| (place != PrimitiveId::NONE).then(|| bvh.corners(place));
                assert_eq!(corners(&all, *place), corners(&flat, *copy), "ray {i} of group {group} of round {round}");
            }
            for (which, bvh) in others.iter().enumerate() {
                assert_eq!(found(bvh, &rays), own, "group {group} of round {round}, way {which}");
            }
        }
    }
    assert!(hits > 2000, "{hits} of 8,192 rays hit");
}

/// Distance and primitive of the nearest hit of each ray.
fn found(bvh: &Bvh, rays: &[Ray]) -> Vec<(f32, PrimitiveId)> {
    let packets = packets(bvh, rays);
    let mut hits = [Hits::none(f32x8::splat(f32::INFINITY)); 8];
    bvh.closest(&packets, &[<f32x8 as Real>::Mask::splat(true); 8], &mut hits, &mut Scratch::default());
    (0..64).map(|i| (hits[i / 8].distance.lane(i % 8), hits[i / 8].primitives.lane(i % 8))).collect()
}

#[test]
fn identical_triangles_build() {
    let one = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0_f32]];
    let bvh = tree(&vec![one; 100_000]);
    let rays = vec![([0.0, 0.0, 2.0], [0.0, 0.0, -1.0]); 64];
    assert_eq!(check(&[one], &bvh, &rays, 1.0), 64);
    // the triangle of lower index wins a tie
    let mut hits = [Hits::none(f32x8::splat(f32::INFINITY))];
    let ray = bvh.rays([0.0, 0.0, 2.0].into(), [0.0, 0.0, -1.0].into());
    bvh.closest(&[ray], &[<f32x8 as Real>::Mask::splat(true)], &mut hits, &mut Scratch::default());
    assert_eq!(bvh.order()[hits[0].primitives.lane(0).triangle().unwrap() as usize], 0);
}

/// Trees whose surface areas overflow are built all the same.
#[test]
fn huge_triangles_build() {
    for scale in [1e15_f32, 1e17, 1e19, 1e20, 1e30, 3e38] {
        for count in [9, 20, 30, 100, 40_000] {
            let corner = |i: u32, k: u32| point(i, k).map(|x| x * scale);
            let triangles: Vec<_> = (0..count).map(|i| [0, 1, 2].map(|k| corner(i, k))).collect();
            let bvh = tree(&triangles);
            let mut found: Vec<u32> = bvh.order().to_vec();
            for (place, id) in (0..).zip(&found) {
                assert_eq!(
                    bvh.corners(PrimitiveId::of_triangle(place)),
                    triangles[*id as usize].concat()[..],
                    "{scale}, {count}"
                );
            }
            found.sort_unstable();
            assert!((0..count).eq(found), "{scale}, {count}");
        }
    }
}

/// 60,000 triangles: a sheet, 20,000 coincident ones, and some that are distant and large.
fn many() -> Vec<[[f32; 3]; 3]> {
    let near = |i: u32, center: [f32; 3], size: f32| {
        [1, 2, 3].map(|k| std::array::from_fn(|a| center[a] + size * point(i, k)[a]))
    };
    (0..60_000)
        .map(|i| match i % 600 {
            0 => near(i, point(i, 0).map(|x| 1e4 * x), 1e3),
            1..200 => near(0, [0.1, 0.2, 0.3], 0.2),
            _ => near(i, [point(i, 0)[0], 0.1 * point(i, 0)[1], point(i, 0)[2]], 0.03),
        })
        .collect()
}

#[test]
fn trees_of_many_parts_are_whole() {
    let triangles = many();
    let bvh = tree(&triangles);
    let mut order = bvh.order().to_vec();
    for (place, &id) in (0..).zip(&order) {
        assert_eq!(
            &bvh.corners(PrimitiveId::of_triangle(place)),
            triangles[id as usize].as_flattened(),
            "place {place}"
        );
    }
    order.sort_unstable();
    assert!(order.into_iter().eq(0..triangles.len() as u32), "a triangle is missing or duplicated");
    // the same hits as by an exhaustive test
    let rays: Vec<_> = (0..64_u32)
        .map(|i| {
            let ([x, z], [u, v]) = (random(i, 20), random(i, 21));
            let d = [0.3 * u, -1.0, 0.3 * v];
            let length = d.iter().map(|x| x * x).sum::<f32>().sqrt();
            ([x, 2.0, z], d.map(|x| x / length))
        })
        .collect();
    let ways = [Traversal::Exhaustive, Traversal::Choose, Traversal::Stream, Traversal::Single];
    let all = ways.map(|way| found(&tree(&triangles).with_traversal(way), &rays));
    let met = all[0].iter().filter(|(_, place)| *place != PrimitiveId::NONE).count();
    assert!(met > 32, "{met} of 64 rays hit");
    assert!(all.iter().all(|hits| *hits == all[0]), "traversals differ");
}

#[test]
fn trees_do_not_depend_on_threads() {
    let triangles = many();
    let built = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| format!("{:?}", tree(&triangles)))
    });
    assert!(built[1] == built[0] && built[2] == built[0], "the tree depends on the number of threads");
    // nor does the tree depend on the ownership of the triangles
    let own = Bvh::taking(triangles, ShapeSet::none()).unwrap();
    assert!(format!("{own:?}") == built[0], "the tree depends on the ownership of the triangles");
}
