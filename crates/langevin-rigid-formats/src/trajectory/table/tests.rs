//! Tables that are whole, cut and damaged.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::State;
use langevin_rigid::linalg::quat_from_rotation_vector;
use proptest::prelude::*;

use super::*;

fn two_bodies() -> Vec<Trajectory> {
    let state = |time: f64, k: f64| State {
        time,
        position: [0.1 * k, -time / 3.0, 1e-9],
        velocity: [k, -0.3, 1.0 / 7.0],
        angular_velocity: [0.0, 1e10, k],
        ..State::default()
    };
    vec![
        Trajectory::new(0, &[state(0.0, 1.0), state(0.1, 1.0)]),
        Trajectory::new(7, &[state(0.0, 2.0)]),
    ]
}

fn table() -> String {
    let mut out = Vec::new();
    write_csv(&two_bodies(), &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn tables_read_back_to_the_last_bit() {
    assert_eq!(read_csv(&table()).unwrap(), two_bodies());
    assert_eq!(
        read_csv(&table().replace('\n', "\r\n")).unwrap(),
        two_bodies()
    );
}

#[test]
fn damage_is_named_with_its_line() {
    let fails = |table: &str| read_csv(table).unwrap_err().to_string();
    assert!(fails("time,x\n").starts_with("line 1: the columns"));
    assert!(fails(&format!("{CSV_HEADER}\n")).contains("no rows"));
    let fewer = table().replacen(",1\n", "\n", 1);
    assert!(fails(&fewer).starts_with("line 2: it has fewer"), "{fewer}");
    let odd = |old: &str, new: &str| fails(&table().replacen(old, new, 1));
    for bad in ["zero", "inf", "NaN", "-infinity", "1e13", ""] {
        let message = odd("\n0,0.1,", &format!("\n0,{bad},"));
        assert!(
            message.starts_with(&format!("line 3: `{bad}` is not a number")),
            "{message}"
        );
    }
    let message = odd(",10000000000,", ",inf,");
    assert!(
        message.starts_with("line 2: `inf` is not a number"),
        "{message}"
    );
    assert!(odd("0,0,0,1,1,", "0,3,0,2,1,").contains("line 2: its quaternion"));
    assert!(odd("\n0,0.1,", "\n0,0,").contains("line 3: its time, 0 s, is not after"));
    assert!(odd("\n7,", "\n-7,").starts_with("line 4: `-7` is no number of a body"));
    let again = table() + table().lines().nth(1).unwrap() + "\n";
    assert!(fails(&again).starts_with("line 5: body 0 comes back"));
}

#[test]
fn a_table_that_ends_within_a_line_is_refused_there() {
    let table = table();
    for end in 0..table.len() {
        let lines = table[..end].matches('\n').count();
        let whole = table[..end].ends_with('\n');
        match read_csv(&table[..end]) {
            Ok(read) => {
                assert!(whole && lines > 1);
                assert_eq!(read.iter().map(Trajectory::len).sum::<usize>(), lines - 1);
            }
            Err(TableError::Header) => assert!(end < CSV_HEADER.len()),
            Err(TableError::Empty) => assert!(lines <= 1),
            Err(TableError::Cut { line }) => assert!(!whole && line == lines + 1),
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn rows_of_many_bodies_and_bodies_of_many_rows_are_read() {
    let still = |time: f64| State {
        time,
        ..State::default()
    };
    let mut bodies: Vec<Trajectory> = (0..200_000)
        .map(|body| Trajectory::new(body, &[still(0.0)]))
        .collect();
    let long: Vec<State> = (0..70_001).map(|i| still(f64::from(i))).collect();
    bodies.push(Trajectory::new(u32::MAX, &long));
    let mut table = Vec::new();
    write_csv(&bodies, &mut table).unwrap();
    assert_eq!(
        read_csv(&String::from_utf8(table).unwrap()).unwrap(),
        bodies
    );
}

fn states() -> impl Strategy<Value = Vec<State>> {
    let x = || -1e12..1e12f64;
    let vector = move || [x(), x(), x()];
    let state = (
        vector(),
        [-9.0..9.0f64, -9.0..9.0, -9.0..9.0],
        [-1e5..1e5f64, -1e5..1e5, -1e5..1e5],
        1e-6..1e6f64,
    );
    prop::collection::vec(state, 1..9).prop_map(|rows| {
        let mut time = 0.0;
        let mut state = |(position, turn, velocity, pause): ([f64; 3], _, [f64; 3], f64)| {
            time += pause;
            State {
                time,
                position,
                orientation: quat_from_rotation_vector(turn),
                velocity,
                angular_velocity: velocity,
                ..State::default()
            }
        };
        rows.into_iter().map(&mut state).collect()
    })
}

proptest! {
    #[test]
    fn any_run_is_read_as_it_was_written(
        bodies in prop::collection::btree_map(any::<u32>(), states(), 1..5),
    ) {
        let bodies: Vec<Trajectory> =
            bodies.iter().map(|(body, states)| Trajectory::new(*body, states)).collect();
        let mut table = Vec::new();
        write_csv(&bodies, &mut table).unwrap();
        prop_assert_eq!(read_csv(&String::from_utf8(table).unwrap()).unwrap(), bodies);
    }

    #[test]
    fn no_damage_makes_a_table_panic_or_lets_it_out_of_range(
        overwrites in prop::collection::vec(
            (any::<prop::sample::Index>(), prop::sample::select(b"0123456789.-+einfaN,\n\r \"".to_vec())),
            1..12,
        ),
    ) {
        let mut bytes = table().into_bytes();
        for (place, byte) in overwrites {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        for trajectory in read_csv(&String::from_utf8(bytes).unwrap()).unwrap_or_default() {
            let track = crate::track::Track::new(&trajectory.poses);
            prop_assert!(track.is_ok(), "{:?}", track);
            prop_assert!(trajectory.poses.is_sorted_by(|a, b| a.time < b.time));
            let rates = trajectory.velocities.iter().chain(&trajectory.angular_velocities);
            prop_assert!(rates.flatten().all(|x| x.is_finite()));
        }
    }
}
