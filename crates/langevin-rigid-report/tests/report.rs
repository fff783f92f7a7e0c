//! The whole report on a few seeds, read as its readers do.
//!
//! A page that says one thing while its data say another, a picture without its body, a number that
//! is not from the runs: each is caught here.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use langevin_rigid_bake::progress::Progress;
use langevin_rigid_report::{Options, PARTS, Part, Report, pages, reproduce};

struct Made {
    folder: tempfile::TempDir,
    report: Report,
}

fn options(first_seed: u64) -> Options {
    Options {
        parts: PARTS.to_vec(),
        seeds: 3,
        first_seed,
        cache: None,
    }
}

fn make(options: &Options) -> Made {
    let folder = tempfile::tempdir().unwrap();
    let report = reproduce(options, folder.path(), &()).unwrap();
    Made { folder, report }
}

/// The report that most tests read: made once.
fn made() -> &'static Made {
    static MADE: OnceLock<Made> = OnceLock::new();
    MADE.get_or_init(|| make(&options(1)))
}

fn page(made: &Made) -> String {
    std::fs::read_to_string(&made.report.page).unwrap()
}

/// The numbers of a part's raw data.
fn raw(folder: &Path, part: &str) -> BTreeMap<String, f64> {
    let text = std::fs::read_to_string(folder.join(part).join("numbers.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn all_raw(folder: &Path) -> BTreeMap<String, f64> {
    PARTS.iter().flat_map(|p| raw(folder, p.name)).collect()
}

/// Key, full value and shown text of every number of the page.
fn quoted(page: &str) -> Vec<(&str, f64, &str)> {
    page.split("<data data-key=\"")
        .skip(1)
        .map(|rest| {
            let (key, rest) = rest.split_once('"').unwrap();
            let (_, rest) = rest.split_once("value=\"").unwrap();
            let (value, rest) = rest.split_once("\">").unwrap();
            (
                key,
                value.parse().unwrap(),
                rest.split_once("</data>").unwrap().0,
            )
        })
        .collect()
}

/// The number that a reader sees.
fn read_by_eye(shown: &str) -> f64 {
    let plain = shown
        .replace('\u{2212}', "-")
        .replace("\u{b7}10<sup>", "e")
        .replace("</sup>", "");
    plain.parse().unwrap()
}

#[test]
fn the_page_shows_the_numbers_of_the_raw_data_and_all_of_them() {
    let made = made();
    let page = page(made);
    let mut raw = all_raw(made.folder.path());
    let shown = quoted(&page);
    assert!(shown.len() > 300, "{}", shown.len());
    for (key, value, text) in &shown {
        let kept = raw
            .get(*key)
            .unwrap_or_else(|| panic!("{key} is not in the data"));
        // Reading JSON may round the last bit.
        assert!(
            (kept - value).abs() <= 1e-15 * value.abs(),
            "{key}: {kept} and {value}"
        );
        let seen = read_by_eye(text);
        assert!(
            (seen - value).abs() <= 0.051 * value.abs() + 1e-12,
            "{key}: {text} for {value}"
        );
    }
    for (key, ..) in shown {
        raw.remove(key);
    }
    assert!(raw.is_empty(), "not in the page: {raw:?}");
}

#[test]
fn no_digit_of_a_result_stands_in_the_page_by_itself() {
    // Between the words of the measured paragraphs and tables, numbers are in `data` elements: what is
    // left of a median or a spread outside them would be a constant.
    let page = page(made());
    for part in ["fig3", "fig4", "fig5"] {
        let start = page.find(&format!("<section id=\"{part}\">")).unwrap();
        let section = &page[start..start + page[start..].find("</section>").unwrap()];
        for table in section.split("<tbody>").skip(1) {
            let mut body = table.split("</tbody>").next().unwrap().to_owned();
            while let Some(at) = body.find("<data") {
                let end = at + body[at..].find("</data>").unwrap() + "</data>".len();
                body.replace_range(at..end, "");
            }
            assert!(
                !body.contains(|c: char| c.is_ascii_digit()),
                "{part}: {body}"
            );
        }
    }
}

#[test]
fn the_page_needs_nothing_else() {
    let page = page(made());
    for outside in [
        "http://www",
        "https://",
        "src=\"/",
        "<link",
        "<script",
        "url(",
        "@import",
    ] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("name=\"viewport\""));
    for image in page.split("<img ").skip(1) {
        let (_, source) = image.split_once("src=\"").unwrap();
        assert!(source.starts_with("data:image/png;base64,iVBORw0KGgo"));
    }
    assert!(page.matches("<svg ").count() >= 15);
    // The letters of a picture mean nothing.
    let words: String = page
        .split("data:image/png;base64,")
        .map(|part| part.split_once('"').map_or(part, |(_, words)| words))
        .collect();
    assert!(!words.contains("NaN") && !words.contains(">inf"));
}

/// Width, height and the red, green and blue of each pixel.
fn pixels(path: &Path) -> (usize, usize, Vec<[u8; 3]>) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let rgb = bytes.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    (info.width as usize, info.height as usize, rgb)
}

fn is_orange([r, g, b]: [u8; 3]) -> bool {
    r > 80 && r > g.saturating_add(30) && g > b
}

fn is_teal([r, g, b]: [u8; 3]) -> bool {
    b > r.saturating_add(30) && g > r.saturating_add(30)
}

#[test]
fn every_picture_shows_its_body_whole() {
    let made = made();
    let mut seen = 0;
    for part in PARTS {
        for entry in std::fs::read_dir(made.folder.path().join(part.name)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|e| e != "png") {
                continue;
            }
            let (width, height, rgb) = pixels(&path);
            let name = path.display();
            let body = |i: &usize| is_orange(rgb[*i]) || is_teal(rgb[*i]);
            // Above the key, which has the colours of both faces.
            let drawn: Vec<usize> = (0..width * (height - 120)).filter(body).collect();
            assert!(
                drawn.len() > 800,
                "{name}: {} pixels of the body",
                drawn.len()
            );
            for i in drawn {
                let (x, y) = (i % width, i / width);
                let inside = (40..width - 8).contains(&x) && (90..height - 120).contains(&y);
                assert!(inside, "{name}: the body is cut off at {x}, {y}");
            }
            seen += 1;
        }
    }
    let page = page(made);
    assert!(seen >= 17, "{seen}");
    assert_eq!(page.matches("<img ").count(), seen);
}

#[test]
fn other_seeds_give_other_numbers_and_the_same_seeds_the_same() {
    let parts: Vec<Part> = ["fig3", "fig5"]
        .map(|name| Part::named(name).unwrap())
        .into();
    let made = made();
    for (first_seed, same) in [(1, true), (1001, false)] {
        let options = Options {
            parts: parts.clone(),
            ..options(first_seed)
        };
        let again = make(&options);
        for part in ["fig3", "fig5"] {
            let (a, b) = (
                raw(made.folder.path(), part),
                raw(again.folder.path(), part),
            );
            let noisy = |key: &&String| {
                key.ends_with("fall_speed.median") && key.contains(".consistent.")
                    || key.ends_with("fall_speed.median") && key.contains(".separated.")
            };
            assert_eq!(a == b, same, "{part}");
            for key in a.keys().filter(noisy) {
                assert_eq!(a[key] == b[key], same, "{key}");
            }
        }
    }
}

#[test]
fn verdicts_follow_from_the_counts() {
    for section in &made().report.sections {
        // Controls are counted, not judged.
        for claim in section
            .claims
            .iter()
            .filter(|c| !c.words.starts_with("Control"))
        {
            let counts: Vec<f64> = quoted(&claim.verdict).iter().map(|q| q.1).collect();
            let best = counts.chunks(2).map(|c| c[0] / c[1]).fold(0.0, f64::max);
            let wanted = match best {
                share if share >= 0.5 => "<b>Reproduced</b> under",
                share if share >= 0.1 => "<b>Partly reproduced</b> under",
                _ => "<b>Not reproduced</b> under",
            };
            assert!(
                claim.verdict.starts_with(wanted),
                "{}: {}",
                claim.words,
                claim.verdict
            );
        }
    }
}

/// Asks to stop when a stage is reached.
struct StopAt(&'static str, AtomicBool);

impl Progress for StopAt {
    fn report(&self, stage: &str, _: f64) {
        if stage == self.0 {
            self.1.store(true, Ordering::Relaxed);
        }
    }

    fn cancelled(&self) -> bool {
        self.1.load(Ordering::Relaxed)
    }
}

#[test]
fn an_interrupted_report_keeps_what_is_finished_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let stop = StopAt("fig4", AtomicBool::new(false));
    let report = reproduce(&options(1), folder.path(), &stop).unwrap();
    let names: Vec<&str> = report.sections.iter().map(|s| s.id).collect();
    assert_eq!(
        (names.as_slice(), report.complete),
        (&["fig2", "fig3"][..], false)
    );
    let page = std::fs::read_to_string(&report.page).unwrap();
    assert!(page.contains("Not finished: fig4, fig5") && page.contains("<section id=\"fig3\">"));
    assert!(folder.path().join("fig3/numbers.json").exists());
    assert!(!folder.path().join("fig4").exists());
}

#[test]
fn tables_are_kept_as_markdown() {
    let made = made();
    let mut kept = 0;
    for section in &made.report.sections {
        let mut names: Vec<&str> = section.tables.iter().map(|t| t.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), section.tables.len(), "{}", section.id);
        for table in &section.tables {
            let path = made.folder.path().join(section.id);
            let text = std::fs::read_to_string(path.join(format!("{}.md", table.name))).unwrap();
            assert_eq!(text, table.markdown);
            assert!(!text.contains("<data") && !text.contains("&lt;"), "{text}");
            let columns = |line: &str| line.replace("\\|", "").matches('|').count();
            let mut lines = text.lines().map(columns);
            let head = lines.next().unwrap();
            assert!(
                lines.clone().count() > 1 && lines.all(|n| n == head),
                "{text}"
            );
            kept += 1;
        }
    }
    assert!(kept >= 15, "{kept}");
}

#[test]
fn every_table_of_the_manual_is_one_of_a_part() {
    let manual = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let sections = &made().report.sections;
    let computed: Vec<pages::Computed> = sections
        .iter()
        .map(|section| (section.id, section.tables.as_slice()))
        .collect();
    let mut seen = 0;
    for page in pages::list(&manual).unwrap() {
        let text = std::fs::read_to_string(&page).unwrap();
        pages::replaced(&text, &computed).unwrap();
        for mark in pages::marks(&text) {
            let (part, _) = mark.split_once('/').unwrap();
            // The command's own, which its tests look for.
            assert!(part == "bench" || Part::named(part).is_ok(), "{mark}");
            seen += 1;
        }
    }
    assert!(seen >= 6, "{seen}");
}

#[test]
fn the_precomputation_is_near_what_it_is_compared_with() {
    for (key, value) in raw(made().folder.path(), "validation") {
        let limit = match key.split('.').nth(1) {
            Some("ellipsoid") => 0.5,
            Some("box")
                if [".translation.", ".rotation."]
                    .iter()
                    .any(|motion| key.contains(motion))
                    && !key.ends_with("wanted") =>
            {
                0.5
            }
            Some("decay") if key.ends_with("difference") => 1e-12,
            Some("shear") if key.ends_with("difference") => 1e-9,
            _ => continue,
        };
        assert!(value.abs() < limit, "{key}: {value}");
    }
}
