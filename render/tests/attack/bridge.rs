//! A scene as the oracle takes it: the numbers that the renderer keeps, in f64, and what only a draft tells.

use super::draft::{self, Draft, Frame, Kind, SourceDraft};
use etendue_oracle::direct::{
    self, Beyond, Body, Cone, Detail, Emission, Finish, Form, Lens, Opacity, Pattern, Picture, Sky, View,
};
use etendue_oracle::{V3, along, basis, cross, dot, sub, unit, wide};
use etendue_render::scene::texture::{self, Colors, Mapping, Texture, Wrap};
use etendue_render::scene::{
    CameraSettings, Geometry, Instance, Material, Parallelogram, Scene, Shape, Sphere, Varying,
};
use std::collections::HashMap;
use std::sync::Arc;

/// The channel that is compared.
pub(crate) const CHANNEL: usize = 1;

/// A map from the space of an object to that of the world.
#[derive(Clone, Copy)]
struct Map([[f64; 4]; 3]);

impl Map {
    fn of(instance: &Instance) -> Self {
        Self(instance.to_world.0.map(|row| row.map(f64::from)))
    }
    /// Where a point is, as the renderer defines it: each product is added in single precision, that of x last.
    fn point(&self, p: V3) -> V3 {
        self.0.map(|[a, b, c, d]| {
            let sum = [(c, p[2]), (b, p[1]), (a, p[0])]
                .into_iter()
                .fold(d as f32, |sum, (a, x)| (a as f32).mul_add(x as f32, sum));
            f64::from(sum)
        })
    }
    fn vector(&self, v: V3) -> V3 {
        self.0.map(|[a, b, c, _]| dot([a, b, c], v))
    }
    /// A vector along the normal of a plane that had the normal `n`: across the images of two vectors within the plane.
    fn normal(&self, n: V3) -> V3 {
        let (s, t) = basis(n);
        cross(self.vector(s), self.vector(t))
    }
}

/// The channel of a texture.
fn pattern(texture: &Texture, channel: usize) -> Pattern {
    let both = |of: &[Texture; 2]| Box::new([pattern(&of[0], channel), pattern(&of[1], channel)]);
    match texture {
        Texture::Constant(color) => Pattern::Constant(color[channel].into()),
        Texture::Picture(picture) => Pattern::Picture(pixels(picture, channel)),
        Texture::Channel(of, channel) => pattern(of, *channel),
        Texture::Product(of) => Pattern::Product(both(of)),
        Texture::Inverse(of) => Pattern::Inverse(Box::new(pattern(of, channel))),
        Texture::Mix(of) => Pattern::Mix(Box::new([0, 1, 2].map(|k| pattern(&of[k], channel)))),
        Texture::Checkerboard(of, mapping) => Pattern::Board(both(of), place(mapping)),
        Texture::Opacity(_) | Texture::Root(_) => unreachable!("no such texture is drawn"),
    }
}

fn place(mapping: &Mapping) -> [[f64; 3]; 2] {
    mapping.0.map(|row| row.map(f64::from))
}

fn pixels(picture: &texture::Picture, channel: usize) -> Picture {
    let texture::Picture { texels, mapping, wrap, bilinear } = picture;
    let Colors::Float(colors) = &texels.colors else { unreachable!("no other picture is drawn") };
    let beyond = |wrap| match wrap {
        Wrap::Repeat => Beyond::Repeats,
        Wrap::Mirror => Beyond::Mirrors,
        Wrap::Clamp => Beyond::Stays,
        Wrap::Black => Beyond::Ends,
    };
    Picture {
        size: [texels.width, texels.height],
        texels: colors.iter().map(|color| color[channel].into()).collect(),
        place: place(mapping),
        beyond: wrap.map(beyond),
        is_smooth: *bilinear,
    }
}

/// What a material reflects.
fn finish(scene: &Scene, index: u32) -> Finish {
    match scene.materials[index as usize] {
        Material::Diffuse(albedo) => Finish::Diffuse(albedo[CHANNEL].into()),
        Material::Mirror(reflectance) => Finish::Mirror(reflectance[CHANNEL].into()),
        Material::Conductor { eta, k, roughness } => {
            Finish::Metal { eta: eta[CHANNEL].into(), k: k[CHANNEL].into(), alpha: roughness.along.into() }
        }
        Material::Glossy { diffuse, specular, roughness, .. } => Finish::Coat {
            albedo: diffuse[CHANNEL].into(),
            reflectance: specular[CHANNEL].into(),
            alpha: roughness.along.into(),
        },
        Material::Layered { .. } | Material::CoatedConductor { .. } => unreachable!("no such material is drawn"),
        // its albedo is among the details
        Material::Varying(of) => match &scene.varying[of as usize] {
            Varying::Diffuse(_) => Finish::Diffuse(0.0),
            Varying::Glossy {
                specular: Texture::Constant(specular),
                roughness: [Texture::Constant([alpha, ..]), _],
                ..
            } => Finish::Coat { albedo: 0.0, reflectance: specular[CHANNEL].into(), alpha: (*alpha).into() },
            _ => unreachable!("no such material is drawn"),
        },
    }
}

fn triangle([corner, b, c]: [V3; 3]) -> Form {
    Form::Flat { corner, edges: [sub(b, corner), sub(c, corner)], is_triangle: true }
}

/// The triangles of meshes and their instances.
fn meshes(scene: &Scene) -> Vec<Body> {
    let albedos = scene.varying.iter().map(|varying| match varying {
        Varying::Diffuse(albedo) | Varying::Glossy { diffuse: albedo, .. } => Arc::new(pattern(albedo, CHANNEL)),
        _ => unreachable!("no such material is drawn"),
    });
    let albedos: Vec<Arc<Pattern>> = albedos.collect();
    let opacity = |mask: &texture::Mask| Opacity {
        chance: Arc::new(pattern(&mask.opacity, 0)),
        least: mask.least.map(f64::from),
    };
    let opacities: HashMap<u32, Opacity> = scene.masks.iter().map(|(of, mask)| (*of, opacity(mask))).collect();
    let mesh = |index: usize, map: Option<&Map>| {
        let material = scene.triangle_materials[index];
        let corners = scene.triangles[index].map(wide);
        let known = scene.details.of(index as u32);
        let albedo = match scene.materials[material as usize] {
            Material::Varying(of) => Some(Arc::clone(&albedos[of as usize])),
            _ => None,
        };
        let opacity = opacities.get(&material).cloned();
        let detail = (known.is_some() || albedo.is_some() || opacity.is_some()).then(|| {
            let normals = known.map_or([[0.0; 3]; 3], |known| known.normals.map(wide));
            let moved = |n: V3| if n == [0.0; 3] { n } else { unit(map.map_or(n, |map| map.normal(n))) };
            let uvs = known.map_or([[0.0; 2]; 3], |known| known.uvs.map(|uv| uv.map(f64::from)));
            Arc::new(Detail { uvs, normals: normals.map(moved), albedo, opacity })
        });
        let form = triangle(corners.map(|p| map.map_or(p, |map| map.point(p))));
        Body { form, finish: finish(scene, material), emission: None, detail }
    };
    let own = scene.objects.first().map_or(scene.triangles.len(), |range| range.start);
    let instances = scene.instances.iter().flat_map(|instance| {
        let map = Map::of(instance);
        scene.objects[instance.object as usize].clone().map(move |index| (index, Some(map)))
    });
    let meshes = (0..own).map(|index| (index, None)).chain(instances);
    meshes.map(|(index, map)| mesh(index, map.as_ref())).collect()
}

/// Spheres, and what emits.
fn shapes(scene: &Scene) -> Vec<Body> {
    let body = |shape: &Shape| Body {
        form: match shape.geometry {
            Geometry::Sphere(Sphere { center, radius }) => Form::Sphere { center: wide(center), radius: radius.into() },
            Geometry::Triangle(corners) => triangle(corners.map(wide)),
            Geometry::Parallelogram(Parallelogram { p, u, v }) => {
                Form::Flat { corner: wide(p), edges: [wide(u), wide(v)], is_triangle: false }
            }
            ref other => unreachable!("no draft has {other:?}"),
        },
        finish: finish(scene, shape.material),
        emission: shape
            .emission
            .map(|emission| Emission { radiance: emission.radiance[CHANNEL].into(), two_sided: emission.two_sided }),
        detail: None,
    };
    scene.shapes.iter().map(body).collect()
}

/// The bodies of a scene.
pub(crate) fn bodies(scene: &Scene) -> Vec<Body> {
    meshes(scene).into_iter().chain(shapes(scene)).filter(has_area).collect()
}

/// Gives the bodies of a draft's scene the normals that the draft has, which the scene's reader may have turned.
pub(crate) fn straighten(draft: &Draft, bodies: &mut [Body]) {
    let mut index = 0;
    for part in draft.parts.iter().filter(|part| part.glow.is_none() && part.copies.is_empty()) {
        for corners in part.form.triangles() {
            let normals = part.skin.bend.map(|bend| bend.normals(*corners));
            if let (Some(normals), Some(detail)) = (normals, &mut bodies[index].detail) {
                // a triangle that lacks one is flat
                let is_flat = normals.contains(&[0.0; 3]) || detail.normals == [[0.0; 3]; 3];
                Arc::make_mut(detail).normals = if is_flat { [[0.0; 3]; 3] } else { normals.map(unit) };
            }
            index += 1;
        }
    }
}

/// The lights without a surface.
pub(crate) fn sources(sources: &[SourceDraft]) -> Vec<direct::SurfacelessLight> {
    let round = |v: V3| v.map(|x| f64::from(x as f32));
    let of = |source: &SourceDraft| {
        let intensity = f64::from(source.strength);
        match source.kind {
            Kind::Point(from) => direct::SurfacelessLight::Point { position: round(from), intensity, cone: None },
            Kind::Spot([from, to], [angle, delta]) => {
                let axis = unit(sub(round(to), round(from)));
                let cone = Some(Cone { axis, angles: [angle - delta, angle].map(f64::to_radians) });
                direct::SurfacelessLight::Point { position: round(from), intensity, cone }
            }
            Kind::Distant([from, to]) => {
                direct::SurfacelessLight::Distant { towards: unit(sub(round(from), round(to))), irradiance: intensity }
            }
            Kind::Sky => {
                let columns = |map: &draft::Map| [0, 1, 2].map(|axis| map.map(|row| row[axis]));
                let axes = source.map.as_ref().map_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], columns);
                let (columns, texels) = match &source.picture {
                    Some(picture) => (picture.width, picture.texels.as_slice()),
                    None => (1, &[1.0_f32][..]),
                };
                let rows = texels.chunks(columns).rev().flatten();
                let texels = rows.map(|x| intensity * f64::from(*x)).collect();
                direct::SurfacelessLight::Sky(Sky::new(axes.map(unit), columns, texels))
            }
        }
    };
    sources.iter().map(of).collect()
}

/// Whether a body is not a triangle that a map has flattened.
fn has_area(body: &Body) -> bool {
    !matches!(body.form, Form::Flat { edges: [u, v], .. } if cross(u, v) == [0.0; 3])
}

/// What a film shows of a scene whose camera has all of it.
pub(crate) fn framed(frame: &Frame, camera: &CameraSettings) -> View {
    let [width, height] = frame.size;
    let [[x0, x1], [y0, y1]] = frame.window;
    let all = view(camera, width, height);
    let size = [x1 - x0, y1 - y0].map(|side| side as usize);
    let at = |from: V3, across: V3, down: V3| along(along(from, across, x0.into()), down, y0.into());
    let Some(half) = frame.screen else {
        return View { size, corner: at(all.corner, all.across, all.down), ..all };
    };
    let pixel = 2.0 * half / f64::from(width.min(height));
    let slides = [camera.right.map(|x| pixel * x), camera.up.map(|x| -pixel * x)];
    let corner = along(along(all.origin, slides[0], -0.5 * f64::from(width)), slides[1], -0.5 * f64::from(height));
    let still = [0.0; 3];
    let origin = at(corner, slides[0], slides[1]);
    View { size, origin, corner: camera.forward, across: still, down: still, slides, lens: None }
}

/// The camera of a scene for an image of this size, with its numbers rounded to f32 as the renderer keeps them.
pub(crate) fn view(camera: &CameraSettings, width: u32, height: u32) -> View {
    let [left, edge, lower, upper] = camera.edges(width, height);
    let vector = |f: &dyn Fn(usize) -> f64| std::array::from_fn(|k| f64::from(f(k) as f32));
    let (right, up) = (camera.right, camera.up);
    View {
        size: [width as usize, height as usize],
        origin: vector(&|k| camera.origin[k]),
        corner: vector(&|k| camera.forward[k] + left * right[k] + upper * up[k]),
        across: vector(&|k| (edge - left) * right[k] / f64::from(width)),
        down: vector(&|k| (lower - upper) * up[k] / f64::from(height)),
        slides: [[0.0; 3]; 2],
        lens: camera.lens.map(|lens| {
            let along = |length: f64| [right, up].map(|axis| vector(&|k| axis[k] * length));
            Lens { radii: along(lens.radius * lens.unit), bends: along(lens.radius / lens.focus) }
        }),
    }
}
