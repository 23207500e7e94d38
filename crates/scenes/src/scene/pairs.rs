//! The energy of pairs of bodies by its formula.

use shadowstep::systems::formula::{FormulaOfBodies, FormulaPair};
use shadowstep::systems::pairs::{Cutoff, CutoffError, CutoffPairs, Ends, Pairs, PairsAndParticles};
use shadowstep::systems::potential::Sum;
use shadowstep::{Number, Potential};
use shadowstep_schemes::symbolic::Exact;

use crate::scene::formula::Formula;
use crate::scene::parameters::values;

const READ: &str = "the numbers of bodies and properties were read with the scene";

/// A function of the positions.
pub(crate) type OfPositions<N> = Box<dyn FnMut(&[N]) -> N>;

/// The energy of two bodies of [[body]].
pub(crate) const GRAVITY: &str = "-g*m_i*m_j/sqrt(r2)";

/// U = Σ u over all pairs of bodies, over those closer than a cutoff, or over those of neighbours in a chain.
#[derive(Debug)]
pub struct PairEnergy {
    /// u, in the separation, properties and parameters.
    pub formula: Formula<FormulaPair<f64>>,
    /// 1, 2 or 3.
    pub dimensions: usize,
    /// How many bodies there are.
    pub bodies: usize,
    /// How many of them are of mass 0, which is their only property: the last ones.
    pub particles: usize,
    /// Names, with a value for each body.
    pub properties: Vec<(String, Vec<Exact>)>,
    /// Those of a chain; none where all pairs interact.
    pub ends: Option<Ends>,
    /// Where the energy ends; none if all pairs interact, or those of a chain.
    pub(crate) cutoff: Option<Box<PairCutoff>>,
    /// Energies of each body beside those of pairs, of bodies whose first property is their mass.
    pub of_bodies: Vec<EnergyOfBodies>,
}

/// The sum over bodies of an energy of each.
pub(crate) type EnergyOfBodies = Formula<FormulaOfBodies<f64>>;

/// Up to where bodies interact.
#[derive(Debug)]
pub(crate) struct PairCutoff {
    /// The distance.
    pub radius: Exact,
    /// How the energy falls to 0; none if it ends abruptly.
    pub smooth: Option<SmoothEnd>,
    /// The sides of the box; none in open space.
    pub sides: Option<Vec<Exact>>,
}

/// How the energy of a pair falls to 0.
#[derive(Debug)]
pub(crate) struct SmoothEnd {
    /// The distance from which on it falls.
    pub from: Exact,
    /// How many derivatives are continuous.
    pub derivatives: u32,
}

impl PairCutoff {
    /// What is wrong with it.
    pub(crate) fn error(&self, dimensions: usize) -> Option<CutoffError> {
        match dimensions {
            1 => self.cutoff::<1>().err(),
            2 => self.cutoff::<2>().err(),
            _ => self.cutoff::<3>().err(),
        }
    }

    fn cutoff<const D: usize>(&self) -> Result<Cutoff<D>, CutoffError> {
        let mut cutoff = Cutoff::at(self.radius.value.clone())?;
        if let Some(SmoothEnd { from, derivatives }) = &self.smooth {
            cutoff = cutoff.switched(from.value.clone(), *derivatives)?;
        }
        match &self.sides {
            Some(sides) => cutoff.in_box(std::array::from_fn(|axis| sides[axis].value.clone())),
            None => Ok(cutoff),
        }
    }
}

impl PairEnergy {
    /// Whether the bodies are in a periodic box.
    pub(crate) fn is_in_box(&self) -> bool {
        self.cutoff.as_ref().is_some_and(|cutoff| cutoff.sides.is_some())
    }

    /// U, with properties and parameters rounded once.
    pub(crate) fn potential<N: Number + 'static>(
        &self,
        parameters: &[(String, Exact)],
        context: &N::Context,
    ) -> Box<dyn Potential<N>> {
        let Some(cutoff) = &self.cutoff else {
            return self.with_values(self.numbers(context), values(parameters, context));
        };
        let of_pairs: Box<dyn Potential<N>> = match self.dimensions {
            1 => Box::new(self.up_to::<N, 1>(cutoff, parameters, context)),
            2 => Box::new(self.up_to::<N, 2>(cutoff, parameters, context)),
            _ => Box::new(self.up_to::<N, 3>(cutoff, parameters, context)),
        };
        with_energies_beside(of_pairs, self.beside(true, parameters, context))
    }

    /// The properties in numbers of a run, each rounded once.
    fn numbers<N: Number>(&self, context: &N::Context) -> Vec<Vec<N>> {
        let number = |exact: &Exact| N::from_rational(&exact.value, context);
        self.properties.iter().map(|(_, values)| values.iter().map(number).collect()).collect()
    }

    /// U without a cutoff, with these values of properties and parameters, which may be in lanes.
    pub(crate) fn with_values<N: Number + 'static>(
        &self,
        properties: Vec<Vec<N>>,
        parameters: Vec<N>,
    ) -> Box<dyn Potential<N>> {
        let beside = self.beside_with(true, &properties, &parameters);
        let of_pairs = match self.dimensions {
            2 if self.particles > 0 => self.sum_with_particles::<N, 2>(properties, parameters),
            3 if self.particles > 0 => self.sum_with_particles::<N, 3>(properties, parameters),
            1 => self.sum::<N, 1>(properties, parameters),
            2 => self.sum::<N, 2>(properties, parameters),
            3 => self.sum::<N, 3>(properties, parameters),
            more => unreachable!("{more} dimensions are refused"),
        };
        with_energies_beside(of_pairs, beside)
    }

    /// The energies of each body beside those of pairs, if there are any; of all bodies, or of those with mass alone.
    pub(crate) fn beside<N: Number + 'static>(
        &self,
        with_particles: bool,
        parameters: &[(String, Exact)],
        context: &N::Context,
    ) -> Option<Box<dyn Potential<N>>> {
        self.beside_with(with_particles, &self.numbers(context), &values(parameters, context))
    }

    fn beside_with<N: Number + 'static>(
        &self,
        with_particles: bool,
        properties: &[Vec<N>],
        parameters: &[N],
    ) -> Option<Box<dyn Potential<N>>> {
        let energies = self.of_bodies.iter();
        let boxed = energies.map(|energy| -> Box<dyn Potential<N>> {
            let of_all = energy.meaning().in_numbers(&properties[0], parameters);
            Box::new(if with_particles { of_all } else { of_all.without_particles() })
        });
        boxed.reduce(|one, other| Box::new(Sum(one, other)))
    }

    /// The same of bodies and particles, which they attract.
    fn sum_with_particles<N: Number + 'static, const D: usize>(
        &self,
        mut properties: Vec<Vec<N>>,
        parameters: Vec<N>,
    ) -> Box<dyn Potential<N>> {
        let mut masses = properties.swap_remove(0);
        masses.truncate(self.bodies - self.particles);
        let (pair, context) = (self.formula.meaning(), masses[0].context());
        let pairs = PairsAndParticles::<FormulaPair<N>, D>::new(
            masses,
            self.particles,
            |masses| pair.in_numbers(vec![masses], parameters),
            &context,
        );
        Box::new(pairs.expect(READ))
    }

    fn sum<N: Number + 'static, const D: usize>(
        &self,
        properties: Vec<Vec<N>>,
        parameters: Vec<N>,
    ) -> Box<dyn Potential<N>> {
        let pair = self.formula.meaning().in_numbers(properties, parameters);
        let pairs = match self.ends {
            None => Pairs::<_, D>::all(self.bodies, pair),
            Some(ends) => Pairs::<_, D>::neighbours(self.bodies, pair, ends),
        };
        Box::new(pairs.expect(READ))
    }

    fn up_to<N: Number, const D: usize>(
        &self,
        cutoff: &PairCutoff,
        parameters: &[(String, Exact)],
        context: &N::Context,
    ) -> CutoffPairs<FormulaPair<N>, D> {
        let pair = self.formula.meaning().in_numbers(self.numbers(context), values(parameters, context));
        let cutoff = cutoff.cutoff::<D>().expect("the cutoff was read with the scene");
        CutoffPairs::new(self.bodies, pair, cutoff).expect(READ)
    }

    /// Computes the virial of bodies in a box, from positions; none in open space, where it is −qᵀU_q.
    pub(crate) fn virial_in_box<N: Number + 'static>(
        &self,
        parameters: &[(String, Exact)],
        context: &N::Context,
    ) -> Option<OfPositions<N>> {
        let cutoff = self.cutoff.as_ref().filter(|_| self.is_in_box())?;
        Some(match self.dimensions {
            1 => virial_of(self.up_to::<N, 1>(cutoff, parameters, context), context),
            2 => virial_of(self.up_to::<N, 2>(cutoff, parameters, context), context),
            _ => virial_of(self.up_to::<N, 3>(cutoff, parameters, context), context),
        })
    }
}

fn with_energies_beside<N: Number + 'static>(
    of_pairs: Box<dyn Potential<N>>,
    beside: Option<Box<dyn Potential<N>>>,
) -> Box<dyn Potential<N>> {
    match beside {
        Some(beside) => Box::new(Sum(of_pairs, beside)),
        None => of_pairs,
    }
}

fn virial_of<N: Number + 'static, const D: usize>(
    mut pairs: CutoffPairs<FormulaPair<N>, D>,
    context: &N::Context,
) -> OfPositions<N> {
    let zero = N::zero(context);
    let mut scratch = vec![zero.clone(); pairs.scratch()];
    pairs.prepare(&mut scratch, context);
    Box::new(move |q| {
        let mut virial = zero.clone();
        pairs.virial(q, &mut virial, &mut scratch);
        virial
    })
}
