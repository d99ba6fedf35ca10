// The surface of each light in double precision: its outline, and where a direction or a pair of coordinates is on it.
// The coordinates of a map of the light are in the unit square, y upwards.

const ROUND = Array.from({ length: 65 }, (_, i) => [Math.cos((i * Math.PI) / 32), Math.sin((i * Math.PI) / 32)]);
const SQUARE = [
  [0, 0],
  [1, 0],
  [1, 1],
  [0, 1],
];
const HALF = Math.sqrt(3) / 2;
const circle = (center, a, b, r) => ROUND.map(([c, s]) => add(center, add(times(a, r * c), times(b, r * s))));

/** The parts of two edges at a point of their plane, relative to their corner. */
function partsOf(s, t, q) {
  const normal = cross(s, t);
  const whole = dot(normal, normal);
  return [dot(cross(q, t), normal) / whole, dot(cross(s, q), normal) / whole];
}
/** A flat light of two edges from a corner. The parts of the edges become places of the map by a matrix of two rows. */
function flat(corner, s, t, outline, matrix, inside) {
  const normal = unit(cross(s, t));
  const [[a, b, c], [d, e, f]] = matrix;
  const whole = a * e - b * d;
  const toMap = ([x, y]) => [a * x + b * y + c, d * x + e * y + f];
  return {
    outlines: [outline.map(([x, y]) => along(along(corner, s, x), t, y))],
    mapOutline: outline.map(toMap),
    uvToMap: toMap,
    plane: { corner, s, t, matrix },
    at: (x, y) => {
      const [p, q] = [x - c, y - f];
      const u = (e * p - b * q) / whole;
      const v = (a * q - d * p) / whole;
      return inside(u, v) ? { point: along(along(corner, s, u), t, v), normal } : null;
    },
    emits: (p) => dot(normal, sub(p, corner)) > 0,
  };
}
const same = (q) => q;
const IDENTITY = [
  [1, 0, 0],
  [0, 1, 0],
];
const inSquare = (a, b) => a >= 0 && a <= 1 && b >= 0 && b <= 1;

const SHAPES = {
  Triangle: ({ v0, e1, e2 }) =>
    flat(
      v0,
      e1,
      e2,
      [
        [0, 0],
        [1, 0],
        [0, 1],
      ],
      [
        [1, 0.5, 0],
        [0, HALF, 0.067],
      ],
      (a, b) => a >= 0 && b >= 0 && a + b <= 1,
    ),
  Parallelogram: ({ corner, edge_s, edge_t }) => flat(corner, edge_s, edge_t, SQUARE, IDENTITY, inSquare),
  Rectangle: ({ corner, edge_s, edge_t }) => flat(corner, edge_s, edge_t, SQUARE, IDENTITY, inSquare),
  Polygon: ({ corners }) => {
    const s = sub(corners[1], corners[0]);
    const t = sub(corners[corners.length - 1], corners[0]);
    const parts = corners.map((c) => partsOf(s, t, sub(c, corners[0])));
    const low = [0, 1].map((k) => Math.min(...parts.map((q) => q[k])));
    const size = [0, 1].map((k) => Math.max(...parts.map((q) => q[k])) - low[k]);
    const turns = (a, b) =>
      parts.map((c, i) => {
        const d = parts[(i + 1) % parts.length];
        return (d[0] - c[0]) * (b - c[1]) - (d[1] - c[1]) * (a - c[0]);
      });
    const matrix = [
      [1 / size[0], 0, -low[0] / size[0]],
      [0, 1 / size[1], -low[1] / size[1]],
    ];
    // its surface coordinates are clamped, so that they do not tell the place
    return { ...flat(corners[0], s, t, parts, matrix, (a, b) => turns(a, b).every((x) => x >= 0)), uvToMap: null };
  },
  Disk: ({ center, normal, radius }) => round(center, normal, radius),
  Sphere: ({ center, radius }) => ({
    sphere: { center, radius },
    outlines: [],
    mapOutline: ROUND.map(([c, s]) => [0.5 + 0.5 * c, 0.5 + 0.5 * s]),
    // as the sphere looks from the point: the far side is not there
    normalToMap: (n, p) => {
      const [a, b] = basis(unit(sub(center, p)));
      return dot(n, sub(p, center)) > 0 ? [0.5 + 0.5 * dot(n, a), 0.5 + 0.5 * dot(n, b)] : null;
    },
    at: (x, y, p) => {
      const towardsCenter = unit(sub(center, p));
      const [a, b] = basis(towardsCenter);
      const q = [2 * x - 1, 2 * y - 1];
      const z = 1 - q[0] * q[0] - q[1] * q[1];
      if (z < 0) return null;
      const normal = along(add(times(a, q[0]), times(b, q[1])), towardsCenter, -Math.sqrt(z));
      return { point: along(center, normal, radius), normal };
    },
    emits: (p) => length(sub(p, center)) > radius,
  }),
  BilinearPatch: ({ corner, edge_s: s, edge_t: t, diagonal }) => {
    const twist = sub(sub(diagonal, s), t);
    const place = (x, y) => add(corner, add(add(times(s, x), times(t, y)), times(twist, x * y)));
    const steps = Array.from({ length: 9 }, (_, i) => i / 8);
    return {
      outlines: [SQUARE.map(([x, y]) => place(x, y))],
      lines: steps.flatMap((k) => [steps.map((x) => place(x, k)), steps.map((y) => place(k, y))]),
      mapOutline: SQUARE,
      uvToMap: same,
      at: (x, y) => ({ point: place(x, y), normal: unit(cross(along(s, twist, y), along(t, twist, x))) }),
      emits: () => true,
    };
  },
  Line: ({ start, edge }) => ({
    outlines: [],
    lines: [[start, add(start, edge)]],
    rims: [[start, add(start, edge)]],
    mapOutline: [
      [0, 0.5],
      [1, 0.5],
    ],
    uvToMap: ([x]) => [x, 0.5],
    at: (x, y) => (Math.abs(y - 0.5) < 0.05 ? { point: along(start, edge, x), normal: null } : null),
    emits: () => true,
  }),
};
function round(center, direction, radius) {
  const normal = unit(direction);
  const [a, b] = basis(normal);
  const shape = flat(
    center,
    times(a, radius),
    times(b, radius),
    ROUND,
    [
      [0.5, 0, 0.5],
      [0, 0.5, 0.5],
    ],
    (x, y) => x * x + y * y <= 1,
  );
  return { ...shape, uvToMap: same, normal };
}
/** The shape of a light; lights without a surface are points. */
function shapeOf(light) {
  const make = SHAPES[light.name];
  return make ? make(light.fields) : { outlines: [], mapOutline: null, at: null, emits: () => true };
}

/** A function that writes where a direction from the point is on the map of the light, in double precision, and returns false if it is nowhere; undefined for lights of which a direction may find several points. */
function locator(shape, p) {
  if (shape.plane) {
    const {
      corner,
      s,
      t,
      matrix: [[a, b, c], [d, e, f]],
    } = shape.plane;
    const o = sub(p, corner);
    const [ax, ay, az] = cross(o, t);
    const [bx, by, bz] = cross(s, o);
    const [nx, ny, nz] = cross(s, t);
    const side = Math.sign(dot(o, [nx, ny, nz]));
    return (x, y, z, target) => {
      const n = x * nx + y * ny + z * nz;
      const u = (x * ax + y * ay + z * az) / n;
      const v = (x * bx + y * by + z * bz) / n;
      target[0] = a * u + b * v + c;
      target[1] = d * u + e * v + f;
      return n * side < 0;
    };
  }
  if (!shape.sphere) return undefined;
  const { center, radius } = shape.sphere;
  const o = sub(p, center);
  const isInside = dot(o, o) < radius * radius;
  const [ax, bx] = basis(unit(times(o, -1)));
  return (x, y, z, target) => {
    const b = o[0] * x + o[1] * y + o[2] * z;
    const cx = o[0] - b * x;
    const cy = o[1] - b * y;
    const cz = o[2] - b * z;
    const root = radius * radius - (cx * cx + cy * cy + cz * cz);
    const r = Math.sqrt(Math.max(0, root));
    const k = 1 / radius;
    target[0] = 0.5 + 0.5 * k * ((cx - r * x) * ax[0] + (cy - r * y) * ax[1] + (cz - r * z) * ax[2]);
    target[1] = 0.5 + 0.5 * k * ((cx - r * x) * bx[0] + (cy - r * y) * bx[1] + (cz - r * z) * bx[2]);
    return b < 0 || isInside;
  };
}
