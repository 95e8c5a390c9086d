//! The server of the page, for this machine alone.

use std::io;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use serde_json::json;
use tiny_http::{Header, Method, Request, Response};

use super::News;
use crate::html::{escaped, filled};

const SHELL: &str = include_str!("shell.html");

/// A question for news is answered after this time even if there are none, so that nobody
/// waits for a connection that is lost.
const PATIENCE: Duration = Duration::from_secs(20);

/// A server that answers until the program ends.
pub(crate) struct Server {
    address: SocketAddr,
}

impl Server {
    /// Serves news of a file on a port of the loopback address, or on a free one for 0.
    ///
    /// # Errors
    /// The port is taken.
    pub fn start(title: &str, news: &Arc<News>, port: u16) -> io::Result<Self> {
        let server = tiny_http::Server::http((Ipv4Addr::LOCALHOST, port)).map_err(io::Error::other)?;
        let address = server.server_addr().to_ip().ok_or_else(|| io::Error::other("no address"))?;
        let shell: Arc<str> = filled(SHELL, &[("TITLE", &escaped(title))]).into();
        let news = Arc::clone(news);
        thread::Builder::new().spawn(move || {
            for request in server.incoming_requests() {
                let (news, shell) = (Arc::clone(&news), Arc::clone(&shell));
                // Most of them wait for news, so each has a thread.
                let _ = thread::Builder::new().spawn(move || answer(request, address, &shell, &news));
            }
        })?;
        Ok(Self { address })
    }

    /// Where the page is.
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }
}

fn answer(request: Request, address: SocketAddr, shell: &str, news: &News) {
    let text = |status: u16, kind: &str, text: String| {
        let headers = [
            ("Content-Type", kind),
            ("Cache-Control", "no-store"),
            ("X-Content-Type-Options", "nosniff"),
            ("X-Frame-Options", "SAMEORIGIN"),
            ("Referrer-Policy", "no-referrer"),
        ];
        let headers = headers.iter().filter_map(|(name, value)| Header::from_bytes(*name, *value).ok());
        headers.fold(Response::from_string(text).with_status_code(status), Response::with_header)
    };
    let html = "text/html; charset=utf-8";
    let path = request.url().to_owned();
    let response = if !is_local(&request, address) {
        // A page of somebody else, whose name was made to lead here, is told nothing.
        text(403, "text/plain", "only for this machine".into())
    } else if *request.method() != Method::Get {
        text(405, "text/plain", "only to be read".into())
    } else if path == "/" {
        text(200, html, shell.to_owned())
    } else if let Some(version) = path.strip_prefix("/news?after=").and_then(|n| n.parse().ok()) {
        let now = news.after(version, PATIENCE);
        let page = now.pages.as_ref().map(|(version, _)| version);
        let is_played = now.pages.as_ref().is_some_and(|(_, pages)| pages.played.is_some());
        let told = json!({ "version": now.version, "page": page, "played": is_played, "error": now.error });
        text(200, "application/json", told.to_string())
    } else if let Some(page) = page(&path, news) {
        text(200, html, page)
    } else {
        text(404, "text/plain", "there is no such page".into())
    };
    // whoever has gone away needs no answer
    let _ = request.respond(response);
}

/// The last page at a path: `/recorded/` or `/played/` with a version, which browsers tell apart by it.
fn page(path: &str, news: &News) -> Option<String> {
    let (_, pages) = news.now().pages.clone()?;
    if path.starts_with("/recorded/") {
        return Some(pages.recorded);
    }
    path.strip_prefix("/played/").and(pages.played)
}

/// Whether a request names the address that it came to: a browser names the host of the
/// page's own address.
fn is_local(request: &Request, address: SocketAddr) -> bool {
    let host = request.headers().iter().find(|header| header.field.equiv("Host"));
    let port = address.port();
    let known = [address.to_string(), format!("localhost:{port}")];
    host.is_some_and(|host| known.iter().any(|known| known == host.value.as_str()))
}

#[cfg(test)]
mod tests {
    use std::io::{Read, Write};
    use std::net::TcpStream;

    use super::super::Pages;
    use super::*;

    fn get(server: &Server, path: &str, host: &str) -> String {
        let mut stream = TcpStream::connect(server.address).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").unwrap();
        let mut text = String::new();
        stream.read_to_string(&mut text).unwrap();
        text
    }

    #[test]
    fn it_serves_the_loopback_address_alone() {
        let news = Arc::new(News::default());
        let server = Server::start("<crank>.mbs", &news, 0).unwrap();
        assert!(server.address.ip().is_loopback());
        let host = server.address.to_string();
        assert!(get(&server, "/", &host).contains("<title>&lt;crank&gt;.mbs</title>"));
        assert!(get(&server, "/", "evil.example").starts_with("HTTP/1.1 403"));
        assert!(get(&server, "/recorded/1", &host).starts_with("HTTP/1.1 404"));
        assert!(get(&server, "/../Cargo.toml", &host).starts_with("HTTP/1.1 404"));

        news.tell(Ok(Pages { recorded: "<p>moving</p>".into(), played: Some("<p>to play</p>".into()) }));
        news.tell(Err("line 3: no body `wheel`".into()));
        let told = get(&server, "/news?after=1", &host);
        assert!(
            told.ends_with(r#"{"error":"line 3: no body `wheel`","page":1,"played":true,"version":2}"#),
            "{told}"
        );
        assert!(get(&server, "/recorded/1", &host).ends_with("<p>moving</p>"));
        assert!(get(&server, "/played/1", &host).ends_with("<p>to play</p>"));
    }
}
