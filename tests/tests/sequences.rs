//! Sequences of random numbers and of points. That packets have the bits of numbers, the fuzz bodies and the table of bits tell.

mod joint;
mod random;
mod sobol;
