//! The time of 10⁶ steps of Störmer–Verlet on Kepler's problem, for `python/benches/overhead.py`: a line of seconds for
//! each line read.

use std::io::{BufRead, Write, stdin, stdout};
use std::time::Instant;

use shadowstep::problems::Kepler;
use shadowstep::{Motion, Stepper, UnitMasses, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
pub struct StormerVerlet;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stepper = Stepper::new(StormerVerlet, "1/100")?;
    for line in stdin().lock().lines() {
        line?;
        let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?;
        let begin = Instant::now();
        for _ in 0..1_000_000 {
            stepper.step(&mut motion);
        }
        let seconds = begin.elapsed().as_secs_f64();
        println!("{seconds} {}", motion.q()[0]);
        stdout().flush()?;
    }
    Ok(())
}
