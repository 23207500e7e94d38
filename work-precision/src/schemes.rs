//! The schemes that are compared if none are named.

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

/// The names of a dozen shipped schemes for quadratic T, or for every T(p).
///
/// ```
/// let for_all = shadowstep_work_precision::schemes::default_schemes(true);
/// assert!(for_all.contains(&"yoshida4") && !for_all.contains(&"bce-rkn8-17"));
/// ```
pub fn default_schemes(general_kinetic: bool) -> [&'static str; 12] {
    if general_kinetic { GENERAL } else { QUADRATIC }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep_scenes::library::scheme;

    #[test]
    fn default_schemes_are_shipped_and_valid() {
        for name in QUADRATIC {
            assert!(scheme(name).is_ok(), "{name}");
        }
        for name in GENERAL {
            assert!(scheme(name).unwrap().quadratic().for_every_kinetic().is_ok(), "{name}");
        }
    }
}
