// The colour bar of a map: its colours, and the numbers and the unit that they stand for.

const UNITS = { radiance: "W/(m² sr)", irradiance: "W/m²", power: "W" };
/** Draws the colours between two ends, above them how many pixels have each, five numbers below them, and the unit. */
function bar(canvas, { color, at, title, format }, counts) {
  fit(canvas);
  const context = canvas.getContext("2d");
  const r = ratio();
  const { width } = canvas;
  const [left, right, top, high] = [30 * r, width - 30 * r, 26 * r, 10 * r];
  const height = top + high;
  context.clearRect(0, 0, width, canvas.height);
  for (let x = Math.floor(left); x < right; x++) {
    const word = color((x - left) / (right - left));
    context.fillStyle = `rgb(${word & 255}, ${(word >> 8) & 255}, ${(word >> 16) & 255})`;
    context.fillRect(x, top, 1, high);
  }
  const style = getComputedStyle(canvas);
  context.fillStyle = style.color;
  // one colour, such as that of black pixels, may have nearly all
  const most = counts ? [...counts].sort((a, b) => b - a)[1] || Math.max(...counts) : 0;
  if (most > 0) {
    const each = (right - left) / counts.length;
    counts.forEach((count, k) => {
      const tall = Math.min(1, count / most) * (top - 2 * r);
      context.fillRect(left + k * each, top - 2 * r - tall, Math.max(1, each - r), tall);
    });
  }
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
  const titles = {
    samples: "samples of a pixel",
    variance: `variance of a pixel's mean, (${unit})²; grey: not known`,
    error: "standard error of a pixel over the mean of the image; grey: not known",
    luminance: `luminance, ${unit}`,
  };
  const at = (t) => low * (high / low) ** t;
  const format = { samples: (x) => short(Math.round(x)), error: (x) => `${short(Number((100 * x).toPrecision(2)))} %` };
  return { color: heat, at, title: `logarithmic: ${titles[layer] ?? `${layer}, ${unit}`}`, format: format[layer] ?? ((x) => short(Number(x.toPrecision(2)))) };
}
