//! Common parts of products, which are computed once.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::collect::{Atom, LoweringPlan, Product, Quantity};

/// The largest number of pairs of factors that are examined: only very long formulas have more.
const MOST_VISITS: usize = 1_000_000;

/// Rewrites the products of a plan such that common parts are atoms of their own.
pub(super) fn share(plan: &mut LoweringPlan) {
    merge_denominators(plan);
    invert_shared(plan);
    let mut visits = 0;
    while let Some(pair) = best_pair(plan, &mut visits) {
        replace(plan, pair);
    }
    move_signs(plan);
}

fn products(plan: &LoweringPlan) -> impl Iterator<Item = &Product> {
    plan.quantities.iter().filter_map(|quantity| match quantity {
        Quantity::Product(product) => Some(product),
        _ => None,
    })
}

fn products_mut(plan: &mut LoweringPlan) -> impl Iterator<Item = &mut Product> {
    plan.quantities.iter_mut().filter_map(|quantity| match quantity {
        Quantity::Product(product) => Some(product),
        _ => None,
    })
}

fn add_atom(plan: &mut LoweringPlan, atom: Atom) -> usize {
    plan.atoms.push(atom);
    plan.atoms.len() - 1
}

/// The atoms in denominators, with their products and multiplicities.
fn denominators(plan: &LoweringPlan) -> BTreeMap<usize, Vec<(usize, i64)>> {
    let mut found: BTreeMap<usize, Vec<(usize, i64)>> = BTreeMap::new();
    for (index, product) in products(plan).enumerate() {
        for (atom, count) in product.factors.iter().filter(|(_, count)| **count < 0) {
            found.entry(*atom).or_default().push((index, *count));
        }
    }
    found
}

/// Factors in the same denominators become one: 1/(a b) is a single division.
fn merge_denominators(plan: &mut LoweringPlan) {
    let mut groups: BTreeMap<Vec<(usize, i64)>, Vec<usize>> = BTreeMap::new();
    for (atom, places) in denominators(plan) {
        if places.len() > 1 {
            groups.entry(places).or_default().push(atom);
        }
    }
    for atoms in groups.into_values().filter(|atoms| atoms.len() > 1) {
        let merged = atoms[1..].iter().fold(atoms[0], |merged, atom| add_atom(plan, Atom::Pair(merged, *atom)));
        for product in products_mut(plan) {
            if let Some(count) = product.factors.get(&atoms[0]).copied().filter(|count| *count < 0) {
                atoms.iter().for_each(|atom| _ = product.factors.remove(atom));
                product.factors.insert(merged, count);
            }
        }
    }
}

/// A factor in several denominators is inverted once.
fn invert_shared(plan: &mut LoweringPlan) {
    for (atom, places) in denominators(plan) {
        if places.len() > 1 {
            let inverse = add_atom(plan, Atom::Inverse(atom));
            for product in products_mut(plan) {
                if let Some(count) = product.factors.get(&atom).copied().filter(|count| *count < 0) {
                    product.factors.remove(&atom);
                    product.factors.insert(inverse, -count);
                }
            }
        }
    }
}

/// The two factors, perhaps equal, whose product saves most multiplications if it is computed first.
fn best_pair(plan: &LoweringPlan, visits: &mut usize) -> Option<(usize, usize)> {
    let mut uses: HashMap<(usize, usize), i64> = HashMap::new();
    for product in products(plan) {
        let factors: Vec<(usize, i64)> =
            product.factors.iter().map(|(a, n)| (*a, *n)).filter(|(_, n)| *n > 0).collect();
        for (index, (a, n)) in factors.iter().enumerate() {
            if *n > 1 {
                *uses.entry((*a, *a)).or_insert(0) += n / 2;
            }
            for (b, m) in &factors[index + 1..] {
                *uses.entry((*a, *b)).or_insert(0) += n.min(m);
            }
        }
        *visits += factors.len() * factors.len();
        if *visits > MOST_VISITS {
            return None;
        }
    }
    let (pair, uses) = uses.into_iter().max_by_key(|((a, b), uses)| (*uses, usize::MAX - a, usize::MAX - b))?;
    (uses > 1).then_some(pair)
}

/// Replaces a pair by one atom everywhere.
fn replace(plan: &mut LoweringPlan, (a, b): (usize, usize)) {
    let both = add_atom(plan, Atom::Pair(a, b));
    for product in products_mut(plan) {
        let count = |atom| product.factors.get(&atom).copied().unwrap_or(0);
        let uses = if a == b { count(a) / 2 } else { count(a).min(count(b)) };
        if uses > 0 {
            *product.factors.entry(a).or_insert(0) -= uses;
            *product.factors.entry(b).or_insert(0) -= uses;
            product.factors.insert(both, uses);
            product.factors.retain(|_, count| *count != 0);
        }
    }
}

/// Moves minus signs into integer factors: −2 x costs what 2 x does, −x one operation more than x.
fn move_signs(plan: &mut LoweringPlan) {
    absorb_negations(plan);
    let mut excluded = HashSet::new();
    let mut negative = HashSet::new();
    for product in products(plan) {
        let integers = integers(plan, product);
        match &integers[..] {
            // The minus goes into the only integer, if all other products with this integer have a minus, too.
            [atom] if product.negative => _ = negative.insert(*atom),
            _ => excluded.extend(integers),
        }
    }
    for atom in negative.difference(&excluded) {
        match &mut plan.atoms[*atom] {
            Atom::Scale(n) | Atom::Shrink(n) => *n = -*n,
            _ => {}
        }
    }
    let all: Vec<Vec<usize>> = products(plan).map(|product| integers(plan, product)).collect();
    for (product, integers) in products_mut(plan).zip(all) {
        if product.negative && integers.iter().any(|atom| negative.contains(atom) && !excluded.contains(atom)) {
            product.negative = false;
        }
    }
}

/// −(a b), where a b itself is not needed, becomes a product with a minus.
fn absorb_negations(plan: &mut LoweringPlan) {
    let mut uses = vec![0; plan.quantities.len()];
    for quantity in &plan.quantities {
        match quantity {
            Quantity::Sum(parts) => parts.iter().for_each(|(_, part)| uses[*part] += 1),
            Quantity::Negate(inner) | Quantity::Call(_, inner) => uses[*inner] += 1,
            Quantity::Leaf(_) | Quantity::Number(_) | Quantity::Product(_) => {}
        }
    }
    for atom in &plan.atoms {
        match atom {
            Atom::Value(id) | Atom::Sqrt(id) | Atom::ReciprocalSqrt(id) | Atom::Root(id, _) => uses[*id] += 1,
            Atom::Power(base, exponent) => [base, exponent].into_iter().for_each(|id| uses[*id] += 1),
            Atom::Scale(_) | Atom::Shrink(_) | Atom::Inverse(_) | Atom::Pair(..) => {}
        }
    }
    plan.outputs.iter().flatten().for_each(|output| uses[*output] += 1);
    for index in 0..plan.quantities.len() {
        if let Quantity::Negate(inner) = plan.quantities[index]
            && uses[inner] == 1
            && let Quantity::Product(product) = &mut plan.quantities[inner]
        {
            let product = std::mem::take(product);
            plan.quantities[index] = Quantity::Product(Product { negative: !product.negative, ..product });
        }
    }
}

/// The integer factors of a product, also those in pairs with others.
fn integers(plan: &LoweringPlan, product: &Product) -> Vec<usize> {
    let mut found = Vec::new();
    let mut waiting: Vec<usize> = product.factors.keys().copied().collect();
    while let Some(atom) = waiting.pop() {
        match plan.atoms[atom] {
            Atom::Scale(_) | Atom::Shrink(_) => found.push(atom),
            Atom::Pair(a, b) => waiting.extend([a, b]),
            _ => {}
        }
    }
    found
}
