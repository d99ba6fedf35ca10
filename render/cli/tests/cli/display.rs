//! `--display-server`: packets that a server receives, decoded, have the pixels of the image.

use super::Folder;
use std::collections::BTreeMap;
use std::io::Read;
use std::net::TcpListener;
use std::thread::{self, JoinHandle};

/// Reads numbers and names from the bytes of a packet.
struct Packet<'a>(&'a [u8]);

impl Packet<'_> {
    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let (first, rest) = self.0.split_first_chunk::<N>().unwrap();
        self.0 = rest;
        *first
    }
    fn number(&mut self) -> usize {
        i32::from_le_bytes(self.bytes()).try_into().unwrap()
    }
    fn text(&mut self) -> String {
        let end = self.0.iter().position(|byte| *byte == 0).unwrap();
        let text = std::str::from_utf8(&self.0[..end]).unwrap().to_owned();
        self.0 = &self.0[end + 1..];
        text
    }
}

/// An image as a display server has it.
#[derive(Debug, Default)]
pub(super) struct Shown {
    pub(super) name: String,
    pub(super) size: [usize; 2],
    pub(super) channels: BTreeMap<String, Vec<f32>>,
    /// How many packets changed it.
    pub(super) updates: usize,
}

/// A display server for one connection: its address, and the image that it has when the connection ends.
pub(super) fn server() -> (String, JoinHandle<Shown>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let receive = move || {
        let mut bytes = Vec::new();
        listener.accept().unwrap().0.read_to_end(&mut bytes).unwrap();
        let (mut shown, mut rest) = (Shown::default(), &bytes[..]);
        while !rest.is_empty() {
            let length = u32::from_le_bytes(rest[..4].try_into().unwrap()) as usize;
            let mut packet = Packet(&rest[4..length]);
            rest = &rest[length..];
            let [kind, focus] = packet.bytes();
            let name = packet.text();
            if kind == 4 {
                assert_eq!((focus, shown.name.as_str()), (1, ""), "an image is made once");
                let [width, height, channels] = [(); 3].map(|()| packet.number());
                let black = |_| (packet.text(), vec![0.0; width * height]);
                shown = Shown { name, size: [width, height], channels: (0..channels).map(black).collect(), updates: 0 };
            } else {
                assert_eq!((kind, focus, &name), (3, 0, &shown.name));
                let channel = packet.text();
                let [left, top, width, height] = [(); 4].map(|()| packet.number());
                let pixels = shown.channels.get_mut(&channel).unwrap();
                for y in top..top + height {
                    for x in left..left + width {
                        pixels[y * shown.size[0] + x] = f32::from_le_bytes(packet.bytes());
                    }
                }
                shown.updates += 1;
            }
            assert!(packet.0.is_empty(), "{} bytes are left", packet.0.len());
        }
        shown
    };
    (address, thread::spawn(receive))
}

impl Shown {
    /// Compares it with the image in a file.
    pub(super) fn compare(&self, folder: &Folder, file: &str) {
        let image = etendue_render::image::read_exr(&folder.path(file)).unwrap();
        assert_eq!(self.size, [image.width, image.height]);
        assert_eq!(self.channels.keys().collect::<Vec<_>>(), ["B", "G", "R"]);
        for (k, channel) in ["R", "G", "B"].into_iter().enumerate() {
            let expected: Vec<f32> = image.radiance.iter().map(|pixel| pixel[k]).collect();
            assert!(expected.iter().any(|x| *x > 0.0) && self.channels[channel] == expected, "{channel}");
        }
        assert!(self.name.starts_with(&format!("{file} (")), "{}", self.name);
    }
}

#[test]
fn a_display_server_receives_the_image() {
    let folder = Folder::new();
    let (address, shown) = server();
    // three tiles of packets across, two down
    let size = ["--size", "300x130"];
    let arguments =
        [&["render", "quads", "--spp", "2", "-o", "a.exr", "--display-server", &address], &size[..]].concat();
    folder.succeed(&arguments);
    let shown = shown.join().unwrap();
    shown.compare(&folder, "a.exr");
    assert_eq!(shown.updates, 3 * 6);
    // each pass
    let (address, shown) = server();
    let error = ["--technique", "solid-angle", "--size", "32x32", "--error", "0.005"];
    folder.succeed(&[&["render", "quads", "-o", "a.exr", "--display-server", &address], &error[..]].concat());
    let shown = shown.join().unwrap();
    shown.compare(&folder, "a.exr");
    assert!(shown.updates > 3 && shown.updates.is_multiple_of(3), "{} updates", shown.updates);
}

#[test]
fn without_a_display_server_the_image_is_rendered() {
    let folder = Folder::new();
    // nothing listens on a port that was just free
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    for address in [format!("127.0.0.1:{port}"), "there.is.no.such.host.invalid:14158".to_owned()] {
        let output = folder.run(&["render", "quads", "--size", "8x8", "--spp", "2", "--display-server", &address]);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{error}");
        assert!(error.contains(&format!("warning: --display-server {address}: ")), "{error}");
        assert_eq!((error.lines().count(), folder.names()), (1, vec!["quads.exr".into(), "quads.png".into()]));
    }
    // one that ends in between
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let gone = thread::spawn(move || drop(listener.accept()));
    let output = folder.run(&["render", "quads", "--size", "256x256", "--time", "1", "--display-server", &address]);
    gone.join().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && error.contains("the image is not shown there"), "{error}");
    assert_eq!(error.lines().count(), 1, "{error}");
    for address in ["127.0.0.1", ":14158", "localhost:0", "localhost:99999"] {
        let error = folder.fail(&["render", "quads", "--display-server", address]);
        assert!(error.contains("--display-server") && error.contains(address), "{error}");
    }
    let part = ["render", "quads", "--spp", "2", "--tile", "0,0,16,16", "--display-server", "localhost:1"];
    assert!(folder.fail(&part).contains("--display-server localhost:1: a part of an image is not shown"));
}
