//! The reader of sweeps on any bytes.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| shadowstep_tests::readers::sweep(bytes));
