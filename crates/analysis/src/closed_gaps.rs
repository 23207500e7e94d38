//! Closed intervals of instability: where a step of the harmonic oscillator turns by a multiple of π and its matrix is
//! ±1.
//!
//! There the trace touches ±2 and does not leave [−2, 2] if the entries beside the diagonal are both 0: two conditions,
//! and the hω is one more unknown. Schemes for sampling need it (Blanes, Casas and Sanz-Serna, SIAM J. Sci. Comput. 36
//! (2014) A1556).

use shadowstep_schemes::MapKind;
use shadowstep_schemes::arithmetic::Arithmetic;

/// The entries beside the diagonal of the matrix of a step, in q and p/ω, at hω = h.
pub(crate) fn beside_diagonal<A: Arithmetic>(
    maps: &[(MapKind, A::Value)],
    h: &A::Value,
    arithmetic: &A,
) -> [A::Value; 2] {
    let mut columns = [[arithmetic.one(), arithmetic.zero()], [arithmetic.zero(), arithmetic.one()]];
    let cube = arithmetic.product(&arithmetic.product(h, h), h);
    for (kind, weight) in maps {
        let (power, factor) = match kind {
            MapKind::Kick => (h, -1),
            MapKind::Drift => (h, 1),
            // U_qq M⁻¹U_q = q
            MapKind::GradientKick => (&cube, 2),
        };
        let moves = arithmetic.product(&arithmetic.product(weight, power), &arithmetic.integer(factor));
        for [q, p] in &mut columns {
            let (moved, by) = if *kind == MapKind::Drift { (q, p) } else { (p, q) };
            arithmetic.add_product(moved, &moves, by);
        }
    }
    let [[_, c], [b, _]] = columns;
    [b, c]
}
