"""Reads scenes of pbrt 4 of the kind that this repository has: constant materials, meshes without normals, spheres, and area lights."""
import re

TOKEN = re.compile(r'#[^\n]*|"[^"]*"|[\[\]]|[^\s\[\]"]+')


def tokens(text):
    return [token for token in TOKEN.findall(text) if not token.startswith('#')]


class Reader:
    """The camera of a scene, and its shapes: dictionaries with `points` and `faces`, or `center` and `radius`, with `material`, and with
    `radiance` if they shine."""

    def __init__(self, text, path):
        self.path, self.tokens, self.at = path, tokens(text), 0
        self.shapes = []
        state = dict(material=('diffuse', {}), radiance=None, move=(0, 0, 0))
        saved = []
        while self.at < len(self.tokens):
            word = self.next()
            if word == 'LookAt':
                numbers = self.numbers(9)
                self.origin, self.target, self.up = numbers[:3], numbers[3:6], numbers[6:]
            elif word == 'Camera':
                self.fov = self.described()[1]['fov'][0]
            elif word in ['Film', 'Sampler', 'PixelFilter', 'Integrator']:
                self.described()
            elif word == 'Scale':
                # of the camera alone, whose axes are left-handed in pbrt
                if self.numbers(3) != [-1, 1, 1] or self.shapes:
                    raise self.error('Scale is read before the world only, and as -1 1 1')
            elif word == 'WorldBegin':
                pass
            elif word == 'AttributeBegin':
                saved.append(dict(state))
            elif word == 'AttributeEnd':
                state = saved.pop()
            elif word == 'Material':
                state['material'] = self.described()
            elif word == 'AreaLightSource':
                state['radiance'] = self.described()[1]['L']
            elif word == 'Translate':
                state['move'] = [a + b for a, b in zip(state['move'], self.numbers(3))]
            elif word == 'Shape':
                kind, values = self.described()
                shape = dict(material=state['material'], radiance=state['radiance'])
                if kind == 'sphere':
                    shape.update(center=state['move'], radius=values['radius'][0])
                else:
                    points = [values['P'][k:k + 3] for k in range(0, len(values['P']), 3)]
                    faces = [0, 1, 3, 0, 3, 2] if kind == 'bilinearmesh' else [int(k) for k in values['indices']]
                    shape.update(points=[[a + b for a, b in zip(p, state['move'])] for p in points],
                                 faces=[faces[k:k + 3] for k in range(0, len(faces), 3)])
                self.shapes.append(shape)
            else:
                raise self.error(f'{word} is not read')

    def error(self, message):
        return ValueError(f'{self.path}: {message}')

    def next(self):
        self.at += 1
        return self.tokens[self.at - 1]

    def numbers(self, count):
        return [float(self.next()) for _ in range(count)]

    def described(self):
        """A type and its parameters: lists of numbers, or of words."""
        kind, values = self.next().strip('"'), {}
        while self.at < len(self.tokens) and self.tokens[self.at].startswith('"'):
            name = self.next().strip('"').split()[-1]
            value = self.next()
            if value == '[':
                value = []
                while self.tokens[self.at] != ']':
                    value.append(self.next())
                self.next()
            else:
                value = [value]
            values[name] = [v.strip('"') if v.startswith('"') or v in ['true', 'false'] else float(v) for v in value]
        return kind, values
