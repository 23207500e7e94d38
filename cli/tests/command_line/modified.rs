//! `shadowstep modified`: series, formulas in all notations, refusals. The formulas are held against modified energies
//! in `scenes`.

use std::fs;
use std::process::Command;

use shadowstep_scenes::reserved_names::Language;

use crate::program::shadowstep;

fn out(command: &str) -> String {
    let result = shadowstep(command);
    assert_eq!((result.code, &*result.err), (0, ""), "{command}");
    result.out
}

/// The function of a problem whose coordinates and parameters have these names.
fn function(names: [&[String]; 2], notation: &str) -> String {
    let [coordinates, parameters] = names;
    let quoted = |names: &[String]| names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    let numbered = |names: &[String]| (1..).zip(names.to_vec()).collect::<Vec<_>>();
    let quartic = numbered(coordinates).into_iter().map(|(i, x)| format!("{x}^4/{i} + sin({x})*{i}"));
    let scaled = numbered(parameters).into_iter().map(|(i, k)| format!("{k}*{i}*{}^3", coordinates[0]));
    // in groups, as a chain of operators is not long
    let terms: Vec<_> = quartic.chain(scaled).collect();
    let potential = terms.chunks(20).map(|terms| format!("({})", terms.join(" + "))).collect::<Vec<_>>().join(" + ");
    let values: Vec<_> = parameters.iter().map(|k| format!("{k} = 1")).collect();
    let zeros = vec!["0"; coordinates.len()].join(", ");
    let text = format!(
        "[problem]\npotential = \"{potential}\"\ncoordinates = [{}]\nparameters = {{ {} }}\n[initial]\nq = \
            [{zeros}]\np = [{zeros}]\n",
        quoted(coordinates),
        values.join(", ")
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("names.toml");
    fs::write(&path, text).unwrap();
    out(&format!("modified stormer-verlet {} --grade 2 --to {notation}", path.display()))
}

/// What a program prints.
fn printed(program: &mut Command) -> f64 {
    let output = program.output().expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().trim().parse().unwrap()
}

/// The value of a function with this number of arguments besides h.
fn value(code: &str, language: Language, count: usize) -> f64 {
    let folder = tempfile::tempdir().unwrap();
    let arguments: String = (1..=count).map(|i| format!(", 1.0/{}.0", i + 2)).collect();
    let file = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).unwrap();
        folder.path().join(name)
    };
    match language {
        Language::Rust => {
            let main = format!("fn main() {{ println!(\"{{:e}}\", modified_hamiltonian(0.5{arguments})); }}\n");
            let (path, program) = (file("main.rs", &format!("{code}{main}")), folder.path().join("main"));
            let mut compiler = Command::new("rustc");
            let compiled =
                compiler.args(["--edition", "2024", "--cap-lints", "allow", "-o"]).arg(&program).arg(path).output();
            let compiled = compiled.expect("rustc runs");
            assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
            printed(&mut Command::new(program))
        }
        _ => {
            file("numpy.py", "from math import *\n");
            let path = file("main.py", &format!("{code}\n\nprint(modified_hamiltonian(0.5{arguments}))\n"));
            printed(Command::new("python3").arg("-B").arg(path))
        }
    }
}

/// Keywords, names of the function, functions of formulas and of the languages; `pi` and columns are no names of a
/// problem.
#[test]
fn code_computes_the_same_whatever_the_names_are() {
    let others = "sin cos exp log sqrt cbrt atan powi x px E f64 i32 usize fn_ h_ total_ np_ math numpy print float \
        abs sum list int union raw safe auto match case type drop Box Vec String Option Result Default Clone Copy \
        Send Sync Fn FnMut Drop Iterator From Into ToString std core main println assert panic vec u e d H result";
    for (language, notation) in [(Language::Python, "numpy"), (Language::Rust, "rust")] {
        let mut names: Vec<String> = language.reserved().iter().map(|name| (*name).to_owned()).collect();
        names.extend(others.split_whitespace().map(str::to_owned));
        names.sort_unstable();
        names.dedup();
        let plain: Vec<String> = (1..=names.len()).map(|i| format!("name{i}")).collect();
        let [x, px] = [&["q".to_owned()][..], &["total".to_owned()][..]];
        let is_momentum = |name: &&String| name.strip_prefix('p').is_some_and(|own| names.iter().any(|x| x == own));
        let coordinates: Vec<String> = names.iter().filter(|name| !is_momentum(name)).cloned().collect();
        for (own, expected) in [
            ([&coordinates[..], &[]], [&plain[..coordinates.len()], &[]]),
            ([x, &names], [x, &plain]),
            ([px, &names[..1]], [px, &plain[..1]]),
        ] {
            let count = 2 * own[0].len() + own[1].len();
            let found = value(&function(own, notation), language, count);
            let reference = value(&function(expected, "numpy"), Language::Python, count);
            // sums of some 150 terms, in another order perhaps
            assert!((found - reference).abs() <= 1e-13 * reference.abs(), "{language:?}: {found} for {reference}");
        }
    }
}

#[test]
fn titles_end_no_comment_and_no_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a\"\"\"\nwrong(\\u.toml");
    fs::write(&path, "[problem]\npotential = \"x^4\"\ncoordinates = [\"x\"]\n[initial]\nq = [1]\np = [0]\n").unwrap();
    for (language, notation) in [(Language::Python, "numpy"), (Language::Rust, "rust")] {
        let mut program = Command::new(env!("CARGO_BIN_EXE_shadowstep"));
        let output = program.args(["modified", "stormer-verlet"]).arg(&path).args(["--to", notation]).output().unwrap();
        assert!(value(&String::from_utf8(output.stdout).unwrap(), language, 2).is_finite());
    }
}

#[test]
fn a_name_of_the_series_is_noted_and_one_of_transformed_time_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("h.toml");
    let write = |parameter: &str, time: &str| {
        let text = format!(
            "[problem]\npotential = \"-1/sqrt(h^2 + {parameter})\"\ncoordinates = [\"h\"]\nparameters = {{ \
                {parameter} = 1 }}\n[initial]\nq = [1]\np = [0]\n{time}"
        );
        fs::write(&path, text).unwrap();
        shadowstep(&format!("modified stormer-verlet {} --grade 2", path.display()))
    };
    let noted = write("k", "");
    assert!(noted.code == 0 && noted.err.contains("`h` in the formulas is of the problem"), "{}", noted.err);
    let refused = write("pt", "[time]\ntransform = \"logarithmic\"\n");
    assert!(
        refused.code == 2 && refused.err.contains("`pt` is of transformed time, and of the problem"),
        "{}",
        refused.err
    );
}
