//! Protects users from licences that they do not expect: every dependency can be used under MIT OR Apache-2.0, except
//! GMP and MPFR.

use std::process::Command;

use serde_json::Value;

/// Licences that ask for no more than a notice.
const PERMISSIVE: [&str; 10] = [
    "MIT",
    "MIT-0",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Bindings to GMP and MPFR, which are under the LGPL. Without the feature `mpfr`, a user's crate does not have them.
const WEAK_COPYLEFT: [(&str, &str); 2] = [("gmp-mpfr-sys", "LGPL-3.0+"), ("rug", "LGPL-3.0+")];

/// Whether one of the alternatives of a licence expression is permissive; `/` is an old form of OR.
fn is_permissive(expression: &str) -> bool {
    let expression = expression.replace(['(', ')'], "").replace('/', " OR ");
    // of `(MIT OR Apache-2.0) AND Unicode-3.0` each part has to be permissive
    expression.split(" AND ").all(|part| part.split(" OR ").any(|licence| PERMISSIVE.contains(&licence.trim())))
}

#[test]
fn expressions_are_read() {
    for permissive in ["MIT", "MIT/Apache-2.0", "LGPL-2.1-or-later OR MIT", "(MIT OR Apache-2.0) AND Unicode-3.0"] {
        assert!(is_permissive(permissive), "{permissive}");
    }
    for other in ["GPL-3.0", "LGPL-3.0+", "MIT AND GPL-2.0", "MITX", ""] {
        assert!(!is_permissive(other), "{other}");
    }
}

#[test]
fn dependencies_are_permissive_except_gmp_and_mpfr() {
    let arguments = ["metadata", "--format-version=1", "--locked", "--offline"];
    let output = Command::new(env!("CARGO")).args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    assert!(packages.len() > 50);
    let of = |package: &Value, field: &str| package[field].as_str().unwrap_or_default().to_owned();
    let all: Vec<_> = packages.iter().map(|package| (of(package, "name"), of(package, "license"))).collect();
    let mut others: Vec<_> = all.iter().filter(|(_, licence)| !is_permissive(licence)).collect();
    others.sort();
    let named: Vec<_> = WEAK_COPYLEFT.map(|(name, licence)| (name.to_owned(), licence.to_owned())).into();
    assert_eq!(others, named.iter().collect::<Vec<_>>(), "see CONTRIBUTING.md, Dependencies");
}
