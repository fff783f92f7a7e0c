//! What the scenes share: a window to fly about in, or one picture without a window.

mod forces;
mod picture;
mod surroundings;

use std::path::PathBuf;

use avian3d::prelude::{PhysicsInterpolationPlugin, PhysicsPlugins};
use bevy::camera_controller::free_camera::FreeCameraPlugin;
use bevy::prelude::*;
use bevy_langevin_rigid::LangevinRigidPlugin;
use bevy_langevin_rigid_avian::LangevinRigidAvianPlugin;

pub use surroundings::{fly, matte, stand, sun};

/// A scene: how it is called, what it needs, and when its picture is taken.
pub struct Scene {
    /// Title of the window.
    pub title: &'static str,
    /// What a person can do, in a line.
    pub help: &'static str,
    /// When its picture shows it (s).
    pub seconds: f32,
    /// Its systems and resources.
    pub plugin: fn(&mut App),
}

/// What the command line asks for.
#[derive(Debug, PartialEq)]
enum Asked {
    Window,
    Picture { file: PathBuf, seconds: f32 },
    Help,
}

/// Shows a scene in a window; with `--picture FILE.png [--seconds SECONDS]` writes a picture of it and needs no display.
pub fn show(scene: &Scene) -> AppExit {
    let asked = match asked(std::env::args().skip(1), scene.seconds) {
        Ok(asked) => asked,
        Err(fault) => {
            eprintln!("{fault}\n{USAGE}");
            return AppExit::from_code(2);
        }
    };
    let mut app = App::new();
    match &asked {
        Asked::Help => {
            println!("{}. {}\n{USAGE}", scene.title, scene.help);
            return AppExit::Success;
        }
        Asked::Window if cfg!(target_os = "linux") && std::env::var_os("DISPLAY").is_none() => {
            eprintln!("there is no display: DISPLAY is not set\n{USAGE}");
            return AppExit::from_code(1);
        }
        Asked::Window => {
            println!("{}", scene.help);
            let window = Window {
                title: scene.title.into(),
                ..default()
            };
            let window = WindowPlugin {
                primary_window: Some(window),
                ..default()
            };
            app.add_plugins((DefaultPlugins.set(window), FreeCameraPlugin));
        }
        Asked::Picture { file, seconds } => picture::prepare(&mut app, file, *seconds),
    }
    app.add_plugins((
        PhysicsPlugins::default().set(PhysicsInterpolationPlugin::interpolate_all()),
        LangevinRigidPlugin,
        LangevinRigidAvianPlugin,
        forces::plugin,
    ));
    (scene.plugin)(&mut app);
    app.run()
}

const USAGE: &str = "Without options: a window. With --picture FILE.png: a picture after a while, without a window; \
                     --seconds SECONDS says after how long.";

fn asked(mut arguments: impl Iterator<Item = String>, default: f32) -> Result<Asked, String> {
    let (mut file, mut seconds) = (None, None);
    while let Some(option) = arguments.next() {
        let mut value = || {
            let value = arguments.next();
            value.ok_or_else(|| format!("{option} wants a value"))
        };
        match option.as_str() {
            "--help" | "-h" => return Ok(Asked::Help),
            "--picture" => file = Some(png(&value()?)?),
            "--seconds" => seconds = Some(positive(&value()?)?),
            _ => return Err(format!("there is no option {option}")),
        }
    }
    match (file, seconds) {
        (Some(file), seconds) => Ok(Asked::Picture {
            file,
            seconds: seconds.unwrap_or(default),
        }),
        (None, None) => Ok(Asked::Window),
        (None, Some(_)) => Err("--seconds goes with --picture".into()),
    }
}

fn png(name: &str) -> Result<PathBuf, String> {
    let file = PathBuf::from(name);
    match file.extension() {
        Some(end) if end == "png" => Ok(file),
        _ => Err(format!("a picture is a .png, not {name:?}")),
    }
}

fn positive(number: &str) -> Result<f32, String> {
    match number.parse() {
        Ok(seconds) if seconds > 0.0 && f32::is_finite(seconds) => Ok(seconds),
        _ => Err(format!("--seconds wants a positive number, not {number:?}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(line: &str) -> Result<Asked, String> {
        asked(line.split_whitespace().map(str::to_owned), 7.0)
    }

    #[test]
    fn options_are_read_and_wrong_ones_named() {
        let picture = |seconds| Asked::Picture {
            file: "a.png".into(),
            seconds,
        };
        assert_eq!(of(""), Ok(Asked::Window));
        assert_eq!(of("--picture a.png"), Ok(picture(7.0)));
        assert_eq!(of("--seconds 2.5 --picture a.png"), Ok(picture(2.5)));
        assert_eq!(of("--picture a.png -h"), Ok(Asked::Help));
        for (line, fault) in [
            ("--picture", "--picture wants a value"),
            ("--picture a.gif", "a picture is a .png, not \"a.gif\""),
            (
                "--picture a.png --seconds -1",
                "--seconds wants a positive number, not \"-1\"",
            ),
            ("--seconds 3", "--seconds goes with --picture"),
            ("leaves", "there is no option leaves"),
        ] {
            assert_eq!(of(line), Err(fault.into()));
        }
    }
}
