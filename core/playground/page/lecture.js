// The lecture: figures about one point and one light, and about integrals, each live.

const LECTURE = [
  {
    figure: "hemisphere-vs-area",
    title: "All directions, or those to the light",
    says: "Sixteen rays from a point: over the whole hemisphere few of them find the light, and towards it all do. Both estimates are right on average.",
    tries: "Drag the light away, or make it smaller: the error of the hemisphere grows, that of the light does not.",
    set: {
      ...UP,
      light: "Rectangle",
      ways: ["uniform hemisphere", "cosine hemisphere", "by area"],
      dots: 16,
      sequence: "independent",
      near: false,
      shade: "none",
      way: "by area",
    },
  },
  {
    figure: "sphere-area-vs-cone",
    title: "A sphere: its surface, or the cone that it fills",
    says: "More than half of the samples by area lie on the far side and are worth nothing. By solid angle all lie within the cone.",
    tries:
      "Push the sphere far: the textbook's cone, 1 − cosσ with a cosine near 1, collapses, and its samples fall on rings; the core's does not.",
    set: {
      ...UP,
      light: "Sphere",
      ways: ["by area", "by solid angle", "by solid angle, textbook"],
      dots: 1024,
      sequence: "owen_sobol",
      near: true,
      shade: "pdf",
      way: "by solid angle",
    },
  },
  {
    figure: "triangle-area-vs-solid-angle",
    title: "A near triangle by three measures",
    says: "By area, samples crowd where the triangle is far from the point. By solid angle they are even in the sky, by projected solid angle even on the ground below it.",
    tries:
      "Choose the map of projected solid angles. Move the point under a corner. Then make the triangle thin or far, and compare Arvo's formula as textbooks have it.",
    set: {
      p: [0.3, 0, -0.2],
      n: [0, 1, 0],
      light: "Triangle",
      ways: ["by area", "by solid angle", "by solid angle, textbook", "by projected solid angle"],
      dots: 1024,
      sequence: "owen_sobol",
      near: false,
      shade: "pdf",
      way: "by solid angle",
    },
  },
  {
    figure: "area-factors",
    title: "What samples by area are multiplied by",
    says: "The value of a sample by area is proportional to cosθ cosθ′/r². Each factor varies over the light, and so does the product.",
    tries: "Choose each factor as the shade of the maps. Bring the point near the light: 1/r² takes over.",
    set: {
      p: [0.4, 0, -0.4],
      n: [0, 1, 0],
      light: { name: "Triangle", fields: { v0: [-1, 0.3, -1.1], e1: [2, 0, 0], e2: [1, 1.1, 0.6] } },
      ways: ["by area"],
      dots: 64,
      sequence: "owen_sobol",
      near: true,
      shade: "product",
      way: "by area",
    },
  },
  {
    figure: "cap-solid-angle-vs-projected",
    title: "A cap that the horizon cuts",
    says: "A sphere of half-angle 40°, 65° from the normal. By solid angle some samples are below the horizon; by projected solid angle none is, and all have the same value.",
    tries: "Lift and lower the sphere with the slider “elevation”, or tilt the normal.",
    set: {
      ...UP,
      light: { name: "Sphere", fields: { center: [1.2688, 0.5917, 0], radius: 0.8999 } },
      ways: ["by solid angle", "by projected solid angle"],
      dots: 1024,
      sequence: "owen_sobol",
      near: false,
      shade: "value",
      way: "by projected solid angle",
    },
  },
  {
    figure: "sample-variance",
    title: "What four samples know of their own variance",
    says: "A renderer that stops where the variance seems small stops where it was lucky.",
    tries:
      "Choose a technique by its letter, and move the light: the less often a sample finds it, the worse is the estimate.",
    set: {
      ...UP,
      light: "Rectangle",
      ways: ["cosine hemisphere", "by area", "by solid angle"],
      dots: 64,
      sequence: "independent",
      near: false,
      shade: "pdf",
      way: "cosine hemisphere",
      panel: "variance",
    },
  },
  {
    figure: "quads-convergence",
    title: "Independent and stratified samples",
    says: "The error of independent samples falls as n⁻⁰·⁵. That of strata falls faster, because each sees a small and smooth part of the integrand.",
    tries: "Let the horizon cut the light: the integrand by area gets an edge, and strata gain less.",
    set: {
      ...UP,
      light: "Rectangle",
      ways: ["by area", "by solid angle"],
      dots: 256,
      sequence: "stratified",
      near: false,
      shade: "value",
      way: "by area",
      panel: "sequences",
    },
  },
  {
    figure: "importance",
    title: "A pdf that is like the integrand, and one that is not",
    says: "Importance sampling divides by the pdf: where the integrand is large and the pdf small, the variance explodes.",
    tries: "Drag the height of the pdf over the bump, or change it by the arrow keys once the chart has the focus.",
    set: { ...UP, light: "Rectangle", ways: [], panel: "importance" },
  },
  {
    figure: "stratification",
    title: "How fast strata converge",
    says: "One point in each of n strata: over a smooth function the variance falls as n⁻², over an edge as n⁻¹·⁵, and independent points only reach n⁻¹.",
    tries: "Compare the points of the two sequences in the unit square.",
    set: { ...UP, light: "Rectangle", ways: [], dots: 256, sequence: "stratified", panel: "stratification" },
  },
];
/** The light of a figure, before anyone chooses another one. */
const lightOf = ({ set: { light } }) => (typeof light === "string" ? overhead(light) : structuredClone(light));
/** The state of a lesson: about its own light, or that of a name which was chosen. */
function lessonState(index, chosen) {
  const own = lightOf(LECTURE[index]);
  const light = chosen && chosen !== own.name ? overhead(chosen) : own;
  return { panel: null, handle: "whole light", ...structuredClone(LECTURE[index].set), light, lesson: index, chosen };
}
/** What a figure asks to try, and which light its text is about if another one was chosen. */
function triesOf({ tries, set: { panel } }, own, light) {
  if (own.name === light.name || panel === "importance" || panel === "stratification") return tries;
  return `${tries} The text is about the ${title(own.name).toLowerCase()}; the ${title(light.name).toLowerCase()} stays, since you chose it, until “Reset”.`;
}
