//! Scenes that differ in the values of some names only.

use std::collections::BTreeSet;
use std::ops::Range;

use shadowstep::Rational;
use shadowstep::tables::{Faults, Source};
use shadowstep_schemes::document::valid_document;
use shadowstep_schemes::symbolic::Exact;
use shadowstep_schemes::symbolic::decimal::to_text;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::document::library::Schemes;
use crate::document::schema::{each_text, words_of};
use crate::read::{Names, read};
use crate::run::arithmetic::Arithmetic;
use crate::scene::{InitialValueProblem, Scene, System};

/// A scene's text in which names stand for values: one scene for each choice of the values.
///
/// A number can be used like a parameter in all numbers and formulas of the scene. `"$name"` in place of a whole value
/// stands for any value: a word such as the name of a scheme, a whole number, or a number.
///
/// ```
/// use shadowstep::tables::Source;
/// use shadowstep_scenes::family::{Family, Meaning};
///
/// let text = r#"
/// [problem]
/// name = "kepler"
/// parameters.eccentricity = "1 - b"
/// [run]
/// scheme = "$method"
/// step = "1/20"
/// steps = 40
/// [output]
/// energy = true
/// "#;
/// let family = Family::new(Source { path: "scene.toml".to_owned(), text: text.to_owned() }, &[]);
/// let names = [
///     ("b".to_owned(), Meaning::Number(shadowstep::exact("1/3")?)),
///     ("method".to_owned(), Meaning::Word("yoshida4".to_owned())),
/// ];
/// let scene = family.scene(&names)?;
/// assert_eq!(scene.scheme.name, "yoshida4");
/// assert_eq!(scene.system.parameters[1].1.value, shadowstep::exact("2/3")?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Family {
    source: Source,
    /// Sections of the text that are not of the scene.
    others: &'static [&'static str],
    schemes: Schemes,
}

/// The text of a family, parsed.
#[derive(Debug)]
pub struct Parsed<'a> {
    family: &'a Family,
    document: DeTable<'a>,
    /// Whether a name stands for a whole value somewhere: `"$name"`.
    has_words: bool,
}

/// What a name stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning {
    /// A number.
    Number(Rational),
    /// A word; one of digits is a whole number.
    Word(String),
}

impl Family {
    /// The family of a text; `others` are its sections that are not of the scene.
    pub fn new(source: Source, others: &'static [&'static str]) -> Family {
        Family { source, others, schemes: Schemes::default() }
    }

    /// The text.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The schemes of the scenes, each of which is read and proved once.
    pub fn schemes(&self) -> &Schemes {
        &self.schemes
    }

    /// The scene with these values of the names.
    ///
    /// # Errors
    /// All faults of the text with these values.
    pub fn scene(&self, names: &[(String, Meaning)]) -> Result<Scene, Faults> {
        self.parsed()?.scene(names)
    }

    /// The text, parsed once for many scenes.
    ///
    /// # Errors
    /// Faults of the syntax.
    pub fn parsed(&self) -> Result<Parsed<'_>, Faults> {
        let document = valid_document(&self.source)?;
        let mut has_words = false;
        document.values().for_each(|value| each_text(value, &mut |text, _| has_words |= whole_name(text).is_some()));
        Ok(Parsed { family: self, document, has_words })
    }

    /// All names in the texts of the scene, whatever they stand for.
    ///
    /// # Errors
    /// Faults of the syntax.
    pub fn names(&self) -> Result<BTreeSet<String>, Faults> {
        let document = valid_document(&self.source)?;
        Ok(names_in(&document, |section| !self.others.contains(&section)))
    }

    /// The names in `"$name"`, in the order of the text, with their places.
    ///
    /// # Errors
    /// Faults of the syntax.
    pub fn whole_names(&self) -> Result<Vec<(String, Range<usize>)>, Faults> {
        let document = valid_document(&self.source)?;
        let mut found = Vec::new();
        let sections = document.iter().filter(|(name, _)| !self.others.contains(&name.get_ref().as_ref()));
        let mut add = |text: &str, at| found.extend(whole_name(text).map(|name| (name.to_owned(), at)));
        sections.for_each(|(_, section)| each_text(section, &mut add));
        found.sort_by_key(|(_, at)| at.start);
        Ok(found)
    }
}

impl Parsed<'_> {
    /// Whether one of the sections that are chosen, such as "run", contains one of these names in its texts.
    pub(crate) fn has_names(&self, is_chosen: impl Fn(&str) -> bool, names: &[&String]) -> bool {
        let found = names_in(&self.document, is_chosen);
        self.has_words || names.iter().any(|name| found.contains(*name))
    }

    /// The system of the scene with these values of the names, computed to the digits of a run in this arithmetic.
    ///
    /// # Errors
    /// All faults of the system with these values; the scene may have others.
    pub(crate) fn system(&self, names: &[(String, Meaning)], arithmetic: Arithmetic) -> Result<System, Faults> {
        System::read_of(self.family.source(), &self.document, numbers(names), arithmetic)
    }

    /// q and p at t = 0 with these values of the names, which only \[initial\] contains: the problem is that of another
    /// scene; `None` if they have a fault, or depend on more than the problem.
    pub(crate) fn state(
        &self,
        names: &[(String, Meaning)],
        problem: &InitialValueProblem,
        arithmetic: Arithmetic,
    ) -> Option<(Vec<Exact>, Vec<Exact>)> {
        problem.read_state(self.family.source(), &self.document, numbers(names), arithmetic)
    }

    /// The scene with these values of the names.
    ///
    /// # Errors
    /// All faults of the text with these values.
    pub fn scene(&self, names: &[(String, Meaning)]) -> Result<Scene, Faults> {
        let Family { source, others, schemes } = self.family;
        let numbers = Names { numbers: numbers(names), others, schemes };
        if !self.has_words {
            return read(source, &self.document, &numbers);
        }
        let words: Vec<_> = names.iter().map(|(name, meaning)| (name.as_str(), meaning.text())).collect();
        let mut document = self.document.clone();
        document.iter_mut().for_each(|(_, value)| substitute(value.get_mut(), &words));
        read(source, &document, &numbers)
    }
}

/// The names that stand for numbers.
fn numbers(names: &[(String, Meaning)]) -> Vec<(String, Exact)> {
    names.iter().filter_map(|(name, meaning)| Some((name.clone(), meaning.number()?))).collect()
}

impl Meaning {
    /// The value as a text.
    pub fn text(&self) -> String {
        match self {
            Meaning::Number(number) => to_text(number),
            Meaning::Word(word) => word.clone(),
        }
    }

    fn number(&self) -> Option<Exact> {
        match self {
            Meaning::Number(number) => Some(Exact { value: number.clone(), rounded: false }),
            Meaning::Word(_) => None,
        }
    }
}

/// Puts the value of a name in place of each `"$name"`.
fn substitute<'i>(value: &mut DeValue<'i>, words: &'i [(&str, String)]) {
    match value {
        DeValue::String(text) => {
            let found = text.strip_prefix('$').and_then(|name| words.iter().find(|(word, _)| *word == name));
            if let Some((_, word)) = found {
                *value = whole(word).unwrap_or_else(|| DeValue::String(word.into()));
            }
        }
        DeValue::Array(members) => members.iter_mut().for_each(|member| substitute(member.get_mut(), words)),
        DeValue::Table(table) => table.iter_mut().for_each(|(_, value)| substitute(value.get_mut(), words)),
        _ => {}
    }
}

/// A whole number in TOML.
fn whole(text: &str) -> Option<DeValue<'_>> {
    let is_whole = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    is_whole.then(|| DeValue::parse(text).ok()).flatten().map(Spanned::into_inner)
}

/// The names in the texts of the sections that are chosen.
fn names_in(document: &DeTable<'_>, is_chosen: impl Fn(&str) -> bool) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let sections = document.iter().filter(|(name, _)| is_chosen(name.get_ref()));
    sections
        .for_each(|(_, section)| each_text(section, &mut |text, _| found.extend(words_of(text).map(str::to_owned))));
    found
}

/// The name in a text `$name`.
fn whole_name(text: &str) -> Option<&str> {
    text.strip_prefix('$').filter(|name| words_of(name).next() == Some(name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::observer::testing::rows;

    fn family(text: &str) -> Family {
        Family::new(Source { path: "test.toml".to_owned(), text: text.to_owned() }, &["axes"])
    }

    fn number(name: &str, text: &str) -> (String, Meaning) {
        (name.to_owned(), Meaning::Number(shadowstep::exact(text).unwrap()))
    }

    fn word(name: &str, word: &str) -> (String, Meaning) {
        (name.to_owned(), Meaning::Word(word.to_owned()))
    }

    const RUN: &str =
        "run = { scheme = \"yoshida4\", step = \"h\", steps = \"$n\", digits = \"$digits\" }\noutput.energy = true\n";

    #[test]
    fn names_are_known_to_every_kind_of_problem() {
        for problem in [
            "problem.name = \"kepler\"\nproblem.parameters.eccentricity = \"e\"\ninitial.q = [\"1 - e\", 0]",
            "problem = { potential = \"q^2/(2*e)\", coordinates = [\"q\"], kinetic = \"pq^2*e\" }\ninitial = { q = \
                [\"e\"], p = [0] }",
            "problem = { pair = \"-m_i*m_j*e/sqrt(r2)\", dimensions = 2, bodies = { m = [1, \"e\"] } }\n\
             initial = { q = [0, 0, \"e\", 1], v = [0, 0, 0, \"e\"] }",
        ] {
            let family = family(&format!("{problem}\n{RUN}\n[axes]\ne = [1, 2]\n"));
            for (e, digits) in [("1/3", "double"), ("2/3", "30")] {
                let names = [number("e", e), number("h", "1/40"), word("n", "12"), word("digits", digits)];
                let scene = family.scene(&names).unwrap_or_else(|faults| panic!("{faults}"));
                assert_eq!((scene.steps(), scene.h.exact().to_string()), (Some(12), "1/40".to_owned()));
                assert_eq!(scene.arithmetic.digits(), digits.parse().unwrap_or(16));
                let value = |name| scene.system.parameters.iter().find(|(n, _)| n == name).unwrap().1.value.to_string();
                assert_eq!(value("e"), e);
                scene.run_into(&mut Vec::new(), &mut ()).unwrap();
            }
        }
    }

    #[test]
    fn a_value_gives_the_same_run_as_its_text() {
        let text = |e: &str, h: &str| {
            format!(
                "problem.name = \"kepler\"\nproblem.parameters.eccentricity = \"{e}\"\n\
                 run = {{ scheme = \"ruth3\", step = \"{h}\", steps = 30, digits = \"double\" }}\noutput.trajectory = true\n"
            )
        };
        let named = family(&text("1 - b^2", "b/10")).scene(&[number("b", "4/5")]).unwrap();
        let plain = family(&text("9/25", "2/25")).scene(&[]).unwrap();
        assert_eq!(rows(&named), rows(&plain));
    }

    #[test]
    fn a_fault_has_its_place_in_the_text() {
        let family = family(&format!("problem.name = \"kepler\"\n{RUN}"));
        let names = [number("h", "1/40"), word("n", "12"), word("digits", "many")];
        let faults = family.scene(&names).unwrap_err();
        assert_eq!((faults.0[0].line, faults.0[0].message.as_str()), (2, "`many` is not known here"));
        // without its value, a name is an ordinary text
        let faults = family.scene(&[number("h", "1/40"), word("n", "12")]).unwrap_err();
        assert_eq!(faults.0[0].message, "`$digits` is not known here");
    }

    #[test]
    fn all_names_of_the_scene_are_found() {
        let family =
            family(&format!("problem.name = \"kepler\"\ninitial.q = [\"2*cos(f)\", 0]\n{RUN}\n[axes]\nz = \"y\""));
        let names = family.names().unwrap();
        assert!(["f", "h", "n", "digits", "yoshida4"].iter().all(|name| names.contains(*name)), "{names:?}");
        assert!(!names.contains("y"));
    }
}
