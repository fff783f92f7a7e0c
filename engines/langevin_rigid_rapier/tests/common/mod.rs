//! A world with all that Rapier wants.
#![allow(unreachable_pub, clippy::unwrap_used, reason = "of tests")]

use std::sync::Arc;

use langevin_rigid_rapier::langevin_rigid::{Input, State, Stepper};
use langevin_rigid_rapier::{ImmersedBodies, Immersion};
use rapier3d::prelude::*;

pub const DT: f64 = 1.0 / 60.0;
/// Of all that touches.
pub const FRICTION: f64 = 0.5;

#[derive(Default)]
pub struct World {
    pub immersed: ImmersedBodies,
    pub bodies: RigidBodySet,
    pub colliders: ColliderSet,
    pub narrow_phase: NarrowPhase,
    pipeline: PhysicsPipeline,
    islands: IslandManager,
    broad_phase: DefaultBroadPhase,
    impulse_joints: ImpulseJointSet,
    multibody_joints: MultibodyJointSet,
    soft_bodies: SoftBodySet,
    ccd: CCDSolver,
}

/// A card of cardboard in air.
pub fn card() -> Arc<Stepper> {
    Arc::new(contact_tests::stepper())
}

impl World {
    pub fn ground(&mut self) {
        let ground =
            ColliderBuilder::cuboid(50.0, 1.0, 50.0).translation(Vector::new(0.0, -1.0, 0.0));
        self.colliders.insert(ground.friction(FRICTION as f32));
    }

    pub fn drop(&mut self, stepper: &Arc<Stepper>, pose: &State) -> RigidBodyHandle {
        let [x, y, z] = contact_tests::SIZE.map(|size| 0.5 * size as f32);
        self.insert(stepper, ColliderBuilder::cuboid(x, y, z), pose)
    }

    pub fn insert(
        &mut self,
        stepper: &Arc<Stepper>,
        collider: ColliderBuilder,
        pose: &State,
    ) -> RigidBodyHandle {
        let [x, y, z] = pose.position.map(|x| x as f32);
        let [i, j, k, w] = pose.orientation.map(|x| x as f32);
        let turn = Rotation::from_xyzw(i, j, k, w);
        let pose = Pose::from_parts(Vector::new(x, y, z), turn);
        let handle = self.bodies.insert(RigidBodyBuilder::dynamic().pose(pose));
        let collider = collider.friction(FRICTION as f32);
        self.colliders
            .insert_with_parent(collider, handle, &mut self.bodies);
        let immersion = Immersion {
            stepper: stepper.clone(),
            centre_of_mass: [0.0; 3],
            contact_distance: 0.05,
        };
        self.immersed
            .insert(handle, immersion, &mut self.bodies, &mut self.colliders)
            .unwrap();
        handle
    }

    pub fn remove(&mut self, handle: RigidBodyHandle) {
        self.bodies.remove(
            handle,
            &mut self.islands,
            &mut self.colliders,
            &mut self.impulse_joints,
            &mut self.multibody_joints,
            &mut self.soft_bodies,
            true,
        );
    }

    pub fn step(&mut self, input: &mut dyn FnMut(RigidBodyHandle, &State) -> Input) {
        self.immersed
            .before_step(DT, &mut self.bodies, &self.narrow_phase, input)
            .unwrap();
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
    }
}
