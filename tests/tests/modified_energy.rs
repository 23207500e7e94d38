//! Protects the modified energy: closed forms, definitions written out naively, exact symmetries, and the signs and
//! rules of the paper where they can be read in more than one way.

use std::fmt::Debug;

use rug::Float;
use shadowstep::problems::{HarmonicOscillator, HenonHeiles, Kepler, Pendulum};
use shadowstep::shadow::run::{EnergyDrift, ShadowRun, States, Trajectory, energy_drift};
use shadowstep::shadow::weights::central;
use shadowstep::shadow::{Bilinear, BuildEstimator, Central, Estimator, SelectionRule, StoppingRule};
use shadowstep::systems::kinetic::{DiagonalMasses, FullMasses, Quadratic};
use shadowstep::{
    Increments, Kinetic, Motion, Number, Potential, Rational, Real, Scheme, Stepper, System, UnitMasses, ValidFor,
};
use shadowstep_tests::{log10_distance, number, numbers, precision, rational, step_size, stepper, variations};

type Vector<P, K, N> = Motion<N, Vec<N>, P, K>;

/// q, p, and what the step to this state added to β.
type State = (Vec<Float>, Vec<Float>, Float);

/// n, value, last term where it is known, and m.
type Estimated<N> = (i64, N, Option<N>, u32);

fn kepler<N: Real>(context: &N::Context) -> Vector<Kepler, UnitMasses, N> {
    Motion::new(Kepler, UnitMasses, numbers(&["0.4", "0"], context), numbers(&["0", "2"], context)).unwrap()
}

fn pendulum<N: Real>(context: &N::Context) -> Vector<Pendulum, UnitMasses, N> {
    Motion::new(Pendulum, UnitMasses, numbers(&["0"], context), numbers(&["1"], context)).unwrap()
}

fn henon_heiles<N: Real>(context: &N::Context) -> Vector<HenonHeiles, UnitMasses, N> {
    Motion::new(HenonHeiles, UnitMasses, numbers(&["0", "0.1"], context), numbers(&["0.3", "0"], context)).unwrap()
}

/// n, value, last term and m of every estimate of a run.
fn estimates<S: Scheme + ValidFor<M::Class>, M: System<Number: Real>>(
    stepper: &Stepper<S, M::Number>,
    system: M,
    steps: u64,
    settings: &impl BuildEstimator<M::Number>,
) -> Vec<Estimated<M::Number>> {
    let mut run = ShadowRun::new(stepper.with(system), steps, settings).expect("it can begin");
    let mut all = Vec::new();
    while let Some((n, estimate)) = run.advance().expect("it can go on") {
        all.push((n, estimate.value.clone(), estimate.last_term.cloned(), estimate.order));
    }
    all
}

// ---------------------------------------------------------------------------------------------------------------
// The harmonic oscillator, in closed form

/// ½(p² + (1−x²)ω²q²)·arcsin(x)/(x√(1−x²)), x = hω/2: what kick-drift-kick Störmer–Verlet conserves.
fn closed_form(q: &Float, p: &Float, omega: &Float, h: &Float) -> Float {
    let x: Float = omega.clone() * h / 2;
    let rest: Float = 1 - x.clone().square();
    let potential = rest.clone() * omega.clone().square() * q.clone().square();
    let factor = x.clone().asin() / (x * rest.sqrt());
    (p.clone().square() + potential) * factor / 2
}

#[test]
fn harmonic_oscillator_has_its_closed_form() {
    const DIGITS: u32 = 120;
    /// The estimates of a number of steps are the closed form.
    fn check(settings: &(impl BuildEstimator<Float> + Debug), omega: &str, step: &str, steps: u64, count: usize) {
        let context = precision(DIGITS);
        let [omega, h, q, p] = [omega, step, "0.8", "-0.3"].map(|text| number(text, DIGITS));
        let potential = HarmonicOscillator { omega: omega.clone() };
        let motion = Motion::new(potential, UnitMasses, vec![q.clone()], vec![p.clone()]).unwrap();
        let found = estimates(&stepper("stormer-verlet", step, &context), motion, steps, settings);
        let expected = closed_form(&q, &p, &omega, &h);
        assert_eq!(found.len(), count, "{settings:?}");
        for (n, value, ..) in found {
            // off by (hω/2)^{2m} of D_m, by (hω/2)^{2k} of E_k, below 1e-120 here; round-off leaves 118 digits
            let off = log10_distance(&value, &expected);
            assert!(off < -115.0, "{settings:?}, ω = {omega:.3}, h = {step}, n = {n}: off by 10^{off}");
        }
        // and it is not the energy: they differ by h²
        let energy = (p.square() + omega.square() * q.square()) / 2;
        assert!(log10_distance(&expected, &energy) > -6.0);
    }
    for (omega, step, m) in [("1", "1/20", 40), ("3/2", "1/30", 40), ("1/7", "1/5", 40), ("1", "1/2", 100)] {
        check(&Central::fixed(m), omega, step, 100, 101);
    }
    // an odd k has its middles between the states 0, 1, …, 50
    for (omega, step, k, count) in [("1", "1/20", 39, 50), ("3/2", "1/30", 40, 51), ("1", "1/2", 100, 51)] {
        check(&Bilinear::new(k), omega, step, 50, count);
    }
}

// ---------------------------------------------------------------------------------------------------------------
// The sign in the β line of the splitting method

/// A potential whose rate has the sign that the paper prints, −(qᵀU_q + 2U), where qᵀU_q − 2U is right.
struct PrintedSign<P>(P);

impl<N: Number, P: Potential<N>> Potential<N> for PrintedSign<P> {
    fn dimension(&self) -> usize {
        self.0.dimension()
    }
    fn scratch(&self) -> usize {
        self.0.scratch()
    }
    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        self.0.energy(q, energy, scratch);
    }
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        self.0.gradient(q, gradient, scratch);
    }
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.0.energy(q, rate, scratch);
        self.0.gradient(q, gradient, scratch);
        rate.multiply_integer(2);
        for (q, gradient) in q.iter().zip(gradient.iter()) {
            rate.add_product(q, gradient);
        }
        rate.negate();
    }
}

/// Of a start at the origin, with H = 0.045.
fn drift_over<P: Potential<Float>>(potential: P) -> EnergyDrift<Float> {
    let context = precision(40);
    let [q, p] = [["0", "0"], ["0.3", "0"]].map(|texts| numbers(&texts, &context));
    let motion = Motion::new(potential, UnitMasses, q, p).unwrap();
    let verlet = stepper("stormer-verlet", "1/20", &context);
    energy_drift(verlet.with(motion), 400, &Central::fixed(10)).unwrap()
}

/// The first value is near H under both signs; only the drift tells them apart.
#[test]
fn printed_sign_of_beta_drifts_and_the_right_one_does_not() {
    let [right, printed] = [drift_over(HenonHeiles), drift_over(PrintedSign(HenonHeiles))];
    let energy = 0.045;
    assert!((right.first.to_f64() - energy).abs() < 1e-3);
    assert!((printed.first.to_f64() - energy).abs() < 1e-3, "one value does not show it: {}", printed.first);
    assert!(right.drift.to_f64() < 1e-12, "{}", right.drift);
    assert!(printed.drift.to_f64() > energy, "{}", printed.drift);
}

// ---------------------------------------------------------------------------------------------------------------
// The definition of T_{m,m}, written out

/// The states of a trajectory with the increments of β, n = −reach..=steps + reach.
fn states<S: Scheme + ValidFor<M::Class>, M: System<Number = Float>>(
    stepper: &Stepper<S, Float>,
    system: M,
    steps: u64,
    reach: usize,
) -> Vec<State> {
    let mut trajectory = Trajectory::new(stepper.with(system), steps, reach).unwrap();
    let mut all = Vec::new();
    while let Some(state) = trajectory.advance().unwrap() {
        all.push((state.q.to_vec(), state.p.to_vec(), state.increments.beta.clone()));
    }
    all
}

/// T_{1,1}, …, T_{M,M} at the state `at`: Richardson's triangle for the derivatives of q, p and β, then
/// H̄ = ½(−qᵀp' + pᵀq' − β').
fn richardson(states: &[State], at: usize, largest: usize, h: &Float) -> Vec<Float> {
    let bits = h.prec();
    let dimension = states[0].0.len();
    // y = (q, p, β) at at − M..=at + M, β counted from the first of them
    let mut beta = Float::new(bits);
    let window: Vec<Vec<Float>> = states[at - largest..=at + largest]
        .iter()
        .map(|(q, p, increment)| {
            beta += increment;
            q.iter().chain(p).cloned().chain([beta.clone()]).collect()
        })
        .collect();
    let y = |j: usize, forward: bool| &window[if forward { largest + j } else { largest - j }];
    // T_{j,1} = (y(jh) − y(−jh))/(2jh); T_{j,k+1} = T_{j,k} + (T_{j,k} − T_{j−1,k})/((1 − k/j)² − 1)
    let mut triangle: Vec<Vec<Vec<Float>>> = Vec::new();
    for j in 1..=largest {
        let width = h.clone() * 2_u32 * j as u32;
        let first = y(j, true).iter().zip(y(j, false)).map(|(a, b)| (a.clone() - b) / &width).collect();
        let mut row: Vec<Vec<Float>> = vec![first];
        for k in 1..j {
            let ratio = Float::with_val(bits, j - k) / j as u32;
            let weight = ratio.square() - 1;
            let next = row[k - 1].iter().zip(&triangle[j - 2][k - 1]);
            let next = next.map(|(fine, coarse)| fine.clone() + (fine.clone() - coarse) / &weight).collect();
            row.push(next);
        }
        triangle.push(row);
    }
    let (q, p, _) = &states[at];
    triangle
        .iter()
        .map(|row| {
            let derivative = row.last().expect("a row has its diagonal");
            let mut twice = -derivative[2 * dimension].clone();
            for i in 0..dimension {
                twice += p[i].clone() * &derivative[i];
                twice -= q[i].clone() * &derivative[dimension + i];
            }
            twice / 2
        })
        .collect()
}

/// |T_{m,m} − T_{m−1,m−1}| for m = 2..=M at [m]; nothing is known of 0 and 1.
fn term_sizes(diagonal: &[Float]) -> Vec<Option<Float>> {
    let sizes = diagonal.windows(2).map(|t| Some((t[1].clone() - &t[0]).abs()));
    [None, None].into_iter().chain(sizes).collect()
}

const TRIANGLE_DIGITS: u32 = 120;

/// Three problems, with schemes of different kinds: `check` gets the scheme's name, the diagonal of the triangle, and
/// the estimate with these settings.
fn against_the_triangle(reach: usize, settings: Central, mut check: impl FnMut(&str, &[Float], &Estimated<Float>)) {
    let context = precision(TRIANGLE_DIGITS);
    let h = step_size("1/20");
    let step = Float::from_rational(h.exact(), &context);
    const STEPS: u64 = 24;
    fn both<P: Potential<Float> + Clone>(
        name: &str,
        motion: &Vector<P, UnitMasses, Float>,
        reach: usize,
        settings: Central,
    ) -> (Vec<State>, Vec<Estimated<Float>>) {
        let stepper = stepper(name, "1/20", &precision(TRIANGLE_DIGITS));
        (states(&stepper, motion.clone(), STEPS, reach), estimates(&stepper, motion.clone(), STEPS, &settings))
    }
    let estimator = BuildEstimator::<Float>::build(&settings, &h, 1, &context).unwrap();
    assert_eq!(estimator.states(), 2 * reach + 1);
    for (name, (states, found)) in [
        ("stormer-verlet", both("stormer-verlet", &kepler(&context), reach, settings)),
        ("ruth3", both("ruth3", &pendulum(&context), reach, settings)),
        ("yoshida4", both("yoshida4", &henon_heiles(&context), reach, settings)),
    ] {
        assert_eq!(found.len() as u64, STEPS + 1);
        for one in &found {
            check(name, &richardson(&states, reach + one.0 as usize, reach, &step), one);
        }
    }
}

#[test]
fn fixed_m_is_the_diagonal_of_the_triangle() {
    for m in [1, 2, 3, 7, 20, 40] {
        let fixed = Central::fixed_with_error(m);
        // its error needs three states more on each side
        let reach = if m > 1 { m + 3 } else { m };
        against_the_triangle(reach as usize, fixed, |name, diagonal, (n, value, term, order)| {
            assert_eq!(*order, m);
            // divided by h = 1/20 and added up over M differences, round-off leaves at least 110 digits of 120
            let off = log10_distance(value, &diagonal[m as usize - 1]);
            assert!(off < -110.0, "{name}, m = {m}, n = {n}: off by 10^{off}");
            assert_eq!(term.is_some(), m > 1);
            if let Some(term) = term {
                let last = term_sizes(diagonal)[m as usize].clone().unwrap();
                let off = log10_distance(term, &last);
                assert!(off < -110.0, "{name}, m = {m}, n = {n}: the last term is off by 10^{off}");
            }
        });
    }
}

/// The first m of 2..=last with the smallest term, or with the smallest largest one of e_{m−5}, …, e_{m+4}.
fn best(sizes: &[Option<Float>], last: usize, rule: SelectionRule) -> usize {
    let size = |m: usize| -> &Float { sizes[m].as_ref().expect("known from 2") };
    let judged = |m: usize| match rule {
        SelectionRule::Least => size(m),
        SelectionRule::Robust => {
            (m.saturating_sub(5).max(2)..=(m + 4).min(last)).map(size).reduce(|a, b| if b > a { b } else { a }).unwrap()
        }
    };
    (2..=last).reduce(|best, m| if judged(m) < judged(best) { m } else { best }).expect("there is m = 2")
}

/// The m chosen is the best of 2..=last; value and last term agree to 10^tolerance.
fn assert_chosen(
    name: &str,
    diagonal: &[Float],
    (last, rule): (usize, SelectionRule),
    found: &Estimated<Float>,
    tolerance: f64,
) {
    let (n, value, term, order) = found;
    let sizes = term_sizes(diagonal);
    let expected = best(&sizes, last, rule);
    assert_eq!(*order as usize, expected, "{name}, n = {n}, {rule:?}");
    let off = log10_distance(value, &diagonal[expected - 1]);
    assert!(off < tolerance, "{name}, n = {n}, m = {expected}: off by 10^{off}");
    let off = log10_distance(term.as_ref().unwrap(), sizes[expected].as_ref().unwrap());
    assert!(off < tolerance, "{name}, n = {n}, m = {expected}: the last term is off by 10^{off}");
}

#[test]
fn best_m_is_its_rule_written_out() {
    for rule in [SelectionRule::Least, SelectionRule::Robust] {
        let mut orders = Vec::new();
        let best = Central::Best { largest: 30, stop: StoppingRule::Full, rule, with_error: false };
        against_the_triangle(30, best, |name, diagonal, one| {
            assert_chosen(name, diagonal, (30, rule), one, -110.0);
            orders.push(one.3);
        });
        orders.sort_unstable();
        orders.dedup();
        assert!(orders.len() > 3, "with always the same m nothing is shown: {orders:?}");
    }
}

/// The early stop: all m up to the first one, at least 13 (`first`), at which the largest of the eleven terms before it
/// is less than the largest of the eleven terms that end with it. (The paper prints ≤, which is met whenever the oldest
/// term is not the largest, so at the first ripple.)
fn first_stop(sizes: &[Option<Float>], first: usize) -> usize {
    let last = sizes.len() - 1;
    let largest = |range: std::ops::RangeInclusive<usize>| {
        let known = range.map(|j| sizes[j].as_ref().expect("known from 2"));
        known.reduce(|a, b| if b > a { b } else { a }).expect("eleven terms")
    };
    (first..=last).find(|&m| largest(m - 11..=m - 1) < largest(m - 10..=m)).unwrap_or(last)
}

#[test]
fn early_stop_is_its_rule_written_out() {
    let mut stopped = 0;
    let early = Central::best(40, StoppingRule::Early);
    against_the_triangle(40, early, |name, diagonal, one| {
        let sizes = term_sizes(diagonal);
        let stop = first_stop(&sizes, 13);
        stopped += usize::from(stop < 40);
        assert_chosen(name, diagonal, (stop, SelectionRule::Least), one, -110.0);
    });
    assert!(stopped > 0, "the rule never stopped anything, so nothing is shown");
}

/// The paper's claim about the early stop: its results nearly equal the results of the full search.
#[test]
fn early_stop_is_nearly_as_good_as_the_full_search() {
    let context = precision(120);
    let verlet = stepper("stormer-verlet", "1/20", &context);
    let [full, early] = [StoppingRule::Full, StoppingRule::Early].map(|stop| {
        let best = Central::best(200, stop);
        energy_drift(verlet.with(kepler::<Float>(&context)), 1000, &best).unwrap()
    });
    let ratio = early.drift.to_f64() / full.drift.to_f64();
    println!("drift: full {:e}, early {:e}", full.drift.to_f64(), early.drift.to_f64());
    // the smallest term of fewer m is a little larger; with ≤ in place of < the ratio is above 2
    assert!(ratio > 0.5 && ratio < 2.0, "{ratio}");
}

/// States on no flow, made so that the terms are of any size in any order: the rules are tried at their edges, which
/// smooth motions hardly ever meet. With q = p = 0 the estimate is −½ D_m β, and an odd β_j can give it every value.
#[test]
fn all_rules_hold_for_terms_of_any_size() {
    const LARGEST: usize = 20;
    let context = precision(TRIANGLE_DIGITS);
    let h = step_size("1/20");
    let step = Float::from_rational(h.exact(), &context);
    let zero = Float::new(context.in_bits());
    let mut seed = 1_u64;
    let mut random = |range: u64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % range
    };
    // how often the first m that counts was the best, and how often it mattered that the stop is tried at 13
    let (mut at_two, mut at_thirteen) = (0, 0);
    for window in 0..300 {
        let mut value = zero.clone();
        let mut beta: Vec<Float> = Vec::new();
        for m in 1..=LARGEST {
            // T_{m,m} − T_{m−1,m−1} of size 2^−30 to 1
            value += (Float::with_val(context.in_bits(), 1000 + random(1000)) / 2000) >> random(30) as u32;
            // −(1/h) Σ_j d_{m,j} β_j = T_{m,m}
            let weights = central(m as u32);
            let mut rest = -value.clone() * &step;
            for (d, beta) in weights.iter().zip(&beta) {
                rest -= Float::from_rational(d, &context) * beta;
            }
            beta.push(rest / Float::from_rational(&weights[m - 1], &context));
        }
        let whole: Vec<Float> =
            beta.iter().rev().map(|b| -b.clone()).chain([zero.clone()]).chain(beta.iter().cloned()).collect();
        let increments = whole.windows(2).map(|pair| pair[1].clone() - &pair[0]);
        let states: Vec<State> =
            [zero.clone()].into_iter().chain(increments).map(|b| (vec![zero.clone()], vec![zero.clone()], b)).collect();

        let diagonal = richardson(&states, LARGEST, LARGEST, &step);
        assert!(log10_distance(&diagonal[LARGEST - 1], &value) < -90.0, "the states are not what they should be");
        let sizes = term_sizes(&diagonal);
        let stop = first_stop(&sizes, 13);
        let ends = [(StoppingRule::Full, LARGEST), (StoppingRule::Early, stop)];
        for ((stop, last), rule) in
            ends.into_iter().flat_map(|end| [(end, SelectionRule::Least), (end, SelectionRule::Robust)])
        {
            let settings = Central::Best { largest: LARGEST as u32, stop, rule, with_error: false };
            let mut estimator = BuildEstimator::<Float>::build(&settings, &h, 1, &context).unwrap();
            for (q, p, beta) in &states {
                if let Some(e) = estimator.push(q, p, Increments::of_beta(beta)) {
                    let found = (window, e.value.clone(), e.last_term.cloned(), e.order);
                    // β grows to 4^20 = 1e12, which costs as many digits
                    assert_chosen("made", &diagonal, (last, rule), &found, -90.0);
                    at_two += usize::from(e.order == 2);
                }
            }
        }
        at_thirteen += usize::from(
            best(&sizes, stop, SelectionRule::Least) != best(&sizes, first_stop(&sizes, 14), SelectionRule::Least),
        );
    }
    assert!(at_two > 0 && at_thirteen > 0, "{at_two}, {at_thirteen}: nothing is shown");
}

// ---------------------------------------------------------------------------------------------------------------
// Digits

/// The values at 120 digits are those at 200 digits: the last ten are lost to round-off at most.
#[test]
fn more_digits_give_the_same_values() {
    let [few, many] = [120, 200].map(|digits| {
        let context = precision(digits);
        let verlet = stepper("stormer-verlet", "1/20", &context);
        estimates(&verlet, kepler::<Float>(&context), 200, &Central::fixed(20))
    });
    for ((n, few, ..), (_, many, ..)) in few.iter().zip(&many) {
        let off = Real::log10_abs(&Float::with_val(700, few - many));
        assert!(off < -110.0, "n = {n}: 10^{off}");
    }
    // the two do not agree by being the same numbers
    assert!(few.iter().zip(&many).any(|(a, b)| a.1 != b.1));
}

/// In double precision the drift is round-off and nothing else.
#[test]
fn drift_in_double_precision_is_round_off() {
    fn drift<N: Real>(context: &N::Context) -> EnergyDrift<N> {
        let verlet = stepper("stormer-verlet", "1/20", context);
        energy_drift(verlet.with(pendulum::<N>(context)), 1000, &Central::fixed(20)).unwrap()
    }
    let (double, precise) = (drift::<f64>(&()), drift::<Float>(&precision(120)));
    println!("drift {:e} in double precision, {:e} at 120 digits", double.drift, precise.drift.to_f64());
    // q and p are of size 1: differences of them are off by 1e-16 and are divided by h
    assert!(double.drift > 1e-16 && double.drift < 1e-13, "{:e}", double.drift);
    // D_20 itself is off by about (20!)² (h/ρ)^40 = 3e-29, ρ = 2.16 the distance of the singularities in complex time
    assert!(precise.drift.to_f64() < 1e-27, "{:e}", precise.drift.to_f64());
    assert!((double.first - precise.first.to_f64()).abs() < 1e-14);
}

// ---------------------------------------------------------------------------------------------------------------
// How the drift depends on the step

/// Kepler, e = 0.6: the energy varies like h², the drift of the modified energy falls like exp(−c/h).
#[test]
fn kepler_drift_is_exponentially_small() {
    let context = precision(120);
    let mut energies = Vec::new();
    let mut drifts = Vec::new();
    for inverse in [10_u64, 20, 40] {
        let verlet = stepper("stormer-verlet", &format!("1/{inverse}"), &context);
        energies.push(variations::of_energy(&verlet, kepler::<Float>(&context), 20 * inverse).ln());
        let best = Central::best(120, StoppingRule::Full);
        let found = energy_drift(verlet.with(kepler::<Float>(&context)), 20 * inverse, &best).unwrap();
        println!("h = 1/{inverse}: drift {:e}, m = {:?}", found.drift.to_f64(), found.orders);
        drifts.push(Real::log10_abs(&found.drift));
    }
    println!("ln of the energy's variation {energies:?}");
    for pair in energies.windows(2) {
        let power = (pair[0] - pair[1]) / std::f64::consts::LN_2;
        // h² and the next term, h⁴ with a large factor at the pericentre
        assert!((power - 2.0).abs() < 0.15, "{energies:?}");
    }
    // 1/h goes 10, 20, 40: the second gain is twice the first; under a power law they would be the same
    let gains = [drifts[0] - drifts[1], drifts[1] - drifts[2]];
    println!("gains {gains:?}");
    assert!(gains[0] > 1.0, "{drifts:?}");
    assert!((gains[1] / gains[0] - 2.0).abs() < 0.5, "{drifts:?}");
}

/// Neither symmetry nor a high order is needed for a modified energy.
#[test]
fn schemes_that_are_no_palindromes_conserve_their_modified_energy() {
    let context = precision(60);
    for (name, least_variation) in [("symplectic-euler", 1e-3), ("ruth3", 1e-8)] {
        let stepper = stepper(name, "1/40", &context);
        assert!(!stepper.scheme().summary().symmetric);
        let energy = variations::of_energy(&stepper, pendulum::<Float>(&context), 400);
        let found = energy_drift(stepper.with(pendulum::<Float>(&context)), 400, &Central::fixed(25)).unwrap();
        println!("{name}: H varies by {energy:e}, the modified energy by {:e}", found.drift.to_f64());
        assert!(energy > least_variation, "{name}: {energy:e}");
        // D_25 is off by about (25!)² (h/ρ)^50 = 4e-47, ρ = 2.16 the distance of the singularities in complex time
        assert!(found.drift.to_f64() < 1e-45, "{name}: {:e}", found.drift.to_f64());
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Masses

/// U in other coordinates: Q = A q.
#[derive(Clone)]
struct Changed<P> {
    potential: P,
    /// A⁻¹, row by row
    inverse: [[Float; 2]; 2],
}

impl<P> Changed<P> {
    fn old(&self, q: &[Float]) -> Vec<Float> {
        self.inverse.iter().map(|row| row[0].clone() * &q[0] + row[1].clone() * &q[1]).collect()
    }

    /// U_Q = A⁻ᵀ U_q
    fn turn(&self, gradient: &mut [Float]) {
        let [x, y] = [gradient[0].clone(), gradient[1].clone()];
        for (j, gradient) in gradient.iter_mut().enumerate() {
            *gradient = self.inverse[0][j].clone() * &x + self.inverse[1][j].clone() * &y;
        }
    }
}

impl<P: Potential<Float>> Potential<Float> for Changed<P> {
    fn dimension(&self) -> usize {
        2
    }
    fn scratch(&self) -> usize {
        self.potential.scratch()
    }
    fn energy(&self, q: &[Float], energy: &mut Float, scratch: &mut [Float]) {
        self.potential.energy(&self.old(q), energy, scratch);
    }
    fn gradient(&self, q: &[Float], gradient: &mut [Float], scratch: &mut [Float]) {
        self.potential.gradient(&self.old(q), gradient, scratch);
        self.turn(gradient);
    }
    /// QᵀU_Q = qᵀU_q
    fn gradient_and_rate(&self, q: &[Float], gradient: &mut [Float], rate: &mut Float, scratch: &mut [Float]) {
        self.potential.gradient_and_rate(&self.old(q), gradient, rate, scratch);
        self.turn(gradient);
    }
}

/// Linear changes of coordinates commute with kicks and drifts, so the modified energy is the same: Q = A q,
/// P = A⁻ᵀ p, M⁻¹ = A Aᵀ.
fn assert_same_energies<K: Kinetic<Float, Class = Quadratic> + Clone>(a: [[&str; 2]; 2], kinetic: K) {
    let context = precision(120);
    let [[a, b], [c, d]] = a.map(|row| row.map(rational));
    let determinant = &a * &d - &b * &c;
    let float = |r: Rational| Float::from_rational(&r, &context);
    let inverse = [[&d / &determinant, -&b / &determinant], [-&c / &determinant, &a / &determinant]];
    let inverse = inverse.map(|row| row.map(float));

    let plain = henon_heiles(&context);
    let (q, p) = (plain.q().to_vec(), plain.p().to_vec());
    let [a, b, c, d] = [a, b, c, d].map(float);
    let new_q = vec![a * &q[0] + b * &q[1], c * &q[0] + d * &q[1]];
    let mut new_p = p;
    let potential = Changed { potential: HenonHeiles, inverse };
    potential.turn(&mut new_p);
    let changed = Motion::new(potential, kinetic, new_q, new_p).unwrap();

    for name in ["stormer-verlet", "ruth3", "blanes-moan-srkn6b"] {
        let stepper = stepper(name, "1/20", &context);
        let expected = estimates(&stepper, plain.clone(), 60, &Central::fixed(12));
        let found = estimates(&stepper, changed.clone(), 60, &Central::fixed(12));
        for ((n, expected, ..), (_, found, ..)) in expected.iter().zip(&found) {
            let off = log10_distance(expected, found);
            // round-off of sixty steps, divided by h
            assert!(off < -112.0, "{name}, n = {n}: 10^{off}");
        }
    }
}

#[test]
fn diagonal_masses_are_a_change_of_units() {
    let masses = DiagonalMasses::new(&[rational("1/4"), rational("9")], &precision(120)).unwrap();
    assert_same_energies([["2", "0"], ["0", "1/3"]], masses);
}

#[test]
fn full_masses_are_a_change_of_coordinates() {
    // A Aᵀ for the A below
    let rows = [[rational("5"), rational("5/3")], [rational("5/3"), rational("10/9")]];
    let masses = FullMasses::from_inverse(&rows.map(|row| row.to_vec()), &precision(120)).unwrap();
    assert_same_energies([["2", "1"], ["1/3", "1"]], masses);
}
