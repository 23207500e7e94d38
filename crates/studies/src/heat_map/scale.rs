//! Which scale suits the values, and where its colour bar ends.

use super::{Colour, ColourScale, Panel};
use crate::picture::ticks::Scale;

/// The part of the nonzero values, the smallest ones, that does not decide on the scale.
const LEFT_OUT: f64 = 0.05;

/// Beyond this ratio, a linear scale shows small values as 0.
const MOST_LINEAR: f64 = 1e3;

/// The decades of a symmetric scale on each side.
const MOST_DECADES: f64 = 12.0;

/// The scale of the colour bar; automatic ones look at the values.
pub(super) fn scale(colour: &Colour, panels: &[Panel]) -> Scale {
    match (&colour.scale, sizes(panels, colour.range)) {
        (ColourScale::Logarithmic, _) => Scale::Log10,
        (ColourScale::SymmetricLogarithmic, Some(sizes)) => Scale::SymmetricLog(threshold(&sizes)),
        (ColourScale::Automatic, Some(sizes)) if sizes.largest / sizes.small > MOST_LINEAR => {
            if sizes.is_signed {
                Scale::SymmetricLog(threshold(&sizes))
            } else {
                Scale::Log10
            }
        }
        // also without nonzero values
        _ => Scale::Linear,
    }
}

/// The smallest and the largest value that have a place on the scale.
pub(super) fn extremes(scale: Scale, panels: &[Panel]) -> Option<(f64, f64)> {
    let values = finite(panels).filter(|&value| scale.at(value).is_finite());
    let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (a.min(value), b.max(value)));
    (least <= most).then_some((least, most))
}

/// The values at the ends of the colour bar, for values in this range; if both signs occur, it is the same on both
/// sides of 0.
pub(super) fn ends(scale: Scale, (least, most): (f64, f64)) -> (f64, f64) {
    let farthest = most.max(-least);
    if scale != Scale::Log10 && least < 0.0 && most > 0.0 { (-farthest, farthest) } else { (least, most) }
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

    fn automatic(cells: &[f64]) -> Scale {
        scale(&Colour::automatic(""), &panel(cells))
    }

    #[test]
    fn the_values_decide_on_an_automatic_scale() {
        assert_eq!(automatic(&[1.0, 2.0, 900.0]), Scale::Linear);
        assert_eq!(automatic(&[1e-14, 1e-3, 0.0, f64::INFINITY]), Scale::Log10);
        assert_eq!(automatic(&[-1.0, 0.5, 0.01, 1.0]), Scale::Linear);
        assert_eq!(automatic(&[-3e-9, 1e-3, 0.0]), Scale::SymmetricLog(1e-9));
        assert_eq!(automatic(&[0.0, f64::NAN]), Scale::Linear);
        // evenly spread values of both signs, some of which are close to 0, are not of many decades
        let even: Vec<_> = (-1000..1000).map(|n| f64::from(n) / 1000.0 + 1e-9).collect();
        assert_eq!(automatic(&even), Scale::Linear);
    }

    /// Values beyond the range of the colour bar do not decide.
    #[test]
    fn the_range_decides_on_an_automatic_scale() {
        let over = |least, most, cells: &[f64]| scale(&Colour::automatic("").over(least, most), &panel(cells));
        assert_eq!(over(1.0, 100.0, &[1.0, 50.0, 1e300]), Scale::Linear);
        assert_eq!(over(1e-9, 1.0, &[1e-8, 0.1, -5.0]), Scale::Log10);
        assert_eq!(over(0.0, 1.0, &[1e-8, 0.1]), Scale::SymmetricLog(1e-8));
    }

    #[test]
    fn a_single_tiny_value_does_not_stretch_a_symmetric_scale() {
        assert_eq!(automatic(&[-1e-200, 1e-3, 1.0]), Scale::SymmetricLog(1e-12));
    }

    #[test]
    fn bars_are_symmetric_where_both_signs_occur() {
        let range = |of: Scale, cells: &[f64]| extremes(of, &panel(cells)).map(|data| ends(of, data));
        assert_eq!(range(Scale::Linear, &[-1.0, 3.0]), Some((-3.0, 3.0)));
        assert_eq!(range(Scale::Linear, &[1.0, 3.0, f64::INFINITY]), Some((1.0, 3.0)));
        assert_eq!(range(Scale::Log10, &[0.01, 0.0, -4.0, 100.0]), Some((0.01, 100.0)));
        assert_eq!(range(Scale::Log10, &[0.0, -4.0, f64::NAN]), None);
    }
}
