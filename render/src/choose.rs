//! Which light is sampled at a shading point. Each way to choose one is a file, which implements `ChooseLight`.

pub mod allocation;
mod choose_light;
mod kinds;
mod light_tree;
mod power;
mod spatial;
mod tree;
mod uniform;

use crate::bvh::BuildError;
use crate::lights::Lights;
use crate::named::named;
use crate::packet::{V8, X8};
use allocation::FEW;
use choose_light::ChooseLight;
use etendue::owned::OwnedTree;
use etendue::select::{Choice, Gloss, LightsAt, SpatialLights, UniformLights};
use etendue::{Real, u32x8};
use kinds::Kinds;
use power::Power;
use std::sync::OnceLock;

named! {
    /// How a light is chosen.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum ChoiceBy {
        /// Choose for me: spatial for 2 to 32 area lights, among which sobol and adaptive divide their samples in advance; otherwise kinds, but up to 32 delta lights alone are all sampled
        #[default]
        Auto = "auto",
        /// Each light has the same chance
        Uniform = "uniform",
        /// By power; that of a sun or sky is what falls on a disk as large as the scene
        Power = "power",
        /// By what each of up to 32 lights can contribute to the point; not with a sun or sky
        Spatial = "spatial",
        /// By a light tree; not with a sun or sky
        Tree = "tree",
        /// Lamps, suns or sky by the irradiance that they can cause at the point, then one of them by a light tree
        Kinds = "kinds",
    }
}

/// A chosen way, with its tables.
#[derive(Debug)]
#[allow(clippy::large_enum_variant, reason = "a scene has few")]
enum Way {
    /// There is at most one light.
    One,
    Uniform(UniformLights),
    Power(Power),
    Spatial(SpatialLights),
    Tree(OwnedTree),
    Kinds(Kinds),
}

/// Chooses among the lights of a scene.
#[derive(Debug)]
pub struct Chooser {
    way: Way,
    /// Whether it is [`ChoiceBy::Auto`].
    is_auto: bool,
    count: usize,
    only_deltas: bool,
}

/// The probabilities of lights at the shading points of a packet, by their indices.
pub type LightPmf<'a> = &'a dyn Fn(u32) -> X8;

/// Chooses in one way.
#[inline(always)]
fn choose_by<C: ChooseLight>(way: &C, p: V8, normal: V8, gloss: Option<&Gloss<X8>>, numbers: [X8; 2]) -> Choice<X8> {
    C::choose(&way.at(p, normal, gloss), numbers)
}

/// Takes the probabilities with which one way chooses.
#[inline(always)]
fn pmf_by<C: ChooseLight, T>(
    way: &C,
    [p, normal]: [V8; 2],
    gloss: Option<&Gloss<X8>>,
    take: impl FnOnce(LightPmf<'_>) -> T,
) -> T {
    let at = way.at(p, normal, gloss);
    take(&|light| C::pmf(&at, light))
}

impl Chooser {
    /// The way to choose that [`ChoiceBy::Auto`] stands for.
    fn auto(lights: &Lights) -> Result<Way, BuildError> {
        let all = lights.records();
        if lights.only_few_areas() && all.len() > 1 {
            return Ok(Way::Spatial(spatial::new(&all).unwrap_or_else(|what| unreachable!("few lights, but {what}"))));
        }
        Ok(if all.len() > 1 { Way::Kinds(Kinds::new(&all, lights.sky())?) } else { Way::One })
    }
    /// Another way to choose, in a scene whose greatest coordinate is `reach`; or why it is none for these lights.
    fn way(lights: &Lights, by: ChoiceBy, reach: f32) -> Result<Way, String> {
        let all = lights.records();
        let somewhere = |way: Way| match all.iter().any(|light| light.far().is_some()) {
            true => Err("lights that are somewhere, and the scene has a sun or a sky".to_owned()),
            false => Ok(way),
        };
        let text = |error: BuildError| error.to_string();
        match by {
            _ if all.len() < 2 => Ok(Way::One),
            ChoiceBy::Auto => Self::auto(lights).map_err(text),
            ChoiceBy::Uniform => uniform::new(all.len()).map(Way::Uniform),
            ChoiceBy::Power => Power::new(&all, reach).map(Way::Power),
            ChoiceBy::Spatial => somewhere(Way::Spatial(spatial::new(&all)?)),
            ChoiceBy::Tree => somewhere(Way::Tree(tree::new(&all).map_err(text)?)),
            ChoiceBy::Kinds => Kinds::new(&all, lights.sky()).map(Way::Kinds).map_err(text),
        }
    }
    fn new(lights: &Lights, way: Way, is_auto: bool) -> Self {
        Self { way, is_auto, count: lights.len(), only_deltas: lights.only_deltas() }
    }
    /// True if the choice of a light needs random numbers of its own: the digits of one do not suffice, or the light needs none.
    pub fn needs_numbers(&self) -> bool {
        self.count > FEW || !self.is_auto && self.only_deltas && self.count > 1
    }
    /// The number of lights if all are sampled, without random numbers: a few delta lights, or none.
    pub fn each(&self) -> Option<u32> {
        let is_each = self.is_auto && self.only_deltas && self.count <= FEW;
        (is_each || self.count == 0).then_some(self.count as u32)
    }
    /// The number of lights among which samples can be allocated: 2 to [`FEW`] that all have an area.
    pub fn few(&self) -> Option<usize> {
        let is_few = self.is_auto && matches!(self.way, Way::Spatial(_));
        is_few.then_some(self.count)
    }
    /// What each light can contribute to points of surfaces, where they are chosen by that.
    #[inline]
    pub fn contributions(&self, p: V8, normal: V8) -> Option<LightsAt<X8>> {
        match &self.way {
            Way::Spatial(lights) => Some(lights.at(p, normal)),
            _ => None,
        }
    }
    /// Chooses a light for each of these points of surfaces, in view of what glossy ones reflect. The second number is for many lights.
    #[inline(always)]
    pub fn choose(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>, numbers: [X8; 2]) -> Choice<X8> {
        match &self.way {
            Way::Spatial(way) => choose_by(way, p, normal, gloss, numbers),
            Way::One => Choice { index: u32x8::splat(0), pmf: X8::lit(1.0), u: numbers[0] },
            Way::Kinds(way) => choose_by(way, p, normal, gloss, numbers),
            _ => self.choose_as_asked(p, normal, gloss, numbers),
        }
    }
    // not inlined, so that it does not burden what `auto` chooses
    #[inline(never)]
    fn choose_as_asked(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>, numbers: [X8; 2]) -> Choice<X8> {
        match &self.way {
            Way::Uniform(way) => choose_by(way, p, normal, gloss, numbers),
            Way::Power(way) => choose_by(way, p, normal, gloss, numbers),
            Way::Tree(way) => choose_by(way, p, normal, gloss, numbers),
            Way::One | Way::Spatial(_) | Way::Kinds(_) => unreachable!("chosen before"),
        }
    }
    /// Takes the probabilities with which [`choose`](Self::choose) chooses at these points. (They are not returned, since what tells them is
    /// large.)
    pub fn pmf<T>(&self, p: V8, normal: V8, gloss: Option<&Gloss<X8>>, take: impl FnOnce(LightPmf<'_>) -> T) -> T {
        match &self.way {
            Way::One => take(&|_| X8::lit(1.0)),
            Way::Uniform(way) => pmf_by(way, [p, normal], gloss, take),
            Way::Power(way) => pmf_by(way, [p, normal], gloss, take),
            Way::Spatial(way) => pmf_by(way, [p, normal], gloss, take),
            Way::Tree(way) => pmf_by(way, [p, normal], gloss, take),
            Way::Kinds(way) => pmf_by(way, [p, normal], gloss, take),
        }
    }
}

/// The ways to choose among the lights of a scene: that of `auto`, and others as soon as they are asked for.
#[derive(Debug)]
pub struct Choosers {
    ways: [OnceLock<Chooser>; ChoiceBy::Kinds as usize + 1],
    reach: f32,
}

impl Choosers {
    /// Prepares `auto` for the lights of a scene whose greatest coordinate is `reach`.
    ///
    /// # Errors
    /// Fails if there are more lights than a tree can index.
    pub fn new(lights: &Lights, reach: f32) -> Result<Self, BuildError> {
        let own = Self { ways: Default::default(), reach };
        let auto = Chooser::new(lights, Chooser::auto(lights)?, true);
        own.ways[ChoiceBy::Auto as usize].get_or_init(|| auto);
        Ok(own)
    }
    /// One of the ways, for the same lights.
    ///
    /// # Errors
    /// Says what it would need if it is none for these lights.
    pub fn by(&self, lights: &Lights, by: ChoiceBy) -> Result<&Chooser, String> {
        let own = &self.ways[by as usize];
        if let Some(chooser) = own.get() {
            return Ok(chooser);
        }
        let way = Chooser::way(lights, by, self.reach)?;
        Ok(own.get_or_init(|| Chooser::new(lights, way, false)))
    }
}
