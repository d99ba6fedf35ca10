//! Whether any surface is on the side from which a portal shows the sky.

use super::params::Params;
use etendue::light::Portal;
use etendue::{Mask, Vec3};
use etendue_render::geometry::bounds_of;
use etendue_render::scene::{Message, Scene};

/// What to say of a portal that no surface can see.
pub(super) fn faces_away(params: &Params) -> Message {
    params.error(
        "\"portal\": no surface is on the side from which it shows the sky; list its corners the other way round",
    )
}

/// Whether some surface sees each of the portals.
///
/// # Errors
/// The message of a portal that faces away from all surfaces.
pub(super) fn check(scene: &Scene, portals: Vec<(Portal, Message)>) -> Result<(), Message> {
    let own = scene.objects.first().map_or(scene.triangles.len(), |range| range.start);
    let objects: Vec<_> =
        scene.objects.iter().map(|range| bounds_of(scene.triangles[range.clone()].as_flattened())).collect();
    for (portal, message) in portals {
        let faces = |p: [f32; 3]| portal.faces(Vec3::<f32>::from(p)).any();
        // a box has a corner in front where its contents have one
        let corners = |[low, high]: [[f32; 3]; 2]| {
            (0..8).map(move |i| std::array::from_fn(|k| if i >> k & 1 == 0 { low[k] } else { high[k] }))
        };
        let is_seen = scene.triangles[..own].as_flattened().iter().any(|p| faces(*p))
            || scene.shapes.iter().any(|shape| corners(shape.geometry.bounds()).any(faces))
            || scene
                .instances
                .iter()
                .any(|instance| instance.corners(objects[instance.object as usize]).into_iter().any(faces));
        let is_empty = own == 0 && scene.shapes.is_empty() && scene.instances.is_empty();
        if !is_seen && !is_empty {
            return Err(message);
        }
    }
    Ok(())
}
