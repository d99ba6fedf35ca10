//! A scene ready to be rendered.

use crate::bvh::{BuildError, Hits, Scratch};
use crate::camera::{Camera, PreparedScene};
use crate::choose::ChoiceBy;
use crate::film::sensor::{Exposure, Sensor};
use crate::know::Know;
#[cfg(feature = "analytic")]
use crate::know::{Certifiable, Knowledge};
use crate::packet::{V8, X8};
use crate::scene::{CameraSettings, Scene};
use crate::settings::Settings;
use crate::technique::Technique;
use etendue::{Mask, Real};

/// A scene ready to be rendered.
#[derive(Debug)]
pub struct World {
    pub(super) scene: PreparedScene,
    /// What closed forms need.
    #[cfg(feature = "analytic")]
    pub(super) certifiable: Certifiable,
    pub(super) camera: CameraSettings,
    /// Diagonal of the film in millimetres.
    diagonal: f64,
    sensor: Sensor,
}

impl World {
    /// Builds the trees and tables of a scene.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn new(scene: &Scene) -> Result<Self, BuildError> {
        if let Some(mut scene) = scene.in_range() {
            return Self::from_scene(&mut scene);
        }
        Ok(Self::with(PreparedScene::new(scene)?, scene))
    }

    /// Like [`World::new`], but takes the triangles out of the scene and builds the tree in their memory.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn from_scene(scene: &mut Scene) -> Result<Self, BuildError> {
        if let Some(other) = scene.in_range() {
            *scene = other;
        }
        Ok(Self::with(PreparedScene::from_scene(scene)?, scene))
    }

    fn with(prepared: PreparedScene, scene: &Scene) -> Self {
        let (camera, diagonal) = (scene.camera.clone(), scene.film.diagonal);
        Self {
            #[cfg(feature = "analytic")]
            certifiable: Certifiable::new(scene, &prepared),
            scene: prepared,
            camera,
            diagonal,
            sensor: Sensor::default(),
        }
    }

    /// Size of the trees and their primitives in bytes.
    pub fn bytes(&self) -> usize {
        self.scene.surfaces.bvh.bytes()
    }

    /// The same world, with another sensor.
    #[must_use]
    pub fn with_sensor(self, sensor: Sensor) -> Self {
        Self { sensor, ..self }
    }

    /// The camera.
    pub const fn camera(&self) -> &CameraSettings {
        &self.camera
    }

    /// Replaces the camera.
    pub fn set_camera(&mut self, camera: CameraSettings) {
        self.camera = camera;
    }

    /// The distance along the camera's axis of what it sees there; `None` if that is nothing.
    pub fn depth(&self) -> Option<f64> {
        let bvh = &self.scene.surfaces.bvh;
        let [origin, forward] = [self.camera.origin, self.camera.forward].map(|v| V8::from(v.map(|x| x as f32)));
        let mut hits = [Hits::none(X8::splat(f32::INFINITY))];
        let active = [X8::splat(0.0).le(X8::splat(1.0))];
        bvh.closest(&[bvh.rays(origin, forward)], &active, &mut hits, &mut Scratch::default());
        hits[0].any().lane(0).then(|| f64::from(hits[0].distance.lane(0)))
    }

    /// The part of all directions in which rays escape, from a little before what the camera sees on its axis, by 4,096 directions; `None` if it
    /// sees nothing there. Inside of a room, it is the part that its windows have.
    pub fn openness(&self) -> Option<f64> {
        const PACKETS: usize = 512;
        let bvh = &self.scene.surfaces.bvh;
        let ahead = 0.9 * self.depth()?;
        let place = [0, 1, 2].map(|k| (self.camera.origin[k] + ahead * self.camera.forward[k]) as f32);
        let (active, mut scratch) = ([X8::splat(0.0).le(X8::splat(1.0))], Scratch::default());
        let mut escaped = 0;
        for packet in 0..PACKETS {
            // a spiral over the sphere
            let direction = |lane: usize| {
                let k = (packet * 8 + lane) as f64 + 0.5;
                let z = 1.0 - 2.0 * k / (8 * PACKETS) as f64;
                let (sin, cos) = libm::sincos(k * 2.399_963_229_728_653);
                let r = (1.0 - z * z).max(0.0).sqrt();
                [r * cos, r * sin, z].map(|x| x as f32)
            };
            let all: [[f32; 3]; 8] = std::array::from_fn(direction);
            let axis = |k: usize| X8::from(all.map(|v| v[k]));
            let mut hits = [Hits::none(X8::splat(f32::INFINITY))];
            let rays = [bvh.rays(V8::from(place), V8::new(axis(0), axis(1), axis(2)))];
            bvh.closest(&rays, &active, &mut hits, &mut scratch);
            escaped += hits[0].any().bits().count_zeros() as usize - 24;
        }
        Some(escaped as f64 / (8 * PACKETS) as f64)
    }

    /// Checks that the scene can be rendered as these settings say.
    ///
    /// # Errors
    /// Says what the choice of a light would need, or that the technique needs the feature `analytic` of this package.
    pub fn check(&self, settings: &Settings) -> Result<(), String> {
        if settings.technique == Technique::Analytic && !cfg!(feature = "analytic") {
            return Err("the technique analytic needs the feature analytic of etendue-render".into());
        }
        let sampled = self.scene.sampled(settings.technique, settings.choice);
        sampled.map(|_| ()).map_err(|what| format!("the choice {} needs {what}", settings.choice.name()))
    }

    /// Whether light is computed without samples where that can be. That requires few lights that all have an area, unless a choice among
    /// them is to be seen: behind portals, what is known of a sky would save next to nothing. (In `render/gallery/emitters/windows.pbrt`,
    /// 0.8 % of the shadow rays leave squares of 4 × 4 pixels in which none arrives, and there is no square in which all do, since the
    /// reveals of the windows hide some of the sky.)
    pub(super) fn is_analytic(&self, settings: &Settings) -> bool {
        let is_asked = cfg!(feature = "analytic") && settings.technique == Technique::Analytic;
        is_asked && settings.choice == ChoiceBy::Auto && self.scene.lights.only_few_areas()
    }

    /// What knows lights without samples, if a technique asks for that.
    pub(super) fn know(&self, settings: &Settings, camera: &Camera) -> Option<Box<dyn Know + '_>> {
        let asked = self.is_analytic(settings).then_some(camera);
        #[cfg(feature = "analytic")]
        let know = |camera| -> Box<dyn Know + '_> {
            Box::new(Knowledge::new(&self.scene, &self.certifiable, camera, settings))
        };
        #[cfg(not(feature = "analytic"))]
        let know = |_| unreachable!("nothing is analytic without the feature");
        asked.map(know)
    }

    /// Whether there is a light that closed forms can know.
    #[cfg(feature = "analytic")]
    pub(super) fn has_closed_forms(&self, settings: &Settings) -> bool {
        self.is_analytic(&Settings { technique: Technique::Analytic, ..*settings }) && !self.certifiable.only_sampled()
    }

    /// Without closed forms, there is none.
    #[cfg(not(feature = "analytic"))]
    pub(super) fn has_closed_forms(&self, _: &Settings) -> bool {
        false
    }

    /// The weights of radiance in an image of this size; `None` if the sensor measures radiance itself.
    pub fn exposure(&self, width: u32, height: u32) -> Option<Exposure> {
        Exposure::new(self.sensor, &self.camera, self.diagonal, [width, height])
    }
}
