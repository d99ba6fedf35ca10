//! `--display-server HOST:PORT`: shows an image in a program that listens there, such as tev, by the protocol that pbrt-v4 speaks, too.
//!
//! A packet is its length in bytes (u32, with these four), its kind (u8), whether the image comes to the front (u8), the name of the image
//! (bytes that end with 0), and what follows for its kind. All numbers are little-endian.
//!
//! - [`CREATE`] makes an image: width, height and number of channels (i32 each), and the name of each channel.
//! - [`UPDATE`] sets a rectangle of one channel: the channel's name; its left, top, width and height in pixels (i32 each); and its values
//!   row by row (f32).
//!
//! Nothing is ever read from the server.

use clap::Args;
use etendue_laboratory::options::say;
use etendue_render::film::Film;
use std::io::{self, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::path::Path;
use std::process;
use std::time::{Duration, Instant};

/// The kind of a packet that makes an image.
const CREATE: u8 = 4;
/// The kind of a packet that sets a rectangle of one channel.
const UPDATE: u8 = 3;
const CHANNELS: [&str; 3] = ["R", "G", "B"];
/// Side of the largest rectangle of a packet in pixels, so that packets stay small.
const SIDE: u32 = 128;
/// How long a server may take for its answer to a connection, and then for an image.
const PATIENCE: Duration = Duration::from_secs(3);

#[derive(Args)]
pub(crate) struct DisplayOptions {
    /// Show the image in the program that listens there, such as tev: tev's own address is 127.0.0.1:14158
    #[arg(long, value_name = "HOST:PORT", value_parser = address)]
    display_server: Option<String>,
}

/// Parses `--display-server`.
fn address(text: &str) -> Result<String, String> {
    let parts =
        text.rsplit_once(':').filter(|(host, port)| !host.is_empty() && port.parse::<u16>().is_ok_and(|p| p > 0));
    parts.map(|_| text.to_owned()).ok_or_else(|| "must be a host and a port, such as 127.0.0.1:14158".to_owned())
}

impl DisplayOptions {
    /// Refuses the option where it has no effect.
    pub(crate) fn check_is_unused(&self) -> Result<(), String> {
        let is_given = |server: &String| Err(format!("--display-server {server}: a part of an image is not shown"));
        self.display_server.as_ref().map_or(Ok(()), is_given)
    }

    /// The display that is asked for. If it cannot be reached, a warning says why, and the rendering goes on without.
    pub(crate) fn connect(&self, image: &Path) -> Display {
        let file = image.file_name().unwrap_or_default().to_string_lossy();
        // images of several processes have names of their own
        let name = format!("{file} ({})", process::id()).replace('\0', "");
        let mut display =
            Display { server: self.display_server.clone().unwrap_or_default(), name, stream: None, size: None };
        if self.display_server.is_some() {
            match connect(&display.server) {
                Ok(stream) => display.stream = Some(stream),
                Err(error) => display.give_up(&error),
            }
        }
        display
    }
}

fn connect(server: &str) -> io::Result<TcpStream> {
    let mut last = io::Error::new(io::ErrorKind::NotFound, "the host has no address");
    for address in server.to_socket_addrs()? {
        match TcpStream::connect_timeout(&address, PATIENCE) {
            Ok(stream) => return Ok(stream),
            Err(error) => last = error,
        }
    }
    Err(last)
}

/// An image in another program; nothing if none is asked for, or if it does not answer any more.
#[derive(Debug)]
pub(crate) struct Display {
    server: String,
    name: String,
    stream: Option<TcpStream>,
    /// The size of the image that the server has, once it has one.
    size: Option<[u32; 2]>,
}

impl Display {
    /// Shows an image. If the server does not take it within three seconds, a warning says so, and it gets no more of them.
    pub(crate) fn show(&mut self, film: &Film) {
        let Some(stream) = self.stream.take() else { return };
        match self.send(&stream, film) {
            Ok(()) => self.stream = Some(stream),
            Err(error) => self.give_up(&error),
        }
    }

    fn give_up(&self, error: &io::Error) {
        let what = match error.kind() {
            io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => "it does not answer within 3 s".to_owned(),
            _ => error.to_string(),
        };
        say(format_args!("warning: --display-server {}: {what}: the image is not shown there", self.server));
    }

    fn send(&mut self, mut stream: &TcpStream, film: &Film) -> io::Result<()> {
        let end = Instant::now() + PATIENCE;
        let mut send = |packet: &[u8]| {
            let left = end.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Err(io::ErrorKind::TimedOut.into());
            }
            stream.set_write_timeout(Some(left))?;
            stream.write_all(packet)
        };
        let size = [film.width, film.height];
        if self.size != Some(size) {
            send(&create(&self.name, size))?;
            self.size = Some(size);
        }
        for top in (0..film.height).step_by(SIDE as usize) {
            for left in (0..film.width).step_by(SIDE as usize) {
                for channel in 0..CHANNELS.len() {
                    send(&update(&self.name, film, channel, [left, top]))?;
                }
            }
        }
        Ok(())
    }
}

/// A packet of this kind, whose rest `fill` writes.
fn packet(kind: u8, focus: bool, name: &str, fill: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut bytes = vec![0, 0, 0, 0, kind, focus.into()];
    text(&mut bytes, name);
    fill(&mut bytes);
    let length = bytes.len() as u32;
    bytes[..4].copy_from_slice(&length.to_le_bytes());
    bytes
}

fn text(bytes: &mut Vec<u8>, text: &str) {
    bytes.extend_from_slice(text.as_bytes());
    bytes.push(0);
}

fn numbers(bytes: &mut Vec<u8>, numbers: &[u32]) {
    // sides are at most 65,536, so they are the same as i32
    numbers.iter().for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
}

fn create(name: &str, [width, height]: [u32; 2]) -> Vec<u8> {
    packet(CREATE, true, name, |bytes| {
        numbers(bytes, &[width, height, CHANNELS.len() as u32]);
        CHANNELS.into_iter().for_each(|channel| text(bytes, channel));
    })
}

/// The values of a channel in the rectangle that begins at this column and row.
fn update(name: &str, film: &Film, channel: usize, [left, top]: [u32; 2]) -> Vec<u8> {
    let (right, bottom) = ((left + SIDE).min(film.width), (top + SIDE).min(film.height));
    packet(UPDATE, false, name, |bytes| {
        text(bytes, CHANNELS[channel]);
        numbers(bytes, &[left, top, right - left, bottom - top]);
        for y in top..bottom {
            let row = &film.pixels[(y * film.width + left) as usize..][..(right - left) as usize];
            row.iter().for_each(|pixel| bytes.extend_from_slice(&pixel.mean[channel].to_le_bytes()));
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_render::film::Pixel;

    #[test]
    fn packets_have_the_bytes_of_the_protocol() {
        assert_eq!(create("a", [5, 258]), b"\x1a\0\0\0\x04\x01a\0\x05\0\0\0\x02\x01\0\0\x03\0\0\0R\0G\0B\0");
        let pixel = |x: f32| Pixel { mean: [0.0, x, 0.0], ..Pixel::default() };
        let film = Film { width: 1, height: 2, pixels: vec![pixel(1.0), pixel(-2.0)] };
        let expected = b"\x22\0\0\0\x03\0a\0G\0\0\0\0\0\0\0\0\0\x01\0\0\0\x02\0\0\0\0\0\x80\x3f\0\0\0\xc0";
        assert_eq!(update("a", &film, 1, [0, 0]), expected);
    }

    #[test]
    fn addresses_have_a_host_and_a_port() {
        for right in ["127.0.0.1:14158", "localhost:1", "[::1]:14158"] {
            assert_eq!(address(right).unwrap(), right);
        }
        for wrong in ["", "localhost", ":14158", "localhost:", "localhost:0", "localhost:65536", "localhost:x"] {
            assert!(address(wrong).unwrap_err().contains("127.0.0.1:14158"), "{wrong}");
        }
    }
}
