//! The step size of a run beside the stability limit of its scheme, and beside the revolutions of planets.

use shadowstep::{Rational, Scheme as _};
use shadowstep_analysis::oscillator::Oscillator;
use shadowstep_analysis::resonance::resonances;
use shadowstep_analysis::stability::Stability;
use shadowstep_schemes::symbolic::decimal::significant;

use crate::document::library::NamedScheme;
use crate::motion::frequency::Frequency;
use crate::run::note::Note;
use crate::scene::System;

/// A trace this far above 2 in size is not due to rounding.
const ROUNDING: f64 = 1e-9;

/// What is to be noted of steps of size h before a run: that they are unstable at the
/// [fastest frequency](System::fastest_frequency), else few for a revolution of a planet, else that they are near a
/// resonance.
pub fn note_of_steps(
    (system, frequency): (&System, Option<Frequency>),
    named: &NamedScheme,
    h: &Rational,
) -> Option<Note> {
    let unstable = frequency.and_then(|frequency| unstable(frequency, named, h));
    unstable.or_else(|| few_kicks(system, named, h)).or_else(|| resonant(system, named, h))
}

/// A note if steps of size h of the fastest oscillation are unstable: |tr| > 2 for the matrix of a step with hω.
fn unstable(frequency: Frequency, named: &NamedScheme, h: &Rational) -> Option<Note> {
    let proved = named.scheme.proved();
    let h_omega = frequency.omega * <f64 as shadowstep::Number>::from_rational(h, &()).abs();
    let nearest = |weight: &Rational| shadowstep::Number::from_rational(weight, &());
    let trace = Oscillator::of(&proved.scheme.maps(), nearest).trace(h_omega);
    (trace.abs() > 2.0 + ROUNDING).then(|| Note::Unstable {
        scheme: named.name.clone(),
        limit: Stability::of_scheme(proved).map(|stability| stability.limit),
        h_omega: significant(h_omega, 5),
        omega: significant(frequency.omega, 5),
        quadratic: frequency.quadratic,
    })
}

/// A note if the fastest oscillation of fast forces and T is beyond the first resonance with the slow kicks of multiple
/// time steps, for slow forces of a hundredth of its stiffness.
pub(crate) fn resonant(system: &System, named: &NamedScheme, h: &Rational) -> Option<Note> {
    system.parts.slow_forces()?;
    let first = resonances(named.scheme.proved(), &Rational::new(1.into(), 100.into()))?.limit;
    let omega = system.fastest_motion()?.omega;
    let h_omega = omega * <f64 as shadowstep::Number>::from_rational(h, &()).abs();
    let from = first.parse::<f64>().ok()?;
    (h_omega > from).then(|| Note::Resonant {
        scheme: named.name.clone(),
        h_omega: significant(h_omega, 5),
        omega: significant(omega, 5),
        from: significant(from, 5),
    })
}

/// A revolution of a planet should have this number of kicks: with fewer, resonances of low order between the step size
/// and the orbits are near (J. Wisdom and M. Holman, Astron. J. 104 (1992) 2022).
const LEAST_KICKS: f64 = 10.0;

/// A note if a planet has few kicks in a revolution of its Kepler orbit at the start.
fn few_kicks(system: &System, named: &NamedScheme, h: &Rational) -> Option<Note> {
    let planets = system.parts.planets()?;
    let (q, p) = system.start::<f64>(&());
    let (planet, period) = planets.shortest_period(&q, &p)?;
    let steps = period / <f64 as shadowstep::Number>::from_rational(h, &()).abs();
    let kicks = named.scheme.summary().evaluations;
    (steps * (kicks as f64) < LEAST_KICKS).then(|| Note::FewKicks {
        planet: planets.names(&system.coordinates).swap_remove(planet),
        steps: significant(steps, 2),
        kicks,
        least: LEAST_KICKS,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::library::scheme;

    #[test]
    fn the_limit_of_a_scheme_decides() {
        let verlet = scheme("stormer-verlet").unwrap();
        let note =
            |h: &str, omega| unstable(Frequency { omega, quadratic: true }, &verlet, &shadowstep::exact(h).unwrap());
        assert_eq!((note("1.99", 1.0), note("1", 2.0)), (None, None));
        let Some(Note::Unstable { limit, h_omega, .. }) = note("-2.1", 1.0) else { panic!("stable") };
        assert_eq!((limit.as_deref(), h_omega.as_str()), (Some("2"), "2.1000"));
        // a slow system, whose frequency has no digit among the first decimals
        let Some(Note::Unstable { h_omega: product, omega, .. }) = note("1e7", 2.1e-7) else { panic!("stable") };
        assert_eq!((product.as_str(), omega.as_str()), ("2.1000", "2.1000e-7"));
    }

    /// Beyond its limit a scheme may be stable again.
    #[test]
    fn the_gaps_of_a_scheme_are_unstable_and_what_is_between_them_is_not() {
        let pefrl = scheme("pefrl").unwrap();
        let unstable = |omega| unstable(Frequency { omega, quadratic: true }, &pefrl, &shadowstep::exact("1").unwrap());
        let gaps = Stability::of_scheme(pefrl.scheme.proved()).unwrap().gaps;
        let number = |text: &String| text.parse::<f64>().unwrap();
        let [first, second, ..] = &gaps[..] else { panic!("{gaps:?}") };
        let (from, to, next) = (number(&first.from), number(first.to.as_ref().unwrap()), number(&second.from));
        assert!(unstable(from * 0.999).is_none() && unstable((from + to) / 2.0).is_some());
        assert!(unstable((to + next) / 2.0).is_none() && unstable(next * 1.01).is_some());
    }
}
