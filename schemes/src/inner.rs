//! Multiple time steps: H = H_1 + H_2 + H_3 of slow forces, fast forces and the kinetic energy (r-RESPA).
//!
//! The *outer* scheme, whose weights are those of the table, composes kicks of H_1 and the flow of H_2 + H_3 in place
//! of drifts. Each of these flows, of weight b, is made of n steps of the *inner* scheme, of weight b/n, in which H_2
//! has the place of kicks. Neighbouring fast kicks merge. In a [plan](crate::StepPlan) H_2 is the middle part. The
//! order is proved by the words on three letters of the maps that a step really has.
//!
//! Source: M. Tuckerman, B. J. Berne & G. J. Martyna, J. Chem. Phys. 97 (1992) 1990.

use std::ops::Range;

use crate::symbolic::Rational;

use crate::document::Fault;
use crate::map::{Map, Stages};
use crate::map_kind::MapKind;
use crate::scheme::{ExactInner, ExactScheme};
use crate::table::{self, MOST_STAGES, Table, Weights};

impl ExactScheme {
    /// The maps of a step with the weights of both its schemes: with an inner scheme, fast kicks stand as kicks behind
    /// all other maps.
    pub fn maps_of_both(&self) -> Vec<Map> {
        let Some(inner) = &self.inner else { return self.maps() };
        let (mut maps, fast) = inner.step(&self.maps());
        maps.extend(fast.into_iter().map(|weight| Map { kind: MapKind::Kick, weight }));
        maps
    }
}

impl ExactInner {
    /// The maps of a step and, between each and the next, the weight of the fast kick.
    ///
    /// ```
    /// use shadowstep_schemes::shipped_proved;
    ///
    /// let scheme = &shipped_proved("r-respa-4").unwrap().scheme;
    /// let (maps, fast) = scheme.inner.as_ref().unwrap().step(&scheme.maps());
    /// // slow ½, fast ⅛, (drift ¼, fast ¼) three times, drift ¼, fast ⅛, slow ½
    /// assert_eq!((maps.len(), fast.len()), (6, 5));
    /// ```
    pub fn step(&self, outer: &[Map]) -> (Vec<Map>, Vec<Rational>) {
        let (mut maps, mut fast) = (Vec::new(), Vec::new());
        for map in outer {
            match map.kind {
                MapKind::Drift => self.substeps(&map.weight).into_iter().for_each(|map| match map.kind {
                    MapKind::Kick => fast.push(map.weight),
                    _ => maps.push(map),
                }),
                _ => maps.push(map.clone()),
            }
        }
        (maps, fast)
    }

    /// The maps of H_2 and H_3 in a drift of this weight.
    fn substeps(&self, weight: &Rational) -> Vec<Map> {
        let each = weight / Rational::from_integer(self.substeps.into());
        self.scheme.stages.repeated(&vec![each; self.substeps as usize]).maps()
    }

    /// Why there is no step with it, if there is none.
    pub(crate) fn refused(&self, table: &Table, claim: &table::Inner, outer: &Stages) -> Option<Fault> {
        let fault = |why: &str, hint: &str| {
            let message = format!("{} {why}", self.scheme.table.name.value);
            Some(table.source.fault(&claim.base.at, message).hint(hint))
        };
        if self.scheme.inner.is_some() {
            return fault("has an inner scheme, which an inner scheme cannot have", "H has three parts");
        }
        if self.scheme.processor.is_some() {
            return fault("is a processed scheme, which an inner scheme cannot be", "write the name of a plain scheme");
        }
        let outer = outer.maps();
        let name = format!("the inner scheme {}", self.scheme.table.name.value);
        for (maps, what, at) in
            [(&self.scheme.maps(), &*name, &claim.base.at), (&outer, "the outer scheme", place_of_weights(table))]
        {
            if !is_between_kicks(maps) {
                let message = format!("{what} must begin and end with kicks, and have no gradient kicks");
                let hint = "stormer-verlet, yoshida4 and blanes-moan-s6 are such schemes";
                return Some(table.source.fault(at, message).hint(hint));
            }
        }
        let substeps = drifts(&outer) * self.substeps as usize * drifts(&self.scheme.maps());
        (substeps > MOST_STAGES).then(|| table.too_long(substeps))
    }
}

/// Whether maps are drifts between plain kicks, so that fast kicks stand between all other maps.
fn is_between_kicks(maps: &[Map]) -> bool {
    let is_kick = |map: Option<&Map>| map.is_some_and(|map| map.kind == MapKind::Kick);
    let has_gradient_kicks = maps.iter().any(|map| map.kind == MapKind::GradientKick);
    maps.len() > 2 && !has_gradient_kicks && is_kick(maps.first()) && is_kick(maps.last())
}

fn drifts(maps: &[Map]) -> usize {
    maps.iter().filter(|map| map.kind == MapKind::Drift).count()
}

fn place_of_weights(table: &Table) -> &Range<usize> {
    match &table.weights {
        Some(Weights::Composition { base, .. }) => &base.at,
        Some(Weights::Stages { kick, .. }) => &kick.at,
        None => &table.name.at,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::ExactArithmetic;
    use crate::part_words;
    use crate::{Proved, Source, read, shipped, shipped_proved};

    /// A table with these lines in place of those of `r-respa-4`.
    fn table(changes: &[(&str, &str)]) -> Source {
        let text = shipped("r-respa-4").unwrap().text;
        let text = text.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join("\n");
        let text = changes.iter().fold(text, |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        });
        Source { path: "mine.toml".to_owned(), text }
    }

    fn proved(changes: &[(&str, &str)]) -> Proved {
        read(&table(changes), &|base, _| shipped(base)).unwrap_or_else(|faults| panic!("{faults}"))
    }

    fn fraction(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    const OUTER: &str = "base = \"stormer-verlet\"\ngamma = [1]";
    const INNER: &str = "[inner]\nbase = \"stormer-verlet\"\nsubsteps = 4";

    #[test]
    fn the_impulse_method_has_one_slow_kick_and_as_many_fast_ones_as_substeps() {
        let plan = shipped_proved("r-respa-4").unwrap().for_many_parts().unwrap().plan;
        let kinds: Vec<_> = plan.maps.iter().map(|(kind, _)| *kind).collect();
        use MapKind::{Drift, Kick};
        assert_eq!(kinds, [Kick, Drift, Drift, Drift, Drift, Kick]);
        assert_eq!((plan.kicks, plan.drifts), (vec![fraction(1, 2)], vec![fraction(1, 4)]));
        assert_eq!((plan.middle_weights, plan.middle), (vec![fraction(1, 8), fraction(1, 4)], vec![0, 1, 1, 1, 0]));
        assert_eq!(plan.evaluations, 1);
    }

    /// The values of words are from an independent program: the product of exponentials in the free algebra, in exact
    /// fractions (Python).
    #[test]
    fn orders_are_of_the_maps_that_a_step_has() {
        for (name, order, failed) in [("r-respa-4", 2, "AAB"), ("r-respa-8", 2, "AAB"), ("nested-s6", 4, "AAAAB")] {
            let proof = shipped_proved(name).unwrap().for_many_parts().unwrap().proof;
            let found = proof.many_parts.unwrap();
            let (condition, value) = found.failed.unwrap();
            assert_eq!(
                (found.order, condition.functional.to_string()),
                (order, format!("the word {failed}")),
                "{name}"
            );
            assert!(order == 4 || value == fraction(1, 8));
            assert!(proof.symmetric);
        }
        let scheme = &shipped_proved("r-respa-4").unwrap().scheme;
        let (maps, fast) = scheme.inner.as_ref().unwrap().step(&scheme.maps());
        let maps = maps.into_iter().map(|map| (map.kind, map.weight));
        let values = part_words::conditions(&part_words::part_maps(maps, fast), 3, 3, &ExactArithmetic);
        for (word, expected) in [("ABC", fraction(1, 4)), ("BBC", fraction(21, 128)), ("BCC", fraction(11, 64))] {
            let value = values.iter().find(|(found, _)| found.functional.to_string() == format!("the word {word}"));
            assert_eq!(value.unwrap().1, expected, "{word}");
        }
        // Yoshida's triple jump composes leapfrogs, and so impulse methods
        let order_4 = [(OUTER, "base = \"yoshida4\"\ngamma = [1]"), ("order = 2", "order = 4")];
        assert_eq!(proved(&order_4).order().order, 4);
        // other schemes of order 4 outside do not help one of order 2 inside, nor the other way round
        let order_2 = [(OUTER, "base = \"blanes-moan-s6\"\ngamma = [1]")];
        assert_eq!(proved(&order_2).order().order, 2);
        let order_2 = [(INNER, "[inner]\nbase = \"yoshida4\"\nsubsteps = 2")];
        assert_eq!(proved(&order_2).order().order, 2);
    }

    #[test]
    fn inner_steps_that_are_not_palindromes_make_a_step_that_is_not() {
        let ruth = [
            (INNER, "[inner]\nbase = \"mine-too\"\nsubsteps = 2"),
            ("symmetric = true\n", ""),
            ("order = 2", "order = 1"),
        ];
        let other =
            "name = \"mine-too\"\norder = 1\nkinetic = \"any\"\n[stages]\nkick = [\"1/3\", \"2/3\"]\ndrift = [1, 0]";
        let library = |name: &str, _: &Source| match name {
            "mine-too" => Some(Source { path: "mine-too.toml".to_owned(), text: other.to_owned() }),
            _ => shipped(name),
        };
        let proved = read(&table(&ruth), &library).unwrap();
        assert!(!proved.proof.symmetric);
        assert_eq!(proved.order().order, 1);
    }

    #[test]
    fn closed_forms_of_inner_schemes_have_any_number_of_digits() {
        let yoshida = [(INNER, "[inner]\nbase = \"yoshida4\"\nsubsteps = 2")];
        let digits = |proved: &Proved| match proved.scheme.held {
            crate::scheme::Held::Digits(digits) => digits,
            held => panic!("{held:?}"),
        };
        let proved = proved(&yoshida).for_many_parts().unwrap();
        let more = proved.to_digits(400).unwrap();
        assert_eq!((digits(&proved), digits(&more)), (300, 400));
        assert_ne!(proved.plan.middle_weights, more.plan.middle_weights);
        assert_eq!(more.plan.middle, proved.plan.middle);
    }
}
