//! A diagnosis as text.

use std::fmt;

use super::cause::Cause;
use super::changes::Jump;
use super::diagnosis::Diagnosis;
use super::misfit::Differences;
use super::roughness::Smoothness;
use super::thresholds::LEAST_ESTIMATES;
use crate::shadow::rules::filled;

impl Diagnosis {
    /// The cause with its size, a sentence.
    pub fn reason(&self) -> String {
        filled(self.decision().1, |name| self.named(name))
    }

    /// What a name in the sentence of a rule stands for.
    pub(super) fn named(&self, name: &str) -> String {
        let size = self.cause.size().unwrap_or(f64::NAN);
        match name {
            "estimates" => self.estimates.to_string(),
            "least estimates" => LEAST_ESTIMATES.to_string(),
            "method" => format!("{:.2e}", self.method_error),
            "method in T" => format!("{:.1e}", self.method_error / self.kinetic),
            "known" => format!("{:.1e}", self.known_to),
            "moved" => self.moved(),
            "digits" => {
                let of_q = self.differences.map_or(f64::NAN, |[of_q, _]| of_q.of_numbers);
                format!("{:.1e}", of_q / 2_f64.sqrt())
            }
            "short size" => format!("{size:.1e}"),
            "size" => format!("{size:.2e}"),
            "part of forces" => {
                format!("{:.1e}", size / self.smoothness.map_or(f64::NAN, |smoothness| smoothness.size))
            }
            "places" => self.where_it_jumps(),
            "other steps" => other_steps(self.reordered, self.differences),
            "undecided" => filled(self.why_undecided(), |name| self.named(name)),
            other => unreachable!("a sentence with {other}"),
        }
    }

    fn moved(&self) -> String {
        let [part, kinetic] = [self.range / self.energy_error, self.range / self.kinetic];
        format!(
            "the modified energy ranges over {:.2e}{}, {part:.1e} of the energy error and {kinetic:.1e} of T, in {}",
            self.range,
            self.units.energy(),
            self.units.time(self.time)
        )
    }

    fn where_it_jumps(&self) -> String {
        let mut first: Vec<i64> = self.jumps.iter().take(3).map(|Jump { n, .. }| *n).collect();
        first.sort_unstable();
        let places: Vec<String> = first.iter().map(i64::to_string).collect();
        format!("{} times, the most before the states {}", self.jumps.len(), places.join(", "))
    }
}

/// Why the states are not those of steps.
pub(super) fn other_steps(reordered: Option<i64>, differences: Option<[Differences; 2]>) -> String {
    if let Some(n) = reordered {
        return format!(
            "the order of the coordinates changes, first at the state {n}: sort each state by the numbers of its atoms"
        );
    }
    let [of_q, of_p] = differences.map_or([f64::NAN; 2], |differences| differences.map(|of| of.of_increments));
    format!(
        "the states are not those of velocity Verlet with these masses, forces and step size: the steps differ by \
         {of_q:.1e} (q) and {of_p:.1e} (p) of themselves, as with other masses or units of time, a thermostat, a \
         constraint, another integrator or step size, velocities in place of momenta, wrapped positions, or momenta \
         at half steps"
    )
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} ({} states, {} estimates)", self.cause, self.states, self.estimates)?;
        if self.estimates == 0 {
            return write!(f, "  {}", self.reason());
        }
        writeln!(
            f,
            "  energy error     {:9.2e}{}  max − min of H; {:.1e} of T",
            self.energy_error,
            self.units.energy(),
            self.energy_error / self.kinetic
        )?;
        writeln!(
            f,
            "  the method's part{:9.2e}  max − min of H − H̄; {:.1e} of T",
            self.method_error,
            self.method_error / self.kinetic
        )?;
        writeln!(
            f,
            "  H̄ ranges over    {:9.2e}  {:.2e} beyond its errors; from beginning to end {:+.2e}",
            self.range, self.moved, self.change
        )?;
        writeln!(f, "  it is known to   {:9.2e}", self.known_to)?;
        if let Some(Smoothness { size, differences, exponent }) = self.smoothness {
            writeln!(f, "  forces           {size:9.2e}  their differences {differences:.2e}, exponent {exponent:.2}")?;
        }
        if let Some(excess) = self.excess {
            writeln!(
                f,
                "  excess           {excess:9.2e}  growth {:.1}, isolation {:.1}",
                self.growth, self.isolation
            )?;
        }
        if let Some(of_energy) = self.energy_smoothness {
            writeln!(
                f,
                "  differences of U {:9.2e}  exponent {:.2}; H̄ changes by {:.2e} in a step",
                of_energy.differences, of_energy.exponent, self.in_a_step
            )?;
        }
        if let Some([of_q, of_p]) = self.differences {
            writeln!(
                f,
                "  states off steps {:9.2e}  of q, {:.2e} of p, as parts of the steps",
                of_q.of_increments, of_p.of_increments
            )?;
        }
        write!(f, "  {}", self.reason())
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words().1)
    }
}
