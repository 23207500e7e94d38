//! Printed decimals become weights of many digits: published schemes, and tables that cannot be polished.

use std::collections::BTreeSet;
use std::fs;

use num_traits::{One, Signed};
use shadowstep_analysis::polish::{NotPolished, Polished, Request, Role, polish};
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::symbolic::exact;
use shadowstep_schemes::{Rational, Source, shipped, shipped_names, shipped_proved};
use toml::{Table, Value};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests");

fn published(name: &str) -> Source {
    let path = format!("{FOLDER}/published/{name}.toml");
    Source { text: fs::read_to_string(&path).unwrap(), path }
}

fn polished(source: &Source, digits: u32, free: &[&str]) -> Result<Polished, NotPolished> {
    let free: Vec<_> = free.iter().map(|name| (*name).to_owned()).collect();
    let wanted = Request { digits: Some(digits), free: &free, ..Request::default() };
    polish(source, &|name, _| shipped(name), &wanted)
}

fn power(exponent: u32) -> Rational {
    Rational::new(1.into(), num_bigint::BigInt::from(10).pow(exponent))
}

fn distance(a: &Rational, b: &str) -> Rational {
    (a - exact(b).unwrap()).abs()
}

/// The digits of the shipped table come from elsewhere: another program (mpmath) solved for them.
fn reproduce(name: &str, request: Option<&Table>) {
    let free = request.and_then(|request| request.get("free")?.as_array());
    let free: Vec<_> = free.into_iter().flatten().map(|name| name.as_str().unwrap().to_owned()).collect();
    let split_kicks = request.is_some_and(|request| request.get("split_kicks").is_some());
    let wanted = Request { digits: Some(250), free: &free, split_kicks, ..Request::default() };
    let polished =
        polish(&published(name), &|name, _| shipped(name), &wanted).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert!(polished.residual < -250.0, "{name}: {}", polished.residual);
    let [found, ours] = [&polished.proved.scheme, &shipped_proved(name).unwrap().scheme];
    for (list, found, ours) in
        [("kick", &found.stages.kick, &ours.stages.kick), ("drift", &found.stages.drift, &ours.stages.drift)]
    {
        assert_eq!(found.len(), ours.len(), "{name}");
        for (i, (found, ours)) in found.iter().zip(ours).enumerate() {
            // the table has 250 digits, and weights that are what is left of 1 have the rounding of the others
            assert!((found - ours).abs() <= power(249), "{name}: {list}[{}]", i + 1);
        }
    }
}

/// A table of order 4 for every T(p) with these lines below its head.
fn table(order: u32, lines: &str) -> Source {
    let text = format!("name = \"t\"\norder = {order}\nkinetic = \"any\"\nreference = \"a test\"\n{lines}");
    Source { path: "t.toml".to_owned(), text }
}

fn refusal(source: &Source, free: &[&str]) -> String {
    match polished(source, 100, free) {
        Ok(polished) => panic!("polished:\n{}", polished.text),
        Err(NotPolished::Faults(faults)) => faults.to_string(),
        Err(NotPolished::Request { message, hint } | NotPolished::Unsolved { message, hint }) => {
            format!("{message}: {hint}")
        }
    }
}

/// Weights of 17 digits.
fn stages(kick: &[Rational], drift: &[Rational]) -> String {
    let list = |weights: &[Rational]| {
        let cells: Vec<_> = weights.iter().map(|w| shadowstep_schemes::to_significant(w, 17)).collect();
        cells.join(", ")
    };
    format!("[stages]\nkick = [{}]\ndrift = [{}]\n", list(kick), list(drift))
}

fn roles(polished: &Polished, role: Role) -> Vec<&str> {
    polished.weights.iter().filter(|w| w.role == role).map(|w| w.name.as_str()).collect()
}

/// Schemes of all kinds: compositions up to 35 stages and order 10, for every T(p), for quadratic T, near-integrable.
#[test]
fn published_digits_become_those_of_the_shipped_tables() {
    let requests: Table = fs::read_to_string(format!("{FOLDER}/requests.toml")).unwrap().parse().unwrap();
    let decimal = |name: &&str| {
        let printed = |held| matches!(held, Held::Digits(digits) if digits < 300);
        let scheme = &shipped_proved(name).unwrap().scheme;
        // those of processors are in a test of their own, those of inner schemes in tables of their own
        printed(scheme.held) && scheme.processor.is_none() && scheme.inner.is_none()
    };
    let mut names: BTreeSet<_> = shipped_names().into_iter().filter(decimal).map(str::to_owned).collect();
    names.extend(requests.keys().cloned());
    // two papers print decimals of what is a closed form
    names.extend(["mclachlan-atela3", "mclachlan-sb3a5"].map(str::to_owned));
    assert_eq!(names.len(), fs::read_dir(format!("{FOLDER}/published")).unwrap().count() - 1, "a README too");
    for name in names {
        reproduce(&name, requests.get(&name).and_then(Value::as_table));
    }
}

#[test]
fn fourteen_digits_become_three_hundred() {
    let gammas = "0.78451361047756, 0.23557321335936, -1.1776799841789, 1.3151863206839";
    let lines = format!(
        "# as a library prints it\n[composition]\nbase = \"stormer-verlet\"\n\
         gamma = [{gammas}, -1.1776799841789,   # and back\n  0.23557321335936, 0.78451361047756]\n"
    );
    let polished = polished(&table(6, &lines), 300, &[]).unwrap();
    assert_eq!((polished.proved.proof.general.order, polished.proved.proof.symmetric), (6, true));
    assert!(polished.proved.order().digits.unwrap() >= 300);
    assert!(polished.proved.scheme.stages.drift.iter().sum::<Rational>().is_one(), "exactly");
    let text = &polished.text;
    assert!(text.contains("# as a library prints it\n[constants]\ng1 = \"0.784513610477557263819497"), "{text}");
    assert!(text.contains("\ng4 = \"1 - 2*(g1 + g2 + g3)\"\n\n[composition]"), "{text}");
    assert!(text.contains("[\"g1\", \"g2\", \"g3\", \"g4\", \"g3\",   # and back\n  \"g2\", \"g1\"]"), "{text}");
    assert!(text.contains("order = 6\ndigits = 300\n"), "{text}");
}

#[test]
fn what_is_exact_stays_as_it_is() {
    let source = published("mclachlan-ss17");
    let polished = polished(&source, 50, &[]).unwrap();
    assert!(polished.text.contains("g1 = \"25/194\"\n"));
    assert!(polished.text.contains("g9 = \"72/97 - 2*(g2 + g3 + g4 + g5 + g6 + g7 + g8)\"\n"), "{}", polished.text);
    assert!(roles(&polished, Role::Free).is_empty());
    let verlet = table(2, "[stages]\nkick = [0.5, 0.5]\ndrift = [1.0, 0.0]\n");
    let text = self::polished(&verlet, 50, &[]).unwrap().text;
    assert!(text.contains("a1 = \"0.5\"\nb1 = \"1\"\n") && text.contains("drift = [\"b1\", 0.0]"), "{text}");
}

#[test]
fn formulas_of_decimals_are_solved_for_these() {
    let lines = "[constants]\nc = \"1.2599210498948732\"\ng1 = \"1/(2 - c)\"\n\n\
                 [composition]\nbase = \"stormer-verlet\"\ngamma = [\"g1\", \"1 - 2*g1\", \"g1\"]\n";
    let polished = polished(&table(4, lines), 200, &[]).unwrap();
    assert!(distance(&polished.weights[0].polished, "2^(1/3)") < power(200));
    assert!(polished.text.contains("g1 = \"1/(2 - c)\""));
}

#[test]
fn weights_with_more_structure_than_their_conditions_know_are_polished() {
    // Yoshida's A as stages: 10 conditions of a palindrome for 8 decimals
    let gamma = polished(&published("yoshida6-a"), 120, &[]).unwrap().proved.scheme;
    let lines = stages(&gamma.stages.kick, &gamma.stages.drift);
    let polished = polished(&table(6, &lines), 100, &[]).unwrap();
    assert_eq!((polished.conditions, polished.weights.len()), (10, 8));
    for (stages, gamma) in polished.proved.scheme.stages.kick.iter().zip(&gamma.stages.kick) {
        assert!((stages - gamma).abs() < power(100));
    }
}

#[test]
fn decimals_that_the_conditions_leave_free_stay_as_printed() {
    let source = published("blanes-moan-s6");
    let chosen = polished(&source, 60, &[]).unwrap();
    assert_eq!(roles(&chosen, Role::Free).len(), 3, "7 decimals, 4 conditions");
    // the names of a decimal are its places in the list, from either end
    let asked = polished(&source, 60, &["kick[1]", "kick[6]", "drift[1]"]).unwrap();
    assert_eq!(roles(&asked, Role::Held), ["kick[1]", "kick[2]", "drift[1]"]);
    assert!(roles(&asked, Role::Free).is_empty());
    let held = asked.weights.iter().filter(|w| w.role == Role::Held);
    assert!(held.clone().all(|w| w.printed == w.polished) && held.count() == 3);
    // the table says so from now on, and is polished no further
    assert!(asked.text.contains("digits = 60\nfree = [\"a1\", \"a2\", \"b1\"]\n"), "{}", asked.text);
    let again = self::polished(&Source { text: asked.text.clone(), ..source.clone() }, 60, &[]).unwrap();
    assert_eq!(again.text, asked.text);
    let more = self::polished(&Source { text: asked.text, ..source }, 50, &["a3"]).unwrap();
    assert!(more.text.contains("digits = 50\nfree = [\"a1\", \"a2\", \"b1\", \"a3\"]\n"), "{}", more.text);
    // decimals with few digits were chosen by somebody: they are held before the others
    let few = polished(&published("mclachlan-ss9"), 60, &[]).unwrap();
    assert_eq!(roles(&few, Role::Free), ["g1"]);
}

#[test]
fn constants_that_mirror_each_other_become_one() {
    let mirrored = polished(&published("blanes-moan-s6"), 60, &["kick[1]", "kick[2]", "drift[1]"]).unwrap();
    let lists = published("blanes-moan-s6").text;
    let cells = |list: &str| {
        let line = lists.lines().find(|line| line.starts_with(list)).unwrap();
        line[line.find('[').unwrap() + 1..line.len() - 1].split(", ").map(str::to_owned).collect::<Vec<_>>()
    };
    let constants = |letter: &str, cells: &[String]| -> String {
        cells.iter().enumerate().map(|(i, cell)| format!("{letter}{i} = {cell}\n")).collect()
    };
    let names =
        |letter: &str, count: usize| (0..count).map(|i| format!("\"{letter}{i}\"")).collect::<Vec<_>>().join(", ");
    let (kicks, drifts) = (cells("kick"), cells("drift"));
    let lines = format!(
        "[constants]\n{}{}[stages]\nkick = [{}]\ndrift = [{}, 0]\n",
        constants("a", &kicks),
        constants("b", &drifts[..6]),
        names("a", 7),
        names("b", 6)
    );
    // from the other end
    let one = polished(&table(4, &lines), 60, &["a6", "kick[6]", "b5"]).unwrap();
    assert_eq!(roles(&one, Role::Held), ["a0", "a1", "b0"]);
    assert!(one.text.contains("\na6 = \"a0\"\n") && one.text.contains("\nb3 = \"b2\"\n"), "{}", one.text);
    assert_eq!(
        (&one.proved.scheme.stages.kick, &one.proved.scheme.stages.drift),
        (&mirrored.proved.scheme.stages.kick, &mirrored.proved.scheme.stages.drift)
    );
}

#[test]
fn decimals_that_are_printed_alike_are_one() {
    let (s, middle) = ("0.4144907717943757", "-0.6579630871775028");
    let list = format!("[composition]\nbase = \"stormer-verlet\"\ngamma = [{s}, {s}, {middle}, {s}, {s}]\n");
    let suzuki = polished(&table(4, &list), 100, &["gamma[4]"]);
    assert!(suzuki.is_err(), "held, all four are");
    let suzuki = polished(&table(4, &list), 100, &[]).unwrap();
    assert_eq!(suzuki.weights.len(), 2);
    assert!(distance(&suzuki.weights[0].polished, "1/(4 - 4^(1/3))") < power(100));
    assert!(suzuki.text.contains("gamma = [\"g1\", \"g1\", \"g3\", \"g1\", \"g1\"]"), "{}", suzuki.text);
    // constants too, but for those that are free
    let cells = "[composition]\nbase = \"stormer-verlet\"\ngamma = [\"u\", \"v\", \"m\", \"v\", \"u\"]\n";
    let constants = format!("[constants]\nu = {s}\nv = {s}\nm = {middle}\n{cells}");
    let one = polished(&table(4, &constants), 100, &[]).unwrap();
    assert!(one.text.contains("\nv = \"u\"\nm = \"1 - 4*u\"\n"), "{}", one.text);
    let free = format!("free = [\"u\"]\n{constants}");
    assert_eq!(polished(&table(4, &free), 100, &[]).unwrap().weights.len(), 3);
    // a few digits may be alike by chance
    let few = list.replace(s, "0.41449").replace(middle, "-0.65796");
    assert_eq!(polished(&table(4, &few), 100, &[]).unwrap().weights.len(), 3);
}

#[test]
fn constants_that_no_weight_uses_stay_out_of_it() {
    let lines = "[constants]\nold = 0.3\nolder = \"1 - old\"\ng1 = 1.3512071919596577\n\
                 [composition]\nbase = \"stormer-verlet\"\ngamma = [\"g1\", \"1 - 2*g1\", \"g1\"]\n";
    let source = table(4, lines);
    let polished = polished(&source, 60, &[]).unwrap();
    assert_eq!(polished.weights.iter().map(|w| w.name.as_str()).collect::<Vec<_>>(), ["g1"]);
    assert_eq!(polished.notes, ["`old` is used by no weight", "`older` is used by no weight"]);
    let text = &polished.text;
    assert!(text.contains("\nold = 0.3\nolder = \"1 - old\"\n") && !text.contains("free = "), "{text}");
    assert!(refusal(&source, &["old"]).contains("`old` is used by no weight"));
}

#[test]
fn tables_are_written_however_they_are_laid_out() {
    let gamma = "[1.3512071919596577, -1.7024143839193153, 1.3512071919596577]";
    let layouts = [
        format!("[composition]\r\nbase = \"stormer-verlet\"\r\ngamma = {gamma}"),
        format!("[composition]\nbase = 'stormer-verlet'\ngamma = {gamma}\n\n[constants]"),
        format!("[composition]\nbase = 'stormer-verlet'\ngamma = {gamma}\n[constants]\ng1 = \"1/3\""),
    ];
    for lines in layouts {
        let polished = polished(&table(4, &lines), 80, &[]).unwrap();
        assert!(polished.proved.order().digits.unwrap() >= 80, "{}", polished.text);
    }
    let windows = table(4, &format!("[composition]\nbase = \"stormer-verlet\"\ngamma = {gamma}\n"));
    let windows = Source { text: windows.text.replace('\n', "\r\n"), ..windows };
    let text = self::polished(&windows, 80, &[]).unwrap().text;
    assert!(text.contains("digits = 80\r\n") && text.contains("[constants]\r\ng1 = "), "{text}");
    assert_eq!(text.matches('\n').count(), text.matches("\r\n").count(), "{text:?}");
    let dotted =
        refusal(&table(4, &format!("composition.base = \"stormer-verlet\"\ncomposition.gamma = {gamma}\n")), &[]);
    assert!(dotted.contains("write [constants] and [composition] on separate lines"), "{dotted}");
}

#[test]
fn names_that_are_no_decimals_are_refused() {
    let source = published("mclachlan-ss17");
    let unknown = refusal(&source, &["g22"]);
    assert!(unknown.contains("no printed decimal `g22`") && unknown.contains("did you mean `g2`?"), "{unknown}");
    assert!(refusal(&source, &["nothing"]).contains(": its decimals: g2, g3, g4, g5, g6, g7, …"));
    assert!(refusal(&published("yoshida6-a"), &["nothing"]).ends_with(": its decimals: g1, g2, g3, g4"));
    assert!(refusal(&source, &["g1"]).contains("`g1` is not a printed decimal"));
    assert!(refusal(&source, &["gamma[1]"]).contains("fractions and formulas stay as they are"));
    assert!(refusal(&shipped("yoshida4").unwrap(), &[]).contains("has no printed decimals"));
    let many: Vec<_> = (100..301).map(|i| format!("0.0{i}")).collect();
    let many = format!("[composition]\nbase = \"stormer-verlet\"\ngamma = [{}]\n", many.join(", "));
    assert!(refusal(&table(2, &many), &[]).contains("201 decimals are too many"));
}

#[test]
fn contradictions_are_told_with_numbers() {
    let source = published("yoshida6-a");
    let order8 = Source { text: source.text.replace("order = 6", "order = 8"), ..source.clone() };
    let said = refusal(&order8, &[]);
    assert!(said.contains("8 conditions for 4 decimals, 4 of them solved for; as printed off by"), "{said}");
    let held = refusal(&source, &["g2"]);
    assert!(held.contains("no values near the printed ones") && held.contains("let more decimals move"), "{held}");
    let all = refusal(&source, &["g1", "gamma[2]", "g3", "gamma[5]", "g4"]);
    assert!(
        all.contains("every decimal is held as printed, so there is nothing to solve for: leave some out of --free"),
        "{all}"
    );
    let unlike = table(2, "symmetric = true\n[stages]\nkick = [0.25, 0.75]\ndrift = [1, 0]\n");
    let said = refusal(&unlike, &[]);
    assert!(said.contains("a palindrome is claimed") && said.contains("found 0.75, needed 0.25"), "{said}");
}

/// A claim of too low an order leaves decimals to themselves that the true one determines.
#[test]
fn the_order_that_holds_as_printed_is_told() {
    let yoshida = published("yoshida6-a");
    let low = Source { text: yoshida.text.replace("order = 6", "order = 4"), ..yoshida.clone() };
    let said = polished(&low, 60, &[]).unwrap();
    assert_eq!(said.notes, ["order 6 holds as printed: claim it, and it will be polished too"]);
    assert_eq!((said.proved.proof.general.order, roles(&said, Role::Free).len()), (4, 2));
    assert!(polished(&yoshida, 60, &[]).unwrap().notes.is_empty());
    let source = published("aba864");
    let near = source.text.replace("near_integrable = [8, 6, 4]", "near_integrable = [6, 4]");
    let said = polished(&Source { text: near, ..source }, 60, &[]).unwrap().notes;
    assert!(said[0].starts_with("order 8 holds for the terms of ε as printed: claim it"), "{said:?}");
    // five digits do not prove order 6
    let short = "[composition]\nbase = \"stormer-verlet\"\n\
                 gamma = [0.78451, 0.23557, -1.1777, 1.3152, -1.1777, 0.23557, 0.78451]\n";
    assert!(polished(&table(4, short), 60, &[]).unwrap().notes.is_empty());
}

#[test]
fn verlet_steps_typed_as_stages_are_told() {
    let steps =
        "these are Störmer–Verlet steps: write them as [composition] with base = \"stormer-verlet\" and gamma = ";
    let scheme = &shipped_proved("sofroniou-spaletta6-13").unwrap().scheme;
    let said = refusal(&table(6, &stages(&scheme.stages.kick, &scheme.stages.drift)), &[]);
    assert!(said.ends_with(&format!(": {steps}the drifts")), "{said}");
    // a drift first: one more stage, without its kick
    let mut exchanged = (scheme.stages.drift.clone(), scheme.stages.kick.clone());
    exchanged.0.rotate_right(1);
    let said = refusal(&table(6, &stages(&exchanged.0, &exchanged.1)), &[]);
    assert!(said.ends_with(&format!(": {steps}the kicks")), "{said}");
    // other schemes are not such steps: here the claim is wrong
    let other = &shipped_proved("blanes-moan-s6").unwrap().scheme;
    let said = refusal(&table(6, &stages(&other.stages.kick, &other.stages.drift)), &[]);
    assert!(!said.contains("Verlet"), "{said}");
}

#[test]
fn decimals_within_formulas_are_named_as_the_reason() {
    let lines = "[composition]\nbase = \"stormer-verlet\"\n\
                 gamma = [\"1.351207192\", \"1 - 2*1.351207192\", \"1.351207192\"]\n";
    let said = refusal(&table(4, lines), &[]);
    assert!(said.ends_with(": the decimal in gamma[2] does not move: make it a constant"), "{said}");
    let lines = "[constants]\ng = \"2*0.675603596\"\nm = \"1 - 2.702414384\"\nold = \"2*0.1234567\"\n\
                 [composition]\nbase = \"stormer-verlet\"\ngamma = [\"g\", \"m\", \"g\"]\n";
    let said = refusal(&table(4, lines), &[]);
    assert!(said.contains("has no printed decimals"), "{said}");
    assert!(said.ends_with(": the decimals in g, m do not move: make them constants"), "{said}");
    // short ones are meant exactly
    let lines = "[composition]\nbase = \"stormer-verlet\"\ngamma = [\"0.5*0.5\", \"0.5\", \"1/4\"]\n";
    let said = refusal(&table(4, lines), &[]);
    assert!(!said.contains("does not move"), "{said}");
}

#[test]
fn an_order_for_quadratic_kinetic_energies_only_is_told() {
    let source = published("blanes-moan-srkn11b");
    let any = source.text.replace("\"quadratic\"", "\"any\"");
    let said = refusal(&Source { text: any, ..source }, &[]);
    assert!(said.ends_with("order 6 holds for quadratic T as printed: write `kinetic = \"quadratic\"`"), "{said}");
}

#[test]
fn singular_solutions_are_told_with_numbers() {
    // for this g1 the two other γ's are equal, a double root of the condition of order 4
    let with = |g2: &str, g3: &str| {
        let g1 = "-cbrt(3/2)/(3 - 2*cbrt(3/2))";
        let gamma = "[\"g1\", \"g2\", \"g3\", \"g2\", \"g1\"]";
        let constants = format!("[constants]\ng1 = \"{g1}\"\ng2 = \"{g2}\"\ng3 = \"{g3}\"\n\n");
        table(4, &format!("{constants}[composition]\nbase = \"stormer-verlet\"\ngamma = {gamma}\n"))
    };
    let near = refusal(&with("1.407318", "1.407321"), &[]);
    assert!(near.contains("derivatives are singular at the solution") && near.contains("condition number"), "{near}");
    let equal = refusal(&with("1.407318", "1.4073180"), &[]);
    assert!(equal.contains("1 of them solved for") && equal.contains("a singular solution"), "{equal}");
}

#[test]
fn a_base_of_few_digits_is_named_as_the_reason() {
    let base = "name = \"base\"\norder = 2\nkinetic = \"any\"\ndigits = 15\nreference = \"a test\"\n\
                [stages]\nkick = [0.2113248654051871, 0.2886751345948129, 0.2886751345948129, 0.2113248654051871]\n\
                drift = [0.25, 0.5, 0.25, 0]\n";
    let lines =
        "[composition]\nbase = \"base\"\ngamma = [1.3512071919596577, -1.7024143839193153, 1.3512071919596577]\n";
    let base = Source { path: "base.toml".to_owned(), text: base.to_owned() };
    let wanted = Request { digits: Some(50), free: &[], ..Request::default() };
    let Err(NotPolished::Unsolved { message, hint }) = polish(&table(4, lines), &|_, _| Some(base.clone()), &wanted)
    else {
        panic!("15 digits cannot become 50")
    };
    assert!(message.contains("not to 50") && hint.contains("the base has 15 digits"), "{message}: {hint}");
}

#[test]
fn as_many_digits_as_can_be_where_none_are_asked_for() {
    // the base has a closed form, rounded to 300 digits
    let lines = "[composition]\nbase = \"yoshida4\"\ngamma = [1.17467175808, -1.34934351616, 1.17467175808]\n";
    let as_many = Request { digits: None, free: &[], ..Request::default() };
    let found = polish(&table(6, lines), &|name, _| shipped(name), &as_many).unwrap();
    assert_eq!((found.proved.proof.general.order, found.proved.order().digits), (6, Some(299)));
    assert!(found.text.contains("\ndigits = 299\n"), "{}", found.text);
    let Err(said) = polished(&table(6, lines), 300, &[]) else { panic!("300 digits of a base that has 299") };
    assert_eq!(said.to_string(), "the conditions hold to 299 digits, not to 300");
    let all = polish(&published("yoshida6-a"), &|name, _| shipped(name), &as_many).unwrap();
    assert!(all.proved.order().digits.unwrap() >= 300);
}

#[test]
fn too_few_digits_are_told_without_a_text_that_nobody_has_seen() {
    for digits in [1, 3] {
        let Err(NotPolished::Unsolved { message, hint }) = polished(&published("yoshida6-a"), digits, &[]) else {
            panic!("{digits} digits prove nothing")
        };
        assert!(message.ends_with("too few to prove that the conditions hold"), "{message}");
        assert!(hint.contains("--digits 20"), "{hint}");
    }
    // what is advised is enough, at the highest order too
    for name in ["hairer10-33", "bce-rkn8-17"] {
        let free = if name == "hairer10-33" { &["gamma[9]"][..] } else { &[] };
        assert!(polished(&published(name), 20, free).is_ok(), "{name}");
    }
}

/// A table with its long decimals cut to 17 digits.
fn cut(source: &Source) -> Source {
    let cut = |line: &str| match line.split_once("= \"") {
        Some((name, value))
            if value.len() > 60 && value.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit()) =>
        {
            let value: f64 = value.trim_end_matches('"').parse().unwrap();
            format!("{name}= \"{value:.17}\"")
        }
        _ => line.to_owned(),
    };
    let text = source.text.lines().map(cut).map(|line| line + "\n").collect::<String>();
    Source { path: source.path.clone(), text: text.replace("digits = 250", "digits = 14") }
}

/// Kernel and processor are solved for together: the conditions of the kernel alone would leave weights free that those
/// of the processed step determine.
#[test]
fn processed_schemes_are_polished_with_their_processors() {
    for name in ["blanes6-7", "bcm6-11", "bcm6-13", "bcm8-13", "bcm10-23", "bcr764"] {
        let shipped_text = shipped(name).unwrap();
        let known = &shipped_proved(name).unwrap().scheme;
        let polished = polished(&cut(&shipped_text), 100, &[]).unwrap_or_else(|error| panic!("{name}: {error}"));
        let found = &polished.proved.scheme;
        let tolerance = power(98);
        let all = |scheme: &shadowstep_schemes::ExactScheme| scheme.processed_maps().unwrap();
        for (one, other) in all(known).iter().zip(&all(found)) {
            assert!((&one.weight - &other.weight).abs() < tolerance, "{name}");
        }
        println!("{name:24} {} conditions", polished.conditions);
    }
}

/// bcss3 as its paper prints it: the condition that a step which turns by π is not unstable has a closed form, b1 =
/// (1 − 2 a1)/(4 (1 − 3 a1)).
#[test]
fn intervals_of_instability_are_closed() {
    let text = "name = \"printed\"\norder = 2\nkinetic = \"any\"\nsymmetric = true\nfree = [\"a1\"]\n[constants]\na1 \
        = \"0.11888010966548\"\n\
                a2 = \"1/2 - a1\"\nb1 = \"0.29619504261126\"\nb2 = \"1 - 2*b1\"\n[stages]\nkick = \
                [\"a1\", \"a2\", \"a2\", \"a1\"]\n\
                drift = [\"b1\", \"b2\", \"b1\", 0]\n";
    let source = Source { path: "printed.toml".into(), text: text.into() };
    let wanted = Request { digits: Some(200), closed_gaps: &[2.98], ..Request::default() };
    let polished = polish(&source, &|name, _| shipped(name), &wanted).unwrap();
    let a1 = exact("0.11888010966548").unwrap();
    let two = Rational::from_integer(2.into());
    let closed = (Rational::one() - &a1 * &two)
        / (Rational::from_integer(4.into()) * (Rational::one() - &a1 * (&two + Rational::one())));
    let found = polished.weights.iter().find(|weight| weight.name == "b1").unwrap();
    assert!((&found.polished - closed).abs() < power(200), "{}", found.polished);
}
