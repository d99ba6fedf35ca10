// The core: its C interface, compiled to WebAssembly. Batches are in columns of the library's memory.

const MOST = 4096;
const SEED = 1n;

/** A sentence for people, instead of the page. */
class Unusable extends Error {}

const AGAIN = "Download the page again, or build it with “cargo run --release -p etendue-playground”.";

/** Unpacks and starts the library that the page holds. */
async function startLibrary() {
  const holder = document.getElementById("library");
  const text = holder ? holder.textContent.trim() : "";
  if (!text) throw new Unusable(`This page lacks the library that it shows. ${AGAIN}`);
  if (typeof WebAssembly !== "object" || typeof DecompressionStream !== "function") {
    throw new Unusable(
      "This browser is too old for this page: it needs WebAssembly and DecompressionStream, which Chromium has from version 91 and Firefox from 113.",
    );
  }
  let code;
  try {
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    code = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  } catch {
    throw new Unusable(`The library in this page is damaged: it does not unpack. ${AGAIN}`);
  }
  let module;
  try {
    module = await WebAssembly.compile(code);
  } catch (error) {
    throw new Unusable(
      `This browser cannot run the library in this page; it may lack the vectors of WebAssembly, which Chromium has from version 91 and Firefox from 89 (${error.message}). ${AGAIN}`,
    );
  }
  const instance = await WebAssembly.instantiate(module, {});
  if (!instance.exports.etendue_sample_batch) throw new Unusable(`The library in this page is another one. ${AGAIN}`);
  return new Library(instance.exports);
}

class Library {
  constructor(exports) {
    this.exports = exports;
    this.memory = exports.memory;
    // all columns are allocated once, so that views of the memory stay valid
    this.memory.grow(128);
    this.top = exports.__heap_base.value;
    this.light = this.floats(24);
    this.p = this.floats(3);
    this.n = this.floats(3);
    this.counters = this.words(5);
    this.pointers = this.words(3);
    this.results = this.words(12);
    this.u = [this.floats(MOST), this.floats(MOST)];
    this.one = {
      u: [this.floats(1), this.floats(1)],
      w: [this.floats(1), this.floats(1), this.floats(1)],
      samples: this.samples(1),
    };
    this.grid = { w: [this.floats(MOST), this.floats(MOST), this.floats(MOST)], pdf: this.floats(MOST) };
    this.place = this.top;
  }
  take(Type, n) {
    this.top = (this.top + 15) & ~15;
    const view = new Type(this.memory.buffer, this.top, n);
    this.top += view.byteLength;
    if (this.top > this.memory.buffer.byteLength) throw new Unusable("The page ran out of the memory of its library.");
    return view;
  }
  floats(n) {
    return this.take(Float32Array, n);
  }
  words(n) {
    return this.take(Uint32Array, n);
  }
  /** Frees what was taken since the start. */
  rewind() {
    this.top = this.place;
  }
  /** Columns for samples. */
  samples(n) {
    const three = () => [this.floats(n), this.floats(n), this.floats(n)];
    return {
      direction: three(),
      distance: this.floats(n),
      pdf: this.floats(n),
      weight: this.floats(n),
      normal: three(),
      uv: [this.floats(n), this.floats(n)],
      emits: this.take(Uint8Array, n),
    };
  }
  call(name, ...values) {
    const status = this.exports[name](...values);
    if (status !== 0) throw new Error(`${name} returned ${status}`);
  }
  /** The address of an array of pointers. */
  columns(views) {
    this.pointers.set(views.map((view) => view.byteOffset));
    return this.pointers.byteOffset;
  }
  sampleColumns(s) {
    const all = [...s.direction, s.distance, s.pdf, s.weight, ...s.normal, ...s.uv, s.emits];
    this.results.set(all.map((view) => view.byteOffset));
    return this.results.byteOffset;
  }
  /** Pairs of a sequence, from the sample 0 of a pixel on. Stratified pairs are those of a set of so many. */
  pairs(sequence, n, u = this.u, pixel = 0, count = n) {
    this.counters.set([pixel, 0, 0, 0, 0]);
    const values = sequence === "stratified" ? [SEED, count] : [SEED];
    this.call(`etendue_${sequence}_pairs`, ...values, this.counters.byteOffset, n, this.columns(u));
  }
  /** Memory for the prepared light of a technique. */
  sampler(technique) {
    return { technique, memory: this.floats(technique.numbers) };
  }
  /** Prepares a light, given by its numbers in the order of its fields. */
  prepare(sampler, light, p, n) {
    this.light.set(light);
    this.p.set(p);
    this.n.set(n);
    // a sun takes the point, too, which is not used
    this.call(
      "etendue_prepare",
      sampler.technique.technique,
      this.light.byteOffset,
      this.p.byteOffset,
      takesNormal(sampler.technique) ? this.n.byteOffset : 0,
      sampler.memory.byteOffset,
    );
  }
  sample(sampler, n, u, samples) {
    const columns = this.columns(u);
    this.call(
      "etendue_sample_batch",
      sampler.technique.technique,
      sampler.memory.byteOffset,
      n,
      columns,
      this.sampleColumns(samples),
    );
  }
  pdf(sampler, n, w, pdf) {
    this.call(
      "etendue_pdf_batch",
      sampler.technique.technique,
      sampler.memory.byteOffset,
      n,
      this.columns(w),
      pdf.byteOffset,
    );
  }
  /** The pdf of one direction. */
  pdfOf(sampler, w) {
    this.one.w.forEach((column, k) => {
      column[0] = w[k];
    });
    this.pdf(sampler, 1, this.one.w, this.one.samples.pdf);
    return this.one.samples.pdf[0];
  }
  /** The numbers that are mapped to one direction. */
  invert(sampler, w) {
    this.one.w.forEach((column, k) => {
      column[0] = w[k];
    });
    const columns = this.columns(this.one.w);
    this.results.set(this.one.u.map((view) => view.byteOffset));
    this.call(
      "etendue_invert_batch",
      sampler.technique.technique,
      sampler.memory.byteOffset,
      1,
      columns,
      this.results.byteOffset,
    );
    return this.one.u.map((column) => column[0]);
  }
  /** The sample for one pair of numbers. */
  sampleOf(sampler, u) {
    this.one.u.forEach((column, k) => {
      column[0] = u[k];
    });
    const s = this.one.samples;
    this.sample(sampler, 1, this.one.u, s);
    return {
      direction: s.direction.map((c) => c[0]),
      pdf: s.pdf[0],
      distance: s.distance[0],
      uv: s.uv.map((c) => c[0]),
    };
  }
  /** Directions of a surface, in the frame whose third axis is the normal, and their pdf. */
  hemisphere(warp, n, u, local, pdf) {
    const columns = this.columns(u);
    this.results.set(local.map((view) => view.byteOffset));
    this.call("etendue_warp_sample_batch", WARPS[warp], 0, n, columns, this.results.byteOffset);
    this.call("etendue_warp_pdf_batch", WARPS[warp], 0, n, this.columns(local), pdf.byteOffset);
  }
  hemisphereInverse(warp, local) {
    this.one.w.forEach((column, k) => {
      column[0] = local[k];
    });
    const columns = this.columns(this.one.w);
    this.results.set(this.one.u.map((view) => view.byteOffset));
    this.call("etendue_warp_invert_batch", WARPS[warp], 0, 1, columns, this.results.byteOffset);
    this.call("etendue_warp_pdf_batch", WARPS[warp], 0, 1, this.columns(this.one.w), this.one.samples.pdf.byteOffset);
    return { u: this.one.u.map((column) => column[0]), pdf: this.one.samples.pdf[0] };
  }
}

const takesNormal = (technique) => technique.place.includes("n");
