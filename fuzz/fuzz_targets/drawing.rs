#![no_main]

use symmetrizer_fuzz::drawing::check;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| check(bytes));
