//! A row: what is written of a state, as cells of CSV or as an object of JSON lines.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use shadowstep::Real;
use shadowstep::shadow::Estimate;

use crate::scene::COLUMNS;
use crate::tangent::TangentRun;

/// A state of the run: what is written at its n.
pub(crate) struct Row<'a, N> {
    pub(crate) n: i64,
    pub(crate) t: &'a N,
    pub(crate) energy: Option<&'a N>,
    pub(crate) modified_energy: Option<ModifiedEnergy<N>>,
    pub(crate) chaos: Option<Indicators>,
    /// Of expressions, with the names of their columns; what is not due or not finite is `None`.
    pub(crate) values: Vec<(&'a str, Option<N>)>,
    /// q and p
    pub(crate) state: Option<(&'a [N], &'a [N])>,
}

pub(crate) struct ModifiedEnergy<N> {
    pub(crate) value: N,
    pub(crate) estimate: Option<N>,
    pub(crate) order: u32,
}

/// Indicators of chaos up to the state; one that is not finite, as at t = 0, has no text.
pub(crate) struct Indicators {
    pub(crate) lyapunov: f64,
    pub(crate) megno: f64,
    pub(crate) mean_megno: f64,
    pub(crate) sali: f64,
}

impl Indicators {
    pub(crate) fn of(run: &dyn TangentRun) -> Self {
        let growth = run.growths()[0];
        Indicators {
            lyapunov: growth.lyapunov(),
            megno: growth.megno(),
            mean_megno: growth.mean_megno(),
            sali: run.sali().unwrap_or(f64::NAN),
        }
    }

    /// With the names of their columns.
    fn texts(&self) -> [(&'static str, Option<String>); 4] {
        let Indicators { lyapunov, megno, mean_megno, sali } = self;
        let text = |x: &f64| Some(x).filter(|x| x.is_finite()).map(|x| x.to_text());
        [("lyapunov", text(lyapunov)), ("megno", text(megno)), ("mean_megno", text(mean_megno)), ("sali", text(sali))]
    }
}

impl<N: Real> ModifiedEnergy<N> {
    pub(crate) fn of(found: &Estimate<'_, N>) -> Self {
        ModifiedEnergy { value: found.value.clone(), estimate: found.error.cloned(), order: found.order }
    }
}

/// As an object of JSON lines. Numbers are texts that give the same numbers when they are read.
impl<N: Real> Serialize for Row<'_, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        object.serialize_entry("n", &self.n)?;
        object.serialize_entry("t", &self.t.to_text())?;
        if let Some(energy) = self.energy {
            object.serialize_entry("energy", &energy.to_text())?;
        }
        if let Some(ModifiedEnergy { value, estimate, order }) = &self.modified_energy {
            object.serialize_entry("modified_energy", &value.to_text())?;
            object.serialize_entry("estimate", &estimate.as_ref().map(N::to_text))?;
            object.serialize_entry("order", order)?;
        }
        for (name, text) in self.chaos.iter().flat_map(Indicators::texts) {
            object.serialize_entry(name, &text)?;
        }
        for (name, value) in self.values.iter().filter_map(|(name, value)| Some((name, value.as_ref()?))) {
            object.serialize_entry(name, &value.to_text())?;
        }
        if let Some((q, p)) = self.state {
            for (name, numbers) in [("q", q), ("p", p)] {
                object.serialize_entry(name, &numbers.iter().map(N::to_text).collect::<Vec<_>>())?;
            }
        }
        object.end()
    }
}

/// The columns of a file besides n and t.
pub(crate) struct Columns {
    pub(crate) energy: bool,
    pub(crate) modified_energy: bool,
    pub(crate) chaos: bool,
    /// The names of values.
    pub(crate) values: Vec<String>,
    /// The names of positions and momenta, if they are written.
    pub(crate) state: Vec<String>,
    /// How many of these are positions.
    pub(crate) coordinates: usize,
}

impl Columns {
    pub(crate) fn names(&self) -> Vec<&str> {
        let mut names = COLUMNS[..2].to_vec();
        names.extend(self.energy.then_some(COLUMNS[2]));
        names.extend(COLUMNS[3..6].iter().filter(|_| self.modified_energy));
        names.extend(COLUMNS[6..].iter().filter(|_| self.chaos));
        names.extend(self.values.iter().chain(&self.state).map(String::as_str));
        names
    }

    /// The cells of a row; what is not written at this n is empty.
    pub(super) fn cells<N: Real>(&self, row: &Row<'_, N>) -> Vec<String> {
        let mut cells = vec![row.n.to_string(), row.t.to_text()];
        let text = |value: Option<&N>| value.map_or(String::new(), N::to_text);
        if self.energy {
            cells.push(text(row.energy));
        }
        match row.modified_energy.as_ref().filter(|_| self.modified_energy) {
            Some(ModifiedEnergy { value, estimate, order }) => {
                cells.extend([value.to_text(), text(estimate.as_ref()), order.to_string()]);
            }
            None => cells.extend(vec![String::new(); if self.modified_energy { 3 } else { 0 }]),
        }
        match row.chaos.as_ref().filter(|_| self.chaos) {
            Some(indicators) => cells.extend(indicators.texts().map(|(_, text)| text.unwrap_or_default())),
            None => cells.extend(vec![String::new(); if self.chaos { 4 } else { 0 }]),
        }
        cells.extend(row.values.iter().map(|(_, value)| text(value.as_ref())));
        match row.state {
            Some((q, p)) => cells.extend(q.iter().take(self.coordinates).chain(p).map(N::to_text)),
            None => cells.extend(vec![String::new(); self.state.len()]),
        }
        cells
    }
}
