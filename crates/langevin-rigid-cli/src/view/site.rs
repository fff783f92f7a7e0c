//! What stands at which address. All of it is in memory: nothing changes under the page, and no address leads into a folder.

use std::collections::HashMap;
use std::path::Path;

use anyhow::Result;
use axum::body::Bytes;
use axum::extract::Request;
use axum::http::header::{
    ALLOW, CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderName, REFERRER_POLICY,
    X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{Method, StatusCode};
use axum::response::{IntoResponse, Response};
use percent_encoding::percent_decode_str;

use super::guard::Guard;
use super::opened::Opened;

/// The files of the page, with their addresses.
const PAGE: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/page.rs"));
const INDEX: &str = "/index.html";

const TEXT: &str = "text/plain; charset=utf-8";
const DATA: &str = "application/octet-stream";

/// What every answer says: the page takes nothing from elsewhere and nobody else takes it.
const HEADERS: [(HeaderName, &str); 6] = [
    (
        CONTENT_SECURITY_POLICY,
        "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; \
         img-src 'self' blob: data:; connect-src 'self' blob: data:; worker-src 'self' blob:; \
         object-src 'none'; base-uri 'none'; frame-ancestors 'none'; form-action 'none'",
    ),
    (X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (REFERRER_POLICY, "no-referrer"),
    (
        HeaderName::from_static("cross-origin-opener-policy"),
        "same-origin",
    ),
    (
        HeaderName::from_static("cross-origin-resource-policy"),
        "same-origin",
    ),
    (CACHE_CONTROL, "no-cache"),
];

/// The page and what was opened with it.
pub(super) struct Site {
    guard: Guard,
    files: HashMap<String, File>,
}

/// What is at an address.
struct File {
    media_type: &'static str,
    bytes: Bytes,
}

impl Site {
    pub(super) fn new(guard: Guard, opened: Option<Opened>) -> Result<Self> {
        let mut site = Self {
            guard,
            files: HashMap::new(),
        };
        for (address, bytes) in PAGE {
            site.put(address, *bytes);
        }
        let described = serde_json::to_vec(&opened.as_ref().map(Opened::described))?;
        site.put("/opened.json", described);
        if let Some(opened) = opened {
            for (name, table) in opened.tables {
                site.put(&format!("/opened/{name}"), table);
            }
            for (name, bytes) in opened.files {
                // Files of others are data, whatever they are called: no browser shows or runs them.
                site.put_as(DATA, &format!("/opened/files/{name}"), bytes);
            }
        }
        Ok(site)
    }

    fn put(&mut self, address: &str, bytes: impl Into<Bytes>) {
        self.put_as(media_type(address), address, bytes);
    }

    fn put_as(&mut self, media_type: &'static str, address: &str, bytes: impl Into<Bytes>) {
        let bytes = bytes.into();
        let file = File { media_type, bytes };
        self.files.insert(address.to_owned(), file);
    }

    pub(super) fn answer(&self, request: &Request) -> Response {
        (HEADERS, self.content(request)).into_response()
    }

    fn content(&self, request: &Request) -> Response {
        let address = percent_decode_str(request.uri().path()).decode_utf8_lossy();
        let address = match &*address {
            "/" => INDEX,
            address => address,
        };
        if let Some(reason) = self.guard.refuse(request.headers(), address == INDEX) {
            return told(StatusCode::FORBIDDEN, reason).into_response();
        }
        if ![Method::GET, Method::HEAD].contains(request.method()) {
            let reason = told(StatusCode::METHOD_NOT_ALLOWED, "This is only to be read.\n");
            return ([(ALLOW, "GET, HEAD")], reason).into_response();
        }
        match self.files.get(address) {
            Some(file) => ([(CONTENT_TYPE, file.media_type)], file.bytes.clone()).into_response(),
            None => told(StatusCode::NOT_FOUND, "There is nothing here.\n").into_response(),
        }
    }
}

fn told(status: StatusCode, reason: &'static str) -> impl IntoResponse {
    (status, [(CONTENT_TYPE, TEXT)], reason)
}

fn media_type(name: &str) -> &'static str {
    let extension = Path::new(name).extension().unwrap_or_default();
    match extension.to_str().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript",
        "css" => "text/css",
        "csv" => "text/csv; charset=utf-8",
        "txt" | "md" => TEXT,
        "json" => "application/json",
        "wasm" => "application/wasm",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "woff2" => "font/woff2",
        _ => DATA,
    }
}
