"""Choice among many lights."""

import etendue as et
import numpy as np


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
