//! Samplers from shared libraries, by `include/etendue_judge.h`.

use crate::area_lights::{AreaLight, Measure};
use crate::lights::sampler::{Lacks, Prepared, Sample, Sampler, Subject, measure_of, shape_of};
use crate::lights::verdict::numbers;
use libloading::Library;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::path::Path;
use std::rc::Rc;

/// `ETENDUE_JUDGE_ABI`.
pub const ABI: u32 = 2;

/// `etendue_judge_sampler`.
#[derive(Clone, Copy)]
#[repr(C)]
struct SamplerTable {
    abi: u32,
    size: u32,
    name: *const c_char,
    shape: *const c_char,
    measure: *const c_char,
    domain: *const c_char,
    in_domain: Option<unsafe extern "C" fn(*const f32, *const f32, *const f32) -> c_int>,
    prepare: Option<unsafe extern "C" fn(*const f32, *const f32, *const f32) -> *mut c_void>,
    sample: Option<unsafe extern "C" fn(*mut c_void, *const f32, *mut f32, *mut f32) -> c_int>,
    pdf: Option<unsafe extern "C" fn(*mut c_void, *const f32) -> f32>,
    invert: Option<unsafe extern "C" fn(*mut c_void, *const f32, *mut f32) -> c_int>,
    hit: Option<unsafe extern "C" fn(*mut c_void, *const f32, *mut f32) -> c_int>,
    release: Option<unsafe extern "C" fn(*mut c_void)>,
    is_generator: c_int,
}

/// The callbacks of a sampler, none of which is missing that has to be there.
#[derive(Clone)]
struct Callbacks {
    table: SamplerTable,
    prepare: unsafe extern "C" fn(*const f32, *const f32, *const f32) -> *mut c_void,
    sample: unsafe extern "C" fn(*mut c_void, *const f32, *mut f32, *mut f32) -> c_int,
    // unloaded after the last use
    _library: Rc<Library>,
}

/// A light that a library has prepared.
struct Foreign {
    callbacks: Callbacks,
    state: *mut c_void,
}
impl Drop for Foreign {
    fn drop(&mut self) {
        if let Some(release) = self.callbacks.table.release {
            // SAFETY: `prepare` returned the state, and this is its only release
            unsafe { release(self.state) }
        }
    }
}
impl Sampler for Foreign {
    fn sample(&self, u: [f32; 2]) -> Option<Sample> {
        let (mut direction, mut pdf) = ([0.0; 3], 0.0);
        // SAFETY: `prepare` returned the state, and the arrays have the lengths of the header
        let answer = unsafe { (self.callbacks.sample)(self.state, u.as_ptr(), direction.as_mut_ptr(), &raw mut pdf) };
        (answer != 0).then_some(Sample { direction, pdf, is_hidden: answer == 2 })
    }
    fn pdf(&self, direction: [f32; 3]) -> f32 {
        // SAFETY: as above
        self.callbacks.table.pdf.map_or(0.0, |pdf| unsafe { pdf(self.state, direction.as_ptr()) })
    }
    fn invert(&self, direction: [f32; 3]) -> Option<[f32; 2]> {
        let mut u = [0.0; 2];
        // SAFETY: as above
        let answer = unsafe { self.callbacks.table.invert?(self.state, direction.as_ptr(), u.as_mut_ptr()) };
        (answer != 0).then_some(u)
    }
    fn hit(&self, direction: [f32; 3]) -> Option<f32> {
        let mut distance = 0.0;
        // SAFETY: as above
        let answer = unsafe { self.callbacks.table.hit?(self.state, direction.as_ptr(), &raw mut distance) };
        Some(if answer == 0 { 0.0 } else { distance })
    }
}

/// The samplers of a library.
///
/// # Errors
/// Fails if there is no such library, it does not export the function, or a sampler is none.
pub fn load(path: &Path) -> Result<Vec<Subject<'static>>, String> {
    let said = |what: &str| format!("{}: {what}", path.display());
    if !path.is_file() {
        return Err(said("no such file"));
    }
    // without a slash, the loader would search its own folders
    let full = path.canonicalize().map_err(|e| said(&e.to_string()))?;
    // SAFETY: its initialisers run in a process of their own
    let library = unsafe { Library::new(full) }.map_err(|e| said(&format!("is no library: {e}")))?;
    let library = Rc::new(library);
    // SAFETY: the header gives the function its type
    let listed =
        unsafe { library.get::<unsafe extern "C" fn(*mut u32) -> *const SamplerTable>(b"etendue_judge_samplers\0") };
    let listed =
        *listed.map_err(|_| said("does not export etendue_judge_samplers (extern \"C\", default visibility)"))?;
    let mut count = 0;
    // SAFETY: the function takes a pointer to a number
    let first = unsafe { listed(&raw mut count) };
    if first.is_null() || count == 0 {
        return Err(said("etendue_judge_samplers returns no samplers"));
    }
    let mut all = Vec::new();
    for i in 0..count as usize {
        // SAFETY: the array has `count` entries, of the size that the first one tells
        let table = unsafe { &*first.add(i) };
        let mine = size_of::<SamplerTable>() as u32;
        if (table.abi, table.size) != (ABI, mine) {
            let (abi, size) = (table.abi, table.size);
            return Err(said(&format!(
                "sampler {i} has ABI {abi} and {size} bytes, not ABI {ABI} and {mine} bytes: compile it with this header"
            )));
        }
        all.push(subject(*table, &library).map_err(|e| said(&format!("sampler {i}: {e}")))?);
    }
    Ok(all)
}

fn subject(table: SamplerTable, library: &Rc<Library>) -> Result<Subject<'static>, String> {
    let text = |text: *const c_char, what: &str| -> Result<String, String> {
        if text.is_null() {
            return Ok(String::new());
        }
        // SAFETY: the header says that it ends with 0
        let text = unsafe { CStr::from_ptr(text) }.to_str();
        Ok(text.map_err(|_| format!("{what} is not UTF-8"))?.to_owned())
    };
    let [name, shape, measure, domain] = [
        text(table.name, "the name")?,
        text(table.shape, "the shape")?,
        text(table.measure, "the measure")?,
        text(table.domain, "the domain")?,
    ];
    if name.is_empty() {
        return Err("it has no name".into());
    }
    let of_name = |e| format!("{name}: {e}");
    let shape = shape_of(&shape).map_err(of_name)?;
    let by = if measure.is_empty() { Measure::Other } else { measure_of(&measure).map_err(of_name)? };
    let missing = |what| format!("{name}: {what} is null");
    let callbacks = Callbacks {
        table,
        prepare: table.prepare.ok_or_else(|| missing("prepare"))?,
        sample: table.sample.ok_or_else(|| missing("sample"))?,
        _library: Rc::clone(library),
    };
    let prepare = move |light: &AreaLight| {
        let numbers = numbers(light);
        let [lamp, p, n] = [numbers.as_ptr(), light.p.as_ptr(), light.n.as_ptr()];
        // SAFETY: the arrays have the lengths of the header
        if let Some(claims) = table.in_domain
            && unsafe { claims(lamp, p, n) } == 0
        {
            return Prepared::OutsideOfDomain;
        }
        // SAFETY: as above
        let state = unsafe { (callbacks.prepare)(lamp, p, n) };
        if state.is_null() {
            return Prepared::Nothing;
        }
        Prepared::Ready(Box::new(Foreign { callbacks: callbacks.clone(), state }))
    };
    let lacks = Lacks { map: table.is_generator != 0, pdf: table.pdf.is_none() };
    Ok(Subject { name, shape, by, lacks, domain, prepare: Box::new(prepare) })
}
