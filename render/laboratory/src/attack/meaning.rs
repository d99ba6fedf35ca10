//! What a draft means by the specification of its format: the same scene without transforms, factors, watts and curves of lights, and
//! the scenes of each of its lights alone.

use super::draft::{Draft, Form, Glow, Kind, Map, Measure, Part, Source, Swept, V3};
use super::skin::{Picture, Skin};
use etendue_oracle::{along, cross, dot, length, sub};
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// A triangle of a light with the texture coordinates of its corners.
type Piece = ([V3; 3], [[f64; 2]; 3]);

/// As text rounds it.
fn round(v: V3) -> V3 {
    v.map(|x| f64::from(x as f32))
}

fn rounded(map: &Map) -> Map {
    map.map(|row| row.map(|x| f64::from(x as f32)))
}

fn point(map: &Map, p: V3) -> V3 {
    map.map(|[a, b, c, d]| dot([a, b, c], p) + d)
}

fn vector(map: &Map, v: V3) -> V3 {
    map.map(|[a, b, c, _]| dot([a, b, c], v))
}

/// The images of the axes.
pub(super) fn columns(map: &Map) -> [V3; 3] {
    [0, 1, 2].map(|axis| map.map(|row| row[axis]))
}

fn determinant(map: &Map) -> f64 {
    let [a, b, c] = columns(map);
    dot(a, cross(b, c))
}

/// The factor of a map that keeps angles.
fn similarity(map: &Map) -> Option<f64> {
    let factor = libm::cbrt(determinant(map).abs());
    let [a, b, c] = columns(map);
    let even = [a, b, c].iter().all(|v| (length(*v) / factor - 1.0).abs() < 1e-5);
    (even && [(a, b), (b, c), (c, a)].iter().all(|(v, w)| dot(*v, *w).abs() < 1e-5 * factor * factor)).then_some(factor)
}

/// The value of a picture of a light, which is interpolated between the middles of texels and stays as it is beyond them.
fn value(picture: &Picture, [u, v]: [f64; 2]) -> f64 {
    let size = [picture.width, picture.texels.len() / picture.width];
    let at = |x: f64, k: usize| {
        let x = (x * size[k] as f64 - 0.5).clamp(0.0, size[k] as f64 - 1.0);
        (x as usize, (x as usize + 1).min(size[k] - 1), x.fract())
    };
    let ((left, right, s), (low, high, t)) = (at(u, 0), at(v, 1));
    let row = |y: usize| {
        let [a, b] = [left, right].map(|x| f64::from(picture.texels[y * size[0] + x]));
        a + (b - a) * s
    };
    row(low) + (row(high) - row(low)) * t
}

/// About how many points tell a mean.
const POINTS: usize = 1 << 22;

/// The mean of a picture over the area of these triangles.
fn mean(picture: &Picture, pieces: &[Piece]) -> f64 {
    let side = (POINTS / pieces.len()).isqrt().max(4);
    let at = |i: usize| (i as f64 + 0.5) / side as f64;
    let of = |(corners, [a, b, c]): &Piece| {
        let point = |(i, j): (usize, usize)| {
            // the half of the parallelogram beyond the diagonal is turned over
            let [s, t] = if i + j < side { [at(i), at(j)] } else { [1.0 - at(i), 1.0 - at(j)] };
            value(picture, [0, 1].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k])))
        };
        let sum: f64 = (0..side).flat_map(|i| (0..side).map(move |j| (i, j))).map(point).sum();
        [area(corners), area(corners) * sum / (side * side) as f64]
    };
    let [all, shown] = pieces.iter().map(of).fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
    shown / all
}

/// The mean of a picture over a whole sphere.
fn mean_of_sphere(picture: &Picture) -> f64 {
    let side = POINTS.isqrt();
    let at = |i: usize| (i as f64 + 0.5) / side as f64;
    let point = |(i, j): (usize, usize)| value(picture, [at(i), 1.0 - libm::acos(2.0 * at(j) - 1.0) / PI]);
    (0..side).flat_map(|i| (0..side).map(move |j| (i, j))).map(point).sum::<f64>() / (side * side) as f64
}

fn area([a, b, c]: &[V3; 3]) -> f64 {
    0.5 * length(cross(sub(*b, *a), sub(*c, *a)))
}

impl Measure {
    /// The factor of a radiance or an intensity that is 1 where the light has the power, or the illuminance, `unit`.
    fn factor(self, strength: f32, unit: f64) -> f64 {
        let scale = f64::from(self.scale.unwrap_or(1.0));
        scale * self.wanted.map_or(f64::from(strength), |wanted| f64::from(wanted) / unit)
    }
}

impl Swept {
    /// Point and normal at (s, t), with so many pieces about the axis.
    fn at(&self, columns: usize, [s, t]: [f64; 2]) -> [V3; 2] {
        let turn = |sweep: f64| (libm::cos(sweep.to_radians() * s), libm::sin(sweep.to_radians() * s));
        // of the same area as what it stands for
        let grown = |half: f64| half / libm::sin(half);
        match *self {
            Self::Disk { radii: [outer, inner], height, sweep } => {
                let (x, y) = turn(sweep);
                let r = (outer + (inner - outer) * t) * libm::sqrt(grown(sweep.to_radians() / columns as f64));
                [[r * x, r * y, height], [0.0, 0.0, 1.0]]
            }
            Self::Cylinder { radius, z: [low, high], sweep } => {
                let (x, y) = turn(sweep);
                let r = radius * grown(sweep.to_radians() / 128.0);
                [[r * x, r * y, low + (high - low) * t], [x, y, 0.0]]
            }
            Self::Sphere { radius, z, sweep } => {
                let (x, y) = turn(sweep);
                let [from, to] = z.map(|z| libm::acos((z / radius).clamp(-1.0, 1.0)));
                let (up, r) = (libm::cos(from + (to - from) * t), libm::sin(from + (to - from) * t));
                let normal = [r * x, r * y, up];
                [normal.map(|x| radius * x), normal]
            }
            Self::Patch([a, b, c, d]) => {
                let mix = |p: V3, q: V3, t: f64| along(p, sub(q, p), t);
                let normal = cross(sub(mix(b, d, t), mix(a, c, t)), sub(mix(c, d, s), mix(a, b, s)));
                [mix(mix(a, b, s), mix(c, d, s), t), normal]
            }
        }
    }
    /// Its triangles, with their normals on its own side. A patch is as good as curved, and so is a whole disk if it is a disk.
    fn pieces(&self, is_disk: bool) -> Vec<Piece> {
        let [columns, rows] = match self {
            Self::Disk { radii: [_, 0.0], sweep: 360.0, .. } if is_disk => [512, 1],
            Self::Disk { .. } | Self::Cylinder { .. } => [64, 1],
            Self::Sphere { .. } => [64, 32],
            Self::Patch(_) => [16, 16],
        };
        let uv = |i: usize, j: usize| [i as f64 / columns as f64, j as f64 / rows as f64];
        let quad = |(i, j)| [uv(i, j), uv(i + 1, j), uv(i + 1, j + 1), uv(i, j + 1)];
        let quads = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))).map(quad);
        let triangles = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        let side = |uvs: [[f64; 2]; 3]| {
            let middle = [0, 1].map(|k| (uvs[0][k] + uvs[1][k] + uvs[2][k]) / 3.0);
            ordered((uvs.map(|uv| self.at(columns, uv)[0]), uvs), self.at(columns, middle)[1])
        };
        triangles.map(side).collect()
    }
}

/// A triangle with its normal on the side of `normal`.
fn ordered((corners, uvs): Piece, normal: V3) -> Piece {
    let [a, b, c] = corners;
    let is_front = dot(cross(sub(b, a), sub(c, a)), normal) >= 0.0;
    if is_front { (corners, uvs) } else { ([a, c, b], [uvs[0], uvs[2], uvs[1]]) }
}

impl Part {
    /// The triangles of a light in world space: their normals are images of its own, unless they are turned over.
    fn pieces(&self) -> Vec<Piece> {
        let map = self.place.map(|place| rounded(&place.map));
        let own: Vec<Piece> = match &self.form {
            Form::Mesh(triangles) => {
                let uvs = self.skin.uvs(triangles.as_flattened());
                let uv = |i: usize| uvs.as_ref().map_or([0.0; 2], |uvs| uvs[i].map(|x| f64::from(x as f32)));
                let piece = |(i, t): (usize, &[V3; 3])| (t.map(round), [0, 1, 2].map(|k| uv(3 * i + k)));
                triangles.iter().enumerate().map(piece).collect()
            }
            Form::Parallelogram(p, u, v) => {
                let [p, u, v] = [p, u, v].map(|x| round(*x));
                let (a, b) = (along(p, u, 1.0), along(p, v, 1.0));
                let c = along(a, v, 1.0);
                vec![([p, a, c], [[0.0, 0.0], [1.0, 0.0], [1.0; 2]]), ([p, c, b], [[0.0, 0.0], [1.0; 2], [0.0, 1.0]])]
            }
            Form::Sphere(center, radius) => {
                let radius = f64::from(*radius as f32);
                let moved = |(corners, uvs): Piece| (corners.map(|p| along(p, round(*center), 1.0)), uvs);
                Swept::Sphere { radius, z: [-radius, radius], sweep: 360.0 }
                    .pieces(false)
                    .into_iter()
                    .map(moved)
                    .collect()
            }
            Form::Swept(swept) => {
                swept.pieces(self.skin.glow.is_none() && map.is_none_or(|map| similarity(&map).is_some()))
            }
        };
        let mirrors = map.is_some_and(|map| determinant(&map) < 0.0);
        let turned = self.place.is_some_and(|place| place.is_reversed) != mirrors;
        let placed = |(corners, uvs): Piece| {
            let [a, b, c] = corners.map(|p| round(map.map_or(p, |map| point(&map, p))));
            if turned { ([a, c, b], [uvs[0], uvs[2], uvs[1]]) } else { ([a, b, c], uvs) }
        };
        let has_area = |([a, b, c], _): &Piece| cross(sub(*b, *a), sub(*c, *a)) != [0.0; 3];
        own.into_iter().map(placed).filter(has_area).collect()
    }
    /// The part that means the same, whose light has neither a factor nor watts.
    fn meant(&self) -> Self {
        let Some(glow) = self.glow else { return self.clone() };
        let map = self.place.map(|place| rounded(&place.map));
        let is_reversed = self.place.is_some_and(|place| place.is_reversed);
        let sides = if glow.two_sided { 2.0 } else { 1.0 };
        let picture = self.skin.glow.as_ref();
        // a picture has its own radiance, so that its factor is in place of one
        let part = |form: Form, area: f64, mean: f64, skin: Skin| {
            let strength = if picture.is_some() { 1.0 } else { glow.radiance };
            let radiance = glow.measure.factor(strength, PI * sides * area * mean) as f32;
            let measure = Measure { scale: picture.is_some().then_some(radiance), wanted: None };
            Self { form, glow: Some(Glow { radiance, measure, ..glow }), skin, place: None, ..self.clone() }
        };
        let similar = map.map_or(Some(1.0), |map| similarity(&map));
        match (&self.form, similar) {
            (Form::Sphere(center, radius), Some(factor))
                if (!is_reversed || glow.two_sided) && (map.is_none() || picture.is_none()) =>
            {
                let radius = f64::from(*radius as f32) * factor;
                let center = map.map_or(*center, |map| point(&map, round(*center)));
                let mean = picture.map_or(1.0, mean_of_sphere);
                return part(Form::Sphere(center, radius), 4.0 * PI * radius * radius, mean, self.skin.clone());
            }
            (Form::Parallelogram(p, u, v), _) if picture.is_none() => {
                let moved = |v: &V3| map.map_or(*v, |map| vector(&map, round(*v)));
                let (p, u, v) = (map.map_or(*p, |map| point(&map, round(*p))), moved(u), moved(v));
                let turned = is_reversed != map.is_some_and(|map| determinant(&map) < 0.0);
                let (u, v) = if turned { (v, u) } else { (u, v) };
                return part(Form::Parallelogram(p, u, v), length(cross(u, v)), 1.0, Skin::default());
            }
            _ => {}
        }
        let pieces = self.pieces();
        let own_uvs = pieces.iter().filter(|_| picture.is_some()).flat_map(|(_, uvs)| *uvs).collect();
        let skin = Skin { glow: picture.cloned(), own_uvs, ..Skin::default() };
        let mesh = Form::Mesh(pieces.iter().map(|(corners, _)| *corners).collect());
        let all = pieces.iter().map(|(corners, _)| area(corners)).sum();
        let mean = picture.filter(|_| glow.measure.wanted.is_some()).map_or(1.0, |of| mean(of, &pieces));
        part(mesh, all, mean, skin)
    }
}

impl Source {
    /// The same light in world space, with neither factors nor watts; a sky keeps its map.
    fn meant(&self) -> Self {
        let map = self.map.as_ref().map(rounded);
        let place = |p: V3| map.map_or(p, |map| point(&map, round(p)));
        let unit = match self.kind {
            Kind::Point(_) => 4.0 * PI,
            Kind::Spot(_, [angle, delta]) => {
                // by the mean of both cones
                let [inner, outer] = [angle - delta, angle].map(|x| 2.0 * libm::sin(0.5 * x.to_radians()).powi(2));
                PI * (inner + outer)
            }
            Kind::Distant(_) => 1.0,
            Kind::Sky => self.picture.as_ref().map_or(PI, illuminance),
        };
        let kind = match self.kind {
            Kind::Point(from) => Kind::Point(place(from)),
            Kind::Spot(way, angles) => Kind::Spot(way.map(place), angles),
            Kind::Distant([from, to]) => {
                // a direction, of any length
                let along = map.map_or(sub(to, from), |map| vector(&map, sub(round(to), round(from))));
                Kind::Distant([[0.0; 3], etendue_oracle::unit(along)])
            }
            Kind::Sky => Kind::Sky,
        };
        let strength = self.measure.factor(if self.picture.is_some() { 1.0 } else { self.strength }, unit) as f32;
        let measure = Measure { scale: self.picture.is_some().then_some(strength), wanted: None };
        Self {
            kind,
            strength,
            measure,
            map: self.map.filter(|_| self.kind == Kind::Sky),
            picture: self.picture.clone(),
        }
    }
}

/// The illuminance of a surface towards +z by a sky with a picture.
fn illuminance(picture: &Picture) -> f64 {
    let (columns, rows) = (picture.width, picture.texels.len() / picture.width);
    let texel = |x: usize, y: usize| f64::from(picture.texels[(rows - 1 - y) * columns + x]);
    if columns != rows {
        // ∫cosθ dω of a row is half the difference of the squared cosines of its edges, for each radian about the pole
        let edge = |y: usize| libm::cos(PI * y as f64 / rows as f64).max(0.0).powi(2);
        let of = |y: usize| 0.5 * (edge(y) - edge(y + 1)) * TAU / columns as f64;
        return (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))).map(|(x, y)| texel(x, y) * of(y)).sum();
    }
    // the cosine is 1 − r² where r is the sum of the distances from the middle, relative to the half side
    let cells = 2048_usize.next_multiple_of(columns);
    let at = |i: usize| (2.0 * (i as f64 + 0.5) / cells as f64 - 1.0).abs();
    let cell = |i: usize, j: usize| {
        let r = at(i) + at(j);
        texel(i * columns / cells, j * rows / cells) * (1.0 - r * r).max(0.0)
    };
    let sum: f64 = (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))).map(|(i, j)| cell(i, j)).sum();
    16.0 * FRAC_PI_4 * sum / (cells * cells) as f64
}

impl Draft {
    /// The same scene without what the reader has to work out.
    #[must_use]
    pub fn meant(&self) -> Self {
        let parts = self.parts.iter().map(Part::meant).collect();
        Self { parts, sources: self.sources.iter().map(Source::meant).collect(), ..self.clone() }
    }
    /// The same scene without light.
    #[must_use]
    pub fn dark(&self) -> Self {
        let dark = |part: &Part| Part { glow: None, skin: Skin { glow: None, ..part.skin.clone() }, ..part.clone() };
        Self { parts: self.parts.iter().map(dark).collect(), sources: Vec::new(), ..self.clone() }
    }
    /// The scenes with one of its lights each; the others are there, but dark.
    #[must_use]
    pub fn alone(&self) -> Vec<Self> {
        let dark = self.dark();
        let with = |index: usize| {
            let mut alone = dark.clone();
            alone.parts[index] = self.parts[index].clone();
            alone
        };
        let of_parts = (0..self.parts.len()).filter(|&i| self.parts[i].glow.is_some()).map(with);
        of_parts
            .chain(self.sources.iter().map(|source| Self { sources: vec![source.clone()], ..dark.clone() }))
            .collect()
    }
    /// Number of lights.
    #[must_use]
    pub fn lights(&self) -> usize {
        self.sources.len() + self.parts.iter().filter(|part| part.glow.is_some()).count()
    }
}
