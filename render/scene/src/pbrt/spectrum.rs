//! Spectra as linear RGB.
//!
//! The renderer works with three channels of linear sRGB. A spectrum becomes a colour by the colour matching functions of CIE 1931, between
//! whose values at every 5 nm there are straight lines, summed at every 1 nm from 360 to 830 nm. This differs from the table at 1 nm by at most
//! 0.4 % of a channel.

mod cie;

use super::inputs::Files;
use crate::message::shown;
use crate::radiance::luminance;
use cie::{FIRST, ILLUMINANTS, MATCHING, STEP};
use std::path::Path;

/// CIE 1931's functions and the illuminant D65 at a wavelength in nanometres.
fn matching(wavelength: f64) -> [f64; 4] {
    let at = ((wavelength - FIRST) / STEP).clamp(0.0, (MATCHING.len() - 1) as f64);
    let before = (at as usize).min(MATCHING.len() - 2);
    let (t, [a, b]) = (at - before as f64, [MATCHING[before], MATCHING[before + 1]]);
    std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t)
}

/// Linear sRGB of CIE XYZ (IEC 61966-2-1).
pub(super) fn srgb([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.240_969_94 * x - 1.537_383_18 * y - 0.498_610_76 * z,
        -0.969_243_64 * x + 1.875_967_5 * y + 0.041_555_06 * z,
        0.055_630_08 * x - 0.203_976_96 * y + 1.056_971_51 * z,
    ]
}

/// XYZ of a spectrum by wavelength, from 360 to 830 nm in steps of 1 nm.
fn integrated(spectrum: impl Fn(f64) -> f64) -> [f64; 3] {
    (360..=830).fold([0.0; 3], |sum, nm| {
        let (wavelength, weights) = (f64::from(nm), matching(f64::from(nm)));
        let value = spectrum(wavelength);
        std::array::from_fn(|k| sum[k] + weights[k] * value)
    })
}

/// Planck's law, in any unit. Temperatures are in kelvins.
fn planck(wavelength: f64, temperature: f64) -> f64 {
    // second radiation constant in nm K; the exponent is about 1.4e7/(λT)
    let x = 1.438_776_877e7 / (wavelength * temperature);
    1e14 / (wavelength.powi(5) * libm::expm1(x))
}

/// The illuminant D65.
fn white(wavelength: f64) -> f64 {
    matching(wavelength)[3]
}

/// A spectrum by wavelength and value, in ascending order of wavelengths in nanometres, with straight lines between them.
#[derive(Clone, Debug)]
pub(super) struct Samples(Vec<[f64; 2]>);

impl Samples {
    /// From pairs of a wavelength and a value.
    pub(super) fn new(numbers: &[f64]) -> Result<Self, String> {
        if numbers.is_empty() || !numbers.len().is_multiple_of(2) {
            return Err(format!("a spectrum needs pairs of wavelength and value, not {} numbers", numbers.len()));
        }
        let pairs: Vec<[f64; 2]> = numbers.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
        if let Some([_, x]) = pairs.iter().find(|[at, x]| !(x.is_finite() && *x >= 0.0 && at.is_finite())) {
            return Err(format!("the values of a spectrum must be finite and at least 0, not {}", shown(*x)));
        }
        if let Some(two) = pairs.windows(2).find(|two| two[1][0] <= two[0][0]) {
            return Err(format!("wavelengths must ascend: {} follows {}", shown(two[1][0]), shown(two[0][0])));
        }
        Ok(Self(pairs))
    }
    /// From a file of lines with a wavelength and a value; `#` begins a comment.
    pub(super) fn read(path: &Path, files: &Files<'_>) -> Result<Self, String> {
        let shown = path.display().to_string();
        let bytes = files.read(path).map_err(|error| format!("cannot read {shown:?}: {error}"))?;
        let text = String::from_utf8_lossy(&bytes);
        let mut numbers = Vec::new();
        for (line, text) in text.lines().enumerate() {
            for word in text.split('#').next().unwrap_or_default().split_whitespace() {
                let number = word.parse::<f64>().map_err(|_| format!("{shown}:{}: {word:?} is no number", line + 1))?;
                numbers.push(number);
            }
        }
        Self::new(&numbers).map_err(|why| format!("{shown}: {why}"))
    }
    /// The value at a wavelength; beyond the ends it is 0, as in pbrt.
    fn at(&self, wavelength: f64) -> f64 {
        let after = self.0.partition_point(|[at, _]| *at <= wavelength);
        match (after.checked_sub(1).and_then(|before| self.0.get(before)), self.0.get(after)) {
            (Some([a, x]), Some([b, y])) => x + (y - x) * (wavelength - a) / (b - a),
            (Some([at, x]), None) if *at == wavelength => *x,
            _ => 0.0,
        }
    }
    /// The colour of a surface with this reflectance, or of any other quantity that is averaged over the wavelengths of each channel.
    pub(super) fn reflectance(&self) -> [f64; 3] {
        let (seen, light) = (srgb(integrated(|at| self.at(at) * white(at))), srgb(integrated(white)));
        std::array::from_fn(|k| (seen[k] / light[k]).max(0.0))
    }
    /// The colour of light with this spectrum, of luminance 1: as in pbrt-v4, only its form counts.
    pub(super) fn illuminant(&self) -> [f64; 3] {
        normalized(integrated(|at| self.at(at)))
    }
}

/// A colour of luminance 1, without what is beyond sRGB's gamut.
fn normalized(xyz: [f64; 3]) -> [f64; 3] {
    let rgb = srgb(xyz).map(|x| x.max(0.0));
    let y = luminance(rgb);
    if y > 0.0 { rgb.map(|x| x / y) } else { [0.0; 3] }
}

/// The colour of a black body, of luminance 1.
pub(super) fn blackbody(kelvins: f64) -> [f64; 3] {
    normalized(integrated(|at| planck(at, kelvins)))
}

/// Refractive indices η and k of metals and crystals, per channel.
///
/// Metals have the figures that are in use for RGB renderers, which come from Johnson and Christy (1972) and Palik (1985) and are not derived
/// anew here. The crystals have those of Sellmeier's formulas at 611, 549 and 464 nm: Stephens and Malitson (1952) for MgO, and DeVore
/// (1951) for the ordinary ray in TiO₂.
const METALS: [(&str, [f64; 3], [f64; 3]); 7] = [
    ("Ag", [0.1553, 0.1167, 0.1383], [4.8284, 3.1224, 2.1470]),
    ("Al", [1.6575, 0.8804, 0.5212], [9.2239, 6.2695, 4.8370]),
    ("Au", [0.1431, 0.3750, 1.4425], [3.9832, 2.3857, 1.6032]),
    ("Cu", [0.2004, 0.9240, 1.1022], [3.9129, 2.4528, 2.1421]),
    ("CuZn", [0.4440, 0.5270, 1.0940], [3.6950, 2.7650, 1.8290]),
    ("MgO", [1.7360, 1.7406, 1.7502], [0.0, 0.0, 0.0]),
    ("TiO2", [2.5973, 2.6490, 2.7787], [0.0, 0.0, 0.0]),
];

/// Refractive indices of glasses by pbrt-v4's names, at 587.6 nm (data sheets of Schott); its "glass-F5" is SF5, and so on.
const GLASSES: [(&str, f64); 7] = [
    ("BK7", 1.5168),
    ("BAF10", 1.67),
    ("FK51A", 1.4866),
    ("LASF9", 1.8503),
    ("F5", 1.6727),
    ("F10", 1.7283),
    ("F11", 1.7847),
];

/// What a named spectrum stands for.
pub(super) enum Named {
    /// An index of refraction or an absorption coefficient, per channel.
    Index([f64; 3]),
    /// Light of luminance 1.
    Illuminant([f64; 3]),
}

/// The spectrum that pbrt-v4 knows by a name.
pub(super) fn named(name: &str) -> Option<Named> {
    if let Some(glass) = name.strip_prefix("glass-") {
        let found = GLASSES.iter().find(|(known, _)| *known == glass)?;
        return Some(Named::Index([found.1; 3]));
    }
    if let Some((metal, which)) = name.strip_prefix("metal-").and_then(|rest| rest.rsplit_once('-')) {
        let (_, eta, k) = METALS.iter().find(|(known, ..)| *known == metal)?;
        return match which {
            "eta" => Some(Named::Index(*eta)),
            "k" => Some(Named::Index(*k)),
            _ => None,
        };
    }
    let illuminant = name.strip_prefix("stdillum-").or_else(|| name.strip_prefix("illum-"))?;
    if illuminant == "D65" {
        return Some(Named::Illuminant([1.0; 3]));
    }
    let (_, [x, y]) = ILLUMINANTS.iter().find(|(known, _)| *known == illuminant)?;
    Some(Named::Illuminant(normalized([x / y, 1.0, (1.0 - x - y) / y])))
}
