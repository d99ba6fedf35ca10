//! Columns in memory.

use super::input::Input;
use super::{CANARY, Column, GAP, Output, same};
use etendue_c::EtendueStatus;

/// Columns of any alignment, with canaries around them.
pub(super) struct Memory {
    bytes: Vec<u8>,
    starts: Vec<usize>,
    n: usize,
}

impl Memory {
    pub(super) fn new(input: &mut Input<'_>, columns: usize, n: usize) -> Self {
        let shift = input.below(4);
        let starts = (0..columns).map(|k| GAP + shift + k * (4 * n + GAP + shift)).collect();
        Self { bytes: vec![CANARY; columns * (4 * n + GAP + shift) + 2 * GAP], starts, n }
    }
    pub(super) fn of(input: &mut Input<'_>, columns: &[Vec<f32>]) -> Self {
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
    /// Asserts that a call for these columns, which has all pointers unless `is_null`, has the status for that and wrote nothing else; and that
    /// each element, of so many bytes or 0 where a column is absent, is what the element gives alone, finite if all inputs are.
    pub(super) fn has(
        &self,
        status: EtendueStatus,
        is_null: bool,
        widths: &[usize],
        is_finite: bool,
        alone: impl Fn(usize) -> Option<Vec<f32>>,
    ) {
        let is_refused = self.n > 0 && is_null;
        assert_eq!(status, if is_refused { EtendueStatus::NullPointer } else { EtendueStatus::Ok });
        let mut written = vec![false; self.bytes.len()];
        for (start, width) in self.starts.iter().zip(widths).filter(|_| !is_refused) {
            written[*start..start + width * self.n].fill(true);
        }
        let is_kept = self.bytes.iter().zip(written).all(|(byte, written)| written || *byte == CANARY);
        assert!(is_kept, "a byte beyond the outputs");
        for i in 0..if is_null { 0 } else { self.n } {
            let Some(one) = alone(i) else { continue };
            for (k, x) in one.into_iter().enumerate() {
                assert!(!is_finite || x.is_finite(), "{x} from finite input");
                let found = match widths.get(k) {
                    Some(4) => self.get(k, i),
                    Some(1) => self.bytes[self.starts[k] + i].into(),
                    _ => continue,
                };
                assert!(same(found, x), "column {k} of element {i}: {found} is not {x}");
            }
        }
    }
}
