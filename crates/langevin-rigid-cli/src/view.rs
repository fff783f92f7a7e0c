//! `langevin-rigid view`

mod bundle;
mod guard;
mod opened;
mod site;

use std::io::Write;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::{io, thread};

use anyhow::{Context, Result};
use axum::Router;
use axum::extract::Request;

use crate::arguments::View;
use crate::bars::Bars;
use crate::say;
use guard::Guard;
use opened::Opened;
use site::Site;

const PORT: u16 = 8420;

pub(crate) fn view(options: &View, bars: &Bars) -> Result<()> {
    let opened = options.what.as_deref().map(Opened::read).transpose()?;
    let listener = listen(options.port)?;
    let address = listener.local_addr()?;
    let site = Site::new(Guard::of(address.port()), opened)?;
    let url = format!("http://{address}/");
    writeln!(say::out(), "{url}")?;
    say::aside("Ctrl-C ends it");
    serve(listener, site)?;
    if !options.no_open && open::that_detached(&url).is_err() {
        say::note("no browser could be opened: open the address above in one");
    }
    bars.wait_for_signal();
    Ok(())
}

fn listen(port: Option<u16>) -> Result<TcpListener> {
    let bind = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    match port {
        Some(port) => bind(port).with_context(|| {
            format!("cannot serve on port {port}: give another --port, or 0 for any that is free")
        }),
        None => bind(PORT)
            .or_else(|_| bind(0))
            .context("cannot serve on any port"),
    }
}

/// Serves in a thread of its own until the program ends.
fn serve(listener: TcpListener, site: Site) -> io::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    listener.set_nonblocking(true)?;
    let site = Arc::new(site);
    let answer = move |request: Request| {
        let site = Arc::clone(&site);
        async move { site.answer(&request) }
    };
    let router = Router::new().fallback(answer);
    thread::spawn(move || {
        runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(listener)?;
            axum::serve(listener, router).await
        })
    });
    Ok(())
}
