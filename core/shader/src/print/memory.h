
#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)
#define ETENDUE_MEMORY __global
#else
#define ETENDUE_MEMORY
#endif

// The tables of all functions, one after another: words of 32 bits, some of which are numbers by their bits. Functions are told at which
// word a table begins.
typedef struct {
    const ETENDUE_MEMORY etendue_shader_word *words;
    // How many there are.
    etendue_shader_word count;
} EtendueShaderMemory;

// The word at an index; past the end the last one, and 0 where there is none.
ETENDUE_FUNCTION etendue_shader_word etendue_shader_load(EtendueShaderMemory memory, etendue_shader_word k) {
    return memory.count == 0u ? 0u : memory.words[k < memory.count ? k : memory.count - 1u];
}
