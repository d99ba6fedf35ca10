//! Direct light of three lights on a diffuse surface by a compute shader. Nothing is in the way, so that each has a closed form; the program
//! prints the errors, and fails if one is too large. Without a Vulkan device it says so, and only the shader has been compiled.
//!
//! `etendue.wgsl` is what this command writes, in the folder `src`:
//! `etendue-shader --language wgsl --lights sphere_by_solid_angle,triangle_by_solid_angle,rectangle_by_solid_angle --functions sample -o etendue.wgsl`

use etendue::sequence::{OwenSobol, Sequence};
use etendue::{Rectangle, Sphere, Triangle, Vec3};
use std::error::Error;
use std::process::ExitCode;
use wgpu::util::DeviceExt;

const SHADER: &str = concat!(include_str!("etendue.wgsl"), include_str!("lights.wgsl"));
const SAMPLES: usize = 1 << 16;
/// The greatest relative error that is right for so many samples, on devices whose divisions and square roots err in the last digits.
const MOST: f64 = 1e-4;

/// What the shader writes: four numbers for each pair of random numbers; none without a device.
fn run(numbers: &[u8]) -> Result<Option<Vec<f32>>, Box<dyn Error>> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN;
    let instance = wgpu::Instance::new(descriptor);
    let Some(adapter) = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN)).into_iter().next()
    else {
        return Ok(None);
    };
    println!("on {}", adapter.get_info().name);
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
    let source = wgpu::ShaderSource::Wgsl(SHADER.into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("run"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let usage = wgpu::BufferUsages::STORAGE;
    let input = device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents: numbers, usage });
    let size = 16 * SAMPLES as u64;
    let buffer =
        |usage| device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let found = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let host = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: input.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: found.as_entire_binding() },
        ],
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(SAMPLES.div_ceil(64) as u32, 1, 1);
    drop(pass);
    encoder.copy_buffer_to_buffer(&found, 0, &host, 0, size);
    queue.submit([encoder.finish()]);
    host.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.expect("the buffer can be read"));
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let bytes = host.slice(..).get_mapped_range()?;
    Ok(Some(bytes.chunks_exact(4).map(|word| f32::from_ne_bytes([word[0], word[1], word[2], word[3]])).collect()))
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let sobol = OwenSobol::new(1);
    let pairs = (0..SAMPLES as u32).map(|index| sobol.pair::<f32>(0, index, 0));
    let numbers: Vec<u8> = pairs.flat_map(|u| [u.x, u.y]).flat_map(f32::to_ne_bytes).collect();
    let Some(found) = run(&numbers)? else {
        println!("no Vulkan device: nothing ran");
        return Ok(ExitCode::SUCCESS);
    };
    // the closed forms of the library in double precision
    let (p, n) = (Vec3::<f64>::lit([0.2, 0.0, 0.1]), Vec3::lit([0.0, 0.8, 0.6]));
    let [o, x, z] = [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]].map(Vec3::lit);
    let [corner, s, t] = [[-0.5, 1.5, 0.2], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::lit);
    let exact = [
        Sphere::new(Vec3::lit([-1.0, 1.5, 0.5]), 0.5).by_projected_solid_angle(p, n).projected_solid_angle(),
        Triangle::new(o, x, z).by_projected_solid_angle(p, n).projected_solid_angle(),
        Rectangle::new(corner, s, t).by_projected_solid_angle(p, n).projected_solid_angle(),
    ];
    let (mut worst, mut right) = (0.0_f64, true);
    println!("{:14} {:>10} {:>12}", "light", "irradiance", "error");
    for (k, name) in ["sphere", "triangle", "rectangle"].into_iter().enumerate() {
        let mean = found.iter().skip(k).step_by(4).map(|&x| f64::from(x)).sum::<f64>() / SAMPLES as f64;
        let error = (mean / exact[k] - 1.0).abs();
        println!("{name:14} {:10.6} {error:12.1e}", exact[k]);
        worst = worst.max(error);
        // which a number that is none is not
        right &= error < MOST;
    }
    println!("the largest error is {worst:.1e}, and {MOST:e} is allowed");
    Ok(if right { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
