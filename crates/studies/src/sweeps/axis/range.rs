//! Ranges: `1/10 … 1/100 in 19 steps of 1/h`.

use num_traits::{Signed, Zero};
use shadowstep::Rational;
use shadowstep_schemes::document::{Reader, Text};
use shadowstep_schemes::symbolic::decimal::round_significant;

use super::number::{evaluated, geometric};

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
    pub(super) steps: u64,
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
            _ if part.is_empty() => reader.wrong(&text.at, "an end of the range is missing", EXAMPLES),
            Ok(value) => Some(value),
            Err(error) => {
                let begin = part.as_ptr() as usize - text.value.as_ptr() as usize;
                let range = error.range();
                reader.wrong(&text.place(&(begin + range.start..begin + range.end)), error.to_string(), EXAMPLES)
            }
        };
        let (from, to) = (end(parts.from)?, end(parts.to)?);
        let (least, unit) = if parts.of_values { (2, "values") } else { (1, "steps") };
        let Some(count) = parts.count.parse::<u64>().ok().filter(|count| (least..=MOST).contains(count)) else {
            let message = format!("`{}` is not a number of {unit}", parts.count);
            return reader.wrong(&text.at, message, format!("write a whole number from {least} to {MOST}"));
        };
        let steps = count + 1 - least;
        let Some(rule) = Rule::of(parts.rule, name) else {
            let hint = format!("write `of {name}`, `of 1/{name}` or `of log({name})`");
            return reader.wrong(&text.at, format!("`of {}` is not known here", parts.rule.unwrap_or_default()), hint);
        };
        if rule != Rule::Value && !(&from * &to).is_positive() {
            let message = "both ends of such a range must have the same sign and be nonzero";
            return reader.wrong(&text.at, message, format!("write `of {name}`, or another end"));
        }
        if from == to {
            return reader.wrong(&text.at, "both ends of the range are equal", EXAMPLES);
        }
        let range = Range { from, to, steps, rule };
        if rule == Rule::Logarithm && [1, steps / 2, steps - 1].into_iter().any(|k| range.power(k).is_none()) {
            let message = "these ends are too large or too small for logarithms";
            return reader.wrong(&text.at, message, format!("write `of {name}`, or other ends"));
        }
        Some(range)
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
            Rule::Logarithm => self.power(k).expect("the ends were checked"),
        }
    }

    /// a^(1 − k/steps) b^(k/steps) for the ends a and b.
    fn power(&self, k: u64) -> Option<Rational> {
        let part = Rational::new(k.into(), self.steps.into());
        let size = geometric(&self.from.abs(), &self.to.abs(), &part, LOGARITHMIC_DIGITS + 10)?;
        let rounded = round_significant(&size, LOGARITHMIC_DIGITS);
        Some(if self.from.is_negative() { Rational::zero() - rounded } else { rounded })
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

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep_schemes::document::{Source, document};

    fn read(text: &str) -> Result<Range, String> {
        let source = Source { path: "test.toml".to_owned(), text: format!("h = \"{text}\"") };
        let (document, _) = document(&source);
        let mut reader = Reader::new(&source, Vec::new());
        let text = reader.text(document.unwrap().get("h").unwrap()).unwrap();
        Range::read(&mut reader, "h", &text).ok_or_else(|| reader.faults[0].message.clone())
    }

    fn values(text: &str) -> Vec<Rational> {
        let range = read(text).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        (0..=range.steps).map(|k| range.value(k)).collect()
    }

    fn exact(texts: &[&str]) -> Vec<Rational> {
        texts.iter().map(|text| shadowstep::exact(text).unwrap()).collect()
    }

    #[test]
    fn values_are_exact() {
        assert_eq!(values("0 … 9/10 in 3 steps"), exact(&["0", "3/10", "6/10", "9/10"]));
        assert_eq!(values("0 ... 9/10 in 4 values"), values("0 … 9/10 in 3 steps of h"));
        assert_eq!(values("1 … -1/3 in 2 steps"), exact(&["1", "1/3", "-1/3"]));
        assert_eq!(values("0.1…0.3 in 1 step"), exact(&["1/10", "3/10"]));
        assert_eq!(values("-1 … 1 in 2 values"), exact(&["-1", "1"]));
        assert_eq!(values("1/10 … 1/40 in 3 steps of 1/h"), exact(&["1/10", "1/20", "1/30", "1/40"]));
        assert_eq!(values("-1/2 … -1/8 in 2 steps of 1 / h"), exact(&["-1/2", "-1/5", "-1/8"]));
    }

    #[test]
    fn both_ends_are_values_and_distances_are_equal() {
        for (text, rule) in [
            ("1/7 … 22/7 in 19 steps", Rule::Value),
            ("22/7 … 1/7 in 20 values of 1/h", Rule::Reciprocal),
            ("sqrt(2) … pi in 19 steps", Rule::Value),
        ] {
            let values = values(text);
            let range = read(text).unwrap();
            assert_eq!((values.len(), &values[0], &values[19]), (20, &range.from, &range.to));
            let scaled = |value: &Rational| if rule == Rule::Value { value.clone() } else { value.recip() };
            let distance = &scaled(&values[1]) - &scaled(&values[0]);
            assert!(values.windows(2).all(|pair| &scaled(&pair[1]) - &scaled(&pair[0]) == distance), "{text}");
        }
    }

    #[test]
    fn decades_of_logarithms_are_exact() {
        let decades = values("1e-30 … 1 in 30 steps of log");
        let text = |k: i32| format!("1e{}", k - 30);
        assert_eq!(decades, (0..=30).map(|k| shadowstep::exact(&text(k)).unwrap()).collect::<Vec<_>>());
        assert_eq!(values("1000 … 1 in 3 steps of log(h)"), exact(&["1000", "100", "10", "1"]));
        assert_eq!(values("-1 … -100 in 2 steps of log"), exact(&["-1", "-10", "-100"]));
        assert_eq!(values("2 … 2048 in 10 steps of log")[7], exact(&["256"])[0]);
    }

    /// Rounded to 12 digits: within half a unit of the last one, 5e-12 of the value.
    #[test]
    fn logarithms_are_equally_spaced() {
        let values = values("1/3 … 700 in 200 steps of log");
        for (k, value) in values.iter().enumerate() {
            let found: f64 = shadowstep::Number::from_rational(value, &());
            let wanted = (1.0 / 3.0) * f64::powf(2100.0, k as f64 / 200.0);
            assert!((found / wanted - 1.0).abs() < 5e-12 + 1e-14, "{k}: {found}");
        }
    }

    /// A value is made from its number alone.
    #[test]
    fn a_range_may_have_very_many_values() {
        let range = read("0 … 1 in 1000000000000 steps").unwrap();
        assert_eq!(range.value(250_000_000_000), exact(&["1/4"])[0]);
        let range = read("1e-12 … 1 in 1000000000000 values of log").unwrap();
        assert_eq!((range.steps + 1, range.value(999_999_999_999)), (1_000_000_000_000, exact(&["1"])[0].clone()));
    }
}
