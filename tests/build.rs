//! Writes a struct for every shipped table, so that a new table is tested without a line of code.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use shadowstep_schemes::shipped_names;

fn main() {
    println!("cargo::rerun-if-changed=build.rs"); // a change of the tables rebuilds the crate that lists them
    let mut code = String::new();
    let mut visits = String::new();
    for name in shipped_names() {
        let kinds = [("", "", "None"), ("DriftFirst", ", first = \"drift\"", "Some(First::Drift)")];
        for (suffix, argument, first) in kinds {
            if suffix.is_empty() || survives_exchange(name) {
                let ident = camel(name) + suffix;
                writeln!(code, "#[splitting_scheme(\"{name}.toml\"{argument})]\npub struct {ident};\n").unwrap();
                writeln!(visits, "    visitor.visit({name:?}, {first}, &{ident});").unwrap();
            }
        }
    }
    write!(
        code,
        "/// Shows a visitor every shipped scheme; with the roles of kick and drift exchanged too, where the\n\
         /// order claimed survives that.\n\
         pub fn for_each(visitor: &mut impl Visitor) {{\n{visits}}}\n"
    )
    .unwrap();
    let out = Path::new(&env::var("OUT_DIR").expect("cargo sets it")).join("shipped.rs");
    fs::write(out, code).expect("the build folder can be written");
}

/// A refused exchange is a compile error, which the compile-fail cases show.
fn survives_exchange(name: &str) -> bool {
    use shadowstep_schemes::{First, read_first, shipped};
    let source = shipped(name).expect("it is listed");
    read_first(&source, &|base, _| shipped(base), First::Drift).is_ok()
}

fn camel(name: &str) -> String {
    name.split('-').map(|word| word[..1].to_uppercase() + &word[1..]).collect()
}
