//! The energy of a pair of bodies from a formula read at run time.

use shadowstep_schemes::symbolic::{Graph, Separation, Summand, parse};

use super::newest::{Derived, Role, Text, derived};
use super::{FormulaError, refuse_repeated};
use std::slice::from_ref;
use std::sync::{Arc, OnceLock};

use crate::Rational;
use crate::number::Number;
use crate::systems::interpreter::Interpreter;
use crate::systems::pairs::{BLOCK, BLOCKS_AT_ONCE, Pair, PairCurvature, PairPotential};

/// The energy of a pair of bodies whose operations are carried out one by one from a list: the twin of a `pair` formula
/// in [`crate::potential!`], with the same bits.
///
/// ```
/// use shadowstep::{Potential, systems::formula::FormulaPair, systems::pairs::{Pairs, Separation}};
///
/// let gravity = "-g * m_i * m_j / sqrt(r2)";
/// let (masses, g) = (("m", vec![4.0, 2.0]), ("g", 1.0));
/// let pair = FormulaPair::new(gravity, Separation::SquaredDistance, &[masses], &[g]).unwrap();
/// let gravity = Pairs::<_, 2>::all(2, pair).unwrap();
/// assert_eq!(Potential::<f64>::dimension(&gravity), 4);
/// ```
#[derive(Clone, Debug)]
pub struct FormulaPair<N> {
    separation: Separation,
    /// The values of each property for all bodies.
    properties: Vec<Vec<N>>,
    /// The properties in the order in which the formula has them: of i, then of j.
    interpreter: Interpreter<N>,
    parameters: Vec<N>,
    derived: Arc<Derived>,
    /// The interpreter of the second derivatives, made when gradient kicks need them.
    second: OnceLock<Interpreter<N>>,
}

impl<N: Number> FormulaPair<N> {
    /// The energy of a formula in `r2` or `d`, in which the property `m` of the bodies i < j is called `m_i` and `m_j`;
    /// with the values of each property for all bodies, and the values of parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula, unknown or repeated names, functions that are not smooth.
    pub fn new(
        formula: &str,
        separation: Separation,
        properties: &[(&str, Vec<N>)],
        parameters: &[(&str, N)],
    ) -> Result<Self, FormulaError> {
        let of = |body: &'static str| properties.iter().map(move |(name, _)| format!("{name}_{body}"));
        let text = Text {
            formula: formula.to_owned(),
            variables: of("i").chain(of("j")).collect(),
            parameters: parameters.iter().map(|(name, _)| (*name).to_owned()).collect(),
            role: Role::Pair(separation),
        };
        let derived = derived::<FormulaError>(text, |Text { formula, variables, parameters, .. }| {
            let expression = parse(formula)?;
            refuse_repeated([separation.name().to_owned()].iter().chain(variables).chain(parameters))?;
            let mut graph = Graph::new();
            let energy = graph.build_pair(&expression, separation.name(), variables, parameters);
            let node = energy.map_err(FormulaError::Meaning)?;
            let programs = graph.pair(node, separation);
            Ok(Derived { programs, quadratic: false, quadratic_form: false, graph, node, second: OnceLock::new() })
        })?;
        let properties = properties.iter().map(|(_, values)| values.clone()).collect();
        let parameters = parameters.iter().map(|(_, value)| value.clone()).collect();
        Ok(FormulaPair::of(derived, separation, properties, parameters))
    }

    fn of(derived: Arc<Derived>, separation: Separation, properties: Vec<Vec<N>>, parameters: Vec<N>) -> Self {
        let interpreter = Interpreter::new(&derived.programs, parameters.clone(), 2 * properties.len());
        FormulaPair { separation, properties, interpreter, parameters, derived, second: OnceLock::new() }
    }

    /// The same formula in other numbers, with the values of its properties and parameters in their order.
    ///
    /// # Panics
    /// If there are not values for each property and parameter.
    pub fn in_numbers<M: Number>(&self, properties: Vec<Vec<M>>, parameters: Vec<M>) -> FormulaPair<M> {
        assert_eq!(properties.len(), self.properties.len(), "each property has values");
        assert_eq!(parameters.len(), self.parameters.len(), "each parameter has a value");
        FormulaPair::of(Arc::clone(&self.derived), self.separation, properties, parameters)
    }

    /// The numbers in the formula.
    pub fn numbers(&self) -> Vec<&Rational> {
        self.derived.numbers()
    }

    /// Puts the properties of i and j where the programs find them.
    fn place_properties(&self, i: usize, j: usize, scratch: &mut [N]) {
        self.place(i, j, self.interpreter.properties(scratch, 1));
    }

    fn place(&self, i: usize, j: usize, places: &mut [N]) {
        let of = |body: usize| self.properties.iter().map(move |values| &values[body]);
        for (place, property) in places.iter_mut().zip(of(i).chain(of(j))) {
            place.assign(property);
        }
    }

    /// The registers of blocks of this length, with the properties of the bodies i and j of each place; none where
    /// blocks have another length.
    #[inline(always)]
    fn blocks<'s, const W: usize>(
        &self,
        count: usize,
        bodies: impl Fn(usize) -> [usize; 2],
        scratch: &'s mut [N],
    ) -> Option<&'s mut [[N; W]]> {
        if W != BLOCK || !N::IN_VECTORS {
            return None;
        }
        let (blocks, _) = scratch[self.interpreter.registers()..].as_chunks_mut::<W>();
        let places = self.interpreter.properties(blocks, BLOCKS_AT_ONCE);
        let (of_i, of_j) = places.split_at_mut(BLOCKS_AT_ONCE * self.properties.len());
        let each = of_i.chunks_exact_mut(BLOCKS_AT_ONCE).zip(of_j.chunks_exact_mut(BLOCKS_AT_ONCE));
        for ((of_i, of_j), values) in each.zip(&self.properties) {
            for (block, (of_i, of_j)) in of_i[..count].iter_mut().zip(&mut of_j[..count]).enumerate() {
                let bodies: [[usize; 2]; W] = std::array::from_fn(|l| bodies(block * W + l));
                *of_i = std::array::from_fn(|l| values[bodies[l][0]].clone());
                *of_j = std::array::from_fn(|l| values[bodies[l][1]].clone());
            }
        }
        Some(blocks)
    }

    fn second(&self) -> &Interpreter<N> {
        self.second.get_or_init(|| {
            let second = self.derived.second(|graph, node| graph.pair_curvature(node, self.separation));
            Interpreter::new(second, self.parameters.clone(), 2 * self.properties.len())
        })
    }
}

impl<N> Pair for FormulaPair<N> {
    fn separation(&self) -> Separation {
        self.separation
    }

    fn summand(&self) -> Summand {
        self.derived.programs.summand
    }

    fn properties(&self) -> Vec<usize> {
        self.properties.iter().map(Vec::len).collect()
    }
}

impl<N: Number> PairPotential<N> for FormulaPair<N> {
    const SEVERAL_BLOCKS: bool = true;

    fn scratch(&self) -> usize {
        let registers = self.interpreter.registers();
        if N::IN_VECTORS { registers * (1 + BLOCKS_AT_ONCE * BLOCK) } else { registers }
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let (registers, blocks) = scratch.split_at_mut(self.interpreter.registers());
        self.interpreter.prepare(registers, context);
        for (of_blocks, register) in blocks.chunks_exact_mut(BLOCKS_AT_ONCE * BLOCK).zip(registers) {
            of_blocks.fill(register.clone());
        }
    }

    fn energy(&self, i: usize, j: usize, x: &N, energy: &mut N, scratch: &mut [N]) {
        self.place_properties(i, j, scratch);
        std::mem::swap(energy, self.interpreter.energy(from_ref(x), scratch));
    }

    fn slope(&self, i: usize, j: usize, x: &N, slope: &mut N, scratch: &mut [N]) {
        self.place_properties(i, j, scratch);
        std::mem::swap(slope, &mut self.interpreter.gradient(from_ref(x), scratch)[0]);
    }

    fn slope_and_summand(&self, i: usize, j: usize, x: &N, slope: &mut N, summand: &mut N, scratch: &mut [N]) {
        self.place_properties(i, j, scratch);
        let outputs = self.interpreter.gradient_and_rate(from_ref(x), scratch);
        std::mem::swap(slope, &mut outputs[0]);
        std::mem::swap(summand, &mut outputs[1]);
    }

    fn curved(&self) -> Option<&dyn PairCurvature<N>> {
        Some(self)
    }

    #[inline]
    fn of_places<const W: usize, const FORCES: bool, const SUM: bool>(
        &self,
        bodies: impl Fn(usize) -> [usize; 2],
        x: &[[N; W]],
        slopes: &mut [[N; W]],
        summands: &mut [[N; W]],
        scratch: &mut [N],
    ) {
        if let Some(registers) = self.blocks::<W>(x.len(), &bodies, scratch) {
            let count = x.len();
            if !FORCES {
                summands[..count].swap_with_slice(&mut self.interpreter.energies(x, registers)[..count]);
            } else if SUM {
                let results = self.interpreter.slopes_and_summands(x, registers);
                let (of_slopes, of_summands) = results.split_at_mut(BLOCKS_AT_ONCE);
                slopes[..count].swap_with_slice(&mut of_slopes[..count]);
                summands[..count].swap_with_slice(&mut of_summands[..count]);
            } else {
                slopes[..count].swap_with_slice(&mut self.interpreter.slopes(x, registers)[..count]);
            }
            return;
        }
        let results = slopes.as_flattened_mut().iter_mut().zip(summands.as_flattened_mut());
        for (l, (x, (slope, summand))) in x.as_flattened().iter().zip(results).enumerate() {
            self.of_one::<FORCES, SUM>(bodies(l), x, slope, summand, scratch);
        }
    }
}

impl<N: Number> PairCurvature<N> for FormulaPair<N> {
    fn curvature_scratch(&self) -> usize {
        self.second().registers()
    }

    fn prepare_curvature(&self, scratch: &mut [N], context: &N::Context) {
        self.second().prepare(scratch, context);
    }

    fn curvature(&self, i: usize, j: usize, x: &N, slope: &mut N, curvature: &mut N, scratch: &mut [N]) {
        let second = self.second();
        self.place(i, j, second.properties(scratch, 1));
        let outputs = second.gradient(from_ref(x), scratch);
        std::mem::swap(slope, &mut outputs[0]);
        std::mem::swap(curvature, &mut outputs[1]);
    }

    fn curvature_and_rate(&self, i: usize, j: usize, x: &N, results: [&mut N; 3], scratch: &mut [N]) {
        let second = self.second();
        self.place(i, j, second.properties(scratch, 1));
        let outputs = second.gradient_and_rate(from_ref(x), scratch);
        results.into_iter().zip(outputs).for_each(|(result, output)| std::mem::swap(result, output));
    }
}
