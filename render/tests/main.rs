//! Rays, certificates, images of scenes, what lights and skies emit, and what scene files mean: against closed forms, references and each
//! other. One program: linking the renderer takes longer than most tests.

mod analytic;
mod attack;
mod certificates;
mod choice;
mod damaged;
mod daylight;
mod glossy;
mod gltf;
mod holes;
mod identity;
mod images;
mod intensity;
mod kit;
mod lens;
mod lights;
mod meshes;
mod occlusion;
mod openings;
mod panels;
mod parts;
mod pbrt;
mod portals;
mod profiles;
mod random;
mod ray_oracle;
mod rays;
mod references;
mod sampler;
mod samples;
mod sensor;
mod sky;
mod surfaces;
mod values;
mod variance;
mod vignetting;
