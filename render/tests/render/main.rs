//! Images of scenes, against closed forms, references and each other. One program: linking the renderer takes longer than most tests.

mod adaptive;
mod allocation;
mod analytic;
mod choice;
mod closed_forms;
mod glossy;
mod identity;
mod images;
mod lens;
mod lights;
mod own_scenes;
mod parts;
mod pictures;
mod portals;
mod profiles;
mod references;
mod sampler;
mod sensor;
mod sky;
mod soundness;
mod values;
mod variance;
mod vignetting;
