//! Answers requests on the loopback address: at most [`CLIENTS`] at a time, only with the token, and only from the page itself.

use super::http::{self, Request, Response};
use std::fmt::Write;
use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// The most clients that can be connected at the same time. Others get the answer 503, and can try again.
const CLIENTS: usize = 16;
/// How long the listener waits for the request of a client that it turns away.
const TURNED_AWAY: Duration = Duration::from_millis(20);
/// How many ports are tried, from the first one.
const PORTS: u16 = 16;

/// A listener on the loopback address, and what the addresses of its pages begin with.
pub(crate) struct Server {
    listener: TcpListener,
    port: u16,
    token: String,
}

impl Server {
    /// Listens on this port, or on the first of those after it that is free.
    ///
    /// # Errors
    /// Fails if none of 16 ports is free, or if the system gives no random numbers.
    pub(crate) fn new(first: u16) -> Result<Self, String> {
        let mut random = [0; 16];
        getrandom::fill(&mut random).map_err(|error| format!("no random numbers for the page's address: {error}"))?;
        let token = random.iter().fold(String::new(), |mut token, byte| {
            let _ = write!(token, "{byte:02x}");
            token
        });
        let last = first.saturating_add(PORTS - 1);
        for port in first..=last {
            match TcpListener::bind((Ipv4Addr::LOCALHOST, port)) {
                Ok(listener) => return Ok(Self { listener, port, token }),
                Err(error) if error.kind() == io::ErrorKind::AddrInUse => {}
                Err(error) => return Err(format!("--port {first}: cannot listen on 127.0.0.1:{port}: {error}")),
            }
        }
        let all = if first == last { format!("port {first}") } else { format!("every port from {first} to {last}") };
        Err(format!("--port {first}: {all} of 127.0.0.1 is in use: choose another one"))
    }

    pub(crate) const fn port(&self) -> u16 {
        self.port
    }

    /// The address of the page.
    pub(crate) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// Answers requests from now on, in threads of its own. `answer` receives what follows the token in the path.
    ///
    /// # Errors
    /// Fails if the system starts no thread.
    pub(crate) fn serve(self, answer: impl Fn(&str, &Request) -> Response + Send + Sync + 'static) -> io::Result<()> {
        let Self { listener, port, token } = self;
        let (answer, clients) = (Arc::new(answer), Arc::new(AtomicUsize::new(0)));
        let guard = Arc::new(Guard { port, token });
        thread::Builder::new().name("listener".into()).spawn(move || {
            loop {
                let Ok((stream, _)) = listener.accept() else {
                    // such as too many open files
                    thread::sleep(Duration::from_millis(100));
                    continue;
                };
                let place = CountGuard::new(&clients);
                if place.number > CLIENTS {
                    // it fits into the buffer of any socket, and whoever knocks next waits no longer than that
                    let _ = http::refuse(&stream, Response::text(503, "too many connections"), TURNED_AWAY);
                    continue;
                }
                let (answer, guard) = (Arc::clone(&answer), Arc::clone(&guard));
                let talk = move || {
                    let _place = place;
                    // a client that is gone needs no answer
                    let _ = match http::read(&stream) {
                        Ok(request) => {
                            let refused_or = guard.check(&request).map(|path| answer(path, &request));
                            http::write(&stream, refused_or.unwrap_or_else(|refused| refused))
                        }
                        Err(Some(refused)) => http::refuse(&stream, refused, http::LEAVING),
                        Err(None) => Ok(()),
                    };
                };
                // without a thread the connection is closed
                let _ = thread::Builder::new().name("client".into()).spawn(talk);
            }
        })?;
        Ok(())
    }
}

/// One of the things that are counted as long as they are there.
pub(crate) struct CountGuard {
    count: Arc<AtomicUsize>,
    /// How many there are with this one.
    pub(crate) number: usize,
}

impl CountGuard {
    pub(crate) fn new(count: &Arc<AtomicUsize>) -> Self {
        let number = count.fetch_add(1, Ordering::Relaxed) + 1;
        Self { count: Arc::clone(count), number }
    }
}

impl Drop for CountGuard {
    fn drop(&mut self) {
        self.count.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Who may ask.
struct Guard {
    port: u16,
    token: String,
}

impl Guard {
    /// What follows the token in the path of a request, if it comes from the page itself. A site whose name is made to lead to this machine
    /// has another `Host`, a page of another site another `Origin`, and other users of the machine do not know the token.
    fn check<'a>(&self, request: &'a Request) -> Result<&'a str, Response> {
        let own = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port));
        if !own.contains(&request.host) {
            return Err(Response::text(403, "this server has another name"));
        }
        let is_own = |origin: &String| origin.strip_prefix("http://") == Some(&request.host);
        if !request.origin.as_ref().is_none_or(is_own) {
            return Err(Response::text(403, "requests of other sites are refused"));
        }
        let (token, path) = request.path.get(1..).and_then(|path| path.split_once('/')).unwrap_or_default();
        if !is_same(token.as_bytes(), self.token.as_bytes()) {
            return Err(Response::text(404, "there is no such page"));
        }
        Ok(path)
    }
}

/// Whether two texts are the same, in a time that does not tell how much of them is.
fn is_same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |differ, (a, b)| differ | (a ^ b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_page_itself_may_ask() {
        let guard = Guard { port: 99, token: "secret".into() };
        let code = |host: &str, origin: Option<&str>, path: &str| {
            let (host, origin, path) = (host.to_owned(), origin.map(str::to_owned), path.to_owned());
            let request = Request { host, origin, path, ..Request::default() };
            guard.check(&request).map(str::to_owned).map_err(|refused| refused.status)
        };
        assert_eq!(code("127.0.0.1:99", None, "/secret/a/b"), Ok("a/b".into()));
        assert_eq!(code("localhost:99", Some("http://localhost:99"), "/secret/"), Ok(String::new()));
        for host in ["", "127.0.0.1", "127.0.0.1:98", "example.com:99", "localhost:99.example.com"] {
            assert_eq!(code(host, None, "/secret/"), Err(403), "{host}");
        }
        for origin in
            ["null", "", "http://127.0.0.1", "https://127.0.0.1:99", "http://localhost:99", "http://example.com"]
        {
            assert_eq!(code("127.0.0.1:99", Some(origin), "/secret/"), Err(403), "{origin}");
        }
        for path in ["", "/", "/secret", "/secreT/", "/secret0/", "//secret/", "/secre/t"] {
            assert_eq!(code("127.0.0.1:99", None, path), Err(404), "{path}");
        }
    }
}
