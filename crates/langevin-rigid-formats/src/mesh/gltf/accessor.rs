//! Numbers out of buffers.

use super::super::{ParseError, Place};
use super::buffer::{Buffers, slice};
use super::document::{Accessor, BufferView, Document, Sparse};
use super::get;

/// What a component of an accessor is stored as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    Byte,
    UnsignedByte,
    Short,
    UnsignedShort,
    UnsignedInt,
    Float,
}

impl Component {
    fn of(code: u32) -> Option<Component> {
        Some(match code {
            5120 => Component::Byte,
            5121 => Component::UnsignedByte,
            5122 => Component::Short,
            5123 => Component::UnsignedShort,
            5125 => Component::UnsignedInt,
            5126 => Component::Float,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Component::Byte | Component::UnsignedByte => 1,
            Component::Short | Component::UnsignedShort => 2,
            Component::UnsignedInt | Component::Float => 4,
        }
    }

    fn read(self, bytes: &[u8]) -> f64 {
        let two = || [bytes[0], bytes[1]];
        let four = || [bytes[0], bytes[1], bytes[2], bytes[3]];
        match self {
            Component::Byte => f64::from(bytes[0].cast_signed()),
            Component::UnsignedByte => f64::from(bytes[0]),
            Component::Short => f64::from(i16::from_le_bytes(two())),
            Component::UnsignedShort => f64::from(u16::from_le_bytes(two())),
            Component::UnsignedInt => f64::from(u32::from_le_bytes(four())),
            Component::Float => f64::from(f32::from_le_bytes(four())),
        }
    }

    /// A number stored as a share of the greatest that can be stored.
    fn normalized(self, x: f64) -> f64 {
        match self {
            Component::Byte => (x / 127.0).max(-1.0),
            Component::UnsignedByte => x / 255.0,
            Component::Short => (x / 32767.0).max(-1.0),
            Component::UnsignedShort => x / 65535.0,
            Component::UnsignedInt | Component::Float => x,
        }
    }
}

/// The items of an accessor, each read when it is asked for.
pub(super) struct Items<'a> {
    pub(super) count: usize,
    component: Component,
    normalized: bool,
    data: Data<'a>,
    replaced: Option<Replaced<'a>>,
}

enum Data<'a> {
    Zeros,
    Stored { bytes: &'a [u8], stride: usize },
    Decoded(Vec<f32>),
}

/// Items of a sparse accessor that have another value.
struct Replaced<'a> {
    /// Increasing.
    numbers: Vec<usize>,
    values: &'a [u8],
}

/// The accessors of a document with the buffers they look into.
pub(super) struct Accessors<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a Buffers<'a>,
}

impl<'a> Accessors<'a> {
    pub(super) fn get(&self, index: usize) -> Result<&'a Accessor, ParseError> {
        get(&self.document.accessors, index, "accessor")
    }

    /// An accessor of `shape` whose components are among `allowed`.
    pub(super) fn items(
        &self,
        index: usize,
        shape: &str,
        allowed: &[Component],
    ) -> Result<Items<'a>, ParseError> {
        let accessor = self.get(index)?;
        let component = self.component(index, shape, allowed)?;
        let size = width(shape) * component.size();
        let data = match (accessor.buffer_view, &accessor.sparse) {
            (Some(view), _) => self.stored(index, view, accessor, size)?,
            (None, Some(_)) => Data::Zeros,
            (None, None) => return Err(bad(index, "has no buffer view")),
        };
        let sparse = accessor.sparse.as_ref();
        let replaced = sparse.map(|sparse| self.replaced(index, sparse, accessor.count, size));
        Ok(Items {
            count: accessor.count,
            component,
            normalized: accessor.normalized,
            data,
            replaced: replaced.transpose()?,
        })
    }

    /// The same for numbers that were decoded already.
    pub(super) fn decoded(
        &self,
        index: usize,
        shape: &str,
        allowed: &[Component],
        numbers: impl FnOnce(usize) -> Result<Vec<f32>, ParseError>,
    ) -> Result<Items<'a>, ParseError> {
        let accessor = self.get(index)?;
        Ok(Items {
            count: accessor.count,
            component: self.component(index, shape, allowed)?,
            normalized: accessor.normalized,
            data: Data::Decoded(numbers(width(shape))?),
            replaced: None,
        })
    }

    fn component(
        &self,
        index: usize,
        shape: &str,
        allowed: &[Component],
    ) -> Result<Component, ParseError> {
        let accessor = self.get(index)?;
        Component::of(accessor.component_type)
            .filter(|component| accessor.shape == shape && allowed.contains(component))
            .ok_or_else(|| {
                let is = format!("{} of {}", accessor.shape, accessor.component_type);
                bad(
                    index,
                    &format!("is {is}, which cannot be what it is used for"),
                )
            })
    }

    fn stored(
        &self,
        index: usize,
        view: usize,
        accessor: &Accessor,
        size: usize,
    ) -> Result<Data<'a>, ParseError> {
        let (bytes, view) = self.buffers.view(view)?;
        let stride = stride(view).unwrap_or(size);
        if stride < size {
            return Err(bad(index, "has items that overlap"));
        }
        let bytes = span(accessor.count, stride, size)
            .and_then(|length| slice(bytes, accessor.byte_offset, length))
            .ok_or_else(|| bad(index, "reaches beyond its buffer"))?;
        Ok(Data::Stored { bytes, stride })
    }

    fn replaced(
        &self,
        index: usize,
        sparse: &Sparse,
        count: usize,
        size: usize,
    ) -> Result<Replaced<'a>, ParseError> {
        let component = Component::of(sparse.indices.component_type)
            .filter(|c| INDICES.contains(c))
            .ok_or_else(|| bad(index, "has sparse indices of a wrong type"))?;
        let part = |view, offset, size: usize| {
            let (bytes, _) = self.buffers.view(view)?;
            let length = sparse.count.checked_mul(size);
            length
                .and_then(|length| slice(bytes, offset, length))
                .ok_or_else(|| bad(index, "has sparse items beyond their buffer"))
        };
        let (indices, values) = (&sparse.indices, &sparse.values);
        let numbers = part(indices.buffer_view, indices.byte_offset, component.size())?;
        let values = part(values.buffer_view, values.byte_offset, size)?;
        self.buffers
            .charge(sparse.count.checked_mul(size_of::<usize>()))?;
        let numbers: Vec<usize> = numbers
            .chunks_exact(component.size())
            .map(|b| component.read(b) as usize)
            .collect();
        let increasing = numbers.is_sorted_by(|a, b| a < b);
        if !increasing || numbers.last().is_some_and(|&last| last >= count) {
            let reason = format!("has sparse indices that do not increase up to {count}");
            return Err(bad(index, &reason));
        }
        Ok(Replaced { numbers, values })
    }
}

/// Components that numbers of items may have.
pub(super) const INDICES: [Component; 3] = [
    Component::UnsignedByte,
    Component::UnsignedShort,
    Component::UnsignedInt,
];

impl Items<'_> {
    /// The item of a number below `count`, of as many components as its shape has.
    pub(super) fn at<const N: usize>(&self, k: usize) -> [f64; N] {
        let size = N * self.component.size();
        let replaced = self.replaced.as_ref().and_then(|replaced| {
            let at = replaced.numbers.binary_search(&k).ok()?;
            Some(&replaced.values[at * size..][..size])
        });
        let numbers = match (replaced, &self.data) {
            (Some(bytes), _) => self.read(bytes),
            (None, Data::Zeros) => [0.0; N],
            (None, Data::Stored { bytes, stride }) => self.read(&bytes[k * stride..][..size]),
            (None, Data::Decoded(numbers)) => {
                std::array::from_fn(|i| f64::from(numbers[k * N + i]))
            }
        };
        match self.normalized {
            true => numbers.map(|x| self.component.normalized(x)),
            false => numbers,
        }
    }

    fn read<const N: usize>(&self, bytes: &[u8]) -> [f64; N] {
        let size = self.component.size();
        std::array::from_fn(|i| self.component.read(&bytes[i * size..]))
    }
}

/// Components of a shape that is read.
fn width(shape: &str) -> usize {
    match shape {
        "VEC3" => 3,
        "VEC4" => 4,
        "MAT4" => 16,
        _ => 1,
    }
}

/// Bytes from one item of a view to the next, where the view says.
fn stride(view: &BufferView) -> Option<usize> {
    view.byte_stride
        .or_else(|| view.meshopt().map(|packed| packed.byte_stride))
}

/// Bytes from the first of `count` items to the end of the last, if that can be a number.
fn span(count: usize, stride: usize, size: usize) -> Option<usize> {
    match count.checked_sub(1) {
        None => Some(0),
        Some(steps) => steps.checked_mul(stride)?.checked_add(size),
    }
}

fn bad(index: usize, reason: &str) -> ParseError {
    ParseError::at(Place::File, format!("accessor {index} {reason}"))
}
