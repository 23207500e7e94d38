//! Proved scheme → how good it is: leading errors, stability and phase of the harmonic oscillator, sizes of the
//! weights.
//!
//! ```
//! use shadowstep_analysis::Analysis;
//! use shadowstep_schemes::{read, shipped};
//!
//! let verlet = read(&shipped("stormer-verlet").unwrap(), &|name, _| shipped(name)).unwrap();
//! let analysis = Analysis::of(&verlet);
//! assert_eq!(analysis.stability.unwrap().limit, "2");
//! assert_eq!((analysis.phase.coefficient, analysis.phase.power), (1.0 / 24.0, 2));
//! assert_eq!(analysis.general.terms[0].0.to_string(), "[K,[K,D]]");
//! ```

use num_traits::{Signed, Zero};
use shadowstep_schemes::symbolic::Rational;

use crate::error::LeadingError;
use crate::sampling::SamplingError;
use crate::stability::Stability;
use crate::trace::PhaseError;
use shadowstep_schemes::MapKind;
use shadowstep_schemes::Proved;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::map::Map;

/// How good a scheme is.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// Evaluations of the gradient a step.
    pub evaluations: usize,
    /// Hessian–vector products a step.
    pub hessian_products: usize,
    /// The leading error for every T(p); of a processed scheme, as all that follows but the next, that of its kernel.
    pub general: LeadingError,
    /// The leading error for quadratic T.
    pub quadratic: LeadingError,
    /// The leading errors after processing, for every T(p) and quadratic T; `None` for a scheme that is not processed.
    pub processed: Option<[LeadingError; 2]>,
    /// Where the harmonic oscillator is stable; `None` for a step of more than
    /// [`stability::MOST_MAPS`](crate::stability::MOST_MAPS) maps that does not repeat a shorter one.
    pub stability: Option<Stability>,
    /// How far the harmonic oscillator's phase is off.
    pub phase: PhaseError,
    /// The largest expected error of the energy of the harmonic oscillator, of a symmetric scheme whose stability is
    /// known.
    pub sampling: Option<SamplingError>,
    /// The sizes of the kicks' weights.
    pub kicks: Sizes,
    /// The sizes of the drifts' weights.
    pub drifts: Sizes,
    /// The sizes of the gradient kicks' weights.
    pub gradient_kicks: Sizes,
}

/// The sizes of the weights of one kind of map; weights that are 0 are left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Σ|w|: 1 if no map goes backwards.
    pub sum_of_sizes: Rational,
    /// The smallest weight, the most negative one if there are such.
    pub smallest: Rational,
    /// The largest weight.
    pub largest: Rational,
}

impl Analysis {
    /// Analyses a scheme: takes milliseconds, for hundreds of digits and order 10 some hundred.
    pub fn of(proved: &Proved) -> Analysis {
        let (maps, proof) = (proved.scheme.maps(), &proved.proof);
        let [general, quadratic] = LeadingError::of(proved);
        let stability = Stability::of_scheme(proved);
        Analysis {
            evaluations: proved.plan.evaluations,
            hessian_products: proved.plan.hessian_products,
            general,
            quadratic,
            processed: LeadingError::processed(proved),
            sampling: SamplingError::of(proved, stability.as_ref()),
            stability,
            phase: PhaseError::of(&maps, proved.scheme.held, proof.quadratic.order),
            kicks: Sizes::of(&maps, MapKind::Kick),
            drifts: Sizes::of(&maps, MapKind::Drift),
            gradient_kicks: Sizes::of(&maps, MapKind::GradientKick),
        }
    }

    /// The leading error for a class of kinetic energies.
    pub fn error(&self, kinetic: Kinetic) -> &LeadingError {
        match kinetic {
            Kinetic::Any => &self.general,
            Kinetic::Quadratic => &self.quadratic,
        }
    }

    /// The effective error for a class of kinetic energies, a Hessian–vector product counted like an evaluation of the
    /// gradient: see [`LeadingError::effective`].
    pub fn effective_error(&self, kinetic: Kinetic) -> f64 {
        self.error(kinetic).effective(self.evaluations + self.hessian_products)
    }
}

impl Sizes {
    /// The sizes of the weights of one kind among the maps of a step.
    pub fn of(maps: &[Map], kind: MapKind) -> Sizes {
        let mut weights: Vec<_> = maps.iter().filter(|map| map.kind == kind).map(|map| &map.weight).collect();
        weights.sort();
        let end = |weight: Option<&&Rational>| weight.map_or_else(Rational::zero, |weight| (*weight).clone());
        Sizes {
            sum_of_sizes: weights.iter().map(|weight| weight.abs()).sum(),
            smallest: end(weights.first()),
            largest: end(weights.last()),
        }
    }
}
