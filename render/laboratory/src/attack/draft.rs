//! A scene to attack with: parts that can be left out one by one, and their text.

use super::skin::{Number, Picture, Skin};
use std::fmt::{self, Display, Formatter};

/// A vector or point in f64; text rounds it to f32.
pub type V3 = [f64; 3];

/// How a part reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finish {
    /// Lambertian, with this albedo.
    Diffuse(f32),
    /// A perfect mirror, with this reflectance.
    Mirror(f32),
    /// A metal of index η + ik with roughness α.
    Metal {
        /// Real part of the index of refraction.
        eta: f32,
        /// Imaginary part of the index of refraction.
        k: f32,
        /// Roughness α of the GGX distribution; 0 is a perfect mirror.
        alpha: f32,
    },
    /// A coat over a Lambertian surface.
    Coat {
        /// Albedo of the surface.
        albedo: f32,
        /// Reflectance of the coat at normal incidence.
        reflectance: f32,
        /// Roughness α of the coat.
        alpha: f32,
    },
}

/// The form of a part.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// Triangles.
    Mesh(Vec<[V3; 3]>),
    /// A sphere of this centre and radius.
    Sphere(V3, f64),
    /// The parallelogram of a corner and two edges; the normal is their cross product.
    Parallelogram(V3, V3, V3),
}

/// Constant emission.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glow {
    /// Radiance in every channel.
    pub radiance: f32,
    /// Whether both sides emit.
    pub two_sided: bool,
}

/// A part of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Form and position.
    pub form: Form,
    /// How it reflects.
    pub finish: Finish,
    /// What it emits, if it is a light.
    pub glow: Option<Glow>,
    /// What varies over a mesh.
    pub skin: Skin,
    /// If there are some, the maps that place copies of a mesh, which is nowhere else.
    pub copies: Vec<Map>,
}

/// A map to world space: the rows of the linear part, each followed by its part of the shift. Text rounds it to f32.
pub type Map = [[f64; 4]; 3];

/// Where a scene is seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Position of the camera.
    pub eye: V3,
    /// What is in the middle of the image.
    pub target: V3,
    /// A direction that appears upwards.
    pub up: V3,
    /// Angle of view in degrees.
    pub fov: f64,
    /// Radius and distance of focus of a lens.
    pub lens: Option<[f64; 2]>,
}

/// A scene of parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// What the scene is called.
    pub name: String,
    /// The camera.
    pub look: Look,
    /// What is in it.
    pub parts: Vec<Part>,
    /// Whether copies share their triangles, as they do in scenes that are read only if they have very many of them.
    pub is_shared: bool,
}

impl Part {
    fn new(form: Form, albedo: f32, glow: Option<Glow>) -> Self {
        Self { form, finish: Finish::Diffuse(albedo), glow, skin: Skin::default(), copies: Vec::new() }
    }
    /// Triangles that reflect.
    #[must_use]
    pub fn mesh(triangles: Vec<[V3; 3]>, albedo: f32) -> Self {
        Self::new(Form::Mesh(triangles), albedo, None)
    }
    /// A sphere that reflects.
    #[must_use]
    pub fn ball(center: V3, radius: f64, albedo: f32) -> Self {
        Self::new(Form::Sphere(center, radius), albedo, None)
    }
    /// A light, which reflects nothing.
    #[must_use]
    pub fn light(form: Form, radiance: f32, two_sided: bool) -> Self {
        Self::new(form, 0.0, Some(Glow { radiance, two_sided }))
    }
    /// Number of primitives.
    #[must_use]
    pub fn size(&self) -> usize {
        if let Form::Mesh(triangles) = &self.form { triangles.len() * self.copies.len().max(1) } else { 1 }
    }
}

impl Form {
    /// The triangles of a mesh.
    #[must_use]
    pub fn triangles(&self) -> &[[V3; 3]] {
        if let Self::Mesh(triangles) = self { triangles } else { &[] }
    }
    /// The points that define the form, a sphere's being its centre, moved by `place`, and the edges and radii turned by `turn`.
    pub fn moved(&mut self, place: impl Fn(V3) -> V3, turn: impl Fn(V3) -> V3) {
        match self {
            Self::Mesh(triangles) => triangles.iter_mut().for_each(|t| *t = t.map(&place)),
            Self::Sphere(center, _) => *center = place(*center),
            Self::Parallelogram(p, u, v) => (*p, *u, *v) = (place(*p), turn(*u), turn(*v)),
        }
    }
}

impl Draft {
    /// Number of primitives.
    #[must_use]
    pub fn size(&self) -> usize {
        self.parts.iter().map(Part::size).sum()
    }
    /// The pictures that the text names.
    pub fn pictures(&self) -> impl Iterator<Item = &Picture> {
        self.parts.iter().flat_map(|part| part.skin.pictures())
    }
    /// Moves everything.
    pub fn shift(&mut self, by: V3) {
        let place = |p: V3| std::array::from_fn(|k| p[k] + by[k]);
        let whole = self.parts.iter_mut().filter(|part| part.copies.is_empty());
        whole.for_each(|part| part.form.moved(place, |v| v));
        for map in self.parts.iter_mut().flat_map(|part| &mut part.copies) {
            map.iter_mut().zip(by).for_each(|(row, by)| row[3] += by);
        }
        (self.look.eye, self.look.target) = (place(self.look.eye), place(self.look.target));
    }
}

/// Points in a row, rounded to f32.
fn points(f: &mut Formatter<'_>, points: &[V3]) -> fmt::Result {
    for [x, y, z] in points {
        write!(f, " {} {} {} ", Number(*x), Number(*y), Number(*z))?;
    }
    Ok(())
}

impl Finish {
    /// The finish with an albedo that is the texture of this name, if it has one.
    const fn with<'a>(&'a self, texture: Option<&'a str>) -> Textured<'a> {
        Textured(self, texture)
    }
}

/// A finish, and the name of the texture of its albedo.
struct Textured<'a>(&'a Finish, Option<&'a str>);

impl Display for Textured<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let number = |x: f32| Number(x.into());
        let albedo = |f: &mut Formatter<'_>, name: &str, x: f32| match self.1 {
            Some(texture) => write!(f, "\"texture {name}\" \"{texture}\""),
            None => write!(f, "\"rgb {name}\" [ {0} {0} {0} ]", number(x)),
        };
        write!(f, "Material ")?;
        match *self.0 {
            Finish::Diffuse(a) => {
                write!(f, "\"diffuse\" ")?;
                albedo(f, "reflectance", a)
            }
            Finish::Mirror(a) => write!(f, "\"mirror\" \"rgb Kr\" [ {0} {0} {0} ]", number(a)),
            Finish::Metal { eta, k, alpha } => write!(
                f,
                "\"conductor\" \"rgb eta\" [ {0} {0} {0} ] \"rgb k\" [ {1} {1} {1} ]
  \"float roughness\" {2} \"bool remaproughness\" false",
                number(eta),
                number(k),
                number(alpha)
            ),
            Finish::Coat { albedo: a, reflectance, alpha } => {
                write!(f, "\"substrate\" ")?;
                albedo(f, "Kd", a)?;
                let (reflectance, alpha) = (number(reflectance), number(alpha));
                write!(f, " \"rgb Ks\" [ {reflectance} {reflectance} {reflectance} ]")?;
                write!(f, " \"float roughness\" {alpha} \"bool remaproughness\" false")
            }
        }
    }
}

impl Part {
    /// What is before the shape: the finish, what varies of it, and the light.
    fn header(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if let Some(albedo) = &self.skin.albedo {
            write!(f, "{}", albedo.named("albedo", true))?;
        }
        write!(f, "  {}", self.finish.with(self.skin.albedo.as_ref().map(|_| "albedo")))?;
        writeln!(f)?;
        if let Some(opacity) = &self.skin.opacity {
            write!(f, "{}", opacity.named("opacity", false))?;
        }
        if let Some(Glow { radiance, two_sided }) = self.glow {
            write!(f, "  AreaLightSource \"diffuse\" \"rgb L\" [ {0} {0} {0} ]", Number(radiance.into()))?;
            writeln!(f, "{}", if two_sided { " \"bool twosided\" true" } else { "" })?;
        }
        Ok(())
    }
    /// The shape.
    fn shape(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.form {
            Form::Mesh(triangles) => {
                write!(f, "  Shape \"trianglemesh\" \"point3 P\" [")?;
                for corners in triangles {
                    write!(f, "\n   ")?;
                    points(f, corners)?;
                }
                write!(f, "]\n    \"integer indices\" [")?;
                (0..3 * triangles.len()).try_for_each(|i| write!(f, " {i}"))?;
                writeln!(f, " ]")?;
                if let Some(uv) = self.skin.uv {
                    write!(f, "    \"point2 uv\" [")?;
                    for [u, v] in triangles.as_flattened().iter().map(|p| uv.at(*p)) {
                        write!(f, " {} {} ", Number(u), Number(v))?;
                    }
                    writeln!(f, "]")?;
                }
                if let Some(bend) = self.skin.bend {
                    write!(f, "    \"normal N\" [")?;
                    triangles.iter().try_for_each(|corners| points(f, &bend.normals(*corners)))?;
                    writeln!(f, "]")?;
                }
                if self.skin.opacity.is_some() {
                    writeln!(f, "    \"texture alpha\" \"opacity\"")?;
                }
            }
            Form::Sphere(center, radius) => {
                write!(f, "  Translate ")?;
                points(f, &[*center])?;
                writeln!(f, "\n  Shape \"sphere\" \"float radius\" {}", Number(*radius))?;
            }
            Form::Parallelogram(p, u, v) => {
                // sums in f64, from which the reader finds the edges again
                let [p, u, v] = [p, u, v].map(|a| a.map(|x| f64::from(x as f32)));
                let add = |a: V3, b: V3| -> V3 { std::array::from_fn(|k| a[k] + b[k]) };
                write!(f, "  Shape \"bilinearmesh\" \"point3 P\" [")?;
                for [x, y, z] in [p, add(p, u), add(p, v), add(add(p, u), v)] {
                    write!(f, " {x:?} {y:?} {z:?} ")?;
                }
                writeln!(f, "]")?;
            }
        }
        Ok(())
    }
}

impl Display for Part {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [begin, end] = if self.copies.is_empty() {
            ["AttributeBegin", "AttributeEnd"]
        } else {
            ["ObjectBegin \"o\"", "ObjectEnd"]
        };
        writeln!(f, "{begin}")?;
        self.header(f)?;
        self.shape(f)?;
        writeln!(f, "{end}")?;
        for map in &self.copies {
            write!(f, "AttributeBegin\n  Transform [")?;
            // column by column
            for axis in 0..4 {
                map.iter().try_for_each(|row| write!(f, " {}", Number(row[axis])))?;
                write!(f, " {} ", if axis == 3 { 1 } else { 0 })?;
            }
            writeln!(f, "]\n  ObjectInstance \"o\"\nAttributeEnd")?;
        }
        Ok(())
    }
}

impl Display for Draft {
    /// The scene as a pbrt-v4 file, whose numbers are exactly those of the scene in f32.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Look { eye, target, up, fov, lens } = &self.look;
        writeln!(f, "# {}", self.name)?;
        write!(f, "LookAt")?;
        points(f, &[*eye])?;
        [target, up].into_iter().flatten().try_for_each(|x| write!(f, " {x:?}"))?;
        write!(f, "\nCamera \"perspective\" \"float fov\" {fov:?}")?;
        if let Some([radius, focus]) = lens {
            write!(f, " \"float lensradius\" {radius:?} \"float focaldistance\" {focus:?}")?;
        }
        writeln!(f, "\nFilm \"rgb\" \"integer xresolution\" 96 \"integer yresolution\" 96\n\nWorldBegin")?;
        self.parts.iter().try_for_each(|part| write!(f, "\n{part}"))
    }
}
