//! Pictures of the scenes show what happens in them. They need Vulkan; where there is no graphics card, Mesa's lavapipe
//! (`mesa-vulkan-drivers`) draws.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::process::Command;

use image::{Rgb, RgbImage};

/// A picture of a scene after a while (s).
fn picture(program: &str, seconds: f32) -> RgbImage {
    let name = Path::new(program).file_stem().unwrap().to_str().unwrap();
    let file = std::env::temp_dir().join(format!("{name}-{}-{seconds}.png", std::process::id()));
    let run = Command::new(program)
        .args(["--picture".as_ref(), file.as_os_str()])
        .args(["--seconds", &seconds.to_string()])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{name}: {said}");
    let picture = image::open(&file).unwrap().to_rgb8();
    std::fs::remove_file(file).unwrap();
    assert_eq!(picture.dimensions(), (1280, 720));
    picture
}

/// Pixels of a part of the height, from the top, for which this holds.
fn count(picture: &RgbImage, part: [f32; 2], holds: impl Fn(&Rgb<u8>) -> bool) -> usize {
    let [from, to] = part.map(|part| (part * picture.height() as f32) as u32);
    let rows = picture
        .enumerate_pixels()
        .filter(|(_, y, _)| (from..to).contains(y));
    rows.filter(|(_, _, pixel)| holds(pixel)).count()
}

fn differing(a: &RgbImage, b: &RgbImage) -> usize {
    let far =
        |(a, b): &(&Rgb<u8>, &Rgb<u8>)| (0..3).map(|i| a.0[i].abs_diff(b.0[i])).max().unwrap() > 24;
    a.pixels().zip(b.pixels()).filter(far).count()
}

#[test]
fn leaves_cover_the_street() {
    let street = |seconds| picture(env!("CARGO_BIN_EXE_autumn_street"), seconds);
    // On the grey of the road, in the lower third.
    let leaves = |picture: &RgbImage| {
        count(picture, [0.67, 1.0], |Rgb([r, _, b])| {
            i16::from(*r) - i16::from(*b) > 40
        })
    };
    let (early, late) = (street(0.5), street(17.0));
    assert!(leaves(&early) < 20, "{}", leaves(&early));
    assert!(leaves(&late) > 200, "{}", leaves(&late));
}

#[test]
fn coins_lie_on_the_floor_of_the_tank() {
    let tank = |seconds| picture(env!("CARGO_BIN_EXE_coins_in_a_tank"), seconds);
    let changed = differing(&tank(0.1), &tank(8.0));
    assert!(changed > 4000, "{changed}");
}

#[test]
fn an_airplane_flies_with_its_trail_and_its_forces() {
    let field = |seconds| picture(env!("CARGO_BIN_EXE_paper_airplane"), seconds);
    let picture = field(0.8);
    // Weight is red, and nothing else in the picture is.
    let red = count(&picture, [0.0, 1.0], |Rgb([r, g, b])| {
        *r > 180 && *g < 90 && *b < 90
    });
    assert!(red > 20, "{red}");
    let flown = differing(&field(0.05), &picture);
    assert!(flown > 500, "{flown}");
}
