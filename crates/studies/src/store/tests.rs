use std::fs;
use std::path::Path;

use rayon::ThreadPoolBuilder;
use tempfile::TempDir;

use std::sync::Mutex;

use super::*;
use crate::{Continues, Progress};

/// Sums 1/k² up to n: the last bits depend on every term. Odd numbers above 1000 fail.
#[derive(Serialize)]
struct Sum<'a> {
    n: u32,
    #[serde(skip)]
    begun: &'a Mutex<Vec<u32>>,
}

impl Sum<'_> {
    fn sum(&self) -> Result<f64, Error> {
        self.begun.lock().unwrap().push(self.n);
        match self.n {
            13 => Ok(f64::NAN),
            n if n > 1000 && n % 2 == 1 => Err(Error::run(format!("{n} is odd"), "choose another")),
            n => Ok((1..=n).map(|k| f64::from(k).powi(-2)).sum()),
        }
    }
}

impl Calculation for Sum<'_> {
    type Outcome = f64;
    type Shared = ();

    /// Multiples of a hundred are computed together.
    fn group(&self) -> Option<String> {
        self.n.is_multiple_of(100).then(|| "hundreds".to_owned())
    }

    fn cost(&self) -> f64 {
        f64::from(self.n)
    }

    fn compute(&self, (): &(), _: Continues<'_>) -> Result<f64, Error> {
        self.sum()
    }
}

/// Keeps failures.
#[derive(Default)]
struct Failures(Vec<String>);

impl Observer for Failures {
    fn failed(&mut self, error: &Error) {
        self.0.push(error.to_string());
    }
}

/// Runs the sums in a folder; returns the outcomes, and which were computed, in the order in which they began.
fn sums(folder: &Path, threads: usize, numbers: &[u32]) -> (Found, Vec<u32>) {
    let begun = Mutex::new(Vec::new());
    let sums: Vec<_> = numbers.iter().map(|&n| Sum { n, begun: &begun }).collect();
    let (mut store, mut failures) = (Store::open(folder, &mut ()).unwrap(), Failures::default());
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let outcomes = pool.install(|| store.compute(&sums, &mut failures)).unwrap();
    drop(sums);
    (Found { outcomes, failures: failures.0 }, begun.into_inner().unwrap())
}

/// The outcomes and failures of sums.
struct Found {
    outcomes: Vec<Option<f64>>,
    failures: Vec<String>,
}

fn file(folder: &Path) -> String {
    fs::read_to_string(folder.join("results.jsonl")).unwrap()
}

const NUMBERS: [u32; 7] = [30, 1, 500, 77, 30, 2000, 400];

#[test]
fn outcomes_do_not_depend_on_the_number_of_threads() {
    let expected = NUMBERS.map(|n| Some((1..=n).map(|k| f64::from(k).powi(-2)).sum::<f64>().to_bits()));
    for threads in [1, 2, 3] {
        let folder = TempDir::new().unwrap();
        let (found, mut begun) = sums(folder.path(), threads, &NUMBERS);
        assert_eq!(found.outcomes.iter().map(|sum| sum.map(f64::to_bits)).collect::<Vec<_>>(), expected);
        assert!(found.failures.is_empty());
        begun.sort_unstable();
        assert_eq!(begun, [1, 30, 77, 400, 500, 2000], "equal tasks are computed once");
    }
}

/// If the program ends after any byte, all complete lines are kept, and the rest is computed.
#[test]
fn interrupted_anywhere_it_can_be_resumed() {
    let folder = TempDir::new().unwrap();
    let (all, _) = sums(folder.path(), 1, &NUMBERS);
    let whole = file(folder.path());
    for length in 0..=whole.len() {
        fs::write(folder.path().join("results.jsonl"), &whole[..length]).unwrap();
        let (again, begun) = sums(folder.path(), 1, &NUMBERS);
        assert_eq!(again.outcomes, all.outcomes);
        let kept = whole[..length].matches('\n').count().saturating_sub(1);
        assert_eq!(begun, [500, 2000, 400, 77, 30, 1][kept..], "after {length} bytes");
        let without_times = |text: &str| -> Vec<String> {
            text.lines().map(|line| line.split(",\"seconds\"").next().unwrap().to_owned()).collect()
        };
        assert_eq!(without_times(&file(folder.path())), without_times(&whole));
    }
}

/// One bit of a byte at a time: whatever it makes of the file, no other outcome comes out of it.
#[test]
fn a_flipped_bit_is_refused_or_does_no_harm() {
    let folder = TempDir::new().unwrap();
    let (all, _) = sums(folder.path(), 1, &NUMBERS);
    let path = folder.path().join("results.jsonl");
    let whole = fs::read(&path).unwrap();
    let mut refused = 0;
    for place in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[place] ^= 1 << (place % 8);
        for aside in fs::read_dir(folder.path()).unwrap() {
            fs::remove_file(aside.unwrap().path()).unwrap();
        }
        fs::write(&path, &bytes).unwrap();
        match Store::open(folder.path(), &mut ()) {
            Err(_) => refused += 1,
            Ok(store) => {
                drop(store);
                assert_eq!(sums(folder.path(), 1, &NUMBERS).0.outcomes, all.outcomes, "byte {place}");
            }
        }
    }
    // the version, the line feeds and the seconds are not protected: their changes do no harm
    assert!(refused * 10 > whole.len() * 8, "{refused} of {}", whole.len());
}

#[test]
fn failures_are_reported_and_the_others_are_done() {
    let folder = TempDir::new().unwrap();
    let (found, _) = sums(folder.path(), 2, &[10, 1001, 13, 20, 1001]);
    assert_eq!(found.outcomes.iter().map(Option::is_some).collect::<Vec<_>>(), [true, false, false, true, false]);
    let [odd, infinite] = &found.failures[..] else { panic!("{:?}", found.failures) };
    assert!(odd.contains("1001 is odd") && infinite.contains("cannot be read back"), "{odd} {infinite}");
    // they are tried again, and only they
    let (_, mut begun) = sums(folder.path(), 2, &[10, 1001, 13, 20]);
    begun.sort_unstable();
    assert_eq!(begun, [13, 1001]);
}

/// Stops after some questions, and keeps the progress.
struct Impatient {
    questions: usize,
    seen: Vec<Progress>,
}

impl Observer for Impatient {
    fn progress(&mut self, progress: Progress) {
        self.seen.push(progress);
    }

    fn stops(&mut self) -> bool {
        self.questions -= 1;
        self.questions == 0
    }
}

#[test]
fn what_is_done_is_saved_when_it_is_stopped() {
    let folder = TempDir::new().unwrap();
    let begun = Mutex::new(Vec::new());
    let due: Vec<_> = NUMBERS.iter().map(|&n| Sum { n, begun: &begun }).collect();
    let mut observer = Impatient { questions: 3, seen: Vec::new() };
    let pool = ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let mut store = Store::open(folder.path(), &mut ()).unwrap();
    let stopped = pool.install(|| store.compute(&due, &mut observer)).unwrap_err();
    assert_eq!(
        stopped.to_string(),
        "interrupted: 2 of 6 calculations are saved\n  hint: the same command computes the others"
    );
    // within the group of 500, 2000 and 400, of 3008 in all
    let last = observer.seen.last().unwrap();
    assert_eq!((last.done, last.all), (2, 6));
    let fractions: Vec<_> = observer.seen.iter().map(|progress| progress.fraction).collect();
    assert!(fractions.is_sorted() && (last.fraction - 500.0 / 3008.0).abs() < 1e-9, "{fractions:?}");
    drop(store);
    assert_eq!(sums(folder.path(), 1, &NUMBERS).1, [400, 77, 30, 1]);
}

#[test]
fn files_of_another_version_are_renamed() {
    let folder = TempDir::new().unwrap();
    let old = "{\"shadowstep\":\"0.0.1\"}\n{\"task\":{\"n\":30},\"outcome\":1.0,\"seconds\":1}\n";
    for aside in ["results-0.0.1.jsonl", "results-0.0.1-2.jsonl"] {
        fs::write(folder.path().join("results.jsonl"), old).unwrap();
        assert_eq!(sums(folder.path(), 1, &[30]).1, [30]);
        assert_eq!(fs::read_to_string(folder.path().join(aside)).unwrap(), old);
    }
}

#[test]
fn two_stores_cannot_have_one_folder() {
    let folder = TempDir::new().unwrap();
    let store = Store::open(folder.path(), &mut ()).unwrap();
    let refused = format!("{:?}", Store::open(folder.path(), &mut ()).unwrap_err());
    assert!(refused.contains("another process uses"), "{refused}");
    drop(store);
    Store::open(folder.path(), &mut ()).unwrap();
}

#[test]
fn a_file_beyond_the_limit_is_not_read() {
    let folder = TempDir::new().unwrap();
    // of zeros that take no place on the disk
    fs::File::create(folder.path().join("results.jsonl")).unwrap().set_len((1 << 30) + 1).unwrap();
    let refused = format!("{:?}", Store::open(folder.path(), &mut ()).unwrap_err());
    assert!(refused.contains("it is longer than 1024 MiB"), "{refused}");
}

#[test]
fn other_files_are_not_changed() {
    let head = format!("{{\"shadowstep\":\"{}\"}}\n", env!("CARGO_PKG_VERSION"));
    for (text, expected) in [
        ("a list of mine".to_owned(), "is not a file of outcomes"),
        ("a list\nof mine\n".to_owned(), "is not a file of outcomes"),
        (format!("{head}nonsense\n"), "results.jsonl:2: not an outcome of a task"),
        (
            format!("{head}{{\"task\":1,\"outcome\":2}}\n"),
            "results.jsonl:2: not an outcome of a task: its hash is missing",
        ),
    ] {
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("results.jsonl"), &text).unwrap();
        let refused = format!("{:?}", Store::open(folder.path(), &mut ()).unwrap_err());
        assert!(refused.contains(expected), "{refused}");
        assert_eq!(file(folder.path()), text);
    }
}

/// 0.1 + 0.2 has 17 digits; without exact reading, some such numbers change their last bit in a file.
#[test]
fn numbers_come_back_to_the_last_bit() {
    let folder = TempDir::new().unwrap();
    let numbers: Vec<u32> = (14..200).collect();
    let (first, _) = sums(folder.path(), 1, &numbers);
    let (again, begun) = sums(folder.path(), 1, &numbers);
    assert!(begun.is_empty());
    for (n, (first, again)) in numbers.iter().zip(first.outcomes.iter().zip(again.outcomes)) {
        let exact: f64 = (1..=*n).map(|k| f64::from(k).powi(-2)).sum();
        assert_eq!((first.unwrap().to_bits(), again.unwrap().to_bits()), (exact.to_bits(), exact.to_bits()));
    }
}
