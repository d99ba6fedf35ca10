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
    /// A light that becomes triangles.
    Swept(Swept),
}

/// A surface over (s, t) in \[0, 1\]², whose angle in degrees is `sweep`, about +z from +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Swept {
    /// A disk with a hole; the normal is +z.
    Disk {
        /// Outer and inner radius.
        radii: [f64; 2],
        /// Its z.
        height: f64,
        /// Angle in degrees.
        sweep: f64,
    },
    /// A cylinder; the normal points outwards.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Least and greatest z.
        z: [f64; 2],
        /// Angle in degrees.
        sweep: f64,
    },
    /// A sphere, or a zone of one; the normal points outwards.
    Sphere {
        /// Radius.
        radius: f64,
        /// Least and greatest z.
        z: [f64; 2],
        /// Angle in degrees.
        sweep: f64,
    },
    /// The bilinear patch of the corners at (0, 0), (1, 0), (0, 1) and (1, 1); the normal is ∂s × ∂t.
    Patch([V3; 4]),
}

/// Emission, constant but for the picture of a skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glow {
    /// Radiance in every channel.
    pub radiance: f32,
    /// Whether both sides emit.
    pub two_sided: bool,
    /// Its factor, and its power in watts.
    pub measure: Measure,
}

/// Parameters of a light beside its radiance or intensity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measure {
    /// What all is multiplied by.
    pub scale: Option<f32>,
    /// The power, or the illuminance of a light at infinity, that it has before.
    pub wanted: Option<f32>,
}

/// A light without a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Kind and position in its own space.
    pub kind: Kind,
    /// Intensity, irradiance or radiance in every channel.
    pub strength: f32,
    /// Its factor, and its power in watts or its illuminance.
    pub measure: Measure,
    /// From its space to world space.
    pub map: Option<Map>,
    /// What a sky shows.
    pub picture: Option<Picture>,
}

/// A kind of light without a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A point.
    Point(V3),
    /// A cone about the way from one point towards another; its angle, and how much of that is the falloff, in degrees.
    Spot([V3; 2], [f64; 2]),
    /// Parallel light along the way from one point to another.
    Distant([V3; 2]),
    /// Light from all around, of which +z is up.
    Sky,
}

/// Where a part is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// From the space of its form to world space.
    pub map: Map,
    /// Whether its normals are turned over.
    pub is_reversed: bool,
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
    /// Where a light is, if its form does not tell.
    pub place: Option<Place>,
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
    /// The film, if it is not square.
    pub frame: Option<Frame>,
}

/// A film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The columns and rows that are rendered, each from one to before the other.
    pub window: [[u32; 2]; 2],
    /// Half of the shorter side, if the camera is orthographic.
    pub screen: Option<f64>,
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
    /// Its lights without a surface.
    pub sources: Vec<Source>,
    /// Whether copies share their triangles, as they do in scenes that are read only if they have very many of them.
    pub is_shared: bool,
}

impl Part {
    fn new(form: Form, albedo: f32, glow: Option<Glow>) -> Self {
        Self { form, finish: Finish::Diffuse(albedo), glow, skin: Skin::default(), copies: Vec::new(), place: None }
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
        Self::new(form, 0.0, Some(Glow { radiance, two_sided, measure: Measure::default() }))
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
            Self::Swept(_) => {}
        }
    }
}

impl Draft {
    /// A scene that is seen from there.
    #[must_use]
    pub const fn new(name: String, look: Look, parts: Vec<Part>) -> Self {
        Self { name, look, parts, sources: Vec::new(), is_shared: false }
    }
    /// Number of primitives.
    #[must_use]
    pub fn size(&self) -> usize {
        self.parts.iter().map(Part::size).sum::<usize>() + self.sources.len()
    }
    /// The pictures that the text names.
    pub fn pictures(&self) -> impl Iterator<Item = &Picture> {
        let sources = self.sources.iter().filter_map(|source| source.picture.as_ref());
        self.parts.iter().flat_map(|part| part.skin.pictures()).chain(sources)
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

impl Measure {
    /// Its parameters, of which the second one has this name.
    const fn named(self, wanted: &str) -> Measured<'_> {
        Measured(self, wanted)
    }
}

/// Parameters of a light, and the name of the second one.
struct Measured<'a>(Measure, &'a str);

impl Display for Measured<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(Measure { scale, wanted }, name) = *self;
        for (name, x) in [("scale", scale), (name, wanted)] {
            if let Some(x) = x {
                write!(f, " \"float {name}\" {}", Number(x.into()))?;
            }
        }
        Ok(())
    }
}

/// A map as 16 numbers, column by column.
fn transform(f: &mut Formatter<'_>, map: &Map) -> fmt::Result {
    write!(f, "  Transform [")?;
    for axis in 0..4 {
        map.iter().try_for_each(|row| write!(f, " {}", Number(row[axis])))?;
        write!(f, " {} ", if axis == 3 { 1 } else { 0 })?;
    }
    writeln!(f, "]")
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
        if let Some(Glow { radiance, two_sided, measure }) = self.glow {
            write!(f, "  AreaLightSource \"diffuse\" ")?;
            match &self.skin.glow {
                Some(picture) => write!(f, "\"string filename\" \"{}\"", picture.name())?,
                None => write!(f, "\"rgb L\" [ {0} {0} {0} ]", Number(radiance.into()))?,
            }
            writeln!(f, "{}{}", measure.named("power"), if two_sided { " \"bool twosided\" true" } else { "" })?;
        }
        if let Some(Place { map, is_reversed }) = &self.place {
            transform(f, map)?;
            f.write_str(if *is_reversed { "  ReverseOrientation\n" } else { "" })?;
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
                if let Some(uvs) = self.skin.uvs(triangles.as_flattened()) {
                    write!(f, "    \"point2 uv\" [")?;
                    for [u, v] in uvs {
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
            Form::Swept(swept) => swept.fmt(f)?,
        }
        Ok(())
    }
}

impl Display for Swept {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (kind, sweep, numbers) = match *self {
            Self::Disk { radii: [radius, inner], height, sweep } => {
                ("disk", sweep, [("radius", radius), ("innerradius", inner), ("height", height)])
            }
            Self::Cylinder { radius, z: [low, high], sweep } => {
                ("cylinder", sweep, [("radius", radius), ("zmin", low), ("zmax", high)])
            }
            Self::Sphere { radius, z: [low, high], sweep } => {
                ("sphere", sweep, [("radius", radius), ("zmin", low), ("zmax", high)])
            }
            Self::Patch(corners) => {
                write!(f, "  Shape \"bilinearmesh\" \"point3 P\" [")?;
                points(f, &corners)?;
                return writeln!(f, "]");
            }
        };
        write!(f, "  Shape \"{kind}\" \"float phimax\" {}", Number(sweep))?;
        numbers.iter().try_for_each(|(name, x)| write!(f, " \"float {name}\" {}", Number(*x)))?;
        writeln!(f)
    }
}

impl Display for Source {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "AttributeBegin")?;
        if let Some(map) = &self.map {
            transform(f, map)?;
        }
        let (kind, name, wanted) = match self.kind {
            Kind::Point(_) => ("point", "I", "power"),
            Kind::Spot(..) => ("spot", "I", "power"),
            Kind::Distant(_) => ("distant", "L", "illuminance"),
            Kind::Sky => ("infinite", "L", "illuminance"),
        };
        write!(f, "  LightSource \"{kind}\"")?;
        match &self.picture {
            Some(picture) => write!(f, " \"string filename\" \"{}\"", picture.name())?,
            None => write!(f, " \"rgb {name}\" [ {0} {0} {0} ]", Number(self.strength.into()))?,
        }
        match self.kind {
            Kind::Point(from) => {
                write!(f, " \"point3 from\" [")?;
                points(f, &[from])?;
                write!(f, "]")?;
            }
            Kind::Spot([from, to], _) | Kind::Distant([from, to]) => {
                for (name, at) in [("from", from), ("to", to)] {
                    write!(f, " \"point3 {name}\" [")?;
                    points(f, &[at])?;
                    write!(f, "]")?;
                }
            }
            Kind::Sky => {}
        }
        if let Kind::Spot(_, [angle, delta]) = self.kind {
            write!(f, " \"float coneangle\" {angle:?} \"float conedeltaangle\" {delta:?}")?;
        }
        writeln!(f, "{}\nAttributeEnd", self.measure.named(wanted))
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
            writeln!(f, "AttributeBegin")?;
            transform(f, map)?;
            writeln!(f, "  ObjectInstance \"o\"\nAttributeEnd")?;
        }
        Ok(())
    }
}

impl Display for Draft {
    /// The scene as a pbrt-v4 file, whose numbers are exactly those of the scene in f32.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Look { eye, target, up, fov, lens, frame } = &self.look;
        writeln!(f, "# {}", self.name)?;
        write!(f, "LookAt")?;
        points(f, &[*eye])?;
        [target, up].into_iter().flatten().try_for_each(|x| write!(f, " {x:?}"))?;
        match frame.and_then(|frame| Some((frame.size, frame.screen?))) {
            Some((size, half)) => {
                let [x, y] = size.map(|side| half * f64::from(side) / f64::from(size[0].min(size[1])));
                let window = format!("{:?} {x:?} {:?} {y:?}", -x, -y);
                write!(f, "\nCamera \"orthographic\" \"float screenwindow\" [ {window} ]")?;
            }
            None => write!(f, "\nCamera \"perspective\" \"float fov\" {fov:?}")?,
        }
        if let Some([radius, focus]) = lens {
            write!(f, " \"float lensradius\" {radius:?} \"float focaldistance\" {focus:?}")?;
        }
        let [width, height] = frame.map_or([96; 2], |frame| frame.size);
        write!(f, "\nFilm \"rgb\" \"integer xresolution\" {width} \"integer yresolution\" {height}")?;
        if let Some(Frame { window: [[x0, x1], [y0, y1]], .. }) = frame {
            write!(f, " \"integer pixelbounds\" [ {x0} {x1} {y0} {y1} ]")?;
        }
        writeln!(f, "\n\nWorldBegin")?;
        self.sources.iter().try_for_each(|source| write!(f, "\n{source}"))?;
        self.parts.iter().try_for_each(|part| write!(f, "\n{part}"))
    }
}
