//! Equal input gives the same bits on every processor: one hash per routine and precision of all numbers that it returns, over the regimes
//! of the generators and at every width. The committed table, `tests/bits/bits.txt`, is the reference.
//!
//! `cargo run -p etendue-bits` compares, for the processor and the compiler flags that it is built with; `-- NAME` prints all numbers of a
//! routine instead, to be compared with those of another processor, and `-- --write` replaces the table.

mod choices;
mod figures;
mod functions;
mod lights;
mod pictures;
mod reflections;
mod sequences;
mod warps;

use figures::{Entry, List};
pub use figures::{Figures, Routine};

/// The committed table.
pub const TABLE: &str = include_str!("../bits.txt");
/// How to replace it.
pub const REPLACE: &str = "cargo run -p etendue-bits -- --write";

fn each(mut take: impl FnMut(Entry)) {
    let mut list = List::new(&mut take);
    sequences::add(&mut list);
    functions::add(&mut list);
    warps::add(&mut list);
    lights::add(&mut list);
    pictures::add(&mut list);
    reflections::add(&mut list);
    choices::add(&mut list);
}

/// The hashes of one routine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RoutineHashes {
    /// The routine.
    pub name: String,
    /// The hash of single precision, and that of double precision.
    pub hashes: [u64; 2],
    /// The widths whose bits differ from those of the scalars, and numbers that are none.
    pub faults: Vec<String>,
}

/// The hashes of all routines, on this processor.
#[must_use]
pub fn rows() -> Vec<RoutineHashes> {
    let mut rows = Vec::new();
    each(|Entry { name, widths }| {
        // the first width of a precision is that of the table
        let first = |precision: &str| widths.iter().find(|(width, _)| width.starts_with(precision));
        let hash = |precision: &str| first(precision).map_or(0, |(_, figures)| figures.hash());
        let mut faults = Vec::new();
        for (width, figures) in &widths {
            if figures.hash() != hash(&width[..3]) {
                let other = first(&width[..3]).map_or("", |(other, _)| *other);
                faults.push(format!("{width} differs from {other}"));
            }
            if figures.nans() > 0 {
                faults.push(format!("{width} returns NaN {} times", figures.nans()));
            }
        }
        rows.push(RoutineHashes { name, hashes: [hash("f32"), hash("f64")], faults });
    });
    rows
}

/// The lines of the table.
#[must_use]
pub fn text(rows: &[RoutineHashes]) -> String {
    rows.iter()
        .map(|RoutineHashes { name, hashes: [single, double], .. }| format!("{name} {single:016x} {double:016x}\n"))
        .collect()
}

/// What differs from the table, a line for each routine.
#[must_use]
pub fn differences(rows: &[RoutineHashes], table: &str) -> Vec<String> {
    let mut expected: Vec<&str> = table.lines().collect();
    let mut all = Vec::new();
    for row in rows {
        all.extend(row.faults.iter().map(|fault| format!("{}: {fault}", row.name)));
        let line = text(core::slice::from_ref(row));
        let fields = |line: &str| line.split(' ').map(str::to_owned).collect::<Vec<_>>();
        let found = expected.iter().position(|line| fields(line)[0] == row.name).map(|at| expected.swap_remove(at));
        match found {
            None => all.push(format!("{}: not in the table", row.name)),
            Some(found) => {
                let (found, line) = (fields(found), fields(line.trim_end()));
                for (k, precision) in ["single precision", "double precision"].iter().enumerate() {
                    if found.get(k + 1) != line.get(k + 1) {
                        all.push(format!("{}: {precision} differs from the table", row.name));
                    }
                }
            }
        }
    }
    all.extend(expected.iter().map(|line| format!("{line}: no such routine")));
    all
}

/// All numbers of the routine, in hexadecimal: one line per slot and width.
#[must_use]
pub fn listing(routine: &str) -> Vec<String> {
    let mut lines = Vec::new();
    each(|Entry { name, widths }| {
        if name == routine {
            lines.extend(widths.iter().flat_map(|(width, figures)| figures.lines(width)));
        }
    });
    lines
}
