//! All cases: a table for each, a file with what it computes, and the list of them.

mod argon;
mod chains;
mod close_planets;
mod fput;
mod frames;
mod henon_heiles;
mod kepler;
mod linear_part;
mod orders;
mod oscillator;
mod pendulum;
mod pericentres;
mod precision;
mod processing;
mod pythagorean;
mod resonances;
mod reversal;
mod round_off;
mod stiff_springs;
mod tangent_maps;
mod transformed_time;

use crate::stability::case::CaseEntry;
use crate::stability::long_run::Staying;

/// In the order of the report.
pub(crate) static CASES: [CaseEntry; 23] = [
    CaseEntry::of::<oscillator::Oscillator>("oscillator", include_str!("cases/oscillator.toml")),
    CaseEntry::of::<orders::Orders>("orders", include_str!("cases/orders.toml")),
    CaseEntry::of::<processing::Processing>("processing", include_str!("cases/processing.toml")),
    CaseEntry::of::<kepler::Kepler>("kepler", include_str!("cases/kepler.toml")),
    CaseEntry::of::<pendulum::Pendulum>("pendulum", include_str!("cases/pendulum.toml")),
    CaseEntry::of::<henon_heiles::HenonHeiles>("henon-heiles", include_str!("cases/henon_heiles.toml")),
    CaseEntry::of::<stiff_springs::StiffSprings>("stiff-springs", include_str!("cases/stiff_springs.toml")),
    CaseEntry::of::<resonances::Resonances>("resonances", include_str!("cases/resonances.toml")),
    CaseEntry::of::<linear_part::LinearPartCase>("linear-part", include_str!("cases/linear_part.toml")),
    CaseEntry::of::<transformed_time::TransformedTime>("transformed-time", include_str!("cases/transformed_time.toml")),
    CaseEntry::of::<pythagorean::Pythagorean>("pythagorean", include_str!("cases/pythagorean.toml")),
    CaseEntry::of::<Staying>("figure-eight", include_str!("cases/figure_eight.toml")),
    CaseEntry::of::<Staying>("outer-planets", include_str!("cases/outer_planets.toml")),
    CaseEntry::of::<pericentres::Pericentres>("pericentres", include_str!("cases/pericentres.toml")),
    CaseEntry::of::<close_planets::ClosePlanets>("close-planets", include_str!("cases/close_planets.toml")),
    CaseEntry::of::<argon::Argon>("argon", include_str!("cases/argon.toml")),
    CaseEntry::of::<fput::Fput>("fput", include_str!("cases/fput.toml")),
    CaseEntry::of::<frames::Frames>("frames", include_str!("cases/frames.toml")),
    CaseEntry::of::<chains::Chains>("chains", include_str!("cases/chains.toml")),
    CaseEntry::of::<round_off::RoundOff>("round-off", include_str!("cases/round_off.toml")),
    CaseEntry::of::<reversal::Reversal>("reversal", include_str!("cases/reversal.toml")),
    CaseEntry::of::<tangent_maps::TangentMaps>("tangent-maps", include_str!("cases/tangent_maps.toml")),
    CaseEntry::of::<precision::Precision>("precision", include_str!("cases/precision.toml")),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::suite::Suite;
    use shadowstep::systems::QUADRATIC_FLOW_DIGITS;
    use shadowstep_scenes::arithmetic::Arithmetic;
    use shadowstep_scenes::library::scheme;

    #[test]
    fn every_table_is_read_and_has_trials() {
        for quick in [true, false] {
            let schemes = ["stormer-verlet", "blanes6-7"].map(|name| scheme(name).unwrap()).to_vec();
            let suite = Suite::new(schemes, Arithmetic::DOUBLE, quick);
            CASES.iter().for_each(|case| assert!(!case.trials(&suite).is_empty(), "{}", case.name));
        }
    }

    #[test]
    fn more_digits_than_flows_of_quadratic_forms_have_are_cut_to_these() {
        let case = CASES.iter().find(|case| case.name == "linear-part").unwrap();
        let digits = |digits| {
            let suite = Suite::new(Vec::new(), Arithmetic::with_digits(digits).unwrap(), true);
            case.table().arithmetic(&suite).digits()
        };
        let most = QUADRATIC_FLOW_DIGITS;
        assert_eq!([30, most, most + 12].map(digits), [30, most, most]);
    }
}
