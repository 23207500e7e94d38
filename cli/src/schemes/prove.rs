//! `shadowstep schemes prove`: the proof of an order as a certificate.

use clap::Args;
use num_traits::Zero;
use serde_json::{Value, json};
use shadowstep_analysis::certificate::{Certificate, Class, Enclosure, Kind, Polynomial};
use shadowstep_scenes::{Error, library};
use shadowstep_schemes::symbolic::decimal::to_text;
use shadowstep_schemes::{Rational, to_significant};

use crate::output::{Output, OutputArguments};
use crate::report::{self, Status};

const EXAMPLES: &str = "\
Examples:
  shadowstep schemes prove yoshida4 > yoshida4.json
  python3 evidence/certificates/check.py yoshida4.json";

/// Writes the proof of the order as a certificate.
///
/// The order is the one for every T(p). The certificate is a JSON object (order, kind, roots, maps, bound), which
/// other programs can check.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// A shipped scheme, such as yoshida4, or the file of a table
    #[arg(value_name = "NAME|FILE")]
    name: String,
    /// The form of the certificate, which version 0.2 had two of
    #[arg(long = "to", hide = true, value_name = "FORM", value_parser = json_alone)]
    _to: Option<()>,
    #[command(flatten)]
    output: OutputArguments,
}

fn json_alone(form: &str) -> Result<(), &'static str> {
    if form == "json" { Ok(()) } else { Err("certificates are JSON; leave --to out") }
}

pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let scheme = library::scheme(&arguments.name)?.quadratic();
    let certificate = Certificate::of(scheme.proved()).ok_or_else(|| {
        let message = format!(
            "{} has gradient kicks or an inner scheme, whose conditions are not those of words in kicks and drifts",
            arguments.name
        );
        Error::usage(message, "certificates are of schemes of kicks and drifts")
    })?;
    if matches!((&certificate.kind, &certificate.enclosure), (Kind::Decimal(_), None)) {
        let message = "no exact scheme is enclosed near these decimals: the certificate has only how far the \
            conditions are off, which proves no order";
        report::note(message);
    }
    // what is refused writes no file
    let text = serde_json::to_string(&record(&scheme.proved().scheme.table.name.value, &certificate))?;
    Output::of(&arguments.output)?.text(text + "\n")?;
    Ok(Status::Success)
}

fn record(name: &str, certificate: &Certificate) -> Value {
    let (roots, bound) = match &certificate.kind {
        Kind::Exact => (&[][..], "0".to_owned()),
        Kind::Algebraic(roots) => (&roots[..], "0".to_owned()),
        Kind::Decimal(bound) => (&[][..], above(bound)),
    };
    let roots: Vec<_> = roots.iter().map(|root| json!({ "power": root.power, "of": terms(&root.of) })).collect();
    let maps: Vec<_> = certificate
        .maps
        .iter()
        .map(|(kind, weight)| json!({ "map": kind.to_string(), "weight": terms(weight) }))
        .collect();
    json!({
        "scheme": name,
        "order": certificate.order,
        "for": "every T(p)",
        "kind": kind(&certificate.kind),
        "bound": bound,
        "roots": roots,
        "maps": maps,
        "also": certificate.also.iter().map(|(class, bound)| also(class, bound)).collect::<Vec<_>>(),
        "enclosure": certificate.enclosure.as_ref().map(enclosure),
    })
}

/// Orders for a smaller class.
fn also(class: &Class, bound: &Rational) -> Value {
    let bound = if bound.is_zero() { "0".to_owned() } else { above(bound) };
    match class {
        Class::EveryKinetic(order) => json!({ "for": "every T(p)", "order": order, "bound": bound }),
        Class::Quadratic(order) => json!({ "for": "quadratic T", "order": order, "bound": bound }),
        Class::NearIntegrable { perturbation, orders } => {
            json!({ "for": "A + εB", "perturbation": perturbation.to_string(), "orders": orders, "bound": bound })
        }
    }
}

/// The box and the matrix, as decimals that are exact.
fn enclosure(enclosure: &Enclosure) -> Value {
    let inverse: Vec<Vec<_>> =
        enclosure.inverse.iter().map(|row| row.iter().map(|y| format!("{y:e}")).collect()).collect();
    json!({
        "of": enclosure.of.to_string(),
        "weights": enclosure.weights.iter().map(to_text).collect::<Vec<_>>(),
        "solved": enclosure.solved,
        "inverse": inverse,
        "radius": to_text(&enclosure.radius),
    })
}

/// The word for a kind of proof.
fn kind(kind: &Kind) -> &'static str {
    match kind {
        Kind::Exact => "exact",
        Kind::Algebraic(_) => "algebraic",
        Kind::Decimal(_) => "decimal",
    }
}

/// Coefficients with the exponents of the roots.
fn terms(polynomial: &Polynomial) -> Vec<(String, &Vec<u32>)> {
    polynomial.iter().map(|(exponents, value)| (to_text(value), exponents)).collect()
}

/// A short decimal that is not less.
fn above(bound: &Rational) -> String {
    to_significant(&(bound * Rational::new(101.into(), 100.into())), 3)
}
