//! `shadowstep emit`: files, refusals, and tables of one's own. What is emitted is tested in `crates/studies/tests/emit`.

use std::fs;

use crate::program::shadowstep;

const MINE: &str = r#"
name = "mine"
order = 4
kinetic = "any"

[constants]
g = "1/(2 - 2^(1/3))"

[composition]
base = "stormer-verlet"
gamma = ["g", "1 - 2*g", "g"]
"#;

#[test]
fn a_table_in_a_file_is_emitted_to_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let [table, module] = ["mine.toml", "mine.py"].map(|name| folder.path().join(name).display().to_string());
    fs::write(&table, MINE).unwrap();
    let command = format!("emit {table} --to python --output {module}");
    let result = shadowstep(&command);
    assert_eq!((result.code, result.out.as_str()), (0, ""), "{}", result.err);
    let text = fs::read_to_string(&module).unwrap();
    assert!(text.starts_with("# mine: a splitting scheme\n#\n# Unpublished.\n# Proved: order 4"), "{text}");
    assert_eq!(text, shadowstep(&format!("emit {table} --to python")).out);
    let again = shadowstep(&command);
    assert_eq!(again.code, 2, "a file that exists is not replaced");
    assert!(again.err.contains("exists"), "{}", again.err);
    assert_eq!(shadowstep(&format!("{command} --force")).code, 0);
}

#[test]
fn a_faulty_table_is_refused_with_the_place() {
    let folder = tempfile::tempdir().unwrap();
    let [table, module] = ["mine.toml", "mine.h"].map(|name| folder.path().join(name).display().to_string());
    fs::write(&table, MINE.replace("2^(1/3)", "2^(-1/3)")).unwrap();
    let result = shadowstep(&format!("emit {table} --to c --output {module}"));
    assert_eq!(result.code, 2);
    assert!(result.err.contains(&format!("{table}:3:9: order 4 is claimed, order 2 holds")), "{}", result.err);
    assert!(!fs::exists(module).unwrap());
}

#[test]
fn what_a_target_cannot_express_is_refused_in_a_sentence() {
    let result = shadowstep("emit chin-4a --to sundials");
    assert_eq!((result.code, result.out.as_str()), (2, ""));
    assert!(result.err.contains("chin-4a has gradient kicks, which a table of SPRKStep cannot make"), "{}", result.err);
    assert!(result.err.contains("hint: emit it to python, jax, c, julia or fortran"), "{}", result.err);
    let unknown = shadowstep("emit yoshida4 --to matlab");
    assert_eq!(unknown.code, 2);
    assert!(unknown.err.contains("possible values: python, jax, c"), "{}", unknown.err);
}
