// Lights as the hand changes them: their fields, what one may take hold of, and how they are pushed far, thin or to the horizon.

/** The shading point and its normal before anyone moves them. */
const UP = { p: [0, 0, 0], n: [0, 1, 0] };
/** A light of each kind above the origin. A kind that is not here gets fields by their kind. */
const OVERHEAD = {
  Sphere: { center: [-0.3, 1.25, -0.2], radius: 0.45 },
  Triangle: { v0: [-0.8, 0.95, -0.7], e1: [1.7, 0.1, 0.1], e2: [0.2, 0.5, 1.4] },
  Parallelogram: { corner: [-0.7, 1.1, -0.6], edge_s: [1.3, 0.1, 0], edge_t: [0.3, 0.15, 1.1] },
  Rectangle: { corner: [-0.7, 1.2, -0.5], edge_s: [1.4, 0, 0], edge_t: [0, 0.3, 0.9] },
  Disk: { center: [0.2, 1.25, 0.1], normal: [-0.2, -1, 0.1], radius: 0.6 },
  Polygon: {
    corners: [
      [-0.5, 1.2, -0.7],
      [0.6, 1.2, -0.8],
      [1.0, 1.2, 0.2],
      [0.2, 1.2, 0.9],
      [-0.8, 1.2, 0.4],
    ],
  },
  BilinearPatch: { corner: [-0.7, 1.0, -0.6], edge_s: [1.4, 0.4, 0], edge_t: [0, 0.4, 1.2], diagonal: [1.4, 0, 1.2] },
  Line: { start: [-0.8, 1.1, -0.2], edge: [1.6, 0.2, 0.4] },
  Sun: { direction: [0.5, 0.8, -0.3], one_minus_cos: 0.06 },
  PointLight: { position: [0.4, 1.3, -0.2] },
  SpotLight: { position: [0.4, 1.4, -0.2], axis: [-0.3, -1, 0.1], one_minus_cos_inner: 0.05, one_minus_cos_outer: 0.25 },
  DirectionalLight: { direction: [0.5, 0.8, -0.3] },
};
const BY_KIND = {
  point: [0, 1.2, 0],
  edge: [1, 0, 0],
  vertex: [0, 0, 1],
  direction: [0, -1, 0],
  number: 0.5,
  corners: [
    [0, 1, 0],
    [1, 1, 0],
    [0, 1, 1],
  ],
};

const kindOf = (name) => LIGHTS.find((light) => light.name === name);
const title = (name) => name.replace(/([a-z])([A-Z])/g, (_, a, b) => `${a} ${b.toLowerCase()}`);
/** “by solid angle” of by_solid_angle. */
const spoken = (by) => by.replaceAll("_", " ");

/** The light of a kind before anyone moves it. */
function overhead(name) {
  const fields = {};
  for (const { name: field, kind } of kindOf(name).fields) {
    const value = structuredClone((OVERHEAD[name] || {})[field] ?? BY_KIND[kind]);
    fields[field] = kind === "direction" ? unit(value) : value;
  }
  return { name, fields };
}

/** The numbers of the fields in order, as the core takes them: a polygon repeats its last corner. */
function numbers(light) {
  return kindOf(light.name).fields.flatMap(({ name, kind }) => {
    const value = light.fields[name];
    if (kind === "number") return [Math.fround(value)];
    if (kind === "corners")
      return single(Array.from({ length: 8 }, (_, i) => value[Math.min(i, value.length - 1)]).flat());
    return single(value);
  });
}
/** The light with fields as the core takes them, for closed forms: no error is then due to rounding them. */
function rounded(light) {
  const fields = {};
  for (const { name, kind } of kindOf(light.name).fields) {
    const value = light.fields[name];
    fields[name] = kind === "number" ? Math.fround(value) : kind === "corners" ? value.map(single) : single(value);
  }
  return { name: light.name, fields };
}

/** The first point of a light, from which its edges and directions start; of distant lights, nothing. */
function anchor(light) {
  const field = kindOf(light.name).fields.find(({ kind }) => kind === "point");
  return field ? light.fields[field.name] : null;
}
const vertices = (light) => {
  const from = anchor(light);
  return kindOf(light.name).fields.flatMap(({ name, kind }) => {
    const value = light.fields[name];
    if (kind === "point") return [value];
    if (kind === "edge" || kind === "vertex") return [add(from, value)];
    return kind === "corners" ? value : [];
  });
};
/** The middle of a light; of distant lights, nothing. */
function middle(light) {
  const { fields } = light;
  if (fields.corner && fields.edge_s && !fields.diagonal)
    return along(along(fields.corner, fields.edge_s, 0.5), fields.edge_t, 0.5);
  const all = vertices(light);
  return all.length ? times(all.reduce(add), 1 / all.length) : null;
}

/** Applies a map of points, one of vectors and a factor of lengths to all fields. */
function mapped(light, point, vector, scale = 1) {
  const fields = {};
  for (const { name, kind } of kindOf(light.name).fields) {
    const value = light.fields[name];
    fields[name] = {
      point: () => point(value),
      corners: () => value.map(point),
      edge: () => vector(value),
      vertex: () => vector(value),
      direction: () => unit(vector(value)),
      number: () => (/radius/.test(name) ? value * scale : value),
    }[kind]();
  }
  return { name: light.name, fields };
}
const moved = (light, by) =>
  mapped(
    light,
    (x) => add(x, by),
    (x) => x,
  );

/** Length of a direction's arrow in the scene. */
const ARROW = 0.5;

/** What one may take hold of: a name, where it is, and the light after it was put elsewhere. */
function handles(light, p) {
  const from = anchor(light);
  const list = [];
  for (const { name, kind } of kindOf(light.name).fields) {
    const value = light.fields[name];
    const put = (change) => (to) => {
      const next = { name: light.name, fields: structuredClone(light.fields) };
      change(next.fields, to);
      return constrained(next, name) ? next : light;
    };
    if (kind === "point") {
      list.push({ name, at: value, put: (to) => pointPut(light, name, to) });
    } else if (kind === "edge" || kind === "vertex") {
      list.push({
        name,
        at: add(from, value),
        put: put((fields, to) => {
          fields[name] = sub(to, from);
        }),
      });
    } else if (kind === "direction") {
      const start = from || p;
      const size = from ? ARROW : 2;
      list.push({
        name,
        from: start,
        at: along(start, value, size),
        put: put((fields, to) => {
          fields[name] = unit(sub(to, start));
        }),
      });
    } else if (kind === "corners") {
      value.forEach((at, i) =>
        list.push({
          name: `corner ${i + 1}`,
          at,
          put: put((fields, to) => {
            fields[name][i] = onPlane(value, to);
          }),
        }),
      );
    }
  }
  const center = middle(light);
  if (center && list.filter((handle) => !handle.from).length > 1) {
    list.push({ name: "whole light", at: center, put: (to) => moved(light, sub(to, center)) });
  }
  return list;
}
/** The point goes elsewhere; vertices stay where they are, all else goes with it. */
function pointPut(light, name, to) {
  const by = sub(to, light.fields[name]);
  const next = { name: light.name, fields: structuredClone(light.fields) };
  next.fields[name] = to;
  for (const field of kindOf(light.name).fields) {
    if (field.kind === "vertex") next.fields[field.name] = sub(next.fields[field.name], by);
  }
  return next;
}
const planeNormal = (corners) =>
  corners.reduce((sum, c, i) => add(sum, cross(c, corners[(i + 1) % corners.length])), [0, 0, 0]);
function onPlane(corners, to) {
  const n = unit(planeNormal(corners));
  return along(to, n, dot(sub(corners[0], to), n));
}
/** Restores what the documentation of a light asks for after a field was changed; false if that cannot be. */
function constrained(light, changed) {
  const { fields } = light;
  if (light.name === "Rectangle") {
    const [kept, other] = changed === "edge_t" ? ["edge_t", "edge_s"] : ["edge_s", "edge_t"];
    const e = unit(fields[kept]);
    const size = length(fields[other]);
    const across = along(fields[other], e, -dot(fields[other], e));
    if (!(length(across) > 1e-9 * size)) return false;
    fields[other] = times(unit(across), size);
  }
  if (fields.corners) {
    const n = planeNormal(fields.corners);
    const c = fields.corners;
    const turns = c.map((x, i) =>
      dot(n, cross(sub(c[(i + 1) % c.length], x), sub(c[(i + 2) % c.length], c[(i + 1) % c.length]))),
    );
    return turns.every((t) => t > 0);
  }
  return true;
}

/** Sliders that push a light far, thin, or to the horizon: what they read, and the light where they are put. Undefined where they mean nothing. */
const PUSHES = {
  distance: {
    label: "distance",
    unit: "",
    low: 0.05,
    high: 1e6,
    logarithmic: true,
    read: (light, p) => middle(light) && length(sub(middle(light), p)),
    put: (light, p, to) => {
      const d = sub(middle(light), p);
      const now = length(d);
      return now > 0 ? moved(light, times(d, to / now - 1)) : light;
    },
  },
  size: {
    label: "size",
    unit: "",
    low: 1e-6,
    high: 100,
    logarithmic: true,
    read: (light) => extent(light),
    put: (light, p, to) => {
      const center = middle(light);
      const k = to / extent(light);
      return mapped(
        light,
        (x) => along(center, sub(x, center), k),
        (x) => times(x, k),
        k,
      );
    },
  },
  thinness: {
    label: "width / length",
    unit: "",
    low: 1e-6,
    high: 1,
    logarithmic: true,
    read: (light) => (thin(light) || {}).ratio,
    put: (light, p, to) => thin(light).put(to),
  },
  elevation: {
    label: "elevation",
    unit: "°",
    low: -30,
    high: 90,
    read: (light, p, n) => {
      const d = towards(light, p);
      return d && (Math.asin(clamp(dot(unit(d), n), -1, 1)) * 180) / Math.PI;
    },
    put: (light, p, to, n) => {
      const d = unit(towards(light, p));
      let axis = cross(d, n);
      if (length(axis) < 1e-9) axis = basis(n)[0];
      const angle = ((to - PUSHES.elevation.read(light, p, n)) * Math.PI) / 180;
      const rotate = (v) => turn(v, unit(axis), angle);
      return mapped(light, (x) => add(p, rotate(sub(x, p))), rotate);
    },
  },
};
/** The vector to the middle of a light, or the direction of a distant one. */
const towards = (light, p) => (middle(light) ? sub(middle(light), p) : light.fields.direction);
/** The greatest length of a light. */
function extent(light) {
  if (/Light$/.test(light.name)) return undefined;
  const { fields } = light;
  if (fields.radius && !fields.axis) return 2 * fields.radius;
  const center = middle(light);
  return center ? 2 * Math.max(...vertices(light).map((v) => length(sub(v, center)))) || undefined : undefined;
}
/** Width over length of a light that has both, and the light with another ratio. */
function thin(light) {
  const { fields } = light;
  if (fields.inner_radius !== undefined) {
    return {
      ratio: 1 - fields.inner_radius / fields.radius,
      put: (to) => ({ name: light.name, fields: { ...fields, inner_radius: fields.radius * (1 - to) } }),
    };
  }
  if (fields.axis && fields.radius) {
    return {
      ratio: (2 * fields.radius) / length(fields.axis),
      put: (to) => ({ name: light.name, fields: { ...fields, radius: 0.5 * to * length(fields.axis) } }),
    };
  }
  const all = vertices(light);
  if (all.length < 3) return undefined;
  const e = unit(sub(all[1], all[0]));
  const across = all
    .map((v) => sub(v, all[0]))
    .map((v) => along(v, e, -dot(v, e)))
    .reduce((a, b) => (length(b) > length(a) ? b : a));
  const q = unit(across);
  const center = middle(light);
  const spread = (axis) => {
    const d = all.map((v) => dot(sub(v, center), axis));
    return Math.max(...d) - Math.min(...d);
  };
  const ratio = spread(q) / spread(e);
  const put = (to) => {
    const squeeze = (v) => along(v, q, dot(v, q) * (to / ratio - 1));
    return mapped(light, (x) => add(center, squeeze(sub(x, center))), squeeze);
  };
  return { ratio, put };
}
