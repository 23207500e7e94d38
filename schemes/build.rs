//! Lists the tables of `tables/`, so that adding a scheme is adding a file.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let tables = Path::new(&env::var("CARGO_MANIFEST_DIR").expect("cargo sets it")).join("tables");
    println!("cargo::rerun-if-changed={}", tables.display());
    let files = fs::read_dir(&tables)
        .expect("the tables are part of the crate")
        .map(|entry| entry.expect("the folder can be read").path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"));
    let named = |file: PathBuf| (file.file_stem().expect("a file has a name").to_string_lossy().into_owned(), file);
    let mut list = String::from("[\n");
    for (name, file) in files.map(named).collect::<BTreeMap<_, _>>() {
        writeln!(list, "    ({name:?}, include_str!({:?})),", file.display().to_string()).expect("memory suffices");
    }
    list.push(']');
    let out = Path::new(&env::var("OUT_DIR").expect("cargo sets it")).join("shipped.rs");
    fs::write(out, list).expect("the build folder can be written");
}
