//! The body of the target of trees of lights.

use super::Input;
use crate::area_lights::LightShape;
use crate::light_tree::{Grove, Lamp, Regime, place};
use etendue::reflection::Reflection;
use etendue::select::Gloss;

/// A light of any numbers.
fn lamp(input: &mut Input<'_>, before: &mut Vec<[f32; 3]>) -> Lamp {
    let shape = Regime::SHAPES[input.below(Regime::SHAPES.len() as u8) as usize];
    let a = input.vector(before);
    before.push(a);
    let (mut b, mut c) = (input.vector(before), input.vector(before));
    if matches!(shape, LightShape::SpotLight | LightShape::Disk) {
        b = input.direction();
    }
    if shape == LightShape::SpotLight {
        let cosine = input.unit();
        c = [cosine + (1.0 - cosine) * input.unit(), cosine, 0.0];
    }
    before.push(b);
    let (radius, two_sided, power) = (input.weight(), input.below(4) == 0, input.weight());
    let is_flat = matches!(shape, LightShape::Triangle | LightShape::Parallelogram | LightShape::Disk);
    let spread = if is_flat && input.below(2) == 0 { 3.0 * input.unit() } else { 0.0 };
    Lamp { shape, a, b, c, radius, two_sided, spread, power }
}

/// Whether the lengths of a light are such that squares of them do not overflow.
fn fair(lamp: &Lamp) -> bool {
    [lamp.a, lamp.b, lamp.c, [lamp.radius; 3]].iter().flatten().all(|x| x.abs() < 1e15)
}

/// Trees of up to 200 lights, some of them of any size and place.
pub(super) fn light_tree(input: &mut Input<'_>) {
    let regime = Regime::ALL[input.below(Regime::ALL.len() as u8) as usize];
    let count = 1 + usize::from(input.below(200)) % (1 + usize::from(input.below(200)));
    let mut random = input.numbers(64);
    let mut lamps = regime.lamps(count, &mut random);
    let mut before = vec![lamps[0].a];
    let odd = input.below(6);
    for to in lamps.iter_mut().take(odd.into()) {
        let any = lamp(input, &mut before);
        if fair(&any) {
            *to = any;
        }
    }
    let grove = Grove::of(&lamps);
    let mut places = [([0.0; 3], [0.0, 0.0, 1.0]); 8];
    let mut aims = [0; 8];
    for (k, to) in places.iter_mut().enumerate() {
        (*to, aims[k]) = if k < 6 || !input.below(2).is_multiple_of(2) {
            place(regime, &lamps, &mut random)
        } else {
            ((input.vector(&before), input.direction()), 0)
        };
    }
    let words = core::array::from_fn(|_| [input.word(), input.word()]);
    let us = core::array::from_fn(|_| input.unit());
    grove.choices(&places, &words, &us);
    for (k, &place) in places.iter().enumerate() {
        if k % 4 == 3 {
            let _ = grove.exact(place);
        }
        let lights = (0..usize::from(odd).min(count)).chain([aims[k], k % count, (7 * k + 3) % count]);
        for light in lights {
            grove.law(place, light, &lamps[light], input.square());
        }
    }
    for &place in &places {
        // rows of the table and beyond it, seen from above and from below
        let (alpha, view) = (input.number(), input.direction());
        let gloss = Gloss::new(input.unit(), input.unit(), &Reflection::new(alpha, place.1.into(), view.into()));
        grove.glossy(place, &gloss, input.unit());
    }
}
