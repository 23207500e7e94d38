//! The initial states that `ours initial` has printed, from the folder of the environment variable INITIAL.

pub struct Initial {
    pub parameters: Vec<f64>,
    pub masses: Vec<f64>,
    pub q: Vec<f64>,
    pub p: Vec<f64>,
}

impl Initial {
    pub fn read(problem: &str) -> Initial {
        let folder = std::env::var("INITIAL").expect("INITIAL is set");
        let text = std::fs::read_to_string(format!("{folder}/{problem}.txt")).expect("the file can be read");
        let numbers =
            |line: &str| line.split_whitespace().skip(1).map(|word| word.parse().expect("a number")).collect();
        let lines: Vec<Vec<f64>> = text.lines().map(numbers).collect();
        let [parameters, masses, q, p] = <[_; 4]>::try_from(lines).expect("four lines");
        Initial { parameters, masses, q, p }
    }

    /// (q, p/m)
    pub fn positions_and_velocities(&self) -> Vec<f64> {
        let velocities = self.p.iter().zip(&self.masses).map(|(p, m)| p / m);
        self.q.iter().copied().chain(velocities).collect()
    }
}
