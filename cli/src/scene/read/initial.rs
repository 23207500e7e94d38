//! [initial]: positions and momenta at t = 0.

use std::ops::Range;

use shadowstep_symbolic::Exact;

use crate::scene::reader::{List, Reader, Section};

/// The state as the scene says it.
pub(super) struct State {
    q: Option<List>,
    p: Option<List>,
    /// The place of `v`: then `p` is of velocities.
    velocities: Option<Range<usize>>,
    /// How many of the lists are there, right or wrong.
    has_q: bool,
    has_p: bool,
}

impl State {
    pub(super) fn read(reader: &mut Reader<'_>, initial: &Section<'_, '_>) -> State {
        let what = "a list of numbers: [1, \"1/2\"]";
        let q = reader.list_of(initial, "q", what, Reader::number);
        let p = reader.list_of(initial, "p", what, Reader::number);
        let v = reader.list_of(initial, "v", what, Reader::number);
        let has = |key| reader.get(initial, key).is_some();
        let (has_q, has_p) = (has("q"), has("p") || has("v"));
        let velocities = reader.get(initial, "v").map(|value| value.span());
        if let (true, Some(at)) = (has("p"), &velocities) {
            reader.fault(at, "p and v are both given", "keep one of the two");
        }
        State { q, p: v.or(p), velocities, has_q, has_p }
    }

    /// Refuses a state that is left out.
    pub(super) fn all_there(&self, reader: &mut Reader<'_>, at: &Range<usize>) {
        for (there, key) in [(self.has_q, "q"), (self.has_p, "p")] {
            if !there {
                let help = format!("add `{key} = […]` to [initial], with a number for each coordinate");
                reader.fault(at, format!("the key `{key}` is missing"), help);
            }
        }
    }

    /// Refuses velocities, where T(p) is no sum over masses.
    pub(super) fn refuse_velocities(&self, reader: &mut Reader<'_>) {
        if let Some(at) = &self.velocities {
            reader.fault(at, "v is of masses, and here T is given by `kinetic`", "give the momenta `p` in place of v");
        }
    }

    /// q and p, where they are given.
    pub(super) fn values(
        &self,
        reader: &mut Reader<'_>,
        coordinates: usize,
        masses: Option<&[Exact]>,
    ) -> (Option<Vec<Exact>>, Option<Vec<Exact>>) {
        let q = self.q.as_ref().and_then(|list| reader.values(list, coordinates));
        let mut p = self.p.as_ref().and_then(|list| reader.values(list, coordinates));
        if let (Some(_), Some(p), Some(masses)) = (&self.velocities, &mut p, masses) {
            for (p, mass) in p.iter_mut().zip(masses) {
                p.value *= &mass.value;
                p.rounded |= mass.rounded;
            }
        }
        (q, p)
    }
}
