//! The noise floor of double precision against the length of the run, for several ways to take differences of states.

use crate::figures::noise::{Block, Differences};
use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let steps = if d.results.quick { 100_000 } else { 10_000_000 };
    let kinds = [
        (Differences::Sums, "β as a running sum"),
        (Differences::OfBeta, "β by increments"),
        (Differences::Increments, "q, p and β by increments"),
    ];
    let blocks = kinds.map(|(kind, label)| (label, d.results.noise(steps, kind).unwrap_or_default()));
    let curve = |n: usize, of: &dyn Fn(&Block) -> f64| {
        let (label, blocks) = &blocks[n];
        Curve::line(*label, blocks.iter().map(|block| ((block.steps as f64).log10(), of(block))).collect(), n)
    };
    d.chart("scatter", (0..3).map(|n| curve(n, &|block| block.scatter.log10())).collect());
    d.chart("wander", (1..3).map(|n| curve(n, &|block| block.wander.abs().log10())).collect());
    compare(d, [&blocks[0].1, &blocks[1].1, &blocks[2].1]);
}

/// The blocks by a running sum of β, by increments of β, and by increments of q, p and β; a part of them in a quick
/// report, which is shorter.
fn compare(d: &mut Drawing<'_>, [all_sums, all_beta, all_increments]: [&Vec<Block>; 3]) {
    let coverage = d.coverage();
    let [Some(sums), Some(beta), Some(increments)] = [all_sums.last(), all_beta.last(), all_increments.last()] else {
        return;
    };
    let largest = all_increments.iter().map(|block| block.scatter).fold(0.0, f64::max);
    d.check(
        "Increments keep the scatter at apocentre below 2e-15 to the end of the run.",
        format!("at most {} in {} steps", scientific(largest), increments.steps),
        coverage.every(largest < 2e-15),
    );
    d.check(
        "A running sum of β loses digits in proportion to the length of the run.",
        format!(
            "{} after {} steps, {:.0} times as much as with increments of β",
            scientific(sums.scatter),
            sums.steps,
            sums.scatter / beta.scatter
        ),
        coverage.any(sums.scatter > 100.0 * beta.scatter),
    );
    d.check(
        "Differences of q and p from increments reduce the scatter a little more.",
        format!(
            "{} against {} after {} steps",
            scientific(increments.scatter),
            scientific(beta.scatter),
            increments.steps
        ),
        coverage.every(all_increments.iter().zip(all_beta).all(|(own, other)| own.scatter < other.scatter)),
    );
    d.found(format!(
        "The mean wanders by {} in {} steps: this is the round-off of the states, which does not depend on how \
            differences are taken.",
        scientific(increments.wander.abs()),
        increments.steps
    ));
}
