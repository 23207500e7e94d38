//! Derivatives of the constants of a computation by a parameter.
//!
//! Constants enter numbers as rationals, rounded once. What makes them, from the text of a scene to the masses of
//! planets, knows nothing of derivatives; but it is exact, so that its difference at two values of the parameter has as
//! many digits as one wants.

use std::cell::RefCell;

use thiserror::Error;

use crate::Rational;
use num_traits::Zero;

/// Why constants have no derivatives by a parameter.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
pub enum ParameterError {
    /// What is made at the second value has not the same constants in the same order.
    #[error("the formulas have another form at a nearby value")]
    OtherForm,
    /// All are the same at both values.
    #[error("no constant of the steps depends on it")]
    NoConstant,
}

shadowstep_schemes::debug_as_text!(ParameterError);

/// What happens to the constants of this thread.
enum Constants {
    Noted(Vec<Rational>),
    /// Those that come next, in reverse.
    Differentiated {
        derivatives: Vec<Rational>,
        fits: bool,
    },
}

thread_local! {
    static CONSTANTS: RefCell<Option<Constants>> = const { RefCell::new(None) };
}

/// The derivative of the next constant, if it has one.
pub(super) fn derivative(value: &Rational) -> Option<Rational> {
    CONSTANTS.with_borrow_mut(|constants| match constants.as_mut()? {
        Constants::Noted(all) => {
            all.push(value.clone());
            None
        }
        Constants::Differentiated { derivatives, fits } => {
            let next = derivatives.pop();
            *fits &= next.is_some();
            next.filter(|next| !next.is_zero())
        }
    })
}

/// What `make` gives of [dual numbers](super::Dual) whose constants have their derivatives by a parameter, along the
/// first direction.
///
/// `make` gets 0, where it makes what is wanted; 1 and 2, where it makes the same with the parameter at the same value
/// and at one that is larger by `distance`, both exactly or to many digits: the derivatives are the differences of the
/// constants of these two, divided by the distance, with an error of the size of the distance. Every constant is one
/// that [`Number::from_rational`](super::Number::from_rational) makes on this thread.
///
/// ```
/// use shadowstep::number::{Dual, Number, with_parameter};
/// use shadowstep::{Rational, exact};
///
/// // 1/m at m = 4
/// let inverse = |m: &Rational| Dual::<f64>::from_rational(&m.recip(), &());
/// let (four, near) = (exact("4")?, exact("4 + 1e-30")?);
/// let found = with_parameter(&exact("1e-30")?, |at| inverse([&four, &four, &near][at]))?;
/// assert_eq!((found.value, found.derivatives), (0.25, [-0.0625]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Constants that are not the same ones at both values, or have the same values.
pub fn with_parameter<T>(distance: &Rational, mut make: impl FnMut(usize) -> T) -> Result<T, ParameterError> {
    // if `make` panics, too
    let _plain = Plain;
    let mut noted = |at: usize| {
        set(Some(Constants::Noted(Vec::new())));
        let _ = make(at);
        let Some(Constants::Noted(all)) = set(None) else { unreachable!("it was set") };
        all
    };
    let (here, there) = (noted(1), noted(2));
    if here.len() != there.len() {
        return Err(ParameterError::OtherForm);
    }
    if here == there {
        return Err(ParameterError::NoConstant);
    }
    let derivatives = here.iter().zip(&there).rev().map(|(here, there)| (there - here) / distance).collect();
    set(Some(Constants::Differentiated { derivatives, fits: true }));
    let made = make(0);
    match set(None) {
        Some(Constants::Differentiated { derivatives, fits: true }) if derivatives.is_empty() => Ok(made),
        _ => Err(ParameterError::OtherForm),
    }
}

/// When it goes, constants have no derivatives again.
struct Plain;

impl Drop for Plain {
    fn drop(&mut self) {
        set(None);
    }
}

fn set(constants: Option<Constants>) -> Option<Constants> {
    CONSTANTS.with_borrow_mut(|own| std::mem::replace(own, constants))
}
