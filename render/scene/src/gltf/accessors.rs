//! Reads accessors: lists of numbers in buffers, each checked against the length of its buffer first.

use super::source::{Source, View};
use etendue_render::scene::Message;
use gltf_json::accessor::{Accessor, ComponentType, Type};
use gltf_json::validation::Checked;
use gltf_json::{Index, buffer};

/// Most elements of an accessor without a buffer: their number says nothing about the size of the file.
const MOST_ZEROS: u64 = 1 << 22;

/// Where the elements of an accessor are.
struct Layout {
    index: usize,
    count: usize,
    component: ComponentType,
    normalized: bool,
    /// Bytes of an element.
    size: usize,
}

impl Source<'_> {
    /// Vectors of N numbers. Integers become numbers as the specification says; floating-point numbers may be NaN or infinite.
    pub(super) fn vectors<const N: usize>(&self, index: Index<Accessor>, user: &str) -> Result<Vec<[f32; N]>, Message> {
        let wanted = [Type::Scalar, Type::Vec2, Type::Vec3, Type::Vec4][N - 1];
        let (accessor, layout) = self.layout(index, wanted, user)?;
        macro_rules! read {
            ($type:ty, $most:expr) => {
                if layout.normalized {
                    self.elements(accessor, &layout, |bytes| {
                        components::<{ size_of::<$type>() }, N>(bytes)
                            .map(|x| (f32::from(<$type>::from_le_bytes(x)) / $most).max(-1.0))
                    })
                } else {
                    self.elements(accessor, &layout, |bytes| {
                        components::<{ size_of::<$type>() }, N>(bytes).map(|x| f32::from(<$type>::from_le_bytes(x)))
                    })
                }
            };
        }
        match layout.component {
            ComponentType::F32 => {
                self.elements(accessor, &layout, |bytes| components::<4, N>(bytes).map(f32::from_le_bytes))
            }
            ComponentType::I8 => read!(i8, 127.0),
            ComponentType::U8 => read!(u8, 255.0),
            ComponentType::I16 => read!(i16, 32_767.0),
            ComponentType::U16 => read!(u16, 65_535.0),
            ComponentType::U32 => Err(self.message(format!(
                "accessor {}, of {user}: its components are 32-bit integers, which only indices may be",
                layout.index
            ))),
        }
    }

    /// Matrices of 4 × 4 numbers, by columns.
    pub(super) fn matrices(&self, index: Index<Accessor>, user: &str) -> Result<Vec<[f32; 16]>, Message> {
        let (accessor, layout) = self.layout(index, Type::Mat4, user)?;
        match layout.component {
            ComponentType::F32 => {
                self.elements(accessor, &layout, |bytes| components::<4, 16>(bytes).map(f32::from_le_bytes))
            }
            other => Err(self.message(format!("accessor {}, of {user}: matrices of {other:?}", layout.index))),
        }
    }

    /// Unsigned integers.
    pub(super) fn integers(&self, index: Index<Accessor>, user: &str) -> Result<Vec<u32>, Message> {
        let (accessor, layout) = self.layout(index, Type::Scalar, user)?;
        match layout.component {
            ComponentType::U8 => self.elements(accessor, &layout, |bytes| u32::from(bytes[0])),
            ComponentType::U16 => {
                self.elements(accessor, &layout, |bytes| u32::from(u16::from_le_bytes([bytes[0], bytes[1]])))
            }
            ComponentType::U32 => {
                self.elements(accessor, &layout, |bytes| u32::from_le_bytes(components::<4, 1>(bytes)[0]))
            }
            other => Err(self
                .message(format!("accessor {}, of {user}: {other:?} is no type of unsigned integers", layout.index))),
        }
    }

    /// The number of elements of an accessor, as the file says it.
    fn layout(&self, index: Index<Accessor>, wanted: Type, user: &str) -> Result<(&Accessor, Layout), Message> {
        let (index, accessor) = self.item(&self.root.accessors, index, "accessor", user)?;
        let failed = |what: String| self.message(format!("accessor {index}, of {user}: {what}"));
        let Checked::Valid(component) = accessor.component_type else {
            return Err(failed("its componentType is unknown".into()));
        };
        match accessor.type_ {
            Checked::Valid(kind) if kind == wanted => {}
            Checked::Valid(kind) => return Err(failed(format!("its type is {kind:?}, not {wanted:?}"))),
            Checked::Invalid => return Err(failed("its type is unknown".into())),
        }
        let count = accessor.count.0;
        if accessor.buffer_view.is_none() && count > MOST_ZEROS {
            return Err(failed(format!("{count} elements, but no bufferView: at most {MOST_ZEROS} are supported")));
        }
        let count = usize::try_from(count).map_err(|_| failed(format!("{count} elements are too many")))?;
        let (component, normalized) = (component.0, accessor.normalized);
        let size = component.size() * wanted.multiplicity();
        Ok((accessor, Layout { index, count, component, normalized, size }))
    }

    /// Elements in a view, and the bytes from one to the next.
    fn range(
        &self,
        view: Index<buffer::View>,
        offset: u64,
        count: usize,
        size: usize,
        item: &str,
    ) -> Result<(&[u8], usize), Message> {
        let View { bytes, stride } = self.view(view, item)?;
        let stride = stride.unwrap_or(size);
        if stride < size {
            return Err(self.message(format!("{item}: elements of {size} bytes are {stride} bytes apart")));
        }
        let length = if count == 0 { 0 } else { (count as u128 - 1) * stride as u128 + size as u128 };
        let end = u128::from(offset) + length;
        if end > bytes.len() as u128 {
            let (view, room) = (view.value(), bytes.len());
            return Err(self.message(format!(
                "{item}: {count} elements of {size} bytes, {stride} apart, from byte {offset} on do not fit into the \
                 {room} bytes of bufferView {view}"
            )));
        }
        Ok((&bytes[offset as usize..end as usize], stride))
    }

    /// All elements, with those that differ in a sparse accessor.
    fn elements<T: Clone>(
        &self,
        accessor: &Accessor,
        layout: &Layout,
        element: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, Message> {
        let &Layout { index, count, size, .. } = layout;
        let item = format!("accessor {index}");
        let mut elements: Vec<T> = match accessor.buffer_view {
            Some(view) => {
                let offset = accessor.byte_offset.unwrap_or_default().0;
                let (bytes, stride) = self.range(view, offset, count, size, &item)?;
                bytes.chunks(stride).map(&element).collect()
            }
            // zeros, as the specification says
            None => vec![element(&[0; 64]); count],
        };
        let Some(sparse) = &accessor.sparse else { return Ok(elements) };
        let Checked::Valid(kind) = sparse.indices.component_type else {
            return Err(self.message(format!("{item}: the componentType of its sparse indices is unknown")));
        };
        let wrong = || self.message(format!("{item}: has {} sparse elements of {count}", sparse.count.0));
        let changed = usize::try_from(sparse.count.0).ok().filter(|&changed| changed <= count).ok_or_else(wrong)?;
        let width = kind.0.size();
        let (indices, values) = (&sparse.indices, &sparse.values);
        let (places, step) =
            self.range(indices.buffer_view, indices.byte_offset.0, changed, width, &format!("{item}: sparse indices"))?;
        let (bytes, stride) =
            self.range(values.buffer_view, values.byte_offset.0, changed, size, &format!("{item}: sparse values"))?;
        for (place, value) in places.chunks(step).zip(bytes.chunks(stride)) {
            let place = place[..width].iter().rev().fold(0, |sum, &byte| sum << 8 | usize::from(byte));
            let old = elements.get_mut(place);
            *old.ok_or_else(|| self.message(format!("{item}: the sparse index {place} is not below {count}")))? =
                element(value);
        }
        Ok(elements)
    }
}

/// The bytes of each of N components of SIZE bytes.
#[inline]
fn components<const SIZE: usize, const N: usize>(bytes: &[u8]) -> [[u8; SIZE]; N] {
    let mut all = [[0; SIZE]; N];
    let bytes = &bytes[..SIZE * N];
    for (component, chunk) in all.iter_mut().zip(bytes.chunks_exact(SIZE)) {
        component.copy_from_slice(chunk);
    }
    all
}
