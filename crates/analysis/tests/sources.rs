//! Protects the reader of source code: its languages, the meanings of lists, what it finds wrong; and that it
//! recognises every shipped scheme.

use num_traits::ToPrimitive;
use shadowstep_analysis::sources::{Checked, Language, Verdict, check};
use shadowstep_schemes::table::Weights;
use shadowstep_schemes::{First, Proved, Rational, shipped_names, shipped_proved, to_significant};

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

#[test]
fn c_has_arrays_sizes_suffixes_macros_and_elements() {
    assert_is(
        "blanes-moan-s6",
        "/* BM4 */ static const double alpha[6] = {0.0792036964311957L, 0.1303114101821663, 0.2228614958676077,\n\
        -0.3667132690474257, 0.3246481886897062, 0.1096884778767498};",
        Language::C,
    );
    assert_is("yoshida4", "#define W1 1.3512071919596578 // symplectic\ndouble w[] = {W1, 1 - 2*W1, W1};", Language::C);
    assert_is(
        "yoshida4",
        "double w[3]; w[0] = 1.0/(2.0 - pow(2.0, 1.0/3.0)); w[1] = 1 - 2*w[0]; w[2] = w[0];",
        Language::C,
    );
    assert_is(
        "suzuki4",
        "struct scheme s = { .order = 4, .gamma = {0.41449077179437573714, 0.41449077179437573714,\n\
        -0.65796308717750294857, 0, 0, 0, 0} };",
        Language::C,
    );
    assert_is(
        "ruth3",
        "constexpr std::array<double, 3> kick{7./24., 0.75, -1.0/24}; constexpr std::array<double, 3> drift{2./3, \
            -2.0/3, 1.0};",
        Language::C,
    );
    assert_is(
        "mclachlan-sb3a4",
        "const double b[] = {0.188'195'217'768'838'217'87, -0.021'528'551'102'171'551'201, \
            0.666'666'666'666'666'666'67,\n\
        -0.021'528'551'102'171'551'201, 0.188'195'217'768'838'217'87}; const double a[] = {1, -0.5, -0.5, 1};",
        Language::C,
    );
}

/// The elements of two arrays that types derive from.
#[test]
fn cpp_has_casts_and_elements_of_this() {
    let text = "struct kicks : array<T, 4> { kicks() { (*this)[0] = static_cast<T>(1); (*this)[1] = \
        static_cast<T>(-1) / static_cast<T>(2);\n\
        (*this)[2] = (*this)[1]; (*this)[3] = (*this)[0]; } };\nstruct drifts : array<T, 5> { drifts() { T z = \
        sqrt(static_cast<T>(7) / static_cast<T>(8)) / 3;\n\
        (*this)[0] = static_cast<T>(1) / static_cast<T>(2) - z / static_cast<T>(1); (*this)[1] = z - \
        static_cast<T>(1) / static_cast<T>(3);\n\
        (*this)[2] = 2.0 / 3; (*this)[3] = (*this)[1]; (*this)[4] = (*this)[0]; } };";
    let verdict = assert_is("mclachlan-sb3a4", text, Language::C);
    assert_eq!(verdict.name, "kicks and drifts");
}

#[test]
fn fortran_has_exponents_kinds_and_constructors() {
    assert_is(
        "yoshida6-a",
        "real(dp), parameter :: w1 = -0.117767998417887d1, w2 = 0.235573213359357_dp, &\n  w3 = 0.784513610477560D0\n\
        real(dp), parameter :: w(7) = (/ w3, w2, w1, 1.0_dp - 2*(w1 + w2 + w3), w1, w2, w3 /)",
        Language::Fortran,
    );
    assert_is(
        "pefrl",
        "      DOUBLE PRECISION A(5), B(4)\nC     the drifts\n      A(1) = 0.1786178958448091D0\n      A(2) = \
            -0.6626458266981849D-1\n\
      \x20     A(3) = 1D0 - 2D0*(A(1) + A(2))\n      A(4) = A(2)\n      A(5) = A(1)\n      B(1) = \
      0.7123418310626054D0\n      B(2) = 0.5D0 - B(1)\n\
      \x20     B(3) = B(2)\n      B(4) = B(1)\n",
        Language::FixedFortran,
    );
    assert_is(
        "yoshida4",
        "x = [real(8) :: 1.3512071919596578_8, -1.7024143839193153_8, 1.3512071919596578_8] ! symplectic",
        Language::Fortran,
    );
}

#[test]
fn python_has_tuples_powers_arrays_and_loops() {
    assert_is(
        "yoshida4",
        "c1 = c4 = 1/(2*(2 - 2**(1/3)))\nc2 = c3 = (1 - 2**(1/3))*c1\nd1 = d3 = 2*c1\nd2 = -2**(1/3)*d1\n\
        c = np.array([c1, c2, c3, c4])\nd = np.array([d1, d2, d3, 0.])\n",
        Language::Python,
    );
    assert_is(
        "efrl",
        "xi, lam, chi = 0.1720865590295143, -0.09156203075515678, -0.1616217622107222\n\
        half = [xi, 0.5 - lam, chi, lam, 1 - 2*(chi + xi)]\n",
        Language::Python,
    );
    assert_is(
        "yoshida6-a",
        "half = [0.784513610477560, 0.235573213359357, -1.17767998417887, 1.31518632068391]\nw = []\nfor x in \
        half:\n    w.append(x)\nfor i in range(2, -1, -1):\n    w.append(half[i])\n",
        Language::Python,
    );
    assert_is(
        "bcss3",
        "class Three:\n    def __init__(self):\n        self.a_0 = 0.11888010966548\n        self.b_1 = \
        0.29619504261126\n        run((self.a_0, self.b_1))\n",
        Language::Python,
    );
}

#[test]
fn julia_has_conversions_rationals_and_big_numbers() {
    assert_is(
        "mclachlan-sb3a5",
        "a1 = convert(T, -3//73); a2 = convert(T, 17//59); a3 = 1 - 2(a1 + a2)\n\
        b1 = T(big\"0.40518861839525227722\"); b2 = T(\"-0.28714404081652408900\"); b3 = 1//2 - (b1 + b2)\n\
        kick = [a1, a2, a3, a2, a1]; drift = T[b1, b2, b3, b3, b2, b1]\n",
        Language::Julia,
    );
    assert_is("ruth3", "const third = Scheme([7/24, 3/4, -1/24], [2/3, -2/3, 1])", Language::Julia);
}

#[test]
fn rust_has_conversions_loops_and_types() {
    assert_is(
        "suzuki-umeno8",
        "let half: [f64; 8] = [0.741_670_364_350_612_95, -0.409_100_825_800_031_6, 0.190_754_710_296_238_38_f64,\n\
        -0.573_862_471_116_082_3, 0.299_064_181_303_655_9, 0.334_624_918_245_298_2, 0.315_293_092_396_766_6, \
        -0.796_887_939_352_916_4];\n\
        let mut all = Vec::new();\nfor &w in &half { all.push(w); }\nfor i in (0..7).rev() { all.push(half[i]); }\n",
        Language::Rust,
    );
    assert_is(
        "yoshida4",
        "let two = F::one() + F::one(); let root = two.powf(F::from_f64(1.0 / 3.0).unwrap());\n\
        let w1 = F::one() / (two - root); let w0 = -root / (two - root); let w = vec![w1, w0, w1];",
        Language::Rust,
    );
    assert_is(
        "yoshida4",
        "const W: [f64; 3] = [1.3512071919596578, -1.7024143839193153, 1.3512071919596578];",
        Language::Rust,
    );
}

#[test]
fn json_has_lists_by_keys() {
    let verdict = assert_is(
        "yoshida4",
        "{\"yoshida\": {\"order\": 4, \"kick\": [\"0.6756035959798288\", -0.1756035959798288, -0.1756035959798288, \
            0.6756035959798288],\n\
        \"drift\": [1.3512071919596578, -1.7024143839193153, 1.3512071919596578]}, \"masses\": [0.5, 1.5]}",
        Language::Json,
    );
    assert_eq!(verdict.name, "yoshida.kick and yoshida.drift");
}

/// 1/3 is 0 in some languages, so that the root is 1.
#[test]
fn whole_numbers_are_divided_as_the_language_divides_them() {
    let text = "w = pow(2.0, 1/3); yoshida[0] = 1/(2 - w) + 0.3512071919596578; yoshida[1] = 1 - 2*yoshida[0]; \
        yoshida[2] = yoshida[0];";
    assert_is("yoshida4", text, Language::C);
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
    let texts = [
        "double w[3]; w[0] = 1.0/(2.0 - pow(2.0, 1.0/3.0)); w[1] = 1 - 2*w[0]; w[2] = w[0]; /* a */ #define X 0.5",
        "real(dp), parameter :: w(3) = (/ 1.3512071919596578_dp, &\n -1.7024143839193153d0, 1.351207191959658 /) ! order 4",
        "a, b = 0.11888010966548, 0.29619504261126\nyoshida = [a, b, 0.5 - a, 1 - 2*b, 0.5 - a, b, a]\nfor x in \
            range(3):\n  w.append(x)",
        "let w = [0.784513610477560_f64, 0.235573213359357]; for &x in &w { v.push(x); } for i in (0..2).rev() { \
            v.push(w[i]); }",
        "x = convert(T, -3//73); y = 2x'; z = T[x, 17//59, 1 - 2(x + y)]; w = big\"0.1\"",
    ];
    const SIGNS: &[u8] = b"()[]{}\"'=,;:.*/-+e09\n&!#";
    let mut random = 12345_u64;
    let mut next = |below: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % below
    };
    for text in texts {
        for _ in 0..15 {
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
