//! Opens the page in the browser of whoever runs the program.

use std::env;
use std::io;
use std::process::{Command, Stdio};
use std::thread;

/// The program that opens an address, with its arguments before the address; or why there is none.
fn opener() -> Result<(&'static str, &'static [&'static str]), &'static str> {
    let has_screen =
        || ["DISPLAY", "WAYLAND_DISPLAY"].iter().any(|name| env::var_os(name).is_some_and(|v| !v.is_empty()));
    match env::consts::OS {
        "macos" => Ok(("open", &[])),
        // `start` takes its first argument in quotes for a title
        "windows" => Ok(("cmd", &["/C", "start", ""])),
        _ if has_screen() => Ok(("xdg-open", &[])),
        _ => Err("there is no screen"),
    }
}

/// Opens an address, and does not wait for the browser.
///
/// # Errors
/// Says why no browser can be opened.
pub(super) fn open(address: &str) -> Result<(), String> {
    let (program, arguments) = opener()?;
    let mut command = Command::new(program);
    command.args(arguments).arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => format!("{program} is not installed"),
        _ => format!("{program} cannot be run ({error})"),
    })?;
    // whoever ends is waited for, so that nothing is left of it
    let wait = thread::Builder::new().name("browser".into()).spawn(move || child.wait());
    wait.map(drop).map_err(|error| error.to_string())
}
