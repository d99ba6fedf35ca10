//! Every entry point with the instructions of every level: nanoseconds per element, and a hash of the results, which must not depend on
//! the level. `cargo bench -p etendue-batch --features dispatch` prints the table; words after `--` select rows.
//!
//! The columns are the levels of this library, at batches of 1, 64 and 4,096, and the core with the instructions of the build, at 4,096.
//! For the best that a build for one processor gives, compile for it: `CARGO_ENCODED_RUSTFLAGS=-Ctarget-cpu=x86-64-v4 cargo bench …`.

mod every;

use etendue::real::SAME_BITS;
use etendue::sequence::{Independent, Sequence};
use etendue::{LightSampler, Real, Vec2, Vec3, f32x8, f32x16};
use etendue_batch::*;
use every::Visitor;
use std::hint::black_box;
use std::time::Instant;

const N: usize = 4096;
const SIZES: [usize; 3] = [1, 64, N];
const LEVELS: [Level; 3] = [Level::Build, Level::V3, Level::V4];

/// Columns of random numbers in [0, 1).
struct Inputs {
    columns: Vec<Vec<f32>>,
}

impl Inputs {
    fn new() -> Self {
        let column = |k: u32| {
            let pair = |i: usize| Independent::new(7).pair::<f32>(k, i as u32, 0).x;
            (0..N).map(pair).collect()
        };
        Self { columns: (0..32).map(column).collect() }
    }
    fn column(&self, k: usize, n: usize) -> &[f32] {
        &self.columns[k % 32][..n]
    }
    fn vector(&self, k: usize, n: usize) -> Vec3<&[f32]> {
        Vec3::new(self.column(k, n), self.column(k + 1, n), self.column(k + 2, n))
    }
}

/// Where the results of an entry point go.
struct Results {
    columns: [Vec<f32>; 6],
}

impl Results {
    fn samples(&mut self, n: usize) -> Samples<'_> {
        let [x, y, z, distance, pdf, weight] = self.columns.each_mut().map(|column| &mut column[..n]);
        Samples { direction: [x, y, z], distance, pdf, weight, ..Samples::default() }
    }
    fn three(&mut self, n: usize) -> [&mut [f32]; 3] {
        let [x, y, z, ..] = self.columns.each_mut().map(|column| &mut column[..n]);
        [x, y, z]
    }
    /// FNV-1a of the bits.
    fn hash(&self, n: usize) -> u64 {
        let bits = self.columns.iter().flat_map(|column| &column[..n]).map(|x| u64::from(x.to_bits()));
        bits.fold(0xcbf2_9ce4_8422_2325, |hash, bits| (hash ^ bits).wrapping_mul(0x0100_0000_01b3))
    }
}

/// The least time of several runs, in nanoseconds per element.
fn time(n: usize, mut run: impl FnMut()) -> f64 {
    let repeat = (8192 / n).max(1);
    let mut least = f64::INFINITY;
    for _ in 0..24 {
        let start = Instant::now();
        for _ in 0..repeat {
            run();
        }
        least = least.min(start.elapsed().as_secs_f64());
    }
    least * 1e9 / (n * repeat) as f64
}

struct Bench {
    only: Vec<String>,
    results: Results,
    differ: usize,
}

impl Bench {
    /// One row: `batch` runs an entry point over n elements; `core` does the same with the core alone, where that is compared.
    fn row(&mut self, name: &str, batch: impl Fn(Batch, usize, &mut Results), core: Option<&dyn Fn(&mut Results)>) {
        if !self.only.iter().all(|word| name.contains(word.as_str())) {
            return;
        }
        print!("{name:45}");
        let mut hashes = Vec::new();
        for level in LEVELS {
            let Some(routines) = Batch::at(level) else {
                print!(" {:>27}", "-");
                continue;
            };
            for n in SIZES {
                let ns = time(n, || batch(black_box(routines), n, &mut self.results));
                print!(" {ns:8.2}");
            }
            self.results.columns.iter_mut().for_each(|column| column.fill(0.0));
            batch(routines, N, &mut self.results);
            hashes.push(self.results.hash(N));
        }
        if let Some(core) = core {
            print!(" {:8.2}", time(N, || core(&mut self.results)));
            self.results.columns.iter_mut().for_each(|column| column.fill(0.0));
            core(&mut self.results);
            hashes.push(self.results.hash(N));
        } else {
            print!(" {:>8}", "");
        }
        // without the feature `same-bits`, levels may round a product and a sum differently
        let same = !SAME_BITS || hashes.iter().all(|hash| *hash == hashes[0]);
        self.differ += usize::from(!same);
        println!(" {:016x}{}", hashes[0], if same { "" } else { "  DIFFERS" });
    }
}

impl Visitor for Bench {
    fn technique<T: Technique>(&mut self, name: &str, light: T::Light<f32>, with: T::With<f32>) {
        let input = &Inputs::new();
        let sampler = Batch::new().prepare::<T>(&light, Vec3::new(0.1, 0.2, 0.3), with);
        let u = |n| Vec2::new(input.column(0, n), input.column(1, n));
        let core: &dyn Fn(&mut Results) = if cfg!(target_feature = "avx512f") {
            &|out| by_core::<T::Prepared, f32x16>(&sampler, u(N), out)
        } else {
            &|out| by_core::<T::Prepared, f32x8>(&sampler, u(N), out)
        };
        self.row(&format!("{name}, sample"), |b, n, out| b.sample(&sampler, u(n), out.samples(n)), Some(core));
        let lights = |n| {
            let mut k = 8;
            T::map_light(light, |_| {
                k += 1;
                input.column(k, n)
            })
        };
        let withs = |n| {
            let mut k = 4;
            T::map_with(with, |_| {
                k += 1;
                input.column(k, n)
            })
        };
        self.row(
            &format!("{name}, sample each"),
            |b, n, out| b.sample_each::<T>(lights(n), input.vector(2, n), withs(n), u(n), out.samples(n)),
            None,
        );
        let pdf_each = |b: Batch, n: usize, out: &mut Results| {
            let w = input.vector(5, n);
            let out = Evaluations { pdf: &mut out.columns[0][..n], ..Evaluations::default() };
            b.evaluate_each::<T>(lights(n), input.vector(2, n), withs(n), w, out);
        };
        self.row(&format!("{name}, pdf each"), pdf_each, None);
        let mut drawn = Results { columns: core::array::from_fn(|_| vec![0.0; N]) };
        Batch::new().sample(&sampler, u(N), drawn.samples(N));
        let directions = |n: usize| Vec3::new(&drawn.columns[0][..n], &drawn.columns[1][..n], &drawn.columns[2][..n]);
        let pdf = |b: Batch, n: usize, out: &mut Results| b.pdf(&sampler, directions(n), &mut out.columns[0][..n]);
        self.row(&format!("{name}, pdf"), pdf, None);
        let invert = |b: Batch, n, out: &mut Results| {
            let [x, y, _] = out.three(n);
            b.invert(&sampler, directions(n), Vec2::new(x, y));
        };
        self.row(&format!("{name}, invert"), invert, None);
        self.row(&format!("{name}, hit"), |b, n, out| b.hit(&sampler, directions(n), out.samples(n)), None);
    }

    fn warp<W: BatchWarp>(&mut self, name: &str, warp: W) {
        let input = &Inputs::new();
        let u = |n| [input.column(0, n), input.column(1, n)];
        self.row(&format!("{name}, sample"), |b, n, out| b.warp(&warp, u(n), out.three(n)), None);
        let mut drawn = Results { columns: core::array::from_fn(|_| vec![0.0; N]) };
        Batch::new().warp(&warp, u(N), drawn.three(N));
        let points = |n: usize| [0, 1, 2].map(|k| &drawn.columns[k][..n]);
        let pdf = |b: Batch, n: usize, out: &mut Results| b.warp_pdf(&warp, points(n), &mut out.columns[0][..n]);
        self.row(&format!("{name}, pdf"), pdf, None);
        let invert = |b: Batch, n, out: &mut Results| {
            let [x, y, _] = out.three(n);
            b.warp_invert(&warp, points(n), [x, y]);
        };
        self.row(&format!("{name}, invert"), invert, None);
    }

    fn sequence<S: BatchSequence>(&mut self, name: &str, sequence: S) {
        let pairs = |b: Batch, n, out: &mut Results| {
            let [x, y, _] = out.three(n);
            b.pairs(&sequence, Counters { pixel: 3, dimension: 1, ..Counters::default() }, Vec2::new(x, y));
        };
        self.row(&format!("{name}, pairs"), pairs, None);
    }
}

/// The same samples by the core, with the instructions of this build.
#[inline(never)]
fn by_core<P: Prepared, R: Real<Scalar = f32>>(sampler: &P, u: Vec2<&[f32]>, out: &mut Results) {
    sampler.over::<R, _>(|sampler| {
        for at in (0..N).step_by(R::LANES) {
            let s = sampler.sample(u.map(|column| R::from_fn(|lane| column[at + lane])));
            let values = [s.direction.x, s.direction.y, s.direction.z, s.distance, s.pdf, s.weight()];
            for (column, value) in out.columns.iter_mut().zip(values) {
                let column = &mut column[at..at + R::LANES];
                for (lane, x) in column.iter_mut().enumerate() {
                    *x = value.lane(lane);
                }
            }
        }
    });
}

fn main() {
    let only = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let results = Results { columns: core::array::from_fn(|_| vec![0.0; N]) };
    let mut bench = Bench { only, results, differ: 0 };
    println!("{:45} {:>26} {:>26} {:>26} {:>8} hash", "ns per element", "build: 1, 64, 4096", "v3", "v4", "core");
    every::visit(&mut bench);
    assert!(bench.differ == 0, "{} entry points differ between levels", bench.differ);
}
