//! The report of a monitor as text.

use std::fmt;

use super::report::Report;
use super::roughness::Rough;
use super::thresholds::{FEW_STEPS, PERMANENT_LIMIT};
use super::trend::Trend;
use super::verdict::Verdict;
use super::whole_run::WholeRun;
use crate::number::Real;
use crate::shadow::rules::filled;

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
        filled(self.sentence, |name| self.named(name))
    }

    /// What a name in the sentence of a rule stands for.
    fn named(&self, name: &str) -> String {
        let run = self.run.unwrap_or(WholeRun::NOTHING);
        let range = run.range.unwrap_or(f64::NAN);
        match name {
            "steps" => self.steps.to_string(),
            "windows" => self.windows.to_string(),
            "least windows" => Verdict::LEAST_WINDOWS.to_string(),
            "mismatches" => self.mismatches.to_string(),
            "wrong rates" => self.wrong_rates.to_string(),
            "size" => self.size(),
            "energy error" => short(&self.energy_error),
            "method" => short(&self.method_rms),
            "move" => short(&self.moved),
            "moved" => format!("the modified energy moved by {} in {} steps", self.in_parts(&self.moved), self.steps),
            "change" => short(&self.change),
            "expected" => short(&self.round_off),
            "round-off" => self.in_parts(&self.round_off),
            "turn" => format!("{:.3}", self.steps_per_turn.unwrap_or_default()),
            "permanent" => self.permanent(),
            "resolved" => self.resolved_coordinate(),
            "bounded" => self.why_bounded(),
            "too large" => self.why_too_large(),
            "permanent change" => self.permanent_change.as_ref().map_or(String::new(), |change| self.in_parts(change)),
            "turns" => self
                .steps_per_turn
                .map_or(String::new(), |steps| format!("the fastest motion turns once in {steps:.0} steps, ")),
            "known" => match &self.worst_error {
                Some(error) => format!("H̄ is known to within {} where it is known least", self.in_parts(error)),
                None => "the errors of H̄ are not known".to_owned(),
            },
            "bound" => match &self.permanent_bound {
                Some(bound) => format!("a net change above {}", self.in_parts(bound)),
                None => "no change".to_owned(),
            },
            "length" => self.advice.map_or(0, |advice| advice.length).to_string(),
            "estimator" => self
                .advice
                .and_then(|advice| advice.order)
                .map_or(String::new(), |order| format!(", or the estimator E_{order} or D_{order}")),
            "largest of all" => format!("{:.1e}", run.largest),
            "last of all" => format!("{:.1e}", run.last),
            "range of all" => format!("{:.1e}", range / self.kinetic.to_f64()),
            "permanent of all" => {
                format!("{:.1}", 100.0 * self.permanent_change.as_ref().map_or(0.0, N::to_f64) / range)
            }
            "resonance" => match self.verdict {
                Verdict::NearResonance { turns, steps } => format!("{turns}/{steps}"),
                _ => String::new(),
            },
            "lost" => self
                .lost_coordinate
                .map_or(String::new(), |(i, steps)| format!("{} turned once in {steps:.1} steps", self.coordinate(i))),
            "not finite" => match self.not_finite {
                Some(n) => format!("a state or its energy is not finite from step {n} on"),
                None => "the energies overflow".to_owned(),
            },
            other => unreachable!("a sentence with {other}"),
        }
    }

    fn why_bounded(&self) -> String {
        if self.has_no_energy_error() {
            return format!("the energy is the same in all windows of {} steps", self.steps);
        }
        format!(
            "{}; in {} steps {}{}{}",
            self.size(),
            self.steps,
            self.permanent(),
            self.unresolved(),
            self.light_coordinate()
        )
    }

    fn why_too_large(&self) -> String {
        match self.relative_error() {
            part if part.is_finite() => format!("the energy error is {part:.1e} of the mean kinetic energy"),
            _ => "the mean kinetic energy is 0 while the positions change: half a turn a step, or more".to_owned(),
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
