//! Round numbers and decades on a scale: the ticks of an axis and their labels.

/// The scale of an axis or of a colour bar. Places on it are in its own measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scale {
    /// The values themselves.
    Linear,
    /// log₁₀ of the values, so that 1e-400 is −400 instead of 0.
    Log10,
    /// For values v of both signs over many decades: with this threshold c, v/c for |v| ≤ c, and ±(1 + log₁₀|v/c|)
    /// beyond.
    SymmetricLog(f64),
}

/// Labelled and minor ticks, in the measure of the scale.
pub(crate) struct Ticks {
    pub(crate) labelled: Vec<(f64, String)>,
    pub(crate) minor: Vec<f64>,
}

/// Shorter ranges have no ticks.
pub(crate) const SMALLEST: f64 = 1e-290;

impl Scale {
    /// The place of a finite value; −∞ for 0 and NaN for negative values on a logarithmic scale.
    pub(crate) fn at(self, value: f64) -> f64 {
        match self {
            Scale::Linear => value,
            Scale::Log10 => value.log10(),
            Scale::SymmetricLog(threshold) => {
                let ratio = value.abs() / threshold;
                value.signum() * if ratio <= 1.0 { ratio } else { 1.0 + value.abs().log10() - threshold.log10() }
            }
        }
    }

    /// Ticks with about this number of intervals between labels, for least < most.
    pub(crate) fn ticks(self, (least, most): (f64, f64), steps: f64) -> Ticks {
        match self {
            Scale::Linear => linear(least, most, steps),
            Scale::Log10 => logarithmic(least, most, steps),
            Scale::SymmetricLog(threshold) => symmetric(threshold, (least, most), steps),
        }
    }

    /// Beyond this, neighbouring ticks cannot be distinguished, and differences may overflow.
    pub(crate) fn largest(self) -> f64 {
        if self == Scale::Log10 { 1e9 } else { 1e290 }
    }

    /// Whether ticks within the range are different numbers; not so if the values hardly change.
    pub(crate) fn has_ticks(self, (least, most): (f64, f64)) -> bool {
        let size = least.abs().max(most.abs());
        size < self.largest() && most - least > SMALLEST.max(1e-9 * size)
    }
}

/// Multiples of 1, 2 or 5 times a power of ten.
fn linear(least: f64, most: f64, steps: f64) -> Ticks {
    let raw = (most - least) / steps;
    let mut exponent = raw.log10().floor() as i32;
    let power = 10f64.powi(exponent);
    let mut digit = [1, 2, 5, 10].into_iter().find(|digit| f64::from(*digit) * power >= raw).unwrap_or(10);
    if digit == 10 {
        (digit, exponent) = (1, exponent + 1);
    }
    let values = |parts: i64| {
        let step = f64::from(digit) / parts as f64;
        let unit = move |n: i64| scaled(n as f64 * step, exponent);
        // a tick at the end of the range is included, whatever the last bit
        let nudge = (most - least) * 1e-9;
        let end = |value: f64| value / scaled(step, exponent);
        let (first, last) = (end(least - nudge).ceil() as i64, end(most + nudge).floor() as i64);
        (first..=last).map(move |n| (n, unit(n)))
    };
    let units = |n: i64| n * i64::from(digit);
    let largest = values(1).map(|(n, _)| units(n).unsigned_abs()).max().unwrap_or(0);
    let labelled = values(1).map(|(n, value)| (value, decimal(units(n), exponent, largest))).collect();
    let parts = if digit == 2 { 4 } else { 5 };
    let minor = values(parts).filter(|(n, _)| n % parts != 0).map(|(_, value)| value).collect();
    Ticks { labelled, minor }
}

/// n · 10^exponent with one rounding, so that 3 · 10⁻¹ is 0.3.
fn scaled(n: f64, exponent: i32) -> f64 {
    if exponent < 0 { n / 10f64.powi(-exponent) } else { n * 10f64.powi(exponent) }
}

/// n · 10^exponent as text, without an exponent where that is short; else with the exponent of the largest n of an
/// axis.
fn decimal(n: i64, exponent: i32, largest: u64) -> String {
    let sign = if n < 0 { "−" } else { "" };
    let n = n.unsigned_abs();
    match exponent {
        _ if n == 0 => "0".to_owned(),
        0..=4 => format!("{sign}{n}{}", "0".repeat(exponent as usize)),
        -4..=-1 => {
            let unit = 10u64.pow(exponent.unsigned_abs());
            format!("{sign}{}.{:0width$}", n / unit, n % unit, width = exponent.unsigned_abs() as usize)
        }
        _ => {
            // one digit before the point of the largest: 0.5×10⁹ below 1.5×10⁹
            let places = largest.max(n).ilog10();
            let unit = 10u64.pow(places);
            let fraction =
                if places > 0 { format!(".{:0width$}", n % unit, width = places as usize) } else { String::new() };
            match i64::from(exponent) + i64::from(places) {
                0 => format!("{sign}{}{fraction}", n / unit),
                power => format!("{sign}{}{fraction}×10{}", n / unit, superscript(power)),
            }
        }
    }
}

/// Whole decades; if there is at most one, 1, 2 and 5 times them, or round numbers.
fn logarithmic(least: f64, most: f64, steps: f64) -> Ticks {
    let span = most - least;
    let within = |value: &f64| (least..=most).contains(value);
    let multiples = |step: i64| {
        let (first, last) = ((least / step as f64).ceil() as i64, (most / step as f64).floor() as i64);
        (first..=last).map(move |n| n * step)
    };
    if most.floor() - least.ceil() < 1.0 || span < 2.0 {
        return few_decades(least, most, steps);
    }
    // steps, each of which divides its successor, with their minor steps
    const STEPS: [(i64, i64); 10] =
        [(1, 1), (2, 1), (5, 1), (10, 2), (20, 5), (50, 10), (100, 20), (200, 50), (500, 100), (1000, 200)];
    let (step, minor) = STEPS.into_iter().find(|(step, _)| span <= *step as f64 * steps).unwrap_or_else(|| {
        let step = (span / steps).ceil() as i64;
        (step, step)
    });
    let labelled = multiples(step).map(|n| (n as f64, power_of_ten(n))).collect();
    let minor = if step > 1 {
        multiples(minor).filter(|n| n % step != 0).map(|n| n as f64).collect()
    } else {
        let decades = least.floor() as i64..=most.floor() as i64;
        decades.flat_map(|n| (2..10).map(move |digit| n as f64 + f64::from(digit).log10())).filter(within).collect()
    };
    Ticks { labelled, minor }
}

fn few_decades(least: f64, most: f64, steps: f64) -> Ticks {
    let decades = least.floor() as i64..=most.floor() as i64;
    // 0.5, 1 and 20 are read more easily than 5×10⁻¹, 1 and 2×10
    let plain = least >= -3.0 && most < 5.0;
    let label = |n: i64, digit: u8| match n as i32 {
        exponent if plain && exponent >= 0 => format!("{digit}{}", "0".repeat(exponent as usize)),
        exponent if plain => decimal(i64::from(digit), exponent, digit.into()),
        _ => times_power(&digit.to_string(), n),
    };
    let labelled: Vec<_> = decades
        .clone()
        .flat_map(|n| [1u8, 2, 5].map(|digit| (n, digit)))
        .map(|(n, digit)| (n as f64 + f64::from(digit).log10(), label(n, digit)))
        .filter(|(value, _)| (least..=most).contains(value))
        .collect();
    if labelled.len() >= 2 {
        let others = decades.flat_map(|n| [3u8, 4, 6, 7, 8, 9].map(|digit| n as f64 + f64::from(digit).log10()));
        return Ticks { labelled, minor: others.filter(|value| (least..=most).contains(value)).collect() };
    }
    // less than half a decade: round numbers between its ends
    let decade = least.floor();
    let round = linear(10f64.powf(least - decade), 10f64.powf(most - decade), steps);
    let labelled =
        round.labelled.into_iter().map(|(digits, text)| (decade + digits.log10(), times_power(&text, decade as i64)));
    Ticks { labelled: labelled.collect(), minor: Vec::new() }
}

/// 0, and powers of ten of both signs beyond the threshold.
fn symmetric(threshold: f64, (least, most): (f64, f64), steps: f64) -> Ticks {
    let side = most.max(-least);
    // a threshold that is a power of ten has a tick
    let first = (threshold.log10() - 1e-9).ceil() as i64;
    let last = (threshold.log10() + side - 1.0 + 1e-9).floor() as i64;
    let step = (((last - first + 1) as f64 / (steps / 2.0)).ceil() as i64).max(1);
    // downwards from the largest, so that the ends of the bar have ticks
    let decades = (first..=last).rev();
    // labels closer to 0 would touch its label
    let near = side / (steps + 1.0);
    let of = |sign: f64, n: i64| sign * (1.0 + n as f64 - threshold.log10()).max(1.0);
    let within = |place: &f64| (least - 1e-9..=most + 1e-9).contains(place);
    let (mut labelled, mut minor) = (vec![(0.0, "0".to_owned())], Vec::new());
    for n in decades {
        for sign in [-1.0, 1.0] {
            match of(sign, n) {
                place if (last - n) % step == 0 && place.abs() > near => {
                    labelled.push((place, format!("{}{}", if sign < 0.0 { "−" } else { "" }, power_of_ten(n))));
                }
                place => minor.push(place),
            }
        }
    }
    labelled.retain(|(place, _)| within(place));
    minor.retain(within);
    labelled.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ticks { labelled, minor }
}

/// 10ⁿ, with 1 and 10 as such.
pub fn power_of_ten(n: i64) -> String {
    match n {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => format!("10{}", superscript(n)),
    }
}

/// A number rounded to this number of significant digits, without trailing zeros: 0.3, −1.25×10⁻⁷.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    let scientific = format!("{:.*e}", digits.saturating_sub(1), value.abs());
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i64 = exponent.parse().unwrap_or(0);
    let sign = if value < 0.0 { "−" } else { "" };
    if value == 0.0 {
        return "0".to_owned();
    }
    if (-4..5).contains(&exponent) {
        // rounded to the digits, its shortest text is the number
        let rounded: f64 = scientific.parse().unwrap_or(value.abs());
        return format!("{sign}{rounded}");
    }
    let mantissa = if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    format!("{sign}{}", times_power(mantissa, exponent))
}

fn times_power(digits: &str, n: i64) -> String {
    match n {
        0 => digits.to_owned(),
        _ if digits == "1" => power_of_ten(n),
        1 => format!("{digits}×10"),
        _ => format!("{digits}×10{}", superscript(n)),
    }
}

/// −20 as ⁻²⁰.
fn superscript(n: i64) -> String {
    let raised = |character| match character {
        '-' => '⁻',
        digit => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize - '0' as usize],
    };
    n.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: Scale, least: f64, most: f64) -> Vec<String> {
        scale.ticks((least, most), 7.0).labelled.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn decades_far_below_double_precision() {
        let expected = ["10⁻⁴⁰⁰", "10⁻³⁰⁰", "10⁻²⁰⁰", "10⁻¹⁰⁰", "1"];
        assert_eq!(labels(Scale::Log10, -400.5, 3.0), expected);
        assert_eq!(labels(Scale::Log10, -121.0, -19.5), ["10⁻¹²⁰", "10⁻¹⁰⁰", "10⁻⁸⁰", "10⁻⁶⁰", "10⁻⁴⁰", "10⁻²⁰"]);
        assert_eq!(labels(Scale::Log10, -2.5, 2.5), ["10⁻²", "10⁻¹", "1", "10", "10²"]);
    }

    #[test]
    fn few_decades_have_numbers_between() {
        assert_eq!(labels(Scale::Log10, -3.1, -2.2), ["10⁻³", "2×10⁻³", "5×10⁻³"]);
        assert_eq!(labels(Scale::Log10, 0.05, 0.2), ["1.2", "1.3", "1.4", "1.5"][..].to_vec());
        assert_eq!(labels(Scale::Log10, -0.8, 0.6), ["0.2", "0.5", "1", "2"]);
        assert_eq!(labels(Scale::Log10, 0.8, 2.6), ["10", "20", "50", "100", "200"]);
        let minor = Scale::Log10.ticks((-2.0, 0.0), 7.0).minor;
        assert_eq!(minor.len(), 16);
    }

    #[test]
    fn round_numbers_of_linear_axes() {
        assert_eq!(
            labels(Scale::Linear, 0.0, 0.3),
            ["0.00", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30"].map(|label| if label == "0.00" {
                "0"
            } else {
                label
            })
        );
        assert_eq!(labels(Scale::Linear, -1.0, 1.0), ["−1.0", "−0.5", "0", "0.5", "1.0"]);
        assert_eq!(labels(Scale::Linear, 3.0, 2100.0), ["500", "1000", "1500", "2000"]);
        assert_eq!(labels(Scale::Linear, 0.0, 1.6e9), ["0", "0.5×10⁹", "1.0×10⁹", "1.5×10⁹"]);
        let close = labels(Scale::Linear, 1.0, 1.000_02);
        assert_eq!(close, ["1.000000", "1.000005", "1.000010", "1.000015", "1.000020"]);
        assert_eq!(labels(Scale::Linear, 0.0, 4e-7), ["0", "1×10⁻⁷", "2×10⁻⁷", "3×10⁻⁷", "4×10⁻⁷"]);
    }

    #[test]
    fn numbers_are_rounded_to_significant_digits() {
        let texts = [
            (0.1 + 0.2, "0.3"),
            (1.0 / 30.0, "0.03333"),
            (-0.5, "−0.5"),
            (0.0, "0"),
            (-0.0, "0"),
            (12_345.6, "12350"),
            (99_999.9, "10⁵"),
            (1e-5, "10⁻⁵"),
            (-1.25e-7, "−1.25×10⁻⁷"),
            (5e-324, "4.941×10⁻³²⁴"),
        ];
        for (value, text) in texts {
            assert_eq!(significant(value, 4), text);
        }
    }

    /// Between 2 and 9 labels, within the range, from the smallest spans to the largest.
    #[test]
    fn every_span_has_some_labels_and_not_too_many() {
        for scale in [Scale::Linear, Scale::Log10] {
            for least in [-1000.0, -120.3, -0.7, 0.0, 5.0] {
                for exponent in -30..=35 {
                    let span = 10f64.powf(f64::from(exponent) / 10.0);
                    let ticks = scale.ticks((least, least + span), 7.0);
                    let count = ticks.labelled.len();
                    assert!((2..=9).contains(&count), "{scale:?} {least} + {span}: {count}");
                    let slack = span * 1e-6;
                    let inside = |value: f64| (least - slack..=least + span + slack).contains(&value);
                    assert!(
                        ticks.labelled.into_iter().map(|tick| tick.0).chain(ticks.minor).all(inside),
                        "{scale:?} {least} + {span}"
                    );
                }
            }
        }
    }

    /// Both parts meet at the threshold, with the same value from both sides.
    #[test]
    fn symmetric_scales_are_odd_and_continuous() {
        let scale = Scale::SymmetricLog(1e-3);
        for (value, place) in [(0.0, 0.0), (5e-4, 0.5), (1e-3, 1.0), (1e-2, 2.0), (10.0, 5.0)] {
            assert!((scale.at(value) - place).abs() < 1e-14, "{value}");
            assert!((scale.at(-value) + place).abs() < 1e-14, "{value}");
        }
    }

    #[test]
    fn symmetric_ticks_are_powers_of_ten_of_both_signs() {
        let labels = |threshold: f64, side: f64| {
            let ticks = Scale::SymmetricLog(threshold).ticks((-side, side), 7.0);
            ticks.labelled.into_iter().map(|(_, label)| label).collect::<Vec<_>>()
        };
        assert_eq!(labels(1e-3, 4.0), ["−1", "−10⁻²", "0", "10⁻²", "1"]);
        assert_eq!(labels(1e-3, 2.5), ["−10⁻²", "−10⁻³", "0", "10⁻³", "10⁻²"]);
        let many = labels(1e-12, 13.0);
        assert!(many.len() <= 9 && many.contains(&"0".to_owned()) && many[0] == "−1", "{many:?}");
    }
}
