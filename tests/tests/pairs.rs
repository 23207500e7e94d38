//! Protects sums over pairs of bodies: they are what the same formula in coordinates is, whatever interacts with what.

use rug::Float;
use shadowstep::number::counting::{Counting, Operations, count};
use shadowstep::problems::Gravity;
use shadowstep::systems::formula::{FormulaPair, FormulaPotential};
use shadowstep::systems::pairs::{Ends, Pair, Pairs, Separation, Summand};
use shadowstep::{Potential, Real, potential};
use shadowstep_tests::{Bits, log10_distance, numbers, potential_values, precision};

potential! {
    /// Has every kind of name: a parameter, two properties, the separation.
    struct Charged { k }
    pair U(r2; e_i, e_j, s_i, s_j) = k*e_i*e_j/sqrt(r2) + exp(-r2/(s_i + s_j)^2)
}
const CHARGED: &str = "k*e_i*e_j/sqrt(r2) + exp(-r2/(s_i + s_j)^2)";

potential! {
    /// Neither even nor odd.
    struct Spring { a }
    pair U(d) = d^2/2 + a*d^3/3 + exp(-d)
}
const SPRING: &str = "d^2/2 + a*d^3/3 + exp(-d)";

potential! {
    /// Its energy costs less than its rate.
    struct Softened { s }
    pair U(r2; m_i, m_j) = -m_i*m_j/sqrt(r2 + s^2)
}
const SOFTENED: &str = "-m_i*m_j/sqrt(r2 + s^2)";

const POINT: [&str; 6] = ["0.3", "-1.7", "2.1", "1/7", "-0.9", "2/3"];
const CHARGES: [&str; 3] = ["1.5", "-2/3", "0.7"];
const SIZES: [&str; 3] = ["0.4", "1.1", "2"];

fn charged<N: Real>(context: &N::Context) -> (Charged<N>, FormulaPair<N>) {
    let [e, s] = [CHARGES, SIZES].map(|texts| numbers::<N>(&texts, context));
    let k = numbers::<N>(&["1.3"], context).remove(0);
    let properties = [("e", e.clone()), ("s", s.clone())];
    let read = FormulaPair::new(CHARGED, Separation::SquaredDistance, &properties, &[("k", k.clone())]).unwrap();
    (Charged { k, e, s }, read)
}

fn spring<N: Real>(context: &N::Context) -> (Spring<N>, FormulaPair<N>) {
    let a = numbers::<N>(&["0.3"], context).remove(0);
    let read = FormulaPair::new(SPRING, Separation::Difference, &[], &[("a", a.clone())]).unwrap();
    (Spring { a }, read)
}

/// Agrees with the formula in coordinates to nearly all digits: the sums are in another order.
fn assert_is(potential: &impl Potential<Float>, written_out: &str, what: &str) {
    let context = precision(120);
    let names: Vec<String> = (0..POINT.len()).map(|i| format!("q{i}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let plain = FormulaPotential::<Float>::new(written_out, &names, &[]).unwrap();
    let q = numbers::<Float>(&POINT, &context);
    for (found, expected) in potential_values(potential, &q).iter().zip(potential_values(&plain, &q)) {
        assert!(log10_distance(found, &expected) < -115.0, "{what}: {found} and {expected}");
    }
}

#[test]
fn all_pairs_are_the_formula_in_coordinates() {
    let (pair, _) = charged::<Float>(&precision(120));
    let term = |i: usize, j: usize| {
        let square = format!("((q{} - q{})^2 + (q{} - q{})^2)", 2 * j, 2 * i, 2 * j + 1, 2 * i + 1);
        let (e_i, e_j, s_i, s_j) = (CHARGES[i], CHARGES[j], SIZES[i], SIZES[j]);
        format!("1.3*({e_i})*({e_j})/sqrt({square}) + exp(-{square}/({s_i} + {s_j})^2)")
    };
    let written_out = [term(0, 1), term(0, 2), term(1, 2)].join(" + ");
    assert_is(&Pairs::<_, 2>::all(3, pair).unwrap(), &written_out, "all pairs");
}

#[test]
fn neighbours_are_the_formula_in_coordinates() {
    let spring_between =
        |i: &str, j: &str| SPRING.replace('d', &format!("({j} - {i})")).replace("*a", "*0.3").replace("a*", "0.3*");
    let chain: Vec<String> = (0..5).map(|i| spring_between(&format!("q{i}"), &format!("q{}", i + 1))).collect();
    let chain = chain.join(" + ");
    let walls = format!("{} + {chain} + {}", spring_between("0", "q0"), spring_between("q5", "0"));
    let ring = format!("{chain} + {}", spring_between("q5", "q0"));
    for (ends, written_out) in [(Ends::Free, &chain), (Ends::Fixed, &walls), (Ends::Periodic, &ring)] {
        let (pair, _) = spring::<Float>(&precision(120));
        assert_is(&Pairs::<_, 1>::neighbours(6, pair, ends).unwrap(), written_out, &format!("{ends:?}"));
    }
}

/// All pairs, a chain and a ring.
#[test]
fn rates_from_energies_are_those_of_the_formula_in_coordinates() {
    let pair = || {
        let context = precision(120);
        Softened { s: numbers(&["0.3"], &context).remove(0), m: numbers::<Float>(&SIZES, &context) }
    };
    assert_eq!(pair().summand(), Summand::Energy);
    let term = |(i, j): (usize, usize)| {
        let square = format!("((q{} - q{})^2 + (q{} - q{})^2)", 2 * j, 2 * i, 2 * j + 1, 2 * i + 1);
        format!("-{}*{}/sqrt({square} + 0.3^2)", SIZES[i], SIZES[j])
    };
    let written_out = |pairs: &[(usize, usize)]| pairs.iter().copied().map(term).collect::<Vec<_>>().join(" + ");
    let [chain, all] = [&[(0, 1), (1, 2)][..], &[(0, 1), (1, 2), (0, 2)][..]].map(written_out);
    assert_is(&Pairs::<_, 2>::all(3, pair()).unwrap(), &all, "all pairs");
    assert_is(&Pairs::<_, 2>::neighbours(3, pair(), Ends::Free).unwrap(), &chain, "a chain");
    assert_is(&Pairs::<_, 2>::neighbours(3, pair(), Ends::Periodic).unwrap(), &all, "a ring");
}

fn same<N: Bits>(one: &[N], other: &[N]) {
    for (one, other) in one.iter().zip(other) {
        assert!(one.is_finite() && one.same_bits(other), "{one} and {other}");
    }
}

/// Enough bodies that sums in `f64` are in blocks.
fn compiled_and_read_are_the_same_of_many<N: Bits>(context: &N::Context) {
    const BODIES: usize = 21;
    let texts = |count: usize, divisor: usize| -> Vec<String> {
        (0..count).map(|i| format!("{}/{divisor}", 1 + (i * i * 7 + i) % 101)).collect()
    };
    let of = |texts: Vec<String>| numbers::<N>(&texts.iter().map(String::as_str).collect::<Vec<_>>(), context);
    let (q, m) = (of(texts(3 * BODIES, 29)), of(texts(BODIES, 53)));
    let s = numbers::<N>(&["0.3"], context).remove(0);
    let (properties, parameters) = ([("m", m.clone())], [("s", s.clone())]);
    let read = FormulaPair::new(SOFTENED, Separation::SquaredDistance, &properties, &parameters).unwrap();
    let compiled = Softened { s, m };
    assert_eq!([compiled.summand(), read.summand()], [Summand::Energy; 2]);
    same(
        &potential_values(&Pairs::<_, 3>::all(BODIES, compiled).unwrap(), &q),
        &potential_values(&Pairs::<_, 3>::all(BODIES, read).unwrap(), &q),
    );
}

fn compiled_and_read_have_the_same_bits<N: Bits>(context: &N::Context) {
    compiled_and_read_are_the_same_of_many::<N>(context);
    let q = numbers::<N>(&POINT, context);
    let (compiled, read) = charged::<N>(context);
    same(
        &potential_values(&Pairs::<_, 2>::all(3, compiled).unwrap(), &q),
        &potential_values(&Pairs::<_, 2>::all(3, read).unwrap(), &q),
    );
    for ends in [Ends::Free, Ends::Fixed, Ends::Periodic] {
        let (compiled, read) = spring::<N>(context);
        let (compiled, read) =
            (Pairs::<_, 1>::neighbours(6, compiled, ends).unwrap(), Pairs::<_, 1>::neighbours(6, read, ends).unwrap());
        same(&potential_values(&compiled, &q), &potential_values(&read, &q));
    }
}

#[test]
fn compiled_and_read_have_the_same_bits_in_double() {
    compiled_and_read_have_the_same_bits::<f64>(&());
}

#[test]
fn compiled_and_read_have_the_same_bits_at_120_digits() {
    compiled_and_read_have_the_same_bits::<Float>(&precision(120));
}

#[test]
fn a_moved_origin_changes_round_off_only() {
    let (pair, _) = charged::<Float>(&precision(120));
    let pairs = Pairs::<_, 2>::all(3, pair).unwrap();
    let q = numbers::<Float>(&POINT, &precision(120));
    let moved: Vec<Float> = q.iter().map(|x| x.clone() + 1000).collect();
    for (here, there) in potential_values(&pairs, &q).iter().zip(potential_values(&pairs, &moved)) {
        assert!(log10_distance(here, &there) < -112.0, "{here} and {there}");
    }
}

#[test]
fn bodies_and_a_pair_that_do_not_fit_are_refused() {
    let gravity = || Gravity { g: 1.0, m: vec![1.0, 2.0] };
    for (error, message) in [
        (Pairs::<_, 3>::all(3, gravity()).err(), "a property has 2 values for 3 bodies; give one for each body"),
        (Pairs::<_, 3>::all(0, gravity()).err(), "a sum over pairs needs at least one body and one dimension"),
        (
            Pairs::<_, 1>::neighbours(2, gravity(), Ends::Fixed).err(),
            "fixed ends are for pairs without properties, as walls have none",
        ),
        (
            Pairs::<_, 2>::all(2, Spring { a: 1.0 }).err(),
            "a formula in d is for bodies on a line, not in 2 dimensions; write it in r2",
        ),
    ] {
        assert_eq!(error.unwrap().to_string(), message);
    }
}

#[test]
fn wrong_formulas_have_their_place() {
    let new = |text| FormulaPair::<f64>::new(text, Separation::SquaredDistance, &[("m", vec![1.0])], &[("g", 1.0)]);
    for (text, range, message) in [
        ("g*m/r2", 2..3, "unknown name `m`; of the bodies i and j it is `m_i` and `m_j`"),
        ("g*m_i*m_j/d", 10..11, "unknown name `d`; known names: r2, m_i, m_j, g"),
    ] {
        let error = new(text).unwrap_err();
        assert_eq!((error.to_string().as_str(), error.range()), (message, range));
    }
    let repeated = FormulaPair::<f64>::new("r2", Separation::SquaredDistance, &[], &[("r2", 1.0)]).unwrap_err();
    assert!(repeated.to_string().starts_with("`r2` is there twice"), "{repeated}");
}

#[test]
fn a_pair_in_space_costs_its_slope_and_eleven_products_and_sums() {
    let bodies = 6;
    let counting = |texts: &[&str]| numbers::<Counting<f64>>(texts, &());
    let gravity = Gravity { g: counting(&["1"]).remove(0), m: counting(&["1"; 6]) };
    let pairs = Pairs::<_, 3>::all(bodies, gravity).unwrap();
    let q: Vec<_> = (0..18).map(|i| Counting(f64::from(i * i))).collect();
    let mut scratch = vec![Counting(0.0); Potential::<Counting<f64>>::scratch(&pairs)];
    pairs.prepare(&mut scratch, &());
    let mut gradient = q.clone();
    let ((), cost) = count(|| pairs.gradient(&q, &mut gradient, &mut scratch));
    // difference 3, squared 2, onto both bodies 6; squared 3, slope 5, times the difference 3
    let pair = Operations { additions: 11, multiplications: 11, roots: 1, ..Operations::default() };
    let all = 15;
    let expected = Operations {
        additions: all * pair.additions,
        multiplications: all * pair.multiplications,
        roots: all * pair.roots,
        ..Operations::default()
    };
    assert_eq!(cost, expected);
    // a multiplication and an addition more for the rate
    let mut rate = Counting(0.0);
    let ((), cost) = count(|| pairs.gradient_and_rate(&q, &mut gradient, &mut rate, &mut scratch));
    let expected =
        Operations { additions: expected.additions + all, multiplications: expected.multiplications + all, ..expected };
    assert_eq!(cost, expected);
}
