//! Bytes read as numbers.

/// Reads bytes as numbers; zeros follow the last.
pub(super) struct Input<'a> {
    pub(super) bytes: std::slice::Iter<'a, u8>,
    /// Whether numbers may be infinite or NaN.
    pub(super) any: bool,
    /// Continues the numbers of long columns.
    pub(super) state: u32,
}

impl Input<'_> {
    pub(super) fn byte(&mut self) -> u8 {
        self.bytes.next().copied().unwrap_or(0)
    }
    pub(super) fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }
    pub(super) fn word(&mut self) -> u32 {
        u32::from_le_bytes([(); 4].map(|()| self.byte()))
    }
    pub(super) fn next(&mut self) -> u32 {
        self.state = self.state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.state
    }
    pub(super) fn ordinary(word: u32) -> f32 {
        (word >> 8) as f32 / 4_194_304.0 - 2.0
    }
    /// Often ordinary; else subnormal, huge, any bits.
    pub(super) fn number(&mut self) -> f32 {
        let kind = self.below(8);
        let word = self.word();
        let x = match kind {
            0 => f32::from_bits(word),
            1 => f32::from_bits(word >> 9),
            2 => [0.0, -0.0, 1.0, f32::MAX, f32::MIN_POSITIVE, f32::INFINITY, f32::NAN, -f32::MAX][word as usize % 8],
            _ => Self::ordinary(word),
        };
        if x.is_finite() || self.any { x } else { 1.0 }
    }
    /// A column: the first numbers from the bytes, the others ordinary.
    pub(super) fn column(&mut self, n: usize, map: impl Fn(f32) -> f32) -> Vec<f32> {
        self.state = self.word();
        let odd = self.below(4);
        (0..n)
            .map(|i| {
                map(if i < odd {
                    self.number()
                } else {
                    let word = self.next();
                    Self::ordinary(word)
                })
            })
            .collect()
    }
    pub(super) fn columns<const N: usize>(&mut self, n: usize, map: impl Fn(f32) -> f32 + Copy) -> [Vec<f32>; N] {
        std::array::from_fn(|_| self.column(n, map))
    }
}

/// A number in [0, 1) from any; NaN remains.
pub(super) fn fraction(x: f32) -> f32 {
    let x = x - x.floor();
    if x < 1.0 || x.is_nan() { x } else { 0.0 }
}
pub(super) fn unit([x, y, z]: [f32; 3]) -> [f32; 3] {
    let v = [x, y, z].map(f64::from);
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 || length.is_nan() { v.map(|x| (x / length) as f32) } else { [0.0, 0.0, 1.0] }
}
/// The same columns with unit vectors across them.
pub(super) fn units(columns: [Vec<f32>; 3]) -> [Vec<f32>; 3] {
    let mut out = columns;
    for i in 0..out[0].len() {
        let v = unit([out[0][i], out[1][i], out[2][i]]);
        for (column, x) in out.iter_mut().zip(v) {
            column[i] = x;
        }
    }
    out
}
