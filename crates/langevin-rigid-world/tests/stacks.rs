//! Stacks that stand.

mod common;

use common::*;
use langevin_rigid::linalg::vector::norm;
use langevin_rigid::{Body, Fluid};
use langevin_rigid_world::{Material, World};

/// Ten boards, of these densities in turn.
fn stack(densities: &[f64]) -> World {
    let mut world = World::new(DOWN);
    world.add_obstacle(ground(Material::default()));
    for number in 0..10 {
        let density = densities[number % densities.len()];
        let board = Body::plate(0.2, 0.14, 0.03, density).unwrap();
        let kind = kind(&board, &Fluid::AIR, DOWN, Material::default());
        let aside = 0.002 * (number % 3) as f64;
        let state = at([aside, 0.0151 + 0.0301 * number as f64, 0.0]);
        world.add(kind, state, noise(number as u32));
    }
    world
}

#[test]
fn a_stack_of_ten_stands() {
    for densities in [&[700.0][..], &[1500.0, 150.0]] {
        for dt in [1e-3, 2e-3, 5e-3, 1.0 / 60.0] {
            let mut world = stack(densities);
            let before: Vec<_> = (0..10).map(|body| world.state(body).position).collect();
            for k in 0..10 {
                run(&mut world, 1.0, dt);
                if densities.len() == 1 {
                    println!(
                        "{dt} {k} {:.6} {:.6} {}",
                        world.state(6).position[0] - before[6][0],
                        world.state(6).position[2],
                        (0..10).filter(|b| world.is_asleep(*b)).count()
                    );
                }
            }
            for (body, before) in before.iter().enumerate() {
                let after = world.state(body).position;
                let aside = norm([after[0] - before[0], 0.0, after[2] - before[2]]);
                let sunk = before[1] - after[1];
                assert!(
                    aside < 1e-3,
                    "{densities:?}, {dt} s: {body} went {aside} m aside"
                );
                assert!(
                    sunk.abs() < 2e-3,
                    "{densities:?}, {dt} s: {body} sank by {sunk} m"
                );
            }
            let awake = (0..10).filter(|body| !world.is_asleep(*body)).count();
            assert_eq!(awake, 0, "{densities:?}, {dt} s");
        }
    }
}
