//! From weights in f64 to a table: free parameters of few digits, all others as many as a table can claim.

use shadowstep_schemes::library::Library;

use crate::polish::{self, NotPolished, Polished};
use crate::search::form::Form;
use crate::search::manifold::{Tangent, nearest};
use crate::search::{Candidate, Search};

/// Digits of free parameters that are tried.
const FEWEST_DIGITS: usize = 3;
const MOST_DIGITS: usize = 15;

/// What the goal may lose, relatively, by the few digits of free parameters.
const LOST: f64 = 1e-7;

impl Search {
    /// The table of a candidate. Where the conditions leave weights free, these have the fewest digits with which the
    /// goal stays what it is to 1e-7 of it; the others are solved for.
    ///
    /// # Errors
    /// As for [`polish`](fn@polish::polish): conditions that do not determine the weights well enough.
    pub fn table(
        &self,
        candidate: &Candidate,
        name: &str,
        digits: Option<u32>,
        library: Library<'_>,
    ) -> Result<Polished, NotPolished> {
        let (space, form) = (self.space(candidate.start), Form::of(&self.request, self.stages(candidate.start)));
        let mut free = Tangent::at(space, &candidate.weights).coordinates;
        free.sort_unstable();
        let (x, decimals) = self.with_few_digits(candidate, &free);
        let value = |n: usize| match free.contains(&n) {
            true => format!("{:.decimals$}", x[n]),
            false => format!("{:.17}", x[n]),
        };
        let values: Vec<_> = (0..form.names().len()).map(value).collect();
        let gaps = &x[x.len() - space.closed_gaps..];
        let free: Vec<_> = free.iter().map(|&n| form.names()[n].as_str()).collect();
        let polished = |kernel: u32| {
            let source = form.table(name, &values, &free, kernel);
            polish::polish(&source, library, &polish::Request { digits, closed_gaps: gaps, ..Default::default() })
        };
        let found = polished(form.least_order())?;
        // the conditions of a processed step may imply more of its kernel
        let of_kernel = found.proved.order().order;
        let implies_more = self.request.processor.is_some() && of_kernel > form.least_order();
        if implies_more { polished(of_kernel) } else { Ok(found) }
    }

    /// The weights with free ones rounded to the fewest decimals that lose nothing, and that number.
    fn with_few_digits(&self, candidate: &Candidate, free: &[usize]) -> (Vec<f64>, usize) {
        let space = self.space(candidate.start);
        let moving: Vec<usize> = (0..candidate.weights.len()).filter(|n| !free.contains(n)).collect();
        let rounded = |decimals: usize| {
            let mut x = candidate.weights.clone();
            for &n in free {
                x[n] = format!("{:.decimals$}", x[n]).parse().expect("a decimal");
            }
            let x = nearest(space, &x, &moving)?;
            let lost = self.goal(candidate.start, &x) - candidate.goal;
            (lost <= LOST * candidate.goal.abs()).then_some((x, decimals))
        };
        let few = (FEWEST_DIGITS..MOST_DIGITS).find_map(rounded);
        few.unwrap_or_else(|| (candidate.weights.clone(), MOST_DIGITS))
    }
}
