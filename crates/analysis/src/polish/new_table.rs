//! The new table: its text, read and proved like any table, and whether its conditions hold to the requested digits.

use shadowstep_schemes::symbolic::Rational;

use crate::polish::newton::{Problem, Solution};
use crate::polish::outcome::NotPolished;
use crate::polish::rounded;
use crate::polish::write::{self, Written};
use shadowstep_schemes::document::{Faults, Source};
use shadowstep_schemes::exact::DIGITS;
use shadowstep_schemes::library::Library;
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{Proved, counted, read};

/// With this number of digits the proof can decide every condition up to the highest order.
const ENOUGH_TO_PROVE: u32 = 20;

/// The new table, and what holds of it.
pub(super) struct NewTable {
    pub(super) digits: u32,
    pub(super) x: Vec<Rational>,
    pub(super) written: Vec<Written>,
    pub(super) text: String,
    pub(super) proved: Proved,
    /// log10 of how far a condition is off, at most.
    pub(super) residual: f64,
}

impl NewTable {
    /// Writes the solution with `digits` digits, and proves what is written.
    pub(super) fn of(
        problem: &Problem<'_>,
        table: &Table,
        names: &[String],
        solution: &Solution,
        digits: u32,
        library: Library<'_>,
    ) -> Result<NewTable, NotPolished> {
        let (x, written) = rounded::rounded(problem.model, names, solution, digits);
        let text = write::text(table, problem.model, names, &written, digits)?;
        let source = Source { path: table.source.path.clone(), text: text.clone() };
        let proved = read(&source, library).map_err(|faults| not_proved(&faults, digits))?;
        let residual = problem.residual(&x, digits);
        Ok(NewTable { digits, x, written, text, proved, residual })
    }

    /// To how many digits the conditions hold.
    pub(super) fn holds(&self) -> u32 {
        self.proved.order().digits.unwrap_or(u32::MAX).min((-self.residual).max(0.0) as u32)
    }

    /// Refuses a table whose conditions hold to fewer digits than requested, because of what was not polished.
    pub(super) fn is_enough(&self) -> Result<(), NotPolished> {
        let (holds, digits) = (self.holds(), self.digits);
        if holds >= digits {
            return Ok(());
        }
        let hint = match self.proved.scheme.held {
            Held::Digits(held) if held < digits => {
                format!("the base has {}: polish its table first", counted(held, "digit"))
            }
            _ => format!("closed forms are held to {DIGITS} digits: ask for fewer, such as --digits {}", holds.max(1)),
        };
        let message = format!("the conditions hold to {}, not to {digits}", counted(holds, "digit"));
        Err(NotPolished::Unsolved { message, hint })
    }
}

/// The faults are in a text that nobody has seen.
fn not_proved(faults: &Faults, digits: u32) -> NotPolished {
    if digits < ENOUGH_TO_PROVE {
        let verb = if digits == 1 { "is" } else { "are" };
        return NotPolished::Unsolved {
            message: format!("{} {verb} too few to prove that the conditions hold", counted(digits, "digit")),
            hint: format!("request more, such as --digits {ENOUGH_TO_PROVE}"),
        };
    }
    let message = faults.0.first().map_or("", |fault| fault.message.as_str());
    NotPolished::Unsolved {
        message: format!("the polished table would not be proved: {message}"),
        hint: "check the printed table with `shadowstep schemes check`".to_owned(),
    }
}
