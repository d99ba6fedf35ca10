// Charts beside the maps: errors against counts, estimated variances, and the two integrals of the lecture.

const POWERS = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const raised = (k) => (k < 0 ? "⁻" : "") + [...String(Math.abs(k))].map((c) => POWERS[c]).join("");
/** A number as people read it. */
function say(x, digits = 3) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "NaN" : x > 0 ? "∞" : "−∞";
  if (x === 0) return "0";
  // rounded first, since 9.99 may become 10
  const [front, power] = x.toExponential(digits - 1).split("e");
  const k = Number(power);
  const text = k >= -3 && k < 6 ? String(Number(x.toPrecision(digits))) : `${front}·10${raised(k)}`;
  return text.replace("-", "−");
}

const tick = (t, { log, base = 10 }) =>
  log && base === 10 && (t < 0.01 || t > 1000) ? `10${raised(Math.round(Math.log10(t)))}` : log ? String(t) : say(t, 3);

/** A plot with axes, of which each may be logarithmic. */
class Plot {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }
  begin({ x, y, xLabel, yLabel }) {
    fit(this.canvas);
    const { context, canvas } = this;
    const r = ratio();
    this.box = [58 * r, 10 * r, canvas.width - 20 * r, canvas.height - 40 * r];
    Object.assign(this, { x, y, drawn: [], texts: [] });
    context.fillStyle = INK.back;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.font = `${11 * r}px sans-serif`;
    context.lineWidth = r;
    const [left, top, right, bottom] = this.box;
    const ticks = ({ low, high, log, base = 10 }) => {
      if (!log) return Array.from({ length: 6 }, (_, i) => low + ((high - low) * i) / 5);
      const from = Math.ceil(Math.log(low) / Math.log(base) - 1e-9);
      const to = Math.floor(Math.log(high) / Math.log(base) + 1e-9);
      const step = Math.ceil((to - from + 1) / 8);
      return Array.from({ length: Math.floor((to - from) / step) + 1 }, (_, i) => base ** (from + i * step));
    };
    context.textAlign = "center";
    for (const t of ticks(x)) {
      const px = this.px(t);
      context.strokeStyle = INK.faint;
      path(
        context,
        [
          [px, top],
          [px, bottom],
        ],
        false,
      );
      context.stroke();
      context.fillStyle = INK.text;
      this.write(tick(t, x), px, bottom + 15 * r);
    }
    context.textAlign = "right";
    for (const t of ticks(y)) {
      const py = this.py(t);
      context.strokeStyle = INK.faint;
      path(
        context,
        [
          [left, py],
          [right, py],
        ],
        false,
      );
      context.stroke();
      context.fillStyle = INK.text;
      this.write(tick(t, y), left - 5 * r, py + 4 * r);
    }
    context.textAlign = "center";
    this.write(xLabel, (left + right) / 2, canvas.height - 6 * r);
    context.save();
    context.translate(12 * r, (top + bottom) / 2);
    context.rotate(-Math.PI / 2);
    context.fillText(yLabel, 0, 0);
    context.restore();
  }
  /** Writes a text, and notes the box that it takes: left, top, right and bottom. */
  write(text, x, y) {
    const { context } = this;
    context.fillText(text, x, y);
    const m = context.measureText(text);
    this.texts.push({
      text,
      box: [
        x - m.actualBoundingBoxLeft,
        y - m.actualBoundingBoxAscent,
        x + m.actualBoundingBoxRight,
        y + m.actualBoundingBoxDescent,
      ],
    });
  }
  px(v) {
    return this.at(v, this.x, this.box[0], this.box[2]);
  }
  py(v) {
    return this.at(v, this.y, this.box[3], this.box[1]);
  }
  at(v, { low, high, log }, from, to) {
    const t = log ? Math.log(clamp(v, low, high) / low) / Math.log(high / low) : (v - low) / (high - low);
    return from + t * (to - from);
  }
  curve(points, color, dash = [], dots = false) {
    const { context } = this;
    const q = points.filter((p) => Number.isFinite(p[0] + p[1])).map(([a, b]) => [this.px(a), this.py(b)]);
    if (!q.length) return;
    // what a legend would hide: points a few pixels apart
    this.drawn.push(q[0]);
    q.slice(1).forEach((end, i) => {
      const steps = Math.ceil(Math.hypot(end[0] - q[i][0], end[1] - q[i][1]) / (4 * ratio())) || 1;
      for (let k = 1; k <= steps; k++) this.drawn.push([0, 1].map((axis) => q[i][axis] + ((end[axis] - q[i][axis]) * k) / steps));
    });
    context.setLineDash(dash.map((d) => d * ratio()));
    context.strokeStyle = color;
    context.lineWidth = 2 * ratio();
    path(context, q, false);
    context.stroke();
    context.setLineDash([]);
    context.fillStyle = color;
    if (dots)
      for (const [a, b] of q) {
        context.beginPath();
        context.arc(a, b, 3 * ratio(), 0, 7);
        context.fill();
      }
  }
  bars(list, color) {
    const { context } = this;
    context.fillStyle = color;
    for (const [from, to, height] of list) {
      const [a, b, y] = [this.px(from), this.px(to), this.py(height)];
      context.fillRect(a + 1, y, b - a - 1, this.box[3] - y);
    }
  }
  /** The names of the curves, at the left or right edge, where they hide the least of the curves. */
  legend(entries) {
    const { context, drawn } = this;
    const r = ratio();
    const [left, top, right, bottom] = this.box;
    context.textAlign = "left";
    const width = 36 * r + Math.max(...entries.map(([text]) => context.measureText(text).width));
    const height = (16 * entries.length + 6) * r;
    // from the corners inwards
    const heights = Array.from({ length: Math.max(1, Math.ceil((bottom - height - top) / (8 * r))) }, (_, i) => 8 * r * i);
    const places = heights.flatMap((inwards) => [
      [right - width, top + inwards],
      [left, bottom - height - inwards],
      [left, top + inwards],
      [right - width, bottom - height - inwards],
    ]);
    const hidden = ([x, y]) => drawn.filter(([a, b]) => a > x && a < x + width && b > y && b < y + height).length;
    const corner = places.reduce((best, next) => (hidden(next) < hidden(best) ? next : best));
    entries.forEach(([text, color, dash], i) => {
      const x = corner[0] + 6 * r;
      const y = corner[1] + (15 + 16 * i) * r;
      context.fillStyle = "rgba(18,21,28,0.75)";
      context.fillRect(x - 4 * r, y - 11 * r, width - 4 * r, 16 * r);
      context.strokeStyle = color;
      context.lineWidth = 2 * r;
      context.setLineDash((dash || []).map((d) => d * r));
      path(
        context,
        [
          [x, y - 4 * r],
          [x + 22 * r, y - 4 * r],
        ],
        false,
      );
      context.stroke();
      context.setLineDash([]);
      context.fillStyle = INK.text;
      this.write(text, x + 28 * r, y);
    });
  }
}

const sums = new Float64Array(MOST);
/** Root mean square relative errors of aligned blocks of 1, 2, 4, … values. */
function blockErrors(values, truth) {
  const list = [];
  sums.set(values);
  for (let m = 1, blocks = MOST; blocks >= 1; m *= 2, blocks /= 2) {
    const scale = 1 / (m * truth);
    let square = 0;
    for (let i = 0; i < blocks; i++) {
      const error = sums[i] * scale - 1;
      square += error * error;
    }
    list.push([m, Math.sqrt(square / blocks)]);
    for (let i = 0; i < blocks / 2; i++) sums[i] = sums[2 * i] + sums[2 * i + 1];
  }
  return list;
}
/** The same for a sequence of its own; stratified sets have each count apart. */
function sequenceErrors(library, way, view, sequence) {
  const run = (count) => {
    for (let first = 0, pixel = 0; first < MOST; first += count, pixel++)
      library.pairs(
        sequence,
        count,
        library.u.map((c) => c.subarray(first, first + count)),
        pixel,
        count,
      );
    way.draw(MOST, library.u);
    evaluate(way, MOST, view.n);
    return blockErrors(way.values, view.truth);
  };
  if (sequence !== "stratified") return run(MOST);
  return [0, 2, 4, 6, 8, 10, 12].map((k) => run(1 << k)[k]);
}
const SEQUENCES = { owen_sobol: "Owen–Sobol", stratified: "stratified (jittered)", independent: "independent" };

function drawErrors(plot, lines) {
  const all = lines.flatMap(([, , , points]) => points.map((q) => q[1])).filter((e) => Number.isFinite(e) && e > 0);
  const decade = (e, round) => 10 ** round(Math.log10(e));
  const low = clamp(decade(Math.min(...all, 0.1), Math.floor), 1e-8, 0.1);
  const high = clamp(decade(Math.max(...all, 1), Math.ceil), 1, 1e4);
  plot.begin({
    x: { low: 1, high: MOST, log: true, base: 2 },
    y: { low, high, log: true },
    xLabel: "samples",
    yLabel: "relative error, root mean square",
  });
  for (const [, color, dash, points] of lines) plot.curve(points, color, dash, true);
  plot.legend(lines.map(([name, color, dash]) => [name, color, dash]));
}

/** How four samples estimate their own variance: a histogram of the estimates over the true variance. */
function drawVariances(plot, values) {
  const n = values.length;
  const mean = meanOf(values, n);
  let variance = 0;
  for (const x of values) variance += (x - mean) ** 2 / (n - 1);
  const estimates = Array.from({ length: n / 4 }, (_, b) => {
    const four = values.subarray(4 * b, 4 * b + 4);
    const m = (four[0] + four[1] + four[2] + four[3]) / 4;
    return four.reduce((sum, x) => sum + (x - m) ** 2, 0) / 3 / variance;
  });
  const bins = 40;
  const high = 4;
  const counts = new Array(bins).fill(0);
  for (const e of estimates) counts[Math.min(bins - 1, Math.floor((e / high) * bins))]++;
  const most = Math.max(...counts) / estimates.length;
  plot.begin({
    x: { low: 0, high },
    y: { low: 0, high: most },
    xLabel: "variance that four samples estimate, over the true one",
    yLabel: "part of the estimates",
  });
  plot.bars(
    counts.map((c, i) => [(i * high) / bins, ((i + 1) * high) / bins, c / estimates.length]),
    SERIES[0],
  );
  plot.curve(
    [
      [1, 0],
      [1, most],
    ],
    SERIES[1],
  );
  const spread = Math.sqrt(estimates.reduce((sum, e) => sum + (e - 1) ** 2, 0) / estimates.length);
  const below = estimates.filter((e) => e < 0.5).length / estimates.length;
  const zero = estimates.filter((e) => e < 1e-6).length / estimates.length;
  return `One sample has the relative standard deviation ${say(Math.sqrt(variance) / mean)}. ${estimates.length.toLocaleString("en")} sets of four estimate its variance with a relative standard deviation of ${say(spread)}: ${say(100 * below, 2)} % of the sets say less than half of it, ${say(100 * zero, 2)} % say nothing at all.`;
}

/** f(x) = exp(−1000(x − ¼)²), and a pdf of two heights. */
const bump = (x) => Math.exp(-1000 * (x - 0.25) ** 2);
const BUMP = Math.sqrt(Math.PI / 1000);
function drawImportance(plot, inside, library) {
  const outside = (1 - 0.2 * inside) / 0.8;
  const pdf = (x) => (x > 0.15 && x < 0.35 ? inside : outside);
  library.pairs("independent", MOST);
  const place = (u) =>
    u < 0.15 * outside
      ? u / outside
      : u < 0.15 * outside + 0.2 * inside
        ? 0.15 + (u - 0.15 * outside) / inside
        : 0.35 + (u - 0.15 * outside - 0.2 * inside) / outside;
  const xs = Float64Array.from(library.u[0], place);
  const values = xs.map((x) => bump(x) / pdf(x));
  const found = values.reduce((sum, v) => sum + (v - BUMP) ** 2, 0) / MOST;
  const exact =
    integral((x) => bump(x) ** 2 / pdf(x), 0, 0.15, 32) +
    integral((x) => bump(x) ** 2 / pdf(x), 0.15, 0.35, 64) +
    integral((x) => bump(x) ** 2 / pdf(x), 0.35, 1, 32) -
    BUMP * BUMP;
  const uniform = Math.sqrt(Math.PI / 2000) - BUMP * BUMP;
  plot.begin({ x: { low: 0, high: 1 }, y: { low: 0, high: 5 }, xLabel: "x", yLabel: "f and pdf" });
  const steps = Array.from({ length: 801 }, (_, i) => i / 800);
  plot.curve(
    steps.map((x) => [x, bump(x)]),
    INK.light,
  );
  plot.curve(
    [
      [0, outside],
      [0.15, outside],
      [0.15, inside],
      [0.35, inside],
      [0.35, outside],
      [1, outside],
    ],
    SERIES[0],
  );
  for (const x of xs.subarray(0, 64))
    plot.curve(
      [
        [x, 0],
        [x, 0.12],
      ],
      SERIES[1],
    );
  plot.legend([
    ["f(x) = exp(−1000(x − ¼)²)", INK.light],
    ["pdf: drag its height", SERIES[0]],
    ["64 samples", SERIES[1]],
  ]);
  return `The pdf is ${say(inside)} between 0.15 and 0.35, and ${say(outside)} elsewhere. One sample has the variance ${say(exact, 4)} in closed form (${say(found, 4)} over ${MOST.toLocaleString("en")} samples): ${exact < uniform ? `${say(uniform / exact)} times less` : `${say(exact / uniform)} times more`} than with uniform samples.`;
}

/** The mean of n points of the unit square over an edge at a random place, or over x: variances against n. */
function stratificationErrors(library, smooth) {
  const total = MOST;
  const lines = { independent: [], stratified: [] };
  for (const sequence of Object.keys(lines)) {
    for (let n = 4; n <= 1024; n *= 4) {
      let square = 0;
      let runs = 0;
      for (let turn = 0; turn < 4; turn++) {
        for (let first = 0; first < total; first += n, runs++)
          library.pairs(
            sequence,
            n,
            library.u.map((c) => c.subarray(first, first + n)),
            runs,
            n,
          );
        for (let first = 0; first < total; first += n) {
          const edge = (0.5 + (first / n + (turn * total) / n) * 0.6180339887498949) % 1;
          let sum = 0;
          for (let i = first; i < first + n; i++)
            sum += smooth ? library.u[0][i] - 0.5 : (library.u[0][i] < edge) - edge;
          square += (sum / n) ** 2;
        }
      }
      lines[sequence].push([n, square / runs]);
    }
  }
  return lines;
}
function drawStratification(plot, library) {
  plot.begin({
    x: { low: 4, high: 1024, log: true, base: 2 },
    y: { low: 1e-8, high: 0.1, log: true },
    xLabel: "points n of the unit square",
    yLabel: "variance of their mean",
  });
  const rows = [
    ["edge", false, SERIES[1]],
    ["x", true, SERIES[0]],
  ];
  const entries = [];
  const said = [];
  for (const [name, smooth, color] of rows) {
    const lines = stratificationErrors(library, smooth);
    for (const [sequence, points] of Object.entries(lines)) {
      const dash = sequence === "independent" ? [5, 4] : [];
      plot.curve(points, color, dash, true);
      entries.push([`${name}, ${sequence}`, color, dash]);
      const [a, b] = [points[0], points[points.length - 1]];
      said.push(`${name}, ${sequence}: ${say(Math.log(b[1] / a[1]) / Math.log(b[0] / a[0]), 3)}`);
    }
  }
  plot.legend(entries);
  return `Measured slopes: ${said.join("; ")}. In theory −1 for independent points; for one in each stratum −1.5 over an edge, and −2 over x.`;
}
