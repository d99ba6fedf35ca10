//! Instructions per sample, which are the same on a busy machine: counted by Valgrind, of which Callgrind dumps its counters at every call
//! of a marker.

use etendue::{f32x4, f32x8};
use etendue_benches::{Routine, SAMPLES, routines};
use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};

/// The argument with which the program counts for [`count`].
pub(crate) const CHILD: &str = "--callgrind-child";

/// Before this the counters are written out.
#[inline(never)]
fn etendue_bench_mark() {
    black_box(());
}

/// A call of each routine whose name holds `filter`, in the order of [`count`]'s answer.
pub(crate) fn child(filter: &str) {
    let mut every: Vec<Routine> = [routines::<f32>(), routines::<f32x4>(), routines::<f32x8>()]
        .into_iter()
        .flatten()
        .filter(|r| r.name.contains(filter))
        .collect();
    for routine in &mut every {
        // whatever is initialised on the first call
        (routine.run)();
        etendue_bench_mark();
        (routine.run)();
        etendue_bench_mark();
    }
}

/// Per sample in f32, f32x4 and f32x8, of each routine whose name holds `filter`.
///
/// It is an error if Valgrind is missing, does not run the program, or counts something else.
pub(crate) fn count(filter: &str) -> Result<Vec<(String, [f64; 3])>, String> {
    let scratch = std::env::temp_dir().join(format!("etendue-callgrind-{}", std::process::id()));
    fs::create_dir_all(&scratch).map_err(|e| format!("{}: {e}", scratch.display()))?;
    let counts = dumps(filter, &scratch);
    // whatever came of it
    let _ = fs::remove_dir_all(&scratch);
    let names: Vec<String> = routines::<f32>().into_iter().map(|r| r.name).filter(|n| n.contains(filter)).collect();
    let counts = counts?;
    // from a marker to the next: a routine, or what lies between two routines
    let runs: Vec<f64> = counts.into_iter().skip(1).step_by(2).map(|n| n as f64 / SAMPLES as f64).collect();
    if runs.len() != 3 * names.len() {
        return Err(format!("callgrind counted {} runs of {} routines at three widths", runs.len(), names.len()));
    }
    let n = names.len();
    Ok(names.into_iter().enumerate().map(|(i, name)| (name, [runs[i], runs[n + i], runs[2 * n + i]])).collect())
}

/// The instructions before each marker, since the one before.
fn dumps(filter: &str, scratch: &Path) -> Result<Vec<u64>, String> {
    let program = std::env::current_exe().map_err(|e| e.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--dump-before=*etendue_bench_mark*"])
        .arg(format!("--callgrind-out-file={}", scratch.join("out").display()))
        .arg(&program)
        .args([CHILD, filter])
        .stdin(Stdio::null())
        .output()
        .map_err(|e| format!("valgrind: {e}; it counts the instructions and has to be installed"))?;
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
