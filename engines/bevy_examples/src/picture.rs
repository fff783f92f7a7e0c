//! A picture of a scene, without a window.

use std::path::{Path, PathBuf};
use std::time::Duration;

use bevy::app::ScheduleRunnerPlugin;
use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::time::{Fixed, TimeUpdateStrategy};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 720;
/// Fixed steps between two frames that nobody sees.
const STRIDE: u32 = 4;
/// Frames after which there must be a picture, and between two looks for one.
const PATIENCE: u32 = 200;
const BETWEEN: u32 = 4;

/// The picture that is to be taken.
#[derive(Resource)]
struct Picture {
    file: PathBuf,
    seconds: f32,
    target: Handle<Image>,
    /// Since the moment that it shows.
    frames: u32,
}

/// Gives the app what it needs to take a picture after `seconds`, write it to `file`, and exit.
pub(crate) fn prepare(app: &mut App, file: &Path, seconds: f32) {
    let no_window = WindowPlugin {
        primary_window: None,
        exit_condition: ExitCondition::DontExit,
        ..default()
    };
    let renderer = RenderPlugin {
        synchronous_pipeline_compilation: true,
        ..default()
    };
    app.add_plugins((
        DefaultPlugins
            .set(no_window)
            .set(renderer)
            .disable::<WinitPlugin>(),
        ScheduleRunnerPlugin::run_loop(Duration::ZERO),
    ))
    .insert_resource(TimeUpdateStrategy::FixedTimesteps(STRIDE));
    let image = Image::new_target_texture(WIDTH, HEIGHT, TextureFormat::Rgba8UnormSrgb, None);
    let target = app.world_mut().resource_mut::<Assets<Image>>().add(image);
    app.insert_resource(Picture {
        file: file.to_owned(),
        seconds,
        target,
        frames: 0,
    })
    .add_observer(aim)
    .add_systems(Last, take);
}

/// Lets cameras draw to the picture, not before it is time.
fn aim(
    added: On<Add, Camera3d>,
    mut cameras: Query<&mut Camera>,
    picture: Res<Picture>,
    mut commands: Commands,
) {
    let target = RenderTarget::Image(picture.target.clone().into());
    commands.entity(added.entity).insert(target);
    if let Ok(mut camera) = cameras.get_mut(added.entity) {
        camera.is_active = false;
    }
}

fn take(
    time: Res<Time<Fixed>>,
    mut picture: ResMut<Picture>,
    mut cameras: Query<&mut Camera>,
    mut strategy: ResMut<TimeUpdateStrategy>,
    mut commands: Commands,
    mut exit: MessageWriter<AppExit>,
) {
    if time.elapsed_secs() < picture.seconds {
        return;
    }
    *strategy = TimeUpdateStrategy::FixedTimesteps(0);
    for mut camera in &mut cameras {
        camera.is_active = true;
    }
    picture.frames += 1;
    if picture.frames.is_multiple_of(BETWEEN) {
        commands
            .spawn(Screenshot::image(picture.target.clone()))
            .observe(keep);
    }
    if picture.frames > PATIENCE {
        error!("nothing was drawn in {PATIENCE} frames");
        exit.write(AppExit::error());
    }
}

/// Writes the picture whole or not at all; one in which nothing is drawn yet is let pass.
fn keep(taken: On<ScreenshotCaptured>, picture: Res<Picture>, mut exit: MessageWriter<AppExit>) {
    let image = &taken.image;
    let is_blank = image
        .data
        .as_ref()
        .is_none_or(|data| data.chunks(4).all(|pixel| pixel == &data[..4]));
    if is_blank {
        return;
    }
    let part = picture.file.with_extension("part.png");
    let written = image
        .clone()
        .try_into_dynamic()
        .map_err(|error| error.to_string())
        .and_then(|image| {
            image
                .to_rgb8()
                .save(&part)
                .map_err(|error| error.to_string())
        })
        .and_then(|()| std::fs::rename(&part, &picture.file).map_err(|error| error.to_string()));
    exit.write(match written {
        Ok(()) => {
            println!("{}", picture.file.display());
            AppExit::Success
        }
        Err(fault) => {
            error!("{} could not be written: {fault}", picture.file.display());
            AppExit::error()
        }
    });
}
