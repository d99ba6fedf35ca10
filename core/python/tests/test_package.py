"""The package as a whole: every technique and warp is there and documented, and the bits are those of the core."""

import pathlib
import platform
import re

import etendue as et
import numpy as np
from common import CORNERS, N, P, TECHNIQUES, VIEW, WARPS


def test_every_technique_is_here():
    stub = (pathlib.Path(__file__).parent.parent / "etendue.pyi").read_text()
    # lights with images have tests of their own
    listed = stub[stub.index("# from the list of techniques") : stub.index("# end of what is from the list")]
    assert len(TECHNIQUES) == listed.count("    def by_") > 20
    assert {type(warp).__name__ for warp, *_ in WARPS} == set(re.findall(r"class (\w+)\(Warp\)", stub))


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
