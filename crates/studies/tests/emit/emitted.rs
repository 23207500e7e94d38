//! What is emitted, as its readers see it: texts of very different schemes, and refusals.

use std::process::Command;

use shadowstep::tables::{Source, TableScheme, read, shipped, shipped_names};
use shadowstep_scenes::reserved_names::Language;
use shadowstep_studies::emit::{Target, emit};

fn emitted(name: &str, target: Target) -> String {
    emit(&shipped(name).unwrap(), target).unwrap()
}

/// Texts to be read. That they compute what Shadowstep computes is tested by `c.rs` and by `make test-emit`.
#[test]
fn texts() {
    let of_kinds = [
        ("stormer-verlet", Target::Python),
        ("wisdom-kernel-3", Target::Python),
        ("omelyan-4mn3f3gv", Target::Jax),
        ("yoshida4", Target::C),
        ("chin-4a", Target::Fortran),
        ("blanes6-7", Target::Julia),
        ("blanes-moan-s6", Target::Openmm),
        ("bcss3", Target::Blackjax),
        ("omelyan-4mn5fp", Target::Mici),
        ("ruth3", Target::Sundials),
        ("saba2", Target::Petsc),
        ("bcr764", Target::Latex),
    ];
    for (name, target) in of_kinds {
        insta::assert_snapshot!(format!("{name}-{target}"), emitted(name, target));
    }
}

#[test]
fn every_scheme_is_emitted_or_refused_in_a_sentence() {
    for name in shipped_names() {
        let scheme = shipped(name).unwrap();
        for &target in Target::ALL {
            match emit(&scheme, target) {
                Ok(text) => {
                    assert!(text.contains(&format!("from the table {name}")), "{name} {target}");
                    assert!(!text.contains('‹') && !text.contains("SCHEME_"), "{name} {target}");
                    let longest = text.lines().map(|line| line.chars().count()).max().unwrap();
                    assert!(
                        longest <= 132 || target != Target::Fortran,
                        "{name} {target}: {longest} columns, Fortran has 132"
                    );
                }
                Err(refusal) => {
                    let nested = scheme.proved().scheme.inner.is_some();
                    let tables = [Target::Openmm, Target::Blackjax, Target::Mici, Target::Sundials, Target::Petsc];
                    let limited = nested || tables.contains(&target);
                    assert!(limited && refusal.to_string().starts_with(name), "{refusal}");
                }
            }
        }
    }
}

#[test]
fn refusals() {
    let refusals = [
        ("chin-4a", Target::Openmm),
        ("ruth3", Target::Blackjax),
        ("takahashi-imada", Target::Mici),
        ("wisdom-corrector-3", Target::Sundials),
        ("blanes-moan-srkn11b", Target::Petsc),
        ("r-respa-4", Target::C),
    ];
    let sentences = refusals.map(|(name, target)| emit(&shipped(name).unwrap(), target).unwrap_err().to_string());
    insta::assert_snapshot!(sentences.join("\n"));
    let unknown = "matlab".parse::<Target>().unwrap_err().to_string();
    assert!(Target::ALL.iter().all(|target| unknown.contains(target.name())), "{unknown}");
}

/// A scheme of a name: Störmer–Verlet.
fn named(name: &str, title: &str) -> TableScheme {
    let text = format!(
        "name = {name:?}\ntitle = {title:?}\norder = 2\nkinetic = \"any\"\n[stages]\nkick = [\"1/2\", \"1/2\"]\ndrift \
            = [1, 0]\n"
    );
    let source = Source { path: "mine.toml".to_owned(), text };
    read(&source, &|_, _| None, None).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Keywords and modules, and names that a header or a first line could take for something else.
#[test]
fn code_is_valid_whatever_a_scheme_is_named() {
    let more =
        ["coding", "1-2", "int", "double", "main", "s", "a1", "kepler", "step", "system", "module", "end", "class"];
    let names = Language::Python
        .reserved()
        .iter()
        .map(|name| name.to_lowercase().replace('_', "-"))
        .chain(more.map(str::to_owned));
    let folder = tempfile::tempdir().unwrap();
    let is_valid = |program: &str, options: &[&str], code: String| {
        let path = folder.path().join("code.h");
        std::fs::write(&path, &code).unwrap();
        let output = Command::new(program).args(options).arg(path).output().expect("the program runs");
        assert!(output.status.success(), "{}\n{code}", String::from_utf8_lossy(&output.stderr));
    };
    let reads = "import ast, re, sys; text = open(sys.argv[1], 'rb').read(); ast.parse(text)\n\
                 for line in re.findall(r'^ *(from \\w+ import \\w+)', text.decode(), re.M): ast.parse(line)";
    for name in names {
        let scheme = named(&name, "coding: of \"\"\" and */ \\ a test");
        for target in [Target::Python, Target::Jax, Target::Openmm, Target::Blackjax, Target::Mici] {
            is_valid("python3", &["-B", "-c", reads], emit(&scheme, target).unwrap());
        }
        let options = ["-DSELF_TEST", "-std=c99", "-Wall", "-Werror", "-fsyntax-only", "-x", "c"];
        is_valid("cc", &options, emit(&scheme, Target::C).unwrap());
    }
    for name in Language::Julia.reserved() {
        let julia = emit(&named(&name.to_lowercase(), "a module"), Target::Julia).unwrap();
        let module = julia.lines().find_map(|line| line.strip_prefix("module ")).unwrap();
        assert!(!Language::Julia.reserved().contains(&module), "{module}");
    }
    let long = emit(&named(&"a".repeat(46), "long"), Target::Fortran).unwrap_err().to_string();
    assert!(long.contains("has a name of 46 letters"), "{long}");
}
