//! Compiles `steps.c` twice: as programs for all processors are, `gcc -O3`, and for this one, `gcc -O3 -march=native`.

use std::path::PathBuf;
use std::process::Command;

fn main() {
    let folder = PathBuf::from(std::env::var("OUT_DIR").expect("cargo sets it"));
    let objects = ["steps", "native"].map(|name| folder.join(name).with_extension("o"));
    let names = ["set_initial", "verlet", "scheme", "one_by_one"].map(|name| format!("-D{name}=native_{name}"));
    run(Command::new("gcc").args(["-O3", "-c", "steps.c", "-o"]).arg(&objects[0]));
    run(Command::new("gcc").args(["-O3", "-march=native"]).args(names).args(["-c", "steps.c", "-o"]).arg(&objects[1]));
    run(Command::new("ar").arg("crs").arg(folder.join("libsteps.a")).args(&objects));
    println!("cargo::rustc-link-search=native={}", folder.display());
    println!("cargo::rustc-link-lib=static=steps");
    println!("cargo::rustc-link-lib=m");
    println!("cargo::rerun-if-changed=steps.c");
    println!("cargo::rerun-if-changed=augmented.h");
    println!("cargo::rerun-if-changed=../c");
}

fn run(command: &mut Command) {
    assert!(command.status().expect("gcc is installed").success(), "{command:?}");
}
