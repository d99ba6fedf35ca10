"""Drives the pages of `etendue chart` and `etendue-judge` in a headless Chromium: wide, narrow, by keyboard and in print.

pages.py PROGRAMS [FOLDER]: the folder of the programs that write the pages, and a folder that keeps pictures of them. Half a minute, most of it for the
measurements that the pages show."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "core/playground/tests"))
from browser import Browser, find

CHART = "etendue chart quads --quick --size 24x18 --spp 1,16 --replicates 2 -o"
# which says that textbooks are wrong
JUDGE = "etendue-judge own --quick --textbooks --page"
# of A4 between margins of a centimetre, in CSS pixels
PRINTED = 718
CONTROLS = "button, select, input, textarea, summary, a[href], [tabindex]:not([tabindex='-1'])"
# names an element for a message
SCRIPT = """
window.say = (e) => e.tagName.toLowerCase() + (e.id ? '#' + e.id : '') + (typeof e.className === 'string' && e.className ? '.' + e.className.replaceAll(' ', '.') : '')
  + ' “' + (e.getAttribute('aria-label') ?? e.textContent).trim().slice(0, 30) + '”';
window.shown = (e) => e.checkVisibility() && e.getBoundingClientRect().width > 0;
window.controls = [...document.querySelectorAll(CONTROLS)].filter((e) => shown(e) && !e.disabled);
window.scrolling = () => [...document.querySelectorAll('body *')].filter((e) => getComputedStyle(e).overflowX !== 'visible' && e.scrollWidth > e.clientWidth && shown(e));
// what sticks out of the page or of its drawing, and is in no box that scrolls
window.outside = () => [...document.querySelectorAll('body *')].filter((e) => {
  const right = e.getBoundingClientRect().right - 1, drawing = e.ownerSVGElement;
  const cut = right > document.documentElement.clientWidth && !scrolling().some((box) => box.contains(e));
  return shown(e) && (cut || drawing && right > drawing.getBoundingClientRect().right);
});
"""


def open_page(browser, page):
    browser.open(page.as_uri(), "document.body")
    browser.evaluate(SCRIPT.replace("CONTROLS", json.dumps(CONTROLS)))


def names(browser, expression):
    return browser.evaluate(f"({expression}).map(say)")


def fits(browser, page, width, may_scroll):
    """The page does not scroll sideways; of its boxes, only those may that the keyboard reaches, and only where the page is narrow."""
    browser.resize(width, 1000)
    open_page(browser, page)
    wide, seen = browser.evaluate("[document.documentElement.scrollWidth, document.documentElement.clientWidth]")
    assert wide <= seen == width, f"{page.name} is {wide} pixels wide in a window of {width}"
    boxes = "scrolling()" if not may_scroll else f"scrolling().filter((e) => !e.matches({json.dumps(CONTROLS)}) && !e.querySelector({json.dumps(CONTROLS)}))"
    for wrong in [boxes, "outside()"]:
        found = names(browser, wrong)
        assert not found, f"{page.name}, {width} pixels: {wrong.split('(')[0]}: {found}"


def by_tab(browser, page):
    """Tab reaches every control once a round, forwards and backwards, shows where it is, and scrolls it into view."""
    wanted = names(browser, "controls")
    assert wanted, f"{page.name} has no control"
    browser.evaluate("document.activeElement.blur(); scrollTo(0, 0); window.reached = []")
    for back in [False, True]:
        if back:
            browser.evaluate("reached = [document.activeElement]")
        for _ in wanted[back:]:
            browser.key("Tab", back)
            fault = browser.evaluate(
                """(() => {
                  const e = document.activeElement, style = getComputedStyle(e), box = e.getBoundingClientRect(), bar = document.querySelector('nav');
                  if (e === document.body) return 'the focus has left the page after ' + reached.length + ' controls';
                  reached.push(e);
                  const covered = bar && !bar.contains(e) && getComputedStyle(bar).position === 'sticky' ? bar.getBoundingClientRect().bottom : 0;
                  if (style.outlineStyle === 'none' || parseFloat(style.outlineWidth) < 1) return say(e) + ' does not show that it has the focus';
                  if (box.bottom < covered + 5 || box.top > innerHeight - 5) return say(e) + ' has the focus out of sight';
                })()"""
            )
            assert not fault, f"{page.name}: {fault}"
        missing = names(browser, "controls.filter((e) => !reached.includes(e))")
        assert not missing, f"{page.name}: Tab does not reach {missing}"
    return len(wanted)


def press(browser, selector, key):
    browser.evaluate(f"document.querySelector({json.dumps(selector)}).focus()")
    browser.key(key)


def chart_by_keyboard(browser, page):
    """Keys do in the chart's page what the mouse does."""
    hidden = "document.querySelectorAll('.scene tr[data-series].off').length"
    before = browser.evaluate(hidden)
    for key in [" ", "Enter"]:
        press(browser, "nav .chip", key)
        after = browser.evaluate(hidden)
        assert after != before, f"{page.name}: the key {key!r} on a technique shows and hides nothing"
        before = after


def printed(browser, page):
    """On paper nothing is cut, and nothing is folded."""
    browser.call("Emulation.setEmulatedMedia", media="print")
    fits(browser, page, PRINTED, False)
    folded = names(browser, "[...document.querySelectorAll('details:not([open])')]")
    assert not folded, f"{page.name}: in print, {folded} are folded"
    browser.call("Emulation.setEmulatedMedia", media="")


def main():
    chromium = find()
    if not chromium:
        print("pages.py: there is no Chromium here: the pages of `etendue chart` and `etendue-judge` are not tested")
        return
    programs = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for command, code in [(f"{CHART} {folder / 'chart'}", 0), (f"{JUDGE} {folder / 'judge.html'}", 1)]:
            program, *arguments = command.split()
            done = subprocess.run([programs / program, *arguments], capture_output=True, text=True)
            assert done.returncode == code, f"{command}: {done.returncode}, {done.stderr}"
        browser = Browser(chromium)
        for page in [folder / "chart/report.html", folder / "judge.html"]:
            for width in [1400, 400]:
                fits(browser, page, width, width < 1000)
                reached = by_tab(browser, page)
                if len(sys.argv) > 2:
                    kept = Path(sys.argv[2])
                    kept.mkdir(parents=True, exist_ok=True)
                    (kept / f"{page.stem}-{width}.png").write_bytes(browser.screenshot())
            if page.stem == "report":
                chart_by_keyboard(browser, page)
            printed(browser, page)
            complaints = browser.errors()
            assert not complaints, f"{page.name}: {complaints}"
            print(f"{page.name}: fits 1,400 and 400 pixels and paper; Tab reaches {reached} controls")
        browser.close()


main()
