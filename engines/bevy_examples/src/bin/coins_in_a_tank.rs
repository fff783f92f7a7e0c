//! Coins fall into a tank of water, flutter and tumble down, and pile up on its floor.

use avian3d::prelude::{Collider, PhysicsLengthUnit, RigidBody};
use bevy::light::NotShadowCaster;
use bevy::prelude::*;
use bevy::time::common_conditions::on_timer;
use bevy_langevin_rigid::langevin_rigid::{Body, NoiseStream};
use bevy_langevin_rigid::{BakedBody, FluidRegion, Immersed};
use bevy_langevin_rigid_examples::{Scene, fly, matte, show, sun};

/// Inside of the tank (m), how high the water is, and how thick the glass.
const TANK: Vec3 = Vec3::new(0.36, 0.40, 0.24);
const WATER: f32 = 0.34;
const GLASS: f32 = 0.008;
/// Radius and thickness of a coin (m), and its density (kg/m^3).
const RADIUS: f32 = 0.011;
const THICKNESS: f32 = 0.002;
const DENSITY: f64 = 7500.0;
const COINS: u64 = 80;

fn main() -> AppExit {
    show(&Scene {
        title: "Coins in a tank",
        help: "Fly with W, A, S, D, E, Q and the mouse while its button is held. Space drops ten more coins; F shows the forces.",
        seconds: 16.0,
        plugin,
    })
}

/// What coins share, and how many there are.
#[derive(Resource)]
struct Coins {
    body: Handle<BakedBody>,
    mesh: Handle<Mesh>,
    materials: [Handle<StandardMaterial>; 2],
    dropped: u64,
}

fn plugin(app: &mut App) {
    let often = std::time::Duration::from_millis(220);
    // Lengths that matter to the contacts here are centimetres.
    app.insert_resource(PhysicsLengthUnit(0.1))
        .add_systems(Startup, (set_up_tank, set_up_coins))
        .add_systems(FixedUpdate, pour.run_if(on_timer(often)));
    app.add_systems(Update, pour_more);
}

fn set_up_tank(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    sun(&mut commands, Color::srgb(0.86, 0.88, 0.90));
    commands.spawn(fly(Vec3::new(0.14, 0.36, 0.62), Vec3::new(0.0, 0.17, 0.0)));
    let wood = materials.add(matte(Color::srgb(0.42, 0.29, 0.19)));
    commands.spawn((
        Mesh3d(meshes.add(Cuboid::new(3.0, 0.1, 3.0))),
        MeshMaterial3d(wood),
        Transform::from_xyz(0.0, -0.05, 0.0),
        RigidBody::Static,
        Collider::cuboid(3.0, 0.1, 3.0),
    ));
    let glass = materials.add(see_through(Color::srgba(0.85, 0.95, 0.95, 0.08)));
    let x = Vec3::new(GLASS, TANK.y, TANK.z + 2.0 * GLASS);
    let z = Vec3::new(TANK.x, TANK.y, GLASS);
    let side = |axis: Vec3| 0.5 * axis * (TANK + GLASS);
    for (size, away) in [
        (x, side(Vec3::X)),
        (x, side(Vec3::NEG_X)),
        (z, side(Vec3::Z)),
        (z, side(Vec3::NEG_Z)),
    ] {
        commands.spawn((
            Mesh3d(meshes.add(Cuboid::from_size(size))),
            MeshMaterial3d(glass.clone()),
            NotShadowCaster,
            Transform::from_translation(away + 0.5 * TANK.y * Vec3::Y),
            RigidBody::Static,
            Collider::cuboid(size.x, size.y, size.z),
        ));
    }
    let water = Vec3::new(TANK.x, WATER, TANK.z);
    commands.spawn((
        Mesh3d(meshes.add(Cuboid::from_size(0.998 * water))),
        MeshMaterial3d(materials.add(see_through(Color::srgba(0.25, 0.55, 0.70, 0.22)))),
        Transform::from_xyz(0.0, 0.5 * WATER, 0.0),
        NotShadowCaster,
        FluidRegion::lake(water),
    ));
}

fn see_through(colour: Color) -> StandardMaterial {
    StandardMaterial {
        base_color: colour,
        alpha_mode: AlphaMode::Blend,
        perceptual_roughness: 0.1,
        ..default()
    }
}

fn set_up_coins(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut bodies: ResMut<Assets<BakedBody>>,
) -> Result {
    let mut metal = |r, g, b| {
        materials.add(StandardMaterial {
            base_color: Color::srgb(r, g, b),
            metallic: 0.5,
            perceptual_roughness: 0.4,
            ..default()
        })
    };
    commands.insert_resource(Coins {
        body: bodies.add(Body::disc(RADIUS.into(), THICKNESS.into(), DENSITY)?),
        mesh: meshes.add(Cylinder::new(RADIUS, THICKNESS).mesh().resolution(48)),
        materials: [metal(0.80, 0.55, 0.25), metal(0.75, 0.74, 0.70)],
        dropped: 0,
    });
    Ok(())
}

fn pour(mut coins: ResMut<Coins>, mut commands: Commands) {
    if coins.dropped < COINS {
        drop_one(&mut coins, &mut commands);
    }
}

fn pour_more(keys: Res<ButtonInput<KeyCode>>, mut coins: ResMut<Coins>, mut commands: Commands) {
    if keys.just_pressed(KeyCode::Space) {
        for _ in 0..10 {
            drop_one(&mut coins, &mut commands);
        }
    }
}

/// Lets one go over the water, somewhere and turned somehow.
fn drop_one(coins: &mut Coins, commands: &mut Commands) {
    let [x, z, a, b, y, ..] = NoiseStream::default()
        .normals(coins.dropped)
        .map(|normal| normal.clamp(-2.0, 2.0) as f32);
    let place = Vec3::new(0.05 * x, TANK.y + 0.02 * (2.0 + y), 0.03 * z);
    let turn = Quat::from_rotation_x(0.5 * a) * Quat::from_rotation_z(0.5 * b);
    let material = coins.materials[coins.dropped as usize % 2].clone();
    commands.spawn((
        Immersed::baked(coins.body.clone()),
        Mesh3d(coins.mesh.clone()),
        MeshMaterial3d(material),
        Transform::from_translation(place).with_rotation(turn),
        RigidBody::Dynamic,
        Collider::cylinder(RADIUS, THICKNESS),
    ));
    coins.dropped += 1;
}
