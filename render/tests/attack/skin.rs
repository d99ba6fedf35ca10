//! What varies over the meshes of a draft: textures, holes, and the normals of smooth surfaces. All of it is a function of the position of
//! corners in the space of the mesh, so that any of its triangles may be left out.

use etendue_oracle::{V3, along, cross, dot, sub, unit};
use std::fmt::{self, Display, Formatter};
use std::hash::{DefaultHasher, Hash, Hasher};

/// A number as f32, with as many digits as it has.
pub(crate) struct Number(pub(super) f64);

impl Display for Number {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let short = format!("{:?}", self.0 as f32);
        // the parser reads f64
        let same = short.parse::<f64>().is_ok_and(|x| (x as f32).to_bits() == (self.0 as f32).to_bits());
        if same { f.write_str(&short) } else { write!(f, "{:?}", f64::from(self.0 as f32)) }
    }
}

/// What varies over a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Skin {
    /// Texture coordinates, if it has some.
    pub(crate) uv: Option<Uv>,
    /// Normals, if it has some.
    pub(crate) bend: Option<Bend>,
    /// The albedo, instead of that of the finish.
    pub(crate) albedo: Option<Pattern>,
    /// The opacity, if there are holes.
    pub(crate) opacity: Option<Pattern>,
}

/// Texture coordinates of a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Uv {
    /// Factors of x, y, z and 1.
    pub(crate) rows: [[f64; 4]; 2],
    /// Greatest magnitude of what is added, which has nothing to do with the coordinates of other corners.
    pub(crate) noise: f64,
}

/// Normals of a corner: away from a centre, or those of the triangles with some noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Bend {
    /// Away from this point.
    Ball(V3),
    /// The triangle's own, and this much of another vector at each corner.
    Bumps(f64),
    /// Those of no surface, of this length.
    Wild(Wild, f64),
}

/// Normals that fit no surface, each of which depends on the position of its corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wild {
    /// Any.
    Any,
    /// The triangle's own or the opposite.
    Opposite,
    /// At this angle in radians from the triangle's own, to any side.
    Beyond(f64),
    /// Any, and 0 at some corners.
    Missing,
}

/// Numbers over texture coordinates.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pattern {
    /// A picture, or else squares of both numbers.
    pub(crate) picture: Result<Picture, [f32; 2]>,
    /// The mode beyond the edges of a picture, in pbrt's words.
    pub(crate) wrap: &'static str,
    /// Whether a picture is interpolated.
    pub(crate) is_bilinear: bool,
    /// Factor and shift of u, and of v.
    pub(crate) scale: [[f64; 2]; 2],
    /// Whether a picture is 1 less its numbers.
    pub(crate) is_inverted: bool,
}

/// The texels of a picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture {
    /// Number of columns.
    pub(crate) width: usize,
    /// Texels, row by row from the bottom.
    pub(crate) texels: Vec<f32>,
}

/// A number from −1 to 1 that depends on a position.
fn noise(p: V3, salt: u64) -> f64 {
    // as the text has it
    let mut hasher = DefaultHasher::new();
    (p.map(|x| (x as f32).to_bits()), salt).hash(&mut hasher);
    (hasher.finish() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

impl Uv {
    /// The coordinates of a corner.
    pub(crate) fn at(&self, p: V3) -> [f64; 2] {
        [0, 1].map(|k| {
            let [a, b, c, d] = self.rows[k];
            dot([a, b, c], p) + d + self.noise * noise(p, k as u64)
        })
    }
}

impl Bend {
    /// The normals at the corners of a triangle.
    pub(crate) fn normals(&self, [a, b, c]: [V3; 3]) -> [V3; 3] {
        let flat = unit(cross(sub(b, a), sub(c, a)));
        [a, b, c].map(|p| {
            let normal = match self {
                Self::Ball(center) => sub(p, *center),
                Self::Bumps(size) => along(flat, [2, 3, 4].map(|salt| noise(p, salt)), *size),
                Self::Wild(wild, length) => return wild.normal(p, flat).map(|x| f64::from((x * length) as f32)),
            };
            let normal = unit(normal).map(|x| f64::from(x as f32));
            if normal == [0.0; 3] { flat } else { normal }
        })
    }
}

impl Wild {
    fn normal(self, p: V3, flat: V3) -> V3 {
        let any = unit([2, 3, 4].map(|salt| noise(p, salt)));
        match self {
            Self::Any => any,
            Self::Opposite => flat.map(|x| x * noise(p, 5).signum()),
            Self::Beyond(angle) => {
                let aside = unit(cross(flat, any));
                along(flat.map(|x| x * libm::cos(angle)), aside, libm::sin(angle))
            }
            Self::Missing => any.map(|x| if noise(p, 5) < -0.4 { 0.0 } else { x }),
        }
    }
}

impl Picture {
    /// The name of its file.
    pub(crate) fn name(&self) -> String {
        let mut hasher = DefaultHasher::new();
        (self.width, self.texels.iter().map(|x| x.to_bits()).collect::<Vec<_>>()).hash(&mut hasher);
        format!("{:016x}.pfm", hasher.finish())
    }
    /// Its file, a portable float map.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut bytes = format!("Pf\n{} {}\n-1\n", self.width, self.texels.len() / self.width).into_bytes();
        bytes.extend(self.texels.iter().flat_map(|x| x.to_le_bytes()));
        bytes
    }
}

impl Skin {
    /// The pictures of its patterns.
    pub(crate) fn pictures(&self) -> impl Iterator<Item = &Picture> {
        let patterns = [&self.albedo, &self.opacity].into_iter().flatten();
        patterns.filter_map(|pattern| pattern.picture.as_ref().ok())
    }
    /// The texture coordinates of corners, if they have some.
    pub(crate) fn uvs(&self, corners: &[V3]) -> Option<Vec<[f64; 2]>> {
        self.uv.map(|uv| corners.iter().map(|p| uv.at(*p)).collect())
    }
}

/// A pattern as the texture of this name, of colours or of numbers.
pub(crate) struct Named<'a>(&'a Pattern, &'a str, bool);

impl Pattern {
    pub(crate) const fn named<'a>(&'a self, name: &'a str, is_color: bool) -> Named<'a> {
        Named(self, name, is_color)
    }
}

impl Display for Named<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(Pattern { picture, wrap, is_bilinear, scale, is_inverted }, name, is_color) = self;
        write!(f, "  Texture \"{name}\" \"{}\" ", if *is_color { "spectrum" } else { "float" })?;
        match picture {
            Ok(picture) => {
                let filter = if *is_bilinear { "bilinear" } else { "point" };
                write!(f, "\"imagemap\" \"string filename\" \"{}\" \"string wrap\" \"{wrap}\"", picture.name())?;
                write!(f, " \"string filter\" \"{filter}\" \"bool invert\" {is_inverted}")?;
            }
            Err(numbers) => {
                write!(f, "\"checkerboard\"")?;
                for (k, x) in (1..).zip(numbers) {
                    let x = Number((*x).into());
                    if *is_color {
                        write!(f, " \"rgb tex{k}\" [ {x} {x} {x} ]")?;
                    } else {
                        write!(f, " \"float tex{k}\" {x}")?;
                    }
                }
            }
        }
        for (axis, [factor, shift]) in ["u", "v"].into_iter().zip(scale) {
            write!(f, " \"float {axis}scale\" {} \"float {axis}delta\" {}", Number(*factor), Number(*shift))?;
        }
        writeln!(f)
    }
}
