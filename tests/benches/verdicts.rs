//! How often the monitor's verdicts are right: matrices of scenes, schemes and steps, each watched with six k, against
//! runs of ten times the length and with half the step.
//!
//! `cargo bench -p shadowstep-tests --bench verdicts` prints the tables of `docs/monitor.md`; `-- NAME` runs the scenes
//! whose names contain NAME. It takes some minutes.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use shadowstep::Scheme;
use shadowstep::shadow::{Bilinear, Report, ShadowEnergy, Verdict};
use shadowstep_tests::matrix::{Matrix, Scene, stepper};

const KS: [u32; 6] = [6, 8, 12, 16, 24, 32];
const EVERY: u64 = 100;
/// The longest runs that are tried where they are advised, in the lengths of the scenes.
const LONGEST: u64 = 40;

/// A scene, a scheme and a step.
#[derive(Clone, Copy)]
struct Case<'a> {
    scene: &'a Scene,
    scheme: &'static str,
    part: f64,
}

/// What long runs show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Truth {
    Bounded,
    Borderline,
    /// As it does with half the step, where it shrinks with h as the order predicts: the trajectory comes to other
    /// places.
    GrowsAtHalf,
    Grows,
    RoundOff,
}

/// What a monitor reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Conclusion {
    Bounded,
    RoundOff,
    Undecided,
    Forces,
    NotSmooth,
    NotConserved,
    TooLarge,
}

impl From<Verdict> for Conclusion {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Bounded => Conclusion::Bounded,
            Verdict::RoundOff => Conclusion::RoundOff,
            Verdict::Undecided(_) => Conclusion::Undecided,
            Verdict::NotSmooth => Conclusion::NotSmooth,
            Verdict::NotConserved => Conclusion::NotConserved,
            Verdict::Drifts | Verdict::Inconsistent | Verdict::NotTheGradient => Conclusion::Forces,
            Verdict::TooLarge(_) | Verdict::NearResonance { .. } => Conclusion::TooLarge,
        }
    }
}

/// The error of H after each of two numbers of steps: the width of the middle 98 % of its values, and max − min.
///
/// Close encounters become closer the longer a run is, so that its largest error grows also where the modified energy
/// is conserved.
fn energy_errors(case: Case<'_>, part: f64, steps: [u64; 2]) -> [[f64; 2]; 2] {
    let stepper = stepper(case.scheme, case.scene.limit, part);
    let mut motion = case.scene.motion();
    let (mut energies, mut errors) = (vec![motion.energy()], [[f64::INFINITY; 2]; 2]);
    for n in 1..=steps[1] {
        stepper.step(&mut motion);
        if n % 4 == 0 {
            energies.push(motion.energy());
            if !energies[energies.len() - 1].is_finite() {
                break;
            }
        }
        for (end, error) in steps.into_iter().zip(&mut errors) {
            if n == end {
                *error = widths(&energies);
            }
        }
    }
    errors
}

/// The width of the middle 98 % of some values, and max − min.
fn widths(values: &[f64]) -> [f64; 2] {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    let last = values.len() - 1;
    [values[last - last / 100] - values[last / 100], values[last] - values[0]]
}

/// The error of H is bounded if it grows by half or less in ten times the length and stays below 0.3 of T; it grows if
/// it trebles or comes to 0.6 of T. It is round-off if it is of the size of that, or grows with half the step as well
/// and is not smaller there.
fn truth(case: Case<'_>, report: &Report<f64>) -> Truth {
    let n = case.scene.steps;
    let [[short, _], [long, largest]] = energy_errors(case, case.part, [n, 10 * n]);
    if !long.is_finite() || largest >= 0.6 * report.kinetic {
        return Truth::Grows;
    }
    let growth = long / short;
    if largest < 20.0 * report.round_off * 10_f64.sqrt() {
        return Truth::RoundOff;
    }
    if growth <= 1.5 {
        return if largest <= 0.3 * report.kinetic { Truth::Bounded } else { Truth::Borderline };
    }
    let [[half_short, _], [half, _]] = energy_errors(case, case.part / 2.0, [2 * n, 20 * n]);
    let order = stepper(case.scheme, 1.0, 1.0).scheme().summary().order_quadratic;
    let (gain, of_order) = (long / half, 2_f64.powi(order as i32));
    match half > 1.5 * half_short {
        true if case.scene.smooth && order > 2 && gain < 4.0 => Truth::RoundOff,
        true if (0.5..1.6).contains(&(gain / of_order)) && largest < 0.1 * report.kinetic => Truth::GrowsAtHalf,
        _ if growth >= 3.0 => Truth::Grows,
        _ => Truth::Borderline,
    }
}

fn watch(case: Case<'_>, ks: &[u32], length: u64) -> Vec<Report<f64>> {
    let stepper = stepper(case.scheme, case.scene.limit, case.part);
    let mut motion = case.scene.motion();
    let new = |k: &u32| ShadowEnergy::new(stepper.clone(), &mut motion, &Bilinear::with_error(*k));
    let mut monitors: Vec<_> = ks.iter().map(new).map(|new| new.expect("a finite start").every(EVERY)).collect();
    for _ in 0..length * case.scene.steps {
        stepper.step_augmented(&mut motion);
        // what is not finite stays so, and each monitor has to see it
        monitors.iter_mut().for_each(|monitor| drop(monitor.observe(&mut motion)));
    }
    monitors.iter().map(|monitor| monitor.report()).collect()
}

/// The result of a case.
struct Outcome {
    name: String,
    smooth: bool,
    truth: Truth,
    conclusions: Vec<Conclusion>,
    verdicts: Vec<Verdict>,
    /// Where the verdict of k = 8 is undecided: how many times as long a run may decide, and whether it does.
    advice: Option<(u64, Option<bool>)>,
}

fn outcome(case: Case<'_>) -> Outcome {
    let reports = watch(case, &KS, 1);
    let truth = truth(case, &reports[0]);
    let advice = reports[1].advice.map(|advice| {
        let decides = || !matches!(watch(case, &[8], advice.length)[0].verdict, Verdict::Undecided(_));
        (advice.length, (advice.length <= LONGEST).then(decides))
    });
    let verdicts: Vec<Verdict> = reports.iter().map(|report| report.verdict).collect();
    let name = format!("{}, {}, {}", case.scene.name, case.scheme, case.part);
    let conclusions = verdicts.iter().map(|&verdict| verdict.into()).collect();
    Outcome { name, smooth: case.scene.smooth, truth, conclusions, verdicts, advice }
}

fn outcomes(matrix: fn() -> Matrix, filter: &[String]) -> Vec<Outcome> {
    let (next, all) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        // each thread has systems of its own
        let matrix = matrix();
        let scenes =
            || matrix.scenes.iter().filter(|scene| filter.is_empty() || filter.iter().any(|f| scene.name.contains(f)));
        let cases: Vec<Case<'_>> = scenes()
            .flat_map(|scene| matrix.schemes.iter().map(move |&scheme| (scene, scheme)))
            .flat_map(|(scene, scheme)| matrix.parts.iter().map(move |&part| Case { scene, scheme, part }))
            .collect();
        while let Some(&case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
            let outcome = outcome(case);
            all.lock().expect("no thread panics").push(outcome);
        }
    };
    std::thread::scope(|scope| {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        (0..threads).for_each(|_| drop(scope.spawn(work)));
    });
    all.into_inner().expect("no thread panics")
}

/// Truths in rows, verdicts in columns.
fn table<'a>(outcomes: impl Iterator<Item = &'a Outcome>) -> String {
    const COLUMNS: [Conclusion; 7] = [
        Conclusion::Bounded,
        Conclusion::RoundOff,
        Conclusion::Undecided,
        Conclusion::NotSmooth,
        Conclusion::Forces,
        Conclusion::NotConserved,
        Conclusion::TooLarge,
    ];
    let mut counts: BTreeMap<(Truth, Conclusion), usize> = BTreeMap::new();
    for outcome in outcomes {
        outcome.conclusions.iter().for_each(|&conclusion| *counts.entry((outcome.truth, conclusion)).or_default() += 1);
    }
    let mut text =
        "| the error of H | bounded | round-off | undecided | not smooth | other causes | not conserved | too large |\n"
            .to_owned();
    text += "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (truth, name) in [
        (Truth::Bounded, "is bounded"),
        (Truth::Borderline, "is borderline"),
        (Truth::GrowsAtHalf, "grows, also with half the step"),
        (Truth::Grows, "grows"),
        (Truth::RoundOff, "is round-off"),
    ] {
        let cells = COLUMNS.map(|conclusion| counts.get(&(truth, conclusion)).copied().unwrap_or(0).to_string());
        writeln!(text, "| {name} | {} |", cells.join(" | ")).expect("strings take all text");
    }
    text
}

/// Cases in which a verdict is false, or two verdicts contradict each other.
fn faults(outcomes: &[Outcome]) -> Vec<String> {
    let is_false = |outcome: &Outcome| {
        let has = |conclusion| outcome.conclusions.contains(&conclusion);
        let grows = has(Conclusion::TooLarge) || has(Conclusion::NotConserved);
        let too_large = grows || has(Conclusion::Forces) || (outcome.smooth && has(Conclusion::NotSmooth));
        let false_alarm = too_large && matches!(outcome.truth, Truth::Bounded | Truth::RoundOff);
        let missed = has(Conclusion::Bounded) && outcome.truth == Truth::Grows;
        false_alarm || missed || (has(Conclusion::Bounded) && too_large)
    };
    let mut faults: Vec<String> = outcomes
        .iter()
        .filter(|outcome| is_false(outcome))
        .map(|outcome| format!("{} ({:?}): {:?}", outcome.name, outcome.truth, outcome.verdicts))
        .collect();
    faults.sort();
    faults
}

fn report(title: &str, outcomes: &[Outcome]) {
    println!("\n## {title}: {} runs, k = 6, 8, 12, 16, 24, 32\n", outcomes.len());
    println!("Smooth forces:\n\n{}", table(outcomes.iter().filter(|outcome| outcome.smooth)));
    println!("Cutoffs:\n\n{}", table(outcomes.iter().filter(|outcome| !outcome.smooth)));
    let advised: Vec<_> = outcomes.iter().filter_map(|outcome| outcome.advice).collect();
    let tried: Vec<bool> = advised.iter().filter_map(|(_, decided)| *decided).collect();
    let decided = tried.iter().filter(|&&decided| decided).count();
    println!(
        "Undecided with k = 8: {}; of {} for which a run at most {LONGEST} times as long is advised, it decides \
            {decided}.",
        advised.len(),
        tried.len()
    );
    let faults = faults(outcomes);
    println!("\nFalse or contradictory: {}", faults.len());
    faults.iter().for_each(|fault| println!("- {fault}"));
}

fn main() {
    let filter: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    report("Calibration", &outcomes(Matrix::calibration, &filter));
    report("Held out", &outcomes(Matrix::held_out, &filter));
}
