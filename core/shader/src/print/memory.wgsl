
// The tables of all functions, one after another: words of 32 bits, some of which are numbers by their bits. Functions are told at which
// word a table begins. A host may change the group and the binding.
@group(0) @binding(0) var<storage, read> etendue_shader_memory: array<u32>;

// The word at an index; past the end the last one.
fn etendue_shader_load(k: u32) -> u32 {
    return etendue_shader_memory[min(k, arrayLength(&etendue_shader_memory) - 1u)];
}
