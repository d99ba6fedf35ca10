//! The same sources as OpenCL C, on a device of this machine: the tests compare them where there is one, and else say that there is none.
//! `OPENCL=no` leaves it out.

use crate::driver::{folder, numbers_of};
use crate::program::Driver;
use core::fmt::Write;
use etendue_shader::*;
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

/// The program that runs kernels, if it compiles and finds a device.
fn host() -> Option<&'static PathBuf> {
    static HOST: OnceLock<Option<PathBuf>> = OnceLock::new();
    let find = || {
        if std::env::var("OPENCL").is_ok_and(|wanted| wanted == "no") {
            return Err("OPENCL=no".into());
        }
        let folder = folder("opencl");
        let [source, binary] = ["main.c", "main"].map(|file| folder.join(file));
        fs::write(&source, include_str!("opencl/main.c")).unwrap();
        let mut compile = Command::new(std::env::var("CC").unwrap_or_else(|_| "cc".into()));
        compile.args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-o"]).arg(&binary).arg(&source).arg("-lOpenCL");
        if !compile.output().expect("a C compiler").status.success() {
            return Err("its headers and library are not installed".into());
        }
        let probe = Command::new(&binary).output().unwrap();
        if probe.status.code() == Some(77) {
            return Err(String::from_utf8_lossy(&probe.stderr).trim().to_owned());
        }
        assert!(probe.status.success(), "{probe:?}");
        Ok((binary, String::from_utf8_lossy(&probe.stdout).trim().to_owned()))
    };
    let tell = |found: Result<(PathBuf, String), String>| match found {
        Ok((binary, device)) => {
            println!("{device}");
            Some(binary)
        }
        Err(why) => {
            // a test that passes shows its messages with --nocapture alone: this one has to be seen
            let _ = std::io::Write::write_all(
                &mut std::io::stderr(),
                format!("OpenCL is not compared: {why}\n").as_bytes(),
            );
            None
        }
    };
    HOST.get_or_init(|| tell(find())).as_ref()
}

impl Driver<'_> {
    /// What OpenCL returns, if it is here.
    pub(crate) fn run_opencl(&self, name: &str, inputs: &[Vec<f32>]) -> Option<Vec<Vec<f32>>> {
        let host = host()?;
        let folder = folder(name);
        let [kernel, words] = ["kernel.cl", "words.bin"].map(|file| folder.join(file));
        let memory = if self.module.reads_memory() {
            "    const EtendueShaderMemory memory = {words, word_count};\n    (void)memory;\n"
        } else {
            ""
        };
        let (takes, gives) = (self.inputs, self.outputs.len());
        let mut source = print(self.module, &C, "Made by a test.");
        let _ = writeln!(
            source,
            "__kernel void run(__global const float *inputs, __global float *outputs, __global const uint *words, uint word_count) {{\n    \
             __global const float *const in = inputs + get_global_id(0) * {takes};\n    __global float *const out = outputs + \
             get_global_id(0) * {gives};\n{memory}{}}}",
            self.c()
        );
        fs::write(&kernel, source).unwrap();
        fs::write(&words, self.memory.iter().flat_map(|word| word.to_ne_bytes()).collect::<Vec<_>>()).unwrap();
        let mut run = Command::new(host);
        run.arg(&kernel).args([takes.to_string(), gives.to_string()]).arg(&words);
        run.env("POCL_CACHE_DIR", folder.join("pocl"));
        Some(numbers_of(name, run, inputs, gives))
    }
}
