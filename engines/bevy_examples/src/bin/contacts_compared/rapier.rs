//! Rapier's contacts.

use std::error::Error;
use std::sync::Arc;

use bevy_langevin_rigid::langevin_rigid::Stepper;
use bevy_langevin_rigid::langevin_rigid::linalg::Quat;
use langevin_rigid_rapier::{ImmersedBodies, Immersion, InsertError};
use rapier3d::prelude::*;

use crate::cards::{self, DT, FRICTION, SIZE, Way};

/// About what a falling card moves in a step (m).
const CONTACT_DISTANCE: f32 = 0.05;
/// Cards meet the ground and not each other.
const GROUND: Group = Group::GROUP_1;
const CARDS: Group = Group::GROUP_2;

/// A world with all that Rapier wants.
#[derive(Default)]
struct World {
    immersed: ImmersedBodies,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    narrow_phase: NarrowPhase,
    pipeline: PhysicsPipeline,
    islands: IslandManager,
    broad_phase: DefaultBroadPhase,
    impulse_joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
}

/// The ways of all cards onto the ground.
pub(crate) fn ways(card: &Stepper, steps: usize) -> Result<Vec<Way>, Box<dyn Error>> {
    let mut world = World::default();
    world.add_ground();
    let card = Arc::new(card.clone());
    let handles = cards::releases()
        .map(|(height, turn)| world.drop_card(&card, height, turn))
        .collect::<Result<Vec<_>, _>>()?;
    let mut ways = vec![Way::new(); handles.len()];
    world.record(&handles, &mut ways);
    for _ in 0..steps {
        world.step(&handles)?;
        world.record(&handles, &mut ways);
    }
    Ok(ways)
}

impl World {
    fn add_ground(&mut self) {
        let ground = ColliderBuilder::cuboid(50.0, 1.0, 50.0)
            .translation(Vector::new(0.0, -1.0, 0.0))
            .friction(FRICTION as f32)
            .collision_groups(groups(GROUND, CARDS));
        self.colliders.insert(ground);
    }

    fn drop_card(
        &mut self,
        card: &Arc<Stepper>,
        height: f64,
        turn: Quat,
    ) -> Result<RigidBodyHandle, InsertError> {
        let [x, y, z, w] = turn.map(|x| x as f32);
        let turn = Rotation::from_xyzw(x, y, z, w);
        let pose = Pose::from_parts(Vector::new(0.0, height as f32, 0.0), turn);
        let handle = self.bodies.insert(RigidBodyBuilder::dynamic().pose(pose));
        let [x, y, z] = SIZE.map(|size| 0.5 * size as f32);
        let collider = ColliderBuilder::cuboid(x, y, z)
            .friction(FRICTION as f32)
            .collision_groups(groups(CARDS, GROUND));
        self.colliders
            .insert_with_parent(collider, handle, &mut self.bodies);
        let immersion = Immersion {
            stepper: card.clone(),
            centre_of_mass: [0.0; 3],
            contact_distance: CONTACT_DISTANCE,
        };
        self.immersed
            .insert(handle, immersion, &mut self.bodies, &mut self.colliders)?;
        Ok(handle)
    }

    fn step(&mut self, handles: &[RigidBodyHandle]) -> Result<(), Box<dyn Error>> {
        let number = |handle| handles.iter().position(|other| *other == handle);
        self.immersed
            .before_step(DT, &mut self.bodies, &self.narrow_phase, |handle, _| {
                number(handle).map(cards::input).unwrap_or_default()
            })
            .map_err(|mut troubles| troubles.remove(0))?;
        let parameters = IntegrationParameters {
            dt: DT as f32,
            ..IntegrationParameters::default()
        };
        self.pipeline.step(
            Vector::new(0.0, -9.81, 0.0),
            &parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.impulse_joints,
            &mut self.multibody_joints,
            &mut self.soft_bodies,
            &mut self.ccd,
            &(),
            &(),
        );
        self.immersed.after_step(&mut self.bodies);
        Ok(())
    }

    fn record(&self, handles: &[RigidBodyHandle], ways: &mut [Way]) {
        for (handle, way) in handles.iter().zip(ways) {
            way.extend(self.immersed.state(*handle));
        }
    }
}

fn groups(own: Group, others: Group) -> InteractionGroups {
    InteractionGroups::new(own, others, InteractionTestMode::And)
}
