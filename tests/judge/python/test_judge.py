"""The judge in Python: a cone in numpy, right and wrong, and callbacks that raise or return something else."""

import etendue_judge
import numpy as np
import pytest


def frame(axis):
    helper = np.where(np.abs(axis[0]) < 0.6, [1.0, 0, 0], [0, 1.0, 0])
    s = np.cross(helper, axis)
    s /= np.linalg.norm(s)
    return s, np.cross(axis, s)


def cone(light, p):
    v = light[:3].astype(float) - p
    d, r = np.linalg.norm(v), float(light[3])
    versine = 2.0 if d <= r else r * r / (d * d) / (1 + np.sqrt((d - r) * (d + r)) / d)
    return v / d, versine


def sample(light, p, n, u):
    axis, versine = cone(light, p)
    s, t = frame(axis)
    k, a = u[:, :1].astype(float) * versine, 2 * np.pi * u[:, 1:].astype(float)
    w = (1 - k) * axis + np.sqrt(k * (2 - k)) * (np.cos(a) * s + np.sin(a) * t)
    return w, np.full(len(u), 1 / (2 * np.pi * versine))


def pdf(light, p, n, w):
    axis, versine = cone(light, p)
    off = 0.5 * ((w.astype(float) - axis) ** 2).sum(axis=1)
    return np.where(off <= versine * (1 + 1e-6) + 1e-12, 1 / (2 * np.pi * versine), 0)


def judged(sample=sample, pdf=pdf):
    return etendue_judge.judge(sample, pdf, shape="sphere", measure="solid angle", name="cone", quick=True)


def test_a_right_sampler_is_right():
    verdict = judged()
    assert verdict.right, verdict
    assert repr(verdict) == "cone: right"


def test_a_percent_is_found():
    verdict = judged(pdf=lambda *a: 1.01 * pdf(*a))
    assert not verdict.right and "differ by up to 1.0 %" in repr(verdict), verdict


def test_what_a_callback_raises_is_a_finding():
    def fails(*_):
        raise ZeroDivisionError("by nothing")

    assert "it raises ZeroDivisionError: by nothing" in repr(judged(sample=fails))
    assert "it raises ZeroDivisionError" in repr(judged(pdf=fails))


def test_wrong_shapes_and_types_are_said():
    with pytest.raises(ValueError, match=r"pdf has to return the shape"):
        judged(pdf=lambda *a: pdf(*a)[1:])
    with pytest.raises(TypeError, match="has to return numbers"):
        judged(pdf=lambda *a: ["a"] * len(a[3]))
    with pytest.raises(RuntimeError, match="shape 'torus'"):
        etendue_judge.judge(sample, pdf, shape="torus")
