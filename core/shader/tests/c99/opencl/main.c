/* Runs a kernel of OpenCL C for all numbers of the standard input: main kernel.cl INPUTS OUTPUTS words.bin. Without arguments, it says which
 * device there is. It exits with 77 where there is none. */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>

static void check(cl_int error, const char *what) {
    if (error != CL_SUCCESS) {
        fprintf(stderr, "OpenCL: error %d of %s\n", (int)error, what);
        exit(1);
    }
}
/* The first device, that of a processor if there is one. */
static cl_device_id first_device(void) {
    cl_platform_id platforms[16];
    cl_uint count = 0;
    if (clGetPlatformIDs(16, platforms, &count) != CL_SUCCESS) count = 0;
    const cl_device_type types[] = {CL_DEVICE_TYPE_CPU, CL_DEVICE_TYPE_ALL};
    for (int kind = 0; kind < 2; ++kind) {
        for (cl_uint k = 0; k < count && k < 16; ++k) {
            cl_device_id device;
            if (clGetDeviceIDs(platforms[k], types[kind], 1, &device, NULL) == CL_SUCCESS) return device;
        }
    }
    fprintf(stderr, "no OpenCL device\n");
    exit(77);
}
static char *read_all(FILE *file, size_t *size) {
    size_t room = 1 << 20;
    char *all = malloc(room + 1);
    *size = 0;
    while (file && all) {
        *size += fread(all + *size, 1, room - *size, file);
        if (*size < room) break;
        all = realloc(all, (room *= 2) + 1);
    }
    if (!file || !all) {
        fprintf(stderr, "a file cannot be read\n");
        exit(1);
    }
    all[*size] = 0;
    return all;
}
static cl_mem buffer(cl_context context, size_t size, void *from) {
    cl_int error;
    const cl_mem_flags copy = from ? CL_MEM_COPY_HOST_PTR : 0;
    const cl_mem memory = clCreateBuffer(context, CL_MEM_READ_WRITE | copy, size ? size : 4, from, &error);
    check(error, "clCreateBuffer");
    return memory;
}

int main(int argc, char **argv) {
    cl_device_id device = first_device();
    if (argc != 5) {
        char name[256] = "", version[256] = "";
        cl_device_fp_config has = 0;
        clGetDeviceInfo(device, CL_DEVICE_NAME, sizeof name, name, NULL);
        clGetDeviceInfo(device, CL_DEVICE_OPENCL_C_VERSION, sizeof version, version, NULL);
        clGetDeviceInfo(device, CL_DEVICE_SINGLE_FP_CONFIG, sizeof has, &has, NULL);
        printf("%s, %s: subnormal numbers %s, correctly rounded division %s, fma %s\n", version, name, has & CL_FP_DENORM ? "yes" : "no",
               has & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT ? "yes" : "no", has & CL_FP_FMA ? "yes" : "no");
        return 0;
    }
    size_t source_size, words_size, inputs_size;
    char *const source = read_all(fopen(argv[1], "rb"), &source_size);
    char *const words = read_all(fopen(argv[4], "rb"), &words_size);
    char *const inputs = read_all(stdin, &inputs_size);
    const size_t count = inputs_size / 4 / (size_t)atoi(argv[2]), outputs_size = count * (size_t)atoi(argv[3]) * 4;
    cl_int error;
    const cl_context context = clCreateContext(NULL, 1, &device, NULL, NULL, &error);
    check(error, "clCreateContext");
    const cl_command_queue queue = clCreateCommandQueue(context, device, 0, &error);
    check(error, "clCreateCommandQueue");
    const cl_program program = clCreateProgramWithSource(context, 1, (const char **)&source, &source_size, &error);
    check(error, "clCreateProgramWithSource");
    error = clBuildProgram(program, 1, &device, "-cl-std=CL1.2 -cl-fp32-correctly-rounded-divide-sqrt", NULL, NULL);
    if (error != CL_SUCCESS) {
        static char log[1 << 16];
        clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log, NULL);
        fprintf(stderr, "%s\n", log);
    }
    check(error, "clBuildProgram");
    const cl_kernel kernel = clCreateKernel(program, "run", &error);
    check(error, "clCreateKernel");
    const cl_mem in = buffer(context, inputs_size, inputs), out = buffer(context, outputs_size, NULL);
    const cl_mem memory = buffer(context, words_size, words_size ? words : NULL);
    const cl_uint word_count = (cl_uint)(words_size / 4);
    check(clSetKernelArg(kernel, 0, sizeof in, &in), "the inputs");
    check(clSetKernelArg(kernel, 1, sizeof out, &out), "the outputs");
    check(clSetKernelArg(kernel, 2, sizeof memory, &memory), "the memory");
    check(clSetKernelArg(kernel, 3, sizeof word_count, &word_count), "the number of words");
    check(clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &count, NULL, 0, NULL, NULL), "clEnqueueNDRangeKernel");
    char *const outputs = malloc(outputs_size);
    check(clEnqueueReadBuffer(queue, out, CL_TRUE, 0, outputs_size, outputs, 0, NULL, NULL), "clEnqueueReadBuffer");
    return fwrite(outputs, 1, outputs_size, stdout) == outputs_size ? 0 : 1;
}
