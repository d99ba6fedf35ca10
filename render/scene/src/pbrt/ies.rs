//! Reads photometric data of luminaires: IES files, ANSI/IES LM-63 of 1986 to 2019.
//!
//! The intensity is candela value × multiplier × ballast factor, and × the ballast-lamp factor in files of before 2002; at its place, later
//! ones have something else. In light space −y is the nadir, and the photometric horizontal is +x.
//!
//! The factors of `TILT`, by which some lamps are dimmer when the luminaire is tilted, are ignored: a scene does not know where the ground is.
//!
//! The vertical angles of the photometric type C, which luminaires for rooms and streets have, are from the nadir, and its horizontal ones from the
//! photometric horizontal, counterclockwise seen from above. Floodlights have type B, and headlamps type A: their beam, at 0° of both angles, is
//! where the nadir of type C is, and their right side at the photometric horizontal. With the beam a, the right side p and the upper side u, the
//! angles V and H are those of sin V u + cos V (cos H a + sin H p) in type A, and of sin H p + cos H (cos V a + sin V u) in type B (LM-75).

use super::inputs::Files;
use crate::distribution::Aim;
use crate::message::shown;
use etendue_render::scene::intensity::{Intensity, Profile};

/// The intensity of a luminaire.
#[derive(Debug)]
pub(super) struct Photometry {
    /// Relative intensity in the space of its profile.
    pub(super) intensity: Intensity,
    /// The greatest intensity in candela.
    pub(super) greatest: f64,
    /// How it lies in light space.
    pub(super) aim: Aim,
    /// What of the file is ignored.
    pub(super) warnings: Vec<String>,
}

/// The numbers of a file, one after the other.
struct Numbers<'a> {
    name: &'a str,
    words: Vec<(usize, &'a str)>,
    next: usize,
}

impl Numbers<'_> {
    fn error(&self, line: usize, what: impl AsRef<str>) -> String {
        format!("{}:{line}: {}", self.name, what.as_ref())
    }
    /// The line of the number that was read last.
    fn line(&self) -> usize {
        self.words.get(self.next.saturating_sub(1)).map_or(0, |(line, _)| *line)
    }
    fn left(&self) -> usize {
        self.words.len() - self.next
    }
    fn number(&mut self, what: &str) -> Result<f64, String> {
        let Some(&(line, word)) = self.words.get(self.next) else {
            let last = self.words.last().map_or(0, |(line, _)| *line);
            return Err(self.error(last, format!("the file ends before {what}")));
        };
        self.next += 1;
        match word.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(self.error(line, format!("{what}: expected a finite number, found {word:?}"))),
        }
    }
    fn within(&mut self, what: &str, low: f64, high: f64) -> Result<f64, String> {
        let x = self.number(what)?;
        if (low..=high).contains(&x) {
            return Ok(x);
        }
        let range = if high == f64::MAX { format!("at least {low}") } else { format!("from {low} to {high}") };
        Err(self.error(self.line(), format!("{what}: must be {range}, not {}", shown(x))))
    }
    /// A number of things that the file has yet to list.
    fn count(&mut self, what: &str) -> Result<usize, String> {
        let x = self.number(what)?;
        if x.fract() == 0.0 && x >= 1.0 && x <= self.left() as f64 {
            return Ok(x as usize);
        }
        let left = self.left();
        Err(self.error(self.line(), format!("{what}: must be from 1 to the {left} numbers left, not {}", shown(x))))
    }
    /// Ascending angles.
    fn angles(&mut self, count: usize, what: &str, low: f64, high: f64) -> Result<Vec<f32>, String> {
        let mut angles = Vec::with_capacity(count);
        for _ in 0..count {
            let angle = self.within(what, low, high)? as f32;
            if let Some(before) = angles.last().filter(|before| **before >= angle) {
                return Err(self.error(self.line(), format!("{what}s must ascend: {angle} follows {before}")));
            }
            angles.push(angle);
        }
        Ok(angles)
    }
}

/// Columns of a table by azimuth.
type Columns = Vec<(f32, Vec<f64>)>;

/// The columns and their mirror image about the first or last of them, in ascending order.
fn mirrored(columns: Columns, about: f32) -> Columns {
    let image = |(angle, column): &(f32, Vec<f64>)| (2.0 * about - angle, column.clone());
    let mut all: Columns = columns.iter().filter(|(angle, _)| *angle != about).map(image).collect();
    all.extend(columns);
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

impl Header {
    /// The candela values, column by column.
    fn columns(&self, angles: &[f32], numbers: &mut Numbers<'_>) -> Result<Columns, String> {
        let mut column = || -> Result<Vec<f64>, String> {
            (0..self.rows).map(|_| numbers.within("candela value", 0.0, f64::MAX)).collect()
        };
        angles.iter().map(|angle| Ok((*angle, column()?))).collect()
    }
    /// The same for the types A and B: polar angles are the vertical angles of type A, or the horizontal ones of type B, plus 90 degrees. What begins
    /// at 0 is symmetric.
    fn beam(&self, numbers: &mut Numbers<'_>) -> Result<(Vec<f32>, Columns), String> {
        let vertical = numbers.angles(self.rows, "vertical angle", -90.0, 90.0)?;
        let horizontal = numbers.angles(self.columns, "horizontal angle", -90.0, 90.0)?;
        let line = numbers.line();
        let mut columns = self.columns(&horizontal, numbers)?;
        if columns[0].0 == 0.0 {
            columns = mirrored(columns, 0.0);
        }
        // by rows as well
        let row = |k: usize| columns.iter().map(|(_, column)| column[k]).collect();
        let mut rows: Columns = vertical.iter().enumerate().map(|(k, angle)| (*angle, row(k))).collect();
        if rows[0].0 == 0.0 {
            rows = mirrored(rows, 0.0);
        }
        let horizontal: Vec<f32> = columns.iter().map(|(angle, _)| *angle).collect();
        let (polar, table) = if self.kind == Kind::B {
            (horizontal, rows)
        } else {
            let vertical = rows.iter().map(|(angle, _)| *angle).collect();
            let column = |k: usize| (horizontal[k], rows.iter().map(|(_, row)| row[k]).collect());
            (vertical, (0..horizontal.len()).map(column).collect())
        };
        if polar.len() < 2 {
            let which = if self.kind == Kind::B { "horizontal" } else { "vertical" };
            return Err(numbers.error(line, format!("a single {which} angle: at least two are needed")));
        }
        Ok((polar.into_iter().map(|angle| angle + 90.0).collect(), table))
    }
}

/// Reads the file with this name.
pub(super) fn read(name: &str, files: &Files<'_>) -> Result<Photometry, String> {
    let bytes = files.read(&files.find(name)).map_err(|error| format!("cannot read {name:?}: {error}"))?;
    parse(&String::from_utf8_lossy(&bytes), name)
}

/// Words of a text with the numbers of their lines, after so many lines.
fn words(text: &str, after: usize) -> Vec<(usize, &str)> {
    let separates = |c: char| c.is_whitespace() || c == ',' || c == '\u{1a}';
    (1..)
        .zip(text.lines())
        .skip(after)
        .flat_map(|(line, text)| text.split(separates).filter(|word| !word.is_empty()).map(move |word| (line, word)))
        .collect()
}

/// Skips the data of `TILT`.
fn skip_tilt(numbers: &mut Numbers<'_>) -> Result<(), String> {
    numbers.number("lamp-to-luminaire geometry")?;
    for _ in 0..2 * numbers.count("number of tilt angles")? {
        numbers.number("tilt angle or factor")?;
    }
    Ok(())
}

/// The photometric types.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    A,
    B,
    C,
}

impl Kind {
    /// The axes of the space of the profile. In light space −y is the nadir or the beam, +x the photometric horizontal or the right side, and −z
    /// what is then the upper side.
    fn aim(self) -> Aim {
        Aim {
            axes: match self {
                Self::C => [(0, 1.0), (2, 1.0), (1, -1.0)],
                // the pole is the lower side, and azimuths go from the beam to the right
                Self::A => [(1, -1.0), (0, 1.0), (2, 1.0)],
                // the pole is the left side, and azimuths go from the beam up
                Self::B => [(1, -1.0), (2, -1.0), (0, -1.0)],
            },
        }
    }
}

/// What the first lines of numbers tell of the table that follows.
struct Header {
    rows: usize,
    columns: usize,
    kind: Kind,
    /// What candela values are multiplied by.
    factor: f64,
}

impl Header {
    /// Reads it from a file of 2002 or later if `is_late`.
    fn read(numbers: &mut Numbers<'_>, is_late: bool) -> Result<Self, String> {
        numbers.number("number of lamps")?;
        numbers.number("lumens per lamp")?;
        let multiplier = numbers.within("multiplier", 0.0, f64::MAX)?;
        let rows = numbers.count("number of vertical angles")?;
        let columns = numbers.count("number of horizontal angles")?;
        let number = numbers.number("photometric type")?;
        let kinds = [(1.0, Kind::C), (2.0, Kind::B), (3.0, Kind::A)];
        let Some((_, kind)) = kinds.into_iter().find(|(known, _)| *known == number) else {
            let what = format!("photometric type: must be 1, 2 or 3, for C, B or A, not {}", shown(number));
            return Err(numbers.error(numbers.line(), what));
        };
        for what in ["units", "width", "length", "height"] {
            numbers.number(what)?;
        }
        let ballast = numbers.within("ballast factor", 0.0, f64::MAX)?;
        let lamp = numbers.number("ballast-lamp factor")?;
        numbers.number("input watts")?;
        let factor = multiplier * ballast * if is_late { 1.0 } else { lamp };
        if !(0.0..=f64::MAX).contains(&factor) {
            return Err(numbers.error(numbers.line(), format!("its factors multiply to {}", shown(factor))));
        }
        // all angles and values must be there before memory is taken
        let needed = rows.saturating_mul(columns).saturating_add(rows).saturating_add(columns);
        if needed > numbers.left() {
            let line = numbers.words.last().map_or(0, |(line, _)| *line);
            let what = format!(
                "{rows} vertical and {columns} horizontal angles need {needed} numbers, but {} are left",
                numbers.left()
            );
            return Err(numbers.error(line, what));
        }
        Ok(Self { rows, columns, kind, factor })
    }

    /// The vertical angles in degrees, and the columns of all azimuths: those of the file and their mirror images.
    fn table(&self, numbers: &mut Numbers<'_>) -> Result<(Vec<f32>, Columns), String> {
        if self.kind != Kind::C {
            return self.beam(numbers);
        }
        let polar = numbers.angles(self.rows, "vertical angle", 0.0, 180.0)?;
        if self.rows < 2 {
            return Err(numbers.error(numbers.line(), "a single vertical angle: at least two are needed"));
        }
        let azimuth = numbers.angles(self.columns, "horizontal angle", 0.0, 360.0)?;
        let line = numbers.line();
        let mut columns = self.columns(&azimuth, numbers)?;
        let ends = [azimuth[0], azimuth[self.columns - 1]];
        let columns = match ends {
            _ if self.columns == 1 => vec![(0.0, columns.swap_remove(0).1)],
            [0.0, 90.0] => mirrored(mirrored(columns, 90.0), 180.0),
            [0.0, 180.0] => mirrored(columns, 180.0),
            [0.0, 360.0] => columns,
            [90.0, 270.0] => {
                mirrored(columns, 270.0).into_iter().map(|(angle, column)| (angle - 360.0, column)).collect()
            }
            [first, last] => {
                let may = "0 to 90, 180 or 360, or from 90 to 270";
                return Err(
                    numbers.error(line, format!("horizontal angles from {first} to {last}: must be from {may}"))
                );
            }
        };
        Ok((polar, columns))
    }
}

/// What a line says of `TILT`, in capitals, if it does.
fn tilt(line: &str) -> Option<String> {
    let (keyword, value) = line.split_once('=')?;
    keyword.trim().eq_ignore_ascii_case("TILT").then(|| value.trim().to_ascii_uppercase())
}

/// Reads the text of a file that messages call `name`.
pub(super) fn parse(text: &str, name: &str) -> Result<Photometry, String> {
    // lines end with CR, LF or both, and keywords are written in any case
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace('\r', "\n");
    let Some((line, tilt)) = (1..).zip(text.lines()).find_map(|(line, text)| Some((line, tilt(text)?))) else {
        return Err(format!("{name}: no line begins with TILT=, after which an IES file has its numbers"));
    };
    let mut numbers = Numbers { name, words: words(&text, line), next: 0 };
    let mut warnings = Vec::new();
    if tilt != "NONE" {
        warnings.push(format!("{name}:{line}: the factors of TILT are ignored"));
    }
    if tilt == "INCLUDE" {
        skip_tilt(&mut numbers)?;
    }
    let first = text.lines().next().unwrap_or_default().to_ascii_uppercase();
    let is_late = ["LM-63-2002", "LM-63-2019"].iter().any(|year| first.contains(year));
    let header = Header::read(&mut numbers, is_late)?;
    let (polar, columns) = header.table(&mut numbers)?;
    if numbers.left() > 0 {
        warnings.push(format!("{name}: {} numbers after the last candela value are ignored", numbers.left()));
    }
    let greatest = columns.iter().flat_map(|(_, column)| column).fold(0.0, |most: f64, &x| most.max(x));
    let unit = if greatest > 0.0 { greatest } else { 1.0 };
    let values: Vec<f32> = columns.iter().flat_map(|(_, column)| column.iter().map(|x| (x / unit) as f32)).collect();
    let azimuth: Vec<f32> = columns.iter().map(|(angle, _)| *angle).collect();
    // angles that differ by too little are the same once they are mirrored
    let profile = Profile::new(polar, azimuth, values).map_err(|error| format!("{name}: {error}"))?;
    let intensity = Intensity::Angles(profile);
    Ok(Photometry { intensity, greatest: greatest * header.factor, aim: header.kind.aim(), warnings })
}
