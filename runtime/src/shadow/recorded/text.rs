//! A diagnosis as text.

use std::fmt;

use super::cause::Cause;
use super::changes::Jump;
use super::diagnosis::Diagnosis;
use super::judge::LEAST_ESTIMATES;
use super::misfit::Differences;
use super::roughness::Smoothness;

impl Diagnosis {
    /// The cause with its size, a sentence.
    pub fn reason(&self) -> String {
        let moved = self.moved();
        match self.cause {
            Cause::Undecided => self.why_undecided(),
            Cause::OtherSteps => other_steps(self.reordered, self.differences),
            Cause::Nothing => {
                format!("the modified energy is conserved: it is known to {:.1e}, and {moved}", self.known_to)
            }
            Cause::Digits => format!(
                "the modified energy is known to {:.1e} only, as the states are stored with few digits: q to {:.1e} \
                    of itself",
                self.known_to,
                self.differences.map_or(f64::NAN, |[of_q, _]| of_q.of_numbers / 2_f64.sqrt())
            ),
            Cause::NoisyEnergy { size } => format!(
                "the modified energy is known to {:.1e} only, as the logged U has errors of {size:.1e} rms that are \
                 independent from state to state; the states do not show that anything moves the energy",
                self.known_to
            ),
            Cause::Jumps { size } => {
                format!("{moved}: it jumps {}, by {size:.2e} rms. {}", self.where_it_jumps(), LATE)
            }
            Cause::NotTheGradient => format!("{moved}: the forces are smooth, and are not −U_q of the logged U"),
            Cause::EnergyNotSmooth { size } => {
                format!("{moved}: U jumps all the time, by {size:.2e} rms in a step, as where a potential is truncated")
            }
            Cause::Noise { size } => format!(
                "{moved}: the forces have errors that are independent from step to step, of {size:.2e} rms in each \
                    component, {:.1e} of the forces",
                size / self.smoothness.map_or(f64::NAN, |smoothness| smoothness.size)
            ),
            Cause::ForcesNotSmooth => format!("{moved}: the forces are not smooth, as at a cutoff"),
            Cause::TimeStep if self.is_too_large_a_step() => format!(
                "the time step is too large: H − H̄, the method's part of the energy error, ranges over {:.2e}, \
                    {:.1e} of T",
                self.method_error,
                self.method_error / self.kinetic
            ),
            Cause::TimeStep => format!("{moved}: the forces are smooth, and the time step is too large for them"),
        }
    }

    fn why_undecided(&self) -> String {
        if self.estimates < LEAST_ESTIMATES {
            return format!(
                "not decided: there are {} estimates, and {LEAST_ESTIMATES} are needed: log more states",
                self.estimates
            );
        }
        let Some(excess) = self.excess else {
            return "not decided: no forces are logged".to_owned();
        };
        let moved = self.moved();
        let (undecided, next) = if self.may_cancel() {
            (
                "to and fro, or with steps that do not resolve the motion; estimates are means over nine states, in \
                 which what U jumps by, or forces that are not −U_q, may cancel"
                    .to_owned(),
                "steps of half the size tell whether anything does",
            )
        } else if self.has_large_jumps() {
            (
                format!("it jumps {}, by as much as the kinetic energy", self.where_it_jumps()),
                "look at these states: steps that are too large there do that, or a state that is changed",
            )
        } else if excess > 1.0 {
            ("by more than errors of the forces explain: U jumps, or the forces are not −U_q".to_owned(), SMALLER)
        } else if self.is_independent() {
            (
                "independently from step to step: the forces have errors, or are not smooth, or the steps are too \
                large"
                    .to_owned(),
                SMALLER,
            )
        } else if !self.is_resolved() {
            ("with steps that do not resolve the motion: that moves it, or hides what does".to_owned(), SMALLER)
        } else {
            (
                format!("and the estimates have errors of {:.1e}", self.known_to),
                "more states, or steps of half the size, may decide it",
            )
        };
        format!("not decided: {moved}, {undecided}; {next}")
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

/// What tells causes apart that large steps hide.
const SMALLER: &str = "steps of half the size tell these apart";

/// What makes such jumps.
const LATE: &str = "A list of neighbours that is renewed too late does that, or a state that is changed";

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
        f.write_str(match self {
            Cause::OtherSteps => "other steps",
            Cause::Nothing => "nothing moves the energy",
            Cause::Digits => "too few digits",
            Cause::NoisyEnergy { .. } => "noise of the logged U",
            Cause::Jumps { .. } => "jumps",
            Cause::NotTheGradient => "not the gradient",
            Cause::EnergyNotSmooth { .. } => "the energy is not smooth",
            Cause::Noise { .. } => "noise of the forces",
            Cause::ForcesNotSmooth => "the forces are not smooth",
            Cause::TimeStep => "the time step",
            Cause::Undecided => "not decided",
        })
    }
}
