// Presets: where a light is put so that formulas fail or noise is great, and the light of the first view.

/** What is pushed how far, one after the other, from where the light is before anyone moves it. */
const PRESETS = {
  far: [["distance", 3000]],
  thin: [["thinness", 1e-4]],
  horizon: [["elevation", 0]],
  huge: [["size", 100]],
  "far, at the horizon": [
    ["distance", 600],
    ["elevation", 0],
  ],
};
/** How far a point is from a sphere that would contain it. */
const OUTSIDE = 0.5;

/** A light after it was pushed, seen from the origin; null if it cannot be pushed so. */
function pushed(name, pushes) {
  const { p, n } = UP;
  let light = overhead(name);
  for (const [key, to] of pushes) {
    const { read, put } = PUSHES[key];
    if (!Number.isFinite(read(light, p, n) ?? NaN)) return null;
    light = put(light, p, to, n);
  }
  const { center, radius, normal } = light.fields;
  const contains = center && !normal && length(center) < radius + OUTSIDE;
  return contains ? PUSHES.distance.put(light, p, radius + OUTSIDE) : light;
}

/** Buttons that put the light of the page where a preset says. */
function presets(app) {
  return Object.entries(PRESETS).map(([text, pushes]) => {
    const can = pushed(app.state.light.name, pushes) !== null;
    const button = make("button", { type: "button", textContent: text, disabled: !can });
    button.title = can ? "Put the light there" : "This light has no size or place to change so";
    button.addEventListener("click", () =>
      app.change({ ...UP, light: pushed(app.state.light.name, pushes), probe: null }),
    );
    return button;
  });
}
