//! Protects the compiler's messages: each case of `compile_fail/` is one fault of a table or of the attribute and gives
//! one error, at the place of the fault; all else that the case does with its struct compiles.
//!
//! `TRYBUILD=overwrite cargo test -p shadowstep-macros --test compile_fail` writes the messages anew; read them.

#[test]
fn faults_are_compile_errors() {
    trybuild::TestCases::new().compile_fail("tests/compile_fail/*.rs");
}
