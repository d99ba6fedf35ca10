// Canvases: pixels for many dots, and the colours of strata.

/** Colours of the canvases, which are dark in both themes. */
const INK = {
  back: "#12151c",
  line: "#5d6a80",
  faint: "#2b3342",
  text: "#dfe6f1",
  strong: "#ffffff",
  light: "#ffd98a",
  mark: "#ff4f7b",
};
/** Okabe and Ito's colours, which the colour-blind tell apart. */
const SERIES = ["#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#f0e442", "#d55e00"];

const packed = (r, g, b) => (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
const BACK = packed(0x12, 0x15, 0x1c);
/** Shades from the background to a quiet blue, on which dots remain visible. */
const SHADES = Uint32Array.from({ length: 256 }, (_, i) => {
  const t = i / 255;
  return packed(18 + 76 * t, 21 + 92 * t, 28 + 118 * t);
});

const STRATA = 8;
/** Colours of the corners of the unit square: indigo, vermilion, sky blue, yellow. */
const CORNERS = [
  [96, 88, 224],
  [238, 92, 52],
  [70, 196, 240],
  [255, 222, 92],
];
/** The colour of a stratum: its place between the corners, every other one darker. */
function stratum(u, v) {
  const i = Math.min(STRATA - 1, Math.floor(u * STRATA));
  const j = Math.min(STRATA - 1, Math.floor(v * STRATA));
  const x = i / (STRATA - 1);
  const y = j / (STRATA - 1);
  const shade = (i + j) % 2 ? 0.72 : 1;
  const mix = (k) =>
    shade *
    ((1 - y) * ((1 - x) * CORNERS[0][k] + x * CORNERS[1][k]) + y * ((1 - x) * CORNERS[2][k] + x * CORNERS[3][k]));
  return packed(mix(0), mix(1), mix(2));
}
const STRATUM = Uint32Array.from({ length: STRATA * STRATA }, (_, i) =>
  stratum(((i % STRATA) + 0.5) / STRATA, (Math.floor(i / STRATA) + 0.5) / STRATA),
);
const stratumOf = (u, v) =>
  STRATUM[Math.min(STRATA - 1, Math.floor(v * STRATA)) * STRATA + Math.min(STRATA - 1, Math.floor(u * STRATA))];
/** The size of dots in CSS pixels for so many of them. */
const dotSize = (n) => (n <= 16 ? 6 : n <= 64 ? 5 : n <= 256 ? 4 : n <= 1024 ? 2.5 : 1.6);

const ratio = () => Math.min(2, window.devicePixelRatio || 1);
/** Counts changes of the layout, since asking for sizes in every frame takes long. */
const layout = { age: 0 };
/** Gives a canvas the pixels of its place. */
function fit(canvas) {
  if (canvas.age === layout.age) return;
  canvas.age = layout.age;
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio()));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio()));
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
}

/** The pixels of a canvas, which are written at once. */
class Pixels {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }
  begin() {
    fit(this.canvas);
    const { width, height } = this.canvas;
    if (!this.image || this.image.width !== width || this.image.height !== height) {
      this.image = this.context.createImageData(width, height);
      this.words = new Uint32Array(this.image.data.buffer);
    }
    this.width = width;
    this.height = height;
  }
  dot(x, y, size, color) {
    const { words, width, height } = this;
    const left = Math.floor(x - 0.5 * size + 0.5);
    const top = Math.floor(y - 0.5 * size + 0.5);
    if (left >= 0 && top >= 0 && left + size <= width && top + size <= height) {
      // nearly all dots: no part of them is beyond the edge
      for (let j = 0, start = top * width + left; j < size; j++, start += width) {
        for (let i = 0; i < size; i++) words[start + i] = color;
      }
      return;
    }
    for (let j = Math.max(0, top); j < Math.min(height, top + size); j++) {
      for (let i = Math.max(0, left); i < Math.min(width, left + size); i++) words[j * width + i] = color;
    }
  }
  end() {
    this.context.putImageData(this.image, 0, 0);
  }
}

/** Draws a polygon through points. */
function path(context, points, closed = true) {
  context.beginPath();
  points.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
  if (closed) context.closePath();
}
function cross2(context, [x, y], size) {
  for (const [color, width] of [
    ["#000", 4],
    [INK.mark, 2],
  ]) {
    context.strokeStyle = color;
    context.lineWidth = width * ratio();
    context.beginPath();
    context.moveTo(x - size, y);
    context.lineTo(x + size, y);
    context.moveTo(x, y - size);
    context.lineTo(x, y + size);
    context.stroke();
  }
}
