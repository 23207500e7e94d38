//! `shadowstep schemes` and tables in files.

use std::fs;
use std::path::Path;

use crate::program::{objects, quietly, shadowstep, text};
use shadowstep::tables::shipped_names;
use shadowstep::{Rational, exact};

const GOOD: &str = "\
name = \"mine\"
order = 4
kinetic = \"any\"
symmetric = true
reference = \"an exercise\"

[constants]
g = \"1/(2 - 2^(1/3))\"

[composition]
base = \"stormer-verlet\"
gamma = [\"g\", \"1 - 2*g\", \"g\"]
";

fn write(folder: &Path, name: &str, table: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, table).unwrap();
    path.display().to_string()
}

#[test]
fn all_shipped_tables_are_listed() {
    let table = quietly("schemes");
    let records = objects(&quietly("schemes --json"));
    assert_eq!(records.len(), shipped_names().len());
    for name in shipped_names() {
        assert!(
            table.lines().any(|line| line.trim_end().ends_with(&format!(" {name}"))),
            "{name} is missing in\n{table}"
        );
        assert!(records.iter().any(|record| text(record, "name") == name), "{name}");
    }
    let verlet = records.iter().find(|record| text(record, "name") == "stormer-verlet").unwrap();
    assert_eq!((&verlet["order"], &verlet["evaluations"]), (&2.into(), &1.into()));
    assert_eq!((&verlet["symmetric"], &verlet["digits"]), (&true.into(), &serde_json::Value::Null));
}

fn listed(flags: &str) -> Vec<serde_json::Value> {
    objects(&quietly(&format!("schemes --json {flags}")))
}

/// For every T(p); with gradient kicks, for quadratic T only.
fn order(record: &serde_json::Value) -> Option<u64> {
    record["order"].as_u64().or_else(|| record["order_quadratic"].as_u64())
}

#[test]
fn the_list_is_sorted_by_the_key() {
    let number = |record: &serde_json::Value, field: &str| record[field].as_f64().unwrap();
    let rises = |flags: &str, value: &dyn Fn(&serde_json::Value) -> f64| {
        let values: Vec<f64> = listed(flags).iter().map(value).collect();
        assert!(values.len() > 1 && values.is_sorted(), "{flags}: {values:?}");
    };
    rises("", &|r| order(r).unwrap() as f64);
    rises("--for quadratic", &|r| number(r, "order_quadratic"));
    rises("--for any", &|r| number(r, "order"));
    rises("--order 4 --sort evaluations", &|r| number(r, "evaluations"));
    rises("--order 4 --sort effective-error", &|r| number(r, "effective_error"));
    rises("--order 4 --sort effective-error --for quadratic", &|r| number(r, "effective_error_quadratic"));
    rises("--order 4 --sort stability", &|r| -text(r, "stability_limit").parse::<f64>().unwrap());
    let names: Vec<String> = listed("--order 6 --sort name").iter().map(|r| text(r, "name").to_owned()).collect();
    assert!(names.is_sorted(), "{names:?}");
}

#[test]
fn the_list_is_filtered_by_order_and_kinetic_energy() {
    for (flags, field) in [("--order 4", "order"), ("--order 4 --for quadratic", "order_quadratic")] {
        let all = listed("").into_iter().filter(|record| record[field] == 4).count();
        let records = listed(flags);
        assert!(records.len() == all && records.iter().all(|record| record[field] == 4), "{flags}");
    }
    let table = quietly("schemes --order 4 --sort name");
    assert!(table.contains(" yoshida4") && !table.contains("stormer-verlet"), "{table}");
}

#[test]
fn schemes_of_different_orders_are_not_mixed_by_their_errors() {
    let records = listed("--sort effective-error");
    assert!(records.is_sorted_by_key(order), "{records:?}");
}

#[test]
fn for_any_kinetic_energy_only_schemes_that_move_any_are_listed() {
    let names = |flags: &str| listed(flags).iter().map(|r| text(r, "name").to_owned()).collect::<Vec<_>>();
    let [all, any] = ["--order 4", "--order 4 --for any"].map(names);
    let quadratic_only = |name: &str| all.contains(&name.to_owned()) && !any.contains(&name.to_owned());
    assert!(quadratic_only("blanes-moan-srkn11b") && !quadratic_only("blanes-moan-srkn6b"), "{any:?}");
    let line = line_of("--order 4", "blanes-moan-srkn11b");
    assert!(line.starts_with(&["4", "(6)"].map(str::to_owned)), "{line:?}");
    assert!(line.ends_with(&["quadratic", "T", "blanes-moan-srkn11b"].map(str::to_owned)), "{line:?}");
}

#[test]
fn a_custom_table_is_listed_among_the_shipped_ones() {
    let folder = tempfile::tempdir().unwrap();
    let table =
        "name = \"mine\"\norder = 1\nkinetic = \"any\"\nreference = \"Euler\"\n[stages]\nkick = [1]\ndrift = [1]\n";
    let path = write(folder.path(), "mine.toml", table);
    let records = listed(&format!("{path} --order 4 --sort stability"));
    assert_eq!(records.len(), listed("--order 4").len() + 1);
    let custom: Vec<_> = records.iter().filter(|record| record["shipped"] == false).collect();
    assert_eq!((custom.len(), text(custom[0], "name"), &custom[0]["order"]), (1, path.as_str(), &1.into()));
    let result = shadowstep("schemes shwo yoshida4");
    assert_eq!(result.code, 2);
    assert!(result.err.contains("did you mean `shadowstep schemes show`?"), "{}", result.err);
    let result = shadowstep("schemes yoshida4");
    assert!(result.err.contains("write: shadowstep schemes show yoshida4"), "{}", result.err);
}

#[test]
fn the_list_fits_a_terminal() {
    for flags in ["", "--for any", "--for quadratic"] {
        for line in quietly(&format!("schemes {flags}")).lines() {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}

/// The line of a scheme, by words.
fn line_of(flags: &str, name: &str) -> Vec<String> {
    let table = quietly(&format!("schemes {flags}"));
    let line = table.lines().find(|line| line.trim_end().ends_with(&format!(" {name}")));
    line.unwrap_or_else(|| panic!("{name} is missing in\n{table}")).split_whitespace().map(str::to_owned).collect()
}

#[test]
fn the_list_shows_what_one_chooses_by() {
    let verlet = ["2", "1", "0.3052", "2.000", "yes", "every", "T(p)", "stormer-verlet"];
    assert_eq!(line_of("--order 2", "stormer-verlet"), verlet);
    // for quadratic T, its order and its error
    let classes = ["--order 4 --for any", "--order 4 --for quadratic"];
    let [any, quadratic] = classes.map(|flags| line_of(flags, "blanes-moan-srkn6b"));
    assert_eq!((any[2].as_str(), quadratic[2].as_str()), ("0.6975", "0.2911"));
    assert_eq!(line_of("--order 6 --for quadratic", "blanes-moan-srkn11b")[0], "6");
    assert!(line_of("--order 4", "aba864").ends_with(&["A+εB", "(8,6,4)", "aba864"].map(str::to_owned)));
}

/// The plan has 3 maps of Störmer–Verlet and 2 kicks: 3 products per dimension, 2 more for β.
#[test]
fn the_cost_of_a_step_is_in_the_wide_list_and_in_json() {
    let wide = line_of("--wide --order 2", "stormer-verlet");
    assert_eq!(wide[..6], ["2", "2", "2", "1", "3", "2"].map(str::to_owned));
    let records = listed("--order 2");
    let verlet = records.iter().find(|record| text(record, "name") == "stormer-verlet").unwrap();
    assert_eq!((&verlet["products_per_dimension"], &verlet["products_for_beta"]), (&3.into(), &2.into()));
    assert_eq!(verlet["stability_limit_per_force"], 2.0);
    for record in &records {
        let shown = &objects(&quietly(&format!("schemes show {} --json", text(record, "name"))))[0];
        for key in ["evaluations", "products_per_dimension", "products_for_beta"] {
            assert_eq!(record[key], shown[key], "{key} of {}", text(record, "name"));
        }
    }
    assert_eq!(shadowstep("schemes --wide --json").code, 2);
}

#[test]
fn unknown_words_for_the_list_are_refused() {
    for (flags, sentence) in [
        ("--order 11", "11 is out of range: write a whole number from 1 to 10"),
        ("--order four", "invalid value 'four' for '--order <ORDER>'"),
        ("--sort speed", "[possible values: effective-error, stability, evaluations, name, order]"),
        ("--for cubic", "[possible values: any, quadratic]"),
        ("--order 4 show ruth3", "`show` is not the file of a table"),
    ] {
        let result = shadowstep(&format!("schemes {flags}"));
        assert_eq!((result.code, result.out.as_str()), (2, ""), "{flags}");
        assert!(result.err.contains(sentence), "{flags}: {}", result.err);
    }
    let result = shadowstep("schemes --order 9 --json");
    assert_eq!((result.code, result.out.as_str()), (0, ""));
    assert!(
        result.err.starts_with("note: no shipped scheme has order 9 for every T(p) (--for quadratic"),
        "{}",
        result.err
    );
}

#[test]
fn show_analyses_a_scheme() {
    let verlet = &objects(&quietly("schemes show stormer-verlet --json"))[0];
    let terms = serde_json::json!([
        {"bracket": "[K,[K,D]]", "coefficient": -1.0 / 24.0},
        {"bracket": "[D,[D,K]]", "coefficient": 1.0 / 12.0},
    ]);
    assert_eq!((&verlet["leading_error"]["power"], &verlet["leading_error"]["terms"]), (&3.into(), &terms));
    assert_eq!(verlet["effective_error"], 0.3052367917903922);
    assert_eq!((text(verlet, "stability_limit"), &verlet["unstable_gaps"]), ("2", &serde_json::json!([])));
    assert_eq!(verlet["phase_error"], serde_json::json!({"coefficient": 1.0 / 24.0, "power": 2}));
    assert_eq!(verlet["trace"], serde_json::json!(["2", "-1"]));
    let kicks = serde_json::json!({"sum_of_sizes": "1", "smallest": "1/2", "largest": "1/2"});
    assert_eq!(verlet["kick_sizes"], kicks);

    let yoshida = &objects(&quietly("schemes show yoshida4 --json"))[0];
    let gap = &yoshida["unstable_gaps"][0];
    assert_eq!(gap["from"], yoshida["stability_limit"]);
    assert!(text(yoshida, "stability_limit").starts_with("1.5734") && gap["to"].is_null(), "{gap}");
    assert_eq!(text(yoshida, "stability_limit").len(), 31, "30 digits and a point");

    // however the lines break
    let readable = quietly("schemes show ruth3").split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "effective error: 0.7366 for every T(p), 0.7339 for quadratic T",
        "2.1701e-3 [K,[K,[K,D]]], 1.3889e-2 [K,[D,[K,D]]], -4.6296e-3 [D,[D,[D,K]]]",
        "stable up to hω = 2.5074811709523554",
        "phase error: 6.3657e-4 (hω)^4",
        "from -1/24 to 3/4, sizes sum to 13/12",
    ] {
        assert!(readable.contains(part), "{part} is missing in\n{readable}");
    }
}

#[test]
fn other_names_and_near_integrable_orders_are_shown() {
    let record = &objects(&quietly("schemes show LF8_6_4 --json"))[0];
    assert_eq!(text(record, "name"), "aba864");
    assert_eq!(record["aliases"], serde_json::json!(["SABA(8,6,4)", "LF8_6_4"]));
    assert_eq!(record["near_integrable"], serde_json::json!([8, 6, 4]));
    assert_eq!(record["leading_error"]["terms"][3]["coefficient"], 0.0, "what the digits do not tell from 0");
    assert_eq!((text(record, "dominant"), &record["free"]), ("drift", &serde_json::json!([])));
    let readable = quietly("schemes show aba864");
    for part in
        ["also named:      SABA(8,6,4), LF8_6_4", "orders (8,6,4) in the powers of ε, where the drifts move by A"]
    {
        assert!(readable.contains(part), "{part} is missing in\n{readable}");
    }
    assert!(readable.split_whitespace().collect::<Vec<_>>().join(" ").contains("with H = T + U it gains nothing"));
    assert!(quietly("schemes --order 2").contains("A + εB: orders such as (8,4)"));
    assert!(!quietly("schemes --order 8").contains("A + εB: orders"));
    let listed = objects(&quietly("schemes --order 2 --json"));
    assert!(listed.iter().any(|scheme| scheme["near_integrable"] == serde_json::json!([4, 2])));
}

/// With 12 digits the conditions still hold to 11: that order 6 is proved to 11 digits is true, but not that the table
/// has the digits of such a scheme.
#[test]
fn a_digit_that_rounding_does_not_explain_is_a_negative_answer() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kahan-li.toml").display().to_string();
    let table = |second: &str| {
        format!(
            "name = \"mine\"\norder = 6\nkinetic = \"any\"\nsymmetric = true\ndigits = 12\nreference = \"Kahan and \
                Li\"\n[constants]\n\
             g1 = \"0.392161444007\"\ng2 = \"{second}\"\ng3 = \"-0.706246172558\"\ng4 = \"0.082213596294\"\n\
             g5 = \"1 - 2*(g1 + g2 + g3 + g4)\"\n\
             [composition]\nbase = \"stormer-verlet\"\ngamma = \
             [\"g1\", \"g2\", \"g3\", \"g4\", \"g5\", \"g4\", \"g3\", \"g2\", \"g1\"]\n"
        )
    };
    let check = |second: &str| {
        fs::write(&path, table(second)).unwrap();
        shadowstep(&format!("schemes check {path}"))
    };
    let right = check("0.332599136789");
    assert_eq!(right.code, 0, "{}{}", right.out, right.err);
    assert!(
        right.out.ends_with(": proved: order 6 for every T(p), to 13 digits, symmetric; is kahan-li6 to 11 digits\n"),
        "{}",
        right.out
    );
    let exchanged = check("0.332599136798");
    assert_eq!(exchanged.code, 1, "{}", exchanged.out);
    let verdict = "to 11 digits, symmetric; its printed digits are not all those of such a scheme; is kahan-li6 to 10 \
        digits\nnote: ";
    assert!(exchanged.out.contains(verdict), "{}", exchanged.out);
    assert!(exchanged.out.contains("rounding does not explain the digits of `g2`"), "{}", exchanged.out);
}

/// Weights that are closed forms have as many digits as the run.
#[cfg(feature = "mpfr")]
#[test]
fn algebraic_weights_have_the_digits_of_the_run() {
    let drift = |digits: &str| {
        let words = format!(
            "drift kepler --scheme yoshida4 --step 1/20 --until 1 --order 2 --json --no-summary --digits {digits}"
        );
        crate::program::objects(&quietly(&words)).remove(0)
    };
    let [few, many] = ["400", "420"].map(drift);
    let digits =
        |object: &serde_json::Value| crate::program::text(object, "last").chars().take(390).collect::<String>();
    assert_eq!(digits(&few), digits(&many));
}

/// PEFRL is stable to 2.9894 and again from 3.5054; its phase is too slow at first.
#[test]
fn stages_stability_and_phase_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pefrl.svg");
    let plot = format!("schemes show pefrl --plot {}", path.display());
    assert!(quietly(&plot).starts_with("pefrl: "));
    let picture = fs::read_to_string(&path).unwrap();
    assert_eq!(picture.matches("<svg").count(), 4, "three charts in one");
    for text in
        ["q: drifts", "p: kicks", "stable to 2.9894", "again from 3.5054", "2 cos hω", "too slow", "-6.054e-5 (hω)"]
    {
        assert!(picture.contains(text), "{text} is missing");
    }
    assert!(!picture.contains('−'), "numbers can be searched");
    let again = shadowstep(&plot);
    assert_eq!(again.code, 2, "a file that exists is not replaced");
    assert!(again.err.contains("--force"), "{}", again.err);
    quietly(&format!("{plot} --force"));
}

/// The trace hardly shows the gaps of 9e-4 and 1e-3 below the end at 9.0736, so that each has a mark.
#[test]
fn thin_gaps_of_stability_are_marked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("thin.svg");
    quietly(&format!("schemes show blanes-moan-srkn11b --plot {}", path.display()));
    let picture = fs::read_to_string(&path).unwrap();
    for text in ["gap at 3.1414, 9e-4 wide", "gap at 6.3479, 1e-3 wide", "but for gaps stable to 9.0736"] {
        assert!(picture.contains(text), "{text} is missing");
    }
    assert!(!picture.contains(">stable to"), "it is not stable to there");
}

#[test]
fn weights_for_machines_are_fractions() {
    let fractions = |name: &str, key: &str| objects(&quietly(&format!("schemes show {name} --json")))[0][key].clone();
    assert_eq!(fractions("ruth3", "drift"), serde_json::json!(["2/3", "-2/3", "1"]));
    let first = fractions("aba864", "kick")[1].as_str().unwrap().to_owned();
    let (numerator, denominator) = first.split_once('/').unwrap();
    let digits = |text: &str| text.len() > 240 && text.bytes().all(|byte| byte.is_ascii_digit());
    assert!(digits(numerator) && digits(denominator), "{first}");
}

#[test]
fn the_hash_is_that_of_the_table_as_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "mine.toml", GOOD);
    let record = &objects(&quietly(&format!("schemes show {path} --json")))[0];
    // sha256sum of the text of GOOD
    assert_eq!(text(record, "table_hash"), "fb848e90951b9f630ec36b7a58ef7253c6edd423278397e74987e1b3cf71864a");
}

#[test]
fn exact_weights_sum_to_one() {
    for name in shipped_names() {
        let record = &objects(&quietly(&format!("schemes show {name} --json")))[0];
        for weights in ["kick", "drift"] {
            let texts = record[weights].as_array().unwrap();
            assert_eq!(texts.len() as u64, record["stages"].as_u64().unwrap());
            let sum: Rational = texts.iter().map(|w| exact(w.as_str().unwrap()).unwrap()).sum();
            assert_eq!(sum, exact("1").unwrap(), "{name}: {weights}");
        }
    }
}

#[test]
fn show_lists_what_is_proved() {
    let record = &objects(&quietly("schemes show ruth3 --json"))[0];
    assert_eq!((&record["order"], &record["order_digits"]), (&3.into(), &serde_json::Value::Null));
    assert_eq!(record["fails"]["order"], 4);
    assert_eq!(record["symmetric"], false);
    assert_eq!(text(record, "first"), "kick");
    assert_eq!(text(record, "doi"), "10.1109/TNS.1983.4332919");
    assert_eq!(record["maps"][4], serde_json::json!({"map": "kick", "weight": "-1/24"}));
    let readable = quietly("schemes show ruth3");
    for part in ["Ruth's third-order scheme", "order 3, exactly", "needed 1/24", "-2/3", "10.1109/TNS.1983.4332919"] {
        assert!(readable.contains(part), "{part} is missing in\n{readable}");
    }
}

#[test]
fn long_weights_are_shortened_for_people_only() {
    let longest = |text: &str| text.split(|c: char| !c.is_ascii_digit()).map(str::len).max().unwrap();
    assert!(longest(&quietly("schemes show yoshida4")) <= 40);
    assert!(longest(&quietly("schemes show yoshida4 --json")) > 250);
}

#[test]
fn check_proves_a_good_table() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "mine.toml", GOOD);
    let result = quietly(&format!("schemes check {path}"));
    assert!(result.starts_with(&format!("{path}: proved: order 4 for every T(p), to ")), "{result}");
    let shipped = quietly("schemes check LF8_6_4");
    assert!(shipped.starts_with("LF8_6_4: proved: order 4 for every T(p), (8,6,4) for A + εB, to "), "{shipped}");
}

/// The lists of a source: the names, the orders, the schemes; what is wrong with one is a negative answer.
#[test]
fn check_finds_schemes_in_sources() {
    let folder = tempfile::tempdir().unwrap();
    let source = "w1 = 1/(2 - 2**(1/3))\nfourth_order = [w1, 1 - 2*w1, w1]\nx = [0.25, 0.5]\n\
                  b1, a1 = 0.11888010966548, 0.29619504261126\nyoshida = [b1, a1, 0.5 - b1, 1 - 2*a1, 0.5 - b1, a1, b1]\n";
    let path = write(folder.path(), "integrators.py", source);
    let found = shadowstep(&format!("schemes check --from {path}"));
    assert_eq!(found.code, 1, "{}{}", found.out, found.err);
    let lines: Vec<_> = found.out.lines().collect();
    assert_eq!(lines[0], format!("{path}:2: fourth_order: composition of a symmetric step of order 2"));
    assert!(
        lines[1].starts_with("  order 4, to 29") && lines[1].ends_with("symmetric; is yoshida4 exactly"),
        "{}",
        lines[1]
    );
    assert_eq!(lines[2], format!("{path}:5: yoshida: kicks and drifts in turn"));
    assert!(lines[3].starts_with("  order 2, ") && lines[3].contains("is bcss3 to 13 digits"), "{}", lines[3]);
    assert!(
        lines[4].starts_with("  wrong: it is named after Yoshida, whose schemes have order 4 and more"),
        "{}",
        lines[4]
    );
    assert_eq!(*lines.last().unwrap(), "schemes: 2, of which wrong: 1; lists that are not schemes: 1");
    let right = write(folder.path(), "right.py", source.split("b1").next().unwrap());
    assert!(
        quietly(&format!("schemes check --from {right}"))
            .ends_with("schemes: 1, of which wrong: 0; lists that are not schemes: 1\n")
    );
}

#[test]
fn check_notes_claims_below_the_proved_order() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "mine.toml", &GOOD.replace("order = 4", "order = 3"));
    let result = quietly(&format!("schemes check {path}"));
    assert!(result.contains("order 3 is claimed, order 4 holds"), "{result}");
    assert!(result.contains(&format!("note: {path}:2:9:")), "{result}");
}

#[test]
fn a_table_with_the_name_of_a_shipped_scheme_is_noted() {
    let folder = tempfile::tempdir().unwrap();
    let verlet = fs::read_to_string("../schemes/tables/stormer-verlet.toml").unwrap();
    let other = verlet
        .replace("kick  = [\"1/2\", \"1/2\"]", "kick  = [0, 1]")
        .replace("drift = [1, 0]", "drift = [\"1/2\", \"1/2\"]");
    let (same, other) = (write(folder.path(), "same.toml", &verlet), write(folder.path(), "other.toml", &other));
    let remark =
        format!("note: the table in {other} is named stormer-verlet like a shipped scheme, and has other weights");
    let commands = [format!("schemes check {other}"), format!("schemes show {other}")];
    for command in commands {
        let result = shadowstep(&command);
        assert!(result.code == 0 && result.err.contains(&remark), "{command}: {}", result.err);
    }
    assert_eq!(shadowstep(&format!("schemes check {same}")).err, "");
    let run = format!("trace --problem kepler --step 1/10 --until 1 --double --no-summary --scheme {other}");
    assert!(shadowstep(&run).err.contains(&remark), "{}", shadowstep(&run).err);
}

#[test]
fn check_shows_the_place_of_each_fault() {
    let folder = tempfile::tempdir().unwrap();
    let good = write(folder.path(), "good.toml", GOOD);
    let wrong = write(folder.path(), "wrong.toml", &GOOD.replace("2^(1/3)", "2^(1/2)"));
    let result = shadowstep(&format!("schemes check {wrong} {good}"));
    assert_eq!(result.code, 1, "{}", result.err);
    assert!(result.out.starts_with(&format!("{wrong}:2:9: order 4 is claimed, order 2 holds")), "{}", result.out);
    assert!(result.out.contains("  2 | order = 4\n    |         ^\n  found "), "{}", result.out);
    assert!(result.out.contains(&format!("{good}: proved")), "the others are checked too: {}", result.out);
}

#[test]
fn a_file_that_cannot_be_read_weighs_more_than_a_fault() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = write(folder.path(), "wrong.toml", "order = 4\n");
    let result = shadowstep(&format!("schemes check nowhere.toml {wrong}"));
    assert_eq!(result.code, 2);
    assert!(result.err.starts_with("error: there is no file nowhere.toml\n  hint: "), "{}", result.err);
    assert!(result.out.contains("the key `name` is missing"), "{}", result.out);
}

#[test]
fn show_takes_files_and_names_only() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "mine.toml", GOOD);
    assert!(quietly(&format!("schemes show {path}")).starts_with("mine\n"));
    let result = shadowstep("schemes show yoshda4");
    assert_eq!(result.code, 2);
    assert!(result.err.contains("did you mean `yoshida4`?"), "{}", result.err);
}

fn run(scheme: &str) -> String {
    format!("drift --problem pendulum --scheme {scheme} --step 1/10 --until 1 --digits 40 --order 4 --json")
}

#[test]
fn a_composition_of_a_shipped_base_runs_like_the_shipped_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "mine.toml", GOOD);
    let mine = &objects(&quietly(&run(&path)))[0];
    let shipped = &objects(&quietly(&run("yoshida4")))[0];
    assert_eq!(text(mine, "scheme"), path);
    assert_eq!(text(mine, "drift"), text(shipped, "drift"));
}

#[test]
fn a_base_beside_the_table_comes_before_a_shipped_one() {
    let folder = tempfile::tempdir().unwrap();
    let drift_first = "\
name = \"stormer-verlet\"
order = 2
kinetic = \"any\"
reference = \"an exercise\"

[stages]
kick = [0, 1]
drift = [\"1/2\", \"1/2\"]
";
    write(folder.path(), "stormer-verlet.toml", drift_first);
    let path = write(folder.path(), "mine.toml", GOOD);
    let show = &objects(&quietly(&format!("schemes show {path} --json")))[0];
    assert_eq!(text(show, "first"), "drift");
    // a shipped table has no base from here
    let composed = GOOD.replace("\"stormer-verlet\"", "\"yoshida4\"").replace("2^(1/3)", "2^(1/5)");
    let path = write(folder.path(), "deeper.toml", &composed.replace("order = 4", "order = 6"));
    let show = &objects(&quietly(&format!("schemes show {path} --json")))[0];
    assert_eq!((text(show, "first"), &show["order"]), ("kick", &6.into()));
}

#[test]
fn cyclic_and_far_bases_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mine = write(folder.path(), "mine.toml", &GOOD.replace("stormer-verlet", "other"));
    write(folder.path(), "other.toml", &GOOD.replace("stormer-verlet", "mine"));
    let result = shadowstep(&format!("schemes check {mine}"));
    assert!(result.code == 1 && result.out.contains("this composition is cyclic"), "{}", result.out);
    let far = write(folder.path(), "far.toml", &GOOD.replace("stormer-verlet", "../far"));
    let result = shadowstep(&format!("schemes check {far}"));
    assert!(result.code == 1 && result.out.contains("there is no table `../far`"), "{}", result.out);
}

#[test]
fn a_faulty_table_does_not_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "mine.toml", &GOOD.replace("order = 4", "order = 5"));
    let result = shadowstep(&run(&path));
    assert_eq!((result.code, result.out.as_str()), (2, ""));
    assert!(result.err.starts_with(&format!("error: {path}:2:9: order 5 is claimed, order 4 holds")), "{}", result.err);
}

/// The resonance is that of the analysis, whose tests hold it beside steps that are made.
#[test]
fn a_scheme_of_multiple_time_steps_is_shown_as_one() {
    let unwrapped = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let shown = unwrapped(quietly("schemes show r-respa-4"));
    for fact in [
        "H of three parts: slow forces, fast forces and T",
        "order 2, exactly; of order 3, the condition of the word AAB fails: found 1/8, needed 1/6",
        "4 steps of stormer-verlet in each drift of the outer scheme",
        "1 evaluation of the slow forces, 4 of the fast ones",
        "1/100 of the stiffness of its fast ones is unstable for hω from 3.04630 to 3.07673, 3.043e-2 wide, and in 2 \
            other intervals up to 8",
    ] {
        assert!(shown.contains(fact), "{fact}: {shown}");
    }
    assert!(!shown.contains("effective error"), "{shown}");
    let record = &objects(&quietly("schemes show nested-s6 --json"))[0];
    assert_eq!(record["inner"]["fast_evaluations"], 36);
    assert_eq!(record["inner"]["resonances"][1]["ratio"], "1/10");
    assert!(unwrapped(quietly("schemes --order 2")).contains("r-respa-4, r-respa-8: multiple time steps"));
    assert!(!quietly("schemes --order 8").contains("multiple time steps"));
}

#[test]
fn a_scheme_with_the_other_map_first_is_called_so() {
    let folder = tempfile::tempdir().unwrap();
    let table = "name = \"mine\"\ntitle = \"drifts first\"\norder = 4\nkinetic = \"any\"\n[constants]\nw = \"1/(2 - \
        2^(1/3))\"\nv = \"1 - 2*w\"\n\
                 [stages]\nkick = [\"0\", \"w\", \"v\", \"w\"]\ndrift = [\"w/2\", \"(w + v)/2\", \"(w + \
                 v)/2\", \"w/2\"]\n";
    let path = write(folder.path(), "mine.toml", table);
    let checked = shadowstep(&format!("schemes check {path}"));
    assert!(checked.out.ends_with("; is yoshida4 exactly, with the other map first\n"), "{}", checked.out);
}
