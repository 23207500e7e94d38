//! The exact values of a problem: parameters, initial state and masses.

use shadowstep_schemes::symbolic::Exact;

use crate::Rational;
use crate::number::Number;
use crate::systems::kinetic::{DiagonalMasses, Kinetic, MassError, Quadratic, UnitMasses};

/// Parameters, initial positions and momenta, and masses.
#[derive(Clone, Debug)]
pub struct Values {
    /// Parameters, then positions, then momenta.
    named: Vec<(String, Exact)>,
    parameters: usize,
    masses: Option<Vec<Exact>>,
}

impl Values {
    /// The values by name, of which the first `parameters` are parameters and the rest is the state; and a mass for
    /// each coordinate, or none if all are 1.
    pub(super) fn new(named: Vec<(String, Exact)>, parameters: usize, masses: Option<Vec<Exact>>) -> Self {
        Values { named, parameters, masses }
    }

    /// Every parameter, position and momentum with its name, in the order of the problem.
    pub fn named(&self) -> &[(String, Exact)] {
        &self.named
    }

    /// The value with this name.
    ///
    /// # Panics
    /// If the problem has no value with this name.
    pub fn value(&self, name: &str) -> &Rational {
        let found = self.named.iter().find(|(known, _)| known == name);
        &found.unwrap_or_else(|| panic!("the problem has no value `{name}`")).1.value
    }

    /// The value with this name, rounded once.
    pub(super) fn number<N: Number>(&self, name: &str, context: &N::Context) -> N {
        N::from_rational(self.value(name), context)
    }

    /// The initial positions with their names.
    pub fn positions(&self) -> &[(String, Exact)] {
        let state = &self.named[self.parameters..];
        &state[..state.len() / 2]
    }

    /// The initial momenta with their names.
    pub fn momenta(&self) -> &[(String, Exact)] {
        let state = &self.named[self.parameters..];
        &state[state.len() / 2..]
    }

    /// One mass per coordinate; `None` if all are 1.
    pub fn masses(&self) -> Option<&[Exact]> {
        self.masses.as_deref()
    }

    /// The initial q, each rounded once.
    pub fn q<N: Number>(&self, context: &N::Context) -> Vec<N> {
        rounded(self.positions(), context)
    }

    /// The initial p, each rounded once.
    pub fn p<N: Number>(&self, context: &N::Context) -> Vec<N> {
        rounded(self.momenta(), context)
    }

    /// The kinetic energy T(p) = Σ p_i²/(2 m_i).
    ///
    /// # Errors
    /// A mass that is not positive.
    pub fn kinetic<N: Number + 'static>(
        &self,
        context: &N::Context,
    ) -> Result<Box<dyn Kinetic<N, Class = Quadratic>>, MassError> {
        Ok(match &self.masses {
            None => Box::new(UnitMasses),
            Some(masses) => {
                let masses: Vec<Rational> = masses.iter().map(|mass| mass.value.clone()).collect();
                Box::new(DiagonalMasses::new(&masses, context)?)
            }
        })
    }
}

fn rounded<N: Number>(values: &[(String, Exact)], context: &N::Context) -> Vec<N> {
    values.iter().map(|(_, exact)| N::from_rational(&exact.value, context)).collect()
}
