//! Values that every run has, whatever its system: the list of them.

use shadowstep::Real;
use shadowstep::tangent::Growth;
use shadowstep_scenes::Summary;

/// A value that every run has, whatever its system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RunValue {
    Verdict,
    Reason,
    EnergyError,
    RelativeEnergyError,
    LastEnergyError,
    MethodError,
    CloseEncounters,
    Drift,
    PermanentChange,
    PermanentResolution,
    PermanentFinding,
    Motion,
    Lyapunov,
    LyapunovError,
    Megno,
    Sali,
    Steps,
    ForceEvaluations,
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
    /// Tangent vectors.
    Tangents,
    Nothing,
}

/// A value with its name, its meaning, what it needs, and whether it is a number.
pub(crate) struct Description {
    pub(crate) kept: RunValue,
    pub(crate) name: &'static str,
    pub(crate) meaning: &'static str,
    pub(crate) need: Need,
    pub(crate) is_number: bool,
}

const fn number(kept: RunValue, name: &'static str, need: Need, meaning: &'static str) -> Description {
    Description { kept, name, meaning, need, is_number: true }
}

const fn word(kept: RunValue, name: &'static str, need: Need, meaning: &'static str) -> Description {
    Description { kept, name, meaning, need, is_number: false }
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
pub(crate) const VALUES: [Description; 18] = [
    word(RunValue::Verdict, "verdict", Need::Summary, "the monitor's verdict on the step size"),
    word(RunValue::Reason, "reason", Need::Summary, "the reason of the verdict"),
    number(RunValue::EnergyError, "energy_error", Need::Energies, "the largest |H(t) − H(0)| of all states"),
    number(RunValue::RelativeEnergyError, "relative_energy_error", Need::Energies, "the same as a part of |H(0)|"),
    number(RunValue::LastEnergyError, "last_energy_error", Need::Energies, "H − H(0) at the last state"),
    number(RunValue::MethodError, "method_error", Need::Summary, "the method's part of the error of H: H − H̄, rms"),
    number(RunValue::CloseEncounters, "close_encounters", Need::Summary, "the number of close encounters"),
    number(RunValue::Drift, "drift", Need::Estimates, "max − min of the modified energy"),
    number(
        RunValue::PermanentChange,
        "permanent_change",
        Need::Estimates,
        "the permanent change of the modified energy; none where it is one-sided",
    ),
    number(
        RunValue::PermanentResolution,
        "permanent_resolution",
        Need::Estimates,
        "what a permanent change must exceed to be resolved",
    ),
    word(RunValue::PermanentFinding, "permanent_finding", Need::Estimates, "resolved, below-resolution or one-sided"),
    word(
        RunValue::Motion,
        "motion",
        Need::Tangents,
        "regular, chaotic or undecided, by the growth of a tangent vector",
    ),
    number(
        RunValue::Lyapunov,
        "lyapunov",
        Need::Tangents,
        "the largest Lyapunov exponent over the last three quarters of the run",
    ),
    number(
        RunValue::LyapunovError,
        "lyapunov_error",
        Need::Tangents,
        "its error: half the width of an interval of 95 %, from parts of the run",
    ),
    number(
        RunValue::Megno,
        "megno",
        Need::Tangents,
        "the mean of MEGNO: 2 of regular runs, growing with the time of chaotic ones",
    ),
    number(RunValue::Sali, "sali", Need::Tangents, "SALI of two tangent vectors"),
    number(RunValue::Steps, "steps", Need::Nothing, "the number of steps"),
    number(
        RunValue::ForceEvaluations,
        "force_evaluations",
        Need::Nothing,
        "evaluations of the gradient, those for estimates and their states included",
    ),
];

/// A number as a text; none of one that is infinite or NaN, as those of estimates and vectors that overflow.
pub(crate) fn finite<N: Real>(x: &N) -> Option<String> {
    x.is_finite().then(|| x.to_text())
}

/// What is known of a run at its end; what no kept value needs is not.
#[derive(Default)]
pub(crate) struct Ended<'a> {
    pub(crate) steps: u64,
    pub(crate) evaluations: u64,
    /// The largest |H − H(0)|, the same as a part of |H(0)|, and the last H − H(0).
    pub(crate) energy: [Option<String>; 3],
    pub(crate) summary: Option<&'a Summary>,
    /// Of the modified energy: max − min; its permanent change, what that must exceed, and the finding.
    pub(crate) drift: [Option<String>; 4],
    /// Of the first tangent vector.
    pub(crate) growth: Option<&'a Growth>,
    pub(crate) sali: Option<f64>,
}

impl RunValue {
    pub(crate) fn description(self) -> &'static Description {
        VALUES.iter().find(|value| value.kept == self).expect("each value has its description")
    }

    /// The value that a run has; `None` where there is none.
    pub(crate) fn of(self, run: &Ended<'_>) -> Option<String> {
        let Ended { energy: [largest, relative, last], drift: [drift, change, resolution, finding], .. } = run;
        match self {
            RunValue::Verdict => Some(run.summary?.verdict().to_owned()),
            RunValue::Reason => Some(run.summary?.reason().to_owned()),
            RunValue::EnergyError => largest.clone(),
            RunValue::RelativeEnergyError => relative.clone(),
            RunValue::LastEnergyError => last.clone(),
            RunValue::MethodError => run.summary?.modified_energy()?.method.clone(),
            RunValue::CloseEncounters => Some(run.summary?.encounters().to_string()),
            RunValue::Drift => drift.clone(),
            RunValue::PermanentChange => change.clone(),
            RunValue::PermanentResolution => resolution.clone(),
            RunValue::PermanentFinding => finding.clone(),
            RunValue::Motion => Some(run.growth?.regularity().to_string()),
            RunValue::Lyapunov => finite(&run.growth?.exponent()?.value),
            RunValue::LyapunovError => finite(&run.growth?.exponent()?.error),
            RunValue::Megno => finite(&run.growth?.mean_megno()?),
            RunValue::Sali => finite(&run.sali?),
            RunValue::Steps => Some(run.steps.to_string()),
            RunValue::ForceEvaluations => Some(run.evaluations.to_string()),
        }
    }
}
