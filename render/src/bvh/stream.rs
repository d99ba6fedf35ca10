//! Stream traversal: the rays of a group visit each node together, once, with the rays that enter it.

use super::node::{INNER, Node, Stack, WIDTH, push_in_order, slabs};
use super::rays::{GROUP, Hits, Rays, by_octant, octant};
use super::single_ray::{Child, Leaves, SingleRay, trace_lane};
use super::tree::{Primitives, View};
use crate::packet::{M8, X8, each_bit};
use etendue::{Mask, Real};
use wide::i8x32;

/// With fewer rays than this, each continues alone, as sharing the traversal no longer pays.
const FEW: u32 = 5;

/// A child to visit, and the set of rays that enter it: bit 8·packet + lane.
#[derive(Clone, Copy, Debug, Default)]
struct Visit {
    rays: u64,
    /// Index of the inner node, or of the leaf's parent.
    node: u32,
    /// Slot of the leaf, or [`INNER`] for an inner node.
    slot: u32,
    near: f32,
}

/// Memory for streams, to be reused.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    visits: Stack<Visit>,
    pub(super) single_ray: Stack<Child>,
}

/// A group of rays. Bit k of `OCTANT` is set if all rays run towards − along axis k; 8 means that they disagree.
struct Stream<'a, const OCTANT: usize> {
    rays: &'a [Rays],
}

impl<const OCTANT: usize> Stream<'_, OCTANT> {
    /// The set of rays that enter each child, and for closest hits the least entry distance of each child.
    #[inline(always)]
    fn enter<const ANY: bool>(&self, node: &Node, among: u64, hits: &[Hits]) -> ([u64; WIDTH], X8) {
        let negative = |k: usize| OCTANT >> k & 1;
        let first = |k: usize| X8::from(node.planes[negative(k)][k]);
        let last = |k: usize| X8::from(node.planes[1 - negative(k)][k]);
        let (first, last) = ([first(0), first(1), first(2)], [last(0), last(1), last(2)]);
        let mut nearest = X8::lit(f64::INFINITY);
        let mut entered = [[0_i8; 8]; GROUP];
        for (((r, hits), entered), p) in self.rays.iter().zip(hits).zip(&mut entered).zip(0..) {
            let mut lanes = (among >> (8 * p)) as u32 & 0xff;
            if lanes == 0 {
                continue;
            }
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize & 7;
                lanes &= lanes - 1;
                let at = |x: &X8| X8::splat(x.as_array()[lane]);
                let axis = |k: usize, inverse: &X8, a: &X8, b: &X8| {
                    let inverse = at(inverse);
                    let a = first[k].mul_add(inverse, at(a));
                    let b = last[k].mul_add(inverse, at(b));
                    if OCTANT < 8 { (a, b) } else { (a.lesser(b), a.greater(b)) }
                };
                let side = |k: usize| (&r.offset[negative(k)], &r.offset[1 - negative(k)]);
                let ((ax, bx), (ay, by), (az, bz)) = (side(0), side(1), side(2));
                let (nx, fx) = axis(0, &r.inverse.x, &ax.x, &bx.x);
                let (ny, fy) = axis(1, &r.inverse.y, &ay.y, &by.y);
                let (nz, fz) = axis(2, &r.inverse.z, &az.z, &bz.z);
                let near = nx.greater(ny).greater(nz.greater(X8::lit(0.0)));
                let far = fx.lesser(fy).lesser(fz.lesser(at(&hits.distance)));
                let mask = near.le(far);
                entered[lane] = mask.bits() as i8;
                if !ANY {
                    nearest = nearest.lesser(Real::blend(mask, near, X8::lit(f64::INFINITY)));
                }
            }
        }
        let (low, high) = entered.as_flattened().split_at(32);
        let half = |bytes: &[i8]| i8x32::new(bytes.try_into().expect("32 bytes"));
        let (mut low, mut high) = (half(low), half(high));
        let mut rays = [0; WIDTH];
        for child in (0..WIDTH).rev() {
            rays[child] = u64::from(low.to_bitmask()) | u64::from(high.to_bitmask()) << 32;
            (low, high) = (low + low, high + high);
        }
        (rays, nearest)
    }
}

/// The bit set of the active rays.
fn bits(active: &[M8]) -> u64 {
    active.iter().zip(0..).fold(0, |bits, (a, p)| bits | u64::from(a.bits()) << (8 * p))
}

/// Finds the nearest hits of a group of packets, if nearer than those in `hits`. With `ANY`, clears the lanes of `active` that hit
/// something instead.
pub(super) fn stream<const ANY: bool>(
    tree: &View<'_, impl Primitives + Leaves>,
    rays: &[Rays],
    active: &mut [M8],
    hits: &mut [Hits],
    scratch: &mut Scratch,
) {
    if tree.count != 0 {
        by_octant!(octant(rays), else 8, stream_in_octant::<ANY>(tree, rays, active, hits, scratch));
    }
}

fn stream_in_octant<const ANY: bool, const OCTANT: usize>(
    tree: &View<'_, impl Primitives + Leaves>,
    rays: &[Rays],
    active: &mut [M8],
    hits: &mut [Hits],
    scratch: &mut Scratch,
) {
    let stream = Stream::<OCTANT> { rays };
    let Scratch { visits, single_ray } = scratch;
    let visits = &mut visits.0[..];
    let mut open = bits(active);
    let mut height = 1;
    visits[0] = Visit { rays: open, node: 0, slot: INNER, near: 0.0 };
    while height > 0 && open != 0 {
        height -= 1;
        let Visit { rays: among, node: place, slot, .. } = visits[height];
        let among = among & open;
        let node = &tree.nodes[place as usize];
        if !ANY && slot != INNER {
            visit_stream_leaf::<ANY>(tree, rays, among, node, slot as usize & 7, hits);
            continue;
        }
        if among.count_ones() < FEW {
            each_bit(among, |i| {
                let p = i >> 3;
                let hidden = trace_lane::<ANY>(tree, place, &rays[p], i & 7, &mut hits[p], single_ray);
                open &= !(u64::from(hidden) << i);
            });
            continue;
        }
        let (entered, near) = stream.enter::<ANY>(node, among, hits);
        let near = near.to_array();
        // the nearest child goes to the top of the stack
        let floor = height;
        for slot in 0..(node.children as usize).min(WIDTH) {
            if entered[slot] == 0 {
                continue;
            }
            let inner = node.count[slot] == 0;
            if ANY && !inner {
                open &= !visit_stream_leaf::<ANY>(tree, rays, entered[slot] & open, node, slot, hits);
                continue;
            }
            let (to, leaf) = if inner { (node.first[slot], INNER) } else { (place, slot as u32) };
            let child = Visit { rays: entered[slot], node: to, slot: leaf, near: near[slot] };
            push_in_order(visits, &mut height, floor, child, |c| c.near);
        }
    }
    if ANY {
        for (p, active) in active.iter_mut().enumerate() {
            *active = M8::from_bits((open >> (8 * p)) as u32 & 0xff);
        }
    }
}

/// Tests the rays of `among` in a leaf. With `ANY`, returns those that hit something.
#[inline(always)]
fn visit_stream_leaf<const ANY: bool>(
    tree: &View<'_, impl Primitives + Leaves>,
    rays: &[Rays],
    among: u64,
    node: &Node,
    slot: usize,
    hits: &mut [Hits],
) -> u64 {
    let leaf = node.leaf(slot);
    let mut hidden = 0;
    for ((rays, hits), p) in rays.iter().zip(hits).zip(0..) {
        let lanes = (among >> (8 * p)) as u32 & 0xff;
        if lanes == 0 {
            continue;
        }
        let (near, _) = slabs::<false>(node, slot, rays, [false; 3], hits.distance);
        // one triangle after another or one ray after another, whichever are fewer
        if lanes.count_ones() as usize >= leaf.len() {
            let lanes = tree.primitives.test_packet::<ANY>(leaf.clone(), rays, near, M8::from_bits(lanes), hits);
            hidden |= u64::from(lanes.bits()) << (8 * p);
            continue;
        }
        each_bit(lanes, |lane| {
            let mut nearest = hits.nearest(lane);
            let near = near.as_array()[lane];
            if ANY || near <= nearest.distance {
                let (ray, near) = (SingleRay::new(rays, lane), X8::splat(near));
                let hit = tree.primitives.test_ray::<ANY>(leaf.clone(), &ray, near, &mut nearest);
                hidden |= u64::from(hit) << (8 * p + lane);
                if !ANY {
                    hits.put(lane, &nearest);
                }
            }
        });
    }
    hidden
}
