//! Arrows of the fluid behind a picture.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid_pictures::{
    PictureOptions, Pose, Stage, Subject, View, picture_in_flow, trajectory_picture,
};

#[test]
fn arrows_are_where_the_fluid_moves_and_nowhere_else() {
    let sheet = Subject {
        vertices: &[
            [-0.1, 0.0, -0.1],
            [0.1, 0.0, -0.1],
            [0.1, 0.0, 0.1],
            [-0.1, 0.0, 0.1],
        ],
        triangles: &[[0, 2, 1], [0, 3, 2]],
    };
    let pose = |time: f64| Pose {
        time,
        position: [time, 1.0 - time, 0.0],
        orientation: [0.0, 0.0, 0.0, 1.0],
    };
    let poses: Vec<Pose> = (0..=100).map(|k| pose(0.01 * f64::from(k))).collect();
    let options = PictureOptions {
        view: View::Front,
        stage: Stage {
            ground: Some(0.0),
            ..Stage::default()
        },
        ..PictureOptions::default()
    };
    let bare = trajectory_picture(&sheet, &poses, &options).unwrap();
    let of = |flow: &dyn Fn([f64; 3]) -> [f64; 3]| {
        picture_in_flow(&sheet, &poses, &options, flow).unwrap()
    };
    assert_eq!(of(&|_| [0.0; 3]), bare);
    assert_eq!(of(&|_| [f64::NAN; 3]), bare);
    // Below the ground there are none, and what goes towards the viewer has no length on the page.
    assert_eq!(
        of(&|[_, y, _]| [if y < 0.0 { 1.0 } else { 0.0 }, 0.0, 0.0]),
        bare
    );
    assert_eq!(
        pixels_that_differ(&of(&|_| [0.0, 0.0, 3.0]), &bare, 120..),
        0
    );

    // Where the left half moves, only the left half has arrows; the caption is above both.
    let left = of(&|[x, _, _]| [0.0, if x < 0.5 { 1.0 } else { 0.0 }, 0.0]);
    let width = bare.width() as usize;
    let differ = |columns: std::ops::Range<usize>| {
        let pixels = left.rgba().chunks_exact(4).zip(bare.rgba().chunks_exact(4));
        let plot = pixels.enumerate().filter(|(n, _)| n / width > 120);
        plot.filter(|(n, (a, b))| columns.contains(&(n % width)) && a != b)
            .count()
    };
    assert!(differ(0..width / 2) > 500);
    assert_eq!(differ(width * 6 / 10..width), 0);
}

fn pixels_that_differ(
    a: &langevin_rigid_pictures::Picture,
    b: &langevin_rigid_pictures::Picture,
    rows: std::ops::RangeFrom<usize>,
) -> usize {
    let width = a.width() as usize;
    let pixels = a.rgba().chunks_exact(4).zip(b.rgba().chunks_exact(4));
    let within = pixels
        .enumerate()
        .filter(|(n, _)| rows.contains(&(n / width)));
    within.filter(|(_, (a, b))| a != b).count()
}
