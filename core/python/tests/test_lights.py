"""Prepared lights: closed forms, densities that integrate to 1, and inverses."""

import etendue as et
import numpy as np
import pytest
from common import LIGHTS, N, P, ROUGH, TRIANGLE, each_technique, prepare, same


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
        assert np.array_equal(pdf, s.pdf) and np.array_equal(hit.pdf, pdf) and np.allclose(hit.distance, s.distance, rtol=1e-4)


@each_technique
def test_the_pdf_of_a_hit_is_that_of_its_direction(light, by):
    u = et.OwenSobol(5).pairs(4096)
    sampler = prepare(light, by)
    s = sampler.sample(u)
    w = s.direction
    pdf, of_hit = sampler.pdf(w), sampler.pdf_of_hit(w)
    assert of_hit.shape == (4096,) and np.isfinite(of_hit).all()
    np.testing.assert_array_equal(of_hit[pdf > 0], pdf[pdf > 0])
    assert sampler.pdf_of_hit(w[7]) == of_hit[7]
    if light in (et.Triangle, et.Parallelogram) and by == "solid_angle":
        # a direction beside the light, which misses it
        beside = -w[:1]
        assert sampler.pdf(beside) == 0 and sampler.pdf_of_hit(beside) == of_hit[0] > 0


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
