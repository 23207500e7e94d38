//! Protects the compiler's messages: each struct, formula or function of `compile_fail/` has one fault and gives one
//! error, at the place of the fault; all else that is done with it compiles.
//!
//! `TRYBUILD=overwrite cargo test -p shadowstep-macros --test compile_fail` writes the messages anew; read them.

#[test]
fn faults_are_compile_errors() {
    trybuild::TestCases::new().compile_fail("tests/compile_fail/*.rs");
}
