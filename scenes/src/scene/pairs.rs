//! The energy of pairs of bodies by its formula.

use shadowstep::systems::formula::FormulaPair;
use shadowstep::systems::pairs::{Ends, Pairs};
use shadowstep::{Number, Potential};
use shadowstep_symbolic::Exact;

use crate::scene::formula::Formula;
use crate::scene::parameters::values;

/// U = Σ u over all pairs of bodies, or over those of neighbours in a chain.
#[derive(Debug)]
pub struct PairEnergy {
    /// u, in the separation, properties and parameters.
    pub formula: Formula<FormulaPair<f64>>,
    /// 1, 2 or 3.
    pub dimensions: usize,
    /// How many bodies there are.
    pub bodies: usize,
    /// Names, with a value for each body.
    pub properties: Vec<(String, Vec<Exact>)>,
    /// Those of a chain; none where all pairs interact.
    pub ends: Option<Ends>,
}

impl PairEnergy {
    /// U, with properties and parameters rounded once.
    pub(crate) fn potential<N: Number + 'static>(
        &self,
        parameters: &[(String, Exact)],
        context: &N::Context,
    ) -> Box<dyn Potential<N>> {
        let number = |exact: &Exact| N::from_rational(&exact.value, context);
        let properties = self.properties.iter().map(|(_, values)| values.iter().map(number).collect()).collect();
        self.of_pair(self.formula.meaning().in_numbers(properties, values(parameters, context)))
    }

    /// U of the pair's energy.
    pub(crate) fn of_pair<N: Number + 'static>(&self, pair: FormulaPair<N>) -> Box<dyn Potential<N>> {
        match self.dimensions {
            1 => self.sum::<N, 1>(pair),
            2 => self.sum::<N, 2>(pair),
            3 => self.sum::<N, 3>(pair),
            more => unreachable!("{more} dimensions are refused"),
        }
    }

    fn sum<N: Number + 'static, const D: usize>(&self, pair: FormulaPair<N>) -> Box<dyn Potential<N>> {
        let pairs = match self.ends {
            None => Pairs::<_, D>::all(self.bodies, pair),
            Some(ends) => Pairs::<_, D>::neighbours(self.bodies, pair, ends),
        };
        Box::new(pairs.expect("the numbers of bodies and properties were read with the scene"))
    }
}
