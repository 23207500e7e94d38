//! A trial of a case: a scheme, and values that its table, the case or the scheme give.

use std::ops::ControlFlow;

use serde::de::DeserializeOwned;
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::System;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::Begin;

use crate::Continues;
use crate::stability::integrator::{AnyIntegrator, start_in, step_size, steps_of};
use crate::stability::suite::{Examined, Suite};
use crate::stability::table::{Table, Values};
use crate::stability::watched::{Watched, watched};

/// One computation with all that it depends on: the JSON of its values identifies it.
pub(crate) struct Trial<'a> {
    pub(crate) suite: &'a Suite,
    table: &'a Table,
    scheme: &'a Examined,
    pub(crate) arithmetic: Arithmetic,
    pub(crate) values: Values,
    /// What is known of it beside the values, which follow from these.
    aside: Values,
}

/// A monitor has about this number of windows.
const WINDOWS: u64 = 256;

impl<'a> Trial<'a> {
    pub(crate) fn of(suite: &'a Suite, table: &'a Table, scheme: &'a Examined, mut values: Values) -> Self {
        values.insert("scheme".to_owned(), scheme.identity.clone().into());
        let aside = values.remove("aside").and_then(|aside| aside.as_object().cloned()).unwrap_or_default();
        Trial { suite, table, scheme, arithmetic: table.arithmetic(suite), values, aside }
    }

    /// A value of the trial, or a constant of the case.
    pub(crate) fn get<T: DeserializeOwned>(&self, name: &str) -> T {
        let value = [&self.values, &self.aside, &self.table.given].into_iter().find_map(|values| values.get(name));
        let value = serde_json::from_value(value.cloned().unwrap_or_default());
        value.unwrap_or_else(|error| panic!("{name} of a trial: {error}"))
    }

    /// The scheme.
    pub(crate) fn scheme(&self) -> &'a NamedScheme {
        &self.scheme.scheme
    }

    /// The name of the scheme.
    pub(crate) fn name(&self) -> &'a str {
        self.scheme.name()
    }

    /// The name of the scheme with a hash of its weights.
    pub(crate) fn identity(&self) -> &'a str {
        &self.scheme.identity
    }

    /// Force evaluations of a step.
    pub(crate) fn evaluations(&self) -> u64 {
        self.scheme.evaluations()
    }

    /// The number of steps: of several the largest, which is the last; 1 if the trial has none.
    pub(crate) fn steps(&self) -> u64 {
        let steps = self.values.get("steps");
        steps.and_then(|steps| steps.as_u64().or_else(|| steps.as_array()?.last()?.as_u64())).unwrap_or(1)
    }

    /// About how many seconds it takes in double precision: by its evaluations, or by the value that its table names.
    pub(crate) fn seconds(&self) -> f64 {
        let evaluations = || self.steps() as f64 * self.evaluations() as f64;
        self.table.seconds * self.table.cost_of.as_ref().map_or_else(evaluations, |name| self.get(name))
    }

    /// The step size: `steps_a_unit` of a unit of time for each evaluation.
    pub(crate) fn step(&self) -> StepSize {
        step_size(Rational::new(self.evaluations().into(), self.get::<u64>("steps_a_unit").into()))
    }

    /// A system at its start, with steps of this size.
    pub(crate) fn start(&self, system: &System, h: &StepSize) -> Box<dyn AnyIntegrator> {
        start_in(self.arithmetic, system, steps_of(self.scheme(), h, Begin::Step))
    }

    /// All steps, with a monitor; `each` gets every state with its number from 1 on.
    pub(crate) fn watched(
        &self,
        run: &mut dyn AnyIntegrator,
        continues: Continues<'_>,
        each: &mut dyn FnMut(u64, &mut dyn AnyIntegrator) -> ControlFlow<()>,
    ) -> Watched {
        watched(run, (self.steps() / WINDOWS).max(1), self.steps(), continues, each)
    }
}
