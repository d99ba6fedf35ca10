//! Rays of every kind, traced in every way. Criterion's throughput is in rays per second, its time per ray.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use etendue_render::bvh::Scratch;
use etendue_routines::rays::{How, RayKind, Workload};
use std::hint::black_box;
use std::time::{Duration, Instant};

fn rays(criterion: &mut Criterion) {
    for scene in ["quads", "terrain"] {
        let workload = Workload::new(scene, 512);
        for (kind, name) in RayKind::ALL {
            let mut group = criterion.benchmark_group(format!("{scene}, {name}"));
            group.throughput(Throughput::Elements(1));
            let rays = workload.rays(kind);
            for (how, name) in How::ALL {
                let mut stack = Scratch::default();
                group.bench_function(name, |bencher| {
                    bencher.iter_custom(|iterations| {
                        let calls = iterations.div_ceil(rays);
                        let start = Instant::now();
                        for _ in 0..calls {
                            black_box(workload.trace(kind, how, &mut stack));
                        }
                        start.elapsed().mul_f64(iterations as f64 / (calls * rays) as f64)
                    });
                });
            }
            group.finish();
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .sample_size(20);
    targets = rays
}
criterion_main!(benches);
