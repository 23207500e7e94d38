//! The noise floor of double precision against the length of the run, for several ways to take differences of states.

use crate::drawing::additional;
use crate::figure::Figure;
use crate::noise::{Block, Differences};
use crate::numbers::scientific;
use crate::results::Results;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Coverage;

pub(super) const FIGURE: Figure =
    Figure { name: "double-precision", title: "The noise floor of double precision", of_paper: "", draw };

fn draw(results: &Results) -> Finding {
    let steps = if results.quick { 100_000 } else { 10_000_000 };
    let kinds = [
        (Differences::Sums, "β as a running sum"),
        (Differences::OfBeta, "β by increments"),
        (Differences::Increments, "q, p and β by increments"),
    ];
    let blocks = kinds.map(|(kind, label)| (label, results.noise(steps, kind).unwrap_or_default()));
    let curve = |n: usize, of: &dyn Fn(&Block) -> f64| {
        let (label, blocks) = &blocks[n];
        Curve::line(*label, blocks.iter().map(|block| ((block.steps as f64).log10(), of(block))).collect(), n)
    };
    let mut finding =
        additional("Störmer–Verlet on Kepler's problem, e = 0.6, h = 1/20, in double precision (f64), by E_8");
    finding.chart(
        Chart::new(
            "Scatter of the modified energy near apocentres",
            Axis::log10("steps"),
            Axis::log10("max − min within ± 10 steps"),
            (0..3).map(|n| curve(n, &|block| block.scatter.log10())).collect(),
        ),
        "The largest value over the apocentres of the block that ends there.",
    );
    finding.chart(
        Chart::new(
            "Wander of its mean",
            Axis::log10("steps"),
            Axis::log10("|mean − mean of the first 1000 steps|"),
            (1..3).map(|n| curve(n, &|block| block.wander.abs().log10())).collect(),
        ),
        "The effect of the round-off of the steps, which no estimator can remove.",
    );
    let [sums, beta, increments] = &blocks;
    compare(&mut finding, &[&sums.1, &beta.1, &increments.1], results.coverage());
    finding
}

/// The blocks by a running sum of β, by increments of β, and by increments of q, p and β; a part of them in a quick
/// report, which is shorter.
fn compare(finding: &mut Finding, [all_sums, all_beta, all_increments]: &[&Vec<Block>; 3], coverage: Coverage) {
    let [Some(sums), Some(beta), Some(increments)] = [all_sums.last(), all_beta.last(), all_increments.last()] else {
        return;
    };
    let largest = all_increments.iter().map(|block| block.scatter).fold(0.0, f64::max);
    finding.check(
        "Increments keep the scatter at apocentre below 2e-15 to the end of the run.",
        format!("at most {} in {} steps", scientific(largest), increments.steps),
        coverage.every(largest < 2e-15),
    );
    finding.check(
        "A running sum of β loses digits in proportion to the length of the run.",
        format!(
            "{} after {} steps, {:.0} times as much as with increments of β",
            scientific(sums.scatter),
            sums.steps,
            sums.scatter / beta.scatter
        ),
        coverage.any(sums.scatter > 100.0 * beta.scatter),
    );
    finding.check(
        "Differences of q and p from increments reduce the scatter a little more.",
        format!(
            "{} against {} after {} steps",
            scientific(increments.scatter),
            scientific(beta.scatter),
            increments.steps
        ),
        coverage.every(all_increments.iter().zip(*all_beta).all(|(own, other)| own.scatter < other.scatter)),
    );
    finding.found(format!(
        "The mean wanders by {} in {} steps: this is the round-off of the states, which does not depend on how \
            differences are taken.",
        scientific(increments.wander.abs()),
        increments.steps
    ));
}
