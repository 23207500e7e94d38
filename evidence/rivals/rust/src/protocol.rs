//! The protocol of all contestants: a request is a line `PROBLEM METHOD PARAMETER SAMPLES UNTIL`, its answer a line
//! with the seconds that the integration took and the state q, p after each of the samples, which are equally far apart
//! in time.

use std::fmt::Write as _;
use std::io::BufRead as _;
use std::time::Duration;

use cpu_time::ProcessTime;

/// One integration.
pub struct Request {
    /// The problem's name.
    pub problem: String,
    /// A scheme or another method of integration.
    pub method: String,
    /// The number of steps, or a tolerance.
    pub parameter: String,
    /// How many times the state is reported.
    pub samples: u64,
    /// The time at the end.
    pub until: f64,
}

impl Request {
    fn of(line: &str) -> Request {
        let words: Vec<_> = line.split_whitespace().collect();
        let [problem, method, parameter, samples, until] = words[..] else { panic!("not a request: {line}") };
        Request {
            problem: problem.to_owned(),
            method: method.to_owned(),
            parameter: parameter.to_owned(),
            samples: samples.parse().expect("a number of samples"),
            until: until.parse().expect("a time"),
        }
    }

    /// The parameter as the number of steps.
    pub fn steps(&self) -> u64 {
        self.parameter.parse().expect("a number of steps")
    }
}

/// The time of an integration and its states.
#[derive(Default)]
pub struct Answer {
    time: Duration,
    states: String,
}

impl Answer {
    /// Does a part of the integration and measures its time on the processor, so that other programs on the
    /// machine do not count.
    pub fn time<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let start = ProcessTime::now();
        let result = work();
        self.time += start.elapsed();
        result
    }

    /// The time of one trajectory of a number that were computed at once.
    #[allow(dead_code, reason = "the other crates compute one trajectory at a time")]
    pub fn divide_time(&mut self, trajectories: u32) {
        self.time /= trajectories;
    }

    /// Reports a state.
    pub fn state(&mut self, numbers: impl IntoIterator<Item = f64>) {
        for number in numbers {
            write!(self.states, " {number:e}").expect("a text takes everything");
        }
    }
}

/// Answers requests until there are no more.
pub fn serve(answer: impl Fn(&Request) -> Answer) {
    for line in std::io::stdin().lock().lines() {
        let Answer { time, states } = answer(&Request::of(&line.expect("text")));
        println!("{:e}{states}", time.as_secs_f64());
    }
}
