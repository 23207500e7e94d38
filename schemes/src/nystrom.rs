//! Order conditions for quadratic T: bicoloured rooted trees in which a drift has at most one child.
//!
//! With T = ½pᵀM⁻¹p + bᵀp + c the elementary differentials of a splitting are the trees whose nodes alternate between
//! kicks and drifts, and whose drifts, being affine in p, carry at most one kick (Runge–Kutta–Nyström trees: Hairer,
//! Lubich & Wanner, *Geometric Numerical Integration*, III.2; Calvo & Sanz-Serna 1993). A tree's value is the sum, over
//! all ways to place its nodes at maps of the step so that each child acts before its parent, of the product of the
//! weights; the exact flow has 1/γ(t), γ(t) the product of the sizes of all subtrees.
//!
//! Dropping the words that have more kicks than drifts + 1 would not do: the Lie brackets which vanish generate an
//! ideal, and from five letters on its members lie among words that stay. The trees are the functionals that do not
//! see that ideal. Some of them are redundant for a symplectic scheme; that costs time, not truth.
//!
//! A gradient kick p += 2c U_qq M⁻¹U_q is, with K = −U_q, 2c times the derivative of K in the direction of `D[K]`, at
//! the q that it finds: a tree K[…] may be placed at it whole with one of its children D[K[…]], to which 2c belongs.

use crate::symbolic::Rational;

use crate::arithmetic::Arithmetic;
use crate::map_kind::MapKind;
use crate::order::{Condition, Functional};

/// A tree whose root is a kick: its children are drifts, each given by the kick below it.
struct KickTree {
    /// For each child the index of the kick tree on that drift, or `None` for a bare drift; sorted.
    children: Vec<Option<usize>>,
    size: u32,
    /// γ(t)
    density: u64,
}

/// The same for maps whose weights are values already.
pub fn tree_conditions<A: Arithmetic>(
    maps: &[(MapKind, A::Value)],
    order: u32,
    arithmetic: &A,
) -> Vec<(Condition, A::Value)> {
    let trees = kick_trees(order);
    let bare = vec![arithmetic.one(); maps.len()];
    let (bare_before, bare_value) = sums(MapKind::Drift, &bare, maps, arithmetic);
    let mut conditions = vec![(condition("D", 1, 1), bare_value)];

    let mut before: Vec<Vec<A::Value>> = Vec::new();
    let has_gradient_kicks = maps.iter().any(|(kind, _)| *kind == MapKind::GradientKick);
    // of each tree the products over the children of its root, which only gradient kicks need
    let mut at_roots: Vec<Vec<A::Value>> = Vec::new();
    for (i, tree) in trees.iter().enumerate() {
        let mut at_kicks = product_of_children(tree, &bare_before, &before, maps, arithmetic);
        if has_gradient_kicks {
            at_roots.push(at_kicks.clone());
            for r in (0..maps.len()).filter(|&r| maps[r].0 == MapKind::GradientKick) {
                at_kicks[r] = with_one_child_inside(tree, r, (&bare_before, &before), &at_roots, arithmetic);
            }
        }
        let (kicked_before, value) = sums(MapKind::Kick, &at_kicks, maps, arithmetic);
        let name = name(&trees, i);
        conditions.push((condition(&name, tree.size, tree.density), value));
        if tree.size < order {
            let (drifted_before, value) = sums(MapKind::Drift, &kicked_before, maps, arithmetic);
            let size = tree.size + 1;
            conditions.push((condition(&format!("D[{name}]"), size, tree.density * u64::from(size)), value));
            before.push(drifted_before);
        }
    }
    conditions.sort_by_key(|(condition, _)| condition.order);
    conditions
}

fn condition(name: &str, size: u32, density: u64) -> Condition {
    Condition {
        order: size,
        functional: Functional::Named(format!("the tree {name}")),
        needed: Rational::new(1.into(), density.into()),
    }
}

/// What a gradient kick r adds to a tree, but for c: twice the sum over the children D[K[…]] at the same map, each with
/// the product of its own children and the others.
fn with_one_child_inside<A: Arithmetic>(
    tree: &KickTree,
    r: usize,
    (bare, before): (&[A::Value], &[Vec<A::Value>]),
    at_roots: &[Vec<A::Value>],
    arithmetic: &A,
) -> A::Value {
    let mut sum = arithmetic.zero();
    for (i, inside) in tree.children.iter().enumerate() {
        let Some(inside) = inside else { continue };
        let others = tree.children.iter().enumerate().filter(|(j, _)| *j != i);
        let product = others.fold(at_roots[*inside][r].clone(), |product, (_, child)| {
            arithmetic.product(&product, &child.map_or(bare, |kick| &before[kick])[r])
        });
        arithmetic.add_product(&mut sum, &arithmetic.one(), &product);
    }
    arithmetic.product(&sum, &arithmetic.integer(2))
}

/// Σ w_r·v_r over the maps r of one kind before each map of the other kind, and over all of them; kicks include
/// gradient kicks.
fn sums<A: Arithmetic>(
    kind: MapKind,
    values: &[A::Value],
    maps: &[(MapKind, A::Value)],
    arithmetic: &A,
) -> (Vec<A::Value>, A::Value) {
    let mut sum = arithmetic.zero();
    let before = maps
        .iter()
        .zip(values)
        .map(|((map, weight), value)| {
            if (*map == MapKind::Drift) == (kind == MapKind::Drift) {
                arithmetic.add_product(&mut sum, weight, value);
                return arithmetic.zero();
            }
            sum.clone()
        })
        .collect();
    (before, sum)
}

fn product_of_children<A: Arithmetic>(
    tree: &KickTree,
    bare: &[A::Value],
    before: &[Vec<A::Value>],
    maps: &[(MapKind, A::Value)],
    arithmetic: &A,
) -> Vec<A::Value> {
    let mut factors = tree.children.iter().map(|child| child.map_or(bare, |kick| &before[kick]));
    let mut product = factors.next().map_or_else(|| vec![arithmetic.one(); maps.len()], <[A::Value]>::to_vec);
    for factor in factors {
        for r in (0..maps.len()).filter(|&r| maps[r].0 != MapKind::Drift) {
            product[r] = arithmetic.product(&product[r], &factor[r]);
        }
    }
    product
}

/// All trees with a kick as root and at most `largest` nodes, smaller ones first.
fn kick_trees(largest: u32) -> Vec<KickTree> {
    let mut trees: Vec<KickTree> = Vec::new();
    for size in 1..=largest {
        let mut forests = Vec::new();
        grow(&trees, size - 1, None, &mut Vec::new(), &mut forests);
        for children in forests {
            let below: u64 = children.iter().map(|c| drift_density(&trees, *c)).product();
            trees.push(KickTree { children, size, density: below * u64::from(size) });
        }
    }
    trees
}

/// Completes `forest` with children not before `least` to `room` more nodes, in all ways.
fn grow(
    trees: &[KickTree],
    room: u32,
    least: Option<usize>,
    forest: &mut Vec<Option<usize>>,
    found: &mut Vec<Vec<Option<usize>>>,
) {
    if room == 0 {
        found.push(forest.clone());
        return;
    }
    let kicks = (least.unwrap_or(0)..trees.len()).map(Some);
    for child in (least.is_none().then_some(None)).into_iter().chain(kicks) {
        let size = drift_size(trees, child);
        if size <= room {
            forest.push(child);
            grow(trees, room - size, child, forest, found);
            forest.pop();
        }
    }
}

fn drift_size(trees: &[KickTree], child: Option<usize>) -> u32 {
    child.map_or(1, |kick| trees[kick].size + 1)
}

fn drift_density(trees: &[KickTree], child: Option<usize>) -> u64 {
    child.map_or(1, |kick| trees[kick].density * u64::from(trees[kick].size + 1))
}

fn name(trees: &[KickTree], index: usize) -> String {
    let child = |child: &Option<usize>| child.map_or("D".to_owned(), |kick| format!("D[{}]", name(trees, kick)));
    let children: Vec<_> = trees[index].children.iter().map(child).collect();
    if children.is_empty() { "K".to_owned() } else { format!("K[{}]", children.join(" ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_are_as_many_as_the_literature_counts() {
        let trees = kick_trees(10);
        let count = |n| trees.iter().filter(|t| t.size == n).count();
        // special Nyström trees: Hairer, Nørsett & Wanner, Solving ODEs I, II.14
        assert_eq!((1..=10).map(count).collect::<Vec<_>>(), [1, 1, 2, 3, 6, 10, 20, 36, 72, 137]);
    }

    #[test]
    fn small_trees_are_the_sums_that_they_stand_for() {
        use crate::arithmetic::ExactArithmetic;
        use num_traits::Zero;
        let rational = |n: i64, d: i64| Rational::new(n.into(), d.into());
        let a = [rational(1, 3), rational(-2, 5), rational(7, 11), rational(3, 2)];
        let b = [rational(5, 7), rational(1, 9), rational(-3, 4), rational(2, 13)];
        let stages = crate::map::Stages { kick: a.to_vec(), gradient_kick: Vec::new(), drift: b.to_vec() };
        let maps = crate::order::weighed(&stages.maps(), &ExactArithmetic);
        let values = tree_conditions(&maps, 4, &ExactArithmetic);
        let value = |name: &str| {
            &values.iter().find(|(c, _)| c.functional == Functional::Named(format!("the tree {name}"))).unwrap().1
        };

        // c_s: where the kick s acts; f_r: how far the kicks have got before the drift r
        let c: Vec<Rational> = (0..4).map(|s| b[..s].iter().sum()).collect();
        let f: Vec<Rational> = (0..4).map(|r| a[..=r].iter().sum()).collect();
        let sum = |term: &dyn Fn(usize) -> Rational| (0..4).fold(Rational::zero(), |sum, s| sum + term(s));
        assert_eq!(*value("K[D]"), sum(&|s| &a[s] * &c[s]));
        assert_eq!(*value("K[D D]"), sum(&|s| &a[s] * &c[s] * &c[s]));
        assert_eq!(*value("D[K]"), sum(&|r| &b[r] * &f[r]));
        assert_eq!(*value("K[D[K]]"), sum(&|s| &a[s] * (0..s).map(|r| &b[r] * &f[r]).sum::<Rational>()));
        assert_eq!(*value("K[D D D]"), sum(&|s| &a[s] * &c[s] * &c[s] * &c[s]));
    }
}
