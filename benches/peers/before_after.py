#!/usr/bin/env python3
"""Speed and error of two builds of the renderer, scene by scene.

    python3 benches/peers/before_after.py BEFORE AFTER [--scenes quads,city] [--spp 64] [--size 128] [--rounds 5] [--core 1]

BEFORE and AFTER are two programs `etendue`, such as target/release/etendue of two commits, or of one commit with different instructions.
With `--technique mis-power,auto` the first uses one technique and the second another: so BEFORE and AFTER may be the same program.
For each scene the two render in turns, A B B A, with one thread on one pinned core and a seed for each round. The table has million samples
per second (the medians over the rounds), the ratio of the speeds (the median of the ratios of the rounds), the relative error (RMS over all
rounds) of each against a reference of --reference samples with another seed, by AFTER, the ratio of the efficiencies 1/(squared error x
time), and whether the images have the same pixels, bit for bit.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENES = "quads,cornell-box,sphere-light,triangle-light,mirror-room,defocus,plates,terrain,city,chandelier"


def run(core, program, *arguments):
    pinned = [] if core is None else ["taskset", "-c", str(core)]
    try:
        done = subprocess.run([*pinned, program, *arguments, "--json"], capture_output=True, text=True)
    except OSError as error:
        sys.exit(f"error: {error}")
    if done.returncode:
        sys.exit(f"error: {program} {' '.join(arguments)} failed:\n{done.stderr}")
    return json.loads(done.stdout)


def pixels(path):
    """The bytes of an EXR file after its header and the table of its chunks."""
    data, at = path.read_bytes(), 8
    # attributes: a name, a type, the size of a value, and the value
    while data[at]:
        at = data.index(0, data.index(0, at) + 1) + 1
        at += 4 + int.from_bytes(data[at : at + 4], "little")
    return data[int.from_bytes(data[at + 1 : at + 9], "little") :]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--scenes", default=SCENES, help="names or files, with commas between them")
    parser.add_argument("--technique", default="auto", help="of both, or of each, with a comma between them")
    parser.add_argument("--sampler", default="adaptive")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel")
    parser.add_argument("--size", type=int, default=128, help="width and height in pixels")
    parser.add_argument("--reference", type=int, default=4096, help="samples per pixel of the references; 0 leaves errors out")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--core", type=int, help="the core for all programs")
    options = parser.parse_args()
    if options.rounds < 1:
        sys.exit(f"error: --rounds {options.rounds} is not at least 1")
    programs = [options.before, options.after]
    techniques = options.technique.split(",")
    if len(techniques) > 2:
        sys.exit(f"error: --technique {options.technique} has more than two techniques")
    print(f"{'':16}{'M samples/s':>16}{'ratio':>8}{'error, %':>18}{'efficiency':>12}  image")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for scene in options.scenes.split(","):

            def render(k, image, spp, seed):
                arguments = [scene, "--size", f"{options.size}x{options.size}", "--threads", "1", "--sampler", options.sampler]
                arguments += ["--technique", techniques[min(k, len(techniques) - 1)], "--spp", str(spp), "--seed", str(seed)]
                return min(run(options.core, programs[k], "render", *arguments, "-o", str(image))["seconds"]["render"])

            reference = folder / "reference.exr"
            if options.reference:
                render(1, reference, options.reference, 1000)
            images = [folder / "before.exr", folder / "after.exr"]
            seconds, squares, alike = [[], []], [[], []], True
            for turn in range(options.rounds):
                for k in [0, 1] if turn % 2 == 0 else [1, 0]:
                    seconds[k].append(render(k, images[k], options.spp, turn))
                    if options.reference:
                        found = run(options.core, options.after, "compare", str(reference), str(images[k]))
                        squares[k].append(found["relative_rms"] ** 2)
                alike = alike and pixels(images[0]) == pixels(images[1])
            speeds = [options.size**2 * options.spp / statistics.median(times) / 1e6 for times in seconds]
            ratio = statistics.median(a / b for a, b in zip(*seconds))
            errors = efficiency = ""
            if options.reference:
                means = [statistics.mean(of) for of in squares]
                errors = "{:8.4f} {:8.4f}".format(*(100 * mean**0.5 for mean in means))
                efficiency = f"{means[0] / means[1] * ratio:.2f}"
            same = "the same" if alike else "differs"
            print(f"{scene:16}{speeds[0]:8.2f}{speeds[1]:8.2f}{ratio:8.2f}{errors:>18}{efficiency:>12}  {same}", flush=True)


if __name__ == "__main__":
    main()
