//! From a value to its place on the colour bar.

use super::{Colour, ColourScale, Panel};
use crate::ticks::{Scale, Ticks, signed_power_of_ten};

/// Beyond this, differences of values may overflow.
pub(super) const LARGEST: f64 = 1e290;

/// The part of the nonzero values, the smallest ones, that does not decide on the scale.
const LEFT_OUT: f64 = 0.05;

/// Beyond this ratio, a linear scale shows small values as 0.
const MOST_LINEAR: f64 = 1e3;

/// The decades of a symmetric scale on each side, unless its threshold is given.
const MOST_DECADES: f64 = 12.0;

/// How values are measured along the colour bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measure {
    Linear,
    Log10,
    /// Linear within this threshold.
    SymmetricLog(f64),
}

impl Measure {
    /// The measure of a scale of numbers; automatic ones look at the values.
    pub(super) fn of(colour: &Colour, panels: &[Panel]) -> Measure {
        let sizes = sizes(panels, colour.range);
        match (&colour.scale, sizes) {
            (ColourScale::Linear | ColourScale::Words(_), _) => Measure::Linear,
            (ColourScale::Logarithmic, _) => Measure::Log10,
            (ColourScale::SymmetricLogarithmic { linear_within: Some(threshold) }, Some(sizes))
                if sizes.largest > *threshold =>
            {
                Measure::SymmetricLog(*threshold)
            }
            (ColourScale::SymmetricLogarithmic { linear_within: None }, Some(sizes)) => {
                Measure::SymmetricLog(threshold(&sizes))
            }
            (ColourScale::Automatic, Some(sizes)) if sizes.largest / sizes.small > MOST_LINEAR => {
                if sizes.is_signed {
                    Measure::SymmetricLog(threshold(&sizes))
                } else {
                    Measure::Log10
                }
            }
            // without nonzero values, or with all of them within the threshold
            (ColourScale::SymmetricLogarithmic { .. } | ColourScale::Automatic, _) => Measure::Linear,
        }
    }

    /// The place of a finite value, in the units of the measure; −∞ for 0 and NaN for negative values on a logarithmic
    /// scale.
    pub(super) fn at(self, value: f64) -> f64 {
        match self {
            Measure::Linear => value,
            Measure::Log10 => value.log10(),
            Measure::SymmetricLog(threshold) => {
                let ratio = value.abs() / threshold;
                value.signum() * if ratio <= 1.0 { ratio } else { 1.0 + value.abs().log10() - threshold.log10() }
            }
        }
    }

    /// The smallest and the largest value that have a place.
    pub(super) fn extremes(self, panels: &[Panel]) -> Option<(f64, f64)> {
        let values = finite(panels).filter(|&value| self.at(value).is_finite());
        let (least, most) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (a.min(value), b.max(value)));
        (least <= most).then_some((least, most))
    }

    /// The values at the ends of the colour bar, for values in this range; if both signs occur, it is the same on both
    /// sides of 0.
    pub(super) fn ends(self, (least, most): (f64, f64)) -> (f64, f64) {
        let farthest = most.max(-least);
        if self != Measure::Log10 && least < 0.0 && most > 0.0 { (-farthest, farthest) } else { (least, most) }
    }

    /// Ticks of the colour bar, in the units of the measure.
    pub(super) fn ticks(self, range: (f64, f64), steps: f64) -> Ticks {
        match self {
            Measure::Linear => Ticks::of_at_most(steps, Scale::Linear, range),
            Measure::Log10 => Ticks::of_at_most(steps, Scale::Log10, range),
            Measure::SymmetricLog(threshold) => symmetric_ticks(threshold, range, steps),
        }
    }
}

/// 0, and powers of ten of both signs beyond the threshold.
fn symmetric_ticks(threshold: f64, (least, most): (f64, f64), steps: f64) -> Ticks {
    let measure = Measure::SymmetricLog(threshold);
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
    let (mut labelled, mut minor) = (vec![(measure.at(0.0), "0".to_owned())], Vec::new());
    for n in decades {
        for sign in [-1.0, 1.0] {
            match of(sign, n) {
                place if (last - n) % step == 0 && place.abs() > near => {
                    labelled.push((place, signed_power_of_ten(sign < 0.0, n)));
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

fn finite(panels: &[Panel]) -> impl Iterator<Item = f64> {
    panels.iter().flat_map(|panel| &panel.cells).flatten().copied().filter(|value| value.is_finite())
}

/// Sizes of nonzero values.
struct Sizes {
    /// Above the smallest 5 %.
    small: f64,
    largest: f64,
    /// Whether the colour bar has to show values that are not positive.
    is_signed: bool,
}

/// Of the values within a range, if one is given, and its ends.
fn sizes(panels: &[Panel], range: Option<(f64, f64)>) -> Option<Sizes> {
    let (least, most) = range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    let within = || finite(panels).filter(|value| (least..=most).contains(value));
    let mut sizes: Vec<f64> = within().filter(|value| *value != 0.0).map(f64::abs).collect();
    let rank = (LEFT_OUT * sizes.len() as f64) as usize;
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    (!sizes.is_empty()).then(|| Sizes {
        small: *sizes.select_nth_unstable_by(rank, f64::total_cmp).1,
        largest,
        is_signed: within().any(|value| value < 0.0) || range.is_some() && least <= 0.0,
    })
}

/// A power of ten below which few of the values lie.
fn threshold(sizes: &Sizes) -> f64 {
    // subnormal powers of ten are not exact
    let exponent = sizes.small.log10().max(sizes.largest.log10() - MOST_DECADES).floor().max(-300.0);
    10f64.powi(exponent as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(cells: &[f64]) -> Vec<Panel> {
        vec![Panel::new("", cells.iter().copied().map(Some).collect())]
    }

    fn automatic(cells: &[f64]) -> Measure {
        Measure::of(&Colour::automatic(""), &panel(cells))
    }

    #[test]
    fn the_values_decide_on_an_automatic_scale() {
        assert_eq!(automatic(&[1.0, 2.0, 900.0]), Measure::Linear);
        assert_eq!(automatic(&[1e-14, 1e-3, 0.0, f64::INFINITY]), Measure::Log10);
        assert_eq!(automatic(&[-1.0, 0.5, 0.01, 1.0]), Measure::Linear);
        assert_eq!(automatic(&[-3e-9, 1e-3, 0.0]), Measure::SymmetricLog(1e-9));
        assert_eq!(automatic(&[0.0, f64::NAN]), Measure::Linear);
        // evenly spread values of both signs, some of which are close to 0, are not of many decades
        let even: Vec<_> = (-1000..1000).map(|n| f64::from(n) / 1000.0 + 1e-9).collect();
        assert_eq!(automatic(&even), Measure::Linear);
    }

    /// Values beyond the range of the colour bar do not decide.
    #[test]
    fn the_range_decides_on_an_automatic_scale() {
        let over = |least, most, cells: &[f64]| Measure::of(&Colour::automatic("").over(least, most), &panel(cells));
        assert_eq!(over(1.0, 100.0, &[1.0, 50.0, 1e300]), Measure::Linear);
        assert_eq!(over(1e-9, 1.0, &[1e-8, 0.1, -5.0]), Measure::Log10);
        assert_eq!(over(0.0, 1.0, &[1e-8, 0.1]), Measure::SymmetricLog(1e-8));
    }

    #[test]
    fn a_single_tiny_value_does_not_stretch_a_symmetric_scale() {
        assert_eq!(automatic(&[-1e-200, 1e-3, 1.0]), Measure::SymmetricLog(1e-12));
    }

    /// Both parts meet at the threshold, with the same value from both sides.
    #[test]
    fn symmetric_scales_are_odd_and_continuous() {
        let measure = Measure::SymmetricLog(1e-3);
        for (value, place) in [(0.0, 0.0), (5e-4, 0.5), (1e-3, 1.0), (1e-2, 2.0), (10.0, 5.0)] {
            assert!((measure.at(value) - place).abs() < 1e-14, "{value}");
            assert!((measure.at(-value) + place).abs() < 1e-14, "{value}");
        }
    }

    #[test]
    fn bars_are_symmetric_where_both_signs_occur() {
        let range = |measure: Measure, cells: &[f64]| measure.extremes(&panel(cells)).map(|data| measure.ends(data));
        assert_eq!(range(Measure::Linear, &[-1.0, 3.0]), Some((-3.0, 3.0)));
        assert_eq!(range(Measure::Linear, &[1.0, 3.0, f64::INFINITY]), Some((1.0, 3.0)));
        assert_eq!(range(Measure::Log10, &[0.01, 0.0, -4.0, 100.0]), Some((0.01, 100.0)));
        assert_eq!(range(Measure::Log10, &[0.0, -4.0, f64::NAN]), None);
    }

    #[test]
    fn symmetric_ticks_are_powers_of_ten_of_both_signs() {
        let labels = |threshold: f64, side: f64| {
            let ticks = Measure::SymmetricLog(threshold).ticks((-side, side), 7.0);
            ticks.labelled.into_iter().map(|(_, label)| label).collect::<Vec<_>>()
        };
        assert_eq!(labels(1e-3, 4.0), ["−1", "−10⁻²", "0", "10⁻²", "1"]);
        assert_eq!(labels(1e-3, 2.5), ["−10⁻²", "−10⁻³", "0", "10⁻³", "10⁻²"]);
        let many = labels(1e-12, 13.0);
        assert!(many.len() <= 9 && many.contains(&"0".to_owned()) && many[0] == "−1", "{many:?}");
    }
}
