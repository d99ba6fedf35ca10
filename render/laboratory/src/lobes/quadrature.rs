//! Integrals of several functions over a rectangle, with a peak at a known point.

use etendue_oracle::gauss_legendre;

/// Nodes along each side of a part.
const NODES: usize = 8;
/// Splits of a part at most.
const DEEPEST: u32 = 24;

#[derive(Clone, Copy)]
struct Part {
    low: [f64; 2],
    high: [f64; 2],
}

impl Part {
    fn quarters(self) -> [Self; 4] {
        let Self { low, high } = self;
        let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
        std::array::from_fn(|i| {
            let side = |k: usize| if i >> k & 1 == 0 { [low[k], middle[k]] } else { [middle[k], high[k]] };
            let [x, y] = [side(0), side(1)];
            Self { low: [x[0], y[0]], high: [x[1], y[1]] }
        })
    }
    /// Whether its longer side is greater than the given length plus its distance from the point.
    fn is_coarse(self, peak: [f64; 2], length: f64) -> bool {
        let Self { low, high } = self;
        let [dx, dy] = [0, 1].map(|k| (low[k] - peak[k]).max(peak[k] - high[k]).max(0.0));
        (high[0] - low[0]).max(high[1] - low[1]) > length + libm::hypot(dx, dy)
    }
}

/// ∫ of `N` functions over the rectangle from `low` to `high`.
///
/// Parts become smaller towards the peak, down to a fraction of its `width`, and are then split until a split changes none of the sums by more
/// than `tolerance` times the sum of magnitudes of that function's parts.
pub fn integrate<const N: usize>(
    f: &impl Fn(f64, f64) -> [f64; N],
    [low, high]: [[f64; 2]; 2],
    peak: Option<[f64; 2]>,
    width: f64,
    tolerance: f64,
) -> [f64; N] {
    let nodes = gauss_legendre::<NODES>();
    let tensor = |part: Part| {
        let [dx, dy] = [0, 1].map(|k| part.high[k] - part.low[k]);
        let mut sums = [0.0; N];
        for &(x, wx) in &nodes {
            for &(y, wy) in &nodes {
                let values = f(part.low[0] + dx * x, part.low[1] + dy * y);
                sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += wx * wy * dx * dy * value);
            }
        }
        sums
    };
    let (mut coarse, mut parts) = (vec![Part { low, high }], Vec::new());
    while let Some(part) = coarse.pop() {
        let is_coarse = peak.is_some_and(|peak| part.is_coarse(peak, width));
        if is_coarse { coarse.extend(part.quarters()) } else { parts.push((part, tensor(part), 0)) }
    }
    let mut allowed = [0.0; N];
    for (_, sums, _) in &parts {
        allowed.iter_mut().zip(sums).for_each(|(allowed, sum)| *allowed += tolerance * sum.abs());
    }
    let mut all = [0.0; N];
    while let Some((part, whole, depth)) = parts.pop() {
        let quarters = part.quarters().map(|quarter| (quarter, tensor(quarter), depth + 1));
        let sums: [f64; N] = std::array::from_fn(|k| quarters.iter().map(|(_, sums, _)| sums[k]).sum());
        let is_near = (0..N).all(|k| (sums[k] - whole[k]).abs() <= allowed[k]);
        if is_near || depth >= DEEPEST {
            all.iter_mut().zip(sums).for_each(|(all, sum)| *all += sum);
        } else {
            parts.extend(quarters);
        }
    }
    all
}
