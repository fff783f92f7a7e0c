//! A world with all that Rapier wants.
#![allow(unreachable_pub, clippy::unwrap_used, reason = "of tests")]

use std::sync::Arc;

use langevin_rigid_rapier::langevin_rigid::linalg::{quat_from_rotation_vector, rotate};
use langevin_rigid_rapier::langevin_rigid::{Body, Fluid, Input, Settings, State, Stepper};
use langevin_rigid_rapier::{ImmersedBodies, Immersion};
use rapier3d::prelude::*;

pub const DT: f64 = 1.0 / 60.0;
const CARD: [f64; 3] = [0.06, 0.0005, 0.09];

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
    let body = Body::cuboid(CARD, 700.0).unwrap();
    Arc::new(Stepper::new(&body, &Fluid::AIR, None, &Settings::default()).unwrap())
}

/// World direction of the thin axis.
pub fn thin_axis(state: &State) -> [f64; 3] {
    rotate(state.orientation, [0.0, 1.0, 0.0])
}

pub fn turned(tilt: [f64; 3]) -> Rotation {
    let [x, y, z, w] = quat_from_rotation_vector(tilt).map(|x| x as f32);
    Rotation::from_xyzw(x, y, z, w)
}

impl World {
    pub fn ground(&mut self) {
        let ground =
            ColliderBuilder::cuboid(50.0, 1.0, 50.0).translation(Vector::new(0.0, -1.0, 0.0));
        self.colliders.insert(ground.friction(0.5));
    }

    pub fn drop(
        &mut self,
        stepper: &Arc<Stepper>,
        place: [f64; 3],
        tilt: [f64; 3],
    ) -> RigidBodyHandle {
        let [x, y, z] = CARD.map(|size| 0.5 * size as f32);
        self.insert(
            stepper,
            ColliderBuilder::cuboid(x, y, z).friction(0.5),
            place,
            tilt,
        )
    }

    pub fn ball(
        &mut self,
        stepper: &Arc<Stepper>,
        radius: f32,
        place: [f64; 3],
    ) -> RigidBodyHandle {
        self.insert(stepper, ColliderBuilder::ball(radius), place, [0.0; 3])
    }

    fn insert(
        &mut self,
        stepper: &Arc<Stepper>,
        collider: ColliderBuilder,
        place: [f64; 3],
        tilt: [f64; 3],
    ) -> RigidBodyHandle {
        let [x, y, z] = place.map(|x| x as f32);
        let pose = Pose::from_parts(Vector::new(x, y, z), turned(tilt));
        let handle = self.bodies.insert(RigidBodyBuilder::dynamic().pose(pose));
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
