//! Protects the compiler's refusals of wrong claims: tables with the mistakes that are found in published codes, each with
//! its message, the value found and the value needed.

use shadowstep_schemes::{First, read_first, shipped};
use shadowstep_tests::refusals::{assert_message, assert_orders, assert_refused, judge};

/// A palindromic composition of Störmer–Verlet steps γ_1, …, γ_k, …, γ_1 with all its weights as printed.
fn composition(order: u32, digits: u32, gammas: &[&str]) -> String {
    let all: Vec<_> = gammas.iter().chain(gammas.iter().rev().skip(1)).collect();
    format!(
        "name = \"composition\"\norder = {order}\nkinetic = \"any\"\nsymmetric = true\ndigits = {digits}\n\
         reference = \"as printed\"\n\n[composition]\nbase = \"stormer-verlet\"\ngamma = {all:?}\n"
    )
}

/// A table of stages as printed, claimed for every T(p).
fn stages(order: u32, digits: u32, kick: &[&str], drift: &[&str]) -> String {
    format!(
        "name = \"stages\"\norder = {order}\nkinetic = \"any\"\ndigits = {digits}\nreference = \"as printed\"\n\n\
         [stages]\nkick = {kick:?}\ndrift = {drift:?}\n"
    )
}

/// McLachlan's SB3A numbers in five stages, with one drift too few for them: order 1 where 4 is claimed.
#[test]
fn one_drift_too_few() {
    let table = r#"
name = "mcate42"
order = 4
kinetic = "any"
digits = 20
reference = "R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151, SB3A, as found in a library"

[constants]
a1 = "-3/73"
a2 = "17/59"
b1 = "0.40518861839525227722"
b2 = "-0.28714404081652408900"

[stages]
kick = ["a1", "a2", "1 - 2*(a1 + a2)", "a2", "a1"]
drift = ["b1", "b2", "1 - 2*(b1 + b2)", "b2", "b1"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:3:9: order 4 is claimed, order 1 holds for every T(p): the condition of the word KD fails
  3 | order = 4
    |         ^
  found 0.5938511087408138…, needed 1/2
"#,
    );

    // with all six drifts, and a drift first, the same numbers have the order that was published
    let right = table.replace(
        "kick = [\"a1\", \"a2\", \"1 - 2*(a1 + a2)\", \"a2\", \"a1\"]\n\
         drift = [\"b1\", \"b2\", \"1 - 2*(b1 + b2)\", \"b2\", \"b1\"]",
        "kick = [0, \"a1\", \"a2\", \"1 - 2*(a1 + a2)\", \"a2\", \"a1\"]\n\
         drift = [\"b1\", \"b2\", \"1/2 - (b1 + b2)\", \"1/2 - (b1 + b2)\", \"b2\", \"b1\"]",
    );
    assert_orders(&right, 4, 4);
}

/// McLachlan's fourth-order composition of a first-order step and its adjoint, c_i h and d_i h with d the reverse of c.
fn composed_with_adjoint(kick: &str, drift: &str) -> String {
    format!(
        r#"
name = "mclachlan4"
order = 4
kinetic = "any"
symmetric = true
reference = "R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151"

[constants]
c1 = "(146 + 5*sqrt(19))/540"
c2 = "(-2 + 10*sqrt(19))/135"
c3 = "1/5"
c4 = "(-23 - 20*sqrt(19))/270"
c5 = "1/2 - (c1 + c2 + c3 + c4)"

[stages]
kick = [{kick}]
drift = [{drift}]
"#
    )
}

/// Step and adjoint composed in the wrong order: order 2.
#[test]
fn maps_composed_in_the_wrong_order() {
    let right = composed_with_adjoint(
        r#""c5", "c1 + c4", "c2 + c3", "c3 + c2", "c4 + c1", "c5""#,
        r#""c5 + c1", "c4 + c2", "c3 + c3", "c2 + c4", "c1 + c5", 0"#,
    );
    assert_orders(&right, 4, 4);
    let wrong = composed_with_adjoint(
        r#""c1", "c5 + c2", "c4 + c3", "c3 + c4", "c2 + c5", "c1""#,
        r#""c1 + c5", "c2 + c4", "c3 + c3", "c4 + c2", "c5 + c1", 0"#,
    );
    assert_refused(
        &wrong,
        r#"
mine.toml:3:9: order 4 is claimed, order 2 holds for every T(p): the condition of the word KKD fails
  3 | order = 4
    |         ^
  found 0.135…, needed 1/6
"#,
    );
}

/// The sign of 1/3 − z = −0.0215… lost.
#[test]
fn a_lost_sign() {
    let table = r#"
name = "sb3a4"
order = 4
kinetic = "any"
reference = "R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151"

[constants]
z = "sqrt(7/8)/3"

[stages]
kick = [0, 1, "-1/2", "-1/2", 1]
drift = ["1/2 - z", "1/3 - z", "2/3", "1/3 - z", "1/2 - z"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:12:9: the drifts do not sum to 1, so not even order 1 holds
  12 | drift = ["1/2 - z", "1/3 - z", "2/3", "1/3 - z", "1/2 - z"]
     |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  found 1.086114204408686…, needed 1
"#,
    );
    assert_orders(&table.replace("1/3 - z", "z - 1/3"), 4, 4);
}

/// 2^(−1/3) = 0.79… where 2^(1/3) is meant.
#[test]
fn wrong_sign_of_an_exponent() {
    let yoshida = r#"
name = "thermostat"
order = 4
kinetic = "any"
reference = "as found in molecular dynamics codes"

[constants]
w1 = "1/(2 - 2^(-1/3))"

[composition]
base = "stormer-verlet"
gamma = ["w1", "1 - 2*w1", "w1"]
"#;
    assert_refused(
        yoshida,
        r#"
mine.toml:3:9: order 4 is claimed, order 2 holds for every T(p): the condition of the word KKD fails
  3 | order = 4
    |         ^
  found 0.131061370551692…, needed 1/6
"#,
    );
    assert_orders(&yoshida.replace("2^(-1/3)", "2^(1/3)"), 4, 4);

    // the same as decimals, and Suzuki's five-fold one, where the honest claim is 2
    let decimals =
        yoshida.replace("1/(2 - 2^(-1/3))", "0.828981543588751").replace("order = 4", "order = 4\ndigits = 15");
    assert!(judge(&decimals).unwrap_err().to_string().contains("order 4 is claimed, order 2 holds"));
    let suzuki = yoshida
        .replace("1/(2 - 2^(-1/3))", "1/(4 - 4^(-1/3))")
        .replace(r#"["w1", "1 - 2*w1", "w1"]"#, r#"["w1", "w1", "1 - 4*w1", "w1", "w1"]"#);
    assert!(judge(&suzuki).unwrap_err().to_string().contains("order 4 is claimed, order 2 holds"));
    assert_orders(&suzuki.replace("order = 4", "order = 2"), 2, 2);
    assert_orders(&suzuki.replace("4^(-1/3)", "4^(1/3)"), 4, 4);
}

/// Fourteen digits taken for exact numbers: the sums are off by 6e-14.
#[test]
fn fourteen_digits_taken_for_exact() {
    let table = r#"
name = "yoshida6"
order = 6
kinetic = "any"
symmetric = true
reference = "H. Yoshida, Phys. Lett. A 150 (1990) 262, solution A"

[constants]
a1 = "0.78451361047756"
a2 = "0.23557321335936"
a3 = "-1.1776799841789"
a4 = "1.3151863206839"

[composition]
base = "stormer-verlet"
gamma = ["a1", "a2", "a3", "a4", "a3", "a2", "a1"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:16:9: the kicks do not sum to 1, so not even order 1 holds
  16 | gamma = ["a1", "a2", "a3", "a4", "a3", "a2", "a1"]
     |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  found 0.99999999999994, needed 1
  help: the condition is off by 6e-14: if the weights are rounded, say so with `digits = …`
mine.toml:16:9: the drifts do not sum to 1, so not even order 1 holds
  16 | gamma = ["a1", "a2", "a3", "a4", "a3", "a2", "a1"]
     |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  found 0.99999999999994, needed 1
  help: the condition is off by 6e-14: if the weights are rounded, say so with `digits = …`
"#,
    );

    let honest = table.replace("order = 6", "order = 6\ndigits = 14");
    assert_orders(&honest, 6, 6);
    let digits = judge(&honest).unwrap().proof.general.digits.unwrap();
    assert!((13..=14).contains(&digits), "{digits}");
    // more digits than there are
    let boast = judge(&table.replace("order = 6", "order = 6\ndigits = 20")).unwrap_err().to_string();
    assert!(boast.contains("more than 20 digits of the weights can account for"), "{boast}");
}

/// Order 4 for quadratic T, 3 for others.
#[test]
fn order_4_for_quadratic_kinetic_energy_only() {
    let table = r#"
name = "mcate4"
order = 4
kinetic = "any"
digits = 17
reference = "R. I. McLachlan, P. Atela, Nonlinearity 5 (1992) 541"

[stages]
kick = ["0.13449619927743109", "-0.22481980307942081", "0.75632000051566829", "0.33400360328632143"]
drift = ["0.51535283743112294", "-0.085782019412973646", "0.44158302361646652", "0.12884615836538419"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:3:9: order 4 is claimed, order 3 holds for every T(p): the condition of the word KKKD fails
  3 | order = 4
    |         ^
  found 0.04343472671724274…, needed 1/24
  help: order 4 holds for quadratic T: write `kinetic = "quadratic"`
"#,
    );
    assert_orders(&table.replace("\"any\"", "\"quadratic\""), 3, 4);
    assert_orders(&table.replace("order = 4", "order = 3"), 3, 4);
}

/// Calvo and Sanz-Serna's and McLachlan and Atela's schemes, where a code does not say that T must be quadratic.
#[test]
fn more_schemes_for_quadratic_kinetic_energy_only() {
    let calvo = stages(
        4,
        14,
        &["0.06175885813563", "0.33897802655364", "0.61479130717558", "-0.14054801465938", "0.12501982279453"],
        &["0.20517766154229", "0.40302128160421", "-0.12092087633891", "0.51272193319241", "0"],
    );
    assert_refused(
        &calvo,
        r#"
mine.toml:2:9: order 4 is claimed, order 3 holds for every T(p): the condition of the word KKKD fails
  2 | order = 4
    |         ^
  found 0.04046715892823397…, needed 1/24
  help: order 4 holds for quadratic T: write `kinetic = "quadratic"`
"#,
    );
    assert_orders(&calvo.replace("\"any\"", "\"quadratic\""), 3, 4);

    let mcate5 = stages(
        5,
        17,
        &[
            "0.11939002928756728",
            "0.69892737038247523",
            "-0.17131235827160078",
            "0.40126950225135345",
            "0.010705081848235984",
            "-0.058979625498031163",
        ],
        &[
            "0.33983962583911000",
            "-0.088601336903027329",
            "0.58585647682596212",
            "-0.60303935653649189",
            "0.32358079655469764",
            "0.44236379421974946",
        ],
    );
    let refused = judge(&mcate5).unwrap_err().to_string();
    assert!(refused.contains("order 5 is claimed, order 3 holds for every T(p)"), "{refused}");
    assert!(refused.ends_with("help: order 5 holds for quadratic T: write `kinetic = \"quadratic\"`"), "{refused}");
    assert_orders(&mcate5.replace("\"any\"", "\"quadratic\""), 3, 5);
}

/// Fifteen digits of McLachlan's SS17, as codes for f64 have them: the sums are off by 2e-15.
#[test]
fn fifteen_digits_of_order_8() {
    let gammas = [
        "0.128865979381443",
        "0.581514087105251",
        "-0.410175371469850",
        "0.185146935716588",
        "-0.409552343420851",
        "0.144405941080012",
        "0.278335500393680",
        "0.314956683916295",
        "-0.626994825405134",
    ];
    let boast = judge(&composition(8, 20, &gammas)).unwrap_err().to_string();
    assert!(
        boast.contains("the kicks do not sum to 1") && boast.contains("off by 2e-15, more than 20 digits"),
        "{boast}"
    );
    assert_orders(&composition(8, 15, &gammas), 8, 8);
    let held = judge(&composition(8, 15, &gammas)).unwrap().proof.general.digits.unwrap();
    assert!((13..=15).contains(&held), "{held}");
}

/// Yoshida's solutions C and D of order 8 with the 20 digits that circulate, of which about 12 are right. The equations
/// are ill-conditioned there: the conditions hold as closely as 20 digits can tell, but the digits that hold say that
/// something is wrong.
#[test]
fn twenty_digits_of_which_twelve_are_right() {
    let c = [
        "0.629030650210427818049",
        "1.36934946416874222370",
        "-1.06458714789183904181",
        "1.66335809963311356298",
        "-1.67896928259637402925",
        "-1.55946803821449795876",
        "0.311790812418431890510",
        "1.6589908845439910692",
    ];
    let d = [
        "0.914844246229642658287",
        "0.253693336566286009974",
        "-1.44485223686030647660",
        "-0.158240635368502468458",
        "1.93813913762291232471",
        "-1.96061023297558163691",
        "0.102799849392219431139",
        "1.7084530707866603157",
    ];
    let held = |gammas: &[&str]| judge(&composition(8, 20, gammas)).unwrap().proof.general.digits.unwrap();
    assert!(held(&d) <= 14, "{}", held(&d));
    let remarks = judge(&composition(8, 20, &c)).unwrap().remarks;
    assert_eq!(remarks.len(), 1);
    assert_message(
        &remarks[0].to_string(),
        "mine.toml:5:10: 20 digits are claimed, the order conditions hold to 14\n  5 | digits = 20\n    |          ^^\n  \
         help: some digits of the weights may be wrong: write `digits = 14`, or look for a better source",
    );

    // the same solution C, polished
    let right = [
        "0.629030650210370799898",
        "1.36934946416881770056",
        "-1.06458714789182507054",
        "1.66335809963350517976",
        "-1.67896928259673847121",
        "-1.55946803821470258821",
        "0.311790812418466772552",
        "1.65899088454421135439",
    ];
    assert!(held(&right) >= 19, "{}", held(&right));
    assert!(judge(&composition(8, 20, &right)).unwrap().remarks.is_empty());
}

/// Two members of Kahan and Li's family circulate. Both are right, a mixture of them is not.
#[test]
fn two_members_of_one_family() {
    let one = [
        "0.39216144400731413927925056",
        "0.33259913678935943859974864",
        "-0.70624617255763935980996482",
        "0.08221359629355080023149045",
        "0.79854399093482996339895035",
    ];
    let other = [
        "0.39215846226558135393725811",
        "0.33260288849639382848984234",
        "-0.70624607359230088534941023",
        "0.08221272729243641010472095",
        "0.79854399107577858563517766",
    ];
    assert_orders(&composition(6, 25, &one), 6, 6);
    assert_orders(&composition(6, 25, &other), 6, 6);
    let mixed = judge(&composition(6, 25, &[one[0], other[1], one[2], one[3], one[4]])).unwrap_err().to_string();
    assert!(mixed.contains("the kicks do not sum to 1"), "{mixed}");
}

/// Runge–Kutta–Nyström schemes of order 6 with the roles of kick and drift exchanged, as a code may do that treats both
/// alike: order 4.
#[test]
fn exchanged_roles() {
    for (name, first) in [("blanes-moan-srkn14a", First::Kick), ("blanes-moan-srkn11b", First::Drift)] {
        let refused = read_first(&shipped(name).unwrap(), &|base, _| shipped(base), first).unwrap_err().to_string();
        let expected = "order 6 is claimed, order 4 holds for quadratic T: the condition of ";
        assert!(refused.contains(expected), "{refused}");
    }
}

/// The kernel of a processed scheme: orders (7,6,4) need its pre- and post-processor, alone it has order 2 (Blanes,
/// Casas & Ros, Celest. Mech. Dyn. Astron. 77 (2000) 17).
#[test]
fn a_kernel_without_its_processor() {
    let kernel = r#"
name = "kernel764"
order = 4
kinetic = "any"
near_integrable = [7, 6, 4]
digits = 16
reference = "S. Blanes, F. Casas, J. Ros, Celest. Mech. Dyn. Astron. 77 (2000) 17"

[constants]
a1 = "1.5171479707207228"
b1 = "0.5600879810924619"

[stages]
kick = [0, "a1", "1 - 2*a1", "a1"]
drift = ["b1", "1/2 - b1", "1/2 - b1", "b1"]
"#;
    assert_refused(
        kernel,
        r#"
mine.toml:3:9: order 4 is claimed, order 2 holds for every T(p): the condition of the word KKD fails
  3 | order = 4
    |         ^
  found 0.2028555712546861…, needed 1/6
mine.toml:5:20: order 7 is claimed, order 2 holds for the terms of ε: the condition of the word KDD fails
  5 | near_integrable = [7, 6, 4]
    |                    ^
  found 0.1304777620786472…, needed 1/6
mine.toml:5:23: order 6 is claimed, order 2 holds for the terms of ε^2: the condition of the word KKD fails
  5 | near_integrable = [7, 6, 4]
    |                       ^
  found 0.2028555712546861…, needed 1/6
mine.toml:5:26: order 4 is claimed, order 3 holds for the terms of ε^3 and higher powers: the condition of the word KKKD fails
  5 | near_integrable = [7, 6, 4]
    |                          ^
  found 0.05976111896067639…, needed 1/24
"#,
    );
    let honest = kernel.replace("order = 4", "order = 2").replace("[7, 6, 4]", "[2]");
    assert_orders(&honest, 2, 2);
}

/// A near-integrable order that one wrong weight spoils: Laskar and Robutel's SABA3 with 1/4 and 1/2 for its kicks.
#[test]
fn a_near_integrable_order_that_does_not_hold() {
    let table = r#"
name = "saba3"
order = 2
kinetic = "any"
near_integrable = [6, 2]
reference = "J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80 (2001) 39"

[constants]
b1 = "(1 - sqrt(3/5))/2"

[stages]
kick = [0, "1/4", "1/2", "1/4"]
drift = ["b1", "1/2 - b1", "1/2 - b1", "b1"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:5:20: order 6 is claimed, order 2 holds for the terms of ε: the condition of the word KDD fails
  5 | near_integrable = [6, 2]
    |                    ^
  found 0.1625…, needed 1/6
"#,
    );
    let right = table.replace("\"1/4\", \"1/2\", \"1/4\"", "\"5/18\", \"4/9\", \"5/18\"");
    assert_orders(&right, 2, 2);
    // with the kicks as the dominant part it is an ordinary scheme of order 2
    let dominant = judge(&right.replace("[6, 2]", "[6, 2]\ndominant = \"kick\"")).unwrap_err().to_string();
    assert!(dominant.contains("order 6 is claimed, order 2 holds for the terms of ε: "), "{dominant}");
    // a claim below the truth
    let modest = judge(&right.replace("[6, 2]", "[4, 2]")).unwrap();
    let remarks: Vec<_> = modest.remarks.iter().map(ToString::to_string).collect();
    assert_eq!(remarks.len(), 1);
    assert!(remarks[0].contains("order 4 is claimed, order 6 holds for the terms of ε"), "{}", remarks[0]);
}

/// One map too many or too few at the ends, and the sums no longer hold.
#[test]
fn sums_that_are_not_one() {
    assert_refused(
        r#"name = "verlet"
order = 2
kinetic = "any"
reference = "none"

[stages]
kick = ["1/2", "1/3"]
drift = [1, 0]
"#,
        r#"
mine.toml:7:8: the kicks do not sum to 1, so not even order 1 holds
  7 | kick = ["1/2", "1/3"]
    |        ^^^^^^^^^^^^^^
  found 5/6, needed 1
"#,
    );
}

// ---------------------------------------------------------------------------------------------------------------
// Claims

#[test]
fn a_palindrome_that_is_none() {
    assert_refused(
        r#"name = "ruth3"
order = 3
kinetic = "any"
symmetric = true
reference = "R. D. Ruth, IEEE Trans. Nucl. Sci. NS-30 (1983) 2669"

[stages]
kick = ["7/24", "3/4", "-1/24"]
drift = ["2/3", "-2/3", 1]
"#,
        r#"
mine.toml:4:13: a palindrome is claimed, the maps do not read the same backwards
  4 | symmetric = true
    |             ^^^^
  found kick 7/24 as map 1 from the start, needed drift 1, the map 1 from the end
  help: correct the weights, or leave `symmetric` out
"#,
    );
}

/// A wrong order and a wrong symmetry come together, in the order of their places.
#[test]
fn all_wrong_claims_at_once() {
    assert_refused(
        r#"name = "euler"
symmetric = true
order = 2
kinetic = "any"
reference = "none"

[stages]
kick = [1]
drift = [1]
"#,
        r#"
mine.toml:2:13: a palindrome is claimed, the maps do not read the same backwards
  2 | symmetric = true
    |             ^^^^
  found kick 1 as map 1 from the start, needed drift 1, the map 1 from the end
  help: correct the weights, or leave `symmetric` out
mine.toml:3:9: order 2 is claimed, order 1 holds for every T(p): the condition of the word KD fails
  3 | order = 2
    |         ^
  found 1, needed 1/2
"#,
    );
}
