//! The pages of the documentation on the shipped schemes, one of them all and one for each family, from their tables,
//! proofs and analysis.

use std::fmt::Write as _;

use shadowstep_analysis::Analysis;
use shadowstep_analysis::resonance::resonances;
use shadowstep_analysis::stability::Stability;
use shadowstep_schemes::First;
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::table::{Cell, Table, Weights};
use shadowstep_schemes::{Kinetic, MapKind, Proved, Rational, shipped_names, shipped_proved, to_significant, to_text};

use crate::pages::project_file;
use crate::rational;

/// Digits of a constant that a person reads.
const SHOWN: usize = 25;

const GENERATED: &str = "<!-- Generated from schemes/tables/*.toml; `UPDATE_DOCS=1 cargo test -p shadowstep-tests \
    documentation` writes it. -->\n\n";

/// Schemes that are for the same.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    General,
    Quadratic,
    GradientKicks,
    NearIntegrable,
    Processed,
    MultipleSteps,
}

impl Family {
    const ALL: [Family; 6] = [
        Family::General,
        Family::Quadratic,
        Family::GradientKicks,
        Family::NearIntegrable,
        Family::Processed,
        Family::MultipleSteps,
    ];

    fn of(proved: &Proved) -> Self {
        match &proved.scheme {
            scheme if scheme.inner.is_some() => Family::MultipleSteps,
            scheme if scheme.processor.is_some() => Family::Processed,
            _ if !proved.proof.near_integrable.is_empty() => Family::NearIntegrable,
            scheme if scheme.has_gradient_kicks() => Family::GradientKicks,
            scheme if scheme.table.kinetic == Kinetic::Quadratic => Family::Quadratic,
            _ => Family::General,
        }
    }

    fn title(self) -> &'static str {
        match self {
            Family::General => "For every T(p)",
            Family::Quadratic => "For quadratic T",
            Family::GradientKicks => "With gradient kicks",
            Family::NearIntegrable => "For near-integrable systems",
            Family::Processed => "Processed",
            Family::MultipleSteps => "With multiple time steps",
        }
    }

    /// The file of its page.
    fn file(self) -> &'static str {
        match self {
            Family::General => "general",
            Family::Quadratic => "quadratic",
            Family::GradientKicks => "gradient-kicks",
            Family::NearIntegrable => "near-integrable",
            Family::Processed => "processed",
            Family::MultipleSteps => "multiple-time-steps",
        }
    }

    /// The column that only this family has.
    fn column(self) -> Option<&'static str> {
        match self {
            Family::NearIntegrable => Some("A + εB"),
            Family::Processed => Some("effective"),
            _ => None,
        }
    }

    fn link(self, name: &str) -> String {
        format!("[{name}](schemes/{}.md#{name})", self.file())
    }

    fn head(self) -> String {
        let Some(column) = self.column() else { return COLUMNS.join("\n") + "\n" };
        let [titles, rules] = COLUMNS;
        let titles = titles.replacen("quadratic T |", &format!("quadratic T | {column} |"), 1);
        format!("{titles}\n{rules} --- |\n")
    }
}

const COLUMNS: [&str; 2] = [
    "| name | order | quadratic T | forces | operations | symmetric | effective error | for quadratic T | stable to \
        hω | per force |",
    "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |",
];

/// The pages, each with its file in `docs/`, in Markdown; what stands above the first family is as it was.
pub fn catalogue_pages() -> Vec<(String, String)> {
    let mut schemes: Vec<_> = shipped_names()
        .into_iter()
        .map(|name| {
            let proved = shipped_proved(name).expect("it is listed");
            (name, proved, Analysis::of(proved))
        })
        .collect();
    schemes.sort_by_key(|(_, proved, _)| {
        let quadratic =
            proved.proof.effective.as_ref().map_or(&proved.proof.quadratic, |effective| &effective.quadratic);
        let order = proved.order_for_every_kinetic().unwrap_or(&proved.proof.quadratic).order;
        let order = proved.proof.effective.as_ref().map_or(order, |effective| effective.quadratic.order);
        (order, quadratic.order, proved.plan.degree())
    });
    let page = project_file("docs/schemes.md");
    let first_title = format!("\n## {}\n", Family::ALL[0].title());
    let (head, _) = page.split_once(&first_title).expect("a text that is written by hand, and the first family");
    let mut all = head.to_owned();
    let mut pages = Vec::new();
    for family in Family::ALL {
        let own = || schemes.iter().filter(move |(_, proved, _)| Family::of(proved) == family);
        let title = family.title();
        write!(all, "\n## {title}\n\n").expect("memory suffices");
        let mut page = format!("{GENERATED}# {title}: weights\n\n{WEIGHTS}");
        all += &if family == Family::MultipleSteps { MULTIPLE_STEPS.to_owned() } else { family.head() };
        for (name, proved, analysis) in own() {
            let (row, section) = match family {
                Family::MultipleSteps => (nested_row(name, proved), nested_section(proved)),
                _ => (row(family, name, proved, analysis), section(proved, analysis)),
            };
            all += &row;
            write!(page, "\n## {name}\n\n{section}").expect("memory suffices");
        }
        pages.push((format!("schemes/{}.md", family.file()), page));
    }
    pages.push(("schemes.md".to_owned(), all));
    pages
}

const WEIGHTS: &str = "\
[*The shipped schemes*](../schemes.md) compares them, and explains the terms. Constants are rounded to 25 digits \
here; the tables have 250 of them or closed
forms, and `shadowstep schemes show NAME --json` writes every weight as an exact fraction.
";

const MULTIPLE_STEPS: &str = "\
[Multiple time steps](multiple-time-steps.md), for slow forces, fast forces and T, whose orders are proved for these \
three parts. *resonance*: the first interval of hω in
which an oscillation is unstable that has 1/100 of the stiffness of its fast forces in the slow ones.

| name | order | slow forces | fast forces | outer scheme | inner scheme | resonance |
| --- | --- | --- | --- | --- | --- | --- |
";

fn nested_row(name: &str, proved: &Proved) -> String {
    let inner = proved.scheme.inner.as_ref().expect("it has one");
    let plan = proved.for_many_parts().expect("it has steps of three parts").plan;
    let Some(Weights::Composition { base, .. }) = &proved.scheme.table.weights else {
        unreachable!("the outer scheme is a table of its own")
    };
    let gaps = resonances(proved, &Rational::new(1.into(), 100.into())).expect("it has few maps").gaps;
    let end = |text: &str| to_significant(&rational(text), 5);
    format!(
        "| {} | {} | {} | {} | {} | {} of {} | {} to {} |\n",
        Family::MultipleSteps.link(name),
        proved.order().order,
        plan.evaluations,
        plan.count(MapKind::Drift),
        base.value,
        inner.substeps,
        inner.scheme.table.name.value,
        end(&gaps[0].from),
        end(gaps[0].to.as_ref().expect("it ends"))
    )
}

fn nested_section(proved: &Proved) -> String {
    let table = &proved.scheme.table;
    let inner = table.inner.as_ref().expect("it has one");
    let symmetric = if proved.proof.symmetric { "symmetric" } else { "not symmetric" };
    format!(
        "{}.\n\n```text\n{}inner: {} of {}\n```\n\n- order {} for slow forces, fast forces and T\n- {symmetric}, \
            begins with a slow kick; {}\n- {}\n",
        named(table),
        weights(table),
        inner.substeps,
        inner.base.value,
        proved.order().order,
        held(proved.scheme.held),
        reference(table)
    )
}

/// The title, and the other names.
fn named(table: &Table) -> String {
    let title = table.title.as_deref().unwrap_or(&table.name.value);
    let aliases: Vec<_> = table.aliases.iter().map(|alias| format!("`{}`", alias.value)).collect();
    let also = if aliases.is_empty() { String::new() } else { format!("; also found as {}", aliases.join(", ")) };
    format!("{title}{also}")
}

fn stability(analysis: &Analysis) -> &Stability {
    analysis.stability.as_ref().expect("shipped schemes have few maps")
}

fn row(family: Family, name: &str, proved: &Proved, analysis: &Analysis) -> String {
    let limit: f64 = stability(analysis).limit.parse().expect("it is a number");
    let mut cells = vec![
        family.link(name),
        proved.order_for_every_kinetic().map_or_else(|| "–".to_owned(), |order| order.order.to_string()),
        proved.proof.quadratic.order.to_string(),
        match analysis.hessian_products {
            0 => analysis.evaluations.to_string(),
            products => format!("{} + {products}", analysis.evaluations),
        },
        proved.plan.cost().products_per_dimension.to_string(),
        if proved.proof.symmetric { "yes" } else { "no" }.to_owned(),
        match analysis.hessian_products {
            0 => format!("{:.4}", analysis.effective_error(Kinetic::Any)),
            _ => "–".to_owned(),
        },
        format!("{:.4}", analysis.effective_error(Kinetic::Quadratic)),
        format!("{limit:.5}"),
        format!("{:.3}", limit / proved.plan.degree() as f64),
    ];
    if family.column().is_some() {
        cells.insert(3, effective_or_near_integrable(proved));
    }
    format!("| {} |\n", cells.join(" | "))
}

fn near_integrable(proved: &Proved) -> String {
    let orders: Vec<_> = proved.proof.near_integrable.iter().map(|order| order.order.to_string()).collect();
    if orders.is_empty() { String::new() } else { format!("({})", orders.join(",")) }
}

fn effective_or_near_integrable(proved: &Proved) -> String {
    let Some(effective) = &proved.proof.effective else { return near_integrable(proved) };
    let orders: Vec<_> = effective.near_integrable.iter().map(|order| order.order.to_string()).collect();
    match orders.is_empty() {
        true => effective.general.order.to_string(),
        false => format!("({})", orders.join(",")),
    }
}

/// What is proved of a processed step, and what an output costs.
fn processed(proved: &Proved) -> Option<String> {
    let (processor, effective) = (proved.scheme.processor.as_ref()?, proved.proof.effective.as_ref()?);
    let orders: Vec<_> = effective.near_integrable.iter().map(|order| order.order.to_string()).collect();
    let near = if orders.is_empty() { String::new() } else { format!(", ({}) for A + εB", orders.join(",")) };
    let general = match proved.scheme.has_gradient_kicks() {
        true => String::new(),
        false => format!("{} for every T(p), ", effective.general.order),
    };
    Some(format!(
        "processed: effective order {general}{} for quadratic T{near}; {} evaluations of U_q and {} kicks and drifts \
         for an output, and as many once at the beginning",
        effective.quadratic.order,
        processor.evaluations(),
        processor.post.len()
    ))
}

fn section(proved: &Proved, analysis: &Analysis) -> String {
    let (table, proof) = (&proved.scheme.table, &proved.proof);
    let mut text = format!("{}.\n\n```text\n{}```\n\n", named(table), weights(table));
    let cost = proved.plan.cost();
    let near = match near_integrable(proved) {
        orders if orders.is_empty() => String::new(),
        orders => format!(", {orders} for A + εB"),
    };
    let meant = if table.kinetic == Kinetic::Quadratic { "; meant for quadratic T" } else { "" };
    let first = if proved.scheme.first() == First::Kick { "kick" } else { "drift" };
    let symmetric = if proof.symmetric { "symmetric" } else { "not symmetric" };
    let products = match analysis.hessian_products {
        0 => String::new(),
        1 => ", 1 Hessian–vector product".to_owned(),
        count => format!(", {count} Hessian–vector products"),
    };
    let lines = [
        match proved.order_for_every_kinetic() {
            Some(order) => {
                format!("order {} for every T(p), {} for quadratic T{near}{meant}", order.order, proof.quadratic.order)
            }
            None => format!("order {} for quadratic T, for which it is meant", proof.quadratic.order),
        },
        format!(
            "{} of U_q{products} and {} products and additions per dimension a step, {} more for the modified energy; \
             {symmetric}, begins with a {first}; {}",
            if analysis.evaluations == 1 {
                "1 evaluation".to_owned()
            } else {
                format!("{} evaluations", analysis.evaluations)
            },
            cost.products_per_dimension,
            cost.products_for_beta,
            held(proved.scheme.held)
        ),
        match analysis.hessian_products {
            0 => format!(
                "effective error {:.4} for every T(p), {:.4} for quadratic T",
                analysis.effective_error(Kinetic::Any),
                analysis.effective_error(Kinetic::Quadratic)
            ),
            _ => format!("effective error {:.4} for quadratic T", analysis.effective_error(Kinetic::Quadratic)),
        },
        format!(
            "harmonic oscillator: {}; phase error {:.4e} (hω)^{}",
            stable(stability(analysis)),
            analysis.phase.coefficient,
            analysis.phase.power
        ),
        sampling(analysis),
        reference(table),
    ];
    let lines: Vec<_> = lines.into_iter().filter(|line| !line.is_empty()).collect();
    let lines = lines[..1].iter().cloned().chain(processed(proved)).chain(lines[1..].iter().cloned());
    lines.for_each(|line| text += &format!("- {line}\n"));
    text
}

fn sampling(analysis: &Analysis) -> String {
    let largest = analysis.sampling.and_then(|sampling| Some((sampling.range, sampling.largest?)));
    largest.map_or_else(String::new, |(range, largest)| {
        format!("expected energy error {largest:.3e} over 0 < hω < {range}")
    })
}

fn held(held: Held) -> String {
    match held {
        Held::Exactly => "exact weights".to_owned(),
        Held::Digits(digits) => format!("weights of {digits} digits"),
    }
}

fn stable(stability: &Stability) -> String {
    let mut text = format!("stable to hω = {}", stability.limit);
    let between = stability.gaps.windows(2).filter_map(|pair| Some((pair[0].to.as_ref()?, &pair[1].from)));
    let wide = between.map(|ends| (rational(ends.0), rational(ends.1))).filter(|(a, b)| b - a > rational("0.01"));
    let wide: Vec<_> = wide.map(|(a, b)| format!("{} to {}", to_significant(&a, 8), to_significant(&b, 8))).collect();
    if !wide.is_empty() {
        text += &format!(", again from {}", wide.join(", "));
    }
    text
}

fn reference(table: &Table) -> String {
    let doi = table.doi.as_ref().map(|doi| format!(", [doi:{doi}](https://doi.org/{doi})"));
    format!("{}{}", table.reference.as_deref().expect("shipped tables are published"), doi.unwrap_or_default())
}

/// The weights as the table has them.
fn weights(table: &Table) -> String {
    let cells = |cells: &[Cell]| cells.iter().map(cell).collect::<Vec<_>>().join(", ");
    let mut text = match table.weights.as_ref().expect("it was proved") {
        Weights::Stages { kick, gradient_kick, drift } => {
            let gradient_kick = gradient_kick.as_ref().map(|list| format!("c = {}\n", cells(&list.value)));
            let gradient_kick = gradient_kick.unwrap_or_default();
            format!("a = {}\n{gradient_kick}b = {}\n", cells(&kick.value), cells(&drift.value))
        }
        Weights::Composition { base, gamma } => format!("γ = {}, of {}\n", cells(&gamma.value), base.value),
    };
    match table.processor.as_ref().and_then(|processor| processor.post.as_ref()) {
        Some(Weights::Stages { kick, drift, .. }) => {
            text += &format!("post-map: a = {}\n          b = {}\n", cells(&kick.value), cells(&drift.value));
        }
        Some(Weights::Composition { gamma, .. }) => text += &format!("post-map: γ = {}\n", cells(&gamma.value)),
        None => {}
    }
    for (name, value) in &table.constants {
        let free = table.free.iter().any(|free| free.value == name.value);
        text += &format!("{} = {}{}\n", name.value, cell(value), if free { "  (free parameter)" } else { "" });
    }
    text
}

/// A formula as it is; of a number a few digits.
fn cell(cell: &Cell) -> String {
    if !cell.value.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.' || byte == b'-') {
        return cell.value.clone();
    }
    let value = rational(&cell.value);
    let whole = to_text(&value);
    if whole.len() <= SHOWN + 3 { whole } else { format!("{}…", to_significant(&value, SHOWN)) }
}
