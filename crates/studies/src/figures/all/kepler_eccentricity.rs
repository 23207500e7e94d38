//! Kepler's problem: the drift against the eccentricity, and the eccentricities with which the body escapes.

use crate::figures::escape::critical;
use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let scans: Vec<Scan> = d.cs("drifts").iter().filter_map(|n| Scan::of(d, n)).collect();
    drifts(d, &scans);
    if !scans.is_empty() {
        check_escapes(d, &scans);
        table(d, &scans);
        orbits(d, &scans);
    }
}

fn drifts(d: &mut Drawing<'_>, scans: &[Scan]) {
    let drifts = d.family("drifts");
    for Series { label, points } in &drifts {
        if let (Some((first, least)), Some((at, middle))) = (points.first(), points.iter().find(|(e, _)| *e >= 0.6)) {
            d.check(
                format!("{label}: almost circular orbits preserve it much better."),
                format!("{} at e = {first}, {} at e = {at}", power(*least), power(*middle)),
                *least < middle - 3.0,
            );
        }
    }
    let first = scans.iter().filter_map(|scan| Some((scan.n, scan.first()?)));
    let marks = first.map(|(n, e)| Mark::at(e, format!("escape, h = 1/{n}"))).collect();
    d.chart("drifts", lines(&drifts, 0)).marks = marks;
}

/// Whether the body escapes before t = 100, for each eccentricity of a scan at h = 1/n.
struct Scan {
    n: u32,
    /// e in thousandths; whether it escapes, after how many returns, and the largest |q|.
    found: Vec<(u32, Option<u32>, f64)>,
}

impl Scan {
    fn of(d: &Drawing<'_>, n: &str) -> Option<Scan> {
        let found = (400..=990).step_by(if d.results.quick { 5 } else { 1 }).map(|e| {
            let escape = d.results.escape(&d.run("drifts", n, &e.to_string()))?;
            Some((e, escape.time.map(|_| escape.returns), escape.farthest))
        });
        // every e is requested before one that is missing ends it
        let found: Vec<_> = found.collect();
        Some(Scan { n: n.parse().ok()?, found: found.into_iter().collect::<Option<_>>()? })
    }

    fn escapes(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.found.iter().filter_map(|(e, returns, _)| Some((*e, (*returns)?)))
    }

    /// The smallest e with which the body escapes.
    fn first(&self) -> Option<f64> {
        self.escapes().next().map(|(e, _)| thousandths(e))
    }

    /// The largest e with which it stays.
    fn last_bound(&self) -> Option<f64> {
        self.found.iter().rev().find(|(_, returns, _)| returns.is_none()).map(|(e, ..)| thousandths(*e))
    }

    /// The range within which the instability begins: from the last e before the first escape to the e from which on
    /// all escape.
    fn range(&self) -> Option<(f64, f64)> {
        let before = |e: f64| self.found.iter().map(|(e, ..)| thousandths(*e)).rfind(|other| *other < e);
        let after = |e: f64| self.found.iter().map(|(e, ..)| thousandths(*e)).find(|other| *other > e);
        Some((before(self.first()?)?, after(self.last_bound()?)?))
    }

    /// How the orbits escape within the range.
    fn described(&self) -> Option<String> {
        let (low, high) = self.range()?;
        if self.first()? > self.last_bound()? {
            let (scanned, apart) = (self.found.len(), thousandths(self.found[1].0 - self.found[0].0));
            return Some(format!(
                "of {scanned} orbits, {apart} apart, none escapes up to e = {low:.3}, and all from {high:.3} on"
            ));
        }
        let within = |e: u32| (low..=high).contains(&thousandths(e));
        let between = self.found.iter().filter(|(e, ..)| within(*e)).count();
        let escaped = self.escapes().filter(|(e, _)| within(*e)).count();
        Some(format!("from e = {low:.3} to {high:.3}, {escaped} of {between} orbits escape"))
    }

    /// Whether all orbits beyond the first escape escape; between the eccentricities of a coarse scan others may stay.
    fn is_one_value(&self, coverage: Coverage) -> Option<Verdict> {
        Some(coverage.every(self.first()? > self.last_bound()?))
    }

    /// Whether all that escape do so on the first way out; `None` without an escape.
    fn escapes_at_once(&self, coverage: Coverage) -> Option<Verdict> {
        self.escapes().next()?;
        Some(coverage.every(self.escapes().all(|(_, returns)| returns == 0)))
    }
}

fn thousandths(e: u32) -> f64 {
    f64::from(e) / 1000.0
}

fn check_escapes(d: &mut Drawing<'_>, scans: &[Scan]) {
    let coverage = d.coverage();
    let (found, verdict) = onset(scans, coverage);
    d.check("An instability occurs at an eccentricity that depends on the step size.", found, verdict);
    for scan in scans {
        let (Some(verdict), Some(found)) = (scan.is_one_value(coverage), scan.described()) else { continue };
        d.check(format!("h = 1/{}: it is one critical eccentricity, to within 0.001.", scan.n), found, verdict);
    }
    topology(d, scans);
}

/// Where the instability begins. Between the eccentricities of a coarse scan others may escape, so that it gives an
/// upper bound only.
fn onset(scans: &[Scan], coverage: Coverage) -> (String, Verdict) {
    let ranges: Vec<_> = scans.iter().map(Scan::range).collect();
    let of = |scan: &Scan| {
        let (low, high) = scan.range()?;
        Some(match coverage {
            Coverage::All => format!("{low:.3} to {high:.3} at h = 1/{}", scan.n),
            Coverage::Some => format!("{:.3} at h = 1/{}", scan.first()?, scan.n),
        })
    };
    let list = scans.iter().filter_map(of).collect::<Vec<_>>().join(", ");
    let begins = match coverage {
        Coverage::All => "it begins at e =",
        Coverage::Some => "it begins no later than at e =",
    };
    (format!("{begins} {list}"), coverage.only_all(depends_on_step(&ranges)))
}

const OVERLAP: &str =
    "The ranges of two step sizes overlap, or one is not known; longer runs and closer eccentricities would decide.";

/// Ranges that are apart belong to different eccentricities; those that overlap, or are not known, allow both.
fn depends_on_step(ranges: &[Option<(f64, f64)>]) -> Verdict {
    let apart = |pair: &[Option<(f64, f64)>]| pair[0].zip(pair[1]).is_some_and(|(left, right)| left.1 < right.0);
    if ranges.windows(2).all(apart) { Verdict::Agrees } else { Verdict::NotDecided(OVERLAP) }
}

/// A level set that is unbounded from the start is left on the first way out; an escape after a return needs a change
/// of the modified energy itself.
fn topology(d: &mut Drawing<'_>, scans: &[Scan]) {
    for scan in scans {
        let (all, late) =
            scan.escapes().fold((0, 0), |(all, late), (_, returns)| (all + 1, late + usize::from(returns > 0)));
        let Some(verdict) = scan.escapes_at_once(d.coverage()) else { continue };
        let critical = critical(1.0 / f64::from(scan.n));
        let others = match late {
            0 => String::new(),
            late => format!(", {late} after an encounter that changed the modified energy"),
        };
        let found = format!(
            "{} of {all} orbits that escape do so on the first way out{others}; up to h² the level set of the start \
             is unbounded from e = {critical:.3} on",
            all - late
        );
        let statement = format!(
            "h = 1/{}: the trajectories are unbounded since the level sets of the modified energy are.",
            scan.n
        );
        d.check(statement, found, verdict);
    }
    d.found(
        "A body has escaped when it is farther than 2, moves outward, and H̄ = H + h² (pᵀU_qq p/12 − |U_q|²/24), the \
         modified energy up to h², is at least 0: the level set then reaches infinity. |q| > 3 is not an escape: \
         orbits of negative energy pass it and return.",
    );
}

fn table(d: &mut Drawing<'_>, scans: &[Scan]) {
    let number = |e: Option<f64>| e.map_or("none".to_owned(), |e| format!("{e:.3}"));
    let rows = scans.iter().map(|scan| {
        let beyond = scan.found.iter().find(|(_, _, farthest)| *farthest > 3.0).map(|(e, ..)| thousandths(*e));
        let critical = format!("{:.3}", critical(1.0 / f64::from(scan.n)));
        vec![format!("1/{}", scan.n), number(scan.first()), number(scan.last_bound()), critical, number(beyond)]
    });
    let (found, end) = (&scans[0].found, |at: Option<&(u32, _, _)>| at.map_or(0.0, |(e, ..)| thousandths(*e)));
    let (all, first, last) = (found.len(), end(found.first()), end(found.last()));
    d.finding.table(
        &format!("Escapes before t = 100, of {all} eccentricities from {first} to {last}"),
        &["h", "first escape", "last that stays", "level set unbounded (up to h²)", "first with |q| > 3"],
        rows.collect(),
    );
}

/// The orbits on both sides of the instability, at h = 1/10: one that stays, the last that stays, the next, which
/// escapes, and the first escape if that is before them.
fn orbits(d: &mut Drawing<'_>, scans: &[Scan]) {
    let Some(scan) = scans.iter().find(|scan| scan.n == 10) else { return };
    let bound = |below: u32| scan.found.iter().rev().find(|(e, returns, _)| *e < below && returns.is_none());
    let Some(last) = bound(u32::MAX).map(|(e, ..)| *e) else { return };
    let mut shown: Vec<(u32, String)> = bound(last - 30).map(|(e, ..)| (*e, STAYS.to_owned())).into_iter().collect();
    let first = scan.escapes().next().filter(|(e, _)| *e < last);
    shown.extend(first.map(|(e, returns)| (e, format!("escapes at encounter {returns}"))));
    shown.push((last, STAYS.to_owned()));
    shown.extend(scan.escapes().find(|(e, _)| *e > last).map(|(e, _)| (e, "escapes".to_owned())));
    let curve = |(i, (e, label)): (usize, &(u32, String))| {
        let orbit = d.results.orbit(&d.run("drifts", "10", &e.to_string()));
        let points = orbit.map_or_else(Vec::new, |orbit| orbit.x.into_iter().zip(orbit.y).collect());
        let label = if label == STAYS { of_bound(&points) } else { label };
        Curve::line(format!("e = {}, {label}", thousandths(*e)), points, i)
    };
    let curves = shown.iter().enumerate().map(curve).collect();
    d.chart("orbits", curves);
}

/// The part of the plane in which orbits are drawn.
const FRAME: [(f64, f64); 2] = [(-30.0, 10.0), (-16.0, 16.0)];

const STAYS: &str = "stays";

/// What an orbit without an escape does: it stays in the frame, or leaves that and returns to it, perhaps after the
/// run.
fn of_bound(points: &[(f64, f64)]) -> &'static str {
    let [x, y] = FRAME;
    let within = |point: &(f64, f64)| (x.0..=x.1).contains(&point.0) && (y.0..=y.1).contains(&point.1);
    match (points.iter().all(within), points.last().is_some_and(within)) {
        (true, _) => STAYS,
        (false, true) => "bound, leaves the frame and returns",
        (false, false) => "bound, returns after t = 100",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scan(found: &[(u32, Option<u32>)]) -> Scan {
        Scan { n: 5, found: found.iter().map(|(e, returns)| (*e, *returns, 1.0)).collect() }
    }

    #[test]
    fn one_critical_value_is_between_the_last_that_stays_and_the_first_escape() {
        let one = scan(&[(600, None), (610, None), (620, Some(0)), (630, Some(0))]);
        assert_eq!(one.is_one_value(Coverage::All), Some(Verdict::Agrees));
        assert_eq!(one.is_one_value(Coverage::Some), Some(Coverage::Some.only_all(true)));
        assert_eq!(one.range(), Some((0.61, 0.62)));
    }

    #[test]
    fn escapes_among_orbits_that_stay_are_a_range() {
        let several = scan(&[(600, None), (610, Some(1)), (620, None), (630, None), (640, Some(0))]);
        assert_eq!(several.is_one_value(Coverage::Some), Some(Verdict::Differs));
        assert_eq!(several.range(), Some((0.6, 0.64)));
        let never = scan(&[(600, None)]);
        assert_eq!((never.is_one_value(Coverage::All), never.range()), (None, None));
    }

    /// The full scan of h = 1/5 finds an escape at 0.634 that the coarse one, with a first escape at 0.665, has no
    /// value for.
    #[test]
    fn a_coarse_scan_bounds_the_onset_from_above_only() {
        let at = |n: u32, e: u32| Scan { n, found: vec![(e - 5, None, 1.0), (e, Some(0), 9.0)] };
        let scans = [at(5, 665), at(10, 765)];
        let (found, verdict) = onset(&scans, Coverage::Some);
        assert_eq!(found, "it begins no later than at e = 0.665 at h = 1/5, 0.765 at h = 1/10");
        assert_eq!(verdict, Coverage::Some.only_all(true));
        let (found, verdict) = onset(&scans, Coverage::All);
        assert_eq!(found, "it begins at e = 0.660 to 0.665 at h = 1/5, 0.760 to 0.765 at h = 1/10");
        assert_eq!(verdict, Verdict::Agrees);
    }

    #[test]
    fn an_orbit_that_leaves_the_frame_does_not_stay() {
        assert_eq!(of_bound(&[(0.2, 0.0), (-1.8, 0.1)]), "stays");
        assert_eq!(of_bound(&[(0.2, 0.0), (-31.0, 0.1)]), "bound, returns after t = 100");
        assert_eq!(
            of_bound(&[(0.2, 0.0), (-31.0, 0.1), (0.2, 17.0), (0.2, 0.1)]),
            "bound, leaves the frame and returns"
        );
    }

    #[test]
    fn overlapping_ranges_do_not_decide_whether_the_step_matters() {
        assert_eq!(depends_on_step(&[Some((0.6, 0.62)), Some((0.63, 0.64))]), Verdict::Agrees);
        assert_eq!(depends_on_step(&[Some((0.6, 0.62)), Some((0.61, 0.64))]), Verdict::NotDecided(OVERLAP));
        assert_eq!(depends_on_step(&[Some((0.6, 0.62)), None]), Verdict::NotDecided(OVERLAP));
    }

    /// Each of six orbits stays, escapes at once or later; a quick report has every second one.
    #[test]
    fn a_coarse_scan_never_contradicts_the_fine_one() {
        let kinds = [None, Some(0), Some(1)];
        for code in 0..3_u32.pow(6) {
            let fine: Vec<_> = (0..6).map(|n| (600 + n, kinds[(code / 3_u32.pow(n) % 3) as usize])).collect();
            let coarse: Vec<_> = fine.iter().copied().step_by(2).collect();
            let verdicts = |found: &[(u32, Option<u32>)], coverage| {
                let scan = scan(found);
                [scan.is_one_value(coverage), scan.escapes_at_once(coverage)]
            };
            let both = verdicts(&coarse, Coverage::Some).into_iter().zip(verdicts(&fine, Coverage::All));
            for (quick, full) in both {
                let open = quick.is_none_or(|quick| quick.reason().is_some());
                assert!(open || quick == full, "{fine:?}: {quick:?}, {full:?}");
            }
        }
    }
}
