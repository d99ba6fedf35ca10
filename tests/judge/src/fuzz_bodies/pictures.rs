//! Lights with pictures.

use super::Input;
use crate::packets::{squares_of, vectors_of};
use crate::properties;
use etendue::light::{Picture, Region, TexelSample};
use etendue::{Disk, LightSampler, Parallelogram, Real, Sphere, Triangle, Vec2, f32x8};

/// Takes a sampler, and its method that returns the texel, too.
type Visitor<'a, R> = dyn FnMut(&dyn LightSampler<R>, &dyn Fn(Vec2<R>) -> TexelSample<R>) + 'a;

/// What is tested of a light: its numbers, in the words of the light.
#[derive(Debug)]
struct Shown {
    kind: u8,
    weights: Vec<f32>,
    size: [usize; 2],
    /// Corner or centre, edges, shading point, normal.
    vectors: Vec<[f32; 3]>,
    radius: f32,
}

impl Shown {
    fn region(&self) -> Region {
        match self.kind % 4 {
            0 => Region::Triangle,
            1 => Region::Disk,
            _ => Region::Square,
        }
    }
    fn is_interpolated(&self) -> bool {
        self.kind >= 4 && self.region() == Region::Square
    }
    /// Whether a texel has radiance, or one at the corners of a cell between texels.
    fn radiates(&self, x: usize, y: usize) -> bool {
        let [width, height] = self.size;
        let weight = |x: usize, y: usize| self.weights[y.min(height - 1) * width + x.min(width - 1)];
        let [left, top] = if self.is_interpolated() { [x, y].map(|i| i.saturating_sub(1)) } else { [x, y] };
        [(left, top), (x, top), (left, y), (x, y)].into_iter().any(|(x, y)| weight(x, y) > 0.0)
    }
    /// Calls `take` with the light by each measure.
    fn each<R: Real>(&self, picture: Picture<'_>, take: &mut Visitor<'_, R>) {
        let [corner, edge_s, edge_t, p, n] = [0, 1, 2, 3, 4].map(|k| vectors_of::<R>(|_| self.vectors[k]));
        let radius = R::lit(f64::from(self.radius));
        macro_rules! by {
            ($($sampler:expr),+) => {{$({
                let sampler = $sampler;
                take(&sampler, &|u| sampler.draw(u));
            })+}};
        }
        macro_rules! flat {
            ($light:expr) => {{
                let shown = picture.on($light);
                by!(shown.by_area(p), shown.by_solid_angle(p), shown.by_projected_solid_angle(p, n))
            }};
        }
        match self.kind % 4 {
            0 => flat!(Triangle { v0: corner, e1: edge_s, e2: edge_t }),
            1 => flat!(Disk { center: corner, normal: n, radius }),
            2 => flat!(Parallelogram { corner, edge_s, edge_t }),
            _ => by!(picture.on(Sphere { center: corner, radius }).by_visible_area(p)),
        }
    }
}

/// Any picture on any light: texels that are drawn have radiance, results are finite, and lanes agree with scalars.
pub(super) fn pictures(input: &mut Input<'_>) {
    let kind = input.below(8);
    let weights = input.weights(40);
    let width = 1 + input.below(weights.len() as u8) as usize;
    let height = weights.len() / width;
    let weights = weights[..width * height].to_vec();
    let mut vectors = Vec::new();
    for _ in 0..4 {
        let next = input.vector(&vectors);
        vectors.push(next);
    }
    vectors.push(input.direction());
    let shown = Shown { kind, weights, size: [width, height], vectors, radius: input.number() };
    let cells = if shown.is_interpolated() { [width + 1, height + 1] } else { [width, height] };
    let mut buffer = vec![0.0; Picture::buffer(cells[0], cells[1])];
    let built = if shown.is_interpolated() {
        Picture::interpolated(&shown.weights, width, &mut buffer)
    } else {
        Picture::build(&shown.weights, width, shown.region(), &mut buffer)
    };
    let Ok(picture) = built else {
        let lit = |i: usize| shown.weights[i] > 0.0 && shown.region().part([i % width, i / width], shown.size) > 0.0;
        assert!(!(0..width * height).any(lit), "{shown:?}: {built:?}");
        return;
    };
    let us: Vec<_> = (0..3).map(|_| input.square()).collect();
    let any = input.direction();
    let mut eights = Vec::new();
    shown.each::<f32x8>(picture, &mut |light, draw| {
        let s = draw(squares_of(&us));
        let hit = light.hit(vectors_of(|_| any));
        eights.push((s.x.to_array()[1], s.light.pdf.lane(1), hit.pdf.lane(5)));
    });
    let mut measure = 0;
    shown.each::<f32>(picture, &mut |light, draw| {
        for (k, &u) in us.iter().enumerate() {
            let s = draw(squares_of(&[u]));
            let (x, y) = (s.x as usize, s.y as usize);
            assert!(x < cells[0] && y < cells[1], "{shown:?} at {u:?}: {s:?}");
            assert!(shown.radiates(x, y), "{shown:?} at {u:?}: a dark texel, {s:?}");
            properties::total_at(&shown, [0.0, 1.0 + 1e-5], light, u);
            let pdf = s.light.pdf;
            if k == 1 {
                assert_eq!((eights[measure].0, eights[measure].1), (s.x, pdf), "{shown:?} at {u:?}");
            }
        }
        let hit = light.hit(vectors_of(|_| any));
        assert!(hit.pdf >= 0.0 && hit.pdf.is_finite() && hit.distance.is_finite(), "{shown:?} along {any:?}: {hit:?}");
        assert_eq!(eights[measure].2, hit.pdf, "{shown:?} along {any:?}");
        measure += 1;
    });
}
