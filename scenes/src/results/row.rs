//! A row: what is written of a state, as cells of CSV or as an object of JSON lines.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use shadowstep::Real;
use shadowstep::shadow::Estimate;

use crate::reserved_names::COLUMNS;
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
            lyapunov: growth.lyapunov().unwrap_or(f64::NAN),
            megno: growth.megno(),
            mean_megno: growth.mean_megno().unwrap_or(f64::NAN),
            sali: run.sali().unwrap_or(f64::NAN),
        }
    }

    /// In the order of their columns.
    fn numbers(&self) -> [f64; 4] {
        let Indicators { lyapunov, megno, mean_megno, sali } = *self;
        [lyapunov, megno, mean_megno, sali]
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
        for (name, x) in self.chaos.iter().flat_map(|own| COLUMNS[6..].iter().zip(own.numbers())) {
            object.serialize_entry(name, &Some(x).filter(|x| x.is_finite()).map(|x| x.to_text()))?;
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

    /// The cells of a row, one for each name.
    pub(super) fn cells<'r, N: Real>(&self, row: &'r Row<'_, N>) -> Vec<Cell<'r, N>> {
        let mut cells = vec![Cell::Step(row.n), Cell::Number(row.t)];
        let number = |value: Option<&'r N>| value.map_or(Cell::Empty, Cell::Number);
        if self.energy {
            cells.push(number(row.energy));
        }
        if self.modified_energy {
            let found = row.modified_energy.as_ref();
            cells.extend([
                number(found.map(|found| &found.value)),
                number(found.and_then(|found| found.estimate.as_ref())),
                found.map_or(Cell::Empty, |found| Cell::Order(found.order)),
            ]);
        }
        if self.chaos {
            let none = [f64::NAN; 4];
            cells.extend(row.chaos.as_ref().map_or(none, Indicators::numbers).map(Cell::Double));
        }
        cells.extend(row.values.iter().map(|(_, value)| number(value.as_ref())));
        match row.state {
            Some((q, p)) => cells.extend(q.iter().take(self.coordinates).chain(p).map(Cell::Number)),
            None => cells.extend(self.state.iter().map(|_| Cell::Empty)),
        }
        cells
    }
}

/// A number of a row.
pub(super) enum Cell<'r, N> {
    Step(i64),
    Number(&'r N),
    Order(u32),
    /// An indicator of chaos, which may be NaN.
    Double(f64),
    /// What is not written at this n.
    Empty,
}

impl<N: Real> Cell<'_, N> {
    /// As in CSV: a text that gives the same number when it is read.
    pub(super) fn text(&self) -> String {
        match self {
            Cell::Step(n) => n.to_string(),
            Cell::Number(x) => x.to_text(),
            Cell::Order(order) => order.to_string(),
            Cell::Double(x) if x.is_finite() => x.to_text(),
            Cell::Double(_) | Cell::Empty => String::new(),
        }
    }

    /// As in a record of NumPy: a double, but of n an integer; NaN of what is not there.
    pub(super) fn bytes(&self) -> [u8; 8] {
        match self {
            Cell::Step(n) => n.to_le_bytes(),
            Cell::Number(x) => x.to_f64().to_le_bytes(),
            Cell::Order(order) => f64::from(*order).to_le_bytes(),
            Cell::Double(x) => x.to_le_bytes(),
            Cell::Empty => f64::NAN.to_le_bytes(),
        }
    }
}
