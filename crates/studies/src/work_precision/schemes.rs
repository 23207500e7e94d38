//! Groups of shipped schemes: those that are compared if none are named, and those that words mean.

use std::path::Path;

use shadowstep::tables::First;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::{NamedScheme, scheme_from};
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::{Error, System};

/// For quadratic T: what people use, and the best of each order that is not much more expensive.
const QUADRATIC: [&str; 12] = [
    "stormer-verlet",
    "yoshida4",
    "pefrl",
    "mclachlan-atela4",
    "blanes-moan-s6",
    "blanes-moan-srkn6b",
    "blanes-moan-srkn11b",
    "blanes-moan-srkn14a",
    "yoshida6-a",
    "kahan-li8",
    "bce-rkn8-17",
    "sofroniou-spaletta10-35",
];

/// For every T(p): Nyström schemes have lower orders there.
const GENERAL: [&str; 12] = [
    "stormer-verlet",
    "mclachlan-s2",
    "ruth3",
    "yoshida4",
    "suzuki4",
    "blanes-moan-s6",
    "yoshida6-a",
    "kahan-li6",
    "blanes-moan-s10",
    "kahan-li8",
    "sofroniou-spaletta8-21",
    "sofroniou-spaletta10-35",
];

/// Beside a dominant part: near-integrable schemes and kernels with correctors of some orders, and the best of others.
/// Those that are not valid for a system are left out.
const DOMINANT: [&str; 16] = [
    "stormer-verlet",
    "wisdom-kernel-7",
    "wisdom-kernel-17",
    "saba3",
    "saba4",
    "mclachlan-aba84",
    "aba104",
    "aba864",
    "aba1064",
    "abah864",
    "abah1064",
    "blanes-moan-srkn6b",
    "blanes-moan-srkn11b",
    "blanes-moan-s10",
    "kahan-li8",
    "sofroniou-spaletta10-35",
];

/// Several shipped schemes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// A dozen, by the parts of a system and its kinetic energy.
    Default,
    /// The catalogue.
    All,
    /// Those with orders for A + εB, of a processed scheme effective ones.
    NearIntegrable,
}

impl Group {
    /// The groups that have words.
    pub const NAMED: [(&'static str, Group); 2] = [("all", Group::All), ("near-integrable", Group::NearIntegrable)];

    /// The group of a word.
    pub fn of_word(word: &str) -> Option<Group> {
        Group::NAMED.into_iter().find(|(name, _)| *name == word).map(|(_, group)| group)
    }

    /// Its names for a system; not all need be valid for it.
    pub(crate) fn names(self, system: &System) -> Vec<&'static str> {
        match self {
            Group::Default if system.parts.has_dominant_part() => DOMINANT.to_vec(),
            Group::Default => if system.has_general_kinetic() { GENERAL } else { QUADRATIC }.to_vec(),
            Group::All => shadowstep::tables::shipped_names(),
            Group::NearIntegrable => {
                shadowstep::tables::shipped_names().into_iter().filter(|name| is_near_integrable(name)).collect()
            }
        }
    }

    /// Its schemes that are valid for a system and have the digits of the runs, with steps that begin with a map, where
    /// one is given.
    ///
    /// # Errors
    /// None is.
    pub fn schemes(
        self,
        system: &System,
        arithmetic: Arithmetic,
        first: Option<First>,
    ) -> Result<Vec<NamedScheme>, Error> {
        let valid = |name: &str| {
            let scheme = scheme_from(name, Path::new(""), first).ok()?;
            Some(for_system(scheme, system).ok()?.fitted(arithmetic).ok()?.0)
        };
        let found: Vec<_> = self.names(system).into_iter().filter_map(valid).collect();
        match found.is_empty() {
            false => Ok(found),
            true => Err(Error::usage("no scheme of the group is valid for this system", "name schemes")),
        }
    }
}

/// Whether a shipped table has orders for A + εB.
fn is_near_integrable(name: &str) -> bool {
    shadowstep_schemes::shipped_proved(name).is_some_and(|proved| {
        let effective = proved.proof.effective.iter().flat_map(|effective| &effective.near_integrable);
        proved.proof.near_integrable.iter().chain(effective).next().is_some()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::tables::Source;
    use shadowstep_scenes::library::scheme;

    fn system(text: &str) -> System {
        System::read(&Source { path: "test.toml".to_owned(), text: text.to_owned() }, Arithmetic::DOUBLE).unwrap().0
    }

    fn names(group: Group, text: &str) -> Vec<String> {
        let found = group.schemes(&system(text), Arithmetic::DOUBLE, None).unwrap();
        found.into_iter().map(|named| named.name).collect()
    }

    #[test]
    fn default_schemes_are_shipped_and_valid() {
        for name in QUADRATIC.into_iter().chain(DOMINANT) {
            assert!(scheme(name).is_ok(), "{name}");
        }
        let relativistic = "problem = { kinetic = 'sqrt(1 + p^2)', momenta = ['p'], potential = 'x^2', coordinates = \
            ['x'] }\ninitial = { q = [1], p = [0] }";
        assert_eq!(names(Group::Default, "problem.name = 'kepler'"), QUADRATIC);
        assert_eq!(names(Group::Default, relativistic), GENERAL);
    }

    #[test]
    fn a_dominant_part_has_near_integrable_schemes_and_kernels() {
        for (parts, kernel) in [("wisdom-holman", true), ("wisdom-holman-heliocentric", false)] {
            let found =
                names(Group::Default, &format!("problem = {{ name = 'outer-solar-system', parts = '{parts}' }}"));
            let has = |name: &str| found.iter().any(|found| found == name);
            assert!(has("aba1064") && has("abah864") && has("sofroniou-spaletta10-35"), "{found:?}");
            assert_eq!((has("wisdom-kernel-17"), has("blanes-moan-srkn11b")), (kernel, kernel), "{found:?}");
        }
        assert!(
            names(Group::Default, "problem = { name = 'henon-heiles', parts = 'linear' }")
                .contains(&"aba864".to_owned())
        );
        let all = names(Group::NearIntegrable, "problem.name = 'henon-heiles'");
        assert!(all.contains(&"saba3".to_owned()) && !all.contains(&"pefrl".to_owned()), "{all:?}");
    }
}
