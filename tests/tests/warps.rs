//! Warps: the properties of all of them, and defects that the properties must notice.

mod maps;
mod properties;
