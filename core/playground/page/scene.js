// The scene: the point, its hemisphere, the light and its samples, from a camera that goes round; and what the hand takes hold of.

/** Distance beyond which lights are shown nearer, as large as they look from the point; and the greatest one that is shown. */
const NEAR = 1.5;
const FAR = 1.95;

class Scene {
  constructor(canvas, overlay, change) {
    Object.assign(this, { canvas, change, context: canvas.getContext("2d"), dots: new Pixels(overlay) });
    this.camera = { azimuth: 0.5, elevation: 0.32, distance: 5.4 };
    this.held = null;
    this.pointers = new Map();
    this.listen();
  }
  /** Sets what is shown: the state, the light as seen, and the handles. */
  show(state, view) {
    this.state = state;
    this.view = view;
    const center = middle(state.light);
    const r = center ? length(sub(center, state.p)) : 1;
    this.scale = r > NEAR ? (FAR - (FAR - NEAR) * (NEAR / r)) / r : 1;
    this.handles = handles(state.light, state.p).map((h) => ({ ...h, shown: this.shown(h.at, h.from === state.p) }));
    this.handles.push({
      name: "shading point",
      at: state.p,
      shown: state.p,
      put: (to) => ({ p: [to[0], state.p[1], to[2]] }),
      ground: true,
    });
    const tip = along(state.p, state.n, 0.8);
    this.handles.push({
      name: "normal",
      at: tip,
      from: state.p,
      shown: tip,
      put: (to) => ({ n: unit(sub(to, state.p)) }),
    });
  }
  /** Where a point of the light is shown. */
  shown(x, fixed = false) {
    return fixed ? x : along(this.state.p, sub(x, this.state.p), this.scale);
  }
  look() {
    const { azimuth, elevation, distance } = this.camera;
    const { width, height } = this.canvas;
    const target = [0, 0.62, 0];
    const back = [
      Math.cos(elevation) * Math.sin(azimuth),
      Math.sin(elevation),
      Math.cos(elevation) * Math.cos(azimuth),
    ];
    const right = [Math.cos(azimuth), 0, -Math.sin(azimuth)];
    const up = cross(back, right);
    this.eye = along(target, back, distance);
    this.view3 = { right, up, back, k: 1.75 * Math.min(width, height * 1.15), x: width / 2, y: height / 2 };
  }
  /** Pixels of a point, or null behind the camera. */
  project(v) {
    const { right, up, back, k, x, y } = this.view3;
    const d = sub(v, this.eye);
    const z = -dot(d, back);
    return z > 0.05 ? [x + (k * dot(d, right)) / z, y - (k * dot(d, up)) / z] : null;
  }
  /** The direction of the ray through a pixel. */
  ray([px, py]) {
    const { right, up, back, k, x, y } = this.view3;
    return unit(add(add(times(right, (px - x) / k), times(up, (y - py) / k)), times(back, -1)));
  }
  line(points, color, width = 1, fill = null, closed = false) {
    const { context } = this;
    const q = points.map((v) => this.project(v));
    if (q.some((v) => !v)) return;
    path(context, q, closed);
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    context.strokeStyle = color;
    context.lineWidth = width * ratio();
    context.stroke();
  }
  draw(way, options, probe) {
    const {
      canvas,
      context,
      state: { p, n },
    } = this;
    fit(canvas);
    this.look();
    context.fillStyle = INK.back;
    context.fillRect(0, 0, canvas.width, canvas.height);
    for (let i = -4; i <= 4; i++) {
      this.line(
        [
          [i / 2, 0, -2],
          [i / 2, 0, 2],
        ],
        INK.faint,
      );
      this.line(
        [
          [-2, 0, i / 2],
          [2, 0, i / 2],
        ],
        INK.faint,
      );
    }
    const [s, t] = basis(n);
    const arc = (a, b) => ROUND.slice(0, 33).map(([c, d]) => add(p, add(times(a, c), times(b, d))));
    this.line(circle(p, s, t, 1), INK.line, 1.2, "rgba(90,110,150,0.10)");
    for (const a of [s, t, unit(add(s, t)), unit(sub(s, t))]) this.line(arc(a, n), INK.faint, 1);
    this.arrow(p, along(p, n, 0.8), INK.text);
    this.drawLight();
    this.drawSamples(way, options);
    if (probe) this.line([p, along(p, probe, this.reach())], INK.mark, 2);
    if (options.dots <= 16) this.drawRays(way, options.dots);
    this.drawHandles();
  }
  reach() {
    const c = middle(this.state.light);
    return c ? Math.max(1, length(sub(this.shown(c), this.state.p))) : 2;
  }
  arrow(from, to, color) {
    this.line([from, to], color, 2);
  }
  drawLight() {
    const { light } = this.state;
    const { shape } = this.view;
    const glow = "rgba(255,217,138,0.28)";
    if (shape.sphere) {
      const c = this.shown(light.fields.center);
      const d = sub(this.eye, c);
      const r = this.scale * light.fields.radius;
      const k = Math.sqrt(Math.max(0, 1 - (r * r) / dot(d, d)));
      const [a, b] = basis(unit(d));
      this.line(circle(along(c, unit(d), (r * r) / length(d)), a, b, r * k), INK.light, 1.5, glow, true);
    }
    for (const outline of shape.outlines)
      this.line(
        outline.map((x) => this.shown(x)),
        INK.light,
        1.5,
        shape.lines ? null : glow,
        true,
      );
    for (const lines of shape.lines || [])
      this.line(
        lines.map((x) => this.shown(x)),
        INK.light,
        shape.outlines.length ? 0.7 : 2.5,
      );
    for (const handle of this.handles)
      if (handle.from)
        this.arrow(
          this.shown(handle.from, handle.from === this.state.p),
          handle.shown,
          handle.name === "normal" ? INK.text : INK.light,
        );
    if (light.fields.one_minus_cos !== undefined)
      for (const rim of rimsOf(this.view))
        this.line(
          rim.map((w) => along(this.state.p, w, 2)),
          INK.light,
          1.5,
          glow,
          true,
        );
  }
  /** The samples on the light and on the hemisphere. */
  drawSamples(way, options) {
    const {
      dots,
      eye,
      state: { p },
      view3: { right, up, back, k, x, y },
    } = this;
    const { samples } = way;
    dots.begin();
    dots.words.fill(0);
    const size = Math.max(1, Math.round(dotSize(options.dots) * ratio() * 0.9));
    const [dx, dy, dz] = samples.direction;
    const put = (vx, vy, vz, color) => {
      const a = vx - eye[0];
      const b = vy - eye[1];
      const c = vz - eye[2];
      const z = -(a * back[0] + b * back[1] + c * back[2]);
      if (!(z > 0.05)) return;
      dots.dot(
        x + (k * (a * right[0] + b * right[1] + c * right[2])) / z,
        y - (k * (a * up[0] + b * up[1] + c * up[2])) / z,
        size,
        color,
      );
    };
    const far = samples.distance;
    const onLight = this.view.shape.at && far;
    for (let i = 0; i < options.dots; i++) {
      const w0 = dx[i];
      const w1 = dy[i];
      const w2 = dz[i];
      put(p[0] + w0, p[1] + w1, p[2] + w2, options.colors[i]);
      if (onLight && way.kind === "core") {
        const r = far[i] * this.scale;
        put(p[0] + r * w0, p[1] + r * w1, p[2] + r * w2, options.colors[i]);
      }
    }
    dots.end();
  }
  drawRays(way, n) {
    const { p } = this.state;
    const [x, y, z] = way.samples.direction;
    const { context } = this;
    context.globalAlpha = 0.55;
    for (let i = 0; i < n; i++)
      this.line(
        [p, along(p, [x[i], y[i], z[i]], way.samples.weight[i] > 0 ? this.reach() : 1)],
        way.samples.weight[i] > 0 ? INK.light : INK.line,
        1,
      );
    context.globalAlpha = 1;
  }
  drawHandles() {
    const { context } = this;
    for (const handle of this.handles) {
      const q = this.project(handle.shown);
      if (!q) continue;
      const chosen = handle.name === this.state.handle;
      context.beginPath();
      context.arc(q[0], q[1], (chosen ? 8 : 5.5) * ratio(), 0, 2 * Math.PI);
      context.fillStyle = handle.name === "shading point" ? INK.mark : handle.name === "normal" ? INK.text : INK.light;
      context.fill();
      context.lineWidth = 2 * ratio();
      context.strokeStyle = chosen ? INK.strong : "#000";
      context.stroke();
      if (chosen) {
        context.font = `${12 * ratio()}px sans-serif`;
        context.fillStyle = INK.strong;
        const far = this.scale < 1 && !handle.ground && handle.name !== "normal";
        const away = far ? `, ${say(length(sub(handle.at, this.state.p)))} away` : "";
        const place = [handle.name.replaceAll("_", " ") + away, q[0] + 12 * ratio(), q[1] - 8 * ratio()];
        // lines end before the text
        context.strokeStyle = INK.back;
        context.lineWidth = 5 * ratio();
        context.lineJoin = "round";
        context.strokeText(...place);
        context.fillText(...place);
      }
    }
  }

  /** Puts a handle where the ray through a pixel meets the plane of the screen through it, or the ground. */
  drag(handle, pixel) {
    const w = this.ray(pixel);
    const normal = handle.ground ? [0, 1, 0] : this.view3.back;
    const at = dot(sub(handle.shown, this.eye), normal) / dot(w, normal);
    if (!(at > 0)) return;
    let to = along(this.eye, w, at);
    if (!handle.ground && handle.name !== "normal" && handle.from !== this.state.p)
      to = along(this.state.p, sub(to, this.state.p), 1 / this.scale);
    this.put(handle, to);
  }
  put(handle, to) {
    if (!to.every(Number.isFinite)) return;
    const next = handle.put(to);
    this.change(next.name ? { light: next } : next);
  }
  /** Moves the chosen handle, or the camera, by keys. */
  key(event) {
    const step = {
      ArrowLeft: [-1, 0, 0],
      ArrowRight: [1, 0, 0],
      ArrowUp: [0, 1, 0],
      ArrowDown: [0, -1, 0],
      PageUp: [0, 0, 1],
      PageDown: [0, 0, -1],
    }[event.key];
    const zoom = { "+": 0.9, "=": 0.9, "-": 1 / 0.9 }[event.key];
    if (zoom) this.zoom(zoom);
    if (!step) return Boolean(zoom);
    const handle = this.handles.find((h) => h.name === this.state.handle);
    const size = event.shiftKey ? 0.2 : 0.02;
    if (!handle) {
      this.orbit(step[0] * 0.08, step[1] * 0.08);
    } else {
      const { right, up, back } = this.view3;
      const axes = handle.ground ? [right, unit([-back[0], 0, -back[2]]), back] : [right, up, back];
      this.put(
        handle,
        axes.reduce((to, axis, i) => along(to, axis, (step[i] * size) / (handle.ground ? 1 : this.scale)), handle.at),
      );
    }
    return true;
  }
  orbit(dx, dy) {
    this.camera.azimuth += dx;
    this.camera.elevation = clamp(this.camera.elevation + dy, -0.3, 1.5);
    this.change({});
  }
  zoom(by) {
    this.camera.distance = clamp(this.camera.distance * by, 2, 20);
    this.change({});
  }
  listen() {
    const { canvas } = this;
    const pixel = (event) => {
      const box = canvas.getBoundingClientRect();
      return [
        ((event.clientX - box.left) * canvas.width) / box.width,
        ((event.clientY - box.top) * canvas.height) / box.height,
      ];
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, pixel(event));
      const reach = (event.pointerType === "touch" ? 28 : 15) * ratio();
      const [x, y] = pixel(event);
      const near = this.handles
        .map((h) => ({ h, q: this.project(h.shown) }))
        .filter(({ q }) => q)
        .map(({ h, q }) => ({ h, d: Math.hypot(q[0] - x, q[1] - y) }));
      near.sort((a, b) => a.d - b.d);
      this.held = this.pointers.size === 1 && near.length && near[0].d < reach ? near[0].h.name : null;
      this.change({ handle: this.held || "view" });
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = this.pointers.get(event.pointerId);
      if (!before) return;
      const now = pixel(event);
      const k = ratio();
      if (this.pointers.size === 2) {
        const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, q]) => q);
        this.zoom(
          Math.hypot(before[0] - other[0], before[1] - other[1]) /
            Math.max(1, Math.hypot(now[0] - other[0], now[1] - other[1])),
        );
      } else if (this.held) {
        const handle = this.handles.find((h) => h.name === this.held);
        if (handle) this.drag(handle, now);
      } else {
        this.orbit((-(now[0] - before[0]) / k) * 0.008, ((now[1] - before[1]) / k) * 0.008);
      }
      this.pointers.set(event.pointerId, now);
    });
    for (const name of ["pointerup", "pointercancel"])
      canvas.addEventListener(name, (event) => {
        this.pointers.delete(event.pointerId);
        this.held = null;
        this.change({});
      });
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.zoom(Math.exp(event.deltaY * 0.001));
      },
      { passive: false },
    );
    canvas.addEventListener("keydown", (event) => {
      if (this.key(event)) event.preventDefault();
    });
  }
}
