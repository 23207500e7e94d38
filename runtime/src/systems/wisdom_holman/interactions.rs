//! Sums of Newton's potential over chosen pairs of bodies, from the formula of the pair.

use crate::number::Number;
use crate::systems::pairs::{Cutoff, Gravity, PairCurvature, PairPotential, Pairs, Shell};
use crate::systems::potential::Prepared;

use super::bodies::Bodies;

/// The attraction between the planets, and of planets to other points.
#[derive(Clone, Debug)]
pub(super) struct Interactions<N, const D: usize> {
    planets: Prepared<N, Pairs<Gravity<N>, D>>,
    /// What kicks have of it, where close planets attract each other in drifts.
    kicks: Option<Box<PairsOfKicks<N, D>>>,
    /// The same formula, for pairs of masses one by one, with its scratch space and that of second derivatives.
    single: Gravity<N>,
    single_scratch: Vec<N>,
    curvature_scratch: Vec<N>,
    squared: N,
    slope: N,
    part: N,
}

/// The part of the attraction that kicks have.
#[derive(Clone, Debug)]
struct PairsOfKicks<N, const D: usize> {
    pairs: Prepared<N, Pairs<Shell<Gravity<N>>, D>>,
    /// Beyond this distance it is the whole attraction.
    radius: f64,
}

impl<N: Number, const D: usize> PairsOfKicks<N, D> {
    /// Whether there is a pair that may be below the distance.
    fn has_near(&self, x: &[N]) -> bool {
        let x = x.as_chunks::<D>().0;
        let has = |(i, one): (usize, &[N; D])| x[..i].iter().any(|other| are_near(one, other, self.radius));
        x.iter().enumerate().any(has)
    }
}

/// Whether two points may be below a distance, beyond round-off of this sum; with lanes, in any of them.
pub(super) fn are_near<N: Number>(one: &[N], other: &[N], distance: f64) -> bool {
    let limit = distance * distance * (1.0 + 1e-12);
    let square = |lane: usize| -> f64 {
        let difference = |(a, b): (&N, &N)| (scaled(a.lane(lane)) - scaled(b.lane(lane))).powi(2);
        one.iter().zip(other).map(difference).sum()
    };
    (0..N::LANES).any(|lane| square(lane) <= limit)
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

/// The sum over all pairs of planets.
pub(super) fn of_planets<N: Number, P: PairPotential<N>, const D: usize>(
    bodies: &Bodies,
    pair: P,
    context: &N::Context,
) -> Prepared<N, Pairs<P, D>> {
    Prepared::new(Pairs::all(bodies.masses.len() - 1, pair).expect("a mass for each planet"), context)
}

impl<N: Number, const D: usize> Interactions<N, D> {
    /// Of the planets; `masses` are those of the pairs one by one.
    pub(super) fn new(bodies: &Bodies, masses: Vec<N>, context: &N::Context) -> Self {
        let planets: Gravity<N> = gravity_of_planets(bodies, context);
        let single = Gravity { g: planets.g.clone(), m: masses };
        let zeros = |count| vec![N::zero(context); count];
        let (mut single_scratch, mut curvature_scratch) =
            (zeros(single.scratch()), zeros(curved(&single).curvature_scratch()));
        single.prepare(&mut single_scratch, context);
        curved(&single).prepare_curvature(&mut curvature_scratch, context);
        let [squared, slope, part] = std::array::from_fn(|_| N::zero(context));
        let planets = of_planets(bodies, planets, context);
        Interactions { planets, kicks: None, single, single_scratch, curvature_scratch, squared, slope, part }
    }

    /// Leaves what a cutoff has of the attraction between the planets to others, which is switched.
    pub(super) fn leave_near(&mut self, bodies: &Bodies, cutoff: &Cutoff<D>, context: &N::Context) {
        let pair = Shell::new(gravity_of_planets(bodies, context), None, Some(cutoff));
        let radius = <f64 as Number>::from_rational(cutoff.radius(), &());
        self.kicks = Some(Box::new(PairsOfKicks { pairs: of_planets(bodies, pair, context), radius }));
    }

    /// gradient ← U_x of the attraction between the planets in kicks and, if asked for, rate ← xᵀU_x − 2U
    pub(super) fn assign_gradient(&mut self, x: &[N], gradient: &mut [N], rate: Option<&mut N>) {
        match self.kicks.as_mut().filter(|kicks| kicks.has_near(x)) {
            Some(kicks) => kicks.pairs.gradient(x, gradient, rate),
            None => self.planets.gradient(x, gradient, rate),
        }
    }

    /// product ← U_xx v of the attraction between the planets
    pub(super) fn assign_hessian_product(&mut self, x: &[N], v: &[N], product: &mut [N]) {
        self.planets.hessian_product(x, v, product, None);
    }

    /// Adds u_xx v of the attraction between two masses at the distance |x| to a product.
    pub(super) fn add_single_product(&mut self, (i, j): (usize, usize), x: &[N; D], v: &[N; D], product: &mut [N; D]) {
        self.assign_single_curvature((i, j), x, v);
        for (sum, (x, v)) in product.iter_mut().zip(x.iter().zip(v)) {
            sum.add_product(&self.slope, v);
            sum.add_product(&self.part, x);
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
        self.planets.energy(x, energy);
    }

    /// Adds u_x of the attraction between two masses at the distance |x| to a gradient and, if asked for, its −3u to a
    /// rate.
    #[inline(always)]
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
