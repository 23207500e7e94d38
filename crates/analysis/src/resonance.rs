//! Where multiple time steps are in resonance with a fast oscillation.
//!
//! H = p²/2 + Ω²q²/2 + rΩ²q²/2 with T, the fast and the slow forces as parts. Its kicks act at the same q, so that a
//! step with slow kicks a and fast kicks c is one of a scheme for two parts with kicks (c + r a)/(1 + r), of the
//! oscillator with ω² = (1 + r) Ω²: where that is unstable is computed as for any scheme. With the exact inner flow,
//! slow kicks open a gap below each multiple of π, from hΩ = nπ − 2 atan(nπr/2) or so.
//!
//! Sources: J. J. Biesiadecki & R. D. Skeel, J. Comput. Phys. 109 (1993) 318; Q. Ma, J. A. Izaguirre & R. D. Skeel,
//! SIAM J. Sci. Comput. 24 (2003) 1951.

use num_traits::{One, Zero};
use shadowstep_schemes::map::{Map, Stages};
use shadowstep_schemes::{MapKind, Proved, Rational};

use crate::stability::Stability;

/// The parts 1/n of the stiffness of fast forces for which reports show resonances.
pub const REPORTED: [i64; 2] = [100, 10];

/// The limit and the gaps of hω, with slow forces of this part of the stiffness of the fast ones; `None` for a scheme
/// without an inner scheme, and where [`Stability::of_scheme`] is.
///
/// ```
/// use shadowstep_analysis::resonance::resonances;
/// use shadowstep_schemes::{Rational, shipped_proved};
///
/// let proved = shipped_proved("r-respa-8").unwrap();
/// let found = resonances(proved, &Rational::new(1.into(), 100.into())).unwrap();
/// assert!(found.limit.starts_with("3.1"));
/// ```
pub fn resonances(proved: &Proved, ratio: &Rational) -> Option<Stability> {
    let maps = of_oscillator(proved, ratio)?;
    let degree = maps.iter().filter(|map| map.kind == MapKind::Drift).count();
    Some(Stability::of(&maps, degree)?.resolved(proved.scheme.held))
}

/// The maps of a step of the oscillator, kicks at the same q merged.
pub fn of_oscillator(proved: &Proved, ratio: &Rational) -> Option<Vec<Map>> {
    let (maps, fast) = proved.scheme.inner.as_ref()?.step(&proved.scheme.maps());
    let mut stages = Stages::default();
    let mut kick = Rational::zero();
    let mut fast = fast.into_iter();
    for map in maps {
        if map.kind == MapKind::Drift {
            stages.kick.push(std::mem::replace(&mut kick, Rational::zero()));
            stages.drift.push(map.weight);
        } else {
            kick += ratio * map.weight;
        }
        kick += fast.next().unwrap_or_else(Rational::zero);
    }
    stages.kick.push(kick);
    stages.drift.push(Rational::zero());
    let all = Rational::one() + ratio;
    stages.kick.iter_mut().for_each(|kick| *kick /= &all);
    Some(stages.maps())
}
