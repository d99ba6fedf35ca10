"""Which texts of the playground collide."""

# what is written where numbers are, and the boxes that it takes on the page and in the chart
WRITTEN = """(() => {
  const page = [...document.querySelectorAll('.card th, .card td, .push span, .push output, .card h2 button, figcaption, #options p, #options label, #verdict')]
    .filter((e) => e.offsetParent && e.textContent.trim()).map((e) => {
      const range = document.createRange(); range.selectNodeContents([...e.childNodes].find((c) => e.matches('label') && c.nodeType === 3) || e);
      const { left, top, right, bottom } = range.getBoundingClientRect();
      const room = (e.closest('.card, .push, #options, #verdict') || e).getBoundingClientRect();
      return { text: e.textContent, box: [left, top, right, bottom], out: left < room.left - 1 || right > room.right + 1 };
    });
  const chart = playground.plot.texts.map(({ text, box }) => ({ text, box, out: box[0] < 0 || box[2] > playground.plot.canvas.width }));
  return [page, chart];
})()"""


def collisions(written):
    """Pairs of texts whose boxes overlap, and texts that are wider than what holds them."""
    found = [f"{w['text']!r} is too wide" for w in written if w["out"]]
    for i, a in enumerate(written):
        for b in written[:i]:
            wide = min(a["box"][2], b["box"][2]) - max(a["box"][0], b["box"][0])
            high = min(a["box"][3], b["box"][3]) - max(a["box"][1], b["box"][1])
            # lines of a table touch
            if wide > 0.5 and high > 2.5:
                found.append(f"{a['text']!r} is on {b['text']!r}")
    return found
