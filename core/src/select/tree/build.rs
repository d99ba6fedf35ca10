//! Builds the tree: splits lights into nodes of eight, and summarises them from the leaves up.

use super::node::{LIGHT, Node8};
use super::part::{Part, Units};
use crate::real::Real;
use crate::select::LightBound;

/// Runs two halves of the building, at once if it can; `()` runs one after the other.
pub trait Join: Sync {
    /// Runs both.
    fn join(&self, a: impl FnOnce() + Send, b: impl FnOnce() + Send);
}

impl Join for () {
    fn join(&self, a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
        a();
        b();
    }
}

/// Ranges of fewer lights are built by one thread.
const ALONE: usize = 4096;
/// Number of bins along an axis.
const BINS: usize = 16;

/// Number of nodes that `count` lights need at most: those of eight lights, those of 64, and those above.
pub(super) const fn nodes_for(count: usize) -> usize {
    if count <= 8 {
        return 1;
    }
    let units = count.div_ceil(64);
    count.div_ceil(8) + units + (4 * units - 1) / 7
}

/// Positions at which a range may be split are multiples of this, so that the lowest nodes are full.
const fn unit(count: usize) -> usize {
    match count {
        0..=8 => 1,
        9..=64 => 8,
        _ => 64,
    }
}

/// The lights, and how they are measured.
pub(super) struct Build<'a, J> {
    pub(super) lights: &'a [LightBound],
    pub(super) units: Units,
    pub(super) join: &'a J,
}

/// A child that is yet to be built.
struct Task<'a> {
    order: &'a mut [u32],
    nodes: &'a mut [Node8],
    index: u32,
    link: u32,
    part: &'a mut Part,
}

/// Sums of the lights of a bin.
#[derive(Clone, Copy)]
struct Bin {
    count: u32,
    power: f32,
    low: [f32; 3],
    high: [f32; 3],
    normal: [f32; 3],
}

impl Bin {
    const EMPTY: Self =
        Self { count: 0, power: 0.0, low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3], normal: [0.0; 3] };

    fn add(&mut self, other: &Self) {
        self.count += other.count;
        self.power += other.power;
        for k in 0..3 {
            self.low[k] = self.low[k].lesser(other.low[k]);
            self.high[k] = self.high[k].greater(other.high[k]);
            self.normal[k] += other.normal[k];
        }
    }
    fn of(light: &LightBound, units: Units) -> Self {
        // a light without power has a place, too
        let power = (light.power * units.power).clamped(f32::MIN_POSITIVE, f32::MAX);
        let normal = if light.two_sided { [0.0; 3] } else { light.normal.map(|x| x * power) };
        let center = light.center.map(|x| x * units.length);
        Self { count: 1, power, low: center, high: center, normal }
    }
    /// What it costs to treat these lights as one: power · squared extent · a factor for the spread of their directions.
    fn cost(&self, least: f32) -> f32 {
        let normal: f32 = self.normal.iter().map(|x| x / self.power.greater(f32::MIN_POSITIVE)).map(|x| x * x).sum();
        let squared: f32 = (0..3).map(|k| (self.high[k] - self.low[k]).greater(0.0)).map(|x| x * x).sum();
        self.power * (squared + least) * (3.0 - 2.0 * normal.lesser(1.0))
    }
}

impl<J: Join> Build<'_, J> {
    fn light(&self, index: u32) -> &LightBound {
        &self.lights[index as usize]
    }
    /// The coordinates of a light's centre and of its normal.
    fn keys(&self, index: u32) -> [f32; 6] {
        let LightBound { center: [x, y, z], normal: [a, b, c], .. } = *self.light(index);
        let [x, y, z] = [x, y, z].map(|x| x * self.units.length);
        [x, y, z, a, b, c]
    }

    /// Builds the nodes of a range into the first of `nodes`, whose index is `index`.
    pub(super) fn range(&self, order: &mut [u32], nodes: &mut [Node8], index: u32, link: u32) -> Part {
        let mut starts = [0; 9];
        let children = self.children(order, &mut starts);
        let Some((own, mut nodes)) = nodes.split_first_mut() else { return Part::default() };
        *own = Node8::default();
        own.link = link;
        let mut parts = [Part::default(); 8];
        let (mut rest, mut next, parallel) = (order, index + 1, starts[children] > ALONE);
        let mut tasks: [Option<Task>; 8] = [const { None }; 8];
        let mut places = [0; 8];
        for ((slot, part), task) in parts.iter_mut().enumerate().take(children).zip(&mut tasks) {
            let count = starts[slot + 1] - starts[slot];
            let (order, more) = rest.split_at_mut(count);
            rest = more;
            if let [light] = *order {
                places[slot] = light | LIGHT;
                *part = Part::light(self.light(light), self.units);
                continue;
            }
            places[slot] = next;
            let (mine, others) = nodes.split_at_mut(nodes_for(count));
            nodes = others;
            *task = Some(Task { order, nodes: mine, index: next, link: index << 3 | slot as u32, part });
            next += nodes_for(count) as u32;
        }
        self.run(&mut tasks[..children], parallel);
        for slot in 0..children {
            own.set(slot, places[slot], &parts[slot]);
        }
        own.union()
    }

    fn run(&self, tasks: &mut [Option<Task>], parallel: bool) {
        match tasks {
            [] => {}
            [task] => {
                if let Some(task) = task.take() {
                    *task.part = self.range(task.order, task.nodes, task.index, task.link);
                }
            }
            _ => {
                let (a, b) = tasks.split_at_mut(tasks.len() / 2);
                if parallel {
                    self.join.join(|| self.run(a, true), || self.run(b, true));
                } else {
                    self.run(a, false);
                    self.run(b, false);
                }
            }
        }
    }

    /// Splits a range into at most eight, whose starts it sets; returns their number.
    fn children(&self, order: &mut [u32], starts: &mut [usize; 9]) -> usize {
        let count = order.len();
        if count <= 8 {
            for (k, start) in starts.iter_mut().enumerate() {
                *start = k.min(count);
            }
            return count;
        }
        let unit = unit(count);
        let mut costs = [f32::INFINITY; 8];
        (starts[0], starts[1]) = (0, count);
        let mut children = 1;
        while children < 8 {
            // the range of the greatest cost that can be split; one of more than half of the lights first, which bounds the depth
            let size = |k: usize| starts[k + 1] - starts[k];
            let rank = |k: usize| (2 * size(k) > count, costs[k]);
            let by_cost = |a: &usize, b: &usize| {
                let (a, b) = (rank(*a), rank(*b));
                a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
            };
            let Some(k) = (0..children).filter(|&k| size(k) > unit).max_by(by_cost) else { break };
            let (start, end) = (starts[k], starts[k + 1]);
            let (middle, [left, right]) = self.split(&mut order[start..end], unit);
            starts.copy_within(k + 1..=children, k + 2);
            starts[k + 1] = start + middle;
            costs.copy_within(k + 1..children, k + 2);
            (costs[k], costs[k + 1]) = (left, right);
            children += 1;
        }
        children
    }

    /// Splits a range in two at a multiple of `unit`, where the sum of the costs is least. Returns the position, and the costs.
    fn split(&self, order: &mut [u32], unit: usize) -> (usize, [f32; 2]) {
        let count = order.len();
        let (mut low, mut high) = ([f32::INFINITY; 6], [f32::NEG_INFINITY; 6]);
        for &light in &*order {
            for (axis, x) in self.keys(light).into_iter().enumerate() {
                low[axis] = low[axis].lesser(x);
                high[axis] = high[axis].greater(x);
            }
        }
        let widest = |axes: [usize; 3]| {
            let wider = |a: &usize, b: &usize| (high[*a] - low[*a]).total_cmp(&(high[*b] - low[*b]));
            axes.into_iter().max_by(wider).unwrap_or(0)
        };
        let least = (0..3).map(|k| high[k] - low[k]).map(|x| x * x).sum::<f32>() * 1e-3;
        let most = count.div_ceil(unit) * unit - unit;
        let margin = (count / 16).div_ceil(unit) * unit;
        let (first, last) = (margin.max(unit).min(most), (count - margin.min(count)) / unit * unit);
        let last = last.max(first).min(most);
        let mut best = (f32::INFINITY, widest([0, 1, 2]), (count / 2 / unit * unit).clamp(first, last), [0.0; 2]);
        let axes = [widest([0, 1, 2]), widest([3, 4, 5])];
        let scales = axes.map(|axis| BINS as f32 / (high[axis] - low[axis]));
        let mut bins = [[Bin::EMPTY; BINS]; 2];
        for &light in &*order {
            let (keys, bin) = (self.keys(light), Bin::of(self.light(light), self.units));
            for ((bins, axis), scale) in bins.iter_mut().zip(axes).zip(scales) {
                // without an extent this is NaN, and the first
                bins[(((keys[axis] - low[axis]) * scale) as usize).min(BINS - 1)].add(&bin);
            }
        }
        for (axis, bins) in axes.into_iter().zip(&bins) {
            let mut after = [Bin::EMPTY; BINS + 1];
            for k in (0..BINS).rev() {
                after[k] = after[k + 1];
                after[k].add(&bins[k]);
            }
            let mut before = Bin::EMPTY;
            for k in 1..BINS {
                before.add(&bins[k - 1]);
                let costs = [before.cost(least), after[k].cost(least)];
                let position = ((before.count as usize + unit / 2) / unit * unit).clamp(first, last);
                if before.count > 0 && after[k].count > 0 && costs[0] + costs[1] < best.0 {
                    best = (costs[0] + costs[1], axis, position, costs);
                }
            }
        }
        let (_, axis, position, costs) = best;
        let by_key = |a: &u32, b: &u32| self.keys(*a)[axis].total_cmp(&self.keys(*b)[axis]).then(a.cmp(b));
        order.select_nth_unstable_by(position, by_key);
        (position, costs)
    }
}
