//! What stands still and holds bodies back.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::*;
use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::norm;
use langevin_rigid::{Body, Fluid, Surface};
use langevin_rigid_world::{Material, Obstacle, ObstacleError, Shape, World};

type Triangles = (Vec<Vec3>, Vec<[u32; 3]>);

/// A surface of revolution about y: this outline of (radius, height), closed, counter-clockwise seen from +z with the
/// radius to the right.
fn turned_surface(outline: &[[f64; 2]], around: u32) -> Triangles {
    let rings = outline.len() as u32;
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..around {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(around)).sin_cos();
        vertices.extend(outline.iter().map(|[r, y]| [r * cos, *y, r * sin]));
        for k in 0..rings {
            let at = |i: u32, k: u32| (i % around) * rings + k % rings;
            let [a, b, c, d] = [at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (vertices, triangles)
}

/// A cup with thick walls, open above.
fn cup() -> Triangles {
    let outline = [
        [1e-4, -0.01],
        [0.06, -0.01],
        [0.06, 0.1],
        [0.05, 0.1],
        [0.05, 0.0],
        [1e-4, 0.0],
    ];
    turned_surface(&outline, 24)
}

#[test]
fn bodies_fall_into_a_cup_and_stay() {
    let (vertices, triangles) = cup();
    let mut world = World::new(DOWN);
    world.add_obstacle(Obstacle::mesh(&vertices, &triangles, Material::default()).unwrap());
    let body = Body::plate(0.03, 0.02, 0.004, 600.0).unwrap();
    let kind = kind(&body, &Fluid::AIR, DOWN, Material::default());
    let mut numbers = Numbers(5);
    for number in 0..12 {
        let [x, _, z] = numbers.vector(0.02);
        let state = turned([x, 0.05 + 0.04 * f64::from(number), z], numbers.vector(1.0));
        world.add(kind.clone(), state, noise(number));
    }
    run(&mut world, 5.0, 2e-3);
    for body in 0..12 {
        let [x, y, z] = world.state(body).position;
        assert!(
            x.hypot(z) < 0.05 && y > 0.0 && y < 0.12,
            "{body}: {x} {y} {z}"
        );
        let overlap = world.overlap(body);
        assert!(
            overlap.as_ref().is_none_or(|overlap| overlap.depth < 4e-4),
            "{overlap:?}"
        );
    }
}

#[test]
fn a_brick_lies_on_a_step_and_leans_on_nothing() {
    let mut world = World::new(DOWN);
    let step = Shape::cuboid([0.2, 0.05, 0.2]).unwrap();
    let step = Obstacle::shape(step, [0.0, 0.05, 0.0], UPRIGHT, Material::default()).unwrap();
    world.add_obstacle(step);
    let body = Body::cuboid([0.1, 0.03, 0.06], 600.0).unwrap();
    let kind = kind(&body, &Fluid::AIR, DOWN, Material::default());
    world.add(kind, turned([0.0, 0.2, 0.0], [0.3, 0.0, 0.2]), noise(0));
    run(&mut world, 4.0, 2e-3);
    assert!(world.is_asleep(0));
    assert!((world.state(0).position[1] - 0.115).abs() < 1e-4);
}

/// A flat floor of triangles.
fn floor(cells: u32, size: f64) -> Triangles {
    let place = |i: u32| size * (f64::from(i) / f64::from(cells) - 0.5);
    let row = cells + 1;
    let vertices = (0..row * row)
        .map(|n| [place(n % row), 0.0, place(n / row)])
        .collect();
    let mut triangles = Vec::new();
    for i in 0..cells {
        for j in 0..cells {
            let corner = j * row + i;
            triangles.push([corner, corner + row, corner + 1]);
            triangles.push([corner + 1, corner + row, corner + row + 1]);
        }
    }
    (vertices, triangles)
}

#[test]
fn a_brick_slides_over_the_edges_of_a_flat_floor() {
    let (vertices, triangles) = floor(40, 4.0);
    let friction = 0.3;
    let rough = material(friction, 0.0);
    let mut world = World::new(DOWN);
    world.add_obstacle(Obstacle::terrain(&vertices, &triangles, rough).unwrap());
    let body = Body::cuboid([0.1, 0.03, 0.07], 500.0).unwrap();
    let kind = kind(&body, &THIN, DOWN, rough);
    let begin = -1.5;
    let mut state = turned([begin, 0.01502, 0.013], [0.0, 0.4, 0.0]);
    state.set_world_velocities([3.0, 0.0, 0.2], [0.0; 3]);
    let speed = norm(state.velocity);
    world.add(kind, state, noise(0));
    let mut highest: f64 = 0.0;
    for _ in 0..1500 {
        world.step(1e-3).unwrap();
        highest = highest.max(world.state(0).position[1]);
    }
    assert!(highest < 0.0152, "tripped: {highest} m");
    let [x, _, z] = world.state(0).position;
    let way = (x - begin).hypot(z - 0.013);
    let expected = speed * speed / (2.0 * friction * G);
    assert!(
        (way / expected - 1.0).abs() < 0.02,
        "{way} m, expected {expected}"
    );
}

#[test]
fn an_open_mesh_is_refused_and_an_edge_of_its_hole_named() {
    let (vertices, mut triangles) = cup();
    let [a, b, c] = triangles.remove(17);
    match Obstacle::mesh(&vertices, &triangles, Material::default()) {
        Err(ObstacleError::Open(from, to)) => {
            let edge = (from, to);
            let hole = [(b, a), (c, b), (a, c)];
            assert!(hole.contains(&edge), "{edge:?} of {hole:?}");
        }
        other => panic!("{other:?}"),
    }
    Obstacle::terrain(&vertices, &triangles, Material::default()).unwrap();
}

#[test]
fn a_ring_falls_over_a_peg() {
    let outline = [[0.03, -0.005], [0.05, -0.005], [0.05, 0.005], [0.03, 0.005]];
    let (vertices, triangles) = turned_surface(&outline, 32);
    let ring = Body {
        surface: Surface {
            vertices,
            triangles,
            ..Surface::default()
        },
        ..Body::disc(0.05, 0.01, 600.0).unwrap()
    };
    let shape = Shape::decomposed(&ring).unwrap();
    let kind = shaped(&ring, shape, &Fluid::AIR, DOWN, Material::default());
    let mut world = World::new(DOWN);
    world.add_obstacle(ground(Material::default()));
    let peg = Shape::cuboid([0.012, 0.06, 0.012]).unwrap();
    let peg = Obstacle::shape(peg, [0.0, 0.06, 0.0], UPRIGHT, Material::default()).unwrap();
    world.add_obstacle(peg);
    world.add(kind, turned([0.004, 0.2, 0.0], [0.1, 0.0, 0.0]), noise(0));
    run(&mut world, 5.0, 2e-3);
    let [x, y, z] = world.state(0).position;
    assert!(world.is_asleep(0), "{x} {y} {z}");
    assert!(y < 0.006 && x.hypot(z) < 0.02, "{x} {y} {z}");
}

#[test]
fn an_overlap_names_what_a_body_is_in() {
    let body = Body::cuboid([0.1, 0.1, 0.1], 500.0).unwrap();
    let kind = kind(&body, &Fluid::AIR, DOWN, Material::default());
    let mut world = World::new(DOWN);
    world.add_obstacle(ground(Material::default()));
    world.add(kind.clone(), at([0.0, 0.04, 0.0]), noise(0));
    world.add(kind.clone(), at([0.0, 0.3, 0.0]), noise(1));
    world.add(kind, at([0.08, 0.3, 0.0]), noise(2));
    let first = world.overlap(0).unwrap();
    assert_eq!((first.body, first.other.as_str()), (0, "obstacle 0"));
    assert!((first.depth - 0.01).abs() < 1e-9, "{}", first.depth);
    let second = world.overlap(1).unwrap();
    assert_eq!(second.other, "body 2");
    assert!((second.depth - 0.02).abs() < 1e-6, "{}", second.depth);
    assert_eq!(
        second.to_string(),
        "body 1 is 20.000 mm inside body 2; place them apart"
    );
}
