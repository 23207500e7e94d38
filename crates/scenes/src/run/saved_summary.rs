//! What the summary of a run needs of the states so far, as texts that give the same numbers when they are read.

use std::slice::Iter;

use serde::{Deserialize, Serialize};
use shadowstep::number::saved::Fields;
use shadowstep::{Rational, Real};

use crate::run::saved_state::number;

/// The numbers of what follows a run up to the state n, in the order in which it gives them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct SavedSummary {
    pub(crate) n: i64,
    numbers: Vec<String>,
}

impl SavedSummary {
    /// `fields` gives the numbers. `None` if one of them cannot be read.
    pub(crate) fn of<N: Real>(n: i64, fields: impl FnOnce(&mut dyn Fields<N>)) -> Option<SavedSummary> {
        let mut written = Written { numbers: Vec::new(), can_be_read: true };
        fields(&mut written);
        written.can_be_read.then_some(SavedSummary { n, numbers: written.numbers })
    }

    /// Replaces the numbers of what was begun anew. Returns whether they are its numbers.
    #[must_use]
    pub(crate) fn restore<N: Real>(&self, fields: impl FnOnce(&mut dyn Fields<N>)) -> bool {
        let mut read = Read { numbers: self.numbers.iter(), fits: true };
        fields(&mut read);
        read.fits && read.numbers.next().is_none()
    }
}

struct Written {
    numbers: Vec<String>,
    can_be_read: bool,
}

impl<N: Real> Fields<N> for Written {
    fn number(&mut self, number: &mut N) {
        let text = number.to_text();
        self.can_be_read &= self::read(&text, &number.context()).as_ref() == Some(number) || text == "NaN";
        self.numbers.push(text);
    }

    fn double(&mut self, number: &mut f64) {
        self.numbers.push(format!("{number:?}"));
    }

    fn whole(&mut self, number: &mut i64) {
        self.numbers.push(number.to_string());
    }

    fn length(&mut self, length: &mut usize) {
        self.numbers.push(length.to_string());
    }

    fn restore(&mut self, _: &mut bool) {}
}

struct Read<'a> {
    numbers: Iter<'a, String>,
    fits: bool,
}

impl Read<'_> {
    /// Replaces a number by the next one.
    fn next<T>(&mut self, number: &mut T, read: impl FnOnce(&str) -> Option<T>) {
        match self.numbers.next().and_then(|text| read(text)) {
            Some(found) => *number = found,
            None => self.fits = false,
        }
    }
}

impl<N: Real> Fields<N> for Read<'_> {
    fn number(&mut self, number: &mut N) {
        let context = number.context();
        self.next(number, |text| read(text, &context));
    }

    fn double(&mut self, number: &mut f64) {
        self.next(number, |text| text.parse().ok());
    }

    fn whole(&mut self, number: &mut i64) {
        self.next(number, |text| text.parse().ok());
    }

    fn length(&mut self, length: &mut usize) {
        let most = self.numbers.len();
        self.next(length, |text| text.parse().ok().filter(|length| *length <= most));
    }

    fn restore(&mut self, restored: &mut bool) {
        *restored = true;
    }
}

/// A number, which may be infinite or NaN.
fn read<N: Real>(text: &str, context: &N::Context) -> Option<N> {
    let quotient = |above: i64| {
        let mut quotient = N::from_rational(&Rational::from_integer(above.into()), context);
        quotient.divide(&N::zero(context));
        quotient
    };
    match text {
        "NaN" => Some(quotient(0)),
        "inf" => Some(quotient(1)),
        "-inf" => Some(quotient(-1)),
        _ => number(text, context),
    }
}
