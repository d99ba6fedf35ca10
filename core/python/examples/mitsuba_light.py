"""Direct light in Mitsuba 3 with the light samples of Étendue, beside Mitsuba's own `direct` integrator.

Both draw one sample of the light per sample of a pixel, with independent random numbers, in the same scenes; in the last rows, both also
draw one sample of the BSDF and combine the two. The table has the means of
both with their difference in standard errors (z), and the variances of one sample, averaged over the pixels. Pixels that show the light
itself, and their neighbours, are left out, since their variance is that of its outline.

Run it with mitsuba, numpy and etendue: `python mitsuba_light.py [--spp 1024] [--res 64] [--variant llvm_ad_rgb]`. The llvm variants need
LLVM; DRJIT_LIBLLVM_PATH says where it is.
"""

import argparse
import tempfile
from pathlib import Path

import drjit as dr
import etendue as et
import mitsuba as mi
import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("--spp", type=int, default=1024)
parser.add_argument("--res", type=int, default=64)
parser.add_argument("--variant", default="llvm_ad_rgb")
arguments = parser.parse_args()
mi.set_variant(arguments.variant)
spp, res = arguments.spp, arguments.res

RADIANCE = 10.0


def torus(rings=16, sides=16, center=(0, 0.9, 0), radii=(0.6, 0.2)):
    """A torus of triangles that face outwards: (512, 3, 3)."""
    a, b = (2 * np.pi * np.arange(k + 1) / k for k in (rings, sides))
    a, b = np.meshgrid(a, b, indexing="ij")
    out = radii[0] + radii[1] * np.cos(b)
    x = np.stack([out * np.cos(a), radii[1] * np.sin(b), out * np.sin(a)], axis=-1) + center
    p, q, r, s = x[:-1, :-1], x[1:, :-1], x[1:, 1:], x[:-1, 1:]
    return np.stack([[p, s, r], [p, r, q]]).transpose(0, 2, 3, 1, 4).reshape(-1, 3, 3)


def scene_of(triangles, folder):
    """A floor and two boxes under a mesh light."""
    lines = [f"v {x} {y} {z}" for x, y, z in triangles.reshape(-1, 3)]
    lines += [f"f {i} {i + 1} {i + 2}" for i in range(1, 3 * len(triangles), 3)]
    path = Path(folder) / "light.obj"
    path.write_text("\n".join(lines) + "\n")
    at, black = mi.ScalarTransform4f(), {"type": "diffuse", "reflectance": 0.0}
    diffuse = lambda *rgb: {"type": "diffuse", "reflectance": {"type": "rgb", "value": rgb}}
    box = lambda x, y, z, size: at.translate([x, y, z]).scale(size)
    film = {"type": "hdrfilm", "width": res, "height": res, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    camera = {"type": "perspective", "fov": 40, "to_world": at.look_at([0, 3.6, 4], [0, 0, 0], [0, 1, 0]), "film": film}
    light = {"type": "area", "radiance": {"type": "rgb", "value": RADIANCE}}
    floor = at.rotate([1, 0, 0], -90).scale(3)
    return mi.load_dict({
        "type": "scene",
        "sensor": camera,
        "floor": {"type": "rectangle", "to_world": floor, "bsdf": diffuse(0.6, 0.5, 0.4)},
        "box": {"type": "cube", "to_world": box(0.7, 0.15, 0.3, 0.15), "bsdf": diffuse(0.3, 0.5, 0.7)},
        "other": {"type": "cube", "to_world": box(-0.8, 0.25, -0.5, 0.25), "bsdf": diffuse(0.7, 0.3, 0.3)},
        "light": {"type": "obj", "filename": str(path), "face_normals": True, "bsdf": black, "emitter": light},
    })


class Lights:
    """Triangles, chosen by a tree and sampled by any technique."""

    def __init__(self, triangles, by):
        self.v, self.by = triangles.astype(np.float32), by
        cross = np.cross(self.v[:, 1] - self.v[:, 0], self.v[:, 2] - self.v[:, 0])
        area = np.linalg.norm(cross, axis=1) / 2
        center = self.v.mean(axis=1)
        radius = np.linalg.norm(self.v - center[:, None], axis=2).max(axis=1)
        self.tree = et.LightTree(center, radius, cross / (2 * area)[:, None], power=area)

    def sample(self, p, n, u, choice):
        """Samples of one of the lights for each point p with the normal n, and the probability with which it was chosen."""
        index, pmf, _ = self.tree.choose(p, n, choice)
        v = self.v[np.where(pmf > 0, index, 0)]
        return et.Triangle.sample_each(v[:, 0], v[:, 1], v[:, 2], p=p, n=n, u=u, by=self.by), pmf

    def pdf(self, p, n, index):
        """The pdf with which `sample` by solid angle draws directions that hit these lights: the same for all directions to a light."""
        v = self.v[index]
        s = et.Triangle.sample_each(v[:, 0], v[:, 1], v[:, 2], p=p, u=[0.5, 0.5], by="solid_angle")
        return s.pdf * self.tree.pmf(p, n, index)


def first_hits(scene, random):
    """What one ray through each pixel hits."""
    pixel = np.arange(res * res)
    place = (np.stack([pixel % res, pixel // res], axis=1) + random.pairs(1, pixel=pixel)[:, 0]) / res
    point = mi.Point2f(np.ascontiguousarray(place.T, dtype=np.float32))
    return scene.ray_intersect(scene.sensors()[0].sample_ray(0.0, 0.5, point, mi.Point2f(0.5))[0])


def pixels_without_the_light(scene):
    """By 64 rays in each pixel, and those of its neighbours."""
    shows = [np.array(first_hits(scene, et.Independent(seed)).emitter(scene) != None) for seed in range(64)]
    shows = np.pad(np.any(shows, axis=0).reshape(res, res), 1)
    return ~np.any([shows[i : i + res, j : j + res] for i in range(3) for j in range(3)], axis=0).ravel()


def render(scene, lights, seed, mis):
    """One sample of each pixel by Étendue: (res · res, 3). With `mis`, also one of the BSDF, combined by the power heuristic."""
    random, pixel = et.Independent(seed), np.arange(res * res)
    u, choice = (random.pairs(1, pixel=pixel, dimension=d)[:, 0] for d in (1, 2))
    hit = first_hits(scene, random)
    seen = np.array(hit.is_valid())
    p, n = (np.where(seen[:, None], np.array(x).T, 0) for x in (hit.p, hit.sh_frame.n))
    s, pmf = lights.sample(p, n, u, choice[:, 0])
    weight = RADIANCE * np.divide(s.weight, pmf, out=np.zeros_like(pmf), where=pmf > 0)

    to = mi.Vector3f(s.direction.T.copy())
    shadow = hit.spawn_ray_to(hit.p + to * mi.Float(s.distance))
    lit = hit.is_valid() & (mi.Float(weight) > 0)
    lit &= ~scene.ray_test(shadow, lit)
    value = hit.bsdf().eval(mi.BSDFContext(), hit, hit.to_local(to), lit)  # times the cosine
    color = hit.emitter(scene).eval(hit)
    if mis:
        context, bsdf, power = mi.BSDFContext(), hit.bsdf(), lambda a, b: dr.select(a > 0, a * a / (a * a + b * b), 0)
        weight *= np.array(power(mi.Float(s.pdf * pmf), bsdf.pdf(context, hit, hit.to_local(to), lit)))
        v = random.pairs(1, pixel=pixel, dimension=3)[:, 0]
        sample, reflected = bsdf.sample(context, hit, 0.5, mi.Point2f(v.T.copy()), hit.is_valid())
        other = scene.ray_intersect(hit.spawn_ray(hit.to_world(sample.wo)), hit.is_valid())
        found = np.array(other.emitter(scene) != None)
        pdf = lights.pdf(p, n, np.where(found, np.array(other.prim_index), 0))
        color += reflected * other.emitter(scene).eval(other) * power(sample.pdf, mi.Float(pdf)) & other.is_valid()
    color += mi.Color3f(value * mi.Float(weight)) & lit
    return np.array(color).T


def statistics(image_of, counted):
    """The mean of the pixels, its standard error, and the variance of one sample, averaged over the pixels: of the luminance."""
    images = [image_of(seed).reshape(-1, 3)[counted] for seed in range(spp)]
    images = np.array(images, dtype=float) @ [0.2126, 0.7152, 0.0722]
    means = images.mean(axis=1)
    return means.mean(), means.std(ddof=1) / np.sqrt(spp), images.var(axis=0, ddof=1).mean()


def main():
    one = np.array([[[-0.9, 0.5, -0.6], [1.1, 0.6, -0.6], [-0.4, 0.7, 0.9]]])  # it emits downwards
    rows = [("triangle", one, by, False) for by in ("area", "solid_angle", "projected_solid_angle")]
    rows += [("torus of 512", torus(), by, False) for by in ("area", "solid_angle", "projected_solid_angle")]
    rows += [("triangle", one, "solid_angle", True), ("torus of 512", torus(), "solid_angle", True)]
    theirs, worst = {}, 0.0
    print(f"spp {spp}, {res} × {res} pixels, {arguments.variant}, Étendue with {et.level()}\n")
    print("| light | Étendue's samples | spp | mean, Étendue | mean, Mitsuba | z | variance, Étendue | variance, Mitsuba | ratio |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, triangles, by, mis in rows:
            scene = scene_of(triangles, folder)
            counted = pixels_without_the_light(scene)
            if (name, mis) not in theirs:
                direct = mi.load_dict({"type": "direct", "emitter_samples": 1, "bsdf_samples": int(mis)})
                theirs[name, mis] = statistics(lambda seed: np.array(mi.render(scene, integrator=direct, spp=1, seed=seed)), counted)
            lights = Lights(triangles, by)
            mean, error, variance = statistics(lambda seed: render(scene, lights, seed, mis), counted)
            their_mean, their_error, their_variance = theirs[name, mis]
            z = (mean - their_mean) / np.hypot(error, their_error)
            worst = max(worst, abs(z))
            print(f"| {name} | by {by.replace('_', ' ')}{' and the BSDF' * mis} | {spp} | {mean:.5f} | {their_mean:.5f} | {z:+.2f} "
                  f"| {variance:.4g} | {their_variance:.4g} | {variance / their_variance:.3f} |", flush=True)
    assert worst < 4, f"a mean differs by {worst:.1f} standard errors"


if __name__ == "__main__":
    main()
