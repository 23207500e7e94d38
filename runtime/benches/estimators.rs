//! What an estimate of the modified energy takes at 120 digits: Kepler's problem, e = 0.6, Störmer–Verlet, h = 1/20.
//!
//! `cargo bench -p shadowstep --features mpfr --bench estimators`
//!
//! Each contestant takes the same 1000 states three times, so that the first ones, which complete no estimate, count
//! little; the jumps do not matter for the time. Ratios are to MPFR. "The same code" is the code for all numbers
//! without limbs; its operations are counted, which takes some 1 ns each.

mod timing;

use std::hint::black_box;

use rug::integer::Order;
use rug::{Float, Integer};
use shadowstep::number::counting::Counting;
use shadowstep::number::{Limbs, Precision, Real};
use shadowstep::problems::Kepler;
use shadowstep::shadow::run::{States, Trajectory, TrajectoryState};
use shadowstep::shadow::{Bilinear, BuildEstimator, Central, Estimator, EstimatorSettings, StoppingRule};
use shadowstep::tables::shipped;
use shadowstep::{Increments, Motion, Number, Rational, StepSize, Stepper, UnitMasses, exact};

use timing::{Contestant, compare};

const STEP: &str = "1/20";
const STATES: u64 = 1000;
const LARGEST: u32 = 200;

/// 120 digits.
type Number7 = Limbs<7>;

struct Given<N> {
    q: Vec<N>,
    p: Vec<N>,
    beta: N,
}

fn states() -> Vec<Given<Number7>> {
    let stepper = Stepper::new(shipped("stormer-verlet").expect("it is shipped"), STEP).expect("h is not 0");
    let number = |text| Number7::from_rational(&exact(text).expect("a number"), &());
    let (q, p) = (vec![number("2/5"), number("0")], vec![number("0"), number("2")]);
    let start = Motion::new(Kepler, UnitMasses, q, p).expect("the dimensions agree");
    let mut states = Trajectory::new(stepper.with(start), STATES, 0).expect("a finite start");
    let mut all = Vec::new();
    while let Some(TrajectoryState { q, p, increments, .. }) = states.advance().expect("finite states") {
        all.push(Given { q: q.to_vec(), p: p.to_vec(), beta: *increments.beta });
    }
    all
}

fn converted<N>(states: &[Given<Number7>], convert: impl Fn(&Number7) -> N) -> Vec<Given<N>> {
    let vector = |numbers: &[Number7]| numbers.iter().map(&convert).collect();
    states.iter().map(|s| Given { q: vector(&s.q), p: vector(&s.p), beta: convert(&s.beta) }).collect()
}

fn float(x: &Number7, precision: Precision) -> Float {
    let mantissa = Float::with_val(precision.in_bits(), Integer::from_digits(x.mantissa(), Order::Lsf));
    let size = mantissa << (x.exponent().unwrap_or(0) - Number7::BITS as i32);
    if x.is_sign_negative() { -size } else { size }
}

/// A run over all states, repeated until a given number of them is reached.
fn contestant<'a, N: Real + 'static>(
    name: &'static str,
    settings: &'a EstimatorSettings,
    states: &'a [Given<N>],
    context: &'a N::Context,
) -> Contestant<'a> {
    let h = StepSize::try_from(STEP).expect("h is not 0");
    let run = move |repetitions: u32| {
        let mut estimator = settings.build(&h, 2, context).expect("valid orders");
        for Given { q, p, beta } in states.iter().cycle().take(repetitions as usize) {
            black_box(estimator.push(q, p, Increments::of_beta(beta)).map(|estimate| estimate.order));
        }
    };
    (name, Box::new(run))
}

/// The Richardson table of Moan & Niesen at one state, row by row, with the early stop.
struct Triangle<'a> {
    /// With β itself, not its increments.
    states: &'a [Given<Float>],
    four_h: Float,
    /// 1/((1 − k/j)² − 1) by j and k.
    ratios: Vec<Vec<Float>>,
    /// T_{j,1}, …, T_{j,j}
    row: Vec<Float>,
    sizes: Vec<Float>,
    newest: Float,
    step: Float,
}

impl<'a> Triangle<'a> {
    fn new(states: &'a [Given<Float>], precision: Precision) -> Self {
        let number = |value: Rational| Float::from_rational(&value, &precision);
        let one = || Rational::from_integer(1.into());
        let ratio = |j: u32, k: u32| number((Rational::new((j - k).into(), j.into()).pow(2) - one()).recip());
        let zeros = || vec![Float::zero(&precision); LARGEST as usize];
        Triangle {
            states,
            four_h: number(exact(STEP).expect("a number") * Rational::from_integer(4.into())),
            ratios: (1..=LARGEST).map(|j| (1..j).map(|k| ratio(j, k)).collect()).collect(),
            row: zeros(),
            sizes: zeros(),
            newest: Float::zero(&precision),
            step: Float::zero(&precision),
        }
    }

    /// Where the search ends at the state n.
    fn last(&mut self, n: usize) -> u32 {
        for j in 1..=LARGEST as usize {
            self.first(n, j);
            let Triangle { row, newest, step, sizes, ratios, .. } = self;
            let size = &mut sizes[j - 1];
            size.assign(&row[j.saturating_sub(2)]); // T_{j−1,j−1}
            for (above, ratio) in row.iter_mut().zip(&ratios[j - 1]) {
                step.assign_difference(newest, above);
                above.assign(newest);
                step.multiply(ratio);
                newest.add(step);
            }
            row[j - 1].assign(newest);
            size.subtract(newest);
            size.make_absolute();
            let (earlier, now) = sizes[..j].split_at(j - 1);
            if j >= 13 && earlier[j - 12..].iter().all(|size| *size < now[0]) {
                return j as u32;
            }
        }
        LARGEST
    }

    /// newest ← T_{j,1} of ½(−qᵀp' + pᵀq' − β')
    fn first(&mut self, n: usize, j: usize) {
        let (this, after, before) = (&self.states[n], &self.states[n + j], &self.states[n - j]);
        let value = &mut self.newest;
        value.assign_difference(&before.beta, &after.beta);
        for c in 0..this.q.len() {
            for (factor, plus, minus) in
                [(&this.p[c], &after.q[c], &before.q[c]), (&this.q[c], &before.p[c], &after.p[c])]
            {
                self.step.assign_difference(plus, minus);
                value.add_product(factor, &self.step);
            }
        }
        value.divide(&self.four_h);
        value.divide_integer(j as i32);
    }
}

fn with_sums_of_beta(mut states: Vec<Given<Float>>) -> Vec<Given<Float>> {
    for n in 1..states.len() {
        let before = states[n - 1].beta.clone();
        states[n].beta.add(&before);
    }
    states
}

fn main() {
    let precision = Precision::digits(120).expect("120 digits");
    let limbs = states();
    let general = converted(&limbs, |x| Counting(*x));
    let mpfr = converted(&limbs, |x| float(x, precision));
    let summed = with_sums_of_beta(converted(&limbs, |x| float(x, precision)));
    let all: [(&str, EstimatorSettings); 8] = [
        ("the best m ≤ 200", Central::best(LARGEST, StoppingRule::Full).into()),
        ("the best m ≤ 200, early stop", Central::best(LARGEST, StoppingRule::Early).into()),
        ("E_8", Bilinear::new(8).into()),
        ("E_24", Bilinear::new(24).into()),
        ("E_50", Bilinear::new(50).into()),
        ("E_8 with its error", Bilinear::with_error(8).into()),
        ("E_24 with its error", Bilinear::with_error(24).into()),
        ("E_50 with its error", Bilinear::with_error(50).into()),
    ];
    for (title, settings) in &all {
        let mut contestants = vec![
            contestant("MPFR, 400 bits", settings, &mpfr, &precision),
            contestant("7 limbs by the same code", settings, &general, &()),
            contestant("7 limbs, fixed point", settings, &limbs, &()),
        ];
        if title.ends_with("early stop") {
            let mut triangle = Triangle::new(&summed, precision);
            let places = LARGEST as usize..summed.len() - LARGEST as usize;
            let run = move |repetitions: u32| {
                places.clone().cycle().take(repetitions as usize).for_each(|n| _ = black_box(triangle.last(n)));
            };
            contestants.push(("MPFR, the Richardson table at each state", Box::new(run)));
        }
        compare(title, contestants, 3 * STATES as u32);
    }
}
