//! Points that a host computes on a light: through rounding, half of them are in front of it.

use etendue::lights::{Emitter, Lights, Receiver, Side};
use etendue::{
    BilinearPatch, DirectionalLight, Disk, Frame, LightSampler, Line, Mask, Parallelogram, PointLight, Polygon, Real,
    Rectangle, Sphere, SpotLight, Sun, Triangle, Vec2, Vec3,
};
use etendue_judge::generators::Random;
use etendue_oracle::tier::cases;

type V<R> = Vec3<R>;

/// Numbers of a precision.
struct Numbers {
    random: Random,
    /// The greatest coordinate of a scene, and where it is.
    size: f64,
    shift: [f64; 3],
}

impl Numbers {
    fn unit<R: Real>(&mut self) -> R {
        R::lit(self.random.unit_f64())
    }
    fn signed<R: Real>(&mut self) -> R {
        R::lit(2.0 * self.random.unit_f64() - 1.0)
    }
    fn vector<R: Real>(&mut self) -> V<R> {
        V::new(self.signed(), self.signed(), self.signed())
    }
    fn point<R: Real>(&mut self) -> V<R> {
        V::lit(self.shift) + self.vector() * R::lit(self.size)
    }
    fn edge<R: Real>(&mut self) -> V<R> {
        let length = R::lit(self.size * 10_f64.powf(-4.0 * self.random.unit_f64()));
        self.vector() * length
    }
}

/// What computes a point of a surface.
type Computes<R> = Box<dyn Fn(&mut Numbers) -> V<R>>;

/// What a host knows of a light: points that it computes on it, and whether the library says that a point is on it.
struct Shape<R: Real<Scalar = R>> {
    light: Emitter<R>,
    /// A point of the surface for numbers, and an upper bound of coordinates that went into it.
    point: Computes<R>,
    is_on: Box<dyn Fn(V<R>) -> bool>,
    /// Whether its samplers take the point for one in front.
    is_lit: Box<dyn Fn(V<R>) -> bool>,
    normal: V<R>,
    /// The greatest coordinate.
    reach: R,
}

macro_rules! shape {
    ($light:expr, $normal:expr, $reach:expr, |$numbers:ident| $point:expr) => {{
        let light = $light;
        Shape {
            light: light.into(),
            point: Box::new(move |$numbers| $point),
            is_on: Box::new(move |p| light.on_surface(p).all()),
            is_lit: Box::new(move |p| light.by_area(p).sample(Vec2::lit([0.3, 0.6])).weight().gt(R::lit(0.0)).all()),
            normal: $normal.unit_and_length().0,
            reach: $reach,
        }
    }};
}

fn greatest<R: Real>(vectors: &[V<R>]) -> R {
    vectors.iter().fold(R::lit(0.0), |most, v| most.greater(v.max_abs()))
}

/// Every shape with a surface, at random.
fn shapes<R: Real<Scalar = R>>(numbers: &mut Numbers) -> Vec<Shape<R>> {
    let one = R::lit(1.0);
    let (a, e, f): (V<R>, V<R>, V<R>) = (numbers.point(), numbers.edge(), numbers.edge());
    let radius = R::lit(numbers.size * 10_f64.powf(-3.0 * numbers.random.unit_f64()));
    let normal: V<R> = numbers.vector::<R>().unit_and_length().0;
    let (b, c) = (a + e, a + f);
    let frame = Frame::new(normal);
    let [x, y] = [e, f].map(|edge| edge.unit_and_length().0);
    let g = x.cross(y).cross(x).unit_and_length().0 * f.unit_and_length().1;
    let corners = [a, a + e, a + e + f, a + f * R::lit(0.5) + f * R::lit(0.5)];
    vec![
        // by barycentric coordinates, of the vertices and of the edges
        shape!(Triangle::new(a, b, c), x.cross(y), greatest(&[a, b, c]), |numbers| {
            let (mut u, mut v) = (numbers.unit::<R>(), numbers.unit::<R>());
            if (u + v).gt(one).all() {
                (u, v) = (one - u, one - v);
            }
            a * (one - u - v) + b * u + c * v
        }),
        shape!(Parallelogram::new(a, e, f), x.cross(y), greatest(&[a, e, f]), |numbers| a
            + e * numbers.unit::<R>()
            + f * numbers.unit::<R>()),
        shape!(Rectangle::new(a, e, g), x.cross(y), greatest(&[a, e, g]), |numbers| a
            + e * numbers.unit::<R>()
            + g * numbers.unit::<R>()),
        shape!(Disk::new(a, normal, radius), normal, greatest(&[a]) + radius, |numbers| {
            let (sin, cos) = numbers.unit::<R>().sin_cos_turns();
            let r = radius * numbers.unit::<R>().sqrt();
            a + frame.s * (r * cos) + frame.t * (r * sin)
        }),
        shape!(Polygon::new(corners), x.cross(y), greatest(&corners), |numbers| {
            let (u, v) = (numbers.unit::<R>(), numbers.unit::<R>());
            corners[0] * (one - u) * (one - v)
                + corners[1] * u * (one - v)
                + corners[2] * u * v
                + corners[3] * (one - u) * v
        }),
        shape!(Sphere::new(a, radius), V::ZERO, greatest(&[a]) + radius, |numbers| {
            a + numbers.vector::<R>().unit_and_length().0 * radius
        }),
    ]
}

/// A point of a plane as the hit of a ray from a point whose coordinates are at most twice as great, by the textbook: t = n·(a − o)/n·d.
fn hit<R: Real<Scalar = R>>(from: V<R>, at: V<R>, on: V<R>, normal: V<R>) -> Option<V<R>> {
    let [greatest, most] = [from, at].map(|v| v.max_abs().lane_f64(0));
    let from = if greatest > 2.0 * most { from * R::lit(2.0 * most / greatest) } else { from };
    let d = (at - from).unit_and_length().0;
    let along = d.dot(normal);
    (along.abs().lane_f64(0) > 0.05).then(|| from + d * (normal.dot(on - from) / along))
}

/// All points that are computed on lights are on them, and no point is that is 1e−4 of the scene away; from such points, half of which the
/// samplers take for points in front, sets get no light.
#[test]
fn on_plane() {
    fn check<R: etendue::lights::Number + Real<Uint = u32>>(seed: u64) {
        let (mut counts, mut in_front) = ([0_u32; 6], [0_u32; 6]);
        let scenes =
            [(1.0, [0.0; 3]), (1e-12, [0.0; 3]), (1e12, [0.0; 3]), (1.0, [30.0, -100.0, 7.0]), (3e3, [1e3, 2e4, 0.0])];
        let each = cases(10_u32, 100);
        for (scene, (size, shift)) in scenes.into_iter().enumerate() {
            let mut numbers = Numbers { random: Random::new(5 * seed + scene as u64), size, shift };
            for _ in 0..20_000 / 5 / each {
                for (kind, shape) in shapes::<R>(&mut numbers).into_iter().enumerate() {
                    let flat = shape.normal.max_abs().lane_f64(0) > 0.0;
                    let set = Lights::new([(shape.light.clone(), R::lit(1.0))]).unwrap();
                    for k in 0..each {
                        let mut p = (shape.point)(&mut numbers);
                        if k % 2 == 1 && flat {
                            // as the hit of a ray, of what has been computed before
                            let from = numbers.point::<R>();
                            p = hit(from, p, p, shape.normal).unwrap_or(p);
                        }
                        assert!((shape.is_on)(p), "{kind}: {p:?} is on {:?}", shape.light);
                        let at = set.at(Receiver { point: p, side: Side::None, on: None });
                        let s = at.sample([R::lit(0.3), R::lit(0.6), R::lit(0.2)]);
                        let lit = [s.weight(), at.pdf(0, s.direction)].map(|x| x.lane_f64(0));
                        assert_eq!(lit, [0.0; 2], "{s:?}");
                        in_front[kind] += u32::from((shape.is_lit)(p));
                        counts[kind] += 1;
                        if flat {
                            let off = p + shape.normal * (shape.reach * R::lit(1e-4));
                            assert!(!(shape.is_on)(off), "{kind}: {off:?} is off {:?}", shape.light);
                        }
                    }
                }
            }
        }
        println!("of {counts:?} computed points, so many are in front by their bits: {in_front:?}");
        assert!(counts.iter().all(|count| *count == 20_000), "{counts:?}");
        assert!(in_front[0] > 2_000, "the points are not what hosts compute: {in_front:?}");
    }
    check::<f32>(1);
    check::<f64>(2);
}

/// No point is on a light without a surface, nor on one of numbers that are not finite or without a plane.
#[test]
fn nothing_is_on_what_has_no_surface() {
    let v = |x: f32| V::new(x, 1.0, 0.0);
    for x in [0.0, 1.0, f32::NAN, f32::INFINITY, 1e38] {
        let p = v(x);
        let none = [
            BilinearPatch::new(p, v(0.0), v(1.0), p).on_surface(p),
            Line::new(v(0.0), v(1.0)).on_surface(p),
            PointLight::new(p).on_surface(p),
            SpotLight::new(p, v(0.0), [0.1, 0.2]).on_surface(p),
            DirectionalLight::new(v(0.0)).on_surface(p),
            Sun::new(v(0.0), 0.1).on_surface(p),
            Triangle::new(v(0.0), v(0.0), v(1.0)).on_surface(p),
            Disk::new(v(0.0), V::ZERO, 1.0).on_surface(p),
            Sphere::new(v(0.0), 0.0).on_surface(p),
            Triangle::new(v(f32::NAN), v(0.0), v(1.0)).on_surface(p),
        ];
        assert_eq!(none, [false; 10], "{x}");
    }
}
