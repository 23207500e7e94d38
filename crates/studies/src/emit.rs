//! A proved scheme → code of other ecosystems: `shadowstep emit`.
//!
//! What is emitted is one file: the weights, each rounded once to `f64`, so that the decimals read back to the same
//! bits; the step, unrolled, with as few evaluations of the gradient as the plan of the scheme has; lines of
//! provenance; and a self-test, which compares a run of Kepler's problem with the state that Shadowstep reaches and
//! measures the order.
//!
//! | module | what it is |
//! | --- | --- |
//! | `step` | the plan of a step → what is done one after the other, with names for the weights |
//! | `provenance` | where a file comes from: table, version, hash, proved orders, reference |
//! | `reference` | what the self-tests expect, computed by `shadowstep` |
//! | `language`, `template` | what every target fills its template with; the templates are in `templates` |
//! | `text` | comments, wrapped lines |
//! | `python`, `jax`, `julia`, `c`, `fortran` | a step, unrolled |
//! | `openmm` | a `CustomIntegrator` |
//! | `blackjax`, `mici` | coefficients for their integrators |
//! | `sundials`, `petsc` | a table of coefficients |
//! | `latex` | a table to print |
//!
//! ```
//! use shadowstep::tables::shipped;
//! use shadowstep_studies::emit::{Target, emit};
//!
//! let code = emit(&shipped("yoshida4").unwrap(), Target::C).unwrap();
//! assert!(code.contains("double *q"));
//! let refusal = emit(&shipped("chin-4a").unwrap(), Target::Sundials).unwrap_err();
//! assert!(refusal.to_string().starts_with("chin-4a has gradient kicks"));
//! ```

mod blackjax;
mod c;
mod fortran;
mod jax;
mod julia;
mod language;
mod latex;
mod mici;
mod openmm;
mod petsc;
mod provenance;
mod python;
mod reference;
mod step;
mod sundials;
mod template;
mod text;

use std::fmt;
use std::str::FromStr;

use shadowstep::tables::TableScheme;
use shadowstep_schemes::Proved;
use thiserror::Error;

use step::Step;

/// Makes the enum of all targets from one list `Variant: name, function`: the function writes a scheme.
macro_rules! targets {
    ($($(#[$doc:meta])* $Name:ident: $name:literal, $write:path;)+) => {
        /// What a scheme is emitted to.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Target {
            $($(#[$doc])* $Name,)+
        }

        impl Target {
            /// All targets.
            pub const ALL: &[Target] = &[$(Target::$Name),+];

            /// Its name on the command line.
            pub fn name(self) -> &'static str {
                match self { $(Target::$Name => $name,)+ }
            }

            fn write(self, step: &Step<'_>) -> String {
                match self { $(Target::$Name => $write(step),)+ }
            }
        }
    };
}

targets! {
    /// A module for NumPy.
    Python: "python", python::module;
    /// A module for JAX.
    Jax: "jax", jax::module;
    /// A header of C99.
    C: "c", c::header;
    /// A Julia module.
    Julia: "julia", julia::module;
    /// A module of Fortran 2008.
    Fortran: "fortran", fortran::module;
    /// A Python function that makes a `CustomIntegrator`.
    Openmm: "openmm", openmm::module;
    /// Coefficients for an integrator of BlackJAX.
    Blackjax: "blackjax", blackjax::module;
    /// Coefficients for an integrator of mici.
    Mici: "mici", mici::module;
    /// A header with an `ARKodeSPRKTable` for ARKODE's SPRKStep.
    Sundials: "sundials", sundials::header;
    /// A header that registers a scheme for `TSBASICSYMPLECTIC`.
    Petsc: "petsc", petsc::header;
    /// A table of the coefficients.
    Latex: "latex", latex::table;
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Target {
    type Err = UnknownTarget;

    fn from_str(name: &str) -> Result<Target, UnknownTarget> {
        let known = Target::ALL.iter().copied().find(|target| target.name() == name);
        known.ok_or_else(|| UnknownTarget { name: name.to_owned() })
    }
}

/// A name that is not one of a target.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no target `{name}`: there are \
    {}", Target::ALL.iter().map(|target| target.name()).collect::<Vec<_>>().join(", "))]
pub struct UnknownTarget {
    /// The name.
    pub name: String,
}

/// Why a target cannot express a scheme: displayed as one sentence, with what would be right.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{scheme} {reason}; {hint}")]
pub struct Refusal {
    /// The scheme's name.
    pub scheme: String,
    /// What follows the name: which feature of the scheme the target does not support.
    pub reason: String,
    /// What would be right.
    pub hint: String,
}

/// The targets that express every scheme for two parts.
const EVERY_SCHEME: &str = "emit it to python, jax, c, julia or fortran";

/// The longest name of a scheme with that of a Fortran module, of at most 63 letters: `shadowstep_scheme_NAME`.
const LONGEST_IN_FORTRAN: usize = 45;

/// Emits a scheme.
///
/// # Errors
/// A scheme that the target cannot express: gradient kicks, processors, steps that are not symmetric, an order that
/// holds for quadratic T only, three parts and more.
pub fn emit(scheme: &TableScheme, target: Target) -> Result<String, Refusal> {
    let proved = scheme.proved();
    if let Some((reason, hint)) = lacks(proved, target) {
        let scheme = proved.scheme.table.name.value.clone();
        return Err(Refusal { scheme, reason, hint: hint.to_owned() });
    }
    Ok(target.write(&Step::of(scheme)))
}

/// Which feature of a scheme a target does not support, and what would be right.
fn lacks(proved: &Proved, target: Target) -> Option<(String, &'static str)> {
    if proved.proof.many_parts.is_some() {
        return Some(("is made for H of three parts and more".to_owned(), "emit the scheme for two parts"));
    }
    if proved.scheme.inner.is_some() {
        let hint = "emit the scheme that its table calls the base";
        return Some(("has multiple time steps, for H of three parts".to_owned(), hint));
    }
    let name = &proved.scheme.table.name.value;
    if target == Target::Fortran && name.len() > LONGEST_IN_FORTRAN {
        let reason = format!("has a name of {} letters, and that of its module would be too long", name.len());
        return Some((reason, "give the scheme a name of at most 45 letters"));
    }
    let place = match target {
        Target::Openmm => "a CustomIntegrator of OpenMM",
        Target::Blackjax => "a list of coefficients of BlackJAX",
        Target::Mici => "a SymmetricCompositionIntegrator of mici",
        Target::Sundials => "a table of SPRKStep",
        Target::Petsc => "a scheme of TSBASICSYMPLECTIC",
        _ => return None,
    };
    let for_sampling = matches!(target, Target::Blackjax | Target::Mici);
    let quadratic = for_sampling || target == Target::Openmm;
    let reason = if proved.scheme.has_gradient_kicks() {
        format!("has gradient kicks, which {place} cannot make")
    } else if proved.scheme.processor.is_some() {
        format!("is a processed scheme, whose pre-map and post-map {place} does not have")
    } else if for_sampling && !proved.proof.symmetric {
        format!("is not symmetric, and {place} must be")
    } else if !quadratic && !proved.holds_for_every_kinetic() {
        format!("has order {} for quadratic T only, and {place} is for every T(p)", proved.order().order)
    } else {
        return None;
    };
    Some((reason, EVERY_SCHEME))
}
