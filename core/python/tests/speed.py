"""Nanoseconds a row of a prepared light over a million rows, by the fields that are asked for, and with new memory or the caller's.

speed.py: processor time, the least of 15 calls, of a triangle by solid angle."""

import time

import etendue as et
import numpy as np

COUNT = 1 << 20
U = et.OwenSobol(1).pairs(COUNT)
SAMPLER = et.Triangle([0, 2, 0], [1, 2, 0], [0, 2, 1]).by_solid_angle([0, 0, 0])


def nanoseconds(call):
    """The least processor time of 15 calls after a first one, for each row."""
    call()
    times = []
    for _ in range(15):
        began = time.process_time()
        call()
        times.append(time.process_time() - began)
    return min(times) * 1e9 / COUNT


samples = SAMPLER.sample(U)
some, least = (SAMPLER.sample(U, fields=fields) for fields in (("direction", "weight"), "weight"))
pdf = np.empty(COUNT, np.float32)
calls = {
    "all fields": lambda: SAMPLER.sample(U),
    "all fields of float64": lambda u=U.astype(float): SAMPLER.sample(u),
    "all fields, out": lambda: SAMPLER.sample(U, out=samples),
    "direction and weight": lambda: SAMPLER.sample(U, fields=("direction", "weight")),
    "direction and weight, out": lambda: SAMPLER.sample(U, out=some),
    "weight, out": lambda: SAMPLER.sample(U, out=least),
    "pdf": lambda: SAMPLER.pdf(samples.direction),
    "pdf, out": lambda: SAMPLER.pdf(samples.direction, out=pdf),
    "pdf of hits, out": lambda: SAMPLER.pdf_of_hit(samples.direction, out=pdf),
    "numbers u of directions": lambda: SAMPLER.invert(samples.direction),
}
for name, call in calls.items():
    print(f"{name:28} {nanoseconds(call):6.2f} ns")
