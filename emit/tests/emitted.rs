//! What is emitted, as its readers see it: texts of very different schemes, and refusals.

use shadowstep::tables::{shipped, shipped_names};
use shadowstep_emit::{Target, emit};

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
