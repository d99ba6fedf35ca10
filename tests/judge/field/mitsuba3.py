"""Judges how Mitsuba 3 samples a sphere, a triangle, a rectangle and a disk by direction.

    pip install mitsuba==3.9.1 numpy && python mitsuba3.py [--side 32] [--json FILE]

Every sampler is tried by size, distance, elevation, aspect, scale and origin, and compared with definitions in double precision. The script
prints a verdict for each shape with the inputs that show what is wrong, and exits with 1 if something is, with 2 for a wrong argument.
"""

import argparse
import json
import math
import sys
import time

import numpy as np

EPSILON = 2.0**-24
# The relative error of a pdf that is a finding; a 32-bit formula without cancellation stays below a hundredth of it.
PDF_LIMIT = 1e-3
# Estimates are findings from this many standard errors, and from this relative error, onwards.
SIGMAS, BIAS = 6.0, 3e-3


# The definitions: lights as seen from the origin, in double precision.


def triangle_angle(a, b, c):
    """The solid angles of triangles, after Van Oosterom and Strackee (1983)."""
    la, lb, lc = (np.linalg.norm(x, axis=-1) for x in (a, b, c))
    volume = np.abs(np.sum(a * np.cross(b - a, c - a), axis=-1))
    ab, bc, ca = (np.sum(x * y, axis=-1) for x, y in ((a, b), (b, c), (c, a)))
    return 2 * np.arctan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb)


def pieces(corners, near, longest=0.1, most=60000):
    """Divides triangles until their edges are short against their distance: centres, solid angles, and the row they come from."""
    triangles, cells = corners, np.arange(len(corners))
    done, done_cells = [], []
    for _ in range(60):
        edges = np.stack([np.linalg.norm(triangles[:, i] - triangles[:, (i + 1) % 3], axis=1) for i in range(3)], axis=1)
        distance = np.minimum(np.linalg.norm(triangles, axis=2).min(axis=1), np.linalg.norm(triangles.mean(axis=1), axis=1))
        small = edges.max(axis=1) <= longest * np.maximum(distance, near)
        done.append(triangles[small])
        done_cells.append(cells[small])
        triangles, cells, edges = triangles[~small], cells[~small], edges[~small]
        if not len(triangles) or sum(map(len, done)) > most:
            break
        order = (edges.argmax(axis=1)[:, None] + np.arange(3)) % 3
        a, b, c = (np.take_along_axis(triangles, order[:, [i], None], axis=1)[:, 0] for i in range(3))
        middle = (a + b) / 2
        triangles = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
        cells = np.concatenate([cells, cells])
    triangles, cells = np.concatenate([*done, triangles]), np.concatenate([*done_cells, cells])
    centres = triangles.mean(axis=1)
    weights = triangle_angle(triangles[:, 0], triangles[:, 1], triangles[:, 2])
    return centres / np.linalg.norm(centres, axis=1)[:, None], weights, cells


class Flat:
    """A flat light relative to the shading point: a corner or the centre, two edges, and how (s, t) of the edges are bounded."""

    def __init__(self, shape, origin, u, v):
        self.shape, self.origin, self.u, self.v = shape, origin, u, v
        cross = np.cross(u, v)
        self.area = np.linalg.norm(cross) * {"rectangle": 1, "triangle": 0.5, "disk": math.pi}[shape]
        self.normal = cross / np.linalg.norm(cross)
        self.height = abs(self.normal @ origin)
        if shape == "disk":
            turns = np.linspace(0, 2 * np.pi, 97)
            # Chords as long as these give the polygon the area of the disk.
            grown = math.sqrt(turns[1] / math.sin(turns[1]))
            rim = origin + grown * (np.cos(turns)[:, None] * u + np.sin(turns)[:, None] * v)
            fan = [(origin, rim[i], rim[i + 1]) for i in range(96)]
        elif shape == "rectangle":
            fan = [(origin, origin + u, origin + u + v), (origin, origin + u + v, origin + v)]
        else:
            fan = [(origin, origin + u, origin + v)]
        self.directions, self.weights, _ = pieces(np.array(fan), self.height)

    def place(self, d):
        """Distances to the plane, and coordinates by the edges."""
        cosine = d @ self.normal
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = (self.origin @ self.normal) / cosine
        point = d * distance[:, None] - self.origin
        gram = np.array([[self.u @ self.u, self.u @ self.v], [self.u @ self.v, self.v @ self.v]])
        return distance, np.abs(cosine), np.linalg.solve(gram, np.stack([point @ self.u, point @ self.v])).T

    def misses(self, d, slack):
        """Which directions miss the light by more than an angle."""
        distance, _, (s, t) = (lambda x: (x[0], x[1], x[2].T))(self.place(d))
        if self.shape == "disk":
            radius = np.sqrt(s * s + t * t)
            inside = (distance > 0) & (radius <= 1)
            nearest = self.origin + (s / radius)[:, None] * self.u + (t / radius)[:, None] * self.v
            nearest /= np.linalg.norm(nearest, axis=1)[:, None]
            return ~inside & ~(np.linalg.norm(np.cross(nearest, d), axis=1) <= slack)
        o, u, v = self.origin, self.u, self.v
        ring = [o, o + u, o + u + v, o + v] if self.shape == "rectangle" else [o, o + u, o + v]
        out = ~(distance > 0)
        for i, corner in enumerate(ring):
            edge = np.cross(corner, ring[(i + 1) % len(ring)]) * np.sign(o @ self.normal)
            length = np.linalg.norm(edge)
            if length > 0:
                out |= -(d @ edge) / length > slack
        return out

    def cosines(self, d):
        return np.maximum(np.abs(d @ self.normal), 1e-12)

    def pdfs(self, d):
        """The pdfs of both conventions: uniform in solid angle, and uniform in area."""
        distance, cosine, _ = self.place(d)
        return {"solid angle": np.full(len(d), 1 / self.weights.sum()), "area": distance**2 / (self.area * cosine)}


class Ball:
    """A sphere relative to the shading point."""

    def __init__(self, centre, radius):
        self.centre, self.radius = centre, radius
        self.distance = np.linalg.norm(centre)
        self.inside = self.distance <= radius
        self.area = 4 * math.pi * radius**2
        self.height = abs(self.distance - radius)
        sine2 = 1.0 if self.inside else (radius / self.distance) ** 2
        cosine = math.sqrt(max(0.0, (self.distance - radius) * (self.distance + radius))) / max(self.distance, 1e-300)
        versine = 2.0 if self.inside else sine2 / (1 + cosine)
        axis = centre / self.distance if self.distance > 0 else np.array([0.0, 0.0, 1.0])
        side = np.cross(axis, [1.0, 0, 0] if abs(axis[0]) < 0.6 else [0, 1.0, 0])
        side /= np.linalg.norm(side)
        rise, turn = np.meshgrid((np.arange(32) + 0.5) / 32 * versine, (np.arange(32) + 0.5) / 16 * np.pi)
        rise, turn = rise.ravel(), turn.ravel()
        sine = np.sqrt(rise * (2 - rise))
        across = np.cross(axis, side)
        self.directions = (sine * np.cos(turn))[:, None] * side + (sine * np.sin(turn))[:, None] * across + (1 - rise)[:, None] * axis
        self.weights = np.full(1024, 2 * math.pi * versine / 1024)

    def misses(self, d, slack):
        if self.inside:
            return np.zeros(len(d), bool)
        angle = np.arctan2(np.linalg.norm(np.cross(d, self.centre), axis=1), d @ self.centre)
        return angle - math.asin(min(1.0, self.radius / self.distance)) > slack

    def cosines(self, d):
        return np.ones(len(d))

    def pdfs(self, d):
        """Uniform in solid angle, or, from inside, uniform in area."""
        along = d @ self.centre
        beside2 = np.maximum(0, self.radius**2 - np.maximum(0, self.distance**2 - along**2))
        reach = along + np.sqrt(beside2)
        area = reach**2 / (self.area * np.maximum(np.sqrt(beside2) / self.radius, 1e-300))
        return {"solid angle": np.full(len(d), 1 / self.weights.sum()), **({"area": area} if self.inside else {})}


# What is tried.


def regimes(shape):
    """Lights of half-size 1 by a and the shading point (x, y, h below the light), for every regime."""
    if shape == "sphere":
        for distance in (1e6, 1e5, 1e4, 5e3, 4e3, 3e3, 1e3, 300, 100, 60, 38, 30, 10, 3, 2, 1.5, 1.1, 1.01, 1.001, 1.0001):
            yield f"{distance:g} radii away", 1, 0, 0, distance
        for distance in (0, 0.1, 0.5, 0.9, 0.99, 0.999, 0.9999):
            yield f"inside, {distance:g} radii from the centre", 1, 0, 0, distance
        return
    for height in (1e5, 1e4, 3e3, 1e3, 300, 100, 30, 10, 3, 1, 0.3, 0.1, 0.01, 1e-3, 1e-4):
        yield f"in front, {height:g} half-sizes away", 1, 0, 0, height
        if height < 1:
            yield f"{height:g} half-sizes before a point off the middle", 1, 0.25, 0.5, height
    for distance in (1.5, 3, 10, 100, 1e3):
        for degrees in (60, 30, 10, 3, 1, 0.1, 0.01):
            rise = math.radians(degrees)
            yield f"{distance:g} away, {degrees:g} degrees high", 1, distance * math.cos(rise), 0, distance * math.sin(rise)
    for aspect in (10, 100, 1e3, 1e4) if shape != "disk" else ():
        for height in (0.1, 1, 10, 100, 1e3, 1e4):
            for x, y in ((0, 0), (-0.9 * aspect, 0), (1.5 * aspect, 0), (0, 2)):
                yield f"aspect {aspect:g}, {height:g} away at ({x:g}, {y:g})", aspect, x, y, height


FRAMES = {"axes": np.eye(3), "turned": np.array([[2.0, -1, 2], [2, 2, -1], [-1, 2, 2]])}


def cases(shape):
    """Inputs in 32 bits: the light's numbers, and p."""
    for frame, (u, v, w) in FRAMES.items():
        for scale, origin in ((1, 0), (1e-3, 0), (1e6, 0), (1, 1024), (1, 65536)):
            for i, (name, a, x, y, h) in enumerate(regimes(shape)):
                if (scale, origin, frame) != (1, 0, "axes") and i % 3:
                    continue
                f32 = lambda z: np.asarray(z, np.float32)
                centre = np.array([1.0, -0.5, 0.75]) * origin
                p = f32(centre + scale * (x * u + y * v - h * w))
                tag = f"{name}; {frame}, scale {scale:g}, origin {origin:g}"
                if shape == "sphere":
                    yield tag, {"centre": f32(centre), "radius": f32(scale * np.linalg.norm(u))}, p, -w
                elif shape == "triangle":
                    corner = lambda s, t: f32(centre + scale * (s * a * u + t * v))
                    yield tag, {"a": corner(-1, -1), "b": corner(1, -1), "c": corner(-1, 1)}, p, -w
                else:
                    yield tag, {"centre": f32(centre), "u": f32(scale * a * u), "v": f32(scale * v), "w": f32(scale * w)}, p, -w


def definition(shape, light, p):
    light, p = {k: np.asarray(x, np.float64) for k, x in light.items()}, p.astype(np.float64)
    if shape == "sphere":
        return Ball(light["centre"] - p, float(light["radius"]))
    if shape == "triangle":
        return Flat(shape, light["a"] - p, light["b"] - light["a"], light["c"] - light["a"])
    if shape == "disk":
        return Flat(shape, light["centre"] - p, light["u"], light["v"])
    return Flat(shape, light["centre"] - p - light["u"] - light["v"], 2 * light["u"], 2 * light["v"])


# The sampler that is judged.


def load(mi, shape, light):
    if shape == "sphere":
        return mi.load_dict({"type": "sphere", "center": light["centre"].tolist(), "radius": float(light["radius"])})
    if shape == "triangle":
        mesh = mi.Mesh("triangle", 3, 1)
        parameters = mi.traverse(mesh)
        parameters["vertex_positions"] = np.concatenate([light[k] for k in "abc"]).tolist()
        parameters["faces"] = [0, 1, 2]
        parameters.update()
        return mesh
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3] = np.stack([light[k] for k in ("u", "v", "w", "centre")], axis=1)
    return mi.load_dict({"type": shape, "to_world": mi.ScalarTransform4f(matrix)})


def draw(mi, sampler, p, side, directions):
    """Directions and pdfs of samples, the pdfs of the same samples asked for, and those of given directions through the ray that hits."""
    from_p = mi.Interaction3f()
    from_p.p = p.tolist()
    random = np.random.default_rng(1)
    grid = (np.stack(np.meshgrid(np.arange(side), np.arange(side)), -1).reshape(-1, 2) + random.random((side * side, 2))) / side
    grid = np.minimum(grid.astype(np.float32), np.float32(1 - EPSILON))
    drawn, asked = np.empty((len(grid), 4)), np.empty(len(grid))
    for i, u in enumerate(grid.tolist()):
        sample = sampler.sample_direction(from_p, u)
        d = sample.d
        drawn[i] = d[0], d[1], d[2], sample.pdf
        asked[i] = sampler.pdf_direction(from_p, sample)
    scene, hit = mi.load_dict({"type": "scene", "light": sampler}), np.zeros(len(directions))
    for i, d in enumerate(directions.tolist()):
        found = scene.ray_intersect(mi.Ray3f(from_p.p, d))
        if found.is_valid():
            hit[i] = sampler.pdf_direction(from_p, mi.DirectionSample3f(None, found, from_p))
    return grid, drawn, asked, hit


def judge(light, normal, grid, drawn, asked, hit, chosen, resolution):
    """Findings of one case: what, how much, and the u that shows it."""
    found = {}

    def note(what, wrong, amount):
        if np.any(wrong):
            worst = np.where(wrong, np.where(np.isfinite(amount), amount, np.inf), -1).argmax()
            found[what] = float(amount[worst]), grid[worst].tolist() if len(amount) == len(grid) else None, float(np.mean(wrong))

    d, pdf = drawn[:, :3], drawn[:, 3]
    finite = np.isfinite(drawn).all(axis=1) & (pdf > 0)
    note("no finite positive pdf and direction", ~finite, pdf)
    if not finite.any():
        return found, None, 0.0
    angle = math.sqrt(light.weights.sum() / math.pi)
    slack = 4 * EPSILON + 2 * resolution + 1e-3 * angle
    length = np.linalg.norm(d, axis=1)
    unit = d / np.where(finite, length, 1)[:, None]
    note("direction is no unit vector", finite & (np.abs(length - 1) > 1e-5), length)
    miss = finite & light.misses(np.where(finite[:, None], unit, light.directions[0]), slack)
    note("direction misses the light", miss, miss.astype(float))
    note("pdf of a sample differs from its pdf asked for", finite & ~(np.abs(asked / pdf - 1) <= PDF_LIMIT), np.abs(asked / pdf - 1))

    # The pdf against the convention that fits best.
    good = finite & ~miss
    error = {k: np.where(good, np.abs(pdf / v - 1), 0) for k, v in light.pdfs(np.where(good[:, None], unit, light.directions[0])).items()}
    measure = min(error, key=lambda k: error[k].max())
    note("pdf differs from its definition", error[measure] > PDF_LIMIT + 4 * resolution, error[measure])
    wanted = light.pdfs(chosen)[measure]
    wrong = np.abs(hit / wanted - 1)
    # A ray finds the plane as exactly as a 32-bit cosine allows, and what it finds at the light's border is anybody's guess.
    allowed = PDF_LIMIT + 8 * resolution + 12 * EPSILON / light.cosines(chosen)
    note("pdf of a direction differs from its definition", (wrong > allowed) & ~light.misses(chosen, -slack), wrong)

    # Estimates of the solid angle and of the irradiance, with the errors that random samples of the defined pdf would have.
    all_pdfs = light.pdfs(light.directions)[measure]
    count = len(grid)
    for name, value, at in (("solid angle", 1.0, 1.0), ("irradiance", light.directions @ normal, unit @ normal)):
        value, at = np.maximum(value, 0) * np.ones(len(light.weights)), np.maximum(at, 0) * np.ones(count)
        exact = light.weights @ value
        sigma = math.sqrt(max(0.0, light.weights @ (value**2 / all_pdfs) - exact**2) / count)
        estimate = np.sum(np.where(good, at / np.where(good, pdf, 1), 0)) / count
        bias = abs(estimate - exact)
        if exact > 0 and bias > SIGMAS * sigma + BIAS * exact and sigma < 0.2 * exact:
            found[f"estimate of the {name} is wrong"] = float(estimate / exact - 1), None, 1.0
    return found, measure, float(error[measure].max())


def judge_shape(mi, shape, side):
    worst, measures, findings, tried = 0.0, {}, {}, 0
    for tag, light, p, normal in cases(shape):
        exact = definition(shape, light, p)
        coordinates = max(np.abs(p).max(), *(np.abs(x).max() for x in light.values()))
        # Points in the space of the scene are rounded: what comes from that alone is no finding.
        resolution = 2 * EPSILON * float(coordinates) / max(float(exact.height), 1e-30)
        if resolution > 1e-3:
            continue
        tried += 1
        chosen = exact.directions[:: max(1, len(exact.directions) // 256)].astype(np.float32)
        numbers = draw(mi, load(mi, shape, light), p, side, chosen)
        chosen = chosen.astype(np.float64)
        chosen /= np.linalg.norm(chosen, axis=1)[:, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            found, measure, error = judge(exact, normal / np.linalg.norm(normal), *numbers, chosen, resolution)
        if measure is not None:
            measures[measure] = measures.get(measure, 0) + 1
        worst = max(worst, error)
        for what, (amount, u, share) in found.items():
            inputs = {k: np.asarray(x).tolist() for k, x in light.items()}
            findings.setdefault(what, []).append({"where": tag, "amount": amount, "share": share, "u": u, "light": inputs, "p": p.tolist()})
    return {"shape": shape, "cases": tried, "measures": measures, "worst": worst, "findings": findings}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--side", type=int, default=32, help="samples are side * side for each case")
    parser.add_argument("--json", help="a file for all findings")
    parser.add_argument("shapes", nargs="*", default=["sphere", "triangle", "rectangle", "disk"])
    arguments = parser.parse_args()
    if not 4 <= arguments.side <= 1024:
        parser.error(f"--side is from 4 to 1024, not {arguments.side}")
    for shape in arguments.shapes:
        if shape not in ("sphere", "triangle", "rectangle", "disk"):
            parser.error(f"there is no shape {shape!r}: sphere, triangle, rectangle, disk")
    try:
        import mitsuba as mi
    except ImportError as error:
        parser.error(f"pip install mitsuba==3.9.1 comes first: {error}")

    mi.set_variant("scalar_rgb")
    start = time.time()
    print(f"Mitsuba {mi.__version__}, {mi.variant()}, {arguments.side**2} samples a case", flush=True)
    verdicts = [judge_shape(mi, shape, arguments.side) for shape in arguments.shapes]
    for verdict in verdicts:
        count = sum(map(len, verdict["findings"].values()))
        fits = ", ".join(f"{k} in {n}" for k, n in sorted(verdict["measures"].items()))
        print(f"\n{verdict['shape']}: {verdict['cases']} cases, uniform in {fits}; greatest error of a pdf {verdict['worst']:.2g}; {count} findings")
        for what, where in verdict["findings"].items():
            simple = min(where, key=lambda x: len(str(x["light"]) + str(x["p"])))
            greatest = max(where, key=lambda x: abs(x["amount"]) if math.isfinite(x["amount"]) else math.inf)
            print(f"  {what} in {len(where)} cases; greatest {greatest['amount']:.3g} ({greatest['where']})")
            inputs = ", ".join(f"{k} = {x}" for k, x in simple["light"].items())
            print(f"    simplest: {simple['amount']:.3g} for {inputs}, p = {simple['p']}, u = {simple['u']}")
    print(f"\n{time.time() - start:.0f} s")
    if arguments.json:
        try:
            with open(arguments.json, "w", encoding="utf-8") as file:
                # JSON has no infinity.
                text = json.dumps({"version": mi.__version__, "verdicts": verdicts}, indent=1)
                file.write(text.replace(": Infinity", ': "infinite"').replace(": NaN", ': "NaN"'))
        except OSError as error:
            print(f"{arguments.json}: {error.strerror}", file=sys.stderr)
            return 2
    return 1 if any(verdict["findings"] for verdict in verdicts) else 0


if __name__ == "__main__":
    sys.exit(main())
