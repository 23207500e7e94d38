//! What the text gives of a body of a planetary system.

use std::ops::Range;

use num_traits::Zero;
use shadowstep::Rational;
use shadowstep_schemes::document::{Fault, Placed, Text};
use shadowstep_schemes::symbolic::Exact;

use crate::document::schema::Table;
use crate::read::elements::Elements;
use crate::read::horizons::HorizonsVector;
use crate::read::reader::Reader;

/// The keys of elements besides `a`, which all are 0 unless they are given.
pub(super) const ANGLES_AND_SHAPE: [&str; 6] = ["e", "i", "node", "pericentre", "M", "lambda"];

/// What the text gives of a body.
pub(in crate::read) struct GivenBody {
    pub(super) name: Option<Text>,
    pub(super) mass: Option<Text>,
    pub(super) q: Option<Placed<Vec<Text>>>,
    pub(super) v: Option<Placed<Vec<Text>>>,
    pub(super) a: Option<Text>,
    pub(super) elements: Vec<(&'static str, Text)>,
    /// A table of Horizons that has the state, `None` inside if it cannot be read.
    pub(super) horizons: Option<(Range<usize>, Option<HorizonsVector>)>,
    pub(super) at: Range<usize>,
    /// Of a file of particles: its name and the line.
    pub(super) line: Option<String>,
}

impl GivenBody {
    pub(super) fn read(reader: &mut Reader<'_>, section: &Table<'_, '_>) -> GivenBody {
        let horizons = section.text("horizons").map(|file| (file.at.clone(), HorizonsVector::open(reader, &file)));
        let state = ["q", "v"].map(|key| section.list(key));
        GivenBody { horizons, ..GivenBody::of(|key| section.text(key), state, &section.at) }
    }

    /// Of the texts of keys, with q and v, at a place.
    pub(super) fn of(
        text: impl Fn(&str) -> Option<Text>,
        [q, v]: [Option<Placed<Vec<Text>>>; 2],
        at: &Range<usize>,
    ) -> GivenBody {
        let elements = ANGLES_AND_SHAPE.into_iter().filter_map(|key| Some((key, text(key)?))).collect();
        let [name, mass, a] = ["name", "mass", "a"].map(text);
        GivenBody { name, mass, q, v, a, elements, horizons: None, at: at.clone(), line: None }
    }

    /// Puts the line of a file before the faults that were found in it.
    pub(super) fn name_line(&self, faults: &mut [Fault]) {
        let Some(line) = &self.line else { return };
        faults.iter_mut().for_each(|fault| fault.message = format!("{line}: {}", fault.message));
    }

    pub(super) fn element(&self, key: &str) -> Option<&Text> {
        self.elements.iter().find(|(name, _)| *name == key).map(|(_, text)| text)
    }

    pub(super) fn is_by_elements(&self) -> bool {
        self.a.is_some() || !self.elements.is_empty()
    }

    /// Whether any state is given.
    pub(super) fn has_state(&self) -> bool {
        self.horizons.is_some() || self.q.is_some() || self.v.is_some() || self.is_by_elements()
    }

    /// The elements; their faults are reported.
    pub(super) fn elements(&self, reader: &mut Reader<'_>) -> Option<Elements> {
        let Some(a) = &self.a else {
            let help = "add q and v, or the semi-major axis of its orbit, `a = 5.2`";
            return reader.toml.wrong(&self.at, "this body has no position", help);
        };
        let zero = || Some(Exact { value: Rational::zero(), rounded: false });
        let mut value = |key: &str| self.element(key).map_or_else(zero, |text| reader.evaluate(text));
        let [e, i, node, pericentre, anomaly, longitude] = ANGLES_AND_SHAPE.map(|key| value(key).map(|e| e.value));
        let (node, pericentre) = (node?, pericentre?);
        let anomaly = match self.element("lambda") {
            None => anomaly?,
            Some(_) => longitude? - &node - &pericentre,
        };
        let elements = Elements { a: reader.evaluate(a)?.value, e: e?, i: i?, node, pericentre, anomaly };
        match elements.fault() {
            None => Some(elements),
            Some((message, help)) => {
                let at = self.element("e").map_or(&a.at, |text| &text.at);
                reader.toml.wrong(at, message, help)
            }
        }
    }
}
