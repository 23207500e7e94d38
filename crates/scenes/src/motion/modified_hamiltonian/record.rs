//! The modified Hamiltonian as texts: the coefficients of its series, and its formulas.

use serde::Serialize;
use shadowstep::tables::Proved;
use shadowstep_analysis::bracket::{Bracket, Letter};
use shadowstep_analysis::modified::ModifiedHamiltonian;
use shadowstep_schemes::Kinetic;
use shadowstep_schemes::symbolic::decimal::to_significant;
use shadowstep_schemes::symbolic::{Node, Notation, Rational};

use super::{SymbolicHamiltonian, SymbolicTerm};
use crate::document::library::NamedScheme;
use crate::document::reserved_names::Language;
use crate::scene::System;
use crate::texts::refusal::Refusal;

/// Short fractions have numerators and denominators of at most this number of digits.
const SHORT: usize = 15;

/// The most words of the series of many parts.
const MOST_WORDS: u64 = 20_000;

/// The series of a scheme's step in brackets.
#[derive(Clone, Debug, Serialize)]
pub struct SeriesRecord {
    /// The scheme.
    pub scheme: String,
    /// `any` or `quadratic`; none for many parts.
    pub kinetic: Option<&'static str>,
    /// The number of parts.
    pub parts: u32,
    /// Whether coefficients are exact.
    pub exact: bool,
    /// The terms that are not 0.
    pub terms: Vec<SeriesTerm>,
}

/// A term of the series.
#[derive(Clone, Debug, Serialize)]
pub struct SeriesTerm {
    /// The power n of h, of a term of H_(n+1).
    pub power: u32,
    /// Such as `[K,[K,D]]`.
    pub bracket: String,
    /// A short fraction, or a decimal.
    pub coefficient: String,
}

/// What a series is of.
#[derive(Clone, Copy, Debug)]
pub struct SeriesOptions {
    /// The highest power of h.
    pub grade: u32,
    /// For H of this number of parts, 3 or more, in place of T + U.
    pub parts: Option<u32>,
    /// Whether brackets that are 0 for quadratic T are left out, as they are of schemes with gradient kicks.
    pub quadratic: bool,
    /// Significant digits of coefficients that are no short fractions.
    pub digits: usize,
}

impl SeriesRecord {
    /// The series of a scheme.
    ///
    /// # Errors
    /// A scheme that is not for these parts; too many words.
    pub fn of(proved: &Proved, options: SeriesOptions) -> Result<Self, Refusal> {
        let name = &proved.scheme.table.name.value;
        let SeriesOptions { grade, parts, digits, .. } = options;
        let Some(parts) = parts else {
            if proved.scheme.inner.is_some() {
                return Err(Refusal::new(
                    format!("{name} has multiple time steps, for slow forces, fast forces and T"),
                    "ask for 3 parts: A for the slow forces, B for the fast ones, C for T",
                ));
            }
            let (kinetic, word) = match options.quadratic || proved.scheme.has_gradient_kicks() {
                true => (Kinetic::Quadratic, "quadratic"),
                false => (Kinetic::Any, "any"),
            };
            let series = ModifiedHamiltonian::of(proved, kinetic, grade);
            return Ok(SeriesRecord::with(name, (Some(word), 2), &series, digits));
        };
        if u64::from(parts).pow(grade + 1) > MOST_WORDS {
            let message = format!("the series of {parts} parts up to h^{grade} has too many terms");
            return Err(Refusal::new(message, "ask for fewer parts, or a lower grade"));
        }
        let series = ModifiedHamiltonian::of_parts(proved, parts as usize, grade)
            .map_err(|not| Refusal::new(not.to_string(), "use a scheme such as yoshida4"))?;
        Ok(SeriesRecord::with(name, (None, parts), &series, digits))
    }

    fn with<L: Letter>(
        scheme: &str,
        (kinetic, parts): (Option<&'static str>, u32),
        series: &ModifiedHamiltonian<L>,
        digits: usize,
    ) -> Self {
        let term = |(power, bracket, c): (u32, &Bracket<L>, &Rational)| SeriesTerm {
            power,
            bracket: bracket.to_string(),
            coefficient: coefficient(c, digits),
        };
        let terms = series.all().map(term).collect();
        SeriesRecord { scheme: scheme.to_owned(), kinetic, parts, exact: series.digits.is_none(), terms }
    }
}

fn coefficient(c: &Rational, digits: usize) -> String {
    let fraction = c.to_string();
    let is_short = fraction.trim_start_matches('-').split('/').all(|part| part.len() <= SHORT);
    if is_short { fraction } else { to_significant(c, digits) }
}

/// The formulas of a scheme's modified Hamiltonian for a system.
#[derive(Clone, Debug, Serialize)]
pub struct FormulaRecord {
    /// The scheme.
    pub scheme: String,
    /// H
    pub hamiltonian: String,
    /// H_2, H_3, …, but those that are 0.
    pub terms: Vec<FormulaTerm>,
    /// The names of coordinates, momenta and parameters in them, as the system has them and as they are written: others
    /// where these are [reserved](crate::document::reserved_names) in the language of the notation.
    #[serde(skip)]
    pub names: Vec<(String, String)>,
    /// The lowest power of h whose term may not be 0 and is left out.
    #[serde(skip)]
    pub remainder: u32,
}

/// The formula of a term.
#[derive(Clone, Debug, Serialize)]
pub struct FormulaTerm {
    /// The power n of h, of H_(n+1).
    pub power: u32,
    /// H_(n+1)
    pub formula: String,
}

/// The formulas of a scheme's modified Hamiltonian for a system, derived once, to be written in several notations.
pub struct Formulas {
    scheme: String,
    symbolic: SymbolicHamiltonian,
    hamiltonian: Node,
    terms: Vec<SymbolicTerm>,
    remainder: u32,
}

impl Formulas {
    /// The formulas up to a power of h.
    ///
    /// # Errors
    /// A system without formulas, a scheme that is not for it, too many parts of formulas.
    pub fn of(system: &System, scheme: &NamedScheme, grade: u32) -> Result<Self, Refusal> {
        let scheme = system.needs().scheme(scheme.clone(), &Default::default())?;
        let mut symbolic = SymbolicHamiltonian::of(system)?;
        let terms = symbolic.modified(scheme.scheme.proved(), grade)?;
        let hamiltonian = symbolic.hamiltonian();
        let remainder = remainder(scheme.scheme.proved(), grade);
        let scheme = scheme.scheme.proved().scheme.table.name.value.clone();
        Ok(Formulas { scheme, symbolic, hamiltonian, terms, remainder })
    }

    /// Their texts; numbers that are no short fractions have this number of significant digits.
    ///
    /// # Errors
    /// A formula that is too long.
    pub fn written(&self, notation: Notation, digits: usize) -> Result<FormulaRecord, Refusal> {
        let Formulas { scheme, symbolic, hamiltonian, terms, remainder } = self;
        let names = symbolic.names()?;
        let written = match notation {
            Notation::Rust => Language::Rust.free(&names),
            Notation::NumPy => Language::Python.free(&names),
            Notation::Formula | Notation::Latex => names.clone(),
        };
        let in_formulas = written.split_at(symbolic.dimension());
        let nodes: Vec<_> = terms.iter().map(|term| term.formula).chain([*hamiltonian]).collect();
        let formula = |term: &SymbolicTerm| {
            Ok(FormulaTerm { power: term.power, formula: symbolic.text(term.formula, notation, in_formulas, digits)? })
        };
        Ok(FormulaRecord {
            scheme: scheme.clone(),
            hamiltonian: symbolic.text(*hamiltonian, notation, in_formulas, digits)?,
            terms: terms.iter().map(formula).collect::<Result<_, Refusal>>()?,
            names: symbolic.places_in(&nodes).into_iter().map(|i| (names[i].clone(), written[i].clone())).collect(),
            remainder: *remainder,
        })
    }
}

impl FormulaRecord {
    /// H + h^2 H_3 + … + O(…)
    pub fn title(&self) -> String {
        sum_of(self.terms.iter().map(|term| term.power), self.remainder)
    }

    /// A function of h, positions, momenta and parameters in the notation of the formulas, which is that of Rust or
    /// NumPy.
    pub fn function(&self, title: &str, notation: Notation) -> String {
        let FormulaRecord { hamiltonian, terms, names, .. } = self;
        let others = names.iter().filter(|(own, written)| own != written);
        let others: String = others.map(|(own, written)| format!("; {written} is {own} of the problem")).collect();
        // of a path, which may have what ends a comment or a text
        let title = format!("{title}{others}").replace(|c: char| c.is_control() || c == '"' || c == '\\', "/");
        let names = names.iter().map(|(_, written)| written);
        match notation {
            Notation::Rust => {
                let names: String = names.map(|name| format!(", {name}: f64")).collect();
                let lines: String = terms
                    .iter()
                    .map(|term| format!("    total += h.powi({})*({});\n", term.power, term.formula))
                    .collect();
                format!(
                    "/// {title}\npub fn modified_hamiltonian(h: f64{names}) -> f64 {{\n    let mut total = \
                        {hamiltonian};\n{lines}    total\n}}\n"
                )
            }
            _ => {
                let lines: String =
                    terms.iter().map(|term| format!("    total += h**{}*({})\n", term.power, term.formula)).collect();
                let names: String = names.map(|name| format!(", {name}")).collect();
                format!(
                    "import numpy as np\n\n\ndef modified_hamiltonian(h{names}):\n    \"\"\"{title}\"\"\"\n    total \
                        = {hamiltonian}\n{lines}    return total\n"
                )
            }
        }
    }
}

/// The lowest power of h whose term may not be 0, of those above `grade`: of a symmetric scheme odd powers are 0.
pub fn remainder(proved: &Proved, grade: u32) -> u32 {
    let is_even = proved.proof.symmetric && proved.scheme.table.processor.is_none();
    if is_even { (grade + 2) / 2 * 2 } else { grade + 1 }
}

/// H + h^2 H_3 + … + O(…) with terms of these powers.
pub fn sum_of(powers: impl Iterator<Item = u32>, remainder: u32) -> String {
    let term = |n: u32| if n == 1 { " + h H_2".to_owned() } else { format!(" + h^{n} H_{}", n + 1) };
    format!("H{} + O(h^{remainder})", powers.map(term).collect::<String>())
}
