//! Writes a struct for every shipped table, so that a new table is tested without a line of code.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use shadowstep_schemes::{First, MapKind, Proved, StepPlan, read, read_first, shipped, shipped_names};

fn main() {
    println!("cargo::rerun-if-changed=build.rs"); // a change of the tables rebuilds the crate that lists them
    let mut code = String::new();
    let [mut visits, mut visits_for_every_kinetic, mut visits_of_kinds, mut names] = [const { String::new() }; 4];
    let mut kinds_of_steps = BTreeSet::new();
    for name in shipped_names() {
        let kinds = [("", "", "None"), ("DriftFirst", ", first = \"drift\"", "Some(First::Drift)")];
        for (suffix, argument, first) in kinds {
            // steps of many parts have tests of their own
            let two_parts = |proved: &Proved| proved.scheme.inner.is_none();
            let Some(proved) = proved(name, !suffix.is_empty()).filter(two_parts) else { continue };
            let ident = camel(name) + suffix;
            writeln!(
                code,
                "#[derive(Clone, Copy, Debug)]\n#[splitting_scheme(\"{name}.toml\"{argument})]\npub struct {ident};\n"
            )
            .unwrap();
            let visit = format!("    visitor.visit({name:?}, {first}, &{ident});\n");
            if proved.holds_for_every_kinetic() {
                visits_for_every_kinetic += &visit;
            }
            visits += &visit;
            if kinds_of_steps.insert(kind_of_step(&proved)) {
                visits_of_kinds += &visit;
            }
            names += &format!("    ({name:?}, {first}),\n");
        }
    }
    write!(
        code,
        "/// Shows a visitor every shipped scheme; with the roles of kick and drift exchanged too, where the\n\
         /// order claimed survives that.\n\
         pub fn for_each(visitor: &mut impl Visitor) {{\n{visits}}}\n\n\
         /// The same for schemes whose order holds for every T(p).\n\
         pub fn for_each_for_every_kinetic(visitor: &mut impl Visitor<General>) {{\n{visits_for_every_kinetic}}}\n\n\
         /// Shows a visitor one scheme of each kind of step, for what would take long to compile for every scheme.\n\
         pub fn for_each_kind_of_step(visitor: &mut impl Visitor) {{\n{visits_of_kinds}}}\n\n\
         /// The names of these schemes, and what the attribute is given.\n\
         pub const NAMES: &[(&str, Option<First>)] = &[\n{names}];\n"
    )
    .unwrap();
    let out = Path::new(&env::var("OUT_DIR").expect("cargo sets it")).join("shipped.rs");
    fs::write(out, code).expect("the build folder can be written");
}

/// `None` for an exchange that changes nothing, or is refused: a compile error, which the compile-fail cases show.
fn proved(name: &str, drift_first: bool) -> Option<Proved> {
    let source = shipped(name).expect("it is listed");
    let library = |base: &str, _: &_| shipped(base);
    let proved = read(&source, &library).expect("shipped tables are proved");
    match drift_first {
        false => Some(proved),
        true if proved.scheme.first() == First::Drift => None,
        true => read_first(&source, &library, Some(First::Drift)).ok(),
    }
}

/// What the generated code of a step depends on, beside its weights and their number: the kinds of its maps, the first
/// of them, whether it is the same backwards, whether it is short enough to be inlined, and whether it has a processor.
fn kind_of_step(proved: &Proved) -> (BTreeSet<MapKind>, MapKind, [bool; 3]) {
    let maps = &proved.plan.maps;
    let kinds = maps.iter().map(|&(kind, _)| kind).collect();
    let is_inlined = maps.len() <= StepPlan::MOST_INLINED;
    (kinds, maps[0].0, [proved.scheme.is_symmetric(), is_inlined, proved.scheme.processor.is_some()])
}

fn camel(name: &str) -> String {
    name.split('-').map(|word| word[..1].to_uppercase() + &word[1..]).collect()
}
