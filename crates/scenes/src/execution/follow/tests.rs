//! The ends of runs.

use crate::{Outcome, Scene};
use shadowstep::number::{Limbs, Real as _};
use shadowstep::problems::Kepler;
use shadowstep::steps::integrator::at_output;
use shadowstep::steps::step_to_time;
use shadowstep::systems::transformed_time::{TimeTransformation, TransformedKinetic, TransformedPotential};
use shadowstep::tables::{Faults, Source, shipped};
use shadowstep::{Carried, Integrator as _, Motion, Number as _, Stepper, UnitMasses};
use shadowstep_schemes::symbolic::decimal::from_text;

fn read(text: &str) -> Result<Scene, Faults> {
    Scene::read(Source { path: "test.toml".to_owned(), text: text.to_owned() })
}

fn pendulum(end: &str, output: &str) -> Result<Scene, Faults> {
    read(&format!(
        "problem.name = \"pendulum\"\n[run]\nscheme = \"yoshida4\"\nstep = \"1/10\"\nuntil = 100\nend = {end}\ndigits \
            = \"double\"\n[output]\n{output}"
    ))
}

fn rows(scene: &Scene) -> Vec<String> {
    let mut rows = Vec::new();
    assert!(matches!(scene.run_into(&mut rows, &mut ()).unwrap(), Outcome::Complete { .. }));
    let text = String::from_utf8(rows).unwrap();
    text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
}

/// The first state at which p < 0 is the last one, whatever is written, and the rows before are those of a run that
/// goes on.
#[test]
fn a_condition_ends_a_run_at_the_first_state_that_meets_it() {
    for output in ["trajectory = true", "trajectory = true\nmodified_energy = { estimator = \"bilinear\", order = 4 }"]
    {
        let (ended, free) = (pendulum("\"p < 0\"", output).unwrap(), pendulum("\"p > 100\"", output).unwrap());
        assert_eq!((ended.steps(), ended.most_steps()), (None, 1000));
        let (ended, free) = (rows(&ended), rows(&free));
        assert_eq!(ended.len(), 1 + 18);
        assert_eq!(ended, free[..ended.len()]);
        let momentum = |row: &String| row.rsplit(',').next().unwrap().parse::<f64>().unwrap();
        let sparse = output.replace("trajectory = true", "trajectory = { every = 1000 }");
        assert_eq!(rows(&pendulum("\"p < 0\"", &sparse).unwrap()).last(), ended.last());
        assert!(momentum(&ended[17]) >= 0.0 && momentum(&ended[18]) < 0.0);
    }
}

/// t of the condition is the physical one; then no last step is made to `until`.
#[test]
fn a_condition_ends_a_run_in_transformed_time() {
    let text = "problem.name = \"kepler\"\ntime.transform = \"logarithmic\"\noutput.trajectory = true\n\
                run = { scheme = \"stormer-verlet\", first = \"drift\", step = \"1/20\", until = 20, end = \"t > 3\", \
                digits = \"double\" }";
    let rows = rows(&read(text).unwrap());
    let time = |row: &String| row.split(',').nth(1).unwrap().parse::<f64>().unwrap();
    assert!(time(&rows[rows.len() - 2]) <= 3.0 && time(&rows[rows.len() - 1]) > 3.0);
}

/// The step is from a state of the trajectory to another one: a part of a step of the kernel alone would have the
/// kernel's error.
#[test]
fn a_last_step_of_a_processed_scheme_has_its_effective_order() {
    // Kepler's orbit of a = 1 and e = 1/2 from its pericentre, whose H is −1/2; E − e sin E = 3 was solved by mpmath
    let exact = [
        "-1.49554367949370064987359367969044780902165371283298359243394",
        "0.0816675374007804714178980304045221740152716243638199507374892",
    ];
    let number = |text: &str| Limbs::<4>::from_rational(&from_text(text).unwrap(), &());
    let mut speed = number("3");
    speed.assign_sqrt(&number("3"));
    for name in ["bcm6-13", "blanes6-7", "shadowstep6-7p"] {
        let [coarse, fine] = ["1/10", "1/20"].map(|h| {
            let (q, p) = (["0.5", "0", "0"].map(number).to_vec(), vec![number("0"), speed, number("0.5")]);
            let time = TimeTransformation::Logarithmic;
            let kinetic = TransformedKinetic::new(time, UnitMasses);
            let motion = Motion::new(TransformedPotential::new(time, Kepler), kinetic, q, p).unwrap();
            let scheme = shipped(name).unwrap().for_every_kinetic().unwrap();
            let mut integrator = Stepper::<_, Limbs<4>>::new(scheme, h).unwrap().into_integrator(motion);
            integrator.preprocess();
            let until = number("3");
            let mut before = (Vec::new(), Vec::new());
            let mut state = || {
                at_output(&mut integrator, |at| before = (at.state().q().to_vec(), at.state().p().to_vec()));
                integrator.step(Carried::Nothing);
                before.clone()
            };
            let states = std::iter::from_fn(|| Some(state())).take_while(|(q, _)| q[2] < until);
            let (q, p) = states.last().unwrap();
            integrator.system().state_mut().set(&q, &p);
            step_to_time(&mut integrator, &until).unwrap();
            let error = |(x, exact): (&Limbs<4>, &str)| {
                let mut error = *x;
                error.subtract(&number(exact));
                error.log10_abs()
            };
            integrator.state().q().iter().zip(exact).map(error).fold(f64::NEG_INFINITY, f64::max)
        });
        let order = (coarse - fine) / std::f64::consts::LOG10_2;
        println!("{name}: {coarse} {fine} {order}");
        assert!((order - 6.0).abs() < 0.4, "{name}: {order}");
    }
}
