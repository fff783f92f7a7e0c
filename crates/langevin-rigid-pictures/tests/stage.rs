//! What stands around bodies, and many bodies, looked at as pixels.
//!
//! A picture of a world must show what its bodies fall into and onto, and all bodies that are there and no others. A failure
//! means water, wall or solid that is missing or hides what it should not, a body that is missing, or one drawn too early.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid_pictures::{
    Actor, Film, Picture, PictureError, PictureOptions, Plane, Pose, Scenery, Stage, Subject, View,
    crowd_picture, trajectory_picture,
};

/// A box of side 0.2 m.
const VERTICES: [[f64; 3]; 8] = [
    [-0.1, -0.1, -0.1],
    [0.1, -0.1, -0.1],
    [-0.1, 0.1, -0.1],
    [0.1, 0.1, -0.1],
    [-0.1, -0.1, 0.1],
    [0.1, -0.1, 0.1],
    [-0.1, 0.1, 0.1],
    [0.1, 0.1, 0.1],
];
const TRIANGLES: [[u32; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];
const CUBE: Subject<'static> = Subject {
    vertices: &VERTICES,
    triangles: &TRIANGLES,
};

const VIEWS: [View; 5] = [
    View::Front,
    View::Side,
    View::Top,
    View::Iso,
    View::FrontAndSide,
];

/// From 1 m down to -1 m in two seconds, `start` seconds late, at `x`.
fn descent(start: f64, x: f64) -> Vec<Pose> {
    (0..=100)
        .map(|k| 0.02 * f64::from(k))
        .map(|t| Pose {
            time: start + t,
            position: [x, 1.0 - t, 0.0],
            orientation: [0.0, 0.0, 0.0, 1.0],
        })
        .collect()
}

fn on(stage: Stage, view: View) -> PictureOptions {
    PictureOptions {
        view,
        stage,
        ..PictureOptions::default()
    }
}

fn one(stage: Stage, view: View) -> Picture {
    trajectory_picture(&CUBE, &descent(0.0, 0.0), &on(stage, view)).unwrap()
}

fn pixels(picture: &Picture) -> impl Iterator<Item = ([usize; 2], [u8; 3])> {
    let width = picture.width() as usize;
    let pixels = picture.rgba().chunks_exact(4).enumerate();
    pixels.map(move |(n, p)| ([n % width, n / width], [p[0], p[1], p[2]]))
}

fn count(picture: &Picture, is: impl Fn([u8; 3]) -> bool) -> usize {
    pixels(picture).filter(|(_, colour)| is(*colour)).count()
}

fn is_water([r, g, b]: [u8; 3]) -> bool {
    r < 225 && b > g && g > r && b - r > 20 && r > 150
}

fn is_water_line(colour: [u8; 3]) -> bool {
    colour == [46, 118, 184]
}

fn is_stone([r, g, b]: [u8; 3]) -> bool {
    r > g && g > b && (8..30).contains(&(r - b)) && (100..215).contains(&r)
}

/// Above the key, whose signs have the colours of the faces.
fn faces(picture: &Picture, columns: std::ops::Range<usize>) -> usize {
    let key = picture.height() as usize - 100;
    pixels(picture)
        .filter(|([x, y], [r, g, b])| {
            let (orange, teal) = (*r > b.saturating_add(60), *b > r.saturating_add(60));
            *y > 110 && *y < key && columns.contains(x) && (orange || (teal && *g < 200))
        })
        .count()
}

#[test]
fn water_is_below_its_level_in_every_view() {
    let pond = Stage {
        water: Some(0.0),
        ..Stage::default()
    };
    for view in VIEWS {
        // Edges of the body have a pixel of that colour here and there.
        let dry = count(&one(Stage::default(), view), is_water);
        let wet = count(&one(pond.clone(), view), is_water);
        assert!(dry < 1000 && wet > 3000, "{view:?}: {dry} {wet}");
    }
    let front = one(pond, View::Front);
    let line: Vec<usize> = pixels(&front)
        .filter(|(_, colour)| is_water_line(*colour))
        .map(|([_, y], _)| y)
        .collect();
    let (first, last) = (line[0], line[line.len() - 1]);
    assert!(last - first <= 2 && line.len() > 100, "{first} {last}");
    let above = pixels(&front).filter(|([_, y], colour)| *y + 2 < first && is_water(*colour));
    let dry = count(&one(Stage::default(), View::Front), is_water);
    assert!(above.count() <= dry);
}

#[test]
fn water_far_below_is_not_drawn_and_water_far_above_is_all_around() {
    let at = |level| Stage {
        water: Some(level),
        ..Stage::default()
    };
    assert_eq!(
        one(at(-100.0), View::Front),
        one(Stage::default(), View::Front)
    );
    let deep = one(at(100.0), View::Front);
    assert_eq!(count(&deep, is_water_line), 0);
    assert!(count(&deep, is_water) > 50_000);
    assert_eq!(
        one(Stage::default(), View::Front).height(),
        deep.height(),
        "the surface is too far away to make room for"
    );
}

#[test]
fn water_in_a_tank_is_between_its_walls() {
    let tank = |walls| Stage {
        water: Some(0.0),
        walls,
        ..Stage::default()
    };
    let walls = Some([[-0.5, -1.2, -0.4], [0.5, 1.0, 0.4]]);
    let wall = [120, 130, 146];
    for view in VIEWS {
        let drawn = one(tank(walls), view);
        assert!(count(&drawn, |colour| colour == wall) > 200, "{view:?}");
    }
    let front = one(tank(walls), View::Front);
    let columns = |is: &dyn Fn([u8; 3]) -> bool| {
        let found = pixels(&front).filter(|(_, colour)| is(*colour));
        let columns: Vec<usize> = found.map(|([x, _], _)| x).collect();
        [columns.iter().min().copied(), columns.iter().max().copied()].map(Option::unwrap)
    };
    let [left, right] = columns(&|colour| colour == wall);
    let [from, to] = columns(&is_water);
    assert!(
        left <= from + 2 && to <= right + 2,
        "{left} {from} {to} {right}"
    );
    // A wall a kilometre away is not in the picture.
    let far = Some([[-500.0; 3], [500.0; 3]]);
    assert_eq!(one(tank(far), View::Front), one(tank(None), View::Front));
}

#[test]
fn solids_are_drawn_and_bodies_behind_them_shine_through() {
    let block = |x: f64, z: f64| Stage {
        solids: vec![Scenery {
            vertices: VERTICES
                .map(|[a, b, c]| [x + 3.0 * a, 3.0 * b, z + 3.0 * c])
                .to_vec(),
            triangles: TRIANGLES.to_vec(),
        }],
        ..Stage::default()
    };
    for view in VIEWS {
        let bare = count(&one(Stage::default(), view), is_stone);
        let stone = count(&one(block(1.0, 0.0), view), is_stone);
        assert!(stone > bare + 2000, "{view:?}: {stone}, {bare}");
    }
    let faces = |z: f64| {
        let picture = one(block(0.0, z), View::Front);
        faces(&picture, 0..picture.width() as usize)
    };
    let (before, behind) = (faces(-1.0), faces(1.0));
    assert!(behind < before * 9 / 10, "{behind} of {before}");
    assert_ne!(
        one(block(0.0, 1.0), View::Front),
        one(block(0.0, 1.5), View::Iso)
    );

    let broken = Stage {
        solids: vec![Scenery {
            vertices: vec![[0.0; 3]],
            triangles: vec![[0, 1, 2]],
        }],
        ..Stage::default()
    };
    let error = trajectory_picture(&CUBE, &descent(0.0, 0.0), &on(broken, View::Front));
    assert!(
        matches!(error, Err(PictureError::BadScenery { index: 0, .. })),
        "{error:?}"
    );
}

#[test]
fn a_slope_is_drawn_where_it_is_in_the_picture() {
    let slope = |height: f64| Stage {
        planes: vec![Plane {
            point: [0.0, height, 0.0],
            normal: [-0.6, 0.8, 0.0],
        }],
        ..Stage::default()
    };
    for view in VIEWS {
        let bare = count(&one(Stage::default(), view), is_stone);
        let drawn = one(slope(-0.9), view);
        assert!(count(&drawn, is_stone) > bare + 300, "{view:?}");
        assert_eq!(one(slope(-50.0), view), one(Stage::default(), view));
    }
}

#[test]
fn a_crowd_shows_all_its_bodies_each_of_its_size() {
    let ways = [-1.0, 0.0, 1.0].map(|x| descent(0.0, x));
    let actor = |number: usize, scale: f64| Actor {
        subject: 0,
        scale,
        poses: &ways[number],
    };
    let options = PictureOptions {
        max_instants: 0,
        ..on(Stage::default(), View::Top)
    };
    let draw = |actors: &[Actor<'_>]| crowd_picture(&[CUBE], actors, &options, None).unwrap();
    let picture = draw(&[actor(0, 0.5), actor(1, 1.0), actor(2, 1.0)]);
    assert_eq!(picture.times(), [2.0]);
    assert_eq!(picture.magnification(), 1.0);
    let width = picture.width() as usize;
    let [left, middle, right] =
        [0, 1, 2].map(|k| faces(&picture, k * width / 3..(k + 1) * width / 3));
    assert!(
        left > 100 && middle > 100 && right > 100,
        "{left} {middle} {right}"
    );
    assert!(
        3 * left < right,
        "half as long is a quarter of the area: {left} {right}"
    );

    // With instants some are drawn on their way too.
    let bodies = |max_instants: usize| {
        let options = PictureOptions {
            max_instants,
            ..on(Stage::default(), View::Front)
        };
        let actors = [actor(0, 0.5), actor(1, 1.0), actor(2, 1.0)];
        let picture = crowd_picture(&[CUBE], &actors, &options, None).unwrap();
        faces(&picture, 0..picture.width() as usize)
    };
    assert!(bodies(32) > 2 * bodies(0));

    for bad in [
        Actor {
            subject: 1,
            ..actor(0, 1.0)
        },
        actor(0, 0.0),
        actor(0, f64::NAN),
    ] {
        let error = crowd_picture(&[CUBE], &[actor(0, 1.0), bad], &options, None);
        assert_eq!(error, Err(PictureError::BadActor { index: 1 }));
    }
    assert!(crowd_picture(&[CUBE], &[], &options, None).is_err());
}

#[test]
fn a_body_of_a_film_appears_when_it_is_let_go() {
    let (early, late) = (descent(0.0, -0.8), descent(1.0, 0.8));
    let actors = [&early, &late].map(|poses| Actor {
        subject: 0,
        scale: 1.0,
        poses,
    });
    let options = on(Stage::default(), View::Front);
    let film = Film::of_crowd(&[CUBE], &actors, &options, 10.0).unwrap();
    assert_eq!(film.frames(), 31);
    let sides = |frame: usize| {
        let frame = film.frame(frame).unwrap();
        let width = frame.width() as usize;
        [faces(&frame, 0..width / 2), faces(&frame, width / 2..width)]
    };
    for frame in [0, 9] {
        let [left, right] = sides(frame);
        assert!(left > 100 && right == 0, "frame {frame}: {left} {right}");
    }
    // Who has come to the end stays.
    for frame in [10, 20, 30] {
        let [left, right] = sides(frame);
        assert!(left > 100 && right > 100, "frame {frame}: {left} {right}");
    }
}
