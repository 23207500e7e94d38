//! Protects the structure of the workspace: no files of a crate import each other in a circle, nor do modules of a
//! folder, so that a file or a module can be read, tested and moved with only what it imports.

mod circles;
mod imports;
mod made_up;
mod source;
mod way_of_a_run;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use self::circles::{circles, show};
use self::imports::{Imports, between_modules, imports};
use self::source::Crate;

#[test]
fn no_files_import_each_other_in_a_circle() {
    let (folder, roots) = workspace();
    assert!(roots.len() >= 6, "the crates of the workspace are found: {roots:?}");
    let mut shown = Vec::new();
    for root in roots.iter().map(|(_, root)| root) {
        let imports = imports(&Crate::read(root));
        shown.extend(circles(&imports).iter().map(|circle| show(circle, &imports, &folder)));
    }
    assert!(
        shown.is_empty(),
        "files import each other in a circle: move the names of one arrow into a file that imports none of these files, \
         or into the file that uses them:\n{}",
        shown.join("")
    );
}

#[test]
fn no_modules_import_each_other_in_a_circle() {
    let (folder, roots) = workspace();
    let mut shown = Vec::new();
    for root in roots.iter().map(|(_, root)| root) {
        let imports = imports(&Crate::read(root));
        for inner in folders(&imports) {
            let imports = between_modules(&imports, &inner);
            shown.extend(circles(&imports).iter().map(|circle| show(circle, &imports, &folder)));
        }
    }
    assert!(shown.is_empty(), "modules import each other in a circle:\n{}", shown.join(""));
}

/// The folders of the files of a crate.
fn folders(imports: &Imports) -> BTreeSet<PathBuf> {
    let files = imports.keys().flat_map(|(from, to)| [from, to]);
    files.filter_map(|file| file.parent()).map(Path::to_path_buf).collect()
}

/// The workspace's folder, and of every crate in it (libraries, programs, tests, benchmarks) the package and the root
/// file.
fn workspace() -> (PathBuf, Vec<(String, PathBuf)>) {
    let metadata = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--format-version", "1", "--manifest-path"])
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml"))
        .output()
        .expect("cargo runs");
    assert!(metadata.status.success(), "{}", String::from_utf8_lossy(&metadata.stderr));
    let metadata: serde_json::Value = serde_json::from_slice(&metadata.stdout).expect("cargo metadata writes JSON");
    let text = |value: &serde_json::Value| value.as_str().expect("a text").to_string();
    let list = |value: &serde_json::Value| value.as_array().expect("a list").clone();
    let mut roots = Vec::new();
    for package in list(&metadata["packages"]) {
        for target in list(&package["targets"]) {
            roots.push((text(&package["name"]), PathBuf::from(text(&target["src_path"]))));
        }
    }
    (PathBuf::from(text(&metadata["workspace_root"])), roots)
}
