//! The shipped scheme to use where a scheme holds its order for quadratic T only.

use shadowstep_schemes::{Kinetic, Proved, parse, shipped, shipped_names, shipped_proved};

use crate::analysis::Analysis;

/// The shipped scheme of least effective error that is meant for every T(p) and claims this order; or the nearest
/// higher order, or else the highest that there is. Processed schemes and those of multiple time steps are left out.
/// Only the schemes of one order are proved and analysed.
///
/// ```
/// use shadowstep_analysis::best_for_every_kinetic;
///
/// let best = best_for_every_kinetic(4).unwrap();
/// assert_eq!(best.proof.general.order, 4);
/// ```
pub fn best_for_every_kinetic(order: u32) -> Option<&'static Proved> {
    let claim = |name: &'static str| {
        let table = parse::table(&shipped(name)?).0?;
        (table.kinetic == Kinetic::Any && table.processor.is_none() && table.inner.is_none())
            .then_some((table.order.value, name))
    };
    let claims: Vec<_> = shipped_names().into_iter().filter_map(claim).collect();
    let orders = || claims.iter().map(|(order, _)| *order);
    let nearest = orders().filter(|higher| *higher >= order).min().or_else(|| orders().max());
    let candidates = claims.iter().filter(|(order, _)| Some(*order) == nearest);
    let schemes = candidates.filter_map(|(_, name)| shipped_proved(name));
    let error = |scheme: &Proved| Analysis::of(scheme).effective_error(Kinetic::Any);
    schemes.map(|scheme| (error(scheme), scheme)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, scheme)| scheme)
}
