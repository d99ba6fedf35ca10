//! What may help where an image is not what its user may have wanted, and what `auto` took.

use crate::output::percent;
use etendue_render::drive::AutoTrial;
use etendue_render::film::Film;
use etendue_render::{ChoiceBy, Sampler, Settings, Technique, World};

/// What may help where an image is black, or its PNG nearly black or white; `brightness` is what the PNG is multiplied by, and `only_pictures`
/// whether nothing but the textures of surfaces emits.
pub(crate) fn hint(film: &Film, brightness: f64, has_sky: bool, only_pictures: bool) -> Option<String> {
    let mut all: Vec<f32> = film.pixels.iter().map(|pixel| pixel.mean.iter().sum::<f32>() / 3.0).collect();
    if all.iter().all(|x| *x == 0.0) {
        let sky = if has_sky { "" } else { "; --environment FILE adds a sky" };
        return Some(format!("the image is black: the camera sees nothing that is lit or emits{sky}"));
    }
    all.sort_by(f32::total_cmp);
    // of pixels that are not black
    let lit = &all[all.partition_point(|x| *x <= 0.0)..];
    let middle = f64::from(lit[lit.len() / 2]) * brightness;
    let stops = (0.5 / middle).log2().round();
    // the PNG is white at 4, and nearly black below a hundredth
    if middle >= 4.0 {
        return Some(format!("the PNG is nearly white: --exposure {stops} darkens it"));
    }
    // screens and signs are rarely meant to light a scene
    if only_pictures && middle < 0.1 {
        return Some("only textures of surfaces emit light: --environment FILE adds a sky".to_owned());
    }
    if middle >= 0.01 {
        return None;
    }
    let sky = if has_sky { "" } else { ", and --environment FILE adds a sky" };
    Some(format!("the PNG is nearly black: --exposure {stops} brightens it{sky}"))
}

/// What may help where the sky lights a room through its windows.
pub(crate) fn windows(world: &World) -> Option<String> {
    let share = world.openness().filter(|share| (1e-3..0.15).contains(share))?;
    let share = percent(share);
    Some(format!(
        "what the camera sees is open to the sky in {share} of all directions: a \"point3 portal\" of four corners in each window, facing inwards, \
         sends all samples there"
    ))
}

/// What may help where a number of samples makes a sampler no better than independent numbers: one that nobody chose, or sets of one sample
/// where the sampler or the sets were chosen.
pub(crate) fn wasted(settings: &Settings, is_chosen: bool) -> Option<String> {
    let Settings { spp, sampler, sets, .. } = *settings;
    if spp > 1 && sampler == Sampler::Independent && !is_chosen {
        let next = spp.next_multiple_of(2);
        return Some(format!(
            "{spp} samples per pixel are independent, since they are odd: --spp {next} has less noise"
        ));
    }
    let is_chosen = is_chosen || sets > 0;
    let sets = sampler.sets(spp, sets);
    (is_chosen && sampler.has_sets() && spp > 1 && sets == spp).then(|| {
        let more = 4 * sets;
        format!("sets of one sample are independent, whatever the sampler: --spp {more} makes sets of 4, with less noise for their number")
    })
}

/// What `auto` has taken, over what, and by how much.
pub(crate) fn taken(settings: &Settings, (trial, seconds): &(AutoTrial, f64)) -> String {
    let name = |technique: Technique, choice: ChoiceBy| match choice {
        ChoiceBy::Auto => technique.name().to_owned(),
        _ => format!("{} with the choice {}", technique.name(), choice.name()),
    };
    let (technique, choice) = trial.over;
    format!(
        "auto {} {}: {:.2} times as efficient as {} in {} tiles of a trial{}, {} of the samples, {seconds:.3} s",
        if trial.is_rule { "kept its rule," } else { "took" },
        name(settings.technique, settings.choice),
        trial.times,
        name(technique, choice),
        trial.tiles,
        if trial.is_rule && trial.times < 1.0 { ", too few to be sure" } else { "" },
        percent(trial.part)
    )
}
