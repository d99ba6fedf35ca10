
#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)
#define ETENDUE_MEMORY __global
#else
#define ETENDUE_MEMORY
#endif

// The tables of all functions, one after another: words of 32 bits, some of which are numbers by their bits. Functions are told at which
// word a table begins.
typedef struct {
    const ETENDUE_MEMORY etendue_word *words;
    // How many there are.
    etendue_word count;
} EtendueMemory;

// The word at an index; past the end the last one, and 0 where there is none.
ETENDUE_FUNCTION etendue_word etendue_load(EtendueMemory memory, etendue_word k) {
    return memory.count == 0u ? 0u : memory.words[k < memory.count ? k : memory.count - 1u];
}
