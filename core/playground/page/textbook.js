// The textbooks' formulas, as they are usually written, in single precision: every operation is rounded.
// A formula is prepared for a light relative to the point; it then writes a direction and its pdf for a pair of numbers to `drawn`.

const f32 = Math.fround;
const drawn = { x: 0, y: 0, z: 0, pdf: 0, away: false };
const PI = f32(Math.PI);
const TAU = f32(2 * Math.PI);
const dotF = (a, b) => f32(f32(f32(a[0] * b[0]) + f32(a[1] * b[1])) + f32(a[2] * b[2]));
const crossF = (a, b) =>
  [0, 1, 2].map((i) => f32(f32(a[(i + 1) % 3] * b[(i + 2) % 3]) - f32(a[(i + 2) % 3] * b[(i + 1) % 3])));
const addF = (a, b) => a.map((x, i) => f32(x + b[i]));
const subF = (a, b) => a.map((x, i) => f32(x - b[i]));
const timesF = (a, s) => a.map((x) => f32(x * s));
const rootF = (x) => f32(Math.sqrt(x));
const lengthF = (a) => rootF(dotF(a, a));
const unitF = (a) => {
  const l = lengthF(a);
  return a.map((x) => f32(x / l));
};
const dotS = (x, y, z, b) => f32(f32(f32(x * b[0]) + f32(y * b[1])) + f32(z * b[2]));

function write(x, y, z, pdf) {
  const l = f32(Math.sqrt(f32(f32(f32(x * x) + f32(y * y)) + f32(z * z))));
  drawn.x = f32(x / l);
  drawn.y = f32(y / l);
  drawn.z = f32(z / l);
  drawn.pdf = pdf;
  drawn.away = false;
}
/** Writes the direction to a point of a flat light with the pdf d²/(cosθ' A). */
function writeByArea(x, y, z, normal, area) {
  write(x, y, z, 0);
  const d2 = f32(f32(f32(x * x) + f32(y * y)) + f32(z * z));
  drawn.pdf = f32(d2 / f32(f32(Math.abs(dotS(drawn.x, drawn.y, drawn.z, normal))) * area));
}

/** A point of a flat shape, uniform by area, with the pdf d²/(cosθ' A). */
function byArea(corner, s, t, half) {
  const c = crossF(s, t);
  const area = f32(lengthF(c) * (half ? 0.5 : 1));
  const normal = unitF(c);
  return (u, v) => {
    let a = u;
    let b = v;
    if (half) {
      const r = rootF(u);
      a = f32(r * f32(1 - v));
      b = f32(r * v);
    }
    const at = (k) => f32(corner[k] + f32(f32(s[k] * a) + f32(t[k] * b)));
    writeByArea(at(0), at(1), at(2), normal, area);
  };
}
/** A disk by area: Shirley and Chiu's square to disk. */
function diskByArea(center, n, radius) {
  const normal = unitF(n);
  const [s, t] = basis(normal).map(single);
  const area = f32(PI * f32(radius * radius));
  return (u, v) => {
    const x = f32(f32(2 * u) - 1);
    const y = f32(f32(2 * v) - 1);
    const wide = Math.abs(x) > Math.abs(y);
    const r = f32(radius * (wide ? x : y));
    const phi =
      x === 0 && y === 0 ? 0 : wide ? f32(f32(PI / 4) * f32(y / x)) : f32(f32(PI / 2) - f32(f32(PI / 4) * f32(x / y)));
    const a = f32(r * f32(Math.cos(phi)));
    const b = f32(r * f32(Math.sin(phi)));
    const at = (k) => f32(center[k] + f32(f32(s[k] * a) + f32(t[k] * b)));
    writeByArea(at(0), at(1), at(2), normal, area);
  };
}
/** Directions within a cone, by its cosine: cosθ = 1 − u(1 − cosσ), sinθ = √(1 − cos²θ). */
function cone(axis, oneMinusCos) {
  const n = unitF(axis);
  const [s, t] = basis(n).map(single);
  const pdf = f32(1 / f32(TAU * oneMinusCos));
  return (u, v) => {
    const cos = f32(1 - f32(u * oneMinusCos));
    const sin = rootF(Math.max(0, f32(1 - f32(cos * cos))));
    const phi = f32(TAU * v);
    const a = f32(sin * f32(Math.cos(phi)));
    const b = f32(sin * f32(Math.sin(phi)));
    const at = (k) => f32(f32(n[k] * cos) + f32(f32(s[k] * a) + f32(t[k] * b)));
    write(at(0), at(1), at(2), pdf);
  };
}
function sphereCone(center, radius) {
  const sin2 = f32(f32(radius * radius) / dotF(center, center));
  return cone(center, f32(1 - rootF(Math.max(0, f32(1 - sin2)))));
}
/** The surface of a sphere by area. */
function sphereByArea(center, radius) {
  const area = f32(f32(4 * PI) * f32(radius * radius));
  return (u, v) => {
    const z = f32(1 - f32(2 * u));
    const r = rootF(Math.max(0, f32(1 - f32(z * z))));
    const phi = f32(TAU * v);
    const normal = [f32(r * f32(Math.cos(phi))), f32(r * f32(Math.sin(phi))), z];
    writeByArea(
      f32(center[0] + f32(radius * normal[0])),
      f32(center[1] + f32(radius * normal[1])),
      f32(center[2] + f32(radius * z)),
      normal,
      area,
    );
    // the far side does not emit towards the point
    drawn.away = dotS(drawn.x, drawn.y, drawn.z, normal) >= 0;
  };
}
/** A spherical triangle with its solid angle from the angles between planes, and Arvo's map. */
class Arvo {
  constructor([a, b, c]) {
    [this.a, this.b, this.c] = [a, b, c].map(unitF);
    const planes = [crossF(this.a, this.b), crossF(this.b, this.c), crossF(this.c, this.a)].map(unitF);
    const angle = (p, q) => f32(Math.acos(clamp(-dotF(p, q), -1, 1)));
    const [alpha, beta, gamma] = [
      angle(planes[0], planes[2]),
      angle(planes[1], planes[0]),
      angle(planes[2], planes[1]),
    ];
    this.solidAngle = f32(f32(f32(alpha + beta) + gamma) - PI);
    this.sinAlpha = f32(Math.sin(alpha));
    this.cosAlpha = f32(Math.cos(alpha));
    this.cosC = dotF(this.a, this.b);
    this.side = unitF(subF(this.c, timesF(this.a, dotF(this.a, this.c))));
  }
  sample(u, v, pdf) {
    const { a, b, side, sinAlpha, cosAlpha } = this;
    const area = f32(u * this.solidAngle);
    const sinArea = f32(Math.sin(area));
    const cosArea = f32(Math.cos(area));
    const s = f32(f32(sinArea * cosAlpha) - f32(cosArea * sinAlpha));
    const t = f32(f32(cosArea * cosAlpha) + f32(sinArea * sinAlpha));
    const p = f32(t - cosAlpha);
    const q = f32(s + f32(sinAlpha * this.cosC));
    const above = f32(f32(f32(f32(q * t) - f32(p * s)) * cosAlpha) - q);
    const below = f32(f32(f32(q * s) + f32(p * t)) * sinAlpha);
    const cos = clamp(f32(above / below), -1, 1);
    const sin = rootF(Math.max(0, f32(1 - f32(cos * cos))));
    const x = f32(f32(a[0] * cos) + f32(side[0] * sin));
    const y = f32(f32(a[1] * cos) + f32(side[1] * sin));
    const w = f32(f32(a[2] * cos) + f32(side[2] * sin));
    const d = dotS(x, y, w, b);
    const z = f32(1 - f32(v * f32(1 - d)));
    const r = rootF(Math.max(0, f32(1 - f32(z * z))));
    const tx = f32(x - f32(b[0] * d));
    const ty = f32(y - f32(b[1] * d));
    const tz = f32(w - f32(b[2] * d));
    const k = f32(r / f32(Math.sqrt(f32(f32(f32(tx * tx) + f32(ty * ty)) + f32(tz * tz)))));
    write(f32(f32(b[0] * z) + f32(tx * k)), f32(f32(b[1] * z) + f32(ty * k)), f32(f32(b[2] * z) + f32(tz * k)), pdf);
  }
}
/** A fan of spherical triangles, of which the first number chooses one. */
function fan(triangles) {
  const parts = triangles.map((t) => new Arvo(t));
  const whole = parts.reduce((sum, part) => f32(sum + part.solidAngle), 0);
  const pdf = f32(1 / whole);
  return (u, v) => {
    let rest = f32(u * whole);
    let k = 0;
    while (k + 1 < parts.length && rest >= parts[k].solidAngle) rest = f32(rest - parts[k++].solidAngle);
    parts[k].sample(f32(rest / parts[k].solidAngle), v, pdf);
  };
}
const fanOf = (corners) => fan(corners.slice(2).map((c, i) => [corners[0], corners[i + 1], c]));

/** A spherical rectangle: Ureña, Fajardo and King 2013. */
function rectangle(corner, s, t) {
  const ls = lengthF(s);
  const lt = lengthF(t);
  const xAxis = s.map((x) => f32(x / ls));
  const yAxis = t.map((x) => f32(x / lt));
  let zAxis = crossF(xAxis, yAxis);
  let z = dotF(corner, zAxis);
  if (z > 0) {
    z = -z;
    zAxis = timesF(zAxis, -1);
  }
  const x0 = dotF(corner, xAxis);
  const y0 = dotF(corner, yAxis);
  const x1 = f32(x0 + ls);
  const y1 = f32(y0 + lt);
  const around = [
    [x0, y0, z],
    [x1, y0, z],
    [x1, y1, z],
    [x0, y1, z],
  ];
  const n = around.map((c, i) => unitF(crossF(c, around[(i + 1) % 4])));
  const g = n.map((c, i) => f32(Math.acos(clamp(-dotF(c, n[(i + 1) % 4]), -1, 1))));
  const b0 = n[0][2];
  const b1 = n[2][2];
  const k = f32(f32(TAU - g[2]) - g[3]);
  const whole = f32(f32(g[0] + g[1]) - k);
  const pdf = f32(1 / whole);
  const z2 = f32(z * z);
  return (u, v) => {
    const angle = f32(f32(u * whole) + k);
    const sin = f32(Math.sin(angle));
    const cos = f32(Math.cos(angle));
    const f = f32(f32(f32(cos * b0) - b1) / sin);
    const c = clamp(f32(f32(1 / rootF(f32(f32(f * f) + f32(b0 * b0)))) * (f > 0 ? 1 : -1)), -1, 1);
    const x = clamp(f32(-f32(c * z) / rootF(Math.max(1e-12, f32(1 - f32(c * c))))), x0, x1);
    const d2 = f32(f32(x * x) + z2);
    const d = rootF(d2);
    const h0 = f32(y0 / rootF(f32(d2 + f32(y0 * y0))));
    const h1 = f32(y1 / rootF(f32(d2 + f32(y1 * y1))));
    const h = f32(h0 + f32(v * f32(h1 - h0)));
    const h2 = f32(h * h);
    const y = h2 < 1 - 1e-6 ? f32(f32(h * d) / rootF(f32(1 - h2))) : y1;
    const at = (i) => f32(f32(xAxis[i] * x) + f32(f32(yAxis[i] * y) + f32(zAxis[i] * z)));
    write(at(0), at(1), at(2), pdf);
  };
}
/** Equiangular sampling of a line by arc tangents from the foot of the perpendicular, with the pdf r/α. */
function equiangular(start, edge) {
  const size = lengthF(edge);
  const e = edge.map((x) => f32(x / size));
  const near = dotF(start, e);
  const foot = subF(start, timesF(e, near));
  const height = lengthF(foot);
  const low = f32(Math.atan(f32(near / height)));
  const high = f32(Math.atan(f32(f32(near + size) / height)));
  const pdf = f32(height / f32(high - low));
  return (u) => {
    const t = f32(height * f32(Math.tan(f32(f32(f32(1 - u) * low) + f32(u * high)))));
    write(f32(foot[0] + f32(e[0] * t)), f32(foot[1] + f32(e[1] * t)), f32(foot[2] + f32(e[2] * t)), pdf);
  };
}
/** A line by its length, with the pdf r²/(length sinγ). */
function lineByLength(start, edge) {
  const size = lengthF(edge);
  return (u) => {
    const point = addF(start, timesF(edge, u));
    const r2 = dotF(point, point);
    const cross2 = lengthF(crossF(point, edge));
    const sin = f32(cross2 / f32(rootF(r2) * size));
    write(point[0], point[1], point[2], f32(r2 / f32(size * sin)));
  };
}

const ARVO = "Arvo 1995; solid angle by Girard";
const AREA = "by area, distance²/(cosθ' A)";
const relativeF = (x, p) => subF(single(x), p);
/** The formulas of each light: beside which technique they stand, their source, and how they are prepared. */
const TEXTBOOK = {
  Sphere: [
    { by: "by_area", source: "uniform sphere", prepare: (f, p) => sphereByArea(relativeF(f.center, p), f.radius) },
    {
      by: "by_solid_angle",
      source: "cone, cosσ = √(1 − R²/d²)",
      prepare: (f, p) => sphereCone(relativeF(f.center, p), f.radius),
    },
  ],
  Triangle: [
    { by: "by_area", source: AREA, prepare: (f, p) => byArea(relativeF(f.v0, p), f.e1, f.e2, true) },
    {
      by: "by_solid_angle",
      source: ARVO,
      prepare: (f, p) => {
        const c = relativeF(f.v0, p);
        return fan([[c, addF(c, f.e1), addF(c, f.e2)]]);
      },
    },
  ],
  Parallelogram: [
    { by: "by_area", source: AREA, prepare: (f, p) => byArea(relativeF(f.corner, p), f.edge_s, f.edge_t, false) },
    { by: "by_solid_angle", source: `two triangles; ${ARVO}`, prepare: (f, p) => fanOf(corners(f, p)) },
  ],
  Rectangle: [
    { by: "by_area", source: AREA, prepare: (f, p) => byArea(relativeF(f.corner, p), f.edge_s, f.edge_t, false) },
    {
      by: "by_solid_angle",
      source: "Ureña et al. 2013",
      prepare: (f, p) => rectangle(relativeF(f.corner, p), f.edge_s, f.edge_t),
    },
  ],
  Polygon: [
    { by: "by_solid_angle", source: `a fan; ${ARVO}`, prepare: (f, p) => fanOf(f.corners.map((c) => relativeF(c, p))) },
  ],
  Disk: [{ by: "by_area", source: AREA, prepare: (f, p) => diskByArea(relativeF(f.center, p), f.normal, f.radius) }],
  Line: [
    { by: "by_length", source: "r²/(length sinγ)", prepare: (f, p) => lineByLength(relativeF(f.start, p), f.edge) },
    { by: "by_angle", source: "Kulla and Fajardo 2012", prepare: (f, p) => equiangular(relativeF(f.start, p), f.edge) },
  ],
  Sun: [
    {
      by: "by_solid_angle",
      source: "cone by its cosine",
      prepare: (f) => cone(f.direction, f32(1 - f32(1 - f.one_minus_cos))),
    },
  ],
};
function corners(f, p) {
  const c = relativeF(f.corner, p);
  const a = addF(c, f.edge_s);
  return [c, a, addF(a, f.edge_t), addF(c, f.edge_t)];
}
