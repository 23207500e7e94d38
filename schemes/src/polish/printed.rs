//! What holds of the table as printed: an order higher than claimed, or the order claimed for other kinetic energies.

use crate::Scheme;
use crate::polish::unknowns::Model;
use crate::proof::{Proof, prove};
use crate::scheme::Held;
use crate::table::{Kinetic, Table};

/// What is proved with the weights taken for as good as their decimals are long, whatever `digits` the table claims.
pub(super) fn proof(scheme: &Scheme, model: &Model) -> Proof {
    let lengths = || model.unknowns.iter().map(|unknown| unknown.digits);
    let most = lengths().max().unwrap_or(1);
    // those that are far shorter than others were chosen, and are no rounded numbers
    let fewest = lengths().filter(|digits| 2 * digits > most).min().unwrap_or(1);
    prove(&Scheme { held: scheme.held.weaker(Held::Digits(fewest)), ..scheme.clone() })
}

/// What to say if a higher order holds than is claimed, for then the decimals are solved for too few conditions.
pub(super) fn higher_order(table: &Table, proof: &Proof) -> Option<String> {
    let order = proof.for_kinetic(table.kinetic).order;
    let higher = order > table.order.value;
    higher.then(|| format!("order {order} holds as printed: claim it, and it will be polished too"))
}

/// What to say if the order claimed holds for quadratic T only.
pub(super) fn quadratic_only(table: &Table, proof: &Proof) -> Option<String> {
    let claimed = table.order.value;
    let for_quadratic = proof.general.order < claimed && proof.quadratic.order >= claimed;
    (table.kinetic == Kinetic::Any && for_quadratic)
        .then(|| format!("order {claimed} holds for quadratic T as printed: write `kinetic = \"quadratic\"`"))
}
