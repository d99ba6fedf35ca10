// The host's page: three-gpu-pathtracer, with edits of its shader, on floors under one light. three_pathtracer.py drives it.
import {
  BufferGeometry, Float32BufferAttribute, Mesh, MeshPhysicalMaterial, PerspectiveCamera, RectAreaLight, Scene, Vector3, WebGLRenderer,
} from "three";
import { ShapedAreaLight, WebGLPathTracer } from "three-gpu-pathtracer";

// the host's strata come from Math.random; a seed makes a picture repeatable, and its own seeds independent
// (xoshiro128**, begun by a hash of the seed)
const state = new Uint32Array(4);
function begin(seed) {
  for (let k = 0; k < 4; k++) {
    let z = Math.imul(4 * seed + k + 1, 0x9e3779b9);
    z = Math.imul(z ^ (z >>> 16), 0x85ebca6b);
    z = Math.imul(z ^ (z >>> 13), 0xc2b2ae35);
    state[k] = z ^ (z >>> 16);
  }
}
const turn = (x, k) => (x << k) | (x >>> (32 - k));
Math.random = () => {
  const answer = Math.imul(turn(Math.imul(state[1], 5), 7), 9) >>> 0;
  const kept = state[1] << 9;
  state[2] ^= state[0];
  state[3] ^= state[1];
  state[1] ^= state[2];
  state[0] ^= state[3];
  state[2] ^= kept;
  state[3] = turn(state[3], 11);
  return answer / 2 ** 32;
};
begin(0);

const renderer = new WebGLRenderer({ antialias: false });
document.body.append(renderer.domElement);
const tracers = new Map();

function floor(roughness, metalness, side) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute([-side, 0, side, side, 0, side, side, 0, -side, -side, 0, -side], 3));
  geometry.setAttribute("normal", new Float32BufferAttribute([0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0], 3));
  geometry.setAttribute("uv", new Float32BufferAttribute([0, 0, 1, 0, 1, 1, 0, 1], 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  // without metal, a diffuse surface alone: no coat reflects
  return new Mesh(geometry, new MeshPhysicalMaterial({ roughness, metalness, specularIntensity: 0, ior: 1 }));
}

function describe({ light, camera, roughness, metalness }) {
  const scene = new Scene();
  scene.add(floor(roughness, metalness, 50));
  const shape = light.disk ? new ShapedAreaLight(0xffffff, 1, light.size[0], light.size[1]) : new RectAreaLight(0xffffff, 1, light.size[0], light.size[1]);
  if (light.disk) shape.isCircular = true;
  shape.position.set(...light.at);
  shape.lookAt(new Vector3(...light.towards));
  shape.updateMatrixWorld();
  scene.add(shape);
  const eye = new PerspectiveCamera(camera.angle, 1, 0.01, 100);
  eye.position.set(...camera.at);
  eye.lookAt(new Vector3(...camera.towards));
  eye.updateMatrixWorld();
  const corners = [shape.matrixWorld.elements.slice(0, 3), shape.matrixWorld.elements.slice(4, 7)];
  return { scene, eye, corners };
}

window.host = {
  /** Makes a path tracer whose shader has these edits, each a text that occurs once and what replaces it. */
  add(name, edits) {
    const tracer = new WebGLPathTracer(renderer);
    Object.assign(tracer, { renderToCanvas: false, rasterizeScene: false, renderDelay: 0, minSamples: 0, bounces: 2 });
    tracer.tiles.set(1, 1);
    const material = tracer._pathTracer.material;
    for (const [old, replacement] of edits) {
      const pieces = material.fragmentShader.split(old);
      if (pieces.length !== 2) throw new Error(`the shader of three-gpu-pathtracer has ${pieces.length - 1} times: ${old}`);
      material.fragmentShader = pieces.join(replacement);
    }
    Object.assign(material.uniforms, { alone: { value: false }, repaired: { value: false } });
    tracers.set(name, tracer);
  },
  /** Shows a scene to all path tracers, with the switches of their shaders; returns the light's axes of width and height. */
  scene(scene, size, switches) {
    renderer.setSize(size, size, false);
    for (const tracer of tracers.values()) {
      for (const [name, value] of Object.entries(switches)) tracer._pathTracer.material.uniforms[name].value = value;
    }
    const { scene: three, eye, corners } = describe(scene);
    for (const tracer of tracers.values()) tracer.setScene(three, eye);
    return corners;
  },
  /** Renders frames of one sample; returns the mean as text of base64, and milliseconds. */
  async render(name, frames, seed) {
    const tracer = tracers.get(name);
    begin(seed);
    const strata = tracer._pathTracer.material.stratifiedTexture;
    strata.sampler = null; // or samples of one picture would avoid the strata of the one before
    tracer.reset();
    tracer.renderSample();
    while (tracer.isCompiling || tracer.samples < 1) {
      await new Promise((done) => setTimeout(done, 20));
      tracer.renderSample();
    }
    const began = performance.now(), before = tracer.samples;
    while (tracer.samples < frames) tracer.renderSample();
    const { width, height } = tracer.target;
    const pixels = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(tracer.target, 0, 0, width, height, pixels);
    const milliseconds = (performance.now() - began) / Math.max(1, tracer.samples - before);
    const red = pixels.filter((_, k) => k % 4 === 0);
    const bytes = new Uint8Array(red.buffer);
    let text = "";
    for (let k = 0; k < bytes.length; k += 8192) text += String.fromCharCode(...bytes.subarray(k, k + 8192));
    return { pixels: btoa(text), milliseconds, samples: tracer.samples };
  },
  /** The source that the device runs for a path tracer. */
  source(name) {
    const program = renderer.properties.get(tracers.get(name)._pathTracer.material).currentProgram;
    return renderer.getContext().getShaderSource(program.fragmentShader);
  },
  device() {
    const gl = renderer.getContext();
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    return gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  },
};
