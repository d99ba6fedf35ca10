//! `etendue view`: renders a scene pass by pass, and shows the image in the browser while it improves.
//!
//! Nothing is written unless `-o` or the page asks for it.
//!
//! The page is served on the loopback address alone, and its address has a random token. Connections, the time of each, requests and images
//! that are being sent are limited in number and size (`view/http.rs`, `view/server.rs`, `view/answer.rs`), so that memory is, too: a
//! client that does not read holds one of four images for at most 20 seconds. Each technique and sampler has an image of its own, which is
//! kept while another one is shown, up to 1 GiB of them (`view/work.rs`).
//!
//! Samples go to the image that is shown, in passes of about a quarter of the time so far and at most 0.4 s, unless the least pass of the
//! sampler takes longer. A wish for another image or part ends the pass, whose samples are lost. While a pass is rendered its tiles are shown,
//! and before the first one, or while the camera turns, a coarse image of about 0.1 s (`view/draft.rs`).

mod answer;
mod browser;
mod draft;
mod http;
mod page;
mod server;
mod state;
mod watch;
mod work;

use crate::image::ImageOptions;
use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::progress::bar;
use crate::render::{fraction, seconds};
use clap::Args;
use draft::Way;
use etendue_laboratory::options::{out, pool, say, whole};
use etendue_render::Settings;
use etendue_render::drive::progressive::{Goal, Refinement};
use etendue_render::film::image::{Picture, read_exr};
use etendue_render::film::{Film, Pixel};
use etendue_render::sampler::default_sampler;
use server::Server;
use state::Shared;
use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use work::{Reading, Worker};

/// The sampler is the best one for passes of as many samples.
const USUAL: u32 = 64;

#[derive(Args)]
pub(crate) struct Options {
    #[command(flatten)]
    image: ImageOptions,
    /// Keep the image that is shown in this EXR file, and in a PNG beside it [default: nothing is written]
    #[arg(short, long, value_name = "OUT.exr")]
    output: Option<PathBuf>,
    /// Refine an image until this many seconds of rendering have passed
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<f64>,
    /// Refine an image until its estimated error (relative RMS) is at most this, such as 0.01 or 1%
    #[arg(long, value_name = "TARGET", value_parser = fraction)]
    error: Option<f64>,
    /// Offer this image for comparison on the page; it must have the size of the view
    #[arg(long, value_name = "FILE.exr")]
    reference: Option<PathBuf>,
    /// Serve the page on this port of 127.0.0.1, or on the next one that is free
    #[arg(long, value_name = "N", default_value_t = 7450, value_parser = whole::<u16>(1..=65535))]
    port: u16,
    /// Print the address of the page, and open no browser
    #[arg(long)]
    no_open: bool,
}

/// Reads an image to compare with.
fn reference(path: &Path, settings: &Settings) -> Result<(String, Arc<Film>), Box<dyn Error>> {
    let Picture { width, height, radiance, variance, .. } = read_exr(path)?;
    let Settings { width: w, height: h, .. } = *settings;
    if [width, height] != [w as usize, h as usize] {
        let name = path.display();
        return Err(format!(
            "--reference {name}: it has {width}x{height} pixels, the view {w}x{h}: --size changes that"
        )
        .into());
    }
    let unknown = vec![[f32::INFINITY; 3]; radiance.len()];
    let both = radiance.into_iter().zip(variance.unwrap_or(unknown));
    let pixels = both.map(|(mean, variance)| Pixel { mean, variance, ..Pixel::default() }).collect();
    Ok((format!("reference {}", path.display()), Arc::new(Film { width: w, height: h, pixels })))
}

/// Serves the page and renders, until the program is interrupted.
pub(crate) fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let interrupt = Interrupt::new()?;
    let image = &options.image;
    if image.spp.is_some() {
        return Err("--spp: `etendue view` takes samples as long as it runs; --error or --time end them".into());
    }
    let reading = Reading::new(image)?;
    let settings = reading.settings;
    let goal = Goal { seconds: options.time, error: options.error };
    let sampler = image.sampler.unwrap_or_else(|| default_sampler(USUAL, settings.sets));
    let plan = Refinement { settings, sampler: Some(sampler), goal };
    plan.check().map_err(|what| format!("--{}: {what}", goal.option()))?;
    let reference = options.reference.as_ref().map(|path| reference(path, &settings)).transpose()?;
    let inputs = &reading.scene.inputs;
    let output = options.output.as_ref().map(|path| Output::of(path.clone(), inputs)).transpose()?.map(Arc::new);

    let server = Server::new(options.port)?;
    let pool = pool(image.threads)?;
    let shared = Arc::new(Shared::new(Worker::state(Way { technique: settings.technique, sampler }), reference));
    if let Some(output) = &output {
        interrupt.watch(&bar(0, ""), &output.exr);
    }
    let address = server.address();
    let said = if server.port() == options.port {
        String::new()
    } else {
        format!("port {} is in use, so the page is on port {}\n", options.port, server.port())
    };
    let text = format!("{said}{} is shown at\n{}\nCtrl-C ends it\n", reading.scene.name, address);
    let asked = Arc::clone(&shared);
    server.serve(move |path, request| answer::answer(&asked, path, request))?;
    {
        // not locked longer than that
        let mut out = out();
        out.write_all(text.as_bytes())?;
        out.flush()?;
    }
    if !options.no_open
        && let Err(what) = browser::open(&address)
    {
        say(format_args!("no browser was opened, since {what}: open the address above yourself"));
    }
    Worker { image, goal, pool: &pool, output, interrupt: &interrupt }.run(reading, &shared)
}
