"""The index of the project's site, and its test in a browser.

site.py write FOLDER [PLAYGROUND]: writes index.html; standard input has a line for each chart, its scene and a description. PLAYGROUND is
anything but empty if there is a playground. The gallery has the captions of render/README.md.
site.py test FOLDER [PICTURES]: opens every page at 1,400 and 400 pixels in a headless Chromium, and keeps pictures.
site.py readme FOLDER DOC: keeps pictures of the first screens of README.md and of the core's documentation in the folder DOC, at both widths."""

import re
import subprocess
import sys
import tempfile
from html import escape
from itertools import product
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STYLE = """
:root { color-scheme: light dark; }
body { max-width: 70rem; margin: 0 auto; padding: 1rem; font: 16px/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
img { max-width: 100%; height: auto; }
ul { padding-left: 1.2rem; }
.gallery { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 20rem), 1fr)); gap: 1rem; align-items: end; }
figure { margin: 0; }
figcaption { font-size: 0.9rem; }
"""


def captions():
    """The pictures of the renderer's README, each with what it shows: its path in the site, and its text."""
    text = (ROOT / "render/README.md").read_text()
    for about, path in re.findall(r"!\[([^\]]+)\]\((gallery/[^)]+)\)", text):
        yield path, about


def first_words():
    """The first paragraph of the README, its picture with the alternative text, and the head of the table beneath."""
    text = (ROOT / "README.md").read_text()
    paragraph = text.split("\n\n")[1].replace("`", "")
    about, path = re.search(r"!\[([^\]]+)\]\(render/(gallery/[^)]+)\)", text).groups()
    said, left, right = re.search(r"^\| (in .+?) \| (.+?) \| (.+?) \|$", text, re.M).groups()
    return paragraph, about, path, f"{said[0].upper()}{said[1:]}: {left}; {right}"


def write(folder, playground, charts):
    paragraph, about, picture, halves = first_words()
    links = [("playground/index.html", "Playground", "drag a light, and see where samples go")] if playground else []
    links += [("judge.html", "Judgements", "where the library and textbook formulas lose accuracy")]
    items = [f'<li><a href="{path}">{name}</a>: {what}</li>' for path, name, what in links]
    items += [f'<li><a href="chart/{escape(name)}/report.html">{escape(name)}</a>: {escape(what)}</li>' for name, what in charts]
    figures = [f'<figure><img loading="lazy" src="{path}" alt="{escape(what)}"><figcaption>{escape(what)}</figcaption></figure>' for path, what in captions()]
    page = f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Étendue</title><link rel="icon" href="data:,"><style>{STYLE}</style></head><body>
<h1>Étendue</h1>
<p>{escape(paragraph)}</p>
<figure><img src="{picture}" alt="{escape(about)}"><figcaption>{escape(halves)}</figcaption></figure>
<h2>Try and measure</h2>
<ul>
{chr(10).join(items[: len(links)])}
</ul>
<h2>Charts: the error of each technique against its time</h2>
<ul>
{chr(10).join(items[len(links) :])}
</ul>
<h2>Gallery</h2>
<div class="gallery">
{chr(10).join(figures)}
</div>
</body></html>
"""
    (folder / "index.html").write_text(page)


def chromium():
    sys.path.insert(0, str(ROOT / "core/playground/tests"))
    from browser import Browser, find

    path = find()
    if not path:
        sys.exit("site.py: there is no Chromium here: no page is opened")
    return Browser(path)


# pages of the documentation: what it begins with, a light, and what all lights share
PAGES = {"index": "index.html", "triangle": "light/struct.Triangle.html", "sampler": "light/trait.LightSampler.html"}


def readme(folder, documentation):
    folder.mkdir(parents=True, exist_ok=True)
    # as on a page of a repository: wide tables scroll
    style = STYLE + "table { display: block; overflow-x: auto; } td, th { padding: 0.2em 0.6em; border: 1px solid #8888; } pre { overflow-x: auto; }"
    with tempfile.TemporaryDirectory() as scratch:
        head = Path(scratch) / "head.html"
        head.write_text(f'<base href="{ROOT.as_uri()}/"><style>{style}</style>')
        subprocess.run(["rustdoc", ROOT / "README.md", "-o", scratch, "--markdown-no-toc", "--html-in-header", head], check=True)
        browser = chromium()
        try:
            pages = {"readme": Path(scratch) / "README.html"} | {f"documentation-{name}": documentation / page for name, page in PAGES.items()}
            for (name, page), (width, height) in product(pages.items(), [(1400, 1000), (400, 800)]):
                browser.resize(width, height)
                browser.open(page.as_uri(), "[...document.images].every((i) => i.naturalWidth)")
                wide = browser.evaluate("document.documentElement.scrollWidth")
                assert wide <= width, f"{name} is {wide} pixels wide in a window of {width}"
                (folder / f"{name}-{width}.png").write_bytes(browser.screenshot(whole=False))
        finally:
            browser.close()


def test(folder, pictures):
    index = folder / "index.html"
    browser = chromium()
    try:
        browser.open(index.as_uri(), "document.body")
        pages = browser.evaluate("[...document.querySelectorAll('a')].map((a) => a.href)")
        assert pages, "the index has no links"
        for url in [index.as_uri(), *pages]:
            assert Path(url.removeprefix("file://")).is_file(), f"{url} is missing"
            name = Path(url).relative_to(folder.as_uri()).as_posix()
            for width in [1400, 400]:
                browser.resize(width, 1000)
                # the playground unpacks its library first
                browser.open(url, "window.playground" if name.startswith("playground/") else "document.body")
                # pictures that are loaded late, too
                broken = browser.evaluate(
                    "Promise.all([...document.images].map((i) => { i.loading = 'eager'; return i.decode().then(() => '', () => i.src.slice(0, 80)); })).then((all) => all.filter(Boolean))"
                )
                assert not broken, f"{name}: pictures are missing: {broken}"
                wide = browser.evaluate("document.documentElement.scrollWidth")
                assert wide <= width, f"{name} is {wide} pixels wide in a window of {width}"
                if width > 1000:
                    clipped = browser.evaluate(
                        "[...document.querySelectorAll('body *:not(input)')].filter((e) => getComputedStyle(e).overflowX !== 'visible' && e.scrollWidth > e.clientWidth && e.clientWidth).map((e) => e.tagName + ' ' + (e.getAttribute('aria-label') ?? e.id))"
                    )
                    assert not clipped, f"{name}: in a window of {width} pixels, {clipped} scroll sideways"
                if pictures and url == index.as_uri():
                    pictures.mkdir(parents=True, exist_ok=True)
                    (pictures / f"site-{width}.png").write_bytes(browser.screenshot())
            assert not browser.errors(), f"{name}: {browser.errors()}"
        print(f"{1 + len(pages)} pages: they fit 1,400 and 400 pixels, lack no picture, and have no errors")
    finally:
        browser.close()


command, folder, *more = sys.argv[1:]
folder = Path(folder).resolve()
if command == "write":
    write(folder, more and more[0], [line.split("\t") for line in sys.stdin.read().splitlines() if line])
elif command == "readme":
    readme(folder, Path(more[0]).resolve())
else:
    test(folder, Path(more[0]) if more else None)
