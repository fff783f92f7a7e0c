//! The bake: what the precomputation hands to the run time, as bytes.
//!
//! Layout, little-endian: the eight bytes of `MAGIC`, the format's version (u32), the length of the
//! payload (u64), the fingerprint of what was baked (32 bytes), the payload, and the 64-bit FNV-1a
//! hash of all before it. The payload is [`Body`], an optional [`TurbulenceHistory`], the error
//! estimate and the warnings, field by field; lists carry their length (u32) before them.

use crate::body::{Body, BodyError, Separation, Slice, Surface};
use crate::turbulence::{HistoryError, TurbulenceHistory};

/// The line ends catch transfers that rewrite text.
const MAGIC: [u8; 8] = *b"LRBAKE\r\n";
const VERSION: u32 = 2;
const HEADER: usize = 8 + 4 + 8 + 32;
const CHECKSUM: usize = 8;

/// A baked body and, where the scene has one, its turbulence history.
///
/// ```
/// # use langevin_rigid::{Bake, Body};
/// # let body = Body { mass: 1.0, inertia: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
/// #     volume: 1.0, centre_of_buoyancy: [0.0; 3], added_mass: [[0.0; 6]; 6],
/// #     half_extents: [1.0; 3], thickness: 1.0, length: 1.0, separation: Default::default(),
/// #     slices: vec![], surface: Default::default() };
/// let bake = Bake {
///     body, history: None, error_estimate: 1e-4, warnings: vec![], fingerprint: [0; 32],
/// };
/// let bytes = bake.to_bytes();
/// assert_eq!(Bake::from_bytes(&bytes)?, bake);
/// # Ok::<(), langevin_rigid::BakeError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Bake {
    /// The body.
    pub body: Body,
    /// Turbulence at the body, for the sources that sample a history.
    pub history: Option<TurbulenceHistory>,
    /// Estimated relative error of the added mass.
    pub error_estimate: f64,
    /// What the precomputation warned about, a sentence each.
    pub warnings: Vec<String>,
    /// Hash of everything that this bake was made from; a bake with the same one need not be made
    /// again.
    pub fingerprint: [u8; 32],
}

/// Why bytes are not a bake.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// The bytes are something else.
    #[error("this is not a Langevin Rigid bake (it does not begin with `LRBAKE`)")]
    Foreign,
    /// The file is of another version.
    #[error(
        "this bake has format version {found}, and this program reads version {VERSION}; bake the body again with this program"
    )]
    Version {
        /// Version of the bytes.
        found: u32,
    },
    /// There are fewer or more bytes than the header says.
    #[error(
        "this bake is {found} bytes long where its header says {expected}; it was cut off or added to: bake the body again"
    )]
    Length {
        /// Bytes there are.
        found: u64,
        /// Bytes there should be.
        expected: u64,
    },
    /// The bytes were changed after they were written.
    #[error("this bake is corrupt (its checksum does not match); bake the body again")]
    Checksum,
    /// The contents contradict each other.
    #[error("this bake is corrupt ({0}); bake the body again")]
    Contents(&'static str),
    /// The body in it is impossible.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The turbulence in it is impossible.
    #[error(transparent)]
    History(#[from] HistoryError),
}

impl Bake {
    /// The bytes of a bake file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut payload = Writer::default();
        payload.body(&self.body);
        payload.history(self.history.as_ref());
        payload.numbers(&[self.error_estimate]);
        payload.texts(&self.warnings);
        let mut bytes = Vec::with_capacity(HEADER + payload.0.len() + CHECKSUM);
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&(payload.0.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&self.fingerprint);
        bytes.extend_from_slice(&payload.0);
        bytes.extend_from_slice(&fnv1a(&bytes).to_le_bytes());
        bytes
    }

    /// Reads the bytes of a bake file.
    ///
    /// # Errors
    /// See [`BakeError`]; nothing is trusted before the length and the checksum agree.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, BakeError> {
        let fingerprint = check_envelope(bytes)?;
        let mut reader = Reader(&bytes[HEADER..bytes.len() - CHECKSUM]);
        let body = reader.body()?;
        let history = reader.history()?;
        let error_estimate = reader.number()?;
        let warnings = reader.texts()?;
        if !reader.0.is_empty() {
            return Err(BakeError::Contents("bytes are left over"));
        }
        body.check()?;
        if let Some(history) = &history {
            history.check()?;
        }
        Ok(Self {
            body,
            history,
            error_estimate,
            warnings,
            fingerprint,
        })
    }
}

/// Checks everything around the payload and returns the fingerprint.
fn check_envelope(bytes: &[u8]) -> Result<[u8; 32], BakeError> {
    if !bytes.starts_with(&MAGIC) {
        return Err(BakeError::Foreign);
    }
    let found = bytes.len() as u64;
    let mut header = Reader(&bytes[MAGIC.len()..]);
    let smallest = (HEADER + CHECKSUM) as u64;
    let short = |_| BakeError::Length {
        found,
        expected: smallest,
    };
    let version = header.u32().map_err(short)?;
    if version != VERSION {
        return Err(BakeError::Version { found: version });
    }
    let payload = u64::from_le_bytes(header.take().map_err(short)?);
    let expected = payload.saturating_add(smallest);
    if found != expected {
        return Err(BakeError::Length { found, expected });
    }
    let fingerprint = header.take().map_err(short)?;
    let (content, checksum) = bytes.split_at(bytes.len() - CHECKSUM);
    if fnv1a(content).to_le_bytes() != checksum {
        return Err(BakeError::Checksum);
    }
    Ok(fingerprint)
}

/// The 64-bit FNV-1a hash (Fowler, Noll, Vo).
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}

#[derive(Default)]
struct Writer(Vec<u8>);

impl Writer {
    fn numbers(&mut self, numbers: &[f64]) {
        for x in numbers {
            self.0.extend_from_slice(&x.to_le_bytes());
        }
    }

    fn count(&mut self, length: usize) {
        // Meshes are indexed by u32, so no list is longer.
        self.0.extend_from_slice(&(length as u32).to_le_bytes());
    }

    fn list<const N: usize>(&mut self, rows: &[[f64; N]]) {
        self.count(rows.len());
        self.numbers(rows.as_flattened());
    }

    fn triangles(&mut self, triangles: &[[u32; 3]]) {
        self.count(triangles.len());
        for v in triangles.as_flattened() {
            self.0.extend_from_slice(&v.to_le_bytes());
        }
    }

    fn texts(&mut self, texts: &[String]) {
        self.count(texts.len());
        for text in texts {
            self.count(text.len());
            self.0.extend_from_slice(text.as_bytes());
        }
    }

    fn body(&mut self, body: &Body) {
        self.numbers(&[body.mass, body.volume, body.thickness, body.length]);
        self.numbers(body.inertia.as_flattened());
        self.numbers(&body.centre_of_buoyancy);
        self.numbers(body.added_mass.as_flattened());
        self.numbers(&body.half_extents);
        let separation = &body.separation;
        for tensor in [
            &separation.drag_area,
            &separation.extents,
            &separation.stokes_translation,
            &separation.stokes_rotation,
        ] {
            self.numbers(tensor.as_flattened());
        }
        self.slices(&body.slices);
        self.list(&body.surface.vertices);
        self.triangles(&body.surface.triangles);
        self.triangles(&body.surface.panels);
        self.list(&body.surface.potentials);
    }

    fn slices(&mut self, slices: &[Slice]) {
        self.count(slices.len());
        for slice in slices {
            self.numbers(&slice.centre);
            for tensor in [
                &slice.translation,
                &slice.rotation,
                &slice.drag_area,
                &slice.extents,
            ] {
                self.numbers(tensor.as_flattened());
            }
        }
    }

    fn history(&mut self, history: Option<&TurbulenceHistory>) {
        self.0.push(u8::from(history.is_some()));
        if let Some(h) = history {
            self.numbers(&[h.interval, h.inflow_speed, h.length]);
            self.list(h.k.as_chunks::<1>().0);
            self.list(h.epsilon.as_chunks::<1>().0);
        }
    }
}

struct Reader<'a>(&'a [u8]);

/// Bytes of a slice: a point and four tensors.
const SLICE: usize = 8 * (3 + 4 * 9);

const SHORT: BakeError = BakeError::Contents("it ends within a field");

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], BakeError> {
        let (head, rest) = self.0.split_first_chunk().ok_or(SHORT)?;
        self.0 = rest;
        Ok(*head)
    }

    fn u32(&mut self) -> Result<u32, BakeError> {
        self.take().map(u32::from_le_bytes)
    }

    fn number(&mut self) -> Result<f64, BakeError> {
        let x = self.take().map(f64::from_le_bytes)?;
        if x.is_finite() {
            Ok(x)
        } else {
            Err(BakeError::Contents("a number is not finite"))
        }
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f64; N], BakeError> {
        let mut numbers = [0.0; N];
        for x in &mut numbers {
            *x = self.number()?;
        }
        Ok(numbers)
    }

    fn matrix<const N: usize>(&mut self) -> Result<[[f64; N]; N], BakeError> {
        let mut rows = [[0.0; N]; N];
        for row in &mut rows {
            *row = self.numbers()?;
        }
        Ok(rows)
    }

    /// A list of items of `size` bytes; its length is checked before anything is allocated.
    fn items<T>(
        &mut self,
        size: usize,
        mut item: impl FnMut(&mut Self) -> Result<T, BakeError>,
    ) -> Result<Vec<T>, BakeError> {
        let count = self.u32()? as usize;
        if count.saturating_mul(size) > self.0.len() {
            return Err(SHORT);
        }
        (0..count).map(|_| item(self)).collect()
    }

    fn list<const N: usize>(&mut self) -> Result<Vec<[f64; N]>, BakeError> {
        self.items(8 * N, Self::numbers)
    }

    fn triangles(&mut self) -> Result<Vec<[u32; 3]>, BakeError> {
        self.items(12, |r| Ok([r.u32()?, r.u32()?, r.u32()?]))
    }

    fn texts(&mut self) -> Result<Vec<String>, BakeError> {
        self.items(4, |r| {
            let bytes = r.items(1, |r| Ok(r.take::<1>()?[0]))?;
            String::from_utf8(bytes).map_err(|_| BakeError::Contents("a warning is no text"))
        })
    }

    fn body(&mut self) -> Result<Body, BakeError> {
        let [mass, volume, thickness, length] = self.numbers()?;
        Ok(Body {
            mass,
            volume,
            thickness,
            length,
            inertia: self.matrix()?,
            centre_of_buoyancy: self.numbers()?,
            added_mass: self.matrix()?,
            half_extents: self.numbers()?,
            separation: Separation {
                drag_area: self.matrix()?,
                extents: self.matrix()?,
                stokes_translation: self.matrix()?,
                stokes_rotation: self.matrix()?,
            },
            slices: self.items(SLICE, Self::slice)?,
            surface: Surface {
                vertices: self.list()?,
                triangles: self.triangles()?,
                panels: self.triangles()?,
                potentials: self.list()?,
            },
        })
    }

    fn slice(&mut self) -> Result<Slice, BakeError> {
        Ok(Slice {
            centre: self.numbers()?,
            translation: self.matrix()?,
            rotation: self.matrix()?,
            drag_area: self.matrix()?,
            extents: self.matrix()?,
        })
    }

    fn history(&mut self) -> Result<Option<TurbulenceHistory>, BakeError> {
        if self.take::<1>()? == [0] {
            return Ok(None);
        }
        let [interval, inflow_speed, length] = self.numbers()?;
        let k = self.list::<1>()?.into_flattened();
        let epsilon = self.list::<1>()?.into_flattened();
        if k.is_empty() || k.len() != epsilon.len() {
            return Err(BakeError::Contents(
                "the turbulence history is empty or uneven",
            ));
        }
        if !(interval > 0.0 && inflow_speed > 0.0 && length > 0.0) {
            return Err(BakeError::Contents("the turbulence history has no scale"));
        }
        Ok(Some(TurbulenceHistory {
            interval,
            inflow_speed,
            length,
            k,
            epsilon,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bake() -> Bake {
        let body = Body {
            mass: 0.5,
            inertia: [[2.0, 0.1, 0.0], [0.1, 3.0, 0.0], [0.0, 0.0, 4.0]],
            volume: 0.25,
            centre_of_buoyancy: [0.0, 0.01, 0.0],
            added_mass: std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j))),
            half_extents: [3.0, 2.0, 1.0],
            thickness: 2.0,
            length: 6.0,
            separation: Default::default(),
            slices: vec![Slice {
                centre: [0.1, 0.2, 0.3],
                ..Slice::default()
            }],
            surface: Surface {
                vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
                triangles: vec![[0, 1, 2]],
                panels: vec![[0, 1, 2], [0, 2, 1]],
                potentials: vec![[0.5; 6]; 3],
            },
        };
        let history = TurbulenceHistory {
            interval: 0.1,
            inflow_speed: 1.0,
            length: 0.01,
            k: vec![1.5, 1.0],
            epsilon: vec![20.0, 10.0],
        };
        Bake {
            body,
            history: Some(history),
            error_estimate: 2e-3,
            warnings: vec!["thin".into(), String::new()],
            fingerprint: [7; 32],
        }
    }

    #[test]
    fn bytes_read_back_as_written() {
        let with = bake();
        assert_eq!(Bake::from_bytes(&with.to_bytes()), Ok(with.clone()));
        let without = Bake {
            history: None,
            ..with
        };
        assert_eq!(Bake::from_bytes(&without.to_bytes()), Ok(without));
    }

    #[test]
    fn every_truncation_and_every_flipped_byte_is_an_error() {
        let bytes = bake().to_bytes();
        for end in 0..bytes.len() {
            assert!(Bake::from_bytes(&bytes[..end]).is_err(), "cut at {end}");
        }
        for place in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[place] ^= 0x10;
            assert!(Bake::from_bytes(&changed).is_err(), "flipped at {place}");
        }
    }

    #[test]
    fn errors_tell_what_is_wrong() {
        let bytes = bake().to_bytes();
        assert_eq!(Bake::from_bytes(b"# a scene"), Err(BakeError::Foreign));
        let mut newer = bytes.clone();
        newer[8] = 9;
        assert_eq!(
            Bake::from_bytes(&newer),
            Err(BakeError::Version { found: 9 })
        );
        let mut longer = bytes.clone();
        longer.push(0);
        assert!(matches!(
            Bake::from_bytes(&longer),
            Err(BakeError::Length { .. })
        ));
        let mut changed = bytes;
        changed[100] ^= 1;
        assert_eq!(Bake::from_bytes(&changed), Err(BakeError::Checksum));
    }

    #[test]
    fn contents_are_checked_even_under_a_good_checksum() {
        let mut wrong = bake();
        wrong.body.surface.panels[0][0] = 9;
        assert_eq!(
            Bake::from_bytes(&wrong.to_bytes()),
            Err(BakeError::Body(BodyError::Surface))
        );
        let mut lighter = bake();
        lighter.body.mass = -1.0;
        assert!(matches!(
            Bake::from_bytes(&lighter.to_bytes()),
            Err(BakeError::Body(_))
        ));
    }
}
