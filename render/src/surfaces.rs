//! The surfaces of a scene: what rays hit, with its material.

pub mod bsdf;
pub mod coat;
mod interpolation;
pub mod lobe;

use crate::bvh::{BuildError, Bvh, Hits, LitSides, PrimitiveId, Rays, ShapeSet};
use crate::geometry::{Points, on_triangle, on_triangles, on_vast_triangles};
use crate::packet::{M8, V8, X8, first_lane};
use crate::scene::light_picture::LightPicture;
use crate::scene::light_profile::LightProfile;
use crate::scene::{Corners, Details, Material, NormalMap, Scene, Shape, Varying};
use bsdf::{MaterialRecord, Metal, PLAIN, albedo, record};
use etendue::{Mask, Real, Vec3};
use interpolation::{
    Barycentric, along_u, between, facing, interpolated, is_behind, lane_of, moved, outward, set_lane, turned,
};
use std::collections::HashMap;
use std::sync::Arc;

/// In scenes with greater coordinates, hits of triangles are points of rays, not of triangles.
const VAST: f32 = (1_u64 << 40) as f32;

/// The hit points of eight rays.
#[derive(Clone, Copy)]
pub struct Surface {
    /// Positions, moved off the surface towards the ray by more than their rounding.
    pub point: V8,
    /// Unit normals on the side of the ray.
    pub normal: V8,
    /// Albedo per channel; 1 for metals and mirrors.
    pub albedo: V8,
    /// Radiance emitted towards the ray.
    pub emission: V8,
    /// Lanes that reflect.
    pub reflects: M8,
}

impl Default for Surface {
    fn default() -> Self {
        let zero = V8::default();
        Self { point: zero, normal: zero, albedo: zero, emission: zero, reflects: M8::splat(false) }
    }
}

/// Everything that rays can hit.
#[derive(Debug)]
pub struct Surfaces {
    /// The trees of triangles and shapes.
    pub bvh: Bvh,
    /// Spheres and emitters.
    shapes: Arc<[Shape]>,
    /// What some of them show.
    pictures: Arc<[LightPicture]>,
    /// How some of them distribute light.
    profiles: Arc<[LightProfile]>,
    /// Albedos of the materials; white for metals and mirrors that are not black.
    albedos: Vec<[f32; 3]>,
    records: Vec<MaterialRecord>,
    /// Material of each triangle in the order of the leaves; empty if all have the same.
    mesh_materials: Vec<u32>,
    /// Material of all triangles if `mesh_materials` is empty.
    one_material: u32,
    /// Whether all surfaces are diffuse, and seen from both sides: what rays from the camera hit first is all that they see.
    pub is_diffuse: bool,
    /// The same, and they are flat, or spheres, each with one albedo.
    pub is_plain: bool,
    rough: bool,
    estimates: bool,
    /// Whether materials reflect anything.
    reflect: Vec<bool>,
    /// Whether rays from the camera pass the backs of materials; empty if they pass none.
    single_sided: Vec<bool>,
    /// What varies over surfaces, if anything does.
    detail: Option<Detail>,
}

/// What varies over the surfaces of a scene.
#[derive(Debug)]
struct Detail {
    corners: Arc<Details>,
    /// The materials; the means of those that vary.
    materials: Vec<Material>,
    /// For each material the one that varies, if it does.
    varying: Vec<Option<Varying>>,
}

/// What hits of one triangle have in common.
struct Hit<'a> {
    material: usize,
    corners: Option<&'a Corners>,
    plane: Option<Barycentric>,
    colors: [[f32; 3]; 3],
}

impl Surfaces {
    /// Builds the trees of a scene.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn new(scene: &Scene) -> Result<Self, BuildError> {
        Ok(Self::with(scene, Self::bvh(Bvh::with_room(&scene.triangles), scene)?))
    }
    /// Like [`Surfaces::new`], but takes the triangles out of the scene and builds the tree in their memory.
    ///
    /// # Errors
    /// Fails if there are more primitives than a tree can index.
    pub fn from_scene(scene: &mut Scene) -> Result<Self, BuildError> {
        let triangles = std::mem::take(&mut scene.triangles);
        let surfaces = Self::with(scene, Self::bvh(triangles, scene)?);
        scene.triangle_materials = Vec::new();
        Ok(surfaces)
    }
    fn bvh(triangles: Vec<[[f32; 3]; 3]>, scene: &Scene) -> Result<Bvh, BuildError> {
        let lit = |shape: &Shape| match shape.emission {
            None => LitSides::Neither,
            Some(emission) if emission.is_unseen => LitSides::Unseen,
            Some(emission) if emission.two_sided => LitSides::Both,
            Some(_) => LitSides::Front,
        };
        let shapes = ShapeSet::new(scene.shapes.iter().map(|shape| (&shape.geometry, lit(shape))))?;
        let mut bvh = Bvh::with_instances(triangles, &scene.objects, &scene.instances, shapes)?;
        if !scene.masks.is_empty() {
            let masks: Vec<_> = scene.masks.iter().map(|(_, mask)| mask.clone()).collect();
            let of_material: HashMap<u32, u32> =
                scene.masks.iter().zip(0..).map(|((of, _), mask)| (*of, mask)).collect();
            bvh.cut_out(&masks.into(), |triangle| {
                let mask = *of_material.get(&scene.triangle_materials[triangle as usize])?;
                Some((mask, scene.details.of(triangle).map_or([[0.0; 2]; 3], |corners| corners.uvs)))
            });
        }
        Ok(bvh)
    }
    fn with(scene: &Scene, bvh: Bvh) -> Self {
        let one = scene.triangle_materials.windows(2).all(|w| w[0] == w[1]);
        let mesh_materials = if one {
            Vec::new()
        } else {
            bvh.order().iter().map(|&id| scene.triangle_materials[id as usize]).collect()
        };
        let of = |material: &Material| match *material {
            Material::Varying(index) => Some(scene.varying[index as usize].clone()),
            _ => None,
        };
        let varying: Vec<_> = scene.materials.iter().map(of).collect();
        // what does not look at the place takes the mean
        let material = |(material, of): (&Material, &Option<Varying>)| of.as_ref().map_or(*material, Varying::mean);
        let means: Vec<Material> = scene.materials.iter().zip(&varying).map(material).collect();
        let mut single_sided = vec![false; if scene.single_sided.is_empty() { 0 } else { means.len() }];
        scene.single_sided.iter().for_each(|of| single_sided[*of as usize] = true);
        let detailed = varying.iter().any(Option::is_some) || !scene.details.of_triangles.is_empty();
        let is_diffuse = scene.single_sided.is_empty() && means.iter().all(|m| matches!(m, Material::Diffuse(_)));
        Self {
            rough: means.iter().any(Material::is_glossy),
            estimates: means.iter().any(|of| matches!(of, Material::CoatedConductor { .. }) && of.is_glossy()),
            is_diffuse,
            is_plain: !detailed && is_diffuse,
            shapes: Arc::clone(&scene.shapes),
            pictures: Arc::clone(&scene.pictures),
            profiles: Arc::clone(&scene.profiles),
            bvh,
            albedos: means.iter().map(albedo).collect(),
            records: means.iter().map(|material| record(&material.isotropic())).collect(),
            reflect: means.iter().map(|material| !material.is_black()).collect(),
            single_sided,
            detail: detailed.then(|| Detail { corners: Arc::clone(&scene.details), materials: means, varying }),
            mesh_materials,
            one_material: scene.triangle_materials.first().copied().unwrap_or(0),
        }
    }
    /// Spheres and emitters, in the order of the scene.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }
    /// Indices of the shapes that emit, in the order of their lights.
    pub fn light_shapes(&self) -> impl Iterator<Item = u32> {
        (0..).zip(self.shapes.iter()).filter(|(_, shape)| shape.emission.is_some()).map(|(index, _)| index)
    }
    /// Whether any material is glossy.
    pub fn has_rough(&self) -> bool {
        self.rough
    }
    /// Whether what any material reflects is estimated.
    pub fn has_estimates(&self) -> bool {
        self.estimates
    }
    /// Geometry and material where eight rays hit the scene.
    // a call would copy the result
    #[inline(always)]
    pub fn hit(&self, hits: &Hits, rays: &Rays) -> Surface {
        let shapes = hits.shapes();
        let meshes = hits.any() & !shapes;
        let mut surface = Surface::default();
        if meshes.any() {
            self.mesh(hits, meshes, rays, &mut surface);
        }
        if shapes.any() {
            self.solid(hits, shapes, rays, &mut surface);
        }
        surface
    }

    #[inline(always)]
    fn mesh(&self, hits: &Hits, lanes: M8, rays: &Rays, surface: &mut Surface) {
        let first = hits.primitives.lane(first_lane(lanes));
        let is_vast = self.bvh.reach() > VAST;
        let uniform = !is_vast && (hits.primitives.are(first) | !lanes).all();
        let reach = self.bvh.reach_of_points();
        let (points, albedo);
        if uniform {
            let c = self.bvh.corners(first).map(f64::from);
            let corners = [[c[0], c[1], c[2]], [c[3], c[4], c[5]], [c[6], c[7], c[8]]];
            points = on_triangle(corners.map(Vec3::from), [rays.origin, rays.direction], reach);
            albedo = V8::from(self.albedo(first));
        } else {
            let rows: [[f32; 9]; 8] =
                std::array::from_fn(
                    |i| if lanes.lane(i) { self.bvh.corners(hits.primitives.lane(i)) } else { [0.0; 9] },
                );
            let c = X8::transpose(rows.map(|r| X8::from(&r[..8])));
            let last = X8::from(rows.map(|r| r[8]));
            let corners = [V8::new(c[0], c[1], c[2]), V8::new(c[3], c[4], c[5]), V8::new(c[6], c[7], last)];
            let meet = if is_vast { on_vast_triangles } else { on_triangles };
            points = meet(corners, [rays.origin, rays.direction], reach);
            albedo = if self.mesh_materials.is_empty() {
                V8::from(self.albedo(first))
            } else {
                let each: [[f32; 3]; 8] =
                    std::array::from_fn(
                        |i| if lanes.lane(i) { self.albedo(hits.primitives.lane(i)) } else { [0.0; 3] },
                    );
                let channel = |k: usize| X8::from(each.map(|a| a[k]));
                V8::new(channel(0), channel(1), channel(2))
            };
        }
        let Points { point, normal } = points;
        surface.point = point;
        surface.normal = normal;
        surface.albedo = albedo;
        surface.reflects = lanes;
    }

    #[inline]
    fn albedo(&self, triangle: PrimitiveId) -> [f32; 3] {
        self.albedos[self.mesh_material(triangle) as usize]
    }

    /// Material of a mesh triangle.
    #[inline]
    fn mesh_material(&self, triangle: PrimitiveId) -> u32 {
        if self.mesh_materials.is_empty() { self.one_material } else { self.mesh_materials[self.bvh.slot(triangle)] }
    }

    /// Calls `f` for each shape that some lanes have hit, with its index, the lanes, the shape and its outward normals at the hits.
    #[inline]
    pub fn each_shape(&self, hits: &Hits, lanes: M8, rays: &Rays, mut f: impl FnMut(usize, M8, &Shape, V8)) {
        hits.primitives.each(lanes, |primitive, here| {
            let Some(index) = primitive.shape() else { return };
            let shape = &self.shapes[index];
            let outward = shape.geometry.outward_at([rays.origin, rays.direction], hits.distance);
            f(index, here, shape, outward);
        });
    }

    /// Radiance that the shapes which eight rays hit emit against them.
    pub fn emission(&self, hits: &Hits, rays: &Rays) -> V8 {
        let mut emission = V8::default();
        self.each_shape(hits, hits.shapes(), rays, |_, here, shape, outward| {
            if let Some((radiance, lit)) = self.emitted(hits, here, shape, outward, rays) {
                emission = V8::blend(lit, radiance, emission);
            }
        });
        emission
    }

    /// Adds the spheres and emitters that eight rays hit.
    fn solid(&self, hits: &Hits, lanes: M8, rays: &Rays, surface: &mut Surface) {
        self.each_shape(hits, lanes, rays, |_, here, shape, outward| {
            if let Some((radiance, lit)) = self.emitted(hits, here, shape, outward, rays) {
                surface.emission = V8::blend(lit, radiance, surface.emission);
            }
            if self.reflect[shape.material as usize] {
                let albedo = self.albedos[shape.material as usize];
                let Points { point, normal } =
                    shape.geometry.points([rays.origin, rays.direction], hits.distance, self.bvh.reach_of_points());
                surface.point = V8::blend(here, point, surface.point);
                surface.normal = V8::blend(here, normal, surface.normal);
                surface.albedo = V8::blend(here, albedo.into(), surface.albedo);
                surface.reflects = surface.reflects | here;
            }
        });
    }

    /// The lanes of these in which rays hit the back of what is seen from the front alone.
    #[inline]
    pub fn unseen_backs(&self, hits: &Hits, lanes: M8, rays: &Rays) -> M8 {
        if self.single_sided.is_empty() { M8::splat(false) } else { self.backs(hits, lanes, rays) }
    }
    #[inline(never)]
    fn backs(&self, hits: &Hits, lanes: M8, rays: &Rays) -> M8 {
        let mut backs = M8::splat(false);
        self.each_shape(hits, lanes & hits.shapes(), rays, |_, here, shape, outward| {
            if self.single_sided[shape.material as usize] {
                backs = backs | here & outward.dot(rays.direction).gt(X8::lit(0.0));
            }
        });
        let meshes = lanes & hits.any() & !hits.shapes();
        let is_back = |lane: usize| {
            let primitive = hits.primitives.lane(lane);
            self.single_sided[self.mesh_material(primitive) as usize]
                && self.outward(primitive).is_some_and(|n| is_behind(n, lane_of(-rays.direction, lane)))
        };
        let bits = (0..8).filter(|lane| meshes.lane(*lane) && is_back(*lane)).fold(0, |bits, lane| bits | 1 << lane);
        backs | M8::from_bits(bits)
    }
    /// The unit normal of a flat triangle on the side from which its corners are counter-clockwise, in its object.
    fn outward(&self, primitive: PrimitiveId) -> Option<[f64; 3]> {
        let is_mirrored = self.bvh.to_world(primitive).is_some_and(|to_world| to_world.determinant() < 0.0);
        outward(self.bvh.corners(primitive), is_mirrored)
    }

    /// Radiance that a shape emits against the rays that have hit it in these lanes, and the lanes where it does.
    #[inline]
    pub fn emitted(&self, hits: &Hits, lanes: M8, shape: &Shape, outward: V8, rays: &Rays) -> Option<(V8, M8)> {
        let emission = shape.emission?;
        let front = outward.dot(rays.direction).lt(X8::lit(0.0));
        let lit = lanes & (front | M8::splat(emission.two_sided));
        let mut radiance = match emission.picture {
            None => emission.radiance.into(),
            Some(picture) => self.shown(picture, hits, lit, shape, outward, rays),
        };
        if let Some(profile) = emission.profile {
            radiance = radiance * self.profiles[profile as usize].factor(-rays.direction, outward);
        } else if let Some(spread) = emission.spread {
            radiance = radiance * spread.splat().attenuation(rays.direction, outward);
        }
        Some((radiance, lit))
    }
    /// Radiance of the points of a shape with a picture that rays have hit; its mean if the form shows no pictures.
    #[inline(never)]
    fn shown(&self, picture: u32, hits: &Hits, lanes: M8, shape: &Shape, outward: V8, rays: &Rays) -> V8 {
        let mut radiance = shape.emission.map_or_else(V8::default, |emission| emission.radiance.into());
        if let Some(chart) = shape.geometry.chart() {
            let st = shape.geometry.coordinates(rays.direction.mul_add(hits.distance, rays.origin));
            self.pictures[picture as usize].show(chart, lanes, st, outward, &mut radiance);
        }
        radiance
    }

    /// Materials at the hit points of these lanes, and the lanes of smooth surfaces: `surface` gets their normals, and the albedos of
    /// materials that vary.
    #[inline]
    pub fn materials(&self, hits: &Hits, lanes: M8, direction: V8, surface: &mut Surface) -> (Metal, M8) {
        match &self.detail {
            Some(detail) => self.detailed(detail, hits, lanes, direction, surface),
            None => (self.metal(hits, lanes), M8::splat(false)),
        }
    }

    #[inline(never)]
    fn detailed(&self, detail: &Detail, hits: &Hits, lanes: M8, direction: V8, surface: &mut Surface) -> (Metal, M8) {
        let order = self.bvh.order();
        let (mut records, mut smooth, mut grain) = ([PLAIN; 8], 0, None);
        // most lanes hit the same triangle as the one before
        let mut last: Option<(PrimitiveId, Hit<'_>)> = None;
        for (lane, own) in records.iter_mut().enumerate().filter(|(lane, _)| lanes.lane(*lane)) {
            let primitive = hits.primitives.lane(lane);
            if let Some(shape) = primitive.shape() {
                *own = self.records[self.shapes[shape].material as usize];
                continue;
            }
            if last.as_ref().is_none_or(|(before, _)| *before != primitive) {
                let triangle = order[self.bvh.slot(primitive)];
                let corners = detail.corners.of(triangle);
                last = Some((
                    primitive,
                    Hit {
                        material: self.mesh_material(primitive) as usize,
                        corners,
                        plane: corners.map(|_| Barycentric::new(self.bvh.corners(primitive))),
                        colors: detail.corners.colors_of(triangle),
                    },
                ));
            }
            let Some((_, Hit { material, corners, plane, colors })) = &last else { continue };
            let (material, corners) = (*material, *corners);
            let varying = detail.varying[material].as_ref();
            let weights = plane.as_ref().map(|plane| plane.weights(lane_of(surface.point, lane)));
            let varied = varying.map(|varying| match (corners, weights) {
                (Some(corners), Some(weights)) => {
                    varying.tinted(interpolated(&corners.uvs, weights), interpolated(colors, weights))
                }
                _ => varying.at([0.0; 2]),
            });
            let here = varied.unwrap_or(detail.materials[material]);
            if !matches!(here, Material::Diffuse(_)) {
                *own = record(&here);
            }
            if let Some(roughness) = here.roughness().filter(|roughness| !roughness.is_isotropic())
                && let Some(corners) = corners
            {
                let along = along_u(self.bvh.corners(primitive), &corners.uvs, roughness.turn);
                set_lane(grain.get_or_insert_default(), lane, along);
            }
            if let Some(varied) = varied {
                set_lane(&mut surface.albedo, lane, albedo(&varied));
            }
            if let Some((corners, weights)) = corners.zip(weights)
                && let map = varying.and_then(Varying::normals)
                && (corners.normals[0] != [0.0; 3] || map.is_some())
                && let Some(n) = self.normal(primitive, corners, weights, map, lane_of(surface.normal, lane))
                && let Some(n) = facing(n, lane_of(direction, lane))
            {
                set_lane(&mut surface.normal, lane, n);
                smooth |= 1 << lane;
            }
        }
        let metal = Metal::new(records.each_ref());
        (grain.map_or(metal, |grain| metal.along(grain)), M8::from_bits(smooth))
    }

    /// The unit normal at a point of a triangle that is smooth or has a map, on the side of the flat one.
    fn normal(
        &self,
        primitive: PrimitiveId,
        corners: &Corners,
        weights: [f32; 3],
        map: Option<&NormalMap>,
        flat: [f32; 3],
    ) -> Option<[f64; 3]> {
        let front = if corners.normals[0] == [0.0; 3] {
            self.outward(primitive)
        } else {
            let to_world = self.bvh.to_world(primitive);
            between(&to_world.map_or(corners.normals, |to_world| moved(corners.normals, to_world)), weights)
        }?;
        let at = || self.bvh.corners(primitive);
        let uv = || interpolated(&corners.uvs, weights);
        let n = map.and_then(|map| turned(front, map, at(), &corners.uvs, uv())).unwrap_or(front);
        Some(if is_behind(front, flat) { n.map(|x| -x) } else { n })
    }

    /// Materials at the hit points of these lanes; of a material that varies, it is the mean.
    #[inline]
    pub fn metal(&self, hits: &Hits, lanes: M8) -> Metal {
        let rows: [&MaterialRecord; 8] = std::array::from_fn(|i| {
            if !lanes.lane(i) {
                return &PLAIN;
            }
            let primitive = hits.primitives.lane(i);
            let material = match primitive.shape() {
                Some(shape) => self.shapes[shape].material,
                None => self.mesh_material(primitive),
            };
            &self.records[material as usize]
        });
        Metal::new(rows)
    }
}
