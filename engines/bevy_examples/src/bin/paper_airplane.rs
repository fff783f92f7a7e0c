//! A paper airplane that you throw with the mouse: how far does it fly?

use std::collections::VecDeque;

use avian3d::prelude::{AngularVelocity, Collider, LinearVelocity, RigidBody, Sleeping};
use bevy::asset::RenderAssetUsages;
use bevy::ecs::system::SystemParam;
use bevy::input::mouse::AccumulatedMouseMotion;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_langevin_rigid::langevin_rigid_bake::TriMesh;
use bevy_langevin_rigid::langevin_rigid_bake::body::BodySpec;
use bevy_langevin_rigid::langevin_rigid_bake::shapes::Shape;
use bevy_langevin_rigid::{BakedBody, Immersed, ShowForces};
use bevy_langevin_rigid_examples::{Scene, matte, show, stand, sun};

/// The sheet that it is folded of: its side and thickness (m), and its mass (kg).
const SIDE: f64 = 0.21;
const THICKNESS: f64 = 0.4e-3;
const MASS: f64 = 5e-3;
/// The centre of mass from the nose, in lengths: the folds at the nose are thick, and hold it there.
const BALANCE: f64 = 0.55;
/// Where it is thrown from (m).
const HAND: Vec3 = Vec3::new(0.0, 1.6, 0.0);
/// Slowest and fastest throw (m/s), and how much of it a pixel a second of the mouse is.
const THROW: [f32; 2] = [2.0, 9.0];
const PER_PIXEL: f32 = 0.004;
/// How far away it may be aimed (m).
const FARTHEST: f32 = 20.0;
/// Airplanes that lie about; the oldest goes first.
const MOST: usize = 12;

fn main() -> AppExit {
    show(&Scene {
        title: "Paper airplane",
        help: "Hold the left button, swing the mouse to where it shall fly, and let go: the faster, the harder the throw. \
               F hides and shows the forces.",
        seconds: 0.7,
        plugin,
    })
}

fn plugin(app: &mut App) {
    app.init_resource::<Swing>()
        .init_resource::<Thrown>()
        .add_systems(Startup, (set_up_field, set_up_airplane))
        .add_systems(Update, (swing, follow, draw_trails).chain());
}

/// What all airplanes share.
#[derive(Resource)]
struct Paper {
    body: Handle<BakedBody>,
    mesh: Handle<Mesh>,
    material: Handle<StandardMaterial>,
    collider: Collider,
}

/// The airplanes, oldest first.
#[derive(Resource, Default)]
struct Thrown(VecDeque<Entity>);

/// Where an airplane has been, and whether its landing was told.
#[derive(Component, Default)]
struct Flight {
    trail: Vec<Vec3>,
    landed: bool,
}

/// How fast the mouse moves, smoothed (pixels/s).
#[derive(Resource, Default)]
struct Swing(Vec2);

fn set_up_field(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    sun(&mut commands, Color::srgb(0.66, 0.79, 0.92));
    commands.spawn(stand(Vec3::new(0.6, 1.7, 2.6), Vec3::new(2.4, 0.95, 0.0)));
    commands.spawn((
        Mesh3d(meshes.add(Cuboid::new(60.0, 1.0, 60.0))),
        MeshMaterial3d(materials.add(matte(Color::srgb(0.30, 0.44, 0.20)))),
        Transform::from_xyz(0.0, -0.5, 0.0),
        RigidBody::Static,
        Collider::cuboid(60.0, 1.0, 60.0),
    ));
    // A line at each metre, a broad one at five and ten.
    let chalk = materials.add(matte(Color::srgb(0.88, 0.88, 0.84)));
    for metre in 1..=12u8 {
        let width = if metre.is_multiple_of(5) { 0.10 } else { 0.03 };
        commands.spawn((
            Mesh3d(meshes.add(Cuboid::new(width, 0.004, 3.0))),
            MeshMaterial3d(chalk.clone()),
            Transform::from_xyz(metre.into(), 0.0, 0.0),
        ));
    }
}

fn set_up_airplane(
    mut commands: Commands,
    mut bodies: ResMut<Assets<BakedBody>>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut thrown: ResMut<Thrown>,
) -> Result {
    let shape = Shape::PaperAirplane {
        side: SIDE,
        thickness: THICKNESS,
    };
    let solid = shape.mesh(800)?;
    let mesh = drawn(&solid);
    let points: Vec<Vec3> = solid.vertices().iter().map(|v| vec3(*v)).collect();
    let collider = Collider::convex_hull(points).ok_or("the airplane has no convex hull")?;
    let paper = Paper {
        body: bodies.add(bake(&solid)?),
        mesh: meshes.add(mesh),
        material: materials.add(matte(Color::srgb(0.93, 0.93, 0.90))),
        collider,
    };
    // Two to begin with, side by side.
    for (aside, speed) in [(-0.3, 6.0), (0.3, 4.0)] {
        let hand = HAND + aside * Vec3::Z;
        throw(
            &paper,
            hand,
            Vec3::new(1.0, 0.06, 0.0),
            speed,
            &mut thrown,
            &mut commands,
        );
    }
    commands.insert_resource(paper);
    Ok(())
}

/// With the centre of mass where the folds put it.
fn bake(solid: &TriMesh) -> Result<BakedBody, BevyError> {
    let along = solid.vertices().iter().map(|vertex| vertex[0]);
    let nose = along.clone().fold(f64::NEG_INFINITY, f64::max);
    let tail = along.fold(f64::INFINITY, f64::min);
    let centre_of_mass = [nose - BALANCE * (nose - tail), -0.003, 0.0];
    let spec = BodySpec {
        mass: Some(MASS),
        centre_of_mass: Some(centre_of_mass),
        ..BodySpec::default()
    };
    let (body, _) = BakedBody::bake(solid, &spec)?;
    Ok(body)
}

fn drawn(solid: &TriMesh) -> Mesh {
    let points: Vec<[f32; 3]> = solid
        .vertices()
        .iter()
        .map(|v| v.map(|x| x as f32))
        .collect();
    let triangles = solid.triangles().as_flattened().to_vec();
    Mesh::new(
        PrimitiveTopology::TriangleList,
        RenderAssetUsages::default(),
    )
    .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, points)
    .with_inserted_indices(Indices::U32(triangles))
    .with_duplicated_vertices()
    .with_computed_flat_normals()
}

fn vec3(vertex: [f64; 3]) -> Vec3 {
    Vec3::from(vertex.map(|x| x as f32))
}

/// Lets one go from the hand, its nose where it flies to.
fn throw(
    paper: &Paper,
    hand: Vec3,
    towards: Vec3,
    speed: f32,
    thrown: &mut Thrown,
    commands: &mut Commands,
) {
    let forwards = towards.normalize();
    let right = forwards.cross(Vec3::Y).normalize();
    let turn = Quat::from_mat3(&Mat3::from_cols(forwards, right.cross(forwards), right));
    let airplane = commands.spawn((
        Flight::default(),
        Immersed::baked(paper.body.clone()),
        Mesh3d(paper.mesh.clone()),
        MeshMaterial3d(paper.material.clone()),
        Transform::from_translation(hand).with_rotation(turn),
        RigidBody::Dynamic,
        paper.collider.clone(),
        LinearVelocity(speed * forwards),
        AngularVelocity::default(),
        ShowForces,
    ));
    thrown.0.push_back(airplane.id());
    while thrown.0.len() > MOST {
        if let Some(oldest) = thrown.0.pop_front() {
            commands.entity(oldest).despawn();
        }
    }
}

/// The mouse over the window.
#[derive(SystemParam)]
struct Mouse<'w, 's> {
    buttons: Res<'w, ButtonInput<MouseButton>>,
    moved: Res<'w, AccumulatedMouseMotion>,
    windows: Query<'w, 's, &'static Window>,
    cameras: Query<'w, 's, (&'static Camera, &'static GlobalTransform)>,
}

impl Mouse<'_, '_> {
    /// Where it points to on the ground; in the sky, a place as far away as one may be (m).
    fn place(&self) -> Option<Vec3> {
        let cursor = self.windows.single().ok()?.cursor_position()?;
        let (camera, place) = self.cameras.single().ok()?;
        let ray = camera.viewport_to_world(place, cursor).ok()?;
        let ground = ray.plane_intersection_point(Vec3::ZERO, InfinitePlane3d::new(Vec3::Y));
        let near = ground.filter(|ground| ground.distance(ray.origin) < FARTHEST);
        Some(near.unwrap_or_else(|| ray.get_point(FARTHEST)))
    }
}

/// Throws an airplane when the button is let go.
fn swing(
    mouse: Mouse,
    time: Res<Time>,
    paper: Res<Paper>,
    mut swing: ResMut<Swing>,
    mut thrown: ResMut<Thrown>,
    mut commands: Commands,
) {
    let dt = time.delta_secs();
    if dt > 0.0 {
        // Over a tenth of a second.
        let share = (dt / 0.1).min(1.0);
        swing.0 = swing.0.lerp(mouse.moved.delta / dt, share);
    }
    if mouse.buttons.just_released(MouseButton::Left)
        && let Some(place) = mouse.place()
    {
        let speed = (PER_PIXEL * swing.0.length()).clamp(THROW[0], THROW[1]);
        throw(
            &paper,
            HAND,
            place - HAND,
            speed,
            &mut thrown,
            &mut commands,
        );
    }
}

/// Keeps where airplanes have been, and tells how far they flew.
fn follow(mut flights: Query<(&mut Flight, &Transform, Has<Sleeping>)>) {
    for (mut flight, transform, asleep) in &mut flights {
        let here = transform.translation;
        if !flight.landed
            && flight
                .trail
                .last()
                .is_none_or(|last| last.distance(here) > 0.02)
        {
            flight.trail.push(here);
        }
        if asleep && !flight.landed {
            flight.landed = true;
            let flown = here - HAND;
            println!("{:.1} m", flown.xz().length());
        }
    }
}

fn draw_trails(flights: Query<&Flight>, mut gizmos: Gizmos) {
    for flight in &flights {
        gizmos.linestrip(flight.trail.iter().copied(), Color::srgb(0.95, 0.95, 0.95));
    }
}
