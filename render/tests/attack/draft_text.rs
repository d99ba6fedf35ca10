//! Drafts as the text of a scene file.

use super::draft::{Draft, Finish, Form, Frame, Glow, Kind, Look, Map, Part, SourceDraft, V3};
use super::skin::Number;
use std::fmt::{self, Display, Formatter};

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
        }
        Ok(())
    }
}

impl Display for SourceDraft {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "AttributeBegin")?;
        if let Some(map) = &self.map {
            transform(f, map)?;
        }
        let (kind, name) = match self.kind {
            Kind::Point(_) => ("point", "I"),
            Kind::Spot(..) => ("spot", "I"),
            Kind::Distant(_) => ("distant", "L"),
            Kind::Sky => ("infinite", "L"),
        };
        let strength = Number(self.strength.into());
        write!(f, "  LightSource \"{kind}\"")?;
        match &self.picture {
            Some(picture) => write!(f, " \"string filename\" \"{}\" \"float scale\" {strength}", picture.name())?,
            None => write!(f, " \"rgb {name}\" [ {strength} {strength} {strength} ]")?,
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
        writeln!(f, "\nAttributeEnd")
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
