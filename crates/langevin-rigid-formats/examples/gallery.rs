//! Draws made-up motions of made-up bodies, to see how pictures of all shapes turn out.
//!
//! `cargo run --release -p langevin-rigid-formats --example gallery -- <directory>`

use std::path::Path;

use langevin_rigid_formats::picture::{PictureOptions, Pose, Subject, View, trajectory_picture};
use libm::{cos, sin};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let directory = std::env::args()
        .nth(1)
        .ok_or("give a directory to write to")?;
    for (name, mesh, poses, options) in gallery() {
        let subject = Subject {
            vertices: &mesh.0,
            triangles: &mesh.1,
        };
        let begin = std::time::Instant::now();
        let picture = trajectory_picture(&subject, &poses, &options)?;
        let drawn = begin.elapsed();
        let png = picture.png()?;
        println!(
            "{name}: {} x {} px, {} bodies {}x, drawn in {drawn:.0?}, encoded in {:.0?}, {} kB",
            picture.width(),
            picture.height(),
            picture.times().len(),
            picture.magnification(),
            begin.elapsed() - drawn,
            png.len() / 1000,
        );
        std::fs::write(
            Path::new(&directory).join(format!("picture-{name}.png")),
            png,
        )?;
    }
    Ok(())
}

type Exhibit = (&'static str, Mesh, Vec<Pose>, PictureOptions);

fn gallery() -> Vec<Exhibit> {
    let titled = |title: &str| PictureOptions {
        title: Some(title.to_owned()),
        ..PictureOptions::default()
    };
    let seen = |view, title: &str| PictureOptions {
        view,
        ..titled(title)
    };
    let sheet = || plate([0.08, 0.0008, 0.08]);
    vec![
        (
            "helix",
            sheet(),
            motion(4.0, helix),
            titled("A square sheet spiralling down in air"),
        ),
        (
            "flutter",
            plate([0.04, 0.001, 0.08]),
            motion(3.0, flutter),
            titled("A card fluttering from side to side in water"),
        ),
        (
            "tumble",
            ellipsoid([0.1, 0.02, 0.06]),
            motion(2.0, tumble),
            titled("An ellipsoid tumbling"),
        ),
        (
            "glide",
            plate([0.15, 0.01, 0.3]),
            motion(3.0, glide),
            PictureOptions {
                ground: Some(0.0),
                ..titled("A glider")
            },
        ),
        (
            "drop",
            plate([0.1, 0.1, 0.1]),
            motion(1.0, drop),
            PictureOptions {
                ground: Some(-5.0),
                ..titled("A box falling straight down")
            },
        ),
        (
            "one-pose",
            ellipsoid([0.1, 0.03, 0.05]),
            motion(0.0, helix),
            titled("One pose only"),
        ),
        (
            "still",
            plate([0.1, 0.04, 0.07]),
            motion(2.0, still),
            titled("A body that hardly moves"),
        ),
        (
            "edge-on",
            sheet(),
            motion(2.0, edge_on),
            titled("A sheet seen exactly along its plane"),
        ),
        (
            "huge",
            sheet(),
            motion(60.0, huge),
            titled("A sheet carried two kilometres"),
        ),
        (
            "tiny",
            ellipsoid([2e-5, 5e-6, 1e-5]),
            motion(1.0, tiny),
            titled("A grain of 40 µm, far from the origin"),
        ),
        (
            "iso",
            sheet(),
            motion(4.0, helix),
            PictureOptions {
                ground: Some(-4.6),
                ..seen(View::Iso, "A square sheet spiralling down in air")
            },
        ),
        (
            "iso-glide",
            plate([0.15, 0.01, 0.3]),
            motion(3.0, glide),
            PictureOptions {
                ground: Some(0.0),
                ..seen(View::Iso, "A glider")
            },
        ),
        (
            "top",
            sheet(),
            motion(4.0, helix),
            seen(View::Top, "A spiral from above"),
        ),
        (
            "side",
            sheet(),
            motion(4.0, helix),
            seen(View::Side, "A spiral from the side"),
        ),
        (
            "small",
            sheet(),
            motion(4.0, helix),
            PictureOptions {
                size: Some([480, 400]),
                ..titled("A small picture")
            },
        ),
        (
            "wide",
            sheet(),
            motion(4.0, helix),
            PictureOptions {
                size: Some([1920, 1080]),
                ..titled("A wide picture")
            },
        ),
        (
            "long-title",
            sheet(),
            motion(4.0, flutter),
            titled(
                "A title that goes on and on, naming the body, its material, the fluid, the release angle and the seed 123456789",
            ),
        ),
    ]
}

fn motion(duration: f64, place: fn(f64) -> ([f64; 3], [f64; 4])) -> Vec<Pose> {
    let steps = 240.0 * duration;
    (0..=steps as u32)
        .map(|k| {
            let time = f64::from(k) / 240.0;
            let (position, orientation) = place(time);
            Pose {
                time,
                position,
                orientation,
            }
        })
        .collect()
}

fn about(axis: [f64; 3], angle: f64) -> [f64; 4] {
    let s = sin(0.5 * angle);
    [axis[0] * s, axis[1] * s, axis[2] * s, cos(0.5 * angle)]
}

fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    ]
}

fn helix(t: f64) -> ([f64; 3], [f64; 4]) {
    let w = 5.5 * t;
    let bank = product(about([0.0, 1.0, 0.0], -w), about([0.0, 0.0, 1.0], 0.6));
    ([0.35 * cos(w), -1.1 * t, 0.35 * sin(w)], bank)
}

fn flutter(t: f64) -> ([f64; 3], [f64; 4]) {
    let w = 4.5 * t;
    let y = -0.28 * t - 0.03 * cos(2.0 * w);
    (
        [0.12 * sin(w), y, 0.02 * sin(0.7 * w)],
        about([0.0, 0.0, 1.0], 0.9 * cos(w)),
    )
}

fn tumble(t: f64) -> ([f64; 3], [f64; 4]) {
    (
        [0.9 * t, -0.7 * t, 0.1 * sin(3.0 * t)],
        about([0.0, 0.0, 1.0], -9.0 * t),
    )
}

fn glide(t: f64) -> ([f64; 3], [f64; 4]) {
    let y = 1.2 - 0.35 * t + 0.12 * sin(3.0 * t);
    (
        [2.2 * t, y, 0.05 * t * t],
        about([0.0, 0.0, 1.0], -0.16 + 0.3 * cos(3.0 * t)),
    )
}

fn drop(t: f64) -> ([f64; 3], [f64; 4]) {
    ([0.0, -4.905 * t * t, 0.0], about([0.6, 0.0, 0.8], t))
}

fn still(t: f64) -> ([f64; 3], [f64; 4]) {
    (
        [0.004 * sin(t), 0.003 * t, 0.0],
        about([0.36, 0.48, 0.8], 0.5 + 0.4 * t),
    )
}

fn edge_on(t: f64) -> ([f64; 3], [f64; 4]) {
    ([0.05 * sin(5.0 * t), -0.5 * t, 0.0], [0.0, 0.0, 0.0, 1.0])
}

fn huge(t: f64) -> ([f64; 3], [f64; 4]) {
    (
        [32.0 * t, -6.0 * t + 20.0 * sin(0.2 * t), 12.0 * t],
        about([0.0, 0.0, 1.0], 3.0 * t),
    )
}

fn tiny(t: f64) -> ([f64; 3], [f64; 4]) {
    (
        [12.0 + 3e-5 * sin(9.0 * t), 7.0 - 4e-4 * t, 3e-5 * t],
        about([0.0, 0.0, 1.0], 4.0 * t),
    )
}

fn plate(size: [f64; 3]) -> Mesh {
    let corner = |i: usize, a: usize| {
        if i >> a & 1 == 1 {
            0.5 * size[a]
        } else {
            -0.5 * size[a]
        }
    };
    let vertices = (0..8)
        .map(|i| [corner(i, 0), corner(i, 1), corner(i, 2)])
        .collect();
    let quads: [[u32; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    (vertices, quads.into_iter().flat_map(halves).collect())
}

/// 16 x 32 facets, 960 triangles.
fn ellipsoid(half_axes: [f64; 3]) -> Mesh {
    let (rings, around) = (16u32, 32u32);
    let pi = std::f64::consts::PI;
    let mut vertices = vec![[0.0, half_axes[1], 0.0]];
    for i in 1..rings {
        for j in 0..around {
            let polar = pi * f64::from(i) / f64::from(rings);
            let azimuth = 2.0 * pi * f64::from(j) / f64::from(around);
            let unit = [
                sin(polar) * sin(azimuth),
                cos(polar),
                sin(polar) * cos(azimuth),
            ];
            vertices.push(std::array::from_fn(|a| unit[a] * half_axes[a]));
        }
    }
    vertices.push([0.0, -half_axes[1], 0.0]);
    let last = vertices.len() as u32 - 1;
    let at = |i: u32, j: u32| match i {
        0 => 0,
        i if i == rings => last,
        i => 1 + (i - 1) * around + j % around,
    };
    let mut triangles = Vec::new();
    for i in 0..rings {
        for j in 0..around {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend(
                [[a, b, c], [a, c, d]]
                    .into_iter()
                    .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]),
            );
        }
    }
    (vertices, triangles)
}
