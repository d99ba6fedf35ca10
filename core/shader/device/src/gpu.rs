//! A Vulkan device, and programs that run on it.

use std::error::Error;
use wgpu::util::DeviceExt;

/// A program in one of the languages that a device takes.
#[derive(Clone, Copy)]
pub(crate) enum GpuSource<'a> {
    Wgsl(&'a str),
    SpirV(&'a [u32]),
}

/// A device that runs programs.
pub(crate) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// What the device and its driver are called.
    pub(crate) name: String,
}

impl Gpu {
    /// The first device whose name has this part; an empty one prefers software.
    pub(crate) fn new(part: &str) -> Result<Option<Self>, Box<dyn Error>> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::VULKAN;
        let mut all = pollster::block_on(wgpu::Instance::new(descriptor).enumerate_adapters(wgpu::Backends::VULKAN));
        all.sort_by_key(|adapter| adapter.get_info().device_type != wgpu::DeviceType::Cpu);
        let Some(adapter) = all.into_iter().find(|adapter| adapter.get_info().name.contains(part)) else {
            return Ok(None);
        };
        let info = adapter.get_info();
        // SPIR-V is passed to the driver as it is
        let descriptor = wgpu::DeviceDescriptor {
            required_limits: adapter.limits(),
            required_features: wgpu::Features::PASSTHROUGH_SHADERS,
            // SAFETY: the programs are those of the tests, which read and write within their buffers
            experimental_features: unsafe { wgpu::ExperimentalFeatures::enabled() },
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))?;
        Ok(Some(Self { device, queue, name: format!("{} ({})", info.name, info.driver_info) }))
    }
    /// Runs the entry point `run` once for each of `count` inputs, and returns what it has written: so many numbers.
    pub(crate) fn run(
        &self,
        source: GpuSource,
        count: usize,
        inputs: &[u8],
        memory: &[u8],
        outputs: usize,
    ) -> Result<Vec<f32>, Box<dyn Error>> {
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = match source {
            GpuSource::Wgsl(text) => {
                let source = wgpu::ShaderSource::Wgsl(text.into());
                self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source })
            }
            GpuSource::SpirV(words) => {
                let spirv = Some(words.into());
                let entry_points =
                    vec![wgpu::PassthroughShaderEntryPoint { name: "run".into(), workgroup_size: (64, 1, 1) }].into();
                let descriptor = wgpu::ShaderModuleDescriptorPassthrough { spirv, entry_points, ..Default::default() };
                // SAFETY: the same
                unsafe { self.device.create_shader_module_passthrough(descriptor) }
            }
        };
        let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let entries = &[entry(0, true), entry(1, true), entry(2, false)];
        let of_group = &self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries });
        let bind_group_layouts = &[Some(of_group)];
        let layout = self
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor { bind_group_layouts, ..Default::default() });
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &module,
            entry_point: Some("run"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(error.into());
        }
        let buffer = |contents: &[u8]| {
            let usage = wgpu::BufferUsages::STORAGE;
            self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let sized = |usage| {
            let size = 4 * outputs as u64;
            self.device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
        };
        let found = sized(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let host = sized(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let (inputs, memory) = (buffer(inputs), buffer(memory));
        let all = [&memory, &inputs, &found].into_iter().enumerate();
        let all = all.map(|(k, of)| wgpu::BindGroupEntry { binding: k as u32, resource: of.as_entire_binding() });
        let entries = &all.collect::<Vec<_>>();
        let group =
            self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: of_group, entries });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(count.div_ceil(64) as u32, 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&found, 0, &host, 0, 4 * outputs as u64);
        self.queue.submit([encoder.finish()]);
        host.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.expect("the buffer can be read"));
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        let bytes = host.slice(..).get_mapped_range()?;
        Ok(bytes.chunks_exact(4).map(|word| f32::from_ne_bytes([word[0], word[1], word[2], word[3]])).collect())
    }
}
