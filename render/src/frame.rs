//! What an image depends on, so that its parts can be recognised.

use crate::area::Place;
use crate::files::{FileError, failed, read_file};
use crate::limits::{MOST_SAMPLES, MOST_SIDE, is_size};
use crate::options::name;
use crate::sampler::Sampler;
use crate::scene::Scene;
use crate::sensor::{Exposure, Sensor};
use crate::settings::Settings;
use crate::technique::Technique;
use clap::ValueEnum;
use serde_json::{Value, json};
use xxhash_rust::xxh3::Xxh3;

/// Everything that an image depends on. Equal frames have equal images, bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The scene's name, for messages.
    pub scene: String,
    /// Hash of the files of the scene, in hexadecimal digits; of its name if it is built in.
    pub digest: String,
    /// The settings, with a sampler that is not left open.
    pub settings: Settings,
    /// What is measured.
    pub sensor: Sensor,
    /// Where the image is in the whole one, if it is only a part.
    pub place: Option<Place>,
    /// Whether the camera has a lens.
    pub lens: bool,
    /// The value of unit radiance at the middle of the image, in the unit of the sensor: the PNG is exposed by it.
    pub exposure: f64,
    /// The version, processor features and sources of the program.
    pub build: String,
}

/// The build of this program.
pub const BUILD: &str = env!("ETENDUE_BUILD");

/// Hash of the files of a scene, in hexadecimal digits; of its name if it is built in.
///
/// # Errors
/// Fails if a file of the scene cannot be read again.
pub fn digest(scene: &Scene) -> Result<String, FileError> {
    let mut hash = Xxh3::new();
    hash.update(scene.name.as_bytes());
    for file in &scene.inputs {
        let bytes = read_file(file).map_err(|error| failed(file, format!("cannot read it again: {error}")))?;
        hash.update(&(bytes.len() as u64).to_le_bytes());
        hash.update(&bytes);
    }
    Ok(format!("{:032x}", hash.digest128()))
}

impl Frame {
    /// The frame that this program renders.
    ///
    /// # Errors
    /// Fails if a file of the scene cannot be read again.
    pub fn new(scene: &Scene, settings: Settings, sensor: Sensor) -> Result<Self, FileError> {
        let size = [settings.width, settings.height];
        let exposure = Exposure::new(sensor, &scene.camera, scene.film.diagonal, size);
        Ok(Self {
            scene: scene.name.clone(),
            digest: digest(scene)?,
            settings,
            sensor,
            place: scene.film.place,
            lens: scene.camera.lens.is_some(),
            exposure: exposure.map_or(1.0, |exposure| exposure.on_axis()),
            build: BUILD.to_owned(),
        })
    }

    /// Samples in a set; 0 if each sample is independent.
    pub fn span(&self) -> u32 {
        if self.settings.sampler.has_sets() { self.settings.spp / self.sets() } else { 0 }
    }
    /// Sets of samples of a pixel.
    pub fn sets(&self) -> u32 {
        self.settings.sampler.sets(self.settings.spp, self.settings.sets, self.lens)
    }

    /// The frame as a JSON object.
    pub fn to_json(&self) -> Value {
        let Settings { width, height, spp, technique, depth, sampler, sets, seed } = self.settings;
        json!({
            "scene": self.scene,
            "digest": self.digest,
            "width": width,
            "height": height,
            "spp": spp,
            "technique": name(technique),
            "depth": depth,
            "sampler": name(sampler),
            "sets": sets,
            "seed": seed,
            "sensor": name(self.sensor),
            "place": self.place.map(|Place { start: [x, y], whole: [across, down] }| [x, y, across, down]),
            "lens": self.lens,
            "exposure": format!("{:?}", self.exposure),
            "build": self.build,
        })
    }

    /// Reads what [`to_json`](Self::to_json) wrote.
    ///
    /// # Errors
    /// Names the first value that is missing or not possible.
    pub fn from_json(value: &Value) -> Result<Self, String> {
        let wrong = |key: &str| format!("{key:?} is missing or wrong: {}", value[key]);
        let number = |key: &str| value[key].as_u64().ok_or_else(|| wrong(key));
        let small =
            |key: &str, most: u32| u32::try_from(number(key)?).ok().filter(|&n| n <= most).ok_or_else(|| wrong(key));
        let text = |key: &str| value[key].as_str().map(str::to_owned).ok_or_else(|| wrong(key));
        fn choice<T: ValueEnum>(text: &str, wrong: String) -> Result<T, String> {
            T::from_str(text, false).map_err(|_| wrong)
        }
        let settings = Settings {
            width: small("width", MOST_SIDE)?,
            height: small("height", MOST_SIDE)?,
            spp: small("spp", MOST_SAMPLES)?,
            technique: choice::<Technique>(&text("technique")?, wrong("technique"))?,
            depth: small("depth", u32::MAX)?,
            sampler: choice::<Sampler>(&text("sampler")?, wrong("sampler"))?,
            sets: small("sets", 4)?,
            seed: number("seed")?,
        };
        let of_place = |numbers: &Vec<Value>| {
            let numbers: Vec<u64> =
                numbers.iter().map_while(Value::as_u64).filter(|n| *n <= MOST_SIDE.into()).collect();
            let &[x, y, across, down] = &numbers[..] else { return Err(wrong("place")) };
            let [right, lower] = [x + u64::from(settings.width), y + u64::from(settings.height)];
            if !is_size(across, down) || right > across || lower > down {
                return Err(wrong("place"));
            }
            Ok(Place { start: [x as u32, y as u32], whole: [across as u32, down as u32] })
        };
        let place = value["place"].as_array().map(of_place).transpose()?;
        let frame = Self {
            scene: text("scene")?,
            digest: text("digest")?,
            settings,
            sensor: choice::<Sensor>(&text("sensor")?, wrong("sensor"))?,
            place,
            lens: value["lens"].as_bool().ok_or_else(|| wrong("lens"))?,
            exposure: text("exposure")?.parse().ok().filter(|x| *x > 0.0).ok_or_else(|| wrong("exposure"))?,
            build: text("build")?,
        };
        let Settings { width, height, spp, sets, sampler, .. } = settings;
        if !is_size(width.into(), height.into()) || spp == 0 || sets == 3 {
            return Err(format!("no image has {width} × {height} pixels of {spp} samples in {sets} sets"));
        }
        sampler.check(spp, sets, frame.lens)?;
        Ok(frame)
    }

    /// How another frame differs, for a message; `None` if it does not.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let (own, other) = (self.to_json(), other.to_json());
        // what says most comes first
        let first = ["scene", "digest", "build"].into_iter();
        let keys = first.chain(own.as_object()?.keys().map(String::as_str));
        let differ = keys.into_iter().find(|&key| own[key] != other[key]);
        let what = |key: &str| match key {
            "digest" => "scene, by the hash of its files,".to_owned(),
            "spp" => "number of samples per pixel".to_owned(),
            "lens" => "answer to whether there is a lens".to_owned(),
            "build" => "build of etendue".to_owned(),
            other => other.to_owned(),
        };
        differ.map(|key| format!("its {} is {}, not {}", what(key), other[key], own[key]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;
    use std::fs;

    /// A place is read as it was written, and must be within the whole image.
    #[test]
    fn places_are_kept() {
        let view = "Camera \"perspective\" WorldBegin LightSource \"point\"";
        let film =
            "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 32 \"integer pixelbounds\" [10 20 5 9]";
        let scene = scene::parse(&format!("{film} {view}"), "a.pbrt", std::path::Path::new("")).unwrap();
        let (width, height) = (scene.film.width, scene.film.height);
        let (technique, sampler) = (Technique::Area, Sampler::Sobol);
        let settings = Settings { width, height, spp: 4, technique, depth: 8, sampler, sets: 0, seed: 0 };
        let frame = Frame::new(&scene, settings, Sensor::Radiance).unwrap();
        assert_eq!(frame.place, Some(Place { start: [10, 5], whole: [64, 32] }));
        let mut json = frame.to_json();
        assert_eq!(Frame::from_json(&json).unwrap(), frame);
        for wrong in [json!([10, 5, 64]), json!([55, 5, 64, 32]), json!([-1, 5, 64, 32]), json!([0, 0, u64::MAX, 32])] {
            json["place"] = wrong;
            assert!(Frame::from_json(&json).unwrap_err().contains("\"place\" is missing or wrong"));
        }
    }

    /// A changed texture or mesh makes another scene, even if the scene file stays as it was.
    #[test]
    fn digests_depend_on_all_files_of_a_scene() {
        let folder = std::env::temp_dir().join(format!("etendue-digest-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
        let ply = |x: u8| {
            format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                 element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n{x} 0 0\n0 1 0\n3 0 1 2\n"
            )
        };
        let picture = |x: f32| [&b"PF\n1 1\n-1.0\n"[..], &[x; 3].map(f32::to_le_bytes).concat()].concat();
        write("mesh.ply", &ply(1));
        fs::write(folder.join("picture.pfm"), picture(0.25)).unwrap();
        write(
            "scene.pbrt",
            "Camera \"perspective\"\nWorldBegin\nLightSource \"point\"\n\
             Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"picture.pfm\"\n\
             Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"plymesh\" \"string filename\" \"mesh.ply\"\n",
        );
        let found = || digest(&scene::load(folder.join("scene.pbrt").to_str().unwrap()).unwrap()).unwrap();
        let first = found();
        assert_eq!(found(), first);
        fs::write(folder.join("picture.pfm"), picture(0.5)).unwrap();
        let second = found();
        assert_ne!(second, first);
        write("mesh.ply", &ply(2));
        assert_ne!(found(), second);
        fs::write(folder.join("picture.pfm"), picture(0.25)).unwrap();
        write("mesh.ply", &ply(1));
        assert_eq!(found(), first);
        fs::remove_dir_all(&folder).unwrap();
    }
}
