//! The table of a figure: what the paper states, families of runs, and charts.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;
use shadowstep::problems::problem;
use shadowstep::shadow::{EstimatorSettings, StoppingRule};

use crate::claim::{self, ChartTexts};
use crate::figures::estimator::{BEST, best, bilinear, central};
use crate::figures::run::{Run, label};

/// A table `all/NAME.toml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    pub(crate) title: String,
    /// The figure of the paper, such as `figure 3, left`; empty for an additional one.
    #[serde(default)]
    pub(crate) of_paper: String,
    /// What the paper states.
    #[serde(default)]
    pub(crate) stated: Vec<String>,
    /// What an additional figure shows.
    #[serde(default)]
    pub(crate) about: Vec<String>,
    #[serde(default)]
    pub(crate) families: BTreeMap<String, Family>,
    #[serde(default)]
    pub(crate) charts: BTreeMap<String, ChartTexts>,
    /// Drifts that are computed again with 200 digits.
    #[serde(default)]
    pub(crate) held: Vec<Held>,
}

/// Drifts of runs that differ in two values, `c` of the curve and `x` of the point, by which texts are filled: `1/{x}`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Family {
    problem: String,
    #[serde(default = "verlet")]
    scheme: String,
    step: String,
    /// Values of parameters or of the initial state.
    #[serde(default)]
    set: BTreeMap<String, String>,
    /// `best`, or one of `best`, `central`, `bilinear` with an order; `early` and `printed` are stopping rules.
    #[serde(default = "best_text")]
    estimator: String,
    /// The curve's; `{scheme}` stands for the name of the scheme c.
    #[serde(default)]
    label: String,
    /// The values c.
    #[serde(default)]
    curves: Grid,
    /// The values x.
    #[serde(default)]
    points: Grid,
    #[serde(default)]
    at: Place,
}

fn verlet() -> String {
    "stormer-verlet".to_owned()
}

fn best_text() -> String {
    "best".to_owned()
}

/// All values, those of a full and of a quick report, or the name of a grid of several figures.
#[derive(Deserialize)]
#[serde(untagged)]
enum Grid {
    Named(String),
    All(Vec<Word>),
    Either { full: Vec<Word>, quick: Vec<Word> },
}

static GRIDS: LazyLock<BTreeMap<String, Grid>> = LazyLock::new(|| claim::read(include_str!("all/grids.toml")));

impl Default for Grid {
    fn default() -> Self {
        Grid::All(vec![Word::Text(String::new())])
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Word {
    Number(u32),
    Text(String),
}

/// Where points are.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Place {
    /// At x.
    #[default]
    X,
    /// At a part of x.
    Tenths,
    Hundredths,
    Thousandths,
    /// At log₁₀ of the states that an estimate uses.
    States,
}

/// A drift that is computed again with more digits.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Held {
    pub(crate) what: String,
    pub(crate) family: String,
    #[serde(default)]
    pub(crate) c: String,
    #[serde(default)]
    pub(crate) x: String,
}

impl Grid {
    fn values(&self, quick: bool) -> Vec<String> {
        let words = match self {
            Grid::Named(name) => return GRIDS[name].values(quick),
            Grid::All(words) => words,
            Grid::Either { quick: words, .. } if quick => words,
            Grid::Either { full: words, .. } => words,
        };
        let text = |word: &Word| match word {
            Word::Number(number) => number.to_string(),
            Word::Text(text) => text.clone(),
        };
        words.iter().map(text).collect()
    }
}

/// A text in which each `{name}` is its value.
pub(crate) fn filled(text: &str, values: &[(&str, &str)]) -> String {
    values.iter().fold(text.to_owned(), |text, (name, value)| text.replace(&format!("{{{name}}}"), value))
}

impl Family {
    /// The values c.
    pub(crate) fn curves(&self, quick: bool) -> Vec<String> {
        self.curves.values(quick)
    }

    /// The values x.
    pub(crate) fn points(&self, quick: bool) -> Vec<String> {
        self.points.values(quick)
    }

    pub(crate) fn label(&self, c: &str) -> String {
        filled(&self.label, &[("c", c), ("scheme", label(c))])
    }

    /// The run of a point.
    pub(crate) fn run(&self, c: &str, x: &str) -> Run {
        let fill = |text: &str| filled(text, &[("c", c), ("x", x)]);
        let problem = problem(&self.problem).expect("figures have shipped problems");
        let run = Run::of(problem, &fill(&self.scheme), fill(&self.step));
        self.set.iter().fold(run, |run, (name, value)| run.with(name, fill(value)))
    }

    /// The estimator of a point.
    pub(crate) fn estimator(&self, c: &str, x: &str) -> EstimatorSettings {
        let text = filled(&self.estimator, &[("c", c), ("x", x)]);
        let (word, order) = text.split_once(' ').unwrap_or((&text, "200"));
        let order = order.parse().expect("orders are whole numbers");
        match word {
            "central" => central(order),
            "bilinear" => bilinear(order),
            "early" => best(order, StoppingRule::Early),
            "printed" => best(order, StoppingRule::Printed),
            _ if order == 200 => BEST,
            _ => best(order, StoppingRule::Full),
        }
    }

    /// The place of a point.
    pub(crate) fn place(&self, c: &str, x: &str) -> f64 {
        let number = || x.parse::<f64>().expect("x is a number");
        match self.at {
            Place::X => number(),
            Place::Tenths => number() / 10.0,
            Place::Hundredths => number() / 100.0,
            Place::Thousandths => number() / 1000.0,
            Place::States => crate::figures::estimator::states(&self.estimator(c, x)).log10(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::figures::all::FIGURES;

    /// Every name of a family, of a grid and of a problem is known, and every text of an estimator.
    #[test]
    fn every_table_is_read() {
        for figure in &FIGURES {
            let table = figure.table();
            for family in table.families.values() {
                for quick in [true, false] {
                    // a figure may give these itself
                    let given = |words: Vec<String>| words.into_iter().find(|word| !word.is_empty());
                    let c = given(family.curves(quick)).unwrap_or("20".to_owned());
                    let x = given(family.points(quick)).unwrap_or("20".to_owned());
                    assert!(family.run(&c, &x).steps() > 0, "{}", figure.name);
                    let _ = family.estimator(&c, &x);
                }
            }
            assert!(table.held.iter().all(|held| table.families.contains_key(&held.family)), "{}", figure.name);
        }
    }
}
