//! Particles of mass 0 in the field of planets, a step of Wisdom & Holman's map each: `evidence/rivals/particles.py` runs it
//! beside REBOUND, for `docs/planets.md`.
//!
//! A line of input is a file of bodies, a line `m x y z vx vy vz` each, those of mass 0 last; G; h; and a number of
//! steps. The answer is the seconds of processor time that the steps took, and the positions.

use std::io::{BufRead as _, stdin};

use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, WisdomHolman};
use shadowstep::tables::{First, read, shipped_source};
use shadowstep::{Rational, Stepper, exact};

type Failure = Box<dyn std::error::Error>;

/// Of the process, by `/proc`: in ticks of 10 ms.
fn seconds() -> Result<f64, Failure> {
    let stat = std::fs::read_to_string("/proc/self/stat")?;
    let times = stat.rsplit(") ").next().unwrap_or_default().split(' ').skip(11).take(2);
    Ok(times.map(|ticks| ticks.parse::<f64>()).sum::<Result<f64, _>>()? / 100.0)
}

fn answer(file: &str, g: &str, h: &str, steps: u64) -> Result<String, Failure> {
    let (mut masses, mut q, mut p) = (Vec::new(), Vec::new(), Vec::new());
    for line in std::fs::read_to_string(file)?.lines() {
        let numbers: Vec<f64> = line.split(' ').map(str::parse).collect::<Result<_, _>>()?;
        let (mass, state) = numbers.split_first().ok_or("an empty line")?;
        let of_momentum = if *mass == 0.0 { 1.0 } else { *mass };
        masses.push(Rational::from_float(*mass).ok_or("a mass that is not finite")?);
        q.extend(&state[..3]);
        p.extend(state[3..].iter().map(|v| v * of_momentum));
    }
    let mut system = WisdomHolman::<_, Jacobi<_, 3>, 3>::new(&Bodies::new(exact(g)?, masses)?, (&q, &p), &())?;
    let source = shipped_source("stormer-verlet").ok_or("no such scheme")?;
    let stepper = Stepper::new(read(&source, &|base, _| shipped_source(base), Some(First::Drift))?, h)?;
    let before = seconds()?;
    stepper.merged_steps(std::slice::from_mut(&mut system), steps);
    let taken = seconds()? - before;
    let positions: Vec<String> = system.inertial().0.iter().map(f64::to_string).collect();
    Ok(format!("{taken} {}", positions.join(" ")))
}

fn main() -> Result<(), Failure> {
    for line in stdin().lock().lines() {
        let line = line?;
        let [file, g, h, steps] = line.split(' ').collect::<Vec<_>>()[..] else {
            return Err("four words a line".into());
        };
        println!("{}", answer(file, g, h, steps.parse()?)?);
    }
    Ok(())
}
