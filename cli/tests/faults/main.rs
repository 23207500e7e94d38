//! Faults: the program is killed, interrupted, started twice; disks are full or read-only, folders vanish, clocks jump,
//! checkpoints are damaged. Whatever happens, no file has its name before it is complete, nothing that is damaged is
//! used, and the command, given again, comes to the bytes of one that was never disturbed.
//!
//! The disturbances are random; `FAULTS_SEED=7 cargo test -p shadowstep-cli --test faults` repeats those of a seed,
//! which is printed.
#![cfg(target_os = "linux")]

mod commands;
mod random;
mod shim;
mod work;

use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use commands::{COMMANDS, Disturbed, TIMED};
use random::Random;
use work::{Undisturbed, Work, message, undisturbed};

/// How often each command is killed at a random moment.
const KILLS: usize = 50;

/// How often each command is killed, and how often it fails, in a random one of the calls that change files.
const CALLS: usize = 15;

/// How often each command gets a signal at a random moment.
const SIGNALS: usize = 8;

/// In how many of its first calls that change files each command gets a signal.
const FIRST_CALLS: u64 = 4;

/// Error numbers of Linux.
const ERRORS: [(u32, &str); 3] =
    [(28, "No space left on device"), (30, "Read-only file system"), (13, "Permission denied")];

/// Random numbers of a test, of the seed FAULTS_SEED, or of the time; the seed is printed.
fn random_of(name: &str) -> Random {
    let of_time = || SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_nanos() as u64 % 1_000_000;
    let seed = std::env::var("FAULTS_SEED").map_or_else(|_| of_time(), |seed| seed.parse().unwrap());
    println!("{name}: FAULTS_SEED={seed}");
    Random::of_seed(name.bytes().fold(seed, |seed, byte| seed.wrapping_mul(31).wrapping_add(u64::from(byte))))
}

fn each(test: fn(Disturbed, &mut Random), name: &str) {
    for &command in COMMANDS {
        test(command, &mut random_of(&format!("{name}, {}", command.name)));
    }
}

/// A part of an undisturbed command. One that is resumed is disturbed several times on its way.
fn part(command: Disturbed, random: &mut Random) -> f64 {
    random.part() * if command.resumes { 0.2 } else { 1.1 }
}

/// A moment of a command.
fn moment(command: Disturbed, time: Duration, random: &mut Random) -> Duration {
    time.mul_f64(part(command, random))
}

/// One of the calls of a command.
fn call(command: Disturbed, calls: u64, random: &mut Random) -> String {
    (1 + (part(command, random) * calls as f64) as u64).to_string()
}

fn killed_at_random_moments(command: Disturbed, random: &mut Random) {
    let Undisturbed { files, time, .. } = undisturbed(command);
    let mut work = Work::new(command);
    for kill in 1..=KILLS {
        let mut child = work.program().spawn().unwrap();
        sleep(moment(command, time, random));
        child.kill().unwrap();
        let is_complete = child.wait().unwrap().success();
        work.check(&files, &format!("after kill {kill}"));
        if is_complete || !command.resumes {
            work.completes(&files, &format!("after kill {kill}"));
            work = Work::new(command);
        }
    }
    work.completes(&files, "after all kills");
}

#[test]
fn a_command_can_be_killed_at_any_moment() {
    each(killed_at_random_moments, "kills");
}

fn killed_in_calls(command: Disturbed, random: &mut Random) {
    let Undisturbed { files, calls, .. } = undisturbed(command);
    let mut work = Work::new(command);
    for _ in 0..CALLS {
        let call = call(command, calls, random);
        let when = format!("killed in call {call}");
        let output = work.with_fault(&[("FAULT_KILL", call)]).output().unwrap();
        let is_complete = output.status.success();
        assert!(output.status.signal() == Some(9) || is_complete, "{when}: {}", message(&output));
        work.check(&files, &when);
        if is_complete || !command.resumes {
            work.completes(&files, &when);
            work = Work::new(command);
        }
    }
    work.completes(&files, "killed in calls");
}

#[test]
fn a_command_can_be_killed_in_any_call_that_changes_a_file() {
    each(killed_in_calls, "calls");
}

fn failing_calls(command: Disturbed, random: &mut Random) {
    let Undisturbed { files, calls, .. } = undisturbed(command);
    let mut work = Work::new(command);
    for (number, text) in ERRORS.into_iter().cycle().take(CALLS) {
        let call = call(command, calls, random);
        let when = format!("{} with {text} from call {call} on", command.name);
        let output = work.with_fault(&[("FAULT_ERRNO", number.to_string()), ("FAULT_FROM", call)]).output().unwrap();
        let (is_complete, err) = (output.status.success(), message(&output));
        // the last calls may be those that remove files, which need no room
        if !is_complete {
            assert!(matches!(output.status.code(), Some(2 | 3)), "{when}: {err}");
            let folder = work.folder.path().display().to_string();
            assert!(err.contains(text) && err.contains(&folder) && err.contains("hint: "), "{when}: {err}");
            work.check_without_litter(&files, &when);
        }
        if is_complete || !command.resumes {
            work.completes(&files, &when);
            work = Work::new(command);
        }
    }
    work.completes(&files, "with failing calls");
}

#[test]
fn a_full_or_read_only_disk_is_reported_and_the_command_can_be_given_again() {
    each(failing_calls, "errors");
}

fn interrupted(command: Disturbed, random: &mut Random) {
    let Undisturbed { files, time, .. } = undisturbed(command);
    let mut work = Work::new(command);
    for signal in ["INT", "TERM"].into_iter().cycle().take(SIGNALS) {
        let child = work.program().spawn().unwrap();
        sleep(moment(command, time, random));
        // the program may have ended
        let _ = Command::new("kill").args(["-s", signal, &child.id().to_string()]).stderr(Stdio::null()).status();
        let output = child.wait_with_output().unwrap();
        let err = message(&output);
        work.check_without_litter(&files, &format!("after SIG{signal}"));
        match output.status.code() {
            Some(3) => assert!(err.contains("interrupted"), "{err}"),
            // before it listened
            None => assert!(matches!(output.status.signal(), Some(2 | 15)), "{err}"),
            code => assert_eq!(code, Some(0), "{err}"),
        }
        if output.status.success() || !command.resumes {
            work.completes(&files, &format!("after SIG{signal}"));
            work = Work::new(command);
        }
    }
    work.completes(&files, "after all signals");
}

#[test]
fn an_interrupted_command_leaves_nothing_incomplete() {
    each(interrupted, "signals");
}

fn interrupted_in_calls(command: Disturbed, random: &mut Random) {
    let Undisturbed { files, calls, .. } = undisturbed(command);
    // the first calls make the files of which the program must know when the signal comes
    let first = (1..=FIRST_CALLS).map(|call| (call.to_string(), true));
    let chosen: Vec<_> = first.chain((0..SIGNALS).map(|_| (call(command, calls, random), !command.resumes))).collect();
    let mut work = Work::new(command);
    for (signal, (call, is_alone)) in [2, 15].into_iter().cycle().zip(chosen) {
        let when = format!("signal {signal} in call {call}");
        let output = work.with_fault(&[("FAULT_SIGNAL", signal.to_string()), ("FAULT_KILL", call)]).output().unwrap();
        let err = message(&output);
        assert!(matches!(output.status.code(), Some(0 | 3)), "{} {when}: {err}", command.name);
        work.check_without_litter(&files, &when);
        if is_alone || output.status.success() {
            work.completes(&files, &when);
            work = Work::new(command);
        }
    }
    work.completes(&files, "interrupted in calls");
}

#[test]
fn an_interrupted_call_leaves_nothing_incomplete() {
    each(interrupted_in_calls, "signals in calls");
}

fn several_at_once(command: Disturbed, random: &mut Random) {
    let Undisturbed { files, time, .. } = undisturbed(command);
    let work = Work::new(command);
    let children: Vec<_> = (0..3)
        .map(|_| {
            let child = work.program().spawn().unwrap();
            sleep(time.mul_f64(0.2 * random.part()));
            child
        })
        .collect();
    let outputs: Vec<_> = children.into_iter().map(|child| child.wait_with_output().unwrap()).collect();
    for output in &outputs {
        let refused = output.status.code() == Some(2) && message(output).contains("another ");
        assert!(output.status.success() || refused, "{}: {}", command.name, message(output));
    }
    assert!(outputs.iter().any(|output| output.status.success()), "{}: all are refused", command.name);
    work.check(&files, "written by several");
    work.completes(&files, "written by several");
}

#[test]
fn several_commands_do_not_write_one_file() {
    each(several_at_once, "several");
}

#[test]
fn clocks_may_jump() {
    for command in COMMANDS.iter().copied().chain([TIMED]) {
        let mut random = random_of(&format!("clocks, {}", command.name));
        let Undisturbed { files, .. } = undisturbed(command);
        let work = Work::new(command);
        let output = work.with_fault(&[("FAULT_CLOCK", (random.next() >> 33).to_string())]).output().unwrap();
        assert!(output.status.success(), "{}: {}", command.name, message(&output));
        work.completes(&files, "with jumping clocks");
    }
}

/// The folder is removed while the command writes into it.
#[test]
fn a_folder_that_vanishes_is_reported() {
    let long = COMMANDS[0].scene.replace("steps = 20000", "steps = 100000000");
    let work = Work::new(COMMANDS[0]);
    let path = work.folder.path();
    fs::write(path.join("scene.toml"), long).unwrap();
    let child = work.program().spawn().unwrap();
    let begun = Instant::now();
    // the limit only ends a test that hangs
    while !path.join("out.csv.checkpoint").exists() {
        assert!(begun.elapsed() < Duration::from_secs(600), "no checkpoint comes");
        sleep(Duration::from_millis(1));
    }
    fs::rename(path, path.with_extension("away")).unwrap();
    let output = child.wait_with_output().unwrap();
    fs::rename(path.with_extension("away"), path).unwrap();
    let err = message(&output);
    assert_eq!(output.status.code(), Some(3), "{err}");
    assert!(err.contains("out.csv.checkpoint.new cannot be written: No such file or directory"), "{err}");
    assert!(err.contains("it is resumed from its last checkpoint"), "{err}");
}
