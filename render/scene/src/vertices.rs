//! Vertices of meshes in world space.

/// A corner of a triangle in world space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub(super) point: [f64; 3],
    /// Normal of length 1; 0 if there is none.
    pub(super) normal: [f64; 3],
    /// Texture coordinates.
    pub(super) uv: [f64; 2],
}

/// The vertices of a mesh. Normals and texture coordinates are as many as points, or none.
#[derive(Debug)]
pub(super) struct Vertices {
    pub(super) points: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    uvs: Vec<[f64; 2]>,
    /// Colours by which materials are multiplied.
    pub(super) colors: Vec<[f32; 3]>,
}

impl Vertices {
    /// Vertices at these points, with normals of length 1 or 0. Texture coordinates that are not finite become 0.
    pub(super) fn new(points: Vec<[f64; 3]>, normals: Vec<[f64; 3]>, mut uvs: Vec<[f64; 2]>) -> Self {
        let faulty = uvs.iter_mut().filter(|uv| !uv.iter().all(|x| x.is_finite()));
        faulty.for_each(|uv| *uv = [0.0; 2]);
        Self { points, normals, uvs, colors: Vec::new() }
    }

    /// The normal of a vertex; 0 if the mesh has none.
    #[inline]
    pub(super) fn normal(&self, vertex: usize) -> [f64; 3] {
        if self.normals.is_empty() { [0.0; 3] } else { self.normals[vertex] }
    }

    /// The texture coordinates of a vertex, or these if the mesh has none.
    #[inline]
    pub(super) fn uv(&self, vertex: usize, without: [f64; 2]) -> [f64; 2] {
        if self.uvs.is_empty() { without } else { self.uvs[vertex] }
    }

    /// The corners of a face, with these texture coordinates if the mesh has none.
    pub(super) fn corners<const N: usize>(&self, face: [usize; N], without: &[[f64; 2]; N]) -> [Vertex; N] {
        std::array::from_fn(|k| Vertex {
            point: self.points[face[k]],
            normal: self.normal(face[k]),
            uv: self.uv(face[k], without[k]),
        })
    }
}
