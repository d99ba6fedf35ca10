//! Which lights, warps and tools a source has, by their names.

use crate::module::Module;
use crate::names::snake;
use crate::record::{add_calls, add_technique, add_warp};
use crate::tables::{add_reflection, tables};
use crate::tools::{add_tool, tools};
use crate::wanted::Wanted;
use etendue::listed::light::{Technique, TechniqueVisitor, every_technique};
use etendue::listed::warp::{ListedWarp, WarpVisitor, every_warp};

/// The name of a light by a technique.
#[must_use]
pub fn technique_name<T: Technique>() -> String {
    format!("{}_{}", snake(T::ENTRY.light), T::ENTRY.by)
}

/// The names of lights, each with those of its techniques.
#[must_use]
pub fn lights() -> Vec<(String, Vec<String>)> {
    struct Names(Vec<(String, Vec<String>)>);
    impl TechniqueVisitor for Names {
        fn visit<T: Technique>(&mut self) {
            let light = snake(T::ENTRY.light);
            if self.0.last().is_none_or(|last| last.0 != light) {
                self.0.push((light, Vec::new()));
            }
            let (_, techniques) = self.0.last_mut().expect("one was pushed");
            techniques.push(technique_name::<T>());
        }
    }
    let mut names = Names(Vec::new());
    every_technique(&mut names);
    names.0
}

/// The names of warps.
#[must_use]
pub fn warps() -> Vec<String> {
    struct Names(Vec<String>);
    impl WarpVisitor for Names {
        fn visit<W: ListedWarp>(&mut self) {
            self.0.push(W::ENTRY.name.into());
        }
    }
    let mut names = Names(Vec::new());
    every_warp(&mut names);
    names.0
}

/// Lights and warps by their names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Lights (`triangle`: by all techniques), single techniques of them (`triangle_by_area`), or `all`.
    pub lights: Vec<String>,
    /// Warps, or `all`.
    pub warps: Vec<String>,
    /// Other functions, or `all`: see [`tools`].
    pub tools: Vec<String>,
    /// What reads tables in memory, or `all`: see [`tables`].
    pub tables: Vec<String>,
    /// The functions and fields of lights and warps.
    pub wanted: Wanted,
    /// See [`Module::exact`].
    pub exact: bool,
}

/// Adds to a module what is selected.
struct Adds<'a>(&'a Selection, Module);
impl TechniqueVisitor for Adds<'_> {
    fn visit<T: Technique>(&mut self) {
        let (light, technique) = (snake(T::ENTRY.light), technique_name::<T>());
        if self.0.lights.iter().any(|name| *name == light || *name == technique || name == "all") {
            add_technique::<T>(&mut self.1, &self.0.wanted);
        }
    }
}
impl WarpVisitor for Adds<'_> {
    fn visit<W: ListedWarp>(&mut self) {
        if self.0.warps.iter().any(|name| name == W::ENTRY.name || name == "all") {
            add_warp::<W>(&mut self.1, &self.0.wanted);
        }
    }
}

impl Selection {
    /// Records all that is selected.
    #[must_use]
    pub fn module(&self) -> Module {
        let mut visitor = Adds(self, Module { exact: self.exact, ..Module::default() });
        every_warp(&mut visitor);
        every_technique(&mut visitor);
        let mut module = visitor.1;
        for tool in tools().iter().filter(|tool| self.tools.iter().any(|name| name == *tool || name == "all")) {
            add_tool(&mut module, tool);
        }
        if self.tables.iter().any(|name| name == "all" || tables().contains(&name.as_str())) {
            add_reflection(&mut module);
        }
        add_calls(&mut module);
        module
    }
}
