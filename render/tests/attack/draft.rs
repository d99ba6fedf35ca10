//! A scene to attack with: parts that can be left out one by one. `draft_text` writes them as a scene file.

use super::skin::{Picture, Skin};

/// A vector or point in f64; text rounds it to f32.
pub(crate) type V3 = [f64; 3];

/// How a part reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Finish {
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
pub(crate) enum Form {
    /// Triangles.
    Mesh(Vec<[V3; 3]>),
    /// A sphere of this centre and radius.
    Sphere(V3, f64),
    /// The parallelogram of a corner and two edges; the normal is their cross product.
    Parallelogram(V3, V3, V3),
}

/// Emission.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Glow {
    /// Radiance in every channel.
    pub(crate) radiance: f32,
    /// Whether both sides emit.
    pub(crate) two_sided: bool,
}

/// A light without a surface.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SourceDraft {
    /// Kind and position.
    pub(crate) kind: Kind,
    /// Intensity, irradiance or radiance in every channel, or what the picture of a sky is multiplied by.
    pub(crate) strength: f32,
    /// From the space of a sky to world space.
    pub(crate) map: Option<Map>,
    /// What a sky shows.
    pub(crate) picture: Option<Picture>,
}

/// A kind of light without a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// A point.
    Point(V3),
    /// A cone about the way from one point towards another; its angle, and how much of that is the falloff, in degrees.
    Spot([V3; 2], [f64; 2]),
    /// Parallel light along the way from one point to another.
    Distant([V3; 2]),
    /// Light from all around, of which +z is up.
    Sky,
}

/// A part of a scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Part {
    /// Form and position.
    pub(crate) form: Form,
    /// How it reflects.
    pub(crate) finish: Finish,
    /// What it emits, if it is a light.
    pub(crate) glow: Option<Glow>,
    /// What varies over a mesh.
    pub(crate) skin: Skin,
    /// If there are some, the maps that place copies of a mesh, which is nowhere else.
    pub(crate) copies: Vec<Map>,
}

/// A map to world space: the rows of the linear part, each followed by its part of the shift. Text rounds it to f32.
pub(crate) type Map = [[f64; 4]; 3];

/// Where a scene is seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    /// Position of the camera.
    pub(crate) eye: V3,
    /// What is in the middle of the image.
    pub(crate) target: V3,
    /// A direction that appears upwards.
    pub(crate) up: V3,
    /// Angle of view in degrees.
    pub(crate) fov: f64,
    /// Radius and distance of focus of a lens.
    pub(crate) lens: Option<[f64; 2]>,
    /// The film, if it is not square.
    pub(crate) frame: Option<Frame>,
}

/// A film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Width and height in pixels.
    pub(crate) size: [u32; 2],
    /// The columns and rows that are rendered, each from one to before the other.
    pub(crate) window: [[u32; 2]; 2],
    /// Half of the shorter side, if the camera is orthographic.
    pub(crate) screen: Option<f64>,
}

/// A scene of parts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Draft {
    /// What the scene is called.
    pub(crate) name: String,
    /// The camera.
    pub(crate) look: Look,
    /// What is in it.
    pub(crate) parts: Vec<Part>,
    /// Its lights without a surface.
    pub(crate) sources: Vec<SourceDraft>,
    /// Whether copies share their triangles, as they do in scenes that are read only if they have very many of them.
    pub(crate) is_shared: bool,
}

impl Part {
    fn new(form: Form, albedo: f32, glow: Option<Glow>) -> Self {
        Self { form, finish: Finish::Diffuse(albedo), glow, skin: Skin::default(), copies: Vec::new() }
    }
    /// Triangles that reflect.
    pub(crate) fn mesh(triangles: Vec<[V3; 3]>, albedo: f32) -> Self {
        Self::new(Form::Mesh(triangles), albedo, None)
    }
    /// A sphere that reflects.
    pub(crate) fn ball(center: V3, radius: f64, albedo: f32) -> Self {
        Self::new(Form::Sphere(center, radius), albedo, None)
    }
    /// A light, which reflects nothing.
    pub(crate) fn light(form: Form, radiance: f32, two_sided: bool) -> Self {
        Self::new(form, 0.0, Some(Glow { radiance, two_sided }))
    }
    /// Number of primitives.
    pub(crate) fn size(&self) -> usize {
        if let Form::Mesh(triangles) = &self.form { triangles.len() * self.copies.len().max(1) } else { 1 }
    }
}

impl Form {
    /// The triangles of a mesh.
    pub(crate) fn triangles(&self) -> &[[V3; 3]] {
        if let Self::Mesh(triangles) = self { triangles } else { &[] }
    }
    /// Moves the points that define the form, a sphere's being its centre, by `place`, and leaves edges and radii.
    pub(crate) fn moved(&mut self, place: impl Fn(V3) -> V3) {
        match self {
            Self::Mesh(triangles) => triangles.iter_mut().for_each(|t| *t = t.map(&place)),
            Self::Sphere(center, _) => *center = place(*center),
            Self::Parallelogram(p, ..) => *p = place(*p),
        }
    }
}

impl Draft {
    /// A scene that is seen from there.
    pub(crate) const fn new(name: String, look: Look, parts: Vec<Part>) -> Self {
        Self { name, look, parts, sources: Vec::new(), is_shared: false }
    }
    /// The pictures that the text names.
    pub(crate) fn pictures(&self) -> impl Iterator<Item = &Picture> {
        let sources = self.sources.iter().filter_map(|source| source.picture.as_ref());
        self.parts.iter().flat_map(|part| part.skin.pictures()).chain(sources)
    }
    /// The same scene without light.
    fn dark(&self) -> Self {
        let dark = |part: &Part| Part { glow: None, ..part.clone() };
        Self { parts: self.parts.iter().map(dark).collect(), sources: Vec::new(), ..self.clone() }
    }
    /// The scenes with one of its lights each; the others are there, but dark.
    pub(crate) fn alone(&self) -> Vec<Self> {
        let dark = self.dark();
        let with = |index: usize| {
            let mut alone = dark.clone();
            alone.parts[index] = self.parts[index].clone();
            alone
        };
        let of_parts = (0..self.parts.len()).filter(|&i| self.parts[i].glow.is_some()).map(with);
        let of_sources = self.sources.iter().map(|source| Self { sources: vec![source.clone()], ..dark.clone() });
        of_parts.chain(of_sources).collect()
    }
    /// Moves everything.
    pub(crate) fn shift(&mut self, by: V3) {
        let place = |p: V3| std::array::from_fn(|k| p[k] + by[k]);
        let whole = self.parts.iter_mut().filter(|part| part.copies.is_empty());
        whole.for_each(|part| part.form.moved(place));
        for map in self.parts.iter_mut().flat_map(|part| &mut part.copies) {
            map.iter_mut().zip(by).for_each(|(row, by)| row[3] += by);
        }
        (self.look.eye, self.look.target) = (place(self.look.eye), place(self.look.target));
    }
}
