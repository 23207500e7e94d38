//! What moves: a shipped problem or a formula's potential, its kinetic energy and its state at t = 0.

use shadowstep::problems::Setup;
use shadowstep::systems::explicit_time::WithTime;
use shadowstep::systems::formula::{FormulaKinetic, FormulaPotential};
use shadowstep::systems::kinetic::{General, Quadratic, WithParticles};
use shadowstep::{DiagonalMasses, Kinetic, Motion, Number, Potential, Rational, System, UnitMasses};
use shadowstep_schemes::symbolic::Exact;
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::run::arithmetic::Arithmetic;
use crate::scene::formula::Formula;
use crate::scene::own::OwnPotential;
use crate::scene::pairs::PairEnergy;
use crate::scene::parameters::values;
use crate::texts::error::Error;

/// H = T(p) + U(q) and the state at t = 0, all exact.
#[derive(Debug)]
pub struct InitialValueProblem {
    /// U(q)
    pub potential: PotentialEnergy,
    /// T(p)
    pub kinetic: KineticEnergy,
    /// Parameters of the shipped problem, or those with which the formulas were read: names and values.
    pub parameters: Vec<(String, Exact)>,
    /// Names of q_1, q_2, ….
    pub coordinates: Vec<String>,
    /// Names of p_1, p_2, ….
    pub momenta: Vec<String>,
    /// Positions at t = 0.
    pub q: Vec<Exact>,
    /// Momenta at t = 0.
    pub p: Vec<Exact>,
    /// Whether H depends on t: then t and p_t are the last of each, and T + p_t is moved.
    pub explicit_time: bool,
}

/// U(q)
#[derive(Debug)]
pub enum PotentialEnergy {
    /// That of a shipped problem.
    Shipped(Setup),
    /// A formula in the coordinates and parameters.
    Formula(Formula<FormulaPotential<f64>>),
    /// A sum over pairs of bodies.
    Pairs(PairEnergy),
    /// A potential of the caller, in double precision.
    Own(Box<dyn OwnPotential>),
    /// None: H is given by the formulas of its parts.
    OfParts,
}

/// T(p)
#[derive(Debug)]
pub enum KineticEnergy {
    /// One for each coordinate, unless all are 1.
    Masses(Option<Vec<Exact>>),
    /// A formula in the momenta and parameters.
    Formula(Formula<FormulaKinetic<f64>>),
}

/// H of the positions and momenta that it gets.
pub type EnergyAt<N> = Box<dyn FnMut(&[N], &[N]) -> N>;

/// H of a system at other states.
pub(crate) fn energy_of<M: System + 'static>(mut system: M) -> EnergyAt<M::Number> {
    let zero = M::Number::zero(&system.state().context());
    Box::new(move |q, p| {
        let mut energy = zero.clone();
        system.assign_energy(Some((q, p)), &mut energy);
        energy
    })
}

/// A kinetic energy with its class, which decides about the schemes that move it.
pub(crate) enum ClassifiedKinetic<N> {
    Quadratic(Box<dyn Kinetic<N, Class = Quadratic>>),
    General(Box<dyn Kinetic<N, Class = General>>),
}

impl<N: Number + 'static> ClassifiedKinetic<N> {
    /// T(p) + p_t
    pub(crate) fn with_time(self) -> Self {
        match self {
            ClassifiedKinetic::Quadratic(kinetic) => ClassifiedKinetic::Quadratic(Box::new(WithTime(kinetic))),
            ClassifiedKinetic::General(kinetic) => ClassifiedKinetic::General(Box::new(WithTime(kinetic))),
        }
    }
}

impl PotentialEnergy {
    /// The sum over pairs of bodies, if it is one.
    pub(crate) fn pairs(&self) -> Option<&PairEnergy> {
        match self {
            PotentialEnergy::Pairs(pairs) => Some(pairs),
            _ => None,
        }
    }
}

impl InitialValueProblem {
    /// A shipped problem at its initial state.
    pub(crate) fn of_setup(setup: Setup) -> Self {
        let values = &setup.values;
        let (coordinates, q) = values.positions().iter().cloned().unzip();
        let (momenta, p) = values.momenta().iter().cloned().unzip();
        let parameters = setup.problem.description().parameters.len();
        InitialValueProblem {
            parameters: values.named()[..parameters].to_vec(),
            kinetic: KineticEnergy::Masses(values.masses().map(<[_]>::to_vec)),
            potential: PotentialEnergy::Shipped(setup),
            coordinates,
            momenta,
            q,
            p,
            explicit_time: false,
        }
    }

    /// Positions and momenta at t = 0.
    pub(crate) fn initial<N: Number>(&self, context: &N::Context) -> (Vec<N>, Vec<N>) {
        let numbers = |values: &[Exact]| values.iter().map(|v| N::from_rational(&v.value, context)).collect();
        (numbers(&self.q), numbers(&self.p))
    }

    /// U(q)
    pub(crate) fn potential<N: Number + 'static>(&self, context: &N::Context) -> Box<dyn Potential<N>> {
        self.in_numbers(&self.potential, context)
    }

    /// A potential in the coordinates and parameters of the problem.
    pub(crate) fn in_numbers<N: Number + 'static>(
        &self,
        potential: &PotentialEnergy,
        context: &N::Context,
    ) -> Box<dyn Potential<N>> {
        match potential {
            PotentialEnergy::Shipped(setup) => setup.potential(context),
            PotentialEnergy::Formula(formula) => {
                Box::new(formula.meaning().in_numbers(values(&self.parameters, context)))
            }
            PotentialEnergy::Pairs(pairs) => pairs.potential(&self.parameters, context),
            PotentialEnergy::Own(own) => own.in_numbers(),
            PotentialEnergy::OfParts => unreachable!("H is not T(p) + U(q)"),
        }
    }

    /// Whether each body has energies beside those of pairs.
    pub(crate) fn has_energies_of_bodies(&self) -> bool {
        self.potential.pairs().is_some_and(|pairs| !pairs.of_bodies.is_empty())
    }

    /// The part of U beside the attraction of bodies, if there is one; of all bodies, or of those with mass alone.
    pub(crate) fn beside<N: Number + 'static>(
        &self,
        with_particles: bool,
        context: &N::Context,
    ) -> Option<Box<dyn Potential<N>>> {
        self.potential.pairs()?.beside(with_particles, &self.parameters, context)
    }

    /// T(p), or T(p) + p_t
    pub(crate) fn kinetic<N: Number + 'static>(&self, context: &N::Context) -> ClassifiedKinetic<N> {
        let kinetic = self.kinetic_without_time(context);
        if self.explicit_time { kinetic.with_time() } else { kinetic }
    }

    /// T(p)
    pub(crate) fn kinetic_without_time<N: Number + 'static>(&self, context: &N::Context) -> ClassifiedKinetic<N> {
        match &self.kinetic {
            KineticEnergy::Masses(None) => self.of_masses(UnitMasses),
            KineticEnergy::Masses(Some(masses)) => {
                let masses: Vec<Rational> = masses.iter().map(|mass| mass.value.clone()).collect();
                self.of_masses(DiagonalMasses::new(&masses, context).expect("the masses were read with the scene"))
            }
            KineticEnergy::Formula(formula) => {
                match formula.meaning().in_numbers(values(&self.parameters, context)).into_quadratic() {
                    Ok(quadratic) => ClassifiedKinetic::Quadratic(Box::new(quadratic)),
                    Err(general) => ClassifiedKinetic::General(Box::new(general)),
                }
            }
        }
    }

    /// T by masses, in which particles have those of their momenta, 1.
    pub(crate) fn of_masses<N: Number>(
        &self,
        kinetic: impl Kinetic<N, Class = Quadratic> + 'static,
    ) -> ClassifiedKinetic<N> {
        ClassifiedKinetic::Quadratic(match self.particles() {
            0 => Box::new(kinetic),
            _ => Box::new(WithParticles::new(kinetic, self.massive_coordinates())),
        })
    }

    /// How many bodies are of mass 0: the last ones.
    pub(crate) fn particles(&self) -> usize {
        self.potential.pairs().map_or(0, |pairs| pairs.particles)
    }

    /// How many of the first coordinates have an energy.
    pub(crate) fn massive_coordinates(&self) -> usize {
        self.q.len() - self.potential.pairs().map_or(0, |pairs| pairs.particles * pairs.dimensions)
    }

    /// Every parameter and initial value with its name.
    pub fn named(&self) -> impl Iterator<Item = (&String, &Exact)> {
        let parameters = self.parameters.iter().map(|(name, exact)| (name, exact));
        parameters.chain(self.coordinates.iter().zip(&self.q)).chain(self.momenta.iter().zip(&self.p))
    }

    /// The names of the columns of q and p: t has its column already.
    pub fn columns(&self) -> impl Iterator<Item = &String> {
        self.coordinates.iter().take(self.coordinates_of_columns()).chain(&self.momenta)
    }

    /// The number of coordinates that have a column of their own.
    pub fn coordinates_of_columns(&self) -> usize {
        self.coordinates.len() - usize::from(self.explicit_time)
    }

    /// The masses of the coordinates, t excepted; of a system whose T is given by them. Those of particles are 1, by
    /// which their momenta are velocities.
    pub(crate) fn exact_masses(&self) -> Vec<Rational> {
        match &self.kinetic {
            KineticEnergy::Masses(Some(masses)) => masses.iter().map(|mass| mass.value.clone()).collect(),
            _ => vec![Rational::from_integer(1.into()); self.coordinates_of_columns()],
        }
    }

    /// T(p) + U(q)
    pub(crate) fn plain_energy<N: Number + 'static>(&self, context: &N::Context) -> EnergyAt<N> {
        const READ: &str = "the dimensions were read with the system";
        let zeros = || vec![N::zero(context); self.q.len()];
        let (q, p) = (zeros(), zeros());
        let potential = self.potential(context);
        match self.kinetic(context) {
            ClassifiedKinetic::Quadratic(kinetic) => {
                energy_of(Motion::of_any_energy(potential, kinetic, q, p).expect(READ))
            }
            ClassifiedKinetic::General(kinetic) => {
                energy_of(Motion::of_any_energy(potential, kinetic, q, p).expect(READ))
            }
        }
    }

    /// The shipped problem at this initial state; `None` for another system.
    pub fn setup(&self) -> Option<Setup> {
        let PotentialEnergy::Shipped(setup) = &self.potential else { return None };
        let names = setup.values.positions().iter().chain(setup.values.momenta()).map(|(name, _)| name.clone());
        let values = self.q.iter().chain(&self.p).map(|exact| to_text(&exact.value));
        let parameters = self.parameters.iter().map(|(name, exact)| (name.clone(), to_text(&exact.value)));
        // exact texts: no digits are lost
        setup.problem.setup(&parameters.chain(names.zip(values)).collect::<Vec<_>>(), 1).ok()
    }

    /// Whether the system can be computed in a number type: a potential of the caller is in double precision.
    ///
    /// # Errors
    /// More digits.
    pub fn check_digits(&self, arithmetic: Arithmetic) -> Result<(), Error> {
        match self.potential {
            PotentialEnergy::Own(_) if arithmetic.is_longer_than_double() => Err(Error::usage(
                format!("a function that computes forces has double precision, not {}", arithmetic.described()),
                "write the potential as a formula, which has any number of digits",
            )),
            _ => Ok(()),
        }
    }

    /// Whether T is at most quadratic in p.
    pub(crate) fn has_quadratic_kinetic(&self) -> bool {
        match &self.kinetic {
            KineticEnergy::Masses(_) => true,
            KineticEnergy::Formula(formula) => formula.meaning().is_quadratic(),
        }
    }
}
