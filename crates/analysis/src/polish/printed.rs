//! What holds of the table as printed: an order higher than claimed, or the order claimed for other kinetic energies;
//! and stages that are Störmer–Verlet steps.

use num_traits::{Signed, Zero};
use shadowstep_schemes::symbolic::Rational;

use crate::polish::unknowns::Model;
use shadowstep_schemes::ExactScheme;
use shadowstep_schemes::MapKind;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::map::Map;
use shadowstep_schemes::proof::{Proof, prove};
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::table::Table;

/// What is proved if all digits of the decimals are trusted, whatever `digits` the table claims.
pub(super) fn proof(scheme: &ExactScheme, model: &Model) -> Proof {
    let lengths = || model.unknowns.iter().map(|unknown| unknown.decimal.significant);
    let most = lengths().max().unwrap_or(1);
    // those that are far shorter than others were chosen, and are not rounded
    let fewest = lengths().filter(|digits| 2 * digits > most).min().unwrap_or(1);
    prove(&ExactScheme { held: scheme.held.weaker(Held::Digits(fewest)), ..scheme.clone() })
}

/// Notes on orders that hold and are higher than claimed: the decimals are then solved for too few conditions.
pub(super) fn higher_orders(table: &Table, proof: &Proof) -> Vec<String> {
    let say = |order: u32, terms: &str| {
        format!("order {order} holds{terms} as printed: claim it, and it will be polished too")
    };
    let order = proof.for_kinetic(table.kinetic).order;
    let mut higher = Vec::from_iter((order > table.order.value).then(|| say(order, "")));
    // a term may be claimed to no higher order than the terms of lower powers of ε
    let mut least = u32::MAX;
    let claims = table.near_integrable.iter().flat_map(|claim| claim.powers());
    for ((claimed, power), order) in claims.zip(&proof.near_integrable) {
        least = least.min(order.order);
        if least > claimed.value {
            higher.push(say(least, &format!(" for the terms of {}", power)));
        }
    }
    higher
}

/// The hint where the order claimed holds for quadratic T only.
pub(super) fn quadratic_only(table: &Table, proof: &Proof) -> Option<String> {
    let claimed = table.order.value;
    let for_quadratic = proof.general.order < claimed && proof.quadratic.order >= claimed;
    (table.kinetic == Kinetic::Any && for_quadratic)
        .then(|| format!("order {claimed} holds for quadratic T as printed: write `kinetic = \"quadratic\"`"))
}

/// The hint where the stages are Störmer–Verlet steps γ_1 h, γ_2 h, …: kicks γ_1/2, (γ_1 + γ_2)/2, …, γ_n/2 and drifts
/// γ_s, or the same with kick and drift exchanged. As stages they must meet far more conditions than there are γ's, and
/// these may be singular.
pub(super) fn verlet_steps(scheme: &ExactScheme, model: &Model) -> Option<String> {
    let maps = scheme.maps();
    let gamma: Vec<_> = maps.iter().skip(1).step_by(2).map(|map| &map.weight).collect();
    if model.base.is_some() || gamma.len() < 2 || maps.len() != 2 * gamma.len() + 1 {
        return None;
    }
    // 2a − γ − γ′ of rounded decimals is off by two units at most
    let close = model.unknowns.iter().map(|unknown| unknown.decimal.unit()).max()? * Rational::from_integer(2.into());
    let zero = Rational::zero();
    let is_half_of_neighbours = |(i, map): (usize, &Map)| {
        let [before, after] = [i.checked_sub(1), Some(i)].map(|s| s.and_then(|s| gamma.get(s)).map_or(&zero, |g| g));
        (&map.weight * Rational::from_integer(2.into()) - before - after).abs() <= close
    };
    let gamma_are = match maps[1].kind {
        MapKind::Drift => "drifts",
        MapKind::Kick => "kicks",
        MapKind::GradientKick => return None,
    };
    maps.iter().step_by(2).enumerate().all(is_half_of_neighbours).then(|| {
        format!(
            "these are Störmer–Verlet steps: write them as [composition] with base = \"stormer-verlet\" and gamma = the \
             {gamma_are}"
        )
    })
}
