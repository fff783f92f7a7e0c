//! Where which fluid is: lakes and seas under the fluid around all.

use std::sync::Arc;

use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Local, Query, ResMut};
use bevy_math::{DVec2, DVec3, Vec3};
use bevy_transform::components::{GlobalTransform, Transform};
use bevy_transform::helper::TransformHelper;
use langevin_rigid::wind::Wind;
use langevin_rigid::{Fluid, Input};
use langevin_rigid_world::water::{WaterError, WaterSurface};

use crate::components::ExternalWrench;
use crate::said::Said;
use crate::winds::Blowing;

/// A part of space that is filled with another fluid than that of [`ImmersionSettings`](crate::ImmersionSettings), such as a
/// lake: a denser fluid under a calm, level surface.
///
/// It is where the entity's transform in the world puts it, and may be moved, turned about the vertical and scaled at any
/// time. A body is in it when its centre of mass is over the floor and between the sides; what of the body is under the
/// surface then feels the fluid: buoyancy is that of the displaced share, and added mass and drag grow with it
/// ([`Immersion`](crate::langevin_rigid_world::water::Immersion)). Floor and sides hold no body back. Of regions that overlap, a
/// body is in the one whose surface is the highest.
///
/// Gravity must be along -y, the fluid denser than that around, and its velocity horizontal. A region that cannot be is an
/// error in the log, and no region until it is mended.
///
/// ```
/// use bevy_langevin_rigid::FluidRegion;
/// use bevy_langevin_rigid::langevin_rigid::Fluid;
/// use bevy_math::Vec3;
/// use bevy_transform::components::Transform;
/// // 20 m by 30 m and 4 m deep, its surface at y = 0.
/// let lake = (FluidRegion::lake(Vec3::new(20.0, 4.0, 30.0)), Transform::from_xyz(0.0, -2.0, 0.0));
/// let current = Fluid { velocity: [0.5, 0.0, 0.0], ..Fluid::WATER };
/// let sea = (FluidRegion { fluid: current, ..FluidRegion::sea() }, Transform::from_xyz(0.0, -1.0, 0.0));
/// ```
#[derive(Component, Debug, Clone, Copy, PartialEq)]
#[require(Transform)]
pub struct FluidRegion {
    /// The fluid; its velocity is a current, world frame.
    pub fluid: Fluid,
    /// How far it reaches.
    pub extent: Extent,
}

/// How far a [`FluidRegion`] reaches from its entity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// Everywhere below the entity, which is at the surface.
    HalfSpace,
    /// A box of this size along the axes of the entity (m), which is in its middle; the surface is its top.
    Box(Vec3),
}

impl FluidRegion {
    /// Fresh water in a box of this size (m), the entity in its middle.
    pub fn lake(size: Vec3) -> Self {
        Self {
            fluid: Fluid::WATER,
            extent: Extent::Box(size),
        }
    }

    /// Fresh water everywhere below the entity.
    pub fn sea() -> Self {
        Self {
            fluid: Fluid::WATER,
            extent: Extent::HalfSpace,
        }
    }
}

/// What is around the bodies in the coming step.
#[derive(Resource, Default)]
pub(crate) struct Surroundings {
    /// Of the game, of all fans and of local winds.
    pub(crate) wind: Wind,
    /// The fluids of the regions, each once and without its velocity.
    pub(crate) fluids: Vec<Fluid>,
    /// From the highest surface down.
    regions: Vec<Region>,
    /// Of fans and local winds.
    pub(crate) blowing: Vec<Blowing>,
}

/// A region made ready.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Region {
    /// Without its velocity.
    pub(crate) fluid: Fluid,
    pub(crate) surface: Arc<WaterSurface>,
    /// World y (m).
    floor: f64,
    /// Middle, direction of the entity's x axis and half the size along x and z (m), all horizontal.
    middle: DVec2,
    x_axis: DVec2,
    half: DVec2,
}

/// Why a region is none.
#[derive(Debug, thiserror::Error)]
enum RegionError {
    #[error("its transform has a number that is not finite")]
    NotFinite,
    #[error(
        "it is tilted, and water is level: turn it about the vertical alone, or give the box another size"
    )]
    Tilted,
    #[error("its size is {0} m; along each axis it must be a positive number")]
    Size(DVec3),
    #[error(
        "its density is {density} kg/m^3 and its viscosity {viscosity} m^2/s; both must be positive numbers"
    )]
    Fluid { density: f64, viscosity: f64 },
    #[error("its velocity is {0:?} m/s; a current is horizontal")]
    Vertical([f64; 3]),
    #[error(transparent)]
    Water(#[from] WaterError),
}

/// Cosine of the tilt that is rounding, 0.1 degrees.
const LEVEL: f64 = 1.0 - 1.5e-6;

impl Region {
    fn new(of: &FluidRegion, transform: &GlobalTransform) -> Result<Self, RegionError> {
        if !transform.affine().is_finite() {
            return Err(RegionError::NotFinite);
        }
        let Fluid {
            density,
            viscosity,
            velocity,
        } = of.fluid;
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !(positive(density) && positive(viscosity)) {
            return Err(RegionError::Fluid { density, viscosity });
        }
        if velocity[1] != 0.0 {
            return Err(RegionError::Vertical(velocity));
        }
        let origin = transform.translation().as_dvec3();
        let (half, x_axis) = match of.extent {
            Extent::HalfSpace => (DVec3::INFINITY, DVec2::X),
            Extent::Box(size) => {
                let (scale, turn, _) = transform.to_scale_rotation_translation();
                let turn = turn.as_dquat();
                let size = size.as_dvec3() * scale.as_dvec3().abs();
                if !(size.min_element() > 0.0 && size.is_finite()) {
                    return Err(RegionError::Size(size));
                }
                // Upside down is as level.
                let up = (turn * DVec3::Y).y.abs();
                if up.is_nan() || up < LEVEL {
                    return Err(RegionError::Tilted);
                }
                let x = turn * DVec3::X;
                (0.5 * size, DVec2::new(x.x, x.z).normalize())
            }
        };
        let (top, floor) = match of.extent {
            Extent::HalfSpace => (origin.y, f64::NEG_INFINITY),
            Extent::Box(_) => (origin.y + half.y, origin.y - half.y),
        };
        let surface = WaterSurface::calm(top)?.with_current([velocity[0], velocity[2]])?;
        Ok(Self {
            fluid: Fluid {
                velocity: [0.0; 3],
                ..of.fluid
            },
            surface: Arc::new(surface),
            floor,
            middle: DVec2::new(origin.x, origin.z),
            x_axis,
            half: DVec2::new(half.x, half.z),
        })
    }

    fn holds(&self, position: DVec3) -> bool {
        let away = DVec2::new(position.x, position.z) - self.middle;
        let along = self.x_axis.dot(away).abs();
        let across = self.x_axis.perp_dot(away).abs();
        along <= self.half.x && across <= self.half.y && position.y >= self.floor
    }
}

impl Surroundings {
    /// What acts on a body with its centre of mass at `position` (m) at `time` (s), in a fluid that streams (m/s): the wind
    /// there, and what pushes it.
    pub(crate) fn input(
        &self,
        position: [f64; 3],
        time: f64,
        stream: [f64; 3],
        wrench: &ExternalWrench,
    ) -> Input {
        let mut input = Input::default();
        if !self.wind.is_empty() {
            input.flow = self.wind.flow(position, time, stream);
        }
        input.wrench.force = wrench.force.as_dvec3().to_array();
        input.wrench.torque = wrench.torque.as_dvec3().to_array();
        input
    }

    /// The region under or around a body with its centre of mass at `position` (m).
    pub(crate) fn region(&self, position: [f64; 3]) -> Option<&Region> {
        let position = DVec3::from(position);
        self.regions.iter().find(|region| region.holds(position))
    }

    /// Knows the fluids of these regions. Those that it knew keep their numbers where it can be, since bodies are made ready
    /// for a fluid by its number.
    fn know<'a>(&mut self, regions: impl Iterator<Item = &'a Region>) {
        let mut fluids: Vec<Fluid> = Vec::new();
        for Region { fluid, .. } in regions {
            if !fluids.contains(fluid) {
                fluids.push(*fluid);
            }
        }
        if !fluids.iter().all(|fluid| self.fluids.contains(fluid)) {
            self.fluids = fluids;
        }
    }
}

/// Finds where regions are, whether or not transforms were propagated since they moved.
pub(crate) fn survey(
    regions: Query<(Entity, &FluidRegion)>,
    transforms: TransformHelper,
    mut around: ResMut<Surroundings>,
    mut said: Local<Said>,
) {
    let mut found: Vec<(Entity, Region)> = Vec::new();
    for (entity, region) in &regions {
        // Gone, or an ancestor without a transform: nowhere.
        let Ok(transform) = transforms.compute_global_transform(entity) else {
            continue;
        };
        match Region::new(region, &transform) {
            Ok(region) => {
                said.is_sound(entity);
                found.push((entity, region));
            }
            Err(error) => said.tell(entity, "the fluid region", &error.to_string()),
        }
    }
    found.sort_by(|(a, p), (b, q)| {
        let [p, q] = [p, q].map(|region| region.surface.level());
        q.total_cmp(&p).then(a.cmp(b))
    });
    around.know(found.iter().map(|(_, region)| region));
    around.regions = found.into_iter().map(|(_, region)| region).collect();
}
