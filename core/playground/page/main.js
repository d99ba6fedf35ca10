// The page: one frame after another.

class App {
  constructor(library) {
    this.library = library;
    this.state = structuredClone(START);
    this.colors = new Uint32Array(MOST);
    this.times = [];
    this.square = new SquareMap(byId("square"));
    this.plot = new Plot(byId("chart"));
    this.scene = new Scene(byId("scene"), byId("overlay"), (change) => this.change(change));
    this.read();
    this.bind();
    new ResizeObserver(() => {
      layout.age++;
      this.change({});
    }).observe(document.body);
    window.addEventListener("hashchange", () => {
      if (location.hash !== this.written) {
        this.read();
        this.change({});
      }
    });
    this.frame();
  }
  /** Changes the state, and draws it in the next frame. */
  change(change) {
    Object.assign(this.state, change);
    if (!this.waiting) {
      this.waiting = true;
      requestAnimationFrame(() => {
        this.waiting = false;
        this.frame(true);
      });
    }
  }
  /** Reads the state from the address; one that is not of this page shows the beginning. */
  read() {
    if (location.hash.length < 2) return;
    try {
      const given = JSON.parse(decodeURIComponent(location.hash.slice(1)));
      const chosen = isAllowed("chosen", given.chosen) ? given.chosen : null;
      const lesson = Number.isInteger(given.lesson) && LECTURE[given.lesson] ? lessonState(given.lesson, chosen) : {};
      const state = { ...structuredClone(START), ...lesson };
      const { light } = given;
      if (light) Object.assign(state, { light: overhead(light.name || light), handle: "whole light" });
      for (const [key, value] of Object.entries(given))
        if (!["light", "lesson"].includes(key) && isAllowed(key, value)) state[key] = value;
      state.n = unit(state.n);
      for (const [key, value] of Object.entries((light && light.fields) || {}))
        if (isLike(value, state.light.fields[key])) state.light.fields[key] = value;
      this.state = state;
    } catch {
      this.state = structuredClone(START);
    }
  }
  /** Writes the state to the address, so that a link shows the same; not while the hand moves. */
  write() {
    clearTimeout(this.writing);
    this.writing = setTimeout(() => {
      const { probe, ...kept } = this.state;
      this.written = `#${encodeURIComponent(JSON.stringify(kept))}`;
      history.replaceState(null, "", this.written);
    }, 400);
  }
  /** Begins a figure of the lecture, or the page without one; a light that was chosen stays. */
  lesson(index, chosen = this.state.chosen) {
    const { inside } = this.state;
    const explored = chosen ? { chosen, light: overhead(chosen), handle: "whole light" } : {};
    const own = index === null ? explored : lessonState(index, chosen);
    this.state = { ...structuredClone(START), inside, ...own };
    this.change({});
  }
  bind() {
    const select = (id, put) => byId(id).addEventListener("change", () => put(byId(id).value));
    select("light", (name) =>
      this.change({ light: overhead(name), chosen: name, probe: null, handle: "whole light" }),
    );
    for (const id of ["handle", "sequence", "shade", "projection"]) select(id, (value) => this.change({ [id]: value }));
    select("dots", (value) => this.change({ dots: Number(value) }));
    for (const id of ["near", "textbook", "surface"])
      byId(id).addEventListener("change", () => this.change({ [id]: byId(id).checked, ways: null }));
    byId("reset").addEventListener("click", () =>
      this.state.lesson === null
        ? this.change({ light: overhead(this.state.light.name), ...UP })
        : this.lesson(this.state.lesson, null),
    );
    byId("explore").addEventListener("click", () => this.lesson(null));
    byId("lecture").addEventListener("click", () => this.lesson(this.state.lesson ?? 0));
    byId("previous").addEventListener("click", () => this.lesson(Math.max(0, this.state.lesson - 1)));
    byId("next").addEventListener("click", () => this.lesson(Math.min(LECTURE.length - 1, this.state.lesson + 1)));
    select("figures", (value) => this.lesson(Number(value)));
    const square = byId("square");
    const point = (event) => {
      const box = square.getBoundingClientRect();
      const q = this.square.place((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
      this.change({ probe: { u: q.map((x) => Math.fround(clamp(x, 0, 0.999999))) } });
    };
    square.addEventListener("pointermove", point);
    square.addEventListener("pointerdown", point);
    square.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step) return;
      event.preventDefault();
      const u = (this.state.probe && this.state.probe.u) || [0.5, 0.5];
      this.change({
        probe: { u: u.map((x, k) => Math.fround(clamp(x + step[k] * (event.shiftKey ? 0.1 : 0.01), 0, 0.999999))) },
      });
    });
    const chart = byId("chart");
    const lift = (to) => {
      if (this.state.panel === "importance") this.change({ inside: clamp(to, 0.2, 4.9) });
    };
    for (const name of ["pointerdown", "pointermove"]) {
      chart.addEventListener(name, (event) => {
        if (!event.buttons || !this.plot.y) return;
        const box = chart.getBoundingClientRect();
        const [, top, , bottom] = this.plot.box;
        const y = ((event.clientY - box.top) * chart.height) / box.height;
        lift((this.plot.y.high * (bottom - y)) / (bottom - top));
      });
    }
    chart.addEventListener("keydown", (event) => {
      const step = { ArrowUp: 0.1, ArrowDown: -0.1 }[event.key];
      if (step && this.state.panel === "importance") {
        event.preventDefault();
        lift(this.state.inside + step);
      }
    });
  }
  /** Makes what depends on the kind of light, and on which ways are shown. */
  build() {
    const { state } = this;
    const kind = state.light.name;
    if (this.kind !== kind) {
      this.kind = kind;
      this.ways = waysOf(this.library, kind);
      this.sliders = sliders(this);
      byId("pushes").replaceChildren(...this.sliders.map(({ slider }) => slider.element));
      byId("presets").replaceChildren(...presets(this));
      this.coordinates = coordinates(this);
      byId("inputs").replaceChildren(...this.coordinates.map((row) => row.element));
      const light = kindOf(kind);
      const paragraph = (name, text) => make("p", {}, make("b", { textContent: `${name}. ` }), text);
      byId("docs").replaceChildren(
        make("p", { textContent: light.about }),
        ...light.techniques.map((t) => paragraph(spoken(t.by), t.about)),
      );
      this.shown = null;
    }
    // a light that was chosen may have none of the ways that a figure compares
    const named = state.ways && (!state.ways.length || this.ways.some((way) => state.ways.includes(way.name)));
    const wanted = (way) =>
      named
        ? state.ways.includes(way.name)
        : way.kind === "core" || (way.kind === "textbook" ? state.textbook : state.surface);
    const ways = this.ways.filter(wanted);
    const key = ways.map((way) => way.name).join();
    if (this.shown !== key) {
      this.shown = key;
      layout.age++;
      const groups = ways.reduce((list, way) => {
        if (way.row && list.length) list[list.length - 1].push(way);
        else list.push([way]);
        return list;
      }, []);
      this.cards = groups.map((group, i) => new Card(this, group, LETTERS[i]));
      byId("cards").replaceChildren(...this.cards.map((card) => card.element));
    }
    if (!ways.some((way) => way.name === state.way)) state.way = (ways[0] || this.ways[0]).name;
  }
  /** What is under the cursor: of a direction, its pdf and numbers by each way; of numbers, their directions. */
  probe(view) {
    const { probe } = this.state;
    if (!probe) return null;
    const of = (way) => {
      if (probe.w) return { w: probe.w, pdf: way.pdf && way.pdf(probe.w), u: way.invert && way.invert(probe.w) };
      if (!way.sampleOf) return null;
      const { direction, pdf } = way.sampleOf(probe.u);
      return { w: direction, pdf, u: way.invert && way.invert(direction) };
    };
    return { ...probe, of };
  }
  /** Draws all; a draft is drawn again, finer, once nothing has changed for a while. */
  frame(draft = false) {
    clearTimeout(this.finer);
    if (draft) this.finer = setTimeout(() => requestAnimationFrame(() => this.frame()), 150);
    const began = performance.now();
    const { state, library } = this;
    this.build();
    const view = (this.view = viewOf(state));
    for (const way of this.ways) way.prepare(view);
    const panel = state.panel || "errors";
    const shown = this.cards.flatMap((card) => card.ways);
    const chosen = this.ways.find((way) => way.name === state.way);
    let lines = [];
    if (panel === "sequences")
      lines = Object.keys(SEQUENCES).map((name, i) => [
        SEQUENCES[name],
        SERIES[i],
        [],
        sequenceErrors(library, chosen, view, name),
      ]);
    // these panels draw points of their own
    const finding =
      panel === "importance"
        ? drawImportance(this.plot, state.inside, library)
        : panel === "stratification"
          ? drawStratification(this.plot, library)
          : "";
    library.pairs(state.sequence, MOST, library.u, 0, state.sequence === "stratified" ? state.dots : MOST);
    for (let i = 0; i < MOST; i++) this.colors[i] = stratumOf(library.u[0][i], library.u[1][i]);
    for (const way of new Set([...shown, chosen])) {
      way.draw(MOST, library.u);
      evaluate(way, MOST, view.n);
      if (!draft) time(way, library.u);
    }
    const options = { ...state, colors: this.colors, draft };
    const probe = this.probe(view);
    const own = probe && probe.of(chosen);
    this.scene.show(state, view);
    this.scene.draw(chosen, options, own && own.w);
    for (const card of this.cards) card.show(view, options, probe);
    const marks = !probe
      ? []
      : probe.u
        ? [{ u: probe.u }]
        : this.cards.map((card) => ({ u: (probe.of(card.ways[0]) || {}).u, name: card.letter })).filter(({ u }) => u);
    this.square.draw(library.u, options, marks);
    if (panel === "errors") lines = this.lines(view);
    if (lines.length) drawErrors(this.plot, lines);
    tell(byId("finding"), panel === "variance" ? drawVariances(this.plot, chosen.values) : finding);
    this.controls(view, probe);
    if (!draft) tell(byId("verdict"), verdict(this.cards, view));
    if (draft) this.pace(began);
    this.write();
  }
  /** The errors of all ways: a textbook's formula has the colour of the technique beside it. */
  lines(view) {
    return this.cards.flatMap((card, i) =>
      card.ways.map((way) => [
        `${card.letter} ${way.name}`,
        SERIES[i % SERIES.length],
        way.row ? [6, 4] : [],
        blockErrors(way.values, view.truth),
      ]),
    );
  }
  controls(view, probe) {
    const { state } = this;
    const lesson = state.lesson !== null;
    choices(
      byId("light"),
      LIGHTS.map((light) => [light.name, title(light.name)]),
      state.light.name,
    );
    const names = ["view", ...this.scene.handles.map((h) => h.name)];
    if (!names.includes(state.handle)) state.handle = "view";
    choices(
      byId("handle"),
      names.map((name) => [name, name === "view" ? "the view" : name.replaceAll("_", " ")]),
      state.handle,
    );
    for (const [id, list] of Object.entries(CHOICES)) choices(byId(id), list, String(state[id]));
    for (const id of ["near", "textbook", "surface"]) byId(id).checked = state[id];
    for (const { slider, read } of this.sliders) slider.show(read());
    for (const row of this.coordinates) row.show();
    tell(
      byId("truth"),
      view.truth > 0
        ? `Irradiance per unit of the light: ${say(view.truth, 7)}, ${view.known}.`
        : view.emits
          ? "The light is below the horizon: nothing arrives."
          : "The point is behind the light, which does not emit there.",
    );
    tell(
      byId("probe"),
      probe
        ? probe.w
          ? `cursor: direction ${probe.w.map((x) => x.toFixed(4)).join(", ")}`
          : `cursor: u = ${probe.u.map((x) => x.toFixed(4)).join(", ")}`
        : "Point at a map to see the pdf and the inverse there, or at the unit square to see where a pair goes.",
    );
    if (document.body.dataset.panel !== (state.panel || "errors")) {
      document.body.dataset.panel = state.panel || "errors";
      layout.age++;
      this.change({});
    }
    byId("explore").setAttribute("aria-pressed", String(!lesson));
    byId("lecture").setAttribute("aria-pressed", String(lesson));
    if (byId("lesson").hidden === lesson) {
      byId("lesson").hidden = !lesson;
      layout.age++;
    }
    if (lesson) {
      const figure = LECTURE[state.lesson];
      choices(
        byId("figures"),
        LECTURE.map(({ title: text }, i) => [String(i), `${i + 1}. ${text}`]),
        String(state.lesson),
      );
      tell(byId("says"), figure.says);
      tell(byId("tries"), triesOf(figure, lightOf(figure), state.light));
      byId("previous").disabled = state.lesson === 0;
      byId("next").disabled = state.lesson === LECTURE.length - 1;
    }
  }
  pace(began) {
    const now = performance.now();
    this.times.push({ began, work: now - began });
    if (this.times.length > 60) this.times.shift();
    const work = this.times.map((t) => t.work).sort((a, b) => a - b);
    const ways = this.cards.flatMap((card) => card.ways).length;
    const each = ways === 1 ? "one way" : `each of ${ways} ways`;
    const time = `${work[work.length >> 1].toFixed(1)} ms`;
    tell(byId("pace"), ways ? `A frame of ${MOST.toLocaleString("en")} samples by ${each} takes ${time}.` : "");
  }
  /** The relative error of 1,024 samples by a way. */
  errorOf(way) {
    return blockError(way.values, MOST, 1024, this.view.truth);
  }
  /** What the page shows, bit by bit: for those who compare it with the core. */
  answer() {
    const { view, state } = this;
    const word = new Uint32Array(1);
    const number = new Float32Array(word.buffer);
    const double = new Float64Array(1);
    const halves = new Uint32Array(double.buffer);
    const bits = (x) => {
      number[0] = x;
      return word[0];
    };
    const wide = (x) => {
      double[0] = x;
      return halves[1].toString(16).padStart(8, "0") + halves[0].toString(16).padStart(8, "0");
    };
    const hash = (columns) => {
      let h = 0x811c9dc5;
      for (const column of columns) for (let i = 0; i < MOST; i++) h = Math.imul(h ^ bits(column[i]), 0x01000193);
      return h >>> 0;
    };
    const probe = this.probe(view);
    const techniques = this.cards
      .map((card) => card.parts[0])
      .filter(({ way }) => way.kind === "core")
      .map(({ way, cells }) => {
        const s = way.samples;
        const own = probe && probe.of(way);
        return {
          by: way.technique.by,
          samples: hash([...s.direction, s.distance, s.pdf, s.weight, ...s.normal, ...s.uv]),
          first: s.direction.map((c) => bits(c[0])),
          errors: COUNTS.map((n) => wide(blockError(way.values, MOST, n, view.truth))),
          estimate: wide(meanOf(way.values, MOST)),
          probe: own ? { pdf: bits(own.pdf), u: own.u.map(bits) } : null,
          drawn: COUNTS.map((n) => cells[n].textContent),
        };
      });
    return {
      light: state.light.name,
      numbers: view.numbers.map(bits),
      p: view.p.map(bits),
      n: view.n.map(bits),
      truth: wide(view.truth),
      known: view.known,
      probe: probe && probe.w ? probe.w.map(bits) : null,
      techniques,
    };
  }
}

/** Starts the page, or says why it cannot. */
async function start() {
  const failure = byId("failure");
  const page = byId("page");
  failure.textContent = "The page unpacks its library …";
  try {
    const library = await startLibrary();
    page.hidden = false;
    // for the console: playground.answer(), playground.change({ dots: 16 })
    window.playground = new App(library);
    failure.hidden = true;
  } catch (error) {
    page.hidden = true;
    failure.hidden = false;
    failure.textContent = error instanceof Unusable ? error.message : `The page failed: ${error.message}. ${AGAIN}`;
    if (!(error instanceof Unusable)) throw error;
  }
}
start();
