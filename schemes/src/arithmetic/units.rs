//! Whole numbers in sign and magnitude, with products that drop low limbs: most of the time of a proof goes into them.

use num_bigint::{BigInt, Sign};

/// Products of this many limbs need no memory of their own.
const ON_STACK: usize = 64;

/// A whole number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Units {
    negative: bool,
    /// The magnitude in limbs of 64 bits, the lowest first; the last one is not 0.
    limbs: Vec<u64>,
}

impl From<&BigInt> for Units {
    fn from(value: &BigInt) -> Self {
        Units { negative: value.sign() == Sign::Minus, limbs: value.iter_u64_digits().collect() }
    }
}

impl From<&Units> for BigInt {
    fn from(value: &Units) -> Self {
        let halves: Vec<u32> = value.limbs.iter().flat_map(|limb| [*limb as u32, (limb >> 32) as u32]).collect();
        BigInt::from_slice(if value.negative { Sign::Minus } else { Sign::Plus }, &halves)
    }
}

impl Units {
    /// 2^(64 n)
    pub(super) fn power(n: usize) -> Self {
        let mut limbs = vec![0; n];
        limbs.push(1);
        Units { negative: false, limbs }
    }

    /// The number of bits of the magnitude.
    pub(super) fn bits(&self) -> u64 {
        let top = self.limbs.last().map_or(0, |limb| limb.leading_zeros());
        64 * self.limbs.len() as u64 - u64::from(top)
    }

    /// self += a b/2^(64 n), off by less than 1 + 2⁻⁵⁰.
    ///
    /// Products of limbs i and j with i + j < n − 2 are left out: fewer than n, each below 2^(64(n − 1)).
    pub(super) fn add_product(&mut self, a: &Units, b: &Units, n: usize) {
        if a.limbs.is_empty() || b.limbs.is_empty() || a.limbs.len() + b.limbs.len() <= n {
            return;
        }
        let first = n.saturating_sub(2);
        let length = a.limbs.len() + b.limbs.len() - first;
        let (mut on_stack, mut in_memory) = ([0; ON_STACK], Vec::new());
        let product = match on_stack.get_mut(..length) {
            Some(product) => product,
            None => {
                in_memory.resize(length, 0);
                &mut in_memory[..]
            }
        };
        // a power of two has limbs of zeros, which are passed over
        let (rows, columns) = if b.limbs[0] == 0 { (&b.limbs, &a.limbs) } else { (&a.limbs, &b.limbs) };
        for (pair, limbs) in rows.chunks(2).enumerate() {
            let left_out = first.saturating_sub(2 * pair);
            if left_out > columns.len() || limbs.iter().all(|limb| *limb == 0) {
                continue;
            }
            let (before, others) = columns.split_at(left_out);
            let sum = &mut product[(2 * pair).saturating_sub(first)..];
            match *limbs {
                [low, high] => add_multiples(sum, (before.last().copied().unwrap_or(0), others), [low, high]),
                _ => add_multiple(sum, others, limbs[0]),
            }
        }
        self.add(a.negative != b.negative, without_zeros(&product[n - first..]));
    }

    /// self/n towards 0
    pub(super) fn divided(&self, n: u32) -> Self {
        let (mut quotient, mut rest) = (self.clone(), 0);
        for limb in quotient.limbs.iter_mut().rev() {
            let dividend = u128::from(rest) << 64 | u128::from(*limb);
            *limb = (dividend / u128::from(n)) as u64;
            rest = (dividend % u128::from(n)) as u64;
        }
        quotient.normalise();
        quotient
    }

    /// Adds a number of this sign and magnitude, which does not end in 0.
    fn add(&mut self, negative: bool, limbs: &[u64]) {
        if negative == self.negative {
            self.limbs.resize(self.limbs.len().max(limbs.len()), 0);
            if add_to(&mut self.limbs, limbs) {
                self.limbs.push(1);
            }
        } else if is_at_least(&self.limbs, limbs) {
            subtract_from(&mut self.limbs, limbs);
        } else {
            let smaller = std::mem::replace(&mut self.limbs, limbs.to_vec());
            subtract_from(&mut self.limbs, &smaller);
            self.negative = negative;
        }
        self.normalise();
    }

    fn normalise(&mut self) {
        self.limbs.truncate(without_zeros(&self.limbs).len());
        self.negative &= !self.limbs.is_empty();
    }
}

/// The limbs up to the last one that is not 0.
fn without_zeros(limbs: &[u64]) -> &[u64] {
    &limbs[..limbs.iter().rposition(|limb| *limb != 0).map_or(0, |last| last + 1)]
}

/// sum += limb·others, for which there is room
fn add_multiple(sum: &mut [u64], others: &[u64], limb: u64) {
    let (low, high) = sum.split_at_mut(others.len());
    let mut carry = 0;
    for (own, other) in low.iter_mut().zip(others) {
        let value = u128::from(*own) + u128::from(limb) * u128::from(*other) + u128::from(carry);
        (*own, carry) = (value as u64, (value >> 64) as u64);
    }
    add_to(high, &[carry]);
}

/// sum += low·others + high·(2⁶⁴ others + before), for which there is room: two chains of carries at once take little
/// longer than one.
fn add_multiples(sum: &mut [u64], (before, others): (u64, &[u64]), [low, high]: [u64; 2]) {
    let (own, rest) = sum.split_at_mut(others.len());
    let (mut previous, mut low_carry, mut high_carry) = (before, 0, 0);
    for (own, other) in own.iter_mut().zip(others) {
        let value = u128::from(*own) + u128::from(low) * u128::from(*other) + u128::from(low_carry);
        low_carry = (value >> 64) as u64;
        let value = u128::from(value as u64) + u128::from(high) * u128::from(previous) + u128::from(high_carry);
        (*own, high_carry) = (value as u64, (value >> 64) as u64);
        previous = *other;
    }
    let value = u128::from(high) * u128::from(previous) + u128::from(low_carry) + u128::from(high_carry);
    add_to(rest, &[value as u64, (value >> 64) as u64]);
}

/// a += b, where a is not shorter; returns the carry.
fn add_to(a: &mut [u64], b: &[u64]) -> bool {
    let (low, high) = a.split_at_mut(b.len().min(a.len()));
    let mut carry = false;
    for (own, other) in low.iter_mut().zip(b) {
        (*own, carry) = own.carrying_add(*other, carry);
    }
    for own in high {
        if !carry {
            break;
        }
        (*own, carry) = own.overflowing_add(1);
    }
    carry
}

/// a −= b ≤ a
fn subtract_from(a: &mut [u64], b: &[u64]) {
    let (low, high) = a.split_at_mut(b.len());
    let mut borrow = false;
    for (own, other) in low.iter_mut().zip(b) {
        (*own, borrow) = own.borrowing_sub(*other, borrow);
    }
    for own in high {
        (*own, borrow) = own.overflowing_sub(u64::from(borrow));
    }
}

/// Whether a ≥ b, both without zeros at the end.
fn is_at_least(a: &[u64], b: &[u64]) -> bool {
    a.len().cmp(&b.len()).then_with(|| a.iter().rev().cmp(b.iter().rev())).is_ge()
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::{One, Signed};
    use proptest::prelude::*;

    fn number() -> impl Strategy<Value = BigInt> {
        // limbs of ones and zeros make carries
        let limb = prop_oneof![Just(0), Just(u64::MAX), Just(1), any::<u64>()];
        (any::<bool>(), prop::collection::vec(limb, 0..40)).prop_map(|(negative, limbs)| {
            let units = Units { negative, limbs: without_zeros(&limbs).to_vec() };
            BigInt::from(&units)
        })
    }

    proptest! {
        #[test]
        fn sums_of_products_are_off_by_less_than_a_unit(a in number(), b in number(), c in number(), n in 0_usize..30) {
            let mut sum = Units::from(&c);
            sum.add_product(&Units::from(&a), &Units::from(&b), n);
            prop_assert!(sum.limbs.last() != Some(&0) && (!sum.negative || !sum.limbs.is_empty()));
            // (c 2^(64 n) + a b − sum 2^(64 n)) 2^50 is less than (2^50 + 1) 2^(64 n)
            let off = ((&c - BigInt::from(&sum)) << (64 * n)) + &a * &b;
            let unit = BigInt::one() << (64 * n);
            prop_assert!(off.abs() << 50 < unit * ((BigInt::one() << 50) + 1));
        }

        #[test]
        fn numbers_are_those_of_big_integers(a in number(), n in 1_u32..) {
            let units = Units::from(&a);
            prop_assert_eq!(&BigInt::from(&units), &a);
            prop_assert_eq!(units.bits(), a.bits());
            prop_assert_eq!(BigInt::from(&units.divided(n)), a / n);
        }
    }
}
