"""Warps, reflections and sequences."""

import etendue as et
import numpy as np
import pytest
from common import WARPS

SEQUENCES = [
    et.Independent(1),
    et.OwenSobol(1),
    et.JointSobol(1),
    et.Stratified(1, 4096),
]
each_warp = pytest.mark.parametrize("warp, coordinates", WARPS, ids=lambda x: type(x).__name__)
each_sequence = pytest.mark.parametrize("sequence", SEQUENCES, ids=lambda x: type(x).__name__)


@each_warp
def test_warps_are_closed(warp, coordinates):
    u = et.OwenSobol(5).pairs(4096)
    x = warp.sample(u)
    assert x.shape == (4096, coordinates) and x.dtype == np.float32
    assert warp.invert(x).shape == u.shape
    gap = np.abs(warp.invert(x) - u)
    assert np.minimum(gap, 1 - gap).max() < 2e-5
    assert (warp.pdf(x) > 0).all()


def test_the_pdfs_of_warps():
    w = et.CosineHemisphere().sample(et.OwenSobol().pairs(256))
    np.testing.assert_allclose(et.CosineHemisphere().pdf(w), w[:, 2] / np.pi, rtol=1e-6)


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
