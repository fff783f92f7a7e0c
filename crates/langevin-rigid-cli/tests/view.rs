//! The page that `view` serves: what stands at which address, who is refused, and what is shown.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use std::collections::HashMap;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};

use common::{BALL, Place, read, scene};
use langevin_rigid_formats::trajectory::read_csv;
use langevin_rigid_scenes::scene::{BUILT_IN, Scene};
use serde_json::{Value, json};

/// The command, serving on a port that was free.
struct Server {
    child: Child,
    port: u16,
}

impl Server {
    fn start(place: &Place, what: &[&str]) -> Self {
        Self::start_with(place, &[&["--port", "0"], what].concat())
    }

    fn start_with(place: &Place, arguments: &[&str]) -> Self {
        let mut child = Command::new(assert_cmd::cargo::cargo_bin("langevin-rigid"))
            .current_dir(place.0.path())
            .args(["view", "--no-open"])
            .args(arguments)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        out.read_line(&mut line).unwrap();
        let port = line.strip_prefix("http://127.0.0.1:");
        let port = port.and_then(|rest| rest.strip_suffix("/\n"));
        let port = port.unwrap_or_else(|| panic!("no address but `{line}`"));
        Self {
            child,
            port: port.parse().unwrap(),
        }
    }

    /// Sends a request with these lines of headers in place of `Host`.
    fn ask_with(&self, method: &str, address: &str, headers: &[String]) -> Answer {
        let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, self.port)).unwrap();
        let headers: String = headers.iter().map(|line| format!("{line}\r\n")).collect();
        let request = format!("{method} {address} HTTP/1.1\r\n{headers}Connection: close\r\n\r\n");
        stream.write_all(request.as_bytes()).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        Answer::of(&bytes)
    }

    /// As a page does that was loaded from here, with further headers.
    fn ask(&self, method: &str, address: &str, headers: &[&str]) -> Answer {
        let mut lines = vec![format!("Host: 127.0.0.1:{}", self.port)];
        lines.extend(headers.iter().map(|&line| line.to_owned()));
        self.ask_with(method, address, &lines)
    }

    fn get(&self, address: &str) -> Answer {
        self.ask("GET", address, &[])
    }

    fn opened(&self) -> Value {
        let answer = self.get("/opened.json");
        assert_eq!(answer.status, 200);
        assert_eq!(answer.headers["content-type"], "application/json");
        serde_json::from_slice(&answer.body).unwrap()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}

struct Answer {
    status: u16,
    headers: HashMap<String, String>,
    body: Vec<u8>,
}

impl Answer {
    fn of(bytes: &[u8]) -> Self {
        let end = bytes.windows(4).position(|w| w == b"\r\n\r\n").unwrap();
        let mut lines = std::str::from_utf8(&bytes[..end]).unwrap().lines();
        let status = lines.next().unwrap().split(' ').nth(1).unwrap();
        let headers = lines.map(|line| line.split_once(": ").unwrap());
        Self {
            status: status.parse().unwrap(),
            headers: headers
                .map(|(name, value)| (name.to_lowercase(), value.to_owned()))
                .collect(),
            body: bytes[end + 4..].to_vec(),
        }
    }

    fn text(&self) -> &str {
        std::str::from_utf8(&self.body).unwrap()
    }

    fn has_the_headers_of_all(&self) {
        for (name, value) in [
            ("x-content-type-options", "nosniff"),
            ("referrer-policy", "no-referrer"),
            ("cross-origin-opener-policy", "same-origin"),
            ("cross-origin-resource-policy", "same-origin"),
            ("cache-control", "no-cache"),
            (
                "content-security-policy",
                "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; \
                 img-src 'self' blob: data:; connect-src 'self' blob: data:; worker-src 'self' blob:; \
                 object-src 'none'; base-uri 'none'; frame-ancestors 'none'; form-action 'none'",
            ),
        ] {
            assert_eq!(self.headers[name], value);
        }
    }
}

/// A tetrahedron.
const OBJ: &str =
    "v 0 0 0\nv 0.02 0 0\nv 0 0.02 0\nv 0 0 0.02\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn hull(mesh: &str) -> String {
    format!("mesh = \"{mesh}\"\nunit = \"m\"\ndensity = 1500.0")
}

#[test]
fn the_page_is_there_with_its_headers() {
    let place = Place::new();
    let server = Server::start(&place, &[]);
    let page = server.get("/");
    assert_eq!(page.status, 200);
    assert_eq!(page.headers["content-type"], "text/html; charset=utf-8");
    page.has_the_headers_of_all();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/page/index.html");
    assert!(page.body == std::fs::read(file).unwrap());
    assert!(page.body == server.get("/index.html").body);

    let head = server.ask("HEAD", "/", &[]);
    assert_eq!(head.status, 200);
    assert_eq!(head.headers["content-length"], page.body.len().to_string());
    assert!(head.body.is_empty());
    assert_eq!(server.opened(), Value::Null);
}

#[test]
fn what_is_not_there_is_not_found() {
    let place = Place::new();
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.1"));
    let server = Server::start(&place, &[&file]);
    for address in [
        "/nothing",
        "/index.html/",
        "//",
        "/opened",
        "/opened/trajectory.csv",
        "/opened/files/",
        "/opened/files/ball.toml",
        "/ball.toml",
        "/../Cargo.toml",
        "/assets/../../Cargo.toml",
        "/%2e%2e/Cargo.toml",
        "/..%2fCargo.toml",
        "/opened/files/..%2f..%2f..%2fetc%2fpasswd",
        "/%ff%00",
    ] {
        let answer = server.get(address);
        assert_eq!(answer.status, 404, "{address}");
        answer.has_the_headers_of_all();
    }
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "PATCH", "ANY"] {
        let answer = server.ask(method, "/", &["Content-Length: 0"]);
        assert_eq!(answer.status, 405, "{method}");
        assert_eq!(answer.headers["allow"], "GET, HEAD");
        answer.has_the_headers_of_all();
    }
}

#[test]
fn others_are_refused() {
    let place = Place::new();
    let server = Server::start(&place, &[]);
    let port = server.port;
    let refused = |answer: &Answer, why: &str| {
        assert_eq!(answer.status, 403, "{why}");
        assert!(answer.text().ends_with(".\n"), "{why}");
        answer.has_the_headers_of_all();
    };
    for host in [format!("localhost:{port}"), format!("[::1]:{port}")] {
        let answer = server.ask_with("GET", "/", &[format!("Host: {host}")]);
        assert_eq!(answer.status, 200, "{host}");
    }
    for host in [format!("evil.example:{port}"), "127.0.0.1".into()] {
        let lines = [format!("Host: {host}")];
        refused(&server.ask_with("GET", "/", &lines), &host);
        refused(&server.ask_with("GET", "/opened.json", &lines), &host);
    }
    refused(&server.ask_with("GET", "/", &[]), "no host");

    let own = format!("Origin: http://localhost:{port}");
    assert_eq!(server.ask("GET", "/opened.json", &[&own]).status, 200);
    for origin in ["http://evil.example", "null", "http://127.0.0.1"] {
        let line = format!("Origin: {origin}");
        refused(&server.ask("GET", "/opened.json", &[&line]), origin);
    }
    for site in ["cross-site", "same-site"] {
        let site = format!("Sec-Fetch-Site: {site}");
        let fetch = [&site, "Sec-Fetch-Mode: no-cors", "Sec-Fetch-Dest: script"];
        refused(&server.ask("GET", "/opened.json", &fetch), &site);
        refused(&server.ask("GET", "/", &fetch), &site);
        let link = [
            &site,
            "Sec-Fetch-Mode: navigate",
            "Sec-Fetch-Dest: document",
        ];
        assert_eq!(server.ask("GET", "/", &link).status, 200);
        refused(&server.ask("GET", "/opened.json", &link), &site);
    }
    let own = ["Sec-Fetch-Site: same-origin", "Sec-Fetch-Mode: cors"];
    assert_eq!(server.ask("GET", "/opened.json", &own).status, 200);
}

#[test]
fn a_built_in_scene_is_opened_as_it_is() {
    let place = Place::new();
    let opened = Server::start(&place, &["leaf"]).opened();
    let leaf = BUILT_IN.iter().find(|scene| scene.name == "leaf").unwrap();
    let expected = json!({
        "kind": "scene",
        "name": "leaf",
        "toml": leaf.scene().unwrap().to_toml().unwrap(),
        "files": [],
        "tables": {},
    });
    assert_eq!(opened, expected);
}

#[test]
fn a_scene_comes_with_its_files_as_they_were_at_the_start() {
    let place = Place::new();
    std::fs::create_dir(place.path("my bodies")).unwrap();
    place.write("my bodies/hüll.obj", OBJ);
    let rest = "duration = 0.1\n[[obstacle]]\nshape = \"mesh\"\nmesh = \"my bodies/hüll.obj\"\nunit = \"m\"\nposition = [0.0, -1.0, 0.0]";
    let file = place.write("hull.toml", &scene(&hull("my bodies/hüll.obj"), rest));
    let server = Server::start(&place, &[&file]);
    place.write("my bodies/hüll.obj", "something else");
    let opened = server.opened();
    assert_eq!(opened["kind"], "scene");
    assert_eq!(opened["name"], "hull");
    assert_eq!(opened["files"], json!(["0-h-ll.obj"]));
    let toml = opened["toml"].as_str().unwrap();
    assert_eq!(toml.matches("mesh = \"0-h-ll.obj\"").count(), 2, "{toml}");
    Scene::parse("hull", "hull.toml", toml).unwrap();
    let mesh = server.get("/opened/files/0-h-ll.obj");
    assert_eq!(mesh.text(), OBJ);
    assert_eq!(mesh.headers["content-type"], "application/octet-stream");
    mesh.has_the_headers_of_all();
}

#[test]
fn a_run_comes_with_its_tables_and_the_scenes_of_its_crowd() {
    let place = Place::new();
    std::fs::create_dir(place.path("kinds")).unwrap();
    place.write("kinds/hull.obj", OBJ);
    // It names itself, by another path.
    let itself = "duration = 0.1\n[crowd]\ncount = 1\n[[crowd.kinds]]\nscene = \"../kinds/Ahornblätter.toml\"";
    place.write("kinds/Ahornblätter.toml", &scene(&hull("hull.obj"), itself));
    let crowd = "duration = 0.05\n[crowd]\ncount = 4\nover = [0.5, 0.5, 0.5]\n[[crowd.kinds]]\nscene = \"kinds/Ahornblätter.toml\"\n\
                 [[wind]]\nfield = \"uniform\"\nvelocity = [0.1, 0.0, 0.0]\nbodies = [\"Ahornblätter\"]";
    let file = place.write("many.toml", &scene(BALL, crowd));
    let simulated = place.run(&["simulate", &file, "--format", "csv", "--out", "run"]);
    assert_eq!(simulated.code, 0, "{}", simulated.err);

    let server = Server::start(&place, &["run"]);
    let opened = server.opened();
    assert_eq!(opened["kind"], "run");
    assert_eq!(opened["name"], "many");
    let tables = json!({"trajectory": "trajectory.csv", "bodies": "bodies.csv"});
    assert_eq!(opened["tables"], tables);
    for name in ["trajectory.csv", "bodies.csv"] {
        let table = server.get(&format!("/opened/{name}"));
        assert_eq!(table.headers["content-type"], "text/csv; charset=utf-8");
        assert_eq!(table.text(), read(&place.path("run").join(name)));
    }
    let steps = server.get("/opened/trajectory.csv");
    assert_eq!(read_csv(steps.text()).unwrap().len(), 4);

    assert_eq!(opened["files"], json!(["0-hull.obj", "Ahornblätter.toml"]));
    let resolved = Scene::parse("many", "many.toml", opened["toml"].as_str().unwrap()).unwrap();
    let kinds = |scene: &Scene| scene.crowd.as_ref().unwrap().kinds[0].scene.clone();
    assert_eq!(kinds(&resolved), "Ahornblätter.toml");
    let kind = server.get("/opened/files/Ahornbl%C3%A4tter.toml");
    let kind = Scene::parse("Ahornblätter", "Ahornblätter.toml", kind.text()).unwrap();
    assert_eq!(kinds(&kind), "Ahornblätter.toml");
    assert_eq!(server.get("/opened/files/0-hull.obj").text(), OBJ);
}

#[test]
fn what_cannot_be_shown_says_why_before_anything_is_served() {
    let place = Place::new();
    let fails = |what: &str, words: &[&str]| {
        let outcome = place.run(&["view", "--no-open", "--port", "0", what]);
        outcome.fails_with(words);
        assert_eq!(outcome.out, "");
    };
    fails("laef", &["laef", "did you mean `leaf`?"]);
    std::fs::create_dir(place.path("empty")).unwrap();
    fails(
        "empty",
        &["empty/trajectory.csv", "langevin-rigid simulate"],
    );

    let file = place.write("ball.toml", &scene(BALL, "duration = 0.1"));
    place.run(&["simulate", &file, "--format", "csv", "--out", "run"]);
    let table = read(&place.path("run/trajectory.csv"));
    place.run(&["simulate", &file, "--format", "glb", "--out", "run"]);
    fails("run", &["older run", "csv among its formats"]);
    place.run(&["simulate", &file, "--format", "csv", "--out", "run"]);
    place.write(
        "run/trajectory.csv",
        &table.replacen("\n0,0.005,", "\n0,x,", 1),
    );
    fails("run", &["trajectory.csv", "line 3", "`x` is not a number"]);
    place.write("run/trajectory.csv", &table);
    std::fs::remove_file(place.path("run/scene.toml")).unwrap();
    fails("run", &["scene.toml"]);

    let lost = place.write("lost.toml", &scene(&hull("lost.obj"), "duration = 0.1"));
    fails(&lost, &["lost.obj", "which the scene names"]);
    place.write(
        "parts.gltf",
        r#"{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 9, "uri": "parts.bin"}]}"#,
    );
    let parts = place.write("parts.toml", &scene(&hull("parts.gltf"), "duration = 0.1"));
    fails(&parts, &["parts.gltf", "`parts.bin`", "save it as .glb"]);
    for folder in ["a", "b"] {
        std::fs::create_dir(place.path(folder)).unwrap();
        place.write(
            &format!("{folder}/nut.toml"),
            &scene(BALL, "duration = 0.1"),
        );
    }
    let crowd = "duration = 0.1\n[crowd]\ncount = 4\nkinds = [{ scene = \"a/nut.toml\" }, { scene = \"b/nut.toml\" }]";
    let nuts = place.write("nuts.toml", &scene(BALL, crowd));
    fails(&nuts, &["both be `nut.toml`", "rename one"]);
}

#[test]
fn another_port_takes_the_place_of_the_usual_one_where_that_is_in_use() {
    let place = Place::new();
    // By us, or by whoever had it before.
    let _taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 8420));
    let server = Server::start_with(&place, &[]);
    assert_ne!(server.port, 8420);
    assert_eq!(server.get("/").status, 200);
}

#[test]
fn a_port_that_was_asked_for_and_is_in_use_says_so() {
    let place = Place::new();
    let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    place
        .run(&["view", "--no-open", "--port", &port])
        .fails_with(&[&port, "give another --port"]);
    let outcome = place.run(&["view", "--no-open", "--port", "99999"]);
    assert_eq!(outcome.code, 2);
}
