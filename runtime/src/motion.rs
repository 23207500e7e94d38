//! A state q, p, β, the maps that move it, and what a step adds to it.

use crate::kinetic::Kinetic;
use crate::number::Number;
use crate::potential::Potential;

/// What a scheme does to a system: kicks and drifts, with weights h·a_s and h·b_s.
///
/// [`Motion`] has these maps; a system with a storage of its own can have them too, and then every scheme moves it.
pub trait Maps<N> {
    /// What is known of its kinetic energy: [`Quadratic`](crate::kinetic::Quadratic) or
    /// [`General`](crate::kinetic::General). Schemes whose order holds for quadratic T only do not move the latter.
    type Class;

    /// p ← p − weight·U_q(q)
    fn kick(&mut self, weight: &N);

    /// The kick, and β ← β + weight·(qᵀU_q − 2U).
    ///
    /// From β' = qᵀH_q + pᵀH_p − 2H with H = T(p) + U(q); the paper's eq. 2 has a wrong sign.
    fn kick_augmented(&mut self, weight: &N);

    /// q ← q + weight·T_p(p)
    fn drift(&mut self, weight: &N);

    /// The drift, and β ← β + weight·(pᵀT_p − 2T), which is nothing for quadratic T.
    fn drift_augmented(&mut self, weight: &N);

    /// β ← 0: β, and what else a system says of a step, counts from its beginning, so that it keeps its digits in long runs.
    fn restart_beta(&mut self);
}

/// What a step added to q, p and β.
///
/// A number type that does not [keep increments](Number::KEEPS_INCREMENTS) has that of β only; q and p are empty.
#[derive(Clone, Debug)]
pub struct Increments<N> {
    /// To q: the sum of the drifts, without the round-off of q itself.
    pub q: Vec<N>,
    /// To p: the sum of the kicks.
    pub p: Vec<N>,
    /// To β.
    pub beta: N,
}

impl<N: Number> Increments<N> {
    /// Zeros for states of `dimension` coordinates, as many as the number type keeps.
    pub fn zero(dimension: usize, context: &N::Context) -> Self {
        let kept = if N::KEEPS_INCREMENTS { dimension } else { 0 };
        let zeros = || vec![N::zero(context); kept];
        Increments { q: zeros(), p: zeros(), beta: N::zero(context) }
    }

    /// That of β alone: what is known of states that come from elsewhere.
    pub fn of_beta(beta: N) -> Self {
        Increments { q: Vec::new(), p: Vec::new(), beta }
    }

    /// Whether those of q and p are known.
    pub fn has_vectors(&self) -> bool {
        !self.q.is_empty()
    }

    pub(crate) fn assign_zero(&mut self) {
        self.each(N::assign_zero);
    }

    pub(crate) fn negate(&mut self) {
        self.each(N::negate);
    }

    pub(crate) fn assign(&mut self, other: &Self) {
        self.q.clone_from(&other.q);
        self.p.clone_from(&other.p);
        self.beta.assign(&other.beta);
    }

    fn each(&mut self, change: impl Fn(&mut N)) {
        self.q.iter_mut().chain(&mut self.p).for_each(&change);
        change(&mut self.beta);
    }
}

/// Holds the coordinates of a state: an array `[N; D]`, or a `Vec<N>` or `Box<[N]>` where the dimension is known at run
/// time only.
pub trait Coordinates<N>: AsRef<[N]> + AsMut<[N]> + Clone {}

impl<N, V: AsRef<[N]> + AsMut<[N]> + Clone> Coordinates<N> for V {}

/// What is known about the gradient at the present q.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kept {
    Nothing,
    Gradient,
    GradientAndRate,
}

/// A system H = T(p) + U(q) and its state.
///
/// The gradient of the last kick is kept as long as q stays, so that the next step's first kick costs no evaluation.
#[derive(Clone, Debug)]
pub struct Motion<N, V, P, K> {
    potential: P,
    kinetic: K,
    q: V,
    p: V,
    increments: Increments<N>,
    gradient: V,
    /// qᵀU_q − 2U
    rate: N,
    kept: Kept,
    /// Whether every evaluation is to find the rate, too.
    wants_rate: bool,
    /// The potential's, with what it keeps there.
    scratch: Vec<N>,
    /// The kinetic energy's, likewise.
    kinetic_scratch: Vec<N>,
    evaluations: u64,
}

impl<N, V, P, K> Motion<N, V, P, K>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    /// The system at q, p.
    ///
    /// # Panics
    /// If q, p, the potential and the kinetic energy do not have the same dimension, at least 1, or the numbers of q and p not
    /// the same context.
    pub fn new(potential: P, kinetic: K, q: V, p: V) -> Self {
        let dimension = q.as_ref().len();
        assert!(dimension > 0, "a motion has at least one coordinate");
        assert_eq!(dimension, p.as_ref().len(), "q and p must have the same dimension");
        assert_eq!(dimension, potential.dimension(), "q must have the potential's dimension");
        let momenta = kinetic.dimension().unwrap_or(dimension);
        assert_eq!(dimension, momenta, "p must have the kinetic energy's dimension");
        let context = q.as_ref()[0].context();
        let alike = q.as_ref().iter().chain(p.as_ref()).all(|x| x.context() == context);
        assert!(alike, "the numbers of q and p must have the same precision");
        let zero = N::zero(&context);
        let mut scratch = vec![zero.clone(); potential.scratch()];
        potential.prepare(&mut scratch, &context);
        let mut kinetic_scratch = vec![zero.clone(); kinetic.scratch()];
        kinetic.prepare(&mut kinetic_scratch, &context);
        Motion {
            scratch,
            kinetic_scratch,
            gradient: p.clone(),
            rate: zero,
            increments: Increments::zero(dimension, &context),
            kept: Kept::Nothing,
            wants_rate: false,
            evaluations: 0,
            potential,
            kinetic,
            q,
            p,
        }
    }

    /// Positions.
    pub fn q(&self) -> &[N] {
        self.q.as_ref()
    }

    /// Momenta.
    pub fn p(&self) -> &[N] {
        self.p.as_ref()
    }

    /// What the last augmented step added to β.
    pub fn beta(&self) -> &N {
        &self.increments.beta
    }

    /// What the last augmented step added to q, p and β.
    pub fn increments(&self) -> &Increments<N> {
        &self.increments
    }

    /// Positions, to be changed; the kept gradient is dropped.
    pub fn q_mut(&mut self) -> &mut [N] {
        self.kept = Kept::Nothing;
        self.q.as_mut()
    }

    /// Momenta, to be changed.
    pub fn p_mut(&mut self) -> &mut [N] {
        self.p.as_mut()
    }

    /// The potential.
    pub fn potential(&self) -> &P {
        &self.potential
    }

    /// Changes the potential, which keeps its dimension; the kept gradient is dropped.
    pub fn change_potential(&mut self, change: impl FnOnce(&mut P)) {
        change(&mut self.potential);
        self.kept = Kept::Nothing;
        let context = self.context();
        self.scratch.resize(self.potential.scratch(), N::zero(&context));
        self.potential.prepare(&mut self.scratch, &context);
    }

    /// How often the gradient U_q has been evaluated; that every drift evaluates T_p is not counted.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The context of the numbers.
    pub fn context(&self) -> N::Context {
        self.increments.beta.context()
    }

    /// H = T(p) + U(q) at the present state.
    pub fn energy(&mut self) -> N {
        let Motion { potential, kinetic, q, p, scratch, kinetic_scratch, increments, .. } = self;
        energy_at(potential, kinetic, (q.as_ref(), p.as_ref()), (scratch, kinetic_scratch), increments.beta.clone())
    }

    /// H = T(p) + U(q) at another state of the same system.
    pub fn energy_of(&mut self, q: &[N], p: &[N]) -> N {
        let Motion { potential, kinetic, scratch, kinetic_scratch, increments, .. } = self;
        energy_at(potential, kinetic, (q, p), (scratch, kinetic_scratch), increments.beta.clone())
    }

    /// H, and T(p) alone, at another state of the same system, in numbers that exist.
    pub(crate) fn assign_energies_of(&mut self, q: &[N], p: &[N], energy: &mut N, kinetic_energy: &mut N) {
        let Motion { potential, kinetic, scratch, kinetic_scratch, .. } = self;
        kinetic.energy(p, kinetic_energy, kinetic_scratch);
        potential.energy(q, energy, scratch);
        energy.add(kinetic_energy);
    }

    /// H and T(p) at the present state. Where the gradient and the rate are kept, U = ½(qᵀU_q − rate) costs no evaluation.
    pub(crate) fn assign_energies(&mut self, energy: &mut N, kinetic_energy: &mut N) {
        let Motion { potential, kinetic, q, p, gradient, rate, kept, scratch, kinetic_scratch, .. } = self;
        kinetic.energy(p.as_ref(), kinetic_energy, kinetic_scratch);
        if *kept == Kept::GradientAndRate {
            energy.assign_zero();
            q.as_ref().iter().zip(gradient.as_ref()).for_each(|(q, u)| energy.add_product(q, u));
            energy.subtract(rate);
            energy.divide_integer(2);
        } else {
            potential.energy(q.as_ref(), energy, scratch);
        }
        energy.add(kinetic_energy);
    }

    /// Whether plain kicks that evaluate the gradient find and keep the rate as well: the last step before one that carries β
    /// does so, as that would have to evaluate its first gradient again.
    pub(crate) fn keep_rate(&mut self, wanted: bool) {
        self.wants_rate = wanted;
    }

    #[inline]
    fn evaluate(&mut self, with_rate: bool) {
        let (q, gradient) = (self.q.as_ref(), self.gradient.as_mut());
        self.kept = if with_rate {
            self.potential.gradient_and_rate(q, gradient, &mut self.rate, &mut self.scratch);
            Kept::GradientAndRate
        } else {
            self.potential.gradient(q, gradient, &mut self.scratch);
            Kept::Gradient
        };
        self.evaluations += 1;
    }

    /// Whether every q, p and β is a finite number.
    pub fn is_finite(&self) -> bool {
        self.increments.beta.is_finite() && self.q().iter().chain(self.p()).all(Number::is_finite)
    }

    #[inline]
    fn kick_with_kept_gradient(&mut self, weight: &N) {
        for (p, gradient) in self.p.as_mut().iter_mut().zip(self.gradient.as_ref()) {
            p.subtract_product(weight, gradient);
        }
    }
}

fn energy_at<N: Number, P: Potential<N>, K: Kinetic<N>>(
    potential: &P,
    kinetic: &K,
    (q, p): (&[N], &[N]),
    (scratch, kinetic_scratch): (&mut [N], &mut [N]),
    mut energy: N,
) -> N {
    let mut kinetic_energy = energy.clone();
    kinetic.energy(p, &mut kinetic_energy, kinetic_scratch);
    potential.energy(q, &mut energy, scratch);
    energy.add(&kinetic_energy);
    energy
}

impl<N, V, P, K> Maps<N> for Motion<N, V, P, K>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    type Class = K::Class;

    #[inline]
    fn kick(&mut self, weight: &N) {
        if self.kept == Kept::Nothing {
            self.evaluate(self.wants_rate);
        }
        self.kick_with_kept_gradient(weight);
    }

    #[inline]
    fn kick_augmented(&mut self, weight: &N) {
        if self.kept != Kept::GradientAndRate {
            self.evaluate(true);
        }
        self.kick_with_kept_gradient(weight);
        self.increments.beta.add_product(weight, &self.rate);
        for (increment, gradient) in self.increments.p.iter_mut().zip(self.gradient.as_ref()) {
            increment.subtract_product(weight, gradient);
        }
    }

    #[inline]
    fn drift(&mut self, weight: &N) {
        self.kinetic.drift(weight, self.p.as_ref(), self.q.as_mut(), &mut self.kinetic_scratch);
        self.kept = Kept::Nothing;
    }

    #[inline]
    fn drift_augmented(&mut self, weight: &N) {
        let (p, q, increments) = (self.p.as_ref(), self.q.as_mut(), &mut self.increments);
        self.kinetic.drift_augmented(weight, p, q, &mut increments.beta, &mut self.kinetic_scratch);
        if increments.has_vectors() {
            self.kinetic.drift(weight, p, &mut increments.q, &mut self.kinetic_scratch);
        }
        self.kept = Kept::Nothing;
    }

    #[inline]
    fn restart_beta(&mut self) {
        self.increments.assign_zero();
    }
}
