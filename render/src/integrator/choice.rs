//! Which light each lane of a packet samples.

use crate::bvh::GROUP;
use crate::lights::Lights;
use crate::packet::{M8, X8, equal, pick, select};
use crate::sky::SunBeside;
use crate::surfaces::Surface;
use etendue::select::{Allocated, Choice, Gloss, LightChoice};
use etendue::{Mask, Real, u32x8};

/// Which light is sampled.
pub(super) enum Which<'a> {
    Given(u32),
    /// The sun besides the sky, which is the last of the lights.
    Sun(SunBeside<'a>),
    /// The one to which the sample is allocated, or one chosen at random if that is empty.
    Chosen(&'a [Allocated<'a, X8>]),
    /// One of those whose lanes are set, for each light and packet.
    Among(&'a [[M8; GROUP]]),
    /// The one to which the sample is allocated, where its lane is set. Where another light than those that were expected in a packet must
    /// be sampled, too, one chosen at random.
    Expected(&'a [Allocated<'a, X8>], &'a [u32; GROUP], &'a [[M8; GROUP]]),
}

impl Which<'_> {
    /// Chooses a light for each lane of a packet by random numbers, of which the second is for many lights. Returns the lanes that sample
    /// it, too. On `rough` surfaces, all lights are sampled, and their pmf is that of the allocation. A light that is neither given nor
    /// allocated is chosen in view of the gloss.
    #[inline(always)]
    pub(super) fn choose(
        &self,
        lights: &Lights,
        surface: &Surface,
        (rough, gloss): (M8, Option<&Gloss<X8>>),
        packet: usize,
        [number, second]: [X8; 2],
    ) -> (Choice<X8>, M8) {
        let all = surface.reflects;
        match self {
            Self::Given(light) => (Choice { index: u32x8::splat(*light), pmf: X8::lit(1.0), u: number }, all),
            Self::Sun(_) => {
                (Choice { index: u32x8::splat(lights.len() as u32 - 1), pmf: X8::lit(1.0), u: number }, all)
            }
            Self::Chosen(allocated) => match allocated.get(packet) {
                Some(allocated) => (allocated.choose(number), all),
                None => (lights.choose(surface.point, surface.normal, gloss, [number, second]), all),
            },
            Self::Among(open) => among(lights, surface, all, packet, number, open),
            Self::Expected(allocated, expected, open) => {
                let unexpected = (0..lights.len()).filter(|light| expected[packet] >> light & 1 == 0);
                let none = M8::splat(false);
                let stray = !rough & unexpected.fold(none, |stray, light| stray | open[light][packet]);
                let choice = allocated[packet].choose(number);
                let (mut lanes, mut left) = (none, all & !stray);
                while left.any() {
                    let light = choice.index.as_array()[left.bits().trailing_zeros() as usize & 7];
                    let same = left & equal(choice.index, u32x8::splat(light));
                    lanes = lanes | same & open[light as usize][packet];
                    left = left & !same;
                }
                if !stray.any() {
                    return (choice, lanes);
                }
                let (other, others) = among(lights, surface, all & stray, packet, number, open);
                let choice = Choice {
                    index: pick(stray, other.index, choice.index),
                    pmf: select(stray, other.pmf, choice.pmf),
                    u: select(stray, other.u, choice.u),
                };
                (choice, lanes | others)
            }
        }
    }
}

/// Chooses one of the lights whose lanes are set in a packet, for each of these lanes.
#[inline]
fn among(
    lights: &Lights,
    surface: &Surface,
    lanes: M8,
    packet: usize,
    number: X8,
    open: &[[M8; GROUP]],
) -> (Choice<X8>, M8) {
    match lights.contributions(surface.point, surface.normal) {
        Some(near) => (near.only(|light| open[light][packet]).choose(number), lanes),
        None => (Choice { index: u32x8::splat(0), pmf: X8::lit(1.0), u: number }, lanes & open[0][packet]),
    }
}
