//! The kinds of lights: each is a file, which has all that is special about it. Those of lights that are shapes are in
//! [`geometry`].

use super::chosen::Chosen;
use super::directed::DirectedLight;
use super::record::{
    DIRECTED, KINDS, LightRecord, PICTURED, POINT, PROFILED, SPOT, SPREAD, SUN, TWO_SIDED, UNSEEN, in_set, sum, wide,
};
use super::{point, spot, sun};
use crate::bvh::PrimitiveId;
use crate::geometry::{self, Extent};
use crate::packet::{V8, X8};
use crate::scene::{DeltaLight, Scene, Shape};
use etendue::select::LightBound;
use etendue::{LightSample, Vec2, Vec3};

/// In a set of kinds, there is a light with a spread.
pub(super) const SPREADS: u32 = in_set(SPREAD);
/// There is a light that shows a picture.
pub(super) const PICTURES: u32 = in_set(PICTURED);
/// There is a light with an area and a profile.
pub(super) const PROFILES: u32 = in_set(PROFILED);
/// There is a light with an area that no ray can hit.
pub(super) const UNSEENS: u32 = in_set(UNSEEN);
/// Lights whose radiance or intensity differs by direction, but for the sky.
pub(super) const UNEVEN: u32 = 1 << DIRECTED | SPREADS | PROFILES;
pub(super) const ONLY_DELTAS: u32 = 1 << POINT | 1 << SPOT | 1 << SUN | 1 << DIRECTED;
pub(super) const ONLY_AREAS: u32 = SHAPES | SPREADS | PICTURES | PROFILES | UNSEENS;

/// All shapes, as a set.
pub(super) const SHAPES: u32 = geometry::KINDS;
const _: () = assert!(SHAPES >> POINT == 0, "shapes are the first kinds");

/// The extent of a light, and the cosine to its normal or axis from which on it is dark.
fn extent(record: &LightRecord, kind: u32) -> (Extent, f32) {
    let of_shape = geometry::extent(kind, record.vectors().map(wide)).map(|extent| (extent, 0.0));
    of_shape.unwrap_or_else(|| match kind {
        SPOT | DIRECTED => spot::extent(record),
        _ => (record.point(), 0.0),
    })
}

/// Samples lights of a kind without an area in all lanes.
#[inline]
pub(super) fn sample_delta(kind: u32, chosen: &Chosen, p: V8, u: Vec2<X8>) -> LightSample<X8> {
    match kind {
        POINT => point::sample(chosen, p, u),
        SPOT => spot::sample(chosen, p, u),
        _ => sun::sample(chosen, u),
    }
}

/// A shape that emits.
pub(super) fn of_shape(index: u32, shape: &Shape) -> Option<LightRecord> {
    let emission = shape.emission?;
    let [place, first, second] = shape.geometry.vectors();
    let flag = |is: bool, flag: u32| if is { flag } else { 0 };
    let kind = shape.geometry.kind()
        | flag(emission.two_sided, TWO_SIDED)
        | flag(emission.spread.is_some(), SPREAD)
        | flag(emission.picture.is_some(), PICTURED)
        | flag(emission.profile.is_some(), PROFILED)
        | flag(emission.is_unseen, UNSEEN);
    let (radiance, spread) = (emission.radiance, emission.spread.unwrap_or_default());
    let sides = if emission.two_sided { 2.0 } else { 1.0 };
    let power = sum(radiance) * shape.geometry.area() * sides;
    let primitive = PrimitiveId::of_shape(index);
    Some(LightRecord { place, first, second, radiance, spread, kind, primitive, power })
}

/// The shapes that emit, in the order of the scene.
pub(super) fn area_lights(shapes: &[Shape]) -> impl Iterator<Item = LightRecord> {
    (0..).zip(shapes).filter_map(|(index, shape)| of_shape(index, shape))
}

/// The lights without an area, in the order of the scene, and those of them that are directed.
pub(super) fn delta_lights(scene: &Scene) -> (Vec<LightRecord>, Vec<DirectedLight>) {
    let mut all_directed = Vec::new();
    let light = |light: &DeltaLight| match *light {
        DeltaLight::Point { position, intensity } => point::record(position, intensity),
        DeltaLight::Spot { position, axis, one_minus_cos_inner, one_minus_cos_outer, intensity } => {
            spot::record(position, axis, [one_minus_cos_inner, one_minus_cos_outer], intensity)
        }
        DeltaLight::Distant { direction, irradiance } => sun::record(direction, irradiance),
        DeltaLight::Directed { position, to_light, intensity, table, cone } => {
            let directed = DirectedLight::new(position, to_light, &scene.intensities[table as usize], cone);
            let record = directed.record(position, intensity, cone, all_directed.len() as u32);
            all_directed.push(directed);
            record
        }
    };
    (scene.delta_lights.iter().map(light).collect(), all_directed)
}

impl LightRecord {
    /// The bound of what a light contributes, for a power in any unit. A light infinitely far away has no power in it.
    pub(crate) fn bound(&self, power: f64) -> LightBound {
        let (Extent { center, radius, normal }, cos_cone) = extent(self, self.kind & KINDS);
        let length = normal.length();
        let narrow = |v: Vec3<f64>| [v.x, v.y, v.z].map(|x| x as f32);
        let two_sided = self.kind & TWO_SIDED != 0;
        LightBound {
            center: narrow(center),
            // the rounding of the centre moves the sphere by less than this
            radius: (radius * (1.0 + 1e-6)) as f32,
            normal: narrow(if length > 0.0 { normal * (1.0 / length) } else { normal }),
            cos_cone: if self.kind & SPREAD == 0 { cos_cone } else { self.spread.cos_cone() },
            two_sided: two_sided && length > 0.0,
            power: match self.far() {
                Some(_) => 0.0,
                None => (power as f32 * if two_sided { 0.5 } else { 1.0 }).max(f32::MIN_POSITIVE),
            },
        }
    }
    /// The set of its kind and its flags.
    pub(super) fn kinds(&self) -> u32 {
        let kind = self.kind;
        1 << (kind & KINDS) | in_set(kind & (SPREAD | PICTURED | PROFILED | UNSEEN))
    }
}
