//! A Lennard-Jones liquid in a periodic box: the time of a step, and what the end of the forces does to the energy. The
//! tables of `docs/liquids.md`:
//!
//! `cargo run --release --example liquid -- time 4000`, `-- formula 4000`, `-- errors`

use std::time::Instant;

use shadowstep::problems::LennardJones;
use shadowstep::systems::formula::FormulaPair;
use shadowstep::systems::pairs::{Cutoff, CutoffPairs, PairPotential, Separation};
use shadowstep::{Motion, Stepper, UnitMasses, exact, tables::shipped};

type Liquid<P> = Motion<f64, Vec<f64>, CutoffPairs<P, 3>, UnitMasses>;
type Failure = Box<dyn std::error::Error>;

/// At the density 0.8442 and a temperature near 0.7, in units of the potential: a lattice at 1.44 that was melted in
/// 200 steps. The forces end at 2.5, smoothly from 2 on with some derivatives, or abruptly with 0.
fn liquid<P: PairPotential<f64>>(bodies: usize, derivatives: u32, pair: P) -> Result<Liquid<P>, Failure> {
    let cells = ((bodies / 4) as f64).cbrt().round() as usize;
    let cell = (4.0 / 0.8442_f64).cbrt();
    let side = exact(&(cell * cells as f64).to_string())?;
    let mut cutoff = Cutoff::<3>::at(exact("5/2")?)?;
    if derivatives > 0 {
        cutoff = cutoff.switched(exact("2")?, derivatives)?;
    }
    let cutoff = cutoff.in_box([side.clone(), side.clone(), side])?;
    let corners = [[0.0, 0.0, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]];
    let mut q = Vec::new();
    for place in 0..cells.pow(3) {
        let place = [place / (cells * cells), place / cells % cells, place % cells];
        for corner in corners {
            q.extend(place.iter().zip(corner).map(|(&place, corner)| (place as f64 + corner) * cell));
        }
    }
    // the fractional parts of multiples of irrational numbers, of mean square 1.44
    let p = (1..=q.len()).map(|i| 2.4 * 3_f64.sqrt() * ((i as f64 * 0.754_877_666_246_692_7).fract() - 0.5)).collect();
    let mut motion = Motion::new(CutoffPairs::new(q.len() / 3, pair, cutoff)?, UnitMasses, q, p)?;
    let stepper = Stepper::new(shipped("stormer-verlet").ok_or("no such scheme")?, "1/200")?;
    (0..200).for_each(|_| stepper.step(&mut motion));
    Ok(motion)
}

/// The median of seven times of some steps, for each derivatives.
fn time<P: PairPotential<f64>>(bodies: usize, pair: impl Fn() -> P) -> Result<(), Failure> {
    let stepper = Stepper::new(shipped("stormer-verlet").ok_or("no such scheme")?, "1/200")?;
    for derivatives in [0, 3] {
        let mut motion = liquid(bodies, derivatives, pair())?;
        let steps = (1_000_000 / bodies).max(10);
        let mut times: Vec<f64> = (0..7)
            .map(|_| {
                let begin = Instant::now();
                (0..steps).for_each(|_| stepper.step(&mut motion));
                begin.elapsed().as_secs_f64() / steps as f64
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("{} bodies, {derivatives} derivatives: {:.3} ms a step", motion.q().len() / 3, times[3] * 1e3);
    }
    Ok(())
}

/// The largest |H(t) − H(0)| up to t = 2 as a part of T, by schemes, steps and derivatives.
fn errors() -> Result<(), Failure> {
    for (scheme, steps) in [("stormer-verlet", [200, 400, 800]), ("blanes-moan-srkn6b", [50, 100, 200])] {
        for derivatives in [0, 1, 2, 3, 4, 6] {
            let mut line = format!("{scheme}, {derivatives} derivatives:");
            for inverse in steps {
                let mut motion = liquid(864, derivatives, LennardJones { epsilon: 1.0, sigma: 1.0 })?;
                let stepper = Stepper::new(shipped(scheme).ok_or("no such scheme")?, format!("1/{inverse}").as_str())?;
                let kinetic: f64 = motion.p().iter().map(|p| p * p / 2.0).sum();
                let start = motion.energy();
                let mut worst = 0.0_f64;
                for _ in 0..2 * inverse {
                    stepper.step(&mut motion);
                    worst = worst.max((motion.energy() - start).abs());
                }
                line += &format!("  h = 1/{inverse}: {:.1e}", worst / kinetic);
            }
            println!("{line}");
        }
    }
    Ok(())
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let bodies = arguments.get(1).map_or(Ok(4000), |text| text.parse())?;
    match arguments.first().map(String::as_str) {
        Some("errors") => errors(),
        Some("formula") => {
            let formula = "4*((1/r2)^6 - (1/r2)^3)";
            let pair = FormulaPair::new(formula, Separation::SquaredDistance, &[], &[])?;
            time(bodies, || pair.clone())
        }
        _ => time(bodies, || LennardJones { epsilon: 1.0, sigma: 1.0 }),
    }
}
