//! Textures: colours and numbers that vary over a surface.

use std::sync::{Arc, LazyLock};

/// What is outside of the unit square of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// The image again, every second time mirrored.
    Mirror,
    /// Its nearest texel.
    Clamp,
    /// Black.
    Black,
}

/// The texels of an image, row by row from the top.
#[derive(Clone)]
pub struct Texels {
    /// Columns, at least 1.
    pub width: usize,
    /// Rows, at least 1.
    pub height: usize,
    /// Colours.
    pub colors: Colors,
    /// Opacity of each texel in [0, 255], if the image has it.
    pub alpha: Option<Vec<u8>>,
}

/// The colours of texels.
#[derive(Clone, PartialEq)]
pub enum Colors {
    /// Bytes that encode [0, 1] by sRGB's curve.
    Srgb(Vec<[u8; 3]>),
    /// Bytes in proportion to [0, 1].
    Linear(Vec<[u8; 3]>),
    /// Linear RGB.
    Float(Vec<[f32; 3]>),
}

impl PartialEq for Texels {
    fn eq(&self, other: &Self) -> bool {
        let parts = |of: &Self| (of.width, of.height);
        let same = || parts(self) == parts(other) && self.colors == other.colors && self.alpha == other.alpha;
        std::ptr::eq(self, other) || same()
    }
}

impl std::fmt::Debug for Texels {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} × {} texels", self.width, self.height)
    }
}

/// The linear value of a number in [0, 1] that sRGB's curve encodes (IEC 61966-2-1).
#[must_use]
pub fn srgb_to_linear(x: f64) -> f32 {
    (if x <= 0.040_45 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) }) as f32
}

/// The linear value of each byte of sRGB.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| std::array::from_fn(|byte| srgb_to_linear(byte as f64 / 255.0)));

impl Texels {
    /// The colour of a texel, linear RGB.
    #[inline]
    fn color(&self, index: usize) -> [f32; 3] {
        match &self.colors {
            Colors::Srgb(bytes) => bytes[index].map(|byte| LINEAR[usize::from(byte)]),
            Colors::Linear(bytes) => bytes[index].map(|byte| f32::from(byte) / 255.0),
            Colors::Float(colors) => colors[index],
        }
    }
    /// The opacity of a texel, as a number.
    #[inline]
    fn opacity(&self, index: usize) -> [f32; 3] {
        [self.alpha.as_ref().map_or(1.0, |alpha| f32::from(alpha[index]) / 255.0); 3]
    }
    /// The greatest value of each channel, at least 0.
    #[must_use]
    pub fn greatest(&self) -> [f32; 3] {
        let texels = (0..self.width * self.height).map(|index| self.color(index));
        texels.fold([0.0; 3], |most, texel| std::array::from_fn(|k| texel[k].max(most[k])))
    }
    /// The mean colour of all texels, linear RGB.
    #[must_use]
    pub fn average(&self) -> [f64; 3] {
        self.average_of(Self::color)
    }
    /// The mean over all texels.
    fn mean(&self, value: impl Fn(&Self, usize) -> [f32; 3]) -> [f32; 3] {
        self.average_of(value).map(|x| x as f32)
    }
    fn average_of(&self, value: impl Fn(&Self, usize) -> [f32; 3]) -> [f64; 3] {
        let count = self.width * self.height;
        let mut sum = [0.0_f64; 3];
        for index in 0..count {
            sum.iter_mut().zip(value(self, index)).for_each(|(sum, x)| *sum += f64::from(x));
        }
        sum.map(|x| x / count as f64)
    }
}

/// From texture coordinates (u, v) to positions in an image or pattern: both rows are factors of u, v and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping(pub [[f32; 3]; 2]);

impl Mapping {
    /// The coordinates themselves.
    pub const IDENTITY: Self = Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);

    #[inline]
    fn at(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        self.0.map(|[a, b, c]| a * u + b * v + c)
    }
    /// First `self`, then another mapping.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let [s, t] = self.0;
        Self(next.0.map(|[a, b, c]| std::array::from_fn(|k| a * s[k] + b * t[k] + if k == 2 { c } else { 0.0 })))
    }
}

/// A picture on a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The texels.
    pub texels: Arc<Texels>,
    /// From (u, v) to the image: (0, 0) is its upper left corner, (1, 1) its lower right one.
    pub mapping: Mapping,
    /// What is beyond the edges, across and down.
    pub wrap: [Wrap; 2],
    /// Whether texels are interpolated bilinearly; else the nearest one counts.
    pub bilinear: bool,
}

/// A colour or a number that varies over a surface. A number is a colour of three equal channels.
#[derive(Clone, Debug, PartialEq)]
pub enum Texture {
    /// The same everywhere.
    Constant([f32; 3]),
    /// A picture.
    Picture(Picture),
    /// The opacity of a picture, as a number; 1 if it has none.
    Opacity(Picture),
    /// One channel of a texture, as a number.
    Channel(Arc<Texture>, usize),
    /// The products of two textures.
    Product(Arc<[Texture; 2]>),
    /// 1 − x, but at least 0.
    Inverse(Arc<Texture>),
    /// √x; of negative numbers 0.
    Root(Arc<Texture>),
    /// (1 − t) a + t b.
    Mix(Arc<[Texture; 3]>),
    /// One texture in squares where ⌊s⌋ + ⌊t⌋ is even, the other one elsewhere.
    Checkerboard(Arc<[Texture; 2]>, Mapping),
}

impl Texture {
    /// A texture of textures, which is a constant if they are.
    fn folded(self, is_constant: bool) -> Self {
        // a constant has the same value everywhere
        if is_constant { Self::Constant(self.at([0.0; 2])) } else { self }
    }
    /// The product of two textures.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        match (&self, &other) {
            (Self::Constant([1.0, 1.0, 1.0]), _) => other,
            (_, Self::Constant([1.0, 1.0, 1.0])) => self,
            _ => {
                let both = self.constant().is_some() && other.constant().is_some();
                Self::Product(Arc::new([self, other])).folded(both)
            }
        }
    }
    /// (1 − t) a + t b.
    #[must_use]
    pub fn mix(a: Self, b: Self, t: Self) -> Self {
        match t.constant() {
            Some([0.0, 0.0, 0.0]) => a,
            Some([1.0, 1.0, 1.0]) => b,
            _ => {
                let all = [&a, &b, &t].iter().all(|of| of.constant().is_some());
                Self::Mix(Arc::new([a, b, t])).folded(all)
            }
        }
    }
    /// 1 − x, but at least 0.
    #[must_use]
    pub fn inverse(self) -> Self {
        let one = self.constant().is_some();
        Self::Inverse(Arc::new(self)).folded(one)
    }
    /// One channel, as a number.
    #[must_use]
    pub fn channel(self, channel: usize) -> Self {
        let one = self.constant().is_some();
        Self::Channel(Arc::new(self), channel).folded(one)
    }
    /// A number.
    #[must_use]
    pub const fn number(x: f32) -> Self {
        Self::Constant([x; 3])
    }
    /// The square root of a number.
    #[must_use]
    pub fn root(self) -> Self {
        let one = self.constant().is_some();
        Self::Root(Arc::new(self)).folded(one)
    }
    /// The value, if it is the same everywhere.
    #[must_use]
    pub fn constant(&self) -> Option<[f32; 3]> {
        if let Self::Constant(color) = self { Some(*color) } else { None }
    }
    /// The number of textures that a value is computed of, each counted as often as it is, if there are at most `most`. That many are
    /// visited.
    #[must_use]
    pub fn parts(&self, most: usize) -> Option<usize> {
        let all =
            |of: &[Self]| of.iter().try_fold(1, |sum: usize, part| Some(sum + part.parts(most.checked_sub(sum)?)?));
        let found = match self {
            Self::Constant(_) | Self::Picture(_) | Self::Opacity(_) => Some(1),
            Self::Channel(of, _) | Self::Inverse(of) | Self::Root(of) => all(std::slice::from_ref(of)),
            Self::Product(of) | Self::Checkerboard(of, _) => all(&of[..]),
            Self::Mix(of) => all(&of[..]),
        };
        found.filter(|parts| *parts <= most)
    }
    /// The value at texture coordinates.
    #[must_use]
    pub fn at(&self, uv: [f32; 2]) -> [f32; 3] {
        match self {
            Self::Constant(color) => *color,
            Self::Picture(picture) => picture.at(uv),
            Self::Opacity(picture) => picture.opacity(uv),
            Self::Channel(of, channel) => [of.at(uv)[*channel]; 3],
            Self::Product(of) => {
                let (a, b) = (of[0].at(uv), of[1].at(uv));
                std::array::from_fn(|k| a[k] * b[k])
            }
            Self::Inverse(of) => of.at(uv).map(|x| (1.0 - x).max(0.0)),
            Self::Root(of) => of.at(uv).map(|x| x.max(0.0).sqrt()),
            Self::Mix(of) => {
                let [a, b, t] = [0, 1, 2].map(|k| of[k].at(uv));
                std::array::from_fn(|k| (1.0 - t[k]) * a[k] + t[k] * b[k])
            }
            Self::Checkerboard(of, mapping) => {
                let [s, t] = mapping.at(uv).map(f32::floor);
                // even numbers have even halves
                let sum = (s + t) * 0.5;
                of[usize::from(sum != sum.floor())].at(uv)
            }
        }
    }
    /// The mean over the unit square, or nearly: pictures are averaged over all texels, whatever part of them is used.
    #[must_use]
    pub fn mean(&self) -> [f32; 3] {
        let both = |of: &[Self; 2], f: fn(f32, f32) -> f32| {
            let (a, b) = (of[0].mean(), of[1].mean());
            std::array::from_fn(|k| f(a[k], b[k]))
        };
        match self {
            Self::Constant(color) => *color,
            Self::Picture(picture) => picture.texels.mean(Texels::color),
            Self::Opacity(picture) => picture.texels.mean(Texels::opacity),
            Self::Channel(of, channel) => [of.mean()[*channel]; 3],
            Self::Product(of) => both(of, |a, b| a * b),
            Self::Inverse(of) => of.mean().map(|x| (1.0 - x).max(0.0)),
            Self::Root(of) => of.mean().map(|x| x.max(0.0).sqrt()),
            Self::Mix(of) => {
                let [a, b, t] = [0, 1, 2].map(|k| of[k].mean());
                std::array::from_fn(|k| (1.0 - t[k]) * a[k] + t[k] * b[k])
            }
            Self::Checkerboard(of, _) => both(of, |a, b| 0.5 * (a + b)),
        }
    }
}

/// The opacity of a surface with holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    /// Opacity, a number: 0 is a hole. Other numbers are chances that a ray is stopped.
    pub opacity: Texture,
    /// If given, the surface is opaque where the opacity is at least this, and has holes elsewhere.
    pub least: Option<f32>,
}

/// The index of a texel along one axis; `None` if it is black.
#[inline]
fn wrapped(i: i64, count: usize, wrap: Wrap) -> Option<usize> {
    let n = count as i64;
    let inside = match wrap {
        Wrap::Repeat => i.rem_euclid(n),
        Wrap::Mirror => {
            let i = i.rem_euclid(2 * n);
            i.min(2 * n - 1 - i)
        }
        Wrap::Clamp => i.clamp(0, n - 1),
        Wrap::Black => {
            if !(0..n).contains(&i) {
                return None;
            }
            i
        }
    };
    Some(inside as usize)
}

impl Picture {
    /// Texels beside a position along one axis, and the weight of the second one.
    #[inline]
    fn beside(&self, x: f32, count: usize) -> (i64, f32) {
        // positions beyond 2^22 images have no fraction left, and NaN is position 0
        let x = if x.is_nan() { 0.0 } else { f64::from(x).clamp(-4.2e6, 4.2e6) };
        let x = x * count as f64 - if self.bilinear { 0.5 } else { 0.0 };
        let low = x.floor();
        (low as i64, if self.bilinear { (x - low) as f32 } else { 0.0 })
    }
    /// The colour at texture coordinates.
    #[must_use]
    pub fn at(&self, uv: [f32; 2]) -> [f32; 3] {
        self.interpolated(uv, |index| self.texels.color(index))
    }
    /// The index of the texel in a column and a row, which may be beyond the edges; `None` if it is black.
    #[inline]
    fn index(&self, x: i64, y: i64) -> Option<usize> {
        let Texels { width, height, .. } = *self.texels;
        let place = wrapped(x, width, self.wrap[0]).zip(wrapped(y, height, self.wrap[1]));
        place.map(|(x, y)| y * width + x)
    }
    /// The colour of the texel in a column and a row, which may be beyond the edges.
    #[must_use]
    pub fn texel(&self, x: i64, y: i64) -> [f32; 3] {
        self.index(x, y).map_or([0.0; 3], |index| self.texels.color(index))
    }
    fn opacity(&self, uv: [f32; 2]) -> [f32; 3] {
        self.interpolated(uv, |index| self.texels.opacity(index))
    }
    #[inline]
    fn interpolated(&self, uv: [f32; 2], value: impl Fn(usize) -> [f32; 3]) -> [f32; 3] {
        let [s, t] = self.mapping.at(uv);
        let Texels { width, height, .. } = *self.texels;
        let ((x, fx), (y, fy)) = (self.beside(s, width), self.beside(t, height));
        let texel = |x: i64, y: i64| self.index(x, y).map_or([0.0; 3], &value);
        if !self.bilinear {
            return texel(x, y);
        }
        let across = |y: i64| {
            let (a, b) = (texel(x, y), texel(x + 1, y));
            std::array::from_fn::<f32, 3, _>(|k| a[k] + (b[k] - a[k]) * fx)
        };
        let (a, b) = (across(y), across(y + 1));
        std::array::from_fn(|k| a[k] + (b[k] - a[k]) * fy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(wrap: Wrap, bilinear: bool) -> Picture {
        // columns 0, 1, 2 and rows 0, 10
        let colors = Colors::Float([0.0, 1.0, 2.0, 10.0, 11.0, 12.0].map(|x| [x; 3]).to_vec());
        let texels = Arc::new(Texels { width: 3, height: 2, colors, alpha: None });
        Picture { texels, mapping: Mapping::IDENTITY, wrap: [wrap; 2], bilinear }
    }

    #[test]
    fn wraps_go_on_beyond_the_edges() {
        let row = |wrap| (-4..8).map(|i| wrapped(i, 3, wrap)).collect::<Vec<_>>();
        let numbers = |list: [usize; 12]| list.map(Some).to_vec();
        assert_eq!(row(Wrap::Repeat), numbers([2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1]));
        assert_eq!(row(Wrap::Mirror), numbers([2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1]));
        assert_eq!(row(Wrap::Clamp), numbers([0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2]));
        assert_eq!(row(Wrap::Black)[2..9], [None, None, Some(0), Some(1), Some(2), None, None]);
    }

    #[test]
    fn pictures_are_interpolated_between_the_middles_of_texels() {
        let at = |wrap, u: f32, v: f32| picture(wrap, true).at([u, v])[1];
        assert!((at(Wrap::Clamp, 0.5, 0.25) - 1.0).abs() < 1e-6);
        assert!((at(Wrap::Clamp, 2.0 / 3.0, 0.5) - 6.5).abs() < 1e-5);
        assert!((at(Wrap::Clamp, 0.0, 0.0) - 0.0).abs() < 1e-6);
        // half of the first and half of the last column, and of both rows
        assert!((at(Wrap::Repeat, 1.0, 1.0) - 6.0).abs() < 1e-5);
        assert!((at(Wrap::Black, 0.0, 0.75) - 5.0).abs() < 1e-5);
        let nearest = |u: f32, v: f32| picture(Wrap::Repeat, false).at([u, v])[0];
        assert_eq!([nearest(0.34, 0.0), nearest(0.99, 0.51), nearest(-0.01, -0.01)], [1.0, 12.0, 12.0]);
        for odd in [f32::NAN, f32::INFINITY, -1e30, 3e38] {
            for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp, Wrap::Black] {
                let value = picture(wrap, true).at([odd, 0.3])[0];
                assert!((0.0..=12.0).contains(&value), "{odd} {wrap:?}: {value}");
            }
        }
    }

    #[test]
    fn patterns_and_products() {
        let [black, white] = [0.0, 1.0].map(Texture::number);
        let mapping = Mapping([[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]]);
        let board = Texture::Checkerboard(Arc::new([black.clone(), white.clone()]), mapping);
        assert_eq!([0.1, 0.3, 0.6, -0.1].map(|u| board.at([u, 0.1])[0]), [0.0, 1.0, 0.0, 1.0]);
        assert_eq!(board.mean(), [0.5; 3]);
        let scaled = Texture::Constant([2.0, 3.0, 4.0]).times(board);
        assert_eq!(scaled.at([0.3, 0.1]), [2.0, 3.0, 4.0]);
        // what is made of constants is one
        let mix = Texture::mix(black.clone(), white.clone(), Texture::number(0.25));
        assert_eq!([mix.constant(), mix.clone().inverse().constant()], [Some([0.25; 3]), Some([0.75; 3])]);
        assert_eq!(mix.root().constant(), Some([0.5; 3]));
        assert_eq!(Texture::Constant([1.0, 2.0, 3.0]).channel(2).constant(), Some([3.0; 3]));
        assert_eq!(scaled.clone().channel(1).at([0.3, 0.1]), [3.0; 3]);
        let mix = Texture::mix(scaled.clone(), black.clone(), Texture::number(0.25));
        assert_eq!((mix.at([0.3, 0.1]), mix.mean()), ([1.5, 2.25, 3.0], [0.75, 1.125, 1.5]));
        let [first, second] = [0.0, 1.0].map(|t| Texture::mix(scaled.clone(), black.clone(), Texture::number(t)));
        assert_eq!((first, second), (scaled, black));
        let turned = Mapping([[0.0, 1.0, 0.0], [-1.0, 0.0, 1.0]]);
        let both = Mapping([[2.0, 0.0, 0.5], [0.0, 3.0, 0.0]]).then(&turned);
        assert_eq!(both.at([0.25, 0.5]), turned.at([1.0, 1.5]));
    }

    #[test]
    fn bytes_of_srgb_are_linear_light() {
        let one = |colors| Texels { width: 1, height: 1, colors, alpha: None }.mean(Texels::color);
        assert_eq!(one(Colors::Srgb(vec![[0, 255, 255]])), [0.0, 1.0, 1.0]);
        assert!((one(Colors::Srgb(vec![[188; 3]]))[0] - 0.502_886).abs() < 1e-5);
        assert_eq!(one(Colors::Linear(vec![[51; 3]])), [0.2; 3]);
    }
}
