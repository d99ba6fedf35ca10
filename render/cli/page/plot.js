// The estimated error against time, both in decades.

/** Okabe and Ito's colours, which the colour-blind tell apart. */
const SERIES = ["#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#d55e00"];
const nameOf = ({ technique, sampler }) => `${technique}, ${sampler}`;

/** Colours of images by their names, in the order in which they came. */
const colors = new Map();
function colorOf(way) {
  const name = nameOf(way);
  if (!colors.has(name)) colors.set(name, SERIES[colors.size % SERIES.length]);
  return colors.get(name);
}

/** The least and greatest of some numbers, as powers of ten with a part in between. */
function decades(numbers) {
  const logs = numbers.map(Math.log10);
  let [low, high] = [Math.min(...logs), Math.max(...logs)];
  if (high - low < 1) [low, high] = [(low + high - 1) / 2, (low + high + 1) / 2];
  return [low - 0.05 * (high - low), high + 0.05 * (high - low)];
}
/** Where lines of a scale are: at 1, 2 and 5 times powers of ten, at 1 and 3 times, or at the powers alone if that would be many. */
function ticks([low, high]) {
  const steps = high - low < 1.3 ? [1, 2, 5] : high - low < 3 ? [1, 3] : [1];
  const all = [];
  for (let k = Math.floor(low); k <= high; k++) for (const m of steps) all.push(m * 10 ** k);
  return all.filter((x) => Math.log10(x) >= low && Math.log10(x) <= high);
}

/** Draws the errors of all pictures that have one, the one that is shown last, and the target. */
function plot(canvas, pictures, shown, target) {
  fit(canvas);
  const context = canvas.getContext("2d");
  const { width, height } = canvas;
  const r = ratio();
  context.clearRect(0, 0, width, height);
  context.font = `${12 * r}px system-ui, sans-serif`;
  const lines = pictures.filter((p) => p.history.length && p.history.every(([s, e]) => s > 0 && e > 0));
  lines.sort((a, b) => (nameOf(a.way) === shown) - (nameOf(b.way) === shown));
  if (!lines.length) {
    context.fillStyle = "#9aa6ba";
    context.textAlign = "center";
    context.fillText("the error is not known yet", width / 2, height / 2);
    return;
  }
  const [left, top, right, bottom] = [70 * r, 12 * r, width - 12 * r, height - 34 * r];
  const x = decades(lines.flatMap((p) => p.history.map((point) => point[0])));
  const y = decades([...lines.flatMap((p) => p.history.map((point) => point[1])), ...(target ? [target] : [])]);
  const across = (s) => left + ((Math.log10(s) - x[0]) / (x[1] - x[0])) * (right - left);
  const down = (e) => bottom - ((Math.log10(e) - y[0]) / (y[1] - y[0])) * (bottom - top);
  const line = (points, color, thick, dash = []) => {
    context.strokeStyle = color;
    context.lineWidth = thick * r;
    context.setLineDash(dash.map((d) => d * r));
    context.beginPath();
    points.forEach(([a, b], i) => (i ? context.lineTo(a, b) : context.moveTo(a, b)));
    context.stroke();
    context.setLineDash([]);
  };
  context.fillStyle = "#b6c0d1";
  context.textAlign = "center";
  for (const s of ticks(x)) {
    line([[across(s), top], [across(s), bottom]], "#2b3342", 1);
    context.fillText(`${Number(s.toPrecision(1))}`, across(s), bottom + 14 * r);
  }
  context.fillText("seconds of rendering", (left + right) / 2, height - 5 * r);
  context.save();
  context.translate(14 * r, (top + bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.fillText("relative RMS error", 0, 0);
  context.restore();
  context.textAlign = "right";
  for (const e of ticks(y)) {
    line([[left, down(e)], [right, down(e)]], "#2b3342", 1);
    context.fillText(`${Number((100 * e).toPrecision(1))} %`, left - 5 * r, down(e) + 4 * r);
  }
  if (target) line([[left, down(target)], [right, down(target)]], "#ffffff", 1.5, [6, 5]);
  for (const p of lines) {
    const points = p.history.map(([s, e]) => [across(s), down(e)]);
    const color = colorOf(p.way);
    if (points.length > 1) line(points, color, nameOf(p.way) === shown ? 3 : 1.6);
    context.fillStyle = color;
    const [a, b] = points[points.length - 1];
    context.beginPath();
    context.arc(a, b, 3.5 * r, 0, 2 * Math.PI);
    context.fill();
  }
}
