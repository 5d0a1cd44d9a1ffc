#![no_main]

use symmetrizer::shape::io::Format;
use symmetrizer_fuzz::check::check;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| check(bytes, Format::Ply));
