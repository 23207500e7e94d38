//! What a run has shown: the error of H, the modified energy, close encounters and the verdict.

use std::fmt;

use num_traits::Zero as _;
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};
use serde_json::json;
use shadowstep::Rational;
use shadowstep::shadow::{Criterion, Missing, Verdict};
use shadowstep_schemes::symbolic::decimal::{from_text, significant, to_significant, to_text};

use crate::texts::readable::wrapped_to;
use crate::watch::encounters::Encounter;
use crate::watch::lasting_change::LastingChange;
use crate::watch::light::{self, LightBody, not_resolved};
use crate::watch::{Approach, Interactions};

/// What a run has shown.
///
/// It is displayed as lines for people, and serialised as an object. Numbers are texts that read back to the same
/// numbers.
#[derive(Clone, Debug)]
pub struct Summary {
    /// The scheme and the step size.
    pub(crate) run: String,
    pub(crate) h: Rational,
    /// Whether the steps are in a fictitious time s.
    pub(crate) transformed: bool,
    /// The first state and the last one; the first one is not 0 where the run was resumed from one without a summary.
    pub(crate) from: i64,
    pub(crate) to: i64,
    pub(crate) energy: EnergySummary,
    /// Whether H̄ was estimated at all.
    pub(crate) has_windows: bool,
    /// `None` without an estimate, or where its sums overflow.
    pub(crate) modified_energy: Option<ModifiedEnergySummary>,
    /// How many close encounters there were, and the closest of them.
    pub(crate) encounters: u64,
    pub(crate) closest: Vec<Encounter>,
    /// Of planets.
    pub(crate) interactions: Option<Interactions>,
    /// Light bodies that came near to planets.
    pub(crate) light: Vec<LightBody>,
    /// The least and the greatest values of expressions.
    pub(crate) extremes: Vec<Extreme>,
    pub(crate) bounded: bool,
    pub(crate) verdict: String,
    /// The verdict, with the size of a bounded error.
    pub(crate) conclusion: String,
    pub(crate) reason: String,
}

/// The least and the greatest value of an expression, each with the n of its state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Extreme {
    /// Its name.
    pub(crate) name: String,
    /// The least value.
    pub(crate) least: (String, i64),
    /// The greatest value.
    pub(crate) greatest: (String, i64),
}

/// The error of H: H(t) − H(0).
#[derive(Clone, Debug, Serialize)]
pub struct EnergySummary {
    /// H(0)
    pub initial: String,
    /// The largest |H(t) − H(0)| of [these states](EnergySummary::states).
    pub largest: String,
    /// The same as a part of |H(0)|; `None` if that is 0, or round-off.
    pub largest_relative: Option<String>,
    /// The n of the state that has it.
    pub at: i64,
    /// H − H(0) at the last state.
    pub last: String,
    /// Its size as a part of |H(0)|; `None` if that is 0.
    pub last_relative: Option<String>,
    /// At how many states H was computed.
    pub states: u64,
}

/// What the monitor found of the modified energy H̄; [`Report`](shadowstep::shadow::Report) has the meanings.
#[derive(Clone, Debug, Serialize)]
pub struct ModifiedEnergySummary {
    /// The method's part of the error of H: H − H̄, rms; `None` where H̄ is not known well enough for it.
    pub method: Option<String>,
    /// To what H̄ is known in these differences, rms.
    pub method_resolution: String,
    /// The expected effect of round-off on H̄.
    pub round_off: String,
    /// max − min of H̄ over states with small estimated errors, as
    /// [`PermanentChange`](shadowstep::shadow::run::PermanentChange) of all states: here of the half of 32 to 64 parts
    /// of the run with the smaller errors, one state each.
    pub permanent_change: String,
    /// A net change of the energy, from the beginning of the run to its end, is excluded above this; `None` where
    /// nothing is excluded.
    pub permanent_bound: Option<String>,
    /// To what H̄ is known.
    pub resolution: Option<String>,
    /// In how many windows it was estimated.
    pub windows: u64,
}

impl Summary {
    /// Whether the error is bounded, or round-off: whether it is small enough is not decided here.
    pub fn is_bounded(&self) -> bool {
        self.bounded
    }

    /// Whether it is of all states: a part of a run that is resumed may have been made without a summary.
    pub fn is_of_whole_run(&self) -> bool {
        self.from == 0
    }

    /// The error of H.
    pub fn energy(&self) -> &EnergySummary {
        &self.energy
    }

    /// The verdict without numbers: `bounded`.
    pub fn verdict(&self) -> &str {
        &self.verdict
    }

    /// The verdict in a line, with the size of an error that is bounded.
    pub fn conclusion(&self) -> &str {
        &self.conclusion
    }

    /// The reason of the verdict.
    pub fn reason(&self) -> &str {
        &self.reason
    }

    /// What the monitor found of the modified energy; `None` without an estimate.
    pub fn modified_energy(&self) -> Option<&ModifiedEnergySummary> {
        self.modified_energy.as_ref()
    }

    /// Replaces a verdict on windows that do not show that H changed for good; `kinetic` is the mean T.
    pub(super) fn name_lasting_change(&mut self, change: &LastingChange, kinetic: f64) {
        let part = change.gap / kinetic;
        let [before, after] = change.between.map(|n| self.time(n));
        self.reason = format!(
            "H changed by {part:.1e} of T between {before} and {after}, and did not come back in this run: a step \
             that is too large there, forces that are not smooth, or something other than the scheme that changed the \
             state have such effects"
        );
        self.verdict = Verdict::Undecided(Missing::Resolution).to_string();
        self.conclusion.clone_from(&self.verdict);
        self.bounded = false;
    }

    /// Replaces a verdict that is worse than bounded where planets came so close that the splitting is not valid: that
    /// is the cause then.
    pub(crate) fn name_close_planets(&mut self) {
        let Some(Approach { n, bodies: [i, j], hill_radii, hill_radius }) =
            self.interactions.as_ref().and_then(Interactions::encounter)
        else {
            return;
        };
        let within = format!("{:.1e}", 3.0 * hill_radius);
        let within = from_text(&within).map_or(within, |exact| to_significant(&exact, 2));
        let (time, hill_radii) = (self.time(*n), significant(*hill_radii, 2));
        if let Some(given) = self.interactions.as_ref().and_then(|found| found.in_drifts_within) {
            let larger =
                if given < 3.0 * hill_radius { format!(", {within} is 3 of these radii") } else { String::new() };
            self.reason = format!(
                "{i} and {j} came within {hill_radii} Hill radii of each other at {time}, and their attraction goes \
                 from kicks to drifts within too few steps: use a smaller step size, or a larger distance in \
                 encounters = {{ within = … }}{larger}"
            );
            self.verdict = Verdict::TooLarge(Criterion::EnergyError).to_string();
        } else {
            self.reason = format!(
                "{i} and {j} came within {hill_radii} Hill radii of each other at {time}, where kicks are not small \
                 beside the Kepler orbits, as these parts require: smaller steps do not help; write parts = \
                 \"wisdom-holman-heliocentric\" with encounters = {{ within = {within} }}, 3 of these radii"
            );
            self.verdict = "the splitting is not valid in a close encounter".to_owned();
        }
        self.conclusion.clone_from(&self.verdict);
    }

    /// A verdict on the energy says nothing about bodies that have none.
    pub(super) fn name_light_bodies(&mut self) {
        let Some(lost) = not_resolved(&self.light, |n| self.time(n)) else { return };
        if self.bounded {
            self.verdict = "light bodies are not resolved".to_owned();
            self.conclusion.clone_from(&self.verdict);
            self.reason = lost;
        } else {
            self.reason = format!("{}; and there are {lost}", self.reason);
        }
        self.bounded = false;
    }

    /// Whether bodies came within one Hill radius of each other.
    fn has_close_bodies(&self) -> bool {
        let planets = self.interactions.as_ref().and_then(|found| found.closest.as_ref());
        planets.is_some_and(|closest| closest.hill_radii < 1.0) || self.light.iter().any(|body| body.hill_radii < 1.0)
    }

    /// The verdict with its reason.
    pub fn verdict_with_reason(&self) -> String {
        format!("{}: {}", self.verdict, self.reason)
    }

    /// How many close encounters there were.
    pub fn encounters(&self) -> u64 {
        self.encounters
    }

    /// The close encounters in a line: how many, and up to `shown` of the closest with their times.
    pub fn encounters_text(&self, shown: usize) -> String {
        let lasts = |encounter: &Encounter| {
            let steps = if encounter.steps == 1 { "1 step".to_owned() } else { format!("{} steps", encounter.steps) };
            format!("{steps} per passage at {}", self.time(encounter.n))
        };
        let closest = self.closest.iter().take(shown).map(lasts).collect::<Vec<_>>().join(", ");
        match self.encounters {
            0 if self.has_close_bodies() => {
                "none of all bodies together; of bodies within one Hill radius, see below".to_owned()
            }
            0 => "none".to_owned(),
            1 => format!("1, with {closest}"),
            count => format!("{count}, the closest with {closest}"),
        }
    }

    /// A remark on a passage of so few steps that the states between which H was compared do not show what it does.
    fn unresolved_text(&self) -> &'static str {
        match self.closest.first() {
            Some(Encounter { steps, .. }) if *steps < RESOLVED && self.has_all_states() => {
                ": too few to resolve the motion there"
            }
            Some(Encounter { steps, .. }) if *steps < RESOLVED => {
                ": too few, the energy may have changed by more than the states that were looked at show"
            }
            _ => "",
        }
    }

    /// What a run of planets has shown of their interactions.
    pub fn interactions(&self) -> Option<&Interactions> {
        self.interactions.as_ref()
    }

    fn extremes_text(&self) -> Option<String> {
        let at = |(value, n): &(String, i64)| format!("{} at {}", value_text(value), self.time(*n));
        let one =
            |Extreme { name, least, greatest }: &Extreme| format!("{name} from {} to {}", at(least), at(greatest));
        let all = self.extremes.iter().map(one).collect::<Vec<_>>().join("; ");
        (!all.is_empty()).then_some(all)
    }

    /// The time of the steps with its letter.
    fn time(&self, n: i64) -> String {
        let letter = if self.transformed { 's' } else { 't' };
        let time = to_significant(&(&self.h * Rational::from_integer(n.into())), 6);
        format!("{letter} = {time}")
    }

    fn energy_text(&self) -> String {
        let EnergySummary { initial, largest, largest_relative, last, last_relative, at, states } = &self.energy;
        let zero = if from_text(initial).is_ok_and(|initial| initial.is_zero()) { "0" } else { "round-off" };
        let part = |relative: &Option<String>, absolute: &str| match relative {
            Some(relative) => format!("{} of |H(0)|", short(relative)),
            None if self.transformed => short(absolute.trim_start_matches('-')),
            None => format!("{} (H(0) is {zero})", short(absolute.trim_start_matches('-'))),
        };
        let (largest, time) = (part(largest_relative, largest), self.time(*at));
        let last = format!("{} at the end", part(last_relative, last));
        match self.has_all_states() {
            true => format!("at most {largest} ({time}), {last}"),
            false => format!("{largest} ({time}) is the largest of {states} states, {last}"),
        }
    }

    /// Whether H was compared at every state.
    fn has_all_states(&self) -> bool {
        u64::try_from(self.to - self.from + 1).is_ok_and(|all| self.energy.states >= all)
    }

    fn modified_energy_text(&self) -> String {
        let Some(modified) = &self.modified_energy else {
            let why = if self.has_windows { "its estimates overflow" } else { "the run is too short for an estimate" };
            return why.to_owned();
        };
        let ModifiedEnergySummary { method, method_resolution, round_off, permanent_change, resolution, .. } = modified;
        let known = resolution.as_ref().map_or(String::new(), |error| format!(", known to {}", short(error)));
        let method = method.as_ref().map_or_else(
            || format!("not resolved: H̄ is known to {} rms only", short(method_resolution)),
            |method| format!("{} rms", short(method)),
        );
        format!(
            "method's part of H {method}; round-off {} expected; permanent change {}{known}",
            short(round_off),
            short(permanent_change)
        )
    }
}

/// A passage of fewer steps is not resolved: on a Kepler orbit with 4 H changed in it by more than the monitor's states
/// excluded.
const RESOLVED: i64 = 6;

/// How many of the closest encounters the text has.
const SHOWN: usize = 3;

/// Eight digits of a value.
fn value_text(text: &str) -> String {
    from_text(text).map_or_else(|_| text.to_owned(), |value| to_significant(&value, 8))
}

/// Three digits of a number.
fn short(text: &str) -> String {
    // numbers of a run that was lost may be too large to be read: their first digits, not rounded
    let first_digits = |(digits, exponent): (&str, &str)| {
        let length = if digits.starts_with('-') { "-1.23" } else { "1.23" }.len();
        format!("{}e{exponent}", digits.get(..length).unwrap_or(digits))
    };
    match from_text(text) {
        Ok(value) => to_significant(&value, 3),
        Err(_) => text.split_once('e').map_or_else(|| text.to_owned(), first_digits),
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let since = if self.from == 0 { String::new() } else { format!(" since n = {}", self.from) };
        write!(f, "{}, {} steps{since}", self.run, self.to - self.from)?;
        let planets = self.interactions.as_ref().map(|found| ("planets", found.text(|n| self.time(n))));
        let facts = [
            (if self.transformed { "error of H'" } else { "error of H" }, self.energy_text()),
            ("modified energy", self.modified_energy_text()),
            ("close encounters", self.encounters_text(SHOWN) + self.unresolved_text()),
        ];
        let light = light::text(&self.light, |n| self.time(n)).map(|text| ("light bodies", text));
        let extremes = self.extremes_text().map(|text| ("values", text));
        let facts = facts
            .into_iter()
            .chain(planets)
            .chain(light)
            .chain(extremes)
            .chain([("verdict", self.verdict_with_reason())]);
        for (name, fact) in facts {
            let lines = wrapped_to(&fact, &" ".repeat(20), 80);
            write!(f, "\n  {name:<18}{}", lines.trim())?;
        }
        Ok(())
    }
}

impl Serialize for Summary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Passage {
            n: i64,
            t: String,
            steps: i64,
        }
        let time = |n: i64| to_text(&(&self.h * Rational::from_integer(n.into())));
        let closest = self.closest.iter().map(|Encounter { n, steps }| Passage { n: *n, t: time(*n), steps: *steps });
        #[derive(Serialize)]
        struct State<'a> {
            value: &'a str,
            n: i64,
            t: String,
        }
        let state = |(value, n): &'_ (String, i64)| json!(State { value, n: *n, t: time(*n) });
        let extreme = |found: &Extreme| {
            (found.name.clone(), json!({ "least": state(&found.least), "greatest": state(&found.greatest) }))
        };
        let extremes: serde_json::Map<_, _> = self.extremes.iter().map(extreme).collect();
        let optional = [self.interactions.is_some(), !self.light.is_empty(), !extremes.is_empty()];
        let fields = 9 + optional.into_iter().map(usize::from).sum::<usize>();
        let mut object = serializer.serialize_struct("Summary", fields)?;
        object.serialize_field("from", &self.from)?;
        object.serialize_field("to", &self.to)?;
        object.serialize_field("energy_error", &self.energy)?;
        object.serialize_field("modified_energy", &self.modified_energy)?;
        object.serialize_field("close_encounters", &self.encounters)?;
        object.serialize_field("closest_encounters", &closest.collect::<Vec<_>>())?;
        if let Some(interactions) = &self.interactions {
            object.serialize_field("planets", interactions)?;
        }
        if !self.light.is_empty() {
            object.serialize_field("light_bodies", &self.light)?;
        }
        if !extremes.is_empty() {
            object.serialize_field("extremes", &extremes)?;
        }
        object.serialize_field("verdict", &self.verdict)?;
        object.serialize_field("reason", &self.reason)?;
        object.serialize_field("bounded", &self.bounded)?;
        object.end()
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_have_three_digits_of_any_size() {
        assert_eq!(short("-2.395973213260594620428624132556e10092"), "-2.39e10092");
        assert_eq!(short("3.3510363341376132e18154"), "3.35e18154");
        assert_eq!(short("NaN"), "NaN");
    }
}
