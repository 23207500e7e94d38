//! Numbers in messages are short, however long they are as they are given.

use std::fs;

use crate::program::shadowstep;

/// The longest run of digits in a text, without the line of the file that a message quotes.
fn longest_number(text: &str) -> usize {
    let own = text.lines().filter(|line| !line.contains(" | "));
    own.flat_map(|line| line.split(|c: char| !c.is_ascii_digit()).map(str::len)).max().unwrap_or(0)
}

#[test]
fn no_message_has_301_digits() {
    let zeros = "0".repeat(300);
    let folder = tempfile::tempdir().unwrap();
    let scene = |problem: &str, run: &str, more: &str| {
        let path = folder.path().join("scene.toml");
        let text = format!(
            "[problem]\n{problem}\n[run]\nscheme = \"yoshida4\"\n{run}\ndigits = \"double\"\n[output]\nenergy = \
                true\n{more}"
        );
        fs::write(&path, text).unwrap();
        format!("run {}", path.display())
    };
    let (kepler, time) = ("name = \"kepler\"", "[time]\ntransform = \"logarithmic\"");
    for command in [
        scene(kepler, "step = 0.1\nuntil = 1e300", ""),
        scene(kepler, &format!("step = 0.1\nuntil = 1{zeros}"), ""),
        scene(kepler, &format!("step = \"1/1{zeros}\"\nuntil = 1"), ""),
        scene(kepler, "step = 1e300\nuntil = 1", ""),
        scene(kepler, "step = 0.1\nuntil = -1e300", ""),
        scene(kepler, &format!("step = 0.1\nsteps = 1{zeros}"), ""),
        scene(kepler, "step = 0.1\nuntil = 1e300", time),
        scene(kepler, &format!("step = 0.1\nuntil = 1{zeros}"), time),
        scene(&format!("{kepler}\nparameters = {{ eccentricity = 1{zeros} }}"), "step = 0.1\nsteps = 10", ""),
        scene(&format!("{kepler}\nparameters = {{ gm = \"-1{zeros}\" }}"), "step = 0.1\nsteps = 10", ""),
        scene(kepler, "step = 0.1\nsteps = 10", &format!("windows = 1{zeros}")),
        scene(kepler, "step = 0.1\nsteps = 10", &format!("modified_energy = {{ accuracy = 1{zeros} }}")),
        "drift kepler --scheme yoshida4 --step 0.1 --until 1e300".to_owned(),
        "drift kepler --scheme yoshida4 --step 1e300 --until 1".to_owned(),
        format!("drift kepler --scheme yoshida4 --step 1/1{zeros} --until 1"),
        format!("drift kepler --scheme yoshida4 --step 0.1 --until 1 --set eccentricity=1{zeros}"),
        "chaos kepler --scheme yoshida4 --step 0.1 --until 1e300".to_owned(),
        "trace kepler --scheme yoshida4 --step 0.1 --until 1e300".to_owned(),
        "work-precision kepler --schemes yoshida4 --until 1e300".to_owned(),
        "advise kepler --until 1e300 --tolerance 1e-8".to_owned(),
    ] {
        let result = shadowstep(&command);
        assert_eq!(result.code, 2, "{command}: {}", result.err);
        assert!(longest_number(&result.err) <= 40, "{command}: {}", result.err);
    }
}
