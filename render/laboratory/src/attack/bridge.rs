//! A scene as the oracle takes it: the numbers that the renderer keeps, in f64.

use etendue_oracle::direct::{Body, Emission, Finish, Form, Lens, View};
use etendue_oracle::{sub, wide};
use etendue_render::scene::{CameraSettings, Geometry, Material, Scene};

/// The channel that is compared.
pub(super) const CHANNEL: usize = 1;

/// The bodies of a scene.
#[must_use]
pub fn bodies(scene: &Scene) -> Vec<Body> {
    let finish = |index: u32| match scene.materials[index as usize] {
        Material::Diffuse(albedo) => Finish::Diffuse(albedo[CHANNEL].into()),
        Material::Mirror(reflectance) => Finish::Mirror(reflectance[CHANNEL].into()),
        Material::Conductor { eta, k, roughness } => {
            Finish::Metal { eta: eta[CHANNEL].into(), k: k[CHANNEL].into(), alpha: roughness.along.into() }
        }
        Material::Glossy { .. } | Material::Varying(_) => unreachable!("no such material is drawn"),
    };
    let triangle = |corners: [[f32; 3]; 3]| {
        let [corner, b, c] = corners.map(wide);
        Form::Flat { corner, edges: [sub(b, corner), sub(c, corner)], is_triangle: true }
    };
    let meshes = scene.triangles.iter().zip(&scene.triangle_materials);
    let meshes = meshes.map(|(t, material)| Body { form: triangle(*t), finish: finish(*material), emission: None });
    let shapes = scene.shapes.iter().map(|shape| Body {
        form: match shape.geometry {
            Geometry::Sphere { center, radius } => Form::Sphere { center: wide(center), radius: radius.into() },
            Geometry::Triangle(corners) => triangle(corners),
            Geometry::Parallelogram { p, u, v } => {
                Form::Flat { corner: wide(p), edges: [wide(u), wide(v)], is_triangle: false }
            }
        },
        finish: finish(shape.material),
        emission: shape
            .emission
            .map(|emission| Emission { radiance: emission.radiance[CHANNEL].into(), two_sided: emission.two_sided }),
    });
    meshes.chain(shapes).collect()
}

/// The camera of a scene for an image of this size, with its numbers rounded to f32 as the renderer keeps them.
#[must_use]
pub fn view(camera: &CameraSettings, width: u32, height: u32) -> View {
    let [kx, ky] = camera.tan_half(width, height);
    let vector = |f: &dyn Fn(usize) -> f64| std::array::from_fn(|k| f64::from(f(k) as f32));
    let (right, up) = (camera.right, camera.up);
    View {
        size: [width as usize, height as usize],
        origin: vector(&|k| camera.origin[k]),
        corner: vector(&|k| camera.forward[k] - kx * right[k] + ky * up[k]),
        across: vector(&|k| 2.0 * kx * right[k] / f64::from(width)),
        down: vector(&|k| -2.0 * ky * up[k] / f64::from(height)),
        lens: camera.lens.map(|lens| {
            let along = |length: f64| [right, up].map(|axis| vector(&|k| axis[k] * length));
            Lens { radii: along(lens.radius * lens.unit), bends: along(lens.radius / lens.focus) }
        }),
    }
}
