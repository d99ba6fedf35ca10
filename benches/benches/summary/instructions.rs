//! Instructions per sample, which do not depend on how busy the machine is: Valgrind counts them, and Callgrind dumps its counters at every
//! call of a marker function.

use etendue::{f32x4, f32x8, f32x16};
use etendue_routines::{Routine, SAMPLES, without_tables};
use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};

/// The argument that makes the program run the routines for [`count`].
pub(crate) const CHILD: &str = "--callgrind-child";

/// The widths of packets that are measured: 1, 4, 8 and 16 lanes.
pub(crate) const WIDTHS: usize = 4;

/// The marker: Callgrind dumps its counters before each call.
#[inline(never)]
fn etendue_bench_mark() {
    black_box(());
}

/// Calls each routine whose name contains `filter`, in the order of the results of [`count`].
pub(crate) fn child(filter: &str) {
    let widths =
        [without_tables::<f32>(), without_tables::<f32x4>(), without_tables::<f32x8>(), without_tables::<f32x16>()];
    let mut every: Vec<Routine> = widths.into_iter().flatten().filter(|r| r.name.contains(filter)).collect();
    for routine in &mut every {
        // the first call initialises lazily built state
        (routine.run)();
        etendue_bench_mark();
        (routine.run)();
        etendue_bench_mark();
    }
}

/// Instructions per sample in f32, f32x4, f32x8 and f32x16, of each routine whose name contains `filter`.
///
/// Fails if Valgrind is missing, does not run the program, or reports an unexpected number of dumps.
pub(crate) fn count(filter: &str) -> Result<Vec<(String, [f64; WIDTHS])>, String> {
    let scratch = std::env::temp_dir().join(format!("etendue-callgrind-{}", std::process::id()));
    fs::create_dir_all(&scratch).map_err(|e| format!("{}: {e}", scratch.display()))?;
    let counts = dumps(filter, &scratch);
    // also after an error
    let _ = fs::remove_dir_all(&scratch);
    let names: Vec<String> =
        without_tables::<f32>().into_iter().map(|r| r.name).filter(|n| n.contains(filter)).collect();
    let counts = counts?;
    // dumps alternate between a routine and what lies between two routines
    let runs: Vec<f64> = counts.into_iter().skip(1).step_by(2).map(|n| n as f64 / SAMPLES as f64).collect();
    let n = names.len();
    if runs.len() != WIDTHS * n {
        return Err(format!("callgrind counted {} runs of {n} routines at {WIDTHS} widths", runs.len()));
    }
    Ok(names.into_iter().enumerate().map(|(i, name)| (name, std::array::from_fn(|w| runs[w * n + i]))).collect())
}

/// The instructions between consecutive markers.
fn dumps(filter: &str, scratch: &Path) -> Result<Vec<u64>, String> {
    let program = std::env::current_exe().map_err(|e| e.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--dump-before=*etendue_bench_mark*"])
        .arg(format!("--callgrind-out-file={}", scratch.join("out").display()))
        .arg(&program)
        .args([CHILD, filter])
        .stdin(Stdio::null())
        .output()
        .map_err(|e| format!("valgrind: {e}; counting instructions requires Valgrind"))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(format!("valgrind ended with {}: {}", output.status, said.lines().last().unwrap_or_default()));
    }
    let mut counts = Vec::new();
    for i in 1.. {
        let Ok(text) = fs::read_to_string(scratch.join(format!("out.{i}"))) else { break };
        let total = text.lines().find_map(|l| l.strip_prefix("totals: "));
        counts.push(
            total.and_then(|t| t.trim().parse().ok()).ok_or_else(|| format!("callgrind's dump {i} has no totals"))?,
        );
    }
    Ok(counts)
}
