// What is compared side by side: techniques of the core, textbooks' formulas, and directions of the surface; their samples and errors.

/** A way to sample the light: its samples for the same random numbers, the pdf of a direction, and its inverse if it has one. */
class Way {
  constructor(library, kind, name, source) {
    Object.assign(this, { library, kind, name, source, values: new Float64Array(MOST) });
  }
  get label() {
    return this.kind === "core" ? this.name : `${this.name}, ${this.source}`;
  }
}
class Technique extends Way {
  constructor(library, technique) {
    super(library, "core", spoken(technique.by), "");
    this.technique = technique;
    this.sampler = library.sampler(technique);
    this.samples = library.samples(MOST);
  }
  prepare(view) {
    this.library.prepare(this.sampler, view.numbers, view.p, view.n);
  }
  draw(n, u) {
    this.library.sample(this.sampler, n, u, this.samples);
  }
  pdf(w) {
    return this.library.pdfOf(this.sampler, w);
  }
  invert(w) {
    return this.library.invert(this.sampler, w);
  }
  sampleOf(u) {
    return this.library.sampleOf(this.sampler, u);
  }
  fill(n, w, pdf) {
    this.library.pdf(this.sampler, n, w, pdf);
  }
}
class Formula extends Way {
  constructor(library, row) {
    super(library, "textbook", `${spoken(row.by)}, textbook`, row.source);
    this.row = row;
    const column = () => new Float32Array(MOST);
    this.samples = { direction: [column(), column(), column()], pdf: column(), weight: column() };
  }
  prepare(view) {
    this.emits = view.emits;
    this.formula = this.row.prepare(view.light.fields, view.p);
  }
  draw(n, u) {
    const {
      direction: [x, y, z],
      pdf,
      weight,
    } = this.samples;
    const { formula } = this;
    for (let i = 0; i < n; i++) {
      formula(u[0][i], u[1][i]);
      x[i] = drawn.x;
      y[i] = drawn.y;
      z[i] = drawn.z;
      pdf[i] = drawn.pdf;
      // as a renderer would: a pdf that is not positive gives nothing, NaN gives NaN
      weight[i] = this.emits && !drawn.away && !(drawn.pdf <= 0) ? 1 / drawn.pdf : 0;
    }
  }
  sampleOf(u) {
    this.formula(Math.fround(u[0]), Math.fround(u[1]));
    return { direction: [drawn.x, drawn.y, drawn.z], pdf: drawn.pdf };
  }
}
/** Directions of the surface, whatever the light: those that miss it are worth 0. */
class Hemisphere extends Way {
  constructor(library, warp, hitter) {
    super(library, "surface", spoken(warp), "all directions of the surface");
    Object.assign(this, {
      warp,
      hitter,
      samples: { direction: library.samples(MOST).direction, pdf: library.floats(MOST), weight: library.floats(MOST) },
    });
  }
  prepare(view) {
    this.n = view.n;
    this.emits = view.emits;
    this.axes = basis(view.n);
    this.hitter.prepare(view);
  }
  draw(n, u) {
    const { direction, pdf, weight } = this.samples;
    const { w: local, pdf: hit } = this.library.grid;
    this.library.hemisphere(this.warp, n, u, local, pdf);
    const [s, t] = this.axes;
    for (let i = 0; i < n; i++) {
      for (let k = 0; k < 3; k++) direction[k][i] = s[k] * local[0][i] + t[k] * local[1][i] + this.n[k] * local[2][i];
    }
    // the light is where its default technique would draw
    this.library.pdf(this.hitter.sampler, n, direction, hit);
    for (let i = 0; i < n; i++) weight[i] = this.emits && hit[i] > 0 && pdf[i] > 0 ? 1 / pdf[i] : 0;
  }
  local(w) {
    return [dot(w, this.axes[0]), dot(w, this.axes[1]), dot(w, this.n)];
  }
  pdf(w) {
    return this.library.hemisphereInverse(this.warp, this.local(w)).pdf;
  }
  invert(w) {
    return this.library.hemisphereInverse(this.warp, this.local(w)).u;
  }
  fill(n, w, pdf) {
    for (let i = 0; i < n; i++) pdf[i] = this.pdf([w[0][i], w[1][i], w[2][i]]);
  }
}

/** Measures once what a sample by a way of the core costs, in nanoseconds. */
function time(way, u) {
  if (way.kind !== "core" || way.ns) return;
  const began = performance.now();
  let [spent, count] = [0, 0];
  while (spent < 3 && count < 256) {
    way.draw(MOST, u);
    count++;
    spent = performance.now() - began;
  }
  way.ns = (1e6 * spent) / (count * MOST);
}
/** All ways to sample a light, in the order of the list, each formula after its technique. */
function waysOf(library, name) {
  library.rewind();
  const light = kindOf(name);
  const ways = light.techniques.flatMap((technique) => {
    const beside = (TEXTBOOK[name] || []).filter((row) => row.by === technique.by);
    return [new Technique(library, technique), ...beside.map((row) => new Formula(library, row))];
  });
  const hitter = ways.find((way) => way.technique && way.technique.by === `by_${light.default}`);
  // a direction finds one point of these lights at most
  if (locator(shapeOf(overhead(name)), [0, 0, 0])) {
    for (const warp of ["uniform_hemisphere", "cosine_hemisphere"]) ways.push(new Hemisphere(library, warp, hitter));
  }
  return ways;
}

/** A light seen from a point, as the core and the formulas take it. */
function viewOf(state) {
  const light = rounded(state.light);
  const p = single(state.p);
  const n = single(state.n);
  const shape = shapeOf(light);
  const locate = locator(shape, p);
  const [truth, known] = irradiance(light, p, n);
  return { light, p, n, shape, locate, truth, known, numbers: numbers(state.light), emits: shape.emits(p) };
}

/** The values of samples: cosθ where it is positive, times the weight. */
function evaluate(way, n, [nx, ny, nz]) {
  const {
    direction: [x, y, z],
    weight,
  } = way.samples;
  const { values } = way;
  for (let i = 0; i < n; i++) {
    const cos = x[i] * nx + y[i] * ny + z[i] * nz;
    // NaN must remain NaN
    values[i] = cos <= 0 ? 0 : cos * weight[i];
  }
}
/** The mean of the values, over aligned blocks of m of them, and the root mean square of these blocks' relative errors. */
function blockError(values, n, m, truth) {
  let sum = 0;
  for (let first = 0; first < n; first += m) {
    let block = 0;
    for (let i = first; i < first + m; i++) block += values[i];
    const error = block / m / truth - 1;
    sum += error * error;
  }
  return Math.sqrt(sum / (n / m));
}
const meanOf = (values, n) => {
  let sum = 0;
  for (let i = 0; i < n; i++) sum += values[i];
  return sum / n;
};
/** Counts for which errors are shown. */
const COUNTS = [1, 16, 1024];

/** A function that writes where a sample is on the map of the light, and returns false where it is not there, or not finite. */
function placer(way, { shape, locate, p }) {
  const {
    direction: [x, y, z],
    normal,
    uv,
    weight,
  } = way.samples;
  const found = (target) => target[0] - target[0] === 0 && target[1] - target[1] === 0;
  if (uv && shape.uvToMap) {
    // the map is linear in the coordinates, so that three places tell it
    const o = shape.uvToMap([0, 0]);
    const s = shape.uvToMap([1, 0]);
    const t = shape.uvToMap([0, 1]);
    const [u, v] = uv;
    return (i, target) => {
      target[0] = o[0] + (s[0] - o[0]) * u[i] + (t[0] - o[0]) * v[i];
      target[1] = o[1] + (s[1] - o[1]) * u[i] + (t[1] - o[1]) * v[i];
      return found(target);
    };
  }
  if (normal && shape.sphere) {
    const [a, b] = basis(unit(sub(shape.sphere.center, p)));
    const [nx, ny, nz] = normal;
    return (i, target) => {
      target[0] = 0.5 + 0.5 * (nx[i] * a[0] + ny[i] * a[1] + nz[i] * a[2]);
      target[1] = 0.5 + 0.5 * (nx[i] * b[0] + ny[i] * b[1] + nz[i] * b[2]);
      // those that are worth nothing are on the far side
      return weight[i] > 0 && found(target);
    };
  }
  if (!locate) return () => false;
  return (i, target) => (way.kind !== "surface" || weight[i] > 0) && locate(x[i], y[i], z[i], target) && found(target);
}

/** A unit in the last place of a direction. */
const ROUNDING = 2 ** -23;
/** What the contract rules out, among the first samples: numbers that are not finite, a pdf below 0, a weight where the pdf is 0, and directions that miss the light by more than a hundredth of it and more than the rounding of a direction explains. Samples of pdf and weight 0 say that there is none, as below the horizon. */
function faults(way, { locate, shape }, n) {
  const {
    direction: [x, y, z],
    pdf,
    weight,
  } = way.samples;
  const q = [0, 0];
  const edges = shape.mapOutline && edgesOf(shape.mapOutline);
  const isOn = (a, b, c) => locate(a, b, c, q) && isNear(edges, q, reachOfRounding(locate, [a, b, c], q));
  let wrong = 0;
  let beside = 0;
  for (let i = 0; i < n; i++) {
    const sum = x[i] + y[i] + z[i] + pdf[i] + weight[i];
    if (sum - sum !== 0 || pdf[i] < 0 || (pdf[i] === 0 && weight[i] !== 0)) wrong++;
    else if (locate && pdf[i] > 0 && !isOn(x[i], y[i], z[i])) beside++;
  }
  return { wrong, beside };
}
/** How far the place of a direction on the map of the light moves if each of its coordinates is rounded. */
function reachOfRounding(locate, w, [x, y]) {
  const there = [0, 0];
  return w.reduce((sum, _, k) => {
    locate(...w.map((c, i) => (i === k ? c + ROUNDING : c)), there);
    return sum + Math.hypot(there[0] - x, there[1] - y);
  }, 0);
}
/** The edges of a convex outline, by unit normals that point inwards, and distances from the origin. */
const edgesOf = (outline) =>
  outline.flatMap((a, i) => {
    const b = outline[(i + 1) % outline.length];
    const ex = b[0] - a[0];
    const ey = b[1] - a[1];
    const size = Math.hypot(ex, ey);
    return size > 0 ? [[-ey / size, ex / size, (-ey * a[0] + ex * a[1]) / size]] : [];
  });
/** True within an outline, or beside it by at most a hundredth and a reach. */
function isNear(edges, q, reach) {
  const x = q[0];
  const y = q[1];
  // the rim of a disk has more edges than any polygon
  if (edges.length > 8) return Math.hypot(x - 0.5, y - 0.5) < 0.51 + reach;
  for (let i = 0; i < edges.length; i++) {
    const edge = edges[i];
    if (edge[0] * x + edge[1] * y - edge[2] < -0.01 - reach) return false;
  }
  return true;
}
