//! The server of the page, for this machine alone.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::time::Duration;

use serde_json::json;

use super::News;
use super::http::{Limits, Reply, Request, serve};
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
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let address = listener.local_addr()?;
        let shell = filled(SHELL, &[("TITLE", &escaped(title))]);
        let news = Arc::clone(news);
        serve(listener, Limits::default(), move |request| answer(request, address, &shell, &news))?;
        Ok(Self { address })
    }

    /// Where the page is.
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }
}

fn answer(request: &Request, address: SocketAddr, shell: &str, news: &News) -> Reply {
    let html = |text: String| Reply { status: 200, kind: "text/html; charset=utf-8", text };
    let path = request.path.as_str();
    if !is_local(request, address) {
        // A page of somebody else, whose name was made to lead here, is told nothing.
        return Reply::plain(403, "only for this machine");
    }
    if path == "/" {
        return html(shell.to_owned());
    }
    if let Some(version) = path.strip_prefix("/news?after=").and_then(|n| n.parse().ok()) {
        let now = news.after(version, PATIENCE);
        let page = now.pages.as_ref().map(|(version, _)| version);
        let is_played = now.pages.as_ref().is_some_and(|(_, pages)| pages.played.is_some());
        let told = json!({ "version": now.version, "page": page, "played": is_played, "error": now.error });
        return Reply { status: 200, kind: "application/json", text: told.to_string() };
    }
    page(path, news).map_or_else(|| Reply::plain(404, "there is no such page"), html)
}

/// The last page at a path: `/recorded/` or `/played/` with a version, which browsers tell apart by it.
fn page(path: &str, news: &News) -> Option<String> {
    let (_, pages) = news.now().pages.clone()?;
    if path.starts_with("/recorded/") {
        return Some(pages.recorded);
    }
    path.strip_prefix("/played/").and(pages.played)
}

/// True if a request names the address that it came to: a browser names the host of the
/// page's own address.
fn is_local(request: &Request, address: SocketAddr) -> bool {
    let port = address.port();
    let known = [address.to_string(), format!("localhost:{port}")];
    request.host.as_ref().is_some_and(|host| known.contains(host))
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
