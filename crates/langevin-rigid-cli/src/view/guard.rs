//! Who may ask: the page and whoever sits at this machine, not the pages of others that their browser shows.

use axum::http::header::{HOST, ORIGIN};
use axum::http::{HeaderMap, HeaderValue};

/// The names that the page has on this machine.
pub(super) struct Guard {
    hosts: [String; 3],
}

impl Guard {
    pub(super) fn of(port: u16) -> Self {
        // Browsers leave out the port that is usual.
        let port = match port {
            80 => String::new(),
            port => format!(":{port}"),
        };
        Self {
            hosts: ["127.0.0.1", "localhost", "[::1]"].map(|host| format!("{host}{port}")),
        }
    }

    /// Why a request is refused, if it is. `index` says whether it is for the page itself, to which others may have links.
    pub(super) fn refuse(&self, headers: &HeaderMap, index: bool) -> Option<&'static str> {
        if !self.is_ours(headers) {
            // A name of somebody else's that leads here (DNS rebinding).
            return Some(
                "This page is served under the address that langevin-rigid printed only.\n",
            );
        }
        let mut origins = headers.get_all(ORIGIN).iter();
        if !origins.all(|origin| self.is_origin(origin)) || is_foreign(headers, index) {
            return Some("Other pages have no access to this one.\n");
        }
        None
    }

    fn is_ours(&self, headers: &HeaderMap) -> bool {
        let mut hosts = headers.get_all(HOST).iter();
        let first = hosts.next();
        first.is_some_and(|host| self.is_host(host.as_bytes())) && hosts.next().is_none()
    }

    fn is_host(&self, host: &[u8]) -> bool {
        let host = host.to_ascii_lowercase();
        self.hosts.iter().any(|ours| ours.as_bytes() == host)
    }

    fn is_origin(&self, origin: &HeaderValue) -> bool {
        let host = origin.as_bytes().strip_prefix(b"http://");
        host.is_some_and(|host| self.is_host(host))
    }
}

/// Whether the browser says that another site asks, and not for following a link to the page.
fn is_foreign(headers: &HeaderMap, index: bool) -> bool {
    let fetch = |name| headers.get(name).map(HeaderValue::as_bytes);
    let own = matches!(
        fetch("sec-fetch-site"),
        None | Some(b"same-origin" | b"none")
    );
    let link = fetch("sec-fetch-mode") == Some(b"navigate")
        && matches!(fetch("sec-fetch-dest"), None | Some(b"document"));
    !(own || index && link)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(port: u16, index: bool, headers: &[(&'static str, &'static str)]) -> bool {
        let headers = headers
            .iter()
            .map(|(name, value)| (name.parse().unwrap(), HeaderValue::from_static(value)));
        let mut map = HeaderMap::new();
        for (name, value) in headers {
            let name: axum::http::HeaderName = name;
            map.append(name, value);
        }
        Guard::of(port).refuse(&map, index).is_some()
    }

    #[test]
    fn only_the_names_of_this_machine_lead_to_it() {
        for host in [
            "127.0.0.1:8420",
            "localhost:8420",
            "LocalHost:8420",
            "[::1]:8420",
        ] {
            assert!(!refused(8420, false, &[("host", host)]), "{host}");
        }
        for host in [
            "",
            "127.0.0.1",
            "127.0.0.1:80",
            "localhost:84200",
            "0.0.0.0:8420",
            "evil.example:8420",
            "localhost:8420.evil.example",
        ] {
            assert!(refused(8420, true, &[("host", host)]), "{host}");
        }
        assert!(refused(8420, true, &[]));
        let twice = [("host", "localhost:8420"), ("host", "evil.example")];
        assert!(refused(8420, true, &twice));
        assert!(!refused(80, true, &[("host", "localhost")]));
    }

    #[test]
    fn origins_of_others_are_refused() {
        let from = |origin| [("host", "localhost:8420"), ("origin", origin)];
        assert!(!refused(8420, false, &from("http://localhost:8420")));
        assert!(!refused(8420, false, &from("http://127.0.0.1:8420")));
        for origin in [
            "null",
            "",
            "http://localhost",
            "https://localhost:8420",
            "http://evil.example",
        ] {
            assert!(refused(8420, true, &from(origin)), "{origin}");
        }
    }

    #[test]
    fn another_site_may_link_to_the_page_and_do_no_more() {
        let asks = |index, site, mode, dest| {
            let headers = [
                ("host", "localhost:8420"),
                ("sec-fetch-site", site),
                ("sec-fetch-mode", mode),
                ("sec-fetch-dest", dest),
            ];
            !refused(8420, index, &headers)
        };
        for site in ["same-origin", "none"] {
            assert!(asks(false, site, "cors", "empty"));
        }
        for site in ["cross-site", "same-site"] {
            assert!(asks(true, site, "navigate", "document"));
            assert!(!asks(false, site, "navigate", "document"));
            assert!(!asks(true, site, "navigate", "iframe"));
            assert!(!asks(true, site, "no-cors", "script"));
        }
    }
}
