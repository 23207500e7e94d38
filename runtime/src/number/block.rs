//! Numbers side by side, for loops that the compiler makes vector operations of.

/// How many numbers are in a [`Block`]: a vector of AVX-512, two of AVX2, four of SSE2.
pub const BLOCK: usize = 8;

/// [`BLOCK`] numbers side by side: of dual numbers all values, and beside them all derivatives of each direction, so
/// that a loop over the numbers is one of vector operations.
///
/// *Columns* are a list in this form in the memory of as many numbers: of dual numbers all values, then all first
/// derivatives, and so on.
pub trait Block<N>: Clone {
    /// The same number at all places.
    fn filled(x: &N) -> Self;

    /// The number at a place.
    fn at(&self, place: usize) -> N;

    /// The number at a place ← x
    fn set(&mut self, place: usize, x: &N);

    /// The block ← the numbers of columns from a place on
    fn read(&mut self, columns: &[N], first: usize);

    /// The numbers of columns from a place on ← those of the block
    fn write(&self, columns: &mut [N], first: usize);

    /// The number at a place of columns.
    fn one_of_columns(columns: &[N], place: usize) -> N;

    /// The number at a place of columns ← x
    fn write_one(columns: &mut [N], place: usize, x: &N);
}

impl<N: Clone> Block<N> for [N; BLOCK] {
    #[inline(always)]
    fn filled(x: &N) -> Self {
        std::array::from_fn(|_| x.clone())
    }

    #[inline(always)]
    fn at(&self, place: usize) -> N {
        self[place].clone()
    }

    #[inline(always)]
    fn set(&mut self, place: usize, x: &N) {
        self[place].clone_from(x);
    }

    #[inline(always)]
    fn read(&mut self, columns: &[N], first: usize) {
        let block: &[N; BLOCK] = columns[first..].first_chunk().expect(WITHIN);
        self.clone_from(block);
    }

    #[inline(always)]
    fn write(&self, columns: &mut [N], first: usize) {
        let block: &mut [N; BLOCK] = columns[first..].first_chunk_mut().expect(WITHIN);
        block.clone_from(self);
    }

    #[inline(always)]
    fn one_of_columns(columns: &[N], place: usize) -> N {
        columns[place].clone()
    }

    #[inline(always)]
    fn write_one(columns: &mut [N], place: usize, x: &N) {
        columns[place].clone_from(x);
    }
}

const WITHIN: &str = "the block is within the columns";
