//! A system of any kind as one type, so that what is done with it is compiled once.

use shadowstep::kinetic::{General, Quadratic};
use shadowstep::many_parts::ManyParts;
use shadowstep::scheme::PartOrder;
use shadowstep::summation::Compensated;
use shadowstep::{Carried, Number, System, VectorState};

/// A system whose coordinates are vectors and whose sums are plain or compensated.
type Dynamic<N, Class> = Box<dyn System<Number = N, Class = Class, Coordinates = Vec<N>, Summation = Sums<N>>>;

/// Sums that are compensated or not.
type Sums<N> = Option<Compensated<N, Vec<N>>>;

/// A system with flows of its own.
///
/// It has the class of quadratic T whatever the class of its system is: the scheme was checked when the scene was read.
pub(crate) enum Boxed<N: Number> {
    /// A system for schemes for quadratic T.
    Quadratic(Dynamic<N, Quadratic>),
    /// A system for schemes for every T(p), or every H = A + B.
    General(Dynamic<N, General>),
    /// A system of three parts and more.
    ManyParts(Dynamic<N, ManyParts>),
}

/// Calls a method of the system inside.
macro_rules! of {
    ($system:expr, $inner:ident => $call:expr) => {
        match $system {
            Boxed::Quadratic($inner) => $call,
            Boxed::General($inner) => $call,
            Boxed::ManyParts($inner) => $call,
        }
    };
}

impl<N: Number> System for Boxed<N> {
    type Number = N;
    type Class = Quadratic;
    type Coordinates = Vec<N>;
    type Summation = Sums<N>;

    fn state(&self) -> &VectorState<N> {
        of!(self, system => system.state())
    }
    fn state_mut(&mut self) -> &mut VectorState<N> {
        of!(self, system => system.state_mut())
    }
    fn clear_increments(&mut self) {
        of!(self, system => system.clear_increments());
    }
    fn kick(&mut self, weight: &N, carried: Carried) {
        of!(self, system => system.kick(weight, carried));
    }
    fn drift(&mut self, weight: &N, carried: Carried) {
        of!(self, system => system.drift(weight, carried));
    }
    fn middle_parts(&mut self, weight: &N, order: PartOrder, carried: Carried) {
        of!(self, system => system.middle_parts(weight, order, carried));
    }
    fn has_gradient_kicks(&self) -> bool {
        of!(self, system => system.has_gradient_kicks())
    }
    fn gradient_kick(&mut self, weight: &N, carried: Carried) {
        of!(self, system => system.gradient_kick(weight, carried));
    }
    fn assign_energies(&mut self, at: Option<(&[N], &[N])>, energy: &mut N, kinetic: &mut N) {
        of!(self, system => system.assign_energies(at, energy, kinetic));
    }
}
