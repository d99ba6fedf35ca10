//! What the command lines of the renderer and of its laboratory share.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use etendue_render::scene::limits::{MOST_PIXELS, MOST_SIDE, is_size};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::fmt::Display;
use std::io::{self, StdoutLock, Write};
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Standard output, locked. Its errors say what could not be written to.
pub fn out() -> impl Write {
    Out(io::stdout().lock())
}

struct Out(StdoutLock<'static>);

fn of_out(error: io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("standard output: cannot write: {error}"))
}

impl Write for Out {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes).map_err(of_out)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(of_out)
    }
}

/// Writes a line to standard error. If that is full or closed, nothing is written: no image is lost for the sake of a message.
pub fn say(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// A parser of whole numbers in this range, which must be one of numbers of type `T`.
pub fn whole<T: TryFrom<u64>>(range: RangeInclusive<u64>) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let valid = text.parse().ok().filter(|n| range.contains(n)).and_then(|n| T::try_from(n).ok());
        valid.ok_or_else(|| format!("must be a whole number from {} to {}", range.start(), range.end()))
    }
}

/// Parses `WxH`.
///
/// # Errors
/// Fails if the text is not two numbers joined by `x`, or if the size is out of range.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once(['x', 'X']).ok_or("must be WIDTHxHEIGHT, such as 640x480")?;
    let side = |s: &str| match s.parse::<u32>() {
        Ok(n) if (1..=MOST_SIDE).contains(&n) => Ok(n),
        _ => Err(format!("each side must be from 1 to {MOST_SIDE}, not {s:?}")),
    };
    let (width, height) = (side(sides.0)?, side(sides.1)?);
    if !is_size(width.into(), height.into()) {
        return Err(format!("at most {MOST_PIXELS} pixels are supported, not {width}x{height}"));
    }
    Ok((width, height))
}

/// A parser of these names, each with what it means.
pub fn named<T>(names: &'static [[&'static str; 2]]) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err = String> + Clone + Send + Sync + 'static,
{
    let values = names.iter().map(|[name, about]| PossibleValue::new(*name).help(*about));
    PossibleValuesParser::new(values).try_map(|name| name.parse())
}

/// Parses `--threads`.
///
/// # Errors
/// Fails if the text is no whole number.
pub fn threads(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "must be a whole number, such as 8, or 0 for one thread per core".to_owned())
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
        say(format_args!("warning: --threads {threads} is more than {cores} core(s) can use: {most} threads are used"));
    }
    ThreadPoolBuilder::new().num_threads(threads.min(most)).build()
}
