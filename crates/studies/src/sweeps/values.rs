//! Values that every run has, whatever its system: the list of them.

use shadowstep::Real;
use shadowstep::tangent::Growth;

use Need::{Energies, Estimates, Nothing, Summary, Tangents};

/// A value that every run has, whatever its system.
#[derive(Debug)]
pub(crate) struct RunValue {
    pub(crate) name: &'static str,
    pub(crate) need: Need,
    pub(crate) meaning: &'static str,
    pub(crate) is_number: bool,
    /// The value of a run; `None` where it has none.
    pub(crate) of: Of,
}

/// What a value needs to be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Need {
    /// H at each state.
    Energies,
    /// The monitor.
    Summary,
    /// Estimates of the modified energy at each state.
    Estimates,
    /// This number of tangent vectors.
    Tangents(usize),
    Nothing,
}

/// What is known of a run at its end; what no kept value needs is not.
#[derive(Default)]
pub(crate) struct Ended<'a> {
    pub(crate) steps: u64,
    pub(crate) evaluations: u64,
    /// The largest |H − H(0)|, the same as a part of |H(0)|, and the last H − H(0).
    pub(crate) energy: [Option<String>; 3],
    pub(crate) summary: Option<&'a shadowstep_scenes::Summary>,
    /// Of the modified energy: max − min; its permanent change, what that must exceed, and the finding.
    pub(crate) drift: [Option<String>; 4],
    /// Of the first tangent vector.
    pub(crate) growth: Option<&'a Growth>,
    pub(crate) sali: Option<f64>,
}

type Of = fn(&Ended<'_>) -> Option<String>;

const fn number(name: &'static str, need: Need, meaning: &'static str, of: Of) -> RunValue {
    RunValue { name, need, meaning, is_number: true, of }
}

const fn word(name: &'static str, need: Need, meaning: &'static str, of: Of) -> RunValue {
    RunValue { name, need, meaning, is_number: false, of }
}

/// Their names.
pub(crate) const NAMES_OF_VALUES: [&str; VALUES.len()] = {
    let (mut names, mut i) = ([""; VALUES.len()], 0);
    while i < VALUES.len() {
        names[i] = VALUES[i].name;
        i += 1;
    }
    names
};

/// All of them.
pub(crate) const VALUES: [RunValue; 18] = [
    word("verdict", Summary, "the monitor's verdict on the step size", |run| Some(run.summary?.verdict().to_owned())),
    word("reason", Summary, "the reason of the verdict", |run| Some(run.summary?.reason().to_owned())),
    number("energy_error", Energies, "the largest |H(t) − H(0)| of all states", |run| run.energy[0].clone()),
    number("relative_energy_error", Energies, "the same as a part of |H(0)|", |run| run.energy[1].clone()),
    number("last_energy_error", Energies, "H − H(0) at the last state", |run| run.energy[2].clone()),
    number("method_error", Summary, "the method's part of the error of H: H − H̄, rms", |run| {
        run.summary?.modified_energy()?.method.clone()
    }),
    number("close_encounters", Summary, "the number of close encounters", |run| {
        Some(run.summary?.encounters().to_string())
    }),
    number("drift", Estimates, "max − min of the modified energy", |run| run.drift[0].clone()),
    number(
        "permanent_change",
        Estimates,
        "the permanent change of the modified energy; none where it is one-sided",
        |run| run.drift[1].clone(),
    ),
    number("permanent_resolution", Estimates, "what a permanent change must exceed to be resolved", |run| {
        run.drift[2].clone()
    }),
    word("permanent_finding", Estimates, "resolved, below-resolution or one-sided", |run| run.drift[3].clone()),
    word("motion", Tangents(1), "regular, chaotic or undecided, by the growth of a tangent vector", |run| {
        Some(run.growth?.regularity().to_string())
    }),
    number("lyapunov", Tangents(1), "the largest Lyapunov exponent over the last three quarters of the run", |run| {
        finite(&run.growth?.exponent()?.value)
    }),
    number(
        "lyapunov_error",
        Tangents(1),
        "its error: half the width of an interval of 95 %, from parts of the run",
        |run| finite(&run.growth?.exponent()?.error),
    ),
    number(
        "megno",
        Tangents(1),
        "the mean of MEGNO: 2 of regular runs, growing with the time of chaotic ones",
        |run| finite(&run.growth?.mean_megno()?),
    ),
    number("sali", Tangents(2), "SALI of two tangent vectors", |run| finite(&run.sali?)),
    number("steps", Nothing, "the number of steps", |run| Some(run.steps.to_string())),
    number(
        "force_evaluations",
        Nothing,
        "evaluations of the gradient, those for estimates and their states included",
        |run| Some(run.evaluations.to_string()),
    ),
];

/// A number as a text; none of one that is infinite or NaN, as those of estimates and vectors that overflow.
pub(crate) fn finite<N: Real>(x: &N) -> Option<String> {
    x.is_finite().then(|| x.to_text())
}
