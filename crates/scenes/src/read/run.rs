//! [run]: the scheme, its steps and the digits.

use std::ops::Range;

use shadowstep::{Rational, StepSize};
use shadowstep_schemes::First;

use super::reader::Reader;
use crate::document::expression::Condition;
use crate::document::library::{LibraryError, NamedScheme, Schemes, check_displaced};
use crate::document::schema::Table;
use crate::run::arithmetic::Arithmetic;
use crate::run::note::Note;
use crate::run::steps;
use crate::scene::System;
use crate::scene::split::{Class, Needs};
use crate::texts::readable::{LONGEST_NUMBER, shortened};
use shadowstep_schemes::document::Text;
use shadowstep_schemes::symbolic::Exact;

/// The number type, to whose digits all values of the scene are computed.
pub(super) fn arithmetic(reader: &mut Reader<'_>, run: &Table<'_, '_>) -> Option<Arithmetic> {
    let Some(digits) = run.whole("digits") else {
        let named = run.word("digits", Arithmetic::NAMED).unwrap_or(Arithmetic::DOUBLE);
        return match run.get("mpfr").filter(|_| run.truth("mpfr") == Some(true)) {
            Some(mpfr) => reader.toml.wrong(&mpfr.span(), "mpfr requires a number of digits", "write digits = 120"),
            None => Some(named),
        };
    };
    let digits = u32::try_from(digits).ok()?;
    match Arithmetic::of_digits(digits, run.truth("mpfr") == Some(true)) {
        Ok(arithmetic) => Some(arithmetic),
        Err(error) => reader.toml.wrong(&run.at, error.to_string(), "write digits = 120"),
    }
}

/// The maps that steps begin with.
pub(super) const FIRST: [(&str, First); 2] = [("kick", First::Kick), ("drift", First::Drift)];

/// The section [run].
pub(super) struct Steps {
    pub(super) scheme: NamedScheme,
    /// As in [`Scene`](crate::scene::Scene).
    pub(super) displaced: bool,
    pub(super) h: StepSize,
    /// As in [`Scene`](crate::scene::Scene).
    pub(super) until: Option<Rational>,
    /// `None` where only the steps themselves have their times.
    pub(super) steps: Option<u64>,
    /// As in [`Scene`](crate::scene::Scene).
    pub(super) end_at: Range<usize>,
    /// As in [`Scene`](crate::scene::Scene).
    pub(super) ends: Option<Condition>,
}

impl Steps {
    /// For this system, `None` if it cannot be read, and whether its time is transformed.
    pub(super) fn read(
        reader: &mut Reader<'_>,
        run: &Table<'_, '_>,
        (system, transformed): (Option<&System>, bool),
        schemes: &Schemes,
    ) -> Option<Steps> {
        let first = run.word("first", &FIRST);
        let scheme = run.text("scheme").and_then(|text| scheme(reader, &text, first, system, schemes));
        let times = times(reader, run, (system, transformed));
        let ends = match run.text("end") {
            None => Some(None),
            Some(text) => condition(reader, &text, system).map(Some),
        };
        let ((h, until, steps), scheme) = (times?, scheme?);
        let displaced = displaced_forces(reader, run, &scheme)?;
        let end_at = run.get("until").or(run.get("steps")).map_or(run.at.clone(), |value| value.span());
        Some(Steps { scheme, displaced, h, until, steps, end_at, ends: ends? })
    }
}

/// Whether a scheme is the file of a table.
pub(super) fn is_table(word: &str) -> bool {
    word.contains(['.', '/', '\\'])
}

fn scheme(
    reader: &mut Reader<'_>,
    word: &Text,
    first: Option<First>,
    system: Option<&System>,
    schemes: &Schemes,
) -> Option<NamedScheme> {
    if reader.is_cursory && is_table(&word.value) {
        return None;
    }
    let named = match schemes.scheme_of(&word.value, reader.toml.source, first) {
        Ok(named) => named,
        Err(LibraryError::NotFound(refusal)) => return reader.found(&word.at, Err(refusal)),
        Err(LibraryError::Faults(faults)) => {
            reader.toml.faults.extend(faults.0);
            return None;
        }
    };
    // of a system that cannot be read, the number of parts is not known
    let unknown = || Needs { parts: 3, ..Needs::of_class(Class::Quadratic) };
    let needs = system.map_or_else(unknown, System::needs);
    let note = named.note();
    let named = reader.found(&word.at, needs.scheme(named, schemes))?;
    reader.notes.extend(note);
    if needs.class == Class::ManyParts {
        reader.notes.extend(near_integrable(&named));
    }
    let (named, note) = reader.found(&word.at, schemes.fitted(reader.arithmetic, named))?;
    reader.notes.extend(note);
    Some(named)
}

/// A note on a near-integrable scheme, whose claim is for two parts.
fn near_integrable(named: &NamedScheme) -> Option<Note> {
    let proved = named.scheme.proved();
    proved.scheme.table.near_integrable.as_ref()?;
    Some(Note::NearIntegrable { scheme: named.name.clone(), order: proved.proof.many_parts.as_ref()?.order })
}

/// Whether gradient kicks are by displaced forces, which the scheme must allow.
fn displaced_forces(reader: &mut Reader<'_>, run: &Table<'_, '_>, named: &NamedScheme) -> Option<bool> {
    if run.str("gradient_kicks") != Some("displaced") {
        return Some(false);
    }
    reader.found(&run.place("gradient_kicks"), check_displaced(named)).map(|()| true)
}

/// A condition on a state of the system.
fn condition(reader: &mut Reader<'_>, text: &Text, system: Option<&System>) -> Option<Condition> {
    let condition = Condition::read(&mut reader.toml, text)?;
    match system {
        Some(system) => system.check(condition.difference(), &mut reader.toml).map(|()| condition),
        None => Some(condition),
    }
}

/// h, the end and the number of steps.
type Times = (StepSize, Option<Rational>, Option<u64>);

/// h, the end and the number of steps; in transformed time h is a fictitious time and the end a physical one.
fn times(
    reader: &mut Reader<'_>,
    run: &Table<'_, '_>,
    (system, transformed): (Option<&System>, bool),
) -> Option<Times> {
    let (step, until) = (reader.value(run, "step"), reader.value(run, "until"));
    let (step, h) = step?;
    let h = StepSize::try_from(h.value).ok()?;
    if let Some(steps) = run.whole("steps") {
        let until = (!transformed).then(|| h.exact() * Rational::from_integer(steps.into()));
        return Some((h, until, Some(steps)));
    }
    let (end, Exact { value: until, .. }) = until?;
    let (sized, ends) = ((&h, step.value.as_str()), (&until, &*shortened(&until, LONGEST_NUMBER)));
    let count = if transformed {
        let rate = system.and_then(System::rate_at_start);
        steps::check_physical_end(sized, ends, rate).map(|()| None)
    } else {
        steps::count(sized, ends).map(Some)
    };
    match count {
        Ok(count) => Some((h, Some(until), count)),
        Err(none) => {
            let at = if none.is_of_time() { &end.at } else { &step.at };
            reader.toml.wrong(at, none.to_string(), none.hint())
        }
    }
}
