//! The weights that a search is among: a table whose decimals are unknowns, its conditions and its maps in f64.

use num_traits::ToPrimitive;
use shadowstep_schemes::document::Faults;
use shadowstep_schemes::library::Library;
use shadowstep_schemes::order::Condition;
use shadowstep_schemes::plan::StepPlan;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{MapKind, Source};

use crate::closed_gaps::beside_diagonal;
use crate::floats::{FloatDual, FloatDuals, Floats};
use crate::polish::{Cell, Equations, Model, NotPolished, maps, processed_maps, readable};

/// Weights as functions of unknowns, and the conditions that they must meet.
///
/// The unknowns are the weights that are different and, where intervals of instability are closed, the hω at which each
/// is: there the step of the harmonic oscillator turns by a multiple of π, with the matrix ±1.
pub(super) struct Space {
    pub(super) table: Table,
    /// How many intervals of instability are closed, near hω = π, 2π, ….
    pub(super) closed_gaps: usize,
    model: Model,
    equations: Equations,
    /// Evaluations of the gradient and Hessian–vector products a step.
    pub(super) cost: usize,
}

/// Conditions and their slopes, scaled to slopes of length 1.
pub(super) struct Linear {
    /// How far each condition is from what is needed.
    pub(super) off: Vec<f64>,
    /// Of each condition, along all unknowns.
    pub(super) slopes: Vec<Vec<f64>>,
    /// By what each condition was multiplied.
    pub(super) scales: Vec<f64>,
}

impl Linear {
    /// Adds a condition.
    fn push(&mut self, value: &FloatDual, needed: f64) {
        let length = value.slopes.iter().map(|slope| slope * slope).sum::<f64>().sqrt();
        // a condition that depends on no unknown is met, or never
        let scale = if length > 0.0 { 1.0 / length } else { 1.0 };
        self.off.push((value.value - needed) * scale);
        self.scales.push(scale);
        self.slopes.push(value.slopes.iter().map(|slope| slope * scale).collect());
    }

    /// The largest distance.
    pub(super) fn largest(&self) -> f64 {
        self.off.iter().fold(0.0, |most, off| most.max(off.abs()))
    }

    /// The sum of the squares.
    pub(super) fn size(&self) -> f64 {
        self.off.iter().map(|off| off * off).sum()
    }
}

impl Space {
    /// That of a table; its decimals are the unknowns, whatever they are.
    ///
    /// # Errors
    /// Faults of the table.
    pub(super) fn of(
        source: &Source,
        closed_gaps: impl Fn(usize) -> usize,
        library: Library<'_>,
    ) -> Result<Space, Faults> {
        let (scheme, base) = readable(source, library).map_err(|error| match error {
            NotPolished::Faults(faults) => faults,
            NotPolished::Request { message, hint } | NotPolished::Unsolved { message, hint } => {
                Faults(vec![source.fault(&(0..0), message).hint(hint)])
            }
        })?;
        let plan = StepPlan::of(&scheme);
        let model = Model::of(&scheme.table, base)?;
        let equations = Equations::of(&model, &scheme.table, false);
        let cost = plan.evaluations + plan.hessian_products;
        Ok(Space { table: scheme.table, closed_gaps: closed_gaps(cost), model, equations, cost })
    }

    /// The names of the weights.
    pub(super) fn names(&self) -> Vec<&str> {
        self.model.unknowns.iter().map(|unknown| unknown.name.as_str()).collect()
    }

    /// The conditions and their slopes.
    pub(super) fn linear(&self, x: &[f64]) -> Linear {
        let unknown = |n: usize| FloatDual::unknown(x[n], n, x.len());
        let weights = self.weights(unknown, &|value| FloatDual { value, slopes: Vec::new() });
        let mut linear = Linear { off: Vec::new(), slopes: Vec::new(), scales: Vec::new() };
        for (condition, value) in self.equations.values(&self.model, &weights, &FloatDuals) {
            linear.push(&value, condition.needed.to_f64().expect("a fraction of small numbers"));
        }
        if self.closed_gaps > 0 {
            let maps = maps(&self.model, &weights, &FloatDuals);
            for gap in x.len() - self.closed_gaps..x.len() {
                beside_diagonal(&maps, &unknown(gap), &FloatDuals)
                    .into_iter()
                    .for_each(|entry| linear.push(&entry, 0.0));
            }
        }
        linear.slopes.iter_mut().for_each(|slopes| slopes.resize(x.len(), 0.0));
        linear
    }

    /// How far each condition is from what is needed, without slopes.
    pub(super) fn off(&self, x: &[f64]) -> Vec<f64> {
        let weights = self.weights(|n| x[n], &|value| value);
        let conditions = self.equations.values(&self.model, &weights, &Floats).into_iter();
        let needed = |condition: Condition| condition.needed.to_f64().expect("a fraction of small numbers");
        let mut off: Vec<f64> = conditions.map(|(condition, value)| value - needed(condition)).collect();
        if self.closed_gaps > 0 {
            let maps = maps(&self.model, &weights, &Floats);
            let gaps = &x[x.len() - self.closed_gaps..];
            off.extend(gaps.iter().flat_map(|gap| beside_diagonal(&maps, gap, &Floats)));
        }
        off
    }

    /// The maps of a step.
    pub(super) fn maps(&self, x: &[f64]) -> Vec<(MapKind, f64)> {
        maps(&self.model, &self.weights(|n| x[n], &|value| value), &Floats)
    }

    /// The maps of the processed step; `None` without a processor.
    pub(super) fn processed_maps(&self, x: &[f64]) -> Option<Vec<(MapKind, f64)>> {
        self.table.processor.as_ref()?;
        Some(processed_maps(&self.model, &self.weights(|n| x[n], &|value| value), &Floats))
    }

    fn weights<V>(&self, unknown: impl Fn(usize) -> V, exact: &dyn Fn(f64) -> V) -> Vec<Vec<V>> {
        let value = |cell: &Cell| match cell {
            Cell::Unknown(n) => unknown(*n),
            // a form has no others than the 0 of a stage without a kick or a drift
            Cell::Formula(_) => exact(0.0),
        };
        self.model.lists.iter().map(|list| list.iter().map(value).collect()).collect()
    }
}
