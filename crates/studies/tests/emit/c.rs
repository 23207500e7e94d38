//! The emitted C, compiled and run: the bits of Shadowstep, and a self-test that can fail.
//!
//! `-ffp-contract=off`: else a compiler for a processor with fused products may round a product and a sum once, not
//! twice.

use std::fs;
use std::process::{Command, Output};

use shadowstep::tables::{shipped, shipped_names};
use shadowstep_studies::emit::{Target, emit};

/// Compiles a header with its self-test, and runs it.
fn self_test(code: &str, more: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let (header, program) = (folder.path().join("scheme.h"), folder.path().join("test"));
    fs::write(&header, code).unwrap();
    let options = ["-DSELF_TEST", "-O2", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"];
    let compiled = Command::new("cc")
        .args(options)
        .args(more)
        .args(["-x", "c"])
        .arg(&header)
        .args(["-lm", "-o"])
        .arg(&program)
        .output()
        .unwrap();
    assert!(compiled.status.success(), "{}\n{code}", String::from_utf8_lossy(&compiled.stderr));
    Command::new(program).output().unwrap()
}

fn text(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[test]
fn the_bits_and_the_orders_of_all_schemes() {
    let of_two_parts = |name: &&str| shipped(name).unwrap().proved().scheme.inner.is_none();
    for name in shipped_names().into_iter().filter(of_two_parts) {
        let code = emit(&shipped(name).unwrap(), Target::C).unwrap();
        let output = self_test(&code, &["-ffp-contract=off"]);
        assert!(output.status.success(), "{name}: {}", text(&output));
        assert!(
            text(&output).starts_with(&format!("{name}: 1000 steps of 1/64: the bits of Shadowstep\n")),
            "{}",
            text(&output)
        );
    }
}

#[test]
fn a_wrong_digit_of_any_weight_is_seen() {
    for name in ["yoshida4", "chin-4a", "omelyan-4mn3f3gv", "wisdom-corrector-3"] {
        let code = emit(&shipped(name).unwrap(), Target::C).unwrap();
        let weights: Vec<_> = code.lines().filter(|line| line.starts_with("static const double")).collect();
        for &line in &weights {
            let (before, number) = line.split_once(" = ").unwrap();
            let (number, after) = number.split_once(';').unwrap();
            let wrong = number.parse::<f64>().unwrap() * (1.0 + 1e-6);
            let output = self_test(&code.replace(line, &format!("{before} = {wrong};{after}")), &["-ffp-contract=off"]);
            assert!(!output.status.success(), "{name}, {line}: {}", text(&output));
            assert!(text(&output).ends_with("the self-test has failed\n"));
        }
    }
}

#[test]
fn fused_products_pass_with_their_distance() {
    if !cfg!(target_arch = "x86_64") || !std::path::Path::new("/proc/cpuinfo").exists() {
        return;
    }
    let has_fused = fs::read_to_string("/proc/cpuinfo").unwrap().split_whitespace().any(|flag| flag == "fma");
    if has_fused {
        let code = emit(&shipped("sofroniou-spaletta10-35").unwrap(), Target::C).unwrap();
        let output = self_test(&code, &["-mfma", "-ffp-contract=fast"]);
        assert!(output.status.success() && text(&output).contains(" from Shadowstep"), "{}", text(&output));
    }
}

/// Samplers in C++ include it.
#[test]
fn headers_are_c_plus_plus_too() {
    for name in ["bcss3", "chin-4a", "blanes6-7"] {
        let folder = tempfile::tempdir().unwrap();
        let header = folder.path().join("scheme.h");
        fs::write(&header, emit(&shipped(name).unwrap(), Target::C).unwrap()).unwrap();
        let options = ["-std=c++11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", "-x", "c++"];
        let checked = Command::new("c++").args(options).arg(&header).output().unwrap();
        assert!(checked.status.success(), "{name}: {}", String::from_utf8_lossy(&checked.stderr));
    }
}
