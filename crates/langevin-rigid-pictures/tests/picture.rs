//! The picture of a trajectory, looked at as pixels.
//!
//! A strobe picture is evidence: it must show where the body was, which of its faces was toward
//! the viewer, and what hid what. Each test draws a motion whose picture is known beforehand. A
//! failure means a body that is missing, cut off, seen from the wrong side or painted in the wrong
//! order, words that are not there, or a picture that is not the same every time.

use langevin_rigid_formats::track::TrackError;
use langevin_rigid_pictures::{
    Film, Picture, PictureError, PictureOptions, Pose, Stage, Subject, View, trajectory_picture,
};

const LEVEL: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
const UPSIDE_DOWN: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
const ALL_VIEWS: [View; 5] = [
    View::Front,
    View::Side,
    View::Top,
    View::Iso,
    View::FrontAndSide,
];

/// A square of side 0.2 m without thickness, its normal along +y.
const SHEET: Subject<'static> = Subject {
    vertices: &[
        [-0.1, 0.0, -0.1],
        [0.1, 0.0, -0.1],
        [0.1, 0.0, 0.1],
        [-0.1, 0.0, 0.1],
    ],
    triangles: &[[0, 2, 1], [0, 3, 2]],
};

fn at(time: f64, position: [f64; 3], orientation: [f64; 4]) -> Pose {
    Pose {
        time,
        position,
        orientation,
    }
}

/// Steady descent without turning, 1 m/s for two seconds.
fn descent() -> Vec<Pose> {
    (0..=100)
        .map(|k| 0.02 * f64::from(k))
        .map(|t| at(t, [0.0, -t, 0.0], LEVEL))
        .collect()
}

fn seen(view: View) -> PictureOptions {
    PictureOptions {
        view,
        ..PictureOptions::default()
    }
}

fn draw(subject: &Subject<'_>, poses: &[Pose], options: &PictureOptions) -> Picture {
    trajectory_picture(subject, poses, options).expect("this can be drawn")
}

fn pixel(picture: &Picture, x: usize, y: usize) -> [u8; 3] {
    let start = 4 * (y * picture.width() as usize + x);
    let rgba = picture.rgba();
    [rgba[start], rgba[start + 1], rgba[start + 2]]
}

/// The pixels in which two pictures of one size differ.
fn differences(a: &Picture, b: &Picture) -> Vec<[usize; 2]> {
    assert_eq!((a.width(), a.height()), (b.width(), b.height()));
    let width = a.width() as usize;
    (0..width * a.height() as usize)
        .map(|i| [i % width, i / width])
        .filter(|[x, y]| pixel(a, *x, *y) != pixel(b, *x, *y))
        .collect()
}

/// The pixels that the bodies take: those that change when the path is drawn alone.
fn body_pixels(subject: &Subject<'_>, poses: &[Pose], options: &PictureOptions) -> Vec<[usize; 2]> {
    let alone = PictureOptions {
        max_instants: 0,
        ..options.clone()
    };
    // The caption tells of the bodies too: leave out its rows.
    let caption_rows = 80;
    let mut pixels = differences(
        &draw(subject, poses, options),
        &draw(subject, poses, &alone),
    );
    pixels.retain(|[_, y]| *y > caption_rows);
    pixels
}

fn is_orange([r, g, b]: [u8; 3]) -> bool {
    r > g && g > b && r > b.saturating_add(60)
}

fn is_teal([r, g, b]: [u8; 3]) -> bool {
    b > r.saturating_add(30) && g > r.saturating_add(30)
}

#[test]
fn a_sheet_is_seen_from_every_side_even_along_its_plane() {
    // Front and side look exactly along the plane: the sheet is a line there, 56 pixels or longer,
    // with the colours of both faces.
    for view in ALL_VIEWS {
        let options = seen(view);
        let picture = draw(&SHEET, &descent(), &options);
        let pixels = body_pixels(&SHEET, &descent(), &options);
        let columns = pixels.iter().map(|p| p[0]);
        let (low, high) = (columns.clone().min().unwrap(), columns.max().unwrap());
        assert!(high - low >= 56, "{view:?}: {low} to {high}");
        let colours = || pixels.iter().map(|[x, y]| pixel(&picture, *x, *y));
        assert!(colours().any(is_orange), "{view:?}");
        if matches!(view, View::Front | View::Side) {
            assert!(colours().any(is_teal), "{view:?}");
        }
    }
}

#[test]
fn a_turned_body_shows_its_other_face() {
    let centre = |orientation| {
        let picture = draw(&SHEET, &[at(0.0, [0.0; 3], orientation)], &seen(View::Top));
        // Aside from the middle, where the mark of the position is.
        let (x, y) = (picture.width() / 2, picture.height() / 2);
        pixel(&picture, x as usize + 60, y as usize)
    };
    assert!(is_orange(centre(LEVEL)), "{:?}", centre(LEVEL));
    assert!(is_teal(centre(UPSIDE_DOWN)), "{:?}", centre(UPSIDE_DOWN));
}

#[test]
fn the_nearer_surface_hides_the_farther_whatever_the_order_of_triangles() {
    // Over a large level square a smaller one, tilted and so differently lit, 0.05 m higher or
    // lower.
    let two = |height: f64, swap: bool| {
        let mut vertices = SHEET.vertices.to_vec();
        vertices.extend(
            SHEET
                .vertices
                .iter()
                .map(|[x, _, z]| [0.5 * x, height + 0.2 * x, 0.5 * z]),
        );
        let near = SHEET.triangles.iter().map(|t| t.map(|v| v + 4));
        let mut triangles = SHEET.triangles.to_vec();
        triangles.extend(near);
        if swap {
            triangles.reverse();
        }
        let subject = Subject {
            vertices: &vertices,
            triangles: &triangles,
        };
        draw(&subject, &[at(0.0, [0.0; 3], LEVEL)], &seen(View::Top))
    };
    let beside_middle = |picture: &Picture| {
        let (x, y) = (picture.width() / 2, picture.height() / 2);
        pixel(picture, x as usize, y as usize + 60)
    };
    let (above, below) = (two(0.05, false), two(-0.05, false));
    assert_eq!(above.rgba(), two(0.05, true).rgba());
    assert_ne!(beside_middle(&above), beside_middle(&below));
    let one = draw(&SHEET, &[at(0.0, [0.0; 3], LEVEL)], &seen(View::Top));
    assert_eq!(beside_middle(&below), beside_middle(&one));
}

#[test]
fn bodies_are_drawn_at_equal_times_and_apart() {
    let picture = draw(&SHEET, &descent(), &seen(View::Iso));
    let times = picture.times();
    assert!(times.len() >= 4, "{times:?}");
    assert_eq!(times[0], 0.0);
    let interval = times[1] - times[0];
    for pair in times.windows(2) {
        assert!((pair[1] - pair[0] - interval).abs() < 1e-12, "{times:?}");
    }
    assert!(times[times.len() - 1] <= 2.0 + 1e-9);
    // A body that spins on the spot has nowhere to be drawn apart: start and end must do.
    let spin: Vec<Pose> = (0..=50)
        .map(|k| f64::from(k) / 10.0)
        .map(|t| at(t, [0.0; 3], [0.0, libm::sin(t), 0.0, libm::cos(t)]))
        .collect();
    assert_eq!(draw(&SHEET, &spin, &seen(View::Top)).times(), [0.0, 5.0]);
}

#[test]
fn a_speck_is_magnified_and_a_large_body_is_not() {
    let far = |reach: f64| [at(0.0, [0.0; 3], LEVEL), at(1.0, [0.0, -reach, 0.0], LEVEL)];
    assert_eq!(
        draw(&SHEET, &far(0.5), &seen(View::Front)).magnification(),
        1.0
    );
    let speck = draw(&SHEET, &far(1e4), &seen(View::Front));
    assert!(speck.magnification() > 100.0);
    let pixels = body_pixels(&SHEET, &far(1e4), &seen(View::Front));
    assert!(pixels.len() > 100, "{}", pixels.len());
}

#[test]
fn the_ground_is_drawn_where_the_motion_comes_near_it() {
    let with = |ground| PictureOptions {
        stage: Stage {
            ground,
            ..Stage::default()
        },
        ..seen(View::Front)
    };
    let without = draw(&SHEET, &descent(), &with(None));
    // 100 m down is nothing that this picture could show.
    assert_eq!(draw(&SHEET, &descent(), &with(Some(-100.0))), without);
    let earth = draw(&SHEET, &descent(), &with(Some(-2.1)));
    let brown = (0..earth.height() as usize)
        .map(|y| pixel(&earth, earth.width() as usize / 2, y))
        .filter(|[r, _, b]| *r > b.saturating_add(15))
        .count();
    assert!(brown > 20, "{brown}");
}

#[test]
fn the_title_is_written_and_fits() {
    let titled = |title: &str| PictureOptions {
        title: Some(title.to_owned()),
        ..PictureOptions::default()
    };
    // Dark pixels in the title's rows, and the rightmost of them.
    let ink = |title: &str| {
        let picture = draw(&SHEET, &descent(), &titled(title));
        let width = picture.width() as usize;
        let dark: Vec<usize> = (0..70 * width)
            .filter(|i| {
                pixel(&picture, i % width, i / width)
                    .iter()
                    .all(|c| *c < 100)
            })
            .map(|i| i % width)
            .collect();
        (dark.len(), dark.into_iter().max().unwrap_or(0), width)
    };
    assert_eq!(ink("").0, 0);
    let (short, ..) = ink("Sheet");
    let (long, ..) = ink("Sheet in water");
    assert!(short > 300 && long > 2 * short, "{short} {long}");
    let (_, right, width) = ink(&"endless ".repeat(2000));
    assert!(
        right > width / 2 && right < width - 20,
        "{right} of {width}"
    );
    // Letters that the font lacks do not stop the picture.
    assert!(ink("\u{96ea}\u{7247}").0 > 50);
}

#[test]
fn pictures_of_one_motion_are_equal_on_any_thread() {
    let picture = || draw(&SHEET, &descent(), &PictureOptions::default());
    let elsewhere = std::thread::spawn(move || picture().png().unwrap());
    let here = draw(&SHEET, &descent(), &PictureOptions::default());
    assert_eq!(here.png().unwrap(), elsewhere.join().unwrap());
}

#[test]
fn the_png_holds_the_pixels() {
    let picture = draw(&SHEET, &descent(), &PictureOptions::default());
    let bytes = picture.png().unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
        .read_info()
        .unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgb).unwrap();
    assert_eq!(
        (info.width, info.height),
        (picture.width(), picture.height())
    );
    let drawn: Vec<u8> = picture
        .rgba()
        .chunks(4)
        .flat_map(|p| p[..3].to_vec())
        .collect();
    assert!(rgb == drawn);
    assert!(picture.rgba().chunks(4).all(|p| p[3] == 255));
}

#[test]
fn sizes_asked_for_are_kept() {
    for size in [[240, 240], [1920, 1080], [300, 2000]] {
        let options = PictureOptions {
            size: Some(size),
            ..PictureOptions::default()
        };
        let picture = draw(&SHEET, &descent(), &options);
        assert_eq!([picture.width(), picture.height()], size);
        assert!(
            picture
                .rgba()
                .chunks(4)
                .any(|p| is_orange([p[0], p[1], p[2]]))
        );
    }
}

#[test]
fn what_cannot_be_drawn_is_named() {
    let fails = |subject: &Subject<'_>, poses: &[Pose], size| {
        let options = PictureOptions {
            size,
            ..PictureOptions::default()
        };
        trajectory_picture(subject, poses, &options).unwrap_err()
    };
    let good = at(0.0, [0.0; 3], LEVEL);
    assert_eq!(
        fails(&SHEET, &[], None),
        PictureError::Track(TrackError::NoPoses)
    );
    for bad in [
        at(f64::NAN, [0.0; 3], LEVEL),
        at(1.0, [0.0, f64::INFINITY, 0.0], LEVEL),
        at(1.0, [0.0, -1e300, 0.0], LEVEL),
        at(1.0, [0.0; 3], [0.0; 4]),
        at(1.0, [0.0; 3], [0.0, f64::NAN, 0.0, 1.0]),
    ] {
        let error = fails(&SHEET, &[good, bad], None);
        assert!(
            matches!(
                error,
                PictureError::Track(TrackError::BadPose { index: 1, .. })
            ),
            "{error}"
        );
        assert!(error.to_string().starts_with("pose 1 "), "{error}");
    }
    let backward = [at(1.0, [0.0; 3], LEVEL), good];
    assert_eq!(
        fails(&SHEET, &backward, None),
        PictureError::Track(TrackError::TimeOrder { index: 1 })
    );
    for [width, height] in [[0, 800], [800, 0], [100_000, 800], [u32::MAX, u32::MAX]] {
        let error = fails(&SHEET, &[good], Some([width, height]));
        assert_eq!(error, PictureError::Size { width, height });
    }
    let empty = Subject {
        vertices: SHEET.vertices,
        triangles: &[],
    };
    assert_eq!(fails(&empty, &[good], None), PictureError::NoTriangles);
    let beyond = Subject {
        vertices: SHEET.vertices,
        triangles: &[[0, 1, 2], [0, 1, 4]],
    };
    let error = PictureError::BadTriangle {
        index: 1,
        vertices: 4,
    };
    assert_eq!(fails(&beyond, &[good], None), error);
    let broken = Subject {
        vertices: &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, f64::NAN, 0.0]],
        triangles: &[[0, 1, 2]],
    };
    assert_eq!(
        fails(&broken, &[good], None),
        PictureError::BadVertex { index: 2 }
    );
}

#[test]
fn degenerate_bodies_and_motions_are_drawn() {
    // A point, a line, a motion of no duration, times far from zero: nothing to divide by.
    let point = Subject {
        vertices: &[[0.0; 3]],
        triangles: &[[0, 0, 0]],
    };
    let line = Subject {
        vertices: &[[0.0; 3], [1.0, 0.0, 0.0]],
        triangles: &[[0, 1, 1]],
    };
    let still = [at(5.0, [1e9; 3], LEVEL), at(5.0, [1e9; 3], LEVEL)];
    let late = [at(1e9, [0.0; 3], LEVEL), at(1e9 + 1.0, [1.0; 3], LEVEL)];
    for subject in [&point, &line, &SHEET] {
        for poses in [&still, &late] {
            for view in ALL_VIEWS {
                let options = PictureOptions {
                    size: Some([400, 400]),
                    ..seen(view)
                };
                let picture = draw(subject, poses, &options);
                assert!(!picture.times().is_empty());
            }
        }
    }
}

#[test]
fn a_picture_shows_bodies_or_path_or_both() {
    let purple = |options: &PictureOptions| {
        let picture = draw(&SHEET, &descent(), options);
        // Above the key, which has the path's colours too.
        let rows = picture.height() as usize - 120;
        (0..rows * picture.width() as usize)
            .map(|i| {
                pixel(
                    &picture,
                    i % picture.width() as usize,
                    i / picture.width() as usize,
                )
            })
            .filter(|[r, g, b]| *b > g.saturating_add(50) && *r > g.saturating_add(10))
            .count()
    };
    let both = seen(View::Iso);
    let bodies = PictureOptions {
        path: false,
        ..both.clone()
    };
    assert!(purple(&both) > 200);
    assert_eq!(purple(&bodies), 0);
    let picture = draw(&SHEET, &descent(), &bodies);
    assert!(picture.times().len() > 3);
}

#[test]
fn a_film_has_one_camera_and_one_body_a_frame() {
    let poses = descent();
    let film = |fps| Film::new(&SHEET, &poses, &seen(View::Front), fps);
    let film_25 = film(25.0).unwrap();
    assert_eq!(film_25.frames(), 51);
    let (first, last) = (film_25.frame(0).unwrap(), film_25.frame(50).unwrap());
    assert_eq!((first.times(), last.times()), (&[0.0][..], &[2.0][..]));
    assert_eq!([first.width() % 2, first.height() % 2], [0, 0]);
    // The body is in the upper part of the first frame and in the lower of the last.
    let rows = |picture: &Picture| {
        let width = picture.width() as usize;
        let rows: Vec<usize> = (100 * width..(picture.height() as usize - 120) * width)
            .filter(|i| is_orange(pixel(picture, i % width, i / width)))
            .map(|i| i / width)
            .collect();
        (*rows.first().unwrap(), *rows.last().unwrap())
    };
    let third = first.height() as usize / 3;
    assert!(rows(&first).1 < third && rows(&last).0 > 2 * third - 60);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
        let error = film(bad).unwrap_err();
        assert!(matches!(error, PictureError::FrameRate { .. }), "{error}");
    }
}
