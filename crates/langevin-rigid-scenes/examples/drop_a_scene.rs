//! A business card falls two metres: from the text of a scene to where it lands, with the table and the picture of its fall.

use std::error::Error;

use langevin_rigid_formats::files;
use langevin_rigid_formats::trajectory::{Trajectory, csv};
use langevin_rigid_pictures::{PictureOptions, Subject, trajectory_picture};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::Scene;

const SCENE: &str = r#"
    description = "A business card"
    fluid.preset = "air"
    body = { shape = "box", size = [0.085, 0.0003, 0.055], triangles = 300, density = 900.0 }
    release = { position = [0.0, 2.0, 0.0], tilt = 20.0, tilt_axis = [1.0, 0.0, 0.1] }
    run = { time_step = 0.002, duration = 10.0, ground = 0.0 }
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = Scene::parse("card", "card.toml", SCENE)?;
    // Bakes the body; with a folder in place of `None` the bake is kept there for the next time.
    let prepared = Prepared::new(scene, None, &())?;
    prepared.check_release()?;
    let fall = prepared.drop(&prepared.release(0), &());
    fall.ended?;

    let trajectory = Trajectory::new(fall.body, &fall.states);
    for pose in trajectory.poses.iter().step_by(50) {
        println!("{:.1} s: {:.2?} m", pose.time, pose.position);
    }
    if let Some(end) = trajectory.poses.last() {
        let [x, _, z] = end.position;
        println!(
            "landed after {:.2} s at x = {x:.2} m, z = {z:.2} m",
            end.time
        );
    }

    let surface = &prepared.body().surface;
    let card = Subject {
        vertices: &surface.vertices,
        triangles: &surface.triangles,
    };
    let options = PictureOptions {
        title: Some(prepared.scene().description.clone()),
        stage: prepared.stage(),
        ..PictureOptions::default()
    };
    let picture = trajectory_picture(&card, &trajectory.poses, &options)?;

    let folder = std::env::temp_dir().join("langevin-rigid-drop-a-scene");
    files::write(&folder.join("card.csv"), csv(&trajectory).as_bytes())?;
    files::write(&folder.join("card.png"), &picture.png()?)?;
    println!("card.csv and card.png are in {}", folder.display());
    Ok(())
}
