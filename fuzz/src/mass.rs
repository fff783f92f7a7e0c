//! From a damaged mesh to its added mass.

use std::sync::LazyLock;

use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{self, AddedMass, added_mass};
use langevin_rigid_bake::mesh::{Options, repair};
use langevin_rigid_bake::shapes::Shape;

use crate::numbers::Numbers;

/// Most triangles of a mesh that is made.
const TRIANGLES: usize = 100;
/// Most changes of a sound mesh.
const CHANGES: usize = 12;

/// Meshed and solved coarsely: what goes wrong does so on few triangles, too.
const COARSE: added_mass::Options = added_mass::Options {
    target_triangles: 50,
    max_triangles: 600,
};

/// Makes a mesh of the bytes, mends it, and solves for its added mass.
pub(crate) fn repair_and_solve(bytes: &[u8]) {
    let numbers = &mut Numbers::new(bytes);
    let soup = soup(numbers);
    let options = options(numbers, soup.size());
    let body = match repair(&soup.vertices, &soup.triangles, &options, &()).body {
        Err(error) => return assert!(!error.to_string().is_empty()),
        Ok(body) => body,
    };
    assert!(body.volume() > 0.0 && body.volume().is_finite());
    let again = repair(body.vertices(), body.triangles(), &Options::default(), &());
    assert_eq!(again.steps, []);
    let again = again.body.unwrap();
    assert_eq!(again.vertices(), body.vertices());
    assert_eq!(again.triangles(), body.triangles());
    match added_mass(&body, &COARSE, &()) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(result) => check(&result),
    }
}

/// Makes the sound meshes.
pub(crate) fn prepare() {
    LazyLock::force(&SOUND);
}

/// Finite, symmetric to the bit, and no translation of negative energy beyond the error that it states.
fn check(result: &AddedMass) {
    let (tensor, error) = (&result.tensor, result.error_estimate);
    let largest = (0..3).map(|i| tensor[i][i]).fold(0.0, f64::max);
    assert!(largest > 0.0 && error >= 0.0, "{error}: {tensor:?}");
    for i in 0..6 {
        assert!(
            i >= 3 || tensor[i][i] >= -error * largest,
            "{error}: {tensor:?}"
        );
        for j in 0..6 {
            assert!(tensor[i][j].is_finite(), "{tensor:?}");
            assert_eq!(tensor[i][j].to_bits(), tensor[j][i].to_bits(), "{tensor:?}");
        }
    }
    let potentials = result.surface.potentials.as_flattened();
    assert!(potentials.iter().all(|x| x.is_finite()));
}

struct Soup {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// Triangles at random, or a sound mesh with some of it changed, at any scale.
fn soup(numbers: &mut Numbers) -> Soup {
    let mut soup = match numbers.below(4) {
        0 => at_random(numbers),
        _ => changed(numbers),
    };
    let scale = 10f64.powi(i32::from(numbers.any::<i8>()) / 4);
    for x in soup.vertices.as_flattened_mut() {
        *x *= scale;
    }
    soup
}

fn at_random(numbers: &mut Numbers) -> Soup {
    let (vertices, triangles) = (numbers.below(TRIANGLES), numbers.below(TRIANGLES));
    Soup {
        vertices: (0..vertices)
            .map(|_| [(); 3].map(|()| numbers.coordinate()))
            .collect(),
        triangles: (0..triangles)
            .map(|_| [(); 3].map(|()| numbers.below(vertices + 1) as u32))
            .collect(),
    }
}

static SOUND: LazyLock<Vec<TriMesh>> = LazyLock::new(|| {
    let [radius, thickness] = [1.0, 0.1];
    let shapes = [
        (
            Shape::Box {
                size: [2.0, 1.0, 0.5],
            },
            12,
        ),
        (
            Shape::Box {
                size: [1.0, 1.0, 0.01],
            },
            28,
        ),
        (
            Shape::Ellipsoid {
                semi_axes: [1.0, 0.5, 0.5],
            },
            20,
        ),
        (
            Shape::Ellipsoid {
                semi_axes: [1.0, 1.0, 1.0],
            },
            80,
        ),
        (
            Shape::Cylinder {
                radius,
                height: 1.0,
            },
            80,
        ),
        (
            Shape::Leaf {
                length: 1.0,
                width: 0.5,
                thickness,
            },
            64,
        ),
    ];
    let made = shapes.map(|(shape, triangles)| shape.mesh(triangles).unwrap());
    made.to_vec()
});

fn changed(numbers: &mut Numbers) -> Soup {
    let sound = &SOUND[numbers.below(SOUND.len())];
    let mut soup = Soup {
        vertices: sound.vertices().to_vec(),
        triangles: sound.triangles().to_vec(),
    };
    for axis in 0..3 {
        let stretch = 2f64.powi(i32::from(numbers.any::<i8>()) / 4);
        soup.vertices.iter_mut().for_each(|v| v[axis] *= stretch);
    }
    for _ in 0..numbers.below(CHANGES) {
        change(&mut soup, numbers);
    }
    soup
}

fn change(soup: &mut Soup, numbers: &mut Numbers) {
    let (v, t) = (
        numbers.below(soup.vertices.len()),
        numbers.below(soup.triangles.len()),
    );
    match numbers.below(7) {
        0 => soup.vertices[v][numbers.below(3)] = numbers.coordinate(),
        1 => soup.vertices[v] = soup.vertices[numbers.below(soup.vertices.len())],
        2 => soup.triangles[t].swap(0, 1),
        3 => soup.triangles[t][numbers.below(3)] = v as u32,
        4 => soup.triangles.push(soup.triangles[t]),
        5 if soup.triangles.len() > 1 => drop(soup.triangles.swap_remove(t)),
        _ => add_copy(soup, numbers),
    }
}

/// A copy of everything beside, across or inside it.
fn add_copy(soup: &mut Soup, numbers: &mut Numbers) {
    if 2 * soup.triangles.len() > TRIANGLES {
        return;
    }
    let count = soup.vertices.len() as u32;
    let (offset, scale) = ([(); 3].map(|()| numbers.coordinate()), numbers.coordinate());
    let moved = |v: &[f64; 3]| std::array::from_fn(|i| scale * v[i] + offset[i]);
    let vertices: Vec<[f64; 3]> = soup.vertices.iter().map(moved).collect();
    let triangles = soup.triangles.iter().map(|t| t.map(|v| v + count));
    let triangles: Vec<[u32; 3]> = triangles.collect();
    soup.vertices.extend(vertices);
    soup.triangles.extend(triangles);
}

impl Soup {
    /// The largest coordinate (m).
    fn size(&self) -> f64 {
        let coordinates = self.vertices.as_flattened().iter();
        coordinates.fold(0.0, |most, x| most.max(x.abs()))
    }
}

/// Choices for a mesh of that size; a wrap takes as long as it is fine, so that it is coarse here.
fn options(numbers: &mut Numbers, size: f64) -> Options {
    let mut given = |share: u8| numbers.any::<u8>() > u8::MAX - share;
    let [weld, fill, thickness, triangles, wrap, largest] =
        [32, 32, 64, 32, 16, 64].map(&mut given);
    Options {
        weld: weld.then(|| numbers.coordinate()),
        fill: fill.then(|| numbers.below(50)),
        thickness: thickness.then(|| numbers.coordinate()),
        triangles: triangles.then(|| numbers.below(TRIANGLES)),
        wrap: wrap.then(|| size * numbers.between(0.8, 2.0)),
        largest,
    }
}
