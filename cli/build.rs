//! The version that the program reports: with the commit in releases, whose results others may want to compute again.

use std::env;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-env-changed=SHADOWSTEP_COMMIT");
    let version = env!("CARGO_PKG_VERSION");
    let version = match env::var("SHADOWSTEP_COMMIT").ok().or_else(of_checkout).filter(|commit| !commit.is_empty()) {
        Some(commit) => format!("{version} ({})", commit.get(..12).unwrap_or(&commit)),
        None => version.to_owned(),
    };
    println!("cargo::rustc-env=SHADOWSTEP_VERSION={version}");
}

/// The commit of the folder around this one where that is a checkout of git, which a crate of crates.io has not. Not in
/// builds for tests, which would be compiled again after each commit.
fn of_checkout() -> Option<String> {
    if env::var("PROFILE").as_deref() != Ok("release") || !Path::new("../.git").exists() {
        return None;
    }
    println!("cargo::rerun-if-changed={}", git(&["rev-parse", "--git-path", "logs/HEAD"])?);
    git(&["rev-parse", "HEAD"])
}

fn git(words: &[&str]) -> Option<String> {
    let output = Command::new("git").args(words).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
