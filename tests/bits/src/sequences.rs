//! Every sequence: pairs of pixels, samples and dimensions, and the words of the generator.

use crate::figures::{Figures, List, Routine};
use etendue::sequence::{CounterRng, Independent, JointSobol, OwenSobol, Sequence, Stratified, ZOrder};
use etendue::{Real, Uint};
use etendue_judge::generators::{AlongCurve, Random};
use rand_core::{Rng, SeedableRng};

/// A sequence for each number of samples, and its dimensions.
struct Drawn<S, F: Fn(u32) -> S>(F, u32);

impl<S: Sequence, F: Fn(u32) -> S> Routine for Drawn<S, F> {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let mut random = Random::new(900);
        for count in [1, 3, 7, 16, 64, 100, 4096] {
            let sequence = (self.0)(count);
            for dimension in (0..self.1).chain([self.1 - 1; 2]) {
                figures.packets::<R>(4 * Figures::MOST, |_, lanes| {
                    let mut counters = || {
                        let words: Vec<_> = (0..R::LANES)
                            .map(|_| {
                                let word = random.word();
                                let any = word as u32;
                                [any, any % 1024, u32::MAX - any % 16, 1 << (any % 32)].map(|x| [x, any % count])
                                    [(word >> 32) as u32 as usize % 4]
                            })
                            .collect();
                        [0, 1].map(|k| R::Uint::from_fn(|i| words[i][k]))
                    };
                    let [pixel, sample] = counters();
                    lanes.pair::<R>(sequence.pair(pixel, sample, dimension));
                    lanes.pair::<R>(sequence.pair(R::Uint::splat(5), pixel, dimension));
                });
            }
        }
    }
}

/// The generator of random numbers.
struct Generator;

impl Routine for Generator {
    fn run<R: Real>(&self, figures: &mut Figures) {
        let mut generator = CounterRng::seed_from_u64(7);
        (0..100).for_each(|_| figures.number(f64::from(generator.next_u32())));
        (0..100).for_each(|_| figures.number((generator.next_u64() >> 11) as f64));
    }
}

pub(crate) fn add(list: &mut List<'_>) {
    list.add("sequence/Independent", &Drawn(|count| Independent::new(u64::from(count) << 30), 4));
    list.add("sequence/Stratified", &Drawn(|count| Stratified::new(3, count), 4));
    list.add("sequence/OwenSobol", &Drawn(|count| OwenSobol::new(u64::from(count)), 4));
    list.add("sequence/ZOrder", &Drawn(|count| AlongCurve(ZOrder::new(3, count)), 4));
    list.add("sequence/JointSobol", &Drawn(|count| JointSobol::new(u64::from(count)), 8));
    list.add("sequence/CounterRng", &Generator);
}
