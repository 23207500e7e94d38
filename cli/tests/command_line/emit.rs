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
    assert_eq!(shadowstep(&format!("{command} --force")).code, 0);
}
