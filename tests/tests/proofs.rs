//! Protects the proofs of orders: schemes of the literature, with the digits that were published, have the orders that
//! were published, for every T(p) and for quadratic T, and no higher ones.

use shadowstep_schemes::{First, Proved, Source, read, read_first, shipped};

fn source(text: &str) -> Source {
    Source { path: "literature.toml".to_owned(), text: text.to_owned() }
}

fn proved(text: &str) -> Proved {
    read(&source(text), &|base, _| shipped(base)).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The proved orders for every T(p) and for quadratic T.
fn orders(proved: &Proved) -> (u32, u32) {
    (proved.proof.general.order, proved.proof.quadratic.order)
}

/// A symmetric composition of Störmer–Verlet: γ_1, …, γ_k, 1 − 2(γ_1 + … + γ_k), γ_k, …, γ_1.
fn composition(order: u32, digits: u32, outer: &[&str]) -> String {
    let mut constants = String::new();
    let mut names = Vec::new();
    for (i, gamma) in (1..).zip(outer) {
        constants += &format!("g{i} = \"{gamma}\"\n");
        names.push(format!("g{i}"));
    }
    constants += &format!("g0 = \"1 - 2*({})\"\n", names.join(" + "));
    let middle = ["g0".to_owned()];
    let all: Vec<_> = names.iter().chain(&middle).chain(names.iter().rev()).map(|n| format!("{n:?}")).collect();
    format!(
        "name = \"composition\"\norder = {order}\nkinetic = \"any\"\nsymmetric = true\ndigits = {digits}\n\
         reference = \"as printed\"\n\n[constants]\n{constants}\n[composition]\nbase = \"stormer-verlet\"\n\
         gamma = [{}]\n",
        all.join(", ")
    )
}

/// A table of stages as printed.
fn stages(order: u32, kinetic: &str, digits: u32, kick: &[&str], drift: &[&str]) -> String {
    format!(
        "name = \"stages\"\norder = {order}\nkinetic = {kinetic:?}\ndigits = {digits}\nreference = \"as printed\"\n\n\
         [stages]\nkick = {kick:?}\ndrift = {drift:?}\n"
    )
}

/// H. Yoshida, Phys. Lett. A 150 (1990) 262, solution A of order 6; 7 stages, 20 digits.
const YOSHIDA_6A: &[&str] = &["0.78451361047755726382", "0.23557321335935813369", "-1.17767998417887100695"];

/// M. Suzuki, K. Umeno (1993), order 8; 15 stages, 40 digits.
const SUZUKI_UMENO_8: &[&str] = &[
    "0.7416703643506129534482278017838063156035",
    "-0.4091008258000315939973000958935634173099",
    "0.1907547102962383799538762564503716627355",
    "-0.5738624711160822666563877266355357421595",
    "0.2990641813036559238444635406886029882258",
    "0.3346249182452981837849579798821822886337",
    "0.3152930923967665966320566638110024309941",
];

/// M. Sofroniou, G. Spaletta, Optim. Methods Softw. 20 (2005) 597, order 10; 35 stages, 32 digits.
const SOFRONIOU_SPALETTA_10: &[&str] = &[
    "0.078795722521686419263907679337684",
    "0.31309610341510852776481247192647",
    "0.027918383235078066109520273275299",
    "-0.22959284159390709415121339679655",
    "0.13096206107716486317465685927961",
    "-0.26973340565451071434460973222411",
    "0.074973343155891435666137105641410",
    "0.11199342399981020488957508073640",
    "0.36613344954622675119314812353150",
    "-0.39910563013603589787862981058340",
    "0.10308739852747107731580277001372",
    "0.41143087395589023782070411897608",
    "-0.0048663605831352617621956593099771",
    "-0.39203335370863990644808193642610",
    "0.051942502962449647037182904015976",
    "0.050665090759924496335874344156866",
    "0.049674370639729879054568800279461",
];

/// Kicks and drifts of R. I. McLachlan, P. Atela, Nonlinearity 5 (1992) 541, order 4, not symmetric; 17 digits.
const MCLACHLAN_ATELA_4: [&[&str]; 2] = [
    &["0.13449619927743109", "-0.22481980307942081", "0.75632000051566829", "0.33400360328632143"],
    &["0.51535283743112294", "-0.085782019412973646", "0.44158302361646652", "0.12884615836538419"],
];

/// Kicks and drifts of D. I. Okunbor, R. D. Skeel, J. Comput. Appl. Math. 51 (1994) 375, order 6; 17 digits.
const OKUNBOR_SKEEL_6: [&[&str]; 2] = [
    &[
        "0",
        "0.00016600692650009894",
        "-0.37962421426377361",
        "0.68913741185181064",
        "0.38064159097092574",
        "0.68913741185181064",
        "-0.37962421426377361",
        "0.00016600692650009894",
    ],
    &[
        "-1.0130879789171747",
        "1.1874295737325427",
        "-0.018335852096460590",
        "0.34399425728109261",
        "0.34399425728109261",
        "-0.018335852096460590",
        "1.1874295737325427",
        "-1.0130879789171747",
    ],
];

/// Kicks and drifts of S. Blanes, F. Casas, A. Escorihuela-Tomàs, Appl. Numer. Math. 182 (2022) 14, order 8; 19 digits.
const BLANES_CASAS_ESCORIHUELA_8: [&[&str]; 2] = [
    &[
        "0",
        "0.1458503048126447316",
        "0.2551565441392939442",
        "0.01813346882083172514",
        "-0.1790401102992645546",
        "-0.1184708014333022451",
        "0.1864616892738210833",
        "0.4590415817671368402",
        "-0.003660836270318358975",
        "-0.5269436816216863317",
        "-0.003660836270318358975",
        "0.4590415817671368402",
        "0.1864616892738210833",
        "-0.1184708014333022451",
        "-0.1790401102992645546",
        "0.01813346882083172514",
        "0.2551565441392939442",
        "0.1458503048126447316",
    ],
    &[
        "0.05209243438403390064",
        "0.2252874932677021658",
        "0.4162761896122571178",
        "-0.3845672702139503997",
        "0.09972717834705148167",
        "-0.1088338343991002188",
        "0.2220107366489916808",
        "0.5238795220367342960",
        "-0.5458724496837200244",
        "-0.5458724496837200244",
        "0.5238795220367342960",
        "0.2220107366489916808",
        "-0.1088338343991002188",
        "0.09972717834705148167",
        "-0.3845672702139503997",
        "0.4162761896122571178",
        "0.2252874932677021658",
        "0.05209243438403390064",
    ],
];

#[test]
fn compositions_of_orders_6_8_and_10() {
    for (gammas, order, digits) in [(YOSHIDA_6A, 6, 20), (SUZUKI_UMENO_8, 8, 40), (SOFRONIOU_SPALETTA_10, 10, 32)] {
        let found = proved(&composition(order, digits, gammas));
        println!("order {order}, {} stages", 2 * gammas.len() + 1);
        assert_eq!(orders(&found), (order, order), "a composition has one order for every T");
        assert!(found.proof.symmetric);
        assert!(found.notes.is_empty(), "{:?}", found.notes);
        // the conditions hold to nearly as many digits as were printed: products of weights up to 1.3 lose one or two
        for proof in [&found.proof.general, &found.proof.quadratic] {
            let held = proof.digits.expect("rounded weights meet no condition exactly");
            println!("  held to {held} of {digits} digits");
            assert!((digits - 3..=digits + 1).contains(&held), "{held} of {digits}");
        }
        // the stages written out are Störmer–Verlet's two, merged
        assert_eq!(found.plan.evaluations, 2 * gammas.len() + 1);
    }
}

#[test]
fn schemes_for_quadratic_kinetic_energy() {
    for (name, [kick, drift], digits, expected) in [
        ("McLachlan & Atela 4", MCLACHLAN_ATELA_4, 17, (3, 4)),
        ("Okunbor & Skeel 6", OKUNBOR_SKEEL_6, 17, (4, 6)),
        ("Blanes, Casas & Escorihuela 8", BLANES_CASAS_ESCORIHUELA_8, 19, (4, 8)),
    ] {
        let found = proved(&stages(expected.1, "quadratic", digits, kick, drift));
        println!("{name}: {:?} of {digits} digits", found.proof.quadratic.digits);
        assert_eq!(orders(&found), expected, "{name}");
    }
}

/// Where T is quadratic, kick and drift are not interchangeable: exchanging them loses orders, which is proved again.
#[test]
fn exchanging_kick_and_drift_loses_orders() {
    for (name, [kick, drift], digits, first, (claimed, left)) in [
        ("McLachlan & Atela 4", MCLACHLAN_ATELA_4, 17, First::Drift, (4, 3)),
        ("Okunbor & Skeel 6", OKUNBOR_SKEEL_6, 17, First::Kick, (6, 4)),
    ] {
        let library = |base: &str, _: &Source| shipped(base);
        let faults = read_first(&source(&stages(claimed, "quadratic", digits, kick, drift)), &library, Some(first));
        let faults = faults.expect_err(name).to_string();
        assert!(faults.contains(&format!("order {claimed} is claimed, order {left} holds")), "{name}: {faults}");
        let kept = read_first(&source(&stages(left, "quadratic", digits, kick, drift)), &library, Some(first));
        assert_eq!(orders(&kept.expect("the lower order holds")), (left, left), "{name}");
    }
}

/// One weight off by 2e-18, as a copy of this table has it: the order still holds as closely as 20 digits and the many
/// products of fifteen stages can tell, but the digits that hold show that something is wrong.
#[test]
fn a_wrong_digit_costs_the_digits_behind_it() {
    let mut gammas: Vec<&str> = SUZUKI_UMENO_8.iter().map(|gamma| &gamma[..gamma.len() - 20]).collect();
    let held = |gammas: &[&str]| proved(&composition(8, 20, gammas)).proof.general.digits.expect("rounded");
    assert!(held(&gammas) >= 19, "{}", held(&gammas));
    assert_eq!(gammas[3], "-0.57386247111608226665");
    gammas[3] = "-0.57386247111608226464";
    assert!(held(&gammas) <= 18, "{}", held(&gammas));
}

/// A claim below the truth is not a fault, but is noted.
#[test]
fn a_modest_claim_is_remarked() {
    let found = proved(&composition(4, 20, YOSHIDA_6A));
    assert_eq!(orders(&found), (6, 6));
    let remarks: Vec<_> = found.notes.iter().map(ToString::to_string).collect();
    assert_eq!(
        remarks,
        ["literature.toml:2:9: order 4 is claimed, order 6 holds for every T(p)\n  \
          2 | order = 4\n    |         ^\n  hint: write `order = 6`"]
    );
}
