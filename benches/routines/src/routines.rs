//! Samples, densities and inverses.

use etendue::discrete::PiecewiseConstant2d;
use etendue::light::parts::ProjectedCap;
use etendue::light::{EnvironmentMap, ImageEnvironment, Picture, Region};
use etendue::reflection::Reflection;
use etendue::sequence::{Independent, JointSobol, OwenSobol, Sequence, Stratified, ZOrder, ZOrderIndex};
use etendue::warp::{Bilinear, Cone, GgxVisibleNormals, PatchSurface, Warp};
use etendue::{LightSample, LightSampler, Real, Rectangle, Sphere, Uint, Vec2, Vec3};
use etendue_visible::{Occlusion, Solid};
use std::hint::black_box;

/// Samples per call of [`Routine::run`].
pub const SAMPLES: usize = 1024;

/// Something to be timed.
pub struct Routine {
    /// What, such as `cone sample`.
    pub name: String,
    /// Computes [`SAMPLES`] samples.
    pub run: Box<dyn FnMut()>,
}

/// Lane `i` of packet `k` is pixel or sample 8k + i: the same samples at every width.
fn index<R: Real>(packet: usize) -> R::Uint {
    R::Uint::from_fn(|lane| (packet * R::LANES + lane) as u32)
}

fn squares<R: Real>(dimension: u32) -> Vec<Vec2<R>> {
    let sequence = Independent::new(1);
    (0..SAMPLES / R::LANES).map(|k| sequence.pair(R::Uint::splat(0), index::<R>(k), dimension)).collect()
}

/// Points about the origin to look from, a unit across.
fn viewpoints<R: Real>() -> Vec<Vec3<R>> {
    let half = R::lit(0.5);
    squares::<R>(1).iter().zip(&squares::<R>(2)).map(|(a, b)| Vec3::new(a.x - half, a.y - half, b.x - half)).collect()
}

struct List<R> {
    routines: Vec<Routine>,
    squares: Vec<Vec2<R>>,
    viewpoints: Vec<Vec3<R>>,
}

impl<R: Real + 'static> List<R> {
    fn new() -> Self {
        Self { routines: Vec::new(), squares: squares(0), viewpoints: viewpoints() }
    }
    fn push<A: Copy + 'static, W: Copy + 'static, T>(
        &mut self,
        name: &str,
        with: W,
        arguments: Vec<A>,
        compute: impl Fn(&W, A) -> T + 'static,
    ) {
        let run = move || {
            // a local that nobody has the address of: it may stay in registers
            let with = with;
            for &argument in &arguments {
                black_box(compute(&with, argument));
            }
        };
        self.routines.push(Routine { name: name.to_owned(), run: Box::new(run) });
    }
    /// The three methods of a prepared warp.
    fn warp<W: Warp<R, Point: Copy> + Copy + 'static>(&mut self, name: &str, warp: W) {
        let points: Vec<_> = self.squares.iter().map(|&u| warp.sample(u)).collect();
        self.push(&format!("{name} sample"), warp, self.squares.clone(), |w, u| w.sample(u));
        self.push(&format!("{name} pdf"), warp, points.clone(), |w, p| w.pdf(p));
        self.push(&format!("{name} invert"), warp, points, |w, p| w.invert(p));
    }
    /// Samples each of which waits for the one before: the length of the chain of operations.
    fn chain(&mut self, name: &str, compute: impl Fn(Vec3<R>, Vec2<R>) -> Vec3<R> + 'static) {
        let arguments: Vec<_> = self.viewpoints.iter().copied().zip(self.squares.iter().copied()).collect();
        let run = move || {
            let mut nothing = R::lit(0.0);
            for &(p, u) in &arguments {
                let waiting = Vec3::new(nothing, nothing, nothing);
                let w = black_box(compute(p + waiting, Vec2::new(u.x + nothing, u.y + nothing)));
                // 0, which the compiler does not know
                nothing = (w.x + w.y + w.z) * R::lit(0.0);
            }
        };
        self.routines.push(Routine { name: format!("{name}, in a chain"), run: Box::new(run) });
    }
    /// Samples of one pixel, then one sample each of as many pixels.
    fn sequence(&mut self, name: &str, sequence: impl Sequence + Copy + 'static) {
        let indices: Vec<_> = (0..SAMPLES / R::LANES).map(index::<R>).collect();
        self.push(&format!("sequence {name} pair"), sequence, indices.clone(), |s, i| {
            s.pair::<R>(R::Uint::splat(7), i, 1)
        });
        self.push(&format!("sequence {name} pair, pixels"), sequence, indices, |s, i| {
            s.pair::<R>(i, R::Uint::splat(7), 1)
        });
    }
    /// A light as an integrator calls it: prepared for every sample and once, its pdf and inverse, and with normal and surface coordinates.
    fn light<S: LightSampler<R> + Copy + 'static>(
        &mut self,
        name: &str,
        prepare: impl Fn(Vec3<R>) -> S + Copy + 'static,
    ) {
        // what direct lighting needs; the rest of the sample is not computed
        let used = |s: LightSample<R>| (s.direction, s.distance, s.pdf, s.emits, s.delta);
        self.prepared(&format!("light {name}"), move |p, u| used(prepare(p).sample(u)));
        self.prepared(&format!("light {name}, with normal and uv"), move |p, u| prepare(p).sample(u));
        self.chain(&format!("light {name}"), move |p, u| prepare(p).sample(u).direction);
        // a loaded value, of which the compiler knows nothing
        let sampler = black_box(prepare(black_box(Vec3::lit([0.1, -0.2, 0.3]))));
        let directions: Vec<_> = self.squares.iter().map(|&u| sampler.sample(u).direction).collect();
        self.push(&format!("light {name}, prepared"), sampler, self.squares.clone(), move |s, u| used(s.sample(u)));
        self.push(&format!("light {name}, prepared, pdf"), sampler, directions.clone(), |s, w| s.pdf(w));
        self.push(&format!("light {name}, prepared, invert"), sampler, directions, |s, w| s.invert(w));
    }
    /// Something that is prepared for every sample.
    fn prepared<T>(&mut self, name: &str, compute: impl Fn(Vec3<R>, Vec2<R>) -> T + 'static) {
        let arguments: Vec<_> = self.viewpoints.iter().copied().zip(self.squares.iter().copied()).collect();
        self.push(name, (), arguments, move |(), (p, u)| compute(p, u));
    }
}

/// What remains of a light behind occluders, from the viewpoints.
fn visible_parts<R: Real + 'static>(list: &mut List<R>) {
    let square = |x: f64, y: f64, half: f64| {
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        Solid::quadrilateral(corners.map(|[a, b]| Vec3::new(x + a, y, b)))
    };
    let ball = |x: f64, y: f64, radius: f64| Solid::Sphere { center: Vec3::new(x, y, 0.0), radius };
    let (over, beside) = (square(0.25, 1.25, 0.4), [3.0, 5.0, 7.0].map(|x| square(x, 1.25, 0.4)));
    let (panel, lamp) = (square(0.0, 2.0, 1.0), ball(0.0, 2.0, 0.9));
    let up = Vec3::lit([0.0, 1.0, 0.0]);
    for (name, light, occluders) in [
        ("polygon", &panel, vec![]),
        ("polygon, 1 occluder", &panel, vec![over.clone()]),
        ("polygon, 4 occluders, 1 before it", &panel, [std::slice::from_ref(&over), &beside].concat()),
        ("polygon, 1 sphere", &panel, vec![ball(0.25, 1.25, 0.4)]),
        ("sphere", &lamp, vec![]),
        ("sphere, 1 occluder", &lamp, vec![over]),
    ] {
        let (light, memory) = (light.clone(), std::cell::RefCell::new(Occlusion::<R>::new()));
        list.prepared(&format!("visible {name}"), move |p, _| {
            memory.borrow_mut().visible(p, black_box(up), &light, &occluders)
        });
    }
}

/// The corners of polygons that are timed, of those that a host's have.
const fn five(_: usize) -> usize {
    5
}
/// A light by a technique.
macro_rules! one_light {
    ($list:ident, $up:ident, $glossy:ident, $light:ident, $name:ident, $by:ident $place:tt) => {
        let name = stringify!($name).replace("polygon", "pentagon").replace("patch", "bilinear patch");
        $list.light(&name.replace('_', " "), move |p| {
            let _ = p;
            etendue::prepared!($light, $by $place, p: p, n: $up, reflection: &$glossy)
        });
    };
}
macro_rules! all_lights {
    ({ $list:ident, $up:ident, $glossy:ident } $(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident $fields:tt by $default:literal {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {$(
        // loaded, so that nothing of the preparation is moved out of a loop
        let light: etendue::light::$light<R $(, { five($corners) })?> = black_box(etendue::example!($light $fields));
        $(one_light!($list, $up, $glossy, light, $name, $by $place);)+
    )+};
}

/// The warps without parameters.
macro_rules! fixed_warps {
    ({ $list:ident } $($(#[$doc:meta])* $warp:ident $([$r:tt] = $struct:ident)?, $name:ident: $coordinates:literal;)+) => {$(
        fixed_warps!(@ $list, $warp, $name $(, $r)?);
    )+};
    (@ $list:ident, $warp:ident, $name:ident) => {
        $list.warp(&stringify!($name).replace('_', " ").replace("low ", "low-"), etendue::warp::$warp);
    };
    (@ $list:ident, $warp:ident, $name:ident, $r:tt) => {};
}

/// Tables of 64 × 32 cells, and pictures, which a process builds once.
fn tables<R: Real + 'static>() -> Vec<Routine> {
    let mut list = List::<R>::new();
    let weights: Vec<f32> = (0..2048).map(|i| 1.0 + (i * 37 % 101) as f32).collect();
    let buffer = |n: usize| -> &'static mut [f32] { Vec::leak(vec![0.0; n]) };
    let table = PiecewiseConstant2d::build(&weights, 64, buffer(PiecewiseConstant2d::buffer(64, 32)));
    list.warp("table 64x32", table.expect("weights are positive"));
    let sky = buffer(ImageEnvironment::buffer(64, 32));
    let sky = ImageEnvironment::build(&weights, 64, EnvironmentMap::Equirectangular, sky);
    list.warp("image environment 64x32", sky.expect("weights are positive"));
    // beside it, to be compared: `light rectangle by solid angle`, which has no picture
    for side in [16, 128, 1024] {
        let weights: Vec<f32> =
            (0..side * side).map(|i| (i * 37 % 101) as f32 * ((i / side * 53) % 97) as f32).collect();
        let buffer = buffer(Picture::buffer(side, side));
        let picture = Picture::build(&weights, side, Region::Square, buffer).expect("weights are positive");
        // near is at the distance of its size, far at 25 times that
        for (name, at) in [("", 2.0), (", far", 50.0)] {
            let edge = |v: [f64; 3]| black_box(Vec3::<R>::lit(v));
            let screen = Rectangle::new(edge([-1.0, at, -1.0]), edge([2.0, 0.0, 0.0]), edge([0.0, 0.0, 2.0]));
            let up = edge([0.0, 1.0, 0.0]);
            let name = move |by: &str| format!("picture {side}x{side} {by}{name}");
            list.prepared(&name("by area"), move |p, u| picture.on(screen).by_area(p).draw(u));
            list.prepared(&name("by solid angle"), move |p, u| picture.on(screen).by_solid_angle(p).draw(u));
            list.prepared(&name("by projected solid angle"), move |p, u| {
                picture.on(screen).by_projected_solid_angle(p, up).draw(u)
            });
        }
        let globe = Sphere::new(Vec3::lit([0.0, 2.0, 0.0]), R::lit(0.7));
        list.prepared(&format!("picture {side}x{side} on a sphere"), move |p, u| {
            picture.on(globe).by_visible_area(p).draw(u)
        });
    }
    list.routines
}

/// Everything, at one width. It is generic, so that only what measures it has to compile it.
#[must_use]
pub fn routines<R: Real + 'static>() -> Vec<Routine> {
    let mut all = without_tables::<R>();
    all.extend(tables::<R>());
    all
}

/// Everything but tables, whose construction in double precision takes an instruction that Valgrind 3.19 does not know.
#[must_use]
pub fn without_tables<R: Real + 'static>() -> Vec<Routine> {
    let mut list = List::<R>::new();
    let vector = |v: [f64; 3]| Vec3::<R>::new(R::lit(v[0]), R::lit(v[1]), R::lit(v[2]));

    etendue::warps!(fixed_warps! { { list } });
    list.warp("cone", Cone { one_minus_cos: R::lit(0.1) });
    list.warp("bilinear", Bilinear { corners: [1.0, 2.0, 0.5, 4.0].map(R::lit) });
    list.warp("GGX visible normals", GgxVisibleNormals::new(R::lit(0.4), R::lit(0.2), vector([0.6, 0.0, 0.8])));

    let a = vector([-1.0, 2.0, -0.5]);
    list.warp("projected cap, cut", ProjectedCap::new(a, R::lit(0.7), vector([0.8, 0.6, 0.0])));
    list.warp("projected cap, lune", ProjectedCap::new(a, R::lit(0.7), vector([0.96, 0.28, 0.0])));
    let [edge_s, edge_t, diagonal] = black_box([[2.0, 0.5, 0.0], [-0.25, 1.0, 1.5], [1.75, 1.8, 1.5]].map(vector));
    list.warp("patch surface", PatchSurface { corner: a, edge_s, edge_t, diagonal });

    let up = vector([0.0, 1.0, 0.0]);
    let glossy = Reflection::new(R::lit(0.3), up, vector([0.6, 0.8, 0.0]));
    etendue::techniques!(all_lights! { { list, up, glossy } });

    visible_parts(&mut list);

    list.sequence("independent", Independent::new(1));
    list.sequence("stratified", Stratified::new(1, 64));
    list.sequence("owen sobol", OwenSobol::new(1));
    list.sequence("joint sobol", JointSobol::new(1));
    let z_order = ZOrder::new(1, 64);
    let indices: Vec<_> = (0..SAMPLES / R::LANES).map(index::<R>).collect();
    list.push("sequence z-order pair", z_order, indices.clone(), |s, i| {
        s.pair::<R>(ZOrderIndex::from_position(R::Uint::splat(7)), i, 1)
    });
    list.push("sequence z-order pair, pixels", z_order, indices, |s, i| {
        s.pair::<R>(ZOrderIndex::from_position(i), R::Uint::splat(7), 1)
    });
    list.routines
}
