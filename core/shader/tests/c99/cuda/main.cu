// Runs every case on the GPU, or compiled as C++ on the processor, compares all bits with those of Rust, and measures time.
#include "case.h"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <thread>
#include <vector>

struct Kernels {
    Kernel run, timed;
};
static std::map<std::string, Kernels> &cases() {
    static std::map<std::string, Kernels> all;
    return all;
}
bool add_case(const char *name, Kernel run, Kernel timed) {
    cases()[name] = {run, timed};
    return true;
}

#ifdef __CUDACC__
static void check(cudaError_t error, const char *what) {
    if (error != cudaSuccess) {
        fprintf(stderr, "%s: %s\n", what, cudaGetErrorString(error));
        exit(2);
    }
}
static void launch(Kernel kernel, size_t threads, Arguments of) {
    kernel<<<unsigned((threads + 127) / 128), 128>>>(of);
    check(cudaGetLastError(), "launch");
    check(cudaDeviceSynchronize(), "kernel");
}
template <typename T> static T *allocate(size_t count) {
    void *at = nullptr;
    check(cudaMalloc(&at, std::max<size_t>(count, 1) * sizeof(T)), "memory");
    return static_cast<T *>(at);
}
template <typename T> static T *upload(const std::vector<T> &of) {
    T *const at = allocate<T>(of.size());
    check(cudaMemcpy(at, of.data(), of.size() * sizeof(T), cudaMemcpyHostToDevice), "upload");
    return at;
}
static std::vector<float> download(const float *at, size_t count) {
    std::vector<float> all(count);
    check(cudaMemcpy(all.data(), at, count * sizeof(float), cudaMemcpyDeviceToHost), "download");
    return all;
}
static void release(const void *at) { check(cudaFree(const_cast<void *>(at)), "release"); }
static void tell_device() {
    cudaDeviceProp device;
    check(cudaGetDeviceProperties(&device, 0), "device");
    printf("%s, compute capability %d.%d\n", device.name, device.major, device.minor);
}
static const size_t samples = size_t(1) << 24;
static const int repetitions = 5;
#else
thread_local size_t this_thread;
static unsigned processors() {
    const char *const wanted = getenv("THREADS");
    return wanted ? unsigned(atoi(wanted)) : std::max(1u, std::thread::hardware_concurrency());
}
static void launch(Kernel kernel, size_t threads, Arguments of) {
    std::vector<std::thread> all;
    const size_t parts = processors();
    for (size_t part = 0; part < parts; ++part) {
        all.emplace_back([=] {
            const size_t end = threads * (part + 1) / parts;
            for (this_thread = threads * part / parts; this_thread < end; ++this_thread) kernel(of);
        });
    }
    for (std::thread &thread : all) thread.join();
}
template <typename T> static T *allocate(size_t count) { return new T[std::max<size_t>(count, 1)]; }
template <typename T> static T *upload(const std::vector<T> &of) {
    T *const at = allocate<T>(of.size());
    std::copy(of.begin(), of.end(), at);
    return at;
}
static std::vector<float> download(const float *at, size_t count) { return std::vector<float>(at, at + count); }
template <typename T> static void release(const T *at) { delete[] at; }
static void tell_device() { printf("the processor, %u threads\n", processors()); }
static const size_t samples = size_t(1) << 19;
static const int repetitions = 2;
#endif

// NaN is NaN, whatever its bits.
static uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return x == x ? bits : 0x7fc00000u;
}
// Million samples in a second, where each thread draws so many; the best of a few times after the first.
static double rate(Kernel kernel, Arguments of, uint32_t rounds) {
    of.rounds = rounds;
    double best = 1e30;
    for (int k = 0; k <= repetitions; ++k) {
        const auto begin = std::chrono::steady_clock::now();
        launch(kernel, samples / rounds, of);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        if (k > 0) best = std::min(best, seconds.count());
    }
    return double(samples) / best / 1e6;
}
// Whether all bits of a case are the same; else prints the first number that differs.
static bool same(const std::string &name, const Kernels &kernels) {
    const std::string path = name + ".bin";
    FILE *const file = fopen(path.c_str(), "rb");
    uint32_t counts[4];
    if (!file || fread(counts, sizeof counts, 1, file) != 1) {
        printf("%s: cannot be read\n", path.c_str());
        return false;
    }
    const size_t count = counts[0], takes = counts[1], gives = counts[2];
    std::vector<uint32_t> words(counts[3]);
    std::vector<float> inputs(count * takes), right(count * gives);
    const size_t read = fread(words.data(), 4, words.size(), file) + fread(inputs.data(), 4, inputs.size(), file) +
                        fread(right.data(), 4, right.size(), file);
    fclose(file);
    if (count == 0 || read != words.size() + inputs.size() + right.size()) {
        printf("%s: too short\n", path.c_str());
        return false;
    }
    const float *const on_device = upload(inputs);
    const uint32_t *const memory = upload(words);
    const size_t sums = kernels.timed ? samples : 0;
    float *const outputs = allocate<float>(std::max(right.size(), sums));
    const Arguments of = {on_device, outputs, memory, counts[3], counts[0], 1};
    launch(kernels.run, count, of);
    const std::vector<float> found = download(outputs, right.size());
    size_t differ = 0, first = 0;
    for (size_t k = right.size(); k-- > 0;) {
        if (bits_of(right[k]) != bits_of(found[k])) {
            ++differ;
            first = k;
        }
    }
    printf("%-60s %3zu numbers, %zu times: ", name.c_str(), gives, count);
    if (differ == 0) {
        printf("the same bits");
    } else {
        printf("%zu differ; output %zu of input %zu is %.9g instead of %.9g, for", differ, first % gives, first / gives,
               double(found[first]), double(right[first]));
        for (size_t k = 0; k < takes; ++k) printf(" %.9g", double(inputs[first / gives * takes + k]));
    }
    if (kernels.timed) {
        const double once = rate(kernels.timed, of, 1), often = rate(kernels.timed, of, 64);
        printf("; million samples/s: %.1f with preparation, %.1f of 64 samples each", once, often);
    }
    printf("\n");
    fflush(stdout);
    release(on_device);
    release(memory);
    release(outputs);
    return differ == 0;
}

int main() {
    tell_device();
    size_t wrong = 0;
    for (const auto &[name, kernels] : cases()) wrong += !same(name, kernels);
    printf("%zu cases, of which %zu differ\n", cases().size(), wrong);
    return wrong == 0 && !cases().empty() ? 0 : 1;
}
