//! How dual numbers are in blocks and columns.

use super::{Dual, DualBlock};
use crate::number::{Block, Number};

impl<N: Number, const K: usize> Block<Dual<N, K>> for DualBlock<N::Block, K> {
    #[inline(always)]
    fn filled(x: &Dual<N, K>) -> Self {
        let derivatives = x.derivatives.each_ref().map(N::Block::filled);
        DualBlock { values: N::Block::filled(&x.value), derivatives }
    }

    #[inline(always)]
    fn at(&self, place: usize) -> Dual<N, K> {
        let value = self.values.at(place);
        Dual { derivatives: std::array::from_fn(|k| self.derivatives[k].at(place)), value }
    }

    #[inline(always)]
    fn set(&mut self, place: usize, x: &Dual<N, K>) {
        self.values.set(place, &x.value);
        for k in 0..K {
            self.derivatives[k].set(place, &x.derivatives[k]);
        }
    }

    #[inline(always)]
    fn read(&mut self, columns: &[Dual<N, K>], first: usize) {
        self.values.read(column(columns, 0), first);
        for k in 0..K {
            self.derivatives[k].read(column(columns, k + 1), first);
        }
    }

    #[inline(always)]
    fn write(&self, columns: &mut [Dual<N, K>], first: usize) {
        self.values.write(column_mut(columns, 0), first);
        for k in 0..K {
            self.derivatives[k].write(column_mut(columns, k + 1), first);
        }
    }

    #[inline(always)]
    fn one_of_columns(columns: &[Dual<N, K>], place: usize) -> Dual<N, K> {
        let value = N::Block::one_of_columns(column(columns, 0), place);
        Dual { derivatives: std::array::from_fn(|k| N::Block::one_of_columns(column(columns, k + 1), place)), value }
    }

    #[inline(always)]
    fn write_one(columns: &mut [Dual<N, K>], place: usize, x: &Dual<N, K>) {
        N::Block::write_one(column_mut(columns, 0), place, &x.value);
        for k in 0..K {
            N::Block::write_one(column_mut(columns, k + 1), place, &x.derivatives[k]);
        }
    }
}

/// The values in columns, k = 0, or their derivatives in the direction k.
#[inline(always)]
#[expect(unsafe_code, reason = "the memory of dual numbers is that of their parts")]
fn column<N, const K: usize>(columns: &[Dual<N, K>], k: usize) -> &[N] {
    let length = columns.len();
    assert!(k <= K, "there are K derivatives");
    // SAFETY: a `Dual` is `repr(C)`, K + 1 of N and nothing else, so that these are initialised numbers in the same
    // memory
    unsafe { std::slice::from_raw_parts(columns.as_ptr().cast::<N>().add(k * length), length) }
}

#[inline(always)]
#[expect(unsafe_code, reason = "the memory of dual numbers is that of their parts")]
fn column_mut<N, const K: usize>(columns: &mut [Dual<N, K>], k: usize) -> &mut [N] {
    let length = columns.len();
    assert!(k <= K, "there are K derivatives");
    // SAFETY: as above, and it is borrowed as long
    unsafe { std::slice::from_raw_parts_mut(columns.as_mut_ptr().cast::<N>().add(k * length), length) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::BLOCK;

    /// Of derivatives of derivatives, too.
    #[test]
    fn columns_have_the_numbers_that_were_written() {
        type Second = Dual<Dual<f64, 2>, 3>;
        let number = |i: usize| {
            let part = |k: usize| (100 * i + 10 * k) as f64;
            let inner = |k: usize| Dual::new(part(k), [part(k) + 1.0, part(k) + 2.0]);
            Dual::new(inner(0), [1, 2, 3].map(inner))
        };
        let parts = |x: &Second| -> Vec<f64> {
            let inner = std::iter::once(&x.value).chain(&x.derivatives);
            inner.flat_map(|x| std::iter::once(x.value).chain(x.derivatives)).collect()
        };
        let mut columns = vec![Second::zero(&()); 11];
        (0..11).for_each(|i| <Second as Number>::Block::write_one(&mut columns, i, &number(i)));
        // the first column is of values
        let first = columns.first().map(parts).unwrap();
        assert_eq!(first[..4], [0.0, 100.0, 200.0, 300.0]);
        let mut block = <Second as Number>::Block::filled(&Second::zero(&()));
        block.read(&columns, 2);
        (0..BLOCK).for_each(|l| assert_eq!(parts(&block.at(l)), parts(&number(l + 2))));
        block.set(3, &number(77));
        block.write(&mut columns, 1);
        let expected = [0, 2, 3, 4, 77, 6, 7, 8, 9, 9, 10];
        for (i, expected) in expected.into_iter().enumerate() {
            let found: Second = <Second as Number>::Block::one_of_columns(&columns, i);
            assert_eq!(parts(&found), parts(&number(expected)), "{i}");
        }
    }
}
