//! Light sampling in shading languages and in C: sources written from the routines of [`etendue`].
//!
//! Every routine of the core is written once over the trait [`Real`](etendue::Real). [`Number`] implements that trait by recording what is
//! computed: a routine that runs on it leaves a [`Graph`] of its operations, and [`Language::write`] prints this in a language. There is no
//! second body of any routine, and no second list: the core's visitors go through its own.
//!
//! ```
//! use etendue_shader::{Language, Selection};
//! let selection = Selection { lights: vec!["sphere_by_solid_angle".into()], ..Selection::default() };
//! let source = Language::C.write(&selection.module(), "Written by an example.").unwrap();
//! let source = String::from_utf8(source).unwrap();
//! assert!(source.contains("EtendueShaderLightSample etendue_shader_sphere_by_solid_angle_sample("));
//! ```
//!
//! The program does the same: `etendue-shader --language cuda --lights triangle,sphere -o etendue.cuh`. In C, a sample takes two calls:
//!
//! ```c
//! EtendueShaderTriangle lamp = {{0, 2, 0}, {1, 0, 0}, {0, 0, 1}};
//! EtendueShaderVec3 p = {0, 0, 0};
//! EtendueShaderVec2 u = {0.3f, 0.6f};
//! EtendueShaderTriangleBySolidAngle prepared = etendue_shader_triangle_by_solid_angle_prepare(lamp, p); // once for a shading point
//! EtendueShaderLightSample s = etendue_shader_triangle_by_solid_angle_sample(prepared, u);              // as often as needed
//! float irradiance = s.direction.y * s.weight;                                            // per unit of radiance
//! ```
//!
//! # What is written
//! For each light by each technique a struct of the light, a struct of what is prepared for a shading point, and the functions `prepare`,
//! `sample`, `pdf`, `hit`, `invert`, and one for what the technique is uniform over; for each warp `sample`, `pdf` and `invert`. Lights
//! `by_reflection` and the warp `reflection` take a struct `reflection`, which the table of this name prepares, or the host by
//! [`Reflection`](etendue::reflection::Reflection).
//! [`tools`] are what is neither. [`Wanted`] leaves functions out, and fields of samples. What only these need is not computed, and the
//! prepared struct has no field that no function uses, none that is constant, and none twice.
//!
//! Equal operations appear once. A value that is used more than once is a variable, the others are parts of expressions. Constants are
//! decimal numbers that every compiler reads as the same bits.
//!
//! # Branches
//! In the core, [`Real::where_any`](etendue::Real::where_any) and [`Real::take_any`](etendue::Real::take_any) name a path that few calls
//! need. Both sides are recorded, with what is selected then, and [`plan`] puts whatever nothing else uses into an `if`.
//! [`Real::iterate`](etendue::Real::iterate) is a loop; other loops of the core have constant bounds, and are written out. `if mask.any()`
//! cannot be recorded.
//!
//! What a routine asks of one lane as a number of Rust ([`Real::lane_f64`](etendue::Real::lane_f64), a comparison of scalars, the bits of a
//! mask) is known for constants alone; anything else panics with a message. Portals, whose tables have numbers of 64 bits,
//! do ask that, and so does the exponential function: they are not here.
//!
//! # Memory
//! The `reflection` alone reads a table: the numbers of [`reflection::table`](etendue::reflection::table), which the host puts into a buffer of
//! words of 32 bits. A parameter of a function is the word at which they begin. An index past the end reads the last word, in every language.
//!
//! | language | the buffer |
//! |---|---|
//! | C, C++, CUDA, HIP, OpenCL C | the first parameter, `EtendueShaderMemory`: a pointer to constant (in OpenCL, global) memory, and a count |
//! | WGSL, SPIR-V | a storage buffer `etendue_shader_memory`, group (set) 0, binding 0 |
//! | GLSL | a buffer with the binding 0; `glsl-es` then is GLSL ES 3.10, since 3.00 and WebGL 2 have none |
//! | HLSL | a `ByteAddressBuffer` at register t0 |
//! | Metal | the last two parameters: the buffer, and its size in bytes |
//!
//! Trees of lights, distributions and images of the sky are not here: a host on a GPU has them in its own layout, or asks the core once a
//! frame. Nor are lights with pictures, whose functions would have up to 8000 lines.
//!
//! # In another renderer
//! In three-gpu-pathtracer 0.0.26, a path tracer in WebGL 2, 25 lines by hand replace samples of the area of rectangles and disks by the functions
//! written here: 1100 lines by solid angle for both shapes, and 9600 with rectangles by projected solid angle. The means agree. Of a near
//! and large rectangle on a floor, the variance of one sample over the squared mean falls from 10 to 0.32 and to 0.0036, and a frame takes
//! 1.1 and 1.9 times as long. `python3 benches/peers/three_pathtracer.py HOST target/release/etendue-shader FOLDER --pictures 12` prints this
//! for more places, and says which line of that renderer it repairs.
//!
//! # Which bits
//! C99, C++ and CUDA return the bits of the scalar Rust routine, if the compiler does not contract operations; tests compare those of C for
//! every function (with `LONG=1`; otherwise for most), and those of OpenCL C where a device is, such as pocl on the processor: the same bits,
//! with subnormal numbers and `-cl-fp32-correctly-rounded-divide-sqrt`. The shading languages promise less: the beginning of each file says
//! what. Read as C++ with another standard library, each operation in Metal has the same bits, but for conversions to words outside of
//! [0, 2²⁴].
//!
//! On an H100, CUDA (nvcc 13.0, without contraction) returned the bits of Rust in all cases but one, hostile input included. In the other one, of
//! single operations, the lesser of −0 and the constant 0 is −0, as the compiler takes it for a minimum; no routine shows it. There are 14 to
//! 430 times as many samples per second as on one core with `f32x8`. What is long in code is slow there: a polygon's numbers do not fit into the
//! registers of a thread.
//! `CASES=folder LONG=1 cargo test -p etendue-shader --test c99` writes a folder, and `folder/run gpu` in it does the rest, with nvcc.
//!
//! No shading language that is text forbids a driver to contract or reorder products and sums; in SPIR-V, `NoContraction` does, which all of
//! them have here. `--exact` writes each fused multiply-add, quotient and square root out, so that they are rounded once on any device whose
//! sums and products are, and whose quotients and square roots are wrong by at most three units. On a device whose `fma` rounds twice (Mesa
//! 22.3's software Vulkan), for the inputs of the tests, of which three of eight are hostile, with a unit of 2⁻²⁴, relative for
//! densities, weights and distances:
//!
//! | routines | WGSL, as SPIR-V without `NoContraction` | SPIR-V | SPIR-V by `--exact` |
//! |---|---|---|---|
//! | 28 lights by technique, and 8 with fewer fields: same bits | 55 to 100 % of numbers | 57 to 100 % | 99.4 to 100 % |
//! | … of which 99 % of numbers are within 4 units | 6 | 6 | 36 |
//! | … numbers that are NaN, and densities where Rust has 0 | 48 and 19 | 0 and 17 | 0 and 0 |
//! | 15 warps: same bits | 66 to 100 % | 67 to 100 % | 99.8 to 100 % |
//! | … of which 99 % of numbers are within 4 units | 12 | 12 | 15 |
//! | 14 tools: same bits | 95 to 100 % | 95 to 100 % | 99.4 to 100 % |
//!
//! An H100's Vulkan driver (580.159) keeps less in the first two columns: 52 to 100 % of the numbers of 60 lights, of which 8 have 99 % within
//! 4 units (points, spots, and what is at infinity), 63 to 99 % of warps' (9 of 15) and 81 to 100 % of tools' (11 of 14); hostile input gives NaN in 0.1 % of the numbers of lights where Rust has none. `--exact`, as it was before it
//! rounded correctly next to ties, kept 82 to 100 % of 34 lights, of which 10 have 99 % within 4 units, and the NaN: the driver takes
//! subnormal numbers for 0, which no source can mend. Use CUDA or OpenCL there if densities must be closed for any input.
//!
//! On Mesa's device, lights at points and at infinity, spheres by solid angle without their `hit` and all warps but
//! those of GGX normals, reflections and the surface of a patch keep their contract. The others need both, sums that are not reordered
//! and an `fma` that rounds once or `--exact`; then at most 0.6 % of the numbers of a routine differ, most of them subnormal, and
//! we have not found why some others do in disks and rectangles by area and the surface of a patch. `.ci/shader` prints the table of all
//! routines.
mod graph;
mod inputs;
mod language;
mod layout;
mod module;
mod names;
mod number;
mod plan;
mod print;
mod record;
mod selection;
mod tables;
mod tools;
mod translate;
mod wanted;

pub use graph::{Branch, Call, Condition, Graph, Id, Kind, Loop, Node, Op};
pub use language::Language;
pub use module::{Access, Field, Function, Leaf, Module, Parameter, Struct, Type};
pub use names::{pascal, snake};
pub use number::{Inner, Number, Truth, Word, record};
pub use plan::{Plan, Step, plan};
pub use print::{C, Dialect, Wgsl, function_name, print, struct_name};
pub use record::{add_calls, add_technique, add_warp};
pub use selection::{Selection, lights, technique_name, warps};
pub use tables::{add_reflection, tables};
pub use tools::{add_tool, tools};
pub use translate::{Checked, Target};
pub use wanted::{Part, SampleField, Wanted};
