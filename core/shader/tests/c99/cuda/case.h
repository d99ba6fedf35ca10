// What a kernel gets, for nvcc and, with threads of the processor in place of a GPU, for any compiler of C++.
#pragma once
#include <cstddef>
#include <cstdint>
#include <math.h>
#include <string.h>

#ifndef __CUDACC__
#define __global__
#define __device__
extern thread_local size_t this_thread;
#endif

struct Arguments {
    // Of each thread, or of 32 of them where time is measured.
    const float *inputs;
    // Of each thread, or one number where time is measured.
    float *outputs;
    const uint32_t *words;
    uint32_t word_count;
    // How many inputs there are.
    uint32_t count;
    // How many samples a thread draws where time is measured.
    uint32_t rounds;
};
using Kernel = void (*)(Arguments);

// Makes a case known to the program, and returns true.
bool add_case(const char *name, Kernel run, Kernel timed);

static inline __device__ size_t thread_index() {
#ifdef __CUDACC__
    return size_t(blockIdx.x) * blockDim.x + threadIdx.x;
#else
    return this_thread;
#endif
}
// A number in [0, 1) of an additive sequence: what time is measured with.
static inline __device__ float random_number(size_t thread, unsigned round, unsigned step) {
    return float(((uint32_t(thread) + (round << 18)) * step) >> 8) * 5.9604645e-8f;
}

// Large cases are compiled with calls in place of functions that are inlined each time.
#ifdef LARGE
#ifdef __CUDACC__
#define inline __noinline__
#else
#define inline __attribute__((noinline))
#endif
#endif
