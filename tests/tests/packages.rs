//! Protects what registries show of the packages: every crate that is published has an address, a page, words to be
//! found by; the address stands in one place.

use std::path::Path;
use std::process::Command;
use std::{fs, str};

use serde_json::Value;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the tests are in a folder of the project")
}

/// What cargo knows of the crates of the workspace that are published.
fn published() -> Vec<Value> {
    let words = ["metadata", "--no-deps", "--offline", "--locked", "--format-version", "1"];
    let output = Command::new(env!("CARGO")).args(words).current_dir(root()).output().unwrap();
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let crates = metadata["packages"].as_array().unwrap().iter();
    crates.filter(|package| package["publish"].is_null()).cloned().collect()
}

#[test]
fn published_crates_say_who_they_are() {
    let crates = published();
    assert!((5..=8).contains(&crates.len()), "{} crates are published", crates.len());
    for package in crates {
        let name = package["name"].as_str().unwrap();
        for key in ["description", "license", "repository", "homepage", "readme", "rust_version"] {
            assert!(package[key].is_string(), "{name} has no {key}");
        }
        let description = package["description"].as_str().unwrap();
        assert!(!description.contains(". ") && description.len() < 160, "{name}: one sentence: {description}");
        assert_eq!(package["documentation"], format!("https://docs.rs/{name}"));
        // the limits of crates.io
        for (key, most) in [("keywords", 5), ("categories", 5)] {
            let words = package[key].as_array().unwrap();
            assert!((1..=most).contains(&words.len()), "{name}: {key}");
            assert!(
                words.iter().all(|word| word.as_str().unwrap().len() <= 20 || key == "categories"),
                "{name}: {key}"
            );
        }
        for dependency in package["dependencies"].as_array().unwrap() {
            // crates and the code that macros generate use each other's internals
            let needs_version = dependency["path"].is_string() && dependency["kind"] != "dev";
            let same_version = format!("={}", package["version"].as_str().unwrap());
            assert!(!needs_version || dependency["req"] == same_version, "{name}: version of {}", dependency["name"]);
        }
    }
}

#[test]
fn the_address_is_in_one_place() {
    let crates = published();
    let address = crates[0]["repository"].as_str().unwrap();
    assert!(
        address.starts_with("https://") && crates.iter().all(|package| package["repository"] == address),
        "{address}"
    );
    let listed = Command::new("git").args(["grep", "-lF", address]).current_dir(root()).output();
    // a packed tree is not a checkout
    let Some(listed) = listed.ok().filter(|output| output.status.success()) else { return };
    assert_eq!(str::from_utf8(&listed.stdout), Ok("Cargo.toml\n"), "files that have the address {address}");
}

#[test]
fn what_is_cited_has_the_version_of_the_crates() {
    let cited = fs::read_to_string(root().join("CITATION.cff")).unwrap();
    let version = cited.lines().find_map(|line| line.strip_prefix("version: ")).unwrap();
    assert_eq!(version, env!("CARGO_PKG_VERSION"));
}

/// With a table of its own in the profile Cargo does not strip a program.
#[test]
fn the_program_is_stripped() {
    let manifest: toml::Table = toml::from_str(&fs::read_to_string(root().join("Cargo.toml")).unwrap()).unwrap();
    let release = &manifest["profile"]["release"];
    assert_eq!(release["strip"].as_bool(), Some(true));
    let tables = release["package"].as_table().unwrap();
    assert!(tables.contains_key("shadowstep-scenes") && !tables.contains_key("shadowstep-cli"), "{tables:?}");
}
