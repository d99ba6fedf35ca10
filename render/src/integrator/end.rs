//! Where paths end: the surface as it is lit, and the fraction of its light that reaches the camera.

use crate::bsdf::{Bsdf, Metal};
use crate::packet::{M8, V8};
use crate::surfaces::Surface;
use etendue::{Mask, Real};

/// Where the paths of a packet end, in a scene with mirrors or metals.
#[derive(Clone, Copy)]
pub(super) struct End {
    /// Directions of the rays that hit the surfaces.
    pub(super) direction: V8,
    pub(super) metal: Option<Metal>,
    /// Lanes whose surface has the normal of a smooth one.
    pub(super) smooth: M8,
    /// Normals of the flat surfaces.
    pub(super) flat: V8,
    /// Fractions of the light leaving the surfaces that reach the camera.
    pub(super) throughput: V8,
}

/// The BSDF at the end of a path.
#[inline(always)]
pub(super) fn bsdf<const METAL: bool>(surface: &Surface, end: &End) -> Bsdf<METAL> {
    if METAL {
        Bsdf::new(surface.normal, end.flat, surface.albedo, end.direction, end.metal)
    } else {
        Bsdf::new(surface.normal, surface.normal, surface.albedo, V8::default(), None)
    }
}

impl End {
    /// Before any ray has hit.
    pub(super) fn start() -> Self {
        let zero = V8::default();
        Self { direction: zero, metal: None, smooth: M8::splat(false), flat: zero, throughput: zero }
    }
    /// Lanes of rough metals and of coats.
    #[inline]
    pub(super) fn rough(&self) -> M8 {
        self.metal.map_or(M8::splat(false), |metal| metal.rough())
    }
    /// Ends the paths of these lanes at a surface.
    #[inline]
    pub(super) fn settle(&mut self, own: &mut Surface, surface: &Surface, lanes: M8, direction: V8, metal: Metal) {
        if !lanes.any() {
            return;
        }
        own.point = V8::blend(lanes, surface.point, own.point);
        own.normal = V8::blend(lanes, surface.normal, own.normal);
        own.albedo = V8::blend(lanes, surface.albedo, own.albedo);
        own.reflects = own.reflects | lanes;
        self.direction = V8::blend(lanes, direction, self.direction);
        self.metal = Some(self.metal.map_or(metal, |other| Metal::select(lanes, &metal, &other)));
    }
    /// Reflects the rays of these lanes at mirrors; returns their origins and directions.
    #[inline]
    pub(super) fn reflect(&mut self, surface: &Surface, metal: &Metal, lanes: M8, direction: V8) -> (V8, V8) {
        let cos = -direction.dot(surface.normal);
        let share = product(self.throughput, metal.reflectance(cos));
        self.throughput = V8::blend(lanes, share, self.throughput);
        (surface.point, surface.normal.mul_add(cos + cos, direction).normalize())
    }
}

#[inline]
pub(super) fn keep(v: V8, mask: M8) -> V8 {
    V8::new(v.x.keep(mask), v.y.keep(mask), v.z.keep(mask))
}

#[inline]
pub(super) fn product(a: V8, b: V8) -> V8 {
    V8::new(a.x * b.x, a.y * b.y, a.z * b.z)
}
