//! What a choice of lights needs to know of a light.

/// A bound of what a light of finite extent can contribute.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct LightBound {
    /// Centre of a sphere around the light, in the coordinates of the scene. A flat light is centred on it.
    pub center: [f32; 3],
    /// Radius of that sphere, not negative; 0 for a point or spot light.
    pub radius: f32,
    /// Unit normal of a flat light, or axis of a spot light; 0 for a light that emits in all directions, such as a sphere or a point.
    pub normal: [f32; 3],
    /// Cosine of the angle to `normal` from which on a spot light, or a flat light with a [`Spread`](crate::light::Spread), is dark, less a
    /// rounding; 0 for other lights. A light that emits beyond a hemisphere has the normal 0.
    pub cos_cone: f32,
    /// Whether a flat light emits from both sides.
    pub two_sided: bool,
    /// Power of one side of a flat light, or of all of another light, in any unit.
    pub power: f32,
}
