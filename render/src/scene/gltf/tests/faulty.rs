//! Tests of faulty.
