//! How much energies vary over a run.

use shadowstep::number::Real;
use shadowstep::shadow::Bilinear;
use shadowstep::shadow::run::energy_drift;
use shadowstep::{Scheme, Stepper, System, ValidFor};

/// max − min of H over some steps, and of E_k for two k.
pub fn of_energies<S, M>(stepper: &Stepper<S, M::Number>, mut system: M, steps: u64, k: [u32; 2]) -> [f64; 3]
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number: Real> + Clone,
{
    let [first, second] = k.map(|k| {
        let found = energy_drift(stepper.with(system.clone()), steps, &Bilinear::new(k));
        found.expect("all states are finite").drift.to_f64()
    });
    let energies = (0..steps).map(|_| {
        stepper.step(&mut system);
        system.energy().to_f64()
    });
    let (least, largest) = energies.fold((f64::MAX, f64::MIN), |(least, largest), e| (least.min(e), largest.max(e)));
    [largest - least, first, second]
}
