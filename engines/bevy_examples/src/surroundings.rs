//! Light, camera and plain materials.

use bevy::camera_controller::free_camera::FreeCamera;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::prelude::*;

/// Sun, sky and the light that comes from it.
pub fn sun(commands: &mut Commands, sky: Color) {
    commands.insert_resource(ClearColor(sky));
    commands.insert_resource(GlobalAmbientLight {
        color: sky,
        brightness: 2_000.0,
        ..default()
    });
    commands.spawn((
        DirectionalLight {
            illuminance: 9_000.0,
            shadow_maps_enabled: true,
            color: Color::srgb(1.0, 0.93, 0.82),
            ..default()
        },
        Transform::from_xyz(6.0, 9.0, 5.0).looking_at(Vec3::ZERO, Vec3::Y),
    ));
}

/// A camera that flies: W, A, S, D, E and Q, the mouse while its button is held.
pub fn fly(from: Vec3, at: Vec3) -> impl Bundle {
    let speed = 0.5 * from.distance(at);
    let controls = FreeCamera {
        walk_speed: speed,
        run_speed: 3.0 * speed,
        ..default()
    };
    (stand(from, at), controls)
}

/// A camera that stays.
pub fn stand(from: Vec3, at: Vec3) -> impl Bundle {
    let place = Transform::from_translation(from).looking_at(at, Vec3::Y);
    // One that needs no tables.
    (Camera3d::default(), Tonemapping::AcesFitted, place)
}

/// A material that does not shine, seen from both sides.
pub fn matte(colour: Color) -> StandardMaterial {
    StandardMaterial {
        base_color: colour,
        perceptual_roughness: 0.95,
        reflectance: 0.2,
        double_sided: true,
        cull_mode: None,
        ..default()
    }
}
