//! A scene to attack with: parts that can be left out one by one, and their text.

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
}

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
}

impl Part {
    /// Triangles that reflect.
    #[must_use]
    pub const fn mesh(triangles: Vec<[V3; 3]>, albedo: f32) -> Self {
        Self { form: Form::Mesh(triangles), finish: Finish::Diffuse(albedo), glow: None }
    }
    /// A sphere that reflects.
    #[must_use]
    pub const fn ball(center: V3, radius: f64, albedo: f32) -> Self {
        Self { form: Form::Sphere(center, radius), finish: Finish::Diffuse(albedo), glow: None }
    }
    /// A light, which reflects nothing.
    #[must_use]
    pub const fn light(form: Form, radiance: f32, two_sided: bool) -> Self {
        Self { form, finish: Finish::Diffuse(0.0), glow: Some(Glow { radiance, two_sided }) }
    }
    /// Number of primitives.
    #[must_use]
    pub fn size(&self) -> usize {
        if let Form::Mesh(triangles) = &self.form { triangles.len() } else { 1 }
    }
}

impl Form {
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
    /// Moves everything.
    pub fn shift(&mut self, by: V3) {
        let place = |p: V3| std::array::from_fn(|k| p[k] + by[k]);
        self.parts.iter_mut().for_each(|part| part.form.moved(place, |v| v));
        (self.look.eye, self.look.target) = (place(self.look.eye), place(self.look.target));
    }
}

/// A number as f32, with as many digits as it has.
struct Number(f64);

impl Display for Number {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let short = format!("{:?}", self.0 as f32);
        // the parser reads f64
        let same = short.parse::<f64>().is_ok_and(|x| (x as f32).to_bits() == (self.0 as f32).to_bits());
        if same { f.write_str(&short) } else { write!(f, "{:?}", f64::from(self.0 as f32)) }
    }
}

/// Points in a row, rounded to f32.
fn points(f: &mut Formatter<'_>, points: &[V3]) -> fmt::Result {
    for [x, y, z] in points {
        write!(f, " {} {} {} ", Number(*x), Number(*y), Number(*z))?;
    }
    Ok(())
}

impl Display for Finish {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let number = |x: f32| Number(x.into());
        match *self {
            Self::Diffuse(a) => write!(f, "Material \"diffuse\" \"rgb reflectance\" [ {0} {0} {0} ]", number(a)),
            Self::Mirror(a) => write!(f, "Material \"mirror\" \"rgb Kr\" [ {0} {0} {0} ]", number(a)),
            Self::Metal { eta, k, alpha } => write!(
                f,
                "Material \"conductor\" \"rgb eta\" [ {0} {0} {0} ] \"rgb k\" [ {1} {1} {1} ]
  \"float roughness\" {2} \"bool remaproughness\" false",
                number(eta),
                number(k),
                number(alpha)
            ),
        }
    }
}

impl Display for Part {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "AttributeBegin\n  {}", self.finish)?;
        if let Some(Glow { radiance, two_sided }) = self.glow {
            write!(f, "  AreaLightSource \"diffuse\" \"rgb L\" [ {0} {0} {0} ]", Number(radiance.into()))?;
            writeln!(f, "{}", if two_sided { " \"bool twosided\" true" } else { "" })?;
        }
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
        writeln!(f, "AttributeEnd")
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
