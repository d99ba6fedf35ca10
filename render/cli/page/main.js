// The page: asks the server what there is, shows it, and tells it what is wished.

const byId = (id) => document.getElementById(id);
function make(tag, text = "") {
  const element = document.createElement(tag);
  element.textContent = text;
  return element;
}
/** How long the page waits between two questions, in milliseconds: usually, and while the image is coarse. */
const [PAUSE, SHORT] = [200, 40];

class View {
  constructor() {
    Object.assign(this, { status: null, pixels: new Map(), other: "", cursor: null, dragged: null, wipes: false, hidden: null, updates: 0 });
    this.lens = new Lens();
    this.first = new Drawn();
    this.second = new Drawn();
    this.bind();
    new ResizeObserver(() => this.frame()).observe(document.body);
    this.ask();
  }

  /** Asks for ever, one question after another, so that no more than one waits for its answer. */
  async ask() {
    for (;;) {
      if (document.hidden) await new Promise((done) => document.addEventListener("visibilitychange", done, { once: true }));
      try {
        const answer = await fetch("status");
        if (!answer.ok) throw new Error(`${answer.status}`);
        this.take(await answer.json());
        await this.load();
        byId("lost").hidden = true;
      } catch (error) {
        if (error instanceof TypeError || /^\d+$/.test(error.message)) byId("lost").hidden = false;
        else throw error;
      }
      await new Promise((done) => setTimeout(done, this.isAsking || (this.status && this.status.draft && this.status.draft.coarse) ? SHORT : PAUSE));
    }
  }
  /** Receives the images that are shown, if there are newer ones. */
  async load() {
    const names = [nameOf(this.status.way), this.other];
    for (const name of this.pixels.keys()) if (!names.includes(name)) this.pixels.delete(name);
    const { reference } = this.status;
    if (reference && this.other === reference && !this.pixels.has(reference)) {
      const pixels = await receive(null);
      if (pixels) this.pixels.set(reference, Object.assign(pixels, { name: reference }));
      this.frame();
    }
    const { draft, pictures } = this.status;
    const drawn = draft ? [draft, ...pictures.filter((p) => nameOf(p.way) !== nameOf(draft.way))] : pictures;
    for (const { way, version } of drawn) {
      const name = nameOf(way);
      const known = this.pixels.get(name);
      if (!names.includes(name) || (known && known.version === version)) continue;
      const pixels = await receive(way);
      if (!pixels) continue;
      pixels.name = name;
      this.pixels.set(name, pixels);
      this.updates++;
      this.frame();
    }
  }
  async wish(wish) {
    const answer = await fetch("wish", { method: "POST", body: JSON.stringify(wish) }).catch(() => null);
    if (!answer) byId("lost").hidden = false;
    else if (answer.ok) this.take(await answer.json());
    else this.say(await answer.text());
  }
  say(text) {
    byId("message").hidden = !text || text === this.hidden;
    byId("message").querySelector("span").textContent = text || "";
  }

  /** Shows what the server says. */
  take(status) {
    const isFirst = !this.status;
    // images of another scene
    if (!isFirst && `${status.size}` !== `${this.status.size}`) this.pixels.clear();
    this.status = status;
    if (isFirst) {
      for (const id of ["technique", "sampler"])
        byId(id).replaceChildren(...status[`${id}s`].map(([name, about]) => Object.assign(make("option", name), { title: about })));
      byId("failure").hidden = true;
      byId("page").hidden = false;
    }
    const { way, pictures, size } = status;
    const picture = pictures.find((p) => nameOf(p.way) === nameOf(way));
    for (const id of ["technique", "sampler"]) if (document.activeElement !== byId(id) || !isFirst) byId(id).value = way[id];
    const about = status.techniques.find(([name]) => name === way.technique)[1];
    byId("about").textContent = picture && picture.chosen !== way.technique ? `${about}. Here it is ${picture.chosen}.` : about;
    byId("title").textContent = `${status.scene}, ${size.join(" × ")}${status.sensor === "radiance" ? "" : `, ${status.sensor}`}`;
    document.title = `${status.scene}: a view of a render`;
    byId("pause").textContent = status.paused ? "Go on" : "Pause";
    byId("pass").value = status.paused || (picture && picture.end) ? 0 : status.pass;
    byId("changed").hidden = !status.changed;
    if (status.changed) byId("changed").querySelector("span").textContent = `${status.changed} has changed since it was read.`;
    if (this.hidden && this.hidden !== status.message) this.hidden = null;
    if (status.message || !byId("message").hidden) this.say(status.message || byId("message").querySelector("span").textContent);
    const facts = [
      ["samples", picture ? `${short(picture.spp)} per pixel` : "none yet"],
      ["error", picture ? percent(picture.error) + (status.target ? `, ${percent(status.target)} wanted` : "") : "not known yet"],
      ["time", picture ? `${picture.seconds.toFixed(1)} s` : "0 s"],
      ["now", status.paused ? "paused" : !picture ? "its first pass, over a coarse image" : picture.end ? `no more samples: ${picture.end}` : "rendering"],
    ];
    if (picture && picture.systematic > 0) facts.splice(2, 0, ["of which", `at most ${percent(picture.systematic)} comes from approximations`]);
    if (picture && picture.uncertain) facts.splice(2, 0, ["uncertain", `since ${picture.uncertain}`]);
    byId("facts").replaceChildren(...facts.flatMap(([term, text]) => [make("dt", term), make("dd", text)]));
    byId("part").textContent = status.crop
      ? `columns ${status.crop[0]} to ${status.crop[2] - 1}, rows ${status.crop[1]} to ${status.crop[3] - 1}; parts are whole tiles of 16 × 16 pixels`
      : "all pixels";
    byId("whole").disabled = !status.crop;
    this.takeOthers(pictures, nameOf(way));
    byId("files").textContent = status.files
      ? `The files ${status.files} hold the image that is shown, and Ctrl-C ends the program.`
      : "Nothing is written unless you save a copy. Ctrl-C ends the program.";
    byId("save").textContent = `Save a copy as ${status.copy}`;
    byId("still").disabled = !status.orbit;
    plot(byId("plot"), pictures, nameOf(way), status.target);
  }
  takeOthers(pictures, shown) {
    const names = pictures.map((p) => nameOf(p.way)).sort();
    const { reference } = this.status;
    const others = ["", ...(reference ? [reference] : []), ...names.filter((name) => name !== shown)];
    if (!others.includes(this.other)) this.other = "";
    if (this.others !== others.join("|")) {
      this.others = others.join("|");
      byId("other").replaceChildren(...others.map((name) => Object.assign(make("option", name || "nothing"), { value: name })));
    }
    byId("other").value = this.other;
    byId("wipe").disabled = !this.other;
    const key = (name) => {
      const item = make("span");
      const mark = make("i");
      const way = pictures.find((p) => nameOf(p.way) === name).way;
      mark.style.background = colorOf(way);
      item.append(mark, make(name === shown ? "b" : "span", name));
      return item;
    };
    const keys = names.map(key);
    if (this.status.target) keys.push(make("span", `- - ${percent(this.status.target)} wanted`));
    byId("lines").replaceChildren(...keys);
  }

  /** Draws the image and the numbers of the pixel. */
  frame() {
    const { status, cursor } = this;
    if (!status) return;
    plot(byId("plot"), status.pictures, nameOf(status.way), status.target);
    const pixels = this.pixels.get(nameOf(status.way)) || this.last;
    if (!pixels) return;
    this.last = pixels;
    // pixel by pixel, only images of one size are compared
    const compared = this.pixels.get(this.other);
    const other = compared && compared.width === pixels.width ? compared : undefined;
    const asked = byId("layer").value;
    const compares = asked === "difference" || asked === "relative";
    const layer = compares && !other ? "radiance" : asked;
    const stops = Number(byId("exposure").value);
    byId("stops").textContent = `${stops > 0 ? "+" : ""}${stops.toFixed(1)} stops`;
    const gain = [1 / status.exposure, 2 ** stops];
    // both have the same colours
    const all = [pixels, other].filter((p) => p);
    const asks = (id, x) => (Number(byId(id).value) > 0 ? Number(byId(id).value) : x);
    const found = layer === "radiance" ? [0, 1] : compares ? widest(pixels, other, layer === "relative") : all.map((p) => ends(p, layer)).reduce((a, b) => [Math.min(a[0], b[0]), Math.max(a[1], b[1])]);
    const range = layer in MAPS ? [asks("low", found[0]), asks("high", found[1])] : found;
    this.first.update(pixels, layer, gain, range, compares && other);
    this.isSplit = Boolean(other) && !compares;
    if (this.isSplit) this.second.update(other, layer, gain, range);
    const crop = this.dragged || status.crop;
    draw(byId("image"), this.lens, status.size, this.first.canvas, this.isSplit && this.second.canvas, byId("wipe").value / 100, all.map((p) => p.name), crop, cursor);
    byId("legend").textContent = compares && !other ? "Choose an image B to compare with." : "";
    byId("bar").hidden = layer === "radiance";
    byId("range").hidden = !(layer in MAPS);
    if (layer !== "radiance") {
      const scale = scaleOf(layer, range, status.sensor);
      bar(byId("bar"), scale, this.first.counts);
      byId("bar").setAttribute("aria-label", `${scale.title}: from ${scale.format(scale.at(0))} to ${scale.format(scale.at(1))}`);
    }
    this.read(all);
  }
  /** The numbers of the pixel under the cursor. */
  read(all) {
    const { cursor } = this;
    byId("place").textContent = cursor ? `Pixel (${cursor.join(", ")}): the value, and its standard error` : "Point at a pixel to read its value and its error.";
    const rows = !cursor ? [] : all.map((pixels) => {
      const i = indexAt(pixels, cursor, this.status.size);
      const row = make("tr");
      row.append(make("th", pixels.name));
      for (const c of [0, 1, 2]) row.append(make("td", `${"RGB"[c]} ${short(pixels.mean[3 * i + c])} ± ${short(Math.sqrt(pixels.variance[3 * i + c]))}`));
      row.append(make("td", `${pixels.samples[i].toLocaleString("en")} samples`));
      return row;
    });
    byId("pixel").tBodies[0].replaceChildren(...rows);
  }

  /** The place of an event in pixels of the canvas. */
  at(event) {
    const canvas = byId("image");
    const box = canvas.getBoundingClientRect();
    return [((event.clientX - box.left) * canvas.width) / box.width, ((event.clientY - box.top) * canvas.height) / box.height];
  }
  pixelAt(place) {
    const at = this.lens.toImage(byId("image"), place).map(Math.floor);
    return at.every((x, k) => x >= 0 && x < this.lens.size[k]) ? at : null;
  }
  /** The pixels between two places of the canvas; null if there are none. */
  between(a, b) {
    const corners = [a, b].map((place) => this.lens.toImage(byId("image"), place));
    const clip = (x, k) => Math.max(0, Math.min(this.lens.size[k], x));
    const low = [0, 1].map((k) => Math.floor(clip(Math.min(corners[0][k], corners[1][k]), k)));
    const high = [0, 1].map((k) => Math.ceil(clip(Math.max(corners[0][k], corners[1][k]), k)));
    return low[0] < high[0] && low[1] < high[1] ? [...low, ...high] : null;
  }
  drags(on) {
    byId("crop").setAttribute("aria-pressed", on);
  }
  get isCropping() {
    return byId("crop").getAttribute("aria-pressed") === "true";
  }

  bind() {
    for (const id of ["technique", "sampler"]) byId(id).addEventListener("change", () => this.wish({ [id]: byId(id).value }));
    for (const id of ["layer", "exposure", "wipe", "low", "high"]) byId(id).addEventListener("input", () => this.frame());
    byId("other").addEventListener("change", () => {
      this.other = byId("other").value;
      byId("wipe").disabled = !this.other;
      this.load().then(() => this.frame(), () => {});
    });
    const click = (id, what) => byId(id).addEventListener("click", what);
    click("pause", () => this.wish({ paused: !this.status.paused }));
    click("reload", () => this.wish({ reload: true }));
    click("dismiss", () => {
      this.hidden = byId("message").querySelector("span").textContent;
      byId("message").hidden = true;
    });
    click("crop", () => this.drags(!this.isCropping));
    click("whole", () => this.wish({ crop: null }));
    click("save", () => this.wish({ save: true }));
    click("turn", () => {
      byId("turn").setAttribute("aria-pressed", !this.isTurning);
      canvas.classList.toggle("turns", this.isTurning);
    });
    click("still", () => this.wish({ orbit: null }));
    click("camera", async () => {
      const { camera } = this.status;
      const copied = await navigator.clipboard.writeText(camera).then(() => "Copied", () => "Not copied, but here it is");
      this.say(`${copied}:\n${camera}`);
    });
    click("worst", () => {
      const pixels = this.last;
      if (!pixels) return;
      if (this.ranked !== pixels) Object.assign(this, { ranked: pixels, rank: 0, worst: worst(pixels) });
      const i = this.worst[this.rank++ % this.worst.length];
      if (i === undefined) return;
      this.cursor = [i % pixels.width, Math.floor(i / pixels.width)];
      if (this.lens.zoom < 8 * ratio()) this.lens.scale(byId("image"), (8 * ratio()) / this.lens.zoom, this.lens.toCanvas(byId("image"), this.cursor));
      this.lens.reveal(byId("image"), this.cursor);
      this.frame();
    });
    const canvas = byId("image");
    const middle = () => [canvas.width / 2, canvas.height / 2];
    click("visible", () => {
      const crop = this.between([0, 0], [canvas.width, canvas.height]);
      if (crop) this.wish({ crop });
    });
    const zoom = (factor, at) => {
      this.lens.scale(canvas, factor, at);
      this.frame();
    };
    const single = () => zoom(1 / this.lens.zoom, middle());
    const all = () => {
      this.lens.isFit = true;
      this.frame();
    };
    click("closer", () => zoom(2, middle()));
    click("farther", () => zoom(0.5, middle()));
    click("single", single);
    click("fit", all);
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      if (this.isTurning) this.turn(0, 0, 2 ** (Math.sign(event.deltaY) / 4));
      else zoom(2 ** (-Math.sign(event.deltaY) / 2), this.at(event));
    }, { passive: false });
    this.bindPointers(canvas);
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (step) {
        const from = this.cursor || this.lens.centre.map(Math.floor);
        const far = event.shiftKey ? 16 : 1;
        this.cursor = from.map((x, k) => Math.max(0, Math.min(this.lens.size[k] - 1, x + far * step[k])));
        this.lens.reveal(canvas, this.cursor);
        this.frame();
      } else if (event.key === "+" || event.key === "=") zoom(2, middle());
      else if (event.key === "-") zoom(0.5, middle());
      else if (event.key === "1") single();
      else if (event.key === "0") all();
      else return;
      event.preventDefault();
    });
  }
  get isTurning() {
    return byId("turn").getAttribute("aria-pressed") === "true";
  }
  /** Turns the camera further. One wish waits for its answer, and the next one has all turns since. */
  async turn(around, over, factor) {
    const [a, o, d] = this.orbit || this.status.orbit || [0, 0, 1];
    this.orbit = [a + around, o + over, Math.max(1e-3, Math.min(1e3, d * factor))];
    if (this.isAsking) return;
    this.isAsking = true;
    while (this.orbit) {
      const orbit = this.orbit;
      await this.wish({ orbit });
      await this.load().catch(() => {});
      if (this.orbit === orbit) this.orbit = null;
    }
    this.isAsking = false;
  }
  /** Whether a place of the canvas is at the line between two images. */
  isAtLine(place) {
    const canvas = byId("image");
    return this.isSplit && Math.abs(place[0] - (byId("wipe").value / 100) * canvas.width) < 12 * ratio();
  }
  /** Drags move the line between two images, the image or the camera, or choose a part of it; two fingers zoom. */
  bindPointers(canvas) {
    const down = new Map();
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      down.set(event.pointerId, this.at(event));
      if (down.size === 1) this.from = this.at(event);
      this.wipes = down.size === 1 && !this.isCropping && this.isAtLine(this.from);
      canvas.classList.toggle("moves", !this.isCropping && !this.wipes);
    });
    canvas.addEventListener("pointermove", (event) => {
      const to = this.at(event);
      const from = down.get(event.pointerId);
      if (from && down.size === 2) {
        const still = [...down].find(([id]) => id !== event.pointerId)[1];
        const far = (p) => Math.hypot(p[0] - still[0], p[1] - still[1]);
        this.lens.scale(canvas, far(to) / Math.max(1, far(from)), still);
      } else if (from && this.wipes) byId("wipe").value = (100 * to[0]) / canvas.width;
      else if (from && this.isCropping) this.dragged = this.between(this.from, to);
      else if (from && this.isTurning) this.turn((-Math.PI * (to[0] - from[0])) / canvas.width, (Math.PI * (to[1] - from[1])) / canvas.height, 1);
      else if (from) this.lens.move([to[0] - from[0], to[1] - from[1]]);
      canvas.classList.toggle("wipes", this.wipes || (!down.size && this.isAtLine(to)));
      if (from) down.set(event.pointerId, to);
      this.cursor = this.pixelAt(to);
      this.frame();
    });
    const up = (event) => {
      if (!down.delete(event.pointerId) || down.size) return;
      canvas.classList.remove("moves");
      this.wipes = false;
      if (this.isCropping && this.dragged && event.type === "pointerup") this.wish({ crop: this.dragged });
      if (this.dragged) this.drags(false);
      this.dragged = null;
      this.cursor = this.pixelAt(this.at(event));
      this.frame();
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
  }
}

window.view = new View();
