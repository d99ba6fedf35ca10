"""Two figures of a lecture on light sampling: where samples of a near triangle go, and how fast their estimates converge.

Run it with numpy, matplotlib and etendue: `python lecture.py [folder]` writes lecture-samples.png and lecture-errors.png there."""

import sys
from pathlib import Path

import etendue as et
import matplotlib.pyplot as plt
import numpy as np

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
corners = np.array([[-0.8, -0.5, 0.6], [-0.8, 2.6, 0.6], [3.0, -0.5, 0.6]])  # it emits downwards
light, p, n = et.Triangle(*corners), [0, 0, 0], [0, 0, 1]
samplers = {"area": light.by_area(p), "solid angle": light.by_solid_angle(p)}
samplers["projected solid angle"] = light.by_projected_solid_angle(p, n)

# (a) the same random numbers, on the light and in the sky over the point
u = et.OwenSobol(seed=1).pairs(1024)
outline = np.concatenate([np.linspace(corners[i], corners[(i + 1) % 3], 100) for i in range(3)])
sky = outline / np.linalg.norm(outline, axis=1)[:, None]
figure, axes = plt.subplots(2, 3, figsize=(11, 7), layout="constrained", sharex="row", sharey="row")
for (name, sampler), (on_light, in_sky) in zip(samplers.items(), axes.T):
    s = sampler.sample(u)
    point = s.direction * s.distance[:, None]
    on_light.plot(*outline.T[:2], "k", *point.T[:2], "C0.", ms=2.5)
    on_light.plot(0, 0, "C3*", ms=11, label="shading point, 0.6 below")
    in_sky.plot(*sky.T[:2], "k", *s.direction.T[:2], "C0.", ms=2.5)
    in_sky.add_patch(plt.Circle((0, 0), 1, fill=False, ls=":"))
    on_light.set(title=f"by {name}", aspect="equal", xlabel="x")
    in_sky.set(aspect="equal", xlabel="x of the direction")
axes[0, 2].legend(loc="upper right"), axes[0, 0].set_ylabel("y, on the light"), axes[1, 0].set_ylabel("y, in the sky, from below")
figure.savefig(folder / "lecture-samples.png", dpi=120)

# (b) the irradiance by a striped light: root mean square error of 256 estimates, each with a pixel of its own
radiance = lambda s: 1 + 0.8 * np.sin(9 * s.uv[..., 0]) * np.cos(7 * s.uv[..., 1])
estimate = lambda sampler, u: (radiance(s := sampler.sample(u)) * s.direction[..., 2] * s.weight).mean(-1, dtype=float)
truth = estimate(samplers["projected solid angle"], et.OwenSobol(seed=2).pairs(1 << 22))
counts, figure = 2 ** np.arange(0, 13), plt.figure(figsize=(7.5, 6), layout="constrained")
for color, (name, sampler) in enumerate(samplers.items()):
    for sequence, style in [(et.Independent(seed=3), "--"), (et.OwenSobol(seed=3), "-")]:
        runs = [estimate(sampler, sequence.pairs(count, pixel=np.arange(256))) for count in counts]
        errors = [np.sqrt(np.mean((run / truth - 1) ** 2)) for run in runs]
        plt.loglog(counts, errors, f"C{color}{style}o", ms=4, label=f"{name}, {type(sequence).__name__}")
plt.gca().set(xlabel="samples", ylabel="relative error (RMS of 256 runs)", title="A striped triangle light over a diffuse surface")
plt.legend(), plt.grid(alpha=0.3)
figure.savefig(folder / "lecture-errors.png", dpi=120)
