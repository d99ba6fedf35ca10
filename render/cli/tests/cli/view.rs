//! `etendue view`: what its server answers, to whom, and what it renders meanwhile.

use super::viewer::{Viewer, picture, spp};
use super::{Folder, scene, until};
use etendue_render::Identity;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::Command;

#[test]
fn the_page_is_for_those_who_know_its_address() {
    let folder = Folder::new();
    let viewer = Viewer::new(&folder, &["quads"]);
    for (path, kind, part) in
        [("", "text/html", "view.js"), ("view.css", "text/css", "#image"), ("view.js", "text/javascript", "fetch")]
    {
        let answer = viewer.ask(path, "");
        assert!(answer.code == 200 && answer.head.contains(&format!("Content-Type: {kind}; ")), "{}", answer.head);
        assert!(answer.text().contains(part), "{path}");
        for header in ["Content-Security-Policy: default-src 'none'", "X-Content-Type-Options: nosniff", "no-store"] {
            assert!(answer.head.contains(header), "{}", answer.head);
        }
        assert!(!answer.head.to_lowercase().contains("access-control"), "{}", answer.head);
    }
    let (host, token) = (&viewer.host, &viewer.token);
    let port = host.split_once(':').unwrap().1;
    let code = |text: &str| viewer.send(text).code;
    let other = token.replace(|c: char| c.is_ascii_digit(), "x");
    for path in ["/", "/status", "/view.js", &format!("/{token}"), &format!("/{other}/"), &format!("/{}/", &token[1..])]
    {
        assert_eq!(code(&format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n")), 404, "{path}");
    }
    assert_eq!(viewer.ask("none", "").code, 404);
    let of_host = |host: &str| code(&format!("GET /{token}/status HTTP/1.1\r\nHost: {host}\r\n\r\n"));
    assert_eq!(of_host(&format!("localhost:{port}")), 200);
    for wrong in
        ["localhost", "127.0.0.1", "127.0.0.1:1", &format!("example.com:{port}"), &format!("{host}.example.com")]
    {
        assert_eq!(of_host(wrong), 403, "{wrong}");
    }
    assert_eq!(code(&format!("GET /{token}/status HTTP/1.1\r\n\r\n")), 400);
    assert_eq!(viewer.ask("status", &format!("Origin: http://{host}\r\n")).code, 200);
    for origin in ["null", "http://example.com", &format!("https://{host}"), &format!("http://localhost:{port}")] {
        assert_eq!(viewer.ask("status", &format!("Origin: {origin}\r\n")).code, 403, "{origin}");
    }
    // requests that are not the page's
    let head = format!("/{token}/status HTTP/1.1\r\nHost: {host}\r\n");
    assert_eq!(code(&format!("POST {head}\r\n")), 405);
    assert_eq!(code(&format!("GET {}\r\n", head.replace("status", "wish"))), 405);
    assert_eq!(code(&format!("GET {head}X: {}\r\n\r\n", "x".repeat(20_000))), 431);
    assert_eq!(viewer.wish(&" ".repeat(5000)).code, 413);
    assert_eq!(code("nonsense\r\n\r\n"), 400);
    assert_eq!(viewer.until("it goes on", |_| true)["scene"], "quads");
    // the token is another one each time
    let second = Viewer::new(&folder, &["quads"]);
    assert_ne!(token, &second.token);
}

#[test]
fn a_busy_port_is_passed_over() {
    let folder = Folder::new();
    let first = Viewer::new(&folder, &["quads"]);
    let port = first.host.split_once(':').unwrap().1;
    let second = Viewer::new(&folder, &["quads", "--port", port]);
    assert_ne!(first.host, second.host);
    let other = second.host.split_once(':').unwrap().1;
    let line = format!("port {port} is in use, so the page is on port {other}\n");
    assert!(second.said.starts_with(&line), "{}", second.said);
    // the last port has none after it; it does not matter who uses it
    let _last = std::net::TcpListener::bind("127.0.0.1:65535");
    let error = folder.fail(&["view", "quads", "--port", "65535"]);
    assert!(error.contains("--port 65535: port 65535 of 127.0.0.1 is in use: choose another one"), "{error}");
}

#[test]
fn clients_that_say_nothing_and_read_nothing_are_few() {
    let folder = Folder::new();
    let more = ["--size", "640x640", "--threads", "1", "--technique", "area", "--sampler", "sobol"];
    let viewer = Viewer::with(&folder, &[&["view", "quads"], &more[..]].concat());
    viewer.until("there is an image", |status| spp(status, "area", "sobol") > 0.0);
    // an image is more than what a connection takes that nobody reads
    let (token, host) = (&viewer.token, &viewer.host);
    let question = format!("GET /{token}/image?technique=area&sampler=sobol HTTP/1.1\r\nHost: {host}\r\n\r\n");
    let unread: Vec<TcpStream> = (0..4).map(|_| viewer.connect()).collect();
    for mut stream in &unread {
        stream.write_all(question.as_bytes()).unwrap();
    }
    // the program sends to all of them
    for mut stream in &unread {
        let mut begin = [0; 12];
        stream.read_exact(&mut begin).unwrap();
        assert_eq!(&begin, b"HTTP/1.1 200");
    }
    let refused = viewer.send(&question);
    assert!(refused.code == 503 && refused.text().contains("images"), "{}", refused.head);
    // connections that say nothing, or begin to
    let silent: Vec<TcpStream> = (0..40).map(|_| viewer.connect()).collect();
    for mut stream in silent.iter().step_by(2) {
        let _ = stream.write_all(b"GET /");
    }
    let refused = viewer.send(&question);
    assert!(refused.code == 503 && refused.text().contains("connections"), "{}", refused.head);
    // they are given up, and there is place for others
    until("somebody else is answered", || {
        let mut stream = viewer.connect();
        let _ = stream.write_all(format!("GET /{token}/status HTTP/1.1\r\nHost: {host}\r\n\r\n").as_bytes());
        let mut text = String::new();
        let _ = stream.read_to_string(&mut text);
        text.starts_with("HTTP/1.1 200")
    });
    // one that goes away makes room for another image
    drop(unread);
    until("an image is sent", || viewer.send(&question).code == 200);
}

#[test]
fn each_technique_and_sampler_keeps_its_samples() {
    let folder = Folder::new();
    let viewer = Viewer::new(&folder, &["quads", "--technique", "area"]);
    viewer.until("there is an image", |status| spp(status, "area", "adaptive") > 100.0);
    assert_eq!(viewer.wish("{\"technique\":\"brdf\",\"sampler\":\"independent\"}").code, 200);
    let then = viewer.until("there is another", |status| spp(status, "brdf", "independent") > 0.0);
    let kept = picture(&then, "area", "adaptive").unwrap().clone();
    let later = viewer.until("it goes on", |status| spp(status, "brdf", "independent") > 200.0);
    assert_eq!(picture(&later, "area", "adaptive"), Some(&kept));
    let (radiance, samples) = viewer.image("area", "adaptive");
    let sum: f64 = samples.iter().map(|n| f64::from(*n)).sum();
    assert_eq!(sum / 1024.0, kept["spp"].as_f64().unwrap());
    assert!(radiance.iter().all(|x| x.is_finite()) && radiance.iter().any(|x| *x > 0.1));
    assert_ne!(viewer.image("brdf", "independent").0, radiance);
    assert_eq!(viewer.ask("image?technique=area&sampler=sobol", "").code, 404);
    // it goes on where it was
    viewer.wish("{\"technique\":\"area\",\"sampler\":\"adaptive\"}");
    let before = kept["spp"].as_f64().unwrap();
    let more = viewer.until("it has more", |status| {
        let now = spp(status, "area", "adaptive");
        assert!(now >= before, "it began anew: {now} after {before} samples");
        now > before
    });
    assert!(more["pictures"].as_array().unwrap().len() == 2);
    let history = picture(&more, "area", "adaptive").unwrap()["history"].as_array().unwrap().clone();
    let rises = history.windows(2).all(|two| two[0][0].as_f64() < two[1][0].as_f64());
    assert!(rises && history.last().unwrap()[1].as_f64() < history[0][1].as_f64(), "{history:?}");
    // a part of the image: whole tiles, and no others
    viewer.wish("{\"paused\":true}");
    // a copy is written between passes: after the first one none is under way, and none begins before the second one
    let [still, later] = ["quads-view.exr", "quads-view-2.exr"].map(|copy| {
        viewer.wish("{\"save\":true}");
        let saved = viewer.until("a copy is written", |status| {
            status["message"].as_str().is_some_and(|message| message.contains(copy))
        });
        assert_eq!(saved["paused"], true);
        spp(&saved, "area", "adaptive")
    });
    assert_eq!(still, later);
    let (_, before) = viewer.image("area", "adaptive");
    assert_eq!(viewer.wish("{\"paused\":false,\"crop\":[20,3,21,4]}").code, 200);
    let cropped = viewer.until("the part has more", |status| spp(status, "area", "adaptive") > still);
    assert_eq!(cropped["crop"], json!([16, 0, 32, 16]));
    let (_, after) = viewer.image("area", "adaptive");
    for (i, (a, b)) in before.iter().zip(&after).enumerate() {
        assert_eq!(a < b, i % 32 >= 16 && i / 32 < 16, "pixel {i}: {a}, then {b}");
    }
}

/// A pass that takes long does not delay what is wished next: it is thrown away.
#[test]
fn a_wish_ends_the_pass() {
    let folder = Folder::new();
    let more = ["--size", "512x512", "--threads", "1", "--technique", "area"];
    let viewer = Viewer::with(&folder, &[&["view", "quads"], &more[..]].concat());
    let in_second = |status: &Value| (0.01..0.6).contains(&status["pass"].as_f64().unwrap());
    viewer.until("the second pass renders", |status| spp(status, "area", "adaptive") == 2.0 && in_second(status));
    viewer.wish("{\"technique\":\"brdf\",\"sampler\":\"sobol\"}");
    let other = viewer.until("there is another image", |status| spp(status, "brdf", "sobol") > 0.0);
    assert_eq!(spp(&other, "area", "adaptive"), 2.0);
    // to pause is no reason to lose one
    viewer.wish("{\"technique\":\"area\",\"sampler\":\"adaptive\"}");
    // its tiles are shown while it is rendered: of the first pass, or of the second one
    viewer.until("some tiles are those of the second pass", |_| {
        let (_, samples) = viewer.image("area", "adaptive");
        samples.contains(&2) && samples.contains(&8)
    });
    viewer.until("the second pass renders", |status| {
        assert_eq!(spp(status, "area", "adaptive"), 2.0);
        status["way"]["technique"] == "area" && in_second(status) && status["pass"].as_f64() > Some(0.1)
    });
    viewer.wish("{\"paused\":true}");
    viewer.until("the second pass has ended", |status| spp(status, "area", "adaptive") > 2.0);
}

#[test]
fn an_interruption_writes_the_image_that_is_shown() {
    let folder = Folder::new();
    let mut viewer = Viewer::new(&folder, &["quads", "--technique", "area"]);
    viewer.until("there are some images", |status| {
        let is_late = |picture: &Value| picture["version"].as_u64() > Some(5);
        picture(status, "area", "adaptive").is_some_and(is_late) && spp(status, "area", "adaptive") >= 96.0
    });
    let id = viewer.child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert_eq!(viewer.child.wait().unwrap().code(), Some(130));
    let mut error = String::new();
    viewer.child.stderr.take().unwrap().read_to_string(&mut error).unwrap();
    assert!(error.starts_with("interrupted: a.exr holds an image of ") && error.lines().count() == 1, "{error}");
    let said: f64 = error.split(' ').nth(6).unwrap().parse().unwrap();
    assert!(said >= 96.0, "{error}");
    assert_eq!(folder.names(), ["a.exr", "a.png"]);
    folder.succeed(&[
        "render",
        "quads",
        "--technique",
        "area",
        "--size",
        "32x32",
        "--spp",
        "64",
        "--seed",
        "7",
        "-o",
        "b.exr",
    ]);
    let text = folder.succeed(&["compare", "b.exr", "a.exr", "--json"]);
    assert_eq!(super::json(&text)["verdict"], "agree", "{text}");
}

#[test]
fn nothing_is_written_but_a_copy_that_is_asked_for_and_a_turned_camera_starts_again() {
    let folder = Folder::new();
    let more = ["--size", "32x32", "--threads", "1", "--technique", "area", "--sampler", "sobol"];
    let mut viewer = Viewer::with(&folder, &[&["view", "quads"], &more[..]].concat());
    viewer.until("there are samples", |status| spp(status, "area", "sobol") > 100.0);
    let (still, _) = viewer.image("area", "sobol");
    for wrong in ["[1,2]", "[0,0,0]", "[1e9,0,1]", "true"] {
        let answer = viewer.wish(&format!("{{\"orbit\":{wrong}}}"));
        assert!(answer.code == 400 && answer.text().contains("is not a turn of the camera"), "{}", answer.text());
    }
    assert_eq!(viewer.wish("{\"orbit\":[0.8,0.1,1.0]}").code, 200);
    viewer.until("it starts again", |status| {
        status["orbit"] == json!([0.8, 0.1, 1.0]) && (1.0..100.0).contains(&spp(status, "area", "sobol"))
    });
    let (turned, _) = viewer.image("area", "sobol");
    let differ = turned.iter().zip(&still).filter(|(a, b)| (*a - *b).abs() > 0.1 * (*a + *b)).count();
    assert!(differ > turned.len() / 8, "{differ} of {} values", turned.len());
    assert_eq!((folder.names(), viewer.status()["copy"].as_str()), (vec![], Some("quads-view.exr and quads-view.png")));
    // a copy that is asked for while the image is coarse is one of its first pass
    viewer.wish("{\"orbit\":[0.4,0.1,1.0],\"save\":true}");
    let saved = viewer.until("it is written", |status| !status["message"].is_null());
    assert_eq!(saved["message"], "Wrote quads-view.exr and quads-view.png");
    assert_eq!(saved["copy"], "quads-view-2.exr and quads-view-2.png");
    assert_eq!(folder.names(), ["quads-view.exr", "quads-view.png"]);
    // it is no image of the camera that the scene has
    folder.succeed(&["render", "quads", "--size", "32x32", "--spp", "64", "--technique", "area", "-o", "plain.exr"]);
    let [turned, plain] = ["quads-view.exr", "plain.exr"].map(|name| Identity::scene_of(&folder.path(name)).unwrap());
    assert!(turned[0] == plain[0] && turned[1].starts_with(&plain[1]) && turned[1].contains("turned"), "{turned:?}");
    let id = viewer.child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let mut error = String::new();
    viewer.child.stderr.take().unwrap().read_to_string(&mut error).unwrap();
    assert_eq!((viewer.child.wait().unwrap().code(), &*error), (Some(130), "interrupted: nothing was written\n"));
}

/// A camera that turns is followed by images of few pixels, also while no samples are taken; what the image is then begins tile by tile.
#[test]
fn a_turned_camera_is_shown_coarsely_first() {
    let folder = Folder::new();
    let more = ["--size", "64x48", "--threads", "1", "--technique", "area", "--sampler", "sobol"];
    let viewer = Viewer::with(&folder, &[&["view", "quads"], &more[..]].concat());
    let rests = |status: &Value| spp(status, "area", "sobol") > 64.0 && status["draft"].is_null();
    let pause = |flag: bool| viewer.wish(&format!("{{\"paused\":{flag}}}")).code;
    viewer.until("there is an image", |status| spp(status, "area", "sobol") > 64.0);
    pause(true);
    viewer.until("it rests", rests);
    let (still, _) = viewer.image("area", "sobol");
    assert_eq!(viewer.wish("{\"orbit\":[0.8,0.1,1.0]}").code, 200);
    let turned = viewer.until("it turns", |status| status["draft"]["coarse"] == true);
    assert_eq!(turned["pictures"], json!([]));
    let (coarse, samples) = viewer.image("area", "sobol");
    assert!(samples.iter().all(|&n| n == 0));
    assert_eq!(coarse.len(), 3 * 16 * 12);
    pause(false);
    viewer.until("there is an image", |status| spp(status, "area", "sobol") > 64.0);
    pause(true);
    viewer.until("it rests", rests);
    let (fine, samples) = viewer.image("area", "sobol");
    assert!(samples.iter().all(|&n| n > 0));
    // the coarse image was one through the turned camera
    let block = |image: &[f32], i: usize| -> f32 {
        let [x, y, channel] = [i / 3 % 16, i / 48, i % 3];
        (0..16).map(|k| image[3 * (64 * (4 * y + k / 4) + 4 * x + k % 4) + channel]).sum::<f32>() / 16.0
    };
    let gap = |other: &[f32]| -> f32 { (0..coarse.len()).map(|i| (coarse[i] - block(other, i)).abs()).sum() };
    assert!(1.5 * gap(&fine) < gap(&still), "{} from the turned image, {} from the still one", gap(&fine), gap(&still));
}

#[test]
fn goals_end_the_rendering_and_not_the_page() {
    let folder = Folder::new();
    let viewer = Viewer::new(&folder, &["quads", "--technique", "area", "--error", "2%"]);
    let ended = viewer.until("it ends", |status| {
        picture(status, "area", "adaptive").is_some_and(|picture| !picture["end"].is_null())
    });
    let of = picture(&ended, "area", "adaptive").unwrap();
    assert!(of["error"].as_f64().unwrap() <= 0.02 && of["end"] == "its error is what was asked for", "{ended}");
    assert_eq!(ended["target"], 0.02);
    // the files have it soon
    let (radiance, _) = viewer.image("area", "adaptive");
    let is_written = |_: &Value| {
        let image = etendue_render::film::image::read_exr(&folder.path("a.exr"));
        image.is_ok_and(|image| image.radiance.as_flattened() == radiance)
    };
    viewer.until("the image is written", is_written);
    assert_eq!(picture(&viewer.status(), "area", "adaptive").unwrap()["version"], of["version"]);
    let viewer = Viewer::new(&folder, &["quads", "--technique", "area", "--time", "0.3"]);
    let ended = viewer.until("it ends", |status| {
        picture(status, "area", "adaptive").is_some_and(|picture| picture["end"] == "0.3 s are over")
    });
    assert!(picture(&ended, "area", "adaptive").unwrap()["seconds"].as_f64() >= Some(0.3));
}

#[test]
fn a_scene_that_changes_is_reported_and_read_again() {
    let folder = Folder::new();
    folder.write("a.pbrt", scene("Include \"part.pbrt\""));
    folder.write("part.pbrt", "");
    let viewer = Viewer::with(&folder, &["view", "a.pbrt", "--technique", "area", "--threads", "1"]);
    let first = viewer.until("there is an image", |status| spp(status, "area", "adaptive") > 0.0);
    assert_eq!((&first["size"], &first["changed"]), (&json!([8, 8]), &Value::Null));
    let later =
        viewer.until("there is another", |status| spp(status, "area", "adaptive") > spp(&first, "area", "adaptive"));
    assert_eq!(later["changed"], Value::Null);
    // an included file: nothing is read until the page asks for it
    folder.write("part.pbrt", "Shape \"sphere\" \"float radius\" one");
    let changed = viewer.until("it is reported", |status| !status["changed"].is_null());
    assert!(changed["changed"].as_str().unwrap().ends_with("part.pbrt"), "{changed}");
    viewer.wish("{\"reload\":true}");
    let faulty = viewer.until("it is faulty", |status| !status["message"].is_null());
    let message = faulty["message"].as_str().unwrap();
    assert!(message.contains("part.pbrt:1: ") && message.contains("found one"), "{message}");
    assert!(spp(&faulty, "area", "adaptive") > 0.0, "the old image stays");
    folder.write("a.pbrt", scene("").replace("\"integer xresolution\" 8", "\"integer xresolution\" 24"));
    viewer.wish("{\"reload\":true}");
    let read = viewer.until("it is read", |status| status["size"] == json!([24, 8]));
    assert_eq!((&read["message"], &read["changed"]), (&Value::Null, &Value::Null));
    viewer.until("there is an image", |status| spp(status, "area", "adaptive") > 0.0);
    assert_eq!(viewer.image("area", "adaptive").1.len(), 24 * 8);
}

#[test]
fn bad_values_are_named() {
    let folder = Folder::new();
    let viewer = Viewer::new(&folder, &["quads"]);
    for (body, what) in [
        ("", "not JSON"),
        ("[]", "not an object"),
        ("{\"technique\":\"areas\"}", "technique: \"areas\" is not one of those that `etendue list` prints"),
        ("{\"sampler\":3}", "sampler: 3 is not a name"),
        ("{\"crop\":[0,0,33,8]}", "crop: [0,0,33,8] is not a part of the image"),
        ("{\"paused\":1}", "paused: 1 is not true or false"),
        ("{\"speed\":1}", "speed: there is no such wish"),
        ("{\"sampler\":\"sobol\",\"crop\":7}", "crop: 7 is not a part"),
    ] {
        let answer = viewer.wish(body);
        assert!(answer.code == 400 && answer.text().contains(what), "{body}: {}", answer.text());
    }
    assert_eq!(viewer.status()["way"], json!({ "technique": "auto", "sampler": "adaptive" }), "no part of a bad wish");
    for (query, what) in [
        ("", "technique: it is missing"),
        ("?technique=area", "sampler: it is missing"),
        ("?technique=area&sampler=x", "sampler: \"x\" is not one"),
    ] {
        let answer = viewer.ask(&format!("image{query}"), "");
        assert!(answer.code == 400 && answer.text().contains(what), "{query}: {}", answer.text());
    }
    let help = folder.succeed(&["view", "--help"]);
    assert!(help.contains("--port") && !help.contains("--spp"), "{help}");
}
