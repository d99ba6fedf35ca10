"""Emitters that Mitsuba 3 lacks, as plugins in Python that it compiles: a panel with a spread, a luminaire of an IES file, and pbrt's spot light.

They are what a user of Mitsuba would write: the panel is sampled by its shape's own method, and the intensity of the luminaire is one
look-up in a texture. Set a variant before this is imported.
"""
import math

import drjit as dr
import mitsuba as mi


class Spread(mi.Emitter):
    """An area light of grey radiance `radiance` · (tan σ − tan θ)/(tan σ − σ), for angles θ to the normal below σ, half of `spread`."""

    def __init__(self, props):
        super().__init__(props)
        half = math.radians(props['spread']) / 2
        self.tangent, self.radiance = math.tan(half), props['radiance'] / (math.tan(half) - half)
        self.m_flags = mi.EmitterFlags.Surface

    def emitted(self, cos, active):
        tangent = dr.safe_sqrt(1 - cos * cos) / cos
        return mi.Spectrum(dr.select(active & (cos > 0), self.radiance * dr.maximum(self.tangent - tangent, 0), 0))

    def eval(self, si, active=True):
        return self.emitted(mi.Frame3f.cos_theta(si.wi), active)

    def sample_direction(self, it, sample, active=True):
        ds = self.get_shape().sample_direction(it, sample, active)
        active = mi.Bool(active) & (ds.pdf != 0)
        ds.emitter = mi.EmitterPtr(self)
        return ds, self.emitted(-dr.dot(ds.d, ds.n), active) / dr.select(active, ds.pdf, 1)

    def pdf_direction(self, it, ds, active=True):
        return dr.select(dr.dot(ds.d, ds.n) < 0, self.get_shape().pdf_direction(it, ds, active), 0)

    def eval_direction(self, it, ds, active=True):
        return self.emitted(-dr.dot(ds.d, ds.n), active)

    def to_string(self):
        return f'Spread[tangent = {self.tangent}]'


class Punctual(mi.Emitter):
    """A light at the point `place`, whose intensity in a direction is `intensity(w)`."""

    def __init__(self, props, place):
        super().__init__(props)
        self.place = mi.ScalarPoint3f(*place)
        self.m_flags = mi.EmitterFlags.DeltaPosition

    def eval(self, si, active=True):
        return mi.Spectrum(0)

    def sample_direction(self, it, sample, active=True):
        ds = dr.zeros(mi.DirectionSample3f)
        ds.p, ds.time, ds.pdf, ds.delta = mi.Point3f(self.place), it.time, 1, True
        ds.emitter = mi.EmitterPtr(self)
        ds.d = ds.p - it.p
        ds.dist = dr.norm(ds.d)
        ds.d /= ds.dist
        return ds, self.eval_direction(it, ds, active)

    def pdf_direction(self, it, ds, active=True):
        return mi.Float(0)

    def eval_direction(self, it, ds, active=True):
        return dr.select(active, mi.Spectrum(self.intensity(-ds.d) / dr.square(ds.dist)), 0)

    def bbox(self):
        return mi.ScalarBoundingBox3f(self.place, self.place)

    def to_string(self):
        return f'{type(self).__name__}[{self.place}]'


class Spot(Punctual):
    """pbrt's: between both cosines its intensity is a smoothstep of the cosine, where Mitsuba's is linear in the angle."""

    def __init__(self, props):
        place, self.axis, self.colour = ([props[name + axis] for axis in '012'] for name in ['place', 'axis', 'colour'])
        super().__init__(props, place)
        self.inner, self.outer = props['inner'], props['outer']

    def intensity(self, w):
        cosine = dr.dot(mi.Vector3f(self.axis), w)
        t = dr.clip((cosine - self.outer) / (self.inner - self.outer), 0, 1)
        return mi.Color3f(self.colour) * (t * t * (3 - 2 * t))


class Luminaire(Punctual):
    """A point light at `x`, `y`, `z` of the intensity in the tensor `table`, by steps of the same size from the nadir to the zenith in its
    rows, and around −z from +x in its columns, of which the last is the first once more. It is bilinear between these."""

    def __init__(self, props):
        super().__init__(props, [props['x'], props['y'], props['z']])
        table = props['table']
        self.size = table.shape[:2]
        self.table = mi.Texture2f(table, wrap_mode=dr.WrapMode.Clamp)

    def intensity(self, w):
        rows, columns = self.size
        polar = dr.safe_acos(-w.z) * ((rows - 1) / math.pi)
        turn = dr.atan2(-w.y, w.x) * (1 / (2 * math.pi))
        turn = (turn - dr.floor(turn)) * (columns - 1)
        return self.table.eval(mi.Point2f((turn + 0.5) / columns, (polar + 0.5) / rows))[0]


mi.register_emitter('pbrt_spot', Spot)
mi.register_emitter('spread', Spread)
mi.register_emitter('luminaire', Luminaire)
