
@group(0) @binding(1) var<storage, read> all_inputs: array<u32>;
@group(0) @binding(2) var<storage, read_write> all_outputs: array<u32>;

fn read_bits(k: u32) -> u32 {
    return all_inputs[k];
}
fn write(k: u32, x: f32) {
    all_outputs[k] = bitcast<u32>(x);
}
@compute @workgroup_size(64)
fn run(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < arrayLength(&all_inputs) / takes) {
        program(id.x * takes, id.x * gives);
    }
}
