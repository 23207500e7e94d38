use shadowstep::{Motion, UnitMasses, problems::Kepler};

fn main() {
    let _ = Motion::new(Kepler, UnitMasses, [1, 0], [0, 1]);
}
