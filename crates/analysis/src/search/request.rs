//! The file of a search: what the schemes shall be, and what shall be small.

use shadowstep_schemes::claims::{HIGHEST_ORDER, Kinetic};
use shadowstep_schemes::document::{Faults, Key, Keys, Reader, Section, Value, document};
use shadowstep_schemes::{First, Source};
use toml::de::DeValue;

use crate::search::measure::{MEASURES, Measure};

/// What is searched for.
#[derive(Clone, Debug)]
pub struct Request {
    /// The tables are called NAME-1, NAME-2, ….
    pub name: String,
    /// The order.
    pub order: u32,
    /// The kinetic energies that the schemes are for.
    pub kinetic: Kinetic,
    /// The numbers of stages: of drifts or kicks that stand between others, or of γ's.
    pub stages: Vec<usize>,
    /// The base of a composition; `None` for kicks and drifts.
    pub base: Option<String>,
    /// What a step of kicks and drifts begins with.
    pub first: First,
    /// Whether the weights are a palindrome.
    pub symmetric: bool,
    /// Whether each kick has a gradient kick.
    pub gradient_kicks: bool,
    /// The orders for A + εB with the flow of A as drift, as they are written; empty for none.
    pub near_integrable: Vec<u32>,
    /// The stages of the post-map of a processed scheme, whose orders are those after processing; `None` for no
    /// processor.
    pub processor: Option<usize>,
    /// The intervals of instability near hω = π, 2π, … that are closed; `None` for those that the goal needs.
    pub closed_gaps: Option<usize>,
    /// No weight is larger.
    pub largest_weight: f64,
    /// What shall be small.
    pub goal: Goal,
    /// Random starts for each number of stages.
    pub starts: usize,
    /// The seed of the random numbers.
    pub seed: u64,
    /// How many schemes are kept, at most.
    pub keep: usize,
}

/// What shall be small.
#[derive(Clone, Debug, PartialEq)]
pub enum Goal {
    /// Σ weight·measure
    Sum(Vec<(Measure, f64)>),
    /// Several measures, none of them more important: the schemes that no other one surpasses in all.
    Front(Vec<Measure>),
}

impl Goal {
    /// The measures.
    pub fn measures(&self) -> Vec<Measure> {
        match self {
            Goal::Sum(weighed) => weighed.iter().map(|(measure, _)| *measure).collect(),
            Goal::Front(measures) => measures.clone(),
        }
    }
}

const KEYS: [Key; 17] = [
    Key::new("name", "\"rkn4\""),
    Key::new("order", "4"),
    Key::new("kinetic", "\"quadratic\""),
    Key::new("stages", "6"),
    Key::new("base", "\"stormer-verlet\""),
    Key::new("first", "\"kick\""),
    Key::new("symmetric", "true"),
    Key::new("gradient_kicks", "false"),
    Key::new("near_integrable", "[8, 4]"),
    Key::new("processor", "6"),
    Key::new("closed_gaps", "1"),
    Key::new("largest_weight", "1"),
    Key::new("minimise", "\"effective-error\""),
    Key::new("front", "[\"effective-error\", \"instability\"]"),
    Key::new("starts", "100"),
    Key::new("seed", "1"),
    Key::new("keep", "3"),
];

/// The most stages: the conditions of more take long, and local minima are too many.
const MOST_STAGES: usize = 40;

const MOST_STARTS: usize = 1_000_000;

impl Request {
    /// How many intervals of instability are closed for a step of this number of evaluations: the sampling error, a
    /// maximum over 0 < hω < evaluations, is infinite in those that are not.
    pub(super) fn closed_gaps_at(&self, evaluations: usize) -> usize {
        let needed = || match self.goal.measures().contains(&Measure::SamplingError) {
            // where the phase is ahead, they are a little before the multiples of π
            true => (1.1 * evaluations as f64 / std::f64::consts::PI) as usize,
            false => 0,
        };
        self.closed_gaps.unwrap_or_else(needed)
    }

    /// Reads the file of a search.
    ///
    /// # Errors
    /// All faults of the text: of the TOML, unknown or missing keys, values of the wrong kind, and what cannot be
    /// together.
    ///
    /// ```
    /// use shadowstep_analysis::search::Request;
    /// use shadowstep_schemes::{First, Source};
    ///
    /// let text = "order = 4\nkinetic = \"quadratic\"\nstages = 6\nminimise = \"effective-error\"\n";
    /// let request = Request::read(&Source { path: "rkn4.toml".into(), text: text.into() })?;
    /// assert_eq!((request.name.as_str(), request.starts), ("rkn4", 100));
    /// # Ok::<(), shadowstep_schemes::document::Faults>(())
    /// ```
    pub fn read(source: &Source) -> Result<Request, Faults> {
        let (document, faults) = document(source);
        let Some(document) = document else { return Err(Faults(faults)) };
        let mut reader = Reader::new(source, faults);
        let root = reader.table(&document, 0..0, Keys::new("the file of a search", KEYS));
        let request = read(&mut reader, &root);
        match request {
            Some(request) if reader.faults.is_empty() => Ok(request),
            _ => Err(Faults(reader.faults)),
        }
    }
}

fn read(reader: &mut Reader<'_>, root: &Section<'_, '_>) -> Option<Request> {
    let order = reader.required(root, "order").and_then(|value| reader.whole(value, 1..=HIGHEST_ORDER, "an order"));
    let kinetic = reader.required(root, "kinetic");
    let kinetic =
        kinetic.and_then(|value| reader.word(value, &[("any", Kinetic::Any), ("quadratic", Kinetic::Quadratic)]));
    let stages = reader.required(root, "stages").and_then(|value| stages(reader, value));
    let goal = goal(reader, root);
    for key in ["gradient_kicks", "first"] {
        if let Some((value, _)) = root.get(key).zip(root.get("base")) {
            let hint = "leave one of the two out: a composition is made of steps of its base";
            reader.fault(&value.span(), format!("`{key}` is not for a composition"), hint);
        }
    }
    let words = [("kick", First::Kick), ("drift", First::Drift)];
    let name = root.get("name").map(|value| reader.text(value).map(|name| name.value));
    let base = root.get("base").map(|value| reader.text(value).map(|base| Some(base.value)));
    let first = root.get("first").map(|value| reader.word(value, &words).map(|first| first.value));
    let mut truth = |key: &str| root.get(key).map(|value| reader.truth(value).map(|truth| truth.value));
    let (symmetric, gradient_kicks) = (truth("symmetric"), truth("gradient_kicks"));
    let near_integrable = root.get("near_integrable").map(|value| {
        let order = |reader: &mut Reader<'_>, value: &Value<'_>| reader.whole(value, 1..=40, "an order");
        let orders = reader.list(value, "a list of orders, such as [8, 4]", order)?;
        Some(orders.value.into_iter().map(|order| order.value).collect())
    });
    let processor = root.get("processor");
    let processor = processor
        .map(|value| reader.whole(value, 1..=MOST_STAGES, "a number of stages").map(|stages| Some(stages.value)));
    let closed_gaps = root.get("closed_gaps");
    let closed_gaps =
        closed_gaps.map(|value| reader.whole(value, 0..=9, "a number of intervals").map(|gaps| Some(gaps.value)));
    let largest_weight = root.get("largest_weight").map(|value| factor(reader, value, "the largest weight"));
    let seed = root.get("seed").map(|value| reader.whole(value, 0..=u64::MAX / 2, "a seed").map(|seed| seed.value));
    let mut number = |key: &str, most: usize, what: &str| {
        root.get(key).map(|value| reader.whole(value, 1..=most, what).map(|number| number.value))
    };
    let (starts, keep) =
        (number("starts", MOST_STARTS, "a number of starts"), number("keep", 1000, "a number of schemes"));
    Some(Request {
        name: name.unwrap_or_else(|| Some(file_stem(&reader.source.path)))?,
        order: order?.value,
        kinetic: kinetic?.value,
        stages: stages?,
        base: base.unwrap_or(Some(None))?,
        first: first.unwrap_or(Some(First::Kick))?,
        symmetric: symmetric.unwrap_or(Some(true))?,
        gradient_kicks: gradient_kicks.unwrap_or(Some(false))?,
        near_integrable: near_integrable.unwrap_or(Some(Vec::new()))?,
        processor: processor.unwrap_or(Some(None))?,
        closed_gaps: closed_gaps.unwrap_or(Some(None))?,
        largest_weight: largest_weight.unwrap_or(Some(1.0))?,
        goal: goal?,
        starts: starts.unwrap_or(Some(100))?,
        seed: seed.unwrap_or(Some(1))?,
        keep: keep.unwrap_or(Some(3))?,
    })
}

/// The file's name without folders and what follows the first point.
fn file_stem(path: &str) -> String {
    let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
    file.split('.').next().unwrap_or(file).to_lowercase().replace('_', "-")
}

/// A number or a list of numbers.
fn stages(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Vec<usize>> {
    let one = |reader: &mut Reader<'_>, value: &Value<'_>| {
        reader.whole(value, 1..=MOST_STAGES, "a number of stages").map(|stages| stages.value)
    };
    match value.get_ref() {
        DeValue::Array(_) => Some(reader.list(value, "a list of numbers of stages, such as [5, 6]", one)?.value),
        _ => one(reader, value).map(|stages| vec![stages]),
    }
}

fn goal(reader: &mut Reader<'_>, root: &Section<'_, '_>) -> Option<Goal> {
    match (root.get("minimise"), root.get("front")) {
        (Some(_), Some(front)) => {
            reader.wrong(&front.span(), "`minimise` and `front` are both given", "keep one of the two")
        }
        (None, None) => {
            reader.missing(root, &["minimise", "front"]);
            None
        }
        (None, Some(value)) => {
            let measures = reader.list(value, "a list of measures", |reader, value| reader.word(value, &MEASURES))?;
            if measures.value.len() < 2 {
                let hint = "write two or more, or one as `minimise`";
                return reader.wrong(&measures.at, "a front needs several measures", hint);
            }
            Some(Goal::Front(measures.value.into_iter().map(|measure| measure.value).collect()))
        }
        (Some(value), None) => match value.get_ref() {
            DeValue::Table(table) => {
                let words = MEASURES.map(|(name, _)| Key::new(name, "1"));
                let section = reader.table(table, value.span(), Keys::new("`minimise`", words));
                let weighed = MEASURES.iter().filter_map(|(name, measure)| {
                    let value = section.get(name)?;
                    Some(factor(reader, value, "how much the measure counts").map(|factor| (*measure, factor)))
                });
                let weighed = weighed.collect::<Option<Vec<_>>>()?;
                if weighed.is_empty() {
                    return reader.wrong(
                        &section.at,
                        "`minimise` has no measure",
                        "write one such as `effective-error = 1`",
                    );
                }
                Some(Goal::Sum(weighed))
            }
            _ => Some(Goal::Sum(vec![(reader.word(value, &MEASURES)?.value, 1.0)])),
        },
    }
}

/// A positive number.
fn factor(reader: &mut Reader<'_>, value: &Value<'_>, what: &str) -> Option<f64> {
    let text = reader.number(value, "1, 0.25")?;
    match text.value.parse::<f64>() {
        Ok(factor) if factor > 0.0 && factor.is_finite() => Some(factor),
        _ => reader.wrong(
            &text.at,
            format!("{} is not a positive number", text.value),
            format!("write {what}, such as 0.25"),
        ),
    }
}
