//! What all targets fill their templates with: names, weights, the step, provenance, what the self-test expects.

use shadowstep_schemes::counted;

use crate::emit::provenance;
use crate::emit::reference::{self, HALVINGS, STEPS, State, TIME, TOLERANCE};
use crate::emit::step::{Action, Step, Weight};
use crate::emit::template::Values;

/// How a language writes what a step is made of.
pub(crate) struct Language {
    /// The sign of a comment to the end of the line.
    pub(crate) comment: &'static str,
    /// A constant, without its comment.
    pub(crate) constant: fn(&Weight) -> String,
    /// A double.
    pub(crate) literal: fn(f64) -> String,
    /// What is done for an action, in the given direction.
    pub(crate) action: fn(Action<'_>, Direction) -> String,
}

/// Which way an action goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    Forward,
    /// As of a pre-map, which undoes the post-map.
    Back,
}

impl Direction {
    /// The sign of what a kick or a drift adds, which it has going forward.
    pub(crate) fn signed(self, sign: char) -> char {
        match (self, sign) {
            (Direction::Forward, sign) => sign,
            (Direction::Back, '+') => '-',
            (Direction::Back, _) => '+',
        }
    }

    /// `h` or `-h`
    pub(crate) fn step_size(self) -> &'static str {
        if self == Direction::Forward { "h" } else { "-h" }
    }
}

/// The letters of weights and what these do.
const MEANINGS: [(char, &str); 5] = [
    ('a', "kicks: p -= h a U_q(q)"),
    ('c', "gradient kicks: p += 2 h^3 c U_qq(q) v, v = M^-1 U_q(q)"),
    ('b', "drifts: q += h b T_p(p)"),
    ('x', "kicks of the post-map; those of the pre-map have -x"),
    ('y', "drifts of the post-map; those of the pre-map have -y"),
];

impl Language {
    /// The values of a scheme.
    pub(crate) fn values(&self, step: &Step<'_>) -> Values {
        let mut values = Values::default();
        let identifier = step.identifier();
        values
            .text("name", step.name())
            .text("IDENTIFIER", identifier.to_uppercase())
            .text("identifier", identifier)
            .lines("provenance", provenance::lines(step, self.comment))
            .text("cost", provenance::cost(step))
            .text("evaluations", counted(step.proved.plan.evaluations, "force evaluation"))
            .lines("weights", self.weights(step))
            .lines("step", self.statements(&step.actions(), Direction::Forward))
            .lines("pre", self.statements(&step.pre(), Direction::Back))
            .lines("post", self.statements(&step.post(), Direction::Forward))
            .condition("processed", step.is_processed())
            .condition("gradient_kicks", step.has_gradient_kicks())
            .condition("kept", step.kept.gradient)
            .condition("kept_gradient", step.kept.gradient && !step.kept.curvature)
            .condition("kept_curvature", step.kept.curvature)
            .condition("every_kinetic", step.proved.holds_for_every_kinetic());
        self.add_expectations(step, &mut values);
        values
    }

    /// What the self-test expects.
    fn add_expectations(&self, step: &Step<'_>, values: &mut Values) {
        let order = step.order();
        let run = reference::order_run(step.scheme, order);
        let coarse = run.map_or(0, |run| run.steps);
        values
            .text("count", STEPS.to_string())
            .text("h", (self.literal)(0.5_f64.powi(HALVINGS as i32)))
            .text("part", format!("1/{}", 1 << HALVINGS))
            .text("tolerance", TOLERANCE)
            .text("order", order.to_string())
            .condition("order_shows", run.is_some())
            .text("time", TIME.to_string())
            .text("coarse", coarse.to_string())
            .text("fine", (2 * coarse).to_string());
        let [end_q, end_p] = self.halves(reference::end(step.scheme));
        let [exact_q, exact_p] = self.halves(run.map_or([0.0; 4], |run| run.exact));
        values.text("end_q", end_q).text("end_p", end_p).text("exact_q", exact_q).text("exact_p", exact_p);
    }

    /// q and p of a state, with commas.
    fn halves(&self, state: State) -> [String; 2] {
        [0, 2].map(|first| format!("{}, {}", (self.literal)(state[first]), (self.literal)(state[first + 1])))
    }

    /// The constants, with a comment on each kind.
    fn weights(&self, step: &Step<'_>) -> Vec<String> {
        let all = || step.weights.iter().chain(&step.post_weights);
        let of_kind = |(letter, meaning): (char, &str)| {
            let weights: Vec<_> =
                all().filter(|weight| weight.name.starts_with(letter)).map(|weight| self.constant(weight)).collect();
            let heading = (!weights.is_empty()).then(|| format!("{} {meaning}", self.comment));
            heading.into_iter().chain(weights)
        };
        MEANINGS.into_iter().flat_map(of_kind).collect()
    }

    fn constant(&self, weight: &Weight) -> String {
        let comment = weight.comment().map_or(String::new(), |comment| format!("  {} {comment}", self.comment));
        format!("{}{comment}", (self.constant)(weight))
    }

    fn statements(&self, actions: &[Action<'_>], direction: Direction) -> Vec<String> {
        actions.iter().map(|action| (self.action)(*action, direction)).filter(|line| !line.is_empty()).collect()
    }
}

/// `NAME = value`, as several languages write it.
pub(crate) fn plain_constant(weight: &Weight) -> String {
    format!("{} = {}", weight.name, weight.literal())
}

/// The actions of a target that has weights only.
pub(crate) fn no_action(_: Action<'_>, _: Direction) -> String {
    String::new()
}
