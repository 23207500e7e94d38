use shadowstep_analysis::search::*;
use shadowstep_schemes::{Source, shipped, shipped_proved};
use std::time::Instant;
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let request = Request::read(&Source { path: path.into(), text }).unwrap();
    let search = Search::new(request, &|name, _| shipped(name)).unwrap();
    for name in std::env::args().skip(2) {
        let p = shipped_proved(&name).unwrap();
        println!("{name}: {:?}", MEASURES.map(|(n, m)| (n, search.measure(m, p))));
    }
    let t = Instant::now();
    let all: Vec<_> = (0..search.starts()).filter_map(|s| search.start(s)).collect();
    println!("{} of {} in {:?}", all.len(), search.starts(), t.elapsed());
    let mut goals: Vec<f64> = all.iter().map(|c| c.goal).collect();
    goals.sort_by(f64::total_cmp);
    println!("{:?}", &goals[..goals.len().min(12)]);
    for c in search.best(&all) {
        println!("{} {:?} {:?}", search.stages(c.start), c.values, c.weights);
        match search.table(c, "found", Some(50), &|name, _| shipped(name)) {
            Ok(p) => println!("{}", p.text),
            Err(e) => println!("{e:?}"),
        }
    }
}
