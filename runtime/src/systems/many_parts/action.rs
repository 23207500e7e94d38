//! Functions of one pair of variables that are functions of I = ½(a q² + 2b q p + c p²), or of q p: I stays, and the
//! flow is that of f′(I) I.

use shadowstep_schemes::symbolic::PotentialPrograms;

use super::part::{FlowState, Part};
use crate::Rational;
use crate::number::Number;
use crate::systems::formula::FormulaValue;

/// f(I) with its derivatives.
struct Function<N> {
    of_action: FormulaValue<N>,
    action: [N; 1],
    slope: [N; 1],
    /// 2I f′ − 2f
    rate: N,
    has_rate: bool,
}

impl<N: Number> Function<N> {
    fn new(programs: &PotentialPrograms, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let of_action = FormulaValue::with(programs, Vec::new(), context);
        Function { of_action, action: [zero()], slope: [zero()], rate: zero(), has_rate: false }
    }

    /// The slope, and where it is needed the rate, at an action; `assign` computes the action.
    fn evaluate(&mut self, state: &FlowState<'_, N>, continues: bool, assign: impl FnOnce(&mut N)) {
        let augmented = state.is_augmented();
        if continues && (self.has_rate || !augmented) {
            return;
        }
        let Function { of_action, action, slope, rate, has_rate } = self;
        assign(&mut action[0]);
        *has_rate = augmented;
        of_action.slopes_at(action, slope, augmented.then_some(&mut *rate));
        if augmented {
            // of I f′ − 2f
            rate.add_product(&action[0], &slope[0]);
        }
    }

    fn add_energy(&mut self, energy: &mut N, assign: impl FnOnce(&mut N)) {
        let mut action = [energy.clone()];
        assign(&mut action[0]);
        energy.add(self.of_action.at(&action));
    }
}

/// f(I), I = ½(a q² + 2b q p + c p²) > 0: (q, p) turns by the angle f′(I) √(ac − b²) t.
pub(super) struct Rotation<N> {
    freedom: usize,
    form: Form<N>,
    function: Function<N>,
    /// √(ac − b²), and its inverse
    root: N,
    inverse: N,
    half: N,
    sin: N,
    cos: N,
    /// What is added to q and p.
    by: [N; 2],
}

/// a, b, c; no b where it is 0.
struct Form<N> {
    a: N,
    b: Option<N>,
    c: N,
}

impl<N: Number> Form<N> {
    /// x ← a q + b p and y ← b q + c p: the slopes of I.
    fn slopes(&self, q: &N, p: &N, [x, y]: [&mut N; 2]) {
        x.assign_product(&self.a, q);
        y.assign_product(&self.c, p);
        if let Some(b) = &self.b {
            x.add_product(b, p);
            y.add_product(b, q);
        }
    }

    /// action ← I, with two numbers to compute in.
    fn action(&self, q: &N, p: &N, [x, y]: [&mut N; 2], action: &mut N) {
        self.slopes(q, p, [x, y]);
        action.assign_product(q, x);
        action.add_product(p, y);
        action.divide_integer(2);
    }
}

impl<N: Number> Rotation<N> {
    pub(super) fn new(
        freedom: usize,
        [a, b, c]: &[Rational; 3],
        programs: &PotentialPrograms,
        context: &N::Context,
    ) -> Self {
        let number = |value: &Rational| N::from_rational(value, context);
        let zero = || N::zero(context);
        let is_zero = *b == Rational::from_integer(0.into());
        let form = Form { a: number(a), b: (!is_zero).then(|| number(b)), c: number(c) };
        let (mut root, mut inverse) = (zero(), zero());
        root.assign_sqrt(&number(&(a * c - b * b)));
        inverse.assign_quotient(&number(&Rational::from_integer(1.into())), &root);
        let function = Function::new(programs, context);
        let (half, sin, cos) = (zero(), zero(), zero());
        Rotation { freedom, form, function, root, inverse, half, sin, cos, by: [zero(), zero()] }
    }
}

impl<N: Number> Part<N> for Rotation<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        let Rotation { freedom, form, function, by: [x, y], .. } = self;
        function.add_energy(energy, |action| form.action(&q[*freedom], &p[*freedom], [x, y], action));
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, continues: bool) {
        let Rotation { freedom, form, function, root, inverse, half, sin, cos, by: [of_q, of_p] } = self;
        let freedoms = state.q().len();
        let (q, p) = (&state.q()[*freedom], &state.p()[*freedom]);
        function.evaluate(state, continues, |action| form.action(q, p, [of_q, of_p], action));
        half.assign_product(&function.slope[0], time);
        half.multiply(root);
        half.divide_integer(2);
        N::assign_sin_cos(sin, cos, half);
        // (sin θ)/√(ac − b²) and cos θ − 1, without cancellation, of θ = 2·half
        cos.multiply(sin);
        cos.multiply_integer(2);
        cos.multiply(inverse);
        half.assign_square(sin);
        half.multiply_integer(-2);
        form.slopes(q, p, [of_p, of_q]);
        of_q.multiply(cos);
        of_q.add_product(half, q);
        of_p.multiply(cos);
        of_p.negate();
        of_p.add_product(half, p);
        state.add(*freedom, of_q);
        state.add(*freedom + freedoms, of_p);
        state.add_to_beta(time, &function.rate);
    }
}

/// f(q p): q ← q e^{t f′}, p ← p e^{−t f′}.
pub(super) struct Squeeze<N> {
    freedom: usize,
    function: Function<N>,
    half: N,
    sinh: N,
    exp: N,
    by: N,
}

impl<N: Number> Squeeze<N> {
    pub(super) fn new(freedom: usize, programs: &PotentialPrograms, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let function = Function::new(programs, context);
        Squeeze { freedom, function, half: zero(), sinh: zero(), exp: zero(), by: zero() }
    }
}

impl<N: Number> Part<N> for Squeeze<N> {
    fn add_energy(&mut self, q: &[N], p: &[N], energy: &mut N) {
        let freedom = self.freedom;
        self.function.add_energy(energy, |action| action.assign_product(&q[freedom], &p[freedom]));
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, continues: bool) {
        let Squeeze { freedom, function, half, sinh, exp, by } = self;
        let freedoms = state.q().len();
        function.evaluate(state, continues, |action| action.assign_product(&state.q()[*freedom], &state.p()[*freedom]));
        half.assign_product(&function.slope[0], time);
        half.divide_integer(2);
        sinh.assign_sinh(half);
        sinh.multiply_integer(2);
        // eˣ − 1 = 2 sinh(x/2) e^{x/2}, first of x, then of −x
        for variable in [*freedom, *freedom + freedoms] {
            exp.assign_exp(half);
            exp.multiply(sinh);
            by.assign_product(exp, state.variable(variable));
            state.add(variable, by);
            half.negate();
            sinh.negate();
        }
        state.add_to_beta(time, &function.rate);
    }
}
