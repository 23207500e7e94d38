//! Studies of problems whose solution is known, and of others beside a reference with an estimated error.

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
use tempfile::TempDir;

fn system(name: &str) -> System {
    System::of_setup(problem(name).unwrap().setup(&[], 60).unwrap())
}

/// A problem until t with schemes, and a folder for its results.
struct Setup {
    system: System,
    until: Rational,
    arithmetic: Arithmetic,
    schemes: Vec<NamedScheme>,
    folder: TempDir,
}

impl Setup {
    fn new(system: System, t: i64, arithmetic: Arithmetic, names: &[&str]) -> Setup {
        let schemes = names.iter().map(|name| scheme(name).unwrap()).collect();
        Setup { system, until: Rational::from_integer(t.into()), arithmetic, schemes, folder: TempDir::new().unwrap() }
    }

    fn problem(&self) -> Problem<'_> {
        Problem { system: &self.system, until: &self.until, arithmetic: self.arithmetic, length: None }
    }

    fn request<'a>(&'a self, problem: Problem<'a>, range: StepRange) -> Request<'a> {
        Request::new(problem, &self.schemes, range, Duration::from_secs(20), self.folder.path())
    }

    fn study(&self, steps: &[u64]) -> Study<'_> {
        self.request(self.problem(), StepRange::Given(steps.to_vec())).study(&mut ()).unwrap()
    }
}

/// Every error is that of the exact solution, and falls as the proved order says.
#[test]
fn schemes_show_their_orders_beside_the_exact_flow() {
    let names = ["stormer-verlet", "blanes-moan-s6", "blanes-moan-srkn11b"];
    let setup = Setup::new(system("pendulum"), 10, Arithmetic::with_digits(30).unwrap(), &names);
    let (problem, study) = (setup.problem(), setup.study(&[100, 200, 400, 800, 1600]));
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
    let (arithmetic, names) =
        (Arithmetic::with_digits(30).unwrap(), ["blanes-moan-srkn6b", "blanes-moan-srkn11b", "chin-4a"]);
    // time as a coordinate, and a drift of x
    for kinetic in ["px^2/2 + ps", "(px + ps)^2/2 + px/3 + ps^2 - 2"] {
        let setup = Setup::new(system(kinetic), 6, arithmetic, &names);
        let (problem, study) = (setup.problem(), setup.study(&[40, 60, 80, 120, 160]));
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
    let text = "problem = { name = 'kepler', parameters = { eccentricity = 0.9 } }\ntime.transform = 'logarithmic'";
    let source = || Source { path: "kepler".to_owned(), text: text.to_owned() };
    for end in [20, -20] {
        let (system, _) = System::read(&source(), Arithmetic::DOUBLE).unwrap();
        let setup = Setup::new(system, end, Arithmetic::DOUBLE, &["sofroniou-spaletta6-13", "yoshida4"]);
        let length = length_of(&setup.system, &setup.until).unwrap().unwrap();
        // s is the eccentric anomaly: 3 periods and what is left of 20 after them
        assert!((length.abs() - exact("20").unwrap()).abs() < exact("1").unwrap(), "{length}");
        let problem = Problem { length: Some(&length), ..setup.problem() };
        let range = StepRange::Given(vec![100, 150, 200, 300, 400]);
        let study = setup.request(problem, range).study(&mut ()).unwrap();
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
    let formula = System::from(InitialValueProblem {
        potential: formula("-1/sqrt(x^2 + y^2)", &["x", "y"]),
        parameters: Vec::new(),
        ..system("kepler").problem
    });
    let setups = [system("kepler"), formula].map(|system| Setup::new(system, 20, Arithmetic::DOUBLE, &["kahan-li8"]));
    let [exact, estimated] = setups.each_ref().map(|setup| setup.study(&[500, 1000, 2000]));
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
    let setup = Setup::new(system, 800, Arithmetic::DOUBLE, &["yoshida4"]);
    let request = setup.request(setup.problem(), StepRange::Given(vec![8000, 16_000]));
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
    let setup = Setup::new(system, 20_000, Arithmetic::DOUBLE, &["abah864"]);
    let study = setup.study(&[25, 50, 100]);
    let Origin::Scheme { steps, .. } = study.reference.origin else { panic!("{:?}", study.reference.origin) };
    assert!(steps < 2000, "{steps}");
    // 800 days are a fifth of Jupiter's year
    let found = study.schemes[0].series.runs[0].position.known().unwrap();
    assert!(found < Size::power_of_ten(-3.0) && study.reference.error() < Size::power_of_ten(-13.0), "{found}");
}

#[test]
fn series_go_from_instability_to_round_off() {
    let names = ["stormer-verlet", "bce-rkn8-17"];
    let setup = Setup::new(system("harmonic-oscillator"), 10, Arithmetic::DOUBLE, &names);
    let range = StepRange::Automatic { seconds: 5.0, target: None };
    let study = setup.request(setup.problem(), range).study(&mut ()).unwrap();
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
    let setup = Setup::new(system("henon-heiles"), 5, Arithmetic::DOUBLE, &["stormer-verlet", "yoshida4"]);
    let results = || std::fs::read(setup.folder.path().join("results.jsonl")).unwrap();
    let again = || setup.study(&[50, 100]).csv(&[]).unwrap();
    let (first, bytes) = (again(), results());
    assert_eq!((again(), results()), (first.clone(), bytes));
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
    let setup = Setup::new(system("henon-heiles"), 5, Arithmetic::with_digits(60).unwrap(), &["yoshida4"]);
    let request = setup.request(setup.problem(), StepRange::Given(vec![50]));
    let stopped = request.study(&mut Stops { questions: 4 }).unwrap_err();
    assert!(stopped.to_string().starts_with("interrupted: 0 of 1 calculations are saved"), "{stopped}");
    let saved = std::fs::read_to_string(setup.folder.path().join("results.jsonl")).unwrap();
    assert_eq!(saved.lines().count(), 1, "the header alone: {saved}");
}

/// A run whose states are not finite is kept as failed.
#[test]
fn runs_that_fail_are_kept_as_failed() {
    // far from the centre the force is large: the coarse steps overshoot ever more
    let pendulum = problem("pendulum").unwrap().setup(&[("p".to_owned(), "10".to_owned())], 60).unwrap();
    let quartic = System::from(InitialValueProblem {
        potential: formula("x^4", &["x"]),
        parameters: Vec::new(),
        coordinates: vec!["x".to_owned()],
        ..System::of_setup(pendulum).problem
    });
    let setup = Setup::new(quartic, 10, Arithmetic::DOUBLE, &["stormer-verlet"]);
    let study = setup.study(&[20, 4000]);
    let runs = &study.schemes[0].series.runs;
    assert!(runs[0].failed.is_some() && runs[1].failed.is_none(), "{runs:?}");
    assert!(study.csv(&[]).unwrap().lines().nth(1).unwrap().contains(",a state is not finite,"));
}
