//! The parts of a glTF file and the files that it names: buffers, views of them, and images.

use super::container;
use crate::files::note;
use crate::message::shortened;
use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use etendue_render::film::files::read_file;
use etendue_render::scene::{Input, Message};
use gltf_json::{Index, Root, buffer};
use percent_encoding::percent_decode_str;
use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};
use std::path::{Path, PathBuf};

/// Base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// A glTF file and what was read of its buffers.
#[derive(Debug)]
pub(super) struct Source<'a> {
    pub(super) root: Root,
    /// The text of the file.
    pub(super) json: &'a [u8],
    file: &'a str,
    /// The folder of the files that it names; `None` if it may not name any.
    folder: Option<&'a Path>,
    binary: Option<&'a [u8]>,
    buffers: Vec<OnceCell<Cow<'a, [u8]>>>,
    inputs: RefCell<Vec<Input>>,
}

/// A part of a buffer.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'a> {
    pub(super) bytes: &'a [u8],
    /// Bytes from one element to the next, if the file says so.
    pub(super) stride: Option<usize>,
}

impl<'a> Source<'a> {
    /// Reads the JSON text of a file that messages call `file`.
    pub(super) fn new(bytes: &'a [u8], file: &'a str, folder: Option<&'a Path>) -> Result<Self, Message> {
        let message = |line: usize, text: String| {
            let line = u32::try_from(line).unwrap_or(u32::MAX);
            Message { file: file.to_owned(), line, text }
        };
        let (json, binary) = container::split(bytes).map_err(|text| message(0, text))?;
        // the lines of a binary file are of no use
        let root = container::parse(json)
            .map_err(|(line, text)| message(if bytes.starts_with(container::MAGIC) { 0 } else { line }, text))?;
        let buffers = root.buffers.iter().map(|_| OnceCell::new()).collect();
        Ok(Self { root, json, file, folder, binary, buffers, inputs: RefCell::default() })
    }

    /// The other files that were read so far.
    pub(super) fn inputs(&self) -> Vec<Input> {
        self.inputs.borrow().clone()
    }

    /// A message about an item of the file.
    pub(super) fn message(&self, text: impl Into<String>) -> Message {
        Message { file: self.file.to_owned(), line: 0, text: text.into() }
    }

    /// The item of this index in a list of the file; `user` is what names it.
    pub(super) fn item<'s, T>(
        &self,
        list: &'s [T],
        index: Index<T>,
        kind: &str,
        user: &str,
    ) -> Result<(usize, &'s T), Message> {
        let index = index.value();
        let missing = || self.message(format!("{user}: {kind} {index} does not exist: there are {}", list.len()));
        list.get(index).map(|item| (index, item)).ok_or_else(missing)
    }

    /// The bytes of a buffer.
    fn buffer(&self, index: Index<buffer::Buffer>, user: &str) -> Result<&[u8], Message> {
        let (index, buffer) = self.item(&self.root.buffers, index, "buffer", user)?;
        if let Some(bytes) = self.buffers[index].get() {
            return Ok(bytes);
        }
        let item = format!("buffer {index}");
        let bytes: Cow<'a, [u8]> = match (&buffer.uri, self.binary) {
            (Some(uri), _) => Cow::Owned(self.open(uri, &item)?.1),
            (None, Some(binary)) if index == 0 => Cow::Borrowed(binary),
            (None, _) => {
                let is_compressed = |name: &&String| name.contains("meshopt");
                let by = self.root.extensions_used.iter().find(is_compressed);
                let why = by.map_or_else(String::new, |name| {
                    format!(": its geometry is compressed by {name}, which is not supported")
                });
                return Err(self.message(format!("{item}: has neither a URI nor a binary chunk{why}")));
            }
        };
        let length = buffer.byte_length.0;
        if (bytes.len() as u64) < length {
            return Err(self.message(format!("{item}: has {} bytes, but should have {length}", bytes.len())));
        }
        Ok(self.buffers[index].get_or_init(|| bytes))
    }

    /// A view of a buffer.
    pub(super) fn view(&self, index: Index<buffer::View>, user: &str) -> Result<View<'_>, Message> {
        let (index, view) = self.item(&self.root.buffer_views, index, "bufferView", user)?;
        let item = format!("bufferView {index}");
        let buffer = self.buffer(view.buffer, &item)?;
        let (offset, length) = (view.byte_offset.unwrap_or_default().0, view.byte_length.0);
        let range = offset.checked_add(length).and_then(|end| {
            let [start, end] = [usize::try_from(offset).ok()?, usize::try_from(end).ok()?];
            buffer.get(start..end)
        });
        let bytes = range.ok_or_else(|| {
            let (buffer, size) = (view.buffer.value(), buffer.len());
            self.message(format!(
                "{item}: {length} bytes from byte {offset} on do not fit into the {size} bytes of buffer {buffer}"
            ))
        })?;
        Ok(View { bytes, stride: view.byte_stride.map(|stride| stride.0) })
    }

    /// The bytes that a URI names or holds, and the name of the file.
    pub(super) fn open(&self, uri: &str, item: &str) -> Result<(PathBuf, Vec<u8>), Message> {
        let failed = |what: String| self.message(format!("{item}: {what}"));
        if let Some(data) = uri.strip_prefix("data:") {
            let (kind, data) =
                data.split_once(',').ok_or_else(|| failed(format!("{:?} has no comma", shortened(uri))))?;
            let decoded: Cow<'_, [u8]> = percent_decode_str(data).into();
            let bytes = if kind.ends_with(";base64") {
                BASE64.decode(&decoded).map_err(|error| failed(format!("damaged base64 data: {error}")))?
            } else {
                decoded.into_owned()
            };
            return Ok((PathBuf::from(item), bytes));
        }
        let name = percent_decode_str(uri).decode_utf8();
        let name = name.map_err(|_| failed(format!("the URI {:?} is not UTF-8", shortened(uri))))?;
        let shown = shortened(&name);
        // a single letter is a drive
        let scheme = uri.split_once(':').map_or("", |(scheme, _)| scheme);
        if scheme.len() > 1 && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c)) {
            return Err(failed(format!("{shown:?}: only files and data URIs are supported")));
        }
        let Some(folder) = self.folder else {
            return Err(failed(format!("{shown:?}: other files cannot be read here")));
        };
        if name.contains('\0') {
            return Err(failed(format!("{shown:?} is not a file name")));
        }
        let path = folder.join(&*name);
        let bytes = read_file(&path).map_err(|error| failed(format!("cannot read {:?}: {error}", path.display())))?;
        note(&mut self.inputs.borrow_mut(), &path, &bytes);
        Ok((path, bytes))
    }
}
