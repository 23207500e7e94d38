//! Vector instructions, chosen at run time: one program for all processors of an architecture.
//!
//! The compiler makes vector operations of loops over [lanes](crate::number::Lanes), for the processors that the
//! program is built for: on x86-64 those with SSE2. Here a whole loop is compiled three times, and the widest version
//! that the processor can execute is called. Results have the same bits in all of them: operations are rounded as they
//! are written, as Rust never contracts a b + c.
//!
//! ```
//! use shadowstep::number::instructions::{self, Instructions};
//! use shadowstep::number::{Lanes, Number};
//!
//! fn sum_of_squares(x: &[Lanes<8>]) -> Lanes<8> {
//!     instructions::widest(#[inline(always)] || {
//!         let mut sum = Lanes::all(0.0);
//!         x.iter().for_each(|x| sum.add_product(x, x));
//!         sum
//!     })
//! }
//! let x = [Lanes::all(0.1); 100];
//! for instructions in Instructions::available() {
//!     assert_eq!(instructions.only(|| sum_of_squares(&x)), sum_of_squares(&x));
//! }
//! ```
//!
//! What is not inlined into the loop is compiled for the processors that the program is built for, and is slower there.
//! So functions on the way are `#[inline(always)]`: in this crate and from [`potential!`](crate::potential!) they are;
//! in a custom potential they should be.

use std::cell::Cell;

use crate::number::Number;

/// The vector instructions of a processor that loops are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instructions {
    /// Those that the whole program is built for.
    Plain,
    /// AVX2 and what processors with it have, of x86-64: 4 `f64` at once.
    Avx2,
    /// AVX-512 (F, CD, BW, DQ, VL) of x86-64: 8 `f64` at once.
    Avx512,
}

thread_local! {
    /// What [`widest`] means in this thread, once it is known: the widest available, or what [`Instructions::only`]
    /// allows.
    static CHOSEN: Cell<Option<Instructions>> = const { Cell::new(None) };
}

impl Instructions {
    /// Those that this processor has, the widest last.
    pub fn available() -> impl Iterator<Item = Instructions> {
        [Instructions::Plain, Instructions::Avx2, Instructions::Avx512].into_iter().filter(|i| i.are_available())
    }

    /// Does some work in which [`widest`] means these at most, in this thread: to compare.
    pub fn only<R>(self, work: impl FnOnce() -> R) -> R {
        struct Reset(Option<Instructions>);
        impl Drop for Reset {
            fn drop(&mut self) {
                CHOSEN.set(self.0);
            }
        }
        let allowed = Instructions::available().filter(|available| *available <= self).max();
        let _reset = Reset(CHOSEN.replace(allowed));
        work()
    }

    #[inline]
    fn chosen() -> Instructions {
        CHOSEN.get().unwrap_or_else(Instructions::choose)
    }

    #[cold]
    fn choose() -> Instructions {
        let widest = Instructions::available().max().expect("the plain ones are always available");
        CHOSEN.set(Some(widest));
        widest
    }

    fn are_available(self) -> bool {
        match self {
            Instructions::Plain => true,
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx512 => {
                Instructions::Avx2.are_available()
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512cd")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }
}

/// Does some work, such as a loop, in the widest instructions that this processor has.
///
/// The work is to be an `#[inline(always)]` closure. The choice costs a few nanoseconds.
#[inline(always)]
pub fn widest<R>(work: impl FnOnce() -> R) -> R {
    match Instructions::chosen() {
        Instructions::Plain => work(),
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx2 => x86::avx2(work),
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx512 => x86::avx512(work),
        #[cfg(not(target_arch = "x86_64"))]
        _ => work(),
    }
}

/// From this number of turns on the choice of instructions costs less than it gains.
const LONG: usize = 64;

/// [`widest`] for a long loop of `turns` turns, with numbers several of which fit into a vector; else the work as it
/// is.
#[inline(always)]
pub(crate) fn widest_if_long<R>(in_vectors: bool, turns: usize, work: impl FnOnce() -> R) -> R {
    if in_vectors && turns >= LONG { widest(work) } else { work() }
}

/// [`Number::in_widest_instructions`] for energies and β. Tangent maps compute neither: of dual numbers in lanes they
/// are compiled once only.
#[inline(always)]
pub(crate) fn widest_for_energies<N: Number, R>(work: impl FnOnce() -> R) -> R {
    if N::HAS_DERIVATIVES && N::LANES > 1 { work() } else { N::in_widest_instructions(work) }
}

/// to ← from, of the same length: whole vectors of a long state.
#[inline(always)]
pub(crate) fn copy<N: Number>(from: &[N], to: &mut [N]) {
    widest_if_long(
        N::IN_VECTORS,
        from.len(),
        #[inline(always)]
        || to.iter_mut().zip(from).for_each(|(to, from)| to.assign(from)),
    );
}

#[cfg(target_arch = "x86_64")]
#[expect(unsafe_code, reason = "a function for more instructions is called after the processor was found to have them")]
mod x86 {
    #[inline(always)]
    pub(super) fn avx512<R>(work: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "avx512f,avx512cd,avx512bw,avx512dq,avx512vl,avx2,fma")]
        fn compiled<R>(work: impl FnOnce() -> R) -> R {
            work()
        }
        // SAFETY: only available instructions are chosen
        unsafe { compiled(work) }
    }

    #[inline(always)]
    pub(super) fn avx2<R>(work: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "avx2,fma")]
        fn compiled<R>(work: impl FnOnce() -> R) -> R {
            work()
        }
        // SAFETY: only available instructions are chosen
        unsafe { compiled(work) }
    }
}
