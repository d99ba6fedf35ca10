// The pixels of an image, and the canvas that shows them.

/** The image of a way as the server has it now, or of the reference; null if there is none yet. */
async function receive(way) {
  const answer = await fetch(way ? `image?technique=${way.technique}&sampler=${way.sampler}` : "reference");
  if (answer.status === 404 || answer.status === 503) return null;
  if (!answer.ok) throw new Error(`${answer.status}`);
  const buffer = await answer.arrayBuffer();
  const [width, height, version] = new Uint32Array(buffer, 0, 3);
  const n = width * height;
  return {
    width,
    height,
    version,
    mean: new Float32Array(buffer, 16, 3 * n),
    variance: new Float32Array(buffer, 16 + 12 * n, 3 * n),
    samples: new Uint32Array(buffer, 16 + 24 * n, n),
  };
}

/** The index of the pixel of an image, which may be coarse, at a place in one of this size. */
const indexAt = ({ width, height }, [x, y], size) => Math.floor((y * height) / size[1]) * width + Math.floor((x * width) / size[0]);
/** Variance of a pixel's mean: the mean over the channels. */
const spread = ({ variance }, i) => (variance[3 * i] + variance[3 * i + 1] + variance[3 * i + 2]) / 3;
const brightness = ({ mean }, i) => RED * mean[3 * i] + GREEN * mean[3 * i + 1] + BLUE * mean[3 * i + 2];
/** The mean of an image over pixels and channels, once for each of its versions. */
const whole = ({ mean }) => mean.reduce((sum, x) => sum + x, 0) / mean.length;
/** The number of a pixel that each map shows, in colours by its logarithm. */
const MAPS = {
  samples: ({ samples }) => (i) => samples[i],
  variance: (pixels) => (i) => spread(pixels, i),
  error: (pixels) => {
    pixels.whole ??= whole(pixels);
    return (i) => Math.sqrt(spread(pixels, i)) / pixels.whole;
  },
  luminance: (pixels) => (i) => brightness(pixels, i),
  red: ({ mean }) => (i) => mean[3 * i],
  green: ({ mean }) => (i) => mean[3 * i + 1],
  blue: ({ mean }) => (i) => mean[3 * i + 2],
};
/** The least and greatest number of a map, for its colours. Numbers that differ by more than 10⁶ have the same colour. */
function ends(pixels, layer) {
  let [low, high] = [Infinity, 0];
  const of = MAPS[layer](pixels);
  const { length } = pixels.samples;
  for (let i = 0; i < length; i++) {
    const x = of(i);
    if (x < low && x > 0) low = x;
    if (x > high && x < Infinity) high = x;
  }
  return high > 0 ? [Math.max(low, high * 1e-6), high] : [1, 1];
}
/** Pixels from the greatest known variance down. */
function worst(pixels) {
  const known = [...pixels.samples.keys()].filter((i) => Number.isFinite(spread(pixels, i)));
  return known.sort((a, b) => spread(pixels, b) - spread(pixels, a)).slice(0, 100);
}

/** A − B at a pixel, the mean over the channels; or that over the mean of B. */
function gap(a, b, i, isRelative) {
  const mean = (p) => (p.mean[3 * i] + p.mean[3 * i + 1] + p.mean[3 * i + 2]) / 3;
  return isRelative ? (mean(a) - mean(b)) / mean(b) : mean(a) - mean(b);
}
/** The greatest difference but for the hundredth part of the pixels that differ most. */
function widest(a, b, isRelative) {
  const all = Float64Array.from(a.samples, (_, i) => Math.abs(gap(a, b, i, isRelative))).filter(Number.isFinite).sort();
  const most = all[Math.floor(0.99 * (all.length - 1))];
  return [0, most > 0 ? most : 1];
}

/** An image in colours, made anew only if it or its colours change. */
class Drawn {
  constructor() {
    this.canvas = document.createElement("canvas");
  }
  update(pixels, layer, gain, range, other) {
    const key = [pixels.version, layer, gain, range, other && other.version].join();
    if (this.key === key && this.pixels === pixels && this.other === other) return;
    Object.assign(this, { key, pixels, other });
    const { width, height } = pixels;
    if (this.canvas.width !== width || this.canvas.height !== height || !this.image) {
      this.canvas.width = width;
      this.canvas.height = height;
      this.context = this.canvas.getContext("2d");
      this.image = this.context.createImageData(width, height);
    }
    const words = new Uint32Array(this.image.data.buffer);
    if (layer === "radiance") this.tones(words, pixels.mean, gain);
    else if (other) this.difference(words, pixels, other, layer === "relative", range);
    else this.map(words, pixels, layer, range);
    this.context.putImageData(this.image, 0, 0);
  }
  tones(words, mean, [first, second]) {
    for (let i = 0, k = 0; i < words.length; i++, k += 3) {
      words[i] = tone(
        f32(f32(mean[k] * first) * second),
        f32(f32(mean[k + 1] * first) * second),
        f32(f32(mean[k + 2] * first) * second),
      );
    }
  }
  difference(words, a, b, isRelative, [, most]) {
    this.counts = new Float64Array(BINS);
    for (let i = 0; i < words.length; i++) {
      const x = gap(a, b, i, isRelative);
      words[i] = Number.isFinite(x) ? tint(x / most) : NONE;
      if (Number.isFinite(x)) this.count((x / most + 1) / 2);
    }
  }
  /** Counts a pixel whose colour is this part of the way along the bar. */
  count(t) {
    this.counts[Math.max(0, Math.min(BINS - 1, Math.floor(t * BINS)))]++;
  }
  map(words, pixels, layer, [low, high]) {
    const of = MAPS[layer](pixels);
    const scale = high > low ? 1 / Math.log(high / low) : 0;
    this.counts = new Float64Array(BINS);
    for (let i = 0; i < words.length; i++) {
      const x = of(i);
      const t = scale === 0 ? 0.5 : Math.log(x / low) * scale;
      const isKnown = Number.isFinite(x) && x >= 0;
      words[i] = isKnown ? heat(t) : NONE;
      if (isKnown) this.count(t);
    }
  }
}
/** Bars of a histogram. */
const BINS = 96;

const ratio = () => window.devicePixelRatio || 1;
/** Gives a canvas the pixels of its place. */
function fit(canvas) {
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio()));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio()));
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
}

/** Where pixels of the image are on the canvas: `zoom` canvas pixels each, with `centre` in the middle. */
class Lens {
  constructor() {
    Object.assign(this, { size: [1, 1], centre: [0.5, 0.5], zoom: 1, isFit: true });
  }
  /** Shows all of an image of this size, unless a hand has chosen what is shown. */
  update(canvas, [width, height]) {
    if (this.size[0] !== width || this.size[1] !== height) Object.assign(this, { size: [width, height], isFit: true });
    if (!this.isFit) return;
    this.centre = [width / 2, height / 2];
    this.zoom = Math.min(canvas.width / width, canvas.height / height);
    // whole numbers of pixels look sharp
    if (this.zoom >= 2) this.zoom = Math.floor(this.zoom);
  }
  toCanvas(canvas, [x, y]) {
    return [(x - this.centre[0]) * this.zoom + canvas.width / 2, (y - this.centre[1]) * this.zoom + canvas.height / 2];
  }
  toImage(canvas, [x, y]) {
    return [(x - canvas.width / 2) / this.zoom + this.centre[0], (y - canvas.height / 2) / this.zoom + this.centre[1]];
  }
  move([dx, dy]) {
    this.isFit = false;
    this.centre = this.centre.map((c, k) => Math.max(0, Math.min(this.size[k], c - [dx, dy][k] / this.zoom)));
  }
  /** Zooms by a factor, and keeps what is at this place of the canvas where it is. */
  scale(canvas, factor, at) {
    const before = this.toImage(canvas, at);
    this.zoom = Math.max(1 / 64, Math.min(256, this.zoom * factor));
    const after = this.toCanvas(canvas, before);
    this.move([at[0] - after[0], at[1] - after[1]]);
  }
  /** Shows a pixel, if it is not shown. */
  reveal(canvas, [x, y]) {
    const [a, b] = [this.toCanvas(canvas, [x, y]), this.toCanvas(canvas, [x + 1, y + 1])];
    const beyond = (low, high, end) => (low < 0 ? -low : high > end ? end - high : 0);
    const move = [beyond(a[0], b[0], canvas.width), beyond(a[1], b[1], canvas.height)];
    if (move[0] || move[1]) this.move(move);
  }
}

/** Draws the image of this size, the other one right of the line with the names of both, the part that receives samples, and the pixel that is read. */
function draw(canvas, lens, size, first, second, wipe, names, crop, cursor) {
  fit(canvas);
  const context = canvas.getContext("2d");
  lens.update(canvas, size);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.imageSmoothingEnabled = lens.zoom < 2 && lens.zoom !== 1;
  const [left, top] = lens.toCanvas(canvas, [0, 0]).map(Math.round);
  const place = [left, top, ...size.map((side) => Math.round(side * lens.zoom))];
  context.drawImage(first, ...place);
  if (second) {
    const x = Math.round(wipe * canvas.width);
    context.save();
    context.beginPath();
    context.rect(x, 0, canvas.width - x, canvas.height);
    context.clip();
    context.fillStyle = "#12151c";
    context.fillRect(x, 0, canvas.width - x, canvas.height);
    context.drawImage(second, ...place);
    context.restore();
    context.fillStyle = "#ffffff";
    context.fillRect(x - ratio(), 0, 2 * ratio(), canvas.height);
    // a handle, and what is left and right of it
    context.beginPath();
    context.arc(x, canvas.height / 2, 9 * ratio(), 0, 2 * Math.PI);
    context.fill();
    context.font = `${13 * ratio()}px system-ui, sans-serif`;
    context.textBaseline = "top";
    names.forEach((name, side) => {
      const text = side ? `B: ${name} ▸` : `◂ A: ${name}`;
      const [wide, off] = [context.measureText(text).width + 12 * ratio(), 8 * ratio()];
      const at = side ? x + off : x - off - wide;
      context.fillStyle = "#12151ccc";
      context.fillRect(at, off, wide, 22 * ratio());
      context.fillStyle = "#ffffff";
      context.fillText(text, at + 6 * ratio(), off + 4 * ratio());
    });
  }
  if (crop) {
    const [x0, y0] = lens.toCanvas(canvas, [crop[0], crop[1]]);
    const [x1, y1] = lens.toCanvas(canvas, [crop[2], crop[3]]);
    for (const [color, dash] of [
      ["#000000", []],
      ["#ffd98a", [6 * ratio(), 6 * ratio()]],
    ]) {
      context.strokeStyle = color;
      context.lineWidth = 2 * ratio();
      context.setLineDash(dash);
      context.strokeRect(x0, y0, x1 - x0, y1 - y0);
    }
    context.setLineDash([]);
  }
  if (cursor) {
    const [x, y] = lens.toCanvas(canvas, [cursor[0] + 0.5, cursor[1] + 0.5]);
    const half = Math.max(4 * ratio(), lens.zoom / 2 + 1.5 * ratio());
    for (const [color, width] of [
      ["#000000", 3],
      ["#ffffff", 1.2],
    ]) {
      context.strokeStyle = color;
      context.lineWidth = width * ratio();
      context.strokeRect(x - half, y - half, 2 * half, 2 * half);
    }
  }
}
