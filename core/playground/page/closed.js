// The irradiance of each light at a point without occlusion, for a radiance (or an intensity, or an irradiance) of 1, in double precision:
// what the estimates are compared with.

/** Nodes and weights of Gauss and Legendre's rule of 8 points on [-1, 1]. */
const GAUSS = (() => {
  const n = 8;
  return Array.from({ length: n }, (_, i) => {
    let x = Math.cos((Math.PI * (i + 0.75)) / (n + 0.5));
    let slope = 0;
    for (let k = 0; k < 20; k++) {
      let [a, b] = [1, x];
      for (let j = 2; j <= n; j++) [a, b] = [b, ((2 * j - 1) * x * b - (j - 1) * a) / j];
      slope = (n * (x * b - a)) / (x * x - 1);
      x -= b / slope;
    }
    return [x, 2 / ((1 - x * x) * slope * slope)];
  });
})();
function integral(f, low, high, panels) {
  const half = (high - low) / (2 * panels);
  let sum = 0;
  for (let k = 0; k < panels; k++) {
    for (const [x, weight] of GAUSS) sum += weight * f(low + half * (2 * k + 1 + x));
  }
  return sum * half;
}

/** Lambert's term of an edge: half of its angle, times the cosine between the normal of its plane through the point and n. */
function edgeTerm(a, b, n) {
  // not a × b, which cancels where the edge is short for its distance
  const normal = cross(a, sub(b, a));
  const size = length(normal);
  return size > 0 ? (0.5 * Math.atan2(size, dot(a, b)) * dot(normal, n)) / size : 0;
}
/** Lambert's formula for a convex polygon relative to the point, clipped to the horizon of n. */
function lambert(corners, n) {
  const above = [];
  corners.forEach((a, i) => {
    const b = corners[(i + 1) % corners.length];
    const ha = dot(a, n);
    const hb = dot(b, n);
    if (ha >= 0) above.push(a);
    if (ha < 0 !== hb < 0) above.push(along(a, sub(b, a), ha / (ha - hb)));
  });
  return Math.abs(above.reduce((sum, a, i) => sum + edgeTerm(a, above[(i + 1) % above.length], n), 0));
}
/** A cap of half-angle σ, by sin²σ and cos²σ, whose axis has the cosine `height` to the normal. Snyder 1996. */
function cap(sin2, cos2, height) {
  const sin = Math.sqrt(sin2);
  const cos = Math.sqrt(cos2);
  if (height >= sin) return Math.PI * sin2 * height;
  if (height <= -sin) return 0;
  const y = Math.sqrt((sin - height) * (sin + height));
  return Math.atan2(y, cos) + sin2 * height * Math.atan2(y, -cos * height) - y * cos;
}
/** The integral of cosθ sinγ ds / r² over a line, clipped to the horizon: γ from the line, s along it. */
function segment(a, edge, n) {
  const size = length(edge);
  const e = times(edge, 1 / size);
  const foot = along(a, e, -dot(a, e));
  const h = length(foot);
  const f = times(foot, 1 / h);
  const up = dot(n, f);
  const slope = dot(n, e);
  let [low, high] = [dot(a, e), dot(a, e) + size];
  // above the horizon where h up + t slope > 0
  const cut = (-h * up) / slope;
  if (slope > 0) low = Math.max(low, cut);
  else if (slope < 0) high = Math.min(high, cut);
  else if (up <= 0) return 0;
  if (!(low < high)) return 0;
  const to = (t) => 0.5 * (up * (Math.atan2(t, h) / h + t / (h * h + t * t)) - (slope * h) / (h * h + t * t));
  return to(high) - to(low);
}
/** A disk, by the integral of Lambert's edges over its rim, and where the horizon cuts it, the chord. */
function diskIrradiance(center, normal, radius, n) {
  const [a, b] = basis(unit(normal)).map((x) => times(x, radius));
  const at = (t) => add(center, add(times(a, Math.cos(t)), times(b, Math.sin(t))));
  const slope = (t) => add(times(a, -Math.sin(t)), times(b, Math.cos(t)));
  const term = (t) => {
    const r = at(t);
    return (0.5 * dot(cross(r, slope(t)), n)) / dot(r, r);
  };
  // n·at(t) = height + reach cos(t − phase)
  const height = dot(center, n);
  const reach = Math.hypot(dot(a, n), dot(b, n));
  const phase = Math.atan2(dot(b, n), dot(a, n));
  if (height <= -reach) return 0;
  if (height >= reach) return Math.abs(integral(term, 0, 2 * Math.PI, 48));
  const half = Math.acos(clamp(-height / reach, -1, 1));
  const [low, high] = [phase - half, phase + half];
  return Math.abs(integral(term, low, high, 48) + edgeTerm(at(high), at(low), n));
}
function patchIrradiance(shape, p, n) {
  const value = (x, y, weight) => {
    const { point, normal } = shape.at(x, y);
    const r = sub(point, p);
    const r2 = dot(r, r);
    const c = dot(r, n);
    const l = -dot(r, normal);
    return c > 0 && l > 0 ? (weight * c * l) / (r2 * r2) : 0;
  };
  return integral((x) => integral((y) => value(x, y, shape.area(x, y)), 0, 1, 8), 0, 1, 8);
}

const BY_QUADRATURE = "by quadrature";
const CLOSED = "in closed form";

/** The irradiance by a light at the point p of a surface with the normal n, and how it is known. A normal that rounding made longer or shorter counts in proportion, as it does in the values of samples. */
function irradiance(light, p, n) {
  const [value, known] = ofUnit(light, p, unit(n));
  return [value * length(n), known];
}
function ofUnit(light, p, n) {
  const f = light.fields;
  const from = (x) => sub(x, p);
  const flatValue = (corners) => {
    const normal = planeNormal(corners.map(from));
    return [dot(normal, from(corners[0])) < 0 ? lambert(corners.map(from), n) : 0, CLOSED];
  };
  const facing = (center, normal) => dot(normal, from(center)) < 0;
  switch (light.name) {
    case "Sphere": {
      const c = from(f.center);
      const d2 = dot(c, c);
      const r2 = f.radius * f.radius;
      return [d2 > r2 ? cap(r2 / d2, 1 - r2 / d2, dot(c, n) / Math.sqrt(d2)) : 0, CLOSED];
    }
    case "Sun": {
      const m = f.one_minus_cos;
      const sin2 = m * (2 - m);
      return [cap(sin2, (1 - m) * (1 - m), dot(f.direction, n) / length(f.direction)), CLOSED];
    }
    case "Triangle":
      return flatValue([f.v0, add(f.v0, f.e1), add(f.v0, f.e2)]);
    case "Parallelogram":
    case "Rectangle":
      return flatValue([
        f.corner,
        add(f.corner, f.edge_s),
        add(add(f.corner, f.edge_s), f.edge_t),
        add(f.corner, f.edge_t),
      ]);
    case "Polygon":
      return flatValue(f.corners);
    case "Disk":
      return [facing(f.center, f.normal) ? diskIrradiance(from(f.center), f.normal, f.radius, n) : 0, BY_QUADRATURE];
    case "Line":
      return [segment(from(f.start), f.edge, n), CLOSED];
    case "BilinearPatch": {
      const twist = sub(sub(f.diagonal, f.edge_s), f.edge_t);
      const shape = shapeOf(light);
      return [
        patchIrradiance(
          { at: shape.at, area: (x, y) => length(cross(along(f.edge_s, twist, y), along(f.edge_t, twist, x))) },
          p,
          n,
        ),
        BY_QUADRATURE,
      ];
    }
    case "PointLight":
    case "SpotLight": {
      const d = from(f.position);
      const d2 = dot(d, d);
      const h = f.axis ? 1 + dot(d, f.axis) / Math.sqrt(d2) : 0;
      const [inner, outer] = [f.one_minus_cos_inner, f.one_minus_cos_outer];
      const t = f.axis ? clamp((outer - h) / (outer - inner), 0, 1) : 1;
      return [(Math.max(0, dot(d, n)) / (d2 * Math.sqrt(d2))) * t * t * (3 - 2 * t), CLOSED];
    }
    case "DirectionalLight":
      return [Math.max(0, dot(f.direction, n)), CLOSED];
    default:
      return [NaN, "not known"];
  }
}
