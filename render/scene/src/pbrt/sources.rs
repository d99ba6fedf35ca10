//! What the `LightSource` directives of a scene file create.

use super::environment::Environment;
use super::inputs::Files;
use super::lights::{self, DeltaLight, Source};
use super::message::{Message, Notes};
use super::params::Params;
use super::transform::Transform;
use super::{directed, portal_sides, profiles};
use crate::intensity::Intensity;
use etendue::light::Portal;
use std::sync::Arc;

/// The lights that are not shapes.
#[derive(Default)]
pub(super) struct Sources {
    pub(super) delta_lights: Vec<DeltaLight>,
    /// The tables of those whose intensity differs by direction.
    pub(super) intensities: Vec<Arc<Intensity>>,
    pub(super) environment: Option<Environment>,
    /// The portals, with what to say if one faces away.
    pub(super) portals: Vec<(Portal, Message)>,
}

impl Sources {
    /// Reads a `LightSource`.
    pub(super) fn read(
        &mut self,
        kind: &str,
        params: &mut Params,
        ctm: &Transform,
        files: &Files<'_>,
        notes: &mut Notes,
    ) -> Result<(), Message> {
        let table = self.intensities.len() as u32;
        if ["goniometric", "projection"].contains(&kind) {
            self.push(directed::read(kind, params, ctm, files, notes, table)?);
            return Ok(());
        }
        let profile = match if kind == "spot" { params.text("profile")? } else { None } {
            // of its power, the falloff is only a part
            Some(name) => {
                let given = (lights::scale(params)?, lights::power(params)?);
                Some((profiles::read(&name, params, files, notes)?, given))
            }
            None => None,
        };
        match lights::read(kind, params, ctm, files, notes)? {
            Source::Delta(light) => match profile {
                None => self.delta_lights.push(light),
                Some((None, _)) => notes.warn(params.error("emits nothing")),
                Some((Some(profile), given)) => {
                    self.push(directed::spot(light, given, profile, params, ctm, notes, table)?);
                }
            },
            Source::Environment(environment) => {
                let facing = |portal: &Portal| (*portal, portal_sides::faces_away(params));
                self.portals.extend(environment.portals.iter().map(facing));
                self.environment = match self.environment.take() {
                    None => Some(environment),
                    Some(before) => {
                        let kept = before.clone();
                        before.and(environment).or_else(|| {
                            notes.stand_in("second sky", || params.error("a second sky is ignored"));
                            Some(kept)
                        })
                    }
                };
            }
            Source::Dark => {}
        }
        Ok(())
    }
    /// Adds a light with its table, unless it is dark.
    fn push(&mut self, read: Option<(DeltaLight, impl Into<Arc<Intensity>>)>) {
        if let Some((light, intensity)) = read {
            self.delta_lights.push(light);
            self.intensities.push(intensity.into());
        }
    }
}
