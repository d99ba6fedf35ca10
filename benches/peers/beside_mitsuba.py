"""Compares the renderer with Mitsuba 3 on meshes with textures under ten lights and more, under lights that show pictures, a panel with a
spread, the sky through portals, and a luminaire of an IES file, and on glossy surfaces, at equal time on one core.

    pip install mitsuba numpy OpenEXR              # and LLVM, which DRJIT_LIBLLVM_PATH names
    cargo build --release
    python3 benches/peers/beside_mitsuba.py target/release/etendue FOLDER [--bunny bunny.ply] [--only pots] [--spp '']

writes scenes for both programs to FOLDER, and prints two tables: how far the means of the two programs are apart, in standard errors
of independent samples, and the error and time of each. Seconds are those of rendering alone, medians of 5. Errors are root mean squares
over the pixels, relative to the mean, of the difference from an image of ours of many samples, less the error that this image claims.
Mitsuba's is the best of four samplers and two integrators. Efficiency is 1/(error² × seconds). With an empty --spp, only means are compared:
Mitsuba compiles for minutes where there are instances. What Mitsuba lacks, it gets as the nearest that it can have: the spread and the
luminaire as emitters of `mitsuba_emitters.py`, glossy surfaces with correlated masking as those of `mitsuba_surfaces.py`, and the whole sky
for the portals.
"""
import argparse, json, math, os, statistics, subprocess, sys, time

arguments = argparse.ArgumentParser()
arguments.add_argument('binary')
arguments.add_argument('folder')
arguments.add_argument('--bunny', help='a PLY mesh of a bunny, 0.15 units high: adds the scene of twelve of them')
arguments.add_argument('--only', help='render only this scene')
arguments.add_argument('--size', type=int, default=256)
arguments.add_argument('--spp', default='16,64,256')
arguments.add_argument('--reference', type=int, default=4096, help='samples per pixel of the reference')
arguments.add_argument('--core', default='1')
OPTIONS = arguments.parse_args()
os.sched_setaffinity(0, {int(OPTIONS.core)})
SIZE = OPTIONS.size

import numpy as np
import OpenEXR  # Mitsuba's own reader waits for ever on one thread
import drjit as dr
import mitsuba as mi

mi.set_variant('llvm_ad_rgb')
mi.set_log_level(mi.LogLevel.Error)
dr.set_thread_count(1)
import mitsuba_emitters  # registers them
import mitsuba_surfaces
from pbrt_reader import Reader

T = mi.ScalarTransform4f


def write_mesh(path, points, faces, normals=None, uvs=None):
    columns, names = [points], 'xyz'
    names = ['x', 'y', 'z']
    if normals is not None:
        columns.append(normals)
        names += ['nx', 'ny', 'nz']
    if uvs is not None:
        columns.append(uvs)
        names += ['u', 'v']
    rows = np.concatenate(columns, axis=1).astype('<f4')
    lists = np.empty(len(faces), np.dtype([('n', 'u1'), ('i', '<i4', 3)]))
    lists['n'], lists['i'] = 3, faces
    header = ['ply', 'format binary_little_endian 1.0', f'element vertex {len(rows)}']
    header += [f'property float {name}' for name in names]
    header += [f'element face {len(faces)}', 'property list uchar int vertex_indices', 'end_header']
    with open(path, 'wb') as file:
        file.write(('\n'.join(header) + '\n').encode())
        file.write(rows.tobytes())
        file.write(lists.tobytes())


def grid(columns, rows):
    """(s, t) of the vertices of a grid over the unit square, and its triangles."""
    s, t = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    at = np.arange((columns + 1) * (rows + 1)).reshape(rows + 1, columns + 1)
    a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]
    faces = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]).reshape(-1, 3)
    return s.ravel(), t.ravel(), faces


def pot(kind):
    """A pot turned about the axis of z, with normals and texture coordinates."""
    s, t, faces = grid(128, 64)
    radius = 0.35 + 0.12 * np.sin(2 * math.pi * (t * (1 + kind % 3) + 0.3 * kind)) * (1 - 0.5 * t)
    slope = np.gradient(radius.reshape(65, 129), axis=0).ravel() * 64
    angle = 2 * math.pi * s
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), t], 1)
    normals = np.stack([np.cos(angle), np.sin(angle), -slope], 1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return points, faces, normals, np.stack([3 * s, t], 1)


def dunes():
    s, t, faces = grid(400, 400)
    x, y = 12 * s - 6, 12 * t - 6
    z = 0.35 * np.sin(1.3 * x + 0.7 * np.sin(y)) + 0.2 * np.cos(2.1 * y + 0.5 * x) + 0.03 * np.sin(11 * x) * np.sin(9 * y)
    return np.stack([x, y, z], 1), faces, None, np.stack([6 * s, 6 * t], 1)


def texture(path, seed):
    """Rings and stripes of a soft kind, with no texel as bright as white."""
    x, y = np.meshgrid(np.arange(512) / 512, np.arange(512) / 512)
    rings = np.sin(2 * math.pi * (5 * x + 0.3 * np.sin(2 * math.pi * (y + 0.1 * seed)))) * 0.5 + 0.5
    spots = ((np.floor(8 * x) + np.floor(8 * y)) % 2)
    rgb = np.stack([0.35 + 0.5 * rings, 0.3 + 0.4 * rings * (0.6 + 0.4 * spots), 0.25 + 0.3 * spots], -1)
    mi.Bitmap((rgb * 255).astype(np.uint8)).write(path)


def programme(size):
    """What a television shows at night: a street with lamps, a lit window and a red sign. Radiance, row by row from the top."""
    x, y = np.meshgrid((np.arange(size) + 0.5) / size, (np.arange(size) + 0.5) / size)
    rgb = np.stack([0.02 + 0.05 * (1 - y), 0.03 + 0.06 * (1 - y), 0.08 + 0.15 * (1 - y)], -1)
    for k in range(5):
        away = (x - 0.1 - 0.2 * k) ** 2 + (y - 0.35 - 0.05 * k) ** 2
        rgb += np.exp(-away / 2e-4)[..., None] * [60, 45, 20]
    rgb[(abs(x - 0.72) < 0.06) & (abs(y - 0.62) < 0.09)] = [12, 9, 4]
    rgb[(abs(x - 0.3) < 0.14) & (abs(y - 0.15) < 0.02)] = [25, 1, 1]
    return rgb.astype(np.float32)


def glass(size):
    """A stained window: panes of saturated colours between lead, with a bright sun behind some of them."""
    x, y = np.meshgrid((np.arange(size) + 0.5) / size, (np.arange(size) + 0.5) / size)
    column, row = np.floor(9 * x + 0.4 * np.sin(7 * y)), np.floor(9 * y + 0.4 * np.sin(5 * x))
    hue = np.modf(0.37 * column + 0.61 * row)[0] * 2 * math.pi
    rgb = np.stack([np.clip(0.5 + 0.6 * np.cos(hue - 2.1 * k), 0.01, 1) for k in range(3)], -1)
    sun = 1.5 + 80 * np.exp(-((x - 0.7) ** 2 + (y - 0.25) ** 2) / 4e-3)
    lead = np.minimum(np.modf(9 * x + 0.4 * np.sin(7 * y))[0], np.modf(9 * y + 0.4 * np.sin(5 * x))[0]) < 0.08
    return np.where(lead[..., None], 0, rgb * sun[..., None]).astype(np.float32)


def weather(rows):
    """A clear sky: brighter near the horizon and about a sun at 25 degrees above it, whose disk has soft edges. Below the horizon is ground."""
    polar, azimuth = np.meshgrid((np.arange(rows) + 0.5) * (math.pi / rows), (np.arange(2 * rows) + 0.5) * (math.pi / rows), indexing='ij')
    x, y, z = np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)
    high, around = math.radians(25), math.radians(-8)
    cos = x * math.cos(high) * math.cos(around) + y * math.cos(high) * math.sin(around) + z * math.sin(high)
    away = np.degrees(np.arccos(np.clip(cos, -1, 1)))
    up = np.clip(z, 0, 1)
    sky = np.stack([0.25 + 0.5 * (1 - up) ** 3, 0.45 + 0.45 * (1 - up) ** 3, 1 - 0.1 * up], -1)
    sky += (np.exp(-away / 12)[..., None] + 4000 * np.exp(-(away / 0.8) ** 2)[..., None]) * [1.0, 0.9, 0.7]
    return np.where(z[..., None] > 0, sky, 0.15 * np.array([0.5, 0.45, 0.35])).astype(np.float32)


def washer():
    """Intensities of a luminaire that lights a wall at its +x, by 5 degrees from the nadir and by 15 degrees around: candela."""
    polar, azimuth = np.meshgrid(np.radians(np.arange(0, 181, 5.0)), np.radians(np.arange(0, 361, 15.0)), indexing='ij')
    x, y, down = np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)
    aim = math.radians(55)
    lobe = np.exp(9 * (x * math.sin(aim) + down * math.cos(aim) - 1) - 1.5 * (y - 0.2) ** 2) + 0.04 * np.clip(down, 0, 1)
    return np.where(polar < math.radians(92), 30 * lobe, 0)


def boxes(path, list_of):
    """A mesh of boxes, by their least and greatest coordinates; returns the number of its triangles."""
    points, faces = [], []
    for low, high in list_of:
        corners = [[(low, high)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)]
        for quad in [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]:
            # corners of their own, since Mitsuba smooths what shares them
            first = len(points)
            points += [corners[k] for k in quad]
            faces += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    write_mesh(path, np.array(points, float), faces)
    return len(faces)


class Scene:
    """A scene for both programs. Lights are parallelograms that emit downwards, or spheres."""

    def __init__(self, name, camera, target, fov):
        self.name, self.count, self.lights = name, 0, 0
        # that our independent samples are compared by
        self.technique = 'solid-angle'
        self.integrators = {'path, depth 2': dict(type='path', max_depth=2),
                            'direct, lights only': dict(type='direct', emitter_samples=1, bsdf_samples=0)}
        self.pbrt = ['Scale -1 1 1', f'LookAt {camera[0]} {camera[1]} {camera[2]}  {target[0]} {target[1]} {target[2]}  0 0 1',
                     f'Camera "perspective" "float fov" {fov}',
                     f'Film "rgb" "integer xresolution" {SIZE} "integer yresolution" {SIZE}', 'WorldBegin']
        film = dict(type='hdrfilm', width=SIZE, height=SIZE, rfilter=dict(type='box'), pixel_format='rgb')
        sensor = dict(type='perspective', fov=fov, film=film,
                      to_world=T().look_at(origin=camera, target=target, up=[0, 0, 1]))
        self.mitsuba = dict(type='scene', sensor=sensor, integrator=dict(type='path', max_depth=2))

    def add(self, what):
        self.count += 1
        self.mitsuba[f'shape{self.count}'] = what

    def mesh(self, file, triangles, at, scale, turn, picture=None, colour=(0.6, 0.6, 0.6)):
        if picture:
            self.pbrt.append(f'Texture "{picture}" "spectrum" "imagemap" "string filename" "{picture}"')
            material = f'Material "diffuse" "texture reflectance" "{picture}"'
            # pbrt's images begin at the top, where v is 1
            reflectance = dict(type='bitmap', filename=os.path.join(OPTIONS.folder, picture), to_uv=mi.ScalarTransform3f().scale([1, -1]))
        else:
            material = f'Material "diffuse" "rgb reflectance" [{colour[0]} {colour[1]} {colour[2]}]'
            reflectance = dict(type='rgb', value=list(colour))
        self.pbrt.append(f'AttributeBegin {material} Translate {at[0]} {at[1]} {at[2]} Rotate {turn} 0 0 1 '
                         f'Scale {scale} {scale} {scale} Shape "plymesh" "string filename" "{file}" AttributeEnd')
        move = T().translate(list(at)).rotate([0, 0, 1], turn).scale(scale)
        bsdf = dict(type='twosided', bsdf=dict(type='diffuse', reflectance=reflectance))
        self.add(dict(type='ply', filename=os.path.join(OPTIONS.folder, file), to_world=move, bsdf=bsdf))
        self.triangles = getattr(self, 'triangles', 0) + triangles

    def lamp(self, corner, u, v, radiance):
        emit = f'AreaLightSource "diffuse" "rgb L" [{radiance[0]} {radiance[1]} {radiance[2]}]'
        self.rectangle(corner, u, v, emit, dict(type='area', radiance=dict(type='rgb', value=list(radiance))))

    def panel(self, corner, u, v, radiance, spread):
        """A rectangle that emits within an angle of its normal, half of `spread`."""
        emit = f'AreaLightSource "diffuse" "rgb L" [{radiance} {radiance} {radiance}] "float spread" {spread}'
        self.rectangle(corner, u, v, emit, dict(type='spread', radiance=float(radiance), spread=float(spread)))

    def sky(self, picture, portals):
        """A sky of longitude and latitude, with its first row at +z and its first column at +x, seen through portals. Texels are constant
        in ours and interpolated by Mitsuba."""
        self.write_picture('sky.exr', picture)
        numbers = ' '.join(f'{x:.9g}' for portal in portals for point in portal for x in point)
        self.pbrt.append(f'LightSource "infinite" "string filename" "sky.exr" "point3 portal" [{numbers}]')
        # Mitsuba's first column is at −z, and its columns run towards +x
        turn = T(np.array([[0, 0, -1, 0], [-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float))
        self.add(dict(type='envmap', bitmap=mi.Bitmap(np.ascontiguousarray(picture[:, ::-1])), to_world=turn))
        self.lights += 1

    def luminaire(self, at, table):
        """A luminaire of type C whose intensities are by steps of the same size, from the nadir to the zenith and all around from +x."""
        rows, columns = table.shape
        listed = lambda numbers: ' '.join(f'{x:.9g}' for x in numbers)
        lines = ['IESNA:LM-63-2002', 'TILT=NONE', f'1 -1 1 {rows} {columns} 1 2 0 0 0', '1 1 100',
                 listed(np.linspace(0, 180, rows)), listed(np.linspace(0, 360, columns))]
        with open(os.path.join(OPTIONS.folder, 'lamp.ies'), 'w') as file:
            file.write('\n'.join(lines + [listed(column) for column in table.T]) + '\n')
        # the nadir is −y of the light
        self.pbrt.append(f'AttributeBegin Translate {at[0]} {at[1]} {at[2]} Rotate 90 1 0 0 '
                         'LightSource "goniometric" "string filename" "lamp.ies" AttributeEnd')
        x, y, z = map(float, at)
        self.add(dict(type='luminaire', x=x, y=y, z=z, table=mi.TensorXf(table[..., None].astype(np.float32))))
        self.lights += 1

    def write_picture(self, file, picture):
        header = dict(compression=OpenEXR.ZIP_COMPRESSION, type=OpenEXR.scanlineimage)
        OpenEXR.File(header, dict(RGB=picture)).write(os.path.join(OPTIONS.folder, file))

    def screen(self, corner, u, v, picture):
        """A rectangle that shows an array of radiance."""
        file = f'{self.name}{self.count}.exr'
        self.write_picture(file, picture)
        # in Mitsuba, v is 0 at the first row
        bitmap = dict(type='bitmap', bitmap=mi.Bitmap(np.ascontiguousarray(picture[::-1])), raw=True, wrap_mode='clamp')
        self.rectangle(corner, u, v, f'AreaLightSource "diffuse" "string filename" "{file}"', dict(type='area', radiance=bitmap))

    def rectangle(self, corner, u, v, emit, emitter):
        p = [corner, np.add(corner, u), np.add(corner, v), np.add(np.add(corner, u), v)]
        numbers = ' '.join(f'{x:.9g}' for point in p for x in point)
        self.pbrt.append(f'AttributeBegin Material "diffuse" "rgb reflectance" [0 0 0] {emit} '
                         f'Shape "bilinearmesh" "point3 P" [{numbers}] AttributeEnd')
        matrix = np.eye(4)
        u, v = np.asarray(u, float), np.asarray(v, float)
        matrix[:3, 0], matrix[:3, 1], matrix[:3, 3] = u / 2, v / 2, np.asarray(corner) + u / 2 + v / 2
        normal = np.cross(u, v)
        matrix[:3, 2] = normal / np.linalg.norm(normal)
        self.add(dict(type='rectangle', to_world=T(matrix), bsdf=dict(type='diffuse', reflectance=dict(type='rgb', value=0.0)),
                      emitter=emitter))
        self.lights += 1

    def ball(self, center, radius, radiance):
        emit = f'AreaLightSource "diffuse" "rgb L" [{radiance[0]} {radiance[1]} {radiance[2]}]'
        self.pbrt.append(f'AttributeBegin Material "diffuse" "rgb reflectance" [0 0 0] {emit} Translate {center[0]} {center[1]} '
                         f'{center[2]} Shape "sphere" "float radius" {radius} AttributeEnd')
        self.add(dict(type='sphere', center=list(center), radius=radius,
                      bsdf=dict(type='diffuse', reflectance=dict(type='rgb', value=0.0)),
                      emitter=dict(type='area', radiance=dict(type='rgb', value=list(radiance)))))
        self.lights += 1

    def grove(self, file, picture, triangles, places):
        """Instances of a mesh with holes where the picture is black."""
        self.pbrt += [f'Texture "{picture}" "float" "imagemap" "string filename" "{picture}" "string encoding" "linear"',
                      'ObjectBegin "bush" Material "diffuse" "rgb reflectance" [.3 .6 .2]',
                      f'Shape "plymesh" "string filename" "{file}" "texture alpha" "{picture}"', 'ObjectEnd']
        opacity = dict(type='bitmap', filename=os.path.join(OPTIONS.folder, picture), raw=True,
                       to_uv=mi.ScalarTransform3f().scale([1, -1]))
        leaf = dict(type='twosided', bsdf=dict(type='diffuse', reflectance=dict(type='rgb', value=[0.3, 0.6, 0.2])))
        bsdf = dict(type='mask', opacity=opacity, bsdf=leaf)
        self.mitsuba['bush'] = dict(type='shapegroup', mesh=dict(type='ply', filename=os.path.join(OPTIONS.folder, file), bsdf=bsdf))
        for x, y, scale, turn in places:
            self.pbrt.append(f'AttributeBegin Translate {x} {y} 0 Rotate {turn} 0 0 1 Rotate 20 1 0 0 '
                             f'Scale {scale} {scale} {2 * scale} ObjectInstance "bush" AttributeEnd')
            move = T().translate([x, y, 0]).rotate([0, 0, 1], turn).rotate([1, 0, 0], 20).scale([scale, scale, 2 * scale])
            self.add(dict(type='instance', to_world=move, shapegroup=dict(type='ref', id='bush')))
        self.triangles += triangles * len(places)
        # shadow rays of other integrators stop at holes
        self.integrators = {'volpath, depth 2': dict(type='volpath', max_depth=2)}

    def read(self, path, near):
        """All of a file of pbrt, whose surfaces may be glossy, from nearer: `near` has what is replaced by what."""
        with open(path) as file:
            text = file.read()
        for old, new in near.items():
            if old not in text:
                sys.exit(f'{path} has no {old}')
            text = text.replace(old, new)
        self.pbrt = [text]
        reader = Reader(text, path)
        self.mitsuba['sensor'].update(fov=reader.fov, to_world=T().look_at(origin=reader.origin, target=reader.target, up=reader.up))
        self.triangles = 0
        for k, shape in enumerate(reader.shapes):
            kind, values = shape['material']
            colour = lambda name: values.get(name, [0.5] * 3)
            if kind == 'diffuse':
                bsdf = dict(type='diffuse', reflectance=dict(type='rgb', value=colour('reflectance')))
            else:
                coated = kind == 'coateddiffuse'
                red, green, blue = colour('reflectance')
                bsdf = dict(type='glossy', alpha=values['roughness'][0], coated=False, specular=red,
                            red=red, green=green, blue=blue)
                if coated:
                    bsdf = dict(type='roughplastic', distribution='ggx', alpha=values['roughness'][0], int_ior=1.5, ext_ior=1.0,
                                nonlinear=True, diffuse_reflectance=dict(type='rgb', value=[red, green, blue]))
            made = dict(bsdf=dict(type='twosided', bsdf=bsdf))
            if shape['radiance']:
                made['emitter'] = dict(type='area', radiance=dict(type='rgb', value=shape['radiance']))
                self.lights += 1
            if 'radius' in shape:
                made.update(type='sphere', center=shape['center'], radius=shape['radius'])
            else:
                faces, points = np.array(shape['faces']), np.array(shape['points'])
                path = os.path.join(OPTIONS.folder, f'{self.name}{k}.ply')
                # corners of their own, since Mitsuba smooths what shares them
                write_mesh(path, points[faces.ravel()], np.arange(faces.size).reshape(-1, 3))
                made.update(type='ply', filename=path)
                self.triangles += len(faces)
            self.add(made)
        # samples of the lights alone would miss the lobes
        self.integrators = {'path, depth 2': dict(type='path', max_depth=2), 'direct': dict(type='direct')}
        self.technique = 'auto'

    def write(self):
        path = os.path.join(OPTIONS.folder, self.name + '.pbrt')
        with open(path, 'w') as file:
            file.write('\n'.join(self.pbrt) + '\n')
        return path


def floor(scene, half, picture=None):
    points = np.array([[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]], float)
    uvs = np.array([[0, 0], [half, 0], [half, half], [0, half]], float)
    write_mesh(os.path.join(OPTIONS.folder, f'floor{half}.ply'), points, [[0, 1, 2], [0, 2, 3]], None, uvs)
    scene.mesh(f'floor{half}.ply', 2, (0, 0, 0), 1, 0, picture, (0.7, 0.7, 0.7))


def lamps(scene, rows, columns, height, size, strength):
    for i in range(rows):
        for j in range(columns):
            at = (3.0 * (i - (rows - 1) / 2), 2.2 * (j - (columns - 1) / 2), height + 0.3 * ((i + 2 * j) % 3))
            grow = size * (0.5 + 0.25 * ((3 * i + j) % 4))
            hue = [strength * (1 + 0.5 * math.cos(2.1 * k + i + j)) / grow ** 2 for k in range(3)]
            # the second edge points backwards, so that the normal points down
            scene.lamp(at, (grow, 0, 0), (0, -grow, 0.2 * grow), hue)


def scenes():
    for k in range(2):
        texture(os.path.join(OPTIONS.folder, f'rings{k}.png'), k)
    if OPTIONS.bunny:
        mesh = mi.load_dict(dict(type='ply', filename=OPTIONS.bunny))
        points = np.array(mesh.vertex_positions_buffer()).reshape(-1, 3)[:, [0, 2, 1]] * [1, -1, 1]
        faces = np.array(mesh.faces_buffer()).reshape(-1, 3)
        low, high = points.min(0), points.max(0)
        points = (points - [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]]) / (high[2] - low[2])
        normals = np.zeros_like(points)
        for corner in range(3):
            a, b, c = (points[faces[:, k]] for k in range(3))
            np.add.at(normals, faces[:, corner], np.cross(b - a, c - a))
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        write_mesh(os.path.join(OPTIONS.folder, 'bunny.ply'), points, faces, normals)
        scene = Scene('bunnies', (0, -7, 4), (0, 0, 0.4), 42)
        floor(scene, 20)
        for k in range(12):
            scene.mesh('bunny.ply', len(faces), (1.5 * (k % 4) - 2.25, 1.5 * (k // 4) - 1.5, 0), 1, 37 * k)
        lamps(scene, 2, 5, 3.0, 0.8, 40.0)
        yield scene
    scene = Scene('pots', (0, -7, 4), (0, 0, 0.4), 42)
    floor(scene, 20, 'rings0.png')
    for k in range(4):
        points, faces, normals, uvs = pot(k)
        write_mesh(os.path.join(OPTIONS.folder, f'pot{k}.ply'), points, faces, normals, uvs)
    for k in range(20):
        at = (1.2 * (k % 5) - 2.4, 1.1 * (k // 5) - 1.6, 0)
        scene.mesh(f'pot{k % 4}.ply', len(faces), at, 0.9, 50 * k, 'rings1.png' if k % 3 else None)
    lamps(scene, 2, 5, 3.0, 0.8, 40.0)
    yield scene
    scene = Scene('dunes', (0, -8, 4), (0, 0, 0), 45)
    points, faces, normals, uvs = dunes()
    write_mesh(os.path.join(OPTIONS.folder, 'dunes.ply'), points, faces, normals, uvs)
    scene.mesh('dunes.ply', len(faces), (0, 0, 0), 1, 0, 'rings0.png')
    lamps(scene, 2, 5, 2.0, 0.7, 1.0)
    for k in range(4):
        scene.ball((2.4 * k - 3.6, 1.0 - (k % 2) * 3, 0.9), 0.12, (30, 25, 20))
    yield scene
    yield grove()
    scene = Scene('television', (2.4, 1.2, 1.9), (-1.6, -1.4, 0.4), 60)
    # a room, a table and a couch before the television, which is on the wall behind the camera's left
    room = [((-3, -3, -0.1), (3, 3, 0)), ((-3.1, -3, 0), (-3, 3, 2.6)), ((-3, -3.1, 0), (3, -3, 2.6)), ((-3, 2, 0), (3, 2.1, 2.6)),
            ((-0.6, -0.6, 0.4), (0.6, 0, 0.45)), ((-0.55, -0.55, 0), (-0.5, -0.5, 0.4)), ((0.5, -0.55, 0), (0.55, -0.5, 0.4)),
            ((-1.2, -2.2, 0), (1.2, -1.4, 0.4)), ((-1.2, -2.5, 0), (1.2, -2.2, 0.9)), ((-1.4, -2.5, 0), (-1.2, -1.4, 0.6))]
    count = boxes(os.path.join(OPTIONS.folder, 'room.ply'), room)
    scene.mesh('room.ply', count, (0, 0, 0), 1, 0)
    scene.screen((-0.8, 1.95, 0.7), (1.6, 0, 0), (0, 0, 0.9), programme(128))
    yield scene
    scene = Scene('window', (-2.6, -2.4, 1.8), (1.2, 1.0, 0.6), 60)
    hall = [((-3, -3, -0.1), (3, 3, 0)), ((3, -3, 0), (3.1, 3, 4)), ((-3, 3, 0), (3, 3.1, 4)), ((0.4, -0.2, 0), (0.8, 0.2, 1.2)),
            ((-1.5, 1, 0), (1.5, 1.3, 0.45)), ((-1.5, 1.3, 0), (1.5, 1.36, 0.9)), ((1.6, -1.8, 0), (2, -1.4, 2.5))]
    count = boxes(os.path.join(OPTIONS.folder, 'hall.ply'), hall)
    scene.mesh('hall.ply', count, (0, 0, 0), 1, 0)
    scene.screen((1.2, -2.95, 1), (-2.4, 0, 0), (0, 0, 2.6), glass(256))
    yield scene
    scene = Scene('spread', (0.6, -5.2, 2.4), (0, 0, 0.5), 45)
    tables = [((-4, -4, -0.1), (4, 4, 0)), ((-4, 2.5, 0), (4, 2.6, 4)), ((-0.5, -0.5, 0), (0.5, 0.5, 0.7)), ((-1.6, -0.4, 0), (-1, 0.2, 1.2)),
              ((0.9, 0.2, 0), (1.5, 0.8, 0.4))]
    count = boxes(os.path.join(OPTIONS.folder, 'tables.ply'), tables)
    scene.mesh('tables.ply', count, (0, 0, 0), 1, 0)
    # above the edges of the image; the second edge points backwards, so that the normal points down
    scene.panel((-1, 0.8, 3), (2, 0, 0), (0, -1.6, 0), 4.0, 20)
    yield scene
    scene = Scene('portals', (1.5, -1.6, 1.6), (-1, 0.5, 0.9), 75)
    windows = [(-1.6, -0.9, 0.8, 2.2), (-0.4, 0.4, 0.9, 2.0), (0.9, 1.5, 0.3, 2.4)]
    room = [((-2, -2, -0.1), (2, 2, 0)), ((-2, -2, 3), (2, 2, 3.1)), ((-2.1, -2, 0), (-2, 2, 3)), ((-2, -2.1, 0), (2, -2, 3)),
            ((-2, 2, 0), (2, 2.1, 3)), ((-0.8, -0.3, 0), (0.1, 0.5, 0.6))]
    ends = [-2] + [y for window in windows for y in window[:2]] + [2]
    room += [((2, low, 0), (2.001, high, 3)) for low, high in zip(ends[::2], ends[1::2])]
    room += [((2, y0, 0), (2.001, y1, z0)) for y0, y1, z0, _ in windows] + [((2, y0, z1), (2.001, y1, 3)) for y0, y1, _, z1 in windows]
    count = boxes(os.path.join(OPTIONS.folder, 'portals.ply'), room)
    scene.mesh('portals.ply', count, (0, 0, 0), 1, 0)
    # the sky is where (p3 − p0) × (p1 − p0) points to
    scene.sky(weather(1024), [[(2, y0, z0), (2, y0, z1), (2, y1, z1), (2, y1, z0)] for y0, y1, z0, z1 in windows])
    yield scene
    scene = Scene('washer', (-2.6, -1.2, 1.7), (1.5, 0.3, 1.1), 70)
    gallery = [((-3, -3, -0.1), (2, 3, 0)), ((2, -3, 0), (2.1, 3, 3)), ((-3, 3, 0), (2, 3.1, 3)), ((1.5, -0.9, 0), (1.8, -0.6, 1.1)),
               ((1.93, 0.3, 1), (2, 1.3, 1.9)), ((0.2, 0.6, 0), (0.9, 1.3, 0.45))]
    count = boxes(os.path.join(OPTIONS.folder, 'gallery.ply'), gallery)
    scene.mesh('gallery.ply', count, (0, 0, 0), 1, 0)
    scene.luminaire((1.1, 0.1, 2.9), washer())
    yield scene
    render = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../render')
    # so that no light is in the image: most of the noise would be that of its edges
    plates = {'LookAt 0 3.2 12.5   0 -0.75 0': 'LookAt 0 3.2 12.5   0 -1.9 2.3', 'fov" 34': 'fov" 17'}
    room = {'LookAt 0 3 9   0 0.3 0': 'LookAt 0 3 9   0 0 2.2', 'fov" 40': 'fov" 27'}
    for file, near in [('scenes/plates', plates), ('gallery/glossy/floor', room), ('gallery/glossy/varnish', room)]:
        scene = Scene(os.path.basename(file), (0, 0, 1), (0, 1, 0), 40)
        scene.read(os.path.join(render, file + '.pbrt'), near)
        yield scene


def grove():
    random = np.random.default_rng(5)
    points, uvs = [], []
    count = 10000
    for _ in range(count):
        middle, u, v = random.normal(size=(3, 3))
        middle = middle * [0.15, 0.15, 0.1] + [0, 0, 0.3]
        u, v = 0.015 * u / np.linalg.norm(u), 0.015 * v / np.linalg.norm(v)
        points += [middle - u - v, middle + u - v, middle + u + v, middle - u + v]
        uvs += [[0, 0], [1, 0], [1, 1], [0, 1]]
    faces = np.concatenate([[[4 * k, 4 * k + 1, 4 * k + 2], [4 * k, 4 * k + 2, 4 * k + 3]] for k in range(count)])
    write_mesh(os.path.join(OPTIONS.folder, 'bush.ply'), np.array(points), faces, None, np.array(uvs))
    x, y = np.meshgrid(np.arange(64) / 63 - 0.5, np.arange(64) / 63 - 0.5)
    # partly transparent at the rim
    opacity = np.clip(4 * (0.5 - np.sqrt(x * x + 3 * y * y)), 0, 1)
    mi.Bitmap((opacity * 255).astype(np.uint8)[..., None].repeat(3, 2)).write(os.path.join(OPTIONS.folder, 'leaf.png'))
    scene = Scene('grove', (0, -7, 4), (0, 0, 0.4), 42)
    floor(scene, 20, 'rings0.png')
    # few, since Mitsuba compiles code for each; but too many triangles to be copied
    places = [(6 * a - 3, 4 * b - 2, 0.6 + 0.6 * c, 360 * d) for a, b, c, d in random.random((60, 4))]
    scene.grove('bush.ply', 'leaf.png', len(faces), places)
    lamps(scene, 2, 5, 3.0, 0.8, 40.0)
    return scene


def mitsuba_image(scene, spp, sampler, integrator, seed):
    """An image and the seconds that it took."""
    made = mi.load_dict(dict(type=sampler, sample_count=spp))
    sensor = scene.sensors()[0]
    sensor.set_sampler(made) if hasattr(sensor, 'set_sampler') else None
    start = time.perf_counter()
    image = mi.render(scene, sensor=sensor, integrator=integrator, spp=spp, seed=seed)
    dr.eval(image)
    dr.sync_thread()
    return np.array(image), time.perf_counter() - start


def moments(images):
    """Mean of images of independent seeds, and the variance of that mean."""
    images = np.stack(images)
    return images.mean(0), images.var(0, ddof=1) / len(images)


def ours(path, spp, seed, repeat, technique='auto', sampler=None):
    out = os.path.join(OPTIONS.folder, 'ours.exr')
    command = [OPTIONS.binary, 'render', path, '-o', out, '--size', f'{SIZE}x{SIZE}', '--spp', str(spp), '--threads', '1',
               '--seed', str(seed), '--repeat', str(repeat), '--technique', technique, '--json']
    command += ['--sampler', sampler] if sampler else []
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    said = json.loads(done.stdout)
    channels = OpenEXR.File(out, separate_channels=True).channels()
    image = np.stack([channels[name].pixels for name in 'RGB'], -1).astype(np.float64)
    return image, said


def main():
    os.makedirs(OPTIONS.folder, exist_ok=True)
    table = []
    print('| scene | triangles | lights | samples of the references | greatest abs z of the 3 means | pixels of abs z > 4 |')
    print('|---|---|---|---|---|---|')
    for scene in scenes():
        if OPTIONS.only and scene.name != OPTIONS.only:
            continue
        path = scene.write()
        loaded = {s: mi.load_dict({**scene.mitsuba, 'sensor': {**scene.mitsuba['sensor'], 'sampler': dict(type=s)}})
                  for s in ['independent', 'multijitter', 'ldsampler', 'orthogonal']}
        integrators = {name: mi.load_dict(integrator) for name, integrator in scene.integrators.items()}
        parts, each = 16, max(OPTIONS.reference // 16, 1)
        direct = list(integrators.values())[-1]
        reference, variance = moments([mitsuba_image(loaded['independent'], each, 'independent', direct, 100 + k)[0]
                                       for k in range(parts)])
        # another technique with independent samples, for which the standard error is plain
        own, own_variance = moments([ours(path, each, 200 + k, 1, scene.technique, 'independent')[0] for k in range(parts)])
        spread = np.sqrt(variance.mean((0, 1)) + own_variance.mean((0, 1))) / SIZE
        z = (own.mean((0, 1)) - reference.mean((0, 1))) / spread
        pixels = (own - reference) / np.sqrt(variance + own_variance + 1e-20)
        many = np.mean(np.abs(pixels) > 4)
        print(f'| {scene.name} | {scene.triangles:,} | {scene.lights} | {parts * each} each | {np.abs(z).max():.2f} | {many:.5f} |', flush=True)
        # the one with the least noise
        truth, said = ours(path, OPTIONS.reference, 99, 1)
        noise, level = (said['error'] * truth.mean()) ** 2, truth.mean()
        mse = lambda image: float(((image - truth) ** 2).mean() - noise)
        for spp in map(int, filter(None, OPTIONS.spp.split(','))):
            image, said = ours(path, spp, 1, 5)
            error, seconds = [mse(image)], statistics.median(said['seconds']['render'])
            error += [mse(ours(path, spp, seed, 1)[0]) for seed in [2, 3]]
            error, best = float(np.mean(error)), None
            for sampler in ['multijitter', 'ldsampler', 'orthogonal', 'independent']:
                for name, integrator in integrators.items():
                    mitsuba_image(loaded[sampler], spp, sampler, integrator, 1)
                    runs = [mitsuba_image(loaded[sampler], spp, sampler, integrator, 2 + k) for k in range(5)]
                    error_of = float(np.mean([mse(image) for image, _ in runs]))
                    took = statistics.median(t for _, t in runs)
                    if best is None or error_of * took < best[0] * best[1]:
                        best = (error_of, took, f'{sampler}, {name}')
            table.append((scene.name, spp, seconds, error, best, level))
    print('\n| scene | samples | ours: seconds | error | Mitsuba: seconds | error | by | efficiency, ours over Mitsuba\'s |')
    print('|---|---|---|---|---|---|---|---|')
    for name, spp, seconds, error, (other, took, by), level in table:
        percent = lambda mse: f'{100 * math.sqrt(max(mse, 0)) / level:.3f} %'
        ratio = other * took / (error * seconds)
        print(f'| {name} | {spp} | {seconds:.2f} | {percent(error)} | {took:.2f} | {percent(other)} | {by} | {ratio:.1f} |')


main()
