// Maps of samples: the unit square, all directions from the point, and the surface of the light.

/** Places of the shade of a map along each side: fewer while the hand moves. */
const GRID = 64;
const DRAFT = 24;

/** Directions as a disk of equal areas: the zenith in the middle, the horizon at radius 1, the nadir at √2. */
const EQUAL_AREA = {
  radius: Math.SQRT2,
  to: ([x, y, z]) => {
    const k = 1 / Math.sqrt(Math.max(1e-12, 1 + z));
    return [x * k, y * k];
  },
  from: ([x, y]) => {
    const s = x * x + y * y;
    const k = Math.sqrt(2 - s);
    return s <= 2 ? [x * k, y * k, 1 - s] : null;
  },
};
/** Directions as their projection to the ground, so that areas are projected solid angles. */
const NUSSELT = {
  radius: 1.05,
  to: ([x, y, z]) => (z >= 0 ? [x, y] : null),
  from: ([x, y]) => (x * x + y * y <= 1 ? [x, y, Math.sqrt(1 - x * x - y * y)] : null),
};
const PROJECTIONS = { "equal-area": EQUAL_AREA, nusselt: NUSSELT };

class SampleMap {
  constructor(canvas) {
    this.canvas = canvas;
    this.pixels = new Pixels(canvas);
    this.shades = new Float32Array(GRID * GRID);
    this.window = { x: 0.5, y: 0.5, half: 0.54 };
  }
  /** Pixels of a place of the map, whose y goes upwards. */
  toPixel([x, y]) {
    const { width, height } = this.pixels;
    const { window: w } = this;
    return [width * (0.5 + (0.5 * (x - w.x)) / w.half), height * (0.5 - (0.5 * (y - w.y)) / w.half)];
  }
  /** The place of the map at parts of the canvas' sides. */
  place(a, b) {
    const { window: w } = this;
    return [w.x + w.half * (2 * a - 1), w.y + w.half * (1 - 2 * b)];
  }
  /** Begins a frame with so many places of the shade along each side. */
  begin(side) {
    this.pixels.begin();
    this.side = side;
    this.shade = this.shades.subarray(0, side * side);
    this.shade.fill(0);
  }
  /** The place of the map in the middle of a place of the shade. */
  middleOf(k) {
    return this.place(((k % this.side) + 0.5) / this.side, (Math.floor(k / this.side) + 0.5) / this.side);
  }
  /** Fills the canvas with the shade, relative to its greatest value. */
  paint() {
    const { words, width, height } = this.pixels;
    const { shade, side } = this;
    let most = 0;
    for (let i = 0; i < shade.length; i++) if (shade[i] > most && shade[i] < Infinity) most = shade[i];
    if (!(most > 0)) {
      words.fill(BACK);
      return;
    }
    const colors = Uint32Array.from(shade, (x) => SHADES[x > 0 ? Math.min(255, 24 + Math.round((231 * x) / most)) : 0]);
    const columns = Uint16Array.from({ length: width }, (_, i) => Math.floor((i * side) / width));
    for (let j = 0; j < height; j++) {
      const row = Math.floor((j * side) / height) * side;
      const start = j * width;
      for (let i = 0; i < width; i++) words[start + i] = colors[row + columns[i]];
    }
  }
  outline(points, color, dash = []) {
    const { context } = this.pixels;
    context.strokeStyle = color;
    context.lineWidth = ratio();
    context.setLineDash(dash);
    path(
      context,
      points.map((q) => this.toPixel(q)),
    );
    context.stroke();
    context.setLineDash([]);
  }
  /** Draws the first n samples; `place` writes where one is to its target, or returns false. */
  dots(n, colors, place) {
    const size = Math.max(1, Math.round(dotSize(n) * ratio()));
    const { pixels, window: w } = this;
    const q = [0, 0];
    const kx = (0.5 * pixels.width) / w.half;
    const ky = (0.5 * pixels.height) / w.half;
    for (let i = 0; i < n; i++) {
      if (place(i, q))
        pixels.dot(0.5 * pixels.width + kx * (q[0] - w.x), 0.5 * pixels.height - ky * (q[1] - w.y), size, colors[i]);
    }
  }
  mark(q) {
    if (q && Number.isFinite(q[0] + q[1])) cross2(this.pixels.context, this.toPixel(q), 7 * ratio());
  }
}

/** All directions from the point, or those about the light. */
class DirectionMap extends SampleMap {
  /** Aims the map: the frame of the normal, the projection, and the window that shows the light if it is to be near. */
  aim(view, projection, near) {
    this.axes = [...basis(view.n), view.n];
    this.projection = PROJECTIONS[projection];
    this.rims = rimsOf(view)
      .map((rim) => rim.map((w) => this.toMap(w)).filter(Boolean))
      .filter((rim) => rim.length > 1);
    const all = this.rims.flat();
    this.window = { x: 0, y: 0, half: this.projection.radius };
    if (near && all.length) {
      const range = (k) => {
        const list = all.map((q) => q[k]);
        return [Math.min(...list), Math.max(...list)];
      };
      const [x, y] = [range(0), range(1)];
      const half = 0.6 * Math.max(x[1] - x[0], y[1] - y[0]);
      if (half > 0 && half < 0.8) this.window = { x: (x[0] + x[1]) / 2, y: (y[0] + y[1]) / 2, half };
    }
  }
  toMap(w) {
    return this.projection.to(this.axes.map((axis) => dot(w, axis)));
  }
  fromMap(q) {
    const local = this.projection.from(q);
    return (
      local && add(add(times(this.axes[0], local[0]), times(this.axes[1], local[1])), times(this.axes[2], local[2]))
    );
  }
  draw(way, view, options, probe) {
    const { pixels } = this;
    this.begin(options.draft ? DRAFT : GRID);
    if (way.fill && options.shade !== "none") this.fillShade(way, view, options);
    this.paint();
    const {
      direction: [x, y, z],
    } = way.samples;
    const [s, t, n] = this.axes;
    const to = this.projection === NUSSELT;
    this.dots(options.dots, options.colors, (i, q) => {
      const a = x[i] * s[0] + y[i] * s[1] + z[i] * s[2];
      const b = x[i] * t[0] + y[i] * t[1] + z[i] * t[2];
      const c = x[i] * n[0] + y[i] * n[1] + z[i] * n[2];
      const k = to ? (c >= 0 ? 1 : NaN) : 1 / Math.sqrt(1 + c);
      q[0] = a * k;
      q[1] = b * k;
      return q[0] - q[0] === 0 && q[1] - q[1] === 0;
    });
    pixels.end();
    const horizon = ROUND.slice(0, 64);
    this.outline(horizon, INK.line, [3 * ratio(), 3 * ratio()]);
    for (const rim of this.rims) this.outline(rim, INK.light);
    if (probe) this.mark(this.toMap(probe));
  }
  fillShade(way, view, options) {
    const { grid } = way.library;
    const { shade } = this;
    const cosines = new Float32Array(shade.length);
    for (let k = 0; k < shade.length; k++) {
      const w = this.fromMap(this.middleOf(k));
      for (let c = 0; c < 3; c++) grid.w[c][k] = w ? w[c] : 0;
      cosines[k] = w ? dot(w, view.n) : -1;
    }
    way.fill(shade.length, grid.w, grid.pdf);
    for (let k = 0; k < shade.length; k++) {
      // beyond the nadir there is no direction
      const pdf = grid.w[0][k] || grid.w[1][k] || grid.w[2][k] ? grid.pdf[k] : 0;
      shade[k] =
        options.shade === "value"
          ? pdf > 0 && cosines[k] > 0
            ? cosines[k] / pdf
            : 0
          : options.shade === "cosine"
            ? pdf > 0
              ? Math.max(0, cosines[k])
              : 0
            : pdf;
    }
  }
}
/** The rims of a light as directions from the point. */
function rimsOf(view) {
  const {
    light: { fields: f },
    shape,
    p,
  } = view;
  if (shape.sphere) {
    const d = sub(f.center, p);
    const d2 = dot(d, d);
    const sin2 = (f.radius * f.radius) / d2;
    if (!(sin2 < 1)) return [];
    return [capRim(unit(d), Math.sqrt(sin2), Math.sqrt(1 - sin2))];
  }
  if (f.one_minus_cos !== undefined)
    return [capRim(unit(f.direction), Math.sqrt(f.one_minus_cos * (2 - f.one_minus_cos)), 1 - f.one_minus_cos)];
  const outlines = shape.rims || shape.outlines;
  return outlines.map((points) => finely(points, points.length > 8 ? 1 : 12).map((x) => unit(sub(x, p))));
}
function capRim(axis, sin, cos) {
  const [a, b] = basis(axis);
  return ROUND.map(([c, s]) => add(times(axis, cos), times(add(times(a, c), times(b, s)), sin)));
}
/** A closed outline with more points, since its edges are curves on the map. */
function finely(points, steps) {
  return points.flatMap((a, i) => {
    const b = points[(i + 1) % points.length];
    return Array.from({ length: steps }, (_, k) => along(a, sub(b, a), k / steps));
  });
}

/** The surface of the light. */
class LightMap extends SampleMap {
  draw(way, view, options, probe) {
    const { pixels } = this;
    const { shape } = view;
    this.begin(options.draft ? DRAFT : GRID);
    if (shape.at && options.shade !== "none") this.fillShade(way, view, options);
    this.paint();
    if (shape.mapOutline) this.dots(options.dots, options.colors, placer(way, view));
    pixels.end();
    if (shape.mapOutline) this.outline(shape.mapOutline, INK.light);
    const q = [0, 0];
    if (probe && view.locate && view.locate(...probe, q)) this.mark(q);
  }
  /** The direction to a place of the map. */
  direction(view, q) {
    const there = view.shape.at && view.shape.at(q[0], q[1], view.p);
    return there && unit(sub(there.point, view.p));
  }
  fillShade(way, view, options) {
    const { grid } = way.library;
    const { shade } = this;
    const { p, n } = view;
    const factors = new Float32Array(shade.length);
    const needsPdf = way.fill && (options.shade === "pdf" || options.shade === "value");
    if (!needsPdf && (options.shade === "pdf" || options.shade === "value")) return;
    for (let k = 0; k < shade.length; k++) {
      const q = this.middleOf(k);
      const there = view.shape.at(q[0], q[1], p);
      const d = there ? sub(there.point, p) : [0, 0, 0];
      const r = length(d);
      const w = r > 0 ? times(d, 1 / r) : [0, 0, 0];
      for (let c = 0; c < 3; c++) grid.w[c][k] = w[c];
      const cos = Math.max(0, dot(w, n));
      const other = there && there.normal ? Math.abs(dot(w, there.normal)) : 1;
      factors[k] = !there
        ? 0
        : {
            pdf: other / (r * r),
            value: cos,
            cosine: cos,
            lightCosine: other,
            distance: 1 / (r * r),
            product: (cos * other) / (r * r),
          }[options.shade];
    }
    if (needsPdf) way.fill(shade.length, grid.w, grid.pdf);
    for (let k = 0; k < shade.length; k++) {
      const pdf = grid.pdf[k];
      shade[k] =
        options.shade === "pdf"
          ? factors[k] * pdf
          : options.shade === "value"
            ? pdf > 0
              ? factors[k] / pdf
              : 0
            : factors[k];
    }
  }
}

/** The unit square with its strata, the pairs of the sequence, and the numbers of the direction under the cursor. */
class SquareMap extends SampleMap {
  paintStrata() {
    const { width, height } = this.pixels;
    const words = new Uint32Array(width * height).fill(BACK);
    for (let j = 0; j < height; j++) {
      for (let i = 0; i < width; i++) {
        const [u, v] = this.place((i + 0.5) / width, (j + 0.5) / height);
        if (u < 0 || v < 0 || u >= 1 || v >= 1) continue;
        const c = stratumOf(u, v);
        words[j * width + i] = packed((c & 255) * 0.3, ((c >> 8) & 255) * 0.3, ((c >> 16) & 255) * 0.3);
      }
    }
    return words;
  }
  draw(u, options, marks) {
    const { pixels } = this;
    pixels.begin();
    if (!this.strata || this.strata.length !== pixels.words.length) this.strata = this.paintStrata();
    pixels.words.set(this.strata);
    this.dots(options.dots, options.colors, (i, q) => {
      q[0] = u[0][i];
      q[1] = u[1][i];
      return true;
    });
    pixels.end();
    this.outline(SQUARE, INK.line);
    const { context } = pixels;
    context.font = `bold ${13 * ratio()}px sans-serif`;
    for (const { u: q, name } of marks) {
      this.mark(q);
      if (!q || !name) continue;
      const [x, y] = this.toPixel(q);
      context.lineWidth = 3 * ratio();
      context.strokeStyle = "#000";
      context.strokeText(name, x + 6 * ratio(), y - 6 * ratio());
      context.fillStyle = INK.strong;
      context.fillText(name, x + 6 * ratio(), y - 6 * ratio());
    }
  }
}
