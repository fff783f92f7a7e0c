//! NumPy arrays in one file, each with a row for each pose of each body.

use std::borrow::Cow;
use std::io::{self, Seek, Write};

use langevin_rigid::linalg::Vec3;
use npyz::{AutoSerialize, DType, TypeStr, WriterBuilder, npz::file_name_from_array_name};
use zip::CompressionMethod::Stored;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::{Recording, Up};
use crate::track::Pose;
use crate::trajectory::Trajectory;

/// Bytes of an array beyond which the archive needs its 64-bit form.
const LARGE: u64 = 1 << 31;

/// The arrays `body` (n), `t` (n), `position` (n, 3), `orientation` (n, 4), `velocity` and
/// `angular_velocity` (n, 3); where bodies differ in kind or size, `bodies`, `kind` and `scale` too, with a row
/// for each of the m bodies.
pub(super) fn write(recording: &Recording<'_>, up: Up, out: impl Write + Seek) -> io::Result<()> {
    let mut out = FirstError {
        out,
        error: None,
        place: 0,
        end: 0,
    };
    let written = archive(recording, up, &mut out);
    out.error.map_or(written, Err)
}

fn archive(recording: &Recording<'_>, up: Up, out: impl Write + Seek) -> io::Result<()> {
    let trajectories = recording.trajectories(up);
    let trajectories = || trajectories.iter().map(Cow::as_ref);
    let mut file = Archive {
        zip: ZipWriter::new(out),
        rows: trajectories().map(|t| t.len() as u64).sum(),
    };
    let bodies = trajectories().flat_map(|t| std::iter::repeat_n(t.body, t.len()));
    file.array("body", 1, bodies)?;
    let poses = || trajectories().flat_map(|t| &t.poses);
    file.array("t", 1, poses().map(|p| p.time))?;
    let flat = |of: fn(&Pose) -> &[f64]| poses().flat_map(of).copied();
    file.array("position", 3, flat(|p| &p.position))?;
    file.array("orientation", 4, flat(|p| &p.orientation))?;
    let flat = |of: fn(&Trajectory) -> &[Vec3]| {
        let vectors = trajectories().flat_map(of);
        vectors.flatten().copied()
    };
    file.array("velocity", 3, flat(|t| &t.velocities))?;
    file.array("angular_velocity", 3, flat(|t| &t.angular_velocities))?;
    if !recording.is_uniform() {
        let bodies = || recording.bodies.iter();
        file.rows = recording.bodies.len() as u64;
        file.array("bodies", 1, bodies().map(|b| b.trajectory.body))?;
        file.texts("kind", bodies().map(|b| recording.kind_of(b).name))?;
        file.array("scale", 1, bodies().map(|b| b.scale))?;
    }
    file.zip.finish()?;
    Ok(())
}

struct Archive<W: Write + Seek> {
    zip: ZipWriter<W>,
    rows: u64,
}

impl<W: Write + Seek> Archive<W> {
    /// A matrix row by row; a vector has one column.
    fn array<T: AutoSerialize>(
        &mut self,
        name: &str,
        columns: u64,
        values: impl Iterator<Item = T>,
    ) -> io::Result<()> {
        self.typed(name, &T::default_dtype(), columns, values)
    }

    /// A vector of texts, as long as the longest of them.
    fn texts<'t>(
        &mut self,
        name: &str,
        texts: impl Iterator<Item = &'t str> + Clone,
    ) -> io::Result<()> {
        let longest = texts.clone().map(|text| text.chars().count()).max();
        let kind = format!("<U{}", longest.unwrap_or(0).max(1));
        let kind: TypeStr = kind.parse().map_err(io::Error::other)?;
        self.typed(name, &DType::Plain(kind), 1, texts.map(str::to_owned))
    }

    fn typed<T: npyz::Serialize>(
        &mut self,
        name: &str,
        kind: &DType,
        columns: u64,
        values: impl Iterator<Item = T>,
    ) -> io::Result<()> {
        let bytes = kind.num_bytes().unwrap_or(0) as u64;
        let options = SimpleFileOptions::default()
            .compression_method(Stored)
            .large_file(bytes * columns * self.rows > LARGE);
        self.zip
            .start_file(file_name_from_array_name(name), options)?;
        let shape = [self.rows, columns];
        let mut array = npyz::WriteOptions::new()
            .dtype(kind.clone())
            .shape(if columns == 1 { &shape[..1] } else { &shape })
            .writer(&mut self.zip)
            .begin_nd()?;
        array.extend(values)?;
        array.finish()
    }
}

/// Keeps the first error of `out`, which begins empty. Nothing is written after it, and the archive is none the
/// wiser: it would try to end itself all the same, and print that it cannot.
struct FirstError<W> {
    out: W,
    error: Option<io::Error>,
    place: u64,
    end: u64,
}

impl<W> FirstError<W> {
    fn until_error<T>(&mut self, work: impl FnOnce(&mut W) -> io::Result<T>) {
        if self.error.is_none() {
            self.error = work(&mut self.out).err();
        }
    }
}

impl<W: Write> Write for FirstError<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.until_error(|out| out.write_all(bytes));
        self.place += bytes.len() as u64;
        self.end = self.end.max(self.place);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.until_error(Write::flush);
        Ok(())
    }
}

impl<W: Seek> Seek for FirstError<W> {
    fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
        self.until_error(|out| out.seek(to));
        self.place = match to {
            io::SeekFrom::Start(place) => place,
            io::SeekFrom::Current(by) => self.place.saturating_add_signed(by),
            io::SeekFrom::End(by) => self.end.saturating_add_signed(by),
        };
        Ok(self.place)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use langevin_rigid::State;

    use super::super::RecordedBody;
    use super::super::tests::recorded as of;
    use super::*;

    #[test]
    fn a_full_disk_is_told_wherever_it_fills() {
        let trajectories = [Trajectory::new(0, &[State::default(); 3])];
        let bodies = [RecordedBody::from(&trajectories[0])];
        let mut whole = Cursor::new(Vec::new());
        let arrays = |out: &mut Cursor<Vec<u8>>| of(&bodies, |run| write(run, Up::Y, out));
        arrays(&mut whole).unwrap();
        let length = whole.get_ref().len();
        of(&bodies, |run| {
            for room in (0..length).step_by(7) {
                let mut full = Cursor::new(vec![0; room]);
                let error = write(run, Up::Y, Cursor::new(full.get_mut().as_mut_slice()));
                assert_eq!(
                    error.unwrap_err().kind(),
                    io::ErrorKind::WriteZero,
                    "{room}"
                );
            }
        });
    }
}
