//! What an interruption of a rendering in passes writes.

use crate::interrupt::Interrupt;
use crate::output::Output;
use etendue_render::film::{Film, Pixel};
use etendue_render::scene::area::{self, Area};
use etendue_render::{Identity, Settings};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The image as it would be if the pass ended now, and whether this pass has added something to it.
#[derive(Clone)]
pub(crate) struct Partial(Arc<Mutex<(Film, bool)>>);

impl Partial {
    /// An image without samples.
    pub(crate) fn new(settings: &Settings) -> Self {
        let pixels = vec![Pixel::default(); area::count(settings.whole())];
        let film = Film { width: settings.width, height: settings.height, pixels };
        Self(Arc::new(Mutex::new((film, false))))
    }
    fn lock(&self) -> MutexGuard<'_, (Film, bool)> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
    /// Replaces the pixels of a tile.
    pub(crate) fn paste(&self, tile: Area, pixels: &[Pixel]) {
        let (film, is_new) = &mut *self.lock();
        *is_new = true;
        area::paste(&mut film.pixels, [0, 0, film.width, film.height], tile, pixels.iter().copied());
    }
    /// Lets an interruption write what the pass that begins has added by then, into files beside those of the passes before it.
    pub(crate) fn keep(&self, interrupt: &Interrupt, output: &Arc<Output>, identity: &Identity) {
        let (partial, output, mut identity) = (self.clone(), Arc::clone(output), identity.clone());
        partial.lock().1 = false;
        let mut status = interrupt.lock();
        let held = status.text.clone();
        status.last = Some(Box::new(move || {
            let (film, is_new) = &*partial.lock();
            if !is_new {
                return Ok(held);
            }
            let samples: f64 = film.pixels.iter().map(|pixel| f64::from(pixel.samples)).sum();
            identity.settings.spp = (samples / film.pixels.len() as f64).round().max(1.0) as u32;
            output.save_part(film, &identity).map(|saved| format!("{saved}; {held}"))
        }));
    }
}
