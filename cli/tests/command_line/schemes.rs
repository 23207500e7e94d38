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
    // schemes of different orders are not mixed by their errors
    assert!(listed("--sort effective-error").is_sorted_by_key(order));
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
    let records = listed("");
    let verlet = records.iter().find(|record| text(record, "name") == "stormer-verlet").unwrap();
    assert_eq!((&verlet["products_per_dimension"], &verlet["products_for_beta"]), (&3.into(), &2.into()));
    assert_eq!(verlet["stability_limit_per_force"], 2.0);
}

/// Weights are exact fractions for machines, and shortened for people.
#[test]
fn a_scheme_is_shown_as_it_is_listed_with_weights_that_sum_to_one() {
    for record in listed("") {
        let name = text(&record, "name");
        let shown = &objects(&quietly(&format!("schemes show {name} --json")))[0];
        for key in ["evaluations", "products_per_dimension", "products_for_beta"] {
            assert_eq!(record[key], shown[key], "{key} of {name}");
        }
        for weights in ["kick", "drift"] {
            let texts = shown[weights].as_array().unwrap();
            assert_eq!(texts.len() as u64, shown["stages"].as_u64().unwrap());
            let sum: Rational = texts.iter().map(|w| exact(w.as_str().unwrap()).unwrap()).sum();
            assert_eq!(sum, exact("1").unwrap(), "{name}: {weights}");
        }
    }
    let longest = |words: &str| quietly(words).split(|c: char| !c.is_ascii_digit()).map(str::len).max().unwrap();
    assert!(longest("schemes show yoshida4") <= 40 && longest("schemes show yoshida4 --json") > 250);
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
    let record = &objects(&quietly(&format!("schemes show {path} --json")))[0];
    // sha256sum of the text of GOOD
    assert_eq!(text(record, "table_hash"), "fb848e90951b9f630ec36b7a58ef7253c6edd423278397e74987e1b3cf71864a");
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
fn schemes_of_multiple_time_steps_and_of_near_integrable_systems_are_listed_where_they_are() {
    let record = &objects(&quietly("schemes show nested-s6 --json"))[0];
    let resonance = &record["inner"]["resonances"][1]["ratio"];
    assert_eq!((&record["inner"]["fast_evaluations"], resonance), (&36.into(), &"1/10".into()));
    let unwrapped = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let [second, eighth] = ["2", "8"].map(|order| unwrapped(quietly(&format!("schemes --order {order}"))));
    for text in ["r-respa-4, r-respa-8: multiple time steps", "A + εB: orders such as (8,4)"] {
        assert!(second.contains(text), "{second}");
    }
    assert!(!eighth.contains("multiple time steps") && !eighth.contains("A + εB: orders"), "{eighth}");
    let record = &objects(&quietly("schemes show LF8_6_4 --json"))[0];
    assert_eq!((text(record, "name"), text(record, "dominant")), ("aba864", "drift"));
    assert_eq!(record["aliases"], serde_json::json!(["SABA(8,6,4)", "LF8_6_4"]));
    assert_eq!(record["near_integrable"], serde_json::json!([8, 6, 4]));
    assert_eq!(record["leading_error"]["terms"][3]["coefficient"], 0.0, "what the digits do not tell from 0");
    assert!(listed("--order 2").iter().any(|scheme| scheme["near_integrable"] == serde_json::json!([4, 2])));
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
