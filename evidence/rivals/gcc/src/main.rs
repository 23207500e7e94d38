//! Steps in `f64` and `Fused` beside steps in C, in one process: ratios to C by gcc -O3, then to C by gcc -O3
//! -march=native.
//!
//! `cargo run --release`, for any processor of the architecture;
//! `RUSTFLAGS="-C target-cpu=native" cargo run --release`, for this one.

#[path = "../../../../runtime/benches/timing/mod.rs"]
mod timing;

use std::hint::black_box;

use shadowstep::systems::kinetic::Quadratic;
use shadowstep::number::{Fused, Number, Real};
use shadowstep::systems::pairs::Pairs;
use shadowstep::problems::{Gravity, HenonHeiles, Kepler, Pendulum};
use shadowstep::steps::scheme::MapKind;
use shadowstep::{
    DiagonalMasses, Kinetic, Motion, Potential, Scheme, Stepper, System, UnitMasses, ValidFor, exact, splitting_scheme,
};

use timing::{Contestant, compare};

#[derive(Clone, Copy)]
#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

#[derive(Clone, Copy)]
#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

#[derive(Clone, Copy)]
#[splitting_scheme("blanes-moan-srkn6b.toml")]
struct Srkn6b;

/// Functions of `steps.c`.
#[derive(Clone, Copy)]
struct InC {
    compiled: &'static str,
    set_initial: unsafe extern "C" fn(i32, *const f64, i32, *const f64),
    verlet: unsafe extern "C" fn(i32, f64, i64, *mut f64, *mut f64),
    scheme: unsafe extern "C" fn(i32, i32, f64, *const f64, *const f64, i64, *mut f64, *mut f64),
}

/// For all processors, and for this one, where gcc fuses products and sums.
const COMPILED: [InC; 2] = [
    InC { compiled: "gcc -O3", set_initial, verlet, scheme },
    InC {
        compiled: "gcc -O3 -march=native",
        set_initial: native_set_initial,
        verlet: native_verlet,
        scheme: native_scheme,
    },
];

#[rustfmt::skip]
unsafe extern "C" {
    fn set_initial(dimension: i32, masses: *const f64, parameters: i32, values: *const f64);
    fn verlet(problem: i32, h: f64, steps: i64, q: *mut f64, p: *mut f64);
    fn scheme(problem: i32, stages: i32, opening: f64, drifts: *const f64, kicks: *const f64, steps: i64, q: *mut f64, p: *mut f64);
    fn one_by_one(problem: i32, h: f64, steps: i64, q: *mut f64, p: *mut f64, newest: *mut f64);
    fn native_set_initial(dimension: i32, masses: *const f64, parameters: i32, values: *const f64);
    fn native_verlet(problem: i32, h: f64, steps: i64, q: *mut f64, p: *mut f64);
    fn native_scheme(problem: i32, stages: i32, opening: f64, drifts: *const f64, kicks: *const f64, steps: i64, q: *mut f64, p: *mut f64);
}

/// A problem: its number in C, the initial state, and the step size.
struct Setting<'a, const D: usize> {
    problem: i32,
    q: [f64; D],
    p: [f64; D],
    h: &'a str,
}

fn number<N: Number<Context = ()>>(x: f64) -> N {
    N::from_rational(&shadowstep::Rational::from_float(x).expect("a finite number"), &())
}

impl<const D: usize> Setting<'_, D> {
    /// The steps in C: Störmer–Verlet as everybody writes it, another scheme from the list of its kicks and drifts.
    fn in_c<S: Scheme>(&self, compiled: InC, of: S) -> impl FnMut(u32, &mut [f64; D], &mut [f64; D]) + use<S, D> {
        let problem = self.problem;
        let h = number(f64::from_rational(&exact(self.h).expect("a number"), &()));
        let stepper = Stepper::<S, f64>::new(of, self.h).expect("h is not 0");
        let (maps, weights) = (stepper.scheme().sequence().maps, stepper.weights());
        let of_kind = |wanted| -> Vec<f64> {
            maps.iter().filter(|(kind, _)| *kind == wanted).map(|(kind, index)| weights.of(*kind)[*index]).collect()
        };
        let (kicks, drifts) = (of_kind(MapKind::Kick), of_kind(MapKind::Drift));
        assert_eq!(kicks.len(), drifts.len() + 1, "kicks at both ends");
        move |steps: u32, q: &mut [f64; D], p: &mut [f64; D]| {
            let (steps, q, p) = (i64::from(steps), q.as_mut_ptr(), p.as_mut_ptr());
            // SAFETY: q and p are as long as the problem's states, and there are as many weights as stated
            unsafe {
                if drifts.len() == 1 {
                    (compiled.verlet)(problem, h, steps, q, p);
                } else {
                    let (drifts_in_c, kicks_in_c) = (drifts.as_ptr(), kicks[1..].as_ptr());
                    (compiled.scheme)(problem, drifts.len() as i32, kicks[0], drifts_in_c, kicks_in_c, steps, q, p);
                }
            }
        }
    }

    /// Checks that C computes the same.
    fn check<S, M>(&self, of: S, stepper: &Stepper<S, M::Number>, mut system: M)
    where
        S: Scheme + ValidFor<M::Class>,
        M: System<Number: Real>,
    {
        let (mut q, mut p) = (self.q, self.p);
        self.in_c(COMPILED[1], of)(100, &mut q, &mut p);
        stepper.steps(std::slice::from_mut(&mut system), 100);
        let agree = |(a, b): (&f64, &M::Number)| (a - b.to_f64()).abs() < 1e-12 * a.abs().max(1.0);
        assert!(q.iter().zip(system.state().q()).all(agree), "{q:?} is not {:?}", system.state().q());
    }

    fn by_gcc<S: Scheme + 'static>(&self, compiled: InC, of: S) -> Contestant<'static> {
        let (mut steps, mut q, mut p) = (self.in_c(compiled, of), self.q, self.p);
        let run = move |repetitions: u32| {
            steps(repetitions, &mut q, &mut p);
            black_box((&q, &p));
        };
        (compiled.compiled, Box::new(run))
    }

    fn ours<'a, N, S, P, K>(&self, names: [&'static str; 3], of: S, potential: P, masses: K) -> [Contestant<'a>; 3]
    where
        N: Real + Number<Context = ()> + Copy + 'a,
        S: Scheme + ValidFor<Quadratic> + Copy + 'a,
        P: Potential<N> + Clone + 'a,
        K: Kinetic<N, Class = Quadratic> + Clone + 'a,
    {
        let start = Motion::new(potential, masses, self.q.map(number::<N>), self.p.map(number::<N>));
        let mut one = start.expect("the dimensions agree");
        let stepper = Stepper::<S, N>::new(of, self.h).expect("h is not 0");
        self.check(of, &stepper, one.clone());
        let (same, mut all) = (stepper.clone(), one.clone());
        let (merging, mut merged) = (stepper.clone(), one.clone());
        let step = move |repetitions| {
            for _ in 0..repetitions {
                stepper.step(&mut one);
            }
            black_box(one.q());
        };
        let steps = move |repetitions: u32| {
            same.steps(std::slice::from_mut(&mut all), repetitions.into());
            black_box(all.q());
        };
        let merged = move |repetitions: u32| {
            merging.merged_steps(std::slice::from_mut(&mut merged), repetitions.into());
            black_box(merged.q());
        };
        [(names[0], Box::new(step)), (names[1], Box::new(steps)), (names[2], Box::new(merged))]
    }
}

/// Steps of Störmer–Verlet one by one, without β and with it, beside the same in C.
fn with_beta<const D: usize, P, K>(title: &str, setting: &Setting<'_, D>, potential: P, masses: K)
where
    P: Potential<f64> + Clone,
    K: Kinetic<f64, Class = Quadratic> + Clone,
{
    let (problem, h) = (setting.problem, number(f64::from_rational(&exact(setting.h).expect("a number"), &())));
    let in_c = |name: &'static str, mut newest: Vec<f64>| -> Contestant<'static> {
        let (mut q, mut p) = (setting.q, setting.p);
        let run = move |steps: u32| {
            let room = if newest.is_empty() { std::ptr::null_mut() } else { newest.as_mut_ptr() };
            // SAFETY: q and p are as long as the problem's states, and there is room for 16 increments or none
            unsafe { one_by_one(problem, h, steps.into(), q.as_mut_ptr(), p.as_mut_ptr(), room) };
            black_box((&q, &p, &newest));
        };
        (name, Box::new(run))
    };
    let start = Motion::new(potential, masses, setting.q, setting.p).expect("the dimensions agree");
    let stepper = Stepper::<_, f64>::new(StormerVerlet, setting.h).expect("h is not 0");
    // C computes the same: what the first step adds
    let (mut q, mut p, mut found, mut system) = (setting.q, setting.p, vec![0.0; 16 * (2 * D + 1)], start.clone());
    // SAFETY: as above
    unsafe { one_by_one(problem, h, 1, q.as_mut_ptr(), p.as_mut_ptr(), found.as_mut_ptr()) };
    stepper.step_augmented(&mut system);
    let added = system.increments();
    for (c, ours) in found.iter().zip(std::iter::once(added.beta).chain(added.q).chain(added.p)) {
        assert!((c - ours).abs() < 1e-12 * ours.abs().max(1.0), "{title}: {c} in C, {ours} here");
    }
    let (other, mut plain, mut augmented) = (stepper.clone(), start.clone(), start);
    // as in C, from a copy of the state on the stack
    let steps = move |repetitions| {
        let mut motion = plain.clone();
        for _ in 0..repetitions {
            stepper.step(&mut motion);
        }
        plain = motion;
        black_box(plain.q());
    };
    let mut newest = [(0.0, [0.0; D], [0.0; D]); 16];
    let with_beta = move |repetitions: u32| {
        let mut motion = augmented.clone();
        for n in 0..repetitions as usize {
            other.step_augmented(&mut motion);
            let added = motion.increments();
            let (beta, q, p) = &mut newest[n % 16];
            *beta = *added.beta;
            q.copy_from_slice(added.q);
            p.copy_from_slice(added.p);
        }
        augmented = motion;
        black_box((augmented.q(), &newest));
    };
    let contestants = vec![
        in_c("C, steps", Vec::new()),
        in_c("C, with β", vec![0.0; 16 * (2 * D + 1)]),
        ("f64, step", Box::new(steps)),
        ("f64, with β", Box::new(with_beta)),
    ];
    compare(&format!("{title}, Störmer–Verlet with β"), contestants, 50_000);
}

fn small<'a, const D: usize, S, P>(of: S, setting: &Setting<'_, D>, potential: P) -> Vec<Contestant<'a>>
where
    S: Scheme + ValidFor<Quadratic> + Copy + 'a,
    P: Potential<f64> + Potential<Fused> + Copy + 'a,
{
    let plain = setting.ours::<f64, _, _, _>(["f64, step", "f64, steps", "f64, merged"], of, potential, UnitMasses);
    let fused = setting.ours::<Fused, _, _, _>(["Fused, step", "Fused, steps", "Fused, \
        merged"], of, potential, UnitMasses);
    plain.into_iter().chain(fused).collect()
}

fn against<const D: usize, S, P>(title: &str, of: S, setting: &Setting<'_, D>, potential: P)
where
    S: Scheme + ValidFor<Quadratic> + Copy + 'static,
    P: Potential<f64> + Potential<Fused> + Copy,
{
    for compiled in COMPILED {
        let mut contestants = vec![setting.by_gcc(compiled, of)];
        contestants.extend(small(of, setting, potential));
        compare(title, contestants, 100_000);
    }
}

const MASSES: [f64; 6] = [
    1.000_005_976_823_1,
    0.000_954_786_104_043,
    0.000_285_583_733_151,
    0.000_043_727_316_454_6,
    0.000_051_775_913_844_879_3,
    7.692_307_692_307_69e-9,
];

fn planets() {
    let problem = shadowstep::problems::problem("outer-solar-system").expect("it is shipped");
    let values = problem.setup(&[], 40).expect("the defaults are valid").values;
    let array = |x: Vec<f64>| <[f64; 18]>::try_from(x).expect("six bodies");
    let setting = Setting { problem: 2, q: array(values.q(&())), p: array(values.p(&())), h: "100" };
    let masses: [f64; 18] = std::array::from_fn(|i| MASSES[i / 3]);
    let g = 2.959_122_082_86e-4;
    // SAFETY: the arrays are as long as stated
    COMPILED.into_iter().for_each(|compiled| unsafe { (compiled.set_initial)(18, masses.as_ptr(), 1, [g].as_ptr()) });
    let plain = Pairs::<_, 3>::all(6, Gravity { g, m: MASSES.to_vec() }).expect("six bodies");
    let fused = Pairs::<_, 3>::all(6, Gravity { g: Fused(g), m: MASSES.map(Fused).to_vec() }).expect("six bodies");
    let plain_masses = DiagonalMasses::from_numbers(&masses).expect("positive masses");
    let fused_masses = DiagonalMasses::from_numbers(&masses.map(Fused)).expect("positive masses");
    for compiled in COMPILED {
        let mut contestants = vec![setting.by_gcc(compiled, StormerVerlet)];
        let (plain, fused) = (plain.clone(), fused.clone());
        let (plain_masses, fused_masses) = (plain_masses.clone(), fused_masses.clone());
        contestants.extend(setting.ours::<f64, _, _, _>(
            ["f64, step", "f64, steps", "f64, merged"],
            StormerVerlet,
            plain,
            plain_masses,
        ));
        contestants.extend(setting.ours::<Fused, _, _, _>(
            ["Fused, step", "Fused, steps", "Fused, merged"],
            StormerVerlet,
            fused,
            fused_masses,
        ));
        compare("the Sun and five planets, Störmer–Verlet", contestants, 20_000);
    }
    with_beta("the Sun and five planets", &setting, plain, plain_masses);
}

fn main() {
    let kepler = Setting { problem: 0, q: [0.4, 0.0], p: [0.0, 2.0], h: "1/100" };
    let star = Setting { problem: 1, q: [0.1, 0.2], p: [0.1, 0.0], h: "1/20" };
    let pendulum = Setting { problem: 3, q: [1.0], p: [0.0], h: "1/20" };
    against("Kepler, Störmer–Verlet", StormerVerlet, &kepler, Kepler);
    against("Kepler, Yoshida 4", Yoshida4, &kepler, Kepler);
    against("Kepler, SRKN6b", Srkn6b, &kepler, Kepler);
    against("Hénon–Heiles, Störmer–Verlet", StormerVerlet, &star, HenonHeiles);
    against("Hénon–Heiles, Yoshida 4", Yoshida4, &star, HenonHeiles);
    against("Hénon–Heiles, SRKN6b", Srkn6b, &star, HenonHeiles);
    planets();
    against("pendulum, Störmer–Verlet", StormerVerlet, &pendulum, Pendulum);
    against("pendulum, SRKN6b", Srkn6b, &pendulum, Pendulum);
    with_beta("Kepler", &kepler, Kepler, UnitMasses);
    with_beta("Hénon–Heiles", &star, HenonHeiles, UnitMasses);
    with_beta("pendulum", &pendulum, Pendulum, UnitMasses);
}
