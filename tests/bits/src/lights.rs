//! Every light by every technique: samples, pdfs, inverses and hits; environment images and portals.

use crate::figures::{Figures, Lanes, List, Routine};
use etendue::light::{EnvironmentMap, ImageEnvironment, Portal, PortalEnvironment, PortalTable, Texel};
use etendue::{ConstantEnvironment, DirectionalLight, LightSample, LightSampler, PointLight, Real, SpotLight, Sun};
use etendue_judge::area_lights::AreaLight;
use etendue_judge::fixture::Fixture;
use etendue_judge::generators::{self, Random};
use etendue_judge::packets::{lanes_of, squares_of, vectors_of};

const SLOTS: usize = 50 * Figures::MOST;

/// x⁴: whether `powi` rounds like this depends on how a program is compiled.
fn uneven(x: f32) -> f32 {
    let square = x * x;
    square * square
}

pub(crate) fn sample<R: Real>(lanes: &mut Lanes<'_>, s: &LightSample<R>) {
    lanes.vector(s.direction);
    lanes.vector(s.normal);
    lanes.pair(s.uv);
    lanes.reals([s.distance, s.pdf, s.weight()]);
    lanes.truth::<R>(s.emits);
    lanes.truth::<R>(s.delta);
}
pub(crate) fn sampler<R: Real>(lanes: &mut Lanes<'_>, sampler: &dyn LightSampler<R>, us: &[[f32; 2]], ws: &[[f32; 3]]) {
    let u = squares_of(us);
    let s = sampler.sample(u);
    sample(lanes, &s);
    lanes.real(sampler.pdf(s.direction));
    lanes.pair(sampler.invert(s.direction));
    sample(lanes, &sampler.hit(s.direction));
    let w = vectors_of(|i| ws[i]);
    lanes.pair(sampler.invert(w));
    sample(lanes, &sampler.hit(w));
}

fn unit(random: &mut Random) -> [f32; 3] {
    random.direction().map(|x| x as f32)
}
/// Points of the square, half of them on its edges.
fn square(random: &mut Random) -> [f32; 2] {
    [(); 2].map(|()| generators::unit_or_edge(random) as f32).map(|u| u.min(1.0 - 1.0 / 16_777_216.0))
}

/// Lights of one kind: in one slot of eight, some coordinates are extreme.
struct Area(Vec<(AreaLight, [f32; 2], [f32; 3])>);

impl Area {
    fn new(kind: usize) -> Self {
        // numbers of its own, wherever it is in the list
        let name = format!("{:?}", AreaLight::kinds()[kind]);
        let mut random =
            Random::new(name.bytes().fold(500_u64, |seed, byte| (seed * 31 + u64::from(byte)) % 1_000_003));
        let slot = |round| {
            let mut light = AreaLight::any(kind, round as u32 / 3, &mut random);
            if round % 8 == 7 {
                match random.word() % 4 {
                    0 => light.a = generators::nasty(&mut random),
                    1 => light.p = light.a,
                    2 => light.radius = generators::nasty(&mut random)[2],
                    _ => (light.a, light.c) = (generators::nasty(&mut random), generators::nasty(&mut random)),
                }
            }
            (light, square(&mut random), unit(&mut random))
        };
        Self((0..SLOTS).map(slot).collect())
    }
}
impl Routine for Area {
    fn run<R: Real>(&self, figures: &mut Figures) {
        figures.packets::<R>(self.0.len(), |first, lanes| {
            let slots = &self.0[first..first + R::LANES];
            let us: Vec<_> = slots.iter().map(|slot| slot.1).collect();
            let ws: Vec<_> = slots.iter().map(|slot| slot.2).collect();
            let lights: Vec<_> = slots.iter().map(|slot| slot.0).collect();
            sampler::<R>(lanes, &*AreaLight::prepare(&lights), &us, &ws);
        });
    }
}

/// Lights without a surface.
struct Distant(usize);

impl Routine for Distant {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let mut random = Random::new(600 + self.0 as u64);
        figures.packets::<R>(SLOTS, |_, lanes| {
            let mut places = Vec::new();
            for _ in 0..R::LANES {
                let extreme = random.word().is_multiple_of(4);
                let p = if extreme { generators::nasty(&mut random) } else { unit(&mut random) };
                places.push((p, unit(&mut random), unit(&mut random), square(&mut random), unit(&mut random)));
            }
            let [p, position, n] =
                [vectors_of(|i| places[i].0), vectors_of(|i| places[i].1), vectors_of(|i| places[i].2)];
            let cosine = |k: usize| lanes_of::<R>(|i| f64::from(places[i].3[k]));
            let all: Box<dyn LightSampler<R>> = match self.0 {
                0 => Box::new(PointLight { position }.by_delta(p)),
                1 => {
                    let (one_minus_cos_inner, one_minus_cos_outer) = (cosine(0), R::lit(1.0) + cosine(1));
                    Box::new(SpotLight { position, axis: n, one_minus_cos_inner, one_minus_cos_outer }.by_delta(p))
                }
                2 => Box::new(DirectionalLight::new(n).by_delta()),
                3 => Box::new(Sun::new(n, cosine(0)).by_solid_angle()),
                4 => Box::new(ConstantEnvironment.by_solid_angle()),
                _ => Box::new(ConstantEnvironment.by_projected_solid_angle(n)),
            };
            let us: Vec<_> = places.iter().map(|place| place.3).collect();
            let ws: Vec<_> = places.iter().map(|place| place.4).collect();
            sampler(lanes, &*all, &us, &ws);
        });
    }
}

/// An image of the sky.
struct Sky(EnvironmentMap, usize, usize);

impl Routine for Sky {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let Self(map, width, height) = *self;
        let mut random = Random::new(700);
        let weights: Vec<_> = (0..width * height).map(|_| uneven(random.unit())).collect();
        let mut buffer = vec![0.0; ImageEnvironment::buffer(width, height)];
        let image = ImageEnvironment::build(&weights, width, map, &mut buffer).expect("the weights are valid");
        (0..height).for_each(|y| figures.number(map.texel_solid_angle(width, height, y)));
        figures.packets::<R>(SLOTS, |_, lanes| {
            let (us, ws): (Vec<_>, Vec<_>) = (0..R::LANES).map(|_| (square(&mut random), unit(&mut random))).unzip();
            sampler::<R>(lanes, &image.by_radiance(), &us, &ws);
            let drawn = image.draw::<R>(squares_of(&us));
            sample(lanes, &drawn.light);
            let Texel { x, y, offset } = image.texel::<R>(vectors_of(|i| ws[i]));
            [drawn.x, drawn.y, x, y].into_iter().for_each(|at| lanes.words(at));
            lanes.pair(offset);
        });
    }
}

/// An image of the sky through three portals, two of them parallel.
struct Portals;

impl Routine for Portals {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let mut random = Random::new(900);
        let mut buffers = [vec![0; PortalTable::buffer(16, 12)], vec![0; PortalTable::buffer(9, 30)]];
        let tables = [16, 9].into_iter().zip(&mut buffers).map(|(width, buffer)| {
            let texels = if width == 16 { 192 } else { 270 };
            let weights: Vec<_> = (0..texels).map(|_| uneven(random.unit())).collect();
            PortalTable::build(&weights, width, buffer).expect("the weights are valid")
        });
        let tables: Vec<_> = tables.collect();
        let tables = [tables[0], tables[0], tables[1]];
        let portals = [
            Portal::new([1.0, -1.0, 0.0], [0.0, 0.9, 0.0], [0.0, 0.0, 1.0]),
            Portal::new([1.0, 0.1, 0.2], [0.0, 0.7, 0.0], [0.0, 0.0, 0.5]),
            Portal::new([-0.5, -0.5, 1.0], [1.0, 0.2, 0.0], [0.1, 0.8, 0.1]),
        ]
        .map(|portal| portal.expect("the edges enclose an area"));
        for (k, portal) in portals.iter().enumerate() {
            let [u, v] = square(&mut random).map(f64::from);
            let (direction, solid_angle) = portal.map().direction(etendue::Vec2::new(u, v));
            [direction.x, direction.y, direction.z, solid_angle, k as f64].into_iter().for_each(|x| figures.number(x));
        }
        let sky = PortalEnvironment::new(&portals, &tables).expect("three portals");
        figures.packets::<R>(SLOTS, |_, lanes| {
            let mut places = Vec::new();
            for _ in 0..R::LANES {
                let extreme = random.word().is_multiple_of(8);
                let p = if extreme { generators::nasty(&mut random) } else { unit(&mut random) };
                places.push((p, square(&mut random), unit(&mut random), unit(&mut random)));
            }
            let us: Vec<_> = places.iter().map(|place| place.1).collect();
            let ws: Vec<_> = places.iter().map(|place| place.2).collect();
            let p = vectors_of(|i| places[i].0);
            sampler::<R>(lanes, &sky.by_radiance(p), &us, &ws);
            let w = vectors_of(|i| ws[i]);
            lanes.truth::<R>(sky.sees(p, w));
            sampler::<R>(lanes, &sky.by_radiance_above(p, vectors_of(|i| places[i].3)), &us, &ws);
        });
    }
}

pub(crate) fn add(list: &mut List<'_>) {
    for (kind, (shape, by)) in AreaLight::kinds().iter().enumerate() {
        list.add(format!("light/{shape:?}/{by:?}"), &Area::new(kind));
    }
    let distant = ["Point", "Spot", "Directional", "Sun", "Constant/SolidAngle", "Constant/ProjectedSolidAngle"];
    for (kind, name) in distant.into_iter().enumerate() {
        list.add(format!("light/{name}"), &Distant(kind));
    }
    list.add("light/Image/EqualArea", &Sky(EnvironmentMap::EqualArea, 16, 16));
    list.add("light/Image/Equirectangular", &Sky(EnvironmentMap::Equirectangular, 24, 13));
    list.add("light/Portals", &Portals);
}
