//! Images of scenes, against closed forms, references and each other, and what lights and skies emit by its definition. One program: linking the renderer takes longer than most tests.

mod analytic;
mod choice;
mod daylight;
mod glossy;
mod holes;
mod identity;
mod images;
mod intensity;
mod kit;
mod lens;
mod lights;
mod openings;
mod panels;
mod parts;
mod portals;
mod profiles;
mod references;
mod sampler;
mod samples;
mod sensor;
mod sky;
mod surfaces;
mod values;
mod variance;
mod vignetting;
