//! A table of the coefficients for a paper.

use shadowstep_schemes::{to_significant, to_text};

use crate::emit::language::{Language, no_action, plain_constant};
use crate::emit::provenance;
use crate::emit::step::{Action, Step, Weight, literal};
use crate::emit::text::plain;

const LATEX: Language = Language { comment: "%", constant: plain_constant, literal, action: no_action };

/// The digits of a weight in the table.
const DIGITS: usize = 30;

/// The longest exact number that is printed as it is.
const SHORT: usize = 24;

/// The table.
pub(crate) fn table(step: &Step<'_>) -> String {
    let mut values = LATEX.values(step);
    let table = &step.proved.scheme.table;
    let title = table.title.as_deref().unwrap_or("A splitting scheme");
    let reference = table.reference.as_ref().map_or(String::new(), |reference| format!("{}.", escaped(reference)));
    let doi = table.doi.as_ref().map_or(String::new(), |doi| format!(" doi:{}.", escaped(doi)));
    values
        .text("title", escaped(title))
        .text("reference", format!("{reference}{doi}"))
        .text("proved", in_formulas(&provenance::proved(step)))
        .lines("map", factors(&step.actions()))
        .lines("post_map", factors(&step.post()))
        .lines("rows", step.weights.iter().chain(&step.post_weights).map(row));
    values.fill(include_str!("templates/latex.tex"))
}

/// The maps as exponentials, that which acts first first.
fn factors(actions: &[Action<'_>]) -> Vec<String> {
    let factor = |weight: &Weight, exponent: &str| Some(format!("e^{{{} {exponent}}}\\,\\allowbreak", symbol(weight)));
    let factors = actions.iter().filter_map(|action| match action {
        Action::Kick(weight) => factor(weight, "hK"),
        Action::Drift(weight) => factor(weight, "hD"),
        Action::GradientKick(weight) => factor(weight, "h^3[K,[D,K]]"),
        Action::Gradient | Action::Curvature => None,
    });
    factors.collect()
}

/// `a_{12}`
fn symbol(weight: &Weight) -> String {
    let (letter, index) = weight.name.split_at(1);
    format!("{letter}_{{{index}}}")
}

fn row(weight: &Weight) -> String {
    let exact = to_text(&weight.exact);
    let number = match exact.len() {
        0..=SHORT => exact,
        _ => format!("{}\\dots", to_significant(&weight.exact, DIGITS)),
    };
    format!("${}$ & ${number}$ \\\\", symbol(weight))
}

/// What is proved, with its formulas as such.
fn in_formulas(proved: &str) -> String {
    let formulas =
        [("H = A + εB", r"$H = A + \varepsilon B$"), ("every T(p)", "every $T(p)$"), ("quadratic T", "quadratic $T$")];
    formulas.iter().fold(proved.to_owned(), |text, (formula, in_latex)| text.replace(formula, in_latex))
}

/// Text with what has a meaning in LaTeX escaped.
fn escaped(text: &str) -> String {
    let escape = |letter: char| match letter {
        '&' | '%' | '$' | '#' | '_' | '{' | '}' => format!("\\{letter}"),
        '~' => "\\textasciitilde{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        'ε' => "$\\varepsilon$".to_owned(),
        '²' => "$^2$".to_owned(),
        '³' => "$^3$".to_owned(),
        _ => letter.to_string(),
    };
    plain(text).chars().map(escape).collect()
}
