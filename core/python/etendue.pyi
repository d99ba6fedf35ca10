"""Light sampling: maps of random numbers to directions, their densities and inverses, over numpy arrays of single precision."""

from collections.abc import Sequence as _Sequence
from typing import Final, Literal, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_F32 = NDArray[np.float32]
_Field = Literal["direction", "distance", "pdf", "weight", "normal", "uv", "emits"]
_Fields = _Field | _Sequence[_Field]

__all__ = [
    "Bilinear",
    "Cone",
    "GgxVisibleNormals",
    "ImageEnvironment",
    "Independent",
    "JointSobol",
    "LightTree",
    "NO_LIGHT",
    "OwenSobol",
    "PatchSurface",
    "Picture",
    "Pictured",
    "Portal",
    "PortalEnvironment",
    "Reflection",
    "Sampler",
    "Samples",
    "Sequence",
    "Stratified",
    "Warp",
    "__version__",
    "level",
    # names of warps from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
    "ConcentricDisk",
    "UniformHemisphere",
    "UniformSphere",
    "CosineHemisphere",
    "Octahedral",
    "AreaTriangle",
    "LowDistortionTriangle",
    # names of warps end of what is from the list
    # lights from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
    "Sphere",
    "Triangle",
    "Parallelogram",
    "Rectangle",
    "Disk",
    "Polygon",
    "BilinearPatch",
    "Line",
    "Sun",
    "PointLight",
    "SpotLight",
    "DirectionalLight",
    # lights end of what is from the list
]

__version__: Final[str]
NO_LIGHT: Final[int]

def level() -> Literal["v4", "v3", "build"]: ...

@final
class Samples:
    @property
    def direction(self) -> _F32: ...
    @property
    def distance(self) -> _F32: ...
    @property
    def pdf(self) -> _F32: ...
    @property
    def weight(self) -> _F32: ...
    @property
    def normal(self) -> _F32: ...
    @property
    def uv(self) -> _F32: ...
    @property
    def emits(self) -> NDArray[np.bool_]: ...

@final
class Sampler:
    def sample(self, u: ArrayLike, *, fields: _Fields | None = None, out: Samples | None = None) -> Samples: ...
    def hit(self, w: ArrayLike, *, fields: _Fields | None = None, out: Samples | None = None) -> Samples: ...
    def pdf(self, w: ArrayLike, *, out: _F32 | None = None) -> _F32: ...
    def pdf_of_hit(self, w: ArrayLike, *, out: _F32 | None = None) -> _F32: ...
    def invert(self, w: ArrayLike, *, out: _F32 | None = None) -> _F32: ...
    @property
    def area(self) -> float: ...
    @property
    def solid_angle(self) -> float: ...
    @property
    def projected_solid_angle(self) -> float: ...
    @property
    def angle(self) -> float: ...

# from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
@final
class Sphere:
    def __new__(cls, center: ArrayLike, radius: ArrayLike) -> Sphere: ...
    def by_area(self, p: ArrayLike) -> Sampler: ...
    def by_solid_angle(self, p: ArrayLike) -> Sampler: ...
    def by_projected_solid_angle(self, p: ArrayLike, n: ArrayLike) -> Sampler: ...
    def by_reflection(self, p: ArrayLike, reflection: Reflection) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        center: ArrayLike,
        radius: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        center: ArrayLike,
        radius: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        center: ArrayLike,
        radius: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        center: ArrayLike,
        radius: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class Triangle:
    def __new__(cls, v0: ArrayLike, v1: ArrayLike, v2: ArrayLike) -> Triangle: ...
    def by_area(self, p: ArrayLike) -> Sampler: ...
    def by_solid_angle(self, p: ArrayLike) -> Sampler: ...
    def by_projected_solid_angle(self, p: ArrayLike, n: ArrayLike) -> Sampler: ...
    def by_reflection(self, p: ArrayLike, reflection: Reflection) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        v0: ArrayLike,
        v1: ArrayLike,
        v2: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        v0: ArrayLike,
        v1: ArrayLike,
        v2: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        v0: ArrayLike,
        v1: ArrayLike,
        v2: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        v0: ArrayLike,
        v1: ArrayLike,
        v2: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class Parallelogram:
    def __new__(cls, corner: ArrayLike, edge_s: ArrayLike, edge_t: ArrayLike) -> Parallelogram: ...
    def by_area(self, p: ArrayLike) -> Sampler: ...
    def by_solid_angle(self, p: ArrayLike) -> Sampler: ...
    def by_projected_solid_angle(self, p: ArrayLike, n: ArrayLike) -> Sampler: ...
    def by_reflection(self, p: ArrayLike, reflection: Reflection) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class Rectangle:
    def __new__(cls, corner: ArrayLike, edge_s: ArrayLike, edge_t: ArrayLike) -> Rectangle: ...
    def by_area(self, p: ArrayLike) -> Sampler: ...
    def by_solid_angle(self, p: ArrayLike) -> Sampler: ...
    def by_projected_solid_angle(self, p: ArrayLike, n: ArrayLike) -> Sampler: ...
    def by_reflection(self, p: ArrayLike, reflection: Reflection) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class Disk:
    def __new__(cls, center: ArrayLike, normal: ArrayLike, radius: ArrayLike) -> Disk: ...
    def by_area(self, p: ArrayLike) -> Sampler: ...
    def by_solid_angle(self, p: ArrayLike) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        center: ArrayLike,
        normal: ArrayLike,
        radius: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        center: ArrayLike,
        normal: ArrayLike,
        radius: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        center: ArrayLike,
        normal: ArrayLike,
        radius: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        center: ArrayLike,
        normal: ArrayLike,
        radius: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class Polygon:
    def __new__(cls, corners: ArrayLike) -> Polygon: ...
    def by_area(self, p: ArrayLike) -> Sampler: ...
    def by_solid_angle(self, p: ArrayLike) -> Sampler: ...
    def by_projected_solid_angle(self, p: ArrayLike, n: ArrayLike) -> Sampler: ...
    def by_reflection(self, p: ArrayLike, reflection: Reflection) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        corners: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        corners: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        corners: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        corners: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area", "solid_angle", "projected_solid_angle", "reflection"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class BilinearPatch:
    def __new__(cls, corner: ArrayLike, edge_s: ArrayLike, edge_t: ArrayLike, diagonal: ArrayLike) -> BilinearPatch: ...
    def by_area(self, p: ArrayLike) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        diagonal: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area"] = "area",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        diagonal: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area"] = "area",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        diagonal: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area"] = "area",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        corner: ArrayLike,
        edge_s: ArrayLike,
        edge_t: ArrayLike,
        diagonal: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["area"] = "area",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class Line:
    def __new__(cls, start: ArrayLike, edge: ArrayLike) -> Line: ...
    def by_length(self, p: ArrayLike) -> Sampler: ...
    def by_angle(self, p: ArrayLike) -> Sampler: ...
    def by_projected_solid_angle(self, p: ArrayLike, n: ArrayLike) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        start: ArrayLike,
        edge: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["length", "angle", "projected_solid_angle"] = "angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        start: ArrayLike,
        edge: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["length", "angle", "projected_solid_angle"] = "angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        start: ArrayLike,
        edge: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["length", "angle", "projected_solid_angle"] = "angle",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        start: ArrayLike,
        edge: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["length", "angle", "projected_solid_angle"] = "angle",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class Sun:
    def __new__(cls, direction: ArrayLike, one_minus_cos: ArrayLike) -> Sun: ...
    def by_solid_angle(self) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        direction: ArrayLike,
        one_minus_cos: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["solid_angle"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        direction: ArrayLike,
        one_minus_cos: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["solid_angle"] = "solid_angle",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        direction: ArrayLike,
        one_minus_cos: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["solid_angle"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        direction: ArrayLike,
        one_minus_cos: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["solid_angle"] = "solid_angle",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class PointLight:
    def __new__(cls, position: ArrayLike) -> PointLight: ...
    def by_delta(self, p: ArrayLike) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        position: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        position: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        position: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        position: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class SpotLight:
    def __new__(cls, position: ArrayLike, axis: ArrayLike, one_minus_cos_inner: ArrayLike, one_minus_cos_outer: ArrayLike) -> SpotLight: ...
    def by_delta(self, p: ArrayLike) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        position: ArrayLike,
        axis: ArrayLike,
        one_minus_cos_inner: ArrayLike,
        one_minus_cos_outer: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        position: ArrayLike,
        axis: ArrayLike,
        one_minus_cos_inner: ArrayLike,
        one_minus_cos_outer: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        position: ArrayLike,
        axis: ArrayLike,
        one_minus_cos_inner: ArrayLike,
        one_minus_cos_outer: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        position: ArrayLike,
        axis: ArrayLike,
        one_minus_cos_inner: ArrayLike,
        one_minus_cos_outer: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class DirectionalLight:
    def __new__(cls, direction: ArrayLike) -> DirectionalLight: ...
    def by_delta(self) -> Sampler: ...
    def on_surface(self, p: ArrayLike) -> bool: ...
    @staticmethod
    def sample_each(
        direction: ArrayLike,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def hit_each(
        direction: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    @staticmethod
    def pdf_each(
        direction: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        out: _F32 | None = None,
    ) -> _F32: ...
    @staticmethod
    def invert_each(
        direction: ArrayLike,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        alpha: ArrayLike | None = None,
        view: ArrayLike | None = None,
        by: Literal["delta"] = "delta",
        out: _F32 | None = None,
    ) -> _F32: ...

# end of what is from the list

class Warp:
    def sample(self, u: ArrayLike) -> _F32: ...
    def pdf(self, x: ArrayLike) -> _F32: ...
    def invert(self, x: ArrayLike) -> _F32: ...

# warps from the list of techniques: WRITE=1 cargo test -p etendue-tests bindings
@final
class ConcentricDisk(Warp):
    def __new__(cls) -> ConcentricDisk: ...

@final
class UniformHemisphere(Warp):
    def __new__(cls) -> UniformHemisphere: ...

@final
class UniformSphere(Warp):
    def __new__(cls) -> UniformSphere: ...

@final
class CosineHemisphere(Warp):
    def __new__(cls) -> CosineHemisphere: ...

@final
class Octahedral(Warp):
    def __new__(cls) -> Octahedral: ...

@final
class AreaTriangle(Warp):
    def __new__(cls) -> AreaTriangle: ...

@final
class LowDistortionTriangle(Warp):
    def __new__(cls) -> LowDistortionTriangle: ...

# warps end of what is from the list

@final
class Cone(Warp):
    def __new__(cls, one_minus_cos: ArrayLike) -> Cone: ...

@final
class Bilinear(Warp):
    def __new__(cls, corners: ArrayLike) -> Bilinear: ...

@final
class GgxVisibleNormals(Warp):
    def __new__(cls, alpha_x: ArrayLike, alpha_y: ArrayLike, wi: ArrayLike) -> GgxVisibleNormals: ...

@final
class Reflection(Warp):
    def __new__(cls, alpha: ArrayLike, n: ArrayLike, view: ArrayLike) -> Reflection: ...
    @property
    def albedo(self) -> float: ...
    @property
    def schlick(self) -> float: ...
    def sphere(self, center: ArrayLike, radius: ArrayLike) -> _F32: ...
    @staticmethod
    def albedo_and_schlick_each(alpha: ArrayLike, n: ArrayLike, view: ArrayLike) -> tuple[_F32, _F32]: ...

@final
class PatchSurface(Warp):
    def __new__(cls, corner: ArrayLike, edge_s: ArrayLike, edge_t: ArrayLike, diagonal: ArrayLike) -> PatchSurface: ...

class Sequence:
    def pairs(self, count: int, *, pixel: ArrayLike | None = None, dimension: int = 0, first: int = 0) -> _F32: ...

@final
class Independent(Sequence):
    def __new__(cls, seed: int = 0) -> Independent: ...

@final
class OwenSobol(Sequence):
    def __new__(cls, seed: int = 0) -> OwenSobol: ...

@final
class JointSobol(Sequence):
    def __new__(cls, seed: int = 0) -> JointSobol: ...

@final
class Stratified(Sequence):
    def __new__(cls, seed: int, count: int) -> Stratified: ...

@final
class ImageEnvironment:
    def __new__(cls, weights: ArrayLike, map: Literal["equirectangular", "equal-area"] = "equirectangular") -> ImageEnvironment: ...
    def by_radiance(self) -> Sampler: ...

@final
class LightTree:
    def __new__(
        cls,
        center: ArrayLike,
        radius: ArrayLike,
        normal: ArrayLike | None = None,
        cos_cone: ArrayLike | None = None,
        two_sided: ArrayLike | None = None,
        power: ArrayLike | None = None,
    ) -> LightTree: ...
    def choose(self, p: ArrayLike, n: ArrayLike, u: ArrayLike) -> tuple[NDArray[np.uint32], _F32, _F32]: ...
    def pmf(self, p: ArrayLike, n: ArrayLike, light: ArrayLike) -> _F32: ...
    def __len__(self) -> int: ...

@final
class Picture:
    def __new__(cls, weights: ArrayLike, region: Literal["square", "triangle", "disk"] = "square") -> Picture: ...
    @staticmethod
    def interpolated(values: ArrayLike) -> Picture: ...
    def on(self, light: Rectangle | Parallelogram | Triangle | Disk | Sphere) -> Pictured: ...

_ByPicture = Literal["area", "solid_angle", "projected_solid_angle", "visible_area"]

@final
class Pictured:
    def by_area(self, p: ArrayLike) -> Sampler: ...
    def by_solid_angle(self, p: ArrayLike) -> Sampler: ...
    def by_projected_solid_angle(self, p: ArrayLike, n: ArrayLike) -> Sampler: ...
    def by_visible_area(self, p: ArrayLike) -> Sampler: ...
    def sample_each(
        self,
        *,
        p: ArrayLike,
        u: ArrayLike,
        n: ArrayLike | None = None,
        by: _ByPicture | None = None,
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    def hit_each(
        self,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        by: _ByPicture | None = None,
        fields: _Fields | None = None,
        out: Samples | None = None,
    ) -> Samples: ...
    def pdf_each(
        self,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        by: _ByPicture | None = None,
        out: _F32 | None = None,
    ) -> _F32: ...
    def invert_each(
        self,
        *,
        p: ArrayLike,
        w: ArrayLike,
        n: ArrayLike | None = None,
        by: _ByPicture | None = None,
        out: _F32 | None = None,
    ) -> _F32: ...

@final
class Portal:
    def __new__(cls, corner: ArrayLike, edge_s: ArrayLike, edge_t: ArrayLike) -> Portal: ...
    def direction(self, uv: ArrayLike) -> tuple[_F32, _F32]: ...

@final
class PortalEnvironment:
    def __new__(cls, portals: _Sequence[Portal], weights: _Sequence[ArrayLike]) -> PortalEnvironment: ...
    def by_radiance(self, p: ArrayLike) -> Sampler: ...
    def sample_each(self, *, p: ArrayLike, u: ArrayLike, fields: _Fields | None = None, out: Samples | None = None) -> Samples: ...
    def hit_each(self, *, p: ArrayLike, w: ArrayLike, fields: _Fields | None = None, out: Samples | None = None) -> Samples: ...
    def pdf_each(self, *, p: ArrayLike, w: ArrayLike, out: _F32 | None = None) -> _F32: ...
    def invert_each(self, *, p: ArrayLike, w: ArrayLike, out: _F32 | None = None) -> _F32: ...
    def sees(self, p: ArrayLike, w: ArrayLike) -> NDArray[np.bool_]: ...

