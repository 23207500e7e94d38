//! Studies of problems whose solution is known, and of others beside a reference with an estimated error.

use std::path::Path;
use std::time::Duration;

use num_traits::Signed;
use shadowstep::problems::problem;
use shadowstep::tables::Source;
use shadowstep::{Rational, exact};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::{NamedScheme, scheme};
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::{Formula, InitialValueProblem, PotentialEnergy, System};
use shadowstep_studies::Observer;
use shadowstep_studies::work_precision::length::length_of;
use shadowstep_studies::work_precision::of::Of;
use shadowstep_studies::work_precision::problem::Problem;
use shadowstep_studies::work_precision::reference::Origin;
use shadowstep_studies::work_precision::series::{End, StepRange};
use shadowstep_studies::work_precision::size::Size;
use shadowstep_studies::work_precision::study::{Cost, Request, Study};

fn system(name: &str) -> System {
    System::of_setup(problem(name).unwrap().setup(&[], 60).unwrap())
}

fn schemes(names: &[&str]) -> Vec<NamedScheme> {
    names.iter().map(|name| scheme(name).unwrap()).collect()
}

fn study<'a>(problem: Problem<'a>, schemes: &'a [NamedScheme], range: StepRange, folder: &Path) -> Study<'a> {
    Request::new(problem, schemes, range, Duration::from_secs(20), folder).study(&mut ()).unwrap()
}

fn until(t: i64) -> Rational {
    Rational::from_integer(t.into())
}

/// Every error is that of the exact solution, and falls as the proved order says.
#[test]
fn schemes_show_their_orders_beside_the_exact_flow() {
    let (system, until, folder) = (system("pendulum"), until(10), tempfile::tempdir().unwrap());
    let schemes = schemes(&["stormer-verlet", "blanes-moan-s6", "blanes-moan-srkn11b"]);
    let problem =
        Problem { system: &system, until: &until, arithmetic: Arithmetic::with_digits(30).unwrap(), length: None };
    let range = StepRange::Given(vec![100, 200, 400, 800, 1600]);
    let study = study(problem, &schemes, range, folder.path());
    assert_eq!(study.reference.origin, Origin::ExactFlow);
    for (studied, order) in study.schemes.iter().zip([2.0, 4.0, 6.0]) {
        assert_eq!((studied.series.runs.len(), studied.series.end), (5, End::Complete));
        for of in [Of::Position, Of::Energy] {
            // the slope still has a part of the next term: 0.1 of the order at these steps
            let found = studied.order(problem, of).unwrap();
            assert!((found.order - order).abs() < 0.1, "{}, {of:?}: {found:?}", studied.scheme.name);
        }
        assert_eq!(studied.series.runs[0].evaluations, 100 * studied.evaluations_per_step());
    }
}

/// Kinetic energies with linear and constant terms have the orders of Nyström schemes, of gradient kicks too, and their
/// modified energy is conserved, as β has the terms of T; with a cubic term these schemes are refused.
#[test]
fn kinetic_energies_of_degree_two_at_most_have_the_orders_for_quadratic_ones() {
    let system = |kinetic: &str| {
        let text = format!(
            "problem = {{ kinetic = '{kinetic}', momenta = ['px', 'ps'], potential = '-(1 + cos(s)/4)*cos(x)', \
                coordinates = ['x', 's'] }}\n\
             initial = {{ q = [1, 0], p = ['1/5', 0] }}"
        );
        System::read(&Source { path: "time.toml".to_owned(), text }, Arithmetic::DOUBLE).unwrap().0
    };
    let (until, arithmetic) = (until(6), Arithmetic::with_digits(30).unwrap());
    // time as a coordinate, and a drift of x
    for kinetic in ["px^2/2 + ps", "(px + ps)^2/2 + px/3 + ps^2 - 2"] {
        let (system, folder) = (system(kinetic), tempfile::tempdir().unwrap());
        let schemes = schemes(&["blanes-moan-srkn6b", "blanes-moan-srkn11b", "chin-4a"]);
        let problem = Problem { system: &system, until: &until, arithmetic, length: None };
        let study = study(problem, &schemes, StepRange::Given(vec![40, 60, 80, 120, 160]), folder.path());
        for (studied, order) in study.schemes.iter().zip([4.0, 6.0, 4.0]) {
            let (found, name) = (studied.order(problem, Of::Position).unwrap(), &studied.scheme.name);
            assert!((found.order - order).abs() < 0.35, "{kinetic}, {name}: {found:?}");
            assert_eq!(f64::from(studied.proved_order(problem)), order);
            let last = &studied.series.runs[4];
            let (error, drift) = (last.energy.log10(), last.modified.unwrap().drift.log10());
            assert!(drift < error - 1.5, "{kinetic}, {name}: {last:?}");
        }
    }
    let refused = for_system(scheme("blanes-moan-srkn11b").unwrap(), &system("px^2/2 + ps^3")).unwrap_err();
    assert!(refused.to_string().contains("for quadratic T only"), "{refused}");
}

/// Errors are those at the physical time at which a run ends, where the exact flow is known.
#[test]
fn runs_in_transformed_time_end_at_a_physical_time() {
    let text =
        "problem = { name = 'kepler', parameters = { eccentricity = 0.9 } }\ntime.transform = 'logarithmic'".to_owned();
    let (system, _) = System::read(&Source { path: "kepler".to_owned(), text }, Arithmetic::DOUBLE).unwrap();
    for end in [20, -20] {
        let (until, folder) = (until(end), tempfile::tempdir().unwrap());
        let length = length_of(&system, &until).unwrap().unwrap();
        // s is the eccentric anomaly: 3 periods and what is left of 20 after them
        assert!((length.abs() - exact("20").unwrap()).abs() < exact("1").unwrap(), "{length}");
        let problem = Problem { system: &system, until: &until, arithmetic: Arithmetic::DOUBLE, length: Some(&length) };
        let schemes = schemes(&["sofroniou-spaletta6-13", "yoshida4"]);
        let study = study(problem, &schemes, StepRange::Given(vec![100, 150, 200, 300, 400]), folder.path());
        assert_eq!(study.reference.origin, Origin::ExactFlow);
        for (studied, order) in study.schemes.iter().zip([6.0, 4.0]) {
            let found = studied.order(problem, Of::Position).unwrap();
            assert!((found.order - order).abs() < 0.3, "{}: {found:?}", studied.scheme.name);
            assert!(studied.series.runs[4].position.known().unwrap() < Size::power_of_ten(-3.0), "{studied:?}");
        }
    }
}

/// A potential without parameters.
fn formula(text: &str, coordinates: &[&str]) -> PotentialEnergy {
    let coordinates: Vec<String> = coordinates.iter().map(|name| (*name).to_owned()).collect();
    PotentialEnergy::Formula(Formula::potential(text, &coordinates, &[]).unwrap())
}

/// The reference is a scheme of order 10, whose estimated error is not smaller than its error.
#[test]
fn the_error_of_a_reference_is_estimated() {
    let (system, until, folder) = (system("kepler"), until(20), tempfile::tempdir().unwrap());
    let formula = System::from(InitialValueProblem {
        potential: formula("-1/sqrt(x^2 + y^2)", &["x", "y"]),
        parameters: Vec::new(),
        ..self::system("kepler").problem
    });
    let schemes = schemes(&["kahan-li8"]);
    let runs = |system| {
        let folder = folder.path().join(format!("{system:p}"));
        let problem = Problem { system, until: &until, arithmetic: Arithmetic::DOUBLE, length: None };
        study(problem, &schemes, StepRange::Given(vec![500, 1000, 2000]), &folder)
    };
    let (exact, estimated) = (runs(&system), runs(&formula));
    assert!(matches!(estimated.reference.origin, Origin::Scheme { .. }));
    let error = estimated.reference.error();
    assert!(error < Size::power_of_ten(-15.0) && error > Size::power_of_ten(-30.0), "{error}");
    for (a, b) in exact.schemes[0].series.runs.iter().zip(&estimated.schemes[0].series.runs) {
        let [a, b] = [a, b].map(|run| run.position.known().unwrap().log10());
        // the same error to three digits, as round-off differs with the form of the potential
        assert!((a - b).abs() < 4e-4 || a < -13.0, "{a} {b}");
    }
}

/// e^t at t = 800 is 1e347, more than a double can be.
#[test]
fn a_reference_that_overflows_in_the_numbers_of_the_runs_is_none() {
    let system = System::from(InitialValueProblem {
        potential: formula("-x^2/2", &["x"]),
        parameters: Vec::new(),
        ..system("harmonic-oscillator").problem
    });
    let (until, folder, schemes) = (until(800), tempfile::tempdir().unwrap(), schemes(&["yoshida4"]));
    let problem = Problem { system: &system, until: &until, arithmetic: Arithmetic::DOUBLE, length: None };
    let range = StepRange::Given(vec![8000, 16_000]);
    let request = Request::new(problem, &schemes, range, Duration::from_secs(20), folder.path());
    let message = request.study(&mut ()).map(drop).unwrap_err().to_string();
    assert!(message.contains("there is no reference: its positions overflow in double precision"), "{message}");
}

/// Of Kepler orbits and their interactions no fastest frequency is known: the reference begins with a step a sample,
/// not a step a day.
#[test]
fn a_reference_of_planets_begins_with_few_steps() {
    let text = "[problem]\nname = \"outer-solar-system\"\nparts = \"wisdom-holman\"".to_owned();
    let source = Source { path: "planets".to_owned(), text };
    let (system, _) = System::read(&source, Arithmetic::DOUBLE).unwrap();
    let (until, folder) = (until(20_000), tempfile::tempdir().unwrap());
    let problem = Problem { system: &system, until: &until, arithmetic: Arithmetic::DOUBLE, length: None };
    let schemes = schemes(&["abah864"]);
    let study = study(problem, &schemes, StepRange::Given(vec![25, 50, 100]), folder.path());
    let Origin::Scheme { steps, .. } = study.reference.origin else { panic!("{:?}", study.reference.origin) };
    assert!(steps < 2000, "{steps}");
    // 800 days are a fifth of Jupiter's year
    let found = study.schemes[0].series.runs[0].position.known().unwrap();
    assert!(found < Size::power_of_ten(-3.0) && study.reference.error() < Size::power_of_ten(-13.0), "{found}");
}

#[test]
fn series_go_from_instability_to_round_off() {
    let (system, until, folder) = (system("harmonic-oscillator"), until(10), tempfile::tempdir().unwrap());
    let schemes = schemes(&["stormer-verlet", "bce-rkn8-17"]);
    let problem = Problem { system: &system, until: &until, arithmetic: Arithmetic::DOUBLE, length: None };
    let study = study(problem, &schemes, StepRange::Automatic { seconds: 5.0, target: None }, folder.path());
    let [verlet, rkn] = &study.schemes[..] else { panic!() };
    for studied in [verlet, rkn] {
        let runs = &studied.series.runs;
        assert!(runs[0].failed.is_some() || runs[0].energy > Size::power_of_ten(-1.0), "{:?}", runs[0]);
        // equal numbers of evaluations, as nearly as steps and samples allow
        assert!(runs.windows(2).all(|runs| runs[0].steps < runs[1].steps));
    }
    assert_eq!(rkn.series.end, End::RoundOff);
    let best = study.cheapest(Of::Position, Cost::Evaluations, Size::power_of_ten(-10.0));
    assert_eq!(best[0].0.scheme.name, "bce-rkn8-17");
}

/// A second call takes everything from the folder.
#[test]
fn results_are_kept() {
    let (system, until, folder) = (system("henon-heiles"), until(5), tempfile::tempdir().unwrap());
    let schemes = schemes(&["stormer-verlet", "yoshida4"]);
    let problem = Problem { system: &system, until: &until, arithmetic: Arithmetic::DOUBLE, length: None };
    let again = || study(problem, &schemes, StepRange::Given(vec![50, 100]), folder.path()).csv(&[]).unwrap();
    let (first, bytes) = (again(), std::fs::read(folder.path().join("results.jsonl")).unwrap());
    assert_eq!((again(), std::fs::read(folder.path().join("results.jsonl")).unwrap()), (first.clone(), bytes));
    let rows: Vec<&str> = first.lines().collect();
    assert!(rows.len() == 5 && rows[1].starts_with("stormer-verlet,2,1/10,50,50,"), "{first}");
}

/// Asks to stop from some question on.
struct Stops {
    questions: u32,
}

impl Observer for Stops {
    fn stops(&mut self) -> bool {
        self.questions = self.questions.saturating_sub(1);
        self.questions == 0
    }
}

/// Two runs make a reference, but not as accurate a one as the time allows: it is computed again.
#[test]
fn an_interrupted_reference_is_not_kept() {
    let (system, until, folder) = (system("henon-heiles"), until(5), tempfile::tempdir().unwrap());
    let schemes = schemes(&["yoshida4"]);
    let problem =
        Problem { system: &system, until: &until, arithmetic: Arithmetic::with_digits(60).unwrap(), length: None };
    let request = Request::new(problem, &schemes, StepRange::Given(vec![50]), Duration::from_secs(20), folder.path());
    let stopped = request.study(&mut Stops { questions: 4 }).unwrap_err();
    assert!(stopped.to_string().starts_with("interrupted: 0 of 1 calculations are saved"), "{stopped}");
    let saved = std::fs::read_to_string(folder.path().join("results.jsonl")).unwrap();
    assert_eq!(saved.lines().count(), 1, "the header alone: {saved}");
}

/// A run whose states are not finite is kept as failed.
#[test]
fn runs_that_fail_are_kept_as_failed() {
    let (until, folder) = (until(10), tempfile::tempdir().unwrap());
    // far from the centre the force is large: the coarse steps overshoot ever more
    let setup = problem("pendulum").unwrap().setup(&[("p".to_owned(), "10".to_owned())], 60).unwrap();
    let quartic = System::from(InitialValueProblem {
        potential: formula("x^4", &["x"]),
        parameters: Vec::new(),
        coordinates: vec!["x".to_owned()],
        ..System::of_setup(setup).problem
    });
    let schemes = schemes(&["stormer-verlet"]);
    let problem = Problem { system: &quartic, until: &until, arithmetic: Arithmetic::DOUBLE, length: None };
    let study = study(problem, &schemes, StepRange::Given(vec![20, 4000]), folder.path());
    let runs = &study.schemes[0].series.runs;
    assert!(runs[0].failed.is_some() && runs[1].failed.is_none(), "{runs:?}");
    assert!(study.csv(&[]).unwrap().lines().nth(1).unwrap().contains(",a state is not finite,"));
}
