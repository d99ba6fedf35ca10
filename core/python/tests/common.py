"""What the tests share: a light of each class, its techniques, and samples of them."""

import etendue as et
import numpy as np
import pytest

P, N = np.array([0.1, 0.2, 0.3]), np.array([0.0, 0.8, 0.6])
TRIANGLE = ([0, 2, 0], [1, 2.5, 0], [0, 2, 1])
CORNERS = [[0, 2, 0], [1, 2, 0], [1.5, 2, 1], [1, 2, 2], [0, 2, 2]]
LIGHTS = {
    et.Sphere: ([0.3, 1.5, 0.2], 0.4),
    et.Triangle: TRIANGLE,
    et.Parallelogram: ([0, 2, 0], [1, 0.2, 0], [0, 0, 1]),
    et.Rectangle: ([0, 2, 0], [1, 0, 0], [0, 0, 1]),
    et.Disk: ([0, 1.5, 0.2], [0, -1, 0], 0.5),
    et.BilinearPatch: ([0, 2, 0], [1, 0, 0], [0, 0, 1], [1, 0.3, 1]),
    et.Polygon: (CORNERS,),
    et.Line: ([0, 1.5, 0.2], [1, 0.2, 0]),
    et.Sun: ([0, 1, 0], 0.01),
    et.PointLight: ([0.2, 1.5, 0.1],),
    et.SpotLight: ([0, 1.5, 0.2], [0, -1, 0], 0.1, 0.5),
    et.DirectionalLight: ([0, 1, 0],),
}
DISTANT = (et.Sun, et.DirectionalLight)
VIEW = np.array([0.0, 1.0, 0.0])
# what each row needs beside its point
SURFACES = {"projected_solid_angle": {"n": N}}
SURFACES |= {"reflection": {"n": N, "alpha": 0.5, "view": VIEW}}
TECHNIQUES = [(light, name[3:]) for light in LIGHTS for name in dir(light) if name.startswith("by_")]
# a rounded direction determines the pdf and the numbers of these only as well as it determines the point
ROUGH = {(et.Sphere, "area"), (et.BilinearPatch, "area")}
WARPS = [
    (et.ConcentricDisk(), 2),
    (et.UniformHemisphere(), 3),
    (et.UniformSphere(), 3),
    (et.CosineHemisphere(), 3),
    (et.Octahedral(), 3),
    (et.AreaTriangle(), 2),
    (et.LowDistortionTriangle(), 2),
    (et.Cone(0.3), 3),
    (et.Bilinear([1, 2, 0.5, 3]), 2),
    (et.GgxVisibleNormals(0.3, 0.5, [0.6, 0, 0.8]), 3),
    (et.Reflection(0.2, [0, 0, 1], [0.6, 0, 0.8]), 3),
    (et.PatchSurface([0, 1, 0], [1, 0, 0], [0, 0, 1], [1, 0.3, 1]), 3),
]
FIELDS = ["direction", "distance", "pdf", "weight", "normal", "uv", "emits"]


def prepare(light, by, p=P, n=N, fields=None):
    place = {"projected_solid_angle": (p, n)}.get(by, (p,))
    if by == "reflection":
        place = (p, et.Reflection(0.5, n, VIEW))
    method = getattr(light(*(LIGHTS[light] if fields is None else fields)), "by_" + by)
    return method() if light in DISTANT else method(*place)


def same(a, b):
    """The same fields, bit by bit."""
    return all(np.array_equal(getattr(a, f).view(np.uint8), getattr(b, f).view(np.uint8)) for f in FIELDS)


each_technique = pytest.mark.parametrize("light, by", TECHNIQUES, ids=lambda x: getattr(x, "__name__", x))
