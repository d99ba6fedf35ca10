//! Reads `Material` and `MakeNamedMaterial`.

use super::given::Given;
pub(super) use super::mixtures::Finish;
use super::mixtures::{Mixture, pane};
use super::params::shown;
use super::spectrum::{self, Named};
use super::textures::{Textures, Value};
use crate::list::PBRT;
use crate::material_table::MaterialTable;
use crate::message::shortened;
use crate::nearest::did_you_mean;
use crate::radiance::rounded;
use etendue_render::scene::texture::Texture;
use etendue_render::scene::{Material, Message, Roughness, Varying};

/// What a material is read with, and what its parameters refer to.
pub(super) struct Context<'a> {
    pub(super) textures: &'a Textures,
    pub(super) named: &'a dyn Fn(&str) -> Option<Finish>,
    pub(super) materials: &'a mut MaterialTable,
    pub(super) given: Given<'a>,
}

/// The materials that may have a normal map.
const MAPPED: [&str; 5] = ["diffuse", "coateddiffuse", "coatedconductor", "conductor", "diffusetransmission"];

/// Reads the parameters of a material. What direct light on opaque surfaces cannot show becomes a stand-in.
pub(super) fn read(kind: &str, mut context: Context<'_>, mixtures: &mut Vec<Mixture>) -> Result<Finish, Message> {
    let stand_in = |given: &mut Given<'_>, what: &str| given.stand_in(kind, format!("becomes {what}"));
    let normals = if MAPPED.contains(&kind) { context.textures.normals(&mut context.given)? } else { None };
    let read = match kind {
        "diffuse" | "matte" => {
            let name = if kind == "matte" { "Kd" } else { "reflectance" };
            context.diffuse(&[name], 0.5)?
        }
        "mirror" => Material::Mirror(context.constant("Kr", 0.9)?),
        "conductor" | "metal" => context.conductor(["eta", "k", "reflectance"], "")?,
        "coatedconductor" => context.coated_conductor()?,
        "coateddiffuse" => context.coated_diffuse(&["reflectance"])?,
        "plastic" | "uber" | "substrate" | "translucent" => {
            if kind == "translucent" {
                stand_in(&mut context.given, "opaque");
            }
            context.older_coat(kind)?
        }
        "disney" => {
            stand_in(&mut context.given, "its base colour, metallic and roughness");
            context.disney()?
        }
        "dielectric" | "thindielectric" | "glass" => {
            let read = context.dielectric()?;
            if let Material::Conductor { eta: [eta, ..], .. } = read
                && read.is_mirror()
            {
                let what = "a pane without refraction, which reflects at all angles what it does at normal incidence";
                stand_in(&mut context.given, what);
                return Ok(pane(reflectance_of(eta.into()), kind == "thindielectric", mixtures));
            }
            stand_in(&mut context.given, "what it reflects: light that passes through it is lost");
            read
        }
        "diffusetransmission" => {
            stand_in(&mut context.given, "what it reflects: light that passes through it is lost");
            let scale = context.given.float("scale")?.unwrap_or(1.0);
            let is_right = (0.0..=f64::from(f32::MAX)).contains(&scale);
            context.given.bound("scale", scale, is_right, "finite and at least 0")?;
            let albedo = context.color(&["reflectance"], 0.25)?.times(Texture::number(scale as f32));
            albedo
                .constant()
                .map_or_else(|| context.materials.vary(Varying::Diffuse(albedo.clone())), Material::Diffuse)
        }
        "subsurface" | "kdsubsurface" => {
            stand_in(&mut context.given, "a coat over a diffuse surface");
            context.coated_diffuse(&["reflectance", "Kd"])?
        }
        "hair" | "measured" | "fourier" => {
            stand_in(&mut context.given, "diffuse of albedo 0.5");
            Material::Diffuse([0.5; 3])
        }
        "mix" => return context.mixed(mixtures),
        "interface" | "none" | "" => return Ok(Finish::Invisible),
        _ => {
            let (kinds, near) = (PBRT.kinds("Material").join(", "), did_you_mean(kind, PBRT.kinds("Material")));
            let kind = shortened(kind);
            return Err(context.given.error(format!("material type {kind:?} is not supported, only {kinds}{near}")));
        }
    };
    Ok(Finish::Of(normals.map_or(read, |normals| context.materials.relief(read, normals))))
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
    fn color(&mut self, names: &[&str], default: f32) -> Result<Texture, Message> {
        let mut found = None;
        for name in names {
            found = found.or(self.textures.color(name, &mut self.given)?);
        }
        Ok(found.unwrap_or(Texture::number(default)))
    }
    fn diffuse(&mut self, names: &[&str], default: f32) -> Result<Material, Message> {
        let albedo = self.color(names, default)?;
        // a constant may exceed 1, which a texture may not
        Ok(albedo.constant().map_or_else(|| self.materials.vary(Varying::Diffuse(albedo.clone())), Material::Diffuse))
    }
    /// A colour that is the same everywhere, or the mean of one that is not.
    fn constant(&mut self, name: &str, default: f32) -> Result<[f32; 3], Message> {
        let texture = self.color(&[name], default)?;
        if texture.constant().is_none() {
            self.given.stand_in(name, format!("{name:?} becomes its mean"));
        }
        Ok(texture.mean())
    }
    /// An index of refraction, the same for all wavelengths.
    fn eta(&mut self, names: &[&str]) -> Result<f64, Message> {
        for name in names {
            if self.given.is_texture(name) {
                let texture = self.textures.number(name, &mut self.given)?;
                self.given.stand_in(name, format!("{name:?} becomes its mean"));
                return Ok(texture.map_or(1.5, |texture| texture.mean()[0].into()));
            }
            if let Some(index) = Textures::index(name, &mut self.given)? {
                let are_right = index.iter().all(|x| (1e-3..=1e3).contains(x));
                return self.given.bound(name, index[1], are_right, "from 1e-3 to 1e3");
            }
        }
        Ok(1.5)
    }
    /// An index of refraction of a coat, at least 1.
    fn coat_eta(&mut self, names: &[&str]) -> Result<f32, Message> {
        let eta = self.eta(names)?;
        if eta < 1.0 {
            self.given.warn(format!("the index of refraction {} of its coat counts as 1", shown(eta)));
        }
        Ok(eta.max(1.0) as f32)
    }
    /// A coat over a diffuse base, with the light that goes back and forth between them.
    fn coated_diffuse(&mut self, names: &[&str]) -> Result<Material, Message> {
        let diffuse = self.color(names, 0.5)?;
        let eta = self.coat_eta(&["eta"])?;
        let roughness = self.coat_roughness(0.0)?;
        Ok(self.materials.vary(Varying::Layered { diffuse, eta, roughness }))
    }
    /// A coat over a metal. What varies becomes its mean.
    fn coated_conductor(&mut self) -> Result<Material, Message> {
        let coat = self.coat_eta(&["interface.eta"])?;
        // both roughnesses have the same flag
        let params = self.given.params.clone();
        let above = self.roughness("interface.", 0.0)?;
        *self.given.params = params;
        for name in ["interface.roughness", "interface.uroughness", "interface.vroughness"] {
            self.given.given(name);
        }
        let names = ["conductor.eta", "conductor.k", "reflectance"];
        let metal = self.conductor(names, "conductor.")?;
        let mut varies = above.iter().any(|alpha| alpha.constant().is_none());
        let interface = of_means(&above);
        let (eta, k, roughness) = match metal {
            Material::Conductor { eta, k, roughness } => (eta, k, roughness),
            other => {
                varies = true;
                let mean = self.materials.mean(other);
                let specular = if let Material::Glossy { specular, .. } = mean { specular } else { [0.5; 3] };
                let k = specular.map(|r| index_of_reflectance(f64::from(r)) as f32);
                ([1.0; 3], k, mean.roughness().unwrap_or(0.0.into()))
            }
        };
        if varies {
            self.given.stand_in("coatedconductor", "its textures become their means");
        }
        if interface.is_smooth() && !roughness.is_smooth() {
            self.warn_of_smooth_coat();
        }
        Ok(Material::CoatedConductor { eta, k, roughness, coat, interface })
    }
    /// The roughness α along u and across, from up to three parameters whose names begin with `prefix`.
    fn roughness(&mut self, prefix: &str, default: f32) -> Result<[Texture; 2], Message> {
        let names = ["roughness", "uroughness", "vroughness"].map(|name| format!("{prefix}{name}"));
        let varies = names.iter().any(|name| self.given.is_texture(name));
        if varies {
            let mut number = |name: &str| self.textures.number(name, &mut self.given);
            let both = number(&names[0])?.unwrap_or(Texture::number(default));
            let each = [number(&names[1])?.unwrap_or(both.clone()), number(&names[2])?.unwrap_or(both)];
            let remap = self.given.flag("remaproughness")?.unwrap_or(true);
            return Ok(each.map(|texture| if remap { texture.root() } else { texture }));
        }
        let both = self.given.float(&names[0])?.unwrap_or(default.into());
        let each = [self.given.float(&names[1])?.unwrap_or(both), self.given.float(&names[2])?.unwrap_or(both)];
        for x in each {
            self.given.bound(&names[0], x, x >= 0.0, "from 0 to 1")?;
            if x > 1.0 {
                self.given.warn(format!("\"{prefix}roughness\": {} counts as 1", shown(x)));
            }
        }
        let remap = self.given.flag("remaproughness")?.unwrap_or(true);
        Ok(each.map(|x| x.min(1.0)).map(|x| Texture::number(if remap { x.sqrt() } else { x } as f32)))
    }
    /// A rough coat over a diffuse base.
    fn coated(
        &mut self,
        diffuse: Texture,
        Coat { specular, grazing }: Coat,
        roughness: f32,
    ) -> Result<Material, Message> {
        let roughness = self.coat_roughness(roughness)?;
        Ok(self.materials.vary(Varying::Glossy { diffuse, specular, grazing, roughness, turn: 0.0, greatest: false }))
    }
    /// The roughness of a coat: a smooth one is not quite smooth.
    fn coat_roughness(&mut self, default: f32) -> Result<[Texture; 2], Message> {
        let roughness = self.roughness("", default)?;
        if roughness.iter().any(|alpha| alpha.constant().is_some_and(|[x, ..]| x < Roughness::LEAST)) {
            self.warn_of_smooth_coat();
        }
        Ok(roughness)
    }
    fn warn_of_smooth_coat(&mut self) {
        let what = format!("its smooth coat becomes one of roughness α = {}", Roughness::LEAST);
        self.given.stand_in("smooth coat", what);
    }
    /// pbrt-v3's coats, by the reflectances of both layers.
    fn older_coat(&mut self, kind: &str) -> Result<Material, Message> {
        let default = if kind == "substrate" { 0.5 } else { 0.25 };
        let (base, coat) = (self.color(&["Kd"], default)?, self.color(&["Ks"], default)?);
        // Ks is a factor of a dielectric's reflectance, or for a substrate that at normal incidence
        let coat = match kind {
            "substrate" => Coat { specular: coat, grazing: Texture::number(1.0) },
            _ => Coat { specular: coat.clone().times(Texture::number(0.04)), grazing: coat },
        };
        self.coated(base, coat, 0.1)
    }
    fn disney(&mut self) -> Result<Material, Message> {
        let base = self.color(&["color"], 0.5)?;
        let mut number = |name: &str, default: f32| {
            let found = self.textures.number(name, &mut self.given)?;
            Ok::<_, Message>(found.unwrap_or(Texture::number(default)))
        };
        let (metallic, roughness) = (number("metallic", 0.0)?, number("roughness", 0.5)?);
        Ok(self.materials.vary(Varying::Metallic { base, metallic, roughness }))
    }
    fn dielectric(&mut self) -> Result<Material, Message> {
        let eta = self.eta(&["eta", "index"])?;
        let roughness = self.roughness("", 0.0)?;
        Ok(match constant(&roughness) {
            Some(roughness) => Material::Conductor { eta: [eta as f32; 3], k: [0.0; 3], roughness },
            None => self.metal(Texture::number(reflectance_of(eta) as f32), roughness),
        })
    }
    /// A mixture of two materials.
    fn mixed(&mut self, mixtures: &mut Vec<Mixture>) -> Result<Finish, Message> {
        let Context { textures, named, given, .. } = self;
        let names = given.texts("materials")?;
        let older = [given.text("namedmaterial1")?, given.text("namedmaterial2")?];
        let names = names.unwrap_or_else(|| older.into_iter().flatten().collect());
        // a float in pbrt-v4, a spectrum in v3
        let amount = if given.is_texture("amount") {
            textures.number("amount", given)?
        } else {
            textures.color("amount", given)?.map(|amount| amount.channel(1))
        };
        let amount = amount.unwrap_or(Texture::number(0.5));
        let [first, second] = &names[..] else {
            return Err(given.error(format!("needs two \"materials\", not {}", names.len())));
        };
        let mut of = [Finish::Of(Material::Diffuse([0.5; 3])); 2];
        for (finish, name) in of.iter_mut().zip([first, second]) {
            match named(name) {
                Some(known) => *finish = known,
                None => given.misspelt(format!(
                    "no MakeNamedMaterial {:?} precedes this: a diffuse surface of albedo 0.5 stands for it",
                    shortened(name)
                )),
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
    fn conductor(&mut self, [eta, k, reflectance]: [&str; 3], prefix: &str) -> Result<Material, Message> {
        let reflectance = self.textures.color_or_texture(reflectance, &mut self.given)?;
        let indices = [Textures::index(eta, &mut self.given)?, Textures::index(k, &mut self.given)?];
        let roughness = self.roughness(prefix, 0.0)?;
        let (eta, k) = match (reflectance, indices) {
            (Some(_), [Some(_), _] | [_, Some(_)]) => {
                return Err(self.given.error("\"reflectance\" cannot be combined with \"eta\" and \"k\""));
            }
            (Some(Value::Varying(specular)), _) => {
                return Ok(self.metal(specular, roughness));
            }
            (Some(Value::Constant(r)), _) if constant(&roughness).is_none() => {
                return Ok(self.metal(Texture::Constant(r.map(|x| x as f32)), roughness));
            }
            (Some(Value::Constant(r)), _) => {
                for x in r {
                    self.given.bound("reflectance", x, x <= 1.0, "at most 1")?;
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
            let too_large = || self.given.error(format!("{name:?}: {rgb:?} is too large: must be less than 1e9"));
            rounded(rgb).filter(|c| c.iter().all(|&x| x < 1e9)).ok_or_else(too_large)
        };
        let (eta, k) = (bounded("eta", eta)?, bounded("k", k)?);
        match constant(&roughness) {
            Some(roughness) => Ok(Material::Conductor { eta, k, roughness }),
            None => {
                // r = ((η − 1)² + k²)/((η + 1)² + k²) at normal incidence
                let of = |i: usize| ((eta[i] - 1.0).powi(2) + k[i] * k[i]) / ((eta[i] + 1.0).powi(2) + k[i] * k[i]);
                Ok(self.metal(Texture::Constant([of(0), of(1), of(2)]), roughness))
            }
        }
    }
    /// A rough metal with this reflectance at normal incidence.
    fn metal(&mut self, specular: Texture, roughness: [Texture; 2]) -> Material {
        let [diffuse, grazing] = [0.0, 1.0].map(Texture::number);
        self.materials.vary(Varying::Glossy { diffuse, specular, grazing, roughness, turn: 0.0, greatest: false })
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
