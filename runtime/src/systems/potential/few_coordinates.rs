//! Steps of a few coordinates, held in registers, for a potential behind a `dyn`.

use std::array;
use std::fmt;
use std::mem::{needs_drop, size_of};

use crate::number::Number;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::InverseMasses;
use crate::systems::maps::{MapKind, Repeated};
use crate::systems::summation::{Plain, Summation};
use crate::systems::system::Visitor;
use crate::systems::turn::{InTurns, Turn, advance_in_turns};

/// Steps of one or several systems H = ½pᵀM⁻¹p + U(q) with at most three coordinates and a diagonal M, for
/// [`Potential::advance_few`](super::Potential::advance_few).
///
/// A step in which the potential and the masses are each behind a `dyn` passes q, p and U_q through memory between its
/// maps. Here one call makes many steps, compiled for the type of the potential, so that these stay in registers. The
/// bits are the same as with the maps one by one.
pub struct FewCoordinates<'a, N> {
    pub(crate) systems: Vec<FewOfSystem<'a, N>>,
    pub(crate) maps: [Repeated<N>; 3],
    /// Sees the state of the one system after each step, in the order of steps.
    pub(crate) visitor: Option<&'a mut dyn Visitor<N>>,
}

/// A system but for its potential.
pub(crate) struct FewOfSystem<'a, N> {
    /// q, p and U_q.
    pub(crate) state: [&'a mut [N]; 3],
    pub(crate) inverse_masses: InverseMasses<'a, N>,
    /// The potential's.
    pub(crate) scratch: &'a mut Vec<N>,
    /// What is kept at q.
    pub(crate) kept: &'a mut KeptForce,
    /// Evaluations of the gradient.
    pub(crate) evaluations: &'a mut u64,
}

impl<N: fmt::Debug> fmt::Debug for FewCoordinates<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let states: Vec<_> = self.systems.iter().map(|system| &system.state).collect();
        f.debug_struct("FewCoordinates").field("states", &states).field("maps", &self.maps).finish_non_exhaustive()
    }
}

/// The gradient of a potential at q.
pub trait Evaluate<N, P: ?Sized>: Fn(&mut P, &[N], &mut [N], &mut [N]) + Copy {}

impl<N, P: ?Sized, F: Fn(&mut P, &[N], &mut [N], &mut [N]) + Copy> Evaluate<N, P> for F {}

/// More coordinates are not held in registers.
const MOST: usize = 3;

/// States that are visited at once: the state of the steps leaves the registers only then, and the processor makes the
/// next steps meanwhile.
const AT_ONCE: usize = 16;

impl<N: Number> FewCoordinates<'_, N> {
    /// Whether registers hold such numbers: of others these steps are not even compiled.
    pub(crate) const FIT: bool = !needs_drop::<N>() && (Self::IN_LANES || size_of::<N>() <= size_of::<f64>());

    /// Numbers of which there are several systems.
    const IN_LANES: bool = N::LANES > 1 && !N::HAS_DERIVATIVES;

    /// Whether this makes the steps of this number of systems of this dimension.
    pub(crate) fn can_hold(systems: usize, dimension: usize) -> bool {
        Self::FIT && (Self::IN_LANES || systems == 1) && (1..=MOST).contains(&dimension)
    }

    /// Makes the steps with these potentials of this dimension, one of each system; `evaluate` computes the gradient of
    /// one, with scratch space.
    ///
    /// # Panics
    /// If they are not as many as the systems, or of more than three coordinates.
    #[inline(always)]
    pub fn advance<P: ?Sized>(&mut self, dimension: usize, potentials: Vec<&mut P>, evaluate: impl Evaluate<N, P>) {
        if const { Self::FIT } {
            match dimension {
                1 => self.advance_in_arrays::<1, P>(potentials, evaluate),
                2 => self.advance_in_arrays::<2, P>(potentials, evaluate),
                3 => self.advance_in_arrays::<3, P>(potentials, evaluate),
                more => unreachable!("{more} coordinates are more than {MOST}"),
            }
        }
    }

    #[inline(always)]
    fn advance_in_arrays<const D: usize, P: ?Sized>(&mut self, potentials: Vec<&mut P>, evaluate: impl Evaluate<N, P>) {
        if const { Self::IN_LANES } {
            // the masses as a constant: so each loop is compiled without branches
            return match self.systems.iter().all(|system| matches!(system.inverse_masses, InverseMasses::Ones)) {
                true => self.advance_in_turns::<D, true, P>(potentials, evaluate),
                false => self.advance_in_turns::<D, false, P>(potentials, evaluate),
            };
        }
        let [potential] = potentials.try_into().unwrap_or_else(|_| unreachable!("there is one system"));
        self.advance_in_registers::<D, P>(potential, evaluate);
    }

    /// Of lanes the systems take turns.
    #[inline(always)]
    fn advance_in_turns<const D: usize, const ONES: bool, P: ?Sized>(
        &mut self,
        potentials: Vec<&mut P>,
        evaluate: impl Evaluate<N, P>,
    ) {
        let systems = self.systems.iter_mut().zip(potentials);
        let systems = systems.map(|(few, potential)| InArrays::<D, ONES, N, P>::of(few, potential)).collect();
        let mut systems = AllInArrays { systems, evaluate };
        advance_in_turns(&mut systems, &self.maps);
        systems.systems.into_iter().for_each(InArrays::put_back);
    }

    #[inline(always)]
    fn advance_in_registers<const D: usize, P: ?Sized>(&mut self, potential: &mut P, evaluate: impl Evaluate<N, P>) {
        let FewCoordinates { systems, maps, visitor } = self;
        let [FewOfSystem { state, inverse_masses, scratch, kept, evaluations }] = &mut systems[..] else {
            unreachable!("there is one system")
        };
        let copy = |from: &[N]| -> [N; D] { from.first_chunk().expect(DIMENSION).clone() };
        let [mut q, mut p, mut gradient] = [copy(state[0]), copy(state[1]), copy(state[2])];
        let mut velocity = p[0].clone();
        let (mut has_gradient, mut evaluated) = (**kept != KeptForce::Nothing, 0);
        let mut made: [[[N; D]; 2]; AT_ONCE] = array::from_fn(|_| [q.clone(), p.clone()]);
        let mut unvisited = 0;
        for (maps, times) in maps {
            for _ in 0..*times {
                for (kind, weight) in &*maps {
                    if *kind == MapKind::Drift {
                        inverse_masses.drift(weight, &p, &mut q, &mut velocity);
                        has_gradient = false;
                        continue;
                    }
                    if !has_gradient {
                        evaluate(potential, &q, &mut gradient, scratch);
                        has_gradient = true;
                        evaluated += 1;
                    }
                    Plain.kick(weight, &gradient, &mut p);
                }
                if let Some(visitor) = visitor {
                    made[unvisited] = [q.clone(), p.clone()];
                    unvisited += 1;
                    if unvisited == AT_ONCE {
                        visitor.visit_each(made.as_flattened().as_flattened(), D);
                        unvisited = 0;
                    }
                }
            }
        }
        if let Some(visitor) = visitor {
            visitor.visit_each(made[..unvisited].as_flattened().as_flattened(), D);
        }
        **kept = if has_gradient { KeptForce::Gradient } else { KeptForce::Nothing };
        **evaluations += evaluated;
        for (into, from) in state.iter_mut().zip([&q, &p, &gradient]) {
            into.clone_from_slice(from);
        }
    }
}

const DIMENSION: &str = "there are D coordinates";

/// A system with its potential, whose state is in arrays.
struct InArrays<'s, 'm, const D: usize, const ONES: bool, N, P: ?Sized> {
    potential: &'s mut P,
    /// q, p and U_q.
    state: [[N; D]; 3],
    evaluated: u64,
    velocity: [N; 1],
    system: &'s mut FewOfSystem<'m, N>,
}

impl<'s, 'm, const D: usize, const ONES: bool, N: Number, P: ?Sized> InArrays<'s, 'm, D, ONES, N, P> {
    fn of(system: &'s mut FewOfSystem<'m, N>, potential: &'s mut P) -> Self {
        let state = system.state.each_ref().map(|from| from.first_chunk().expect(DIMENSION).clone());
        let velocity = [system.state[0][0].clone()];
        InArrays { potential, state, evaluated: 0, velocity, system }
    }

    fn put_back(self) {
        for (own, made) in self.system.state.iter_mut().zip(&self.state) {
            own.clone_from_slice(made);
        }
        *self.system.evaluations += self.evaluated;
    }
}

struct AllInArrays<'s, 'm, const D: usize, const ONES: bool, N, P: ?Sized, E> {
    systems: Vec<InArrays<'s, 'm, D, ONES, N, P>>,
    evaluate: E,
}

impl<const D: usize, const ONES: bool, N: Number, P: ?Sized, E: Evaluate<N, P>> InTurns<N>
    for AllInArrays<'_, '_, D, ONES, N, P, E>
{
    const IN_REGISTERS: bool = true;

    #[inline(always)]
    fn advance(&mut self, turn: &Turn<'_, N>) {
        for InArrays { potential, state: [q, p, gradient], evaluated, velocity, system } in &mut self.systems {
            let FewOfSystem { inverse_masses, scratch, kept, .. } = &mut **system;
            if turn.has_kick() && **kept == KeptForce::Nothing {
                (self.evaluate)(potential, q, gradient, scratch);
                **kept = KeptForce::Gradient;
                *evaluated += 1;
            }
            // a copy, which the compiler can hold in registers
            let mut copy = p.clone();
            turn.kick(&mut Plain, &mut copy, gradient);
            let mut inverse_masses = if ONES { InverseMasses::Ones } else { *inverse_masses };
            turn.drift(&mut Plain, (&mut inverse_masses, velocity), (q, &copy), kept);
            *p = copy;
        }
    }
}
