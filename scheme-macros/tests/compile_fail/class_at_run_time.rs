//! A scheme whose class is known at run time only makes no steps before it is checked.

use shadowstep::problems::Kepler;
use shadowstep::tables::shipped;
use shadowstep::{Motion, Stepper, UnitMasses};

fn main() {
    let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap();
    let scheme = shipped("yoshida4").unwrap().for_many_parts().unwrap().at_run_time();
    Stepper::new(scheme, "1/20").unwrap().step(&mut motion);
}
