//! What the `LightSource` directives of a scene file create.

use super::given::Given;
use super::lights::{self, Source};
use super::{directed, portal_sides, profiles};
use etendue::light::{Portal, PortalEnvironment};
use etendue_render::scene::intensity::Intensity;
use etendue_render::scene::limits::MOST_RADIANCE;
use etendue_render::scene::{DeltaLight, Environment, Message, SkyRadiance};
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
    pub(super) fn read(&mut self, kind: &str, given: &mut Given<'_>) -> Result<(), Message> {
        let table = self.intensities.len() as u32;
        if kind == "goniometric" {
            self.push(directed::read(given, table)?);
            return Ok(());
        }
        if kind == "projection" {
            given.stand_in(kind, "lights of this type are left out");
            return Ok(());
        }
        let profile = match if kind == "spot" { given.text("profile")? } else { None } {
            // of its power, the falloff is only a part
            Some(name) => {
                let strength = (lights::scale(given)?, lights::power(given)?);
                Some((profiles::read(&name, given)?, strength))
            }
            None => None,
        };
        match lights::read(kind, given)? {
            Source::Delta(light) => match profile {
                None => self.delta_lights.push(light),
                Some((None, _)) => given.warn("emits nothing"),
                Some((Some(profile), strength)) => {
                    self.push(directed::spot(light, strength, profile, given, table)?);
                }
            },
            Source::Environment(environment) => {
                let facing = |portal: &Portal| (*portal, portal_sides::faces_away(given));
                self.portals.extend(environment.portals.iter().map(facing));
                self.environment = match self.environment.take() {
                    None => Some(environment),
                    Some(before) => {
                        let kept = before.clone();
                        both(before, environment).or_else(|| {
                            given.stand_in("second sky", "a second sky is ignored");
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

/// The sum of two skies, if one of them is the same in all directions, or if both are the same sky through other portals.
fn both(mut one: Environment, other: Environment) -> Option<Environment> {
    if !one.portals.is_empty() && !other.portals.is_empty() && (one.to_light, one.sun) == (other.to_light, other.sun) {
        let are_few = one.portals.len() + other.portals.len() <= PortalEnvironment::MOST;
        if are_few && one.sky == other.sky {
            one.portals.extend(other.portals);
            return Some(one);
        }
    }
    if !(one.portals.is_empty() && other.portals.is_empty()) || one.sun.is_some() && other.sun.is_some() {
        return None;
    }
    let sun = one.sun.or(other.sun);
    let add = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| (a[k] + b[k]).min(MOST_RADIANCE));
    let (constant, other) = match (one.sky, other.sky) {
        (SkyRadiance::Constant(a), sky) => (a, Environment { sky, ..other }),
        (sky, SkyRadiance::Constant(b)) => (b, Environment { sky, to_light: one.to_light, ..other }),
        _ => return None,
    };
    let sky = match other.sky {
        SkyRadiance::Constant(b) => SkyRadiance::Constant(add(constant, b)),
        SkyRadiance::Image { width, map, texels } => {
            let texels = texels.into_iter().map(|texel| add(texel, constant)).collect();
            SkyRadiance::Image { width, map, texels }
        }
    };
    Some(Environment { sky, sun, ..other })
}
