"""Drives the page of `etendue view` in a headless Chromium: a render is watched to its end, techniques are switched, and what the page shows
is compared with the files.

view.py PROGRAM [FOLDER]: the program `etendue`, and a folder for pictures."""

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "core/playground/tests"))
from browser import Browser, find
from png import colors, pixels

PROGRAM = Path(sys.argv[1]).resolve()
FOLDER = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
SCENE = """LookAt 0 4 6 0 0 0 0 1 0 Camera "perspective" Film "rgb" "integer xresolution" {} "integer yresolution" 64
WorldBegin
AttributeBegin AreaLightSource "diffuse" "rgb L" [5 4 2] Translate 0 3 0 Shape "sphere" AttributeEnd
Shape "trianglemesh" "point3 P" [-9 0 9 9 0 9 0 0 -9]
"""


class Viewer:
    """A program that serves a page."""

    def __init__(self, *arguments):
        # a test in the background ignores Ctrl-C, which its programs would go on ignoring
        heed = lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        self.process = subprocess.Popen([PROGRAM, "view", "--no-open", *arguments], preexec_fn=heed, **pipes)
        said = [self.process.stdout.readline() for _ in range(3)]
        self.url = next(line.strip() for line in said if line.startswith("http://"))

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)
        _, error = self.process.communicate(timeout=20)
        assert self.process.returncode == 130 and error.startswith("interrupted: "), error
        return error

    def close(self):
        self.process.kill()
        self.process.wait()


def keep(name, browser):
    """Keeps a picture of the whole page, if someone wants them."""
    if FOLDER:
        FOLDER.mkdir(parents=True, exist_ok=True)
        (FOLDER / name).write_bytes(browser.screenshot())


def keep_both(name, browser):
    """Keeps pictures of the whole page in a wide and in a narrow window, if someone wants them."""
    for width, height in [(400, 800), (1400, 1000)] if FOLDER else []:
        browser.resize(width, height)
        browser.settle()
        keep(f"{name}-{width}.png", browser)


def shown(browser, way):
    """What the page says of an image, once it has received it."""
    browser.wait(f"view.pixels.get({json.dumps(way)})")
    return browser.evaluate(f"view.status.pictures.find((p) => `${{p.way.technique}}, ${{p.way.sampler}}` === {json.dumps(way)})")


def facts(browser):
    """The terms and texts of the list beside the image."""
    return dict(browser.evaluate("[...document.querySelectorAll('#facts dt')].map((t) => [t.textContent, t.nextSibling.textContent])"))


def watch_to_the_end(browser):
    """A render until its goal: the page shows the pixels of the PNG, and the numbers of the pixel under the cursor."""
    viewer = Viewer("quads", "--size", "160x120", "--technique", "solid-angle", "--error", "0.5%", "-o", "end.exr")
    try:
        browser.open(viewer.url, "window.view && view.last && view.status.pictures.length")
        updates = browser.evaluate("view.updates")
        browser.wait("view.status.pictures[0].end", 60)
        browser.wait("view.last.version === view.status.pictures[0].version")
        said = facts(browser)
        assert said["now"] == "no more samples: its error is what was asked for", said
        error = browser.evaluate("view.status.pictures[0].error")
        assert error <= 0.005 and said["error"].startswith(f"{100 * error:#.3g} %") and "0.500 % wanted" in said["error"], (error, said)
        picture = browser.screenshot("#image")
        number, commonest = colors(picture)
        assert number > 200 and commonest < 0.7, f"{number} colours, {commonest:.0%} of the image has one"
        number, _ = colors(browser.screenshot("#plot"))
        assert number > 10, f"the plot has {number} colours"
        # the file is written when the render ends
        deadline = time.monotonic() + 10
        while not Path("end.png").exists() or time.time() - os.stat("end.png").st_mtime < 0.3:
            assert time.monotonic() < deadline
            time.sleep(0.1)
        width, height, channels, rows = pixels(Path("end.png").read_bytes())
        words = browser.evaluate("[...new Uint32Array(view.first.image.data.buffer)]")
        assert (width, height, len(words)) == (160, 120, 160 * 120)
        differ = 0
        for i, word in enumerate(words):
            x, y = i % width, i // width
            of_file = rows[y][channels * x : channels * x + 3]
            of_page = [word & 255, word >> 8 & 255, word >> 16 & 255]
            far = max(abs(a - b) for a, b in zip(of_file, of_page))
            assert far <= 1, f"pixel {x}, {y}: {of_page} in the page, {list(of_file)} in the file"
            differ += far
        # rounding of the same powers
        assert differ <= 2, f"{differ} of {len(words)} pixels differ by 1 from the PNG"
        # the pixel under the cursor, by hand and by key
        browser.evaluate("document.getElementById('image').scrollIntoView()")
        left, top, w, h = browser.box("#image")
        top -= browser.evaluate("scrollY")
        browser.mouse("mouseMoved", left + w / 2 + 0.3, top + h / 2 + 0.3)
        browser.settle()
        assert browser.evaluate("view.cursor") == [80, 60]
        browser.evaluate("document.getElementById('image').focus()")
        browser.key("ArrowRight")
        assert browser.evaluate("view.cursor") == [81, 60]
        i = 60 * 160 + 81
        mean = browser.evaluate(f"[...view.last.mean.slice(3 * {i}, 3 * {i} + 3)]")
        spread = browser.evaluate(f"[...view.last.variance.slice(3 * {i}, 3 * {i} + 3)].map(Math.sqrt)")
        cells = browser.evaluate("[...document.querySelectorAll('#pixel td')].map((d) => d.textContent)")
        for cell, x, s in zip(cells, mean, spread):
            a, b = re.fullmatch(r"[RGB] (\S+) ± (\S+)", cell).groups()
            assert abs(float(a) - x) <= 6e-4 * x and abs(float(b) - s) <= 6e-3 * s, f"{cell} for {x} and {s}"
        assert cells[3] == f"{browser.evaluate(f'view.last.samples[{i}]'):,} samples", cells
        # the image follows the hand
        place = "view.lens.toCanvas(document.getElementById('image'), [80, 60])"
        x, y = browser.evaluate(place)
        browser.drag((left + w / 2, top + h / 2), (left + w / 2 - 40, top + h / 2 + 25))
        assert browser.evaluate(place) == [x - 40, y + 25]
        browser.click("#fit")
        assert browser.evaluate(place) == [x, y]
        # exposure, zoom, and the maps
        before = browser.evaluate("view.first.key")
        browser.choose("exposure", "2")
        assert browser.evaluate("document.getElementById('stops').textContent") == "+2.0 stops"
        assert browser.evaluate("view.first.key") != before
        browser.choose("exposure", "0")
        zoom = browser.evaluate("view.lens.zoom")
        browser.click("#closer")
        assert browser.evaluate("view.lens.zoom") == 2 * zoom
        browser.click("#fit")
        assert browser.evaluate("view.lens.zoom") == zoom
        for layer in ["error", "luminance", "red", "variance", "samples"]:
            browser.choose("layer", layer)
            number, _ = colors(browser.screenshot("#image"))
            assert number > 20, f"{layer} has {number} colours"
            keep(f"{layer}.png", browser)
        # colours of a range: what is above has the last one
        browser.choose("low", "1")
        browser.choose("high", "2")
        words = browser.evaluate("[...new Set(new Uint32Array(view.first.image.data.buffer))]")
        assert len(words) == 1, f"all pixels have more than 2 samples: {words}"
        browser.choose("low", "")
        browser.choose("high", "")
        # the pixel of the greatest variance
        browser.click("#worst")
        assert browser.evaluate(
            "(() => { const v = view.last.variance, at = (i) => v[3 * i] + v[3 * i + 1] + v[3 * i + 2], [x, y] = view.cursor;"
            " return [...view.last.samples.keys()].every((i) => at(i) <= at(y * 160 + x)); })()"
        )
        browser.click("#fit")
        # where the camera is, for files
        look, matrix = browser.evaluate("view.status.camera").split("\n")
        assert re.fullmatch(r"(Scale -1 1 1 )?LookAt( +-?[0-9.]+){9}", look) and len(json.loads(f"{{{matrix}}}")["matrix"]) == 16
        browser.choose("layer", "radiance")
        keep("end.png", browser)
        browser.mouse("mouseMoved", 0, 0)
        return updates
    finally:
        viewer.close()


def switch_and_compare(browser):
    """Techniques and samplers are switched and keep their samples; a part receives all; the slider is between two images."""
    viewer = Viewer("quads", "--size", "96x64", "--technique", "area", "--sampler", "sobol", "-o", "switch.exr")
    try:
        browser.open(viewer.url, "window.view && view.last && view.status.pictures.length")
        browser.wait("view.status.pictures[0].spp > 64")
        browser.choose("technique", "brdf")
        browser.wait("view.pixels.get('brdf, sobol')")
        kept = shown(browser, "brdf, sobol")
        browser.choose("sampler", "independent")
        browser.wait("view.pixels.get('brdf, independent') && view.status.pictures.length === 3")
        area = browser.evaluate("view.status.pictures.find((p) => p.way.technique === 'area')")
        assert area["spp"] > 64 and kept["spp"] > 0
        browser.choose("other", "area, sobol")
        browser.wait("view.pixels.get('area, sobol')")
        assert browser.evaluate("view.pixels.get('area, sobol').version") == area["version"], "it keeps what it had"
        # left of the slider the one, right of it the other
        browser.click("#pause")
        browser.wait("view.status.paused")
        for at, left, right in [(0, "area", "area"), (50, "brdf", "area"), (100, "brdf", "brdf")]:
            browser.choose("wipe", str(at))
            same = browser.evaluate(
                "(() => { const c = document.getElementById('image'), g = c.getContext('2d'), l = view.lens;"
                " const of = (d, x, y) => { const w = new Uint32Array(d.image.data.buffer)[y * 96 + x]; const p = l.toCanvas(c, [x + 0.5, y + 0.5]);"
                " const s = g.getImageData(Math.floor(p[0]), Math.floor(p[1]), 1, 1).data; return s[0] === (w & 255) && s[1] === (w >> 8 & 255); };"
                " const all = (d, from, to) => { let n = 0; for (let x = from; x < to; x++) for (let y = 0; y < 64; y++) n += of(d, x, y); return n / (64 * (to - from)); };"
                " return [all(view.first, 0, 44), all(view.second, 0, 44), all(view.first, 52, 96), all(view.second, 52, 96)]; })()"
            )
            first = {"brdf": 0, "area": 1}
            assert same[first[left]] == 1 and same[2 + first[right]] == 1, f"at {at} %: {same}"
            assert min(same[1 - first[left]], same[3 - first[right]]) < 0.9, f"both images are the same: {same}"
        browser.choose("wipe", "50")
        keep_both("wipe", browser)
        # the line follows the hand, and the names of both images stand at it
        browser.evaluate("document.getElementById('image').scrollIntoView()")
        x, y, w, h = browser.evaluate("(() => { const b = document.getElementById('image').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")
        browser.drag((x + w / 2, y + h / 3), (x + 0.7 * w, y + h / 3))
        assert abs(float(browser.evaluate("document.getElementById('wipe').value")) - 70) <= 0.5
        browser.choose("wipe", "50")
        # differences have a bar of colours with numbers and a unit
        for layer, title in [("difference", "A − B, W/(m² sr)"), ("relative", "(A − B) / B")]:
            browser.choose("layer", layer)
            assert browser.evaluate("document.getElementById('bar').getAttribute('aria-label')").startswith(title)
            number, _ = colors(browser.screenshot("#image"))
            assert number > 20, f"{layer} has {number} colours"
            keep_both(layer, browser)
        browser.choose("layer", "radiance")
        assert browser.evaluate("document.getElementById('bar').hidden")
        # a part, dragged by hand
        browser.click("#crop")
        browser.evaluate("document.getElementById('image').scrollIntoView()")
        browser.settle()
        corner = lambda x, y: browser.evaluate(
            f"(() => {{ const c = document.getElementById('image'), b = c.getBoundingClientRect(), p = view.lens.toCanvas(c, [{x}, {y}]);"
            " return [b.x + p[0] * b.width / c.width, b.y + p[1] * b.height / c.height]; })()"
        )
        browser.drag(corner(18, 18), corner(40, 30))
        browser.wait("view.status.crop")
        assert browser.evaluate("view.status.crop") == [16, 16, 48, 32]
        before = browser.evaluate("[...view.pixels.get('brdf, independent').samples]")
        browser.click("#pause")
        browser.wait("view.pixels.get('brdf, independent').samples[20 * 96 + 20] > %d" % (before[20 * 96 + 20] + 1000))
        browser.click("#pause")
        browser.wait("view.status.paused")
        after = browser.evaluate("[...view.pixels.get('brdf, independent').samples]")
        for i, (a, b) in enumerate(zip(before, after)):
            inside = 16 <= i % 96 < 48 and 16 <= i // 96 < 32
            assert inside or b - a <= 1000 and b == after[0], f"pixel {i % 96}, {i // 96}: {a}, then {b} samples"
        browser.click("#whole")
        browser.wait("view.status.crop === null")
        browser.click("#pause")
        # what is refused is said
        answer = browser.evaluate("view.wish({sampler: 'none'}).then(() => document.getElementById('message').textContent)")
        assert 'sampler: "none" is not one of those' in answer, answer
        browser.click("#dismiss")
        # a browser that goes away and comes back
        browser.call("Page.navigate", url="about:blank")
        browser.wait("location.href === 'about:blank'")
        # meanwhile another page, even one that knows the address, can neither read nor wish
        for options in ["{}", "{method: 'POST', body: '{\"paused\":true}', mode: 'no-cors'}"]:
            asked = f"fetch({json.dumps(viewer.url + 'wish')}, {options}).then((a) => a.status, () => -1)"
            assert browser.evaluate(asked) in (-1, 0), options
        browser.open(viewer.url, "window.view && view.last && view.status.pictures.length")
        assert browser.evaluate("[view.status.pictures.length, view.status.paused]") == [3, False]
        # small windows
        browser.resize(400, 800, touch=True)
        browser.settle()
        assert browser.evaluate("document.documentElement.scrollWidth") <= 400
        keep("narrow.png", browser)
        browser.resize(1400, 1000)
        said = viewer.interrupt()
        assert "switch.exr holds an image of" in said, said
        browser.wait("!document.getElementById('lost').hidden")
        assert browser.evaluate("document.getElementById('lost').getBoundingClientRect().height") > 20
        subprocess.run([PROGRAM, "compare", "switch.exr", "switch.exr"], check=True, capture_output=True)
    finally:
        viewer.close()


def turn_and_save(browser):
    """The camera turns about what it looks at, and the image starts again; nothing is written but the copy that the page asks for."""
    before = set(os.listdir())
    viewer = Viewer("studio", "--size", "96x72", "--technique", "area", "--sampler", "sobol")
    try:
        browser.open(viewer.url, "window.view && view.last && view.status.pictures.length")
        browser.wait("view.status.pictures[0].spp > 512")
        still = browser.evaluate("[...view.last.mean.slice(0, 3 * 96)]")
        browser.click("#turn")
        # a fast machine soon has as many samples as before
        spp = browser.evaluate("window.fewest = view.status.pictures[0].spp; setInterval(() => { fewest = Math.min(fewest, ...view.status.pictures.map((p) => p.spp)); }, 10); fewest")
        x, y, w, h = browser.evaluate("(() => { const b = document.getElementById('image').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")
        browser.drag((x + w / 2, y + h / 2), (x + 0.7 * w, y + 0.4 * h))
        browser.wait(f"view.status.orbit && fewest < {spp}")
        browser.wait(f"view.last.mean.slice(0, 3 * 96).some((x, i) => Math.abs(x - {json.dumps(still)}[i]) > 0.3)")
        browser.wait("view.status.pictures[0].spp > 64")
        keep_both("turned", browser)
        browser.click("#still")
        browser.wait("!view.status.orbit")
        assert set(os.listdir()) == before, set(os.listdir()) - before
        browser.click("#save")
        browser.wait("document.getElementById('message').textContent.includes('Wrote studio-view.exr and studio-view.png')")
        assert set(os.listdir()) - before == {"studio-view.exr", "studio-view.png"}
        assert "studio-view-2.exr" in browser.evaluate("document.getElementById('save').textContent")
        assert "nothing was written" in viewer.interrupt()
    finally:
        viewer.close()


def change_the_scene(browser):
    """A scene that changes is offered anew."""
    Path("a.pbrt").write_text(SCENE.format(64))
    viewer = Viewer("a.pbrt", "-o", "scene.exr")
    try:
        browser.open(viewer.url, "window.view && view.last && view.status.pictures.length")
        assert browser.evaluate("document.getElementById('changed').hidden")
        # also while the camera moves
        browser.click("#turn")
        x, y, w, h = browser.evaluate("(() => { const b = document.getElementById('image').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")
        browser.drag((x + w / 2, y + h / 2), (x + 0.6 * w, y + 0.4 * h))
        browser.wait("view.status.orbit")
        Path("a.pbrt").write_text(SCENE.format(96))
        browser.wait("!document.getElementById('changed').hidden", 10)
        assert "a.pbrt has changed" in browser.evaluate("document.getElementById('changed').textContent")
        keep("changed.png", browser)
        browser.click("#reload")
        browser.wait("view.last.width === 96 && document.getElementById('changed').hidden", 10)
        Path("a.pbrt").write_text(SCENE.format(96) + "Shape \"sphere\" \"float radius\" -1\n")
        browser.wait("!document.getElementById('changed').hidden", 10)
        browser.click("#reload")
        browser.wait("!document.getElementById('message').hidden", 10)
        text = browser.evaluate("document.getElementById('message').textContent")
        assert "a.pbrt:5: " in text and "radius" in text, text
    finally:
        viewer.close()


def measure(browser):
    """How often a picture of 640 × 480 pixels is shown anew, and how long it takes the page."""
    viewer = Viewer("quads", "--size", "640x480", "--technique", "solid-angle", "--sampler", "sobol", "-o", "measure.exr")
    try:
        browser.open(viewer.url, "window.view && view.last && view.status.pictures.length")
        updates, busy, start = browser.evaluate("view.updates"), browser.busy(), time.monotonic()
        time.sleep(4)
        updates, busy = browser.evaluate("view.updates") - updates, browser.busy() - busy
        passed = time.monotonic() - start
        assert updates >= 2, f"{updates} images in {passed:.1f} s"
        print(f"640 × 480 pixels: {updates / passed:.1f} images per second, {1000 * busy / updates:.0f} ms of the page's time each")
        sizes = {name or "page": len(urllib.request.urlopen(viewer.url + name).read()) for name in ["", "view.css", "view.js"]}
        print(f"bytes of the page's files: {sizes}")
        assert sum(sizes.values()) < 60_000
    finally:
        viewer.close()


def main():
    path = find()
    if not path:
        sys.exit("view.py: no Chromium here: the page is not tested")
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        browser = Browser(path)
        try:
            for step in [watch_to_the_end, switch_and_compare, turn_and_save, change_the_scene, measure]:
                step(browser)
                print(f"{step.__name__}: passed after {time.monotonic() - began:.0f} s")
            errors = browser.errors()
            assert not errors, errors
        finally:
            browser.close()
            os.chdir("/")


main()
