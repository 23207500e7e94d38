//! A fault of a scene has its line and column, a message and a hint; the exit code is 2.

use std::fs;

use crate::program::shadowstep;
use crate::scenes::{folder, names, run};

const GOOD: &str = r#"[problem]
potential = "k/sqrt(x^2 + y^2)"
coordinates = ["x", "y"]
parameters = { k = -1 }
masses = [1, 2]
[initial]
q = [1, 0]
p = [0, 1]
[run]
scheme = "yoshida4"
step = "1/20"
until = 2
digits = 30
[output]
energy = true
"#;

/// A text of the valid scene and its replacement; then place and message of the fault, and its hint.
const WRONG: &[(&str, &str, &str, &str)] = &[
    ("scheme =", "shceme =", "10:1: unknown key `shceme`", "did you mean `scheme`?"),
    ("digits = 30\n[output]", "[output]\ndigits = 30", "14:1: unknown key `digits`", "`digits` is a key of [run]"),
    ("[initial]", "[intial]", "6:2: unknown section `intial`", "did you mean [initial]?"),
    ("[output]\nenergy = true\n", "", "1:1: the section [output] is missing", "shadowstep scene kepler"),
    ("[initial]\nq = [1, 0]\np = [0, 1]\n", "", "2:13: potential requires `q` in [initial]", "add it"),
    ("step = \"1/20\"\n", "", "9:1: the key `step` is missing", "add `step = \"1/20\"`"),
    ("until = 2\n", "", "9:1: one of the keys `until`, `steps` is needed", "`until = 100` or `steps = 2000`"),
    (
        "potential = \"k/sqrt(x^2 + y^2)\"\n",
        "",
        "1:1: one of the keys `name`, `potential`, `pair`, `hamiltonian` is",
        "`potential =",
    ),
    ("coordinates = [\"x\", \"y\"]\n", "", "2:13: potential requires `coordinates`", "add `coordinates"),
    ("q = [1, 0]\n", "", "2:13: potential requires `q` in [initial]", "add it"),
    ("scheme = \"yoshida4\"", "scheme = 4", "10:10: this value is of the wrong kind", "found a whole number"),
    ("q = [1, 0]", "q = 1", "7:5: this value is of the wrong kind", "needed a list of numbers or lists of numbers, or"),
    ("digits = 30", "digits = 30.5", "13:10: this value is of the wrong kind", "needed a whole number"),
    ("q = [1, 0]", "q = [1, 0, 0]", "7:5: this list needs a number for each coordinate", "found 3 numbers, needed 2"),
    (
        "coordinates = [\"x\", \"y\"]",
        "coordinates = \"x\"",
        "3:15: this value is of the wrong kind",
        "a list of names in quotes",
    ),
    ("k = -1", "j = \"1 + 1\", k = \"z\"", "4:34: unknown name `z`", "1/10"),
    ("masses = [1, 2]", "masses = []", "5:10: this list is empty", "a list of numbers"),
    ("sqrt(x^2", "sqrt(z^2", "2:21: unknown name `z`", "a smooth formula"),
    ("\"k/sqrt(x", "\"\\u006b/sqrt(z", "2:13: unknown name `z`", "a smooth formula"),
    ("\"k/sqrt(x^2 + y^2)\"", "'''\nk/sqrt(x^2 + z^2)'''", "3:14: unknown name `z`", "a smooth formula"),
    ("x^2 + y^2)", "x^2 + y^2", "2:20: unexpected end: this `(` has no `)`", "a smooth formula"),
    ("k/sqrt(x^2", "k/abs(x^2", "2:16: `abs` is not smooth", "a smooth formula"),
    ("[\"x\", \"y\"]", "[\"x\", \"x\"]", "3:21: the coordinate `x` is named twice", "another name"),
    ("[\"x\", \"y\"]", "[\"x\", \"k\"]", "3:21: the coordinate `k` has the name of a parameter", "another name"),
    ("[\"x\", \"y\"]", "[\"x\", \"px\"]", "3:21: the coordinate `px` has the name of the momentum of `x`", "another"),
    ("[\"x\", \"y\"]", "[\"px\", \"x\"]", "3:22: the momentum `px` of `x` has the name of a coordinate", "another"),
    ("[\"x\", \"y\"]", "[\"x\", \"t\"]", "3:21: the coordinate `t` has the name of a column of the output", "another"),
    ("[\"x\", \"y\"]", "[\"x\", \"2y\"]", "3:21: `2y` is not a valid name", "begins with a letter"),
    ("k = -1", "k = \"1/0\"", "4:23: division by zero", "1/10"),
    ("k = -1", "k = \"2*x\"", "4:23: unknown name `x`", "1/10"),
    ("masses = [1, 2]", "masses = [1, -2]", "5:14: a mass of -2 is not positive", "masses must be positive"),
    ("masses = [1, 2]", "masses = [0, 2]", "5:11: a mass of 0 is not positive", "masses must be positive"),
    ("q = [1, 0]", "q = [\"1 + z\", 0]", "7:11: unknown name `z`", "known names: k"),
    ("q = [1, 0]", "q = [inf, 0]", "7:6: inf is not a finite number", "1/10"),
    ("q = [1, 0]", "q = [-nan, 0]", "7:6: -nan is not a finite number", "1/10"),
    (
        "q = [1, 0]",
        "q = [1e99999, 0]",
        "7:6: the exponent of this number is out of range: -10000 to 10000 is allowed",
        "1/10",
    ),
    ("q = [1, 0]", "q = [0x10, 0]", "7:6: this value is of the wrong kind", "decimal digits"),
    ("p = [0, 1]", "p = [0, 1]\nv = [0, 1]", "9:5: p and v are both given", "keep one of the two"),
    ("step = \"1/20\"", "step = 0", "11:8: step must be nonzero, not 0", "write step = "),
    ("step = \"1/20\"", "step = -0.05", "11:8: steps of -0.05 never reach the time 2", "positive values for both"),
    ("step = \"1/20\"", "step = 3", "11:8: a step of 3 is longer than the run until 2", "a smaller step size"),
    ("step = \"1/20\"", "step = 1e-20", "11:8: steps of 1e-20 until 2 are 2e20 steps", "the limit is 1e10"),
    ("until = 2", "until = 0", "12:9: until 0: the time must be nonzero", "such as 100"),
    ("until = 2", "until = 2\nsteps = 40", "13:9: until and steps are both given", "keep one of the two"),
    ("until = 2", "steps = 0", "12:9: 0 is out of range", "from 1 to"),
    ("step = \"1/20\"\nuntil = 2", "step = 0\nsteps = 2", "11:8: step must be nonzero, not 0", "write step = "),
    (
        "digits = 30",
        "digits = 5001",
        "10:10: yoshida4 has irrational weights, computed to at most 4980 digits",
        "use at most 4980 digits",
    ),
    ("digits = 30", "digits = 0", "13:10: 0 is out of range", "from 1 to 100000"),
    ("digits = 30", "digits = \"single\"", "13:10: `single` is not known here", "write \"double\""),
    ("digits = 30", "digits = \"30\"", "13:10: this number is in quotes", "write 30"),
    (
        "digits = 30",
        "digits = \"double\"\n[initial.extra]",
        "14:10: unknown key `extra`",
        "the keys of [initial] are q, p, v",
    ),
    ("\"yoshida4\"", "\"yoshida5\"", "10:10: there is no scheme `yoshida5`", "did you mean `yoshida4`?"),
    ("\"yoshida4\"", "\"mine.toml\"", "10:10: there is no file ", "give the path of a table"),
    ("\"yoshida4\"", "\"yoshida4\"\nfirst = \"kik\"", "11:9: `kik` is not known here", "write \"kick\" or \"drift\""),
    ("energy = true", "energy = false", "14:1: no output is selected", "energy = true"),
    ("energy = true", "energy = { evry = 2 }", "15:12: unknown key `evry`", "did you mean `every`?"),
    ("energy = true", "energy = { every = 0 }", "15:20: 0 is out of range", "from 1"),
    ("energy = true", "energy = \"yes\"", "15:10: this value is of the wrong kind", "needed true or false, or a table"),
    ("energy = true", "modified_energy = { order = 0 }", "15:29: 0 is out of range", "from 1 to 1000"),
    ("energy = true", "modified_energy = { order = \"best\" }", "15:29: `best` is not known", "write \"auto\""),
    (
        "energy = true",
        "modified_energy = { estimator = \"bilinear\", order = 1000 }",
        "15:53: 1000 is out of range",
        "from 1 to 256",
    ),
    ("energy = true", "modified_energy = { max_order = 1 }", "15:33: 1 is out of range", "from 2 to 1000"),
    (
        "energy = true",
        "modified_energy = { order = 4, stop = \"early\" }",
        "15:39: stop requires order = \"auto\", not order = 4",
        "remove it",
    ),
    ("energy = true", "modified_energy = { order = 4, rule = \"robust\" }", "15:39: rule requires order", "remove it"),
    (
        "energy = true",
        "modified_energy = { estimator = \"central\", accuracy = 1e-9 }",
        "15:55: accuracy requires estimator = \"bilinear\", not estimator = \"central\"",
        "write estimator = \"bilinear\"",
    ),
    (
        "energy = true",
        "modified_energy = { rule = \"least\" }",
        "15:28: rule requires estimator = \"central\"",
        "remove it",
    ),
    (
        "energy = true",
        "modified_energy = { estimator = \"bilinear\", accuracy = 0 }",
        "15:56: accuracy must be positive, not 0",
        "write accuracy = 1e-20",
    ),
    (
        "energy = true",
        "modified_energy = { estimator = \"bilinear\", accuracy = \"1e400\" }",
        "15:56: accuracy 1e400 is above 1e100, an error larger than any energy",
        "such as 1e-20",
    ),
    (
        "energy = true",
        "modified_energy = { estimator = \"bilinear\", order = 7 }",
        "15:53: with estimator = \"bilinear\" and an odd order the values are at times between the states",
        "an even order",
    ),
    ("energy = true", "modified_energy = { estimator = \"linear\" }", "15:33: `linear` is not known", "\"bilinear\""),
    ("energy = true", "modified_energy = { rule = \"best\" }", "15:28: `best` is not known here", "\"robust\""),
    (
        "energy = true",
        "energy = true\nfile = \"x.txt\"",
        "16:8: the name `x.txt` does not give the format",
        ".csv, .jsonl or .npy",
    ),
    (
        "energy = true",
        "energy = true\nfile = \"x.npy\"",
        "16:8: records of NumPy have double precision, not 30 digits",
        ".csv or .jsonl",
    ),
    (
        "digits = 30\n[output]\nenergy = true",
        "digits = \"double\"\n[output]\nenergy = true\nformat = \"npy\"",
        "16:10: records of NumPy require a file",
        "file = \"out.npy\"",
    ),
    ("energy = true", "energy = true\nfile = \"no/x.csv\"", "16:8: file ", "a folder that exists"),
    (
        "energy = true",
        "energy = true\nfile = \"scene.toml\"\nformat = \"csv\"",
        "16:8: the file is the scene",
        "another",
    ),
    ("energy = true", "energy = true\ncheckpoint = 9", "16:14: checkpoint requires `file`", "add `file = "),
    (
        "energy = true",
        "energy = true\nfile = \"x.csv\"\ncheckpoint = \"1 m\"",
        "17:14: `1 m` is not a valid time between checkpoints",
        "\"1 min\"",
    ),
    (
        "energy = true",
        "energy = true\nfile = \"x.csv\"\ncheckpoint = \"-1 s\"",
        "17:14: `-1 s` is not a valid time between checkpoints",
        "\"1 min\"",
    ),
    ("energy = true", "energy = yes", "15:10: string values must be quoted", ""),
    ("[output]", "[output", "14:", ""),
    ("[problem]", "[problem]\nname = \"kepler\"", "3:13: name and potential are both given", "keep one of the two"),
    ("masses =", "bodies = 2\nmasses =", "5:10: bodies requires `pair`", "remove `bodies`"),
    ("q = [1, 0]", "q = \"i\"", "7:5: this value is of the wrong kind", "needed a list of numbers"),
    ("q = [1, 0]", "q = [[1, 0]]", "7:5: this value is of the wrong kind", "needed a list of numbers"),
    ("potential =", "pair = \"d^2\"\npotential =", "2:8: potential and pair are both given", "keep one of the two"),
    ("until = 2", "until = 2\nuntil = 3", "13:1: duplicate key", "keep one of the two"),
];

#[test]
fn each_fault_has_its_place_and_message() {
    for (part, replacement, sentence, help) in WRONG {
        assert!(GOOD.contains(part), "{part}");
        complains(&GOOD.replacen(part, replacement, 1), sentence, help);
    }
}

/// However H is split.
#[test]
fn a_faulty_formula_has_its_place_in_every_split() {
    let faulty = GOOD.replacen("sqrt(x^2", "sqrt(z^2", 1);
    for (part, replacement) in [
        ("[initial]", "parts = \"linear\"\n[initial]"),
        ("[initial]", "parts = \"wisdom-holman\"\n[initial]"),
        ("[run]", "[time]\ntransform = \"logarithmic\"\n[run]"),
        ("[run]", "[time]\ntransform = \"power\"\nexponent = \"-1/2\"\n[run]"),
    ] {
        complains(&faulty.replacen(part, replacement, 1), "2:21: unknown name `z`", "a smooth formula");
    }
    let bodies = "[problem]\nparameters = { g = 1, r2 = 2 }\n[[body]]\nmass = 1\n[[body]]\nmass = 0.1\na = 1\n";
    let (_, run) = GOOD.split_at(GOOD.find("[run]").unwrap());
    complains(&format!("{bodies}{run}"), "2:23: with [[body]], `r2` is a name in", "give it another name");
}

/// The same for a scene with a kinetic energy.
const WRONG_KINETIC: &[(&str, &str, &str, &str)] = &[
    ("p = [0, 1]", "v = [0, 1]", "8:5: velocities `v` require masses, but T is given by `kinetic`", "the momenta `p`"),
    ("sqrt(k", "sqrt(x", "5:17: unknown name `x`", "px, py and the parameters; `momenta`"),
    ("sqrt(k", "abs(k", "5:12: `abs` is not smooth", "a smooth formula in the momenta"),
    ("sqrt(k", "sqrt((k", "5:16: unexpected end: this `(` has no `)`", "a smooth formula"),
    ("[initial]", "masses = [1, 1]\n[initial]", "6:10: kinetic and masses are both given", "keep one of the two"),
    ("[initial]", "momenta = [\"px\"]\n[initial]", "6:11: this list needs a name for each", "found 1, needed 2"),
    ("[initial]", "momenta = [\"px\", \"x\"]\n[initial]", "6:18: the momentum `x` has the name of a coord", "another"),
    ("[initial]", "momenta = [\"k\", \"b\"]\n[initial]", "6:12: the momentum `k` has the name of a param", "another"),
    ("[initial]", "momenta = [\"n\", \"b\"]\n[initial]", "6:12: the momentum `n` has the name of a column", "another"),
    ("[initial]", "momenta = [\"b\", \"b\"]\n[initial]", "6:17: the momentum `b` has the name of another", "another"),
    ("[initial]", "momenta = [\"1b\", \"b\"]\n[initial]", "6:12: `1b` is not a valid name", "begins with a letter"),
    ("[initial]", "momenta = [\"a\", \"b\"]\n[initial]", "5:23: unknown name `px`", "in the momenta a, b and"),
];

#[test]
fn each_fault_of_a_kinetic_energy_has_its_place_and_message() {
    let good = GOOD.replace("masses = [1, 2]", "kinetic = \"sqrt(k^2 + px^2 + py^2)\"");
    for (part, replacement, sentence, help) in WRONG_KINETIC {
        assert!(good.contains(part), "{part}");
        complains(&good.replacen(part, replacement, 1), sentence, help);
    }
    assert_eq!(run(folder(&good).path(), "").code, 0);
}

const PAIRS: &str = r#"[problem]
pair = "-g*m_i*m_j/sqrt(r2)"
dimensions = 2
bodies = { m = [1, 1, 1] }
masses = "m"
parameters = { g = 1 }
[initial]
q = [["0.97", "-0.24"], ["-0.97", "0.24"], [0, 0]]
v = [0.466203685, 0.43236573, 0.466203685, 0.43236573, -0.93240737, -0.86473146]
[run]
scheme = "yoshida4"
step = "1/100"
steps = 2
digits = 30
[output]
energy = true
"#;

/// The same for that scene.
const WRONG_PAIRS: &[(&str, &str, &str, &str)] = &[
    (
        "pair = \"-g*m_i*m_j/sqrt(r2)\"\n",
        "",
        "1:1: one of the keys `name`, `potential`, `pair`, `hamiltonian` is needed",
        "`pair =",
    ),
    ("pair =", "pairs =", "2:1: unknown key `pairs`", "did you mean `pair`?"),
    (
        "(r2)",
        "(r)",
        "2:8: the energy of a pair must be a formula in `r2` or in `d`; this one has neither",
        "r2 is the square",
    ),
    (
        "(r2)",
        "(r2) + r2*d",
        "2:8: the energy of a pair must be a formula in `r2` or in `d`; this one has both",
        "r2 is the",
    ),
    ("sqrt(r2)", "d", "3:14: a formula in `d` requires one dimension, not 2", "in `r2`"),
    ("sqrt(r2)", "abs(r2)", "2:20: `abs` is not smooth", "a smooth formula"),
    ("sqrt(r2)", "sqrt(r2", "2:24: unexpected end", "r2 is the square"),
    ("m_i", "e_i", "2:12: unknown name `e_i`", "a smooth formula"),
    ("m_i*m_j", "m^2", "2:12: unknown name `m`; of the bodies i and j it is `m_i` and `m_j`", "a smooth formula"),
    ("dimensions = 2", "dimensions = 4", "3:14: 4 is out of range", "from 1 to 3"),
    ("dimensions = 2\n", "", "1:1: the key `dimensions` is missing", "add `dimensions = 3`"),
    ("dimensions = 2", "dimensions = 3", "8:6: this list needs a number for each coordinate of the body", "needed 3"),
    ("bodies = { m = [1, 1, 1] }\n", "", "2:8: pair requires `bodies`", "add `bodies ="),
    (
        "{ m = [1, 1, 1] }",
        "[1, 1, 1]",
        "4:10: this value is of the wrong kind",
        "a whole number from 1 to 1000000, or a table",
    ),
    ("{ m = [1, 1, 1] }", "0", "4:10: 0 is out of range", "from 1 to 100000"),
    ("{ m = [1, 1, 1] }", "{ m = \"1\" }", "4:10: the number of bodies is missing", "`count = 32`"),
    (
        "[1, 1, 1] }",
        "[1, 1, 1], e = [1, 1] }",
        "4:31: this list needs a number for each body",
        "found 2 numbers, needed 3",
    ),
    ("{ m", "{ count = 4, m", "4:27: this list needs a number for each body", "needed 4"),
    ("[1, 1, 1]", "[1, 1]", "8:5: this needs a list for each body", "found 3 lists, needed 2"),
    ("[1, 1, 1]", "[1, 1]", "9:5: this list needs a number for each coordinate of each body", "needed 4"),
    ("[1, 1, 1]", "[1, [2], 3]", "4:20: this value is of the wrong kind", "needed a number"),
    ("[1, 1, 1]", "[1, 0, 1]", "5:10: a mass of 0 is not positive", "masses must be positive"),
    ("[1, 1, 1] }", "[1, 1, 1], d = [1, 2, 3] }", "4:27: with `pair`, `d` is the difference", "another name"),
    ("[1, 1, 1] }", "[1, 1, 1], 2a = [1, 2, 3] }", "4:27: `2a` is not a valid name", "begins with a letter"),
    ("g = 1", "g = 1, r2 = 1", "6:23: with `pair`, `r2` is the square of the distance", "another name"),
    ("g = 1", "g = 1, i = 1", "6:23: with `pair`, `i` is the number of a body", "another name"),
    ("g = 1", "g = 1, m = 1", "6:23: the parameter `m` has the name of a property", "another name"),
    ("g = 1", "g = 1, m_j = 1", "6:23: the parameter `m_j` has the name of a property", "another name"),
    ("g = 1", "g = 1, x2 = 1", "6:23: the parameter `x2` has the name of a coordinate", "another name"),
    ("g = 1", "g = 1, py3 = 1", "6:23: the parameter `py3` has the name of a momentum", "another name"),
    ("masses = \"m\"", "masses = \"e\"", "5:11: unknown name `e`", ""),
    ("masses = \"m\"", "masses = [1, 2]", "5:10: this list needs a number for each body", "found 2 numbers, needed 3"),
    ("masses = \"m\"", "masses = \"1/(i - 2)\"", "5:13: division by zero, at i = 2", ""),
    (
        "parameters",
        "coordinates = [\"x\"]\nparameters",
        "6:15: coordinates requires `potential` or `hamiltonian`",
        "remove `coord",
    ),
    (
        "parameters",
        "momenta = [\"x\"]\nparameters",
        "6:11: momenta requires `potential` or `hamiltonian`",
        "remove `momenta`",
    ),
    ("parameters", "neighbours = \"ring\"\nparameters", "6:14: `ring` is not known here", "\"free\" or \"fixed\""),
    (
        "parameters",
        "neighbours = \"fixed\"\nparameters",
        "4:10: bodies between fixed ends cannot have properties",
        "free",
    ),
    ("parameters", "kinetic = \"px1^2\"\nparameters", "5:10: kinetic and masses are both given", "keep one"),
    ("masses = \"m\"", "kinetic = \"px1^2 + x1\"", "5:20: unknown name `x1`", "the momenta px1, py1, px2, … and"),
    ("masses = \"m\"", "kinetic = \"px1^4\"", "9:5: velocities `v` require masses", "the momenta `p`"),
    (
        "q = [[\"0.97\", \"-0.24\"], [\"-0.97\", \"0.24\"], [0, 0]]",
        "q = \"i\"",
        "8:5: a formula for all bodies requires one dimension, not 2",
        "a list for each body",
    ),
    (
        "q = [[\"0.97\", \"-0.24\"], [\"-0.97\", \"0.24\"], [0, 0]]\n",
        "",
        "2:8: pair requires `q` in [initial]",
        "add it",
    ),
    ("[0, 0]]", "0]", "8:5: this value is of the wrong kind", "needed a list for each body"),
    ("[0, 0]]", "[0]]", "8:44: this list needs a number for each coordinate of the body", "found 1 number, needed 2"),
];

#[test]
fn each_fault_of_pairs_has_its_place_and_message() {
    assert_eq!(run(folder(PAIRS).path(), "").code, 0);
    for (part, replacement, sentence, help) in WRONG_PAIRS {
        assert!(PAIRS.contains(part), "{part}");
        complains(&PAIRS.replacen(part, replacement, 1), sentence, help);
    }
    let alone = PAIRS.replace("{ m = [1, 1, 1] }", "1").replace("\"m\"", "\"1\"").replace("*m_i*m_j", "");
    complains(&alone, "4:10: one body does not form a pair", "two bodies or more");
    let named =
        PAIRS.replace("masses = \"m\"", "kinetic = \"px1^2\"").replace("v =", "p =").replace("g = 1", "g = 1, px1 = 1");
    complains(&named, "6:23: the parameter `px1` has the name of a momentum", "another name");
}

const NAMED: &str = "[problem]\nname = \"kepler\"\nparameters = { eccentricity = \"1/2\" }\n\
                     [run]\nscheme = \"ruth3\"\nsteps = 2\nstep = 0.1\n[output]\nenergy = true\n";

#[test]
#[cfg(feature = "mpfr")]
fn each_fault_of_a_shipped_problem_has_its_place_and_message() {
    for (part, replacement, sentence, help) in [
        ("\"kepler\"", "\"keppler\"", "2:8: there is no problem `keppler`", "did you mean `kepler`?"),
        ("eccentricity", "ecentricity", "3:16: kepler has no parameter `ecentricity`", "did you mean `eccentricity`?"),
        ("\"1/2\"", "\"3/2\"", "3:31: eccentricity = 3/2 is out of range", "less than 1"),
        ("\"1/2\"", "\"1/x\"", "3:34: unknown name `x`", "1/10"),
        (
            "[run]",
            "coordinates = [\"x\", \"y\"]\n[run]",
            "4:15: coordinates requires `potential` or `hamiltonian`",
            "remove `",
        ),
        ("[run]", "masses = [1, 1]\n[run]", "4:10: masses requires `potential` or `pair`", "remove `"),
        ("[run]", "kinetic = \"px^2\"\n[run]", "4:11: kinetic requires `potential` or `pair`", "remove `kinetic`"),
        (
            "[run]",
            "momenta = [\"px\"]\n[run]",
            "4:11: momenta requires `potential` or `hamiltonian`",
            "remove `momenta`",
        ),
        ("[run]", "bodies = 2\n[run]", "4:10: bodies requires `pair`", "remove `bodies`"),
        ("[run]", "dimensions = 2\n[run]", "4:14: dimensions requires `pair`", "remove `dimensions`"),
        ("[run]", "neighbours = \"free\"\n[run]", "4:14: neighbours requires `pair`", "remove `neigh"),
        ("[run]", "pair = \"d^2\"\n[run]", "4:8: name and pair are both given", "keep one of the two"),
        ("[run]", "pair = \"d\"\npotential = \"x\"\n[run]", "5:13: name and potential are both given", "keep one"),
        ("[run]", "[initial]\nq = [1]\n[run]", "5:5: this list needs a number for each", "found 1 number, needed 2"),
        (
            "0.1",
            "1e-400\ndigits = \"double\"",
            "7:8: 1e-400 overflows or underflows in double precision",
            "digits = 16",
        ),
        (
            "0.1",
            "0.1\ndigits = 6000\n[initial]\np = [0, \"sqrt(2)\"]",
            "10:9: this value is irrational",
            "digits = 4980",
        ),
    ] {
        complains(&NAMED.replacen(part, replacement, 1), sentence, help);
    }
}

fn complains(scene: &str, sentence: &str, help: &str) {
    let folder = folder(scene);
    let result = run(folder.path(), "");
    assert_eq!((result.code, result.out.as_str()), (2, ""), "{scene}");
    let place = format!("{}:{sentence}", folder.path().join("scene.toml").display());
    let message = result.err.strip_prefix("error: ").unwrap();
    let at = message.find(&place).unwrap_or_else(|| panic!("{sentence}: {scene}\n{message}"));
    assert!(message[at..].contains(help), "{help}: {message}");
    assert_eq!(names(folder.path()), ["scene.toml"], "{scene}");
}

/// In double precision.
#[test]
fn numbers_whose_squares_or_inverses_overflow_are_refused() {
    let good = GOOD.replace("digits = 30", "digits = \"double\"");
    for (part, replacement, sentence) in [
        ("q = [1, 0]", "q = [1, -1e160]", "7:9: the square of the position -1e160 overflows in double precision"),
        ("[1, 2]", "[1e-310, 2]", "5:11: a mass of 1e-310 or its inverse overflows or underflows in double precision"),
    ] {
        complains(&good.replace(part, replacement), sentence, "digits = 16");
        assert_eq!(run(folder(&GOOD.replace(part, replacement)).path(), "").code, 0, "{replacement}");
    }
    let sentence = "a mass of 1e-310 or its inverse overflows or underflows in double precision";
    let planets = "[problem]\nname = \"outer-solar-system\"\nparameters = { m_pluto = 1e-310 }\n[run]\n\
                   scheme = \"ruth3\"\nsteps = 2\nstep = 1\ndigits = \"double\"\n[output]\nenergy = true\n";
    complains(planets, &format!("2:8: {sentence}"), "digits = 16");
}

#[test]
#[cfg(feature = "mpfr")]
fn irrational_values_of_a_problem_have_the_digits_of_the_run() {
    let scene = NAMED.replace("1/2", "1/3").replace("0.1", "0.1\ndigits = 6000");
    complains(&scene, "2:8: py is irrational and computed to 5000 digits", "digits = 4980");
}

#[test]
fn the_line_is_shown() {
    let folder = folder(&GOOD.replace("sqrt(x^2", "sqrt(z^2"));
    let result = run(folder.path(), "");
    assert!(
        result.err.contains("  2 | potential = \"k/sqrt(z^2 + y^2)\"\n    |                     ^\n  hint: "),
        "{}",
        result.err
    );
}

#[test]
fn all_faults_are_reported_at_once() {
    let folder = folder(&GOOD.replace("yoshida4", "yoshida5").replace("masses = [1, 2]", "masses = [1, -2]"));
    let result = run(folder.path(), "");
    assert!(result.err.contains(":5:14: ") && result.err.contains(":10:10: "), "{}", result.err);
}

#[test]
fn the_valid_scenes_are_accepted() {
    for scene in [GOOD, NAMED] {
        let folder = folder(scene);
        assert_eq!(run(folder.path(), "").code, 0);
    }
}

#[test]
fn a_file_that_is_not_a_scene_is_refused() {
    let folder = folder("");
    fs::write(folder.path().join("bytes.toml"), [0xff, 0xfe]).unwrap();
    for (file, sentence) in
        [("none.toml", "there is no file"), ("scene.toml", "is empty"), ("bytes.toml", "UTF-8"), ("", "cannot be read")]
    {
        let result = shadowstep(&format!("run {}", folder.path().join(file).display()));
        assert_eq!(result.code, 2);
        assert!(
            result.err.contains(sentence) && result.err.contains("hint: give the path of a scene"),
            "{}",
            result.err
        );
    }
    assert_eq!(shadowstep("run").code, 2);
}
