//! A program that serves a page, and what it answers.

use super::Folder;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A program that serves a page, ended with the test.
pub(crate) struct Viewer {
    pub(crate) child: Child,
    /// What it said at the start.
    pub(crate) said: String,
    pub(crate) host: String,
    pub(crate) token: String,
}

impl Drop for Viewer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// An answer: its code, its head and its body.
pub(crate) struct Answer {
    pub(crate) code: u32,
    pub(crate) head: String,
    pub(crate) body: Vec<u8>,
}

impl Answer {
    pub(crate) fn text(&self) -> String {
        String::from_utf8(self.body.clone()).unwrap()
    }
}

impl Viewer {
    pub(crate) fn new(folder: &Folder, more: &[&str]) -> Self {
        let common = ["--size", "32x32", "--threads", "1", "-o", "a.exr"];
        Self::with(folder, &[&["view"], more, &common].concat())
    }
    pub(crate) fn with(folder: &Folder, arguments: &[&str]) -> Self {
        let mut child = folder.spawn(&[arguments, &["--no-open"]].concat());
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut said = String::new();
        while !said.ends_with("Ctrl-C ends it\n") {
            if out.read_line(&mut said).unwrap() == 0 {
                let mut error = String::new();
                child.stderr.take().unwrap().read_to_string(&mut error).unwrap();
                panic!("{arguments:?}: {said}{error}");
            }
        }
        let address = said.lines().find_map(|line| line.strip_prefix("http://")).unwrap();
        let (host, token) = address.trim_end_matches('/').split_once('/').unwrap();
        let (host, token) = (host.to_owned(), token.to_owned());
        assert!(host.starts_with("127.0.0.1:") && token.len() == 32, "{said}");
        Self { child, said, host, token }
    }
    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
        stream
    }
    /// Sends this text, and returns what is answered until the connection ends.
    pub(crate) fn send(&self, text: &str) -> Answer {
        let mut stream = self.connect();
        // the server may answer, and end the connection, before it has all
        let _ = stream.write_all(text.as_bytes());
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").unwrap_or_else(|| panic!("{bytes:?}")) + 4;
        let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
        let code = head.strip_prefix("HTTP/1.1 ").unwrap()[..3].parse().unwrap();
        Answer { code, head, body: bytes[end..].to_vec() }
    }
    pub(crate) fn ask(&self, path: &str, headers: &str) -> Answer {
        self.send(&format!("GET /{}/{path} HTTP/1.1\r\nHost: {}\r\n{headers}\r\n", self.token, self.host))
    }
    pub(crate) fn wish(&self, body: &str) -> Answer {
        let (token, host, length) = (&self.token, &self.host, body.len());
        self.send(&format!("POST /{token}/wish HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n\r\n{body}"))
    }
    pub(crate) fn status(&self) -> Value {
        let answer = self.ask("status", "");
        assert_eq!(answer.code, 200);
        serde_json::from_slice(&answer.body).unwrap()
    }
    /// Waits until the status is like this, and returns it.
    pub(crate) fn until(&self, what: &str, is_so: impl Fn(&Value) -> bool) -> Value {
        let start = Instant::now();
        loop {
            let status = self.status();
            if is_so(&status) {
                return status;
            }
            assert!(start.elapsed() < Duration::from_secs(30), "not so that {what}: {status}");
            sleep(Duration::from_millis(20));
        }
    }
    /// The radiance and the number of samples of each pixel.
    pub(crate) fn image(&self, technique: &str, sampler: &str) -> (Vec<f32>, Vec<u32>) {
        let answer = self.ask(&format!("image?technique={technique}&sampler={sampler}"), "");
        assert_eq!(answer.code, 200, "{}", answer.text());
        let word = |i: usize| answer.body[4 * i..][..4].try_into().unwrap();
        let n = (u32::from_le_bytes(word(0)) * u32::from_le_bytes(word(1))) as usize;
        assert_eq!(answer.body.len(), 16 + 28 * n);
        let radiance = (4..4 + 3 * n).map(|i| f32::from_le_bytes(word(i))).collect();
        (radiance, (4 + 6 * n..4 + 7 * n).map(|i| u32::from_le_bytes(word(i))).collect())
    }
}

pub(crate) fn picture<'a>(status: &'a Value, technique: &str, sampler: &str) -> Option<&'a Value> {
    let way = json!({ "technique": technique, "sampler": sampler });
    status["pictures"].as_array().unwrap().iter().find(|picture| picture["way"] == way)
}

pub(crate) fn spp(status: &Value, technique: &str, sampler: &str) -> f64 {
    picture(status, technique, sampler).map_or(0.0, |picture| picture["spp"].as_f64().unwrap())
}
