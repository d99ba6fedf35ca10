// What the host adds to the file of etendue-shader: the irradiance of one sample of each of three lights on a surface.
@group(0) @binding(0) var<storage, read> numbers: array<vec2<f32>>;
@group(0) @binding(1) var<storage, read_write> irradiance: array<vec4<f32>>;

const P = vec3<f32>(0.2, 0.0, 0.1);
const N = vec3<f32>(0.0, 0.8, 0.6);

// A renderer traces a shadow ray first, along `direction` up to `distance`.
fn contribution(s: EtendueShaderLightSample) -> f32 {
    return max(dot(s.direction, N), 0.0) * s.weight;
}

@compute @workgroup_size(64)
fn run(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= arrayLength(&numbers)) {
        return;
    }
    let u = numbers[id.x];
    let sphere = etendue_shader_sphere_by_solid_angle_prepare(EtendueShaderSphere(vec3<f32>(-1.0, 1.5, 0.5), 0.5), P);
    let triangle = etendue_shader_triangle_by_solid_angle_prepare(
        EtendueShaderTriangle(vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, 1.0)), P);
    let rectangle = etendue_shader_rectangle_by_solid_angle_prepare(
        EtendueShaderRectangle(vec3<f32>(-0.5, 1.5, 0.2), vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, 1.0)), P);
    irradiance[id.x] = vec4<f32>(
        contribution(etendue_shader_sphere_by_solid_angle_sample(sphere, u)),
        contribution(etendue_shader_triangle_by_solid_angle_sample(triangle, u)),
        contribution(etendue_shader_rectangle_by_solid_angle_sample(rectangle, u)),
        0.0);
}
