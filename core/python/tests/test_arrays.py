"""Arrays: their shapes, types and memory, and which fields of samples there are."""

import etendue as et
import numpy as np
import pytest
from common import FIELDS, LIGHTS, P, SURFACES, TRIANGLE, each_technique, prepare, same


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


def test_fields():
    u = et.Independent(4).pairs(3000)
    sampler = et.Triangle(*TRIANGLE).by_solid_angle(P)
    whole = sampler.sample(u)
    w = whole.direction
    each = {"p": np.float32(P) + 0.1 * u[:, :1], "by": "solid_angle"}
    for wanted in (["direction", "weight"], ("emits",), "pdf", {"uv", "normal", "distance"}, FIELDS):
        names = [wanted] if isinstance(wanted, str) else wanted
        for call, at in (
            (sampler.sample, {"u": u}),
            (sampler.hit, {"w": w}),
            (lambda **k: et.Triangle.sample_each(*TRIANGLE, **each, **k), {"u": u}),
            (lambda **k: et.Triangle.hit_each(*TRIANGLE, **each, **k), {"w": w}),
        ):
            some, all_of_them = call(**at, fields=wanted), call(**at)
            for field in FIELDS:
                assert hasattr(some, field) == (field in names)
                if field in names:
                    assert np.array_equal(getattr(some, field), getattr(all_of_them, field)), field
            assert all(name in repr(some) for name in names)


def test_out():
    sampler, other = et.Triangle(*TRIANGLE).by_solid_angle(P), et.Sphere([0.3, 1.5, 0.2], 0.4).by_solid_angle(P)
    u = et.Independent(4).pairs(3000)
    out = sampler.sample(u)
    direction = out.direction
    assert other.sample(u, out=out) is out and out.direction is direction
    assert same(out, other.sample(u))
    some = sampler.sample(u, fields=("direction", "pdf"))
    other.sample(u, out=some)
    assert np.array_equal(some.direction, out.direction) and np.array_equal(some.pdf, out.pdf) and not hasattr(some, "uv")
    w = out.direction.copy()
    # samples over the directions that they are asked for
    assert same(other.hit(out.direction, out=out), other.hit(w))
    for call, wanted in (
        (other.pdf, other.pdf(w)),
        (other.pdf_of_hit, other.pdf_of_hit(w)),
        (other.invert, other.invert(w)),
        (lambda w, out: et.Sphere.pdf_each([0.3, 1.5, 0.2], 0.4, p=P, w=w, out=out), other.pdf(w)),
        (lambda w, out: et.Sphere.invert_each([0.3, 1.5, 0.2], 0.4, p=P, w=w, out=out), other.invert(w)),
    ):
        memory = np.full(wanted.shape, 7, np.float32)
        assert call(w, out=memory) is memory and np.array_equal(memory, wanted)
        assert call(w[0], out=memory[0, ...]).tobytes() == wanted[0].tobytes()
    # nothing is written where an argument is refused
    memory = np.full(2, 7, np.float32)
    with pytest.raises(ValueError, match="unit vector"):
        other.pdf([[0, 1, 0], [0, 0, 0]], out=memory)
    assert memory.tolist() == [7, 7]
