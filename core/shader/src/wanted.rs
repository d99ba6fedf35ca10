//! Which functions and fields a source has.

use crate::module::Leaf;
use std::collections::BTreeSet;

/// A function of a prepared light or of a warp.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Draws a direction or a point.
    Sample,
    /// The density of a direction or a point.
    Pdf,
    /// The point of the light in a direction.
    Hit,
    /// The random numbers of a direction or a point.
    Invert,
    /// What the technique is uniform over.
    Measure,
}

/// A field of a sample of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SampleField {
    /// See [`etendue::LightSample::direction`].
    Direction,
    /// See [`etendue::LightSample::distance`].
    Distance,
    /// See [`etendue::LightSample::pdf`].
    Pdf,
    /// See [`etendue::LightSample::weight`].
    Weight,
    /// See [`etendue::LightSample::normal`].
    Normal,
    /// See [`etendue::LightSample::uv`].
    Uv,
    /// See [`etendue::LightSample::emits`].
    Emits,
    /// See [`etendue::LightSample::delta`].
    Delta,
}

macro_rules! names {
    ($type:ident { $($variant:ident = $name:literal),+ }) => {
        impl $type {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];
            /// Its name in sources and on the command line.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name),+
                }
            }
        }
    };
}
names!(Part { Sample = "sample", Pdf = "pdf", Hit = "hit", Invert = "invert", Measure = "measure" });
names!(SampleField {
    Direction = "direction",
    Distance = "distance",
    Pdf = "pdf",
    Weight = "weight",
    Normal = "normal",
    Uv = "uv",
    Emits = "emits",
    Delta = "delta"
});

impl SampleField {
    /// Its type.
    #[must_use]
    pub fn leaf(self) -> Leaf {
        match self {
            Self::Direction | Self::Normal => Leaf::Vec3,
            Self::Uv => Leaf::Vec2,
            Self::Distance | Self::Pdf | Self::Weight => Leaf::Real,
            Self::Emits | Self::Delta => Leaf::Truth,
        }
    }
    /// What it is.
    #[must_use]
    pub fn doc(self) -> &'static str {
        match self {
            Self::Direction => "Unit direction from the shading point to the light.",
            Self::Distance => "Distance along it, in the unit of the coordinates; 3.4e38 for lights at infinity.",
            Self::Pdf => {
                "Density of the direction, per steradian unless the technique says otherwise; 0 where there is no sample."
            }
            Self::Weight => {
                "1/pdf where there is a sample that emits this way, else 0: what an estimator multiplies by."
            }
            Self::Normal => "Unit normal of the light at the point.",
            Self::Uv => "Surface coordinates of the point, in [0, 1].",
            Self::Emits => "True on the side of the light that emits.",
            Self::Delta => "True where no other technique can hit the light.",
        }
    }
}

/// The functions and the fields that a source has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// Which functions, besides the preparation.
    pub parts: BTreeSet<Part>,
    /// Which fields samples have; what only others need is not computed.
    pub fields: BTreeSet<SampleField>,
}

impl Default for Wanted {
    fn default() -> Self {
        Self { parts: Part::ALL.iter().copied().collect(), fields: SampleField::ALL.iter().copied().collect() }
    }
}
