//! Buffer views compressed by meshoptimizer (EXT_meshopt_compression, KHR_meshopt_compression).
//!
//! Its decoders check what they read; what they take for granted about sizes is checked here.

use super::super::{ParseError, Place};
use super::document::Meshopt;

/// The bytes of a view before it was compressed.
pub(super) fn decompress(bytes: &[u8], packed: &Meshopt) -> Result<Vec<u8>, ParseError> {
    let (count, stride) = (packed.count, packed.byte_stride);
    let data = match (packed.mode.as_str(), stride) {
        ("ATTRIBUTES", _) => vertices(bytes, count, stride),
        ("TRIANGLES", 2) if count.is_multiple_of(3) => {
            meshopt::decode_index_buffer::<u16>(bytes, count).map(|v| flat(&v, u16::to_ne_bytes))
        }
        ("TRIANGLES", 4) if count.is_multiple_of(3) => {
            meshopt::decode_index_buffer::<u32>(bytes, count).map(|v| flat(&v, u32::to_ne_bytes))
        }
        ("INDICES", 2) => {
            meshopt::decode_index_sequence::<u16>(bytes, count).map(|v| flat(&v, u16::to_ne_bytes))
        }
        ("INDICES", 4) => {
            meshopt::decode_index_sequence::<u32>(bytes, count).map(|v| flat(&v, u32::to_ne_bytes))
        }
        (mode, _) => {
            let reason = format!("{count} compressed items of {stride} bytes cannot be {mode}");
            return Err(ParseError::at(Place::File, reason));
        }
    };
    let data = data.map_err(|_| {
        ParseError::at(
            Place::File,
            "the compressed data of a buffer view are broken",
        )
    })?;
    filtered(data, packed)
}

/// Undoes the filter that made the data compress better.
fn filtered(data: Vec<u8>, packed: &Meshopt) -> Result<Vec<u8>, ParseError> {
    match packed.filter.as_deref() {
        None | Some("NONE") => Ok(data),
        Some("EXPONENTIAL") => {
            let mut words: Vec<[u32; 1]> = unflat(&data, |b| [u32::from_le_bytes(b)]);
            meshopt::decode_filter_exp(&mut words);
            Ok(flat(&words, |[word]| word.to_le_bytes()))
        }
        Some("QUATERNION") if packed.byte_stride == 8 => {
            let mut numbers: Vec<[i16; 4]> = unflat(&data, |[a, b, c, d, e, f, g, h]| {
                [[a, b], [c, d], [e, f], [g, h]].map(i16::from_le_bytes)
            });
            meshopt::decode_filter_quat(&mut numbers);
            Ok(flat(numbers.as_flattened(), i16::to_le_bytes))
        }
        Some(filter) => Err(ParseError::Unsupported {
            feature: format!("the filter {filter} on positions"),
            remedy: "export it without compression",
        }),
    }
}

fn flat<T: Copy, const N: usize>(items: &[T], bytes: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    items.iter().flat_map(|&item| bytes(item)).collect()
}

fn unflat<T, const N: usize>(data: &[u8], item: impl Fn([u8; N]) -> T) -> Vec<T> {
    data.as_chunks::<N>().0.iter().map(|&b| item(b)).collect()
}

/// As many words as an item has; the decoder takes the size of an item from its type.
#[derive(Clone, Copy)]
struct Words<const N: usize>([u32; N]);

impl<const N: usize> Default for Words<N> {
    fn default() -> Words<N> {
        Words([0; N])
    }
}

fn vertices(bytes: &[u8], count: usize, stride: usize) -> meshopt::Result<Vec<u8>> {
    fn of<const N: usize>(bytes: &[u8], count: usize) -> meshopt::Result<Vec<u8>> {
        let items = meshopt::decode_vertex_buffer::<Words<N>>(bytes, count)?;
        Ok(items
            .iter()
            .flat_map(|item| item.0)
            .flat_map(u32::to_ne_bytes)
            .collect())
    }
    let wrong = || meshopt::Error::Parse(format!("items of {stride} bytes"));
    if !stride.is_multiple_of(4) {
        return Err(wrong());
    }
    macro_rules! by_words {
        ($($n:literal)*) => {
            match stride / 4 {
                $($n => of::<$n>(bytes, count),)*
                _ => Err(wrong()),
            }
        };
    }
    by_words!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32
        33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64)
}
