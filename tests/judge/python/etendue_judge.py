"""Judges a sampler of lights that Python can call.

    import etendue_judge

    verdict = etendue_judge.judge(sample, pdf, shape="sphere", measure="solid angle")
    print(verdict)
    assert verdict.right

A sampler that evaluates no densities has `pdf=None`, and one that draws by rejection, so that `u` is only what its generator starts from,
`generator=True`: both are judged by what is left.

`sample(light, p, n, u)` gets the numbers of one light as the C header orders them, the point, the normal, and an array (M, 2); it returns
directions (M, 3) and pdfs (M,), which are 0 where nothing is drawn. `pdf(light, p, n, w)` gets directions (D, 3) and returns (D,).
The program `etendue-judge` has to be on the path, or in the environment's ETENDUE_JUDGE.
"""

import json
import os
import pathlib
import subprocess
import tempfile

import numpy as np

__all__ = ["Verdict", "judge"]


class Verdict:
    """What is said about a sampler: `right`, `findings` (a list of dictionaries), and everything as `json`."""

    def __init__(self, said):
        self.json = said
        self.findings = said["findings"]
        self.right = not self.findings

    def __repr__(self):
        if self.right:
            return f"{self.json['name']}: right"
        lines = [f"{f['said']}\n    " + f["input"].replace("\n", "\n    ") for f in self.findings]
        return f"{self.json['name']}: WRONG\n  " + "\n  ".join(lines)


def _program(*arguments):
    program = os.environ.get("ETENDUE_JUDGE", "etendue-judge")
    try:
        done = subprocess.run([program, *arguments], capture_output=True, text=True)
    except FileNotFoundError as error:
        raise RuntimeError(f"there is no program {program}: set ETENDUE_JUDGE to it") from error
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stderr.strip())
    return done.stdout


def _array(value, shape, what):
    """The numbers that a callback has returned, whose shape has to be this."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{what} has to return numbers: {error}") from error
    if array.shape != shape:
        raise ValueError(f"{what} has to return the shape {shape}, not {array.shape}")
    return array


def judge(sample, pdf, shape, measure="other", name="sampler", quick=False, seed=1, generator=False):
    """Judges a sampler, and returns a `Verdict`. What a callback raises is a finding; a wrong shape or type raises here."""
    with tempfile.TemporaryDirectory() as folder:
        given = {"--quick": quick, "--generator": generator, "--no-pdf": pdf is None}
        options = [option for option, is_given in given.items() if is_given]
        _program("ask", folder, "--shape", shape, "--measure", measure, "--name", name, "--seed", str(seed), *options)
        here = pathlib.Path(folder)
        lights, points, normals, us, directions = (
            np.load(here / f"{file}.npy") for file in ("light", "point", "normal", "u", "direction")
        )
        samples = np.zeros((*us.shape[:2], 4), np.float32)
        pdfs = np.zeros(directions.shape[:2], np.float32)
        single = us.shape[1] // 8
        evaluated = np.zeros((len(us), single), np.float32)
        for i, place in enumerate(zip(lights, points, normals)):
            try:
                drawn, density = sample(*place, us[i])
                at = pdf(*place, directions[i]) if pdf else pdfs[i]
                own = pdf(*place, np.asarray(drawn, dtype=np.float32)[:single]) if pdf else evaluated[i]
            except Exception as error:  # noqa: BLE001: whatever a callback raises is what is wrong with it
                said = f"it raises {type(error).__name__}: {error}"
                numbers = [a.tolist() for a in place]
                text = "light {}, point {}, normal {}".format(*numbers)
                finding = {"figure": "Answer", "value": 1.0, "said": said, "input": text}
                return Verdict({"name": name, "shape": shape, "measure": measure, "findings": [finding]})
            samples[i, :, :3] = _array(drawn, (us.shape[1], 3), "sample (directions)")
            samples[i, :, 3] = _array(density, (us.shape[1],), "sample (pdfs)")
            pdfs[i] = _array(at, (directions.shape[1],), "pdf")
            evaluated[i] = _array(own, (single,), "pdf")
        for file, array in (("sample", samples), ("pdf", pdfs), ("evaluated", evaluated)):
            np.save(here / f"{file}.npy", array)
        return Verdict(json.loads(_program("numbers", folder, "--json"))[0])
