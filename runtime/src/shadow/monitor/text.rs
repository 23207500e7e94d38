//! The report of a monitor as text.

use std::fmt;

use super::report::Report;
use super::roughness::Rough;
use super::trend::Trend;
use super::verdict::{Advice, Criterion, Missing, PERMANENT_LIMIT, Verdict};
use crate::number::Real;

/// A coordinate that turns once in fewer steps is hardly resolved.
const FEW_STEPS: f64 = 10.0;

impl<N: Real> Report<N> {
    /// An energy as a part of the energy error; its value where that is 0.
    fn in_parts(&self, energy: &N) -> String {
        match self.part(energy) {
            part if part.is_finite() => format!("{part:.1e} of the energy error"),
            _ => short(energy),
        }
    }

    /// An energy in T, for a unit of time, and as a part of the energy error.
    fn per_time(&self, energy: &N) -> String {
        let mut rate = energy.clone();
        rate.divide(&self.kinetic);
        let of_kinetic = short(&rate);
        rate.divide(&self.time);
        format!("{of_kinetic} of T, or {} of T per unit time,", short(&rate))
    }

    /// What is known of the change of the energy from the beginning to the end.
    fn permanent(&self) -> String {
        match (&self.permanent_change, &self.permanent_bound) {
            (Some(change), _) => format!("a net change of {} was measured", self.per_time(change)),
            (None, Some(bound)) => format!("a net change above {} is excluded", self.per_time(bound)),
            (None, None) => "a net change is not excluded".to_owned(),
        }
    }

    /// The energy error and its size, in percent from 1 % on.
    fn size(&self) -> String {
        match self.relative_error() {
            part if part >= 0.01 => format!("the energy error is {:.1} % of T", 100.0 * part),
            part => format!("the energy error is {part:.1e} of T"),
        }
    }

    /// The verdict in a line; a bounded energy error has its size, as the user decides whether that is small enough.
    pub fn conclusion(&self) -> String {
        match self.verdict {
            Verdict::Bounded if self.has_no_energy_error() => format!("{}: the energy error is 0", self.verdict),
            Verdict::Bounded => format!("{}: {}", self.verdict, self.size()),
            verdict => verdict.to_string(),
        }
    }

    /// The reason for the verdict, a sentence with numbers.
    pub fn reason(&self) -> String {
        let steps = self.steps;
        let moved = format!("the modified energy moved by {} in {steps} steps", self.in_parts(&self.moved));
        let check = "compare gradient, energy and rate (in Rust with check_potential)";
        match self.verdict {
            Verdict::Undecided(Missing::Windows) => {
                format!("a verdict needs {} windows, and there are {}", Verdict::LEAST_WINDOWS, self.windows)
            }
            Verdict::Undecided(Missing::Resolution) => self.what_would_decide(),
            Verdict::Inconsistent => self.why_inconsistent(),
            Verdict::RoundOff => format!(
                "{moved}, and round-off makes {}: for this energy a larger step size is sufficient{}, or more digits \
                    are needed",
                self.in_parts(&self.round_off),
                self.resolved_coordinate()
            ),
            Verdict::NearResonance { turns, steps } => format!(
                "{moved}, and the fastest motion turns once in {:.3} steps, near {turns}/{steps} turns a step: \
                 use another step size",
                self.steps_per_turn.unwrap_or_default()
            ),
            Verdict::Drifts => format!(
                "{moved}, linearly in time: by {} in all, where round-off makes {}. The scheme conserves it, so the \
                 cause is a force that is not −U_q, a state that is changed between the steps, or a resonance; {check}",
                short(&self.change),
                short(&self.round_off)
            ),
            Verdict::NotTheGradient => format!(
                "the modified energy changes from state to state as the energy does, which no scheme does: the forces \
                 are not its gradient, or something else acts; {check}"
            ),
            Verdict::NotSmooth => self.why_not_smooth(),
            Verdict::NotConserved => format!(
                "{}, and {moved}, permanently, where round-off makes {}: the error grows with the length of the run. \
                 A smaller step resolves encounters better; forces that are not smooth, or something other than the \
                 scheme, have such effects, too",
                self.size(),
                self.in_parts(&self.round_off)
            ),
            Verdict::TooLarge(criterion) => self.why_too_large(criterion, &moved),
            Verdict::Bounded if self.has_no_energy_error() => {
                format!("the energy is the same in all windows of {steps} steps")
            }
            Verdict::Bounded => format!(
                "{}; in {steps} steps {}{}{}",
                self.size(),
                self.permanent(),
                self.unresolved(),
                self.light_coordinate()
            ),
        }
    }

    /// A coordinate by its name, or its number from 1.
    fn coordinate(&self, i: usize) -> String {
        self.coordinate_names.get(i).cloned().unwrap_or_else(|| format!("coordinate {}", i + 1))
    }

    /// What a larger step has to resolve: light bodies have no part in the energy.
    fn resolved_coordinate(&self) -> String {
        self.fastest_coordinate.map_or(String::new(), |(i, steps)| {
            format!(" where it resolves {}, which turns once in {steps:.1} steps", self.coordinate(i))
        })
    }

    /// A coordinate with little energy that the steps hardly resolve, if there is one: the verdict concerns the energy
    /// only.
    fn light_coordinate(&self) -> String {
        let others = self.steps_per_turn.unwrap_or(f64::INFINITY);
        let light = self.fastest_coordinate.filter(|(_, steps)| *steps < FEW_STEPS && 2.0 * steps < others);
        light.map_or(String::new(), |(i, steps)| {
            format!(
                ". A motion with too little energy to be seen in this verdict, {}, turns, or turned at the start, \
                 once in {steps:.1} steps: it may be lost",
                self.coordinate(i)
            )
        })
    }

    /// A remark where the verdict does not follow from the modified energy.
    fn unresolved(&self) -> String {
        match &self.worst_error {
            Some(error) if self.part(error) >= PERMANENT_LIMIT => {
                format!(". Where H̄ is known least, it is known to within {} only", self.in_parts(error))
            }
            None if self.part(&self.range) >= PERMANENT_LIMIT => {
                ". H̄ ranges over more than that, but this estimator gives no errors".to_owned()
            }
            _ => String::new(),
        }
    }

    fn what_would_decide(&self) -> String {
        let Some(Advice { length, order }) = self.advice else { return "not decided".to_owned() };
        if let Some(change) = &self.permanent_change {
            let turns = self
                .steps_per_turn
                .map_or(String::new(), |steps| format!("the fastest motion turns once in {steps:.0} steps, "));
            return format!(
                "{}, of which in {} steps {} were a permanent change; {turns}and the cause may be the step size, \
                 forces that are not smooth, or something other than the scheme that changed the state: a longer run, \
                 and windows of 17 states or more, would tell",
                self.size(),
                self.steps,
                self.in_parts(change),
            );
        }
        let resolved = match &self.worst_error {
            Some(error) => format!("H̄ is known to within {} where it is known least", self.in_parts(error)),
            None => "the errors of H̄ are not known".to_owned(),
        };
        let bound = self
            .permanent_bound
            .as_ref()
            .map_or("no change".to_owned(), |bound| format!("a net change above {}", self.in_parts(bound)));
        let estimator = order.map_or(String::new(), |order| format!(", or the estimator E_{order} or D_{order}"));
        format!(
            "{}, but {resolved}, and {bound} is excluded: a run {length} times as long may tell, or a \
             smaller step{estimator}",
            self.size()
        )
    }

    fn why_not_smooth(&self) -> String {
        format!(
            "{}, most of it from forces that are not smooth; in {} steps {}",
            self.size(),
            self.steps,
            self.permanent()
        )
    }

    fn why_inconsistent(&self) -> String {
        if self.mismatches > 0 {
            return format!(
                "in {} of {} windows the states differ from the increments of the steps: plain steps were made where \
                 needs_increments() is true, or q or p were changed between the steps",
                self.mismatches, self.windows
            );
        }
        if self.wrong_rates > 0 {
            return format!(
                "in {} windows the rate is not qᵀU_q − 2U: compare them (in Rust with check_potential). A virial by \
                    nearest images is not qᵀU_q",
                self.wrong_rates
            );
        }
        format!(
            "the states do not belong to the increments, or the rate is not qᵀU_q − 2U (compare them, in Rust with \
             check_potential): H − H̄ is {} rms, and H̄ moved by {}, too much beside an energy error of {}",
            short(&self.method_rms),
            short(&self.moved),
            short(&self.energy_error)
        )
    }

    fn why_too_large(&self, criterion: Criterion, moved: &str) -> String {
        // a wrapped angle or a changed momentum changes H̄, too
        let other = "or something other than the scheme that changed the state";
        match criterion {
            Criterion::Moved => format!(
                "{moved}, permanently, where round-off makes {}: no modified energy is conserved. Forces that are not smooth, \
                 {other}, have such effects, too",
                self.in_parts(&self.round_off)
            ),
            Criterion::EnergyError if self.relative_error().is_finite() => {
                format!("the energy error is {:.1e} of the mean kinetic energy", self.relative_error())
            }
            Criterion::EnergyError => {
                "the mean kinetic energy is 0 while the positions change: half a turn a step, or more".to_owned()
            }
            Criterion::Lost => {
                let (i, steps) = self.lost_coordinate.expect("the verdict follows from it");
                format!(
                    "{} turned once in {steps:.1} steps at the start, and no longer does: the steps do not resolve \
                     it, however little of the energy it has",
                    self.coordinate(i)
                )
            }
            Criterion::NotFinite => match self.not_finite {
                Some(n) => format!("a state or its energy is not finite from step {n} on: the steps diverge"),
                None => "the energies overflow: the steps diverge".to_owned(),
            },
        }
    }
}

impl<N: Real> fmt::Display for Report<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Report { steps, windows, .. } = self;
        writeln!(f, "{} ({steps} steps, {windows} windows)", self.conclusion())?;
        if *windows == 0 {
            return write!(f, "  {}", self.reason());
        }
        let part = |energy: &N| match self.part(energy) {
            part if part.is_finite() => format!("{part:.1e} of the energy error"),
            _ if self.has_no_energy_error() => "where the energy error is 0".to_owned(),
            _ => "overflow".to_owned(),
        };
        let line = |f: &mut fmt::Formatter<'_>, name: &str, value: &N, text: &str| {
            // the bar of H̄ is a character, and takes no column
            let width = 18 + name.matches('\u{304}').count();
            writeln!(f, "  {name:<width$}{:>10}  {text}", short(value))
        };
        let of_kinetic = match self.relative_error() {
            part if part.is_finite() => format!("{part:.1e} of T"),
            _ => format!("T is {}", short(&self.kinetic)),
        };
        line(f, "energy error", &self.energy_error, &format!("max − min of H; {of_kinetic}"))?;
        match self.method().map(|all| all.map(short)) {
            Some([rms, least, largest]) => {
                let range = format!("rms of H − H̄, which is from {least} to {largest}");
                writeln!(f, "  {:<18}{rms:>10}  {range}", "the method's part")?;
            }
            None => {
                let known = format!("H̄ is known to {} rms only", short(&self.method_resolution));
                writeln!(f, "  {:<18}{:>10}  not resolved: {known}", "the method's part", "–")?;
            }
        }
        // where the energy is lost, windows with accurate estimates are few
        let trend = self.trend.filter(|_| !self.verdict.loses_the_energy());
        let trend = trend.map_or(String::new(), |trend| format!(", {trend}"));
        line(f, "permanent change", &self.range, &format!("max − min of H̄; {}{trend}", part(&self.range)))?;
        line(
            f,
            "H̄ changed by",
            &self.change,
            &format!("from the beginning to the end; it moved by {} beyond its errors", short(&self.moved)),
        )?;
        if let Some(resolution) = &self.resolution {
            line(f, "H̄ is known to", resolution, &part(resolution))?;
        }
        line(f, "round-off", &self.round_off, &format!("{}, expected by Brouwer's law", part(&self.round_off)))?;
        if let Some(bound) = self.permanent_bound.as_ref().filter(|_| !self.verdict.loses_the_energy()) {
            line(f, "net change", bound, &format!("{}, at most", part(bound)))?;
        }
        if let Some(turn) = self.steps_per_turn {
            writeln!(f, "  {:<18}{turn:>10.1}  steps a turn", "fastest motion")?;
        }
        if let Some(Rough { least, most }) = self.rough {
            let gain = format!("derivatives of U jump: schemes gain up to order {most} at best");
            writeln!(f, "  {:<18}{:>10}  {gain}", "not smooth", format!("{least} to {most}"))?;
        }
        write!(f, "  {}", self.reason())
    }
}

impl fmt::Display for Trend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Trend::Steady => "steady",
            Trend::RandomWalk => "a random walk",
            Trend::Linear => "linear in time",
        })
    }
}

/// Three digits, also of a number outside the range of `f64`.
fn short<N: Real>(number: &N) -> String {
    if !number.is_finite() {
        return "not finite".to_owned();
    }
    let value = number.to_f64();
    let log10 = number.log10_abs();
    if value.is_normal() || log10 == f64::NEG_INFINITY {
        return format!("{value:.2e}");
    }
    let (mut exponent, mut mantissa) = (log10.floor(), 10_f64.powf(log10 - log10.floor()));
    if mantissa >= 9.995 {
        (exponent, mantissa) = (exponent + 1.0, 1.0);
    }
    let sign = if number.is_below_zero() { "-" } else { "" };
    format!("{sign}{mantissa:.2}e{exponent}")
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn short_texts_of_long_numbers() {
        assert_eq!([0.0, -1.5, 123456.0].map(|x| short(&x)), ["0.00e0", "-1.50e0", "1.23e5"]);
        // 5e-324 is subnormal
        assert_eq!(short(&-5e-324), "-4.94e-324");
        assert_eq!([f64::INFINITY, f64::NAN].map(|x| short(&x)), ["not finite"; 2]);
    }
}
