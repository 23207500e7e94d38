//! The estimated errors of estimators, against their true errors on the exact flow.

use shadowstep::Number;

use crate::figures::prelude::*;

fn estimators() -> [(&'static str, EstimatorSettings); 6] {
    [
        ("T_{m,m}, m = 10", central(10)),
        ("T_{m,m}, m = 40", central(40)),
        ("best m ≤ 100", best(100, StoppingRule::Full)),
        ("E_8", bilinear(8)),
        ("E_16", bilinear(16)),
        ("E_32", bilinear(32)),
    ]
}

/// The largest ratio of true and estimated error that counts as reliable.
const RELIABLE: f64 = 2.0;

fn run(e: &str, h: &str, until: &str) -> Run {
    Run::of(Problem::Kepler, EXACT_FLOW, h).with("eccentricity", e).until(until)
}

/// log₁₀ of the true errors: the energy is −1/2.
fn true_errors(found: &Energies) -> Vec<f64> {
    found.values.iter().map(|value| (&number(value) + &Wide::from(0.5)).log10_abs()).collect()
}

/// log₁₀ of true error/estimate; infinite ratios, of zeros, are left out.
fn ratios(found: &Energies, estimates: &[Option<f64>]) -> Vec<f64> {
    let pairs = true_errors(found).into_iter().zip(estimates);
    pairs.filter_map(|(error, estimate)| Some(error - (*estimate)?)).filter(|ratio| ratio.is_finite()).collect()
}

/// The median, the 95th percentile, and the largest.
fn quantiles(mut ratios: Vec<f64>) -> [f64; 3] {
    ratios.sort_by(f64::total_cmp);
    let at = |part: f64| {
        ratios.get(((ratios.len().max(1) - 1) as f64 * part) as usize).map_or(f64::NAN, |y| 10_f64.powf(*y))
    };
    [at(0.5), at(0.95), at(1.0)]
}

fn shown(ratio: f64) -> String {
    if (0.01..1000.0).contains(&ratio) { format!("{ratio:.2}") } else { format!("{ratio:.0e}") }
}

pub(super) fn draw(d: &mut Drawing<'_>) {
    for (label, estimator) in [&estimators()[2], &estimators()[4]] {
        along_an_orbit(d, label, estimator);
    }
    let orbits = d.results.grid(&["0", "3/10", "6/10", "9/10"], &["0", "6/10", "9/10"]);
    let steps = d.results.grid(&["1/10", "3/31", "1/20", "1/40"], &["1/10", "1/20"]);
    let mut rows = Vec::new();
    let mut worst_of_all = 0.0_f64;
    for (label, estimator) in &estimators() {
        let all = || orbits.iter().flat_map(|e| steps.iter().map(move |h| run(e, h, "7")));
        let of = |pick: fn(&Energies) -> &Vec<Option<f64>>| {
            quantiles(
                all()
                    .filter_map(|run| d.results.energies(&run, estimator))
                    .flat_map(|found| ratios(&found, pick(&found)))
                    .collect(),
            )
        };
        let (estimated, last_terms) = (of(|found| &found.errors), of(|found| &found.last_terms));
        let coarse = d.results.energies(&run("6/10", "2", "100"), estimator);
        let coarse = coarse.map_or(f64::NAN, |found| quantiles(ratios(&found, &found.errors))[2]);
        let few = if coarse > RELIABLE { "not reliable here".to_owned() } else { shown(coarse) };
        worst_of_all = worst_of_all.max(estimated[2]);
        rows.push(
            [(*label).to_owned()].into_iter().chain(estimated.map(shown)).chain([shown(last_terms[2]), few]).collect(),
        );
    }
    let list = |values: &[&str]| values.join(", ");
    d.finding.table(
        &format!("True error / estimated error over one orbit each of e = {}, h = {}", list(orbits), list(steps)),
        &["", "median", "95 %", "largest", "largest, by the last term", "largest, h = 2: three states a period"],
        rows,
    );
    d.check(
        "The estimated errors are hardly ever smaller than the true ones, close encounters included.",
        format!("true/estimated is at most {worst_of_all:.2}"),
        d.coverage().every(worst_of_all < RELIABLE),
    );
}

fn along_an_orbit(d: &mut Drawing<'_>, label: &str, estimator: &EstimatorSettings) {
    let Some(found) = d.results.energies(&run("6/10", "1/20", "7"), estimator) else { return };
    let against = |sizes: Vec<f64>| found.times.iter().copied().zip(sizes).collect::<Points>();
    let known = |sizes: &[Option<f64>]| against(sizes.iter().map(|size| size.unwrap_or(f64::NAN)).collect());
    let curves = vec![
        Curve::thick("true", against(true_errors(&found)), 0),
        Curve::line("estimated", known(&found.errors), 1),
        Curve::dashed("last term", known(&found.last_terms), 2),
    ];
    d.chart_of("errors", &[("estimator", label)], curves);
}
