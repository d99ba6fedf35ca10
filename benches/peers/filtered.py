#!/usr/bin/env python3
"""What `etendue compare --claim` says of filtered images, beside what their error is: of Intel's denoiser, and of a box, whose bias is most of its
error.

    pip install numpy OpenEXR pyoidn               # without pyoidn, of the box alone
    cargo build --release
    python3 benches/peers/filtered.py target/release/etendue FOLDER [--scenes terrain,studio,pots.pbrt,dunes.pbrt] [--seeds 4]

renders each scene (`beside_mitsuba.py` writes files of pots and dunes) with --seeds seeds, writes the filtered images to FOLDER, and prints a table:
the relative errors of the image and of the filtered one, RMS over the seeds; the error that the claims tell over the true one; their
standard error, relative to the claim, as they say and as their spread over the seeds tells; and how often the claim called the better image, the worse one,
or neither. The truth is an image of --reference samples, whose own claimed error is taken away.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

import numpy as np
import OpenEXR

try:
    import pyoidn
except ImportError:
    pyoidn = None

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument('etendue', help='the program')
parser.add_argument('folder', type=pathlib.Path)
parser.add_argument('--scenes', default='terrain,studio')
parser.add_argument('--spp', default='16,64,256')
parser.add_argument('--size', type=int, default=256)
parser.add_argument('--seeds', type=int, default=4)
parser.add_argument('--reference', type=int, default=4096)
OPTIONS = parser.parse_args()


def run(*arguments):
    done = subprocess.run([OPTIONS.etendue, *map(str, arguments), '--json'], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f'error: {arguments}: {done.stderr}')
    return json.loads(done.stdout)


def render(scene, spp, seed, out):
    said = run('render', scene, '-o', out, '--size', f'{OPTIONS.size}x{OPTIONS.size}', '--spp', spp, '--seed', seed, '--sampler', 'adaptive')
    channels = OpenEXR.File(str(out), separate_channels=True).channels()
    return np.stack([channels[name].pixels for name in 'RGB'], -1), said


def box(image):
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)), 'edge')
    height, width = image.shape[:2]
    return sum(padded[y:y + height, x:x + width] for y in range(3) for x in range(3)) / np.float32(9)


def denoiser():
    """Open Image Denoise, of the colours alone."""
    device = pyoidn.Device()
    device.commit()

    def denoise(image):
        filtered, colours = np.zeros_like(image), np.ascontiguousarray(image)
        ray_tracing = pyoidn.Filter(device, 'RT')
        ray_tracing.set_image(pyoidn.OIDN_IMAGE_COLOR, colours, pyoidn.OIDN_FORMAT_FLOAT3)
        ray_tracing.set_image(pyoidn.OIDN_IMAGE_OUTPUT, filtered, pyoidn.OIDN_FORMAT_FLOAT3)
        ray_tracing.set_bool('hdr', True)
        ray_tracing.commit()
        ray_tracing.execute()
        return filtered
    return denoise


def write(path, image):
    channels = {name: np.ascontiguousarray(image[..., k]) for k, name in enumerate('RGB')}
    OpenEXR.File({'compression': OpenEXR.ZIP_COMPRESSION, 'type': OpenEXR.scanlineimage}, channels).write(str(path))


OPTIONS.folder.mkdir(parents=True, exist_ok=True)
FILTERS = ([('OIDN', denoiser())] if pyoidn else []) + [('box 3x3', box)]
print('| scene | samples | filter | image | filtered | claimed over true | standard error: said | by the spread | right, wrong, not known |')
print('|---|---|---|---|---|---|---|---|---|')
for scene in OPTIONS.scenes.split(','):
    truth, said = render(scene, OPTIONS.reference, 1000, OPTIONS.folder / 'reference.exr')
    level = float(truth.mean(dtype=np.float64))
    noise = (said['error'] * level) ** 2
    for spp in map(int, OPTIONS.spp.split(',')):
        rows = {name: [] for name, _ in FILTERS}
        for seed in range(1, OPTIONS.seeds + 1):
            rendered, changed = OPTIONS.folder / 'image.exr', OPTIONS.folder / 'filtered.exr'
            image, _ = render(scene, spp, seed, rendered)
            mse = lambda x: float(((x.astype(np.float64) - truth) ** 2).mean()) - noise
            for name, work in FILTERS:
                filtered = work(image)
                write(changed, filtered)
                claim = run('compare', rendered, changed, '--claim')
                better = 'filtered' if mse(filtered) < mse(image) else 'image'
                verdict = [claim['better'] == better, claim['better'] not in (better, None), claim['better'] is None]
                rows[name].append([mse(image), mse(filtered), claim['filtered']['mse'], claim['filtered']['mse_deviation'], *verdict])
        for name, row in rows.items():
            image, filtered, claimed, deviation, *verdicts = np.array(row, dtype=float).T
            percent = lambda squares: f'{100 * math.sqrt(max(squares.mean(), 0)) / level:.3f} %'
            # half of that of the squares
            told = 50 * math.sqrt((deviation ** 2).mean()) / claimed.mean()
            spread = 50 * math.sqrt(((claimed - filtered) ** 2).mean()) / claimed.mean()
            counts = ', '.join(f'{int(v.sum())}' for v in verdicts)
            ratio = math.sqrt(max(claimed.mean(), 0) / filtered.mean())
            print(f'| {pathlib.Path(scene).stem} | {spp} | {name} | {percent(image)} | {percent(filtered)} | {ratio:.3f} | {told:.1f} % | {spread:.1f} % | {counts} |',
                  flush=True)
