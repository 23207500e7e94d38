//! A = c q^α p^β of one pair of variables, α ≠ β.
//!
//! A stays, so that q p grows like q p + (β − α) t A: with 1 + s = 1 + (β − α) t A/(q p), q ← q (1 + s)^{β/(β − α)} and
//! p ← p (1 + s)^{−α/(β − α)}.

use num_integer::Integer as _;
use num_traits::One as _;
use shadowstep_schemes::symbolic::PotentialPrograms;

use super::part::{FlowState, Part};
use crate::Rational;
use crate::number::Number;
use crate::systems::formula::FormulaValue;

pub(super) struct Monomial<N> {
    freedom: usize,
    exponents: [i32; 2],
    /// β − α
    difference: i32,
    /// y is this root of 1 + s, or of √(1 + s): a real root of a negative number would go on behind the singularity,
    /// where there is no flow.
    root: u32,
    of_square_root: bool,
    /// The powers of y by which q and p are multiplied.
    powers: [i32; 2],
    /// A/(q p)
    quotient: FormulaValue<N>,
    variables: [N; 2],
    one: N,
    s: N,
    y: N,
    /// y − 1
    excess: N,
    sum: N,
    power: N,
}

impl<N: Number> Monomial<N> {
    pub(super) fn new(freedom: usize, exponents: [i32; 2], programs: &PotentialPrograms, context: &N::Context) -> Self {
        let [of_q, of_p] = exponents;
        let difference = of_p - of_q;
        let common = of_q.gcd(&of_p);
        let root = difference.unsigned_abs() / common.unsigned_abs();
        let of_square_root = !root.is_multiple_of(2);
        let factor = difference.signum() * if of_square_root { 2 } else { 1 };
        let zero = || N::zero(context);
        Monomial {
            freedom,
            exponents,
            difference,
            root,
            of_square_root,
            powers: [factor * of_p / common, -factor * of_q / common],
            quotient: FormulaValue::with(programs, Vec::new(), context),
            variables: [zero(), zero()],
            one: N::from_rational(&Rational::one(), context),
            s: zero(),
            y: zero(),
            excess: zero(),
            sum: zero(),
            power: zero(),
        }
    }

    /// s ← A/(q p) and sum ← A
    fn evaluate(&mut self, q: &N, p: &N) {
        let Monomial { quotient, variables, s, sum, .. } = self;
        variables[0].assign(q);
        variables[1].assign(p);
        s.assign(quotient.at(variables));
        sum.assign_product(s, q);
        sum.multiply(p);
    }

    /// sum ← 1 + y + … + y^{count − 1}, and power ← y^count
    fn sum_powers(&mut self, count: u32) {
        let Monomial { one, y, sum, power, .. } = self;
        sum.assign(one);
        power.assign(y);
        for _ in 1..count {
            sum.add(power);
            power.multiply(y);
        }
    }

    /// y and y − 1, without cancellation: s = y^n − 1 is y − 1 times a sum of powers.
    fn take_root(&mut self) {
        let Monomial { one, s, y, sum, .. } = self;
        y.assign_sum(one, s);
        if self.of_square_root {
            sum.assign_sqrt(y);
            y.assign(sum);
        }
        if self.root > 1 {
            sum.assign_root(y, self.root);
            y.assign(sum);
        }
        self.sum_powers(self.root * if self.of_square_root { 2 } else { 1 });
        self.excess.assign_quotient(&self.s, &self.sum);
    }
}

impl<N: Number> Part<N> for Monomial<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        self.evaluate(&q[self.freedom], &p[self.freedom]);
        energy.add(&self.sum);
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, _continues: bool) {
        let (freedom, freedoms) = (self.freedom, state.q().len());
        self.evaluate(&state.q()[freedom], &state.p()[freedom]);
        let [of_q, of_p] = self.exponents;
        self.sum.multiply_integer(of_q + of_p - 2);
        state.add_to_beta(time, &self.sum);
        self.s.multiply(time);
        self.s.multiply_integer(self.difference);
        self.take_root();
        for (variable, exponent) in [freedom, freedom + freedoms].into_iter().zip(self.powers) {
            self.sum_powers(exponent.unsigned_abs());
            let Monomial { excess, sum, power, .. } = self;
            sum.multiply(excess);
            if exponent < 0 {
                sum.divide(power);
                sum.negate();
            }
            sum.multiply(state.variable(variable));
            state.add(variable, sum);
        }
    }
}
