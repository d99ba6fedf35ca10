// The page's own elements: selects, sliders, inputs and cards.

const byId = (id) => document.getElementById(id);
function make(name, properties = {}, ...children) {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
}
/** Sets a text, unless it is there already: every change costs a layout. */
function tell(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
/** Fills a select with values and their texts. */
function choices(select, list, chosen) {
  const key = list.join();
  if (select.dataset.key !== key) {
    select.replaceChildren(...list.map(([value, text]) => make("option", { value, textContent: text })));
    select.dataset.key = key;
  }
  if (select.value !== chosen) select.value = chosen;
}

/** A slider with a label and the number that it stands for. */
class Slider {
  constructor(label, { low, high, logarithmic, unit }, put) {
    Object.assign(this, { low, high, logarithmic, unit });
    this.input = make("input", { type: "range", min: 0, max: 1000, step: 1 });
    this.output = make("output");
    this.element = make("label", { className: "push" }, make("span", { textContent: label }), this.input, this.output);
    this.input.addEventListener("input", () => put(this.value(this.input.value / 1000)));
  }
  value(t) {
    return this.logarithmic ? this.low * (this.high / this.low) ** t : this.low + (this.high - this.low) * t;
  }
  show(x) {
    const t = this.logarithmic
      ? Math.log(x / this.low) / Math.log(this.high / this.low)
      : (x - this.low) / (this.high - this.low);
    // a slider that the hand holds stays where it is
    if (Math.abs(this.input.value / 1000 - t) > 0.0008) this.input.value = String(Math.round(1000 * clamp(t, 0, 1)));
    tell(this.output, this.unit === "°" ? `${say(Math.round(10 * x) / 10)}°` : say(x));
  }
}
/** Ranges of the fields that are numbers. */
const RANGES = {
  one_minus_cos: { low: 1e-8, high: 1, logarithmic: true },
  one_minus_cos_inner: { low: 0, high: 1.99 },
  one_minus_cos_outer: { low: 0.01, high: 2 },
  radius: { low: 1e-4, high: 5, logarithmic: true },
  inner_radius: { low: 1e-4, high: 5, logarithmic: true },
};

/** The sliders of a light: its numbers, and those that push it far, thin, or to the horizon. */
function sliders(app) {
  const { state } = app;
  const list = [];
  for (const [name, push] of Object.entries(PUSHES)) {
    const now = push.read(state.light, state.p, state.n);
    if (now === undefined || now === null || !Number.isFinite(now)) continue;
    const put = (to) => app.change({ light: push.put(app.state.light, app.state.p, to, app.state.n) });
    list.push({
      name,
      slider: new Slider(push.label, push, put),
      read: () => push.read(app.state.light, app.state.p, app.state.n),
    });
  }
  for (const { name, kind } of kindOf(state.light.name).fields) {
    if (kind !== "number") continue;
    const put = (to) =>
      app.change({
        light: {
          name: app.state.light.name,
          fields: limited(app.state.light.name, { ...app.state.light.fields, [name]: to }),
        },
      });
    list.push({
      name,
      slider: new Slider(name.replaceAll("_", " "), RANGES[name] || { low: 0, high: 2 }, put),
      read: () => app.state.light.fields[name],
    });
  }
  return list;
}
/** Fields in the order that their documentation asks for. */
function limited(name, fields) {
  if (name === "SpotLight" && fields.one_minus_cos_inner >= fields.one_minus_cos_outer) {
    fields.one_minus_cos_inner = fields.one_minus_cos_outer - 0.01;
  }
  return fields;
}

/** Inputs for every coordinate: the label, and how each number is read and put. */
function coordinates(app) {
  const rows = [];
  const row = (label, size, read, put) => {
    const inputs = Array.from({ length: size }, (_, k) => {
      const input = make("input", {
        type: "number",
        step: "any",
        ariaLabel: size > 1 ? `${label}, ${"xyz"[k]}` : label,
      });
      input.addEventListener("change", () => {
        if (input.value !== "" && Number.isFinite(input.valueAsNumber)) put(k, input.valueAsNumber);
      });
      return input;
    });
    const show = () =>
      inputs.forEach((input, k) => {
        if (document.activeElement !== input)
          input.value = String(Number(Number(size > 1 ? read()[k] : read()).toPrecision(7)));
      });
    rows.push({ element: make("label", {}, make("span", { textContent: label }), ...inputs), show });
  };
  const set = (vector, k, x) => vector.map((old, i) => (i === k ? x : old));
  row(
    "point p",
    3,
    () => app.state.p,
    (k, x) => app.change({ p: set(app.state.p, k, x) }),
  );
  row(
    "normal n",
    3,
    () => app.state.n,
    (k, x) => {
      const n = set(app.state.n, k, x);
      if (length(n) > 0) app.change({ n: unit(n) });
    },
  );
  for (const { name, kind } of kindOf(app.state.light.name).fields) {
    const label = name.replaceAll("_", " ");
    const value = () => app.state.light.fields[name];
    const put = (to) => {
      const next = { name: app.state.light.name, fields: { ...structuredClone(app.state.light.fields), [name]: to } };
      if (constrained(next, name)) app.change({ light: next });
    };
    if (kind === "number") row(label, 1, value, (k, x) => put(x));
    else if (kind === "corners")
      value().forEach((_, i) =>
        row(
          `corner ${i + 1}`,
          3,
          () => value()[i],
          (k, x) => put(value().map((c, j) => (j === i ? onPlane(value(), set(c, k, x)) : c))),
        ),
      );
    else
      row(label, 3, value, (k, x) => {
        const v = set(value(), k, x);
        if (kind !== "direction" || length(v) > 0) put(kind === "direction" ? unit(v) : v);
      });
  }
  return rows;
}

const LETTERS = "ABCDEFGHIJ";
/** The numbers of a card: a word, their key, and what they are. */
const ROWS = [
  ...COUNTS.map((n) => [
    `n = ${n.toLocaleString("en")}`,
    n,
    `relative error of the mean of ${n} samples, root mean square`,
  ]),
  ["ns", "ns", "nanoseconds of a sample in this browser, prepared; a native program with wider vectors takes less"],
  ["in 1 µs", "equal", "relative error of the mean of as many samples as take 1 µs here, without shadow rays, root mean square"],
  ["estimate", "estimate", "mean of all samples"],
  ["pdf", "pdf", "density of the direction under the cursor, per steradian (lines: in their measure)"],
  ["invert u", "u", "the first of the numbers that are mapped to the direction under the cursor"],
  ["invert v", "v", "the second of them"],
  ["broken", "faults", "how many of the samples break the contract that stands below the cards"],
];
/** The card of a way, with the textbook's formula beside it if there is one: their maps and their numbers. */
class Card {
  constructor(app, ways, letter) {
    Object.assign(this, { app, ways, letter });
    const [first] = ways;
    this.parts = ways.map((way) => this.part(way));
    const about = first.technique
      ? first.technique.about.split(/: |\. |,? at the point| above the|,? as a/)[0].replace(/[,.]*$/, ".")
      : first.source;
    const buttons = this.parts.map(({ button }) => button);
    const body = make("tbody");
    for (const [text, key, explained] of ROWS) {
      body.append(
        make(
          "tr",
          {},
          make("th", { scope: "row", textContent: text, title: explained }),
          ...this.parts.map(({ cells }) => (cells[key] = make("td"))),
        ),
      );
    }
    const heads = make(
      "tr",
      {},
      make("th", { scope: "col", textContent: "error" }),
      ...ways.map((way) => make("th", { scope: "col", textContent: way.kind })),
    );
    const [maps, others] = [this.parts[0], this.parts[1]].map((part) =>
      make("div", { className: "maps" }, ...(part ? part.figures : [])),
    );
    const source = make("p", {
      className: "source",
      textContent: ways.length > 1 ? `Textbook: ${ways[1].source}` : "",
    });
    this.element = make(
      "article",
      { className: "card" },
      make("h2", {}, ...buttons),
      make("p", { className: "source", textContent: about }),
      maps,
      make("table", {}, make("thead", {}, heads), body),
      source,
      others,
    );
  }
  /** What belongs to one of the ways. */
  part(way) {
    const text = way.kind === "textbook" ? "textbook" : `${this.letter} ${way.name}`;
    const button = make("button", { type: "button", title: "Show its samples in the scene", textContent: text });
    button.addEventListener("click", () => this.app.change({ way: way.name }));
    const map = (Kind, name, label) => {
      const canvas = make("canvas");
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", `${way.label}: ${label}`);
      return [
        new Kind(canvas),
        make("figure", { className: way.kind }, canvas, make("figcaption", { textContent: name })),
      ];
    };
    const [directions, one] = map(DirectionMap, "directions", "map of the directions from the point");
    const [surface, two] = map(LightMap, "on the light", "map of the light");
    this.follow(directions.canvas, (q) => directions.projection && directions.fromMap(directions.place(...q)));
    this.follow(surface.canvas, (q) => surface.direction(this.app.view, surface.place(...q)));
    return { way, button, directions, surface, figures: [one, two], cells: {} };
  }
  /** Puts the cursor where the hand is on a map. */
  follow(canvas, toDirection) {
    const put = (event) => {
      const box = canvas.getBoundingClientRect();
      const w = toDirection([(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]);
      if (w) this.app.change({ probe: { w: single(unit(w)) } });
    };
    canvas.addEventListener("pointermove", put);
    canvas.addEventListener("pointerdown", put);
  }
  show(view, options, probe) {
    for (const part of this.parts) {
      const { way, button, directions, surface, cells } = part;
      button.setAttribute("aria-pressed", String(way.name === this.app.state.way));
      directions.aim(view, options.projection, options.near);
      const own = probe && probe.of(way);
      directions.draw(way, view, options, own && own.w);
      surface.draw(way, view, options, own && own.w);
      const put = (key, text, bad) => {
        tell(cells[key], text);
        cells[key].classList.toggle("bad", Boolean(bad));
      };
      for (const n of COUNTS) {
        const error = blockError(way.values, MOST, n, view.truth);
        put(n, view.truth > 0 ? percent(error) : "–", view.truth > 0 && !(error < 1e3));
      }
      const equal = inEqualTime(way, view.truth);
      put("ns", way.ns ? say(way.ns, 2) : "–");
      put("equal", Number.isFinite(equal) ? percent(equal) : "–");
      const mean = meanOf(way.values, MOST);
      put("estimate", say(mean, mean < 0.01 ? 3 : 5), !Number.isFinite(mean));
      put("pdf", own && own.pdf !== undefined ? say(own.pdf, own.pdf < 0.01 || own.pdf > 1e3 ? 3 : 4) : "–");
      const numbersThere = own && own.u && (own.pdf > 0 ? own.u.map((x) => x.toFixed(5)) : ["beside", "beside"]);
      ["u", "v"].forEach((key, k) => put(key, numbersThere ? numbersThere[k] : "–"));
      if (options.draft) continue;
      // directions of the surface may pass beside the light
      const { wrong, beside } = faults(way, way.kind === "surface" ? { ...view, locate: undefined } : view, MOST);
      part.broken = wrong + beside;
      put("faults", part.broken ? part.broken.toLocaleString("en") : "none", part.broken > 0);
      const why = [`${wrong} are not finite or have no positive pdf`, `${beside} miss the light`];
      cells.faults.title = part.broken ? why.join(", ") : "";
    }
  }
}

/** The relative error of as many samples as a way of the core takes in a microsecond, from the nearest power of two; NaN of others, which run as scripts. */
function inEqualTime(way, truth) {
  if (!(truth > 0 && way.ns)) return NaN;
  const n = 2 ** Math.max(0, Math.min(10, Math.round(Math.log2(1000 / way.ns))));
  return blockError(way.values, MOST, n, truth) * Math.sqrt((n * way.ns) / 1000);
}
/** A relative error as people read it. */
const percent = (error) => (error < 1e3 ? `${say(100 * error, 2)} %` : say(error, 2));
/** What the cards show in a sentence: whether textbooks' formulas hold here, and the best technique of the core. */
function verdict(cards, { truth }) {
  if (!(truth > 0)) return "";
  const parts = cards.flatMap((card) => card.parts.map((part) => ({ ...part, core: card.parts[0] })));
  const off = ({ way }, n) => blockError(way.values, MOST, n, truth);
  const said = [];
  const books = parts.filter(({ way }) => way.kind === "textbook");
  const fails = books.filter((part) => part.broken || !(off(part, 1024) <= 20 * off(part.core, 1024)));
  for (const part of fails) {
    const grouped = (n) => n.toLocaleString("en");
    const count = part.broken ? `${grouped(part.broken)} of ${grouped(MOST)} samples are broken, and ` : "";
    const error = off(part, 1024);
    const is = Number.isFinite(error) ? `is off by ${percent(error)}` : "is no number";
    const core = `is off by ${percent(off(part.core, 1024))}${part.core.broken ? "" : ", and none is broken"}`;
    said.push(
      `The textbook’s formula ${part.core.way.name} fails here: ${count}the mean of 1,024 ${is}. The core’s ${core}.`,
    );
  }
  if (books.length && !fails.length) said.push("Textbooks’ formulas hold here.");
  const core = parts.filter(({ way }) => way.kind === "core");
  const best = core.reduce((a, b) => (off(b, 1) < off(a, 1) ? b : a), core[0]);
  if (best) said.push(`The best for equal samples: one ${best.way.name} is off by ${percent(off(best, 1))}.`);
  const equal = ({ way }) => inEqualTime(way, truth);
  const soon = core.reduce((a, b) => (equal(b) < equal(a) ? b : a), core[0]);
  if (soon && Number.isFinite(equal(soon)))
    said.push(`For equal time, without shadow rays: ${soon.way.name}, off by ${percent(equal(soon))} after 1 µs.`);
  return said.join(" ");
}
