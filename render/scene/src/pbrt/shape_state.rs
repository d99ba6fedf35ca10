//! What the graphics state of a scene file makes of a shape.

use super::area_lights::Area;
use super::given::Given;
use super::inputs::Files;
use super::material_parameters::Finish;
use super::named_materials::NamedMaterials;
use super::params::Params;
use super::textures::Textures;
use crate::builder::Builder;
use crate::shape_attributes::ShapeAttributes;
use crate::transform::Transform;
use etendue_render::scene::Message;
use etendue_render::scene::texture::{Mask, Texture};

/// The part of the graphics state that applies to a shape.
pub(super) struct ShapeState {
    /// To world space.
    pub(super) ctm: Transform,
    /// Whether `ReverseOrientation` holds.
    pub(super) reverse: bool,
    pub(super) material: Finish,
    /// The chance that a ray is stopped by this part of a mixture, if it has passed those before; `None` if the material is no mixture.
    pub(super) share: Option<Texture>,
    pub(super) area: Area,
    /// Whether an object is being read.
    pub(super) is_object: bool,
}

impl ShapeState {
    /// The attributes of a shape with these parameters; none if it is not there.
    pub(super) fn attributes(
        self,
        kind: &str,
        params: &mut Params,
        files: Files<'_>,
        textures: &Textures,
        named: &mut NamedMaterials,
        out: &mut Builder,
    ) -> Result<Option<ShapeAttributes>, Message> {
        let det = self.ctm.determinant();
        params.require(det != 0.0 && det.is_finite(), || "its transform is singular")?;
        let opacity = textures.number("alpha", &mut Given { params, files, notes: &mut out.notes, ctm: &self.ctm })?;
        let is_absent = |opacity: &Texture| opacity.constant().is_some_and(|[x, ..]| x <= 0.0);
        if opacity.as_ref().is_some_and(is_absent) && self.area.emission.is_none() {
            params.ignore_all();
            return Ok(None);
        }
        let opacity = opacity.filter(|opacity| opacity.constant().is_none_or(|[x, ..]| x < 1.0));
        let Area { mut emission, picture, mut profile, power } = self.area;
        let Some(material) = named.of_shape(self.material, out) else {
            if emission.is_some() {
                out.notes.warn(params.error("a light of material \"interface\" emits nothing, as in pbrt"));
            }
            params.ignore_all();
            return Ok(None);
        };
        if emission.is_some() && self.is_object {
            out.notes.stand_in("light in an object", || params.error("a light in an object emits nothing, as in pbrt"));
            emission = None;
        }
        if let Some(emission) = emission.as_mut().filter(|emission| kind == "sphere" && emission.spread.is_some()) {
            let what = if profile.is_some() { "profile" } else { "spread" };
            out.notes.stand_in(what, || params.error(format!("a sphere has no {what:?}: it emits in all directions")));
            (emission.spread, profile) = (None, None);
        }
        // as in pbrt, a lamp of opacity 0 lights the scene, and no ray meets it
        if let Some((emission, opacity)) = emission.as_mut().zip(opacity.as_ref()) {
            let mean = opacity.mean()[0].clamp(0.0, 1.0);
            emission.is_unseen = mean == 0.0;
            if mean > 0.0 {
                emission.radiance =
                    emission.radiance.map(|x| (x * mean).max(if x > 0.0 { f32::MIN_POSITIVE } else { 0.0 }));
                let what = "\"alpha\": a light with holes becomes opaque, and dimmer by its mean opacity";
                out.notes.stand_in("light with holes", || params.error(what));
            }
        }
        // a part of a mixture is made of triangles, as the others are, even if it has no holes
        let opacity = match (opacity, self.share) {
            (opacity, None) => opacity,
            (None, share) => share,
            (Some(opacity), Some(share)) => Some(opacity.times(share)),
        };
        let mask = opacity.map(|opacity| Mask { opacity, least: None });
        Ok(Some(ShapeAttributes {
            ctm: self.ctm,
            flip: self.reverse != (det < 0.0),
            material: match mask {
                Some(mask) if emission.is_none() => {
                    let whole = out.materials.material(material);
                    out.materials.masked(whole, mask)
                }
                _ => out.materials.material(material),
            },
            emission,
            picture,
            profile,
            power,
        }))
    }
}
