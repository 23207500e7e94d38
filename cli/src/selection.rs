//! Arguments → problem, schemes and steps: the runs to make.

use shadowstep::shadow::{EstimatorOptions, EstimatorSettings, check_accuracy};
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::Note;
use shadowstep_scenes::drift::DriftRequest;
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::quantity;
use crate::report;
use crate::run_arguments::{EstimatorArguments, OrderChoice, RunArguments};
use crate::system::Described;
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::estimator::{ACCURACY_HINT, conflict, order_setting};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::propagator::Propagator;
use shadowstep_scenes::run::{OrderSetting, Run};
use shadowstep_scenes::stability::note_of_steps;
use shadowstep_scenes::steps::MOST_STEPS;

/// Everything that is to be run.
#[derive(Debug)]
pub(crate) struct Selection {
    pub(crate) problem: Described,
    pub(crate) until: Rational,
    pub(crate) arithmetic: Arithmetic,
    pub(crate) estimator: EstimatorSettings,
    propagators: Vec<Propagator>,
    /// With the number of steps, or the most where a physical time ends the runs.
    sizes: Vec<(StepSize, u64)>,
}

impl Selection {
    pub(crate) fn read(arguments: &RunArguments) -> Result<Self, Error> {
        let arithmetic = arguments.numbers.arithmetic()?.unwrap_or(Arithmetic::DOUBLE);
        let estimator = estimator(&arguments.estimator)?;
        let problem = Described::read(&arguments.system, arithmetic)?;
        let until = quantity::number("--until", &arguments.until)?;
        refuse_empty("--scheme", &arguments.schemes, "yoshida4,ruth3")?;
        refuse_empty("--step", &arguments.sizes, "1/10,1/20")?;
        let step = |text: &String| {
            let h = quantity::step_size("--step", text)?;
            let count = quantity::steps((&h, text), &until, &problem.system)?;
            Ok::<_, Error>((h, count))
        };
        let steps = arguments.sizes.iter().map(step).collect::<Result<Vec<_>, _>>()?;
        let words = each_once(&arguments.schemes, |word| word.clone(), "scheme");
        let propagators: Vec<_> =
            words.iter().map(|word| Propagator::of_system(word, &problem.system)).collect::<Result<_, _>>()?;
        let steps = each_once(&steps, |(h, _)| to_text(h.exact()), "step");
        let fitted = |propagator: Propagator| {
            let (propagator, note) = propagator.fitted(arithmetic)?;
            let of_name = propagator.scheme().and_then(NamedScheme::note);
            of_name.iter().chain(&note).for_each(report::note);
            Ok(propagator)
        };
        let propagators = propagators.into_iter().map(fitted).collect::<Result<_, Error>>()?;
        let note_of_end = |(h, steps): &(StepSize, Option<u64>)| Note::of_end(h.exact(), (*steps)?, &until);
        steps.iter().filter_map(note_of_end).for_each(report::note);
        let sizes = steps.into_iter().map(|(h, steps)| (h, steps.unwrap_or(MOST_STEPS))).collect();
        let selection = Selection { problem, until, arithmetic, estimator, propagators, sizes };
        if !arguments.no_summary {
            selection.note_large_steps();
        }
        Ok(selection)
    }

    /// The runs, all steps of a scheme together.
    pub(crate) fn runs(&self) -> impl Iterator<Item = (&Propagator, Run<'_>)> {
        let order = order_setting(&self.estimator)
            .map(|(name, value)| OrderSetting { name: if name == "order" { "--order" } else { "--max-order" }, value });
        self.propagators.iter().flat_map(move |propagator| {
            let name = propagator.name();
            self.sizes.iter().map(move |(h, steps)| {
                (propagator, Run { propagator: name, h, steps: *steps, order, windows: Run::WINDOWS })
            })
        })
    }

    /// The name of a run, the n-th of several.
    pub(crate) fn numbered(&self, n: usize, run: Run<'_>) -> String {
        match self.count() {
            1 => run.name(),
            count => format!("run {n} of {count}: {}", run.name()),
        }
    }

    /// About how many steps a run will have.
    pub(crate) fn expected_steps(&self, run: Run<'_>) -> u64 {
        self.problem.system.expected_steps(run, Some(&self.until))
    }

    /// How many runs there are.
    pub(crate) fn count(&self) -> usize {
        self.propagators.len() * self.sizes.len()
    }

    /// What is the same in all runs.
    pub(crate) fn drift_request(&self, summarised: bool) -> DriftRequest<'_> {
        let Selection { problem, until, arithmetic, estimator, .. } = self;
        let Described { name, system, .. } = problem;
        DriftRequest { problem: name, system, until, arithmetic: *arithmetic, estimator, summarised }
    }

    /// Notes of runs whose steps are beyond the stability limit of their scheme, or too few for a revolution of a
    /// planet.
    fn note_large_steps(&self) {
        let system = &self.problem.system;
        let frequency = system.fastest_frequency();
        let note = |scheme, h: &StepSize| note_of_steps((system, frequency), scheme, h.exact());
        for scheme in self.propagators.iter().filter_map(Propagator::scheme) {
            self.sizes.iter().filter_map(|(h, _)| note(scheme, h)).for_each(report::note);
        }
    }
}

fn estimator(arguments: &EstimatorArguments) -> Result<EstimatorSettings, Error> {
    let options = EstimatorOptions {
        order: match arguments.order {
            OrderChoice::Auto => None,
            OrderChoice::Fixed(order) => Some(order),
        },
        max_order: arguments.max_order,
        stop: arguments.stop,
        rule: arguments.rule,
        accuracy: arguments.accuracy.as_deref().map(accuracy).transpose()?,
    };
    refuse_high_order(&arguments.estimator, "--order", options.order)?;
    refuse_high_order(&arguments.estimator, "--max-order", options.max_order)?;
    match EstimatorSettings::from_options(&arguments.estimator, options) {
        Ok(settings) => Ok(settings.expect("only names of estimators are accepted")),
        Err(error) => {
            let flag = |name: &str| format!("--{}", name.replace('_', "-"));
            let (message, hint) =
                conflict(&error, &flag(error.option), |name, value| format!("{} {value}", flag(name)));
            Err(Error::usage(message, hint))
        }
    }
}

/// Refuses an order that the estimator does not have.
fn refuse_high_order(estimator: &str, flag: &str, order: Option<u32>) -> Result<(), Error> {
    match (order, EstimatorSettings::highest_order(estimator)) {
        (Some(order), Some(highest)) if order > highest => Err(Error::usage(
            format!("{flag} {order} is above {highest}, the largest order of --estimator {estimator}"),
            format!("write {flag} {highest} or less"),
        )),
        _ => Ok(()),
    }
}

fn accuracy(text: &str) -> Result<Rational, Error> {
    let accuracy = quantity::number("--accuracy", text)?;
    match check_accuracy(&accuracy) {
        Ok(()) => Ok(accuracy),
        Err(error) => Err(Error::usage(format!("--accuracy {text} {error}"), ACCURACY_HINT)),
    }
}

/// Refuses a comma without a value before or after it.
fn refuse_empty(flag: &str, list: &[String], example: &str) -> Result<(), Error> {
    if list.iter().all(|item| !item.trim().is_empty()) {
        return Ok(());
    }
    let message = format!("{flag} {} has an empty value", list.join(","));
    Err(Error::usage(message, format!("write one value, or several with commas between them: {flag} {example}")))
}

/// The list without repetitions, which are reported.
fn each_once<T: Clone>(list: &[T], name: impl Fn(&T) -> String, what: &str) -> Vec<T> {
    let mut distinct: Vec<T> = Vec::new();
    for item in list {
        if distinct.iter().any(|other| name(other) == name(item)) {
            report::note(format_args!("the {what} {} is given twice; it is run once", name(item)));
        } else {
            distinct.push(item.clone());
        }
    }
    distinct
}
