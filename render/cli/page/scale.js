// The colour bar of a map: its colours, and the numbers and the unit that they stand for.

const UNITS = { radiance: "W/(m² sr)", irradiance: "W/m²", power: "W" };
/** Draws the colours between two ends, five numbers below them, and the unit. */
function bar(canvas, { color, at, title, format }) {
  fit(canvas);
  const context = canvas.getContext("2d");
  const r = ratio();
  const { width } = canvas;
  const [left, right, height] = [30 * r, width - 30 * r, 14 * r];
  context.clearRect(0, 0, width, canvas.height);
  for (let x = Math.floor(left); x < right; x++) {
    const word = color((x - left) / (right - left));
    context.fillStyle = `rgb(${word & 255}, ${(word >> 8) & 255}, ${(word >> 16) & 255})`;
    context.fillRect(x, 0, 1, height);
  }
  const style = getComputedStyle(canvas);
  context.fillStyle = style.color;
  context.font = `${12 * r}px ${style.fontFamily}`;
  context.textAlign = "center";
  for (let k = 0; k <= 4; k++) context.fillText(format(at(k / 4)), left + (k / 4) * (right - left), height + 14 * r);
  context.fillText(title, (left + right) / 2, height + 29 * r);
}

/** What the bar of a layer shows, for these ends and this sensor. */
function scaleOf(layer, [low, high], sensor) {
  const unit = UNITS[sensor];
  const signed = (title, format) => ({ color: (t) => tint(2 * t - 1), at: (t) => (2 * t - 1) * high, title, format });
  if (layer === "difference") return signed(`A − B, ${unit}, mean over R, G and B`, short);
  if (layer === "relative") return signed("(A − B) / B, mean over R, G and B; grey where B is 0", (x) => `${short(100 * x)} %`);
  if (layer === "samples") return { color: heat, at: (t) => low + t * (high - low), title: "samples of a pixel", format: (x) => short(Math.round(x)) };
  const at = (t) => low * (high / low) ** t;
  return { color: heat, at, title: `variance of a pixel's mean, (${unit})²; grey is not known`, format: (x) => short(Number(x.toPrecision(2))) };
}
