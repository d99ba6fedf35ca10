//! Images whose parts are rendered by processes of their own: `plan`, parts that are killed, repeated, damaged or foreign, and `merge`.

use super::{Folder, until};
use std::fs::{self, DirEntry};
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

/// The stages of a plan, as lists of arguments.
fn plan(folder: &Folder, arguments: &[&str]) -> Vec<Vec<Vec<String>>> {
    let text = folder.succeed(&[&["plan"], arguments].concat());
    let command = |line: &str| line.split(' ').skip(1).map(str::to_owned).collect();
    text.split("\n\n").map(|stage| stage.lines().map(command).collect()).collect()
}

fn run(folder: &Folder, command: &[String]) -> String {
    folder.succeed(&command.iter().map(String::as_str).collect::<Vec<_>>())
}

/// The folder of the file that a command writes, and the file.
fn target(command: &[String]) -> (&str, &str) {
    let path = command.iter().skip_while(|word| *word != "-o").nth(1).unwrap();
    (path.rsplit_once('/').map_or(".", |(folder, _)| folder), path)
}

const IMAGE: [&str; 7] = ["quads", "--size", "64x48", "--spp", "64", "--seed", "5"];

#[test]
fn a_plan_makes_the_image_of_a_single_process() {
    for (more, stages, tasks) in [
        (&["--sampler", "sobol", "--tasks", "6"][..], 2, 6),
        (&["--sampler", "independent", "--tasks", "4", "--parts", "some parts"], 2, 4),
        (&["--tasks", "6"], 4, 6),
    ] {
        let folder = Folder::new();
        let single: Vec<&str> = more.iter().copied().take_while(|word| *word != "--tasks").collect();
        folder.succeed(&[&["render"], &IMAGE[..], &single, &["-o", "single.exr"]].concat());
        let text = folder.succeed(&[&["plan"], &IMAGE[..], more, &["-o", "whole.exr"]].concat());
        let stage: Vec<&str> = text.split("\n\n").collect();
        assert_eq!((stage.len(), stage[0].lines().count()), (stages, tasks), "{text}");
        // the plan is a program for a shell, in any order within its stages
        for stage in stage {
            let lines: Vec<&str> = stage.lines().rev().collect();
            let shell = Command::new("sh").current_dir(&folder.0).arg("-ec").arg(lines.join("\n")).output().unwrap();
            assert!(shell.status.success() && shell.stderr.is_empty(), "{shell:?}");
        }
        let read = |name: &str| fs::read(folder.path(name)).unwrap();
        assert!(read("single.exr") == read("whole.exr") && read("single.png") == read("whole.png"), "{more:?}");
    }
}

/// A part of an image that the scene asks for can be rendered in parts.
#[test]
fn crops_have_parts() {
    let folder = Folder::new();
    let film =
        "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 32 \"integer pixelbounds\" [10 29 5 27]";
    let view = "LookAt 0 0 .5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 50";
    folder.write("crop.pbrt", format!("{film} {view} WorldBegin LightSource \"infinite\" \"rgb L\" [1 2 3]"));
    let image = ["crop.pbrt", "--spp", "16", "--sampler", "sobol"];
    folder.succeed(&[&["render"], &image[..], &["-o", "single.exr"]].concat());
    for stage in plan(&folder, &[&image[..], &["--tasks", "4", "-o", "whole.exr"]].concat()) {
        stage.iter().for_each(|command| drop(run(&folder, command)));
    }
    let read = |name: &str| fs::read(folder.path(name)).unwrap();
    assert!(read("single.exr") == read("whole.exr"));
    assert!(folder.succeed(&["compare", "single.exr", "whole.exr"]).contains("all values are equal"));
}

/// The tasks of a plan are lit by the same sky; one that cannot be read stops all before anything is written.
#[test]
fn a_plan_keeps_the_sky() {
    let folder = Folder::new();
    let mut sky = b"PF\n2 1\n-1.0\n".to_vec();
    sky.extend([1.0_f32, 0.5, 0.25, 0.0, 0.0, 0.125].iter().flat_map(|x| x.to_le_bytes()));
    fs::write(folder.path("a sky.pfm"), &sky).unwrap();
    let image = ["quads", "--size", "32x16", "--spp", "8", "--environment", "a sky.pfm"];
    folder.succeed(&[&["render"], &image[..], &["-o", "lit.exr"]].concat());
    folder.succeed(&["render", "quads", "--size", "32x16", "--spp", "8", "-o", "plain.exr"]);
    let text = folder.succeed(&[&["plan"], &image[..], &["--tasks", "2", "-o", "whole.exr"]].concat());
    let shell = Command::new("sh").current_dir(&folder.0).arg("-ec").arg(&text).output().unwrap();
    assert!(shell.status.success() && shell.stderr.is_empty(), "{text}\n{shell:?}");
    let read = |name: &str| fs::read(folder.path(name)).unwrap();
    assert!(read("lit.exr") == read("whole.exr") && read("lit.exr") != read("plain.exr"));
    let names = folder.names();
    let error = folder.fail(&["render", "quads", "--environment", "none.exr", "-o", "new.exr"]);
    assert!(error.contains("none.exr: cannot read"), "{error}");
    assert_eq!(folder.names(), names);
}

#[test]
fn parts_that_are_killed_repeated_or_damaged_lose_nothing() {
    let folder = Folder::new();
    let arguments = [&IMAGE[..], &["--sampler", "sobol", "--threads", "1"]].concat();
    folder.succeed(&[&["render"], &arguments[..], &["-o", "single.exr"]].concat());
    let stages = plan(&folder, &[&arguments[..], &["--tasks", "12", "-o", "whole.exr"]].concat());
    let [parts, merge] = [&stages[0], &stages[1]];

    // some are killed as they begin or while they write, some run twice at once
    for (i, command) in parts.iter().enumerate() {
        let spawn = || {
            let mut process = Command::new(env!("CARGO_BIN_EXE_etendue"));
            process.current_dir(&folder.0).args(command).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
        };
        let mut processes: Vec<_> = (0..=i % 2).map(|_| spawn()).collect();
        if i % 3 == 0 {
            let temporary = format!(".etendue-{}-", processes[0].id());
            let begins =
                |file: io::Result<DirEntry>| file.unwrap().file_name().to_string_lossy().starts_with(&temporary);
            let writes = || fs::read_dir(folder.path(target(command).0)).is_ok_and(|mut files| files.any(begins));
            until("it writes or has ended", || i == 0 || writes() || processes[0].try_wait().unwrap().is_some());
            let _ = processes[0].kill();
        }
        for process in &mut processes {
            let _ = process.wait();
        }
    }
    let (dir, missing) = target(&parts[7]);
    let missing = folder.path(missing);
    let _ = fs::remove_file(&missing);
    let error = folder.fail(&merge[0].iter().map(String::as_str).collect::<Vec<_>>());
    assert!(error.contains("lacks") && error.contains("--tile "), "{error}");
    assert!(!folder.path("whole.exr").exists());

    // what is there is kept, the rest is rendered
    for command in parts {
        let before = fs::read(folder.path(target(command).1)).ok();
        let said = run(&folder, command);
        assert_eq!(said.starts_with("kept "), before.is_some(), "{said}");
        assert!(before.is_none_or(|before| fs::read(folder.path(target(command).1)).unwrap() == before));
    }
    run(&folder, &merge[0]);
    let read = |name: &str| fs::read(folder.path(name)).unwrap();
    assert!(read("single.exr") == read("whole.exr"));

    // truncated parts are refused, all by name, and rendered again; the image stays
    let names = [&parts[2], &parts[9]].map(|command| target(command).1);
    for name in names {
        let bytes = read(name);
        fs::write(folder.path(name), &bytes[..bytes.len() / 2]).unwrap();
    }
    let merge: Vec<&str> = merge[0].iter().map(String::as_str).collect();
    let error = folder.fail(&merge);
    assert!(names.iter().all(|name| error.contains(name)), "{error}");
    assert!(read("single.exr") == read("whole.exr"));
    for command in [&parts[2], &parts[9]] {
        let output = folder.run(&command.iter().map(String::as_str).collect::<Vec<_>>());
        let [out, error] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert!(output.status.success() && out.starts_with("wrote ") && error.contains("rendered again"), "{error}");
    }

    // a copy is ignored
    fs::copy(folder.path(names[0]), folder.path(&format!("{dir}/copy.exr"))).unwrap();
    let said = folder.succeed(&merge);
    assert!(said.contains("ignored ") && read("single.exr") == read("whole.exr"), "{said}");
    // an image of what is there
    fs::remove_file(folder.path(&format!("{dir}/copy.exr"))).unwrap();
    fs::remove_file(&missing).unwrap();
    let partial = folder.succeed(&["merge", "--partial", "-o", "partial.exr", dir]);
    assert!(partial.contains("1 areas are missing") && folder.path("partial.png").is_file(), "{partial}");
    // no temporary file is left but those of killed processes
    let left = fs::read_dir(folder.path(dir)).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap());
    assert!(left.filter(|name| !name.ends_with(".exr")).all(|name| name.starts_with(".etendue-")));
}

#[test]
fn options_that_make_no_part_are_refused() {
    let folder = Folder::new();
    for (arguments, message) in [
        (
            &["render", "quads", "--spp", "64", "--tile", "0,0,16,16"][..],
            "the sampler adaptive takes its samples in two rounds",
        ),
        (&["render", "quads", "--spp", "6", "--tile", "0,0,8,16"], "multiples of 16, or the size of the image"),
        (&["render", "quads", "--spp", "6", "--tile", "0,0,16,160000"], "multiples of 16, or the size of the image"),
        (&["render", "quads", "--spp", "6", "--tile", "16,0,16,16"], "the first two less than the others"),
        (&["render", "quads", "--spp", "6", "--tile", "0,0,16"], "four numbers"),
        (&["render", "quads", "--spp", "6", "--pilot"], "only for --sampler adaptive"),
        (&["render", "quads", "--spp", "64", "--after", "no.exr"], "no.exr: cannot read"),
        (&["render", "quads", "--time", "1", "--tile", "0,0,16,16"], "cannot be used with"),
        (&["render", "quads", "--spp", "6", "--tile", "0,0,16,16", "-o", "part.png"], "must end in .exr"),
        (&["plan", "quads", "--spp", "16", "--tasks", "0", "-o", "a.exr"], "from 1 to 1000000"),
        (&["plan", "quads", "--spp", "16", "-o", "a.png"], "must end in .exr"),
        (&["plan", "quads", "--spp", "16", "-o", "nowhere/a.exr"], "the folder nowhere does not exist"),
        (&["merge", "-o", "a.exr", "nothing"], "nothing: cannot read"),
        (&["merge", "-o", "a.exr", "."], "there are no parts in this folder"),
    ] {
        let error = folder.fail(arguments);
        assert!(error.contains(message), "{arguments:?}: {error:?} should contain {message:?}");
        assert!(folder.names().is_empty(), "{arguments:?}: {:?}", folder.names());
    }
    // without a name, the image has that of `render`
    assert!(
        folder.succeed(&["plan", "quads", "--spp", "6", "--tasks", "1"]).ends_with(" merge -o quads.exr quads.parts\n")
    );
    // a part is not the pilot
    let render = ["render", "quads", "--size", "32x16", "--spp", "64"];
    folder.succeed(&[&render[..], &["--pilot", "--tile", "0,0,16,16", "-o", "pilot.exr"]].concat());
    let error = folder.fail(&[&render[..], &["--after", "pilot.exr", "-o", "a.exr"]].concat());
    assert!(error.contains("pilot.exr: not the whole pilot, which `etendue merge` makes of its parts"), "{error}");
    let error = folder.fail(&["merge", "-o", "a.exr", "pilot.exr"]);
    assert!(error.contains("the pilot lacks 1 part(s):\n--pilot --tile 16,0,32,16"), "{error}");
    folder.succeed(&["render", "quads", "--size", "32x16", "--spp", "6", "--tile", "0,0,16,16", "-o", "tile.exr"]);
    assert!(folder.fail(&[&render[..], &["--after", "tile.exr", "-o", "a.exr"]].concat()).contains("of another image"));
    assert!(folder.fail(&["merge", "-o", "pilot.exr", "pilot.exr"]).contains("this file is an input"));
}

/// Images of different seeds are averaged, and what must not be is refused. Neither an image that is read nor any other is replaced by a
/// part, but a part of another image is, and one that is damaged.
#[test]
fn images_are_averaged_and_kept() {
    let folder = Folder::new();
    let image = ["render", "quads", "--size", "32x16"];
    for (seed, spp) in [("1", "64"), ("2", "32"), ("3", "64")] {
        let name = format!("images/{seed}.exr");
        fs::create_dir_all(folder.path("images")).unwrap();
        folder.succeed(&[&image[..], &["--seed", seed, "--spp", spp, "-o", &name]].concat());
    }
    assert!(folder.succeed(&["merge", "-o", "mean.exr", "images"]).contains("from 3 files"));
    assert!(folder.path("mean.png").is_file());
    let error = folder.fail(&["merge", "-o", "images/3.exr", "images"]);
    assert!(error.contains("images/3.exr: this file is an input"), "{error}");
    folder.succeed(&["render", "quads", "--size", "32x16", "--error", "5%", "--seed", "4", "-o", "refined.exr"]);
    folder.succeed(&["merge", "-o", "more.exr", "mean.exr", "refined.exr"]);
    folder.succeed(&[&image[..], &["--seed", "5", "--depth", "1", "-o", "other.exr"]].concat());
    let error = folder.fail(&["merge", "-o", "b.exr", "images", "other.exr"]);
    let says = "other.exr: not of the same image as images/1.exr: its depth is 1, not 8";
    assert!(error.contains(says) && !folder.path("b.exr").exists(), "{error}");

    // an image of another program has no text
    let tile = ["--spp", "4", "--tile", "0,0,16,16", "-o", "a.exr"];
    fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/sky.exr"), folder.path("a.exr")).unwrap();
    let error = folder.fail(&["merge", "-o", "b.exr", "a.exr"]);
    assert!(error.contains("a.exr: not an image of etendue, nor a part of one"), "{error}");
    for name in ["a.exr", "other.exr"] {
        let before = fs::read(folder.path(name)).unwrap();
        let error = folder.fail(&[&image[..], &tile[..4], &["-o", name]].concat());
        assert!(error.contains(&format!("{name}: this is an image, which a part must not replace")), "{error}");
        assert!(fs::read(folder.path(name)).unwrap() == before);
    }
    fs::remove_file(folder.path("a.exr")).unwrap();
    folder.succeed(&[&image[..], &["--seed", "1"], &tile].concat());
    let before = fs::read(folder.path("a.exr")).unwrap();
    let said = folder.run(&[&image[..], &tile].concat());
    assert!(said.status.success() && fs::read(folder.path("a.exr")).unwrap() != before, "{said:?}");
}

/// No input of a part or a merge is written to, by whatever name it is given.
#[test]
fn parts_that_are_read_are_not_overwritten() {
    let folder = Folder::new();
    let image = ["render", "quads", "--size", "32x16", "--spp", "64"];
    folder.succeed(&[&image[..], &["--pilot", "-o", "parts/pilot.exr"]].concat());
    fs::hard_link(folder.path("parts/pilot.exr"), folder.path("same.exr")).unwrap();
    let absolute = folder.path("parts/pilot.exr");
    let before = fs::read(&absolute).unwrap();
    let mut names = vec!["parts/pilot.exr", "parts/../parts/pilot.exr", absolute.to_str().unwrap(), "same.exr"];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("parts/pilot.exr", folder.path("link.exr")).unwrap();
        names.push("link.exr");
    }
    let all = folder.names();
    let kept = || fs::read(&absolute).unwrap() == before && folder.names() == all;
    for name in &names {
        for (pilot, output) in [("parts/pilot.exr", name), (*name, &"parts/pilot.exr")] {
            let error = folder.fail(&[&image[..], &["--after", pilot, "-o", output]].concat());
            assert!(error.contains(&format!("{output}: the pilot is read from this file")) && kept(), "{error}");
        }
        let error = folder.fail(&["merge", "-o", "parts/pilot.exr", name]);
        assert!(error.contains("this file is an input: choose another name with -o") && kept(), "{error}");
    }
    // a part among those of a folder, and a part whose name is that of the PNG
    let error = folder.fail(&["merge", "-o", "parts/pilot.exr", "parts"]);
    assert!(error.contains("parts/pilot.exr: this file is an input") && kept(), "{error}");
    fs::copy(&absolute, folder.path("a.png")).unwrap();
    assert!(folder.fail(&["merge", "-o", "a.exr", "a.png"]).contains("a.png: this file is an input"));
    assert!(fs::read(folder.path("a.png")).unwrap() == before);
    // nor is an image that lies among its parts
    fs::remove_file(folder.path("a.png")).unwrap();
    folder.succeed(&["render", "quads", "--size", "32x16", "--spp", "4", "--tile", "0,0,32,16", "-o", "own/part.exr"]);
    folder.succeed(&["merge", "-o", "own/image.exr", "own"]);
    assert!(folder.fail(&["merge", "-o", "own/image.exr", "own"]).contains("own/image.exr: this file is an input"));
}
