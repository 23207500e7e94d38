//! Saving what follows a run, and going on from it with the same bits.
//!
//! What changes along a run is gone through in one order, number by number, by one method for both ways: it writes the
//! numbers, or replaces those of something that was begun anew with the same settings.

/// Writes the numbers that it is given, or replaces them.
pub trait Fields<N> {
    /// A number of the run.
    fn number(&mut self, number: &mut N);

    /// A number of double precision.
    fn double(&mut self, number: &mut f64);

    /// A whole number.
    fn whole(&mut self, number: &mut i64);

    /// How many items follow, of which each is a number or more.
    fn length(&mut self, length: &mut usize);

    /// Sets a mark where the numbers are replaced.
    fn restore(&mut self, restored: &mut bool);

    /// Numbers, whose number is known.
    fn numbers(&mut self, numbers: &mut [N]) {
        numbers.iter_mut().for_each(|number| self.number(number));
    }

    /// A count.
    fn count(&mut self, count: &mut u64) {
        let mut whole = count.cast_signed();
        self.whole(&mut whole);
        *count = whole.cast_unsigned();
    }

    /// A place among `places` of them.
    fn place(&mut self, place: &mut usize, places: usize) {
        let mut count = *place as u64;
        self.count(&mut count);
        *place = usize::try_from(count).unwrap_or(0).min(places.saturating_sub(1));
    }

    /// Yes or no.
    fn flag(&mut self, flag: &mut bool) {
        let mut whole = i64::from(*flag);
        self.whole(&mut whole);
        *flag = whole != 0;
    }
}

/// What is saved and restored by its numbers.
pub trait Saved<N> {
    /// Gives all numbers that change along a run, always in the same order.
    fn fields(&mut self, to: &mut dyn Fields<N>);
}

/// A list of any length, whose new items are like `item`.
pub fn list<N, T: Clone>(
    to: &mut dyn Fields<N>,
    items: &mut Vec<T>,
    item: &T,
    mut fields: impl FnMut(&mut dyn Fields<N>, &mut T),
) {
    let mut length = items.len();
    to.length(&mut length);
    items.resize(length, item.clone());
    items.iter_mut().for_each(|item| fields(to, item));
}

/// What may not be there; where it comes anew, it is like `item`.
pub fn optional<N, T: Clone>(
    to: &mut dyn Fields<N>,
    option: &mut Option<T>,
    item: &T,
    fields: impl FnOnce(&mut dyn Fields<N>, &mut T),
) {
    let mut is_there = option.is_some();
    to.flag(&mut is_there);
    match is_there {
        true => fields(to, option.get_or_insert_with(|| item.clone())),
        false => *option = None,
    }
}
