//! The portals of a sky, with their tables.

use crate::packet::{V8, X8};
use etendue::light::{Portal, PortalEnvironment, PortalMap, PortalTable};
use etendue::owned::OwnedTree;
use etendue::real::Real;
use etendue::select::LightBound;
use etendue::{Vec2, Vec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// The portals of a sky. Parallel ones share a table.
#[derive(Clone, Debug)]
pub(super) struct SkyPortals {
    portals: Vec<Portal>,
    /// The table of each portal.
    of: Vec<usize>,
    tables: Vec<Vec<u64>>,
    /// Columns and rows of a table.
    size: usize,
    /// The portals as lights.
    tree: OwnedTree,
}

/// Bounds of the number of columns and rows.
const LEAST: usize = 64;
const MOST: usize = 1024;
/// Greatest number of places per texel of a table at which the sky is looked up, along each axis.
const MOST_PLACES: usize = 16;

impl SkyPortals {
    /// Tables of a sky whose texels span this angle, by a function that looks it up. The tables are about as fine as the image, within bounds,
    /// and the sky is looked up at every half texel of it, so that no small sun is missed.
    pub(super) fn new(portals: &[Portal], texel: f64, radiance: impl Fn(V8) -> X8 + Sync) -> Option<Self> {
        if portals.is_empty() {
            return None;
        }
        let wanted = PI / texel;
        let size = (wanted as usize).clamp(LEAST, MOST);
        let places = ((2.0 * wanted / size as f64).ceil() as usize).clamp(2, MOST_PLACES);
        let mut maps: Vec<PortalMap> = Vec::new();
        let of = portals.iter().map(|portal| {
            let map = portal.map();
            maps.iter().position(|known| *known == map).unwrap_or_else(|| {
                maps.push(map);
                maps.len() - 1
            })
        });
        let of: Vec<_> = of.collect();
        let (tables, irradiances): (_, Vec<_>) = maps.iter().map(|map| table(map, size, places, &radiance)).unzip();
        let powers = portals.iter().zip(&of).map(|(portal, of)| portal.area() * irradiances[*of]);
        let bounds: Vec<LightBound> =
            portals.iter().zip(powers).map(|(portal, power)| bound(portal, power as f32)).collect();
        let tree = OwnedTree::new(&bounds, &()).expect("a few portals");
        Some(Self { portals: portals.to_vec(), of, tables, size, tree })
    }
    /// An estimate of the irradiance that comes through the portals, summed over channels.
    #[inline]
    pub(super) fn irradiance(&self, p: V8, normal: V8) -> X8 {
        self.tree.irradiance(&self.tree.get().at(p, normal))
    }
    /// What `run` makes of the portals.
    #[inline]
    pub(super) fn all<T>(&self, run: impl FnOnce(&PortalEnvironment<'_>) -> T) -> T {
        let table = |k: usize| PortalTable::from_buffer(&self.tables[k], self.size).expect("a table of its own size");
        let mut tables = [table(0); PortalEnvironment::MOST];
        for (k, of) in self.of.iter().enumerate().filter(|(_, of)| **of > 0) {
            tables[k] = table(*of);
        }
        let tables = &tables[..self.portals.len()];
        run(&PortalEnvironment::new(&self.portals, tables).expect("the scene reader has counted the portals"))
    }
}

/// A portal as a light of this power.
fn bound(portal: &Portal, power: f32) -> LightBound {
    let ([s, t], corner) = (portal.edges(), Vec3::from(portal.corner().map(f64::from)));
    let center = corner + (s + t) * 0.5;
    let radius = 0.5 * (s + t).length().max((s - t).length());
    let narrow = |v: Vec3<f64>| [v.x, v.y, v.z].map(|x| x as f32);
    LightBound {
        center: narrow(center),
        // the rounding of the centre moves the sphere by less than this
        radius: (radius * (1.0 + 1e-6)) as f32,
        // towards those who see the sky
        normal: narrow(t.cross(s).normalize()),
        power: power.max(f32::MIN_POSITIVE),
        ..LightBound::default()
    }
}

/// The sky before a portal, and the irradiance of the portal by it. A dark sky counts as one of the same radiance everywhere.
fn table(map: &PortalMap, size: usize, places: usize, radiance: &(impl Fn(V8) -> X8 + Sync)) -> (Vec<u64>, f64) {
    let step = 1.0 / (size * places) as f64;
    let weight = |x: usize, y: usize| -> f64 {
        let mut sum = 0.0;
        for first in (0..places * places).step_by(8) {
            let place = |k: usize| ((first + k) % places, (first + k) / places);
            let at = |corner: usize, inner: usize| ((corner * places + inner) as f64 + 0.5) * step;
            let u = Vec2::new(X8::from_fn(|k| at(x, place(k).0) as f32), X8::from_fn(|k| at(y, place(k).1) as f32));
            let (direction, solid_angle) = map.direction(u);
            let worth = radiance(direction) * solid_angle;
            sum += (0..8.min(places * places - first)).map(|k| worth.lane_f64(k)).sum::<f64>();
        }
        sum / (places * places) as f64
    };
    let mut weights = vec![0.0; size * size];
    let axis = map.direction(Vec2::new(0.5_f64, 0.5)).0;
    let received: Vec<f64> = weights
        .par_chunks_mut(size)
        .enumerate()
        .map(|(y, row)| {
            let mut sum = 0.0;
            for (x, entry) in row.iter_mut().enumerate() {
                *entry = weight(x, y).min(f64::from(f32::MAX)) as f32;
                let middle = [x, y].map(|i| (i as f64 + 0.5) / size as f64);
                sum += f64::from(*entry) * map.direction(Vec2::new(middle[0], middle[1])).0.dot(axis);
            }
            sum
        })
        .collect();
    let irradiance = received.iter().sum::<f64>() / (size * size) as f64;
    if weights.iter().all(|w| *w == 0.0) {
        weights.fill(1.0);
    }
    let mut buffer = vec![0; PortalTable::buffer(size, size)];
    PortalTable::build(&weights, size, &mut buffer).expect("valid weights");
    (buffer, irradiance)
}
