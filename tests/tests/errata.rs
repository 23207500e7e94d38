//! Protects docs/errata-of-published-tables.md: its tables are judged, and what it quotes is what the compiler says of
//! them. `UPDATE_DOCS=1 cargo test -p shadowstep-tests errata` writes its messages and its table of digits anew.

use std::collections::BTreeSet;
use std::fs;
use std::sync::LazyLock;

use num_traits::{Signed, ToPrimitive};
use shadowstep_analysis::polish::{Polished, PolishedWeight, Request, Role, polish, power_of_ten};
use shadowstep_schemes::{First, Proved, Rational, Source, read_first, shipped, shipped_proved};
use shadowstep_tests::pages::{self, assert_page, blocks, project_file, with_messages};
use shadowstep_tests::refusals::{assert_orders, judge, judge_named, printed, printed_with_digits};
use toml::Table;

const PAGE: &str = "docs/errata-of-published-tables.md";
const ANALYSIS_TESTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/analysis/tests");
const DIGITS: [&str; 2] = ["<!-- digits: begin -->\n", "<!-- digits: end -->"];

static TEXT: LazyLock<String> = LazyLock::new(|| project_file(PAGE));

// ---------------------------------------------------------------------------------------------------------------
// The page

/// The table of this name on the page.
fn table(name: &str) -> String {
    pages::table(&TEXT, name).unwrap_or_else(|| panic!("no table {name} on the page"))
}

/// The page has this text, wherever its lines break.
#[track_caller]
fn says(text: &str) {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words(&TEXT).contains(&words(text)), "the page does not say: {text}");
}

fn exchanged(name: &str, first: First) -> String {
    let source = Source { path: format!("{name}.toml"), ..shipped(name).unwrap() };
    read_first(&source, &|base, _| shipped(base), Some(first)).expect_err("roles matter here").to_string()
}

/// The message about a table.
fn message(name: &str) -> String {
    match name {
        "blanes-moan-srkn14a" => exchanged(name, First::Kick),
        "blanes-moan-srkn11b" => exchanged(name, First::Drift),
        "yoshida8-c" | "yoshida8-d" => {
            let proved = judge_named(&format!("{name}.toml"), &printed_with_digits(name, 20)).unwrap();
            proved.notes.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
        }
        _ => judge_named(&format!("{name}.toml"), &table(name)).expect_err("the page shows wrong tables").to_string(),
    }
}

#[test]
fn the_page_has_the_messages_and_digits_that_it_has_to_have() {
    let page = with_messages(&TEXT, |_, old| message(old.split(".toml").next().expect("the name of a table")));
    let (head, rest) = page.split_once(DIGITS[0]).expect("a table of digits");
    let (_, tail) = rest.split_once(DIGITS[1]).expect("its end");
    assert_page(PAGE, &[head, DIGITS[0], &digits_table(), DIGITS[1], tail].concat());
}

#[test]
fn every_table_has_its_message_below() {
    let blocks = blocks(&TEXT);
    let (mut sums, mut tables) = (0, 0);
    for pair in blocks.windows(2).filter(|pair| pair[0].0 == "toml") {
        let [(_, table), (language, message)] = pair else { unreachable!("two") };
        let name = table.split('"').nth(1).expect("a table begins with its name");
        assert!(*language == "text" && message.starts_with(&format!("{name}.toml:")), "{table}");
        tables += 1;
        sums += usize::from(message.contains("do not sum to 1"));
    }
    says(&format!("A test of the sums alone would have found {sums} of the {tables} tables that are refused above."));
}

/// The first table's orders, claimed and proved, agree with the messages.
#[test]
fn the_overview_agrees_with_the_messages() {
    for (name, row) in [
        ("mcate42", "`McAte42`"),
        ("mclachlan4", "`McLachlan4`"),
        ("thermostat3", "Thermostats"),
        ("thermostat5", "Thermostats"),
        ("blanes-moan-srkn14a", "roles exchanged"),
        ("blanes-moan-srkn11b", "roles exchanged"),
        ("kernel764", "`PLF7_6_4`"),
        ("product4", "Product formulas"),
        ("recursion4", "Product formulas"),
        ("blackjax-yoshida", "BlackJAX"),
    ] {
        let message = message(name);
        let number = |after: &str| message.split(after).nth(1).unwrap().split(' ').next().unwrap();
        let claimed = if name == "kernel764" { "(7,6,4)".to_owned() } else { format!("order {}", number(": order ")) };
        let row = TEXT.lines().find(|line| line.starts_with("| [") && line.contains(row)).unwrap();
        let cells: Vec<_> = row.split('|').map(str::trim).collect();
        assert_eq!((cells[2], cells[3]), (&*claimed, &*format!("order {}", number("claimed, order "))), "{row}");
    }
}

/// Links within the page lead to headings.
#[test]
fn links_lead_somewhere() {
    let anchor = |heading: &str| -> String {
        let kept = heading.to_lowercase().replace(|c: char| !c.is_alphanumeric() && c != ' ' && c != '-', "");
        format!("#{}", kept.trim().replace(' ', "-"))
    };
    let headings: Vec<_> = TEXT.lines().filter(|line| line.starts_with("##")).map(anchor).collect();
    for link in TEXT.split("](#").skip(1) {
        let link = format!("#{}", link.split(')').next().unwrap());
        assert!(headings.contains(&link), "{link} of {headings:?}");
    }
}

/// The schemes that the page recommends are there, with the order for every T(p) that the wrong ones claim.
#[test]
fn what_to_take_instead() {
    let rows = TEXT.lines().filter(|line| line.starts_with("| [")).map(|line| line.split('|').collect::<Vec<_>>());
    let names: Vec<_> = rows.flat_map(|row| row[4].split('`').skip(1).step_by(2).collect::<Vec<_>>()).collect();
    let orders: Vec<_> = names.iter().map(|n| shipped_proved(n).expect(n).proof.general.order).collect();
    assert_eq!(names.len(), 20);
    assert_eq!(orders, [4, 4, 4, 4, 4, 4, 8, 4, 2, 6, 8, 4, 4, 6, 8, 8, 8, 6, 6, 4]);
}

// ---------------------------------------------------------------------------------------------------------------
// What the tables should have been

fn weights(proved: &Proved) -> impl Iterator<Item = &Rational> {
    proved.scheme.stages.kick.iter().chain(&proved.scheme.stages.drift)
}

/// The largest distance between the weights of a table and of a shipped scheme.
#[track_caller]
fn distance(table: &str, name: &str) -> f64 {
    let (mine, shipped) = (judge(table).unwrap_or_else(|faults| panic!("{faults}")), shipped_proved(name).unwrap());
    assert_eq!(mine.scheme.stages.kick.len(), shipped.scheme.stages.kick.len());
    weights(&mine).zip(weights(shipped)).map(|(a, b)| (a - b).abs().to_f64().unwrap()).fold(0.0, f64::max)
}

/// A table of the page with what is wrong there put right.
struct Corrected {
    name: &'static str,
    /// A text, and what it should be.
    texts: &'static [[&'static str; 2]],
    order: u32,
    /// The shipped scheme that it is then, and how near.
    shipped: (&'static str, f64),
}

const CORRECTED: [Corrected; 8] = [
    // all six drifts, and a drift first
    Corrected {
        name: "mcate42",
        texts: &[["kick = [", "kick = [0, "], ["\"1 - 2*(b1 + b2)\"", "\"1/2 - (b1 + b2)\", \"1/2 - (b1 + b2)\""]],
        order: 4,
        shipped: ("mclachlan-sb3a5", 1e-20),
    },
    // a sign was lost
    Corrected { name: "sb3a4", texts: &[["\"0.0215", "\"-0.0215"]], order: 4, shipped: ("mclachlan-sb3a4", 1e-20) },
    // of fifteen weights the middle one is there twice
    Corrected {
        name: "eighth-order",
        texts: &[["\"g8\", \"g8\"", "\"g8\""]],
        order: 8,
        shipped: ("suzuki-umeno8", 2e-14),
    },
    // the third root in place of the fifth and the seventh one
    Corrected { name: "product4", texts: &[["1/7", "1/3"]], order: 4, shipped: ("suzuki4", 1e-290) },
    Corrected { name: "recursion4", texts: &[["1/5", "1/3"]], order: 4, shipped: ("suzuki4", 1e-290) },
    // another scheme under the name
    Corrected { name: "blackjax-yoshida", texts: &[["order = 4", "order = 2"]], order: 2, shipped: ("bcss3", 2e-14) },
    // a digit is missing in the middle of the last weight
    Corrected {
        name: "rebound864",
        texts: &[["0.0653961422823734184559721793911134363710", "0.06539614228237341845597217939161134363710"]],
        order: 4,
        shipped: ("aba864", 2e-39),
    },
    // what stands beside the wrong exponents in the same codes
    Corrected {
        name: "thermostat3",
        texts: &[
            ["order = 4", "order = 6"],
            [
                "gamma = [0.828981543588751, -0.657963087177502, 0.828981543588751]",
                "gamma = [0.784513610477560, 0.235573213359357, -1.17767998417887, 1.31518632068391, \
                 -1.17767998417887, 0.235573213359357, 0.784513610477560]",
            ],
        ],
        order: 6,
        shipped: ("yoshida6-a", 1e-14),
    },
];

#[test]
fn what_the_tables_should_have_been() {
    let digits = CORRECTED.map(|Corrected { name, texts, order, shipped }| {
        let right = texts.iter().fold(table(name), |text, [wrong, right]| {
            assert!(text.contains(wrong), "{name}: {wrong}");
            text.replace(wrong, right)
        });
        assert_orders(&right, order, order);
        let off = distance(&right, shipped.0);
        assert!(off < shipped.1, "{name} is off by {off:e}");
        (name, judge(&right).unwrap().proof.general.digits)
    });
    let digits = |name: &str| digits.iter().find(|row| row.0 == name).and_then(|row| row.1).expect("decimals");
    assert_eq!(digits("sb3a4"), 20);
    says("a step of sixteen weights goes a fifth of its way");
    assert!(message("eighth-order").contains("found 0.203"), "{}", message("eighth-order"));
    says(&format!("With one `g8` order 8 holds to {} digits", digits("eighth-order")));
    says(&format!("Yoshida's solution A, order 6 to {} digits", digits("thermostat3")));
    says("a digit is missing, …793911134… in place of …7939161134…");
    let fewer = |digits: &str| judge(&table("rebound864").replace("digits = 39", digits));
    assert_eq!(fewer("digits = 30").unwrap().proof.general.order, 4);
    assert!(fewer("digits = 34").is_err());
}

#[test]
fn maps_in_the_wrong_order() {
    let wrong = table("mclachlan4");
    let right = format!(
        "{}kick = [\"c5\", \"c1 + c4\", \"c2 + c3\", \"c3 + c2\", \"c4 + c1\", \"c5\"]\n\
         drift = [\"c5 + c1\", \"c4 + c2\", \"c3 + c3\", \"c2 + c4\", \"c1 + c5\", 0]\n",
        &wrong[..wrong.find("kick = ").unwrap()]
    );
    assert_orders(&right, 4, 4);
    assert!(distance(&right, "mclachlan-s5") < 1e-290, "roots are rounded to 300 digits");
}

/// 2^(−1/3) = 0.79… where 2^(1/3) is meant, 4^(−1/3) where 4^(1/3) is.
#[test]
fn an_exponent_with_the_wrong_sign() {
    for (name, base, weight, middle, right) in
        [("thermostat3", 2, "0.828981543588751", 2, "yoshida4"), ("thermostat5", 4, "0.2967324292201065", 4, "suzuki4")]
    {
        let decimals = table(name);
        // the decimals are the formula with the wrong sign
        let formula = |sign: &str| {
            let closed = format!("[constants]\nw = \"1/({base} - {base}^({sign}1/3))\"\n\n[composition]");
            let list = |list: &str| {
                let cells = list.trim_matches(|c| "[]".contains(c)).split(", ");
                let cells =
                    cells.map(|cell| if cell == weight { "\"w\"".to_owned() } else { format!("\"1 - {middle}*w\"") });
                format!("gamma = [{}]", cells.collect::<Vec<_>>().join(", "))
            };
            let (head, gamma) = decimals.trim_end().split_once("gamma = ").unwrap();
            format!("{}{}\n", head.replace("[composition]", &closed).replace("digits = 15\n", ""), list(gamma))
        };
        assert!(judge(&formula("-")).unwrap_err().to_string().contains("order 4 is claimed, order 2 holds"));
        let honest = |text: &str| judge(&text.replace("order = 4", "order = 2")).unwrap();
        let (printed, closed) = (honest(&decimals), honest(&formula("-")));
        for (a, b) in weights(&printed).zip(weights(&closed)) {
            assert!((a - b).abs().to_f64().unwrap() < 1e-15, "15 decimals");
        }
        assert_orders(&formula(""), 4, 4);
        assert!(distance(&formula(""), right) < 1e-290, "roots are rounded to 300 digits");
    }

    for (formula, begins) in [
        ("1/(2 − 2^(1/3))", "1.35"),
        ("1/(4 − 4^(1/3))", "0.414"),
        ("1/(2 − 2^(−1/3))", "0.828"),
        ("1/(4 − 4^(−1/3))", "0.296"),
    ] {
        let value = shadowstep_schemes::to_significant(&shadowstep::exact(&formula.replace('−', "-")).unwrap(), 10);
        assert!(value.starts_with(begins), "{formula} = {value}");
        says(&format!("{formula} = {begins}…"));
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Digits

/// Polished to 60 digits, the named decimals held.
fn polished(text: &str, free: &[String]) -> Polished {
    let source = Source { path: "printed.toml".to_owned(), text: text.to_owned() };
    let wanted = Request { digits: Some(60), free, ..Request::default() };
    polish(&source, &|base, _| shipped(base), &wanted).unwrap_or_else(|refusal| panic!("{text}{refusal}"))
}

fn off(weight: &PolishedWeight) -> f64 {
    (&weight.printed - &weight.polished).abs().to_f64().unwrap()
}

/// The decimal with the most wrong digits, of these the one that is off by most.
fn worst(polished: &Polished) -> &PolishedWeight {
    let solved = polished.weights.iter().filter(|w| matches!(w.role, Role::Solved | Role::Formula));
    let wrong = |w: &PolishedWeight| w.printed_digits - w.right;
    solved.max_by(|a, b| wrong(a).cmp(&wrong(b)).then(off(a).total_cmp(&off(b)))).expect("something to solve for")
}

fn largest_distance(polished: &Polished) -> f64 {
    polished.weights.iter().map(off).fold(0.0, f64::max)
}

/// A row for each composition as printed and for the three schemes by stages of which the page has the decimals.
fn digits_table() -> String {
    let requests: Table = fs::read_to_string(format!("{ANALYSIS_TESTS}/requests.toml")).unwrap().parse().unwrap();
    let free = |name: &str| -> Vec<String> {
        let names = requests.get(name).and_then(|request| request.get("free")?.as_array());
        names.into_iter().flatten().map(|name| name.as_str().unwrap().to_owned()).collect()
    };
    let files = fs::read_dir(format!("{ANALYSIS_TESTS}/published")).unwrap().map(|file| file.unwrap().file_name());
    let names = files.filter_map(|file| Some(file.to_str()?.strip_suffix(".toml")?.to_owned()));
    let mut names: Vec<_> = names.filter(|name| printed(name).contains("[composition]")).collect();
    names.sort();
    let mut tables: Vec<_> = names.iter().map(|name| (format!("`{name}`"), printed(name), free(name))).collect();
    for (name, shipped) in
        [("calvosanz4", "calvo-sanzserna4"), ("mcate4", "mclachlan-atela4"), ("mcate5", "mclachlan-atela5")]
    {
        let text = table(name).replace("\"any\"", "\"quadratic\"");
        let held = if name == "mcate5" { vec!["b4".to_owned()] } else { free(shipped) };
        tables.push((format!("`{shipped}`, as `{name}` above"), text, held));
    }
    let mut rows = "| scheme | digits of the worst decimal | right of these | largest distance | conditions off by |\n\
                    | --- | --: | --: | --: | --: |\n"
        .to_owned();
    for (name, text, free) in tables {
        let polished = polished(&text, &free);
        let worst = worst(&polished);
        let conditions = power_of_ten(polished.residual_printed);
        let (printed, right) = (worst.printed_digits, worst.right);
        rows += &format!("| {name} | {printed} | {right} | {:.1e} | {conditions} |\n", largest_distance(&polished));
    }
    rows
}

#[test]
fn fourteen_digits_taken_for_exact() {
    let exact = table("yoshida6");
    let claiming = |digits: u32| exact.replace("order = 6", &format!("order = 6\ndigits = {digits}"));
    let honest = judge(&claiming(14)).unwrap();
    says(&format!("order 6 to {} digits. Of the digits none is wrong", honest.proof.general.digits.unwrap()));
    says(&format!("| order 6 to {} digits |", honest.proof.general.digits.unwrap()));
    assert!(polished(&exact, &[]).weights.iter().all(|w| w.right == w.printed_digits));
    let boast = judge(&claiming(20)).unwrap_err().to_string();
    assert!(boast.contains("off by 6e-14, more than 20 digits of the weights can account for"), "{boast}");
}

/// McLachlan's SS17 as in REBOUND's leapfrog of order 8.
#[test]
fn fifteen_digits_of_order_8() {
    let claiming = |digits: &str| {
        format!(
            r#"
name = "leapfrog8"
order = 8
kinetic = "any"
symmetric = true
{digits}
[constants]
g1 = "0.128865979381443"
g2 = "0.581514087105251"
g3 = "-0.410175371469850"
g4 = "0.1851469357165877"
g5 = "-0.4095523434208514"
g6 = "0.1444059410800120"
g7 = "0.2783355003936797"
g8 = "0.3149566839162949"
g9 = "-0.6269948254051343979"
[composition]
base = "stormer-verlet"
gamma = ["g1", "g2", "g3", "g4", "g5", "g6", "g7", "g8", "g9", "g8", "g7", "g6", "g5", "g4", "g3", "g2", "g1"]
"#
        )
    };
    for (digits, hint) in [
        ("digits = 20", "off by 6e-16, more than 20 digits of the weights can account for"),
        ("", "off by 6e-16: if the weights are rounded"),
    ] {
        let message = judge(&claiming(digits)).unwrap_err().to_string();
        assert!(message.contains("the weights gamma do not sum to 1") && message.contains(hint), "{message}");
    }
    let honest = judge(&claiming("digits = 15")).unwrap();
    assert_eq!(honest.proof.general.order, 8);
    says(&format!(
        "the sums are off by 6e-16, the order conditions hold to {} digits, and a claim of 20 is refused",
        honest.proof.general.digits.unwrap()
    ));
    // McLachlan's free parameter is 25/194
    says(&format!("| order 8 to {} digits |", honest.proof.general.digits.unwrap()));
    let polished = polished(&claiming("").replace("0.128865979381443", "25/194"), &[]);
    let worst = worst(&polished);
    assert_eq!(worst.name, "g9");
    let (printed, right, off) = (worst.printed_digits, worst.right, off(worst));
    says(&format!("Its middle weight has {printed} digits, of which {right} are right (off by {off:.1e})"));
    assert!(polished.weights.iter().filter(|w| w.name != "g9").all(|w| w.right == w.printed_digits));
}

/// Yoshida's solutions C and D of order 8, whose equations are ill-conditioned: the residuals hide wrong digits.
#[test]
fn twenty_digits_of_which_twelve_are_right() {
    let (mut counts, mut right) = (Vec::new(), BTreeSet::new());
    for name in ["yoshida8-c", "yoshida8-d"] {
        let polished = polished(&printed(name), &[]);
        assert!(polished.weights.iter().all(|w| (20..=21).contains(&w.printed_digits)), "{name}");
        right.extend(polished.weights.iter().map(|w| w.right));
        let most = largest_distance(&polished);
        assert!(most > 1000.0 * f64::EPSILON, "{name}");
        counts.push(format!(
            "by up to {most:.1e} (conditions off by {}, condition number {:.1e})",
            power_of_ten(polished.residual_printed),
            polished.condition_number
        ));
        // with the polished digits, as many of them as were printed, nothing is left to remark
        let mut text = printed_with_digits(name, 20);
        for w in &polished.weights {
            let cell = |value: &Rational| shadowstep_schemes::to_significant(value, 21);
            let line = text.lines().find(|line| line.starts_with(&format!("{} = ", w.name))).unwrap().to_owned();
            text = text.replace(&line, &format!("{} = \"{}\"", w.name, cell(&w.polished)));
        }
        let proved = judge(&text).unwrap();
        assert!(proved.notes.is_empty() && proved.proof.general.digits.unwrap() >= 19, "{text}");
    }
    says(&format!("the printed weights of C turn out wrong {}, those of D {}.", counts[0], counts[1]));
    says(&format!("| {} to {} digits |", right.first().unwrap(), right.last().unwrap()));
    let good = polished(&printed("yoshida8-a"), &[]);
    assert!(good.weights.iter().all(|w| w.right == w.printed_digits), "solution A");
}

/// Suzuki and Umeno's scheme under the name of Yoshida's D, one of its weights off by 2e-18.
#[test]
fn one_name_two_schemes() {
    let wrong = "-0.57386247111608226464";
    let line = "g4 = \"-0.5738624711160822666563877266355357421595\"";
    let text = printed("suzuki-umeno8");
    assert!(text.contains(line));
    let polished = polished(&text.replace(line, &format!("g4 = \"{wrong}\"")), &[]);
    let worst = worst(&polished);
    assert_eq!((worst.name.as_str(), worst.printed_digits, worst.right), ("g4", 20, 17));
    says(&format!("One weight there, {}, is off by {:.1e}", wrong.replace('-', "−"), off(worst)));
    let claimed = printed_with_digits("suzuki-umeno8", 20).replace(line, &format!("g4 = \"{wrong}\""));
    let boast = judge(&claimed).unwrap_err().to_string();
    assert!(boast.contains("off by 4e-18, more than 20 digits of the weights can account for"), "{boast}");

    assert!(distance(&claimed.replace("digits = 20", "digits = 17"), "suzuki-umeno8") < 1e-17);
    let magnitudes = |name: &str| {
        let mut all: Vec<_> = shipped_proved(name).unwrap().scheme.stages.drift.iter().map(Signed::abs).collect();
        all.sort();
        all
    };
    let (suzuki, yoshida) = (magnitudes("suzuki-umeno8"), magnitudes("yoshida8-d"));
    assert!(suzuki.last().unwrap().to_f64().unwrap() < 0.8 && yoshida.last().unwrap().to_f64().unwrap() > 1.9);
}

/// Two members of Kahan and Li's family circulate. Both are right, a mixture of them is not.
#[test]
fn two_sets_of_digits_both_right() {
    let names = ["kahan-li6", "kahan-li6-gni"];
    for (name, other) in [(names[0], names[1]), (names[1], names[0])] {
        let proved = judge(&printed_with_digits(name, 25)).unwrap();
        assert_eq!((proved.proof.general.order, proved.notes.len()), (6, 0), "{name}");
        assert!(polished(&printed(name), &["g2".to_owned()]).weights.iter().all(|w| w.right == w.printed_digits));
        let text = shipped(name).unwrap().text;
        assert!(text.starts_with("# A family with one free parameter") && text.lines().next().unwrap().contains(other));
    }
    let apart = distance(&printed_with_digits(names[0], 25), names[1]);
    says(&format!("right in all its digits (the weights differ by up to {apart:.1e})"));

    let cell = |name: &str| printed(name).lines().find(|line| line.starts_with("g2")).unwrap().to_owned();
    let mixed = printed_with_digits(names[0], 25).replace(&cell(names[0]), &cell(names[1]));
    let said = judge(&mixed).unwrap_err().to_string();
    assert!(said.contains("the weights gamma do not sum to 1"), "{said}");
}

/// The middle weight of REBOUND's leapfrog of order 6.
#[test]
fn sixteen_digits_of_order_6() {
    let text = "name = \"leapfrog6\"\norder = 6\nkinetic = \"any\"\n[constants]\ng1 = \"0.1867\"\ng2 \
        = \"0.5554970237124784\"\n\
                g3 = \"0.1294669489134754\"\ng4 = \"-0.843265623387734\"\ng5 \
                = \"0.9432033015235604\"\n[composition]\nbase = \"stormer-verlet\"\n\
                gamma = [\"g1\", \"g2\", \"g3\", \"g4\", \"g5\", \"g4\", \"g3\", \"g2\", \"g1\"]\n";
    let polished = polished(text, &["g1".to_owned()]);
    let middle = polished.weights.iter().find(|w| w.name == "g5").unwrap();
    assert_eq!(shadowstep_schemes::to_significant(&middle.polished, 16), "0.9432033015235617");
    says("0.9432033015235604, should end in 617. That is 13 units of its last digit, and 12 of rounding of an f64.");
    assert!((off(middle) / 1e-16 - 13.0).abs() < 0.5 && (off(middle) / (f64::EPSILON / 2.0) - 12.0).abs() < 0.5);
}

/// Kepler's problem with eccentricity 1/2 in steps of 1/20: the mean errors of H in tenths of 10⁴ outputs, the least
/// and the greatest.
fn errors_at_outputs(fitted: bool) -> [f64; 2] {
    let (mut q, mut p) = ([0.5_f64, 0.0], [0.0, 3.0_f64.sqrt()]);
    let kick = |q: [f64; 2], p: &mut [f64; 2], h: f64| {
        let cube = q[0].hypot(q[1]).powi(3);
        (0..2).for_each(|i| p[i] -= h * q[i] / cube);
    };
    let (h, mut t, mut output, mut random) = (0.05, 0.0, 0.0, 1_u64);
    let mut errors = Vec::new();
    for _ in 0..10_000 {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        output += 0.5 + (random >> 11) as f64 / (1_u64 << 53) as f64;
        while t < output {
            let step = if t + h <= output { h } else { output - t };
            if step < h && !fitted {
                break;
            }
            kick(q, &mut p, step / 2.0);
            (0..2).for_each(|i| q[i] += step * p[i]);
            kick(q, &mut p, step / 2.0);
            t = if step < h { output } else { t + h };
        }
        errors.push((p[0] * p[0] + p[1] * p[1]) / 2.0 - 1.0 / q[0].hypot(q[1]) + 0.5);
    }
    let means = || errors.chunks(1000).map(|errors| errors.iter().sum::<f64>() / 1000.0);
    [means().fold(f64::MAX, f64::min), means().fold(f64::MIN, f64::max)]
}

#[test]
fn steps_fitted_to_outputs() {
    let [fixed, fitted] = [false, true].map(errors_at_outputs);
    assert!(fixed[1] - fixed[0] < 1e-4 && fitted[1] - fitted[0] > 4e-3, "{fixed:?} {fitted:?}");
    let text = |value: f64| format!("{value:.4}");
    says(&format!("the mean error of H of each tenth of the run is {};", text(fixed[0])));
    says(&format!("it wanders between {} and {}", text(fitted[0]), text(fitted[1])));
}

// ---------------------------------------------------------------------------------------------------------------
// Right tables, misused

/// The orders for every T(p) and for quadratic T, and the honest claims of both kinds.
#[test]
fn for_quadratic_kinetic_energy_only() {
    for (name, order) in [("calvosanz4", 4), ("mcate4", 4), ("mcate5", 5)] {
        let wrong = table(name);
        assert_orders(&wrong.replace("\"any\"", "\"quadratic\""), 3, order);
        assert_orders(&wrong.replace(&format!("order = {order}"), "order = 3"), 3, order);
    }
    let calvo = polished(&table("calvosanz4").replace("\"any\"", "\"quadratic\""), &[]);
    let few = calvo.weights.iter().filter(|w| w.right == 13).count();
    let (worst, off) = (worst(&calvo), off(worst(&calvo)));
    assert_eq!((few, worst.printed_digits), (2, 14));
    says(&format!("of which {} are right in two weights; the worst is off by {off:.1e}", worst.right));
}

/// A processed scheme: its orders need the processor.
#[test]
fn a_kernel_without_its_processor() {
    let kernel = table("kernel764");
    assert_orders(&kernel.replace("order = 4", "order = 2").replace("[7, 6, 4]", "[2]"), 2, 2);

    // drift, kick, …; the kernel; kick, drift, … with the signs changed
    let conjugated = |processor: &str, kernel: &str| {
        let cells: Vec<_> = processor.split(' ').collect();
        let back = cells.iter().rev().map(|cell| cell.strip_prefix('-').map_or(format!("-{cell}"), str::to_owned));
        let forth = cells.iter().map(|&cell| cell.to_owned());
        forth.chain(kernel.split(", ").map(str::to_owned)).chain(back).collect::<Vec<_>>()
    };
    let kick = conjugated(
        "-1.6218101180868010 0.0061709468110142 0.8348493592472594 -0.0511253369989315 0.5633782670698199 -0.5",
        "a1, 1 - 2*a1, a1",
    );
    let drift = conjugated(
        "-0.3346222298730800 1.0975679907321640 -1.0380887460967830 0.6234776317921379 -1.1027532063031910 \
         -0.0141183222088869",
        "b1, 1/2 - b1, 1/2 - b1, b1",
    );
    let kick = [vec!["0".to_owned()], kick].concat();
    let at = kernel.find("kick = ").unwrap();
    let whole = format!("{}kick = {kick:?}\ndrift = {drift:?}\n", &kernel[..at]);
    // the processor's weights end in zeros: they were rounded to fewer digits
    let whole = whole.replace("digits = 16", "digits = 15");
    let proved = judge(&whole).unwrap_or_else(|faults| panic!("{faults}"));
    let near: Vec<_> = proved.proof.near_integrable.iter().map(|order| order.order).collect();
    assert_eq!((proved.proof.general.order, near), (4, vec![7, 6, 4]));
    assert!(proved.notes.is_empty(), "{:?}", proved.notes);
    says(&format!(
        "one table of {} stages, the same claims are proved: order 4, near-integrable orders (7,6,4), to {} digits",
        proved.scheme.stages.kick.len(),
        proved.order().digits.unwrap()
    ));
}
