#!/usr/bin/env python3
"""Takes the place of a command in a plan: runs it, and lets happen to it what happens on clusters. `check` uses it.

faults.py CONFIG INDEX COMMAND…, where INDEX is the line of the plan.
"""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
from pathlib import Path


def claim(path):
    """Whether this process is the first to come here."""
    try:
        os.close(os.open(path, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return False
    return True


def parts_in(folder):
    folder = Path(folder)
    return sorted(p for p in folder.iterdir() if p.is_file() and not p.name.startswith(".")) if folder.is_dir() else []


def run(config, index, command):
    """Runs line `index` of a plan, with the fault that is due."""
    config = json.loads(Path(config).read_text())
    notes = Path(config["notes"])
    chance = random.Random(f"{config['seed']} {index}")
    fault = config["fault"]
    if command[1] == "merge":
        return merge(config, index, command, chance)
    due = str(index) in config["chosen"]
    if fault in ("killed", "lost") and not due:
        # A task that ended before its time leaves its fate to another.
        missed, taken = (len(list(notes.glob(f"{what}-*"))) for what in ("missed", "taken"))
        due = missed > taken and claim(notes / f"taken-{taken}")
    if fault not in ("killed", "lost", "twice") or not due or not claim(notes / f"first-{index}"):
        os.execvp(command[0], command)
    if fault == "twice":
        codes = [process.wait() for process in [subprocess.Popen(command), subprocess.Popen(command)]]
        (notes / f"twice-{index}").touch()
        return max(codes, key=abs)
    process = subprocess.Popen(command)
    try:
        code = process.wait(chance.uniform(0, config["chosen"].get(str(index), min(config["chosen"].values()))))
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        (notes / f"{fault}-{index}").touch()
        if fault == "lost":
            os.kill(os.getppid(), signal.SIGKILL)
        os.kill(os.getpid(), signal.SIGKILL)
    (notes / f"missed-{index}").touch()
    return code


def merge(config, index, command, chance):
    notes, fault, lie = Path(config["notes"]), config["fault"], config["lie"]
    output, parts = command[command.index("-o") + 1], parts_in(command[-1])
    damaged = []
    if fault in ("truncated", "foreign") and len(parts) >= 2 and claim(notes / f"first-{index}"):
        if fault == "truncated":
            damaged = chance.sample(parts, 2)
            for part in damaged:
                os.truncate(part, chance.randrange(part.stat().st_size))
        else:
            damaged = [Path(command[-1]) / ("foreign" + parts[0].suffix)]
            shutil.copy(config["foreign"][str(index)], damaged[0])
        if lie == "a merge that should refuse succeeds":
            Path(output).write_bytes(b"")
            return 0
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    said = result.stdout
    if lie == "a refusal does not name the file":
        for part in damaged:
            said = said.replace(part.name, "a part")
    if lie == "a byte of the image is flipped" and result.returncode == 0:
        image = bytearray(Path(output).read_bytes())
        image[chance.randrange(len(image))] ^= 1 << chance.randrange(8)
        Path(output).write_bytes(image)
    if damaged:
        damage = {"parts": [str(p) for p in damaged], "output": output, "code": result.returncode}
        (notes / f"damaged-{index}").write_text(json.dumps(damage))
    sys.stdout.write(said)
    return result.returncode


if __name__ == "__main__":
    sys.exit(run(sys.argv[1], sys.argv[2], sys.argv[3:]))
