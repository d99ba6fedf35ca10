"""The Python package: closed forms, shapes, wrong arguments, and the bits of the core."""

import pathlib
import platform
import re

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
SURFACES = {by: {"n": N} for by in ("projected_solid_angle", "cosine_warp")}
SURFACES |= {"reflection": {"n": N, "alpha": 0.5, "view": VIEW}, "spread": {"spread": 2.9}}
TECHNIQUES = [(light, name[3:]) for light in LIGHTS for name in dir(light) if name.startswith("by_")]
# a rounded direction determines the pdf and the numbers of these only as well as it determines the point
ROUGH = {(et.Sphere, "area"), (et.BilinearPatch, "area")}
WARPS = [
    (et.ConcentricDisk(), 2, 2),
    (et.PolarDisk(), 2, 2),
    (et.UniformHemisphere(), 2, 3),
    (et.UniformSphere(), 2, 3),
    (et.CosineHemisphere(), 2, 3),
    (et.Octahedral(), 2, 3),
    (et.AreaTriangle(), 2, 2),
    (et.LowDistortionTriangle(), 2, 2),
    (et.Cone(0.3), 2, 3),
    (et.Bilinear([1, 2, 0.5, 3]), 2, 2),
    (et.GgxVisibleNormals(0.3, 0.5, [0.6, 0, 0.8]), 2, 3),
    (et.Reflection(0.2, [0, 0, 1], [0.6, 0, 0.8]), 2, 3),
    (et.PatchSurface([0, 1, 0], [1, 0, 0], [0, 0, 1], [1, 0.3, 1]), 2, 3),
    (et.Linear(3, 1), 1, 1),
    (et.Tent(1.5), 1, 1),
]
SEQUENCES = [
    et.Independent(1),
    et.OwenSobol(1),
    et.JointSobol(1),
    et.Stratified(1, 4096),
]
FIELDS = ["direction", "distance", "pdf", "weight", "normal", "uv", "emits"]


def prepare(light, by, p=P, n=N, fields=None):
    place = {"projected_solid_angle": (p, n), "cosine_warp": (p, n)}.get(by, (p,))
    if by == "reflection":
        place = (p, et.Reflection(0.5, n, VIEW))
    if by == "spread":
        place = (p, et.Spread(2.9))
    method = getattr(light(*(LIGHTS[light] if fields is None else fields)), "by_" + by)
    return method() if light in DISTANT else method(*place)


def same(a, b):
    """The same fields, bit by bit."""
    return all(np.array_equal(getattr(a, f).view(np.uint8), getattr(b, f).view(np.uint8)) for f in FIELDS)


each_technique = pytest.mark.parametrize("light, by", TECHNIQUES, ids=lambda x: getattr(x, "__name__", x))
each_warp = pytest.mark.parametrize("warp, numbers, coordinates", WARPS, ids=lambda x: type(x).__name__)
each_sequence = pytest.mark.parametrize("sequence", SEQUENCES, ids=lambda x: type(x).__name__)


def test_every_technique_is_here():
    stub = (pathlib.Path(__file__).parent.parent / "etendue.pyi").read_text()
    # lights with images, and spread, have tests of their own
    listed = stub[stub.index("# from the list of techniques") : stub.index("# end of what is from the list")]
    assert len(TECHNIQUES) == listed.count("    def by_") > 20
    assert {type(warp).__name__ for warp, *_ in WARPS} == set(re.findall(r"class (\w+)\(Warp\)", stub))


# closed forms


def test_delta_lights():
    to = np.array([0.2, 1.5, 0.1]) - P
    point = et.PointLight([0.2, 1.5, 0.1]).by_delta(P).sample([0.3, 0.6])
    np.testing.assert_allclose(point.direction, to / np.linalg.norm(to), rtol=1e-6)
    assert point.weight == pytest.approx(1 / (to @ to)) and point.distance == pytest.approx(np.linalg.norm(to))
    # full in the inner cone, half as bright where the cosine is in the middle of both, and dark outside
    for cones, part in (((0.1, 0.5), 1), ((0, 2 - 2 * 1.3 / np.linalg.norm([0.1, 1.3, 0.1])), 0.5), ((1e-4, 2e-4), 0)):
        spot = et.SpotLight([0, 1.5, 0.2], [0, -1, 0], *cones).by_delta(P).sample([0.3, 0.6])
        assert spot.weight * 1.71 == pytest.approx(part, rel=1e-4)
    sun = et.DirectionalLight([0, 1, 0]).by_delta().sample([0.3, 0.6])
    assert sun.direction.tolist() == [0, 1, 0] and sun.weight == 1 and sun.distance == np.finfo(np.float32).max


def test_solid_angle_of_a_triangle():
    a, b, c = (np.array(v) - P for v in TRIANGLE)
    la, lb, lc = (np.linalg.norm(v) for v in (a, b, c))
    # Van Oosterom and Strackee 1983
    below = la * lb * lc + a @ b * lc + b @ c * la + c @ a * lb
    omega = 2 * np.arctan2(abs(a @ np.cross(b, c)), below)
    sampler = et.Triangle(*TRIANGLE).by_solid_angle(P)
    assert sampler.solid_angle == pytest.approx(omega, rel=1e-6)
    assert np.all(sampler.sample(et.OwenSobol().pairs(64)).pdf == np.float32(1 / np.float32(sampler.solid_angle)))


@pytest.mark.parametrize("light", [et.Triangle, et.Parallelogram, et.Polygon], ids=lambda x: x.__name__)
def test_form_factor_of_a_polygon(light):
    fields = LIGHTS[light]
    if light is et.Parallelogram:
        o, s, t = map(np.array, fields)
        corners = np.array([o, o + s, o + s + t, o + t])
    else:
        corners = np.array(fields if light is et.Triangle else fields[0])
    r = corners - P
    r /= np.linalg.norm(r, axis=1)[:, None]
    following = np.roll(r, -1, axis=0)
    cross = np.cross(r, following)
    angle = np.arctan2(np.linalg.norm(cross, axis=1), np.sum(r * following, axis=1))
    # Lambert's formula
    irradiance = abs(np.sum(angle[:, None] * cross / np.linalg.norm(cross, axis=1)[:, None] @ N)) / 2
    by_projected = prepare(light, "projected_solid_angle")
    assert by_projected.projected_solid_angle == pytest.approx(irradiance, rel=2e-6)
    # no variance: every sample has this value
    s = by_projected.sample(et.Independent().pairs(100))
    np.testing.assert_allclose(s.direction @ N / s.pdf, irradiance, rtol=1e-5)


def test_form_factors_of_a_sphere_and_a_disk():
    u = et.OwenSobol().pairs(1 << 16)
    sphere = et.Sphere([0, 2, 0], 0.5).by_projected_solid_angle([0, 0, 0], [0, 1, 0])
    assert sphere.projected_solid_angle == pytest.approx(np.pi * 0.25**2, rel=1e-6)
    s = et.Disk([0, 2, 0], [0, -1, 0], 0.5).by_area([0, 0, 0]).sample(u)
    assert np.mean(s.direction[:, 1] * s.weight) == pytest.approx(np.pi * 0.25 / 4.25, rel=1e-5)
    assert s.emits.all()
    s = et.Disk([0, 2, 0], [0, 1, 0], 0.5).by_area([0, 0, 0]).sample(u)
    assert not s.emits.any() and not s.weight.any() and s.pdf.all()


@each_technique
def test_the_pdf_integrates_to_1(light, by):
    if light is et.Line or by == "delta":
        pytest.skip("no direction hits a line or a delta light")
    # over a cone about the light
    target = {et.Sun: [0, 1, 0]}.get(light, prepare(light, by).sample(et.OwenSobol().pairs(256)).direction.mean(axis=0))
    frame = np.linalg.qr(np.column_stack([target, [1, 0, 0], [0, 0, 1]]))[0]
    z = frame[:, 0] * np.sign(frame[:, 0] @ target)
    height = 0.02 if light is et.Sun else 0.6
    w = et.Cone(height).sample(et.OwenSobol(3).pairs(1 << 20))
    w = w[:, :1] * frame[:, 1] + w[:, 1:2] * frame[:, 2] + w[:, 2:] * z
    sampler = prepare(light, by)
    assert np.max(1 - sampler.sample(et.OwenSobol().pairs(4096)).direction @ z) < height
    pdf = sampler.pdf(w)
    area = 2 * np.pi * height
    integral = pdf.mean(dtype=float) * area
    # Sobol points are not worse than independent ones
    error = pdf.std(dtype=float) * area / 1024
    if (light, by) == (et.Sphere, "area"):
        # directions meet the near side alone
        integral += 1 - sampler.sample(et.OwenSobol().pairs(1 << 20)).emits.mean()
        error += 0.5 / 1024
    assert integral == pytest.approx(1, abs=3 * float(error))


@each_technique
def test_closed(light, by):
    u = et.OwenSobol(5).pairs(4096)
    sampler = prepare(light, by)
    s = sampler.sample(u)
    assert np.allclose(np.linalg.norm(s.direction, axis=1), 1, atol=1e-6)
    if (light, by) == (et.Sphere, "area"):
        u, s = u[s.emits], sampler.sample(u[s.emits])
    back = sampler.invert(s.direction)
    if by == "delta":
        assert same(s, sampler.sample(u[::-1])) and s.emits.all() and (s.weight * s.pdf == pytest.approx(1))
        assert not sampler.pdf(s.direction).any() and not sampler.hit(s.direction).weight.any() and not back.any()
        return
    if light is et.Line:
        u, back = u[:, 0], back[:, 0]
    inner = np.ones(len(s.pdf), bool)
    if (light, by) in ROUGH:
        cosine = -np.sum(s.direction * s.normal, axis=1)
        inner = cosine > 0.3
    gap = np.abs(back - u)[inner]
    assert np.minimum(gap, 1 - gap).max() < 3e-5
    if light is not et.Line and (light, by) not in ROUGH:
        hit, pdf = sampler.hit(s.direction), sampler.pdf(s.direction)
        # a cosine warp's sample has the pdf of the point that was drawn
        assert np.allclose(pdf, s.pdf, rtol=2e-4, atol=0) if by == "cosine_warp" else np.array_equal(pdf, s.pdf)
        assert np.array_equal(hit.pdf, pdf) and np.allclose(hit.distance, s.distance, rtol=1e-4)


@each_warp
def test_warps_are_closed(warp, numbers, coordinates):
    u = et.OwenSobol(5).pairs(4096)
    u = u if numbers == 2 else u[:, 0]
    x = warp.sample(u)
    assert x.shape == ((4096, coordinates) if coordinates > 1 else (4096,)) and x.dtype == np.float32
    assert warp.invert(x).shape == u.shape
    gap = np.abs(warp.invert(x) - u)
    assert np.minimum(gap, 1 - gap).max() < 2e-5
    assert (warp.pdf(x) > 0).all()


def test_the_pdfs_of_warps():
    w = et.CosineHemisphere().sample(et.OwenSobol().pairs(256))
    np.testing.assert_allclose(et.CosineHemisphere().pdf(w), w[:, 2] / np.pi, rtol=1e-6)
    x = np.linspace(-10, 10, 2001)
    assert et.Tent(1).pdf([-0.5, 0, 0.5, 2]).tolist() == [0.5, 1, 0.5, 0]


@each_sequence
def test_sequences(sequence):
    u = sequence.pairs(4096)
    assert u.shape == (4096, 2) and u.dtype == np.float32 and (u >= 0).all() and (u < 1).all()
    assert np.abs(u.mean(axis=0) - 0.5).max() < 4 / np.sqrt(12 * 4096)
    assert np.array_equal(u, sequence.pairs(4096))
    assert np.array_equal(u[100:200], sequence.pairs(100, first=100))
    pixels = sequence.pairs(10, pixel=[[0, 5], [9, 2]], dimension=3)
    assert pixels.shape == (2, 2, 10, 2)
    assert np.array_equal(pixels[1, 0], sequence.pairs(10, pixel=9, dimension=3))
    assert not np.array_equal(pixels[0, 0], u[:10])
    assert sequence.pairs(0).shape == (0, 2) and sequence.pairs(3, pixel=[]).shape == (0, 3, 2)
    assert sequence.pairs(1, first=2**32 - 1).shape == (1, 2)


def test_owen_sobol_is_a_net():
    u = et.OwenSobol(3).pairs(256, pixel=7, dimension=2)
    cells = np.unique((u * 16).astype(int), axis=0)
    assert len(cells) == 256


# shapes


@each_technique
def test_any_count_gives_the_same_bits(light, by):
    sampler = prepare(light, by)
    u = et.Independent(2).pairs(1000)
    many = sampler.sample(u)
    for i in [0, 1, 500, 999]:
        one = sampler.sample(u[i])
        assert one.direction.shape == (3,) and one.pdf.shape == () and one.uv.shape == (2,)
        for field in FIELDS:
            assert np.array_equal(getattr(one, field), getattr(many, field)[i])
    w = many.direction
    assert np.array_equal(sampler.pdf(w)[37], sampler.pdf(w[37]))
    assert np.array_equal(sampler.invert(w)[37], sampler.invert(w[37]))
    grid = sampler.sample(u.reshape(10, 20, 5, 2))
    assert grid.direction.shape == (10, 20, 5, 3) and grid.emits.shape == (10, 20, 5)
    assert np.array_equal(grid.pdf.ravel(), many.pdf)
    assert same(many, sampler.sample(u))


@each_technique
def test_each_is_the_same_as_one_by_one(light, by):
    rng = np.random.default_rng(1)
    count = 37
    move = rng.normal(size=(count, 3)).astype(np.float32) * 0.1
    p, u = (P + move).astype(np.float32), rng.random((count, 2)).astype(np.float32)
    fields = [np.broadcast_to(np.float32(f), (count, *np.shape(f))) for f in LIGHTS[light]]
    n = SURFACES.get(by, {})
    s = light.sample_each(*fields, p=p, u=u, by=by, **n)
    assert s.direction.shape == (count, 3)
    for i in range(count):
        one = prepare(light, by, p=p[i]).sample(u[i])
        for field in FIELDS:
            assert np.array_equal(getattr(s, field)[i], getattr(one, field)), field
    w = s.direction
    hit, pdf, back = (f(*fields, p=p, w=w, by=by, **n) for f in (light.hit_each, light.pdf_each, light.invert_each))
    for i in range(count):
        sampler = prepare(light, by, p=p[i])
        one = sampler.hit(w[i])
        for field in FIELDS:
            assert np.array_equal(getattr(hit, field)[i], getattr(one, field)), field
        assert pdf[i] == sampler.pdf(w[i]) and np.array_equal(back[i], sampler.invert(w[i]))
    # the light and the point alike are broadcast
    s = light.sample_each(*LIGHTS[light], p=p[:, None], u=u, by=by, **n)
    assert s.direction.shape == (count, count, 3) and s.pdf.shape == (count, count)
    empty = light.sample_each(*LIGHTS[light], p=P, u=np.empty((0, 2)), by=by, **n)
    assert empty.direction.shape == (0, 3)


def test_any_array_will_do():
    sampler = et.Triangle(*TRIANGLE).by_solid_angle(P)
    u = et.Independent(2).pairs(1000)
    expected = sampler.sample(u)
    assert same(sampler.sample(np.asfortranarray(u)), expected)
    assert same(sampler.sample(u.astype(float)), expected)
    assert same(sampler.sample(u.tolist()), expected)
    assert same(sampler.sample(u.astype(">f8")), expected)
    wide = np.zeros((2000, 6), np.float32)
    wide[::2, 1::3] = u
    assert same(sampler.sample(wide[::2, 1::3]), expected)
    assert same(sampler.sample(u[::-1]), sampler.sample(u[::-1].copy()))
    raw = np.frombuffer(b"x" + u.tobytes(), np.uint8)[1:].view(np.float32).reshape(-1, 2)
    assert not raw.flags.aligned and same(sampler.sample(raw), expected)
    frozen = u.copy()
    frozen.flags.writeable = False
    assert same(sampler.sample(frozen), expected)
    assert et.ConcentricDisk().sample(np.array([[0, 0]])).shape == (1, 2)
    # numbers of double precision that are below 1 and round to it
    last = np.float32(1) - np.float32(2**-24)
    assert same(sampler.sample([[1 - 1e-12, 0.5]]), sampler.sample(np.float32([[last, 0.5]])))
    assert et.Tent(1).sample(1 - 1e-16) == et.Tent(1).sample(last)


def test_results_do_not_share_memory():
    u = et.Independent().pairs(8)
    kept = u.copy()
    x = et.ConcentricDisk().sample(u)
    x[:] = 0
    assert np.array_equal(u, kept) and x.flags.c_contiguous and x.flags.writeable


@pytest.mark.parametrize("empty", [[], np.empty((0, 2)), np.empty((0, 2), np.float32), np.empty((3, 0, 2))], ids=str)
def test_empty(empty):
    shape = np.shape(empty)[:-1] or (0,)
    s = et.Triangle(*TRIANGLE).by_solid_angle(P).sample(empty)
    assert s.direction.shape == (*shape, 3) and s.emits.shape == shape and s.emits.dtype == bool
    assert et.CosineHemisphere().sample(empty).shape == (*shape, 3)


# degenerate and wrong arguments


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
        p = rng.choice(special, (count, 3))
        s = light.sample_each(*fields, p=p, u=rng.random((count, 2)), by=by, **({"n": [0, 0, 1]} | SURFACES.get(by, {})))
        finite = np.isfinite(p).all(axis=1)
        for f in fields:
            finite &= np.isfinite(f).reshape(count, -1).all(axis=1)
        for field in ["direction", "distance", "pdf", "weight"]:
            assert np.isfinite(getattr(s, field)[finite]).all(), field
        sampler = prepare(light, by)
        w = rng.choice(special, (count, 3))
        w = w[~(np.abs(np.square(w).sum(axis=1) - 1) < np.inf) | (np.square(w).sum(axis=1) == 0)]
        sampler.pdf(w), sampler.invert(w), sampler.hit(w)


def test_degenerate_lights_have_no_samples():
    s = et.Triangle([0, 1, 0], [0, 1, 0], [0, 1, 0]).by_solid_angle(P).sample([0.3, 0.6])
    assert s.pdf == 0 and s.weight == 0
    assert et.Sphere([0, 1, 0], 0).by_solid_angle(P).sample([0.3, 0.6]).pdf == 0


U = [[0.3, 0.6]]
SAMPLER = et.Triangle(*TRIANGLE).by_solid_angle(P)
EACH = {"p": P, "u": U}


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
        (lambda: et.Tent(1).sample(np.float16(1)), ValueError, r"u must be in \[0, 1\), not 1$"),
        (
            lambda: et.Sphere.sample_each([0, 2, 0], 1, p=np.zeros((5, 1, 3)), u=[[0.5, 0.5], [0.5, 1]], by="area"),
            ValueError,
            r"u\[1, 1\] must be in \[0, 1\), not 1$",
        ),
        (lambda: SAMPLER.pdf([0, 2, 0]), ValueError, "w must be a unit vector, not of length 2"),
        (lambda: SAMPLER.hit([[0, 1, 0], [0, 2, 0]]), ValueError, r"w\[1\] must be a unit vector, not of length 2"),
        (lambda: SAMPLER.pdf([0, 2]), ValueError, r"w must have the shape \(\.\.\., 3\), not \(2,\)"),
        (lambda: SAMPLER.sample(), TypeError, "'u'"),
        (lambda: SAMPLER.area, AttributeError, "Triangle by_solid_angle has no area"),
        (lambda: et.Triangle([0, 0, 0], [1, 0, 0]), TypeError, "'v2'"),
        (lambda: et.Triangle([0, 0, 0], [1, 0, 0], [0, 1]), ValueError, r"v2 must have .* not \(2,\)"),
        (lambda: et.Triangle(np.zeros((4, 3)), [1, 0, 0], [0, 1, 0]), ValueError, r"v0 must have .* not \(4, 3\)"),
        (lambda: et.Triangle(*TRIANGLE).by_projected_solid_angle(P), TypeError, "'n'"),
        (lambda: et.Triangle(*TRIANGLE).by_projected_solid_angle(P, [0, 0, 3]), ValueError, "n must be a unit vector"),
        (lambda: et.Triangle.sample_each(*TRIANGLE, **EACH, by="magic"), ValueError, "by must be one of .*area.*magic"),
        (lambda: et.Triangle.sample_each(*TRIANGLE, **EACH, by="cosine_warp"), TypeError, "needs n"),
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
        (lambda: et.Disk([0, 0, 0], [0, 0, 2], 1), ValueError, "normal must be a unit vector"),
        (lambda: et.Polygon([[0, 0, 0], [1, 0, 0]]), ValueError, r"corners must have the shape .*3 to 8.*\(2, 3\)"),
        (lambda: et.Polygon(np.zeros((9, 3))), ValueError, r"\(9, 3\)"),
        (lambda: et.Warp(), TypeError, "Warp"),
        (lambda: et.Bilinear([1, 2, 3]), ValueError, r"corners must have the shape \(\.\.\., 4\)"),
        (lambda: et.Tent(1).sample([0.5, 2]), ValueError, r"u\[1\] must be in \[0, 1\), not 2"),
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


# what a host does wrong at first


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


@each_technique
def test_directions_from_points(light, by):
    if light in (et.Line, et.Sun) or by == "delta":
        pytest.skip("no direction hits a line or a delta light, and a sun has no points")
    u = 0.02 + 0.96 * et.OwenSobol(4).pairs(4096)
    sampler = prepare(light, by)
    s = sampler.sample(u)
    points = np.float32(P) + s.direction * s.distance[:, None]
    w = points - np.float32(P)
    w /= np.linalg.norm(w, axis=1)[:, None]
    facing = np.abs(np.sum(w * s.normal, axis=1)) > 0.3
    facing &= s.emits | ((light, by) not in ROUGH)
    np.testing.assert_allclose(sampler.pdf(w)[facing], s.pdf[facing], rtol=1e-4)


# reflections


def test_reflections():
    lobe = et.Reflection(0.2, [0, 0, 1], [0.6, 0, 0.8])
    assert 0.9 < lobe.albedo < 1 and 0 < lobe.schlick < 0.1 and "albedo 0.9" in repr(lobe)
    # the pdf integrates to 1 over the hemisphere, and is greatest near the mirror direction
    w = et.UniformHemisphere().sample(et.OwenSobol().pairs(1 << 18))
    pdf = lobe.pdf(w)
    assert pdf.mean(dtype=float) * 2 * np.pi == pytest.approx(1, abs=2e-3)
    assert w[pdf.argmax()] @ [-0.6, 0, 0.8] > 0.95 and lobe.pdf([0, 0, -1]) == 0
    # spheres cover what of the lobe is within their angle; from inside they cover all of it
    inside = w @ np.array([-0.6, 0, 0.8]) > 0.8
    part = (pdf * inside).mean(dtype=float) * 2 * np.pi
    covered = lobe.sphere([[-6, 0, 8], [0.1, 0, 0.1], [-6, 0, 8]], [6, 1, 0])
    assert covered.dtype == np.float32 and covered[1] == np.float32(np.pi) and covered[2] == 0
    assert covered[0] == pytest.approx(np.pi * part, rel=2e-3) and covered[0] == lobe.sphere([-6, 0, 8], 6)
    # what samples of the light say is what its closed form says
    panel = et.Parallelogram([-2, -1, 1], [0, 2, 0], [0, 0, 2])
    sampler = panel.by_reflection([0, 0, 0], lobe)
    s = sampler.sample(et.OwenSobol().pairs(4096))
    seen = lobe.pdf(s.direction) / s.pdf
    np.testing.assert_allclose(seen, sampler.projected_solid_angle / np.pi, rtol=1e-4)
    # a reflection for each row
    alpha, view = np.linspace(0, 1, 7), [[0.6, 0, 0.8], [0, 0, 1], [0, 0.8, -0.6]]
    albedo, schlick = et.Reflection.albedo_and_schlick_each(alpha, [0, 0, 1], np.array(view)[:, None])
    assert albedo.shape == schlick.shape == (3, 7) and not albedo[2].any()
    for i, j in np.ndindex(3, 7):
        one = et.Reflection(alpha[j], [0, 0, 1], view[i])
        assert albedo[i, j] == one.albedo and schlick[i, j] == one.schlick


# light from an image


def test_image_environment():
    rng = np.random.default_rng(1)
    weights = 0.1 + rng.random((16, 32))
    weights[3, 5] = 0
    sky = et.ImageEnvironment(weights)
    assert "32 x 16" in repr(sky)
    sampler = sky.by_radiance()
    s = sampler.sample(et.OwenSobol().pairs(1 << 16))
    # the cosines and azimuths of the rows' and columns' edges, in double precision
    edges = np.cos(np.arange(17) * np.pi / 16)
    power = weights * (edges[:-1] - edges[1:])[:, None] * (np.pi / 16)
    x, y, z = s.direction.astype(float).T
    column = np.floor(np.arctan2(y, x) % (2 * np.pi) * 16 / np.pi).astype(int) % 32
    row = np.floor(np.arccos(np.clip(z, -1, 1)) * 16 / np.pi).astype(int)
    # directions within rounding of an edge may be found on its other side
    inside = np.abs(s.uv * [32, 16] % 1 - 0.5).max(axis=1) < 0.4999
    assert inside.mean() > 0.99
    found = np.stack([column, row], axis=1)[inside]
    assert np.array_equal(found, np.floor(s.uv * [32, 16])[inside].astype(int))
    # a table's probabilities are multiples of 2^-24 in the column of rows and in each row
    np.testing.assert_allclose(s.pdf[inside], (weights[row, column] / power.sum())[inside], rtol=2e-5)
    np.testing.assert_array_equal(s.pdf, sampler.pdf(s.direction))
    np.testing.assert_allclose(s.weight * s.pdf, 1, rtol=1e-6)
    counts = np.zeros((16, 32))
    np.add.at(counts, (row, column), 1 / len(row))
    assert np.abs(counts - power / power.sum()).max() < 3e-4 and counts[3, 5] == 0
    back = sampler.sample(sampler.invert(s.direction))
    np.testing.assert_allclose(back.direction[inside], s.direction[inside], atol=2e-6)
    np.testing.assert_array_equal(sampler.hit(s.direction).uv, s.uv)
    # the table lives as long as its samplers do
    u = [[0.3, 0.6]]
    assert et.ImageEnvironment([[1, 2]], "equal-area").by_radiance().sample(u).pdf[0] > 0
    uniform = et.ImageEnvironment(np.ones((8, 8)), "equal-area").by_radiance()
    np.testing.assert_allclose(uniform.sample(u).pdf, 1 / (4 * np.pi), rtol=1e-6)


# the tree


def test_light_tree():
    rng = np.random.default_rng(1)
    center = rng.random((300, 3)) * 10 + [0, 3, 0]
    normal = rng.normal(size=(300, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    power = rng.random(300)
    power[17] = 0
    tree = et.LightTree(center, 0.1, normal, power=power)
    assert len(tree) == 300 and "300" in repr(tree)
    p, n = [5, 0, 5], [0, 1, 0]
    pmf = tree.pmf(p, n, np.arange(301))
    assert pmf.sum() <= 1 + 1e-5 and pmf[17] == 0 and pmf[300] == 0
    u = et.OwenSobol().pairs(1 << 16)[:, 0]
    index, chosen, left = tree.choose(p, n, u)
    assert index.dtype == np.uint32 and index.shape == chosen.shape == left.shape == u.shape
    some = index != et.NO_LIGHT
    assert np.array_equal(chosen[some], pmf[index[some]]) and not chosen[~some].any()
    assert np.abs(np.bincount(index[some], minlength=301) / len(u) - pmf).max() < 1e-3
    assert ((left >= 0) & (left < 1)).all() and abs(left.mean() - 0.5) < 0.01
    one = tree.choose(p, n, u[5])
    assert one[0].shape == () and one[0] == index[5] and one[1] == chosen[5]
    none = et.LightTree(np.empty((0, 3)), 1)
    assert len(none) == 0 and none.choose(p, n, 0.5)[0] == et.NO_LIGHT and none.choose(p, n, [])[0].shape == (0,)


# bits


def fnv(words):
    value = 0xCBF29CE484222325
    for word in words.ravel().tolist():
        value = (value ^ word) * 0x100000001B3 & (1 << 64) - 1
    return value


def test_the_bits_are_those_of_the_core():
    """The hashes are those that `tests/bits.rs` computes in Rust."""
    u = et.Independent(7).pairs(1000, pixel=3)

    def samples(sampler):
        s = sampler.sample(u)
        numbers = [s.direction, s.distance, s.pdf, s.weight, s.normal, s.uv]
        words = [x.view(np.uint32).reshape(1000, -1) for x in numbers] + [s.emits.astype(np.uint32)[:, None]]
        return fnv(np.concatenate(words, axis=1))

    triangle = et.Triangle([0, 2, 0], [1, 2.5, 0], [0, 2, 1])
    lobe, panel = et.Reflection(0.5, N, VIEW), ([0, 2, 0], [1, 0, 0], [0, 0, 1])
    found = [
        fnv(et.OwenSobol(1).pairs(1000, pixel=5, dimension=2).view(np.uint32)),
        fnv(et.CosineHemisphere().sample(u).view(np.uint32)),
        samples(triangle.by_area(P)),
        samples(triangle.by_solid_angle(P)),
        samples(triangle.by_projected_solid_angle(P, N)),
        samples(et.Sphere([0.3, 1.5, 0.2], 0.4).by_solid_angle(P)),
        samples(et.Polygon(CORNERS).by_solid_angle(P)),
        fnv(lobe.sample(u).view(np.uint32)),
        fnv(lobe.sphere(et.UniformSphere().sample(u), 0.4).view(np.uint32)),
        *(samples(light.by_reflection(P, lobe)) for light in (triangle, et.Parallelogram(*panel), et.Rectangle(*panel), et.Polygon(CORNERS))),
    ]
    assert found == [int(word.replace("_", ""), 16) for word in HASHES]


SOURCE = (pathlib.Path(__file__).parent / "bits.rs").read_text()
HASHES = re.findall("0x[0-9a-f_]{19}", SOURCE[SOURCE.index("const HASHES:") : SOURCE.index("fn hashes_of_images")])


def test_level():
    """The wheel finds the instructions of its processor; "build" is what other architectures have, and x86-64 of before 2013."""
    assert et.level() in (("v4", "v3") if platform.machine() in ("x86_64", "AMD64") else ("build",))


def test_readme():
    """The example in the README."""
    text = (pathlib.Path(__file__).parent.parent / "README.md").read_text()
    example = text[text.index("```python\n") + 10 :]
    exec(example[: example.index("```")], {})


def test_everything_is_documented():
    for name in dir(et):
        item = getattr(et, name)
        if isinstance(item, type):
            assert item.__doc__, name
            for member in dir(item):
                if not member.startswith("_"):
                    assert getattr(item, member).__doc__, f"{name}.{member}"
