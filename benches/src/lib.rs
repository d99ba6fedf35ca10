//! Benchmarks of the library and of ray traversal. What they measure is in `etendue-routines`, in the folder `routines`.
