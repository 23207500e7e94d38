//! Correctors lower the error of the energy, and leave secular frequencies as wrong as before (Rein, Brown & Tamayo,
//! Mon. Not. R. Astron. Soc. 490 (2019) 5122): the Sun, Jupiter and Saturn by Wisdom–Holman maps of equal step size.
//!
//! ```sh
//! cargo run --release -p shadowstep --example secular-frequencies -- 400 10000000         # the step in days and the time in years
//! cargo run --release -p shadowstep --example secular-frequencies -- 400 100000000 1/10   # planets of a tenth of their masses
//! ```
//!
//! For each map: the variation of H at outputs and of E_8, the mean of E_8 − H, as parts of |H|, and the frequencies
//! g_5 of Jupiter's pericentre and g_6 of Saturn's with their errors, beside those that the
//! [modified Hamiltonian](predicted_frequencies) predicts.

use std::error::Error;

use shadowstep::number::{Limbs, Number, Real};
use shadowstep::shadow::Bilinear;
use shadowstep::shadow::run::ShadowRun;
use shadowstep::systems::wisdom_holman::secular::{
    Frequency, PredictedFrequency, eccentricities, main_frequency, predicted_frequencies,
};
use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, WisdomHolman};
use shadowstep::tables::{self, First, Source, TableScheme};
use shadowstep::{Integrator as _, Rational, Stepper, exact};

type Planets<N> = WisdomHolman<N, Jacobi<N, 3>, 3>;

/// A map, and the planets before its first step.
type Begun<N> = (Stepper<TableScheme, N>, Planets<N>);

/// The initial state of Hairer, Lubich & Wanner, Geometric Numerical Integration, table I.2.2: astronomical units,
/// days, solar masses.
const MASSES: [&str; 3] = ["1.00000597682", "0.000954786104043", "0.000285583733151"];
const POSITIONS: [&str; 9] =
    ["0", "0", "0", "-3.5023653", "-3.8169847", "-1.5507963", "9.0755314", "-3.0458353", "-1.6483708"];
const VELOCITIES: [&str; 9] =
    ["0", "0", "0", "0.00565429", "-0.00412490", "-0.00190589", "0.00168318", "0.00483525", "0.00192462"];

const YEAR: f64 = 365.25;

/// Steps at which energies are compared.
const STEPS_OF_ENERGIES: u64 = 3000;

/// A map with a name for the table.
struct Map {
    name: &'static str,
    scheme: &'static str,
    displaced: bool,
    /// The coefficient of h²[B,[B,A]] in the modified Hamiltonian after a corrector: `shadowstep modified` writes that
    /// of `[K,[K,D]]`.
    term: f64,
}

/// −1/24 [A,[A,B]] + 1/12 [B,[B,A]] of the leapfrog, and what the corrector leaves of it.
const LEFT: f64 = 1.0 / 12.0 - 1.0 / 24.0;

const MAPS: [Map; 4] = [
    Map { name: "plain (`stormer-verlet`, drifts first)", scheme: "stormer-verlet", displaced: false, term: LEFT },
    Map { name: "corrected (`wisdom-corrector-17`)", scheme: "wisdom-corrector-17", displaced: false, term: LEFT },
    Map { name: "kernel (`wisdom-kernel-17`)", scheme: "wisdom-kernel-17", displaced: false, term: 0.0 },
    Map { name: "kernel, displaced forces", scheme: "wisdom-kernel-17", displaced: true, term: 0.0 },
];

/// What all maps have in common.
struct Setting {
    /// The step.
    days: u64,
    years: u64,
    /// Of the masses of the planets.
    part: Rational,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let mut word = |default: &str| words.next().unwrap_or(default.to_owned());
    let setting = Setting { days: word("400").parse()?, years: word("10000000").parse()?, part: exact(&word("1"))? };
    let Setting { days, years, part } = &setting;
    // of order (10, 6, 4) for A + εB
    let reference = Map { name: "", scheme: "aba1064", displaced: false, term: 0.0 };
    let exact = frequencies(&reference, &Setting { days: days / 4, part: part.clone(), ..setting })?;
    println!("h = {days} days, {years} years; g_5 and g_6 by aba1064 at h/4: {}", texts(&exact).join(", "));
    let averaged = predicted(&reference, &setting)?;
    println!("by averaging: {}\n", averaged.map(|found| format!("{:.5}", arcseconds(found.omega))).join(", "));
    println!("| map | H | E_8 | mean of E_8 − H | error of g_5 | predicted | error of g_6 | predicted |");
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for map in &MAPS {
        let [of_h, of_modified, mean] = energies(map, &setting)?;
        let found = frequencies(map, &setting)?;
        let errors = found.iter().zip(&exact).zip(predicted(map, &setting)?).map(|((found, exact), predicted)| {
            let (error, uncertainty) = (found.omega / exact.omega - 1.0, found.uncertainty / exact.omega.abs());
            format!("{error:+.2e} ± {uncertainty:.0e} | {:+.2e}", predicted.change / predicted.omega + 0.0)
        });
        let errors = errors.collect::<Vec<_>>().join(" | ");
        println!("| {} | {of_h:.1e} | {of_modified:.1e} | {mean:+.1e} | {errors} |", map.name);
    }
    Ok(())
}

fn arcseconds(radians: f64) -> f64 {
    radians.to_degrees() * 3600.0 * YEAR
}

/// By the modified Hamiltonian.
fn predicted(map: &Map, setting: &Setting) -> Result<[PredictedFrequency; 2], Box<dyn Error>> {
    let (_, planets) = begin::<f64>(map, setting)?;
    let factor = map.term * (setting.days as f64).powi(2);
    Ok(predicted_frequencies(&planets, factor).ok_or("the planets are on elliptic orbits")?)
}

/// In arcseconds a year.
fn texts(frequencies: &[Frequency]) -> Vec<String> {
    let text = |found: &Frequency| format!("{:.7} ± {:.0e}″/a", arcseconds(found.omega), arcseconds(found.uncertainty));
    frequencies.iter().map(text).collect()
}

fn scheme(name: &str) -> Result<TableScheme, Box<dyn Error>> {
    let source: Source = tables::shipped_source(name).ok_or("it is not shipped")?;
    let first = (name == "stormer-verlet").then_some(First::Drift);
    Ok(tables::read(&source, &|base, _| tables::shipped_source(base), first)?)
}

/// The stepper of a map, and the planets before its first step.
fn begin<N: Real + Number<Context = ()>>(map: &Map, setting: &Setting) -> Result<Begun<N>, Box<dyn Error>> {
    let mut masses: Vec<Rational> = MASSES.iter().map(|mass| exact(mass)).collect::<Result<_, _>>()?;
    masses.iter_mut().skip(1).for_each(|mass| *mass *= &setting.part);
    let bodies = Bodies::new(exact("2.95912208286e-4")?, masses.clone())?;
    let number = |(axis, text): (usize, &&str), mass: bool| {
        let value = exact(text)?;
        let factor = if mass { masses[axis / 3].clone() } else { exact("1")? };
        Ok::<_, Box<dyn Error>>(N::from_rational(&(value * factor), &()))
    };
    let q = POSITIONS.iter().enumerate().map(|text| number(text, false)).collect::<Result<Vec<_>, _>>()?;
    let p = VELOCITIES.iter().enumerate().map(|text| number(text, true)).collect::<Result<Vec<_>, _>>()?;
    let stepper = Stepper::new(scheme(map.scheme)?, Rational::from_integer(setting.days.into()))?;
    let mut planets = Planets::new(&bodies, (&q, &p), &())?;
    if map.displaced {
        planets = planets.displaced(stepper.displacements()?);
    }
    stepper.preprocess(&mut planets);
    Ok((stepper, planets))
}

/// max − min of H at outputs and of E_8, and the mean of E_8 − H, as parts of |H|.
fn energies(map: &Map, setting: &Setting) -> Result<[f64; 3], Box<dyn Error>> {
    let (stepper, planets) = begin::<Limbs<3>>(map, setting)?;
    let mut run = ShadowRun::new(stepper.with(planets), STEPS_OF_ENERGIES, &Bilinear::new(8))?;
    let start = run.integrator().system().energy();
    let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let (mut sum, mut count) = (0.0, 0.0);
    while let Some((_, found)) = run.advance()? {
        let (mut q, mut p, modified) = (found.q.to_vec(), found.p.to_vec(), *found.value);
        run.integrator().postprocess_state(&mut q, &mut p);
        let energies = [run.integrator().energy_at(&q, &p), modified].map(|mut energy| {
            energy.subtract(&start);
            energy.to_f64()
        });
        for (range, energy) in ranges.iter_mut().zip(energies) {
            *range = [range[0].min(energy), range[1].max(energy)];
        }
        sum += energies[1] - energies[0];
        count += 1.0;
    }
    let [of_h, of_modified] = ranges.map(|[least, most]| most - least);
    Ok([of_h, of_modified, sum / count].map(|energy| energy / start.to_f64().abs()))
}

/// g_5 and g_6, from means over a thousand years.
fn frequencies(map: &Map, setting: &Setting) -> Result<Vec<Frequency>, Box<dyn Error>> {
    let (stepper, mut planets) = begin::<f64>(map, setting)?;
    let Setting { days, years, .. } = *setting;
    let steps = (1000.0 * YEAR / days as f64).round() as u64;
    let samples = (years as f64 * YEAR / (days * steps) as f64) as usize;
    let mut means = [Vec::with_capacity(samples), Vec::with_capacity(samples)];
    for _ in 0..samples {
        let mut sums = [[0.0; 2]; 2];
        for _ in 0..steps {
            stepper.step(&mut planets);
            for (sum, e) in sums.iter_mut().zip(eccentricities(&planets)) {
                *sum = [sum[0] + e[0], sum[1] + e[1]];
            }
        }
        means.iter_mut().zip(sums).for_each(|(means, sum)| means.push(sum.map(|sum| sum / steps as f64)));
    }
    // at most 100 arcseconds a year
    let largest = (100.0_f64 / 3600.0).to_radians() / YEAR * f64::from_rational(&setting.part, &());
    Ok(means.iter().map(|means| main_frequency(means, (days * steps) as f64, largest)).collect())
}
