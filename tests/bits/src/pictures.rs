//! Lights with pictures by every measure.

use crate::figures::{Figures, Lanes, List, Routine};
use crate::lights::{sample, sampler};
use etendue::light::{Picture, Region, TexelSample};
use etendue::{Disk, LightSampler, Parallelogram, Real, Rectangle, Sphere, Triangle, Vec2, Vec3};
use etendue_judge::generators::{self, Random};
use etendue_judge::packets::{squares_of, vectors_of};

/// A picture on a light of this name, in texels, or interpolated.
struct Shown(&'static str, Region, [usize; 2], bool);

/// x⁶: whether `powi` rounds like this depends on how a program is compiled.
fn sixth(x: f32) -> f32 {
    let square = x * x;
    square * (square * square)
}

/// All methods, and the texel that is drawn.
fn all<R: Real>(
    lanes: &mut Lanes<'_>,
    light: &dyn LightSampler<R>,
    draw: &dyn Fn(Vec2<R>) -> TexelSample<R>,
    us: &[[f32; 2]],
    ws: &[[f32; 3]],
) {
    sampler(lanes, light, us, ws);
    let drawn = draw(squares_of(us));
    sample(lanes, &drawn.light);
    [drawn.x, drawn.y].into_iter().for_each(|at| lanes.words(at));
}

impl Routine for Shown {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let Self(name, region, [width, height], is_interpolated) = *self;
        let mut random = Random::new(950);
        let values: Vec<_> = (0..width * height).map(|_| sixth(random.unit())).collect();
        let mean = |i: usize| Picture::mean_of_bilinear(&values, width, [i % width, i / width]);
        // some texels are dark
        let weights: Vec<_> = (0..width * height).map(|i| if i % 5 == 4 { 0.0 } else { mean(i) }).collect();
        weights.iter().for_each(|&weight| figures.number(weight.into()));
        let cells = if is_interpolated { [width + 1, height + 1] } else { [width, height] };
        let mut buffer = vec![0.0; Picture::buffer(cells[0], cells[1])];
        let picture = if is_interpolated {
            Picture::interpolated(&weights, width, &mut buffer)
        } else {
            Picture::build(&weights, width, region, &mut buffer)
        };
        let picture = picture.expect("the weights are valid");
        figures.packets::<R>(10 * Figures::MOST, |_, lanes| {
            let places: Vec<_> = (0..R::LANES)
                .map(|_| {
                    let mut direction = || random.direction().map(|x| x as f32);
                    let vectors = [direction(), direction(), direction(), direction(), direction(), direction()];
                    let hostile = random.word().is_multiple_of(4);
                    let p = if hostile { generators::nasty(&mut random) } else { vectors[0].map(|x| 2.0 * x) };
                    (p, vectors, [random.unit(), random.unit()])
                })
                .collect();
            let vector = |k: usize| vectors_of::<R>(|i| places[i].1[k]);
            let (p, n): (Vec3<R>, Vec3<R>) = (vectors_of(|i| places[i].0), vector(1));
            let [corner, edge_s, edge_t] = [2, 3, 4].map(vector);
            let us: Vec<_> = places.iter().map(|place| place.2).collect();
            let ws: Vec<_> = places.iter().map(|place| place.1[5]).collect();
            macro_rules! by {
                ($($sampler:expr),+) => {{$({
                    let sampler = $sampler;
                    all(lanes, &sampler, &|u| sampler.draw(u), &us, &ws);
                })+}};
            }
            macro_rules! flat {
                ($light:expr) => {{
                    let shown = picture.on($light);
                    by!(shown.by_area(p), shown.by_solid_angle(p), shown.by_projected_solid_angle(p, n))
                }};
            }
            let radius = R::lit(0.75);
            match name {
                "Triangle" => flat!(Triangle { v0: corner, e1: edge_s, e2: edge_t }),
                "Parallelogram" => flat!(Parallelogram { corner, edge_s, edge_t }),
                "Rectangle" => flat!(Rectangle { corner, edge_s, edge_t: edge_s.cross(edge_t) }),
                "Disk" => flat!(Disk { center: corner, normal: edge_s, radius }),
                _ => by!(picture.on(Sphere { center: corner, radius }).by_visible_area(p)),
            }
        });
    }
}

pub(crate) fn add(list: &mut List<'_>) {
    for (name, region, size) in [
        ("Triangle", Region::Triangle, [8, 8]),
        ("Parallelogram", Region::Square, [13, 7]),
        ("Rectangle", Region::Square, [16, 16]),
        ("Disk", Region::Disk, [9, 12]),
        ("Sphere", Region::Square, [8, 16]),
    ] {
        list.add(format!("light/Picture/{name}"), &Shown(name, region, size, false));
    }
    for (name, size) in [("Parallelogram", [13, 7]), ("Rectangle", [16, 15]), ("Sphere", [8, 16])] {
        list.add(format!("light/Picture/Interpolated{name}"), &Shown(name, Region::Square, size, true));
    }
}
