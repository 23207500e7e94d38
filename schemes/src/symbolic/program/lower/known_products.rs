//! Sums with products that have a place of their own.
//!
//! A product that only one sum needs is added to it by one operation, `add_product`. One that has a place, as another
//! result needs it too or the sum is computed there, is rounded before it is added. The number types that fuse products
//! with sums can do so here as well, if the operation has the factors beside the product.

use std::collections::HashMap;

use crate::symbolic::program::instruction::{Instruction, Place};

/// Gives sums and differences with a product its factors, where these are unchanged.
pub(super) fn with_factors(instructions: Vec<Instruction>) -> Vec<Instruction> {
    let mut products = HashMap::new();
    instructions.into_iter().map(|instruction| with_known(instruction, &mut products)).collect()
}

/// The factors of the product at each place that holds one.
type Products = HashMap<Place, (Place, Place)>;

fn with_known(instruction: Instruction, products: &mut Products) -> Instruction {
    let changed = replaced(&instruction, products).unwrap_or(instruction);
    let targets = changed.targets();
    products.retain(|product, (a, b)| !targets.iter().any(|target| [&*product, a, b].contains(&target)));
    match changed {
        Instruction::AssignProduct(x, a, b) => products.insert(x, (a, b)),
        Instruction::AssignSquare(x, a) => products.insert(x, (a, a)),
        _ => None,
    };
    changed
}

/// The same operation with the factors of its first product.
fn replaced(instruction: &Instruction, products: &Products) -> Option<Instruction> {
    use Instruction as I;
    let factors =
        |product: Place, target: Place| products.get(&product).copied().filter(|(a, b)| ![*a, *b].contains(&target));
    match *instruction {
        I::AssignSum(x, c, product) if factors(product, x).is_some() => {
            factors(product, x).map(|(a, b)| I::AssignSumWithProduct(x, c, product, a, b))
        }
        I::AssignSum(x, product, c) => factors(product, x).map(|(a, b)| I::AssignSumWithProduct(x, c, product, a, b)),
        I::AssignDifference(x, c, product) => {
            factors(product, x).map(|(a, b)| I::AssignDifferenceWithProduct(x, c, product, a, b))
        }
        I::Add(x, c) => products.get(&x).map(|(a, b)| I::AddToProduct(x, c, *a, *b)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Place = Place::Coordinate(0);
    const Y: Place = Place::Coordinate(1);
    const S: Place = Place::Scratch(0);
    const T: Place = Place::Scratch(1);

    fn changed(instructions: &[Instruction]) -> Vec<String> {
        with_factors(instructions.to_vec()).iter().map(Instruction::to_string).collect()
    }

    #[test]
    fn sums_get_the_factors_of_their_products() {
        use Instruction as I;
        assert_eq!(
            changed(&[I::AssignProduct(S, X, Y), I::AssignSum(T, S, X), I::Add(S, Y)]),
            [
                "s0.assign_product(q0, q1)",
                "s1.assign_sum_with_product(q0, s0, q0, q1)",
                "s0.add_to_product(q1, q0, q1)"
            ]
        );
        assert_eq!(
            changed(&[I::AssignSquare(S, X), I::AssignDifference(T, Y, S)])[1],
            "s1.assign_difference_with_product(q1, s0, q0, q0)"
        );
    }

    #[test]
    fn factors_that_have_changed_are_not_used() {
        use Instruction as I;
        let unchanged = |instructions: &[Instruction]| {
            assert_eq!(changed(instructions), instructions.iter().map(Instruction::to_string).collect::<Vec<_>>());
        };
        unchanged(&[I::AssignProduct(S, T, Y), I::Negate(T), I::Add(S, Y)]);
        unchanged(&[I::AssignProduct(S, T, Y), I::AssignSum(T, S, X)]);
        unchanged(&[I::AssignProduct(S, X, Y), I::Multiply(S, X), I::Add(S, Y)]);
    }
}
