//! Protects the reader of source code: its languages, in the sources of `sources.toml`, the meanings of lists, what it
//! finds wrong; and that it recognises every shipped scheme.

use std::sync::LazyLock;

use num_traits::ToPrimitive;
use shadowstep_analysis::sources::{Checked, Language, Verdict, check};
use shadowstep_schemes::table::Weights;
use shadowstep_schemes::{First, Proved, Rational, shipped_names, shipped_proved, to_significant};
use toml::{Table, Value};

/// The only scheme of a source.
#[track_caller]
fn only(text: &str, language: Language) -> Verdict {
    let Checked { mut verdicts, .. } = check(text, language);
    assert_eq!(verdicts.len(), 1, "{text}\n{verdicts:#?}");
    verdicts.remove(0)
}

/// The only scheme is this one, and nothing is wrong.
#[track_caller]
fn assert_is(name: &str, text: &str, language: Language) -> Verdict {
    let verdict = only(text, language);
    assert_eq!(verdict.likeness.as_ref().map(|likeness| likeness.known.name), Some(name), "{text}\n{verdict:#?}");
    assert!(verdict.faults.is_empty(), "{text}\n{:?}", verdict.faults);
    verdict
}

/// The only scheme has one fault, with these words.
#[track_caller]
fn assert_wrong(words: &[&str], text: &str, language: Language) -> Verdict {
    let verdict = only(text, language);
    for words in words {
        assert!(verdict.faults.iter().any(|fault| fault.contains(words)), "{words}\n{:#?}", verdict.faults);
    }
    verdict
}

// ---- languages ----

/// A source of `sources.toml`.
struct Known {
    language: Language,
    scheme: &'static str,
    name: Option<&'static str>,
    text: &'static str,
}

static KNOWN: LazyLock<Vec<Known>> = LazyLock::new(|| {
    let document: &Table = Box::leak(Box::new(include_str!("sources.toml").parse().unwrap()));
    let known = |source: &'static Value| {
        let text = |key: &str| source.get(key).map(|value| value.as_str().expect("a text"));
        let is_named = |language: &Language| format!("{language:?}") == text("language").unwrap();
        let language = Language::ALL.into_iter().find(is_named).expect("a language");
        Known { language, scheme: text("is").unwrap(), name: text("name"), text: text("text").unwrap() }
    };
    document["source"].as_array().unwrap().iter().map(known).collect()
});

/// Arrays with sizes, suffixes, macros and elements in C; the elements of two arrays that types derive from in C++;
/// exponents, kinds and constructors in Fortran; tuples, powers, arrays and loops in Python; conversions, rationals and
/// big numbers in Julia; conversions, loops and types in Rust; lists by keys in JSON. In C 1/3 is 0, so that its root
/// is 1.
#[test]
fn languages_are_read() {
    for Known { language, scheme, name, text } in KNOWN.iter() {
        let verdict = assert_is(scheme, text, *language);
        assert!(name.is_none_or(|name| verdict.name == name), "{text}\n{}", verdict.name);
    }
}

// ---- wrong lists ----

/// A half of a palindrome whose middle is appended twice.
#[test]
fn an_entry_too_many() {
    let text = "fn eighth_order() {\n let w = [0.74167036435061, -0.40910082580003, 0.19075471029623, \
        -0.57386247111608, 0.29906418130365,\n\
        0.33462491824529, 0.31529309239676, -0.79688793935291];\n let mut weights = Vec::new();\n for &x in &w { \
        weights.push(x); }\n\
        weights.push(w[7]);\n for i in (0..7).rev() { weights.push(w[i]); } }";
    let words = [
        "the weights sum to 0.203",
        "suzuki-umeno8 with one entry too many",
        "order 8 is claimed by `eighth_order`, order 0 holds",
    ];
    let verdict = assert_wrong(&words, text, Language::Rust);
    assert_eq!((verdict.name.as_str(), verdict.orders), ("weights", [0, 0]));
}

/// The three-stage scheme of BCSS under the name of a scheme of order 4.
#[test]
fn a_scheme_under_the_name_of_another() {
    let text = "b1 = 0.11888010966548\na1 = 0.29619504261126\nyoshida_weights = [b1, a1, 0.5 - b1, 1 - 2*a1, 0.5 - \
        b1, a1, b1]";
    let verdict = assert_wrong(
        &["named after Yoshida, whose schemes have order 4 and more; it is bcss3, of order 2"],
        text,
        Language::Python,
    );
    assert_eq!(verdict.orders, [2, 2]);
    assert_is("bcss3", &text.replace("yoshida", "hmc"), Language::Python);
}

/// Yoshida's solution A of order 8 with an exponent lost: the sum holds, as the middle follows from it.
#[test]
fn a_lost_exponent() {
    let proved = shipped_proved("yoshida8-a").unwrap();
    let weights =
        proved.scheme.maps().into_iter().skip(1).step_by(2).take(7).map(|map| to_significant(&map.weight, 15));
    let right = format!("w = [{}]", weights.collect::<Vec<_>>().join(", "))
        .replace("-0.00716989419709533", "-0.716989419709533e-2");
    assert!(right.contains("e-2"), "{right}");
    assert_is("yoshida8-a", &right, Language::Python);
    let wrong = right.replace("e-2", "");
    let verdict = assert_wrong(
        &["it is yoshida8-a but for these entries: entry 5", "its exponent e-2 is missing"],
        &wrong,
        Language::Python,
    );
    assert_eq!(verdict.orders, [2, 2]);
}

/// 1/7 in place of 1/3 in Suzuki's product formula of order 4.
#[test]
fn another_root() {
    let text =
        |root: &str| format!("# fourth order product formula\ns = 1/(4 - 4**({root}))\nsuzuki = [s, s, 1 - 4*s, s, s]");
    assert_is("suzuki4", &text("1/3"), Language::Python);
    assert_wrong(&["order 4 is claimed by the comment, order 2 holds"], &text("1/7"), Language::Python);
}

#[test]
fn a_digit_a_sign_and_a_missing_entry() {
    let text = |w: &str| format!("double alpha[] = {{{w}}};");
    let weights =
        shipped_proved("blanes-moan-s6").unwrap().scheme.maps().into_iter().map(|map| to_significant(&map.weight, 16));
    let right = weights.collect::<Vec<_>>().join(", ");
    assert_is("blanes-moan-s6", &text(&right), Language::C);
    let entries: Vec<_> = right.split(", ").collect();
    let changed = |place: usize, entry: &str| {
        let mut entries = entries.clone();
        entries[place] = entry;
        text(&entries.join(", "))
    };
    let sign = assert_wrong(
        &["blanes-moan-s6 but for these entries: entry 4"],
        &changed(3, entries[3].trim_start_matches('-')),
        Language::C,
    );
    assert!(sign.faults.iter().any(|fault| fault.contains("with the other sign")), "{:?}", sign.faults);
    assert_wrong(&["blanes-moan-s6 without"], &text(&entries[..12].join(", ")), Language::C);
    let mut swapped = entries[2].to_owned().into_bytes();
    swapped.swap(12, 13);
    assert_wrong(
        &["rounding does not explain the digits", "two digits may be transposed"],
        &changed(2, std::str::from_utf8(&swapped).unwrap()),
        Language::C,
    );
    // where the middle takes up the change, the sums hold
    let half = |entry: &str| format!("alpha = [{}, {entry}, {}]", entries[..2].join(", "), entries[3..6].join(", "));
    assert_is("blanes-moan-s6", &half(entries[2]), Language::Python);
    assert_wrong(
        &["rounding does not explain the digits"],
        &half(std::str::from_utf8(&swapped).unwrap()),
        Language::Python,
    );
}

/// Weights of thermostats with the root of 1/2 in place of that of 2: beside the right ones of order 6, and under a
/// name. Five digits decide nothing beyond the sums; as exact numbers they have an order.
#[test]
fn decimals_of_few_digits_have_the_order_of_exact_numbers() {
    let text = "# fourth order\nweights = [1.3512, -1.7024, 1.3512]";
    let verdict =
        assert_wrong(&["order 4 is claimed by the comment, order 2 holds", "the word KKD"], text, Language::Python);
    assert_eq!((verdict.orders, verdict.digits), ([2, 2], None));
}

#[test]
fn lists_beside_a_scheme_are_schemes() {
    let text = "def weights(self, count):\n    if count == 3:\n        self.list = [0.828981543588751, \
        -0.657963087177502, 0.828981543588751]\n    if count == 7:\n        self.list = [0.784513610477560, \
        0.235573213359357, -1.17767998417887, 1.31518632068391, -1.17767998417887, 0.235573213359357, \
        0.784513610477560]\n";
    let found = check(text, Language::Python);
    assert_eq!(found.verdicts.iter().map(|verdict| verdict.orders[0]).collect::<Vec<_>>(), [2, 6], "{found:#?}");
    let named = text.split("    if count == 7").next().unwrap().replace("self.list", "suzuki_yoshida");
    assert_wrong(
        &["named after Suzuki, whose schemes have order 4 and more; it has order 2"],
        &named,
        Language::Python,
    );
}

/// What is not a scheme is skipped, and counted.
#[test]
fn other_lists_are_skipped() {
    let text = "times = [0.5, 1.0, 1.5]\nb = [35/384, 0, 500/1113, 125/192, -2187/6784, 11/84]\nnodes = \
        [0.2777777777777778, 0.4444444444444444, 0.2777777777777778]\n\
                colours = [0.1234567890123, 0.8765432109877]\nshape = (3, 4)\n# Gauss and Legendre's weights and nodes\n\
                weights = [0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454]\nc = \
                [0.211324865405187, 0.788675134594813]\n\
                velocities = [0.5, 1.0, 0.5]\nnode = 0.2113248654051871\n";
    let found = check(text, Language::Python);
    assert!(found.verdicts.is_empty(), "{:#?}", found.verdicts);
    assert_eq!(found.skipped, 8);
}

/// A scheme of Nyström's kind: which of the lists are the kicks matters for its order.
#[test]
fn the_first_map_matters_for_quadratic_kinetic_energies() {
    let proved = shipped_proved("blanes-moan-srkn14a").unwrap();
    let text = maps_as(Language::Python, proved);
    let verdict = assert_is("blanes-moan-srkn14a", &text, Language::Python);
    assert_eq!((verdict.orders, verdict.first), ([4, 6], Some(First::Drift)));
}

/// Whatever is cut out, doubled or changed: an answer, not a panic.
#[test]
fn any_text_has_an_answer() {
    const SIGNS: &[u8] = b"()[]{}\"'=,;:.*/-+e09\n&!#";
    let mut random = 12345_u64;
    let mut next = |below: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % below
    };
    for Known { text, .. } in KNOWN.iter().step_by(4) {
        for _ in 0..12 {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..=next(3) {
                let (from, length) = (next(bytes.len()), next(20));
                let part = from..(from + length).min(bytes.len());
                match next(3) {
                    0 => drop(bytes.drain(part)),
                    1 => bytes.extend_from_within(part),
                    _ => bytes[from] = SIGNS[next(SIGNS.len())],
                }
                if bytes.is_empty() {
                    break;
                }
            }
            let text = String::from_utf8(bytes).unwrap();
            for language in Language::ALL {
                let found = check(&text, language);
                assert!(found.verdicts.iter().all(|verdict| verdict.line > 0), "{text}");
            }
        }
    }
}

// ---- all shipped schemes ----

fn literal(language: Language, weight: &Rational) -> String {
    let text = to_significant(weight, 20);
    let text = if text.contains(['.', 'e']) { text } else { format!("{text}.0") };
    match language {
        Language::Fortran | Language::FixedFortran if text.contains('e') => text.replace('e', "d"),
        Language::Fortran | Language::FixedFortran => format!("{text}d0"),
        Language::Rust => format!("{text}_f64"),
        _ => text,
    }
}

fn array(language: Language, name: &str, weights: &[Rational]) -> String {
    let list = weights.iter().map(|weight| literal(language, weight)).collect::<Vec<_>>().join(", ");
    let count = weights.len();
    match language {
        Language::C => format!("static const double {name}[{count}] = {{{list}}};\n"),
        Language::Fortran | Language::FixedFortran => {
            format!("real(8), parameter :: {name}({count}) = (/ {} /)\n", list.replace(", ", ", &\n  "))
        }
        Language::Python => format!("{name} = np.array([{list}])\n"),
        Language::Julia => format!("const {name} = Float64[{list}]\n"),
        Language::Rust => format!("const {}: [f64; {count}] = [{list}];\n", name.to_uppercase()),
        Language::Json => format!("\"{name}\": [{list}]"),
    }
}

fn document(language: Language, arrays: &[String]) -> String {
    match language {
        Language::Json => format!("{{{}}}", arrays.join(",\n")),
        _ => arrays.concat(),
    }
}

/// The maps as two arrays, of the maps that begin and of the others.
fn maps_as(language: Language, proved: &Proved) -> String {
    let weights: Vec<_> = proved.scheme.maps().into_iter().map(|map| map.weight).collect();
    let [first, second] = [0, 1].map(|kind| weights.iter().skip(kind).step_by(2).cloned().collect::<Vec<_>>());
    document(language, &[array(language, "splitting_a", &first), array(language, "splitting_b", &second)])
}

/// The γ's of a composition of Störmer–Verlet, half of them where it is a palindrome.
fn halves_as(language: Language, proved: &Proved) -> String {
    let weights: Vec<_> = proved.scheme.maps().into_iter().map(|map| map.weight).collect();
    let is_composition = matches!(&proved.scheme.table.weights, Some(Weights::Composition { base, .. }) if base.value == "stormer-verlet");
    if is_composition {
        let gamma: Vec<_> = weights.into_iter().skip(1).step_by(2).collect();
        return document(language, &[array(language, "composition", &gamma[..gamma.len().div_ceil(2)])]);
    }
    document(language, &[array(language, "splitting", &weights[..weights.len().div_ceil(2)])])
}

/// Whether the verdict is of the scheme, or of another one of the same weights.
fn assert_itself(name: &str, proved: &Proved, text: &str, language: Language) {
    let verdict = only(text, language);
    let likeness = verdict.likeness.as_ref().unwrap_or_else(|| panic!("{name}\n{text}\n{verdict:#?}"));
    let (mine, found) = (proved.scheme.maps(), shipped_proved(likeness.known.name).unwrap().scheme.maps());
    let same = mine.iter().zip(&found).all(|(a, b)| (&a.weight - &b.weight).to_f64().unwrap().abs() < 1e-15);
    assert!(mine.len() == found.len() && same, "{name} is found to be {}", likeness.known.name);
    assert!(verdict.faults.is_empty(), "{name}: {:?}\n{text}", verdict.faults);
    assert_eq!(verdict.orders, [proved.proof.general.order, proved.proof.quadratic.order], "{name}");
    assert!(verdict.digits.is_none_or(|digits| digits >= 16), "{name}: {:?}", verdict.digits);
}

#[test]
fn every_shipped_scheme_is_recognised_in_every_language() {
    let languages = [Language::C, Language::Fortran, Language::Python, Language::Julia, Language::Rust, Language::Json];
    let (mut whole, mut halves) = (0, 0);
    for (i, name) in shipped_names().into_iter().enumerate() {
        let proved = shipped_proved(name).unwrap();
        if proved.scheme.has_gradient_kicks() || proved.scheme.inner.is_some() || proved.scheme.maps().len() < 3 {
            continue;
        }
        let language = |shift: usize| languages[(i + shift) % languages.len()];
        assert_itself(name, proved, &maps_as(language(0), proved), language(0));
        whole += 1;
        if proved.proof.symmetric && proved.scheme.maps().len() > 3 {
            assert_itself(name, proved, &halves_as(language(1), proved), language(1));
            halves += 1;
        }
    }
    assert!(whole > 75 && halves > 60, "{whole}, {halves}");
}
