"""Direct light of eight lights on a diffuse surface, in numpy. Nothing is in the way, so that each has a closed form; the program prints the
errors, and fails if one is too large: `python eight_lights.py`, with numpy and etendue."""

import sys

import etendue as et
import numpy as np

SAMPLES, MOST = 1 << 16, 1e-5  # and the greatest relative error that is right for so many
P, N = np.array([0.2, 0, 0.1]), np.array([0, 0.8, 0.6])  # the shading point and its unit normal


def lambert(corners):
    """The irradiance from a polygon with a radiance of 1: Lambert 1760."""
    a = np.asarray(corners, float) - P
    b = np.roll(a, -1, axis=0)
    normal = np.cross(a, b)
    sine = np.linalg.norm(normal, axis=1)
    return abs(np.sum(np.arctan2(sine, np.sum(a * b, axis=1)) * (normal @ N) / sine)) / 2


def quadrilateral(corner, s, t, diagonal=None):
    corner, s, t = map(np.asarray, (corner, s, t))
    return lambert([corner, corner + s, corner + (s + t if diagonal is None else diagonal), corner + t])


triangle = [[0, 1, 0], [1, 1, 0], [0, 1, 1]]
parallelogram = [-1, 2, 0], [1, 0.2, 0], [0.1, 0.1, 1]
rectangle = [-0.5, 1.5, 0.2], [1, 0, 0], [0, 0, 1]
corners = [[0, 2, 0], [1, 2, 0], [1.5, 2, 1], [1, 2, 2], [0, 2, 2]]
patch = [-0.5, 2, 0.3], [1, 0, 0], [0, 0, 1], [1.5, 0, 1.25]  # flat, and no parallelogram
center, radius = np.array([-1, 1.5, 0.5]), 0.5
to = center - P
h, a, r = 1.5, 0.5, 0.7  # of a disk parallel to the surface: its height, its distance from the normal, and its radius
total = h * h + a * a + r * r
sun, narrow = np.array([0, 0.6, 0.8]), 0.02
lights = {
    "sphere": (et.Sphere(center, radius).by_projected_solid_angle(P, N), np.pi * radius**2 * (to @ N) / np.linalg.norm(to) ** 3),
    "triangle": (et.Triangle(*triangle).by_projected_solid_angle(P, N), lambert(triangle)),
    "parallelogram": (et.Parallelogram(*parallelogram).by_solid_angle(P), quadrilateral(*parallelogram)),
    "rectangle": (et.Rectangle(*rectangle).by_solid_angle(P), quadrilateral(*rectangle)),
    "disk": (
        et.Disk(P + h * N + [a, 0, 0], -N, r).by_solid_angle(P),
        np.pi / 2 * (1 - (total - 2 * r * r) / np.sqrt(total**2 - 4 * r * r * a * a)),
    ),
    "polygon": (et.Polygon(corners).by_solid_angle(P), lambert(corners)),
    "patch": (et.BilinearPatch(*patch).by_area(P), quadrilateral(*patch)),
    "sun": (et.Sun(sun, narrow).by_solid_angle(), np.pi * narrow * (2 - narrow) * (sun @ N)),
}

u = et.OwenSobol(seed=1).pairs(SAMPLES)
s = None  # all lights write their samples over those of the first
errors = []
print(f"{'light':14} {'irradiance':>10} {'error':>12}")
for name, (sampler, exact) in lights.items():
    s = sampler.sample(u, fields=("direction", "weight")) if s is None else sampler.sample(u, out=s)
    # a renderer traces shadow rays here, along s.direction
    irradiance = np.mean(np.maximum(s.direction @ N, 0) * s.weight, dtype=float)
    errors.append(abs(irradiance / exact - 1))
    print(f"{name:14} {exact:10.6f} {errors[-1]:12.1e}")
print(f"the largest error is {max(errors):.1e}, and {MOST:.0e} is allowed")
# a number that is none is no small error
sys.exit(not all(error < MOST for error in errors))
