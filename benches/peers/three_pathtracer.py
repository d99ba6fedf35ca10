"""Puts our light sampling into a renderer of others, three-gpu-pathtracer in WebGL 2, and compares it with that renderer's own.

    npm install --prefix HOST three-gpu-pathtracer@0.0.26 three@0.187.0 esbuild@0.28.2
    cargo build --release -p etendue-shader
    python3 benches/peers/three_pathtracer.py HOST target/release/etendue-shader FOLDER     # needs Chromium and numpy

The host samples the area of a RectAreaLight, rectangular or circular. The script replaces three places of its fragment shader: where
a light is sampled, where the pdf of a light that a BSDF sample hits is computed for the weights, and where the normal is known. What
stands there calls the functions that etendue-shader writes (`three_pathtracer.glsl`): by solid angle, and for rectangles also by
projected solid angle, and by solid angle warped by the cosine at the surface, which is nearly the same in a seventh of the lines.

Each scene is a floor under one light, of which the host's path of two bounces computes the direct light completely. For each way of
sampling there are independent pictures of a few samples, with the light's samples alone, and combined with those of the BSDF by the
host's power heuristic. The table has, for each:

- z: difference of the mean of all pixels from the host's own sampling, in standard errors; and the largest |z| of 64 parts of the
  picture, for which chance gives 2 to 4.
- variance: mean over the pixels of the variance of one sample, divided by the squared mean; its standard error; and how many times
  smaller than the host's own it is.
- frame: median milliseconds of one sample a pixel, in turns, on Mesa's device in software where there is no other. A busy machine makes it
  longer. Chromium's own, SwiftShader, renders the host's shader, and runs out of memory at 13 GB when it compiles our functions.

A second table compares one point of the floor with quadrature in double precision of the host's diffuse surface, done here. The host
loses light there: it lifts the origin of its rays off the surface on the side to which the BSDF sample goes, and takes that origin for the
light's sample, too, so that no light is seen where a rough lobe is sampled below the surface (the first figure, "as it is"). All
other figures are with a repair: the light's sample starts above the surface.

A page `index.html` in FOLDER has the pictures, and `page.png` shows it.
"""
import argparse
import base64
import html
import json
import math
import re
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / 'core/playground/tests'))
from browser import Browser, find

arguments = argparse.ArgumentParser(description=__doc__.split('\n')[0])
arguments.add_argument('host', type=Path, help='folder with the node_modules of the host')
arguments.add_argument('writer', type=Path, help='the program etendue-shader')
arguments.add_argument('folder', type=Path, help='folder for the page')
arguments.add_argument('--size', type=int, default=96, help='pixels of a side; a multiple of 8')
arguments.add_argument('--samples', type=int, default=4, help='samples per pixel of a picture')
arguments.add_argument('--pictures', type=int, default=24, help='independent pictures of each kind')
arguments.add_argument('--ways', default='solid angle,projected', help='how we sample rectangles, with commas between')
arguments.add_argument('--device', choices=['mesa', 'swiftshader'], default='mesa', help="the driver of the machine, or Chromium's own device in software")
arguments.add_argument('--seed', type=int, default=0, help='another seed gives independent pictures')
arguments.add_argument('--only', help='render only scenes whose names contain this')
OPTIONS = arguments.parse_args()

# how rectangles are sampled, and what the preparation takes; disks always are by solid angle
TECHNIQUES = {'solid angle': ('solid_angle', 'p'), 'projected': ('projected_solid_angle', 'p, etendueNormal')}
WAYS = {'own': None} | {way: TECHNIQUES[way] for way in OPTIONS.ways.split(',')}
KINDS = ['light alone', 'combined']
# Mesa's is a device in software where there is no other
DEVICES = {'mesa': ['--use-angle=gl-egl'], 'swiftshader': ['--use-angle=swiftshader', '--enable-unsafe-swiftshader']}


def scene(at, towards, size, disk=False, camera=None, roughness=1, metalness=0):
    camera = camera or {'at': [0, 4, 4], 'towards': [0, 0, 0], 'angle': 40}
    return {'light': {'at': at, 'towards': towards, 'size': size, 'disk': disk}, 'camera': camera, 'roughness': roughness, 'metalness': metalness}


ALONG = {'at': [0, 0.9, 4.5], 'towards': [0, 0, 1], 'angle': 24}
SCENES = {
    'near and large': scene([0, 0.5, 0], [0, 0, 0.001], [2, 2]),
    'far and small': scene([1, 6, 0], [0, 0, 0], [0.3, 0.3]),
    'half below the horizon': scene([0, 0, -1.2], [0, 0, 5], [2, 2]),
    'grazing': scene([0, 0.25, -0.5], [0, 0.25, 5], [3, 0.4], camera=ALONG),
    'near, on metal': scene([0, 0.8, 0], [0, 0, 0.001], [2, 1], metalness=1, roughness=0.3),
    'disk, near and large': scene([0, 0.5, 0], [0, 0, 0.001], [2, 2], disk=True),
    'disk, far and small': scene([1, 6, 0], [0, 0, 0], [0.3, 0.3], disk=True),
    'disk, half below the horizon': scene([0, 0, -1.2], [0, 0, 5], [2, 2], disk=True),
}
POINT = [0.3, 0.0, 0.4]


# also of the host's own: switches for samples of the light without the BSDF's, and for the repair
LIGHT = 'directLightContribution( - ray.direction, surf, state, '
SWITCHES = [
    ('uniform LightsInfo lights;', 'uniform LightsInfo lights;\nuniform bool alone, repaired;'),
    (f'{LIGHT}hitPoint )', f'{LIGHT}repaired ? stepRayOrigin( ray.origin, ray.direction, surf.faceNormal, surfaceHit.dist ) : hitPoint )'),
    ('misHeuristic( lightPdf, lightMaterialPdf )', '( alone ? 1.0 : misHeuristic( lightPdf, lightMaterialPdf ) )'),
    ('misHeuristic( scatterRec.pdf, lightRec.pdf / lightsDenom )', '( alone ? 0.0 : misHeuristic( scatterRec.pdf, lightRec.pdf / lightsDenom ) )'),
]


def edits(way):
    """What is replaced in the host's shader, and the lines that replace it."""
    if WAYS[way] is None:
        return []
    found = []
    technique, place = WAYS[way]
    lights = f'rectangle_by_{technique},disk_by_solid_angle'
    command = [OPTIONS.writer, '--language', 'glsl-es', '--lights', lights, '--functions', 'sample,pdf', '--fields', 'direction,distance,pdf,emits']
    ours = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    glue = (HERE / 'three_pathtracer.glsl').read_text().replace('TECHNIQUE', technique).replace('PLACE', place)
    before = 'bool intersectLightAtIndex('
    found.append((before, f'{ours}\n{glue}\n{before}'))
    start = 'vec3 randomPos;\n\t\tif( light.type == RECT_AREA_LIGHT_TYPE ) {'
    found.append((start, f'return etendueLightSample( light, rayOrigin, ruv );\n\n\t\t{start}'))
    found.append(('lightRec.pdf = ( dist * dist ) / ( light.area * cosTheta );', 'lightRec.pdf = etenduePdf( light, rayOrigin, rayDirection );'))
    surface = 'scatterRec = bsdfSample( - ray.direction, surf );'
    found.append((surface, f'etendueNormal = surf.normal;\n\t\t\t\t\t\t{surface}'))
    return found


def lines(text):
    """How many lines have code."""
    return sum(bool(line.strip()) and not line.strip().startswith('//') for line in text.splitlines())


class Host:
    """The page with all ways of sampling."""

    def __init__(self):
        modules = OPTIONS.host / 'node_modules'
        versions = [(name, json.loads((modules / name / 'package.json').read_text())['version']) for name in ['three-gpu-pathtracer', 'three', 'esbuild']]
        OPTIONS.folder.mkdir(parents=True, exist_ok=True)
        bundle = OPTIONS.folder / 'host.js'
        command = [modules / '.bin/esbuild', HERE / 'three_pathtracer.js', '--bundle', '--log-level=error', f'--outfile={bundle}']
        subprocess.run(command, check=True, env={'NODE_PATH': str(modules.resolve()), 'PATH': '/usr/bin:/bin:/usr/local/bin'})
        (OPTIONS.folder / 'host.html').write_text('<!doctype html><meta charset="utf-8"><body><script src="host.js"></script>')
        chromium = find()
        if not chromium:
            sys.exit('three_pathtracer.py: there is no Chromium on the PATH; the variable CHROMIUM can name one')
        self.browser = Browser(chromium, gpu=True, options=['--use-gl=angle', '--ignore-gpu-blocklist', *DEVICES[OPTIONS.device]], patience=900)
        self.browser.open((OPTIONS.folder / 'host.html').resolve().as_uri(), 'window.host')
        print(', '.join(f'{name} {version}' for name, version in versions))
        print(self.call('device'))
        for way in WAYS:
            self.call('add', way, [*SWITCHES, *edits(way)])

    def call(self, function, *values):
        return self.browser.evaluate(f'host.{function}({", ".join(map(json.dumps, values))})')

    def show(self, description, size, kind, repaired=True):
        self.size = size
        return self.call('scene', description, size, {'alone': kind == 'light alone', 'repaired': repaired})

    def render(self, way, samples, seed):
        answer = self.call('render', way, samples, seed)
        if answer['samples'] != samples:
            sys.exit(f'three_pathtracer.py: {way}: {answer["samples"]} samples instead of {samples}')
        pixels = np.frombuffer(base64.b64decode(answer['pixels']), '<f4').reshape(self.size, self.size)
        return pixels.astype(float), answer['milliseconds']


def ways_of(description):
    """Disks have one technique."""
    return [way for way in WAYS if way in ('own', 'solid angle') or not description['light']['disk']]


def measure(host, description, kind, first):
    """For each way: its pictures, and milliseconds a frame."""
    host.show(description, OPTIONS.size, kind)
    ways = ways_of(description)
    found = {way: ([], []) for way in ways}
    for way in ways:
        host.render(way, 1, first)  # compiles
    for k in range(OPTIONS.pictures):
        for j, way in enumerate(ways):
            pixels, milliseconds = host.render(way, OPTIONS.samples, first + 1 + k * len(ways) + j)
            found[way][0].append(pixels)
            found[way][1].append(milliseconds)
    return {way: (np.array(pictures), float(np.median(times))) for way, (pictures, times) in found.items()}


def z_of(one, two):
    """Differences of means of independent pictures, over the first axis, in standard errors."""
    error = np.sqrt(one.var(0, ddof=1) / len(one) + two.var(0, ddof=1) / len(two))
    difference = one.mean(0) - two.mean(0)
    # where neither varies, only equality agrees
    return np.where(error > 0, difference / np.where(error > 0, error, 1), np.where(difference == 0, 0, np.inf))


def parts(pictures):
    n, side = len(pictures), OPTIONS.size // 8
    return pictures.reshape(n, 8, side, 8, side).mean((2, 4))


def variance(pictures):
    """Of one sample, relative to the squared mean; and its standard error in per cent, from how far the pictures are from one another."""
    squares = ((pictures - pictures.mean(0)) ** 2).mean((1, 2)) * len(pictures) / (len(pictures) - 1)
    error = squares.std(ddof=1) / math.sqrt(len(pictures)) / squares.mean()
    return float(squares.mean() * OPTIONS.samples / pictures.mean() ** 2), float(100 * error)


def quadrature(description, axes, eye):
    """Light reflected at POINT towards the eye, by the host's formula of a diffuse surface of roughness 1 without a coat."""
    light = description['light']
    # where the host lifts the origin of its rays
    p = np.array(POINT) + [0, 1e-4 * (max(map(abs, POINT)) + 1), 0]
    u, v = (np.array(a) * size for a, size in zip(axes, light['size']))
    normal = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
    count = 1500 if light['disk'] else 400
    x, w = np.polynomial.legendre.leggauss(400)
    if light['disk']:
        # uniform in the area: squared radius, and angle; the horizon cuts the disk, so that many points are needed
        s, ws = (np.arange(count) + 0.5) / count, np.full(count, 1 / count)
        radius, angle = np.meshgrid(0.5 * np.sqrt(s), 2 * math.pi * (np.arange(count) + 0.5) / count, indexing='ij')
        a, b, weight = radius * np.cos(angle), radius * np.sin(angle), np.full((count, count), 1 / count ** 2)
        area = math.pi / 4 * np.linalg.norm(np.cross(u, v))
    else:
        # the horizon may cut the rectangle across v: only the part above counts
        low, high = -0.5, 0.5
        if v[1] > 0 and u[1] == 0:
            low = max(low, (p[1] - light['at'][1]) / v[1])
        b = (low + high) / 2 + x * (high - low) / 2
        a, b = np.meshgrid(x / 2, b, indexing='ij')
        weight = np.outer(w / 2, w * (high - low) / 2)
        area = np.linalg.norm(np.cross(u, v))
    away = np.array(light['at']) + a[..., None] * u + b[..., None] * v - p
    squared = (away ** 2).sum(-1)
    wi = away / np.sqrt(squared)[..., None]
    wo = (np.array(eye) - POINT) / np.linalg.norm(np.array(eye) - POINT)
    cosine, at_light = np.maximum(wi[..., 1], 0), np.maximum(wi @ normal, 0)
    fl, fv = (1 - cosine) ** 5, (1 - wo[1]) ** 5
    rr = 0.5 + 2 * fl * fl
    surface = (rr * (fl + fv + fl * fv * (rr - 1)) + (1 - 0.5 * fl) * (1 - 0.5 * fv)) / math.pi
    return float((weight * surface * cosine * at_light / squared).sum() * area)


def points(host, chosen, seed):
    """Prints the light at one point of the floor beside quadrature."""
    ways = [('as it is', 'own', False), *((way, way, True) for way in WAYS)]
    print(f'\none point of the floor, and how many per cent each differs from it\n{"scene":30}{"quadrature":>12}' + ''.join(f'{title:>22}' for title, _, _ in ways))
    for name, description in chosen.items():
        if description['metalness']:
            continue
        eye, text, expected = [0.0, 4.0, 4.0], '', None
        point = dict(description, camera={'at': eye, 'towards': POINT, 'angle': 1e-4})
        for _, way, repaired in ways:
            axes = host.show(point, 32, 'light alone', repaired)
            expected = expected or quadrature(description, axes, eye)
            if way not in ways_of(description):
                continue
            means = np.array([host.render(way, OPTIONS.samples, seed + k)[0].mean() for k in range(OPTIONS.pictures)])
            seed += 1000
            error = means.std(ddof=1) / math.sqrt(len(means))
            text += f'{100 * (means.mean() / expected - 1):12.4f} ±{100 * error / expected:8.4f}'
        print(f'{name:30}{expected:12.4g}{text}', flush=True)


def png(path, rows):
    """Writes rows of grey bytes."""
    height, width = rows.shape
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    data = zlib.compress(b''.join(b'\0' + row.tobytes() for row in rows))
    path.write_bytes(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)) + chunk(b'IDAT', data) + chunk(b'IEND', b''))


def picture(path, pixels, white):
    # the first row that WebGL reads is the lowest
    linear = np.clip(pixels[::-1] / white, 0, 1)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    png(path, (encoded * 255 + 0.5).astype(np.uint8))


def main():
    host = Host()
    texts = {way: edits(way) for way in WAYS if WAYS[way]}
    for way, list_of in texts.items():
        added = sum(lines(new) - lines(old) for old, new in list_of)
        own = lines((HERE / 'three_pathtracer.glsl').read_text()) + 3
        print(f'{way}: {own} lines by hand, {added - own} lines that etendue-shader writes')
    chosen = {name: s for name, s in SCENES.items() if not OPTIONS.only or OPTIONS.only in name}
    if not chosen:
        sys.exit(f'three_pathtracer.py: no scene has {OPTIONS.only!r} in its name; there are {", ".join(SCENES)}')
    print(f'\n{OPTIONS.size} × {OPTIONS.size} pixels, {OPTIONS.pictures} pictures of {OPTIONS.samples} samples')
    print(f'{"scene":30}{"samples":14}{"by":13}{"z":>6}{"parts":>7}{"variance":>10}{"":7}{"own/this":>9}{"frame":>8}')
    page, seed = [], 1 + 1_000_000 * OPTIONS.seed
    for name, description in chosen.items():
        for kind in KINDS:
            found = measure(host, description, kind, seed)
            seed += 1000
            own, white = found['own'][0], np.quantile(found['own'][0].mean(0), 0.98)
            figures = []
            for way, (pictures, milliseconds) in found.items():
                z = float(z_of(pictures.mean((1, 2)), own.mean((1, 2)))) if way != 'own' else 0.0
                most = float(abs(z_of(parts(pictures), parts(own))).max()) if way != 'own' else 0.0
                this, error = variance(pictures)
                row = (this, variance(own)[0] / this, milliseconds)
                print(f'{name:30}{kind:14}{way:13}{z:6.1f}{most:7.1f}{this:10.3g} ±{error:3.0f} %{row[1]:10.3g}{milliseconds:7.1f} ms', flush=True)
                file = re.sub(r'[^a-z]+', '-', f'{name} {kind} {way}') + '.png'
                picture(OPTIONS.folder / file, pictures[0], white)
                figures.append(f'<figure><img src="{file}"><figcaption>{html.escape(way)}<br>variance {row[0]:.3g}<br>z {z:.1f}, {row[2]:.0f} ms</figcaption></figure>')
            page.append(f'<section><h2>{html.escape(name)}, {kind}</h2>{"".join(figures)}</section>')
    for way in texts:
        if 'return etendueLightSample(' not in host.call('source', way):
            sys.exit(f'three_pathtracer.py: the device does not run our sampling by {way}')
    points(host, chosen, seed)

    style = 'body{font:14px sans-serif;margin:1em;display:grid;grid-template-columns:1fr 1fr;gap:1em}h2{font-size:1em;margin:.3em 0}figure{display:inline-block;margin:0 6px 0 0}img{width:154px;image-rendering:pixelated;display:block}'
    title = 'three-gpu-pathtracer with its own light sampling, and with ours'
    head = f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title><style>{style}</style>'
    (OPTIONS.folder / 'index.html').write_text(f'{head}<h1 style="grid-column:1/-1">{title}: {OPTIONS.samples} samples a pixel</h1>{"".join(page)}')
    host.browser.open((OPTIONS.folder / 'index.html').resolve().as_uri(), 'true')
    (OPTIONS.folder / 'page.png').write_bytes(host.browser.screenshot())
    host.browser.close()


main()
