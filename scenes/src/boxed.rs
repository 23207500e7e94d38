//! A system of any kind as one type, so that what is done with it is compiled once.

use shadowstep::kinetic::{General, Quadratic};
use shadowstep::many_parts::ManyParts;
use shadowstep::scheme::PartOrder;
use shadowstep::{Increments, Number, Remainders, System};

/// A system with flows of its own.
///
/// It has the class of quadratic T whatever the class of its system is: the scheme was checked when the scene was read.
pub(crate) enum Boxed<N> {
    /// A system for schemes for quadratic T.
    Quadratic(Box<dyn System<Number = N, Class = Quadratic>>),
    /// A system for schemes for every T(p), or every H = A + B.
    General(Box<dyn System<Number = N, Class = General>>),
    /// A system of three parts and more.
    ManyParts(Box<dyn System<Number = N, Class = ManyParts>>),
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

    fn q(&self) -> &[N] {
        of!(self, system => system.q())
    }
    fn p(&self) -> &[N] {
        of!(self, system => system.p())
    }
    fn increments(&self) -> Increments<'_, N> {
        of!(self, system => system.increments())
    }
    fn set_state(&mut self, q: &[N], p: &[N]) {
        of!(self, system => system.set_state(q, p));
    }
    fn remainders(&self) -> Remainders<N> {
        of!(self, system => system.remainders())
    }
    fn set_remainders(&mut self, remainders: &Remainders<N>) {
        of!(self, system => system.set_remainders(remainders));
    }
    fn is_compensated(&self) -> bool {
        of!(self, system => system.is_compensated())
    }
    fn kick(&mut self, weight: &N) {
        of!(self, system => system.kick(weight));
    }
    fn kick_augmented(&mut self, weight: &N) {
        of!(self, system => system.kick_augmented(weight));
    }
    fn drift(&mut self, weight: &N) {
        of!(self, system => system.drift(weight));
    }
    fn drift_augmented(&mut self, weight: &N) {
        of!(self, system => system.drift_augmented(weight));
    }
    fn middle_parts(&mut self, weight: &N, order: PartOrder) {
        of!(self, system => system.middle_parts(weight, order));
    }
    fn middle_parts_augmented(&mut self, weight: &N, order: PartOrder) {
        of!(self, system => system.middle_parts_augmented(weight, order));
    }
    fn has_gradient_kicks(&self) -> bool {
        of!(self, system => system.has_gradient_kicks())
    }
    fn gradient_kick(&mut self, weight: &N) {
        of!(self, system => system.gradient_kick(weight));
    }
    fn gradient_kick_augmented(&mut self, weight: &N) {
        of!(self, system => system.gradient_kick_augmented(weight));
    }
    fn clear_increments(&mut self) {
        of!(self, system => system.clear_increments());
    }
    fn assign_energies(&mut self, energy: &mut N, kinetic: &mut N) {
        of!(self, system => system.assign_energies(energy, kinetic));
    }
    fn assign_energies_at(&mut self, q: &[N], p: &[N], energy: &mut N, kinetic: &mut N) {
        of!(self, system => system.assign_energies_at(q, p, energy, kinetic));
    }
    fn evaluations(&self) -> u64 {
        of!(self, system => system.evaluations())
    }
    fn before_augmented_step(&mut self, follows: bool) {
        of!(self, system => system.before_augmented_step(follows));
    }
}
