//! What the importance of a node is worth: shares and bounds of the children of random nodes, beside what their lights contribute.

use super::published::Cluster;
use super::stage::{Point, Stage};
use etendue::select::{LightTree, TreeAt, TreeChild};
use etendue::sequence::{Independent, Sequence};
use etendue::{Real, Vec2, Vec3, u32x8};
use etendue_render::packet::{V8, X8};
use etendue_render::technique::Measure;
use rayon::prelude::*;

/// Distances of points from a node's centre, in units of its radius.
pub const DISTANCES: [f64; 7] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0];
/// Elevations of a node's centre above the horizon of the point, in degrees.
pub const ELEVATIONS: [f64; 7] = [-15.0, 0.0, 5.0, 15.0, 30.0, 60.0, 90.0];
/// The greatest number of lights of a node that is looked at.
const MOST: usize = 4096;

/// What became of the children at one distance and elevation.
#[derive(Clone, Debug, Default)]
pub struct Cell {
    /// Children that contribute.
    pub children: u64,
    /// Those whose published importance is less than what they contribute.
    pub below: u64,
    /// Those whose importance is 0 although they contribute: published, and this tree's.
    pub zero: [u64; 2],
    /// The share of a child over its true share: published, and this tree's, each with the true share as its weight.
    pub ratios: [Vec<(f64, f64)>; 2],
    /// Relative second moment of a choice among the children, Σ true²/share: published, and this tree's.
    pub moments: [Vec<f64>; 2],
    /// The worst of this tree: a node and a point with much contribution and little share.
    pub worst: Option<Worst>,
}

/// A child whose share is too small.
#[derive(Clone, Copy, Debug)]
pub struct Worst {
    /// Node and slot.
    pub node: [u32; 2],
    /// Lights of the child.
    pub lights: usize,
    /// Share and true share.
    pub shares: [f64; 2],
    /// The point.
    pub point: Point<[f32; 3]>,
}

impl Cell {
    /// Adds what became of others.
    pub fn merge(&mut self, other: &Self) {
        self.children += other.children;
        self.below += other.below;
        for k in 0..2 {
            self.zero[k] += other.zero[k];
        }
        for (own, other) in self.ratios.iter_mut().zip(&other.ratios) {
            own.extend_from_slice(other);
        }
        for (own, other) in self.moments.iter_mut().zip(&other.moments) {
            own.extend_from_slice(other);
        }
        let loss = |worst: &Worst| worst.shares[1] * worst.shares[1] / worst.shares[0];
        if other.worst.as_ref().map_or(0.0, loss) > self.worst.as_ref().map_or(0.0, loss) {
            self.worst = other.worst;
        }
    }
    /// Quantiles of the share over the true share, weighted by the true share.
    #[must_use]
    pub fn quantiles<const N: usize>(&self, which: usize, at: [f64; N]) -> [f64; N] {
        let mut all = self.ratios[which].clone();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = all.iter().map(|x| x.1).sum();
        at.map(|q| {
            let mut sum = 0.0;
            let found = all.iter().find(|x| {
                sum += x.1;
                sum >= q * total
            });
            found.map_or(f64::NAN, |x| x.0)
        })
    }
    /// The mean relative variance of a choice among the children.
    #[must_use]
    pub fn variance(&self, which: usize) -> f64 {
        let moments = &self.moments[which];
        moments.iter().map(|m| m - 1.0).sum::<f64>() / moments.len() as f64
    }
}

/// Relative entropy of the shares, in bits: how much the choice at a node differs from the true shares, weighted by the true probability of
/// the node.
#[derive(Clone, Debug, Default)]
pub struct Entropy {
    /// By level, from the root.
    pub levels: Vec<f64>,
    /// By the distance of the point from the node's centre over its radius: up to 0.5, 1, 2, 4, 8, 16, and more.
    pub distances: [f64; 7],
    /// The part that is lost at nodes whose children are all lights.
    pub lowest: f64,
}

/// What is below a node at a point.
struct Sum {
    total: f64,
    low: [f32; 3],
    high: [f32; 3],
    /// Entropies of all nodes below, not yet divided by the sum of all lights: level, distance, whether its children are lights.
    losses: Vec<(usize, usize, bool, f64)>,
}

/// Children of a node: slot, lights, and what the published tree would know of them.
struct Child {
    slot: u32,
    lights: Vec<u32>,
    cluster: Cluster,
}

/// The lights below a node, or nothing if they are too many.
fn below(tree: LightTree<'_>, child: TreeChild) -> Option<Vec<u32>> {
    let at = tree.at::<f32>(Vec3::default(), Vec3::new(0.0, 0.0, 1.0));
    let (mut lights, mut pending) = (Vec::new(), vec![child]);
    while let Some(child) = pending.pop() {
        match child {
            TreeChild::Nothing => {}
            TreeChild::Light(light) => lights.push(light),
            TreeChild::Node(node) => pending.extend(at.shares(0, node).map(|(_, child)| child)),
        }
        if lights.len() + pending.len() > MOST {
            return None;
        }
    }
    Some(lights)
}

impl Stage {
    /// What each light contributes at a point without occlusion.
    fn given(&self, lights: &[u32], point: &Point<[f32; 3]>) -> f64 {
        let at = point.splat();
        let mut sum = 0.0;
        for lights in lights.chunks(8) {
            let index = u32x8::new(std::array::from_fn(|k| lights[k.min(lights.len() - 1)]));
            let (.., value) = self.sample(index, Measure::Projected, &at, Vec2::new(X8::lit(0.5), X8::lit(0.5)));
            sum += value.to_array()[..lights.len()].iter().map(|&x| f64::from(x)).sum::<f64>();
        }
        sum
    }

    /// What the choice loses at each level, on average over these points.
    pub fn entropy(&self, points: &[Point<[f32; 3]>]) -> Entropy {
        let of = |point: &Point<[f32; 3]>| {
            let contributions = self.contributions(point);
            let at = self.own.get().at::<f32>(point.p.into(), point.n.into());
            let sum = self.sum(&at, 0, 0, point, &contributions);
            (sum.total, sum.losses)
        };
        let all: Vec<_> = points.par_iter().map(of).filter(|(total, _)| *total > 0.0).collect();
        let (mut entropy, count) = (Entropy::default(), all.len() as f64);
        for (total, losses) in all {
            for (level, distance, lowest, loss) in losses {
                let loss = loss / total / count / std::f64::consts::LN_2;
                entropy.levels.resize(entropy.levels.len().max(level + 1), 0.0);
                entropy.levels[level] += loss;
                entropy.distances[distance] += loss;
                entropy.lowest += if lowest { loss } else { 0.0 };
            }
        }
        entropy
    }

    fn sum(
        &self,
        at: &TreeAt<'_, f32>,
        node: u32,
        level: usize,
        point: &Point<[f32; 3]>,
        contributions: &[f64],
    ) -> Sum {
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        let mut all = Sum { total: 0.0, low, high, losses: Vec::new() };
        let (mut totals, mut lowest) = ([0.0; 8], true);
        let shares = at.shares(0, node);
        for ((_, child), own) in shares.into_iter().zip(&mut totals) {
            match child {
                TreeChild::Nothing => continue,
                TreeChild::Light(light) => {
                    let cluster = &self.clusters[light as usize];
                    (*own, low, high) = (contributions[light as usize], cluster.low, cluster.high);
                }
                TreeChild::Node(child) => {
                    lowest = false;
                    let sum = self.sum(at, child, level + 1, point, contributions);
                    all.losses.extend(sum.losses);
                    (*own, low, high) = (sum.total, sum.low, sum.high);
                }
            }
            all.total += *own;
            for k in 0..3 {
                (all.low[k], all.high[k]) = (all.low[k].min(low[k]), all.high[k].max(high[k]));
            }
        }
        let lit = shares.iter().zip(totals).filter(|(_, own)| *own > 0.0);
        let loss: f64 = lit.map(|((units, _), own)| own * (own / all.total * 65_536.0 / f64::from(*units)).ln()).sum();
        if loss.is_finite() && loss != 0.0 {
            let square = |of: &dyn Fn(usize) -> f32| (0..3).map(|k| of(k) * of(k)).sum::<f32>();
            let radius = square(&|k| 0.5 * (all.high[k] - all.low[k])).sqrt();
            let distance = square(&|k| 0.5 * (all.high[k] + all.low[k]) - point.p[k]).sqrt();
            let bin = ((distance / radius).log2() + 2.0).clamp(0.0, 6.0) as usize;
            all.losses.push((level, bin, lowest, loss));
        }
        all
    }

    /// The children of random nodes as seen from random points, for each distance and elevation.
    pub fn nodes(&self, count: u32, seed: u64) -> Vec<Vec<Cell>> {
        let tree = self.own.get();
        let at = tree.at::<f32>(Vec3::default(), Vec3::new(0.0, 0.0, 1.0));
        let mut all = Vec::new();
        let mut pending = vec![(0, 0)];
        while let Some((node, level)) = pending.pop() {
            all.push((level, node));
            let children = at.shares(0, node).map(|(_, child)| child);
            pending.extend(children.into_iter().filter_map(|child| match child {
                TreeChild::Node(node) => Some((node, level + 1)),
                _ => None,
            }));
        }
        all.sort_unstable();
        let levels: Vec<Vec<u32>> =
            all.chunk_by(|a, b| a.0 == b.0).map(|chunk| chunk.iter().map(|x| x.1).collect()).collect();
        let empty = || vec![vec![Cell::default(); ELEVATIONS.len()]; DISTANCES.len()];
        (0..count)
            .into_par_iter()
            .map(|i| {
                // all levels are equally likely
                let random = |k: u32| -> Vec2<f64> { Independent::new(seed).pair(i, k, 0) };
                let (mut cells, pick) = (empty(), random(0));
                let level = &levels[(pick.x * levels.len() as f64) as usize];
                self.node(level[(pick.y * level.len() as f64) as usize], random, &mut cells);
                cells
            })
            .reduce(empty, |mut a, b| {
                a.iter_mut().flatten().zip(b.into_iter().flatten()).for_each(|(a, b)| a.merge(&b));
                a
            })
    }

    fn node(&self, node: u32, random: impl Fn(u32) -> Vec2<f64>, cells: &mut [Vec<Cell>]) {
        let tree = self.own.get();
        let at = tree.at::<f32>(Vec3::default(), Vec3::new(0.0, 0.0, 1.0));
        let children: Option<Vec<Child>> = (0..)
            .zip(at.shares(0, node))
            .map(|(slot, (_, child))| {
                let lights = below(tree, child)?;
                let clusters = lights.iter().map(|&light| &self.clusters[light as usize]);
                let cluster = clusters.copied().reduce(|a, b| a.union(&b));
                let cluster = cluster.unwrap_or(Cluster::light([[0.0; 3]; 2], [0.0; 3], 0.0, false));
                Some(Child { slot, lights, cluster })
            })
            .collect();
        let Some(children) = children else { return };
        let lit = || children.iter().filter(|child| child.cluster.power > 0.0);
        let [low, high]: [[f64; 3]; 2] = [
            std::array::from_fn(|k| lit().map(|c| f64::from(c.cluster.low[k])).fold(f64::INFINITY, f64::min)),
            std::array::from_fn(|k| lit().map(|c| f64::from(c.cluster.high[k])).fold(f64::NEG_INFINITY, f64::max)),
        ];
        let center = Vec3::<f64>::from(std::array::from_fn(|k| 0.5 * (low[k] + high[k])));
        let radius = (Vec3::<f64>::from(high) - Vec3::<f64>::from(low)).length() * 0.5;
        for (d, distance) in DISTANCES.into_iter().enumerate() {
            for (e, elevation) in ELEVATIONS.into_iter().enumerate() {
                let key = 1 + 2 * (d * ELEVATIONS.len() + e) as u32;
                let (u, turn) = (random(key), random(key + 1));
                let (z, around) = (2.0 * u.x - 1.0, std::f64::consts::TAU * u.y);
                let across = (1.0 - z * z).max(0.0).sqrt();
                let away = Vec3::<f64>::new(across * around.cos(), across * around.sin(), z);
                let p = center + away * (distance * radius);
                // the normal has this elevation of the centre, and turns around it at random
                let frame = etendue::Frame::new(away);
                let (sin, cos) = elevation.to_radians().sin_cos();
                let turn = std::f64::consts::TAU * turn.x;
                let n = frame.s * (cos * turn.cos()) + frame.t * (cos * turn.sin()) - away * sin;
                let narrow = |v: Vec3<f64>| [v.x, v.y, v.z].map(|x| x as f32);
                let point = Point { p: narrow(p), n: narrow(n), albedo: [std::f32::consts::PI; 3] };
                self.compare(node, &children, &point, &mut cells[d][e]);
            }
        }
    }

    fn compare(&self, node: u32, children: &[Child], point: &Point<[f32; 3]>, cell: &mut Cell) {
        let truth: Vec<f64> = children.iter().map(|child| self.given(&child.lights, point)).collect();
        let (p, n) = (V8::from(point.p), V8::from(point.n));
        let bounds: Vec<f64> =
            children.iter().map(|child| f64::from(child.cluster.importance(p, n).to_array()[0])).collect();
        let shares = self.own.get().at::<f32>(point.p.into(), point.n.into()).shares(0, node);
        let own: Vec<f64> = shares.iter().map(|share| f64::from(share.0) / 65_536.0).collect();
        let [total, bound] = [&truth, &bounds].map(|x| x.iter().sum::<f64>());
        if total <= 0.0 || !total.is_finite() {
            return;
        }
        let mut moments = [0.0; 2];
        for (slot, &true_value) in truth.iter().enumerate().filter(|(_, x)| **x > 0.0) {
            let share = true_value / total;
            cell.children += 1;
            cell.below += u64::from(bounds[slot] < true_value * (1.0 - 1e-4));
            let shares = [if bound > 0.0 { bounds[slot] / bound } else { 0.0 }, own[slot]];
            for (k, chosen) in shares.into_iter().enumerate() {
                cell.zero[k] += u64::from(chosen <= 0.0);
                cell.ratios[k].push((chosen / share, share));
                moments[k] += if chosen > 0.0 { share * share / chosen } else { 0.0 };
            }
            let loss = |s: [f64; 2]| s[1] * s[1] / s[0];
            let now = [own[slot], share];
            if cell.worst.as_ref().is_none_or(|worst| loss(now) > loss(worst.shares)) {
                let lights = children[slot].lights.len();
                cell.worst = Some(Worst { node: [node, children[slot].slot], lights, shares: now, point: *point });
            }
        }
        for (all, moment) in cell.moments.iter_mut().zip(moments) {
            all.push(moment);
        }
    }
}
