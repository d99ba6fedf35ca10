"""What a host does wrong: degenerate lights, points on lights, and arguments that are refused."""

import etendue as et
import numpy as np
import pytest
from common import DISTANT, FIELDS, LIGHTS, N, P, SURFACES, TECHNIQUES, TRIANGLE, VIEW, each_technique, prepare


@each_technique
def test_any_numbers_at_all(light, by):
    rng = np.random.default_rng(7)
    # the vectors between finite points must be finite, too
    special = np.float32([0, -0.0, 1, -1, 1e-45, 1e-38, 1.7e38, -1.7e38, 1e30, 1e-30, np.inf, -np.inf, np.nan])
    count = 3000
    with np.errstate(all="ignore"):
        fields = [rng.choice(special, (count, *np.shape(f))) for f in LIGHTS[light]]
        if light in (et.Disk, et.SpotLight, *DISTANT):
            k = 0 if light in DISTANT else 1
            fields[k] = rng.choice(np.float32([[0, 0, 1], [0, 0, 0], [np.nan, 0, 0], [0.6, 0, 0.8]]), count)
        if light in (et.Sphere, et.Disk):
            fields[-1] = np.abs(fields[-1])
        p = rng.choice(special, (count, 3))
        s = light.sample_each(*fields, p=p, u=rng.random((count, 2)), by=by, **({"n": [0, 0, 1]} | SURFACES.get(by, {})))
        finite = np.isfinite(p).all(axis=1)
        for f in fields:
            finite &= np.isfinite(f).reshape(count, -1).all(axis=1)
        for field in ["direction", "distance", "pdf", "weight"]:
            assert np.isfinite(getattr(s, field)[finite]).all(), field


def test_degenerate_lights_have_no_samples():
    s = et.Triangle([0, 1, 0], [0, 1, 0], [0, 1, 0]).by_solid_angle(P).sample([0.3, 0.6])
    assert s.pdf == 0 and s.weight == 0
    assert et.Sphere([0, 1, 0], 0).by_solid_angle(P).sample([0.3, 0.6]).pdf == 0


def computed(rng, light):
    """A light, a point that is computed on it in single precision, and the normal there."""
    a, s, t = np.float32(rng.uniform(-30, 30, 3)), *np.float32(rng.uniform(-1, 1, (2, 3)))
    n = np.cross(s, t)
    n /= np.linalg.norm(n)
    u, v = np.float32(rng.random(2))
    if light is et.Triangle:
        if u + v > 1:
            u, v = 1 - u, 1 - v
        return et.Triangle(a, a + s, a + t), a * (1 - u - v) + (a + s) * u + (a + t) * v, n
    if light in (et.Rectangle, et.Disk):
        t = np.cross(n, s)
    p = a + u * s + v * t
    if light is et.Disk:
        return et.Disk(a, n, np.linalg.norm(s) * 2), p, n
    if light is et.Polygon:
        return et.Polygon([a, a + s, a + s + t, a + t]), p, n
    return light(a, s, t), p, n


@pytest.mark.parametrize("light", [et.Triangle, et.Parallelogram, et.Rectangle, et.Disk, et.Polygon])
def test_on_plane(light):
    rng = np.random.default_rng(3)
    in_front = 0
    for _ in range(20_000):
        lamp, p, n = computed(rng, light)
        assert lamp.on_surface(p), (lamp, p)
        assert not lamp.on_surface(p + np.float32(0.01) * n), (lamp, p)
        in_front += lamp.by_area(p).sample([0.3, 0.6]).weight > 0
    assert in_front > 4_000


U = [[0.3, 0.6]]
SAMPLER = et.Triangle(*TRIANGLE).by_solid_angle(P)
EACH = {"p": P, "u": U}
ASKED = (SAMPLER.pdf, SAMPLER.pdf_of_hit, SAMPLER.hit, SAMPLER.invert)


@pytest.mark.parametrize(
    "call, kind, message",
    [
        (lambda: SAMPLER.sample(np.zeros((1024, 3))), ValueError, r"u must have the shape \(\.\.\., 2\), not \(1024, 3\)"),
        (lambda: SAMPLER.sample(0.5), ValueError, r"u must have the shape \(\.\.\., 2\), not \(\)"),
        (lambda: SAMPLER.sample("a"), TypeError, "u must be an array of real numbers, not of <U1"),
        (lambda: SAMPLER.sample(None), TypeError, "u must be"),
        (lambda: SAMPLER.sample([[1j, 0]]), TypeError, "u must be .* complex128"),
        (lambda: SAMPLER.sample([[0.1, 0.2], [0.3]]), ValueError, "^u: "),
        (lambda: SAMPLER.sample([0.1, 1.5]), ValueError, r"u\[1\] must be in \[0, 1\), not 1.5"),
        (lambda: SAMPLER.sample([0.1, np.nan]), ValueError, r"u\[1\] must be in .* not NaN"),
        (lambda: SAMPLER.sample([1, 0]), ValueError, r"u\[0\] must be in \[0, 1\), not 1$"),
        (lambda: SAMPLER.sample(np.ones((1, 2), np.float32)), ValueError, r"u\[0, 0\] must be in .* not 1$"),
        (lambda: SAMPLER.sample([[0.1, 0.2], [0.3, -1e-60]]), ValueError, r"u\[1, 1\] must be in .*, not -0\.0*1$"),
        (lambda: SAMPLER.sample(np.linspace(0, 1, 12).reshape(2, 3, 2)), ValueError, r"u\[1, 2, 1\] must be .* not 1$"),
        (lambda: et.ConcentricDisk().sample(np.float16([0.5, 1])), ValueError, r"u\[1\] must be in \[0, 1\), not 1$"),
        (
            lambda: et.Sphere.sample_each([0, 2, 0], 1, p=np.zeros((5, 1, 3)), u=[[0.5, 0.5], [0.5, 1]], by="area"),
            ValueError,
            r"u\[1, 1\] must be in \[0, 1\), not 1$",
        ),
        (lambda: SAMPLER.pdf([0, 2, 0]), ValueError, "w must be a unit vector, not of length 2"),
        (lambda: SAMPLER.hit([[0, 1, 0], [0, 2, 0]]), ValueError, r"w\[1\] must be a unit vector, not of length 2"),
        *((lambda f=f: f([0, 0, 0]), ValueError, "w must be a unit vector, not of length 0") for f in ASKED),
        *((lambda f=f: f([[0, 1, 0], [0, 1e-30, 0]]), ValueError, r"w\[1\] must be .*, not of length 0") for f in ASKED),
        *((lambda f=f: f([0, np.nan, 0]), ValueError, "w must be a unit vector, not of length NaN") for f in ASKED),
        *((lambda f=f: f([0, np.inf, 0]), ValueError, "w must be a unit vector, not of length inf") for f in ASKED),
        *(
            (lambda f=f: f(*TRIANGLE, p=P, w=[[0, 1, 0], [0, np.nan, 0]]), ValueError, r"w\[1\] must be a unit vector, not of length NaN")
            for f in (et.Triangle.pdf_each, et.Triangle.hit_each, et.Triangle.invert_each)
        ),
        (lambda: SAMPLER.sample(U, fields=("pdf", "color")), ValueError, 'fields must be of .*"uv".*, not "color"'),
        (lambda: SAMPLER.sample(U, fields=7), TypeError, "not iterable"),
        (lambda: SAMPLER.sample(U, fields=[7]), TypeError, "not an instance of .str"),
        (lambda: SAMPLER.sample(U, fields="pdf").weight, AttributeError, "no weight"),
        (lambda: SAMPLER.sample(U, fields="pdf").emits, AttributeError, "no emits"),
        (lambda: SAMPLER.sample(U, fields="pdf", out=SAMPLER.sample(U)), TypeError, "either fields or out"),
        (lambda: SAMPLER.sample(U, out=np.zeros((1, 3), np.float32)), TypeError, "out must be Samples, not ndarray"),
        (lambda: SAMPLER.sample(U, out=SAMPLER.sample(U[0])), ValueError, r"out must have the shape \(1,\), not \(\)"),
        (lambda: SAMPLER.pdf([0, 1, 0], out=np.zeros((), float)), TypeError, "out must be an array of float32, not of float64"),
        (lambda: SAMPLER.pdf([0, 1, 0], out=1.0), TypeError, "out must be an array of float32, not of float"),
        (lambda: SAMPLER.pdf([0, 1, 0], out=np.zeros(3, np.float32)), ValueError, r"out must have the shape \(\), not \(3,\)"),
        (lambda: SAMPLER.pdf([[0, 1, 0]] * 4, out=np.zeros(8, np.float32)[::2]), ValueError, "out must be contiguous"),
        (lambda: SAMPLER.pdf([0, 1, 0], out=np.frombuffer(b"1234", np.float32).reshape(())), ValueError, "out cannot be written"),
        (lambda: SAMPLER.pdf([0, 2]), ValueError, r"w must have the shape \(\.\.\., 3\), not \(2,\)"),
        (lambda: SAMPLER.sample(), TypeError, "'u'"),
        (lambda: SAMPLER.area, AttributeError, "Triangle by_solid_angle has no area"),
        (lambda: et.Triangle([0, 0, 0], [1, 0, 0]), TypeError, "'v2'"),
        (lambda: et.Triangle([0, 0, 0], [1, 0, 0], [0, 1]), ValueError, r"v2 must have .* not \(2,\)"),
        (lambda: et.Triangle(np.zeros((4, 3)), [1, 0, 0], [0, 1, 0]), ValueError, r"v0 must have .* not \(4, 3\)"),
        (lambda: et.Triangle(*TRIANGLE).by_projected_solid_angle(P), TypeError, "'n'"),
        (lambda: et.Triangle(*TRIANGLE).by_projected_solid_angle(P, [0, 0, 3]), ValueError, "n must be a unit vector"),
        (lambda: et.Triangle.sample_each(*TRIANGLE, **EACH, by="magic"), ValueError, "by must be one of .*area.*magic"),
        (lambda: et.Triangle.sample_each(*TRIANGLE, **EACH, by="projected_solid_angle"), TypeError, "needs n"),
        (lambda: et.Triangle.sample_each(*TRIANGLE, **EACH, n=N, by="reflection"), TypeError, "n, alpha and view are needed"),
        (lambda: et.Disk.sample_each([0, 2, 0], [0, -1, 0], 1, **EACH, by="reflection"), ValueError, "by must be one of .*, not .reflection"),
        (lambda: et.Triangle(*TRIANGLE).by_reflection(P, N), TypeError, "Reflection"),
        (lambda: et.Reflection([0.1, 0.2], N, VIEW), ValueError, r"alpha must be one number, not \(2,\)"),
        (lambda: et.Reflection(0.1, [0, 0, 2], VIEW), ValueError, "n must be a unit vector"),
        (lambda: et.Reflection(0.1, N, [0, 0, 2]), ValueError, "view must be a unit vector"),
        (
            lambda: et.Triangle.sample_each(*TRIANGLE, p=np.zeros((3, 3)), u=np.zeros((4, 2))),
            ValueError,
            r"do not agree: p \(3, 3\), u \(4, 2\)",
        ),
        (lambda: et.Sphere([0, 0, 0], [1, 2]), ValueError, r"radius must be one number, not \(2,\)"),
        (lambda: et.Sphere([0, 0, 0], -1), ValueError, "radius must be at least 0, not -1"),
        (lambda: et.Sphere.sample_each([0, 2, 0], [1, -0.5], p=P, u=[0.5, 0.5]), ValueError, r"radius\[1\] must be at least 0, not -0.5"),
        (lambda: et.Disk([0, 0, 0], [0, 0, 1], -1), ValueError, "radius must be at least 0, not -1"),
        (lambda: et.Disk([0, 0, 0], [0, 0, 2], 1), ValueError, "normal must be a unit vector"),
        (lambda: et.Polygon([[0, 0, 0], [1, 0, 0]]), ValueError, r"corners must have the shape .*3 to 8.*\(2, 3\)"),
        (lambda: et.Polygon(np.zeros((9, 3))), ValueError, r"\(9, 3\)"),
        (lambda: et.Warp(), TypeError, "Warp"),
        (lambda: et.Bilinear([1, 2, 3]), ValueError, r"corners must have the shape \(\.\.\., 4\)"),
        (lambda: et.ConcentricDisk().sample([0.5, 2]), ValueError, r"u\[1\] must be in \[0, 1\), not 2"),
        (lambda: et.OwenSobol(-1), ValueError, "seed must be in"),
        (lambda: et.OwenSobol("x"), TypeError, "seed"),
        (lambda: et.OwenSobol().pairs(-1), ValueError, "count must be in"),
        (lambda: et.OwenSobol().pairs(2**33), ValueError, "first [+] count must be at most"),
        (lambda: et.OwenSobol().pairs(2, pixel=[-1]), ValueError, r"pixel must be in \[0, 2\*\*32\), not -1"),
        (lambda: et.OwenSobol().pairs(2, pixel=0.5), TypeError, "pixel must be an array of integers"),
        (lambda: et.Stratified(0, 0), ValueError, "count must be in"),
        (lambda: et.LightTree([0, 0, 0], 1), ValueError, r"center must have the shape \(count, 3\)"),
        (lambda: et.LightTree(np.zeros((3, 3)), [1, 2]), ValueError, "do not agree: center .* radius"),
        (lambda: et.LightTree([[0, 0, 0]], 1).pmf(P, N, 0.5), TypeError, "light must be an array of integers"),
        (lambda: et.ImageEnvironment([[1, 2]], "cube"), ValueError, 'map must be "equirectangular" or "equal-area", not "cube"'),
        (lambda: et.ImageEnvironment(np.ones((2, 3, 3))), ValueError, r"the shape \(height, width\), not \(2, 3, 3\)"),
        (lambda: et.ImageEnvironment(np.ones((0, 3))), ValueError, "1 to 16777216 rows and columns, not 0 and 3"),
        (lambda: et.ImageEnvironment([[1, 2], [3, -1]]), ValueError, r"weights\[1, 1\] must be finite .* not -1"),
        (lambda: et.ImageEnvironment([[1, np.nan]]), ValueError, r"weights\[0, 1\] must be finite .* not NaN"),
        (lambda: et.ImageEnvironment([[1e39, 1]]), ValueError, r"weights\[0, 0\] must be finite .* not inf"),
        (lambda: et.ImageEnvironment([[0, 0]]), ValueError, "all weights are 0"),
        (lambda: et.ImageEnvironment(["x"]), TypeError, "weights must be an array of real numbers"),
    ],
)
def test_wrong_arguments(call, kind, message):
    with pytest.raises(kind, match=message):
        call()


@pytest.mark.parametrize("light, by", [t for t in TECHNIQUES if t[0] not in (et.Line, *DISTANT)], ids=lambda x: getattr(x, "__name__", x))
def test_a_point_on_the_light(light, by):
    first = np.array(LIGHTS[light][0], np.float32)
    if light is et.BilinearPatch:
        s = prepare(light, by, p=[0, 0, 0]).sample([0.3, 0.6])
        p = s.direction * s.distance
    else:
        away = [0, 0.4, 0] if light is et.Sphere else [0, 0, 0]
        p = (first[0] if light is et.Polygon else first) + np.float32(away)
    sampler = prepare(light, by, p=p)
    s = sampler.sample(et.OwenSobol().pairs(1024))
    w = et.UniformSphere().sample(et.OwenSobol(2).pairs(1024))
    for x in (s.pdf, s.weight, s.distance, sampler.pdf(w), sampler.hit(w).weight, sampler.invert(w)):
        assert np.isfinite(x).all() and (x >= 0).all()
    if light in (et.Triangle, et.Parallelogram, et.Rectangle, et.Disk, et.Polygon):
        assert not s.pdf.any() and not sampler.pdf(w).any()


def test_numbers_that_are_none():
    """What is computed from NaN has no sample, and its neighbours are as they are without it."""
    u = et.Independent(3).pairs(5)
    for light, by in TECHNIQUES:
        fields = [np.broadcast_to(np.float32(f), (5, *np.shape(f))).copy() for f in LIGHTS[light]]
        given, p = SURFACES.get(by, {}), np.float32(np.broadcast_to(P, (5, 3)))
        right = light.sample_each(*fields, p=p, u=u, by=by, **given)
        assert (right.pdf > 0).all()
        for array in (*fields, p):
            whole = array.copy()
            array.reshape(5, -1)[2, 0] = np.nan
            s = light.sample_each(*fields, p=p, u=u, by=by, **given)
            array[:] = whole
            # what a technique does not use may be anything
            assert not s.pdf[2] and not s.weight[2] or np.array_equal(s.direction[2], right.direction[2]), (light, by)
            others = [0, 1, 3, 4]
            assert all(np.array_equal(getattr(s, f)[others], getattr(right, f)[others]) for f in FIELDS), (light, by)


def test_normals():
    triangle = et.Triangle(*TRIANGLE)
    for n in ([0, 2, 0], [0, 0.5, 0]):
        with pytest.raises(ValueError, match="n must be a unit vector, not of length"):
            triangle.by_projected_solid_angle(P, n)
    below = triangle.by_projected_solid_angle(P, -N)
    assert below.projected_solid_angle == 0 and below.sample([0.3, 0.6]).weight == 0
    # the other order of the vertices turns the light's normal
    turned = et.Triangle(TRIANGLE[0], TRIANGLE[2], TRIANGLE[1])
    front, behind = (x.by_solid_angle(P).sample([0.3, 0.6]) for x in (triangle, turned))
    assert front.emits != behind.emits and front.pdf == pytest.approx(behind.pdf)
    assert sorted([front.weight, behind.weight]) == [0, pytest.approx(1 / front.pdf)]
