//! What a sum computes of W pairs at once, between the positions and the forces.

use shadowstep_schemes::symbolic::Separation;

use crate::number::Number;

/// What u is a function of, from the differences q_j − q_i by axes.
#[inline(always)]
pub(super) fn separations<N: Number, const D: usize, const W: usize>(
    differences: &[[N; W]; D],
    separation: Separation,
) -> [N; W] {
    let mut x = differences[0].clone();
    if separation == Separation::SquaredDistance {
        for l in 0..W {
            x[l].assign_square(&differences[0][l]);
        }
        for of_axis in &differences[1..] {
            for l in 0..W {
                x[l].add_product(&of_axis[l], &of_axis[l]);
            }
        }
    }
    x
}

/// The differences become the forces of pairs with these slopes.
#[inline(always)]
pub(super) fn make_forces<N: Number, const D: usize, const W: usize>(
    differences: &mut [[N; W]; D],
    slopes: &[N; W],
    separation: Separation,
) {
    for of_axis in differences {
        for l in 0..W {
            match separation {
                Separation::Difference => of_axis[l].assign(&slopes[l]),
                Separation::SquaredDistance => of_axis[l].multiply(&slopes[l]),
            }
        }
    }
}
