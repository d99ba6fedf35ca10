//! Images of scenes, against closed forms, references and each other. One program: linking the renderer takes longer than most tests.

mod analytic;
mod choice;
mod glossy;
mod holes;
mod identity;
mod images;
mod kit;
mod lens;
mod lights;
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
