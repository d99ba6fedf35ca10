//! What the command lines of the renderer and of its laboratory share.

use clap::ValueEnum;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// Parses `WxH`.
///
/// # Errors
/// Fails if the text is not two numbers joined by `x`, or if the size is out of range.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X']).ok_or("must be WIDTHxHEIGHT, such as 640x480")?;
    let side = |s: &str| match s.parse::<u32>() {
        Ok(n) if (1..=65_536).contains(&n) => Ok(n),
        _ => Err(format!("each side must be from 1 to 65536, not {s:?}")),
    };
    let (width, height) = (side(sides.0)?, side(sides.1)?);
    if u64::from(width) * u64::from(height) > 1 << 28 {
        return Err(format!("at most 2^28 pixels are supported, not {width}x{height}"));
    }
    Ok((width, height))
}

/// A value's name on the command line.
#[must_use]
pub fn name(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned())
}

/// The threads of a command: `threads`, or one per core if it is 0. More than 64 threads, or than four per core if that is more, only
/// cost time; the number is then reduced, and a warning on standard error says so.
///
/// # Errors
/// Fails if the system cannot start the threads.
pub fn pool(threads: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let most = (4 * cores).max(64);
    if threads > most {
        eprintln!("warning: --threads {threads} is more than {cores} core(s) can use: {most} threads are used");
    }
    ThreadPoolBuilder::new().num_threads(threads.min(most)).build()
}
