#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::io::Write;
use std::path::Path;

use npyz::{AutoSerialize, WriterBuilder};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::*;
use crate::wind_table::{parse_wind_table, read_wind_table};

struct Npz(ZipWriter<Cursor<Vec<u8>>>);

impl Npz {
    fn new() -> Self {
        Self(ZipWriter::new(Cursor::new(Vec::new())))
    }

    fn with<T: AutoSerialize>(
        mut self,
        name: &str,
        shape: &[u64],
        order: Order,
        values: impl IntoIterator<Item = T>,
    ) -> Self {
        let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
        self.0
            .start_file(file_name_from_array_name(name), stored)
            .unwrap();
        let options = npyz::WriteOptions::new()
            .default_dtype()
            .shape(shape)
            .order(order);
        let mut array = options.writer(&mut self.0).begin_nd().unwrap();
        array.extend(values).unwrap();
        array.finish().unwrap();
        self
    }

    fn grid() -> Self {
        Self::new()
            .with("origin", &[3], Order::C, [0.0, 1.0, 2.0])
            .with("spacing", &[3], Order::C, [0.5, 1.0, 2.0f32])
    }

    fn bytes(self) -> Vec<u8> {
        self.0.finish().unwrap().into_inner()
    }
}

/// u = (x, y, z) at the points of a grid of 3 x 2 x 2.
fn velocities() -> Vec<f64> {
    let point = |n: usize| {
        [
            0.5 * (n / 4) as f64,
            1.0 + (n / 2 % 2) as f64,
            2.0 + 2.0 * (n % 2) as f64,
        ]
    };
    (0..12).flat_map(point).collect()
}

const PLACE: Vec3 = [0.6, 1.3, 3.1];

fn near(a: Vec3, b: Vec3) -> bool {
    (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12)
}

#[test]
fn grids_are_read_in_either_order_and_precision() {
    let shape = [3, 2, 2, 3];
    let rows = velocities();
    let table = Npz::grid().with("velocity", &shape, Order::C, rows.clone());
    let table = parse_wind_table(&table.bytes()).unwrap();
    assert!(near(table.velocity(PLACE, 0.0), PLACE));

    // The same with the first index fastest.
    let mut columns = Vec::new();
    for component in 0..3 {
        for k in 0..2 {
            for j in 0..2 {
                for i in 0..3 {
                    columns.push(rows[((i * 2 + j) * 2 + k) * 3 + component] as f32);
                }
            }
        }
    }
    let fortran = Npz::grid().with("velocity", &shape, Order::Fortran, columns);
    assert_eq!(parse_wind_table(&fortran.bytes()).unwrap(), table);

    let twice = rows.iter().copied().chain(rows.iter().map(|x| 3.0 * x));
    let timed = Npz::grid()
        .with("velocity", &[2, 3, 2, 2, 3], Order::C, twice)
        .with("time", &[2], Order::C, [0.0, 2.0]);
    let timed = parse_wind_table(&timed.bytes()).unwrap();
    assert!(near(timed.velocity(PLACE, 1.0), PLACE.map(|x| 2.0 * x)));
}

#[test]
fn what_is_no_table_is_told() {
    let told = |bytes: Vec<u8>| parse_wind_table(&bytes).unwrap_err().to_string();
    let shape = [3, 2, 2, 3];
    let with =
        |name, shape: &[u64], values: Vec<f64>| Npz::grid().with(name, shape, Order::C, values);
    for (bytes, words) in [
        (b"no".to_vec(), "it is no NPZ file"),
        (
            Npz::new().bytes(),
            "it has no array `origin`, the first point",
        ),
        (Npz::grid().bytes(), "it has no array `velocity`"),
        (
            with("velocity", &[36], velocities()).bytes(),
            "has the shape [36], and must have (nx, ny, nz, 3)",
        ),
        (
            with("velocity", &[1, 3, 2, 2, 3], velocities()).bytes(),
            "it has no array `time`",
        ),
        (
            with("velocity", &shape, vec![f64::NAN; 36]).bytes(),
            "velocity number 0 of the grid is not finite",
        ),
        (
            Npz::grid()
                .with("velocity", &shape, Order::C, vec![1i32; 36])
                .bytes(),
            "its numbers are '<i4', and must be floats",
        ),
        (
            Npz::new()
                .with("origin", &[2], Order::C, [0.0, 1.0])
                .bytes(),
            "must have 3 numbers",
        ),
    ] {
        let told = told(bytes);
        assert!(told.contains(words), "{told}");
    }
    // As it is marked in both headers of the first array.
    let mut compressed = Npz::grid().bytes();
    let central = compressed
        .windows(4)
        .position(|bytes| bytes == b"PK\x01\x02");
    for place in [8, central.unwrap() + 10] {
        compressed[place] = 8;
    }
    let words = "its array `origin` is compressed: write it with numpy.savez";
    assert!(told(compressed).starts_with(words));
    let path = Path::new("no/such.npz");
    assert!(
        read_wind_table(path)
            .unwrap_err()
            .to_string()
            .contains("such.npz: ")
    );
}

#[test]
fn damage_at_any_byte_panics_nowhere() {
    let whole = Npz::grid()
        .with("velocity", &[3, 2, 2, 3], Order::C, velocities())
        .bytes();
    for place in 0..whole.len() {
        let _ = parse_wind_table(&whole[..place]);
        for byte in [0, 0xFF, b'9'] {
            let mut damaged = whole.clone();
            damaged[place] = byte;
            let _ = parse_wind_table(&damaged);
        }
    }
    // A shape that no file holds.
    let mut huge = Npz::grid();
    let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    huge.0.start_file("velocity.npy", stored).unwrap();
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999, 99999999, 9, 3), }";
    let header = format!("{header:<117}\n");
    huge.0.write_all(b"\x93NUMPY\x01\x00").unwrap();
    huge.0
        .write_all(&(header.len() as u16).to_le_bytes())
        .unwrap();
    huge.0.write_all(header.as_bytes()).unwrap();
    let told = parse_wind_table(&huge.bytes()).unwrap_err().to_string();
    assert!(told.contains("more numbers than the file holds"), "{told}");
}
