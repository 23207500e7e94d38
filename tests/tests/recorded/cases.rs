//! Trajectories of velocity Verlet with a fault whose kind is known: four systems, eleven faults.

use shadowstep::shadow::recorded::{Derivatives, Diagnosis, Logged as State, Observer, Window};

use super::*;

/// Numbers that look random, of a seed.
#[derive(Clone, Debug)]
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d);
        random.part();
        random
    }

    /// From 0 to 1.
    pub(super) fn part(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// From `low` to `high`, equally often at each order of magnitude.
    pub(super) fn between(&mut self, [low, high]: [f64; 2]) -> f64 {
        low * (high / low).powf(self.part())
    }

    /// Of mean 0 and variance 1, nearly normal.
    pub(super) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.part() - 0.5).sum()
    }
}

/// A system of unit masses; times are in units of its shortest period, divided by 2π.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum System {
    /// 27 Lennard-Jones particles.
    Fluid,
    /// Oscillators of frequencies 1 to 1.05 with weak quartic springs between neighbours: phases that drift apart.
    Oscillators,
    /// Fermi, Pasta, Ulam and Tsingou's chain with fixed ends.
    Chain,
    /// Molecules of three particles with stiff bonds, and Gaussian repulsion between all particles.
    Molecules,
}

impl System {
    pub(super) const ALL: [System; 4] = [System::Fluid, System::Oscillators, System::Chain, System::Molecules];

    /// 1/ω of the fastest motion, about.
    pub(super) fn fastest(self) -> f64 {
        match self {
            System::Fluid => 0.02,
            System::Oscillators => 1.0,
            System::Chain => 0.5,
            System::Molecules => 0.05,
        }
    }

    fn start(self, random: &mut Random) -> [Vec<f64>; 2] {
        let q = match self {
            System::Fluid => fluid().start()[0].clone(),
            System::Oscillators => vec![0.0; 60],
            System::Chain => vec![0.0; 32],
            System::Molecules => (0..8)
                .flat_map(|i| {
                    let at = [f64::from(i % 2), f64::from(i / 2 % 2), f64::from(i / 4)].map(|x| 1.5 * x);
                    let [x, y, z] = at;
                    [x, y, z, x + 0.5, y, z, x, y + 0.5, z]
                })
                .collect(),
        };
        let p = q.iter().map(|_| random.normal()).collect();
        [q, p]
    }

    /// U, and its gradient into `gradient`.
    fn evaluate(self, cutoff: Cutoff, q: &[f64], gradient: &mut [f64]) -> f64 {
        gradient.fill(0.0);
        let mut energy = 0.0;
        match self {
            System::Fluid => {
                let fluid = Fluid { kind: cutoff, ..fluid() };
                fluid.gradient(q, gradient, &mut []);
                fluid.energy(q, &mut energy, &mut []);
            }
            System::Oscillators => {
                for (i, (q, g)) in q.iter().zip(&mut *gradient).enumerate() {
                    let square = (1.0 + 0.05 * i as f64 / 59.0).powi(2);
                    energy += square * q * q / 2.0;
                    *g += square * q;
                }
                quartic(q, 0.0005, gradient, &mut energy);
            }
            System::Chain => {
                let with_ends: Vec<f64> = [&[0.0], q, &[0.0]].concat();
                for i in 0..=q.len() {
                    let d = with_ends[i + 1] - with_ends[i];
                    energy += d * d / 2.0 + 0.3 * d.powi(4) / 4.0;
                    let slope = d + 0.3 * d.powi(3);
                    if i < q.len() {
                        gradient[i] += slope;
                    }
                    if i > 0 {
                        gradient[i - 1] -= slope;
                    }
                }
            }
            System::Molecules => {
                molecules(q, gradient, &mut energy);
                // all are held together
                for (q, g) in q.iter().zip(&mut *gradient) {
                    energy += 0.25 * (q - 0.75) * (q - 0.75);
                    *g += 0.5 * (q - 0.75);
                }
            }
        }
        energy
    }
}

fn quartic(q: &[f64], strength: f64, gradient: &mut [f64], energy: &mut f64) {
    for i in 1..q.len() {
        let d = q[i] - q[i - 1];
        *energy += strength * d.powi(4);
        gradient[i] += 4.0 * strength * d.powi(3);
        gradient[i - 1] -= 4.0 * strength * d.powi(3);
    }
}

fn molecules(q: &[f64], gradient: &mut [f64], energy: &mut f64) {
    let particles = q.len() / 3;
    let mut pair = |i: usize, j: usize, u: &dyn Fn(f64) -> (f64, f64)| {
        let d: [f64; 3] = std::array::from_fn(|axis| q[3 * i + axis] - q[3 * j + axis]);
        let (value, slope) = u(d.iter().map(|d| d * d).sum());
        *energy += value;
        (0..3).for_each(|axis| {
            gradient[3 * i + axis] += slope * d[axis];
            gradient[3 * j + axis] -= slope * d[axis];
        });
    };
    // u and u′/r of r²
    let bond = |r2: f64| {
        let (stretch, r) = (r2.sqrt() - 0.5, r2.sqrt());
        (100.0 * stretch * stretch, 200.0 * stretch / r)
    };
    let repulsion = |r2: f64| (4.0 * (-r2).exp(), -8.0 * (-r2).exp());
    for i in 0..particles {
        for j in 0..i {
            if i / 3 != j / 3 {
                pair(i, j, &repulsion);
            } else if j % 3 == 0 {
                pair(i, j, &bond);
            }
        }
    }
}

/// What is wrong. Sizes are parts of the rms of the forces, or as stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fault {
    None,
    /// Independent errors of each force.
    Noise(f64),
    /// Forces that are too large by a factor.
    Scaled(f64),
    /// A force along the velocity of the neighbour: no gradient, smooth.
    NoGradient(f64),
    /// U jumps with the places of the particles, by this: truncated. The fluid has its own truncated potential.
    Truncated(f64),
    /// U′ jumps with the places of the particles, by this. The fluid has its own shifted potential.
    Kinks(f64),
    /// The logged U has independent errors, of this part of T.
    NoisyEnergy(f64),
    /// p times 1 − this, after each step.
    Friction(f64),
    /// Momenta are renewed a little after each step, as by Langevin's thermostat: this part.
    Langevin(f64),
    /// The stated step size is larger by this part.
    WrongStep(f64),
    /// q and p are rounded to multiples of this.
    Rounded(f64),
    /// Coordinates change places in this part of the states.
    Reordered(f64),
    /// q is changed by this at two states.
    Changed(f64),
}

/// A trajectory with a fault.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub(super) system: System,
    /// The step size times the largest frequency, about: 2 is the limit of stability.
    pub(super) turn: f64,
    pub(super) fault: Fault,
    pub(super) seed: u64,
}

/// What was found, and what the fault did to the energy: max − min of its work, in the steps themselves.
pub(super) struct Outcome {
    pub(super) found: [Diagnosis; 2],
    pub(super) effect: f64,
}

/// A run of a case.
struct Run {
    case: Case,
    random: Random,
    h: f64,
    q: Vec<f64>,
    p: Vec<f64>,
    gradient: Vec<f64>,
    energy: f64,
    work: f64,
    bounds: [f64; 2],
}

/// States of a run.
const STATES: usize = 600;
/// Windows of nine states begin in as many.
const APART: usize = 16;

impl Case {
    /// From all states, and from windows of nine; `None` where the run explodes before a window ends.
    pub(super) fn outcome(self) -> Option<Outcome> {
        let mut run = Run::new(self);
        let stated = match self.fault {
            Fault::WrongStep(part) => run.h * (1.0 + part),
            _ => run.h,
        };
        let (step, masses) = (stated.try_into().unwrap(), vec![1.0; run.q.len()]);
        let observer = |window| Observer::with_window(&step, &masses, window).unwrap();
        let [mut all, mut windows] = [Window::Seventeen, Window::Nine].map(observer);
        for n in 0..STATES {
            let [q, p, gradient] = run.stored();
            let derivatives = Derivatives::Gradient(&gradient);
            let state = State { q: &q, p: &p, energy: run.energy, derivatives };
            all.observe(&state).ok()?;
            if n % APART == 0 && n > 0 {
                windows.begin(n as i64).unwrap();
            }
            if n % APART < 9 {
                windows.observe(&state).ok()?;
            }
            run.step(n);
        }
        let [lowest, highest] = run.bounds;
        Some(Outcome { found: [all.diagnosis(), windows.diagnosis()], effect: highest - lowest })
    }
}

fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt()
}

fn kinetic(p: &[f64]) -> f64 {
    p.iter().map(|p| p * p).sum::<f64>() / 2.0
}

impl Run {
    fn new(case: Case) -> Self {
        let mut random = Random::new(case.seed);
        let [q, p] = case.system.start(&mut random);
        let (gradient, h) = (vec![0.0; q.len()], 0.3 * case.system.fastest());
        // without the fault first, to equilibrium
        let warm = Case { fault: Fault::None, ..case };
        let mut run = Run { case: warm, random, h, q, p, gradient, energy: 0.0, work: 0.0, bounds: [0.0; 2] };
        run.evaluate();
        (0..300).for_each(|n| run.step(n));
        (run.case, run.h) = (case, case.turn * case.system.fastest());
        run.evaluate();
        (run.work, run.bounds) = (0.0, [0.0; 2]);
        run
    }

    /// What is logged of the state.
    fn stored(&mut self) -> [Vec<f64>; 3] {
        let mut stored = [&self.q, &self.p, &self.gradient].map(Vec::clone);
        match self.case.fault {
            Fault::Rounded(unit) => {
                stored[..2].iter_mut().flatten().for_each(|x| *x = (*x / unit).round() * unit);
            }
            Fault::Reordered(part) if self.random.part() < part => {
                let by = 3 * (1 + (self.random.part() * 5.0) as usize);
                stored.iter_mut().for_each(|x| x.rotate_left(by));
            }
            _ => (),
        }
        stored
    }

    /// U and its gradient as the program has them, and the work of the fault.
    fn evaluate(&mut self) {
        let Run { case: Case { system, fault, .. }, random, q, p, gradient, energy, h, .. } = self;
        let cutoff = match fault {
            Fault::Truncated(_) => Cutoff::Truncated,
            Fault::Kinks(_) => Cutoff::Shifted,
            _ => Cutoff::Smooth,
        };
        *energy = system.evaluate(cutoff, q, gradient);
        let (right, size, dimension) = (gradient.clone(), rms(gradient), q.len());
        let mut jump = 0.0;
        match *fault {
            Fault::Noise(part) => gradient.iter_mut().for_each(|g| *g += part * size * random.normal()),
            Fault::Scaled(part) => gradient.iter_mut().for_each(|g| *g *= 1.0 + part),
            Fault::NoGradient(part) => {
                for i in 0..dimension {
                    gradient[i] += part * size * q[(i + 1) % dimension].sin();
                }
            }
            Fault::Truncated(part) if *system != System::Fluid => {
                jump = part * q.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > 0.7).count() as f64;
                *energy += jump;
            }
            Fault::Kinks(part) if *system != System::Fluid => {
                for i in 1..dimension {
                    let d = q[i] - q[i - 1];
                    if d.abs() > 0.7 {
                        *energy += part * (d.abs() - 0.7);
                        gradient[i] += part * d.signum();
                        gradient[i - 1] -= part * d.signum();
                    }
                }
            }
            Fault::NoisyEnergy(part) => *energy += part * dimension as f64 / 2.0 * random.normal(),
            _ => (),
        }
        if matches!(fault, Fault::Noise(_) | Fault::Scaled(_) | Fault::NoGradient(_)) {
            // p is half a step before
            let power = |((g, right), p): ((&f64, &f64), &f64)| (g - right) * (p - *h / 2.0 * g);
            let power: f64 = gradient.iter().zip(&right).zip(p.iter()).map(power).sum();
            self.work -= *h * power;
        } else if jump != 0.0 {
            // the sum of all jumps is what U has of them
            self.work = jump;
        }
        self.bounds = [self.bounds[0].min(self.work), self.bounds[1].max(self.work)];
    }

    fn kick(&mut self) {
        self.p.iter_mut().zip(&self.gradient).for_each(|(p, g)| *p -= self.h / 2.0 * g);
    }

    fn step(&mut self, n: usize) {
        self.kick();
        self.q.iter_mut().zip(&self.p).for_each(|(q, p)| *q += self.h * p);
        if let Fault::Changed(by) = self.case.fault
            && [200, 450].contains(&n)
        {
            let before = self.case.system.evaluate(Cutoff::Smooth, &self.q, &mut self.gradient);
            for q in &mut self.q {
                *q += by * self.random.normal();
            }
            self.work += self.case.system.evaluate(Cutoff::Smooth, &self.q, &mut self.gradient) - before;
        }
        self.evaluate();
        self.kick();
        let before = kinetic(&self.p);
        match self.case.fault {
            Fault::Friction(part) => self.p.iter_mut().for_each(|p| *p *= 1.0 - part),
            Fault::Langevin(part) => {
                for p in &mut self.p {
                    *p = *p * (1.0 - part) + (2.0 * part).sqrt() * self.random.normal();
                }
            }
            _ => return,
        }
        self.work += kinetic(&self.p) - before;
        self.bounds = [self.bounds[0].min(self.work), self.bounds[1].max(self.work)];
    }
}
