//! A certificate as a file of Lean 4 with Mathlib: the weights, the coefficients of the words, and a theorem for each
//! condition.
//!
//! Rational conditions are left to `norm_num`. Those in roots are sums of the roots' equations with factors that are
//! computed here, so that `linear_combination` has only an identity of polynomials to check.

use num_traits::{One, Signed};
use shadowstep_analysis::certificate::{Certificate, Kind, Polynomial, Root};
use shadowstep_scenes::Error;
use shadowstep_scenes::readable::wrapped_to;
use shadowstep_schemes::order::{Condition, Functional, letter};
use shadowstep_schemes::{MapKind, Proved};

use super::formula;

/// The most products of weights that are written, in all conditions together.
const MOST_PRODUCTS: usize = 500;

/// Characters in a line.
const WIDTH: usize = 100;

/// What else can be had.
const JSON: &str = "its certificate is written with --to json";

/// The file of a certificate.
///
/// # Errors
/// Decimals meet no equation; formulas of very many products.
pub(super) fn text(proved: &Proved, certificate: &Certificate) -> Result<String, Error> {
    let name = &proved.scheme.table.name.value;
    let roots = match &certificate.kind {
        Kind::Exact => &[][..],
        Kind::Algebraic(roots) => roots,
        Kind::Decimal(_) => &[],
    };
    let conditions = certificate.cofactors().ok_or_else(|| {
        let proof = if certificate.enclosure.is_some() { "an enclosure of a solution" } else { "a bound for decimals" };
        Error::usage(format!("the proof of {name} is {proof}, and Lean is given equations only"), JSON)
    })?;
    let file = File { certificate, roots, arguments: arguments(roots), maps: named(certificate, roots) };
    let products: usize =
        conditions.iter().map(|(condition, _)| formula::products(word(condition), file.maps.len())).sum();
    if products > MOST_PRODUCTS {
        let message = format!(
            "the conditions of {name} have some {products} products of weights, and Lean is given {MOST_PRODUCTS} at most"
        );
        return Err(Error::usage(message, JSON));
    }
    let import = if roots.is_empty() { "" } else { "import Mathlib.Data.Real.Basic\n" };
    let begin = if roots.is_empty() { "" } else { "noncomputable section\n\n" };
    let mut text = format!("{import}import Mathlib.Tactic\n\n{}\n", head(proved, certificate, roots));
    text += &format!("{begin}namespace Shadowstep.«{name}»\n\n{}", file.weights());
    text.extend(conditions.iter().map(|(condition, factors)| file.condition(condition, factors)));
    text += &format!("{}\nend Shadowstep.«{name}»\n", file.order(&conditions));
    Ok(text)
}

/// What the file is about.
fn head(proved: &Proved, certificate: &Certificate, roots: &[Root]) -> String {
    let (table, order) = (&proved.scheme.table, certificate.order);
    let or_none = |text: &Option<String>| text.clone().unwrap_or_else(|| "none".to_owned());
    let what = if proved.scheme.processor.is_some() { "The kernel of " } else { "" };
    let factors: Vec<_> = certificate
        .maps
        .iter()
        .zip(named(certificate, &[]))
        .map(|((kind, _), (_, name))| format!("exp(h {name} {})", letter(*kind)))
        .collect();
    let of_roots = match roots {
        [] => String::new(),
        _ => format!(
            "The weights are polynomials in real numbers with {}. The conditions hold for all such numbers; the table \
                has one choice of them.",
            (0..roots.len()).map(|place| equation(roots, place)).collect::<Vec<_>>().join(" and ")
        ),
    };
    let paragraphs = [
        format!("# {what}{} has order {order} for every T(p)", table.name.value),
        format!(
            "Written by `shadowstep schemes prove {} --to lean`. Source: {}, doi {}.",
            table.name.value,
            or_none(&table.reference),
            or_none(&table.doi)
        ),
        format!(
            "With H = T(p) + U(q), K is the Lie derivative of the kick and D that of the drift. A step is the \
                product, in the order in which the maps act, {}. \
            The exact motion is exp(h (K + D)). Order {order} means that a step differs from it by O(h^{}). It does \
            so if, for each Lyndon word of m ≤ {order} letters K \
            and D, the coefficient of the word in the product is 1/m! (Murua & Sanz-Serna 1999). Each theorem is the \
            condition of a word; \
            that the formulas are the coefficients of the words is for the reader to see, and not part of the \
            theorems.",
            factors.join(" "),
            order + 1
        ),
        format!(
            "A formula sums over the maps in which the runs of equal letters of a word begin. A run of q letters has \
                (S^q − S'^q)/q!, S the sum of the weights from the map in which it begins to the next run, S' without \
                that map; \
            the first run has S^q/q! with all weights before the second. {of_roots}"
        ),
    ];
    let wrapped: Vec<_> =
        paragraphs.iter().map(|text| wrapped_to(&text.replace("-/", "- /").replace("/-", "/ -"), "", WIDTH)).collect();
    format!("/-!\n{}-/\n", wrapped.join("\n"))
}

/// A certificate with the names of what is in it.
struct File<'a> {
    certificate: &'a Certificate,
    roots: &'a [Root],
    /// ` (x : ℝ)`
    arguments: String,
    maps: Vec<(MapKind, String)>,
}

impl File<'_> {
    fn number(&self) -> &'static str {
        if self.roots.is_empty() { "ℚ" } else { "ℝ" }
    }

    /// The definitions of the weights.
    fn weights(&self) -> String {
        let define = |((_, weight), (kind, name)): (&(MapKind, Polynomial), &(MapKind, String))| {
            let name = name.split(' ').next().unwrap_or(name);
            definition(
                &format!("def {name}{} : {} :=", self.arguments, self.number()),
                &polynomial(weight, self.roots),
                &format!("The weight of a {kind}."),
            )
        };
        self.certificate.maps.iter().zip(&self.maps).map(define).collect()
    }

    /// The coefficient of a word, and the theorem that it is what is needed.
    fn condition(&self, condition: &Condition, factors: &[Polynomial]) -> String {
        let word = word(condition);
        let (name, applied) = (spelled(word), self.applied(word));
        let formula = formula::coefficient(word, &self.maps);
        let coefficient = definition(
            &format!("def coefficient_{name}{} : {} :=", self.arguments, self.number()),
            &formula,
            &format!("The coefficient of {name}."),
        );
        let mut unfolded = vec![format!("coefficient_{name}")];
        unfolded.extend(
            self.maps
                .iter()
                .map(|(_, name)| name.split(' ').next().unwrap_or(name).to_owned())
                .filter(|name| has(&formula, name)),
        );
        let proof = match self.roots {
            [] => wrapped_to(&format!("norm_num [{}]", unfolded.join(", ")), "  ", WIDTH),
            roots => {
                let parts: Vec<_> = used(factors)
                    .map(|place| format!("({}) * h{}", polynomial(&factors[place], roots), variable(roots, place)))
                    .collect();
                let last = if parts.is_empty() {
                    "ring".to_owned()
                } else {
                    format!("linear_combination {}", parts.join(" + "))
                };
                wrapped_to(&format!("unfold {}", unfolded.join(" ")), "  ", WIDTH) + &indented(&last)
            }
        };
        let hypotheses: String = used(factors).map(|place| hypothesis(self.roots, place)).collect();
        let statement =
            format!("theorem condition_{name}{}{hypotheses} : {applied} = {} := by", self.arguments, condition.needed);
        format!("{coefficient}{}{proof}\n", indented(&statement).trim_start())
    }

    /// The theorem of all conditions.
    fn order(&self, conditions: &[(Condition, Vec<Polynomial>)]) -> String {
        let order = self.certificate.order;
        let all: Vec<_> = conditions
            .iter()
            .map(|(condition, _)| format!("{} = {}", self.applied(word(condition)), condition.needed))
            .collect();
        let proof = |(condition, factors): &(Condition, Vec<Polynomial>)| {
            let variables = (0..self.roots.len()).map(|place| format!(" {}", variable(self.roots, place)));
            let hypotheses = used(factors).map(|place| format!(" h{}", variable(self.roots, place)));
            format!("condition_{}{}", spelled(word(condition)), variables.chain(hypotheses).collect::<String>())
        };
        let proofs: Vec<_> = conditions.iter().map(proof).collect();
        let is_used = |place: &usize| conditions.iter().any(|(_, factors)| !factors[*place].is_empty());
        let hypotheses: String =
            (0..self.roots.len()).filter(is_used).map(|place| hypothesis(self.roots, place)).collect();
        let comment = format!("/-- All conditions up to order {order}. -/\n");
        format!(
            "{comment}theorem order_{order}{}{hypotheses} :\n    {} :=\n  ⟨{}⟩\n",
            self.arguments,
            all.join(" ∧\n    "),
            proofs.join(",\n    ")
        )
    }

    /// `coefficient_KD x`
    fn applied(&self, word: &[MapKind]) -> String {
        format!("coefficient_{}{}", spelled(word), variables(self.roots))
    }
}

/// A definition with its comment.
fn definition(begin: &str, value: &str, comment: &str) -> String {
    let line = format!("{begin} {value}");
    let lines =
        if line.chars().count() <= WIDTH { format!("{line}\n") } else { format!("{begin}\n{}", indented(value)) };
    format!("/-- {comment} -/\n{lines}\n")
}

/// A term that goes on further to the right than it begins, as Lean has it; lines end after + and −.
fn indented(term: &str) -> String {
    let together = term.replace(' ', "~").replace("~+~", "~+ ").replace("~-~", "~- ").replace(")~(h", ") (h");
    let lines = wrapped_to(&together, "    ", WIDTH).replace('~', " ");
    format!("  {}", lines.trim_start())
}

/// The names of the maps, with the roots that they depend on: `a1 x` for kicks, `b1 x` for drifts.
fn named(certificate: &Certificate, roots: &[Root]) -> Vec<(MapKind, String)> {
    let mut counts = [0, 0];
    let mut name = |kind: MapKind| {
        let (count, letter) = if kind == MapKind::Kick { (&mut counts[0], 'a') } else { (&mut counts[1], 'b') };
        *count += 1;
        format!("{letter}{count}{}", variables(roots))
    };
    certificate.maps.iter().map(|(kind, _)| (*kind, name(*kind))).collect()
}

fn word(condition: &Condition) -> &[MapKind] {
    match &condition.functional {
        Functional::Word(word) => word,
        Functional::Named(_) => unreachable!("the conditions for every T(p) are of words"),
    }
}

fn spelled(word: &[MapKind]) -> String {
    word.iter().copied().map(letter).collect()
}

/// Whether a name stands in a formula.
fn has(formula: &str, name: &str) -> bool {
    formula.split(|c: char| !c.is_alphanumeric()).any(|part| part == name)
}

/// The equations with a factor.
fn used(factors: &[Polynomial]) -> impl Iterator<Item = usize> {
    factors.iter().enumerate().filter(|(_, factor)| !factor.is_empty()).map(|(place, _)| place)
}

/// x, or x1, x2, …
fn variable(roots: &[Root], place: usize) -> String {
    if roots.len() == 1 { "x".to_owned() } else { format!("x{}", place + 1) }
}

fn variables(roots: &[Root]) -> String {
    (0..roots.len()).map(|place| format!(" {}", variable(roots, place))).collect()
}

/// ` (x : ℝ)`
fn arguments(roots: &[Root]) -> String {
    if roots.is_empty() { String::new() } else { format!(" ({} : ℝ)", variables(roots).trim_start()) }
}

/// `x ^ 3 = 2`
fn equation(roots: &[Root], place: usize) -> String {
    let root = &roots[place];
    format!("{} ^ {} = {}", variable(roots, place), root.power, polynomial(&root.of, roots))
}

/// ` (hx : x ^ 3 = 2)`
fn hypothesis(roots: &[Root], place: usize) -> String {
    format!(" (h{} : {})", variable(roots, place), equation(roots, place))
}

/// A polynomial, high powers first.
fn polynomial(polynomial: &Polynomial, roots: &[Root]) -> String {
    let mut text = String::new();
    for (exponents, value) in polynomial.iter().rev() {
        let powers = exponents.iter().enumerate().filter(|(_, e)| **e > 0).map(|(place, e)| match e {
            1 => variable(roots, place),
            e => format!("{} ^ {e}", variable(roots, place)),
        });
        let size = value.abs();
        let number = (exponents.is_empty() || !size.is_one()).then(|| size.to_string());
        let term = number.into_iter().chain(powers).collect::<Vec<_>>().join(" * ");
        text += match (text.is_empty(), value.is_negative()) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        text += &term;
    }
    if text.is_empty() { "0".to_owned() } else { text }
}
