//! What draws documents: random choices, and the document so far.

use std::collections::BTreeSet;
use std::fmt::Display;

use crate::document::{Document, File, NAME};
use crate::random::Random;

/// A document that is being drawn.
pub(crate) struct Maker {
    random: Random,
    pub(crate) document: Document,
    /// Names of axes or columns, which can stand for numbers.
    pub(crate) names: Vec<&'static str>,
    /// Those that stand for one.
    pub(crate) used: BTreeSet<&'static str>,
    /// Whether time is transformed: U is negative then.
    pub(crate) has_time: bool,
    /// Whether numbers are in double precision.
    pub(crate) is_double: bool,
}

/// What other sections need of the system.
#[derive(Clone, Debug, Default)]
pub(crate) struct System {
    pub(crate) coordinates: Vec<String>,
    pub(crate) momenta: Vec<String>,
    pub(crate) parameters: Vec<String>,
    /// The names or numbers of bodies.
    pub(crate) bodies: Vec<String>,
    /// A step size that resolves it.
    pub(crate) step: &'static str,
    /// Schemes that fit.
    pub(crate) schemes: &'static [&'static str],
}

/// Numbers of all forms.
const NUMBERS: [&str; 12] =
    ["1", "2", "\"1/3\"", "0.25", "\"sqrt(2)/3\"", "0", "-1", "\"-1/2\"", "1e-3", "\"pi/4\"", "\"2^-3\"", "1.5e0"];

/// Numbers far from all others.
const EXTREMES: [&str; 6] = ["1e300", "1e-300", "1e-17", "\"10^20\"", "-1e10", "\"1/3^40\""];

impl Maker {
    pub(crate) fn of_seed(seed: u64) -> Maker {
        let document = Document { files: vec![File::new(NAME, "")], commands: Vec::new() };
        Maker {
            random: Random::of_seed(seed),
            document,
            names: Vec::new(),
            used: BTreeSet::new(),
            has_time: false,
            is_double: true,
        }
    }

    /// Less than this.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.random.part() * count as f64) as usize
    }

    /// Once in this number of times; combinations that are always refused are to be rare.
    pub(crate) fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    pub(crate) fn one<T: Clone>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())].clone()
    }

    /// Some of a list, in its order, at least one.
    pub(crate) fn some<T: Clone>(&mut self, list: &[T]) -> Vec<T> {
        let kept = self.below(list.len());
        let chosen = list.iter().enumerate().filter(|(place, _)| *place == kept || self.once_in(3));
        chosen.map(|(_, value)| value.clone()).collect()
    }

    /// The value of a number.
    pub(crate) fn number(&mut self) -> String {
        match self.below(60) {
            0 => self.one(&EXTREMES).to_owned(),
            1..25 if !self.names.is_empty() => {
                let names = self.names.clone();
                let name = self.one(&names);
                self.used.insert(name);
                self.one(&["\"N\"", "\"1/3 + N/50\"", "\"N/2\""]).replace('N', name)
            }
            _ => self.one(&NUMBERS).to_owned(),
        }
    }

    pub(crate) fn numbers(&mut self, count: usize) -> String {
        let numbers: Vec<String> = (0..count).map(|_| self.number()).collect();
        format!("[{}]", numbers.join(", "))
    }

    pub(crate) fn line(&mut self, line: String) {
        self.document.files[0].lines.push(line);
    }

    pub(crate) fn heading(&mut self, heading: &str) {
        self.line(heading.to_owned());
    }

    pub(crate) fn key(&mut self, name: &str, value: impl Display) {
        self.line(format!("{name} = {value}"));
    }

    pub(crate) fn text(&mut self, name: &str, value: &str) {
        self.key(name, format!("\"{value}\""));
    }

    /// Whether a line of the document has this word.
    pub(crate) fn mentions(&self, word: &str) -> bool {
        let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
        let files = self.document.files.iter().filter(|file| file.name.ends_with(".toml"));
        files.flat_map(|file| &file.lines).any(|line| line.split(|letter| !is_part(letter)).any(|known| known == word))
    }

    /// A key once in this number of times, with one of these values.
    pub(crate) fn maybe(&mut self, times: usize, name: &str, values: &[&str]) {
        if self.once_in(times) {
            let value = self.one(values);
            self.key(name, value);
        }
    }

    /// A formula: this template with names for X and Y (coordinates), P and R (momenta), A (a parameter, or a number
    /// where there is none).
    pub(crate) fn filled(&mut self, template: &str, system: &System) -> String {
        let mut pair = |names: &[String]| {
            let first = if names.is_empty() { 0 } else { self.below(names.len()) };
            let name = |place: usize| names.get(place % names.len().max(1)).cloned().unwrap_or_else(|| "1".to_owned());
            (name(first), name(first + 1))
        };
        let ((x, y), (p, r), (a, _)) = (pair(&system.coordinates), pair(&system.momenta), pair(&system.parameters));
        // one pass, as names may have these letters
        template
            .chars()
            .map(|letter| match letter {
                'X' => x.clone(),
                'Y' => y.clone(),
                'P' => p.clone(),
                'R' => r.clone(),
                'A' => a.clone(),
                other => other.to_string(),
            })
            .collect()
    }

    /// A sum of some of these templates.
    pub(crate) fn sum(&mut self, templates: &[&str], system: &System) -> String {
        let terms: Vec<String> = (0..=self.below(3))
            .map(|_| {
                let template = self.one(templates);
                self.filled(template, system)
            })
            .collect();
        terms.join(" + ")
    }
}
