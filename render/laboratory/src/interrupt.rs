//! Ctrl-C, and the other signals that ask the program to end.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

/// Calls `handler` for each signal that asks the program to end, with the exit code that shells use for it: 130 for Ctrl-C, 143 for
/// SIGTERM and 129 for a terminal that is closed. A signal that was ignored when the program began stays so, as `nohup` wants it.
///
/// It must be called before the program starts other threads.
///
/// # Errors
/// Fails if the system does not allow it.
#[cfg(unix)]
pub fn on_end(mut handler: impl FnMut(i32) + Send + 'static) -> io::Result<()> {
    use nix::sys::signal::{SigSet, Signal};
    let ignored = ignored();
    let mut signals = SigSet::empty();
    for signal in [Signal::SIGINT, Signal::SIGTERM, Signal::SIGHUP] {
        if ignored >> (signal as u32 - 1) & 1 == 0 {
            signals.add(signal);
        }
    }
    // all threads that are started from now on leave them to the one below
    signals.thread_block()?;
    std::thread::Builder::new().name("signals".into()).spawn(move || {
        while let Ok(signal) = signals.wait() {
            handler(128 + signal as i32);
        }
    })?;
    Ok(())
}

/// Makes a file that is longer than the system allows an error of whoever writes it, as on a full disk, and not the end of the program.
pub fn survive_limits_of_files() {
    #[cfg(unix)]
    {
        use nix::sys::signal::{SigSet, Signal};
        let mut signals = SigSet::empty();
        signals.add(Signal::SIGXFSZ);
        // of a blocked signal, only the error is left; all threads that are started from now on block it, too
        let _ = signals.thread_block();
    }
}

/// The signals that are ignored, each a bit, where Linux tells.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let digits = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    digits.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok()).unwrap_or(0)
}

/// Calls `handler` with 130 for each Ctrl-C.
///
/// # Errors
/// Fails if the system does not allow it.
#[cfg(not(unix))]
pub fn on_end(mut handler: impl FnMut(i32) + Send + 'static) -> io::Result<()> {
    ctrlc::set_handler(move || handler(130)).map_err(io::Error::other)
}

/// A flag that Ctrl-C sets: measuring stops after the current image. A second Ctrl-C ends the program. The number is the exit code that the
/// signal asks for; 0 without one.
///
/// # Errors
/// Fails if the signal handler cannot be installed.
pub(crate) fn interrupt() -> io::Result<(Arc<AtomicBool>, Arc<AtomicI32>)> {
    let (flag, asked) = <(Arc<AtomicBool>, Arc<AtomicI32>)>::default();
    let (set, code) = (Arc::clone(&flag), Arc::clone(&asked));
    on_end(move |signal| {
        if code.swap(signal, Ordering::Relaxed) != 0 {
            std::process::exit(signal);
        }
        set.store(true, Ordering::Relaxed);
    })?;
    Ok((flag, asked))
}
