//! The pendulum: the drift against the initial momentum.

use super::pendulum::SCHEME;
use crate::drawing::{digits_held, drift_axis};
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::numbers::power;
use crate::results::Results;
use crate::run::Run;
use shadowstep::problems::Problem;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;

pub(super) const FIGURE: Figure = Figure {
    name: "pendulum-momentum",
    title: "The pendulum: drift against the initial momentum",
    of_paper: "figure 2",
    draw,
};

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "The drift as a function of the initial momentum p(0), q(0) = 0.",
        "The Störmer–Verlet method shows improved energy preservation near the equilibrium point, revealing the \
         dependence exp(−c/(h ‖f‖)), in which ‖f‖ decreases as p → 0.",
    ]);
    let all: Vec<u32> = (1..=19).chain([21]).chain((22..=30).step_by(2)).collect();
    let tenths = results.grid(&all, &[1, 5, 10, 15, 19, 21, 30]);
    let mut curves = Vec::new();
    for (i, n) in [2_u32, 4, 10].into_iter().enumerate() {
        let run = |p: u32| Run::of(Problem::Pendulum, SCHEME, format!("1/{n}")).with("p", format!("{p}/10"));
        let points: Vec<_> =
            tenths.iter().map(|&p| (f64::from(p) / 10.0, results.log10_drift(&run(p), &BEST))).collect();
        let at = [1, 5, 10, 15, 19].map(|p| results.log10_drift(&run(p), &BEST));
        finding.check(
            format!("h = 1/{n}: the drift falls as p(0) → 0."),
            format!("{} at p(0) = 0.1, 0.5, 1, 1.5, 1.9", at.map(power).join(", ")),
            at.is_sorted(),
        );
        curves.push(Curve::line(format!("h = 1/{n}"), points, i));
    }
    let checked = Run::of(Problem::Pendulum, SCHEME, "1/4").with("p", "19/10");
    digits_held(&mut finding, "the drift at h = 1/4, p(0) = 1.9", results.digits_held(&checked, &BEST, 200));
    finding.chart(
        Chart::new("Störmer–Verlet, pendulum, q(0) = 0", Axis::linear("p(0)"), drift_axis(), curves),
        "Best m up to 200. For p(0) > 2 the pendulum rotates; p(0) = 2 is the separatrix.",
    );
    finding
}
