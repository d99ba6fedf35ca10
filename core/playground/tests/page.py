"""Drives the playground in a headless Chromium, and compares what it shows with the core, bit by bit.

page.py PAGE ANSWERS [FOLDER]: the page's file, the program of examples/answers.rs, and a folder for pictures."""

import base64
import gzip
import json
import math
import re
import struct
import subprocess
import sys
import tempfile
import time
import urllib.parse
from pathlib import Path

import firefox
from browser import Browser, find
from png import changed, colors, pixels
from texts import WRITTEN, collisions

PAGE, ANSWERS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
FOLDER = Path(sys.argv[3] if len(sys.argv) > 3 else tempfile.mkdtemp()).resolve()
SHOW = "JSON.stringify(playground.answer())"
LIMIT = 400_000


def keep(name, browser):
    """Keeps a picture of the whole page, if someone wants them."""
    if len(sys.argv) > 3:
        (FOLDER / name).write_bytes(browser.screenshot())


def double(text):
    return struct.unpack(">d", bytes.fromhex(text))[0]


class Test:
    """What the page said at each step, to be compared with the core at the end."""

    def __init__(self):
        self.shown = []

    def take(self, browser, step):
        browser.settle()
        shown = json.loads(browser.evaluate(SHOW))
        assert shown["techniques"], f"{step}: no technique of the core is shown"
        self.shown.append((step, shown))
        return shown

    def compare(self):
        lines = "".join(json.dumps(shown) + "\n" for _, shown in self.shown)
        answers = subprocess.run([ANSWERS], input=lines, capture_output=True, text=True, check=True).stdout.splitlines()
        assert len(answers) == len(self.shown)
        numbers = 0
        for (step, shown), line in zip(self.shown, answers):
            answer = json.loads(line)
            core = {technique["by"]: technique for technique in answer["techniques"]}
            for technique in shown["techniques"]:
                for key, expected in core[technique["by"]].items():
                    assert technique[key] == expected, f"{step}, {shown['light']}, {technique['by']}, {key}: {technique[key]} in the page, {expected} in the core"
                numbers += 4096 * 11 + 9
                # what is written on the page is what was computed
                for text, bits in zip(technique["drawn"], technique["errors"]):
                    assert double(shown["truth"]) == 0 or close(spoken(text), double(bits), 0.06), f"{step}: the page says {text} for {double(bits)}"
            if answer["oracle"] is not None and double(shown["truth"]) > 0:
                assert close(double(shown["truth"]), answer["oracle"], 1e-8), f"{step}: irradiance {double(shown['truth'])} in the page, {answer['oracle']} by the oracle"
        return numbers


def spoken(text):
    """The number that a text of the page means."""
    if text.endswith(" %"):
        return spoken(text[:-2]) / 100
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")
    return float(re.sub(r"·10(.*)", r"e\1", text.translate(raised)))


def close(a, b, tolerance):
    return a == b or abs(a - b) <= tolerance * max(abs(a), abs(b))


def address(page=PAGE, **state):
    return page.as_uri() + ("#" + urllib.parse.quote(json.dumps(state)) if state else "")


def lights(browser, test):
    """Every light of the core's list is there, with all of its techniques, whose estimates are right."""
    names = browser.evaluate("[...document.getElementById('light').options].map((o) => o.value)")
    assert len(names) >= 12, names
    for name in names:
        browser.choose("light", name)
        shown = test.take(browser, "every light")
        assert shown["light"] == name
        truth = double(shown["truth"])
        for technique in shown["techniques"]:
            assert close(double(technique["estimate"]), truth, 5e-3), f"{name} {technique['by']}: {double(technique['estimate'])} instead of {truth}"
    print(f"{len(names)} lights, each by all of its techniques; estimates within 0.5 % of the irradiance, {sum(len(s['techniques']) for _, s in test.shown)} in all")


def handle(browser, name):
    """Where a handle is in the window."""
    return browser.evaluate(
        f"(() => {{ const s = playground.scene, c = s.canvas, b = c.getBoundingClientRect(), h = s.handles.find((h) => h.name === {json.dumps(name)});"
        " const q = s.project(h.shown); return [b.x + q[0] * b.width / c.width, b.y + q[1] * b.height / c.height]; })()"
    )


def hands(browser, test):
    """Mouse, keyboard and touch move the light, the point, the cursor and the view, and switch techniques."""
    browser.open(address(light="Triangle"))
    before = test.take(browser, "before")
    at = handle(browser, "e1")
    browser.drag(at, [at[0] + 30, at[1] + 25])
    dragged = test.take(browser, "a vertex dragged by the mouse")
    assert dragged["numbers"] != before["numbers"] and dragged["p"] == before["p"]
    at = handle(browser, "shading point")
    browser.drag(at, [at[0] - 40, at[1] - 12])
    moved = test.take(browser, "the point dragged by the mouse")
    assert moved["p"] != before["p"] and moved["numbers"] == dragged["numbers"]
    camera = browser.evaluate("playground.scene.camera.azimuth")
    browser.drag([40, 400], [90, 400])
    assert browser.evaluate("playground.scene.camera.azimuth") != camera, "the background turns the view"

    browser.choose("handle", "normal")
    browser.evaluate("document.getElementById('scene').focus()")
    for _ in range(5):
        browser.key("ArrowRight")
    turned = test.take(browser, "the normal turned by keys")
    assert turned["n"] != moved["n"]
    browser.evaluate("document.getElementById('square').focus()")
    browser.key("ArrowUp")
    probed = browser.evaluate("playground.state.probe.u")
    assert close(probed[1], 0.51, 1e-6), probed

    # the cursor on each map of directions and of the light
    for index in range(4):
        box = browser.evaluate(f"(() => {{ const e = document.querySelectorAll('.maps canvas')[{index}]; e.scrollIntoView({{block: 'center'}}); const b = e.getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; }})()")
        browser.mouse("mouseMoved", box[0] + 0.5 * box[2], box[1] + 0.55 * box[3])
        shown = test.take(browser, f"cursor on map {index}")
        assert shown["probe"], "the cursor has a direction"
        if index % 2:
            assert any(t["probe"]["pdf"] for t in shown["techniques"]), "a place of the light has a pdf"

    browser.click(".card:nth-child(3) h2 button")
    assert browser.evaluate("playground.state.way") == "by projected solid angle"
    browser.evaluate("window.scrollTo(0, 0)")
    browser.resize(400, 900, touch=True)
    browser.settle()
    before = test.take(browser, "before touching")
    at = handle(browser, "whole light")
    browser.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": at[0] + 6, "y": at[1] + 6}])
    for k in range(1, 5):
        browser.touch([[at[0] + 8 * k, at[1] + 4 * k]])
    browser.touch([])
    assert test.take(browser, "the light dragged by touch")["numbers"] != before["numbers"]
    browser.resize(1400, 1000)
    print("mouse, keyboard and touch: a vertex, the point, the normal, the view, the cursor, a technique and a light moved")


def breaks(browser, test):
    """What is pushed far, thin and to the horizon: the core holds, the textbook's formula does not, and the page shows it."""

    def errors():
        return browser.evaluate("playground.cards.flatMap((c) => c.ways).map((w) => [w.name, blockErrorOf(w)])".replace("blockErrorOf(w)", "w.kind + ' ' + playground.errorOf(w)"))

    for light, name, value in [("Sphere", "distance", 2000.0), ("Triangle", "distance", 3000.0), ("Rectangle", "distance", 3000.0), ("Triangle", "thinness", 3e-5)]:
        browser.open(address(light=light))
        slide(browser, name, value)
        test.take(browser, f"{light}, {name} {value:g}")
        found = {row[0]: row[1].split() for row in errors()}
        core, textbook = (float(found[key][1].replace("null", "nan").replace("NaN", "nan")) for key in ["by solid angle", "by solid angle, textbook"])
        print(f"{light}, {name} {value:g}: relative error of 1,024 samples by solid angle {core:.1e}, by the textbook's formula {textbook:.1e}")
        assert core < 1e-3 and not textbook < 20 * core, (core, textbook)
    for light in ["Sphere", "Triangle", "Rectangle", "Polygon", "Disk", "Line"]:
        browser.open(address(light=light))
        slide(browser, "elevation", 2.0)
        shown = test.take(browser, f"{light} at the horizon")
        assert double(shown["truth"]) > 0, f"{light}: nothing is above the horizon"


def slide(browser, name, value):
    """Moves a slider to a value."""
    done = browser.evaluate(
        f"(() => {{ const s = playground.sliders.find((s) => s.name === {json.dumps(name)}).slider; s.input.value = String(Math.round(1000 *"
        f" (s.logarithmic ? Math.log({value} / s.low) / Math.log(s.high / s.low) : ({value} - s.low) / (s.high - s.low))));"
        " s.input.dispatchEvent(new Event('input')); return true; })()"
    )
    assert done
    browser.settle()


def ends(browser, test):
    """At both ends of every slider of every light, no number collides with another one, and no sample of the core breaks its contract."""
    checked, faults = 0, []
    for width, height in [(1400, 900), (400, 900)]:
        browser.resize(width, height)
        browser.open(address())
        names = browser.evaluate("[...document.getElementById('light').options].map((o) => o.value)")
        for light in names:
            browser.open(address(light=light, probe={"u": [0.3, 0.6]}))
            browser.settle()
            for slider in browser.evaluate("playground.sliders.map((s) => s.name)"):
                for end in [0, 1000]:
                    step = f"{light}, {slider} at {end / 10:.0f} %, {width} px"
                    browser.evaluate(f"playground.change({{ light: (playground.reset ??= structuredClone(playground.state.light)), probe: {{ u: [0.3, 0.6] }} }})")
                    browser.settle()
                    browser.evaluate(f"(() => {{ const s = playground.sliders.find((s) => s.name === {json.dumps(slider)}).slider.input; s.value = '{end}'; s.dispatchEvent(new Event('input')); }})()")
                    browser.settle()
                    # the last frame, which is no draft, counts what is broken
                    browser.evaluate("(clearTimeout(playground.finer), playground.frame())")
                    for written in browser.evaluate(WRITTEN):
                        faults += [f"{step}: {what}" for what in collisions(written)]
                    broken = browser.evaluate("playground.cards.flatMap((c) => c.parts).filter((p) => p.way.kind === 'core' && p.broken).map((p) => `${p.way.name}: ${p.cells.faults.title}`)")
                    faults += [f"{step}: {what}" for what in broken]
                    checked += 1
            assert browser.evaluate("document.documentElement.scrollWidth") <= width, f"{light} at {width} px"
    assert not faults, "\n".join([f"{len(faults)} faults", *faults[:40]])
    browser.resize(1400, 1000)
    print(f"{checked} ends of sliders: no number collides, and no sample of the core is broken")


def first_view(browser, test):
    """The page begins where a textbook's formula fails and the core holds, says so, and shows its chart; each preset changes the view."""
    browser.resize(1400, 900)
    browser.open(address())
    browser.wait("document.getElementById('verdict').textContent")
    test.take(browser, "the first view")
    said = browser.evaluate("document.getElementById('verdict').textContent")
    assert re.search(r"The textbook’s formula by solid angle fails here: \d[\d,]* of 4,096 samples are broken", said) and "none is broken" in said, said
    core, textbook = browser.evaluate("playground.cards[1].parts.map((p) => [p.broken, playground.errorOf(p.way)])")
    assert core[0] == 0 and core[1] < 1e-3 and textbook[0] > 0 and textbook[1] > 20 * core[1], (core, textbook)
    assert browser.evaluate("getComputedStyle(document.getElementById('contract')).display !== 'none' && document.getElementById('contract').textContent.startsWith('Broken is what the contract rules out')")
    _, top, _, high = browser.box("#chart")
    assert top + high <= 900, f"the chart ends at {top + high} px"
    keep("playground-1400.png", browser)
    pressed = 0
    for light in ["Triangle", "Sphere", "Line", "Sun"]:
        browser.open(address(light=light))
        browser.settle()
        pictures = {browser.screenshot("#view")}
        for k in range(browser.evaluate("document.querySelectorAll('#presets button').length")):
            name, disabled = browser.evaluate(f"(({{ textContent, disabled }}) => [textContent, disabled])(document.querySelectorAll('#presets button')[{k}])")
            if disabled:
                continue
            browser.click(f"#presets button:nth-child({k + 1})")
            browser.evaluate("(clearTimeout(playground.finer), playground.frame())")
            shown = test.take(browser, f"{light}, {name}")
            assert double(shown["truth"]) > 0, f"{light}, {name}: nothing arrives"
            picture = browser.screenshot(".maps") + browser.screenshot("#view")
            assert picture not in pictures, f"{light}, {name}: nothing changes"
            pictures.add(picture)
            pressed += 1
            keep(f"playground-{light}-{name.replace(', ', '-').replace(' ', '-')}.png", browser)
    assert pressed >= 12, pressed
    browser.resize(400, 900)
    browser.open(address())
    browser.wait("document.getElementById('verdict').textContent")
    keep("playground-400.png", browser)
    browser.resize(1400, 1000)
    print(f"the first view: {said}\n{pressed} presets change the view")


def a_light_stays(browser):
    """A light that was chosen is that of every figure of the lecture, and of the page after it; a figure can be reset to its own."""
    browser.open(address())
    browser.choose("light", "Disk")
    browser.click("#lecture")
    count = browser.evaluate("document.getElementById('figures').options.length")
    for k in range(count):
        light, ways, panel = browser.evaluate("[playground.state.light.name, playground.cards.length, playground.state.panel]")
        assert light == "Disk", f"figure {k + 1} shows {light}"
        assert ways or panel in ("importance", "stratification"), f"figure {k + 1} compares nothing"
        assert not re.search(r"\b0 ways", browser.evaluate("document.body.innerText")), f"figure {k + 1}"
        if k == 1:
            assert "The text is about the sphere; the disk stays, since you chose it" in browser.evaluate("document.getElementById('tries').textContent")
        if k + 1 < count:
            browser.click("#next")
    browser.choose("figures", "1")
    browser.click("#reset")
    assert browser.evaluate("playground.state.light.name") == "Sphere"
    browser.choose("light", "Line")
    browser.click("#next")
    assert browser.evaluate("playground.state.light.name") == "Line"
    browser.click("#explore")
    assert browser.evaluate("playground.state.light.name") == "Line"
    print(f"a light that was chosen stays through {count} figures")


def lecture(browser):
    """Every figure of the lecture shows something, and says what to do."""
    browser.open(address())
    browser.click("#lecture")
    count = browser.evaluate("document.getElementById('figures').options.length")
    said = set()
    for k in range(count):
        assert browser.evaluate("playground.state.lesson") == k
        said.add(browser.evaluate("document.getElementById('says').textContent + document.getElementById('tries').textContent"))
        browser.evaluate("window.scrollTo(0, 0)")
        keep(f"lecture-{k + 1}.png", browser)
        assert colors(browser.screenshot("#chart"))[0] > 20, f"the chart of figure {k + 1} is blank"
        if k + 1 < count:
            browser.click("#next")
    assert len(said) == count
    print(f"lecture: {count} figures, none of them blank")


def looks(browser):
    """The page is not blank, fits a narrow window, and its canvases show samples."""
    for width, height in [(1400, 1000), (400, 900)]:
        browser.resize(width, height)
        for light in ["Triangle", "Sphere", "Line"]:
            browser.open(address(light=light))
            browser.settle()
            assert browser.evaluate("document.documentElement.scrollWidth") <= width, f"{light}: the page is wider than {width} px"
        browser.open(address())
        browser.settle()
        keep(f"page-{width}.png", browser)
        for selector in ["#view", "#square", ".maps canvas", "#chart"]:
            many, commonest = colors(browser.screenshot(selector))
            assert many > 30 and commonest < 0.97, f"{selector} at {width} px has {many} colours, one of them on {100 * commonest:.0f} % of it"
    browser.resize(1400, 1000)
    # the scene shows where the samples of the chosen technique go, and the light
    browser.open(address(light="Sphere", handle="view"))
    pictures = []
    for change in ["{}", "{ way: 'by area' }", "{ light: moved }"]:
        browser.evaluate(f"(() => {{ const moved = structuredClone(playground.state.light); moved.fields.radius *= 1.2; playground.change({change}); }})()")
        browser.settle()
        pictures.append(browser.screenshot("#view"))
    for what, before, after in zip(["another technique", "a larger light"], pictures, pictures[1:]):
        part = changed(before, after)
        assert part > 0.004, f"{what} changes only {100 * part:.2f} % of the scene"
    print("1400 and 400 px wide: not blank, and no wider than the window")


def addresses(browser):
    """Addresses with nonsense after the # show the page; what can be used of them is."""
    for nonsense in ["%%%", "[]", "null", '{"light":"Lamp"}', '{"p":[1,2]}', '{"p":["x",0,0],"dots":"many","light":{"name":"Disk","fields":{"radius":"wide"}}}', '{"lesson":99}', '{"ways":3}', '{"probe":{"u":[1]},"sequence":"dice","projection":"none","panel":"x","n":[0,0,0]}']:
        browser.open(PAGE.as_uri() + "#" + nonsense)
        browser.settle()
        assert browser.evaluate("document.getElementById('failure').hidden && playground.view.truth > 0"), nonsense
    browser.open(address(light={"name": "Disk", "fields": {"radius": 0.25}}, p=[0.5, 0, 0]))
    assert browser.evaluate("[playground.state.light.fields.radius, playground.state.p[0]]") == [0.25, 0.5]
    print("addresses: what is wrong in them is left out")


def damaged(browser):
    """A page whose library is broken, missing, or another one, says so in a sentence."""
    text = PAGE.read_text()
    start = text.index('id="library">') + len('id="library">')
    end = text.index("</script>", start)
    other = base64.b64encode(gzip.compress(b"\0asm\1\0\0\0")).decode()
    cases = {"broken": text[:start] + text[start:end][: (end - start) // 2] + text[end:], "missing": text[:start] + text[end:]}
    cases["garbled"] = text[:start] + "*" + text[start + 1 :]
    cases["another"] = text[:start] + other + text[end:]
    cases["cut"] = text[: end - 1000]
    cases["without scripts"] = text[: text.index("<script>")] + "</body></html>"
    for name, damage in cases.items():
        path = FOLDER / "damaged.html"
        path.write_text(damage)
        browser.open(address(path), "!document.getElementById('failure').hidden")
        # the scripts have tried the library by then
        time.sleep(0.3)
        said, hidden = browser.evaluate("[document.getElementById('failure').innerText, document.getElementById('page').hidden]")
        print(f"{name}: {said}")
        assert hidden and len(said) > 40 and said.endswith("."), said
    path.unlink()


def pace(browser):
    """How long frames take while the light moves, with 4,096 samples by each technique and formula."""
    for light in ["Triangle", "Sphere", "Rectangle", "Polygon"]:
        browser.open(address(light=light, dots=4096))
        move = (
            "(async (seconds) => { const frame = () => new Promise((done) => requestAnimationFrame(done)), start = playground.state.light; let ticks = 0;"
            " const first = performance.now(); while (performance.now() - first < 1000 * seconds) { const by = [Math.sin(++ticks / 9) / 5, 0, 0];"
            " playground.scene.put(playground.scene.handles.find((h) => ['whole light', 'center'].includes(h.name)), [0, 1.2, 0].map((x, k) => x + by[k]));"
            " await frame(); } return [ticks, (performance.now() - first) / 1000, playground.cards.flatMap((c) => c.ways).length]; })"
        )
        browser.evaluate(f"{move}(1)")
        before = browser.busy()
        ticks, seconds, ways = browser.evaluate(f"{move}(2)")
        each = 1000 * (browser.busy() - before) / ticks
        print(f"{light}, 4,096 samples by each of {ways} ways: {each:.1f} ms of processor time a frame, {ticks / seconds:.0f} frames a second beside what else this machine does")


def in_firefox(test):
    """Every light in Firefox, where it is there."""
    path = firefox.find()
    if not path:
        print("no Firefox here: the page is not tested in it")
        return
    browser = firefox.Firefox(path)
    try:
        browser.resize(1400, 1100)
        browser.open(address())
        for light in browser.evaluate("[...document.getElementById('light').options].map((o) => o.value)"):
            browser.evaluate(f"(() => {{ const e = document.getElementById('light'); e.value = '{light}'; e.dispatchEvent(new Event('change')); }})()")
            assert test.take(browser, "Firefox")["light"] == light
        browser.open(address(light="Triangle", probe={"u": [0.25, 0.5]}))
        browser.settle()
        keep("firefox.png", browser)
        assert colors(browser.screenshot("#view"))[0] > 100, "the scene is blank in Firefox"
        print("Firefox shows every light")
    finally:
        browser.close()


def main():
    text = PAGE.read_bytes()
    size = len(gzip.compress(text, 9))
    print(f"{PAGE.name}: {len(text):,} bytes, {size:,} compressed")
    assert size <= LIMIT, f"the page has more than {LIMIT:,} bytes"
    assert not re.search(rb"(src|href)=\"(?!data:)", text), "the page loads something"
    FOLDER.mkdir(parents=True, exist_ok=True)
    browser, test = Browser(find()), Test()
    began = time.monotonic()
    try:
        browser.open(address())
        lights(browser, test)
        hands(browser, test)
        breaks(browser, test)
        first_view(browser, test)
        ends(browser, test)
        a_light_stays(browser)
        lecture(browser)
        looks(browser)
        addresses(browser)
        assert not browser.errors(), browser.errors()
        in_firefox(test)
        print(f"{test.compare():,} numbers of {len(test.shown)} states have the bits of the core")
        damaged(browser)
        pace(browser)
    finally:
        browser.close()
    print(f"all is well, after {time.monotonic() - began:.0f} s")


main()
