//! Time per sample of every routine in f32, f32x4, f32x8 and f32x16. `cargo bench -p etendue-benches --bench warps -- "cone"` selects by name.

use criterion::{Criterion, criterion_group, criterion_main};
use etendue::{f32x4, f32x8, f32x16};
use etendue_routines::{Routine, SAMPLES, routines};
use std::time::{Duration, Instant};

/// One iteration is one sample at every width, so that criterion's time is the time per sample.
fn width(criterion: &mut Criterion, routines: Vec<Routine>, width: &str) {
    for mut routine in routines {
        criterion.bench_function(&format!("{}/{width}", routine.name), |bencher| {
            bencher.iter_custom(|iterations| {
                let calls = iterations.div_ceil(SAMPLES as u64);
                let start = Instant::now();
                for _ in 0..calls {
                    (routine.run)();
                }
                start.elapsed().mul_f64(iterations as f64 / (calls * SAMPLES as u64) as f64)
            });
        });
    }
}

fn warps(criterion: &mut Criterion) {
    width(criterion, routines::<f32>(), "f32");
    width(criterion, routines::<f32x4>(), "f32x4");
    width(criterion, routines::<f32x8>(), "f32x8");
    width(criterion, routines::<f32x16>(), "f32x16");
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .sample_size(20);
    targets = warps
}
criterion_main!(benches);
