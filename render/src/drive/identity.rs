//! What an image depends on, and its file.

use crate::film::files::{FileError, failed, replace};
use crate::film::sensor::{Exposure, Sensor};
use crate::film::{Pixel, image};
use crate::scene::Scene;
use crate::scene::area::PlaceInImage;
use crate::settings::Settings;
use serde::Serialize;
use serde_json::{Value, json};
use std::path::Path;

/// Everything that an image depends on: equal identities have equal images, bit for bit. Image files have it in their header.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    pub exposure: f64,
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
        }
    }

    /// Writes an image: an EXR file with the channels of [`image::encode_exr`]. If the image has a place in a larger one, that is the display
    /// window, and the place the data window. Equal images give equal bytes.
    ///
    /// # Errors
    /// Fails if the file cannot be written; an existing file then remains unchanged.
    pub fn write_image(&self, path: &Path, pixels: &[Pixel]) -> Result<(), FileError> {
        let size = [self.settings.width, self.settings.height];
        let place = self.place.unwrap_or(PlaceInImage { start: [0; 2], whole: size });
        let bytes = image::encode_exr(pixels, size, place, &json!({ "identity": self }));
        replace(path, &bytes.map_err(|error| failed(path, error))?)
    }

    /// The scene and the digest that the header of an image tells; `None` if the file is no image that [`Identity::write_image`] wrote.
    #[must_use]
    pub fn scene_of(path: &Path) -> Option<[String; 2]> {
        let text: Value = image::text_of(path)?;
        let [scene, digest] = ["scene", "digest"].map(|key| text["identity"][key].as_str().map(str::to_owned));
        Some([scene?, digest?])
    }
}
