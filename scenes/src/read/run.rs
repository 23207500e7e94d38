//! [run]: the scheme, its steps and the digits.

use std::ops::Range;

use shadowstep::{Rational, StepSize};
use shadowstep_schemes::First;
use toml::de::DeValue;

use super::reader::Reader;
use crate::arithmetic::{Arithmetic, MOST_DIGITS};
use crate::expression::Condition;
use crate::library::{LibraryError, NamedScheme, Schemes, check_displaced};
use crate::note::Note;
use crate::readable::{LONGEST_NUMBER, shortened};
use crate::refusal::Refusal;
use crate::scene::System;
use crate::scene::split::{Class, Needs};
use crate::steps::{self, MOST_STEPS};
use shadowstep_schemes::document::{Section, Text, Value};

/// The number type, to whose digits all values of the scene are computed.
pub(super) fn arithmetic(reader: &mut Reader<'_>, run: &Section<'_, '_>) -> Option<Arithmetic> {
    let mpfr = run.get("mpfr").and_then(|value| reader.toml.truth(value)).filter(|mpfr| mpfr.value);
    let named = match run.get("digits") {
        None => Some(Arithmetic::DOUBLE),
        Some(value) if matches!(value.get_ref(), DeValue::String(_)) => Some(named_or_quoted(reader, value)?),
        Some(_) => None,
    };
    if let Some(named) = named {
        return match mpfr {
            Some(mpfr) => reader.toml.wrong(&mpfr.at, "mpfr requires a number of digits", "write digits = 120"),
            None => Some(named),
        };
    }
    let digits = u32::try_from(reader.whole(run.get("digits")?, 1..=MOST_DIGITS.into())?).ok()?;
    match Arithmetic::of_digits(digits, mpfr.is_some()) {
        Ok(arithmetic) => Some(arithmetic),
        Err(error) => reader.toml.wrong(&run.at, error.to_string(), "write digits = 120"),
    }
}

/// The number type that a text names.
fn named_or_quoted(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Arithmetic> {
    match value.get_ref().as_str().filter(|text| text.parse::<u32>().is_ok()) {
        Some(digits) => {
            let hint = format!("write digits = {digits}");
            reader.toml.wrong(&value.span(), "the number of digits is in quotes", hint)
        }
        None => reader.word(value, Arithmetic::NAMED),
    }
}

/// The map that steps begin with.
pub(super) fn first(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<First> {
    reader.word(value, &[("kick", First::Kick), ("drift", First::Drift)])
}

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
        run: &Section<'_, '_>,
        (system, transformed): (Option<&System>, bool),
        schemes: &Schemes,
    ) -> Option<Steps> {
        let first = run.get("first").map(|value| first(reader, value));
        let scheme = match run.get("scheme") {
            Some(value) => {
                reader.toml.text(value).and_then(|text| scheme(reader, &text, first.flatten(), system, schemes))
            }
            None => {
                reader.toml.missing(run, &["scheme"]);
                None
            }
        };
        let displaced = match run.get("gradient_kicks") {
            None => Some(None),
            Some(value) => {
                reader.word(value, &[("exact", false), ("displaced", true)]).map(|wanted| Some((value.span(), wanted)))
            }
        };
        let times = times(reader, run, (system, transformed));
        let ends = match run.get("end") {
            None => Some(None),
            Some(value) => condition(reader, value, system).map(Some),
        };
        if matches!(first, Some(None)) {
            return None;
        }
        let (h, until, steps) = times?;
        let scheme = scheme?;
        let displaced =
            displaced?.map_or(Some(false), |(at, wanted)| displaced_forces(reader, &at, wanted, &scheme))?;
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
        Err(LibraryError::NotFound { message, hint }) => return reader.toml.wrong(&word.at, message, hint),
        Err(LibraryError::Faults(faults)) => {
            reader.toml.faults.extend(faults.0);
            return None;
        }
    };
    // of a system that cannot be read, the number of parts is not known
    let unknown = || Needs { parts: 3, ..Needs::of_class(Class::Quadratic) };
    let needs = system.map_or_else(unknown, System::needs);
    let note = named.note();
    let named = match needs.scheme(named, schemes) {
        Ok(named) => named,
        Err(Refusal { message, hint }) => return reader.toml.wrong(&word.at, message, hint),
    };
    reader.notes.extend(note);
    if needs.class == Class::ManyParts {
        reader.notes.extend(near_integrable(&named));
    }
    match schemes.fitted(reader.arithmetic, named) {
        Ok((named, note)) => {
            reader.notes.extend(note);
            Some(named)
        }
        Err(Refusal { message, hint }) => reader.toml.wrong(&word.at, message, hint),
    }
}

/// A note on a near-integrable scheme, whose claim is for two parts.
fn near_integrable(named: &NamedScheme) -> Option<Note> {
    let proved = named.scheme.proved();
    proved.scheme.table.near_integrable.as_ref()?;
    Some(Note::NearIntegrable { scheme: named.name.clone(), order: proved.proof.many_parts.as_ref()?.order })
}

/// Whether gradient kicks are by displaced forces, which the scheme must allow.
fn displaced_forces(reader: &mut Reader<'_>, at: &Range<usize>, wanted: bool, named: &NamedScheme) -> Option<bool> {
    match check_displaced(named) {
        Err(Refusal { message, hint }) if wanted => reader.toml.wrong(at, message, hint),
        _ => Some(wanted),
    }
}

/// A condition on a state of the system.
fn condition(reader: &mut Reader<'_>, value: &Value<'_>, system: Option<&System>) -> Option<Condition> {
    let text = reader.toml.text(value)?;
    let condition = Condition::read(&mut reader.toml, &text)?;
    let before = reader.toml.faults.len();
    if let Some(system) = system {
        system.check(condition.difference(), &mut reader.toml);
    }
    (reader.toml.faults.len() == before).then_some(condition)
}

/// h, the end and the number of steps.
type Times = (StepSize, Option<Rational>, Option<u64>);

/// h, the end and the number of steps; in transformed time h is a fictitious time and the end a physical one.
fn times(
    reader: &mut Reader<'_>,
    run: &Section<'_, '_>,
    (system, transformed): (Option<&System>, bool),
) -> Option<Times> {
    let value = |reader: &mut Reader<'_>, key| {
        let text = run.get(key).and_then(|value| reader.number(value))?;
        let exact = reader.evaluate(&text)?;
        Some((text, exact.value))
    };
    let step = value(reader, "step");
    let until = value(reader, "until");
    let steps = run.get("steps").map(|value| (value.span(), reader.whole(value, 1..=MOST_STEPS)));
    if run.get("step").is_none() {
        reader.toml.missing(run, &["step"]);
    }
    if run.get("until").is_none() && steps.is_none() {
        reader.toml.missing(run, &["until", "steps"]);
    }
    if let (Some(_), Some((at, _))) = (run.get("until"), &steps) {
        return reader.toml.wrong(at, "until and steps are both given", "keep one of the two");
    }
    let (step, h) = step?;
    let h = match StepSize::try_from(h) {
        Ok(h) => h,
        Err(zero) => {
            return reader.toml.wrong(
                &step.at,
                format!("step {}: {zero}", step.value),
                "write a step size such as 1/10",
            );
        }
    };
    if let Some((_, steps)) = steps {
        let steps = steps?;
        let until = (!transformed).then(|| h.exact() * Rational::from_integer(steps.into()));
        return Some((h, until, Some(steps)));
    }
    let (end, until) = until?;
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
