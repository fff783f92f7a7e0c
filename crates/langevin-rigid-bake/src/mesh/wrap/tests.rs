use super::*;
#[cfg(feature = "meshopt")]
use crate::mesh::intersect::meetings;
use crate::shapes::Shape;

fn wrapped(mesh: &TriMesh, size: f64) -> TriMesh {
    wrap(mesh.vertices(), mesh.triangles(), size).unwrap().body
}

#[test]
fn a_ball_and_a_box_keep_their_volume() {
    let ball = Shape::Ellipsoid {
        semi_axes: [1.0; 3],
    }
    .mesh(1280)
    .unwrap();
    let brick = Shape::Box {
        size: [2.0, 1.0, 0.5],
    }
    .mesh(12)
    .unwrap();
    for mesh in [ball, brick] {
        let wrap = wrapped(&mesh, 0.05);
        let bias = wrap.volume() / mesh.volume() - 1.0;
        assert!(bias.abs() < 0.01, "{bias}");
    }
}

/// A shell with a slot gets an inside only where the slot is wider than the wrap closes.
#[test]
fn gaps_are_closed_up_to_the_size() {
    let brick = Shape::Box { size: [1.0; 3] }.mesh(4800).unwrap();
    let in_slot = |t: &[u32; 3]| {
        let centre = t.map(|v| brick.vertices()[v as usize]);
        let [x, y, z] = [0, 1, 2].map(|k| centre.iter().map(|p| p[k]).sum::<f64>() / 3.0);
        z > 0.499 && x.abs() < 0.1 && y.abs() < 0.3
    };
    let open: Vec<[u32; 3]> = brick
        .triangles()
        .iter()
        .copied()
        .filter(|t| !in_slot(t))
        .collect();
    assert!(open.len() < brick.triangles().len());
    let volume = |size| wrap(brick.vertices(), &open, size).unwrap().body.volume();
    // The slot is 0.2 wide.
    assert!((volume(0.3) - 1.0).abs() < 0.05, "{}", volume(0.3));
    assert!(volume(0.05) < 0.4, "{}", volume(0.05));
    let made = wrap(brick.vertices(), &open, 0.3).unwrap().made;
    assert!(made > 0.02 && made < 0.2, "{made}");
}

/// The hollow box with a slot again: a wrap that the water enters says so, and names a size that it does not.
#[test]
fn a_wrap_that_the_fluid_enters_says_so() {
    let brick = Shape::Box { size: [1.0; 3] }.mesh(4800).unwrap();
    let in_slot = |t: &[u32; 3]| {
        let centre = t.map(|v| brick.vertices()[v as usize]);
        let [x, y, z] = [0, 1, 2].map(|k| centre.iter().map(|p| p[k]).sum::<f64>() / 3.0);
        z > 0.499 && x.abs() < 0.05 && y.abs() < 0.3
    };
    let mut open = brick.triangles().to_vec();
    open.retain(|t| !in_slot(t));
    let leak = wrap(brick.vertices(), &open, 0.04).unwrap().leak.unwrap();
    assert!(leak.coarser > 1.1 * leak.volume, "{leak:?}");
    let advised = leak.advised.unwrap();
    assert!(leak.to_string().contains(&format!("--wrap {advised}")));
    let tight = wrap(brick.vertices(), &open, advised).unwrap();
    assert!((tight.body.volume() - 1.0).abs() < 0.05);
    assert_eq!(tight.leak, None);
}

/// Nothing leaks where nothing is open: round and sharp, convex and not, at fine and coarse sizes.
#[test]
fn a_wrap_of_a_closed_body_does_not_leak() {
    let semi_axes = [1.0, 0.8, 0.5];
    let ball = Shape::Ellipsoid { semi_axes }.mesh(1280).unwrap();
    let size = [2.0, 1.0, 0.5];
    let brick = Shape::Box { size }.mesh(12).unwrap();
    for mesh in [ball, brick] {
        for size in [0.05, 0.1, 0.3, 1.0, 5.0, 1e300] {
            let leak = wrap(mesh.vertices(), mesh.triangles(), size)
                .ok()
                .and_then(|w| w.leak);
            assert_eq!(leak, None, "{size}");
        }
    }
}

#[test]
fn an_open_sheet_becomes_about_half_as_thick_as_the_size() {
    let corners = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let sheet = wrap(&corners, &[[0, 1, 2], [0, 2, 3]], 0.1).unwrap();
    // A wrap of twice the size is twice as thick.
    assert!(sheet.leak.is_some());
    let thickness = sheet.body.volume() / 1.0;
    assert!((0.04..0.065).contains(&thickness), "{thickness}");
}

#[test]
fn sizes_that_are_none_and_too_fine_ones_are_refused() {
    let cube = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    let refused = |size| wrap(cube.vertices(), cube.triangles(), size).err().unwrap();
    for size in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(size), WrapError::BadSize(_)), "{size}");
    }
    assert!(matches!(
        wrap(&[], &[], 0.1).err(),
        Some(WrapError::Nothing)
    ));
    let fine = refused(1e-4);
    let WrapError::TooFine { advised, .. } = fine else {
        panic!("{fine}");
    };
    let said = format!("take {advised:.1e} m or more");
    assert!(fine.to_string().contains(&said), "{fine}");
    assert_eq!(
        format!("{advised:.1e}").parse::<f64>().unwrap() / advised,
        1.0
    );
    // What is advised is within the limit.
    let corners: Vec<_> = cube
        .triangles()
        .iter()
        .map(|t| t.map(|v| cube.vertices()[v as usize]))
        .collect();
    let (nodes, _) = Grid::lattice(&corners, 0.5 * advised / OFFSET).unwrap();
    assert!(nodes <= MOST_NODES && nodes > 0.7 * MOST_NODES, "{nodes:e}");
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let ball = Shape::Ellipsoid {
        semi_axes: [1.0, 0.5, 0.3],
    }
    .mesh(1280)
    .unwrap();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| wrapped(&ball, 0.07))
    };
    let (one, four) = (on(1), on(4));
    assert_eq!(one.vertices(), four.vertices());
    assert_eq!(one.triangles(), four.triangles());
}

/// Two walls so near that triangles of few vertices would pass through each other.
#[cfg(feature = "meshopt")]
#[test]
fn a_wrap_is_simplified_without_meeting_itself() {
    let ball = Shape::Ellipsoid {
        semi_axes: [1.0, 1.0, 0.6],
    }
    .mesh(1280)
    .unwrap();
    let plates = Shape::Box {
        size: [2.4, 0.2, 0.01],
    }
    .mesh(12)
    .unwrap();
    let count = ball.vertices().len() as u32;
    let vertices = [ball.vertices(), plates.vertices()].concat();
    let more = plates.triangles().iter().map(|t| t.map(|v| v + count));
    let triangles: Vec<_> = ball.triangles().iter().copied().chain(more).collect();
    let fine = wrap(&vertices, &triangles, 0.04).unwrap().body;
    let proxy = fine.proxy(500).unwrap();
    assert!(proxy.triangles().len() < fine.triangles().len() / 4);
    assert_eq!(meetings(proxy.vertices(), proxy.triangles()), []);
    assert!((proxy.volume() / fine.volume() - 1.0).abs() < 1e-12);
}
