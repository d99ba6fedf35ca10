//! Tests of materials.
