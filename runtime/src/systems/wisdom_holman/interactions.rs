//! Sums of Newton's potential over chosen pairs of bodies, from the formula of the pair.

use crate::number::Number;
use crate::systems::pairs::{Cutoff, Gravity, PairCurvature, PairPotential, Pairs, Shell};
use crate::systems::potential::{HessianProduct, Potential};

use super::bodies::Bodies;

/// The attraction between the planets, and of planets to other points.
#[derive(Clone, Debug)]
pub(super) struct Interactions<N, const D: usize> {
    planets: Pairs<Gravity<N>, D>,
    scratch: Vec<N>,
    /// What kicks have of it, where close planets attract each other in drifts.
    kicks: Option<Box<PairsOfKicks<N, D>>>,
    /// The same formula, for pairs of masses one by one.
    single: Gravity<N>,
    single_scratch: Vec<N>,
    /// Those of second derivatives, of all planets and of pairs of masses.
    hessian_scratch: Vec<N>,
    curvature_scratch: Vec<N>,
    squared: N,
    slope: N,
    part: N,
}

/// The part of the attraction that kicks have, with its scratch space.
#[derive(Clone, Debug)]
struct PairsOfKicks<N, const D: usize> {
    pairs: Pairs<Shell<Gravity<N>>, D>,
    scratch: Vec<N>,
    /// Beyond this distance it is the whole attraction.
    radius: f64,
}

impl<N: Number, const D: usize> PairsOfKicks<N, D> {
    /// Whether there is a pair that may be below the distance.
    fn has_near(&self, x: &[N]) -> bool {
        // beyond round-off of this sum
        let limit = self.radius * self.radius * (1.0 + 1e-12);
        let x = x.as_chunks::<D>().0;
        let is_near = |one: &[N; D], other: &[N; D], lane: usize| {
            let difference = |(a, b): (&N, &N)| (scaled(a.lane(lane)) - scaled(b.lane(lane))).powi(2);
            one.iter().zip(other).map(difference).sum::<f64>() <= limit
        };
        let has =
            |(i, one): (usize, &[N; D])| x[..i].iter().any(|other| (0..N::LANES).any(|lane| is_near(one, other, lane)));
        x.iter().enumerate().any(has)
    }
}

/// m 2ⁿ
#[inline(always)]
pub(super) fn scaled((m, n): (f64, i64)) -> f64 {
    if n == 0 { m } else { m * 2f64.powi(n.clamp(-4000, 4000) as i32) }
}

/// The formula of Newton's potential has second derivatives.
pub(super) fn curved<N: Number>(pair: &Gravity<N>) -> &dyn PairCurvature<N> {
    pair.curved().expect("they are derived with the formula")
}

/// The attraction between the planets.
pub(super) fn gravity_of_planets<N: Number>(bodies: &Bodies, context: &N::Context) -> Gravity<N> {
    let number = |value| N::from_rational(value, context);
    Gravity { g: number(&bodies.g), m: bodies.masses[1..].iter().map(number).collect() }
}

impl<N: Number, const D: usize> Interactions<N, D> {
    /// Of the planets; `masses` are those of the pairs one by one.
    pub(super) fn new(bodies: &Bodies, masses: Vec<N>, context: &N::Context) -> Self {
        let planets: Gravity<N> = gravity_of_planets(bodies, context);
        let single = Gravity { g: planets.g.clone(), m: masses };
        let planets = Pairs::all(bodies.masses.len() - 1, planets).expect("a mass for each planet");
        let zeros = |count| vec![N::zero(context); count];
        let mut scratch = zeros(Potential::<N>::scratch(&planets));
        planets.prepare(&mut scratch, context);
        let mut single_scratch = zeros(single.scratch());
        single.prepare(&mut single_scratch, context);
        let mut hessian_scratch = zeros(HessianProduct::<N>::hessian_scratch(&planets));
        planets.prepare_hessian(&mut hessian_scratch, context);
        let mut curvature_scratch = zeros(curved(&single).curvature_scratch());
        curved(&single).prepare_curvature(&mut curvature_scratch, context);
        let [squared, slope, part] = std::array::from_fn(|_| N::zero(context));
        Interactions {
            planets,
            scratch,
            kicks: None,
            single,
            single_scratch,
            hessian_scratch,
            curvature_scratch,
            squared,
            slope,
            part,
        }
    }

    /// Leaves what a cutoff has of the attraction between the planets to others, which is switched.
    pub(super) fn leave_near(&mut self, bodies: &Bodies, cutoff: &Cutoff<D>, context: &N::Context) {
        let pair = Shell::new(gravity_of_planets(bodies, context), None, Some(cutoff));
        let pairs = Pairs::all(bodies.masses.len() - 1, pair).expect("a mass for each planet");
        let mut scratch = vec![N::zero(context); Potential::<N>::scratch(&pairs)];
        pairs.prepare(&mut scratch, context);
        let radius = <f64 as Number>::from_rational(cutoff.radius(), &());
        self.kicks = Some(Box::new(PairsOfKicks { pairs, scratch, radius }));
    }

    /// gradient ← U_x of the attraction between the planets in kicks and, if asked for, rate ← xᵀU_x − 2U
    pub(super) fn assign_gradient(&mut self, x: &[N], gradient: &mut [N], rate: Option<&mut N>) {
        if let Some(kicks) = self.kicks.as_mut().filter(|kicks| kicks.has_near(x)) {
            let PairsOfKicks { pairs, scratch, .. } = &mut **kicks;
            return match rate {
                None => pairs.gradient(x, gradient, scratch),
                Some(rate) => pairs.gradient_and_rate(x, gradient, rate, scratch),
            };
        }
        match rate {
            None => self.planets.gradient(x, gradient, &mut self.scratch),
            Some(rate) => self.planets.gradient_and_rate(x, gradient, rate, &mut self.scratch),
        }
    }

    /// product ← U_xx v of the attraction between the planets
    pub(super) fn assign_hessian_product(&mut self, x: &[N], v: &[N], product: &mut [N]) {
        self.planets.hessian_product(x, v, product, &mut self.hessian_scratch);
    }

    /// Adds u_xx v of the attraction between two masses at the distance |x| to a product.
    pub(super) fn add_single_product(&mut self, (i, j): (usize, usize), x: &[N; D], v: &[N; D], product: &mut [N; D]) {
        self.assign_single_curvature((i, j), x, v);
        for (sum, (x, v)) in product.iter_mut().zip(x.iter().zip(v)) {
            sum.add_product(&self.slope, v);
            sum.add_product(&self.part, x);
        }
    }

    /// Subtracts the same.
    pub(super) fn subtract_single_product(
        &mut self,
        (i, j): (usize, usize),
        x: &[N; D],
        v: &[N; D],
        product: &mut [N; D],
    ) {
        self.assign_single_curvature((i, j), x, v);
        for (sum, (x, v)) in product.iter_mut().zip(x.iter().zip(v)) {
            sum.subtract_product(&self.slope, v);
            sum.subtract_product(&self.part, x);
        }
    }

    /// slope and part, with which u_xx v = slope v + part x.
    fn assign_single_curvature(&mut self, (i, j): (usize, usize), x: &[N; D], v: &[N; D]) {
        let Interactions { single, curvature_scratch, squared, slope, part, .. } = self;
        squared.assign_zero();
        x.iter().for_each(|x| squared.add_product(x, x));
        curved(single).curvature(i, j, squared, slope, part, curvature_scratch);
        squared.assign_zero();
        x.iter().zip(v).for_each(|(x, v)| squared.add_product(x, v));
        part.multiply(squared);
    }

    /// energy ← U of the attraction between the planets
    pub(super) fn assign_energy(&mut self, x: &[N], energy: &mut N) {
        self.planets.energy(x, energy, &mut self.scratch);
    }

    /// Adds u_x of the attraction between two masses at the distance |x| to a gradient and, if asked for, its −3u to a
    /// rate.
    pub(super) fn add_single(
        &mut self,
        (i, j): (usize, usize),
        x: &[N; D],
        gradient: &mut [N; D],
        rate: Option<&mut N>,
    ) {
        self.assign_slope((i, j), x, rate.is_some());
        gradient.iter_mut().zip(x).for_each(|(sum, x)| sum.add_product(&self.slope, x));
        rate.into_iter().for_each(|rate| rate.add(&self.part));
    }

    /// Subtracts the same.
    pub(super) fn subtract_single(
        &mut self,
        (i, j): (usize, usize),
        x: &[N; D],
        gradient: &mut [N; D],
        rate: Option<&mut N>,
    ) {
        self.assign_slope((i, j), x, rate.is_some());
        gradient.iter_mut().zip(x).for_each(|(sum, x)| sum.subtract_product(&self.slope, x));
        rate.into_iter().for_each(|rate| rate.subtract(&self.part));
    }

    fn assign_slope(&mut self, (i, j): (usize, usize), x: &[N; D], with_rate: bool) {
        let Interactions { single, single_scratch, squared, slope, part, .. } = self;
        squared.assign_zero();
        x.iter().for_each(|x| squared.add_product(x, x));
        match with_rate {
            true => single.slope_and_summand(i, j, squared, slope, part, single_scratch),
            false => single.slope(i, j, squared, slope, single_scratch),
        }
    }

    /// The energy u of two masses at the distance |x|.
    pub(super) fn single_energy(&mut self, (i, j): (usize, usize), x: &[N; D]) -> &N {
        let Interactions { single, single_scratch, squared, part, .. } = self;
        squared.assign_zero();
        x.iter().for_each(|x| squared.add_product(x, x));
        single.energy(i, j, squared, part, single_scratch);
        part
    }
}
