//! What Ctrl-C and SIGTERM do to a rendering: they clear the progress bar, say which image is in the file, and exit with code 130 or 143. A
//! rendering that can write what it has is stopped first; a second signal ends it at once.

use etendue_laboratory::interrupt::on_end;
use etendue_laboratory::options::say;
use indicatif::ProgressBar;
use std::io;
use std::path::Path;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What to do and to say when the program is interrupted.
pub(crate) struct Status {
    /// The progress bar to clear.
    pub(crate) bar: ProgressBar,
    /// Which image, if any, is on disk.
    pub(crate) text: String,
    /// Writes an image that is newer than the one on disk, and returns which that is then.
    pub(crate) last: Option<Last>,
    /// What stops the rendering, if it then writes what it has.
    stop: Option<Arc<Stop>>,
}

impl Status {
    /// Takes note of what the file holds now, so that a signal says that and ends the program at once.
    pub(crate) fn hold(&mut self, text: String) {
        (self.text, self.last, self.stop) = (text, None, None);
    }
}

/// Whether a rendering is to stop.
#[derive(Debug, Default)]
pub(crate) struct Stop {
    pub(crate) flag: AtomicBool,
    code: AtomicI32,
}

impl Stop {
    /// Whether a signal has come.
    pub(crate) fn is_set(&self) -> bool {
        self.flag.load(Ordering::Acquire)
    }
}

type Last = Box<dyn FnOnce() -> Result<String, String> + Send>;

/// The status, shared with the handler of signals.
#[derive(Clone)]
pub(crate) struct Interrupt(Arc<Mutex<Status>>);

impl Interrupt {
    /// Installs the handler, before other threads are started.
    pub(crate) fn new() -> io::Result<Self> {
        let status = Status { bar: ProgressBar::hidden(), text: "nothing was written".into(), last: None, stop: None };
        let interrupt = Self(Arc::new(Mutex::new(status)));
        let handler = interrupt.clone();
        on_end(move |code| {
            let mut status = handler.lock();
            if let Some(stop) = status.stop.take() {
                stop.code.store(code, Ordering::Release);
                stop.flag.store(true, Ordering::Release);
                return;
            }
            status.bar.finish_and_clear();
            let text = match status.last.take().map(|write| write()) {
                Some(Ok(text)) => text,
                Some(Err(error)) => format!("{error}; {}", status.text),
                None => status.text.clone(),
            };
            say(format_args!("interrupted: {text}"));
            process::exit(code);
        })?;
        Ok(interrupt)
    }
    /// Locks the status. The handler waits for it, so files that are written meanwhile are complete when the program ends.
    pub(crate) fn lock(&self) -> MutexGuard<'_, Status> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
    /// Takes note of the bar to clear and the file that is not written yet.
    pub(crate) fn watch(&self, bar: &ProgressBar, file: &Path) {
        let state = if file.exists() { "is unchanged" } else { "does not exist" };
        let text = format!("{} {state}", file.display());
        *self.lock() = Status { bar: bar.clone(), text, last: None, stop: None };
    }
    /// Like [`watch`](Self::watch), for a rendering that ends soon after its stop is set, and then writes what it has and
    /// [ends](Self::end).
    pub(crate) fn stop(&self, bar: &ProgressBar, file: &Path) -> Arc<Stop> {
        self.watch(bar, file);
        let stop = Arc::new(Stop::default());
        self.lock().stop = Some(Arc::clone(&stop));
        stop
    }
    /// Says what was written, and ends the program as the signal asked.
    pub(crate) fn end(&self, stop: &Stop, text: &str) -> ! {
        let status = self.lock();
        status.bar.finish_and_clear();
        say(format_args!("interrupted: {text}; {}", status.text));
        process::exit(stop.code.load(Ordering::Acquire))
    }
}
