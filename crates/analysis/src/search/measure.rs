//! What a search makes small: errors, instability, phase, sampling error, sizes of weights; each computed in f64 from
//! the maps of a step.

use num_bigint::BigInt;
use num_traits::{One, ToPrimitive, Zero};
use shadowstep_schemes::MapKind;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::table::Table;

use crate::bracket::{Bracket, coordinates};
use crate::floats::Floats;
use crate::logarithm::Logarithm;
use crate::oscillator::Oscillator;
use crate::sampling;
use crate::trace::leading_phase;

/// A measure of a scheme: the less, the better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Measure {
    /// s·‖E‖^{1/p} after processing, if there is any, see
    /// [`LeadingError::effective`](crate::error::LeadingError::effective); for A + εB that of the terms of ε², of the
    /// order claimed for them.
    EffectiveError,
    /// Evaluations per unit of hω at the limit of stability: 1/2 for Störmer–Verlet, which no scheme is below.
    Instability,
    /// s·|c|^{1/r} for the leading error c (hω)^r of the phase of the harmonic oscillator.
    PhaseError,
    /// The largest expected error of the energy in sampling, see [`SamplingError`](crate::sampling::SamplingError),
    /// over 0 < hω < forces and Hessian–vector products of a step; where a step is unstable in the range, 1 and how far
    /// the limit is from its end.
    SamplingError,
    /// max |w| over kicks and drifts.
    LargestWeight,
    /// Σ max(−w, 0) over kicks and drifts: 0 for positive weights.
    NegativeWeights,
}

/// All measures, with their names in files.
pub const MEASURES: [(&str, Measure); 6] = [
    ("effective-error", Measure::EffectiveError),
    ("instability", Measure::Instability),
    ("phase-error", Measure::PhaseError),
    ("sampling-error", Measure::SamplingError),
    ("largest-weight", Measure::LargestWeight),
    ("negative-weights", Measure::NegativeWeights),
];

impl Measure {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        MEASURES.iter().find(|(_, measure)| *measure == self).expect("every measure has a name").0
    }
}

/// The maps of a step.
type Maps<'a> = &'a [(MapKind, f64)];

/// The measures of the schemes of one class and order, prepared once.
pub(super) struct Measures {
    order: u32,
    error: LeadingTerms,
}

/// The coordinates of the leading error, as a linear function of the logarithm's coefficients.
struct LeadingTerms {
    logarithm: Logarithm,
    /// Of each bracket, the factors of the words' coefficients.
    rows: Vec<Vec<f64>>,
    order: u32,
}

impl Measures {
    /// For the class and the orders that a table claims.
    pub(super) fn of(table: &Table, symmetric: bool) -> Measures {
        let (order, near_integrable) = match &table.processor {
            Some(processor) => (processor.order.value, &processor.near_integrable),
            None => (table.order.value, &table.near_integrable),
        };
        let least = match table.kinetic {
            Kinetic::Any => order,
            // that for every T(p), of which a consistent step has 1, and 2 if it is symmetric, which a processed one is
            // not
            Kinetic::Quadratic => 1 + u32::from(symmetric && table.processor.is_none()),
        };
        let squares = near_integrable.as_ref().and_then(|claim| claim.powers().nth(1));
        let error = match squares {
            Some((order, power)) => LeadingTerms::of(order.value, least, table.kinetic, |bracket| {
                bracket.letters().iter().filter(|letter| **letter == power.perturbation).count() == power.count
            }),
            None => LeadingTerms::of(order, least, table.kinetic, |_| true),
        };
        Measures { order, error }
    }

    /// A measure of a step of maps, of a processed scheme those of the kernel and of the processed step. The step costs
    /// `cost` evaluations.
    pub(super) fn value(&self, measure: Measure, (maps, processed): (Maps<'_>, Option<Maps<'_>>), cost: usize) -> f64 {
        let cost = cost as f64;
        let weights = || maps.iter().filter(|(kind, _)| *kind != MapKind::GradientKick).map(|(_, weight)| *weight);
        match measure {
            Measure::EffectiveError => {
                cost * self.error.norm(processed.unwrap_or(maps)).powf(1.0 / f64::from(self.error.order))
            }
            Measure::Instability => cost / Oscillator::of_floats(maps).limit(2.0 * cost),
            Measure::PhaseError => {
                let (coefficient, power) = leading_phase(maps, self.order);
                cost * coefficient.abs().powf(1.0 / f64::from(power))
            }
            Measure::SamplingError => {
                let step = Oscillator::of_floats(maps);
                match step.limit(2.0 * cost) {
                    limit if limit < cost => 1.0 + cost - limit,
                    _ => sampling::largest(&step, cost),
                }
            }
            Measure::LargestWeight => weights().fold(0.0, |most, weight| most.max(weight.abs())),
            Measure::NegativeWeights => weights().map(|weight| (-weight).max(0.0)).sum(),
        }
    }
}

impl LeadingTerms {
    /// Those of h^{order + 1} of steps with at least the order `least` for every T(p).
    fn of(order: u32, least: u32, kinetic: Kinetic, stays: impl Fn(&Bracket) -> bool) -> LeadingTerms {
        let logarithm = Logarithm::of_length(order as usize + 1, least as usize);
        let unit = |n: usize| {
            let entry = |m: usize| if m == n { BigInt::one() } else { BigInt::zero() };
            let words = logarithm.words().iter().enumerate().map(|(m, word)| (word.clone(), entry(m)));
            let found = coordinates(&words.collect::<Vec<_>>(), kinetic).into_iter();
            let found = found.filter(|(bracket, _)| stays(bracket));
            found.map(|(_, value)| value.to_f64().expect("a fraction of small numbers")).collect::<Vec<f64>>()
        };
        let columns: Vec<_> = (0..logarithm.words().len()).map(unit).collect();
        let rows = (0..columns[0].len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        LeadingTerms { logarithm, rows, order }
    }

    fn norm(&self, maps: &[(MapKind, f64)]) -> f64 {
        let values = self.logarithm.of(maps, &Floats);
        let coordinate = |row: &Vec<f64>| row.iter().zip(&values).map(|(factor, value)| factor * value).sum::<f64>();
        self.rows.iter().map(|row| coordinate(row).powi(2)).sum::<f64>().sqrt()
    }
}
