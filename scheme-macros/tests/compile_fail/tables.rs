//! Faults of tables, and of what the attribute is given. All that is done with the structs compiles: their users have
//! no errors of their own.

use shadowstep::problems::Pendulum;
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{Motion, Scheme, Stepper, UnitMasses, ValidFor, splitting_scheme};

// the fault is in the base of the composition, and reported with its own path
#[splitting_scheme("base_with_faults.toml")]
pub struct BaseWithFaults;

// a composition whose base is a composition of itself
#[splitting_scheme("cyclic.toml")]
pub struct Cyclic;

// a constant that divides by zero, and one that has an even root of a negative number
#[splitting_scheme("division_by_zero.toml")]
pub struct DivisionByZero;

// a processor has one weight with a wrong digit
#[splitting_scheme("effective_order.toml")]
pub struct EffectiveOrder;

// the order does not survive the exchange of kick and drift
#[splitting_scheme("nystrom.toml", first = "drift")]
pub struct ExchangedRoles;

// more kicks than drifts
#[splitting_scheme("lengths.toml")]
pub struct Lengths;

// the table claims to be a palindrome, and is not
#[splitting_scheme("no_palindrome.toml")]
pub struct NoPalindrome;

// no table is named
#[splitting_scheme()]
pub struct NoTableNamed;

// the text is not TOML
#[splitting_scheme("no_toml.toml")]
pub struct NoToml;

// order 4 holds for quadratic kinetic energy only
#[splitting_scheme("quadratic_only.toml")]
pub struct QuadraticOnly;

// a cell is not a formula
#[splitting_scheme("syntax_in_a_cell.toml")]
pub struct SyntaxInACell;

// an argument that does not exist
#[splitting_scheme("yoshida4.toml", frist = "drift")]
pub struct UnknownArgument;

// two keys with spelling mistakes
#[splitting_scheme("unknown_key.toml")]
pub struct UnknownKey;

// weights that are not exact numbers
#[splitting_scheme("unreadable_weight.toml")]
pub struct UnreadableWeight;

// a step begins with a kick or a drift
#[splitting_scheme("yoshida4.toml", first = "force")]
pub struct WrongFirst;

// order 4 is claimed, but one exponent has the wrong sign
#[splitting_scheme("wrong_order.toml")]
pub struct WrongOrder;

// the drifts sum to 5/6
#[splitting_scheme("wrong_sum.toml")]
pub struct WrongSum;

// a scheme with an inner scheme for two parts
#[splitting_scheme("r-respa-4.toml")]
pub struct InnerScheme;

// a scheme with gradient kicks for three parts
#[splitting_scheme("chin-4a.toml", parts = 3)]
pub struct GradientKicks;

// the attribute stands above a function
#[splitting_scheme("yoshida4.toml")]
fn no_struct() {}

// the attribute stands above a struct with a field
#[splitting_scheme("yoshida4.toml")]
pub struct NoUnitStruct {
    pub steps: u64,
}

fn used<S: Scheme + ValidFor<Quadratic>>(scheme: S) {
    let stepper = Stepper::new(scheme, "1/10").unwrap();
    let mut motion = Motion::new(Pendulum, UnitMasses, [0.0], [1.0]).unwrap();
    stepper.step(&mut motion);
    stepper.step_augmented(&mut motion);
    stepper.step_back(&mut motion);
    stepper.step_back_augmented(&mut motion);
    println!("{} {:?}", stepper.scheme().summary().name, motion.energy());
}

fn main() {
    used(BaseWithFaults);
    used(Cyclic);
    used(DivisionByZero);
    used(EffectiveOrder);
    used(ExchangedRoles);
    used(Lengths);
    used(NoPalindrome);
    used(NoTableNamed);
    used(NoToml);
    used(QuadraticOnly);
    used(SyntaxInACell);
    used(UnknownArgument);
    used(UnknownKey);
    used(UnreadableWeight);
    used(WrongFirst);
    used(WrongOrder);
    used(WrongSum);
    let _ = (InnerScheme, GradientKicks);
    println!("{}", NoUnitStruct { steps: 1 }.summary().name);
}
