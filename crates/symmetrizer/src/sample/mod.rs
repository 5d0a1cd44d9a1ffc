//! Points on the surface that stand for it (paper, section 2).

pub mod uniform;
