//! What moves: a shipped problem or a formula's potential, its masses and its state at t = 0.

use shadowstep::formula::{FormulaError, FormulaPotential};
use shadowstep::kinetic::Quadratic;
use shadowstep::problems::{ProblemMotion, Setup};
use shadowstep::{DiagonalMasses, Kinetic, Motion, Number, Potential, Rational, UnitMasses};
use shadowstep_symbolic::Exact;

/// H = T(p) + U(q) and the state at t = 0, all exact.
#[derive(Debug)]
pub(crate) struct System {
    pub(crate) energy: PotentialEnergy,
    /// Names and values.
    pub(crate) parameters: Vec<(String, Exact)>,
    /// Names of q_1, q_2, ….
    pub(crate) coordinates: Vec<String>,
    /// Names of p_1, p_2, ….
    pub(crate) momenta: Vec<String>,
    /// One for each coordinate, unless all are 1.
    pub(crate) masses: Option<Vec<Exact>>,
    pub(crate) q: Vec<Exact>,
    pub(crate) p: Vec<Exact>,
}

/// U(q)
#[derive(Debug)]
pub(crate) enum PotentialEnergy {
    Shipped(Setup),
    Formula(String),
}

impl System {
    /// Positions and momenta at t = 0.
    pub(crate) fn start<N: Number>(&self, context: &N::Context) -> (Vec<N>, Vec<N>) {
        let numbers = |values: &[Exact]| values.iter().map(|v| N::from_rational(&v.value, context)).collect();
        (numbers(&self.q), numbers(&self.p))
    }

    /// The system at q, p.
    pub(crate) fn motion<N: Number + 'static>(&self, q: Vec<N>, p: Vec<N>, context: &N::Context) -> ProblemMotion<N> {
        Motion::new(self.potential(context), self.kinetic(context), q, p)
    }

    fn potential<N: Number + 'static>(&self, context: &N::Context) -> Box<dyn Potential<N>> {
        match &self.energy {
            PotentialEnergy::Shipped(setup) => setup.potential(context),
            PotentialEnergy::Formula(formula) => {
                let potential = formula_potential::<N>(formula, &self.coordinates, &self.parameters, context);
                Box::new(potential.expect("the formula was read with the scene"))
            }
        }
    }

    fn kinetic<N: Number + 'static>(&self, context: &N::Context) -> Box<dyn Kinetic<N, Class = Quadratic>> {
        let Some(masses) = &self.masses else { return Box::new(UnitMasses) };
        let masses: Vec<Rational> = masses.iter().map(|mass| mass.value.clone()).collect();
        Box::new(DiagonalMasses::new(&masses, context).expect("the masses were read with the scene"))
    }
}

/// The potential of a formula, with its parameters rounded once.
pub(crate) fn formula_potential<N: Number>(
    formula: &str,
    coordinates: &[String],
    parameters: &[(String, Exact)],
    context: &N::Context,
) -> Result<FormulaPotential<N>, FormulaError> {
    let coordinates: Vec<&str> = coordinates.iter().map(String::as_str).collect();
    let parameters: Vec<(&str, N)> =
        parameters.iter().map(|(name, exact)| (name.as_str(), N::from_rational(&exact.value, context))).collect();
    FormulaPotential::new(formula, &coordinates, &parameters)
}
