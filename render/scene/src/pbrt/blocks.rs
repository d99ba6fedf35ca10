//! The graphics state of a scene file, and the blocks that save and restore it: attributes, transforms and objects.

use super::area_lights::Area;
use super::material_parameters::Finish;
use super::params::Param;
use crate::builder::Builder;
use crate::message::{Place, shortened};
use crate::nearest::did_you_mean;
use crate::transform::Transform;
use etendue_render::scene::{Material, Message};
use std::collections::HashMap;

/// Greatest depth of nested `AttributeBegin`s.
const DEEPEST_ATTRIBUTES: usize = 1024;

/// The graphics state that `AttributeBegin` saves and `AttributeEnd` restores.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) ctm: Transform,
    pub(super) reverse: bool,
    pub(super) material: Finish,
    pub(super) area: Area,
    /// Parameters of `Attribute`, by what they are for.
    pub(super) defaults: Vec<(String, Vec<Param>)>,
    /// Whether transforms apply only to the end of the exposure, which is not rendered.
    pub(super) is_end: bool,
}

impl Default for State {
    fn default() -> Self {
        Self {
            ctm: Transform::IDENTITY,
            reverse: false,
            material: Finish::Of(Material::Diffuse([0.5; 3])),
            area: Area::default(),
            defaults: Vec::new(),
            is_end: false,
        }
    }
}

/// The object that is being read.
struct Open {
    name: String,
    place: Place,
    /// How many states were saved before.
    depth: usize,
    before: Builder,
}

/// The blocks that are open, and the objects that were closed.
#[derive(Default)]
pub(super) struct Blocks {
    saved: Vec<(State, Place)>,
    open: Option<Open>,
    objects: HashMap<String, u32>,
}

impl Blocks {
    /// Whether an object is being read.
    pub(super) const fn is_object(&self) -> bool {
        self.open.is_some()
    }

    /// Number of open blocks.
    pub(super) fn depth(&self) -> usize {
        self.saved.len()
    }

    /// Where the first block was opened that is deeper than this.
    pub(super) fn opened(&self, depth: usize) -> Option<&Place> {
        self.saved.get(depth).map(|(_, place)| place)
    }

    /// Checks that all blocks are closed at the end of the file.
    pub(super) fn check_closed(&self) -> Result<(), Message> {
        if let Some(open) = &self.open {
            return Err(open.place.message("this ObjectBegin is never closed"));
        }
        match self.saved.last() {
            Some((_, place)) => Err(place.message("this AttributeBegin or TransformBegin is never closed")),
            None => Ok(()),
        }
    }

    /// Carries out `AttributeBegin` or `TransformBegin`.
    pub(super) fn begin(&mut self, word: &str, place: Place, state: &State) -> Result<(), Message> {
        if self.saved.len() == DEEPEST_ATTRIBUTES {
            return Err(place.message(format!("{word} is nested more than {DEEPEST_ATTRIBUTES} deep")));
        }
        self.saved.push((state.clone(), place));
        Ok(())
    }

    /// Carries out `AttributeEnd` or `TransformEnd`: returns the state from before.
    pub(super) fn end(&mut self, word: &str, place: &Place) -> Result<State, Message> {
        if let Some(open) = self.open.as_ref().filter(|open| self.saved.len() == open.depth + 1) {
            let at = open.place.seen_from(&place.file);
            return Err(place.message(format!("{word}: the ObjectBegin of {at} is not closed")));
        }
        let unmatched = || place.message(format!("{word} has no matching Begin"));
        self.saved.pop().map(|(state, _)| state).ok_or_else(unmatched)
    }

    /// Carries out `ObjectBegin`.
    pub(super) fn begin_object(
        &mut self,
        name: String,
        place: Place,
        state: &State,
        out: &mut Builder,
    ) -> Result<(), Message> {
        if let Some(open) = &self.open {
            let at = open.place.seen_from(&place.file);
            return Err(place.message(format!("ObjectBegin: the one of {at} is not closed")));
        }
        let before = out.begin_object();
        self.open = Some(Open { name, place: place.clone(), depth: self.saved.len(), before });
        self.saved.push((state.clone(), place));
        Ok(())
    }

    /// Carries out `ObjectEnd`: returns the state from before, if the object had one.
    pub(super) fn end_object(&mut self, place: &Place, out: &mut Builder) -> Result<Option<State>, Message> {
        let Some(open) = self.open.take() else {
            return Err(place.message("ObjectEnd has no matching ObjectBegin"));
        };
        if let Some((_, begun)) = self.saved.get(open.depth + 1..).and_then(<[_]>::last) {
            let at = begun.seen_from(&place.file);
            let what = format!("ObjectEnd: the AttributeBegin or TransformBegin of {at} is not closed");
            return Err(place.message(what));
        }
        let state = self.saved.pop().map(|(state, _)| state);
        self.objects.insert(open.name, out.end_object(open.before));
        Ok(state)
    }

    /// Carries out `ObjectInstance`.
    pub(super) fn instance(
        &self,
        name: &str,
        place: &Place,
        ctm: &Transform,
        out: &mut Builder,
    ) -> Result<(), Message> {
        if self.open.is_some() {
            return Err(place.message("ObjectInstance: objects cannot contain instances"));
        }
        let Some(object) = self.objects.get(name) else {
            let near = did_you_mean(name, self.objects.keys().map(String::as_str));
            let what = format!("no ObjectBegin {:?} precedes this: nothing is added{near}", shortened(name));
            out.notes.misspelt(place.message(what));
            return Ok(());
        };
        let added = out.instance(*object, ctm);
        added.map_err(|why| place.message(format!("ObjectInstance {:?}: {why}", shortened(name))))
    }
}
