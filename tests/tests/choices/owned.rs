//! Tables that own their memory have the bits of those in the caller's.

use etendue::light::{EnvironmentMap, ImageEnvironment, Picture, Region};
use etendue::owned::{OwnedEnvironment, OwnedPicture, OwnedTree};
use etendue::select::{LightBound, LightChoice, LightTree, Node8};
use etendue::{Disk, LightSampler, Rectangle, Sphere, Vec2, Vec3};
use etendue_judge::generators::Random;

fn lamps(count: usize, random: &mut Random) -> Vec<LightBound> {
    let lamp = |_| {
        let place = Vec3::from(random.direction().map(|x| 10.0 * x as f32));
        Sphere::new(place, 0.1).bound(random.unit() + 0.1)
    };
    (0..count).map(lamp).collect()
}

#[test]
fn trees_are_built_again_in_their_memory() {
    let mut random = Random::new(1);
    let mut tree = OwnedTree::new(&lamps(1000, &mut random), &()).unwrap();
    let (p, n) = (Vec3::new(0.1, 0.2, 0.3_f32), Vec3::new(0.0, 0.6, 0.8));
    for count in [1000, 70, 0, 9, 2000] {
        let lamps = lamps(count, &mut random);
        tree.rebuild(&lamps, &()).unwrap();
        let (mut nodes, mut places) = (vec![Node8::default(); LightTree::nodes_for(count)], vec![0; count]);
        let check = |tree: &OwnedTree, other: LightTree<'_>, random: &mut Random| {
            for _ in 0..100 {
                let u = random.unit();
                let (own, other) = (tree.get().at(p, n).choose(u), other.at(p, n).choose(u));
                assert_eq!((own.index, own.pmf, own.u), (other.index, other.pmf, other.u), "{count} lights, {u}");
            }
        };
        check(&tree, LightTree::build(&lamps, &mut nodes, &mut places).unwrap(), &mut random);
        let moved: Vec<_> = lamps.iter().map(|lamp| LightBound { power: 1.5 - lamp.power, ..*lamp }).collect();
        tree.refit(&moved).unwrap();
        LightTree::refit(&moved, &mut nodes, &places).unwrap();
        check(&tree, LightTree::from_buffers(&nodes, &places), &mut random);
        assert!(tree.refit(&vec![LightBound::default(); count + 1]).is_err());
    }
}

#[test]
fn images_have_the_bits_of_those_in_other_memory() {
    let mut random = Random::new(2);
    let weights: Vec<f32> = (0..35).map(|_| random.unit()).collect();
    let (map, region) = (EnvironmentMap::EqualArea, Region::Disk);
    let (sky, plain) = (OwnedEnvironment::new(&weights, 5, map), OwnedPicture::new(&weights, 5, region));
    let (sky, plain, smooth) = (sky.unwrap(), plain.unwrap(), OwnedPicture::interpolated(weights.clone(), 5).unwrap());
    let (mut image, mut flat) = ([0.0; ImageEnvironment::buffer(5, 7)], [0.0; Picture::buffer(5, 7)]);
    let mut between = [0.0; Picture::buffer(6, 8)];
    let image = ImageEnvironment::build(&weights, 5, map, &mut image).unwrap();
    let flat = Picture::build(&weights, 5, region, &mut flat).unwrap();
    let between = Picture::interpolated(&weights, 5, &mut between).unwrap();
    let disk = Disk::new(Vec3::new(0.0, 0.0, 2.0), Vec3::new(0.0, 0.0, -1.0_f32), 1.5);
    let screen = Rectangle::new(Vec3::new(-1.0, -1.0, 2.0_f32), Vec3::new(0.0, 2.0, 0.0), Vec3::new(2.0, 0.0, 0.0));
    for _ in 0..500 {
        let u = Vec2::new(random.unit(), random.unit());
        let same = |own: &dyn LightSampler<f32>, other: &dyn LightSampler<f32>| {
            let (own, other) = (own.sample(u), other.sample(u));
            assert_eq!((own.direction, own.pdf, own.uv), (other.direction, other.pdf, other.uv), "{u:?}");
        };
        same(&sky.get().by_radiance(), &image.by_radiance());
        same(&plain.get().on(disk).by_solid_angle(Vec3::ZERO), &flat.on(disk).by_solid_angle(Vec3::ZERO));
        same(&smooth.get().on(screen).by_area(Vec3::ZERO), &between.on(screen).by_area(Vec3::ZERO));
    }
}
