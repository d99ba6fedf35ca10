//! Loop's subdivision: points of the limit surface by hand and its normals.

use crate::pbrt::text::{read, warnings};
use etendue_render::scene::Scene;

const OCTAHEDRON: &str = "\"point3 P\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1]
    \"integer indices\" [0 2 4  2 1 4  1 3 4  3 0 4  2 0 5  1 2 5  3 1 5  0 3 5]";

fn scene(shape: &str) -> String {
    format!("Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n{shape}")
}

fn divided(mesh: &str, levels: u32) -> Scene {
    read(&scene(&format!("Shape \"loopsubdiv\" {mesh} \"integer levels\" {levels}")))
}

/// The normal at a corner that is near to this point.
fn normal_at(scene: &Scene, point: [f32; 3]) -> Option<[f32; 3]> {
    let near = |p: &[f32; 3]| (0..3).all(|k| (p[k] - point[k]).abs() < 1e-6);
    let (triangle, corner) = (0..).zip(&scene.triangles).find_map(|(k, of)| Some((k, of.iter().position(near)?)))?;
    let flat = [0.0; 3];
    Some(scene.details.of(triangle).map_or(flat, |corners| corners.normals[corner]))
}

/// A vertex of valence 4 ends half as far from its opposite one, and the middle of an edge, of valence 6, at 29/96 of both ends, whatever the
/// number of levels. Normals point outwards.
#[test]
fn an_octahedron_ends_on_its_limit_surface() {
    for levels in 0..4 {
        let scene = divided(OCTAHEDRON, levels);
        assert_eq!(scene.triangles.len(), 8 << (2 * levels));
        for (point, normal) in [([0.5, 0.0, 0.0], [1.0, 0.0, 0.0]), ([0.0, 0.0, -0.5], [0.0, 0.0, -1.0])] {
            let found = normal_at(&scene, point).unwrap_or_else(|| panic!("{levels}: no corner at {point:?}"));
            assert!((0..3).all(|k| (found[k] - normal[k]).abs() < 1e-6), "{levels}: {found:?} at {point:?}");
        }
        let (middle, half) = (29.0 / 96.0, std::f32::consts::FRAC_1_SQRT_2);
        let found = normal_at(&scene, [middle, 0.0, -middle]);
        assert_eq!(found.is_some(), levels > 0, "{levels}");
        if let Some(found) = found {
            assert!((found[0] - half).abs() < 1e-6 && (found[2] + half).abs() < 1e-6, "{levels}: {found:?}");
        }
    }
    assert!(warnings(&divided(OCTAHEDRON, 3)).is_empty());
    // as many levels as pbrt has, and the older name
    let same = |text: &str| read(&scene(&format!("Shape \"loopsubdiv\" {OCTAHEDRON} {text}"))).triangles;
    assert_eq!(same(""), divided(OCTAHEDRON, 3).triangles);
    assert_eq!(same("\"integer nlevels\" 2"), divided(OCTAHEDRON, 2).triangles);
}

/// Boundaries are cubic B-splines: a corner between two others ends at 2/3 of itself and 1/6 of both. In a plane all normals are the plane's,
/// which needs vertices of two to five neighbours at the boundary.
#[test]
fn boundaries_are_splines() {
    let fan = "\"point3 P\" [0 0 0 3 0 0 2 2 0 0 3 0 -2 2 0 -3 0 0] \"integer indices\" [0 1 2 0 2 3 0 3 4 0 4 5]";
    for levels in 0..3 {
        let flat = divided(fan, levels);
        for (point, what) in [([2.0 * 2.0 / 3.0 + 0.5, 4.0 / 3.0 + 0.5, 0.0], "between two"), ([0.0; 3], "the middle")]
        {
            assert!(normal_at(&flat, point).is_some(), "{levels}: {what}");
        }
        // flat triangles have no normals of their own
        assert!(flat.details.of_triangles.is_empty());
    }
    // a boundary that rises: normals there lean against it, to the side of the faces' order
    let bent = fan.replace("2 2 0 0 3 0 -2 2 0", "2 2 .5 0 3 1 -2 2 .5");
    for levels in 0..3 {
        let scene = divided(&bent, levels);
        let normals: Vec<_> = scene.details.corners.iter().flat_map(|corners| corners.normals).collect();
        assert!(normals.len() == 12 << (2 * levels) && normals.iter().all(|n| n[2] > 0.8 && n[1] < 0.0), "{normals:?}");
    }
    // and a mirror turns them over, as it does the faces
    let mirrored = scene(&format!("Scale 1 1 -1 Shape \"loopsubdiv\" {bent}"));
    let corners = &read(&mirrored).details.corners;
    assert!(corners.iter().flat_map(|corners| corners.normals).all(|n| n[2].abs() > 0.8 && n[1] * n[2] > 0.0));
}

/// A vertex of no face stays, and is no fault.
#[test]
fn vertices_without_faces_stay() {
    let lonely = "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1 -1 0 0] \"integer indices\" [0 1 2]";
    assert_eq!(divided(lonely, 2).triangles.len(), 16);
}
