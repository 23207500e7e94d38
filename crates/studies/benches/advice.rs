//! Advice against brute force: thirteen problems and four tolerances. The advised scheme and step are compared with the
//! cheapest of all runs of all schemes over all of the time, and their error is measured beside an independent
//! reference.
//!
//! `cargo bench -p shadowstep-studies --bench advice` prints the table of `docs/work-precision.md`; `-- NAME`
//! runs the problems whose names contain NAME. It takes some minutes.

use std::path::Path;
use std::time::Duration;

use shadowstep::Rational;
use shadowstep::tables::Source;
use shadowstep_scenes::System;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_studies::work_precision::advise::{Advice, AdviceRequest, Choice};
use shadowstep_studies::work_precision::of::Of;
use shadowstep_studies::work_precision::problem::Problem;
use shadowstep_studies::work_precision::run::PositionError;
use shadowstep_studies::work_precision::schemes::Group;
use shadowstep_studies::work_precision::series::StepRange;
use shadowstep_studies::work_precision::size::Size;
use shadowstep_studies::work_precision::study::{Cost, Request, Study};

/// Names, the sections of a scene, and times.
const PROBLEMS: [(&str, &str, i64); 13] = [
    ("oscillator", "problem.name = 'harmonic-oscillator'", 100),
    ("pendulum", "problem.name = 'pendulum'", 100),
    ("Kepler, e = 0.6", "problem.name = 'kepler'", 100),
    ("Kepler, e = 0.2", "problem = { name = 'kepler', parameters = { eccentricity = 0.2 } }", 200),
    ("Hénon–Heiles, regular", "problem.name = 'henon-heiles'", 100),
    ("Hénon–Heiles, chaotic", "problem.name = 'henon-heiles'\ninitial = { p = ['0.5', '0.2'] }", 50),
    ("Fermi–Pasta–Ulam α", "problem.name = 'fput-alpha'", 500),
    ("Fermi–Pasta–Ulam, stiff", "problem.name = 'fput-stiff'", 5),
    ("outer planets", "problem.name = 'outer-solar-system'", 20_000),
    ("outer planets, Wisdom–Holman", "problem = { name = 'outer-solar-system', parts = 'wisdom-holman' }", 200_000),
    ("figure eight", "problem.name = 'figure-eight'", 20),
    ("Toda", "problem.name = 'toda'", 50),
    (
        "relativistic, quartic",
        "problem = { kinetic = 'sqrt(1 + p^2)', momenta = ['p'], potential = 'x^4/4', coordinates = ['x'] }\n\
         initial = { q = [1], p = [0] }",
        50,
    ),
];

const TOLERANCES: [i32; 4] = [-4, -6, -8, -10];

fn main() {
    let filter: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    println!("| problem | tolerance | advice | predicted | error | forces | fewest of all runs | ratio |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    let (mut worst, mut missed, mut all) = (0.0_f64, 0, 0);
    for (name, text, until) in PROBLEMS {
        if !filter.is_empty() && !filter.iter().any(|part| name.contains(part.as_str())) {
            continue;
        }
        let source = Source { path: name.to_owned(), text: text.to_owned() };
        let (system, _) = System::read(&source, Arithmetic::DOUBLE).unwrap();
        let until = Rational::from_integer(until.into());
        let problem = Problem { system: &system, until: &until, arithmetic: Arithmetic::DOUBLE, length: None };
        let schemes = Group::Default.schemes(&system, Arithmetic::DOUBLE, None).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let study = study(problem, &schemes, &folder.path().join("study"));
        for exponent in TOLERANCES {
            let tolerance = Size::power_of_ten(f64::from(exponent));
            let folder = folder.path().join(format!("{exponent}"));
            let request = AdviceRequest {
                problem,
                schemes: &schemes,
                of: Of::Position,
                tolerance,
                cost: Cost::Evaluations,
                seconds: 48.0,
                folder,
            };
            let best = study.cheapest(Of::Position, Cost::Evaluations, tolerance).into_iter().next();
            all += 1;
            match (request.run(&mut ()).unwrap(), best) {
                (Advice::Found { choices, .. }, best) => {
                    let error = measured(problem, &choices[0], &request.folder.join("measured"));
                    let met = matches!(error, PositionError::Known(error) | PositionError::Below(error) if error <= tolerance);
                    missed += u32::from(!met);
                    let cost = choices[0].work(&system).total() as f64;
                    let ratio = best.map(|(_, fewest)| cost / fewest);
                    worst = worst.max(ratio.unwrap_or(0.0));
                    row(
                        (name, exponent),
                        (&choices[0], cost),
                        error,
                        best.map(|(studied, fewest)| (studied.scheme, fewest)),
                    );
                }
                (Advice::OutOfReach { least, .. }, best) => {
                    missed += u32::from(best.is_some());
                    let least = least.map_or("none".to_owned(), |(error, name)| format!("{error} of {name}"));
                    let best = best
                        .map_or("none".to_owned(), |(studied, fewest)| format!("{fewest:.0}, {}", studied.scheme.name));
                    println!("| {name} | 1e{exponent} | out of reach; least {least} | | | | {best} | |");
                }
            }
        }
    }
    println!("\n{all} cases; the tolerance is missed in {missed}; the largest ratio of costs is {worst:.2}.");
}

/// The time for a reference.
const REFERENCE: Duration = Duration::from_secs(60);

/// All schemes over all of the time, down to round-off.
fn study<'a>(problem: Problem<'a>, schemes: &'a [NamedScheme], folder: &Path) -> Study<'a> {
    let range = StepRange::Automatic { seconds: 4.0, target: None };
    Request::new(problem, schemes, range, REFERENCE, folder).study(&mut ()).unwrap()
}

/// The error of the advised run beside a reference of more digits.
fn measured(problem: Problem<'_>, choice: &Choice<'_>, folder: &Path) -> PositionError {
    let until = &choice.step * Rational::from_integer(choice.steps.into());
    let problem = Problem { until: &until, ..problem };
    let (schemes, range) = ([choice.scheme.clone()], StepRange::Given(vec![choice.steps]));
    let request = Request::new(problem, &schemes, range, REFERENCE, folder);
    request.study(&mut ()).unwrap().schemes[0].series.runs[0].position
}

fn row(
    (name, exponent): (&str, i32),
    (choice, cost): (&Choice<'_>, f64),
    error: PositionError,
    best: Option<(&NamedScheme, f64)>,
) {
    let error = match error {
        PositionError::Known(error) => error.to_string(),
        PositionError::Below(bound) => format!("< {bound}"),
        PositionError::None => "none".to_owned(),
    };
    let step = shadowstep_schemes::symbolic::decimal::to_text(&choice.step);
    let (best, ratio) = best.map_or((String::new(), String::new()), |(scheme, fewest)| {
        (format!("{fewest:.0}, {}", scheme.name), format!("{:.2}", cost / fewest))
    });
    let advice = format!("{}, h = {step}", choice.scheme.name);
    println!("| {name} | 1e{exponent} | {advice} | {} | {error} | {cost:.0} | {best} | {ratio} |", choice.error);
}
