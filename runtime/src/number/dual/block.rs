//! Blocks of dual numbers.

/// Dual numbers side by side: a block of their values, and a block of derivatives for each direction.
#[derive(Debug)]
pub struct DualBlock<B, const K: usize> {
    pub(super) values: B,
    pub(super) derivatives: [B; K],
}

impl<B: Clone, const K: usize> Clone for DualBlock<B, K> {
    #[inline(always)]
    fn clone(&self) -> Self {
        DualBlock { values: self.values.clone(), derivatives: self.derivatives.clone() }
    }
}
