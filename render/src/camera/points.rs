//! Shading points: where paths from the camera end, and what fraction of the light there reaches the camera.

use crate::bvh::{GROUP, PrimitiveIds};
use crate::packet::{M8, V8};
use crate::surfaces::Surface;
use crate::surfaces::bsdf::Metal;
use crate::surfaces::lobe::Lobe;
use etendue::Mask;

/// The shading points of a group of packets.
#[derive(Clone)]
pub(crate) struct Points {
    /// The surfaces as they are lit.
    pub(crate) surfaces: [Surface; GROUP],
    pub(crate) places: [PointIdentity; GROUP],
    /// What else is known of surfaces that are not flat and diffuse.
    pub(crate) ends: [End; GROUP],
    /// The fits of rough surfaces, where they have been [noted](Self::note_lobes).
    pub(crate) lobes: [Option<Lobe>; GROUP],
}

/// The places of a packet of shading points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointIdentity {
    /// What their surfaces are parts of.
    pub(crate) primitives: PrimitiveIds,
    /// Lanes that the camera sees directly.
    pub(crate) direct: M8,
    /// The pixel of a packet that belongs to a single one.
    pub(crate) pixel: Option<[u32; 2]>,
    /// Lanes of rough surfaces with a fit, …
    pub(crate) fitted: M8,
    /// … and of those that are neither diffuse nor have one.
    pub(crate) unfitted: M8,
}

/// Surfaces that are not flat and diffuse.
#[derive(Clone, Copy)]
pub(crate) struct End {
    /// Directions of the rays that hit the surfaces.
    pub(crate) direction: V8,
    pub(crate) metal: Option<Metal>,
    /// Lanes whose surface has the normal of a smooth one.
    pub(crate) smooth: M8,
    /// Normals of the flat surfaces.
    pub(crate) flat: V8,
    /// Fractions of the light leaving the surfaces that reach the camera.
    pub(crate) throughput: V8,
}

impl Points {
    /// Before any ray has hit.
    pub(crate) fn new() -> Self {
        let none = M8::splat(false);
        let place = PointIdentity {
            primitives: PrimitiveIds::none(),
            direct: M8::splat(true),
            pixel: None,
            fitted: none,
            unfitted: none,
        };
        Self {
            surfaces: [Surface::default(); GROUP],
            places: [place; GROUP],
            ends: [End::start(); GROUP],
            lobes: [const { None }; GROUP],
        }
    }
    /// Forgets the points of a packet.
    #[inline]
    pub(crate) fn start(&mut self, packet: usize) {
        self.surfaces[packet] = Surface::default();
        self.ends[packet] = End::start();
    }
    /// Ends the paths of these lanes of a packet at a surface with this finish, and the normals `flat` without interpolation.
    #[inline]
    pub(crate) fn settle(
        &mut self,
        packet: usize,
        lanes: M8,
        surface: &Surface,
        flat: V8,
        (metal, smooth): (&Metal, M8),
    ) {
        let (own, end) = (&mut self.surfaces[packet], &mut self.ends[packet]);
        end.smooth = end.smooth | (smooth & lanes);
        end.flat = V8::blend(lanes, flat, end.flat);
        if lanes.any() {
            own.point = V8::blend(lanes, surface.point, own.point);
            own.normal = V8::blend(lanes, surface.normal, own.normal);
            own.albedo = V8::blend(lanes, surface.albedo, own.albedo);
            own.reflects = own.reflects | lanes;
            match &mut end.metal {
                Some(own) => own.put(lanes, metal),
                none => *none = Some(*metal),
            }
        }
    }
    /// Notes the fits of the rough surfaces of the first packets.
    pub(crate) fn note_lobes(&mut self, count: usize) {
        for p in 0..count {
            let (end, surface, place) = (&self.ends[p], &self.surfaces[p], &mut self.places[p]);
            let lobe = end.metal.as_ref().and_then(|metal| metal.lobe(surface.normal, surface.albedo, -end.direction));
            place.fitted = lobe.as_ref().map_or(M8::splat(false), |lobe| lobe.lanes & !end.smooth);
            place.unfitted = end.smooth | end.rough() & !place.fitted;
            self.lobes[p] = lobe;
        }
    }
}

impl End {
    /// Before any ray has hit.
    fn start() -> Self {
        let zero = V8::default();
        Self { direction: zero, metal: None, smooth: M8::splat(false), flat: zero, throughput: V8::from([1.0; 3]) }
    }
    /// Lanes of rough metals and of coats.
    #[inline]
    pub(crate) fn rough(&self) -> M8 {
        self.metal.as_ref().map_or(M8::splat(false), Metal::rough)
    }
}
