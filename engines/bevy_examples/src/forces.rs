//! F shows and hides the forces on bodies.

use bevy::prelude::*;
use bevy_langevin_rigid::{ForceGizmosPlugin, ShowForces, Stepped};

pub(crate) fn plugin(app: &mut App) {
    app.add_plugins(ForceGizmosPlugin).add_systems(
        Update,
        toggle.run_if(resource_exists::<ButtonInput<KeyCode>>),
    );
}

fn toggle(
    keys: Res<ButtonInput<KeyCode>>,
    bodies: Query<(Entity, Has<ShowForces>), With<Stepped>>,
    mut commands: Commands,
) {
    if !keys.just_pressed(KeyCode::KeyF) {
        return;
    }
    for (body, shown) in &bodies {
        if shown {
            commands.entity(body).remove::<ShowForces>();
        } else {
            commands.entity(body).insert(ShowForces);
        }
    }
}
