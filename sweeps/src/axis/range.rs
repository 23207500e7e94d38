//! Ranges: `1/10 … 1/100 in 19 steps of 1/h`.

use std::collections::BTreeMap;

use num_traits::{Signed, Zero};
use shadowstep::Rational;
use shadowstep_schemes::document::{Reader, Text};
use shadowstep_symbolic::decimal::{round_significant, to_text};
use shadowstep_symbolic::{evaluate, parse};

use super::number::evaluated;

/// Values of a logarithmic range are rounded to this many digits, and are exact from there on.
const LOGARITHMIC_DIGITS: u32 = 12;

/// The most values.
const MOST: u64 = 1_000_000_000_000;

const EXAMPLES: &str = "write a range such as \"0 … 9/10 in 18 steps\" or \"1/10 … 1/100 in 19 steps of 1/h\"";

/// Values from one number to another.
#[derive(Clone, Debug)]
pub(super) struct Range {
    from: Rational,
    to: Rational,
    /// One less than the number of values.
    steps: u64,
    rule: Rule,
}

/// What has equal distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    Value,
    Reciprocal,
    Logarithm,
}

impl Range {
    pub(super) fn read(reader: &mut Reader<'_>, name: &str, text: &Text) -> Option<Range> {
        let Some(parts) = Parts::of(&text.value) else {
            return reader.wrong(&text.at, "this text is not a range", EXAMPLES);
        };
        let mut end = |part: &str| match evaluated(part) {
            Ok(value) => Some(value),
            Err(error) => reader.wrong(&text.at, format!("`{part}`: {error}"), EXAMPLES),
        };
        let (from, to) = (end(parts.from)?, end(parts.to)?);
        let steps = match parts.count.parse::<u64>() {
            Ok(count) if parts.of_values && (2..=MOST).contains(&count) => count - 1,
            Ok(count) if !parts.of_values && (1..MOST).contains(&count) => count,
            _ => {
                let (least, unit) = if parts.of_values { (2, "values") } else { (1, "steps") };
                let message = format!("`{}` is not a number of {unit}", parts.count);
                return reader.wrong(&text.at, message, format!("write a whole number from {least} to {MOST}"));
            }
        };
        let Some(rule) = Rule::of(parts.rule, name) else {
            let hint = format!("write `of {name}`, `of 1/{name}` or `of log({name})`");
            return reader.wrong(&text.at, format!("`of {}` is not known here", parts.rule.unwrap_or_default()), hint);
        };
        let same_sign = (from.is_positive() && to.is_positive()) || (from.is_negative() && to.is_negative());
        if rule != Rule::Value && !same_sign {
            let message = "both ends of such a range must have the same sign and be nonzero";
            return reader.wrong(&text.at, message, format!("write `of {name}`, or another end"));
        }
        if from == to {
            return reader.wrong(&text.at, "both ends of the range are equal", EXAMPLES);
        }
        Some(Range { from, to, steps, rule })
    }

    pub(super) fn count(&self) -> u64 {
        self.steps + 1
    }

    pub(super) fn is_logarithmic(&self) -> bool {
        self.rule == Rule::Logarithm
    }

    /// The k-th value; the first and the last one are the ends.
    pub(super) fn value(&self, k: u64) -> Rational {
        let Range { from, to, steps, .. } = self;
        let part = Rational::new(k.into(), (*steps).into());
        let between = |from: &Rational, to: &Rational| from + &(&(to - from) * &part);
        match self.rule {
            _ if k == 0 => from.clone(),
            _ if k == *steps => to.clone(),
            Rule::Value => between(from, to),
            Rule::Reciprocal => between(&from.recip(), &to.recip()).recip(),
            Rule::Logarithm => {
                // a^(1 − part) b^part
                let text = format!("log({}) + log({}) * ({part})", to_text(&from.abs()), to_text(&(to / from)));
                let value = parse(&format!("exp({text})"))
                    .ok()
                    .and_then(|expression| evaluate(&expression, &BTreeMap::new(), LOGARITHMIC_DIGITS + 10).ok());
                let size = value.expect("the ends are positive").value;
                let rounded = round_significant(&size, LOGARITHMIC_DIGITS);
                if from.is_negative() { Rational::zero() - rounded } else { rounded }
            }
        }
    }
}

impl Rule {
    fn of(rule: Option<&str>, name: &str) -> Option<Rule> {
        let Some(rule) = rule else { return Some(Rule::Value) };
        let rule: String = rule.chars().filter(|c| !c.is_whitespace()).collect();
        match rule {
            rule if rule == name => Some(Rule::Value),
            rule if rule == format!("1/{name}") => Some(Rule::Reciprocal),
            rule if rule == "log" || rule == format!("log({name})") => Some(Rule::Logarithm),
            _ => None,
        }
    }
}

/// The parts of the text of a range.
struct Parts<'a> {
    from: &'a str,
    to: &'a str,
    count: &'a str,
    /// Whether values are counted, and not steps.
    of_values: bool,
    rule: Option<&'a str>,
}

impl<'a> Parts<'a> {
    fn of(text: &'a str) -> Option<Parts<'a>> {
        let (from, rest) = text.split_once('…').or_else(|| text.split_once("..."))?;
        let (to, rest) = rest.split_once(" in ")?;
        let (count, rest) = rest.trim().split_once(' ')?;
        let (unit, rule) = match rest.trim().split_once(' ') {
            None => (rest.trim(), None),
            Some((unit, rule)) => (unit, Some(rule.trim().strip_prefix("of ")?)),
        };
        let of_values = match unit {
            "values" => true,
            "steps" | "step" => false,
            _ => return None,
        };
        Some(Parts { from: from.trim(), to: to.trim(), count, of_values, rule })
    }
}
