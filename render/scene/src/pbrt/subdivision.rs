//! Loop's subdivision surfaces.

use crate::transform::{add, cross, scaled, sub, unit};
use std::collections::HashMap;

/// Most triangles that a mesh may have in the end.
const MOST: usize = 1 << 26;

/// Points, faces, and normals at the points on the side of the faces' order, of length 1 or 0.
pub(super) type Smooth = (Vec<[f64; 3]>, Vec<[usize; 3]>, Vec<[f64; 3]>);

/// What surrounds the vertices of a mesh.
struct Rings {
    /// The neighbours of each vertex.
    neighbors: Vec<Vec<usize>>,
    /// The two neighbours along the border of each vertex that is on it.
    border: Vec<Option<[usize; 2]>>,
}

fn edges(face: [usize; 3]) -> [[usize; 2]; 3] {
    let [a, b, c] = face;
    [[a, b], [b, c], [c, a]]
}
fn key([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// The corner of each face opposite to an edge.
fn opposite(faces: &[[usize; 3]]) -> Result<HashMap<[usize; 2], Vec<usize>>, String> {
    let mut map: HashMap<_, Vec<usize>> = HashMap::new();
    for face in faces {
        for (k, edge) in edges(*face).into_iter().enumerate() {
            if edge[0] == edge[1] {
                return Err("a face has the same vertex twice".to_owned());
            }
            map.entry(key(edge)).or_default().push(face[(k + 2) % 3]);
        }
    }
    match map.values().find(|of| of.len() > 2) {
        Some(of) => Err(format!("{} faces share an edge: a surface has at most two", of.len())),
        None => Ok(map),
    }
}

fn rings(count: usize, opposite: &HashMap<[usize; 2], Vec<usize>>) -> Rings {
    let (mut neighbors, mut border) = (vec![Vec::new(); count], vec![Vec::new(); count]);
    let mut sorted: Vec<_> = opposite.iter().collect();
    sorted.sort_unstable_by_key(|(edge, _)| **edge);
    for (&[a, b], of) in sorted {
        for [from, to] in [[a, b], [b, a]] {
            neighbors[from].push(to);
            if of.len() == 1 {
                border[from].push(to);
            }
        }
    }
    let border = border.into_iter().map(|of| of.try_into().ok()).collect();
    Rings { neighbors, border }
}

fn sum(points: &[[f64; 3]], of: impl IntoIterator<Item = usize>) -> [f64; 3] {
    of.into_iter().fold([0.0; 3], |sum, i| add(sum, points[i]))
}

/// Warren's weight of each of n neighbours.
fn beta(n: usize) -> f64 {
    if n == 3 { 3.0 / 16.0 } else { 3.0 / (8.0 * n as f64) }
}

/// Subdivides a mesh `levels` times, and moves its points to the limit surface.
///
/// Formula: Loop 1987, with Warren's weights; the limit by γ = 1/(n + 3/(8β)) (PBR 3rd ed., 3.8). Normals are the sums of the limit
/// faces' around a point, weighted by area. Fails if more than two faces share an edge, or for more than 2²⁶ triangles.
pub(super) fn smooth(mut points: Vec<[f64; 3]>, mut faces: Vec<[usize; 3]>, levels: usize) -> Result<Smooth, String> {
    let final_count = faces.len().checked_mul(1 << (2 * levels)).filter(|&count| count <= MOST);
    final_count.ok_or_else(|| format!("{levels} levels of {} triangles: more than 2^26", faces.len()))?;
    for _ in 0..levels {
        let opposite = opposite(&faces)?;
        let Rings { neighbors, border } = rings(points.len(), &opposite);
        let count = points.len();
        let mut next: Vec<_> = (0..count)
            .map(|i| match (border[i], neighbors[i].len()) {
                (_, 0) => points[i],
                (Some(ends), _) => add(scaled(points[i], 0.75), scaled(sum(&points, ends), 0.125)),
                (None, n) => {
                    let beta = beta(n);
                    let around = sum(&points, neighbors[i].iter().copied());
                    add(scaled(points[i], 1.0 - n as f64 * beta), scaled(around, beta))
                }
            })
            .collect();
        let mut middles = HashMap::new();
        let mut middle = |edge: [usize; 2]| {
            *middles.entry(key(edge)).or_insert_with(|| {
                let ends = sum(&points, edge);
                let of = &opposite[&key(edge)];
                let point = match of[..] {
                    [a, b] => add(scaled(ends, 3.0 / 8.0), scaled(sum(&points, [a, b]), 1.0 / 8.0)),
                    _ => scaled(ends, 0.5),
                };
                next.push(point);
                next.len() - 1
            })
        };
        let mut parts = Vec::with_capacity(4 * faces.len());
        for face in &faces {
            let [a, b, c] = *face;
            let [ab, bc, ca] = edges(*face).map(&mut middle);
            parts.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        (points, faces) = (next, parts);
    }
    let Rings { neighbors, border } = rings(points.len(), &opposite(&faces)?);
    let limit: Vec<_> = (0..points.len())
        .map(|i| match (border[i], neighbors[i].len()) {
            (_, 0) => points[i],
            (Some(ends), _) => add(scaled(points[i], 3.0 / 5.0), scaled(sum(&points, ends), 1.0 / 5.0)),
            (None, n) => {
                let gamma = 1.0 / (n as f64 + 3.0 / (8.0 * beta(n)));
                let around = sum(&points, neighbors[i].iter().copied());
                add(scaled(points[i], 1.0 - n as f64 * gamma), scaled(around, gamma))
            }
        })
        .collect();
    let mut normals = vec![[0.0; 3]; limit.len()];
    for face in &faces {
        let [a, b, c] = face.map(|i| limit[i]);
        let normal = cross(sub(b, a), sub(c, a));
        face.iter().for_each(|&i| normals[i] = add(normals[i], normal));
    }
    normals.iter_mut().for_each(|n| *n = unit(*n).unwrap_or([0.0; 3]));
    Ok((limit, faces, normals))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transform::{dot, length};

    #[test]
    fn an_octahedron_becomes_round() {
        let points: Vec<_> =
            (0..3).flat_map(|k| [1.0, -1.0].map(|x| std::array::from_fn(|j| if j == k { x } else { 0.0 }))).collect();
        let mut faces = Vec::new();
        for (x, y, z) in (0..8).map(|i| (i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2 & 1))) {
            let even = (x + y + z) % 2 == 0;
            faces.push(if even { [x, y, z] } else { [x, z, y] });
        }
        let (points, faces, normals) = smooth(points, faces, 4).unwrap();
        assert_eq!((faces.len(), points.len()), (2048, 1026));
        let radii: Vec<_> = points.iter().map(|&p| length(p)).collect();
        let [least, most] = [radii.iter().copied().fold(9.0, f64::min), radii.iter().copied().fold(0.0, f64::max)];
        // by γ = 1/8 for four neighbours, which sum to 0
        assert!((most - 0.5).abs() < 1e-12 && least > 0.4, "{least} {most}");
        for (p, n) in points.iter().zip(&normals) {
            assert!(dot(*p, *n) > 0.95 * length(*p) * length(*n));
        }
        // the border of a single triangle stays in its plane, and no face is turned
        let flat = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let (points, faces, normals) = smooth(flat, vec![[0, 1, 2]], 3).unwrap();
        assert_eq!(faces.len(), 64);
        assert!(points.iter().all(|p| p[2] == 0.0) && normals.iter().all(|n| n[2] > 0.0));
    }

    #[test]
    fn meshes_that_are_no_surfaces_are_refused() {
        let points = vec![[0.0; 3]; 6];
        let three = smooth(points.clone(), vec![[0, 1, 2], [0, 1, 3], [1, 0, 4]], 1).unwrap_err();
        assert!(three.contains("3 faces share an edge"), "{three}");
        assert!(smooth(points, vec![[0, 0, 2]], 1).unwrap_err().contains("same vertex"));
        assert!(smooth(vec![[0.0; 3]; 3], vec![[0, 1, 2]; 65], 10).unwrap_err().contains("more than 2^26"));
    }
}
