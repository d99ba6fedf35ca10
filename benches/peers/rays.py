#!/usr/bin/env python3
"""Million rays per second through a terrain of a million triangles, ours beside Embree 3's, on one core:

    benches/peers/rays.py [--core 1] [--rounds 5] [--before BINARY]

The rays are those of benches/examples/trace.rs (`--make`). In "groups" ours are 64 rays at a time, Embree's the fastest of its entries for
8 and 16 rays with either flag of coherence; "single" is one ray at a time. Programs alternate, and each figure is a median over the
rounds. The ratio is ours to Embree's; `--before` adds a column for another build of our trace program. Seconds of building include
a copy of the triangles. Needs cargo, taskset, a C++ compiler and libembree-dev (3.x).
"""
import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FILES = ["camera", "shadow", "shuffled", "bounce"]
QUERIES = [("camera", "closest"), ("camera", "any"), ("shadow", "any"), ("shuffled", "any"), ("bounce", "closest"), ("bounce", "any")]
REPETITIONS = "3"


def run(*command, **options):
    try:
        return subprocess.run([str(word) for word in command], check=True, cwd=ROOT, stdout=subprocess.PIPE, text=True, **options).stdout
    except FileNotFoundError as error:
        sys.exit(f"error: {error.filename} is not installed, or is no program")
    except subprocess.CalledProcessError as error:
        sys.exit(f"error: {error.cmd[0]} failed, exit status {error.returncode}: {' '.join(error.cmd)}")


def ours(core, program, folder):
    """Speeds and hits by file, query and way, and the seconds of the build."""
    out = folder / "out.json"
    run("taskset", "-c", core, program, folder / "triangles", *(folder / f for f in FILES), "--only", "single,groups", "--repetitions",
        REPETITIONS, "--json", out)
    summary = json.loads(out.read_text())
    rows = {(pathlib.Path(r["rays"]).name, *r["what"].split()): (r["median"], r["hits"]) for r in summary["rows"]}
    return rows | {("build",): (summary["build_seconds"], None)}


def embree(core, program, folder):
    rows = {}
    for line in run("taskset", "-c", core, program, REPETITIONS, folder / "triangles", *(folder / f for f in FILES)).splitlines():
        what, *rest = line.split()
        if what == "build":
            rows["build",] = float(rest[0]), None
            continue
        key = pathlib.Path(what).name, rest[0], "single" if rest[1] == "1" else "groups"
        rows[key] = max(rows.get(key, (0.0, 0)), (float(rest[2]), int(rest[3])))
    return rows


def measure(options, folder):
    run("cargo", "build", "--release", "--locked", "--quiet", "-p", "etendue-benches", "--example", "trace")
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    trace = ROOT / target / "release/examples/trace"
    run(trace, "--make", folder)
    programs = {"ours": (ours, trace)}
    if options.before:
        programs["before"] = ours, options.before.resolve()
    compiler = os.environ.get("CXX", "c++")
    if not shutil.which(compiler):
        sys.exit(f"error: no C++ compiler {compiler}")
    probe = subprocess.run([compiler, "-E", "-x", "c++", "-"], input="#include <embree3/rtcore.h>", text=True, capture_output=True)
    if probe.returncode:
        sys.exit("error: embree3/rtcore.h is missing: install libembree-dev, of Embree 3")
    run(compiler, "-std=c++17", "-O3", "-march=native", "-Wall", "-Wextra", HERE / "embree_rays.cpp", "-o", folder / "embree", "-lembree3")
    programs["Embree"] = embree, folder / "embree"
    rounds = [{name: of(options.core, program, folder) for name, (of, program) in programs.items()} for _ in range(options.rounds)]
    print(f"{'M rays/s':26}" + "".join(f"{name:>10}" for name in [*programs, "ratio"]))
    for key in [("build",)] + [(*query, way) for way in ("groups", "single") for query in QUERIES]:
        figures = {name: statistics.median(r[name][key][0] for r in rounds) for name in programs}
        hits = [rounds[0][name][key][1] for name in programs]
        # Embree loses hits at edges, and leaves out what does not fill its last packet
        if key != ("build",) and max(hits) - min(hits) > 1e-3 * max(hits) + 16:
            sys.exit(f"error: the programs disagree about {' '.join(key)}: hits {hits}")
        name = "build, seconds" if key == ("build",) else " ".join(key)
        print(f"{name:26}" + "".join(f"{x:10.3f}" for x in figures.values()) + f"{figures['ours'] / figures['Embree']:10.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--core", type=int, default=1, help="the core that all programs run on")
    parser.add_argument("--rounds", type=int, default=5, help="runs of each program")
    parser.add_argument("--before", type=pathlib.Path, help="another build of our trace program")
    options = parser.parse_args()
    if options.before and not options.before.is_file():
        sys.exit(f"error: no file {options.before}")
    with tempfile.TemporaryDirectory() as folder:
        measure(options, pathlib.Path(folder))


main()
