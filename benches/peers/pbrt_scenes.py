"""Reads scenes of pbrt 4 as people publish them: transforms, included files, named materials, textures of images, meshes, spheres, disks,
area lights, point, spot and distant lights, and constant skies. What a renderer of another kind cannot share becomes something simpler, in a copy
of the files as in what is returned, and is noted. Whatever else these files say is an error."""
import gzip
import os
import re

import numpy as np

TOKEN = re.compile(r'#[^\n]*|"[^"]*"|[\[\]]|[^\s\[\]"]+')
GREY = dict(reflectance=('rgb', [0.5] * 3))
# indices of red, green and blue light
METALS = {'Ag': ([0.155, 0.117, 0.138], [4.83, 3.12, 2.15]), 'Au': ([0.143, 0.375, 1.442], [3.98, 2.39, 1.60]),
          'Cu': ([0.200, 0.924, 1.102], [3.91, 2.45, 2.14]), 'Al': ([1.66, 0.88, 0.52], [9.22, 6.27, 4.84])}
OPTIONS = ['Film', 'Sampler', 'PixelFilter', 'Integrator', 'Accelerator', 'MakeNamedMedium']


class Source:
    """One file: its tokens and where they are, and what is to be written in the place of some."""

    def __init__(self, path):
        with open(path, encoding='utf-8') as file:
            self.text = file.read()
        self.path, self.at, self.edits = path, 0, []
        self.found = [match for match in TOKEN.finditer(self.text) if match[0][0] != '#']

    def next(self):
        self.at += 1
        return self.found[self.at - 1][0]

    def numbers(self, count):
        words = []
        while len(words) < count:
            word = self.next()
            words += [] if word in '[]' else [float(word)]
        if self.at < len(self.found) and self.found[self.at][0] == ']':
            self.at += 1
        return words

    def name(self):
        return self.next().strip('"')

    def parameters(self):
        """Types and lists by names."""
        values = {}
        while self.at < len(self.found) and self.found[self.at][0].startswith('"'):
            kind, name = self.name().split()
            value = [self.next()]
            if value == ['[']:
                value = []
                while self.found[self.at][0] != ']':
                    value.append(self.next())
                self.next()
            values[name] = (kind, [v.strip('"') if v[0] in '"tf' else float(v) for v in value])
        return values

    def edit(self, first, text):
        """Writes the text in the place of all tokens from the first one on that have been read."""
        self.edits.append((self.found[first].start(), self.found[self.at - 1].end(), text))

    def edited(self):
        text = self.text
        for start, end, new in reversed(self.edits):
            text = text[:start] + new + text[end:]
        return text


def written(values):
    def one(value):
        return f'"{value}"' if isinstance(value, str) and value not in ('true', 'false') else str(value)
    return ' '.join(f'"{kind} {name}" [ {" ".join(map(one, value))} ]' for name, (kind, value) in values.items())


def look_at(numbers):
    """Of the camera space, which is left-handed."""
    origin, target, up = np.array(numbers).reshape(3, 3)
    ahead = (target - origin) / np.linalg.norm(target - origin)
    right = np.cross(up, ahead)
    right /= np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3] = np.stack([right, np.cross(ahead, right), ahead, origin], 1)
    return np.linalg.inv(matrix)


def rotation(degrees, *axis):
    axis = np.array(axis) / np.linalg.norm(axis)
    sin, cos = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    cross = np.cross(np.eye(3), axis)
    matrix = np.eye(4)
    matrix[:3, :3] = cos * np.eye(3) + sin * cross + (1 - cos) * np.outer(axis, axis)
    return matrix


def translation(*by):
    matrix = np.eye(4)
    matrix[:3, 3] = by
    return matrix


def read_ply(path):
    """Points, faces, normals and texture coordinates: the last two may be absent."""
    with (gzip.open if path.endswith('.gz') else open)(path, 'rb') as file:
        data = file.read()
    end = data.index(b'end_header')
    head, body = data[:end].decode().split('\n'), data[data.index(b'\n', end) + 1:]
    types = dict(float='f4', float32='f4', double='f8', uchar='u1', uint8='u1', char='i1', int8='i1', short='i2', ushort='u2', int='i4',
                 int32='i4', uint='u4', uint32='u4')
    order = '>' if any('binary_big' in line for line in head) else '<'
    elements = []
    for line in map(str.split, head):
        if line[:1] == ['element']:
            elements.append((line[1], int(line[2]), []))
        elif line[:1] == ['property']:
            elements[-1][2].append((line[-1], [order + types[word] for word in line[1:-1] if word in types], line[1] == 'list'))
    if any('ascii' in line for line in head):
        raise ValueError(f'{path}: a PLY file of text is not read')
    points = normals = uvs = None
    faces, at = [], 0
    for name, count, properties in elements:
        if name == 'vertex':
            rows = np.frombuffer(body, np.dtype([(p, kinds[0]) for p, kinds, _ in properties]), count, at)
            at += rows.nbytes
            def columns(*names):
                return np.stack([rows[n] for n in names], 1).astype(float) if set(names) <= set(rows.dtype.names) else None
            points, normals = columns('x', 'y', 'z'), columns('nx', 'ny', 'nz')
            uvs = columns('u', 'v') if 'u' in rows.dtype.names else columns('s', 't')
            continue
        for _ in range(count):
            for p, kinds, is_list in properties:
                size = 1
                if is_list:
                    size, at = int(np.frombuffer(body, kinds[0], 1, at)[0]), at + np.dtype(kinds[0]).itemsize
                corners = np.frombuffer(body, kinds[-1], size, at)
                at += corners.nbytes
                if is_list and name == 'face' and 'vert' in p:
                    faces += [[corners[0], corners[k], corners[k + 1]] for k in range(1, size - 1)]
    return points, np.array(faces, int).reshape(-1, 3), normals, uvs


class Reader:
    """The camera of a scene as a matrix from its space, whose x points to the right of the image and z ahead, `fov`, the `size` of the film;
    `shapes`, each with `matrix`, `flip`, `material` and `radiance`; and `lights`. Without `coats`, what is below them is bare."""

    def __init__(self, path, coats=True):
        self.coats = coats
        self.folder, self.sources = os.path.dirname(path), []
        self.shapes, self.lights, self.notes = [], [], set()
        self.named, self.textures, self.objects, self.systems = {}, {}, {}, {}
        self.into, self.saved = None, []
        self.state = dict(matrix=np.eye(4), material=('diffuse', GREY, None), radiance=None, flip=False)
        self.read(path)

    def read(self, path):
        source = Source(path)
        self.sources.append(source)
        while source.at < len(source.found):
            self.source, self.first = source, source.at
            word = source.next()
            if hasattr(self, 'read_' + word):
                getattr(self, 'read_' + word)(source)
            elif word in OPTIONS:
                name, values = source.name(), source.parameters()
                if word == 'Film':
                    self.size = [int(values[side][1][0]) for side in ('xresolution', 'yresolution')]
                    if {'cropwindow', 'pixelbounds'} & set(values):
                        raise self.error('a film that is cropped is not read')
            else:
                raise self.error(f'{word} is not read')

    def error(self, message):
        line = self.source.text.count('\n', 0, self.source.found[self.first].start()) + 1
        return ValueError(f'{os.path.basename(self.source.path)}:{line}: {message}')

    def move(self, matrix):
        self.state['matrix'] = self.state['matrix'] @ matrix

    def read_LookAt(self, source):
        self.move(look_at(source.numbers(9)))

    def read_Translate(self, source):
        self.move(translation(*source.numbers(3)))

    def read_Scale(self, source):
        self.move(np.diag(source.numbers(3) + [1.0]))

    def read_Rotate(self, source):
        self.move(rotation(*source.numbers(4)))

    def read_Transform(self, source):
        self.state['matrix'] = np.array(source.numbers(16)).reshape(4, 4).T

    def read_ConcatTransform(self, source):
        self.move(np.array(source.numbers(16)).reshape(4, 4).T)

    def read_Identity(self, source):
        self.state['matrix'] = np.eye(4)

    def read_CoordSysTransform(self, source):
        self.state['matrix'] = self.systems[source.name()]

    def read_ReverseOrientation(self, source):
        self.state['flip'] = not self.state['flip']

    def read_Camera(self, source):
        kind, values = source.name(), source.parameters()
        if kind != 'perspective' or set(values) - {'fov', 'shutteropen', 'shutterclose'}:
            raise self.error(f'a camera "{kind}" with {", ".join(values)} is not read')
        self.fov = values['fov'][1][0] if 'fov' in values else 90.0
        self.camera = self.systems['camera'] = np.linalg.inv(self.state['matrix'])

    def read_WorldBegin(self, source):
        self.state['matrix'] = np.eye(4)

    def read_AttributeBegin(self, source):
        self.saved.append(dict(self.state))

    def read_AttributeEnd(self, source):
        self.state = self.saved.pop()

    read_TransformBegin = read_AttributeBegin

    def read_TransformEnd(self, source):
        self.state['matrix'] = self.saved.pop()['matrix']

    def read_ObjectBegin(self, source):
        self.read_AttributeBegin(source)
        self.into = self.objects[source.name()] = []

    def read_ObjectEnd(self, source):
        self.into = None
        self.read_AttributeEnd(source)

    def read_ObjectInstance(self, source):
        for shape in self.objects[source.name()]:
            self.shapes.append({**shape, 'matrix': self.state['matrix'] @ shape['matrix'], 'radiance': None})

    def read_Include(self, source):
        self.read(os.path.join(self.folder, source.name()))

    def read_MediumInterface(self, source):
        self.notes.add('no media')
        source.name()
        if source.found[source.at][0].startswith('"'):
            source.name()

    def read_Texture(self, source):
        name, kind, texture, values = source.name(), source.name(), source.name(), source.parameters()
        self.textures[name] = (texture, values)
        if texture == 'imagemap' and not os.path.exists(os.path.join(self.folder, values['filename'][1][0])):
            value = '"rgb value" [ 0.5 0.5 0.5 ]' if kind == 'spectrum' else '"float value" [ 0.5 ]'
            source.edit(self.first, f'Texture "{name}" "{kind}" "constant" {value}')

    def read_Material(self, source):
        kind, values = source.name(), source.parameters()
        shared = self.shared(kind, values)
        if shared[2]:
            source.edit(self.first, f'Material "{shared[0]}" {written(shared[1])}')
        self.state['material'] = shared

    def read_MakeNamedMaterial(self, source):
        name, values = source.name(), source.parameters()
        kind = values.pop('type')[1][0]
        shared = self.shared(kind, values)
        if shared[2]:
            source.edit(self.first, f'MakeNamedMaterial "{name}" "string type" "{shared[0]}" {written(shared[1])}')
        self.named[name] = shared

    def read_NamedMaterial(self, source):
        self.state['material'] = self.named[source.name()]

    def picture(self, name):
        """Whether a texture is an image that is there and that both programs look up in the same way."""
        texture, values = self.textures.get(name, (None, {}))
        file = os.path.join(self.folder, values['filename'][1][0]) if texture == 'imagemap' else ''
        return set(values) <= {'filename', 'uscale', 'vscale', 'filter'} and file.endswith(('.png', '.jpg')) and os.path.exists(file)

    def shared(self, kind, values):
        """The nearest that both renderers have, and what it replaces or nothing."""
        values, notes = dict(values), []
        for name in {'displacement', 'normalmap', 'sigma'} & set(values):
            values.pop(name)
            notes.append(f'no {name}')
        if kind in ('diffuse', 'coateddiffuse'):
            given, value = values.get('reflectance', GREY['reflectance'])
            if given != 'rgb' and not (given == 'texture' and self.picture(value[0])):
                notes.append(f'{given} of a surface → grey')
                values['reflectance'] = GREY['reflectance']
            for name in {'roughness', 'uroughness', 'vroughness'} & set(values):
                if values[name][0] == 'texture':
                    values[name] = ('float', [0.1])
                    notes.append('texture of a roughness → 0.1')
            if kind == 'coateddiffuse' and not self.coats:
                kind, values = 'diffuse', {name: values[name] for name in {'reflectance'} & set(values)}
                notes.append('no coat')
        elif kind == 'conductor' and self.roughness(values)[0] > 0:
            if 'reflectance' not in values and any(values.get(name, [None])[0] != 'rgb' for name in ('eta', 'k')):
                text = str(values.get('eta', 'Cu'))
                metal = next(name for name in METALS if name in text)
                values['eta'], values['k'] = [('rgb', list(index)) for index in METALS[metal]]
                notes.append(f'spectra of {metal} → rgb')
            elif 'reflectance' in values:
                return 'diffuse', GREY, f'{kind} → grey'
        elif kind not in ('interface', '', 'none'):
            return 'diffuse', GREY, f'{"mirror" if kind == "conductor" else kind} → grey'
        return kind, values, ', '.join(notes) or None

    @staticmethod
    def roughness(values):
        """GGX's α along both axes."""
        both = [values.get(name, values.get('roughness', ('float', [0.0])))[1][0] for name in ('uroughness', 'vroughness')]
        return both if values.get('remaproughness', (0, ['true']))[1] == ['false'] else [r ** 0.5 for r in both]

    def colour(self, values, name):
        """Radiance or intensity: a spectrum becomes white in both programs."""
        if {'power', 'illuminance', 'filename', 'portal', 'mapname', 'twosided', 'spread', 'profile', 'sky'} & set(values):
            raise self.error(f'a light with {", ".join(values)} is not read')
        given, value = values.get(name, ('rgb', [1.0] * 3))
        if given not in ('rgb', 'color'):
            self.notes.add(f'{given} of a light → white')
            values[name] = ('rgb', [1.0] * 3)
        return np.array(values.get(name, ('rgb', [1.0] * 3))[1]) * values.get('scale', (0, [1.0]))[1][0], given not in ('rgb', 'color')

    def read_AreaLightSource(self, source):
        kind, values = source.name(), source.parameters()
        self.state['radiance'], changed = self.colour(values, 'L')
        if changed:
            source.edit(self.first, f'AreaLightSource "{kind}" {written(values)}')

    def read_LightSource(self, source):
        kind, values = source.name(), source.parameters()
        colour, changed = self.colour(values, 'L' if kind in ('distant', 'infinite') else 'I')
        if changed:
            source.edit(self.first, f'LightSource "{kind}" {written(values)}')
        point = lambda name, default: (self.state['matrix'] @ [*values.get(name, (0, default))[1], 1.0])[:3]
        degrees = [values.get(name, (0, [default]))[1][0] for name, default in (('coneangle', 30.0), ('conedeltaangle', 5.0))]
        self.lights.append(dict(kind=kind, colour=colour, origin=point('from', [0.0] * 3), target=point('to', [0.0, 0.0, 1.0]),
                                degrees=degrees))

    def read_Shape(self, source):
        kind, values = source.name(), source.parameters()
        if values.pop('alpha', None):
            self.notes.add('alpha of a shape → opaque')
            source.edit(self.first, f'Shape "{kind}" {written(values)}')
        if kind == 'loopsubdiv':
            kind = 'trianglemesh'
            values.pop('levels', None)
            self.notes.add('subdivision → its control mesh')
            source.edit(self.first, f'Shape "{kind}" {written(values)}')
        shape = {**self.state, 'kind': kind}
        if shape['material'][0] in ('interface', '', 'none'):
            self.notes.add('shapes without a surface')
            return
        if kind in ('sphere', 'disk'):
            if set(values) - {'radius', 'height'}:
                raise self.error(f'a {kind} with {", ".join(values)} is not read')
            shape.update(radius=values.get('radius', (0, [1.0]))[1][0], height=values.get('height', (0, [0.0]))[1][0])
        elif kind == 'plymesh':
            file = os.path.join(self.folder, values['filename'][1][0])
            shape.update(zip(['points', 'faces', 'normals', 'uvs'], read_ply(file)))
        elif kind == 'trianglemesh':
            rows = lambda name, count: np.array(values[name][1], float).reshape(-1, count) if name in values else None
            faces = rows('indices', 3) if 'indices' in values else np.array([[0, 1, 2]])
            shape.update(points=rows('P', 3), faces=faces.astype(int), normals=rows('N', 3), uvs=rows('uv', 2))
        else:
            raise self.error(f'a {kind} is not read')
        if shape['material'][2]:
            self.notes.add(shape['material'][2])
        (self.shapes if self.into is None else self.into).append(shape)

    def copy(self, folder):
        """Writes the files that are changed, beside links to the others; returns the path of the scene."""
        for root, _, names in os.walk(self.folder):
            into = os.path.join(folder, os.path.relpath(root, self.folder))
            os.makedirs(into, exist_ok=True)
            for name in names:
                os.symlink(os.path.abspath(os.path.join(root, name)), os.path.join(into, name))
        for source in self.sources:
            path = os.path.join(folder, os.path.relpath(source.path, self.folder))
            if source.edits:
                os.path.islink(path) and os.remove(path)
                with open(path, 'w', encoding='utf-8') as file:
                    file.write(source.edited())
        return os.path.join(folder, os.path.basename(self.sources[0].path))
