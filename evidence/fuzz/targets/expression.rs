//! The reader of expressions on any bytes.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| shadowstep_tests::readers::expression(bytes));
