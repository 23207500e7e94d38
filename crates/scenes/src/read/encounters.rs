//! `encounters` in [problem]: planets that come close to each other.

use shadowstep::systems::wisdom_holman::Shells;

use super::reader::Reader;
use crate::document::schema::Table;
use crate::scene::split::{CanonicalCoordinates, CloseEncounters};
use crate::scene::{Parts, System};

/// Substeps of a step, by default.
const SUBSTEPS: u32 = 4;

/// Sets the encounters of a system of planets in heliocentric coordinates, where they are given.
pub(super) fn set(reader: &mut Reader<'_>, problem: &Table<'_, '_>, system: &mut System) -> Option<()> {
    let Some(table) = problem.table("encounters") else { return Some(()) };
    let (text, within) = reader.value(&table, "within")?;
    let shells = match Shells::within(within.value) {
        Ok(shells) => shells,
        Err(error) => return reader.toml.wrong(&text.at, error.to_string(), "write some 3 Hill radii of the planets"),
    };
    let substeps = table.whole("substeps").map_or(Some(SUBSTEPS), |substeps| u32::try_from(substeps).ok())?;
    let has_more = system.has_energies_of_bodies();
    match &mut system.parts {
        Parts::WisdomHolman(planets)
            if planets.coordinates == CanonicalCoordinates::DemocraticHeliocentric && !has_more =>
        {
            planets.encounters = Some(CloseEncounters { shells, substeps });
            Some(())
        }
        _ => {
            let message = "close encounters are those of planets in heliocentric coordinates";
            let help = "write parts = \"wisdom-holman-heliocentric\", or remove `encounters`";
            reader.toml.wrong(&table.at, message, help)
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::observer::testing;
    use crate::watch::summary::Summary;

    /// Of two planets that come within 0.13 Hill radii.
    fn summary(problem: &str) -> Summary {
        testing::summary(&testing::read(&format!(
            "[problem]\nparameters = {{ g = 1 }}\n{problem}\n[[body]]\nmass = 1\n[[body]]\nmass = \"1/5000\"\nq = [1, \
                0]\nv = [0, 1]\n\
             [[body]]\nmass = \"1/20000\"\nq = [\"1.127\", \"0.34\"]\nv = [\"-0.311\", \"0.852\"]\n\
             [run]\nscheme = \"stormer-verlet\"\nstep = \"1/80\"\nuntil = 10\ndigits = \"double\"\n[output]\nenergy = true"
        )))
    }

    const HELIOCENTRIC: &str = "parts = \"wisdom-holman-heliocentric\"";

    /// A run in which planets meet names what to write, and with that its energy is bounded.
    #[test]
    fn a_run_says_when_planets_need_it() {
        let without = summary(HELIOCENTRIC);
        let hint = "write parts = \"wisdom-holman-heliocentric\" with encounters = { within = 0.1";
        assert!(!without.is_bounded() && without.reason().contains(hint), "{}", without.reason());
        let with = summary(&format!("{HELIOCENTRIC}\nencounters = {{ within = \"0.14\" }}"));
        assert!(with.is_bounded(), "{}", with.verdict_with_reason());
        // long steps through a narrow changeover
        let narrow = summary(&format!("{HELIOCENTRIC}\nencounters = {{ within = \"0.01\" }}"));
        assert_eq!(narrow.verdict(), "the step size is too large");
        assert!(narrow.reason().contains("or a larger distance in encounters"), "{}", narrow.reason());
    }
}
