//! At 120 digits a step allocates nothing, neither in Rust nor in GMP and MPFR, except inside MPFR's elementary
//! functions.
//!
//! Both allocators count; this file is a program of its own, so that no other test runs beside it.
#![cfg(feature = "mpfr")]
#![expect(unsafe_code, reason = "counting allocators are unsafe by their nature")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::c_void;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use gmp_mpfr_sys::gmp;
use rug::Float;
use shadowstep::number::{Number, Precision};
use shadowstep::problems::{HenonHeiles, Kepler};
use shadowstep::shadow::{Bilinear, BuildEstimator, Central, Estimator, SelectionRule, ShadowEnergy, StoppingRule};
use shadowstep::systems::formula::{FormulaKinetic, FormulaPair, FormulaPotential};
use shadowstep::systems::kepler_drift::KeplerDrift;
use shadowstep::systems::pairs::{Ends, Pairs, Separation};
use shadowstep::tables::{TableScheme, shipped, shipped_names};
use shadowstep::{
    DiagonalMasses, FullMasses, Kinetic, Motion, Potential, Scheme, Stepper, UnitMasses, ValidFor, exact, kinetic,
    potential,
};

static RUST: AtomicU64 = AtomicU64::new(0);
static GMP: AtomicU64 = AtomicU64::new(0);

struct Counting;

// SAFETY: every call goes on to the system's allocator
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        RUST.fetch_add(1, Relaxed);
        // SAFETY: as the caller promises
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as the caller promises
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

unsafe extern "C" {
    fn malloc(size: usize) -> *mut c_void;
    fn realloc(pointer: *mut c_void, size: usize) -> *mut c_void;
    fn free(pointer: *mut c_void);
}

extern "C" fn count_allocate(size: usize) -> *mut c_void {
    GMP.fetch_add(1, Relaxed);
    // SAFETY: any size is allowed
    unsafe { malloc(size) }
}

extern "C" fn count_reallocate(pointer: *mut c_void, _: usize, size: usize) -> *mut c_void {
    GMP.fetch_add(1, Relaxed);
    // SAFETY: GMP hands back what it got from `count_allocate`
    unsafe { realloc(pointer, size) }
}

extern "C" fn release(pointer: *mut c_void, _: usize) {
    // SAFETY: GMP hands back what it got from `count_allocate`
    unsafe { free(pointer) }
}

/// (allocations of Rust, allocations of GMP and MPFR) during the work.
fn allocations(work: impl FnOnce()) -> (u64, u64) {
    let before = (RUST.load(Relaxed), GMP.load(Relaxed));
    work();
    (RUST.load(Relaxed) - before.0, GMP.load(Relaxed) - before.1)
}

kinetic! {
    /// A polynomial.
    struct Quartic;
    T(px, py) = (px^4 + py^4)/4 + px^2*py
}

potential! {
    /// A polynomial.
    struct Spring;
    pair U(d) = d^2/2 + d^4/4
}

const STEPS: u64 = 10;

/// Allocations of ten steps of each kind by every shipped scheme, after one step that may make caches.
fn of_all_schemes<P: Potential<Float> + Clone, K: Kinetic<Float> + Clone>(
    motion: &Motion<Float, Vec<Float>, P, K>,
    report: impl FnMut(&str, u64, (u64, u64)),
) where
    TableScheme: ValidFor<K::Class>,
{
    of_schemes(shipped_names().into_iter().filter_map(shipped), motion, report);
}

fn of_schemes<C, P: Potential<Float> + Clone, K: Kinetic<Float> + Clone>(
    schemes: impl IntoIterator<Item = TableScheme<C>>,
    motion: &Motion<Float, Vec<Float>, P, K>,
    mut report: impl FnMut(&str, u64, (u64, u64)),
) where
    TableScheme<C>: ValidFor<K::Class>,
{
    for scheme in schemes {
        let name = scheme.summary().name.to_owned();
        let stepper = Stepper::with_context(scheme, "1/50", &motion.context()).unwrap();
        let mut motion = motion.clone();
        stepper.step_augmented(&mut motion);
        let evaluations = motion.evaluations();
        let found = allocations(|| {
            for _ in 0..STEPS {
                stepper.step(&mut motion);
                stepper.step_augmented(&mut motion);
                stepper.step_back(&mut motion);
                stepper.step_back_augmented(&mut motion);
            }
        });
        report(&name, motion.evaluations() - evaluations, found);
    }
}

fn numbers(texts: [&str; 2], digits: &Precision) -> Vec<Float> {
    texts.map(|text| Float::from_rational(&exact(text).unwrap(), digits)).to_vec()
}

/// One test, as the counters are for the whole program.
#[test]
fn steps_and_estimators_do_not_allocate() {
    // SAFETY: the three functions are a matching set over one allocator, installed before the first number is made
    unsafe { gmp::set_memory_functions(Some(count_allocate), Some(count_reallocate), Some(release)) };
    let digits = Precision::digits(120).unwrap();
    let (q, p) = (numbers(["0.1", "0.2"], &digits), numbers(["0.1", "0"], &digits));
    let masses = ["2", "1/3"].map(|m| exact(m).unwrap());
    let diagonal = DiagonalMasses::<Float>::new(&masses, &digits).unwrap();
    let rows = [["2", "1/3"], ["1/3", "1"]].map(|row| row.map(|m| exact(m).unwrap()).to_vec());
    let full = FullMasses::<Float>::from_inverse(&rows, &digits).unwrap();

    // the counters count
    assert_ne!(allocations(|| drop(Float::new(400))).1, 0, "GMP's allocations are seen");
    assert_ne!(allocations(|| drop(Box::new([0_u8; 64]))).0, 0, "Rust's allocations are seen");

    // polynomials only: nothing at all
    let nothing = |name: &str, _: u64, found: (u64, u64)| assert_eq!(found, (0, 0), "{name} on Hénon–Heiles");
    of_all_schemes(&Motion::new(HenonHeiles, UnitMasses, q.clone(), p.clone()).unwrap(), nothing);
    of_all_schemes(&Motion::new(HenonHeiles, diagonal, q.clone(), p.clone()).unwrap(), nothing);
    of_all_schemes(&Motion::new(HenonHeiles, full, q, p).unwrap(), nothing);

    // a formula read at run time
    let formula = FormulaPotential::new("(x^2 + y^2)/2 + x^2*y - y^3/3", &["x", "y"], &[]).unwrap();
    let (q_too, p_too) = (numbers(["0.1", "0.2"], &digits), numbers(["0.1", "0"], &digits));
    of_all_schemes(&Motion::new(formula, UnitMasses, q_too, p_too).unwrap(), nothing);

    // neighbours, compiled and read
    let state = || (numbers(["0.1", "0.2"], &digits), numbers(["0.1", "0"], &digits));
    let (q, p) = state();
    of_all_schemes(
        &Motion::new(Pairs::<_, 1>::neighbours(2, Spring, Ends::Fixed).unwrap(), UnitMasses, q, p).unwrap(),
        nothing,
    );
    let spring = FormulaPair::new("d^2/2 + d^4/4", Separation::Difference, &[], &[]).unwrap();
    let (q, p) = state();
    of_all_schemes(
        &Motion::new(Pairs::<_, 1>::neighbours(2, spring, Ends::Fixed).unwrap(), UnitMasses, q, p).unwrap(),
        nothing,
    );

    // kinetic energies from formulas, compiled and read
    let any: Vec<_> = shipped_names().into_iter().filter_map(|name| shipped(name)?.for_every_kinetic().ok()).collect();
    assert!(!any.is_empty(), "schemes for every T(p)");
    let state = || (numbers(["0.1", "0.2"], &digits), numbers(["0.1", "0.3"], &digits));
    let (q, p) = state();
    of_schemes(any.clone(), &Motion::new(HenonHeiles, Quartic, q, p).unwrap(), nothing);
    let formula = FormulaKinetic::new("(px^4 + py^4)/4 + px^2*py", &["px", "py"], &[]).unwrap();
    let (q, p) = state();
    of_schemes(any, &Motion::new(HenonHeiles, formula, q, p).unwrap(), nothing);

    // a Kepler drift in f64 also where it computes in double-double, and after the first of such
    let mut drift = KeplerDrift::<f64>::new(&());
    let found = allocations(|| {
        for (v, t) in [(1.0, 0.1), (-4.0, 3.0), (0.3, 9.0), (-1.0, 2.0)] {
            let (mut q, mut p) = ([1.0, 0.1, 0.0], [v, 0.2, 0.1]);
            drift.advance(&1.0, &t, &mut q, &mut p);
        }
    });
    assert_eq!(found, (0, 0), "Kepler drifts in f64");
    let mut drift = KeplerDrift::<Float>::new(&digits);
    let (mut q, mut v) = (numbers(["0.4", "0"], &digits), numbers(["0", "2"], &digits));
    let [mu, t] = [1.0, 0.05].map(|x| Float::with_val(digits.in_bits(), x));
    let found = allocations(|| {
        for _ in 0..STEPS {
            drift.advance(&mu, &t, &mut q, &mut v);
        }
    });
    assert_eq!(found, (0, 0), "Kepler drifts at 120 digits");

    // Kepler: what its reciprocal square roots allocate, and nothing else
    let root = {
        let (mut x, a) = (Float::new(400), Float::with_val(400, 0.7));
        allocations(|| x.assign_reciprocal_sqrt(&a)).1
    };
    let kepler = Motion::new(Kepler, UnitMasses, numbers(["0.4", "0"], &digits), numbers(["0", "2"], &digits)).unwrap();
    of_all_schemes(&kepler, |name, evaluations, found| {
        assert_eq!(found, (0, evaluations * root), "{name} on Kepler: Rust, GMP");
    });

    estimators_do_not_allocate(&digits);
    a_monitor_does_not_allocate(&digits);
}

fn estimators_do_not_allocate(digits: &Precision) {
    does_not_allocate(&Central::fixed(5), digits);
    does_not_allocate(&Central::fixed_with_error(5), digits);
    does_not_allocate(&Central::best(20, StoppingRule::Full), digits);
    does_not_allocate(&Central::best_with_error(20, StoppingRule::Early, SelectionRule::Robust), digits);
    does_not_allocate(&Bilinear::with_error(5), digits);
    does_not_allocate(&Bilinear::best(12), digits);
}

fn does_not_allocate(settings: &impl BuildEstimator<Float>, digits: &Precision) {
    let stepper = Stepper::with_context(shipped("stormer-verlet").unwrap(), "1/50", digits).unwrap();
    let mut estimator = settings.build(stepper.step_size(), 2, digits).unwrap();
    let mut motion =
        Motion::new(HenonHeiles, UnitMasses, numbers(["0.1", "0.2"], digits), numbers(["0.1", "0"], digits)).unwrap();
    let mut advance = || {
        stepper.step_augmented(&mut motion);
        estimator.push(motion.q(), motion.p(), motion.increments()).is_some()
    };
    while !advance() {}
    assert_eq!(allocations(|| assert!(advance())), (0, 0));
}

/// Neither between windows nor in one, nor where it merges its blocks, after 64 windows.
fn a_monitor_does_not_allocate(digits: &Precision) {
    let stepper = Stepper::with_context(shipped("stormer-verlet").unwrap(), "1/50", digits).unwrap();
    let mut motion =
        Motion::new(HenonHeiles, UnitMasses, numbers(["0.1", "0.2"], digits), numbers(["0.1", "0"], digits)).unwrap();
    let mut monitor = ShadowEnergy::new(stepper, &mut motion, &Bilinear::with_error(4)).unwrap().every(20);
    let mut windows = |steps| {
        let samples = (0..steps).map(|_| monitor.step(&mut motion).unwrap().is_some());
        samples.filter(|is_some| *is_some).count()
    };
    windows(40);
    assert_eq!(allocations(|| assert_eq!(windows(1400), 70)), (0, 0));
}
