//! Every public sampler, without std, alloc or libc (Linux, x86-64). The exit code is the number of samplers if all of them keep their
//! contract, or 100 + k if sampler k, counted from 0, breaks it; 251 to 254 mean that a table was not built, 255 means a panic.
#![no_std]
#![no_main]

mod start;

use core::f32::consts::PI;
use etendue::discrete::{PiecewiseConstant1d, PiecewiseConstant2d};
use etendue::estimate::{Heuristic, Welford};
use etendue::light::{
    BilinearPatch, ConstantEnvironment, DirectionalLight, Disk, EnvironmentMap, ImageEnvironment, Line, PointLight,
    Polygon, SpotLight, Sun,
};
use etendue::reflection::Reflection;
use etendue::select::{LightBound, LightChoice, LightTree, Node8, SpatialLights, UniformLights};
use etendue::sequence::{CounterRng, Independent, JointSobol, OwenSobol, Sequence, Stratified, ZOrder, ZOrderIndex};
use etendue::warp::{
    AreaTriangle, Bilinear, ConcentricDisk, Cone, CosineHemisphere, GgxVisibleNormals, LowDistortionTriangle,
    Octahedral, PatchSurface, UniformHemisphere, UniformSphere,
};
use etendue::{
    LightSample, LightSampler, Mask, Parallelogram, Real, Rectangle, Sphere, Triangle, Vec2, Vec3, Warp, f32x8, u32x8,
};
use rand_core::{Rng, SeedableRng};
use start::exit;

type X = f32x8;
const SAMPLES: u32 = 1 << 12;
const ORIGIN: [f32; 3] = [0.0; 3];
const UP: [f32; 3] = [0.0, 1.0, 0.0];

fn lit(x: f32) -> X {
    X::splat(x)
}
fn sum(x: X) -> f32 {
    (0..8).map(|i| x.lane(i)).sum()
}
fn squares() -> impl Iterator<Item = Vec2<X>> {
    let strata = Stratified::new(1, SAMPLES);
    (0..SAMPLES).step_by(8).map(move |start| {
        let index = u32x8::from(core::array::from_fn(|lane| start + lane as u32));
        strata.pair(u32x8::splat(0), index, 0)
    })
}
fn near(a: f32, b: f32, relative: f32) -> bool {
    (a - b).abs() <= relative * b
}

/// The number of samplers that kept their contract so far.
struct Count(u32);

impl Count {
    fn check(&mut self, kept: bool) {
        if !kept {
            // 100 + the index of the sampler
            exit(100 + self.0);
        }
        self.0 += 1;
    }
    /// Checks sample, pdf and inverse: they are closed, and the mean of 1/pdf is the `measure` of the whole.
    fn warp<W: Warp<X, Point: Copy>>(&mut self, warp: W, measure: f32) {
        let (mut far, mut inverse) = (0.0_f32, lit(0.0));
        for u in squares() {
            let p = warp.sample(u);
            let v = warp.invert(p);
            let d = Vec2::new(u.x - v.x, u.y - v.y);
            // an azimuth may come back one turn off
            let off = |d: X| (0..8).map(|i| d.lane(i).abs()).fold(0.0_f32, |m, d| m.max(d.min(1.0 - d)));
            far = far.max(off(d.x)).max(off(d.y));
            inverse += lit(1.0) / warp.pdf(p);
        }
        self.check(far < 1e-3 && near(sum(inverse) / SAMPLES as f32, measure, 2e-2));
    }
    fn line(&mut self, table: PiecewiseConstant1d<'_>) {
        let kept = squares().all(|u| {
            let x = table.sample(u.x);
            let back = table.invert(x) - u.x;
            (0..8).all(|i| back.lane(i).abs() < 1e-4) && table.pdf(x).gt(lit(0.0)).all()
        });
        self.check(kept);
    }
    /// Checks the irradiance from radiance 1 on a receiver that faces up.
    fn light(&mut self, truth: f32, sample: impl Fn(Vec2<X>) -> LightSample<X>) {
        let mut total = lit(0.0);
        for u in squares() {
            let s = sample(u);
            let counts = s.emits & s.pdf.gt(lit(0.0)) & s.direction.y.gt(lit(0.0));
            total += (s.direction.y / s.pdf).keep(counts);
        }
        self.check(near(sum(total) / SAMPLES as f32, truth, 1e-2));
    }
    /// Checks that the mean of x·y over a sequence is 1/4.
    fn sequence(&mut self, sequence: impl Sequence) {
        self.pairs(|index| sequence.pair(u32x8::splat(3), index, 1));
    }
    fn pairs(&mut self, pair: impl Fn(u32x8) -> Vec2<X>) {
        let mut total = lit(0.0);
        for start in (0..SAMPLES).step_by(8) {
            let u = pair(u32x8::from(core::array::from_fn(|lane| start + lane as u32)));
            total += u.x * u.y;
        }
        self.check(near(sum(total) / SAMPLES as f32, 0.25, 5e-2));
    }
}

fn warps(count: &mut Count) {
    count.warp(ConcentricDisk, PI);
    count.warp(UniformHemisphere, 2.0 * PI);
    count.warp(UniformSphere, 4.0 * PI);
    count.warp(Octahedral, 4.0 * PI);
    count.warp(CosineHemisphere, 2.0 * PI);
    count.warp(Cone { one_minus_cos: lit(0.25) }, 0.5 * PI);
    count.warp(AreaTriangle, 0.5);
    count.warp(LowDistortionTriangle, 0.5);
    count.warp(Bilinear { corners: [1.0, 2.0, 3.0, 4.0].map(lit) }, 1.0);
    // the hemisphere, minus the normals that face away from the view
    count.warp(GgxVisibleNormals::new(lit(1.0), lit(1.0), [0.0, 0.6, 0.8].into()), 2.0 * (PI - 0.643_501_1));
}

fn surfaces(count: &mut Count) {
    let (corner, edge_s, edge_t) = ([0.0, 2.0, 0.0].into(), [1.0, 0.0, 0.0].into(), [0.0, 0.0, 1.0].into());
    // a trapezium
    count.warp(PatchSurface { corner, edge_s, edge_t, diagonal: [0.5, 0.0, 1.0].into() }, 0.75);
}

fn tables(count: &mut Count) {
    let weights = [1.0, 2.0, 0.5, 4.0, 1.0, 1.5];
    let (mut cdf, mut buffer) = ([0.0; 6], [0.0; 8]);
    match PiecewiseConstant1d::build(&weights, &mut cdf) {
        Ok(table) => count.line(table),
        Err(_) => exit(251),
    }
    match PiecewiseConstant2d::build(&weights, 3, &mut buffer) {
        Ok(table) => count.warp(table, 1.0),
        Err(_) => exit(252),
    }
    let lights =
        [1.0, 2.0].map(|x| LightBound { center: [x, 1.0, 0.0], radius: 0.5, power: x, ..LightBound::default() });
    let Ok(power) = PiecewiseConstant1d::build(&weights, &mut cdf) else { exit(252) };
    let Ok(spatial) = SpatialLights::new(&lights) else { exit(251) };
    let (mut nodes, mut places) = ([Node8::default(); LightTree::nodes_for(2)], [0; 2]);
    let Ok(tree) = LightTree::build(&lights, &mut nodes, &mut places) else { exit(251) };
    let mut means = [lit(0.0); 4];
    let up = [0.0, 1.0, 0.0];
    for u in squares() {
        means[0] += lit(1.0) / UniformLights { count: 6 }.choose(u.x).pmf;
        means[1] += lit(1.0) / power.choose(u.x).pmf;
        means[2] += lit(1.0) / spatial.at(ORIGIN.into(), up.into()).choose(u.x).pmf;
        means[3] += lit(1.0) / tree.at(ORIGIN.into(), up.into()).choose(u.x).pmf;
    }
    for (mean, truth) in means.into_iter().zip([6.0, 6.0, 2.0, 2.0]) {
        count.check(near(sum(mean) / SAMPLES as f32, truth, 1e-2));
    }
}

/// A light above the origin, and its irradiance there on a receiver that faces up, from radiance, intensity or irradiance 1.
trait Known {
    const IRRADIANCE: f32;
    fn known() -> Self;
}
macro_rules! known {
    ($($light:ident $(<$n:literal>)?: $irradiance:expr, $value:expr;)+) => {$(
        impl Known for $light<X $(, $n)?> {
            const IRRADIANCE: f32 = $irradiance;
            fn known() -> Self {
                $value
            }
        }
    )+};
}
// Lambert's formula for a square of side 1 at distance 1
const SQUARE: f32 = 0.752_274_7;
fn sides() -> [Vec3<X>; 3] {
    [[-0.5, 1.0, -0.5], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::from)
}
known! {
    // E = π R²/d²
    Sphere: 0.25 * PI, Self { center: [0.0, 2.0, 0.0].into(), radius: lit(1.0) };
    Triangle: 0.5 * SQUARE, { let [p, u, v] = sides(); Self { v0: p, e1: u, e2: v } };
    Parallelogram: SQUARE, { let [p, u, v] = sides(); Self::new(p, u, v) };
    Rectangle: SQUARE, { let [p, u, v] = sides(); Self::new(p, u, v) };
    // E = π r²/(h² + r²); the normal points down because the disk is one-sided
    Disk: 0.5 * PI, Self { center: [0.0, 1.0, 0.0].into(), normal: [0.0, -1.0, 0.0].into(), radius: lit(1.0) };
    Polygon<4>: SQUARE, { let [p, u, v] = sides(); Self { corners: [p, p + u, p + u + v, p + v] } };
    BilinearPatch: SQUARE, { let [p, u, v] = sides(); Self::new(p, u, v, u + v) };
    // per unit of width
    Line: 0.431_823_8, Self { start: [-1.0, 2.0, 0.0].into(), edge: [2.0, 0.0, 0.0].into() };
    Sun: 0.25 * PI, Self { direction: UP.into(), one_minus_cos: lit(0.133_974_6) };
    // E = I/d²
    PointLight: 0.25, Self { position: [0.0, 2.0, 0.0].into() };
    SpotLight: 0.25, Self { position: [0.0, 2.0, 0.0].into(), axis: [0.0, -1.0, 0.0].into(), one_minus_cos_inner: lit(0.1), one_minus_cos_outer: lit(0.2) };
    DirectionalLight: 1.0, Self { direction: UP.into() };
}
fn irradiance<L: Known>(_: &L) -> f32 {
    L::IRRADIANCE
}
macro_rules! all_lights {
    ({ $count:ident } $(
        $(#[$light_doc:meta])* $light:ident $([$corners:literal])? = $light_c:ident, $columns_c:ident { $($fields:tt)* } by $default:literal {
            $(
                $(#[$doc:meta])* $technique:ident, $name:ident -> $sampler:ident $([$n:literal])? $(= $sampler_c:ident[$size:literal])?: $by:ident $place:tt $($measure:ident)?;
            )+
        }
    )+) => {$(
        let light = $light::known();
        $($count.light(irradiance(&light), |u| {
            // a matt surface
            let reflection = Reflection::new(lit(1.0), UP.into(), UP.into());
            let _ = &reflection;
            etendue::prepared!(light, $by $place, p: ORIGIN.into(), n: UP.into(), reflection: &reflection).sample(u)
        });)+
    )+};
}

fn lights(count: &mut Count) {
    etendue::techniques!(all_lights! { { count } });
    count.light(PI, |u| ConstantEnvironment.by_solid_angle().sample(u));
    count.light(PI, |u| ConstantEnvironment.by_projected_solid_angle(UP.into()).sample(u));
    let mut buffer = [0.0; ImageEnvironment::buffer(4, 2)];
    let weights = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    match ImageEnvironment::build(&weights, 4, EnvironmentMap::Equirectangular, &mut buffer) {
        Ok(sky) => count.warp(sky, 4.0 * PI),
        Err(_) => exit(254),
    }
}

fn sequences(count: &mut Count) {
    count.sequence(Independent::new(1));
    count.sequence(Stratified::new(1, SAMPLES));
    count.sequence(OwenSobol::new(1));
    count.sequence(JointSobol::new(1));
    let z_order = ZOrder::new(1, SAMPLES);
    count.pairs(|index| z_order.pair(ZOrderIndex::new(u32x8::splat(3), u32x8::splat(5)), index, 1));
    let mut rng = CounterRng::seed_from_u64(7);
    let mut total = lit(0.0);
    for _ in 0..SAMPLES / 8 {
        let mut unit = || X::unit(u32x8::from(core::array::from_fn(|_| rng.next_u32())));
        total += unit() * unit();
    }
    count.check(near(sum(total) / SAMPLES as f32, 0.25, 5e-2));
}

fn estimators(count: &mut Count) {
    let [a, b] = Heuristic::Balance.weights([lit(1.0), lit(3.0)]);
    count.check(sum(a) == 2.0 && sum(b) == 6.0);
    let mut welford = Welford::default();
    squares().for_each(|u| welford.push(u.x));
    // each lane has the samples of one column of strata: mean 1/2, variance 1/12
    count.check(near(sum(welford.mean()) / 8.0, 0.5, 1e-2) && near(sum(welford.variance()) / 8.0, 1.0 / 12.0, 5e-2));
}

extern "C" fn main() -> ! {
    let mut count = Count(0);
    warps(&mut count);
    surfaces(&mut count);
    tables(&mut count);
    lights(&mut count);
    sequences(&mut count);
    estimators(&mut count);
    // all checks pass: a code that no accident gives
    exit(42)
}
