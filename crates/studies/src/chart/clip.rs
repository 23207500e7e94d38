//! Lines are interrupted where points are missing, and cut where they leave the chart.

use crate::picture::elements::{Place, Point};

/// The visible pieces of the line through the points; NaN and infinite values are missing points.
pub(super) fn pieces(place: &Place, points: &[Point]) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut last = None;
    for pair in points.windows(2) {
        let Some((from, to)) = cut(place, pair[0], pair[1]) else {
            last = None;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if last == Some(from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
        // after a cut the next piece begins elsewhere
        last = (to == pair[1]).then_some(to);
    }
    pieces
}

/// The points that no line shows because both neighbours are missing.
pub(super) fn alone(place: &Place, points: &[Point]) -> Vec<Point> {
    let is_there = |i: usize| points.get(i).is_some_and(|(x, y)| x.is_finite() && y.is_finite());
    let alone = |i: &usize| !is_there(i + 1) && (*i == 0 || !is_there(i - 1));
    (0..points.len()).filter(alone).map(|i| points[i]).filter(|point| place.contains(*point)).collect()
}

/// The part of a line within the place (Liang and Barsky 1984).
fn cut(place: &Place, from: Point, to: Point) -> Option<(Point, Point)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    // not finite if an end is not
    if !dx.is_finite() || !dy.is_finite() {
        return None;
    }
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let (right, bottom) = (place.right(), place.bottom());
    let sides = [(-dx, from.0 - place.left), (dx, right - from.0), (-dy, from.1 - place.top), (dy, bottom - from.1)];
    for (outward, room) in sides {
        if outward == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if outward < 0.0 {
            enter = enter.max(room / outward);
        } else {
            leave = leave.min(room / outward);
        }
    }
    let at = |t: f64| ((from.0 + t * dx).clamp(place.left, right), (from.1 + t * dy).clamp(place.top, bottom));
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave == 1.0 { to } else { at(leave) };
    (enter <= leave).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACE: Place = Place { left: 0.0, top: 0.0, width: 10.0, height: 10.0 };

    #[test]
    fn missing_points_break_the_line() {
        let points = [(0.0, 1.0), (1.0, 1.0), (2.0, f64::NAN), (3.0, 1.0), (4.0, 1.0), (5.0, 2.0)];
        let expected = [vec![(0.0, 1.0), (1.0, 1.0)], vec![(3.0, 1.0), (4.0, 1.0), (5.0, 2.0)]];
        assert_eq!(pieces(&PLACE, &points), expected);
    }

    #[test]
    fn points_between_missing_ones_are_not_lost() {
        let missing = (2.0, f64::NAN);
        let points = [(0.0, 1.0), missing, (3.0, 1.0), (4.0, 1.0), missing, (6.0, 2.0), missing, (7.0, 99.0)];
        assert_eq!(alone(&PLACE, &points), [(0.0, 1.0), (6.0, 2.0)]);
        assert_eq!(alone(&PLACE, &[(1.0, 1.0)]), [(1.0, 1.0)]);
    }

    #[test]
    fn lines_are_cut_at_the_frame_without_a_bend() {
        // out at the top and in again: two pieces, each ending where the line crosses y = 10
        let points = [(0.0, 0.0), (4.0, 20.0), (8.0, 0.0)];
        let expected = [vec![(0.0, 0.0), (2.0, 10.0)], vec![(6.0, 10.0), (8.0, 0.0)]];
        assert_eq!(pieces(&PLACE, &points), expected);
        // through, from outside to outside
        assert_eq!(pieces(&PLACE, &[(-10.0, 5.0), (20.0, 5.0)]), [vec![(0.0, 5.0), (10.0, 5.0)]]);
        assert!(pieces(&PLACE, &[(-10.0, 11.0), (20.0, 12.0)]).is_empty());
        assert!(pieces(&PLACE, &[(-10.0, 5.0), (5.0, 25.0)]).is_empty());
    }
}
