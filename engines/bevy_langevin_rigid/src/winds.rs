//! Winds that are somewhere: what fans blow, and the library's fields about entities.

use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::reflect::ReflectComponent;
use bevy_ecs::system::{Local, Query, Res, ResMut};
use bevy_log::error;
use bevy_math::{DVec3, Vec3};
use bevy_reflect::Reflect;
use bevy_transform::components::{GlobalTransform, Transform};
use bevy_transform::helper::TransformHelper;
use langevin_rigid::wind::{Jet, Region, Wind, WindError, WindField};

use crate::ambient::AmbientWind;
use crate::regions::Surroundings;
use crate::said::Said;

/// A fan: blows a round turbulent jet from its entity forwards, along -z of the entity, on top of the
/// [`AmbientWind`] ([`Jet`]).
///
/// The jet spreads, slows down and draws in the fluid around it; nothing stands in its way. It is in the fluid of
/// [`ImmersionSettings`](crate::ImmersionSettings) alone, not in a [`FluidRegion`](crate::FluidRegion). A fan that cannot be is an
/// error in the log, and does not blow until it is mended.
#[derive(Component, Debug, Clone, Copy, PartialEq, Reflect)]
#[reflect(Component, Clone, PartialEq)]
#[require(Transform)]
pub struct Fan {
    /// Speed in the middle of the fan (m/s).
    pub speed: f32,
    /// Diameter (m), before it is scaled with the entity.
    pub diameter: f32,
}

/// A wind about an entity, on top of the [`AmbientWind`]: the draught of a car, a dust devil, a gusty corner.
///
/// It goes with the entity, but is neither turned nor scaled: places in `field` (centres of jets and vortices, the ground of a
/// shear) and in `region` are relative to the entity's position, along the axes of the world; gusts and tables are where they
/// are in the world. As with a [`Fan`], it is in the fluid of [`ImmersionSettings`](crate::ImmersionSettings) alone. A wind that
/// cannot be is an error in the log, and does not blow until it is mended.
///
/// ```
/// use bevy_langevin_rigid::LocalWind;
/// use bevy_langevin_rigid::langevin_rigid::wind::{Region, Vortex, WindField};
/// // Turns about the vertical, 2 m wide and 6 m high.
/// let dust_devil = LocalWind {
///     field: WindField::Vortex(Vortex { centre: [0.0; 3], axis: [0.0, 1.0, 0.0], circulation: 6.0, core: 0.4 }),
///     region: Some(Region::Box { centre: [0.0, 3.0, 0.0], size: [2.0, 6.0, 2.0], edge: 0.5 }),
/// };
/// ```
#[derive(Component, Debug, Clone, PartialEq)]
#[require(Transform)]
pub struct LocalWind {
    /// What blows.
    pub field: WindField,
    /// Where; everywhere if none.
    pub region: Option<Region>,
}

/// A wind of an entity, where it is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Blowing {
    field: WindField,
    region: Option<Region>,
}

impl Blowing {
    fn of_fan(fan: &Fan, transform: &GlobalTransform) -> Self {
        let scale = transform.scale().abs().max_element();
        let jet = Jet {
            centre: transform.translation().as_dvec3().to_array(),
            axis: (transform.affine().matrix3 * Vec3::NEG_Z)
                .as_dvec3()
                .to_array(),
            speed: fan.speed.into(),
            diameter: (fan.diameter * scale).into(),
        };
        Self {
            field: jet.into(),
            region: None,
        }
    }

    fn of_local(wind: &LocalWind, transform: &GlobalTransform) -> Self {
        let mut blowing = Self {
            field: wind.field.clone(),
            region: wind.region,
        };
        let by = transform.translation().as_dvec3();
        let to = |place: &mut [f64; 3]| *place = (DVec3::from(*place) + by).to_array();
        match &mut blowing.field {
            WindField::Jet(jet) => to(&mut jet.centre),
            WindField::Vortex(vortex) => to(&mut vortex.centre),
            WindField::Shear(shear) => shear.ground += by.y,
            _ => {}
        }
        if let Some(Region::Box { centre, .. } | Region::Sphere { centre, .. }) =
            &mut blowing.region
        {
            to(centre);
        }
        blowing
    }

    fn add_to(&self, wind: &mut Wind) -> Result<(), WindError> {
        match self.region {
            Some(region) => wind.add_within(self.field.clone(), region),
            None => wind.add(self.field.clone()),
        }
    }
}

/// Finds where fans and local winds are, whether or not transforms were propagated since they moved.
pub(crate) fn survey(
    fans: Query<(Entity, &Fan)>,
    local: Query<(Entity, &LocalWind)>,
    transforms: TransformHelper,
    ambient: Res<AmbientWind>,
    mut around: ResMut<Surroundings>,
    mut said: Local<[Said; 2]>,
) {
    let [said_of_fans, said_of_local] = &mut *said;
    let mut found: Vec<(Entity, Blowing)> = Vec::new();
    let mut take = |entity, blowing: Blowing, what, said: &mut Said| match blowing
        .add_to(&mut Wind::default())
    {
        Ok(()) => {
            said.is_sound(entity);
            found.push((entity, blowing));
        }
        Err(error) => said.tell(entity, what, &error.to_string()),
    };
    // Those that are gone, or have an ancestor without a transform, are nowhere.
    for (entity, fan) in &fans {
        if let Ok(transform) = transforms.compute_global_transform(entity) {
            let blowing = Blowing::of_fan(fan, &transform);
            take(entity, blowing, "the fan", said_of_fans);
        }
    }
    for (entity, wind) in &local {
        if let Ok(transform) = transforms.compute_global_transform(entity) {
            let blowing = Blowing::of_local(wind, &transform);
            take(entity, blowing, "the local wind", said_of_local);
        }
    }
    // Stable: the fan of an entity comes before its wind.
    found.sort_by_key(|(entity, _)| *entity);
    let found: Vec<Blowing> = found.into_iter().map(|(_, blowing)| blowing).collect();
    if found != around.blowing || ambient.is_changed() {
        match sum(&ambient.0, &found) {
            Ok(wind) => around.wind = wind,
            // Each was added alone before.
            Err(error) => error!("local winds cannot be added to the wind around all: {error}"),
        }
        around.blowing = found;
    }
}

fn sum(ambient: &Wind, blowing: &[Blowing]) -> Result<Wind, WindError> {
    let mut wind = ambient.clone();
    for each in blowing {
        each.add_to(&mut wind)?;
    }
    Ok(wind)
}
