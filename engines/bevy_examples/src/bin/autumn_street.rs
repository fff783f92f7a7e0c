//! Eight trees shed two thousand leaves into a gusty street; a car passes now and then and stirs them up.

use std::time::Duration;

use avian3d::prelude::{Collider, LinearVelocity, Position, RigidBody};
use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_langevin_rigid::langevin_rigid::Body;
use bevy_langevin_rigid::langevin_rigid::wind::{
    GustSettings, Gusts, Profile, Region, Shear, Wind, WindError, WindField,
};
use bevy_langevin_rigid::{AmbientWind, BakedBody, Crown, DropLeaves, Leaf, LocalWind, ShedFrom};
use bevy_langevin_rigid_examples::{Scene, fly, matte, show, sun};

/// Leaves of each tree, and how long it takes to shed them (s).
const LEAVES: u32 = 250;
const SHEDDING: u64 = 30;
/// Length and width of a leaf, half its thickness as it is drawn (m).
const LEAF: [f32; 2] = [0.08, 0.05];
/// Half the widths of road and street (m), and how high the pavement is.
const ROAD: f32 = 3.0;
const STREET: f32 = 7.0;
const KERB: f32 = 0.12;
/// Where the trees are along the street, on both sides of it (m).
const TREES: [f32; 4] = [-12.0, -4.0, 4.0, 12.0];
/// How high the middle of a crown is, and its radius (m).
const CROWN: [f32; 2] = [4.4, 1.7];
/// Speed of the car (m/s), where it comes from and goes to (m).
const SPEED: f32 = 9.0;
const WAY: f32 = 45.0;

const COLOURS: [[f32; 3]; 6] = [
    [0.72, 0.28, 0.06],
    [0.83, 0.45, 0.08],
    [0.86, 0.62, 0.14],
    [0.55, 0.16, 0.07],
    [0.62, 0.42, 0.16],
    [0.50, 0.47, 0.15],
];

fn main() -> AppExit {
    show(&Scene {
        title: "Autumn street",
        help: "Fly with W, A, S, D, E, Q and the mouse while its button is held. F shows the forces on the leaves.",
        seconds: 30.0,
        plugin,
    })
}

fn plugin(app: &mut App) {
    app.add_systems(
        Startup,
        (set_up_wind, set_up_street, set_up_trees, set_up_car),
    )
    .add_systems(FixedUpdate, drive)
    .add_observer(dress);
}

fn set_up_wind(mut wind: ResMut<AmbientWind>) -> Result {
    wind.0 = breeze()?;
    Ok(())
}

/// A light wind along the street, with gusts.
fn breeze() -> Result<Wind, WindError> {
    let mut wind = Wind::default();
    wind.add(Shear {
        velocity: [1.2, 0.0, 0.2],
        height: 5.0,
        ground: 0.0,
        profile: Profile::Log { roughness: 0.02 },
    })?;
    wind.add(Gusts::new(&GustSettings {
        rms: 0.5,
        length: 4.0,
        carried: [1.2, 0.0, 0.2],
        ..GustSettings::default()
    })?)?;
    Ok(wind)
}

fn set_up_street(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    sun(&mut commands, Color::srgb(0.72, 0.80, 0.88));
    commands.spawn(fly(Vec3::new(-9.5, 1.6, 3.4), Vec3::new(1.5, 0.9, -1.4)));
    let mut block = |size: Vec3, centre: Vec3, colour: Color| {
        (
            Mesh3d(meshes.add(Cuboid::from_size(size))),
            MeshMaterial3d(materials.add(matte(colour))),
            Transform::from_translation(centre),
        )
    };
    let asphalt = Color::srgb(0.20, 0.20, 0.22);
    let road = block(
        Vec3::new(90.0, 1.0, 90.0),
        Vec3::new(0.0, -0.5, 0.0),
        asphalt,
    );
    commands.spawn((road, RigidBody::Static, Collider::cuboid(90.0, 1.0, 90.0)));
    for side in [-1.0, 1.0] {
        let (size, z) = (STREET - ROAD, 0.5 * side * (STREET + ROAD));
        let flags = Color::srgb(0.46, 0.44, 0.42);
        let pavement = block(
            Vec3::new(90.0, KERB, size),
            Vec3::new(0.0, 0.5 * KERB, z),
            flags,
        );
        let collider = Collider::cuboid(90.0, KERB, size);
        commands.spawn((pavement, RigidBody::Static, collider));
        for house in 0..12u8 {
            let number = f32::from(house);
            let x = 7.0 * (number - 5.5);
            let height = 6.0 + (number * 2.4 + side).sin().abs() * 3.0;
            let tint = 0.06 * (number * 1.7 + side).cos();
            let brick = Color::srgb(0.55 + tint, 0.36 + 0.5 * tint, 0.28);
            let at = |x: f32, y: f32, depth: f32| Vec3::new(x, y, side * (STREET + depth));
            let wall = block(Vec3::new(6.8, height, 6.0), at(x, 0.5 * height, 3.0), brick);
            commands.spawn((wall, RigidBody::Static, Collider::cuboid(6.8, height, 6.0)));
            for (column, row) in [(-1.0, 0.0), (1.0, 0.0), (-1.0, 1.0), (0.0, 1.0), (1.0, 1.0)] {
                let place = at(x + 2.0 * column, 1.9 + 2.6 * row, 0.0);
                let glass = Color::srgb(0.16, 0.19, 0.23);
                commands.spawn(block(Vec3::new(1.1, 1.5, 0.1), place, glass));
            }
        }
    }
}

fn set_up_trees(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut bodies: ResMut<Assets<BakedBody>>,
    mut drop_leaves: MessageWriter<DropLeaves>,
) -> Result {
    let [length, width] = LEAF;
    // 0.2 mm thick, 450 kg/m^3.
    let body = bodies.add(Body::plate(length.into(), width.into(), 0.2e-3, 450.0)?);
    let leaf = Leaf::baked(body).drawn(meshes.add(leaf_mesh()));
    let bark = materials.add(matte(Color::srgb(0.25, 0.19, 0.14)));
    let trunk = meshes.add(Cylinder::new(0.16, CROWN[0]));
    let clump = meshes.add(Sphere::new(1.0).mesh().ico(3)?);
    let foliage = COLOURS.map(|[r, g, b]| materials.add(matte(Color::srgb(0.8 * r, 0.8 * g, b))));
    for (number, x) in (0u8..).zip(TREES.iter().chain(&TREES)) {
        let z = if number < 4 { -ROAD - 1.0 } else { ROAD + 1.0 };
        let crown = Crown {
            centre: Vec3::Y * CROWN[0],
            seed: number.into(),
            ..Crown::ball(CROWN[1], leaf.clone())
        };
        let tree = commands
            .spawn((
                crown,
                Transform::from_xyz(*x, KERB, z),
                Visibility::default(),
            ))
            .with_children(|tree| {
                tree.spawn((
                    Mesh3d(trunk.clone()),
                    MeshMaterial3d(bark.clone()),
                    Transform::from_xyz(0.0, 0.5 * CROWN[0], 0.0),
                ));
                for part in 0..7u8 {
                    let angle = f32::from(part) * 2.4 + f32::from(number);
                    let (away, up) = (0.55 * CROWN[1], 0.35 * (angle * 1.9).sin());
                    let place = Vec3::new(away * angle.cos(), CROWN[0] + up, away * angle.sin());
                    let colour = (part + number) as usize % COLOURS.len();
                    tree.spawn((
                        Mesh3d(clump.clone()),
                        MeshMaterial3d(foliage[colour].clone()),
                        Transform::from_translation(place).with_scale(Vec3::new(1.0, 0.8, 1.0)),
                    ));
                }
            })
            .id();
        drop_leaves.write(DropLeaves::over(
            tree,
            LEAVES,
            Duration::from_secs(SHEDDING),
        ));
    }
    Ok(())
}

/// Gives a leaf that was shed its colour and its contacts.
fn dress(
    shed: On<Add, ShedFrom>,
    mut colours: Local<Vec<Handle<StandardMaterial>>>,
    mut number: Local<usize>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut commands: Commands,
) {
    if colours.is_empty() {
        let colour = |[r, g, b]: [f32; 3]| materials.add(matte(Color::srgb(r, g, b)));
        *colours = COLOURS.map(colour).into();
    }
    *number = (*number + 1) % COLOURS.len();
    commands.entity(shed.entity).insert((
        MeshMaterial3d(colours[*number].clone()),
        RigidBody::Dynamic,
        Collider::cuboid(LEAF[0], 0.002, LEAF[1]),
    ));
}

/// A pointed oval along x, a little folded along its rib.
fn leaf_mesh() -> Mesh {
    const PARTS: u16 = 8;
    let [length, width] = LEAF;
    let mut points = Vec::new();
    for part in 0..=PARTS {
        let along = f32::from(part) / f32::from(PARTS);
        let half = 0.5 * width * (std::f32::consts::PI * along.powf(0.8)).sin().max(0.0);
        for side in [-1.0, 0.0, 1.0] {
            let z = side * half;
            points.push([length * (along - 0.5), 0.2 * z.abs(), z]);
        }
    }
    let mut triangles = Vec::new();
    for part in 0..PARTS {
        let first = 3 * part;
        for row in [first, first + 1] {
            triangles.extend([row, row + 1, row + 3, row + 1, row + 4, row + 3]);
        }
    }
    Mesh::new(
        PrimitiveTopology::TriangleList,
        RenderAssetUsages::default(),
    )
    .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, points)
    .with_inserted_indices(Indices::U16(triangles))
    .with_computed_normals()
}

/// A car that comes by again and again.
#[derive(Component)]
struct Car;

fn set_up_car(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) -> Result {
    let paint = materials.add(StandardMaterial {
        base_color: Color::srgb(0.10, 0.22, 0.38),
        perceptual_roughness: 0.35,
        ..default()
    });
    let dark = materials.add(matte(Color::srgb(0.05, 0.05, 0.06)));
    let boxes = [
        (Vec3::new(4.2, 0.6, 1.7), Vec3::new(0.0, 0.0, 0.0), &paint),
        (Vec3::new(2.2, 0.55, 1.5), Vec3::new(-0.2, 0.55, 0.0), &dark),
    ];
    let wheel = meshes.add(Cylinder::new(0.33, 0.22));
    let half = 0.5 * f64::from(SPEED);
    // The air behind is dragged along and swirls up, five metres far.
    let wake = Region::Box {
        centre: [-4.0, 0.2, 0.0],
        size: [7.0, 2.2, 3.2],
        edge: 0.8,
    };
    let swirls = Gusts::new(&GustSettings {
        rms: 1.5,
        length: 0.8,
        carried: [half, 0.0, 0.0],
        ..GustSettings::default()
    })?;
    let winds = [WindField::Uniform([half, 1.0, 0.0]), swirls.into()];
    commands
        .spawn((
            Car,
            Transform::from_xyz(-WAY, 0.55, 1.4),
            Visibility::default(),
            RigidBody::Kinematic,
            Collider::cuboid(4.2, 0.9, 1.7),
            LinearVelocity(SPEED * Vec3::X),
        ))
        .with_children(|car| {
            for (size, place, material) in boxes {
                car.spawn((
                    Mesh3d(meshes.add(Cuboid::from_size(size))),
                    MeshMaterial3d(material.clone()),
                    Transform::from_translation(place),
                ));
            }
            for (x, z) in [(-1.3, -0.8), (-1.3, 0.8), (1.3, -0.8), (1.3, 0.8)] {
                let turn = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
                car.spawn((
                    Mesh3d(wheel.clone()),
                    MeshMaterial3d(dark.clone()),
                    Transform::from_xyz(x, -0.22, z).with_rotation(turn),
                ));
            }
            for field in winds {
                let region = Some(wake);
                car.spawn(LocalWind { field, region });
            }
        });
    Ok(())
}

fn drive(mut cars: Query<&mut Position, With<Car>>) {
    for mut car in &mut cars {
        if car.x > WAY {
            car.x = -WAY;
        }
    }
}
