// From numbers to colours: the tone map of the PNG, in single precision as there, and the colours of maps.

const f32 = Math.fround;
const [RED, GREEN, BLUE] = [0.2126, 0.7152, 0.0722].map(f32);

/** The code of a linear value from 0 to 1 in 8-bit sRGB, before it is rounded. */
function encoded(x) {
  const root = f32(Math.pow(x, f32(1 / f32(2.4))));
  const value = x <= f32(0.0031308) ? f32(f32(12.92) * x) : f32(f32(f32(1.055) * root) - f32(0.055));
  return f32(value * 255);
}
/** The least values that have each code or a greater one: a search among single-precision numbers, since `encoded` increases. */
const LEAST = (() => {
  const bits = new Uint32Array(1);
  const value = new Float32Array(bits.buffer);
  return Float32Array.from({ length: 256 }, (_, code) => {
    let [low, high] = [0, 0x3f800000];
    while (low < high) {
      bits[0] = Math.floor((low + high) / 2);
      if (encoded(value[0]) >= code - 0.5) high = bits[0];
      else low = bits[0] + 1;
    }
    bits[0] = low;
    return code ? value[0] : 0;
  });
})();
/** The code at the start of each of these steps, from which it is only a few codes to the right one. */
const STEPS = 4096;
const AT = Uint8Array.from({ length: STEPS + 1 }, (_, i) => Math.max(0, LEAST.findLastIndex((x) => x <= i / STEPS)));
function code(x) {
  // what is not a number is black
  if (!(x > 0)) return 0;
  if (x >= 1) return 255;
  let found = AT[Math.floor(x * STEPS)];
  while (found < 255 && x >= LEAST[found + 1]) found++;
  return found;
}

const packed = (r, g, b) => (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
/** The colour of a radiance: Reinhard's extended curve on luminance, white at 4, as in the PNG. */
function tone(r, g, b) {
  const luminance = f32(f32(f32(RED * r) + f32(GREEN * g)) + f32(BLUE * b));
  const scale = f32(f32(1 + f32(luminance / 16)) / f32(1 + luminance));
  return packed(code(f32(r * scale)), code(f32(g * scale)), code(f32(b * scale)));
}

/** Colours of a map from little to much, whose luminance increases. */
const STOPS = [
  [10, 8, 32],
  [72, 28, 130],
  [180, 50, 110],
  [245, 130, 60],
  [255, 240, 170],
];
const HEAT = Uint32Array.from({ length: 256 }, (_, i) => {
  const t = (i / 255) * (STOPS.length - 1);
  const k = Math.min(STOPS.length - 2, Math.floor(t));
  return packed(...STOPS[k].map((x, c) => Math.round(x + (t - k) * (STOPS[k + 1][c] - x))));
});
const NONE = packed(64, 70, 82);
const heat = (t) => HEAT[Math.max(0, Math.min(255, Math.round(255 * t)))];

/** Colours of differences: blue for less, white for none, red for more. */
const tint = (t) => {
  const s = Math.sqrt(Math.min(1, Math.abs(t)));
  return packed(...(t < 0 ? [33, 102, 200] : [200, 24, 43]).map((end) => Math.round(255 + (end - 255) * s)));
};

/** A number with three digits. */
function short(x) {
  if (x === 0) return "0";
  if (!Number.isFinite(x)) return "not known";
  const size = Math.abs(x);
  if (size < 1e-3 || size >= 1e6) return x.toExponential(2).replace("e+", "e");
  return x.toLocaleString("en", { maximumSignificantDigits: 4 });
}
const percent = (x) => (x === null || x === undefined ? "not known" : `${(100 * x).toPrecision(3)} %`);
