//! Columns in memory.

use super::input::Input;
use super::{CANARY, Column, GAP, Output};

/// Columns of any alignment, with canaries around them.
pub(super) struct Memory {
    pub(super) bytes: Vec<u8>,
    pub(super) starts: Vec<usize>,
    n: usize,
}

impl Memory {
    pub(super) fn new(input: &mut Input<'_>, columns: usize, n: usize) -> Self {
        let shift = input.below(4);
        let starts = (0..columns).map(|k| GAP + shift + k * (4 * n + GAP + shift)).collect();
        Self { bytes: vec![CANARY; columns * (4 * n + GAP + shift) + 2 * GAP], starts, n }
    }
    pub(super) fn of(input: &mut Input<'_>, columns: &[&[f32]]) -> Self {
        let mut memory = Self::new(input, columns.len(), columns[0].len());
        for (k, column) in columns.iter().enumerate() {
            for (i, x) in column.iter().enumerate() {
                let at = memory.starts[k] + 4 * i;
                memory.bytes[at..at + 4].copy_from_slice(&x.to_ne_bytes());
            }
        }
        memory
    }
    pub(super) fn outputs<const N: usize>(&mut self) -> [Output; N] {
        let bytes = self.bytes.as_mut_ptr();
        std::array::from_fn(|k| bytes.wrapping_add(self.starts[k]).cast())
    }
    pub(super) fn inputs<const N: usize>(&self) -> [Column; N] {
        std::array::from_fn(|k| self.bytes.as_ptr().wrapping_add(self.starts[k]).cast())
    }
    pub(super) fn get(&self, column: usize, i: usize) -> f32 {
        let at = self.starts[column] + 4 * i;
        f32::from_ne_bytes(self.bytes[at..at + 4].try_into().unwrap())
    }
    /// Asserts that only the first bytes of those columns changed: `widths` are bytes per element.
    pub(super) fn only(&self, widths: &[usize]) {
        let mut written = vec![false; self.bytes.len()];
        for (start, width) in self.starts.iter().zip(widths) {
            written[*start..start + width * self.n].fill(true);
        }
        assert!(
            self.bytes.iter().zip(written).all(|(byte, written)| written || *byte == CANARY),
            "a byte beyond the outputs"
        );
    }
}
