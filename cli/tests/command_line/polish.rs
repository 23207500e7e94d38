//! `shadowstep schemes polish`.

use std::fs;

use tempfile::TempDir;

use crate::program::{quietly, shadowstep};

/// Yoshida's solution D of order 8 with his 20 digits.
const PRINTED: &str = "\
name = \"yoshida8d\"
title = \"Yoshida's solution D\"   # table 2
order = 8
kinetic = \"any\"
symmetric = true
digits = 20
reference = \"H. Yoshida, Phys. Lett. A 150 (1990) 262-268\"

[constants]
w7 = \"0.914844246229642658287\"
w6 = \"0.253693336566286009974\"
w5 = \"-1.44485223686030647660\"
w4 = \"-0.158240635368502468458\"
w3 = \"1.93813913762291232471\"
w2 = \"-1.96061023297558163691\"
w1 = \"0.102799849392219431139\"
w0 = \"1 - 2*(w1 + w2 + w3 + w4 + w5 + w6 + w7)\"

[composition]
base = \"stormer-verlet\"
gamma = [\"w7\", \"w6\", \"w5\", \"w4\", \"w3\", \"w2\", \"w1\", \"w0\", \"w1\", \"w2\", \"w3\", \"w4\", \"w5\", \"w6\", \"w7\"]
";

fn printed(text: &str) -> (TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("printed.toml").display().to_string();
    fs::write(&path, text).unwrap();
    (folder, path)
}

#[test]
fn the_polished_table_is_proved_to_the_requested_digits() {
    let (folder, path) = printed(PRINTED);
    let output = folder.path().join("polished.toml").display().to_string();
    let result = shadowstep(&format!("schemes polish {path} --output {output}"));
    assert_eq!((result.code, result.out.as_str()), (0, ""));
    // stderr: what was done, and what the printed digits were worth
    assert!(result.err.contains("order 8 for every T(p), symmetric: 8 conditions in the γ's"), "{}", result.err);
    assert!(result.err.contains("up to 9 of the printed digits are wrong; conditions off by"), "{}", result.err);

    let proved = quietly(&format!("schemes check {output}"));
    let digits = proved.split("to ").nth(1).unwrap().split(' ').next().unwrap();
    assert!(proved.contains("order 8 for every T(p)") && digits.parse::<u32>().unwrap() >= 300, "{proved}");
    let text = fs::read_to_string(&output).unwrap();
    assert!(text.contains("# table 2\norder = 8\n") && text.contains("digits = 300\n"), "{text}");
    assert!(text.contains("w0 = \"1 - 2*(w1 + w2 + w3 + w4 + w5 + w6 + w7)\""), "{text}");
    assert!(text.contains("w7 = \"0.91484424622979156674"), "{text}");

    // what is polished stays as it is, and is written to stdout too
    let again = shadowstep(&format!("schemes polish {output}"));
    assert_eq!((again.code, again.out), (0, text));
    assert!(again.err.contains("every printed digit is right"), "{}", again.err);
}

#[test]
fn a_table_that_cannot_be_polished_gives_exit_code_1_and_no_output() {
    let (folder, path) = printed(&PRINTED.replace("order = 8", "order = 10"));
    let output = folder.path().join("polished.toml").display().to_string();
    let result = shadowstep(&format!("schemes polish {path} --output {output}"));
    assert_eq!((result.code, result.out.as_str()), (1, ""));
    assert!(result.err.starts_with("error: ") && result.err.contains("16 conditions for 7 decimals"), "{}", result.err);
    assert!(result.err.contains("condition number"), "{}", result.err);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "the printed table only");

    let (_folder, path) = printed(&PRINTED.replace("\"w6\", \"w7\"]", "\"w6\", \"w6\"]"));
    let result = shadowstep(&format!("schemes polish {path}"));
    assert_eq!(result.code, 1);
    assert!(result.err.contains("a palindrome is claimed, this weight is not what it mirrors"), "{}", result.err);
}

#[test]
fn near_integrable_orders_are_solved_too() {
    // McLachlan's (8, 4) method: order 4 alone leaves 2 of its 6 decimals free
    let table = "name = \"aba84\"\norder = 4\nkinetic = \"any\"\nsymmetric = true\nreference = \"McLachlan 1995\"\n\
                 [stages]\n\
                 kick = [0, 0.1901, 0.8468, -1.0738, 0.8468, 0.1901]\n\
                 drift = [0.0753, 0.5179, -0.0932, -0.0932, 0.5179, 0.0753]\n";
    let (_folder, path) = printed(&table.replace("[stages]", "near_integrable = [8, 4]\n[stages]"));
    let result = shadowstep(&format!("schemes polish {path} --digits 30"));
    assert_eq!(result.code, 0, "{}", result.err);
    assert!(result.err.contains("order 4 for every T(p), (8,4) for A + εB, symmetric: 6 conditions"), "{}", result.err);
    assert!(result.err.lines().all(|line| !line.contains("leave it free")), "{}", result.err);
    let (_folder, path) = printed(table);
    let alone = shadowstep(&format!("schemes polish {path} --digits 30"));
    assert_eq!(alone.err.lines().filter(|line| line.contains("leave it free")).count(), 2, "{}", alone.err);
}

const REMARK: &str = "seems to be misprinted";

/// The report on a published table with other digits in one place.
fn with_misprint(name: &str, right: &str, wrong: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/analysis/tests/published");
    let text = fs::read_to_string(format!("{folder}/{name}.toml")).unwrap();
    assert!(text.contains(right), "{name}: {right}");
    let (_folder, path) = printed(&text.replace(right, wrong));
    let result = shadowstep(&format!("schemes polish {path} --digits 40"));
    assert_eq!(result.code, 0, "{}", result.err);
    result.err
}

#[test]
fn a_misprinted_weight_is_named() {
    let (_folder, path) = printed(&PRINTED.replace("0.25369333", "0.25639333"));
    let result = shadowstep(&format!("schemes polish {path}"));
    assert_eq!(result.code, 0, "{}", result.err);
    assert!(result.err.contains("note: w6 seems to be misprinted: 2 of its 21 digits are right"), "{}", result.err);
    assert!(result.err.contains(": w6 has 19 wrong digits, the others up to 9"), "{}", result.err);
    // two digits transposed far behind
    let result = with_misprint("yoshida6-a", "0.235573213359358", "0.235573213395358");
    assert!(result.contains("note: g2 seems to be misprinted: 10 of its 20 digits are right"), "{result}");
    assert!(result.contains(": g2 has 10 wrong digits, the others up to 1"), "{result}");
    let result = with_misprint("aba864", "0.31078285989857486", "0.31078285989857846");
    assert!(result.contains("note: kick[3] seems to be misprinted: 14 of its"), "{result}");
}

/// Yoshida's C and D are wrong throughout, and the small weight of his 6C was printed to digits that were not computed.
#[test]
fn an_error_as_large_as_the_others_is_not_a_misprint() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/analysis/tests/published");
    for file in fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()) {
        let name = file.file_stem().unwrap().to_str().unwrap();
        if name.starts_with("yoshida") {
            let result = shadowstep(&format!("schemes polish {} --digits 40", file.display()));
            assert!(result.code == 0 && !result.err.contains(REMARK), "{name}: {}", result.err);
        }
    }
}

#[test]
fn messages_use_singular_and_plural() {
    let verlet = "name = \"v\"\norder = 2\nkinetic = \"any\"\nreference = \"a test\"\n[constants]\na = 0.5\n\
                  [stages]\nkick = [\"a\", \"a\"]\ndrift = [1, 0]\n";
    let (_folder, path) = printed(verlet);
    let result = shadowstep(&format!("schemes polish {path}"));
    assert!(result.code == 0 && result.out.contains("digits = 300\n"), "{}", result.err);
    let composed = PRINTED.replace("\"stormer-verlet\"", "\"yoshida4\"").replace("order = 8", "order = 4");
    let (_folder, path) = printed(&composed);
    let result = shadowstep(&format!("schemes polish {path}"));
    assert_eq!(result.code, 0, "as many digits as can be: {}", result.err);
    assert!(result.err.contains("order 4 for every T(p), symmetric: 1 condition in the γ's"), "{}", result.err);
    assert!(result.err.contains(": formulas meet the conditions, whatever the decimals are"), "{}", result.err);
}
