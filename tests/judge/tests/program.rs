//! The program: libraries and files of numbers, right and wrong, and those that are none.

use etendue_judge::lights::observe::ask;
use etendue_judge::lights::sampler::{Lacks, Prepared, own};
use etendue_judge::numbers::{Array, Asked};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

struct Folder(PathBuf);
impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("judge-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
    /// A library of the sphere in C, with a fault.
    fn library(&self, fault: &str) -> PathBuf {
        let (out, root) = (self.0.join(format!("lib{fault}.so")), Path::new(env!("CARGO_MANIFEST_DIR")));
        let mut cc = Command::new("cc");
        cc.args(["-O1", "-shared", "-fPIC", "-Wall", "-Wextra", "-D"]).arg(format!("FAULT={fault}"));
        let built = cc.arg("-o").arg(&out).arg(root.join("tests/sphere.c")).arg("-lm").output().expect("a C compiler");
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        out
    }
}
impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
fn judge(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_etendue-judge")).args(arguments).output().unwrap()
}
/// Runs the program, whose exit code and words have to be these.
fn says(arguments: &[&str], code: i32, said: &str) -> String {
    let output = judge(arguments);
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    println!("{}", text.chars().take(1500).collect::<String>());
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {text}");
    assert!(text.contains(said), "{said:?} is not in {text}");
    text
}

#[test]
fn a_library_is_judged() {
    let folder = Folder::new("library");
    let library = |fault: &str| folder.library(fault).display().to_string();
    let page = folder.0.join("page.html").display().to_string();
    says(&["run", &library("RIGHT"), "--quick", "--page", &page], 0, "cone: right (");
    assert!(fs::read_to_string(&page).unwrap().contains("Speed against accuracy"));
    // wrong where it is small
    let text = says(&["run", &library("PDF"), "--json"], 1, "\"figure\": \"Density\"");
    assert!(text.contains("wrong by up to 1.0 % where the light's size is at most 1/"), "{text}");
    // which it may say
    says(&["run", &library("HALF"), "--quick"], 0, "where the light is larger than 1/300");
    says(&["run", &library("NOT_A_NUMBER"), "--quick"], 1, "are no numbers");
    says(&["run", &library("LOUD"), "--quick"], 0, "cone: right (");
}

/// What a sampler declares that it does not have is not judged, and the rest is.
#[test]
fn samplers_without_a_map_or_a_pdf_are_judged_by_what_is_left() {
    let folder = Folder::new("lacks");
    let library = |fault: &str| folder.library(fault).display().to_string();
    says(&["run", &library("REJECTION"), "--quick"], 0, "cone: right (");
    // undeclared, it would be a map
    says(&["run", &library("MAP"), "--quick"], 1, "parts of the square map to areas");
    says(&["run", &library("NO_PDF"), "--quick"], 0, "cone: right (");
    let path = folder.0.join("asked").display().to_string();
    let asked = folder.0.join("asked");
    let ask = ["ask", &path, "--shape", "triangle", "--measure", "solid angle", "--name", "a shader"];
    judge(&[&ask[..], &["--no-pdf", "--quick"]].concat());
    let [samples, _] = answer(&asked, "a shader", Lacks { map: false, pdf: true });
    samples.write(&asked.join("sample.npy")).unwrap();
    says(&["numbers", &path], 0, "a shader: right (");
    let half = samples.numbers.chunks(4).flat_map(|s| [s[0], s[1], s[2], 0.5 * s[3]]).collect();
    Array { numbers: half, ..samples }.write(&asked.join("sample.npy")).unwrap();
    says(&["numbers", &path], 1, "irradiance is biased");
}

#[test]
fn grave_findings_come_first_and_none_has_the_error_0() {
    let folder = Folder::new("order");
    let library = |fault: &str| folder.library(fault).display().to_string();
    let text = says(&["run", &library("MANY"), "--quick"], 1, "the pdf of samples is wrong");
    let said = ["irradiance is biased", "directions miss the light", "the pdf of samples is wrong"];
    let places = said.map(|said| text.find(said));
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}: {text}");
    for fault in ["MANY", "MAP", "ABORT", "PDF"] {
        let text = says(&["run", &library(fault), "--quick"], 1, "**wrong**");
        assert!(!text.contains("0.0e0"), "{text}");
    }
}

#[test]
fn what_ends_the_process_is_a_finding() {
    let folder = Folder::new("ends");
    let library = |fault: &str| folder.library(fault).display().to_string();
    says(&["run", &library("CRASH")], 1, "segmentation fault");
    says(&["run", &library("ABORT")], 1, "abort");
    let said = "signal 6 (abort), after the line \"sphere.c: the radius is no number\"";
    says(&["run", &library("SAYS_WHY")], 1, said);
    says(&["run", &library("HANG"), "--limit", "1"], 1, "does not end within 1 s");
}

#[test]
fn what_cannot_be_judged_is_said() {
    let folder = Folder::new("cannot");
    let library = |fault: &str| folder.library(fault).display().to_string();
    says(&["run", &library("OLD")], 2, "has ABI 0");
    says(&["run", &library("SHAPE")], 2, "shape 'torus' is none of sphere, triangle");
    says(&["run", &library("MISSING")], 2, "cone: prepare is null");
    says(&["run", &library("RIGHT"), "--only", "torus"], 2, "no sampler's name contains 'torus'");
    says(&["run", "/nowhere/libnone.so"], 2, "no such file");
    let text = folder.0.join("text.so");
    fs::write(&text, "no library").unwrap();
    says(&["run", &text.display().to_string()], 2, "is no library");
    let empty = folder.0.join("libempty.so");
    let c = folder.0.join("empty.c");
    fs::write(&c, "int nothing;").unwrap();
    assert!(Command::new("cc").args(["-shared", "-fPIC", "-o"]).arg(&empty).arg(&c).status().unwrap().success());
    says(&["run", &empty.display().to_string()], 2, "does not export etendue_judge_samplers");
    says(&["run"], 2, "required");
}

/// Answers what a folder asks by a technique of the core.
fn answer(folder: &Path, name: &str, lacks: Lacks) -> [Array; 2] {
    let mut asked = Asked::new(name, "triangle", "solid angle", true, 1).unwrap();
    asked.lacks = lacks;
    etendue_judge::numbers::ask(folder, &asked).unwrap();
    let subject = own().into_iter().find(|s| s.name == "etendue triangle by SolidAngle").unwrap();
    let (mut samples, mut pdfs) = (Vec::new(), Vec::new());
    let direction = Array::read(&folder.join("direction.npy")).unwrap();
    let all = asked.places();
    let d = direction.shape[1];
    for (i, (place, _, questions)) in all.iter().enumerate() {
        let Prepared::Ready(sampler) = (subject.prepare)(&place.light) else { panic!("the core prepares all") };
        for s in ask(&*sampler, questions, lacks).samples {
            let s = s.map_or([0.0; 4], |s| [s.direction[0], s.direction[1], s.direction[2], s.pdf]);
            samples.extend(s);
        }
        let w = &direction.numbers[i * d * 3..(i + 1) * d * 3];
        pdfs.extend(w.chunks(3).map(|w| sampler.pdf([w[0], w[1], w[2]])));
    }
    let m = all[0].2.us.len();
    [Array { shape: vec![all.len(), m, 4], numbers: samples }, Array { shape: vec![all.len(), d], numbers: pdfs }]
}

#[test]
fn files_of_numbers_are_judged() {
    let folder = Folder::new("numbers");
    let path = folder.0.display().to_string();
    let [samples, pdfs] = answer(&folder.0, "a shader", Lacks::default());
    says(&["numbers", &path], 2, "sample.npy");
    let write = |samples: &Array, pdfs: &Array| {
        samples.write(&folder.0.join("sample.npy")).unwrap();
        pdfs.write(&folder.0.join("pdf.npy")).unwrap();
    };
    write(&samples, &pdfs);
    says(&["numbers", &path], 0, "a shader: right (");
    // one percent
    let more = Array { numbers: pdfs.numbers.iter().map(|p| p * 1.01).collect(), ..pdfs.clone() };
    write(&samples, &more);
    says(&["numbers", &path], 1, "does not integrate to 1");
    let mut not = samples.clone();
    not.numbers[7] = f32::NAN;
    write(&not, &pdfs);
    says(&["numbers", &path], 1, "are no numbers");
    let less = Array { shape: vec![1, pdfs.numbers.len()], ..pdfs.clone() };
    write(&samples, &less);
    says(&["numbers", &path], 2, "the shape is [1, ");
    fs::write(folder.0.join("pdf.npy"), b"\x93NUMPY\x01\x00\x10\x00{'descr': '<i4'}").unwrap();
    says(&["numbers", &path], 2, "not float32 or float64");
    fs::write(folder.0.join("pdf.npy"), "text").unwrap();
    says(&["numbers", &path], 2, "is no .npy file");
    says(&["ask", &path, "--shape", "torus"], 2, "shape 'torus'");
    says(&["ask", &path, "--shape", "disk", "--measure", "length"], 2, "measure 'length'");
}

#[test]
fn arrays_are_read_as_they_were_written() {
    let folder = Folder::new("arrays");
    for shape in [vec![6], vec![2, 3], vec![1, 2, 3]] {
        let array = Array { shape, numbers: vec![1.0, -2.5, 0.0, f32::MAX, 1e-42, 3.0] };
        array.write(&folder.0.join("a.npy")).unwrap();
        assert_eq!(Array::read(&folder.0.join("a.npy")).unwrap(), array);
    }
}
