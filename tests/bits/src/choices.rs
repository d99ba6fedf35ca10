//! Choices of lights over the regimes of the trees' tests, and tables.

use crate::figures::{Figures, Lanes, List, Routine};
use etendue::discrete::{PiecewiseConstant1d, PiecewiseConstant2d};
use etendue::reflection::Reflection;
use etendue::select::{Choice, Gloss, LightBound, LightChoice, LightTree, Node8, SpatialLights, UniformLights};
use etendue::{Mask, Real, Uint, Warp};
use etendue_judge::generators::{self, Random};
use etendue_judge::light_tree::{Lamp, PointAndNormal, Regime, place};
use etendue_judge::packets::{lanes_of, squares_of, vectors_of};

fn choice<R: Real>(lanes: &mut Lanes<'_>, choice: &Choice<R>) {
    lanes.words(choice.index);
    lanes.reals([choice.pmf, choice.u]);
}
fn chosen<R: Real>(lanes: &mut Lanes<'_>, all: &impl LightChoice<R>, us: &[f32], lights: &[u32]) {
    let one = all.choose(lanes_of(|i| f64::from(us[i])));
    choice(lanes, &one);
    lanes.reals([all.pmf(one.index), all.pmf(R::Uint::from_fn(|i| lights[i])), all.pmf_of(3)]);
}

/// Lights of a regime, as many numbers and indices as there are slots, and points that the lights make difficult.
struct Set {
    bounds: Vec<LightBound>,
    slots: Vec<(f32, u32, PointAndNormal, [u32; 2])>,
}

fn sets(count: usize, slots: usize) -> Vec<Set> {
    let set = |(k, regime): (usize, Regime)| {
        let mut random = Random::new(1100 + k as u64);
        let lamps = regime.lamps(count, &mut random);
        let slot = |_| {
            let word = random.word();
            let u = (generators::unit_or_edge(&mut random) as f32).min(1.0 - 1.0 / 16_777_216.0);
            let (place, light) = place(regime, &lamps, &mut random);
            (u, if word & 1 == 0 { light as u32 } else { word as u32 % 50 }, place, [word as u32, (word >> 32) as u32])
        };
        let slots = (0..slots).map(slot).collect();
        Set { bounds: lamps.iter().map(Lamp::bound).collect(), slots }
    };
    Regime::ALL.into_iter().enumerate().map(set).collect()
}

/// Directions to viewers.
const VIEWS: [[f32; 3]; 4] = [[0.6, 0.0, 0.8], [0.0, -0.28, 0.96], [0.8, -0.6, 0.0], [-0.36, 0.48, -0.8]];

/// The choices of one kind.
#[derive(Clone, Copy)]
enum ChoiceKind {
    Uniform,
    Spatial,
    Tree,
    /// In a tree, and among few lights, in view of what glossy surfaces reflect.
    Glossy,
}
struct Choices(ChoiceKind, Vec<Set>);

impl Routine for Choices {
    fn run<R: Real>(&self, figures: &mut Figures) {
        for Set { bounds, slots } in &self.1 {
            let few = &bounds[..bounds.len().min(SpatialLights::MOST)];
            let spatial = SpatialLights::new(few).expect("there are few lights");
            let mut nodes = vec![Node8::default(); LightTree::nodes_for(bounds.len())];
            let mut places = vec![0; bounds.len()];
            let tree = LightTree::build(bounds, &mut nodes, &mut places).expect("there is enough memory");
            figures.packets::<R>(slots.len(), |first, lanes| {
                let slots = &slots[first..first + R::LANES];
                let us: Vec<_> = slots.iter().map(|slot| slot.0).collect();
                let lights: Vec<_> = slots.iter().map(|slot| slot.1).collect();
                let (p, n) = (vectors_of::<R>(|i| slots[i].2.0), vectors_of(|i| slots[i].2.1));
                match self.0 {
                    ChoiceKind::Uniform => {
                        chosen::<R>(lanes, &UniformLights { count: bounds.len() as u32 }, &us, &lights)
                    }
                    ChoiceKind::Spatial => {
                        let at = spatial.at(p, n);
                        chosen(lanes, &at, &us, &lights);
                        at.weights().for_each(|weight| lanes.real(weight));
                        let some = at.only(|k| R::Mask::splat(k % 3 != 1));
                        chosen(lanes, &some, &us, &lights);
                    }
                    ChoiceKind::Tree => {
                        let at = tree.at(p, n);
                        chosen(lanes, &at, &us, &lights);
                        choice(lanes, &at.choose_by([0, 1].map(|k| R::Uint::from_fn(|i| slots[i].3[k]))));
                    }
                    ChoiceKind::Glossy => {
                        let some = |shift: u32| lanes_of::<R>(|i| f64::from(slots[i].3[0] >> shift & 255) / 255.0);
                        let views = vectors_of::<R>(|i| VIEWS[slots[i].3[1] as usize % VIEWS.len()]);
                        let gloss = Gloss::new(some(0), some(8), &Reflection::new(some(16), n, views));
                        chosen(lanes, &tree.at_glossy(p, n, &gloss), &us, &lights);
                        chosen(lanes, &spatial.at_glossy(p, n, &gloss), &us, &lights);
                    }
                }
            });
        }
    }
}

/// Weights of cells, some of them 0.
fn weights(count: usize, random: &mut Random) -> Vec<f32> {
    (0..count).map(|_| if random.word().is_multiple_of(5) { 0.0 } else { random.magnitude(1e-4, 1e4) as f32 }).collect()
}

/// Tables of one and two dimensions.
struct Tables;

impl Routine for Tables {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let mut random = Random::new(1300);
        for count in [1, 2, 7, 40, 360] {
            let mut weights = weights(count, &mut random);
            weights[0] = 1.0;
            let mut cdf = vec![0.0; count];
            let line = PiecewiseConstant1d::build(&weights, &mut cdf).expect("the weights are valid");
            let width = count.min(20);
            let mut buffer = vec![0.0; PiecewiseConstant2d::buffer(width, count / width)];
            let image = PiecewiseConstant2d::build(&weights[..width * (count / width)], width, &mut buffer)
                .expect("the weights are valid");
            figures.packets::<R>(40 * Figures::MOST, |_, lanes| {
                let us: Vec<_> = (0..R::LANES)
                    .map(|_| {
                        let edge = generators::EDGES[random.word() as u32 as usize % 11];
                        if random.word() & 1 == 0 { [edge, random.unit()] } else { [random.unit(), edge] }
                    })
                    .collect();
                let u = squares_of::<R>(&us);
                let cell = line.cell(u.x);
                lanes.words(cell.index);
                lanes.reals([cell.offset, cell.pmf]);
                lanes.reals([line.pmf(cell.index), line.invert_cell(cell.index, cell.offset)]);
                let x = line.sample(u.y);
                lanes.reals([x, line.pdf(x), line.invert(x), line.pdf(u.x), line.invert(u.y)]);
                let cell = image.cell(u);
                lanes.words(cell.x);
                lanes.words(cell.y);
                lanes.pair(cell.offset);
                lanes.reals([cell.pmf, image.pmf(cell.x, cell.y), image.pdf(u)]);
                lanes.pair(image.sample(u));
                lanes.pair(image.invert(u));
                lanes.pair(image.invert_cell(cell.x, cell.y, cell.offset));
            });
        }
    }
}

pub(crate) fn add(list: &mut List<'_>) {
    list.add("choice/UniformLights", &Choices(ChoiceKind::Uniform, sets(20, 2 * Figures::MOST)));
    list.add("choice/SpatialLights", &Choices(ChoiceKind::Spatial, sets(12, 8 * Figures::MOST)));
    list.add("choice/LightTree", &Choices(ChoiceKind::Tree, sets(200, 8 * Figures::MOST)));
    list.add("choice/glossy", &Choices(ChoiceKind::Glossy, sets(200, 4 * Figures::MOST)));
    list.add("tables", &Tables);
}
