//! `#[splitting_scheme("yoshida4.toml")]`: a table of exact weights becomes straight-line steps.
//!
//! `potential!{…}`: a formula becomes a potential with its gradient; `kinetic!{…}`: a kinetic energy with its drifts.
//!
//! The macros are a thin shell: `locate` finds the table, the `shadowstep-schemes` crate proves it, `emit` writes the
//! code; `formula` turns tokens to text, the module `symbolic` of that crate derives it, `potential`, `pair` and
//! `kinetic` write the code with the bodies of methods from `methods`.
//!
//! Use them through the `shadowstep` crate, which re-exports them.

mod arguments;
mod definition;
mod emit;
mod formula;
mod kinetic;
mod locate;
mod methods;
mod pair;
mod potential;
mod program;

use proc_macro::TokenStream;
use shadowstep_schemes::{Proved, read_first};
use syn::parse_macro_input;

use arguments::{Arguments, UnitStruct};
use definition::Definition;
use locate::Locator;

/// Gives a unit struct the steps of the splitting scheme in a table.
///
/// ```
/// use shadowstep::{Scheme, splitting_scheme};
///
/// #[splitting_scheme("yoshida4.toml")]
/// pub struct Yoshida4;
///
/// #[splitting_scheme("yoshida4.toml", first = "drift")]
/// pub struct DriftFirst;
///
/// assert_eq!(Yoshida4.summary().order, 4);
/// assert_eq!(DriftFirst.summary().evaluations, 3);
/// ```
///
/// With `parts = 3` the steps are for H = H_1 + … + H_n of three parts and more, whatever their number
/// (`shadowstep::systems::many_parts`). A table with an inner scheme needs it: its steps are for slow forces, fast
/// forces and T.
///
/// The table is looked for beside the source file, then in the crate's root, then among the shipped ones. Its claims
/// are proved; a claim that does not hold is a compile error that names the condition which fails. The struct gets
/// `shadowstep::Scheme`: `step`, `step_augmented` (carries β), `step_back` and `step_back_augmented`, written out map
/// by map, and documentation with orders, cost and source. `schemes/tables/README.md` describes the keys of a table.
///
/// # What is generated
///
/// Of `stormer-verlet.toml`, besides its properties, its exact weights and the sequence of its maps:
///
/// ```ignore
/// /// Störmer–Verlet (leapfrog, Strang; kick first: velocity Verlet): `stormer-verlet`, meant for every kinetic energy T(p).
/// ///
/// /// - Order 2 (exactly) for every T(p), order 2 (exactly) for quadratic T: proved.
/// /// - 2 stages: 2 kicks and 1 drift, symmetric.
/// /// - A step costs 1 gradient (the gradient of the last kick serves the next step), …
/// pub struct StormerVerlet;
///
/// impl Scheme for StormerVerlet {
///     type Weights<N: Number> = Weights<[N; 1], [N; 1], [N; 0], [N; 0]>;
///
///     fn forward<F: Flows>(&self, weights: &Self::Weights<F::Number>, flows: &mut F) {
///         let Weights { kicks: [kick_1], drifts: [drift_1], .. } = weights;
///         flows.kick(kick_1);
///         flows.drift(drift_1);
///         flows.kick(kick_1);
///     }
///
///     // the scheme is symmetric: steps back are steps with the weights of −h
///     fn back<F: Flows>(&self, weights: &Self::Weights<F::Number>, flows: &mut F) {
///         self.forward(weights, flows);
///     }
/// }
///
/// impl ValidFor<Quadratic> for StormerVerlet {}
/// impl ValidFor<General> for StormerVerlet {}
/// ```
///
/// `Flows` is what the maps of a step act on: a system alone, or with what a step carries along, such as increments and
/// β.
#[proc_macro_attribute]
pub fn splitting_scheme(arguments: TokenStream, item: TokenStream) -> TokenStream {
    let arguments = parse_macro_input!(arguments as Arguments);
    let item = parse_macro_input!(item as UnitStruct).0;
    let here = arguments.table.span().unwrap().local_file();
    let locator = Locator::new(here.as_deref(), std::env::var_os("CARGO_MANIFEST_DIR").as_deref());
    let code = match prove(&arguments, &locator) {
        Ok(proved) => emit::scheme(&item, &proved, &locator.files()),
        Err(message) => emit::refused(&item, &arguments.table, &message, &locator.files()),
    };
    code.into()
}

fn prove(arguments: &Arguments, locator: &Locator) -> Result<Proved, String> {
    let source = locator.find(&arguments.table.value())?;
    let library = |name: &str, from: &_| locator.base(name, from);
    let proved = read_first(&source, &library, arguments.first).map_err(|faults| faults.to_string())?;
    match (&proved.scheme.inner, arguments.parts) {
        (None, 2) => Ok(proved),
        (None, _) | (Some(_), 3) => proved.for_many_parts().map_err(|refused| refused.to_string()),
        (Some(_), count) => {
            let name = &proved.scheme.table.name.value;
            Err(format!("{name} has an inner scheme, whose steps are for three parts, not {count}: write `parts = 3`"))
        }
    }
}

/// A potential from its formula: the gradient and qᵀU_q − 2U are derived, for every type of numbers.
///
/// ```
/// use shadowstep::{Motion, UnitMasses, potential};
///
/// potential! {
///     /// A Gaussian well.
///     pub struct Well { depth, width }
///     U(x, y) = -depth * exp(-(x^2 + y^2) / width^2)
/// }
///
/// let well = Well { depth: 2.0, width: 0.5 };
/// let mut motion = Motion::new(well, UnitMasses, [0.0, 0.0], [1.0, 0.0]).unwrap();
/// assert_eq!(motion.energy(), 0.5 - 2.0);
/// ```
///
/// Formulas have numbers (exact), `pi`, coordinates, parameters, `+ - * / ^` with rational exponents, and the functions
/// sqrt, cbrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan, asin, acos. The struct gets `shadowstep::Potential`,
/// with the cost of a call in its documentation; what depends on parameters only is computed once.
///
/// A `pair` formula is the energy of two bodies i < j, in r2, the square of their distance, or on a line in d = q_j −
/// q_i; properties of bodies such as masses are called `m_i` and `m_j`, and the struct has the values of all bodies as
/// `m`. `shadowstep::systems::pairs::Pairs` sums it over all pairs, or over the neighbours in a chain.
///
/// ```
/// use shadowstep::{Motion, UnitMasses, systems::pairs::{Ends, Pairs}, potential};
///
/// potential! {
///     /// Toda's spring.
///     pub struct Toda;
///     pair U(d) = exp(-d) + d - 1
/// }
///
/// let ring = Pairs::<_, 1>::neighbours(3, Toda, Ends::Periodic).unwrap();
/// let mut motion = Motion::new(ring, UnitMasses, [0.0; 3], [1.0, -1.0, 2.0]).unwrap();
/// assert_eq!(motion.energy(), 3.0);
/// ```
#[proc_macro]
pub fn potential(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as Definition);
    potential::emit(&input).unwrap_or_else(syn::Error::into_compile_error).into()
}

/// A kinetic energy T(p) from its formula: T_p and pᵀT_p − 2T are derived, for every type of numbers.
///
/// ```
/// use shadowstep::{Motion, Stepper, kinetic, potential, splitting_scheme};
///
/// kinetic! {
///     /// With the speed of light c and mass 1.
///     pub struct Relativistic { c }
///     T(p) = sqrt(c^4 + c^2*p^2)
/// }
///
/// potential! { pub struct Spring; U(q) = q^2/2 }
///
/// #[splitting_scheme("yoshida4.toml")]
/// pub struct Yoshida4;
///
/// let stepper = Stepper::new(Yoshida4, "1/20").unwrap();
/// let mut motion = Motion::new(Spring, Relativistic { c: 2.0 }, [0.0], [1.5]).unwrap();
/// assert_eq!(motion.energy(), 5.0);
/// (0..1000).for_each(|_| stepper.step(&mut motion));
/// assert!((motion.energy() - 5.0).abs() < 1e-5);
/// ```
///
/// Formulas are those of [`potential!`]. The struct gets `shadowstep::Kinetic`, with the cost of a call in its
/// documentation. If the formula is a quadratic form in p, every scheme moves it, and β gets nothing from a drift; if
/// not, a scheme whose order holds for quadratic T only is a compile error.
#[proc_macro]
pub fn kinetic(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as Definition);
    kinetic::emit(&input).unwrap_or_else(syn::Error::into_compile_error).into()
}
