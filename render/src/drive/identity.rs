//! What an image depends on: its parts are recognised by it, and images that may be averaged.

use crate::film::sensor::{Exposure, Sensor};
use crate::scene::Scene;
use crate::scene::area::PlaceInImage;
use crate::scene::limits::{MOST_SAMPLES, is_size};
use crate::settings::Settings;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::fs;
use std::sync::OnceLock;
use xxhash_rust::xxh3::xxh3_64;

/// Everything that an image depends on. Parts of equal identities make an image, and equal identities have equal images, bit for bit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// The scene's name, for messages.
    pub scene: String,
    /// Hash of the files of the scene, in hexadecimal digits; of its name if it is built in.
    pub digest: String,
    /// The settings, with a sampler that is not left open. Of an image that is an average, these are the samples of all.
    #[serde(flatten)]
    pub settings: Settings,
    /// What is measured.
    pub sensor: Sensor,
    /// Where the image is in the whole one, if it is only a part.
    pub place: Option<PlaceInImage>,
    /// The value of unit radiance at the middle of the image, in the unit of the sensor: the PNG is exposed by it.
    #[serde(with = "exact")]
    pub exposure: f64,
    /// Seeds of other images, if this one is the average of theirs and its own.
    pub averaged: Vec<u64>,
    /// The [build] of the program that made a part; `None` for images.
    pub build: Option<String>,
}

/// The build of the program that runs: its version, and a hash of its file.
#[must_use]
pub fn build() -> String {
    static HASH: OnceLock<u64> = OnceLock::new();
    let read = || std::env::current_exe().and_then(fs::read).map_or(0, |bytes| xxh3_64(&bytes));
    format!("{} {:016x}", env!("CARGO_PKG_VERSION"), HASH.get_or_init(read))
}

/// Numbers as texts, which keep all of their bits.
mod exact {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    pub(super) fn serialize<S: Serializer>(x: &f64, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&format!("{x:?}"))
    }
    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        String::deserialize(from)?.parse().map_err(D::Error::custom)
    }
}

impl Identity {
    /// The identity of the image that these settings give.
    pub fn new(scene: &Scene, settings: Settings, sensor: Sensor) -> Self {
        let size = [settings.width, settings.height];
        let exposure = Exposure::new(sensor, &scene.camera, scene.film.diagonal, size);
        Self {
            scene: scene.name.clone(),
            digest: scene.digest(),
            settings,
            sensor,
            place: scene.film.place,
            exposure: exposure.map_or(1.0, |exposure| exposure.on_axis()),
            averaged: Vec::new(),
            build: None,
        }
    }

    /// That of the parts that this program makes.
    #[must_use]
    pub fn of_parts(self) -> Self {
        Self { build: Some(build()), ..self }
    }
    /// That of the image which parts or samples make.
    #[must_use]
    pub fn of_image(self) -> Self {
        Self { build: None, ..self }
    }
    /// What images must have in common to be averaged: all but their samples.
    #[must_use]
    pub fn of_average(&self) -> Self {
        let settings = Settings { spp: 0, seed: 0, ..self.settings };
        Self { settings, averaged: Vec::new(), ..self.clone().of_image() }
    }

    /// Sets of samples of a pixel.
    pub fn sets(&self) -> u32 {
        self.settings.sampler.sets(self.settings.spp, self.settings.sets)
    }
    /// The seeds of its samples.
    pub fn seeds(&self) -> impl Iterator<Item = u64> {
        std::iter::once(self.settings.seed).chain(self.averaged.iter().copied())
    }
    /// Where the image is in the whole one, also if it is that.
    pub fn window(&self) -> PlaceInImage {
        self.place.unwrap_or(PlaceInImage { start: [0; 2], whole: [self.settings.width, self.settings.height] })
    }

    /// Reads an identity from a JSON object.
    ///
    /// # Errors
    /// Names the first value that is missing or not possible.
    pub fn from_json(value: &Value) -> Result<Self, String> {
        let identity = Self::deserialize(value).map_err(|error| error.to_string())?;
        // averages have any number of samples
        let Settings { width, height, spp, .. } = identity.settings;
        Settings { spp: spp.min(MOST_SAMPLES), ..identity.settings }.check()?;
        let PlaceInImage { start: [x, y], whole: [across, down] } = identity.window();
        let fits = |start: u32, side: u32, whole: u32| start.checked_add(side).is_some_and(|end| end <= whole);
        if !is_size(across.into(), down.into()) || !fits(x, width, across) || !fits(y, height, down) {
            return Err(format!("no image of {across} × {down} pixels has {width} × {height} at {x}, {y}"));
        }
        if !(identity.exposure > 0.0 && identity.exposure.is_finite()) {
            return Err(format!("the exposure cannot be {}", identity.exposure));
        }
        Ok(identity)
    }

    /// How another identity differs, for a message; `None` if it does not.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let (own, other) = (json!(self), json!(other));
        // what says most comes first
        let first = ["scene", "digest", "build"].into_iter();
        let keys = first.chain(own.as_object()?.keys().map(String::as_str));
        let differ = keys.into_iter().find(|&key| own[key] != other[key]);
        let what = |key: &str| match key {
            "digest" => "scene, by the hash of its files,".to_owned(),
            "spp" => "number of samples per pixel".to_owned(),
            "build" => "build of etendue".to_owned(),
            other => other.to_owned(),
        };
        differ.map(|key| format!("its {} is {}, not {}", what(key), other[key], own[key]))
    }
}
