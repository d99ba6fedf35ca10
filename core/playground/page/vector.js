// Vectors of three numbers, in double precision.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
/** a + b s */
const along = (a, b, s) => [a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s];
const length = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => {
  const l = length(a);
  return l > 0 ? times(a, 1 / l) : [0, 1, 0];
};
const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

/** Two unit vectors that are perpendicular to a unit vector and to each other, as the core chooses them (Duff et al. 2017). */
function basis(n) {
  const sign = n[2] < 0 || Object.is(n[2], -0) ? -1 : 1;
  const a = -1 / (sign + n[2]);
  const b = n[0] * n[1] * a;
  return [
    [1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]],
    [b, sign + n[1] * n[1] * a, -n[1]],
  ];
}
/** A vector turned by an angle about a unit axis. */
function turn(v, axis, angle) {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return add(add(times(v, c), times(cross(axis, v), s)), times(axis, dot(axis, v) * (1 - c)));
}
/** Numbers as the core takes them. */
const single = (numbers) => numbers.map(Math.fround);
