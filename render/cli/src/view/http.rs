//! One request of HTTP/1.1 and its answer over a connection, with limits of time and size. Connections are not kept.

use std::borrow::Cow;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

/// Greatest size of the head of a request in bytes.
const HEAD: usize = 8192;
/// Greatest size of the body of a request in bytes.
const BODY: usize = 4096;
/// How long a client may take to send its request.
const ASKING: Duration = Duration::from_secs(2);
/// How long a client may take to read its answer.
const READING: Duration = Duration::from_secs(20);
/// How long a client may take to send the rest of a request that is refused, and of how many bytes at most.
pub(crate) const LEAVING: Duration = Duration::from_millis(500);
const MOST_LEFT: u64 = 1 << 16;

/// What the page may do, for the browser: load its own script and style, ask its own server, and nothing else; no other page may frame it
/// or read from it.
const HEADERS: &str = "Cache-Control: no-store\r\n\
    Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; \
    base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
    Cross-Origin-Opener-Policy: same-origin\r\n\
    Cross-Origin-Resource-Policy: same-origin\r\n\
    Referrer-Policy: no-referrer\r\n\
    X-Content-Type-Options: nosniff\r\n\
    Connection: close\r\n";

/// A request.
#[derive(Debug, Default)]
pub(crate) struct Request {
    pub(crate) method: String,
    /// What follows the host, up to a question mark.
    pub(crate) path: String,
    /// The pairs after the question mark.
    pub(crate) query: Vec<(String, String)>,
    pub(crate) host: String,
    /// The site of the page that asks; browsers leave it out of some requests to their own site.
    pub(crate) origin: Option<String>,
    pub(crate) body: Vec<u8>,
}

/// What is sent back.
pub(crate) struct Response {
    pub(crate) status: u16,
    /// The type of its contents.
    pub(crate) kind: &'static str,
    pub(crate) body: Body,
}

pub(crate) enum Body {
    Bytes(Cow<'static, [u8]>),
    /// So many bytes, which are made as they are sent.
    Stream(usize, Stream),
}

/// Writes a body.
pub(crate) type Stream = Box<dyn FnOnce(&mut dyn Write) -> io::Result<()>>;

impl Response {
    pub(crate) fn new(status: u16, kind: &'static str, body: impl Into<Cow<'static, [u8]>>) -> Self {
        Self { status, kind, body: Body::Bytes(body.into()) }
    }
    /// A line of text.
    pub(crate) fn text(status: u16, text: &str) -> Self {
        Self::new(status, "text/plain; charset=utf-8", format!("{text}\n").into_bytes())
    }
}

/// A connection that ends at a time, however slowly its bytes come and go.
struct Until<'a>(&'a TcpStream, Instant);

impl Until<'_> {
    fn left(&self) -> io::Result<Option<Duration>> {
        let left = self.1.saturating_duration_since(Instant::now());
        if left.is_zero() { Err(io::ErrorKind::TimedOut.into()) } else { Ok(Some(left)) }
    }
}

impl Read for Until<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.0.set_read_timeout(self.left()?)?;
        self.0.read(bytes)
    }
}

impl Write for Until<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.set_write_timeout(self.left()?)?;
        self.0.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Reads a request. A failure is what to answer, or nothing if the client is gone or too slow.
pub(crate) fn read(stream: &TcpStream) -> Result<Request, Option<Response>> {
    let mut stream = Until(stream, Instant::now() + ASKING);
    let mut bytes = Vec::new();
    loop {
        if let Some((mut request, start, length)) = parse(&bytes)? {
            if length > BODY {
                return Err(Some(Response::text(413, &format!("a request has at most {BODY} bytes"))));
            }
            while bytes.len() < start + length {
                more(&mut stream, &mut bytes)?;
            }
            request.body = bytes[start..start + length].to_vec();
            return Ok(request);
        }
        if bytes.len() > HEAD {
            return Err(Some(Response::text(431, &format!("the head of a request has at most {HEAD} bytes"))));
        }
        more(&mut stream, &mut bytes)?;
    }
}

fn more(stream: &mut Until<'_>, bytes: &mut Vec<u8>) -> Result<(), Option<Response>> {
    let mut part = [0; 2048];
    match stream.read(&mut part) {
        Ok(0) | Err(_) => Err(None),
        Ok(n) => {
            bytes.extend_from_slice(&part[..n]);
            Ok(())
        }
    }
}

/// The request whose head these bytes begin with, where its body starts, and how long that is; nothing as long as the head is not complete.
fn parse(bytes: &[u8]) -> Result<Option<(Request, usize, usize)>, Option<Response>> {
    let mut headers = [httparse::EMPTY_HEADER; 64];
    let mut parsed = httparse::Request::new(&mut headers);
    let wrong = |what: &str| Some(Response::text(400, what));
    let start = match parsed.parse(bytes) {
        Ok(httparse::Status::Complete(start)) => start,
        Ok(httparse::Status::Partial) => return Ok(None),
        Err(error) => return Err(wrong(&error.to_string())),
    };
    let target = parsed.path.unwrap_or_default();
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    let pair = |pair: &str| pair.split_once('=').map(|(key, value)| (key.to_owned(), value.to_owned()));
    let mut request = Request {
        method: parsed.method.unwrap_or_default().to_owned(),
        path: path.to_owned(),
        query: query.split('&').filter_map(pair).collect(),
        ..Request::default()
    };
    let (mut length, mut hosts) = (0, 0);
    for header in parsed.headers.iter() {
        let value = String::from_utf8_lossy(header.value).trim().to_owned();
        match header.name.to_ascii_lowercase().as_str() {
            "host" => (request.host, hosts) = (value, hosts + 1),
            "origin" => request.origin = Some(value),
            "content-length" => {
                length = value.parse().map_err(|_| wrong(&format!("Content-Length {value}: not a number")))?;
            }
            "transfer-encoding" => return Err(wrong("the length of a request must be known")),
            _ => {}
        }
    }
    if hosts != 1 {
        return Err(wrong("a request names one host"));
    }
    Ok(Some((request, start, length)))
}

/// Sends an answer to a request that was not read whole. What is left of it is thrown away, for as long as `leaving`: closing the connection
/// before that could take the answer from the client.
pub(crate) fn refuse(stream: &TcpStream, response: Response, leaving: Duration) -> io::Result<()> {
    write(stream, response)?;
    stream.shutdown(Shutdown::Write)?;
    let mut rest = Until(stream, Instant::now() + leaving).take(MOST_LEFT);
    io::copy(&mut rest, &mut io::sink()).map(|_| ())
}

/// Sends an answer.
pub(crate) fn write(stream: &TcpStream, response: Response) -> io::Result<()> {
    let mut stream = Until(stream, Instant::now() + READING);
    let Response { status, kind, body } = response;
    let reason = match status {
        200 => "OK",
        400 => "Bad Request",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        413 => "Content Too Large",
        431 => "Request Header Fields Too Large",
        _ => "Service Unavailable",
    };
    let length = match &body {
        Body::Bytes(bytes) => bytes.len(),
        Body::Stream(length, _) => *length,
    };
    let head =
        format!("HTTP/1.1 {status} {reason}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{HEADERS}\r\n");
    stream.write_all(head.as_bytes())?;
    match body {
        Body::Bytes(bytes) => stream.write_all(&bytes),
        Body::Stream(_, write) => write(&mut stream),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_parsed() {
        let text =
            b"POST /a/b?x=1&y=c-d&z HTTP/1.1\r\nHOST: here:1\r\nOrigin: http://here:1\r\nContent-Length: 3\r\n\r\nabc";
        let (request, start, length) = parse(text).unwrap_or_else(|_| panic!()).unwrap();
        assert_eq!((&text[start..], length), (&b"abc"[..], 3));
        assert_eq!((&*request.method, &*request.path, &*request.host), ("POST", "/a/b", "here:1"));
        assert_eq!(request.query, [("x", "1"), ("y", "c-d")].map(|(a, b)| (a.to_owned(), b.to_owned())));
        assert_eq!(request.origin.as_deref(), Some("http://here:1"));
        for n in 0..start {
            assert!(matches!(parse(&text[..n]), Ok(None)), "{n} bytes");
        }
        for wrong in [
            "GET / HTTP/1.1\r\n\r\n",
            "GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n",
            "GET / HTTP/1.1\r\nHost: a\r\nContent-Length: -1\r\n\r\n",
            "GET / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n",
            "GET  HTTP/1.1\r\nHost: a\r\n\r\n",
            "\0\0\0\0",
        ] {
            assert!(matches!(parse(wrong.as_bytes()), Err(Some(Response { status: 400, .. }))), "{wrong:?}");
        }
    }
}
