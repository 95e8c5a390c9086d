//! As much of HTTP/1.1 as a page on this machine needs, with a bound for all that a client may ask for.

use std::io::{self, BufRead, BufReader, ErrorKind, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// Bounds on the requests and connections of clients.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Bytes of a request without its body.
    pub head: u64,
    /// Bytes of the body of a request, which nothing is done with.
    pub body: u64,
    /// Requests that one connection may make.
    pub requests: usize,
    /// Connections at a time. Each has a thread.
    pub connections: usize,
    /// The longest time for a request to arrive, and for an answer to be taken.
    pub patience: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            head: 1 << 14,
            body: 1 << 16,
            requests: 1000,
            connections: 64,
            patience: Duration::from_secs(10),
        }
    }
}

/// A question, GET or HEAD.
#[derive(Debug, Default)]
pub(super) struct Request {
    /// The target of the request, which stands behind the method: `/news?after=1`.
    pub path: String,
    pub host: Option<String>,
    method: String,
    length: u64,
    /// `true` if no other request is to follow on the connection.
    is_last: bool,
}

/// An answer.
#[derive(Debug)]
pub(super) struct Reply {
    pub status: u16,
    /// Its media type.
    pub kind: &'static str,
    pub text: String,
}

impl Reply {
    /// A few words for people.
    pub fn plain(status: u16, text: &str) -> Self {
        Self { status, kind: "text/plain; charset=utf-8", text: text.to_owned() }
    }
}

/// Answers what comes to a listener, until the program ends.
///
/// # Errors
/// There is no thread for it.
pub(super) fn serve(
    listener: TcpListener,
    limits: Limits,
    answer: impl Fn(&Request) -> Reply + Send + Sync + 'static,
) -> io::Result<()> {
    let answer = Arc::new(answer);
    let accept = move || {
        // as many references as there are connections, and this one
        let open = Arc::new(());
        for stream in listener.incoming() {
            let Ok(stream) = stream else {
                // mostly there is no descriptor left: one will be
                thread::sleep(Duration::from_millis(50));
                continue;
            };
            if Arc::strong_count(&open) > limits.connections {
                let busy = Reply::plain(503, "too many connections");
                let _ = write(&mut Timed::new(&stream, Duration::from_millis(100)), &busy, true, true);
                continue;
            }
            let (place, answer) = (Arc::clone(&open), Arc::clone(&answer));
            let _ = thread::Builder::new().spawn(move || {
                // whoever has gone away needs no answer
                let _ = converse(&stream, &limits, &*answer);
                drop(place);
            });
        }
    };
    thread::Builder::new().spawn(accept).map(drop)
}

/// Answers the requests of a connection, one after another.
fn converse(stream: &TcpStream, limits: &Limits, answer: &dyn Fn(&Request) -> Reply) -> io::Result<()> {
    let mut reader = BufReader::new(Timed::new(stream, limits.patience));
    for count in 1..=limits.requests {
        reader.get_mut().begin(limits.patience);
        let (request, reply) = match read(&mut reader, limits)? {
            Some(Ok(request)) if matches!(request.method.as_str(), "GET" | "HEAD") => {
                let reply = answer(&request);
                (request, reply)
            }
            Some(Ok(request)) => (request, Reply::plain(405, "only to be read")),
            Some(Err(refusal)) => (Request { is_last: true, ..Request::default() }, refusal),
            None => return Ok(()),
        };
        let is_last = request.is_last || count == limits.requests;
        write(&mut Timed::new(stream, limits.patience), &reply, request.method != "HEAD", is_last)?;
        if is_last {
            break;
        }
    }
    // Bytes that are on their way are taken for a moment: otherwise the system may drop the answer as well.
    stream.shutdown(Shutdown::Write)?;
    reader.get_mut().begin(limits.patience.min(Duration::from_secs(1)));
    io::copy(&mut reader.take(1 << 20), &mut io::sink()).map(drop)
}

/// Reads a request; nothing if none comes, an answer where it cannot be taken.
fn read(reader: &mut impl BufRead, limits: &Limits) -> io::Result<Option<Result<Request, Reply>>> {
    let (mut head, mut left) = (Vec::new(), limits.head);
    loop {
        let before = head.len();
        match reader.by_ref().take(left).read_until(b'\n', &mut head) {
            Ok(read) if head.ends_with(b"\n") && read > 0 => left -= read as u64,
            Ok(read) if read as u64 == left => {
                return Ok(Some(Err(Reply::plain(431, "the head of the request is too long"))));
            }
            Ok(_) => return Ok(None),
            Err(error) if is_late(&error) && head.is_empty() => return Ok(None),
            Err(error) if is_late(&error) => return Ok(Some(Err(Reply::plain(408, "too slow")))),
            Err(error) => return Err(error),
        }
        match head.get(before..).unwrap_or_default() {
            // an empty line before a request is none of its own
            b"\n" | b"\r\n" if before == 0 => head.clear(),
            b"\n" | b"\r\n" => break,
            _ => {}
        }
    }
    let Some(request) = str::from_utf8(&head).ok().and_then(parse) else {
        return Ok(Some(Err(Reply::plain(400, "not understood"))));
    };
    let Ok(request) = request else { return Ok(Some(request)) };
    if request.length > limits.body {
        return Ok(Some(Err(Reply::plain(413, "the body of the request is too long"))));
    }
    let skipped = io::copy(&mut reader.take(request.length), &mut io::sink());
    match skipped {
        Ok(length) if length < request.length => Ok(None),
        Err(error) if is_late(&error) => Ok(Some(Err(Reply::plain(408, "too slow")))),
        skipped => skipped.map(|_| Some(Ok(request))),
    }
}

fn is_late(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock)
}

/// Reads the lines of a request; nothing if they are none.
fn parse(head: &str) -> Option<Result<Request, Reply>> {
    let mut lines = head.lines();
    let words: Vec<&str> = lines.next()?.split(' ').collect();
    let [method, path, version] = words.as_slice() else { return None };
    let is_last = match *version {
        "HTTP/1.1" => false,
        "HTTP/1.0" => true,
        _ => return None,
    };
    let mut length = None;
    let mut request =
        Request { path: (*path).into(), host: None, method: (*method).into(), length: 0, is_last };
    for line in lines.take_while(|line| !line.is_empty()) {
        let (name, value) = line.split_once(':').filter(|(name, _)| !name.contains([' ', '\t']))?;
        let value = value.trim();
        match name.to_ascii_lowercase().as_str() {
            "host" if request.host.is_some() => return None,
            "host" => request.host = Some(value.into()),
            "content-length" if length.is_some() => return None,
            "content-length" => length = Some(value.parse().ok()?),
            "transfer-encoding" => return Some(Err(Reply::plain(411, "the body has to have a length"))),
            "connection" => request.is_last |= value.to_ascii_lowercase().contains("close"),
            _ => {}
        }
    }
    request.length = length.unwrap_or(0);
    Some(Ok(request))
}

fn write(output: &mut impl Write, reply: &Reply, has_body: bool, is_last: bool) -> io::Result<()> {
    let Reply { status, kind, text } = reply;
    let reason = match status {
        200 => "OK",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed\r\nAllow: GET, HEAD",
        408 => "Request Timeout",
        411 => "Length Required",
        413 => "Content Too Large",
        431 => "Request Header Fields Too Large",
        503 => "Service Unavailable",
        _ => "Bad Request",
    };
    let connection = if is_last { "close" } else { "keep-alive" };
    let head = format!(
        "HTTP/1.1 {status} {reason}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nConnection: {connection}\r\n\
         Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nX-Frame-Options: SAMEORIGIN\r\n\
         Referrer-Policy: no-referrer\r\n\r\n",
        text.len()
    );
    output.write_all(head.as_bytes())?;
    if has_body { output.write_all(text.as_bytes()) } else { Ok(()) }
}

/// A connection on which everything together has to happen within a time.
struct Timed<'a> {
    stream: &'a TcpStream,
    end: Instant,
}

impl<'a> Timed<'a> {
    fn new(stream: &'a TcpStream, patience: Duration) -> Self {
        Self { stream, end: Instant::now() + patience }
    }

    /// Begins the time anew.
    fn begin(&mut self, patience: Duration) {
        self.end = Instant::now() + patience;
    }

    fn left(&self) -> io::Result<Option<Duration>> {
        let left = self.end.saturating_duration_since(Instant::now());
        if left.is_zero() { Err(ErrorKind::TimedOut.into()) } else { Ok(Some(left)) }
    }
}

impl Read for Timed<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.stream.set_read_timeout(self.left()?)?;
        self.stream.read(bytes)
    }
}

impl Write for Timed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stream.set_write_timeout(self.left()?)?;
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

#[cfg(test)]
mod tests {
    use std::net::{Ipv4Addr, SocketAddr};

    use super::*;

    /// A server that says what it was asked.
    fn server(limits: Limits) -> SocketAddr {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let address = listener.local_addr().unwrap();
        serve(listener, limits, |request| Reply::plain(200, &request.path)).unwrap();
        address
    }

    /// All that is answered to some bytes.
    fn answer(address: SocketAddr, bytes: &[u8]) -> String {
        let mut stream = TcpStream::connect(address).unwrap();
        let mut writer = stream.try_clone().unwrap();
        let mut text = Vec::new();
        thread::scope(|scope| {
            // the server may end it before all is written
            scope.spawn(move || writer.write_all(bytes));
            let _ = stream.read_to_end(&mut text);
            let _ = stream.shutdown(Shutdown::Both);
        });
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn requests_are_answered_one_after_another() {
        let address = server(Limits::default());
        let both = answer(
            address,
            b"GET /a HTTP/1.1\r\nHost: x\r\n\r\nPOST /b HTTP/1.1\r\nContent-Length: 3\r\n\r\nabcHEAD /c HTTP/1.1\r\n\
              Connection: close\r\n\r\n",
        );
        let replies: Vec<&str> = both.split("HTTP/1.1 ").skip(1).collect();
        let [get, post, head] = replies[..] else { panic!("{both}") };
        assert!(get.starts_with("200 OK") && get.ends_with("\r\n\r\n/a"), "{get}");
        assert!(post.starts_with("405") && post.contains("Allow: GET, HEAD"), "{post}");
        assert!(head.contains("Content-Length: 2\r\n") && head.ends_with("\r\n\r\n"), "{head}");
    }

    /// Regression: a length of a hundred gigabytes ended the process, which reserved them.
    #[test]
    fn what_is_too_large_or_no_request_is_refused() {
        let address = server(Limits::default());
        let long = format!("GET / HTTP/1.1\r\nCookie: {}\r\n\r\n", "a".repeat(20_000));
        for (request, status) in [
            ("POST / HTTP/1.1\r\nContent-Length: 100000000000\r\n\r\n", 413),
            ("GET / HTTP/1.1\r\nContent-Length: 100000000000000000000000\r\n\r\n", 400),
            ("GET / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n", 400),
            ("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n", 411),
            (&long, 431),
            (&"\r\n".repeat(20_000), 431),
            ("GET /\r\n\r\n", 400),
            ("GET / HTTP/2.0\r\n\r\n", 400),
            ("GET / HTTP/1.1\r\nno header\r\n\r\n", 400),
            ("GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", 400),
        ] {
            let said = answer(address, request.as_bytes());
            assert!(said.starts_with(&format!("HTTP/1.1 {status} ")), "{request:.60}: {said}");
        }
    }

    /// Regression: each request of a connection had a thread, and 20,000 of them ended the server.
    #[test]
    fn a_connection_makes_so_many_requests_and_no_more() {
        let address = server(Limits { requests: 50, ..Limits::default() });
        let said = answer(address, "GET / HTTP/1.1\r\n\r\n".repeat(20_000).as_bytes());
        assert_eq!(said.matches("HTTP/1.1 200").count(), 50);
        assert!(answer(address, b"GET /still HTTP/1.0\r\n\r\n").ends_with("/still"));
    }

    #[test]
    fn slow_clients_are_not_waited_for() {
        let address = server(Limits { patience: Duration::from_millis(100), ..Limits::default() });
        for (begun, expected) in [
            ("", ""),
            ("GET / HT", "HTTP/1.1 408"),
            ("POST / HTTP/1.1\r\nContent-Length: 9\r\n\r\nabc", "HTTP/1.1 408"),
        ] {
            let said = answer(address, begun.as_bytes());
            assert!(said.starts_with(expected) && said.is_empty() == expected.is_empty(), "{begun}: {said}");
        }
    }

    #[test]
    fn there_are_so_many_connections_and_no_more() {
        let address = server(Limits { connections: 2, ..Limits::default() });
        let ask = b"GET / HTTP/1.0\r\n\r\n";
        let mut held: Vec<TcpStream> = Vec::new();
        for _ in 0..2 {
            let mut stream = TcpStream::connect(address).unwrap();
            stream.write_all(b"GET / HTTP/1.1\r\n\r\n").unwrap();
            assert_eq!(stream.read(&mut [0; 1]).unwrap(), 1);
            held.push(stream);
        }
        assert!(answer(address, b"").starts_with("HTTP/1.1 503"));
        drop(held);
        // as soon as the server has seen that they are gone
        while !answer(address, ask).starts_with("HTTP/1.1 200") {
            thread::yield_now();
        }
    }
}
