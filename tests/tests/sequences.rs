//! Sequences of random numbers and of points.

mod associated_pairs;
mod joint;
mod random;
mod sobol;
