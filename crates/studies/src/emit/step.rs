//! The plan of a step → what is done one after the other, with names for the weights.

use shadowstep::number::Number;
use shadowstep::tables::TableScheme;
use shadowstep_scenes::reserved_names::Language;
use shadowstep_schemes::map::Stages;
use shadowstep_schemes::{First, Map, MapKind, Proved, Rational, to_significant, to_text};

/// The most letters of an exact number that is written in a comment.
const SHORT: usize = 24;

/// The digits of a longer one: enough for quadruple precision.
const DIGITS: usize = 36;

/// What is done in a step, one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action<'a> {
    /// g ← U_q(q)
    Gradient,
    /// w ← U_qq(q) M⁻¹g
    Curvature,
    /// p ← p − h a g
    Kick(&'a Weight),
    /// p ← p + 2h³ c w
    GradientKick(&'a Weight),
    /// q ← q + h b T_p(p)
    Drift(&'a Weight),
}

/// A constant of the code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Weight {
    /// `a1`, `a2`, … of kicks, `b1`, … of drifts, `c1`, … of gradient kicks; of a post-map `x1`, … and `y1`, …
    pub(crate) name: String,
    pub(crate) exact: Rational,
}

impl Weight {
    /// The nearest double.
    pub(crate) fn double(&self) -> f64 {
        nearest(&self.exact)
    }

    /// The nearest double in as few digits as read back to it.
    pub(crate) fn literal(&self) -> String {
        literal(self.double())
    }

    /// The exact number where that is short, else more digits of it; `None` if they add nothing to the literal.
    pub(crate) fn comment(&self) -> Option<String> {
        let text = to_text(&self.exact);
        if text == self.literal() {
            return None;
        }
        match text.len() {
            0..=SHORT => Some(text).filter(|_| Rational::from_float(self.double()).as_ref() != Some(&self.exact)),
            _ => Some(format!("{}…", to_significant(&self.exact, DIGITS))),
        }
    }
}

/// The nearest double.
pub(crate) fn nearest(exact: &Rational) -> f64 {
    f64::from_rational(exact, &())
}

/// A double in as few digits as read back to it, with a point or an exponent.
pub(crate) fn literal(value: f64) -> String {
    format!("{value:?}")
}

/// A decimal of 36 digits, with a point: for constants of every precision up to the quadruple one.
pub(crate) fn long_decimal(exact: &Rational) -> String {
    let text = to_significant(exact, DIGITS);
    if text.contains(['.', 'e']) { text } else { format!("{text}.0") }
}

/// What is kept from step to step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct KeptForces {
    /// g: the first and the last map are kicks.
    pub(crate) gradient: bool,
    /// w: there are gradient kicks at both ends.
    pub(crate) curvature: bool,
}

const NOTHING: KeptForces = KeptForces { gradient: false, curvature: false };

/// A scheme as the targets need it.
#[derive(Debug)]
pub(crate) struct Step<'a> {
    pub(crate) scheme: &'a TableScheme,
    pub(crate) proved: &'a Proved,
    /// The weights of the step, distinct ones once.
    pub(crate) weights: Vec<Weight>,
    /// The weights of the post-map.
    pub(crate) post_weights: Vec<Weight>,
    pub(crate) kept: KeptForces,
}

impl<'a> Step<'a> {
    pub(crate) fn of(scheme: &'a TableScheme) -> Self {
        let proved = scheme.proved();
        let plan = &proved.plan;
        let runs: Vec<_> = plan.maps.split(|(kind, _)| *kind == MapKind::Drift).collect();
        let has_curvature = |run: Option<&&[(MapKind, usize)]>| {
            run.is_some_and(|run| run.iter().any(|(kind, _)| *kind == MapKind::GradientKick))
        };
        let gradient = plan.keeps_gradient();
        let kept =
            KeptForces { gradient, curvature: gradient && has_curvature(runs.first()) && has_curvature(runs.last()) };
        let named = |letter: char, exact: &[Rational]| {
            let weight = |(index, exact): (usize, &Rational)| Weight {
                name: format!("{letter}{}", index + 1),
                exact: exact.clone(),
            };
            exact.iter().enumerate().map(weight).collect::<Vec<_>>()
        };
        let weights = [('a', &plan.kicks), ('c', &plan.gradient_kicks), ('b', &plan.drifts)];
        let weights = weights.into_iter().flat_map(|(letter, exact)| named(letter, exact)).collect();
        let post = proved.scheme.processor.as_ref().map_or(&[][..], |processor| &processor.post);
        let post_weights = [('x', MapKind::Kick), ('y', MapKind::Drift)];
        let post_weights =
            post_weights.into_iter().flat_map(|(letter, kind)| named(letter, &distinct(post, kind))).collect();
        Step { scheme, proved, weights, post_weights, kept }
    }

    /// The name of the table.
    pub(crate) fn name(&self) -> &str {
        &self.proved.scheme.table.name.value
    }

    /// The name of the table as an identifier: `stormer_verlet`; `scheme_class` where the name is a keyword of a
    /// target, or a module that it has.
    pub(crate) fn identifier(&self) -> String {
        let is_letter = |letter: char| letter.is_ascii_alphanumeric();
        let name: String =
            self.name().chars().map(|c| if is_letter(c) { c.to_ascii_lowercase() } else { '_' }).collect();
        let capitalised = name[..name.len().min(1)].to_uppercase() + name.get(1..).unwrap_or_default();
        let is_reserved =
            Language::Python.reserved().contains(&&*name) || Language::Julia.reserved().contains(&&*capitalised);
        let is_word = name.starts_with(|c: char| c.is_ascii_alphabetic());
        if is_word && !is_reserved { name } else { format!("scheme_{name}") }
    }

    /// Whether it has gradient kicks.
    pub(crate) fn has_gradient_kicks(&self) -> bool {
        !self.proved.plan.gradient_kicks.is_empty()
    }

    /// Whether it is a processed scheme.
    pub(crate) fn is_processed(&self) -> bool {
        !self.post_weights.is_empty()
    }

    /// The actions of a step.
    pub(crate) fn actions(&self) -> Vec<Action<'_>> {
        actions(&self.proved.scheme.maps(), &self.weights, self.kept)
    }

    /// The actions of the post-map.
    pub(crate) fn post(&self) -> Vec<Action<'_>> {
        let processor = self.proved.scheme.processor.as_ref();
        processor.map_or_else(Vec::new, |processor| actions(&processor.post, &self.post_weights, NOTHING))
    }

    /// The actions of the pre-map, whose weights are the negatives of the post-map's; the latter are named.
    pub(crate) fn pre(&self) -> Vec<Action<'_>> {
        let Some(processor) = &self.proved.scheme.processor else { return Vec::new() };
        let backwards: Vec<_> = processor.post.iter().rev().cloned().collect();
        actions(&backwards, &self.post_weights, NOTHING)
    }

    /// The order on which the self-test insists: for quadratic T, as of Kepler's problem, of the processed step where
    /// there is one.
    pub(crate) fn order(&self) -> u32 {
        let proof = &self.proved.proof;
        proof.effective.as_ref().map_or(proof.quadratic.order, |effective| effective.quadratic.order)
    }

    /// The names of the weights of kicks and drifts, which are made in turn.
    pub(crate) fn alternating(&self) -> Vec<&str> {
        fn name(action: Action<'_>) -> Option<&str> {
            match action {
                Action::Kick(weight) | Action::Drift(weight) => Some(&weight.name),
                _ => None,
            }
        }
        self.actions().into_iter().filter_map(name).collect()
    }

    /// Whether its first map is a kick.
    pub(crate) fn begins_with_kick(&self) -> bool {
        self.proved.scheme.first() == First::Kick
    }

    /// The weights of kicks and drifts, stage by stage: in each the kick comes before the drift, and a missing one has
    /// weight 0.
    pub(crate) fn stages(&self) -> [Vec<Rational>; 2] {
        let stages = Stages::of(&self.proved.scheme.maps());
        [stages.kick, stages.drift]
    }
}

/// The distinct weights of a kind, in the order of their first use.
fn distinct(maps: &[Map], kind: MapKind) -> Vec<Rational> {
    let mut found: Vec<Rational> = Vec::new();
    for map in maps.iter().filter(|map| map.kind == kind) {
        if !found.contains(&map.weight) {
            found.push(map.weight.clone());
        }
    }
    found
}

/// The actions that maps are, where the gradient is evaluated when it is needed and not known.
fn actions<'a>(maps: &[Map], weights: &'a [Weight], mut known: KeptForces) -> Vec<Action<'a>> {
    let mut actions = Vec::new();
    for Map { kind, weight } in maps {
        let letters = match kind {
            MapKind::Kick => ['a', 'x'],
            MapKind::GradientKick => ['c', 'c'],
            MapKind::Drift => ['b', 'y'],
        };
        let is = |named: &&Weight| named.name.starts_with(letters) && named.exact == *weight;
        let weight = weights.iter().find(is).expect("every weight has a name");
        if *kind == MapKind::Drift {
            known = NOTHING;
            actions.push(Action::Drift(weight));
            continue;
        }
        if !std::mem::replace(&mut known.gradient, true) {
            actions.push(Action::Gradient);
        }
        if *kind == MapKind::Kick {
            actions.push(Action::Kick(weight));
            continue;
        }
        if !std::mem::replace(&mut known.curvature, true) {
            actions.push(Action::Curvature);
        }
        actions.push(Action::GradientKick(weight));
    }
    actions
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep::tables::{shipped, shipped_names};

    #[test]
    fn a_step_evaluates_what_its_plan_counts() {
        for name in shipped_names() {
            let scheme = shipped(name).unwrap();
            let (step, proved) = (Step::of(&scheme), scheme.proved());
            let count = |wanted: Action<'_>| step.actions().iter().filter(|action| **action == wanted).count();
            assert_eq!(count(Action::Gradient), proved.plan.evaluations, "{name}");
            assert_eq!(count(Action::Curvature), proved.plan.hessian_products, "{name}");
            let maps = step.actions().len() - count(Action::Gradient) - count(Action::Curvature);
            assert_eq!(maps, proved.plan.maps.len(), "{name}");
        }
    }

    #[test]
    fn literals_read_back_to_the_nearest_double() {
        for name in shipped_names() {
            let scheme = shipped(name).unwrap();
            let step = Step::of(&scheme);
            for weight in step.weights.iter().chain(&step.post_weights) {
                let read: f64 = weight.literal().parse().unwrap();
                // no neighbour is nearer
                let distance = |value: f64| {
                    let difference = Rational::from_float(value).unwrap() - &weight.exact;
                    if difference < Rational::from_integer(0.into()) { -difference } else { difference }
                };
                assert!(distance(read) <= distance(read.next_up()), "{name} {}", weight.name);
                assert!(distance(read) <= distance(read.next_down()), "{name} {}", weight.name);
                assert_eq!(long_decimal(&weight.exact).parse(), Ok(read), "{name} {}", weight.name);
            }
        }
    }
}
