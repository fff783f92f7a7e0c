//! Trees that shed leaves.

use std::time::Duration;

use bevy_asset::Handle;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::{Message, MessageReader};
use bevy_ecs::query::With;
use bevy_ecs::reflect::{ReflectComponent, ReflectResource};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Commands, Local, Query, Res, ResMut};
use bevy_log::{error, warn};
use bevy_math::{Affine3A, DVec3, Quat, Vec3};
use bevy_mesh::{Mesh, Mesh3d};
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use bevy_time::{Fixed, Time};
use bevy_transform::components::{GlobalTransform, Transform};
use bevy_transform::helper::TransformHelper;
use langevin_rigid::NoiseStream;

use crate::ambient::ImmersionSettings;
use crate::baked_body::BakedBody;
use crate::components::{BodySource, Immersed};
use crate::said::Said;

/// Lets a tree shed leaves; a message.
///
/// The tree is an entity with a [`Crown`]. Each leaf starts at rest, at a random place of the crown and turned at random,
/// at a random moment of its own part of the time. All that is a pure function of the seeds and of how many leaves the tree
/// has shed before. A leaf is an entity of its own with a `Transform`, [`Immersed`], [`ShedFrom`] and, if the crown has one, a
/// `Mesh3d`; all leaves of a kind share one baked body and one mesh. What else they need, such as a material, an observer
/// gives them:
///
/// ```
/// use bevy_app::App;
/// use bevy_ecs::prelude::*;
/// use bevy_langevin_rigid::ShedFrom;
/// # #[derive(Component)]
/// # struct Autumnal;
/// fn plugin(app: &mut App) {
///     app.add_observer(|leaf: On<Add, ShedFrom>, mut commands: Commands| {
///         commands.entity(leaf.entity).insert(Autumnal);
///     });
/// }
/// ```
///
/// Nobody takes leaves away again: the game despawns those that it has done with. Leaves beyond the [`LeafLimit`] are not
/// shed. What a tree cannot shed is told in the log, once for each fault of a tree.
#[derive(Message, Debug, Clone, Copy, PartialEq, Eq)]
pub struct DropLeaves {
    /// The tree, an entity with a [`Crown`].
    pub tree: Entity,
    /// How many leaves.
    pub count: u32,
    /// Over which time; all in the next fixed step if it is zero.
    pub over: Duration,
}

/// Where a tree has its leaves, and of what kind they are.
///
/// The crown is an ellipsoid that goes with the entity's transform in the world: scaled, turned and moved. Its leaves keep
/// their size.
#[derive(Component, Debug, Clone, PartialEq, Reflect)]
#[reflect(Component, Clone, PartialEq)]
#[require(Transform, LeavesShed)]
pub struct Crown {
    /// Its middle, frame of the tree (m).
    pub centre: Vec3,
    /// Half its size along the axes of the tree (m).
    pub half_extents: Vec3,
    /// Its leaves.
    pub leaf: Leaf,
    /// Trees with the same seed shed alike.
    pub seed: u64,
}

/// A kind of leaf.
#[derive(Debug, Clone, PartialEq, Reflect)]
#[reflect(Clone, PartialEq)]
pub struct Leaf {
    /// Where its body comes from.
    pub source: BodySource,
    /// What is drawn; nothing if none.
    pub mesh: Option<Handle<Mesh>>,
    /// Size, one for as large as body and mesh are.
    pub scale: f32,
}

/// How many leaves a tree has shed; the next ones differ from these.
#[derive(Component, Debug, Clone, Copy, PartialEq, Eq, Default, Reflect)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct LeavesShed(pub u64);

/// Marks a leaf, with the tree that has shed it, which may be gone.
#[derive(Component, Debug, Clone, Copy, PartialEq, Eq, Reflect)]
#[reflect(Component, Clone, PartialEq)]
pub struct ShedFrom(pub Entity);

/// How many leaves that were shed there may be at once; a resource. 20,000 by default.
#[derive(Resource, Debug, Clone, Copy, PartialEq, Eq, Reflect)]
#[reflect(Resource, Default, Clone, PartialEq)]
pub struct LeafLimit(pub usize);

impl DropLeaves {
    /// All in the next fixed step.
    pub fn at_once(tree: Entity, count: u32) -> Self {
        Self::over(tree, count, Duration::ZERO)
    }

    /// Over a time.
    pub fn over(tree: Entity, count: u32, over: Duration) -> Self {
        Self { tree, count, over }
    }
}

impl Crown {
    /// A ball about the tree's origin.
    pub fn ball(radius: f32, leaf: Leaf) -> Self {
        Self {
            centre: Vec3::ZERO,
            half_extents: Vec3::splat(radius),
            leaf,
            seed: 0,
        }
    }
}

impl Leaf {
    /// Leaves with a body that was baked before, or that the library makes.
    pub fn baked(body: Handle<BakedBody>) -> Self {
        Self {
            source: BodySource::Baked(body),
            mesh: None,
            scale: 1.0,
        }
    }

    /// Leaves that are open sheets, of this density (kg/m^3) and thickness (m).
    pub fn sheet(mesh: Handle<Mesh>, density: f32, thickness: f32) -> Self {
        Self {
            source: BodySource::Mesh {
                density,
                thickness: Some(thickness),
            },
            mesh: Some(mesh),
            scale: 1.0,
        }
    }

    /// Drawn as this mesh.
    #[must_use]
    pub fn drawn(self, mesh: Handle<Mesh>) -> Self {
        Self {
            mesh: Some(mesh),
            ..self
        }
    }

    /// So many times as large.
    #[must_use]
    pub fn scaled(self, scale: f32) -> Self {
        Self { scale, ..self }
    }
}

impl Default for LeafLimit {
    fn default() -> Self {
        Self(20_000)
    }
}

/// Leaves that are still to be shed.
#[derive(Resource, Default)]
pub(crate) struct Shedding(Vec<Fall>);

/// What is left of one message.
struct Fall {
    tree: Entity,
    /// Which leaves of the tree.
    leaves: std::ops::Range<u64>,
    /// The first of them when the message came, and their number.
    first: u64,
    count: u32,
    /// Since the message came, and until the last leaf (s).
    elapsed: f64,
    over: f64,
}

impl Fall {
    /// Whether leaf number `leaf` is due within `dt` (s).
    fn is_due(&self, leaf: u64, within: f64, seed: u64) -> bool {
        let part = (leaf - self.first) as f64 + moment(seed, leaf);
        part * self.over < (self.elapsed + within) * f64::from(self.count)
    }
}

/// Takes in what trees are to shed.
pub(crate) fn receive(
    mut messages: MessageReader<DropLeaves>,
    mut trees: Query<(&Crown, &mut LeavesShed)>,
    leaves: Query<(), With<ShedFrom>>,
    limit: Res<LeafLimit>,
    transforms: TransformHelper,
    mut shedding: ResMut<Shedding>,
    mut said: Local<Said>,
) {
    if messages.is_empty() {
        return;
    }
    let waiting = shedding
        .0
        .iter()
        .map(|fall| fall.leaves.end - fall.leaves.start);
    let mut free = (limit.0 as u64)
        .saturating_sub(leaves.iter().len() as u64)
        .saturating_sub(waiting.sum());
    for &DropLeaves { tree, count, over } in messages.read() {
        let mut refuse = |fault: &str| {
            if said.is_new(tree, fault) {
                error!("the tree {tree} cannot shed leaves: {fault}");
            }
        };
        let Ok((crown, mut shed)) = trees.get_mut(tree) else {
            refuse("it is gone or has no `Crown`");
            continue;
        };
        if let Err(fault) = frame(tree, &transforms).and_then(|_| check(crown)) {
            refuse(&fault);
            continue;
        }
        if count == 0 {
            refuse("it was asked for none; ask for one at least");
            continue;
        }
        let most = u32::try_from(free).unwrap_or(u32::MAX).min(count);
        if most < count {
            let fault = format!("more than {} at once (`LeafLimit`)", limit.0);
            if said.is_new(tree, &fault) {
                warn!(
                    "the tree {tree} was asked for {count} leaves and sheds {most}: there cannot be {fault}"
                );
            }
        } else {
            said.is_sound(tree);
        }
        if most == 0 {
            continue;
        }
        let first = shed.0;
        shed.0 = first.saturating_add(most.into());
        free -= u64::from(most);
        shedding.0.push(Fall {
            tree,
            leaves: first..shed.0,
            first,
            count: most,
            elapsed: 0.0,
            over: over.as_secs_f64(),
        });
    }
}

/// Sheds the leaves that are due in the coming step.
pub(crate) fn shed(
    time: Res<Time<Fixed>>,
    settings: Res<ImmersionSettings>,
    trees: Query<&Crown>,
    transforms: TransformHelper,
    mut shedding: ResMut<Shedding>,
    mut commands: Commands,
) {
    let dt = time.delta_secs_f64();
    shedding.0.retain_mut(|fall| {
        let tree = fall.tree;
        let made = match trees.get(tree) {
            Err(_) => Err("it is gone or has no `Crown` any more".into()),
            Ok(crown) => {
                frame(tree, &transforms).and_then(|frame| check(crown).map(|()| (crown, frame)))
            }
        };
        let (crown, frame) = match made {
            Ok(made) => made,
            Err(fault) => {
                let left = fall.leaves.end - fall.leaves.start;
                error!(
                    "the tree {tree} does not shed the {left} leaves that were to come: {fault}"
                );
                return false;
            }
        };
        let seed = mixed(settings.seed, crown.seed);
        while fall.leaves.start < fall.leaves.end && fall.is_due(fall.leaves.start, dt, seed) {
            let place = place(crown, &frame, seed, fall.leaves.start);
            spawn(tree, crown, place, &mut commands);
            fall.leaves.start += 1;
        }
        fall.elapsed += dt;
        !fall.leaves.is_empty()
    });
}

fn spawn(tree: Entity, crown: &Crown, place: Transform, commands: &mut Commands) {
    let immersed = Immersed {
        source: crown.leaf.source.clone(),
        number: None,
    };
    let mut leaf = commands.spawn((place, immersed, ShedFrom(tree)));
    if let Some(mesh) = &crown.leaf.mesh {
        leaf.insert(Mesh3d(mesh.clone()));
    }
}

/// Where the tree is in the world.
fn frame(tree: Entity, transforms: &TransformHelper) -> Result<Affine3A, String> {
    let transform = transforms
        .compute_global_transform(tree)
        .as_ref()
        .map(GlobalTransform::affine)
        .map_err(|_| "it or an ancestor has no `Transform`".to_owned())?;
    if !transform.is_finite() {
        return Err("its transform in the world has a number that is not finite".into());
    }
    if transform.matrix3.determinant() == 0.0 {
        return Err("it is scaled to nothing; all three scales must differ from zero".into());
    }
    Ok(transform)
}

/// What is wrong with a crown.
fn check(crown: &Crown) -> Result<(), String> {
    let Crown {
        centre,
        half_extents,
        leaf,
        ..
    } = crown;
    if !(centre.is_finite() && half_extents.is_finite() && half_extents.min_element() >= 0.0) {
        return Err(format!(
            "its crown about {centre} m has the half-extents {half_extents} m; these must be zero or positive numbers"
        ));
    }
    if !(leaf.scale > 0.0 && leaf.scale.is_finite()) {
        return Err(format!(
            "its leaves have the scale {}; it must be a positive number",
            leaf.scale
        ));
    }
    if matches!(leaf.source, BodySource::Mesh { .. }) && leaf.mesh.is_none() {
        return Err("its leaves are to be baked from their mesh and have none".into());
    }
    Ok(())
}

/// The seed of a tree: other numbers than those of the noise of the bodies.
fn mixed(seed: u64, of_tree: u64) -> u64 {
    seed ^ of_tree.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15)
}

/// Where in the crown a leaf is and how it is turned: uniform over the ball, and over all rotations.
fn place(crown: &Crown, frame: &Affine3A, seed: u64, leaf: u64) -> Transform {
    let normals = NoiseStream { seed, body: 0 }.normals(leaf);
    // Three coordinates of a point that is uniform on the sphere in five dimensions are uniform in the ball.
    let [a, b, c, d, e, x, y, z, w, ..] = normals;
    let length = |numbers: &[f64]| numbers.iter().map(|x| x * x).sum::<f64>().sqrt();
    let in_ball = DVec3::new(a, b, c) / length(&[a, b, c, d, e]);
    let turn = length(&[x, y, z, w]);
    let turn = [x, y, z, w].map(|q| (q / turn) as f32);
    let place = crown.centre + crown.half_extents * in_ball.as_vec3();
    Transform {
        translation: frame.transform_point3(place),
        rotation: Quat::from_array(turn).normalize(),
        scale: Vec3::splat(crown.leaf.scale),
    }
}

/// When in its part of the time a leaf is shed, uniform from 0 to 1.
fn moment(seed: u64, leaf: u64) -> f64 {
    let [a, b, c, d, ..] = NoiseStream { seed, body: 1 }.normals(leaf);
    let [half, other] = [a * a + b * b, c * c + d * d];
    half / (half + other).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crown() -> Crown {
        Crown {
            centre: Vec3::new(0.0, 4.0, 0.0),
            half_extents: Vec3::new(2.0, 1.0, 3.0),
            ..Crown::ball(1.0, Leaf::baked(Handle::default()))
        }
    }

    #[test]
    fn leaves_fill_the_crown_evenly() {
        let crown = crown();
        let count = 20_000;
        let (mut square, mut inner, mut up) = (Vec3::ZERO, 0, Vec3::ZERO);
        for leaf in 0..count {
            let place = place(&crown, &Affine3A::IDENTITY, 7, leaf);
            let away = (place.translation - crown.centre) / crown.half_extents;
            assert!(away.length() <= 1.0 + 1e-6);
            square += away * away;
            inner += u32::from(away.length() < 0.5);
            up += place.rotation * Vec3::Y;
        }
        let count = count as f32;
        // Of a ball: a fifth of the squared radius along each axis, an eighth of the volume within half the radius.
        assert!(
            (square / count - 0.2).abs().max_element() < 0.005,
            "{square}"
        );
        assert!((inner as f32 / count - 0.125).abs() < 0.01, "{inner}");
        assert!((up / count).length() < 0.02, "{up}");
    }

    #[test]
    fn moments_are_even_from_zero_to_one() {
        let moments: Vec<f64> = (0..20_000).map(|leaf| moment(3, leaf)).collect();
        assert!(moments.iter().all(|moment| (0.0..1.0).contains(moment)));
        for share in [0.1, 0.5, 0.9] {
            let below = moments.iter().filter(|moment| **moment < share).count();
            assert!(
                (below as f64 / 20_000.0 - share).abs() < 0.015,
                "{share}: {below}"
            );
        }
    }

    #[test]
    fn a_crown_goes_with_its_tree() {
        let crown = crown();
        let frame = Affine3A::from_scale_rotation_translation(
            Vec3::splat(2.0),
            Quat::from_rotation_y(1.0),
            Vec3::new(10.0, 0.0, 0.0),
        );
        let here = place(&crown, &Affine3A::IDENTITY, 1, 5);
        let there = place(&crown, &frame, 1, 5);
        let wanted = frame.transform_point3(here.translation);
        assert!((there.translation - wanted).length() < 1e-5);
        assert_eq!((there.rotation, there.scale), (here.rotation, here.scale));
    }
}
