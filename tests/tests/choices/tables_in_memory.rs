//! Tables that are read from words in memory, at an index of its own in each lane, have the bits of the tables themselves.

use etendue::discrete::{PiecewiseConstant1d, Words1d};
use etendue::light::{EnvironmentMap, EnvironmentWords, ImageEnvironment};
use etendue::{LightSampler, Real, Uint, Vec2, Vec3, f32x8, u32x8};
use etendue_judge::generators::Random;
use etendue_oracle::tier::cases;

/// A table for each lane: its words, where they begin, and its size.
struct Lanes {
    words: Vec<f32>,
    first: u32x8,
    size: [u32x8; 2],
}

impl Lanes {
    fn new(sizes: [[usize; 2]; 8], mut table: impl FnMut([usize; 2]) -> Vec<f32>) -> Self {
        let mut words = Vec::new();
        let first = sizes.map(|size| {
            let first = words.len() as u32;
            words.extend(table(size));
            first
        });
        let size = [0, 1].map(|k| u32x8::from(sizes.map(|size| size[k] as u32)));
        Self { words, first: first.into(), size }
    }
    fn of(&self, lane: usize, length: usize) -> &[f32] {
        &self.words[self.first.lane(lane) as usize..][..length]
    }
}

const SIZES: [[usize; 2]; 8] = [[1, 1], [2, 1], [1, 3], [5, 7], [8, 8], [20, 3], [33, 20], [100, 9]];

fn weights(count: usize, random: &mut Random) -> Vec<f32> {
    let mut all: Vec<f32> =
        (0..count).map(|_| if random.word().is_multiple_of(3) { 0.0 } else { random.unit() }).collect();
    all[count / 2] = 1.0;
    all
}
fn square(random: &mut Random) -> Vec2<f32x8> {
    let mut numbers = || f32x8::from(core::array::from_fn(|_| random.unit()));
    Vec2::new(numbers(), numbers())
}
fn direction(random: &mut Random) -> Vec3<f32x8> {
    let all: [[f64; 3]; 8] = core::array::from_fn(|_| random.direction());
    let [x, y, z] = [0, 1, 2].map(|k| f32x8::from(all.map(|w| w[k] as f32)));
    Vec3::new(x, y, z)
}
fn pair(u: Vec2<f32x8>, lane: usize) -> Vec2<f32> {
    Vec2::new(u.x.lane(lane), u.y.lane(lane))
}
fn three(w: Vec3<f32x8>, lane: usize) -> Vec3<f32> {
    Vec3::new(w.x.lane(lane), w.y.lane(lane), w.z.lane(lane))
}
fn bits(w: Vec3<f32>, pdf: f32) -> [u32; 4] {
    [w.x, w.y, w.z, pdf].map(f32::to_bits)
}

#[test]
fn environments() {
    let mut random = Random::new(2);
    for map in [EnvironmentMap::EqualArea, EnvironmentMap::Equirectangular] {
        let lanes = Lanes::new(SIZES, |[w, h]| {
            let mut buffer = vec![0.0; ImageEnvironment::buffer(w, h)];
            ImageEnvironment::build(&weights(w * h, &mut random), w, map, &mut buffer).unwrap();
            buffer
        });
        let sky = EnvironmentWords { memory: &lanes.words[..], first: lanes.first, size: lanes.size, map };
        for _ in 0..cases(400, 4000) {
            let (u, w) = (square(&mut random), direction(&mut random));
            let (s, hit, inverse) =
                (sky.by_radiance().sample(u), sky.by_radiance().hit(w), sky.by_radiance().invert(w));
            for (lane, [columns, rows]) in SIZES.into_iter().enumerate() {
                let buffer = lanes.of(lane, ImageEnvironment::buffer(columns, rows));
                let own = ImageEnvironment::from_buffer(buffer, columns, map).unwrap().by_radiance();
                let right = own.sample(pair(u, lane));
                assert_eq!(bits(three(s.direction, lane), s.pdf.lane(lane)), bits(right.direction, right.pdf));
                let right = own.hit(three(w, lane));
                assert_eq!(
                    [hit.pdf.lane(lane), hit.uv.x.lane(lane)].map(f32::to_bits),
                    [right.pdf, right.uv.x].map(f32::to_bits)
                );
                let right: Vec2<f32> = own.invert(three(w, lane));
                assert_eq!((inverse.x.lane(lane), inverse.y.lane(lane)), (right.x, right.y));
            }
        }
    }
}

#[test]
fn distributions() {
    let mut random = Random::new(3);
    let sizes = [[2, 1], [2, 2], [3, 1], [19, 24], [37, 5], [5, 9], [9, 2], [181, 1]];
    let values: Vec<Vec<f32>> = sizes.iter().map(|size| weights(size[0] * size[1], &mut random)).collect();
    let tables: Vec<Vec<f32>> = sizes
        .iter()
        .zip(&values)
        .map(|(_, values)| {
            let mut cdf = vec![0.0; values.len()];
            PiecewiseConstant1d::build(values, &mut cdf).unwrap();
            cdf
        })
        .collect();
    let mut next = tables.iter();
    let cdfs = Lanes::new(sizes, |_| next.next().unwrap().clone());
    let count = u32x8::from(sizes.map(|size| (size[0] * size[1]) as u32));
    let line = Words1d { memory: &cdfs.words[..], first: cdfs.first, count };
    for _ in 0..cases(1000, 10_000) {
        let u = square(&mut random).x;
        let cell = line.cell(u);
        for lane in 0..8 {
            let mut same = tables[lane].clone();
            let right = PiecewiseConstant1d::build(&values[lane], &mut same).unwrap().cell(u.lane(lane));
            assert_eq!(
                (cell.index.lane(lane), cell.offset.lane(lane), cell.pmf.lane(lane)),
                (right.index, right.offset, right.pmf)
            );
        }
    }
}
