//! What a directive is given: its parameters, the files that it may name, the notes of its reader, and the transform that holds.

use super::inputs::Files;
use super::params::{Color, Params};
use crate::message::Notes;
use crate::transform::Transform;
use etendue_render::scene::Message;
use std::ops::{Deref, DerefMut};

/// The parameters of a directive, with what their readers need beside them.
pub(super) struct Given<'a> {
    pub(super) params: &'a mut Params,
    pub(super) files: Files<'a>,
    pub(super) notes: &'a mut Notes,
    /// The transform that holds.
    pub(super) ctm: &'a Transform,
}

impl Deref for Given<'_> {
    type Target = Params;
    fn deref(&self) -> &Params {
        self.params
    }
}

impl DerefMut for Given<'_> {
    fn deref_mut(&mut self) -> &mut Params {
        self.params
    }
}

impl Given<'_> {
    /// A colour or spectrum, or the name of a texture.
    pub(super) fn color(&mut self, name: &str) -> Result<Option<Color>, Message> {
        self.params.color(name, &self.files)
    }
    /// The colour of light, in the unit of the parameter; spectra have luminance 1.
    pub(super) fn light(&mut self, name: &str) -> Result<Option<[f64; 3]>, Message> {
        self.params.light(name, &self.files)
    }
    /// Adds a warning at the directive's line.
    pub(super) fn warn(&mut self, text: impl AsRef<str>) {
        self.notes.warn(self.params.error(text));
    }
    /// Warns of what is left out since it may be misspelt.
    pub(super) fn misspelt(&mut self, text: impl AsRef<str>) {
        self.notes.misspelt(self.params.error(text));
    }
    /// Warns that something stands for something else, but only of the first one of its kind.
    pub(super) fn stand_in(&mut self, kind: &str, text: impl AsRef<str>) {
        self.notes.stand_in(kind, || self.params.error(text));
    }
}
