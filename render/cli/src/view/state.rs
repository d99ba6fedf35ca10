//! What the rendering thread and those of the clients share: what the page wishes, and what there is to show.

use super::draft::{Draft, Way};
use super::watch::Watch;
use etendue_render::Technique;
use etendue_render::camera::Orbit;
use etendue_render::film::Film;
use etendue_render::film::claim::Claim;
use etendue_render::scene::CameraSettings;
use etendue_render::scene::area::Area;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// What the page asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wishes {
    /// The image that is shown and receives samples.
    pub(crate) way: Way,
    /// The pixels that receive the samples, in whole tiles; `None` for all.
    pub(crate) crop: Option<Area>,
    pub(crate) paused: bool,
    /// Whether the scene is to be read again.
    pub(crate) reload: bool,
    /// Whether a copy of the image that is shown is to be written.
    pub(crate) save: bool,
    /// Where the camera has turned; `None` for that of the scene.
    pub(crate) orbit: Option<Orbit>,
}

/// An image as it was after its last pass.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    pub(crate) way: Way,
    /// The technique that `auto` stands for, or the same one.
    pub(crate) chosen: Technique,
    pub(crate) film: Arc<Film>,
    /// No other image, and none of its drafts, has the same.
    pub(crate) version: u64,
    /// Samples per pixel, the mean over all pixels.
    pub(crate) spp: f64,
    pub(crate) error: Option<Claim>,
    /// Seconds of rendering.
    pub(crate) seconds: f64,
    /// The seconds after some of the passes, and the error then.
    pub(crate) history: Vec<[f64; 2]>,
    /// Why it receives no more samples, if it does not.
    pub(crate) end: Option<String>,
}

/// What is known of the scene, and stays the same until it is read again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facts {
    pub(crate) scene: String,
    pub(crate) size: [u32; 2],
    /// The value of unit radiance in the middle of the image, by which the PNG is divided.
    pub(crate) exposure: f64,
    pub(crate) sensor: &'static str,
    /// The error that is asked for.
    pub(crate) target: Option<f64>,
    /// Which files hold the image, if any is written.
    pub(crate) files: Option<String>,
    /// Which files a copy would be written to.
    pub(crate) copy: String,
    /// The camera of the scene, and the distance of what it looks at.
    pub(crate) camera: Option<(CameraSettings, f64)>,
}

#[derive(Debug)]
pub(crate) struct State {
    pub(crate) wishes: Wishes,
    pub(crate) facts: Facts,
    /// The images that are kept, the one that was rendered last at the end.
    pub(crate) pictures: Vec<Picture>,
    /// The files of the scene, which whoever asks for the status looks at: a pass, or a disk that is slow to write the image, delays no answer.
    pub(crate) watch: Arc<Watch>,
    /// What the page should say.
    pub(crate) message: Option<String>,
}

impl State {
    pub(crate) fn picture(&self, way: Way) -> Option<&Picture> {
        self.pictures.iter().find(|picture| picture.way == way)
    }
}

/// The shared state.
#[derive(Debug)]
pub(crate) struct Shared {
    state: Mutex<State>,
    changed: Condvar,
    /// Ends a pass that is not wished any more.
    pub(crate) stop: AtomicBool,
    /// The pixels of the pass that are done, and all of them.
    pub(crate) done: AtomicU64,
    pub(crate) of: AtomicU64,
    /// What is shown of an image while it is rendered. Never locked together with the state.
    draft: Mutex<Option<Draft>>,
    versions: AtomicU64,
    /// Images that are being sent.
    pub(crate) sending: Arc<AtomicUsize>,
    /// The name of an image to compare with, and its pixels.
    pub(crate) reference: Option<(String, Arc<Film>)>,
}

impl Shared {
    pub(crate) fn new(state: State, reference: Option<(String, Arc<Film>)>) -> Self {
        let (stop, done, of, draft, versions, sending) = Default::default();
        Self { state: Mutex::new(state), changed: Condvar::new(), stop, done, of, draft, versions, sending, reference }
    }

    pub(crate) fn draft(&self) -> MutexGuard<'_, Option<Draft>> {
        self.draft.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A version of an image that no other one has.
    pub(crate) fn version(&self) -> u64 {
        self.versions.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Whether there is something to show of an image.
    pub(crate) fn shows(&self, way: Way) -> bool {
        self.draft().as_ref().is_some_and(|draft| draft.way == way) || self.lock().picture(way).is_some()
    }

    /// Forgets all that is shown.
    pub(crate) fn forget(&self) {
        *self.draft() = None;
        self.lock().pictures.clear();
    }

    pub(crate) fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes the wishes, unless that fails, and wakes the rendering thread. It ends its pass if another image or part is wished, but not to
    /// pause or to save.
    pub(crate) fn wish(&self, change: impl FnOnce(&mut Wishes, &Facts) -> Result<(), String>) -> Result<(), String> {
        let mut state = self.lock();
        let mut next = state.wishes;
        change(&mut next, &state.facts)?;
        let before = Wishes { paused: next.paused, save: next.save, ..state.wishes };
        if before != next {
            self.stop.store(true, Ordering::Relaxed);
            self.done.store(0, Ordering::Relaxed);
        }
        state.wishes = next;
        drop(state);
        self.changed.notify_all();
        Ok(())
    }

    /// The wishes for the next pass.
    pub(crate) fn wishes(&self) -> Wishes {
        let state = self.lock();
        self.stop.store(false, Ordering::Relaxed);
        state.wishes
    }

    /// Waits until there are other wishes than these, but not longer than this.
    pub(crate) fn wait(&self, wishes: &Wishes, long: Duration) {
        let are_same = |state: &mut State| state.wishes == *wishes;
        let _ = self.changed.wait_timeout_while(self.lock(), long, are_same).unwrap_or_else(PoisonError::into_inner);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_render::Sampler;

    /// Each wish changes what the wishes before it have left, whoever sends them.
    #[test]
    fn no_wish_is_lost() {
        let way = Way { technique: Technique::Auto, sampler: Sampler::Sobol };
        let wishes = Wishes { way, crop: Some([0; 4]), paused: false, reload: false, save: false, orbit: None };
        let (facts, pictures) = (Facts::default(), Vec::new());
        let shared = Shared::new(State { wishes, facts, pictures, watch: Arc::default(), message: None }, None);
        let count = || {
            for _ in 0..1000 {
                let counted = shared.wish(|next, _| {
                    next.crop = next.crop.map(|[x0, y0, x1, y1]| [x0, y0, x1 + 1, y1]);
                    Ok(())
                });
                assert_eq!(counted, Ok(()));
            }
        };
        std::thread::scope(|scope| (0..4).for_each(|_| drop(scope.spawn(count))));
        assert_eq!(shared.lock().wishes.crop, Some([0, 0, 4000, 0]));
        // what fails changes nothing
        let failed = shared.wish(|next, _| {
            next.paused = true;
            Err("no".into())
        });
        assert_eq!((failed, shared.lock().wishes.paused), (Err("no".into()), false));
    }
}
