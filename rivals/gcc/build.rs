//! Compiles `steps.c` as a user of C would: `gcc -O3 -march=native`.

use std::path::PathBuf;
use std::process::Command;

fn main() {
    let folder = PathBuf::from(std::env::var("OUT_DIR").expect("cargo sets it"));
    let object = folder.join("steps.o");
    run(Command::new("gcc").args(["-O3", "-march=native", "-c", "steps.c", "-o"]).arg(&object));
    run(Command::new("ar").arg("crs").arg(folder.join("libsteps.a")).arg(&object));
    println!("cargo::rustc-link-search=native={}", folder.display());
    println!("cargo::rustc-link-lib=static=steps");
    println!("cargo::rustc-link-lib=m");
    println!("cargo::rerun-if-changed=steps.c");
    println!("cargo::rerun-if-changed=../c");
}

fn run(command: &mut Command) {
    assert!(command.status().expect("gcc is installed").success(), "{command:?}");
}
