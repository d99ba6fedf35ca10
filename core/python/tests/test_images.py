"""Lights with images and portals: closed forms, arguments, and the bits of the core."""

import pathlib
import re

import etendue as et
import numpy as np
import pytest

P, N = np.array([0.1, 0.2, 0.3]), np.array([0.0, 0.8, 0.6])
WEIGHTS = np.array([[0, 1, 0.3, 1e-3, 7], [2, 0, 0.5, 3, 1], [4, 0.25, 1, 0, 6]])
CORNER, S, T = [-0.5, 2, -0.3], [0.1, 0.2, 1.1], [1.2, 0.1, 0.2]
PANEL = et.Parallelogram(CORNER, S, T)
LIGHTS = {
    "square": [et.Rectangle([-0.5, 2, -0.3], [0, 0, 1.1], [1.2, 0, 0]), PANEL],
    "triangle": [et.Triangle(CORNER, np.add(CORNER, S), np.add(CORNER, T))],
    "disk": [et.Disk([0.3, 2, 0.1], [0, -0.8, 0.6], 0.5)],
}
BALL = et.Sphere([0.3, 2, 0.1], 0.5)
FLAT = [(region, light, by) for region, lights in LIGHTS.items() for light in lights for by in ("area", "solid_angle", "projected_solid_angle")]
U = et.Independent(7).pairs(1000, pixel=3)
FIELDS = ["direction", "distance", "pdf", "weight", "normal", "uv", "emits"]


def same(a, b):
    return all(np.asarray(getattr(a, f)).tobytes() == np.asarray(getattr(b, f)).tobytes() for f in FIELDS)


def prepare(pictured, by):
    return getattr(pictured, "by_" + by)(*((P, N) if by == "projected_solid_angle" else (P,)))


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


# pictures


@pytest.mark.parametrize("region, light, by", FLAT, ids=lambda x: x if isinstance(x, str) else type(x).__name__)
def test_flat_pictures(region, light, by):
    pictured = et.Picture(WEIGHTS, region).on(light)
    sampler = prepare(pictured, by)
    s = sampler.sample(U)
    on = s.pdf > 0
    assert on.mean() > (0.9 if region == "square" else 0.4)
    # the texel of a sample has radiance, and the pdf is that of the direction
    column, row = np.floor(s.uv * [5, 3]).astype(int).T
    assert (WEIGHTS[row, column][on] > 0).all()
    np.testing.assert_array_equal(sampler.pdf(s.direction), s.pdf)
    np.testing.assert_array_equal(sampler.hit(s.direction).uv[on], s.uv[on])
    # a direction within rounding of a texel's edge may be found in the neighbour
    inner = on & (np.abs(s.uv * [5, 3] % 1 - 0.5).max(axis=1) < 0.499)
    np.testing.assert_allclose(sampler.invert(s.direction)[inner], U[inner], atol=2e-3)
    np.testing.assert_allclose(sampler.sample(sampler.invert(s.direction)).direction[inner], s.direction[inner], atol=2e-5)
    # the mean of radiance over pdf is the integral of the radiance, whatever the technique
    radiance = WEIGHTS[row, column] * on
    cosine = np.maximum(s.direction @ N, 0)
    u = et.OwenSobol(1).pairs(1 << 16)
    reference = light.by_solid_angle(P).sample(u)
    x, y = np.minimum(np.floor(reference.uv * [5, 3]).astype(int), [4, 2]).T
    wanted = (WEIGHTS[y, x] * np.maximum(reference.direction @ N, 0) * (reference.pdf > 0) / np.maximum(reference.pdf, 1e-9)).mean()
    found = radiance * cosine / np.where(on, s.pdf, 1)
    assert abs(found.mean() - wanted) < 4.5 * found.std() / np.sqrt(len(found)) + 2e-3 * wanted
    # each row has its own point
    p = P + 0.1 * U[:, :1]
    each = pictured.sample_each(p=p, u=U, n=N, by=by)
    for i in (0, 17, 999):
        place = (p[i], N) if by == "projected_solid_angle" else (p[i],)
        one = getattr(pictured, "by_" + by)(*place)
        assert all(np.array_equal(getattr(each, f)[i], getattr(one.sample(U[i]), f)) for f in FIELDS)
        w = s.direction[i]
        assert pictured.pdf_each(p=p[i], w=w, n=N, by=by) == one.pdf(w)
        assert np.array_equal(pictured.invert_each(p=p[i], w=w, n=N, by=by), one.invert(w))
        assert same(pictured.hit_each(p=p[i], w=w, n=N, by=by), one.hit(w))


def test_pictures_on_spheres():
    pictured = et.Picture(WEIGHTS).on(BALL)
    sampler = pictured.by_visible_area(P)
    s = sampler.sample(U)
    column, row = np.floor(s.uv * [5, 3]).astype(int).T
    assert (WEIGHTS[row, column] > 0).all() and (s.pdf > 0).all()
    # a direction meets the near side of a sphere; texels at its rim are drawn as a whole
    facing = np.abs(np.sum(s.direction * s.normal, axis=1)) > 0.1
    facing &= s.emits
    assert facing.mean() > 0.3
    np.testing.assert_allclose(sampler.pdf(s.direction)[facing], s.pdf[facing], rtol=1e-3)
    # before a point of the far side, there may be a texel without radiance
    found = sampler.pdf(s.direction) > 0
    assert found.mean() > 0.7
    back = sampler.sample(sampler.invert(s.direction)).direction
    np.testing.assert_allclose(back[found], s.direction[found], atol=2e-5)
    each = pictured.sample_each(p=np.tile(P, (1000, 1)), u=U)
    assert same(each, s)


def test_pmf_of_pictures():
    # by area the pmf of a texel is its part of the radiance, to a step of 2^-24; the sum over all texels is 1
    light = et.Rectangle([-0.5, 2, -0.5], [0, 0, 1], [1, 0, 0])
    sampler = et.Picture(WEIGHTS).on(light).by_area([0, 0, 0])
    y, x = np.mgrid[0:3, 0:5]
    points = np.stack([-0.5 + (y + 0.5) / 3, np.full((3, 5), 2.0), -0.5 + (x + 0.5) / 5], axis=-1)
    r = np.linalg.norm(points, axis=-1)
    pmf = sampler.pdf(points / r[..., None]) * (2 / r) / r**2 / 15
    np.testing.assert_allclose(pmf, WEIGHTS / WEIGHTS.sum(), rtol=1e-4, atol=1e-9)
    assert abs(pmf.sum() - 1) < 1e-6
    # in proportion to what is interpolated: 1 and 3 at the centres of two texels
    smooth = et.Picture.interpolated([[1, 3]]).on(light).by_area([0, 0, 0])
    s = (np.arange(19) + 1) / 20
    points = np.stack([np.zeros(19), np.full(19, 2.0), -0.5 + s], axis=-1)
    r = np.linalg.norm(points, axis=-1)
    found = smooth.pdf(points / r[:, None]) * (2 / r) / r**2
    np.testing.assert_allclose(found, np.clip(1 + 4 * (s - 0.25), 1, 3) / 2, rtol=1e-4)
    # from the light's plane there is nothing
    assert et.Picture(WEIGHTS).on(light).by_solid_angle([0, 2, 5]).sample([0.3, 0.6]).pdf == 0


# portals


def test_portals():
    portals = [et.Portal([-0.5, 1, -0.5], [0, 0.25, 1], [1, 0, 0]), et.Portal([0.25, 1.5, 0], [0, 0.25, 1], [1, 0, 0])]
    y, x = np.mgrid[0:64, 0:64]
    w, solid_angle = portals[0].direction(np.stack([(x + 0.5) / 64, (y + 0.5) / 64], axis=-1))
    assert w.shape == (64, 64, 3) and np.abs(np.linalg.norm(w, axis=-1) - 1).max() < 1e-6
    ahead, angle = portals[0].direction([0.5, 0.5])
    np.testing.assert_allclose(ahead, np.array([0, 4, -1]) / np.sqrt(17), atol=1e-6)
    assert angle == pytest.approx(np.pi**2)
    # a sky of the same radiance everywhere: uniform over what is seen
    sky = et.PortalEnvironment(portals, [solid_angle, solid_angle])
    sampler = sky.by_radiance(P)
    s = sampler.sample(U)
    assert (s.pdf > 0).all() and sky.sees(P, s.direction).all()
    np.testing.assert_array_equal(sampler.pdf(s.direction), s.pdf)
    everywhere = et.UniformSphere().sample(et.OwenSobol(3).pairs(1 << 16))
    sees = sky.sees(P, everywhere)
    assert sees.dtype == bool and np.array_equal(sees, sampler.pdf(everywhere) > 0)
    # directions through both portals have both densities: elsewhere the pdf is constant to a texel's solid angle
    assert sampler.pdf(everywhere).mean() * 4 * np.pi == pytest.approx(1, rel=0.02)
    assert (1 / s.pdf).mean() == pytest.approx(sees.mean() * 4 * np.pi, rel=0.05)
    p = P + 0.2 * U[:, :1]
    each = sky.sample_each(p=p, u=U)
    for i in (0, 500):
        one = sky.by_radiance(p[i])
        assert all(np.array_equal(getattr(each, f)[i], getattr(one.sample(U[i]), f)) for f in FIELDS)
        assert sky.pdf_each(p=p[i], w=s.direction[i]) == one.pdf(s.direction[i])
        assert np.array_equal(sky.invert_each(p=p[i], w=s.direction[i]), one.invert(s.direction[i]))
        assert same(sky.hit_each(p=p[i], w=s.direction[i]), one.hit(s.direction[i]))
    # from behind, nothing is seen
    assert sky.by_radiance([0, 9, 0]).sample([0.3, 0.6]).pdf == 0 and not sky.sees([0, 9, 0], everywhere).any()


# wrong arguments


@pytest.mark.parametrize(
    "call, kind, message",
    [
        (lambda: et.Picture(WEIGHTS, "ring"), ValueError, 'region must be "square", "triangle" or "disk", not "ring"'),
        (lambda: et.Picture([[1, -1]]), ValueError, r"weights\[0, 1\] must be finite .* not -1"),
        (lambda: et.Picture([[0, 0]]), ValueError, "all weights are 0"),
        (lambda: et.Picture(np.ones(3)), ValueError, r"weights must have the shape \(height, width\), not \(3,\)"),
        (lambda: et.Picture.interpolated([[np.nan]]), ValueError, r"values\[0, 0\] must be finite"),
        (lambda: et.Picture(WEIGHTS).on(3), TypeError, "light must be a Rectangle, .*not int"),
        (lambda: et.Picture(WEIGHTS, "disk").on(PANEL), ValueError, 'for the region "disk", and the light covers "square"'),
        (lambda: et.Picture(WEIGHTS).on(PANEL).by_visible_area(P), TypeError, "for spheres"),
        (lambda: et.Picture(WEIGHTS).on(BALL).by_area(P), TypeError, "for flat lights"),
        (lambda: et.Picture(WEIGHTS).on(PANEL).sample_each(p=P, u=U, by="magic"), ValueError, "by must be one of .*magic"),
        (lambda: et.Picture(WEIGHTS).on(PANEL).sample_each(p=P, u=U, by="projected_solid_angle"), TypeError, "needs n"),
        (lambda: et.Portal([0, 0, 0], [1, 0, 0], [2, 0, 0]), ValueError, "must not be parallel"),
        (lambda: et.PortalEnvironment([], []), ValueError, "1 to 8"),
        (lambda: et.PortalEnvironment([et.Portal([0, 0, 0], [1, 0, 0], [0, 1, 0])], [np.ones((1, 4097))]), ValueError, "at most 4096"),
    ],
)
def test_wrong_arguments(call, kind, message):
    with pytest.raises(kind, match=message):
        call()


# bits


def fnv(words):
    value = 0xCBF29CE484222325
    for word in words.ravel().tolist():
        value = (value ^ word) * 0x100000001B3 & (1 << 64) - 1
    return value


def test_the_bits_are_those_of_the_core():
    """The hashes are those that `tests/bits.rs` computes in Rust."""

    def samples(sampler):
        s = sampler.sample(U)
        numbers = [s.direction, s.distance, s.pdf, s.weight, s.normal, s.uv]
        words = [x.view(np.uint32).reshape(1000, -1) for x in numbers] + [s.emits.astype(np.uint32)[:, None]]
        return fnv(np.concatenate(words, axis=1))

    weights = WEIGHTS.astype(np.float32)
    picture, smooth = et.Picture(weights), et.Picture.interpolated(weights)
    portals = [et.Portal(corner, [0, 0.25, 1], [1, 0, 0]) for corner in ([-0.5, 1, -0.5], [0.25, 1.5, 0])]
    found = [
        samples(picture.on(PANEL).by_area(P)),
        samples(picture.on(PANEL).by_solid_angle(P)),
        samples(smooth.on(PANEL).by_projected_solid_angle(P, N)),
        samples(smooth.on(BALL).by_visible_area(P)),
        samples(et.PortalEnvironment(portals, [weights, weights]).by_radiance(P)),
    ]
    assert found == [int(word.replace("_", ""), 16) for word in HASHES]


SOURCE = (pathlib.Path(__file__).parent / "bits.rs").read_text()
HASHES = re.findall("0x[0-9a-f_]{19}", SOURCE[SOURCE.index("const HASHES_OF_IMAGES") :])
