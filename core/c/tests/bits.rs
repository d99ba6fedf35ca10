//! The functions for lights with images and for sets of lights return what the core does, bit by bit.

use etendue::light::*;
use etendue::lights::{Emitter, Lights, Receiver, Side, Which};
use etendue::owned::OwnedEnvironment;
use etendue::reflection::Reflection;
use etendue::sequence::{Independent, Sequence};
use etendue::warp::{UniformSphere, Warp};
use etendue::{LightSampler, Vec2, Vec3};
use etendue_c::*;
use std::ptr::null;

const P: [f32; 3] = [0.1, 0.2, 0.3];
const N: [f32; 3] = [0.0, 0.8, 0.6];
const COUNT: u32 = 300;
const WEIGHTS: [f32; 15] = [0.0, 1.0, 0.3, 1e-3, 7.0, 2.0, 0.0, 0.5, 3.0, 1.0, 4.0, 0.25, 1.0, 0.0, 6.0];

fn pair(i: u32) -> Vec2<f32> {
    Independent::new(3).pair(0, i, 0)
}
fn direction(i: u32) -> Vec3<f32> {
    UniformSphere.sample(Independent::new(3).pair(1, i, 0))
}
fn three(v: Vec3<f32>) -> [f32; 3] {
    [v.x, v.y, v.z]
}
fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|x| x.to_bits()).collect()
}
fn of_core(s: &LightSample<f32>) -> Vec<u32> {
    let [d, n] = [s.direction, s.normal].map(three);
    let emits = f32::from(u8::from(s.emits));
    bits(&[d[0], d[1], d[2], s.distance, s.pdf, s.weight(), n[0], n[1], n[2], s.uv.x, s.uv.y, emits])
}
fn of_c(s: &EtendueLightSample) -> Vec<u32> {
    let EtendueLightSample { direction: d, distance, pdf, weight, normal: n, uv, emits } = *s;
    bits(&[d[0], d[1], d[2], distance, pdf, weight, n[0], n[1], n[2], uv[0], uv[1], f32::from(emits)])
}

/// Compares all that is done with one prepared light.
macro_rules! assert_same {
    ($name:expr, $core:expr, $sampler:expr, $technique:ident) => {{
        let (core, sampler) = ($core, $sampler);
        let (technique, sampler) = (EtendueTechnique::$technique as u32, std::ptr::from_ref(&sampler).cast());
        let (mut found, mut positive) = (EtendueLightSample::default(), 0);
        for i in 0..COUNT {
            let u = pair(i);
            // SAFETY: all pointers are to what the header says
            unsafe {
                assert_eq!(etendue_sample(technique, sampler, [u.x, u.y].as_ptr(), &mut found), EtendueStatus::Ok);
                let expected = core.sample(u);
                assert_eq!(of_c(&found), of_core(&expected), "{}, sample {i}", $name);
                for w in [expected.direction, direction(i)] {
                    let (raw, mut back) = (three(w), [0.0; 2]);
                    let pdf = core.pdf(w);
                    positive += u32::from(pdf > 0.0);
                    assert_eq!(
                        etendue_pdf(technique, sampler, raw.as_ptr()).to_bits(),
                        pdf.to_bits(),
                        "{}, pdf {i}",
                        $name
                    );
                    assert_eq!(etendue_hit(technique, sampler, raw.as_ptr(), &mut found), EtendueStatus::Ok);
                    assert_eq!(of_c(&found), of_core(&core.hit(w)), "{}, hit {i}", $name);
                    assert_eq!(etendue_invert(technique, sampler, raw.as_ptr(), back.as_mut_ptr()), EtendueStatus::Ok);
                    let u = core.invert(w);
                    assert_eq!(bits(&back), bits(&[u.x, u.y]), "{}, inverse {i}", $name);
                }
            }
        }
        assert!(positive > COUNT / 2, "{}: only {positive} directions have a pdf", $name);
    }};
}
/// A sampler of C, prepared for the point, and for what else the technique takes.
macro_rules! prepared {
    ($sampler:ident: $light:expr, $technique:ident, $with:expr) => {{
        let mut sampler = std::mem::MaybeUninit::<$sampler>::uninit();
        let (technique, light) = (EtendueTechnique::$technique as u32, std::ptr::from_ref(&$light).cast());
        // SAFETY: all pointers are to what the header says, and the function writes the sampler
        unsafe {
            let status = etendue_prepare(technique, light, P.as_ptr(), $with, sampler.as_mut_ptr().cast());
            assert_eq!(status, EtendueStatus::Ok);
            sampler.assume_init()
        }
    }};
}

#[test]
fn reflections() {
    let (p, n, view) = (Vec3::from(P), Vec3::from(N), [-0.6, 0.64, 0.48]);
    for alpha in [0.0, 0.1, 0.5, 1.0] {
        let core = Reflection::new(alpha, n, view.into());
        let mut same = std::mem::MaybeUninit::<EtendueReflection>::uninit();
        // SAFETY: the pointers are to what the header says, and the function writes the reflection
        let same = unsafe {
            let prepared = etendue_reflection_prepare(alpha, N.as_ptr(), view.as_ptr(), same.as_mut_ptr());
            assert_eq!(prepared, EtendueStatus::Ok);
            same.assume_init()
        };
        let (lobe, of) = (EtendueWarp::Reflection as u32, std::ptr::from_ref(&same).cast());
        assert_eq!(bits(&[same.albedo, same.schlick]), bits(&[core.albedo(), core.schlick()]));
        for i in 0..COUNT {
            let (u, center, mut drawn, mut back) = (pair(i), direction(i), [0.0; 3], [0.0; 2]);
            // SAFETY: the pointers are to what the header says
            unsafe {
                assert_eq!(etendue_warp_sample(lobe, of, [u.x, u.y].as_ptr(), drawn.as_mut_ptr()), EtendueStatus::Ok);
                let w = core.sample(u);
                assert_eq!(bits(&drawn), bits(&three(w)), "{alpha}, sample {i}");
                assert_eq!(
                    etendue_warp_pdf(lobe, of, drawn.as_ptr()).to_bits(),
                    core.pdf(w).to_bits(),
                    "{alpha}, pdf {i}"
                );
                assert_eq!(etendue_warp_invert(lobe, of, drawn.as_ptr(), back.as_mut_ptr()), EtendueStatus::Ok);
                assert_eq!(bits(&back), bits(&[core.invert(w).x, core.invert(w).y]), "{alpha}, inverse {i}");
                let covered = etendue_reflection_sphere(&same, three(center).as_ptr(), u.x);
                assert_eq!(covered.to_bits(), core.sphere(center, u.x).to_bits(), "{alpha}, sphere {i}");
            }
        }
        let (corner, s, t) = ([-0.5, 2.0, -0.3], [0.1, 0.2, 1.1], [1.2, 0.1, 0.2]);
        let light = EtendueParallelogram { corner, edge_s: s, edge_t: t };
        let expected = Parallelogram::new(corner.into(), s.into(), t.into()).by_reflection(p, &core);
        let sampler = prepared!(EtendueParallelogramByReflection: light, ParallelogramByReflection, of);
        assert_same!(alpha, expected, sampler, ParallelogramByReflection);
        // the sampler of a rectangle is a parallelogram's
        let (s, t) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let light = EtendueRectangle { corner, edge_s: s, edge_t: t };
        let expected = Rectangle::new(corner.into(), s.into(), t.into()).by_reflection(p, &core);
        let sampler = prepared!(EtendueParallelogramByReflection: light, RectangleByReflection, of);
        assert_same!(alpha, expected, sampler, RectangleByReflection);
        let light = EtendueTriangle { v0: corner, e1: [1.2, 0.1, 0.2], e2: [0.1, 0.2, 1.1] };
        let expected = Triangle { v0: light.v0.into(), e1: light.e1.into(), e2: light.e2.into() };
        let sampler = prepared!(EtendueTriangleByReflection: light, TriangleByReflection, of);
        assert_same!(alpha, expected.by_reflection(p, &core), sampler, TriangleByReflection);
        let corners = [[-0.5, 2.0, -0.3], [0.6, 2.0, -0.4], [0.9, 2.0, 0.4], [0.2, 2.0, 0.9]];
        let corners = std::array::from_fn(|i| corners[i.min(3)]);
        let expected = Polygon::new(corners.map(Vec3::from)).by_reflection(p, &core);
        let sampler = prepared!(EtenduePolygonByReflection: EtenduePolygon { corners }, PolygonByReflection, of);
        assert_same!(alpha, expected, sampler, PolygonByReflection);
        let light = EtendueSphere { center: [-0.2, 2.0, 0.3], radius: 0.9 };
        let expected = Sphere::new(light.center.into(), light.radius).by_reflection(p, &core);
        let sampler = prepared!(EtendueSphereByReflection: light, SphereByReflection, of);
        assert_same!(alpha, expected, sampler, SphereByReflection);
    }
}

/// A picture in C and in the core, over one image.
fn assert_pictures(picture: Picture<'_>, same: EtenduePicture, name: &str) {
    let (p, n) = (Vec3::from(P), Vec3::from(N));
    let (corner, s, t) = ([-0.5, 2.0, -0.3], [0.1, 0.2, 1.1], [1.2, 0.1, 0.2]);
    let light = |parallelogram| EtenduePicturedParallelogram { picture: same, light: parallelogram };
    let mut coordinates = EtendueParallelogram { corner: [0.0; 3], edge_s: [0.0; 3], edge_t: [0.0; 3] };
    match picture.region() {
        Region::Square => {
            let parallelogram = Parallelogram { corner: corner.into(), edge_s: s.into(), edge_t: t.into() };
            let own = light(EtendueParallelogram { corner, edge_s: s, edge_t: t });
            let on = picture.on(parallelogram);
            assert_same!(
                name,
                on.by_area(p),
                prepared!(EtenduePictureByArea: own, PictureByArea, null()),
                PictureByArea
            );
            let sampler = prepared!(EtenduePictureBySolidAngle: own, PictureBySolidAngle, null());
            assert_same!(name, on.by_solid_angle(p), sampler, PictureBySolidAngle);
            let sampler =
                prepared!(EtenduePictureByProjectedSolidAngle: own, PictureByProjectedSolidAngle, N.as_ptr().cast());
            assert_same!(name, on.by_projected_solid_angle(p, n), sampler, PictureByProjectedSolidAngle);

            let rectangle =
                Rectangle { corner: corner.into(), edge_s: [0.0, 0.0, 1.0].into(), edge_t: [1.0, 0.0, 0.0].into() };
            let raw = EtendueRectangle { corner, edge_s: [0.0, 0.0, 1.0], edge_t: [1.0, 0.0, 0.0] };
            // SAFETY: the pointers are to a light and to room for one
            assert_eq!(unsafe { etendue_rectangle_coordinates(&raw, &mut coordinates) }, EtendueStatus::Ok);
            let sampler = prepared!(EtenduePictureBySolidAngle: light(coordinates), PictureBySolidAngle, null());
            assert_same!(name, picture.on(rectangle).by_solid_angle(p), sampler, PictureBySolidAngle);

            let sphere =
                EtenduePicturedSphere { picture: same, light: EtendueSphere { center: [0.3, 2.0, 0.1], radius: 0.5 } };
            let sampler = prepared!(EtenduePictureOnSphereByVisibleArea: sphere, PictureOnSphereByVisibleArea, null());
            let core = picture.on(Sphere::new(Vec3::new(0.3, 2.0, 0.1), 0.5)).by_visible_area(p);
            assert_same!(name, core, sampler, PictureOnSphereByVisibleArea);
        }
        Region::Triangle => {
            let raw = EtendueTriangle { v0: corner, e1: s, e2: t };
            // SAFETY: the pointers are to a light and to room for one
            assert_eq!(unsafe { etendue_triangle_coordinates(&raw, &mut coordinates) }, EtendueStatus::Ok);
            let core = picture.on(Triangle { v0: corner.into(), e1: s.into(), e2: t.into() });
            let sampler = prepared!(EtenduePictureByProjectedSolidAngle: light(coordinates), PictureByProjectedSolidAngle, N.as_ptr().cast());
            assert_same!(name, core.by_projected_solid_angle(p, n), sampler, PictureByProjectedSolidAngle);
        }
        Region::Disk => {
            let raw = EtendueDisk { center: [0.3, 2.0, 0.1], normal: [0.0, -0.8, 0.6], radius: 0.5 };
            // SAFETY: the pointers are to a light and to room for one
            assert_eq!(unsafe { etendue_disk_coordinates(&raw, &mut coordinates) }, EtendueStatus::Ok);
            let core =
                picture.on(Disk { center: [0.3, 2.0, 0.1].into(), normal: [0.0, -0.8, 0.6].into(), radius: 0.5 });
            let sampler = prepared!(EtenduePictureBySolidAngle: light(coordinates), PictureBySolidAngle, null());
            assert_same!(name, core.by_solid_angle(p), sampler, PictureBySolidAngle);
        }
    }
}

#[test]
fn pictures() {
    for (code, region) in [Region::Square, Region::Triangle, Region::Disk].into_iter().enumerate() {
        let mut buffer = vec![0.0; Picture::buffer(5, 3)];
        let mut table = vec![0.0; etendue_picture_table(5, 3)];
        let picture = Picture::build(&WEIGHTS, 5, region, &mut buffer).unwrap();
        let mut same = EtenduePicture { table: null(), values: null(), width: 0, height: 0, region: 0 };
        // SAFETY: the pointers are to as many numbers as the header says
        let built =
            unsafe { etendue_picture_build(WEIGHTS.as_ptr(), 5, 3, code as u32, table.as_mut_ptr(), &mut same) };
        assert_eq!(built, EtendueStatus::Ok);
        assert_pictures(picture, same, &format!("{region:?}"));
        drop(table);
        drop(buffer);
    }
}

#[test]
fn interpolated_pictures() {
    let mut buffer = vec![0.0; Picture::buffer(6, 4)];
    let mut table = vec![0.0; etendue_picture_interpolated_table(5, 3)];
    let picture = Picture::interpolated(&WEIGHTS, 5, &mut buffer).unwrap();
    let mut same = EtenduePicture { table: null(), values: null(), width: 0, height: 0, region: 0 };
    // SAFETY: the pointers are to as many numbers as the header says
    let built = unsafe { etendue_picture_interpolate(WEIGHTS.as_ptr(), 5, 3, table.as_mut_ptr(), &mut same) };
    assert_eq!(built, EtendueStatus::Ok);
    assert_pictures(picture, same, "interpolated");
    drop(table);
}

#[test]
fn portals() {
    let corners = [[-0.5, 1.0, -0.5], [0.25, 1.5, 0.0]];
    let (s, t) = ([0.0, 0.25, 1.0], [1.0, 0.0, 0.0]);
    let mut buffer = vec![0; PortalTable::buffer(5, 3)];
    let tables = [PortalTable::build(&WEIGHTS, 5, &mut buffer).unwrap(); 2];
    let portals = corners.map(|corner| Portal::new(corner, s, t).unwrap());
    let core = PortalEnvironment::new(&portals, &tables).unwrap();

    let mut sums = vec![0; etendue_portal_table(5, 3)];
    let mut table = EtenduePortalTable { sums: null(), width: 0, height: 0 };
    // SAFETY: the pointers are to as many numbers as the header says
    let built = unsafe { etendue_portal_table_build(WEIGHTS.as_ptr(), 5, 3, sums.as_mut_ptr(), &mut table) };
    assert_eq!(built, EtendueStatus::Ok);
    let (raw, both) = (corners.map(|corner| EtenduePortal { corner, edge_s: s, edge_t: t }), [table; 2]);
    let sky = EtenduePortalEnvironment { portals: raw.as_ptr(), tables: both.as_ptr(), count: 2 };
    let sampler = prepared!(EtenduePortalsByRadiance: sky, PortalsByRadiance, null());
    assert_same!("portals", core.by_radiance(Vec3::from(P)), sampler, PortalsByRadiance);
    for i in 0..COUNT {
        let (uv, mut w, mut angle) = (pair(i), [0.0; 3], 0.0);
        let (direction, solid_angle) = portals[0].map().direction(uv);
        // SAFETY: all pointers are to what the header says
        let found = unsafe { etendue_portal_direction(&raw[0], [uv.x, uv.y].as_ptr(), w.as_mut_ptr(), &mut angle) };
        assert_eq!(found, EtendueStatus::Ok);
        assert_eq!((bits(&w), angle.to_bits()), (bits(&three(direction)), solid_angle.to_bits()));
    }
    drop(sums);
}

#[test]
fn sets() {
    const MAP: EnvironmentMap = EnvironmentMap::Equirectangular;
    let (ball, bulb) =
        (EtendueSphere { center: [0.3, 2.0, 0.1], radius: 0.5 }, EtenduePointLight { position: [2.0; 3] });
    let mesh = [0.0, 3.0].map(|x| EtendueTriangle { v0: [x, 2.0, -0.3], e1: [1.2, 0.1, 0.2], e2: [0.1, 0.2, 1.1] });
    let leaf = EtendueParallelogram { corner: [-2.0, 2.0, -0.3], edge_s: [1.2, 0.1, 0.2], edge_t: [0.1, 0.2, 1.1] };
    let mut table = vec![0.0; etendue_image_environment_table(5, 3)];
    let mut sky = EtendueImageEnvironment { table: null(), width: 0, height: 0, map: 0 };
    // SAFETY: the pointers are to as many numbers as the header says
    let built =
        unsafe { etendue_image_environment_build(WEIGHTS.as_ptr(), 5, 3, MAP as u32, table.as_mut_ptr(), &mut sky) };
    assert_eq!(built, EtendueStatus::Ok);
    let down = [0.0, -1.0, 0.0];
    let triangles = mesh.map(|t| Triangle { v0: t.v0.into(), e1: t.e1.into(), e2: t.e2.into() });
    let leaf_of_core: Emitter<f32> =
        Parallelogram::new(leaf.corner.into(), leaf.edge_s.into(), leaf.edge_t.into()).into();
    let core: Vec<(Emitter<f32>, f32)> = vec![
        (Sphere::new(ball.center.into(), ball.radius).into(), 3.0),
        (PointLight::new(bulb.position.into()).into(), 5.0),
        (Emitter::group(triangles).facing(down.into()), 1.0),
        (leaf_of_core.two_sided(), 2.0),
        (ConstantEnvironment.into(), 0.1),
        (OwnedEnvironment::new(&WEIGHTS, 5, MAP).unwrap().into(), 0.2),
    ];
    let one = EtendueEmitter {
        light: null(),
        parts: 1,
        kind: EtendueLightKind::ConstantEnvironment as u32,
        two_sided: 0,
        facing: [0.0; 3],
        radiance: 0.1,
    };
    let of = |kind: EtendueLightKind, light, radiance| EtendueEmitter { light, kind: kind as u32, radiance, ..one };
    let raw = [
        of(EtendueLightKind::Sphere, std::ptr::from_ref(&ball).cast(), 3.0),
        of(EtendueLightKind::PointLight, std::ptr::from_ref(&bulb).cast(), 5.0),
        EtendueEmitter { parts: 2, facing: down, ..of(EtendueLightKind::Triangle, mesh.as_ptr().cast(), 1.0) },
        EtendueEmitter { two_sided: 1, ..of(EtendueLightKind::Parallelogram, std::ptr::from_ref(&leaf).cast(), 2.0) },
        one,
        of(EtendueLightKind::ImageEnvironment, std::ptr::from_ref(&sky).cast(), 0.2),
    ];
    let core = Lights::new(core).unwrap();
    let mut same = std::ptr::null_mut();
    // SAFETY: the pointers are to what the header says
    assert_eq!(unsafe { etendue_lights_create(raw.len(), raw.as_ptr(), &mut same) }, EtendueStatus::Ok);
    drop(table);
    let mut drawn = [0; 6];
    let on = EtendueWhich { light: 2, part: 1 };
    for (side, raw_side) in [
        (Side::Surface(N.into()), EtendueSide::Surface),
        (Side::Both, EtendueSide::Both),
        (Side::None, EtendueSide::None),
    ] {
        for on in [None, Some(&on)] {
            let raw = EtendueReceiver { p: P, n: N, side: raw_side as u32, on: on.map_or(null(), std::ptr::from_ref) };
            let on = on.map(|on| Which { light: on.light, part: on.part });
            let at = core.at(Receiver { point: P.into(), side, on });
            let mut prepared = std::mem::MaybeUninit::<EtendueLightsAt>::uninit();
            let mut found = std::mem::MaybeUninit::<EtendueLightsSample>::uninit();
            // SAFETY: the pointers are to what the header says, and what is read was written
            unsafe {
                assert_eq!(etendue_lights_at(same, &raw, prepared.as_mut_ptr()), EtendueStatus::Ok);
                for i in 0..COUNT {
                    let (u, w) = (pair(i), direction(i));
                    let u = [Independent::new(4).pair(0_u32, i, 0).x, u.x, u.y];
                    assert_eq!(
                        etendue_lights_sample(prepared.as_mut_ptr(), u.as_ptr(), found.as_mut_ptr()),
                        EtendueStatus::Ok
                    );
                    let (s, c) = (at.sample(u), found.assume_init());
                    drawn[s.which.light as usize] += u32::from(s.pdf > 0.0);
                    let expected = [
                        &three(s.direction)[..],
                        &three(s.point),
                        &three(s.normal),
                        &[s.distance, s.bound, s.pdf, s.pmf, s.factor, s.weight(), s.reach()],
                    ];
                    let returned = [
                        &c.direction[..],
                        &c.point,
                        &c.normal,
                        &[c.distance, c.bound, c.pdf, c.pmf, c.factor, c.weight, c.reach],
                    ];
                    assert_eq!(bits(&returned.concat()), bits(&expected.concat()), "{s:?}");
                    assert_eq!((c.which.light, c.which.part, c.delta), (s.which.light, s.which.part, s.delta.into()));
                    for w in [s.direction, w] {
                        let pdf = etendue_lights_pdf(prepared.as_mut_ptr(), c.which, three(w).as_ptr());
                        assert_eq!(pdf.to_bits(), at.pdf(s.which, w).to_bits(), "{s:?}");
                    }
                }
            }
        }
    }
    // SAFETY: the set is used no more
    unsafe { etendue_lights_free(same) };
    assert!(drawn.iter().all(|&count| count > 0), "{drawn:?}");
}
