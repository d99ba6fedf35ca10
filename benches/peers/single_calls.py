#!/usr/bin/env python3
"""Nanoseconds per call where a host in C takes one sample or one pdf at a time:

    benches/peers/single_calls.py [--keep FOLDER]

The columns are the textbook's formulas (textbook.h, from PBR, compiled as pbrt is, for this processor), the C library (core/c, whose
functions choose their instructions when they run), and the header that core/shader writes, for this processor without contraction, which
its bits need. A row "sample" or "pdf" prepares the light, too; "prepared" is a sample of one that is kept. The textbook's pdf never asks
whether the direction hits the light. Rows without a textbook's formula have a dash. Needs cargo, a C compiler
and what core/c/install needs. Pin it to a core (taskset -c 1), and compare within one run.
"""
import argparse
import os
import pathlib
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LIGHTS = ",".join(
    f"triangle_by_{way}" for way in ("solid_angle", "projected_solid_angle")
) + ",sphere_by_solid_angle,rectangle_by_solid_angle"


def run(*command, **options):
    subprocess.run([str(word) for word in command], check=True, cwd=ROOT, **options)


def measure(folder):
    run("core/c/install", "--prefix", folder, stdout=subprocess.DEVNULL)
    run("cargo", "run", "--release", "--locked", "--quiet", "-p", "etendue-shader", "--", "--language", "c", "--lights", LIGHTS,
        "--warps", "bilinear", "-o", folder / "etendue_header.h")
    compiler = [os.environ.get("CC", "cc"), "-std=c99", "-O3", "-march=native", "-Wall", "-Wextra", "-c", HERE / "single_calls.c"]
    parts = {
        "TEXTBOOK": ["-fno-math-errno"],
        "LIBRARY": [f"-I{folder}/include"],
        "HEADER": [f"-I{folder}", "-ffp-contract=off", "-fno-math-errno"],
        "PROGRAM": [],
    }
    objects = []
    for name, flags in parts.items():
        objects.append(folder / f"{name}.o")
        run(*compiler, f"-DOF_{name}", *flags, "-o", objects[-1])
    program = folder / "single_calls"
    run(compiler[0], "-o", program, *objects, folder / "lib/libetendue.a", "-lm")
    print(f"{'ns per call':32} {'textbook':>9} {'library':>9} {'header':>9}", flush=True)
    run(program)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the library, the header and the program, which are kept")
    options = parser.parse_args()
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
        measure(options.keep.resolve())
    else:
        with tempfile.TemporaryDirectory() as folder:
            measure(pathlib.Path(folder))


main()
