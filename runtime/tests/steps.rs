//! `Stepper::steps` of one system: the bits, evaluations and kept values of a loop of steps.

use shadowstep::kinetic::Quadratic;
use shadowstep::problems::HenonHeiles;
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Motion, Stepper, System, UnitMasses};

fn stepper() -> Stepper<TableScheme, f64> {
    Stepper::new(shipped("yoshida4").unwrap(), "1/20").unwrap()
}

fn check<M: System<Number = f64, Class = Quadratic> + Clone>(start: &M) {
    let stepper = stepper();
    for keeps_rate in [false, true] {
        for count in [0, 1, 2, 100] {
            let [mut one_by_one, mut together] = [start.clone(), start.clone()];
            one_by_one.before_augmented_step(keeps_rate);
            together.before_augmented_step(keeps_rate);
            (0..count).for_each(|_| stepper.step(&mut one_by_one));
            stepper.steps(std::slice::from_mut(&mut together), count);
            stepper.step_augmented(&mut one_by_one);
            stepper.step_augmented(&mut together);
            assert_eq!((one_by_one.q(), one_by_one.p()), (together.q(), together.p()));
            assert_eq!(one_by_one.increments().beta, together.increments().beta);
            assert_eq!(one_by_one.remainders(), together.remainders());
            assert_eq!(one_by_one.evaluations(), together.evaluations(), "{count} steps, {keeps_rate}");
        }
    }
}

#[test]
fn steps_of_arrays_are_those_one_by_one() {
    let motion = Motion::new(HenonHeiles, UnitMasses, [0.1, 0.2], [0.1, 0.0]).unwrap();
    check(&motion);
    check(&motion.clone().compensated());
    check(&motion.fixed_point(&[2.0; 2], &[2.0; 2]).unwrap());
}

#[test]
fn steps_of_vectors_are_those_one_by_one() {
    let motion = Motion::new(HenonHeiles, UnitMasses, vec![0.1, 0.2], vec![0.1, 0.0]).unwrap();
    check(&motion);
    check(&motion.compensated());
}
