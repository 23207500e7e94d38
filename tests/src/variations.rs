//! How much energies vary over a run.

use shadowstep::number::Real;
use shadowstep::shadow::Bilinear;
use shadowstep::shadow::run::energy_drift;
use shadowstep::{Scheme, Stepper, System, ValidFor};

/// max − min of H over some steps and the start.
pub fn of_energy<S, M>(stepper: &Stepper<S, M::Number>, mut system: M, steps: u64) -> f64
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number: Real>,
{
    let start = system.energy().to_f64();
    let (mut least, mut largest) = (start, start);
    for _ in 0..steps {
        stepper.step(&mut system);
        let energy = system.energy().to_f64();
        (least, largest) = (least.min(energy), largest.max(energy));
    }
    largest - least
}

/// max − min of H over some steps, and of E_k for two k.
pub fn of_energies<S, M>(stepper: &Stepper<S, M::Number>, start: impl Fn() -> M, steps: u64, k: [u32; 2]) -> [f64; 3]
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number: Real>,
{
    let [first, second] = k.map(|k| {
        let found = energy_drift(stepper.with(start()), steps, &Bilinear::new(k));
        found.expect("all states are finite").drift.to_f64()
    });
    [of_energy(stepper, start(), steps), first, second]
}
