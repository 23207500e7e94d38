use shadowstep::Stepper;

fn main() {
    let _ = Stepper::<_, f64>::new("yoshida4", "1/20");
}
