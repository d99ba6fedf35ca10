"""Renders scenes of pbrt 4 that people have published with Mitsuba 3, too, and compares the images: direct light alone, whose noise in the mean is
below 0.3 %. Python reads the scenes for Mitsuba by `pbrt_scenes.py`, which shares nothing with the renderer.

    pip install mitsuba numpy OpenEXR              # and LLVM, which DRJIT_LIBLLVM_PATH names
    python3 benches/peers/corpus_beside_mitsuba.py target/release/etendue FOLDER... [--only killeroo]

prints, for each scene below the folders that has area or punctual lights, the mean of both images, the ratio of the means with its standard error,
first where no lamp is seen, and the share of pixels that are more than 4 standard errors and 1 % of the mean apart (by chance, 0.04 %). What both
cannot share is replaced in both, as the last column says, or the scene is listed with the reason below the table. The files are those that people
have published, such as github.com/w3ntao/pbrt-minus-scenes: fetch them yourself, and do not commit them.
"""
import argparse
import os
import subprocess
import sys
import tempfile

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument('etendue', help='the program')
arguments.add_argument('folders', nargs='+')
arguments.add_argument('--only', default='', help='render only scenes with this in their path')
arguments.add_argument('--side', type=int, default=96, help='pixels of the longer side')
arguments.add_argument('--spp', type=int, default=64, help='samples per pixel of each of 16 images of ours')
arguments.add_argument('--peer', type=int, default=256, help='samples per pixel of each of 16 images of Mitsuba')
arguments.add_argument('--technique', default='auto')
arguments.add_argument('--uncoated', action='store_true', help='take the coats off diffuse surfaces, which Mitsuba shadows otherwise')
arguments.add_argument('--keep', help='write both images of each scene to this folder')
OPTIONS = arguments.parse_args()
PARTS = 16

import numpy as np
import OpenEXR  # Mitsuba's own reader waits for ever on one thread
import drjit as dr
import mitsuba as mi

mi.set_variant('llvm_ad_rgb')
mi.set_log_level(mi.LogLevel.Error)
dr.set_thread_count(1)
import mitsuba_emitters  # registers them
from corpus import scenes
from pbrt_scenes import Reader

T = mi.ScalarTransform4f


def rgb(value):
    return dict(type='rgb', value=[float(x) for x in value])


def surface(reader, material):
    kind, values, _ = material
    given, value = values.get('reflectance', ('rgb', [0.5] * 3))
    if given == 'texture':
        _, texture = reader.textures[value[0]]
        scale = [texture.get(name, (0, [1.0]))[1][0] for name in ('uscale', 'vscale')]
        # pbrt's images begin at the top, where v is 1
        reflectance = dict(type='bitmap', filename=os.path.join(reader.folder, texture['filename'][1][0]),
                           to_uv=mi.ScalarTransform3f().scale([scale[0], -scale[1]]))
    else:
        reflectance = rgb(value)
    if kind == 'diffuse':
        bsdf = dict(type='diffuse', reflectance=reflectance)
    elif kind == 'coateddiffuse':
        # the highlight of a smooth coat is as wide in our renderer
        alpha = max(np.sqrt(np.mean(np.square(reader.roughness(values)))), 0.01)
        bsdf = dict(type='roughplastic', distribution='ggx', alpha=float(alpha), ext_ior=1.0, nonlinear=True, diffuse_reflectance=reflectance,
                    int_ior=values.get('eta', (0, [1.5]))[1][0])
    else:
        alpha = reader.roughness(values)
        bsdf = dict(type='roughconductor', distribution='ggx', alpha_u=float(alpha[0]), alpha_v=float(alpha[1]), eta=rgb(values['eta'][1]),
                    k=rgb(values['k'][1]))
    return dict(type='twosided', bsdf=bsdf)


def mesh(points, faces, normals, uvs, bsdf, emitter):
    props = mi.Properties()
    props['mesh_bsdf'] = bsdf
    if emitter:
        props['mesh_emitter'] = emitter
    # corners of their own, since Mitsuba smooths what shares them
    made = mi.Mesh('mesh', 3 * len(faces), len(faces), has_vertex_normals=normals is not None, has_vertex_texcoords=uvs is not None, props=props)
    corners = mi.traverse(made)
    corners['vertex_positions'] = points[faces].astype(np.float32).ravel()
    corners['faces'] = np.arange(3 * len(faces), dtype=np.uint32)
    if normals is not None:
        corners['vertex_normals'] = normals[faces].astype(np.float32).ravel()
    if uvs is not None:
        corners['vertex_texcoords'] = uvs[faces].astype(np.float32).ravel()
    corners.update()
    return made


def round_shape(shape):
    """A sphere or a disk: Mitsuba has those of radius 1."""
    linear = shape['matrix'][:3, :3]
    scale = np.sqrt(np.linalg.det(linear @ linear.T) ** (1 / 3))
    if not np.allclose(linear @ linear.T, scale ** 2 * np.eye(3), rtol=1e-4, atol=1e-5 * scale ** 2):
        raise ValueError('an ellipsoid or an ellipse is not read')
    at = shape['matrix'] @ [0, 0, shape['height'], 1]
    if shape['kind'] == 'sphere':
        return dict(type='sphere', center=list(shape['matrix'][:3, 3]), radius=float(shape['radius'] * scale), flip_normals=shape['flip'])
    axis = linear[:, 2] / scale * (-1 if shape['flip'] else 1)
    side = np.cross(axis, [1, 0, 0] if abs(axis[0]) < 0.7 else [0, 1, 0])
    side *= shape['radius'] * scale / np.linalg.norm(side)
    matrix = np.eye(4)
    matrix[:3] = np.stack([side, np.cross(axis, side), axis, at[:3]], 1)
    return dict(type='disk', to_world=T(matrix))


def converted(reader):
    """Mitsuba's scene; whether its image is mirrored; its lights."""
    parts, bsdfs, kinds = dict(type='scene'), {}, {}
    groups = {}
    for count, shape in enumerate(reader.shapes):
        key = id(shape['material'])
        if key not in bsdfs:
            bsdfs[key] = mi.load_dict(surface(reader, shape['material']))
        bsdf, emits = bsdfs[key], shape['radiance'] is not None
        emitter = dict(type='area', radiance=rgb(shape['radiance'])) if emits else None
        if emits:
            kinds[shape['kind']] = kinds.get(shape['kind'], 0) + 1
        if shape['kind'] in ('sphere', 'disk'):
            parts[f'shape{count}'] = {**round_shape(shape), 'bsdf': bsdf, **(dict(emitter=emitter) if emits else {})}
            continue
        linear, faces, normals = shape['matrix'][:3, :3], shape['faces'], shape.get('normals')
        points = shape['points'] @ linear.T + shape['matrix'][:3, 3]
        normals = None if normals is None else normals @ np.linalg.inv(linear)
        if emits:
            # the lit side is that of the normals of the file, or else where counterclockwise corners show before the matrix, unless reversed
            a, b, c = (points[faces[:, k]] for k in range(3))
            lit = np.cross(b - a, c - a) * np.sign(np.linalg.det(linear))
            if normals is not None:
                lit *= np.sign(np.sum(lit * normals[faces[:, 0]], 1))[:, None]
            lit *= -1 if shape['flip'] else 1
            turn = np.sum(lit * np.cross(b - a, c - a), 1) < 0
            faces = np.where(turn[:, None], faces[:, ::-1], faces)
            parts[f'shape{count}'] = mesh(points, faces, None, shape.get('uvs'), bsdf, mi.load_dict(emitter))
            continue
        textured = 'texture' in str(shape['material'][1].get('reflectance'))
        uvs = shape.get('uvs') if textured else None
        if textured and uvs is None:
            raise ValueError('a mesh without texture coordinates has a texture')
        groups.setdefault((key, normals is not None), []).append((points, faces, normals, uvs))
    for (key, smooth), meshes in groups.items():
        firsts = np.cumsum([0] + [len(points) for points, *_ in meshes])
        faces = np.concatenate([faces + first for (_, faces, _, _), first in zip(meshes, firsts)])
        columns = [np.concatenate([m[k] for m in meshes]) if meshes[0][k] is not None else None for k in (0, 2, 3)]
        parts[f'group{len(parts)}'] = mesh(columns[0], faces, *columns[1:], bsdfs[key], None)
    for count, light in enumerate(reader.lights):
        kinds[light['kind']] = kinds.get(light['kind'], 0) + 1
        towards = light['target'] - light['origin']
        if light['kind'] == 'point':
            made = dict(type='point', position=list(light['origin']), intensity=rgb(light['colour']))
        elif light['kind'] == 'distant':
            made = dict(type='directional', direction=list(towards), irradiance=rgb(light['colour']))
        elif light['kind'] == 'infinite':
            made = dict(type='constant', radiance=rgb(light['colour']))
        elif light['kind'] == 'spot':
            whole, edge = light['degrees']
            made = dict(type='pbrt_spot', inner=float(np.cos(np.radians(whole - edge))), outer=float(np.cos(np.radians(whole))))
            for name, values in (('place', light['origin']), ('axis', towards / np.linalg.norm(towards)), ('colour', light['colour'])):
                made.update({f'{name}{k}': float(values[k]) for k in range(3)})
        else:
            raise ValueError(f'a light "{light["kind"]}" is not read')
        parts[f'light{count}'] = made
    camera = reader.camera / np.append(np.linalg.norm(reader.camera[:3, :3], axis=0), 1)
    # x of Mitsuba's cameras points to the left; they have no mirrored ones
    mirrored = np.linalg.det(camera[:3, :3]) > 0
    if not mirrored:
        camera = camera @ np.diag([-1, 1, 1, 1])
    width, height = (max(1, round(OPTIONS.side * side / max(reader.size))) for side in reader.size)
    film = dict(type='hdrfilm', width=width, height=height, rfilter=dict(type='box'), pixel_format='rgb', component_format='float32')
    parts['sensor'] = dict(type='perspective', fov=reader.fov, fov_axis='smaller', near_clip=1e-4, far_clip=1e7, film=film, to_world=T(camera),
                           sampler=dict(type='independent'))
    return mi.load_dict(parts), mirrored, kinds, (width, height)


def ours(path, size, seed, folder):
    out = os.path.join(folder, 'ours.exr')
    command = [OPTIONS.etendue, 'render', path, '-o', out, '--size', f'{size[0]}x{size[1]}', '--spp', str(OPTIONS.spp), '--threads', '1', '--seed',
               str(seed), '--technique', OPTIONS.technique]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise ValueError(done.stderr.strip().splitlines()[-1])
    channels = OpenEXR.File(out, separate_channels=True).channels()
    return np.stack([channels[name].pixels for name in 'RGB'], -1).astype(np.float64)


def moments(images, used):
    """Mean of the images, the variance of that mean in each pixel, and the mean of the used pixels with its variance."""
    images = np.stack(images).mean(-1)
    means = images[:, used].mean(1)
    return images.mean(0), images.var(0, ddof=1) / len(images), means.mean(), means.var(ddof=1) / len(images)


def seen(scene, images, mirrored):
    """The pixels that show lamps, and their neighbours: lamps smaller than pixels would have most of the noise."""
    hidden = mi.load_dict(dict(type='direct', hide_emitters=True))
    shown = np.array(mi.render(scene, integrator=hidden, spp=OPTIONS.peer, seed=100), dtype=np.float64)
    shown = np.any(~np.isclose(shown, images[0][:, ::-1] if mirrored else images[0], rtol=1e-3), -1)
    shown = np.pad(shown[:, ::-1] if mirrored else shown, 1)
    height, width = shown.shape
    return np.any([shown[y:height - 2 + y, x:width - 2 + x] for y in range(3) for x in range(3)], 0)


def compare(path, folder):
    reader = Reader(path, not OPTIONS.uncoated)
    scene, mirrored, kinds, size = converted(reader)
    copied = os.path.join(folder, 'scene')
    path = reader.copy(copied) if any(source.edits for source in reader.sources) else path
    integrator = mi.load_dict(dict(type='direct'))
    peers = []
    for seed in range(PARTS):
        image = np.array(mi.render(scene, integrator=integrator, spp=OPTIONS.peer, seed=100 + seed), dtype=np.float64)
        peers.append(image[:, ::-1] if mirrored else image)
    own = [ours(path, size, seed, folder) for seed in range(PARTS)]
    whole = np.ones(size[::-1], bool)
    rows = []
    for used in (~seen(scene, peers, mirrored), whole):
        a, b = moments(own, used), moments(peers, used)
        if b[2] == 0:
            raise ValueError(f'black in Mitsuba; mean of ours {a[2]:.4g}')
        ratio = a[2] / b[2]
        rows.append(f'{ratio:.4f} ± {ratio * np.sqrt(a[3] / a[2] ** 2 + b[3] / b[2] ** 2):.4f}')
    if OPTIONS.keep:
        os.makedirs(OPTIONS.keep, exist_ok=True)
        np.savez(os.path.join(OPTIONS.keep, os.path.basename(path)), ours=np.mean(own, 0), mitsuba=np.mean(peers, 0), variances=[a[1], b[1]])
    apart = np.mean((abs(a[0] - b[0]) > 4 * np.sqrt(a[1] + b[1])) & (abs(a[0] - b[0]) > 0.01 * b[2]))
    lights = ', '.join(f'{count} {kind}' for kind, count in kinds.items())
    return f'{lights} | {a[2]:.5g} | {b[2]:.5g} | {rows[0]} | {rows[1]} | {100 * apart:.2f} % | {"; ".join(sorted(reader.notes))}'


def main():
    left = []
    print('| file | lights | mean | of Mitsuba | ratio where no lamp is seen | of all | pixels apart | replaced in both |')
    print('|---|---|---|---|---|---|---|---|')
    for path in scenes(OPTIONS.folders):
        if OPTIONS.only not in path or not path.endswith('.pbrt'):
            continue
        name = os.path.join(os.path.basename(os.path.dirname(path)), os.path.basename(path))
        with tempfile.TemporaryDirectory() as folder:
            try:
                print(f'| {name} | {compare(path, folder)} |', flush=True)
            except (ValueError, KeyError, OSError) as error:
                left.append(f'{name}: {error}')
    print()
    for line in left:
        print(line)


if __name__ == '__main__':
    main()
