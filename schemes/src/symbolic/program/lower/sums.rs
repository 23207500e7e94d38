//! Common parts of sums, which are computed once: x² + y² is a part of x² + y² + 1.

use std::collections::HashMap;

use super::collect::{Id, LoweringPlan, Quantity};

/// The largest number of pairs of parts that are examined: only very long formulas have more.
const MOST_VISITS: usize = 1_000_000;

/// Two parts of a sum, and whether their signs differ.
type Pair = (Id, Id, bool);

/// Rewrites the sums of a plan such that common parts are sums of their own.
pub(super) fn share(plan: &mut LoweringPlan) {
    let mut visits = 0;
    while let Some(pair) = best_pair(plan, &mut visits) {
        replace(plan, pair);
    }
}

fn sums(plan: &LoweringPlan) -> impl Iterator<Item = &Vec<(bool, Id)>> {
    plan.quantities.iter().filter_map(|quantity| match quantity {
        Quantity::Sum(parts) => Some(parts),
        _ => None,
    })
}

/// The two parts that are together in most sums, if these are at least two.
fn best_pair(plan: &LoweringPlan, visits: &mut usize) -> Option<Pair> {
    let mut uses = vec![0; plan.quantities.len()];
    sums(plan).flatten().for_each(|(_, part)| uses[*part] += 1);
    let mut pairs: HashMap<Pair, usize> = HashMap::new();
    for parts in sums(plan) {
        let shared: Vec<_> = parts.iter().filter(|(_, part)| uses[*part] > 1).collect();
        for (index, (sign, a)) in shared.iter().enumerate() {
            for (other, b) in &shared[index + 1..] {
                *pairs.entry((*a.min(b), *a.max(b), sign != other)).or_insert(0) += 1;
            }
        }
        *visits += parts.len() + shared.len() * shared.len();
        if *visits > MOST_VISITS {
            return None;
        }
    }
    let (pair, uses) =
        pairs.into_iter().max_by_key(|((a, b, differ), uses)| (*uses, usize::MAX - a, usize::MAX - b, *differ))?;
    (uses > 1).then_some(pair)
}

/// Replaces a pair by one part everywhere.
fn replace(plan: &mut LoweringPlan, (a, b, differ): Pair) {
    let both = plan.quantities.len();
    for quantity in &mut plan.quantities {
        if let Quantity::Sum(parts) = quantity {
            let sign = |id| parts.iter().find(|(_, part)| *part == id).map(|(negative, _)| *negative);
            if let (Some(of_a), Some(of_b)) = (sign(a), sign(b))
                && (of_a != of_b) == differ
            {
                parts.retain(|(_, part)| *part != a && *part != b);
                parts.push((of_a, both));
            }
        }
    }
    plan.quantities.push(Quantity::Sum(vec![(false, a), (differ, b)]));
}
