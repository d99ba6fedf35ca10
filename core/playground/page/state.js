// What the page is about: how it begins, and which values an address may give it.

const START = {
  light: pushed("Sphere", PRESETS["far, at the horizon"]),
  ...UP,
  handle: "center",
  way: "by solid angle",
  dots: 1024,
  sequence: "owen_sobol",
  shade: "pdf",
  projection: "equal-area",
  near: true,
  textbook: true,
  surface: false,
  lesson: null,
  chosen: null,
  ways: null,
  panel: null,
  probe: null,
  inside: 4.6,
};

/** The values of selects, with their texts. */
const CHOICES = {
  dots: [16, 64, 256, 1024, MOST].map((n) => [n, n.toLocaleString("en")]),
  sequence: Object.entries(SEQUENCES),
  shade: [
    ["pdf", "pdf"],
    ["value", "value of a sample, cosθ/pdf"],
    ["cosine", "cosθ"],
    ["lightCosine", "cosθ′ at the light"],
    ["distance", "1/r²"],
    ["product", "cosθ cosθ′/r²"],
    ["none", "none"],
  ],
  projection: [
    ["equal-area", "equal solid angles"],
    ["nusselt", "equal projected solid angles"],
  ],
};
const PANELS = [null, "variance", "sequences", "importance", "stratification"];

/** True if a value is like another one: finite numbers, lists of the same length, or the same type. */
function isLike(value, known) {
  if (Array.isArray(known))
    return Array.isArray(value) && value.length === known.length && known.every((x, i) => isLike(value[i], x));
  return typeof value === typeof known && (typeof known !== "number" || Number.isFinite(value));
}
/** True if the state may have this value, which comes from outside. */
function isAllowed(key, value) {
  if (CHOICES[key]) return CHOICES[key].some(([choice]) => choice === value);
  switch (key) {
    case "panel":
      return PANELS.includes(value);
    case "chosen":
      return value === null || LIGHTS.some((light) => light.name === value);
    case "ways":
      return value === null || (Array.isArray(value) && value.every((name) => typeof name === "string"));
    case "probe":
      return value === null || isLike(value.w, [0, 0, 0]) || isLike(value.u, [0, 0]);
    case "n":
      return isLike(value, [0, 0, 0]) && length(value) > 0;
    default:
      return key in START && isLike(value, START[key]);
  }
}
