//! Kepler's problem: the drift against the step, the eccentricity and the scheme; the modified energy in time.

use std::f64::consts::PI;

use shadowstep::Number;

use super::calculation::{By, Energies, Setting, number};
use super::chart::Marker;
use super::charts::{dashed, dots, line, linear, log10_axis, right, thick};
use super::drawn::{DECAY_HEADER, Drawn, decay, decay_row, power};
use super::fit::ExponentialDecay;
use super::results::Results;

pub(crate) const BEST: By = By::Best { largest: 200, early: false };

pub(crate) const SCHEMES: [(&str, &str); 4] = [
    ("stormer-verlet", "Störmer–Verlet"),
    ("yoshida4", "Yoshida 4"),
    ("blanes-moan-s6", "Blanes–Moan S6"),
    ("blanes-moan-srkn6b", "Blanes–Moan SRKN6b"),
];

pub(crate) const EXACT: &str = "exact-flow";

/// 1/h
const STEPS: [u32; 24] = [4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 22, 24, 27, 30, 35, 40, 45, 50, 60];

/// The distance of the nearest singularity of q(t) from the real axis: E = i arcosh(1/e) in t = E − e sin E.
pub(crate) fn singularity(e: f64) -> f64 {
    (1.0 / e).acosh() - (1.0 - e * e).sqrt()
}

/// Störmer–Verlet and others with e = 0.6, a = 1.
pub(crate) fn run(propagator: &'static str, n: u32) -> Setting {
    Setting::of("kepler", propagator, format!("1/{n}"))
}

/// (1/h, log₁₀ drift)
pub(crate) fn drifts(results: &Results, propagator: &'static str, steps: &[u32], by: By) -> Vec<(f64, f64)> {
    steps.iter().map(|&n| (f64::from(n), results.log10_drift(&run(propagator, n), by))).collect()
}

/// The rate over h ≤ 1/10, of points against 1/h.
pub(crate) fn rate(points: &[(f64, f64)]) -> Option<ExponentialDecay> {
    decay(&points.iter().map(|(n, y)| (1.0 / n, *y)).collect::<Vec<_>>(), 0.1)
}

pub(crate) fn step(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The drift against the step, e = 0.6: the theoretical exp(−c/h) behaviour.",
        "In contrast with the pendulum, the T_{m,m} do not converge as m → ∞: the m of 2 … 200 with the least |T_{m,m} − T_{m−1,m−1}| is taken.",
    ]);
    let steps = results.grid(&STEPS, 5);
    let best = drifts(results, "stormer-verlet", &steps, BEST);
    let fixed = [5, 20, 60, 200].map(|m| (m, drifts(results, "stormer-verlet", &steps, By::Central { m })));
    let mut curves = vec![thick("best m ≤ 200", best.clone(), 0)];
    curves.extend(fixed.iter().enumerate().map(|(i, (m, points))| line(format!("m = {m}"), points.clone(), i + 1)));
    drawn.chart(
        "Störmer–Verlet, Kepler, e = 0.6",
        linear("1/h"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves,
        "The same m at every state, and the best one of each.",
    );
    let fit = rate(&best);
    if let Some(fit) = &fit {
        drawn.check(
            "The drift follows exp(−c/h).",
            format!("c = {:.3} ± {:.3}, a line to within {:.2} decades", fit.c, fit.c_error, fit.spread),
            fit.spread < 0.5 && fit.c > 0.0,
        );
    }
    let at = |points: &[(f64, f64)], n: f64| points.iter().find(|(x, _)| *x == n).map_or(f64::NAN, |(_, y)| *y);
    let [twenty, _, many] = [1, 2, 3].map(|i| at(&fixed[i].1, 10.0));
    drawn.check(
        "T_{m,m} do not converge as m → ∞.",
        format!(
            "at h = 1/10: {} by m = 20, {} by m = 200, {} by the best m",
            power(twenty),
            power(many),
            power(at(&best, 10.0))
        ),
        many > twenty - 1.0,
    );
    drawn.table(
        "The rate",
        &DECAY_HEADER,
        vec![
            decay_row("best m ≤ 200", fit.as_ref()),
            vec![
                "π ρ, what differences of samples alias to".to_owned(),
                format!("{:.4}", PI * singularity(0.6)),
                String::new(),
                String::new(),
            ],
        ],
    );
    drawn
        .digits_held("the drift at h = 1/20 by the best m", results.digits_held(&run("stormer-verlet", 20), BEST, 200));
    drawn.digits_held(
        "the drift at h = 1/20 by m = 20",
        results.digits_held(&run("stormer-verlet", 20), By::Central { m: 20 }, 200),
    );
    drawn
}

/// Thousandths of e, to which the instability is located.
fn escapes(results: &Results, n: u32, coarse: &[u32]) -> Option<f64> {
    // a bound orbit stays within 1 + e, its precession included
    let escapes = |e: u32| Some(results.farthest(&of(n, e))? > 3.0);
    let first = coarse.iter().position(|&e| escapes(e) == Some(true))?;
    let (mut bound, mut escaped) = (*coarse.get(first.checked_sub(1)?)?, coarse[first]);
    while escaped - bound > 1 {
        let middle = u32::midpoint(bound, escaped);
        match escapes(middle)? {
            true => escaped = middle,
            false => bound = middle,
        }
    }
    Some(f64::from(escaped) / 1000.0)
}

/// With e in thousandths.
fn of(n: u32, e: u32) -> Setting {
    run("stormer-verlet", n).with("eccentricity", format!("{e}/1000"))
}

pub(crate) fn eccentricity(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "Almost circular orbits show much better preservation of the energy than highly elliptical ones.",
        "An instability occurs at a critical eccentricity which depends on the step: the topology of the energy levels of the modified \
         energy changes, which leads to unbounded trajectories.",
    ]);
    let grid: Vec<u32> = (1..=19).map(|n| 50 * n).collect();
    let thousandths = results.grid(&grid, 4);
    let fine: Vec<u32> = grid.iter().copied().chain([970, 990]).collect();
    let (mut curves, mut rows) = (Vec::new(), Vec::new());
    for (i, n) in [5, 10, 20, 40].into_iter().enumerate() {
        let points: Vec<_> =
            thousandths.iter().map(|&e| (f64::from(e) / 1000.0, results.log10_drift(&of(n, e), BEST))).collect();
        let escape = escapes(results, n, &fine);
        rows.push(vec![format!("1/{n}"), escape.map_or("none below 0.99".to_owned(), |e| format!("{e:.3}"))]);
        if let (Some((_, least)), Some((_, middle))) = (points.first(), points.iter().find(|(e, _)| *e >= 0.6)) {
            drawn.check(
                &format!("h = 1/{n}: almost circular orbits preserve it much better."),
                format!("{} at e = 0.05, {} at e = 0.6 or the next value of the grid", power(*least), power(*middle)),
                *least < middle - 3.0,
            );
        }
        curves.push(line(format!("h = 1/{n}"), points, i));
    }
    let located: Vec<&String> = rows.iter().map(|row| &row[1]).filter(|e| !e.starts_with("none")).collect();
    if !located.is_empty() {
        let grows = located.windows(2).all(|pair| pair[0] < pair[1]);
        let list = rows.iter().map(|row| format!("{} at h = {}", row[1], row[0])).collect::<Vec<_>>().join(", ");
        drawn.check("An instability occurs at a critical eccentricity which depends on the step.", list, grows);
    }
    drawn.table("The least eccentricity with which the body goes beyond |q| = 3 before t = 100", &["h", "e"], rows);
    drawn.chart(
        "Störmer–Verlet, Kepler",
        linear("eccentricity e"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves,
        "The best m of each state, up to 200.",
    );
    drawn
}

pub(crate) fn schemes(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The plots for the drift of Yoshida's method and of the Blanes–Moan method look the same as for Störmer–Verlet; in particular \
         the constant c in exp(−c/h) is the same.",
        "The drift of Störmer–Verlet is about a factor of three smaller than that of Yoshida's method and a factor of four smaller than that of \
         Blanes and Moan.",
    ]);
    let steps = results.grid(&STEPS, 5);
    let of = SCHEMES.map(|(scheme, label)| (label, drifts(results, scheme, &steps, BEST)));
    let control = drifts(results, EXACT, &steps, BEST);
    let mut curves: Vec<_> =
        of.iter().enumerate().map(|(i, (label, points))| line(*label, points.clone(), i)).collect();
    curves.push(dashed("exact flow", control.clone(), 8));
    drawn.chart(
        "Kepler, e = 0.6, the best m up to 200",
        linear("1/h"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves,
        "Dashed: the same estimator on the exact flow, whose energy is −1/2 at every state.",
    );
    let ratio = |points: &[(f64, f64)], to: &[(f64, f64)]| {
        let fine: Vec<f64> =
            points.iter().zip(to).filter(|((n, _), _)| *n >= 10.0).map(|((_, a), (_, b))| a - b).collect();
        10_f64.powf(fine.iter().sum::<f64>() / fine.len() as f64)
    };
    let [verlet, others @ ..] = &of;
    for ((label, points), stated) in others.iter().zip([3.0, 4.0, 4.0]) {
        let found = ratio(points, &verlet.1);
        drawn.check(
            &format!("The drift of {label} is about {stated} times that of Störmer–Verlet."),
            format!("{found:.2} times (geometric mean over h ≤ 1/10)"),
            (found / stated - 1.0).abs() < 0.35,
        );
    }
    let fits: Vec<_> = of.iter().map(|(label, points)| (*label, rate(points))).collect();
    let rates: Vec<f64> = fits.iter().filter_map(|(_, fit)| Some(fit.as_ref()?.c)).collect();
    if let [first, others @ ..] = &rates[..] {
        let off = others.iter().map(|c| (c / first - 1.0).abs()).fold(0.0, f64::max);
        drawn.check("The constant c is the same.", format!("to within {:.2} %", 100.0 * off), off < 0.05);
    }
    let mut rows: Vec<_> = fits.iter().map(|(label, fit)| decay_row(label, fit.as_ref())).collect();
    rows.push(decay_row("exact flow", rate(&control).as_ref()));
    drawn.table("Rates", &DECAY_HEADER, rows);
    drawn.found(format!(
        "The control shows {:.3} times the drift of Blanes and Moan's SRKN6b: that drift is the estimator's, not the scheme's.",
        ratio(&control, &of[3].1)
    ));
    drawn
}

/// (t, log₁₀|value − reference|)
fn off(energies: &Energies, reference: usize) -> Vec<(f64, f64)> {
    let reference = number(&energies.values[reference]);
    let sizes = energies.values.iter().map(|value| (number(value) - &reference).log10_abs());
    energies.times.iter().copied().zip(sizes).collect()
}

/// The state nearest to the first apocentre, t = π.
fn apocentre(energies: &Energies) -> usize {
    let nearest = energies.times.iter().map(|t| (t - PI).abs()).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map_or(0, |(place, _)| place)
}

pub(crate) fn energies(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The modified energy less the initial one, for several steps (Störmer–Verlet) and for the methods at h = 0.1. There are peaks when the \
         particle is near the singularity, and the energy essentially recovers its value after this point before another close encounter.",
        "The methods give rather different results, even though the maximal variation is almost the same. The Blanes–Moan method seems to \
         preserve the modified energy better after the close encounter.",
    ]);
    let steps: &[u32] = if results.quick { &[10, 20] } else { &[10, 20, 30] };
    let of_steps: Vec<_> =
        steps.iter().map(|&n| (format!("h = 1/{n}"), results.energies(&run("stormer-verlet", n), BEST))).collect();
    let of_schemes: Vec<_> = SCHEMES
        .into_iter()
        .chain([(EXACT, "exact flow")])
        .map(|(scheme, label)| (label.to_owned(), results.energies(&run(scheme, 10), BEST)))
        .collect();
    let y = "|modified energy − its first value|";
    let from_apocentre = "|modified energy − its value at the first apocentre|";
    let charts = [
        ("Störmer–Verlet, several steps", y, false, &of_steps),
        ("h = 1/10, several schemes", y, false, &of_schemes),
        ("Störmer–Verlet, several steps, from the apocentre", from_apocentre, true, &of_steps),
        ("h = 1/10, several schemes, from the apocentre", from_apocentre, true, &of_schemes),
    ];
    for (title, y, from_apocentre, of) in charts {
        let curves = of.iter().enumerate().filter_map(|(i, (label, energies))| {
            let energies = energies.as_ref()?;
            let points = off(energies, if from_apocentre { apocentre(energies) } else { 0 });
            let curve = points.into_iter().filter(|(t, _)| *t <= 40.0).collect();
            Some(if i == 4 { dashed(label.clone(), curve, 8) } else { line(label.clone(), curve, i) })
        });
        let caption = if from_apocentre {
            "The start is a pericentre, where the estimate is worst; from an apocentre the changes between encounters can be seen."
        } else {
            "t ≤ 40 of [0, 100]; the start is a pericentre."
        };
        drawn.chart(title, linear("time t"), log10_axis(y), curves.collect(), caption);
    }
    let verlet = of_steps.iter().find(|(label, _)| label == "h = 1/20").and_then(|(_, energies)| energies.as_ref());
    if let Some(verlet) = verlet {
        let points = off(verlet, apocentre(verlet));
        let largest = |near: bool| {
            let of_t = |t: f64| (t / (2.0 * PI)).fract();
            let chosen = points
                .iter()
                .filter(|(t, _)| near == (of_t(*t) < 0.1 || of_t(*t) > 0.9) && (near || (of_t(*t) - 0.5).abs() < 0.1));
            chosen.map(|(_, y)| *y).filter(|y| y.is_finite()).fold(f64::NEG_INFINITY, f64::max)
        };
        let (encounter, between) = (largest(true), largest(false));
        drawn.check(
            "It essentially recovers its value after a close encounter (Störmer–Verlet, h = 1/20).",
            format!(
                "off by up to {} near the pericentres, by {} near the apocentres",
                power(encounter),
                power(between)
            ),
            between < encounter - 2.0,
        );
    }
    let changes: Vec<(String, f64, f64)> = of_schemes
        .iter()
        .filter_map(|(label, energies)| {
            let energies = energies.as_ref()?;
            let points = off(energies, apocentre(energies));
            let largest = |quiet: bool| {
                let chosen = points.iter().filter(|(t, _)| !quiet || ((t / (2.0 * PI)).fract() - 0.5).abs() < 0.05);
                chosen.map(|(_, y)| *y).fold(f64::NEG_INFINITY, f64::max)
            };
            Some((label.clone(), largest(false), largest(true)))
        })
        .collect();
    if let [verlet, .., s6, srkn, _] = &changes[..] {
        let most = changes.iter().map(|(_, peak, _)| *peak);
        let (least, largest) = (most.clone().fold(f64::INFINITY, f64::min), most.fold(f64::NEG_INFINITY, f64::max));
        drawn.check(
            "The maximal variation is almost the same.",
            format!("from {} to {} at h = 1/10", power(least), power(largest)),
            largest - least < 1.0,
        );
        drawn.check(
            "Blanes and Moan's methods preserve it better after the encounter.",
            format!(
                "near apocentres {} for S6 and {} for SRKN6b, {} for Störmer–Verlet",
                power(s6.2),
                power(srkn.2),
                power(verlet.2)
            ),
            s6.2 < verlet.2 && srkn.2 < verlet.2,
        );
    }
    let rows = changes.iter().map(|(label, peak, quiet)| vec![label.clone(), power(*peak), power(*quiet)]).collect();
    drawn.table(
        "Largest difference from the first apocentre, h = 1/10, t ≤ 100",
        &["", "at all times", "near apocentres"],
        rows,
    );
    drawn
}

pub(crate) fn orders(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The change per step, the accumulated change, and the optimal m, capped at 200, for Störmer–Verlet with h = 1/20 and e = 0.6. Near \
         the singularity quite a high m is used; away from it a lower one suffices.",
        "The ad-hoc criterion, which stops where the errors rise, gives plots that are nearly indistinguishable from those of the full search.",
    ]);
    let searches = [("full search", false), ("early stop", true)]
        .map(|(label, early)| (label, results.energies(&run("stormer-verlet", 20), By::Best { largest: 200, early })));
    for (label, found) in &searches {
        let Some(found) = found else { continue };
        let values: Vec<_> = found.values.iter().map(|value| number(value)).collect();
        let steps = values.windows(2).map(|pair| (pair[1].clone() - &pair[0]).log10_abs());
        let shown = |points: Vec<(f64, f64)>| points.into_iter().filter(|(t, _)| *t <= 20.0).collect::<Vec<_>>();
        let per_step = found.times[1..].iter().copied().zip(steps).collect();
        let orders = found.times.iter().zip(&found.orders).map(|(t, m)| (*t, f64::from(*m))).collect();
        drawn.chart_with_right_axis(
            &format!("Störmer–Verlet, h = 1/20, e = 0.6, {label}"),
            linear("time t"),
            log10_axis("change of the modified energy"),
            Some(linear("m")),
            vec![
                line("accumulated", shown(off(found, 0)), 0),
                dashed("per step", shown(per_step), 1),
                right(dots("m", shown(orders), 2, Marker::Cross)),
            ],
            "t ≤ 20 of [0, 100].",
        );
    }
    if let [(_, Some(full)), (_, Some(early))] = &searches {
        let mean = |near: bool| {
            let of = full
                .times
                .iter()
                .zip(&full.orders)
                .filter(|(t, _)| near == (((**t + 0.3) / (2.0 * PI)).fract() < 0.6 / (2.0 * PI)));
            let all: Vec<f64> = of.map(|(_, m)| f64::from(*m)).collect();
            all.iter().sum::<f64>() / all.len() as f64
        };
        drawn.check(
            "Near the singularity a higher m is used.",
            format!("on average {:.0} within 0.3 of a pericentre, {:.0} elsewhere", mean(true), mean(false)),
            mean(true) > mean(false),
        );
        let drift = |energies: &Energies| {
            let values: Vec<_> = energies.values.iter().map(|value| number(value)).collect();
            let most = values.iter().max_by(|a, b| a.total_cmp(b)).expect("there are values");
            let least = values.iter().min_by(|a, b| a.total_cmp(b)).expect("there are values");
            (most.clone() - least).log10_abs()
        };
        let (full, early) = (drift(full), drift(early));
        drawn.check(
            "The early stop gives nearly the same.",
            format!("drift {} by the early stop, {} by the full search", power(early), power(full)),
            (early - full).abs() < 0.3,
        );
    }
    drawn
}
