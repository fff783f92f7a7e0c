//! Releases of many bodies at once.

use std::f64::consts::PI;

use langevin_rigid::{Body, State};

use super::draw::scattered_release;
use crate::scene::Scene;

/// Radius of the disc that each body has to itself, in its largest extents: neighbours are then about two
/// extents apart.
const ROOM: f64 = 1.2;

/// The release of body `number` among many: that of the scene for body 0, and [`scattered_release`] for the
/// others, on level ground around it.
///
/// The places are a sunflower's seeds: evenly spaced however many there are.
pub fn side_by_side(scene: &Scene, body: &Body, number: u32) -> State {
    if number == 0 {
        return scene.release;
    }
    let golden_angle = PI * (3.0 - 5.0f64.sqrt());
    let away = ROOM * 2.0 * body.half_extents[0] * f64::from(number).sqrt();
    let angle = golden_angle * f64::from(number);
    let mut state = scattered_release(scene, number);
    state.position[0] += away * libm::cos(angle);
    state.position[2] += away * libm::sin(angle);
    state
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baking;

    #[test]
    fn a_thousand_bodies_are_apart_and_together() {
        let scene = crate::scene::find("leaf").unwrap();
        let body = baking::bake_scene(&scene, None, &()).unwrap().bake.body;
        let places: Vec<[f64; 3]> = (0..1000)
            .map(|number| side_by_side(&scene, &body, number).position)
            .collect();
        assert_eq!(places[0], scene.release.position);
        let extent = 2.0 * body.half_extents[0];
        for (number, place) in places.iter().enumerate() {
            assert_eq!(place[1], scene.release.position[1]);
            let nearest = places
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != number)
                .map(|(_, p)| libm::hypot(p[0] - place[0], p[2] - place[2]))
                .fold(f64::INFINITY, f64::min);
            assert!((1.1..2.6).contains(&(nearest / extent)), "{nearest}");
        }
    }
}
