//! Reads `Material` and `MakeNamedMaterial`.

use super::inputs::Files;
pub(super) use super::mixtures::Finish;
use super::mixtures::{Mixture, pane};
use super::params::{Params, shown};
use super::spectrum::{self, Named};
use super::textures::{Textures, Value};
use crate::builder::Builder;
use crate::list::PBRT;
use crate::message::shortened;
use crate::nearest::did_you_mean;
use crate::radiance::rounded;
use etendue_render::scene::texture::Texture;
use etendue_render::scene::{Material, Message, Roughness, Varying};

/// What a material's parameters refer to.
pub(super) struct Context<'a> {
    pub(super) textures: &'a Textures,
    pub(super) named: &'a dyn Fn(&str) -> Option<Finish>,
    pub(super) files: Files<'a>,
}

/// The materials that may have a normal map.
const MAPPED: [&str; 5] = ["diffuse", "coateddiffuse", "coatedconductor", "conductor", "diffusetransmission"];

/// Reads the parameters of a material. What direct light on opaque surfaces cannot show becomes a stand-in.
pub(super) fn read(
    kind: &str,
    params: &mut Params,
    context: &Context<'_>,
    mixtures: &mut Vec<Mixture>,
    out: &mut Builder,
) -> Result<Finish, Message> {
    let stand_in = |out: &mut Builder, params: &Params, what: &str| {
        out.notes.stand_in(kind, || params.error(format!("becomes {what}")));
    };
    let normals =
        if MAPPED.contains(&kind) { context.textures.normals(params, &context.files, &mut out.notes)? } else { None };
    let read = match kind {
        "diffuse" | "matte" => {
            let name = if kind == "matte" { "Kd" } else { "reflectance" };
            context.diffuse(&[name], 0.5, params, out)?
        }
        "mirror" => Material::Mirror(context.constant("Kr", 0.9, params, out)?),
        "conductor" | "metal" => context.conductor(["eta", "k", "reflectance"], "", params, out)?,
        "coatedconductor" => context.coated_conductor(params, out)?,
        "coateddiffuse" => context.coated_diffuse(&["reflectance"], params, out)?,
        "plastic" | "uber" | "substrate" | "translucent" => {
            if kind == "translucent" {
                stand_in(out, params, "opaque");
            }
            context.older_coat(kind, params, out)?
        }
        "disney" => {
            stand_in(out, params, "its base colour, metallic and roughness");
            context.disney(params, out)?
        }
        "dielectric" | "thindielectric" | "glass" => {
            let read = context.dielectric(params, out)?;
            if let Material::Conductor { eta: [eta, ..], .. } = read
                && read.is_mirror()
            {
                let what = "a pane without refraction, which reflects at all angles what it does at normal incidence";
                stand_in(out, params, what);
                return Ok(pane(reflectance_of(eta.into()), kind == "thindielectric", mixtures));
            }
            stand_in(out, params, "what it reflects: light that passes through it is lost");
            read
        }
        "diffusetransmission" => {
            stand_in(out, params, "what it reflects: light that passes through it is lost");
            let scale = params.float("scale")?.unwrap_or(1.0);
            if !(0.0..=f64::from(f32::MAX)).contains(&scale) {
                return Err(params.error(format!("\"scale\": must be finite and at least 0, not {}", shown(scale))));
            }
            let albedo = context.color(&["reflectance"], 0.25, params, out)?.times(Texture::number(scale as f32));
            albedo.constant().map_or_else(|| out.materials.vary(Varying::Diffuse(albedo.clone())), Material::Diffuse)
        }
        "subsurface" | "kdsubsurface" => {
            stand_in(out, params, "a coat over a diffuse surface");
            context.coated_diffuse(&["reflectance", "Kd"], params, out)?
        }
        "hair" | "measured" | "fourier" => {
            stand_in(out, params, "diffuse of albedo 0.5");
            Material::Diffuse([0.5; 3])
        }
        "mix" => return context.mixed(params, mixtures, out),
        "interface" | "none" | "" => return Ok(Finish::Invisible),
        _ => {
            let (kinds, near) = (PBRT.kinds("Material").join(", "), did_you_mean(kind, PBRT.kinds("Material")));
            let kind = shortened(kind);
            return Err(params.error(format!("material type {kind:?} is not supported, only {kinds}{near}")));
        }
    };
    Ok(Finish::Of(normals.map_or(read, |normals| out.materials.relief(read, normals))))
}

/// Reflectance at normal incidence on a smooth dielectric.
fn reflectance_of(eta: f64) -> f64 {
    let ratio = (eta - 1.0) / (eta + 1.0);
    ratio * ratio
}

/// The reflectances of a coat at normal and at grazing incidence.
struct Coat {
    specular: Texture,
    grazing: Texture,
}

/// The k of a metal of this reflectance at normal incidence and η = 1: r = k²/(k² + 4).
fn index_of_reflectance(r: f64) -> f64 {
    let r = r.min(MOST_REFLECTANCE);
    2.0 * (r / (1.0 - r)).sqrt()
}

/// The greatest reflectance that is converted to an index of refraction: pbrt's limit.
const MOST_REFLECTANCE: f64 = 0.9999;

impl Context<'_> {
    /// The colour of the first of these names that is given.
    fn color(&self, names: &[&str], default: f32, params: &mut Params, out: &mut Builder) -> Result<Texture, Message> {
        let Context { textures, files, .. } = self;
        let mut found = None;
        for name in names {
            found = found.or(textures.color(name, params, files, &mut out.notes)?);
        }
        Ok(found.unwrap_or(Texture::number(default)))
    }
    fn diffuse(
        &self,
        names: &[&str],
        default: f32,
        params: &mut Params,
        out: &mut Builder,
    ) -> Result<Material, Message> {
        let albedo = self.color(names, default, params, out)?;
        // a constant may exceed 1, which a texture may not
        Ok(albedo.constant().map_or_else(|| out.materials.vary(Varying::Diffuse(albedo.clone())), Material::Diffuse))
    }
    /// A colour that is the same everywhere, or the mean of one that is not.
    fn constant(&self, name: &str, default: f32, params: &mut Params, out: &mut Builder) -> Result<[f32; 3], Message> {
        let texture = self.color(&[name], default, params, out)?;
        if texture.constant().is_none() {
            out.notes.stand_in(name, || params.error(format!("{name:?} becomes its mean")));
        }
        Ok(texture.mean())
    }
    /// An index of refraction, the same for all wavelengths.
    fn eta(&self, names: &[&str], params: &mut Params, out: &mut Builder) -> Result<f64, Message> {
        let Context { textures, files, .. } = self;
        for name in names {
            if params.is_texture(name) {
                let texture = textures.number(name, params, &mut out.notes)?;
                out.notes.stand_in(name, || params.error(format!("{name:?} becomes its mean")));
                return Ok(texture.map_or(1.5, |texture| texture.mean()[0].into()));
            }
            if let Some(index) = Textures::index(name, params, files)? {
                if index.iter().all(|x| (1e-3..=1e3).contains(x)) {
                    return Ok(index[1]);
                }
                return Err(params.error(format!("{name:?}: must be from 1e-3 to 1e3, not {}", shown(index[1]))));
            }
        }
        Ok(1.5)
    }
    /// An index of refraction of a coat, at least 1.
    fn coat_eta(&self, names: &[&str], params: &mut Params, out: &mut Builder) -> Result<f32, Message> {
        let eta = self.eta(names, params, out)?;
        if eta < 1.0 {
            out.notes.warn(params.error(format!("the index of refraction {} of its coat counts as 1", shown(eta))));
        }
        Ok(eta.max(1.0) as f32)
    }
    /// A coat over a diffuse base, with the light that goes back and forth between them.
    fn coated_diffuse(&self, names: &[&str], params: &mut Params, out: &mut Builder) -> Result<Material, Message> {
        let diffuse = self.color(names, 0.5, params, out)?;
        let eta = self.coat_eta(&["eta"], params, out)?;
        let roughness = self.coat_roughness(0.0, params, out)?;
        Ok(out.materials.vary(Varying::Layered { diffuse, eta, roughness }))
    }
    /// A coat over a metal. What varies becomes its mean.
    fn coated_conductor(&self, params: &mut Params, out: &mut Builder) -> Result<Material, Message> {
        let coat = self.coat_eta(&["interface.eta"], params, out)?;
        // both roughnesses have the same flag
        let above = self.roughness("interface.", 0.0, &mut params.clone(), out)?;
        for name in ["interface.roughness", "interface.uroughness", "interface.vroughness"] {
            params.given(name);
        }
        let names = ["conductor.eta", "conductor.k", "reflectance"];
        let metal = self.conductor(names, "conductor.", params, out)?;
        let mut varies = above.iter().any(|alpha| alpha.constant().is_none());
        let interface = of_means(&above);
        let (eta, k, roughness) = match metal {
            Material::Conductor { eta, k, roughness } => (eta, k, roughness),
            other => {
                varies = true;
                let mean = out.materials.mean(other);
                let specular = if let Material::Glossy { specular, .. } = mean { specular } else { [0.5; 3] };
                let k = specular.map(|r| index_of_reflectance(f64::from(r)) as f32);
                ([1.0; 3], k, mean.roughness().unwrap_or(0.0.into()))
            }
        };
        if varies {
            out.notes.stand_in("coatedconductor", || params.error("its textures become their means"));
        }
        if interface.is_smooth() && !roughness.is_smooth() {
            self.warn_of_smooth_coat(params, out);
        }
        Ok(Material::CoatedConductor { eta, k, roughness, coat, interface })
    }
    /// The roughness α along u and across, from up to three parameters whose names begin with `prefix`.
    fn roughness(
        &self,
        prefix: &str,
        default: f32,
        params: &mut Params,
        out: &mut Builder,
    ) -> Result<[Texture; 2], Message> {
        let names = ["roughness", "uroughness", "vroughness"].map(|name| format!("{prefix}{name}"));
        let varies = names.iter().any(|name| params.is_texture(name));
        if varies {
            let mut number = |name: &str| self.textures.number(name, params, &mut out.notes);
            let both = number(&names[0])?.unwrap_or(Texture::number(default));
            let each = [number(&names[1])?.unwrap_or(both.clone()), number(&names[2])?.unwrap_or(both)];
            let remap = params.flag("remaproughness")?.unwrap_or(true);
            return Ok(each.map(|texture| if remap { texture.root() } else { texture }));
        }
        let both = params.float(&names[0])?.unwrap_or(default.into());
        let each = [params.float(&names[1])?.unwrap_or(both), params.float(&names[2])?.unwrap_or(both)];
        for x in each {
            if x.is_nan() || x < 0.0 {
                return Err(params.error(format!("\"{prefix}roughness\": must be from 0 to 1, not {}", shown(x))));
            }
            if x > 1.0 {
                out.notes.warn(params.error(format!("\"{prefix}roughness\": {} counts as 1", shown(x))));
            }
        }
        let remap = params.flag("remaproughness")?.unwrap_or(true);
        Ok(each.map(|x| x.min(1.0)).map(|x| Texture::number(if remap { x.sqrt() } else { x } as f32)))
    }
    /// A rough coat over a diffuse base.
    fn coated(
        &self,
        diffuse: Texture,
        Coat { specular, grazing }: Coat,
        roughness: f32,
        params: &mut Params,
        out: &mut Builder,
    ) -> Result<Material, Message> {
        let roughness = self.coat_roughness(roughness, params, out)?;
        Ok(out.materials.vary(Varying::Glossy { diffuse, specular, grazing, roughness, turn: 0.0, greatest: false }))
    }
    /// The roughness of a coat: a smooth one is not quite smooth.
    fn coat_roughness(&self, default: f32, params: &mut Params, out: &mut Builder) -> Result<[Texture; 2], Message> {
        let roughness = self.roughness("", default, params, out)?;
        if roughness.iter().any(|alpha| alpha.constant().is_some_and(|[x, ..]| x < Roughness::LEAST)) {
            self.warn_of_smooth_coat(params, out);
        }
        Ok(roughness)
    }
    fn warn_of_smooth_coat(&self, params: &Params, out: &mut Builder) {
        out.notes.stand_in("smooth coat", || {
            params.error(format!("its smooth coat becomes one of roughness α = {}", Roughness::LEAST))
        });
    }
    /// pbrt-v3's coats, by the reflectances of both layers.
    fn older_coat(&self, kind: &str, params: &mut Params, out: &mut Builder) -> Result<Material, Message> {
        let default = if kind == "substrate" { 0.5 } else { 0.25 };
        let (base, coat) = (self.color(&["Kd"], default, params, out)?, self.color(&["Ks"], default, params, out)?);
        // Ks is a factor of a dielectric's reflectance, or for a substrate that at normal incidence
        let coat = match kind {
            "substrate" => Coat { specular: coat, grazing: Texture::number(1.0) },
            _ => Coat { specular: coat.clone().times(Texture::number(0.04)), grazing: coat },
        };
        self.coated(base, coat, 0.1, params, out)
    }
    fn disney(&self, params: &mut Params, out: &mut Builder) -> Result<Material, Message> {
        let base = self.color(&["color"], 0.5, params, out)?;
        let mut number = |name: &str, default: f32, params: &mut Params| {
            let found = self.textures.number(name, params, &mut out.notes)?;
            Ok::<_, Message>(found.unwrap_or(Texture::number(default)))
        };
        let (metallic, roughness) = (number("metallic", 0.0, params)?, number("roughness", 0.5, params)?);
        Ok(out.materials.vary(Varying::Metallic { base, metallic, roughness }))
    }
    fn dielectric(&self, params: &mut Params, out: &mut Builder) -> Result<Material, Message> {
        let eta = self.eta(&["eta", "index"], params, out)?;
        let roughness = self.roughness("", 0.0, params, out)?;
        Ok(match constant(&roughness) {
            Some(roughness) => Material::Conductor { eta: [eta as f32; 3], k: [0.0; 3], roughness },
            None => self.metal(Texture::number(reflectance_of(eta) as f32), roughness, out),
        })
    }
    /// A mixture of two materials.
    fn mixed(&self, params: &mut Params, mixtures: &mut Vec<Mixture>, out: &mut Builder) -> Result<Finish, Message> {
        let Context { textures, named, files } = self;
        let names = params.texts("materials")?;
        let older = [params.text("namedmaterial1")?, params.text("namedmaterial2")?];
        let names = names.unwrap_or_else(|| older.into_iter().flatten().collect());
        // a float in pbrt-v4, a spectrum in v3
        let amount = if params.is_texture("amount") {
            textures.number("amount", params, &mut out.notes)?
        } else {
            textures.color("amount", params, files, &mut out.notes)?.map(|amount| amount.channel(1))
        };
        let amount = amount.unwrap_or(Texture::number(0.5));
        let [first, second] = &names[..] else {
            return Err(params.error(format!("needs two \"materials\", not {}", names.len())));
        };
        let mut of = [Finish::Of(Material::Diffuse([0.5; 3])); 2];
        for (finish, name) in of.iter_mut().zip([first, second]) {
            match named(name) {
                Some(known) => *finish = known,
                None => out.notes.misspelt(params.error(format!(
                    "no MakeNamedMaterial {:?} precedes this: a diffuse surface of albedo 0.5 stands for it",
                    shortened(name)
                ))),
            }
        }
        Ok(match amount.constant() {
            Some([x, ..]) if x <= 0.0 => of[0],
            Some([x, ..]) if x >= 1.0 => of[1],
            _ => {
                mixtures.push(Mixture { of, amount });
                Finish::Mix(mixtures.len() - 1)
            }
        })
    }
    fn conductor(
        &self,
        [eta, k, reflectance]: [&str; 3],
        prefix: &str,
        params: &mut Params,
        out: &mut Builder,
    ) -> Result<Material, Message> {
        let Context { textures, files, .. } = self;
        let given = textures.color_or_texture(reflectance, params, files, &mut out.notes)?;
        let indices = [Textures::index(eta, params, files)?, Textures::index(k, params, files)?];
        let roughness = self.roughness(prefix, 0.0, params, out)?;
        let (eta, k) = match (given, indices) {
            (Some(_), [Some(_), _] | [_, Some(_)]) => {
                return Err(params.error("\"reflectance\" cannot be combined with \"eta\" and \"k\""));
            }
            (Some(Value::Varying(specular)), _) => {
                return Ok(self.metal(specular, roughness, out));
            }
            (Some(Value::Constant(r)), _) if constant(&roughness).is_none() => {
                return Ok(self.metal(Texture::Constant(r.map(|x| x as f32)), roughness, out));
            }
            (Some(Value::Constant(r)), _) => {
                if let Some(x) = r.iter().find(|&&x| x > 1.0) {
                    return Err(params.error(format!("\"reflectance\": must be at most 1, not {}", shown(*x))));
                }
                ([1.0; 3], r.map(index_of_reflectance))
            }
            // one of them alone goes with copper's other one, as in pbrt
            (None, [eta, k]) => {
                let copper = copper();
                (eta.unwrap_or(copper.0), k.unwrap_or(copper.1))
            }
        };
        // fourth powers must be finite in f32
        let bounded = |name: &str, rgb: [f64; 3]| {
            let too_large = || params.error(format!("{name:?}: {rgb:?} is too large: must be less than 1e9"));
            rounded(rgb).filter(|c| c.iter().all(|&x| x < 1e9)).ok_or_else(too_large)
        };
        let (eta, k) = (bounded("eta", eta)?, bounded("k", k)?);
        match constant(&roughness) {
            Some(roughness) => Ok(Material::Conductor { eta, k, roughness }),
            None => {
                // r = ((η − 1)² + k²)/((η + 1)² + k²) at normal incidence
                let of = |i: usize| ((eta[i] - 1.0).powi(2) + k[i] * k[i]) / ((eta[i] + 1.0).powi(2) + k[i] * k[i]);
                Ok(self.metal(Texture::Constant([of(0), of(1), of(2)]), roughness, out))
            }
        }
    }
    /// A rough metal with this reflectance at normal incidence.
    fn metal(&self, specular: Texture, roughness: [Texture; 2], out: &mut Builder) -> Material {
        let [diffuse, grazing] = [0.0, 1.0].map(Texture::number);
        out.materials.vary(Varying::Glossy { diffuse, specular, grazing, roughness, turn: 0.0, greatest: false })
    }
}

/// A metal's roughness that does not vary: smooth in both directions or in none.
fn constant([along, across]: &[Texture; 2]) -> Option<Roughness> {
    along.constant().and(across.constant())?;
    Some(of_means(&[along.clone(), across.clone()]))
}

/// The mean of a metal's roughness.
fn of_means(roughness: &[Texture; 2]) -> Roughness {
    let [along, across] = roughness.each_ref().map(|alpha| alpha.mean()[0].clamp(0.0, 1.0));
    let least = if along == across { 0.0 } else { LEAST_OF_METAL };
    Roughness { along: along.max(least), across: across.max(least), turn: 0.0 }
}

/// The least roughness in one direction of a metal that is rougher in the other, as in pbrt.
const LEAST_OF_METAL: f32 = 1e-4;

/// pbrt's default conductor.
fn copper() -> ([f64; 3], [f64; 3]) {
    let of = |name: &str| match spectrum::named(name) {
        Some(Named::Index(rgb)) => rgb,
        _ => unreachable!("a metal has indices"),
    };
    (of("metal-Cu-eta"), of("metal-Cu-k"))
}
