//! The keys of a scene with their meanings: the one place for `--explain`, messages and templates.

/// A section of a scene, or a table that is the value of a key.
pub struct Section {
    /// Its name in TOML: `output`, `output.energy`.
    pub name: &'static str,
    /// The same in brackets: `[output]`.
    pub heading: &'static str,
    /// What it is about.
    pub meaning: &'static str,
}

/// A key of a section.
pub struct Key {
    /// The section's name.
    pub section: &'static str,
    /// Its own name.
    pub name: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// A value in TOML.
    pub example: &'static str,
    /// The default; `None` if the key is required.
    pub default: Option<&'static str>,
}

/// All sections, in the order of the explanation.
pub(crate) const SECTIONS: [Section; 16] = [
    section(
        "problem",
        "[problem]",
        "The system H = T(p) + U(q). U is that of a shipped problem, a formula in the coordinates, or a sum over pairs of bodies.",
    ),
    section(
        "problem.cutoff",
        "[problem.cutoff]",
        "A smooth end in place of `cutoff = 2.5`. Between the two distances the energy of a pair is multiplied with a polynomial in r2 that falls \
         from 1 to 0.",
    ),
    section("problem.encounters", "[problem.encounters]", "The table `encounters`."),
    section("problem.units", "[problem.units]", "The table `units`."),
    section(
        "body",
        "[[body]]",
        "A body of a planetary system, in place of a name, a potential or a pair: a section for each, the central body first. \
         A planet has either q and v, in an inertial frame, or orbital elements, with angles in degrees.",
    ),
    section("initial", "[initial]", "The state at t = 0."),
    section(
        "time",
        "[time]",
        "Transforms time, so that steps become short in close encounters: the steps have equal lengths in a fictitious time s, and t is a \
         coordinate. It requires U < 0 on the whole orbit, and a scheme for every T(p); `first = \"drift\"` is best. The modified \
         energy is that of H' = f(T + p_t) - f(-U), which is 0; `energy` is H.",
    ),
    section("run", "[run]", "The scheme, its steps, and the number type."),
    section("output", "[output]", "What is written, and where. Nothing else is computed."),
    section("output.energy", "[output.energy]", "A table in place of `energy = true`."),
    section("output.modified_energy", "[output.modified_energy]", "A table in place of `modified_energy = true`."),
    section(
        "output.modified_hamiltonian",
        "[output.modified_hamiltonian]",
        "A table in place of `modified_hamiltonian = 4`.",
    ),
    section("output.trajectory", "[output.trajectory]", "A table in place of `trajectory = true`."),
    section("output.elements", "[output.elements]", "A table in place of `elements = true`."),
    section("output.chaos", "[output.chaos]", "A table in place of `chaos = true`."),
    section("output.plot", "[output.plot]", "A table in place of `plot = \"kepler.svg\"`."),
];

/// All keys, section by section.
pub(crate) const KEYS: [Key; 91] = [
    key(
        "problem",
        "name",
        "A shipped problem; `shadowstep problems` lists them.",
        "\"kepler\"",
        Some("none; a `potential` or a `pair` is given instead"),
    ),
    key(
        "problem",
        "potential",
        "U(q), or U(q, t) with the time t, a smooth formula in the coordinates and parameters. The gradient is derived from it. With t, H is \
         H(q, p, t) + pt, where pt is the momentum of t.",
        "\"-1/sqrt(x^2 + y^2)\"",
        Some("none; a `name` or a `pair` is given instead"),
    ),
    key(
        "problem",
        "pair",
        "The energy of two bodies i and j; U is its sum over all pairs. A smooth formula in `r2`, the square of their \
         distance, or in one dimension in `d` = q_j - q_i, in the parameters, and in properties of both bodies. The \
         coordinates are x1, y1, z1, x2, …, the momenta px1, py1, …; in one dimension q1, q2, … and p1, p2, ….",
        "\"-g*m_i*m_j/sqrt(r2)\"",
        Some("none; a `name` or a `potential` is given instead"),
    ),
    key(
        "problem",
        "slow",
        "The slow part of U, a formula beside the `potential` or `pair`, which are then the fast part: H has three parts, slow forces, fast forces and T, \
         for schemes with multiple time steps such as r-respa-4. Beside a `potential` it is a formula in the same names. Beside a `pair` it is one in r2 or d, \
         whose sum is over all pairs of bodies whatever `neighbours` and `cutoff` are, or one in the coordinates x1, y1, ….",
        "\"-g/sqrt(r2)\"",
        Some("none"),
    ),
    key(
        "problem",
        "bodies",
        "For `pair`: the number of bodies, `bodies = 32`, or a table of their properties, each with a list of one value \
         for each body. The property m is `m_i` and `m_j` in the formula. A formula in quotes can replace the list: its \
         values are those at i = 1, 2, …, and it can use the properties before it. If all properties are formulas, \
         `count` gives the number of bodies: { count = 32, m = \"1 + i/32\" }.",
        "{ m = [1, \"1/1000\", 2] }",
        Some("none; required with `pair`"),
    ),
    key(
        "problem",
        "dimensions",
        "For `pair`: the number of dimensions, 1, 2 or 3.",
        "3",
        Some("1 for a formula in `d`; required for one in `r2`"),
    ),
    key(
        "problem",
        "neighbours",
        "Makes the bodies a chain: each forms a pair with the next one only. Its ends are \"free\", \"fixed\" (the first and \
         the last body form pairs with walls at rest at 0; bodies have no properties), or \"periodic\" (a ring: the last \
         body forms a pair with the first).",
        "\"fixed\"",
        Some("none; all pairs of bodies interact"),
    ),
    key(
        "problem",
        "cutoff",
        "For `pair` in r2: bodies interact up to this distance, and a step takes a time that grows as their number. The energy of a \
         pair jumps there, so that no scheme conserves it, unless a table makes its end smooth.",
        "{ at = \"5/2\", from = 2, derivatives = 3 }",
        Some("none; all pairs of bodies interact"),
    ),
    key(
        "problem",
        "box",
        "With `cutoff`: the side of a periodic box, or a list of its sides, each at least twice the cutoff. Forces are those of the nearest \
         images; coordinates are not wrapped.",
        "[10, 10, 12]",
        Some("none; open space"),
    ),
    key(
        "problem",
        "coordinates",
        "The names of q_1, q_2, … for `potential`.",
        "[\"x\", \"y\"]",
        Some("none; a shipped problem has its own, `pair` has fixed names"),
    ),
    key(
        "problem",
        "parameters",
        "Names and values, for formulas or of the shipped problem. Each can use those before it. Masses, initial state, \
         step and times can use all of them. None may have the name of something else in a formula of [output] or `end` that contains it, \
         such as E, the energy.",
        "{ depth = 2, width = \"depth/3\" }",
        Some("those of the shipped problem; otherwise none"),
    ),
    key(
        "problem",
        "masses",
        "The m_i of T = p_1^2/(2 m_1) + p_2^2/(2 m_2) + …, one for each coordinate. With `pair`: one for each body, or a \
         formula for all of them as in `bodies`; masses = \"m\" uses the property m.",
        "[1, \"1/1000\"]",
        Some("all are 1"),
    ),
    key(
        "problem",
        "kinetic",
        "T(p), a smooth formula in the momenta and parameters, in place of `masses`. If its degree in p is above 2, \
         the scheme must be valid for every T(p); with the time t in it, for three parts and more.",
        "\"sqrt(1 + px^2 + py^2)\"",
        Some("p_1^2/(2 m_1) + p_2^2/(2 m_2) + …"),
    ),
    key(
        "problem",
        "hamiltonian",
        "H(q, p), a smooth formula in the coordinates, momenta and parameters that has no parts with known flows. The steps are in M. Tao's extended phase \
         space, with copies x_2, px_2 of each x, px: H(x, px_2) + H(x_2, px) + coupling/2 |differences|^2, whose parts they solve. The \
         scheme must be valid for three parts and more; the energy is that sum.",
        "\"(x^2 + 1)*(px^2 + 1)/2\"",
        Some("none; a `potential` or another of these is given instead"),
    ),
    key(
        "problem",
        "coupling",
        "For `hamiltonian`: the rate that holds the copies together. Too small, they part; large, it asks for small steps.",
        "20",
        None,
    ),
    key(
        "problem",
        "vector_potential",
        "For `potential`: the components of A, times the charge, of a magnetic field, one for each of the `coordinates`. H is the sum of \
         (p_i - A_i)^2/(2*m_i) and U. A constant field is a part with an exact flow; in another one no A_i may depend on its own coordinate. \
         The scheme must be valid for three parts and more. Velocities `v` of [initial] give p = m v + A.",
        "[\"-b*y/2\", \"b*x/2\"]",
        Some("none; no magnetic field"),
    ),
    key(
        "problem",
        "momenta",
        "The names of p_1, p_2, … for `kinetic` and the output, one for each of the `coordinates`.",
        "[\"px\", \"py\"]",
        Some("`p` and the coordinate: px for x"),
    ),
    key(
        "problem",
        "parts",
        "How H is split into a part for drifts and one for kicks: \"kinetic-potential\", T(p) and U(q); of [[body]] or a shipped \
         problem of bodies \"wisdom-holman\", the Kepler orbits of the planets in Jacobi coordinates and their interactions, for \
         schemes such as abah864; or \"wisdom-holman-heliocentric\", the same in democratic heliocentric coordinates, for \
         schemes for every T(p), with states written in inertial coordinates; \"linear\", for any U that has second derivatives at q = 0, \
         T(p) + qᵀKq/2 with K = U_qq(0) and what is left of U: the oscillations are solved exactly. Or, in place of a name, a potential or a \
         pair, a list of formulas in the coordinates, momenta and parameters, whose sum is H and each of which has a known flow, also with t: \
         [\"(px^2 + py^2)/2\", \"y*px - x*py\", \"cos(x) + cos(y)\"].",
        "\"wisdom-holman\"",
        Some("\"kinetic-potential\""),
    ),
    key(
        "problem",
        "encounters",
        "With parts = \"wisdom-holman-heliocentric\": planets that are nearer than `within` attract each other in the drifts, whose substeps become shorter as they meet.",
        "{ within = 0.3, substeps = 4 }",
        Some("none; all attraction between planets is in kicks"),
    ),
    key(
        "problem",
        "units",
        "For [[body]]: the units of length (AU, km, m), time (day, year of 365.25 days, s) and mass (solar, earth, jupiter, kg), from \
         which the gravitational constant follows.",
        "{ length = \"AU\", time = \"day\", mass = \"solar\" }",
        Some("none; a parameter g is given instead"),
    ),
    key(
        "problem",
        "elements",
        "For [[body]]: what orbital elements are relative to: \"heliocentric\", the first body, with the masses of the two; or \"jacobi\", the centre of mass of \
         the bodies before, with their mass and the body's own, which is REBOUND's default.",
        "\"jacobi\"",
        Some("\"heliocentric\""),
    ),
    key(
        "problem",
        "barycentric",
        "For [[body]]: moves the centre of mass to the origin, and to rest.",
        "true",
        Some("false"),
    ),
    key(
        "problem",
        "central",
        "For [[body]]: an energy of each body but the first beside the attraction, a smooth formula in its position x, y, z relative to the first \
         body, in its distance r, its mass m, the mass m0 of the first body, g and the parameters; by kicks, also with \
         parts = \"wisdom-holman\". The example turns pericentres as general relativity does.",
        "\"-3*(g*m0)^2*m/(c^2*r^2)\"",
        Some("none; bodies attract each other only"),
    ),
    key(
        "problem",
        "external",
        "For [[body]]: an energy of each body, the first too, in the same names; x, y, z and r are those of the inertial frame.",
        "\"m*tide*z^2/2\"",
        Some("none; there are no other forces"),
    ),
    key(
        "problem",
        "particles",
        "For [[body]]: a file of CSV with bodies of mass 0, a line each, which the bodies attract; its path is relative to the scene's folder. The first line has the names of the          columns: x, y, z, vx, vy, vz or the elements a, e, i, node, pericentre, and M or lambda; name gives them names.",
        "\"asteroids.csv\"",
        Some("none; a [[body]] of mass 0 is a particle, too"),
    ),
    key("problem.cutoff", "at", "The distance at which the energy is 0.", "\"5/2\"", None),
    key("problem.cutoff", "from", "The distance from which on it falls.", "2", None),
    key(
        "problem.cutoff",
        "derivatives",
        "How many derivatives of the energy are continuous, 1 to 8. A scheme of high order needs more of them.",
        "3",
        None,
    ),
    key(
        "problem.encounters",
        "within",
        "The distance below which planets are near, some 3 Hill radii or more.",
        "\"3/10\"",
        None,
    ),
    key(
        "problem.encounters",
        "substeps",
        "How many substeps a step has, at least, while planets are near. Each time that their distance halves there are three times as many.",
        "8",
        Some("4"),
    ),
    key("problem.units", "length", "\"AU\", \"km\" or \"m\".", "\"AU\"", None),
    key("problem.units", "time", "\"day\", \"year\" or \"s\".", "\"day\"", None),
    key("problem.units", "mass", "\"solar\", \"earth\", \"jupiter\" or \"kg\".", "\"solar\"", None),
    key(
        "body",
        "name",
        "Its name, with which its coordinates are x_sun, y_sun, z_sun, px_sun, …",
        "\"sun\"",
        Some("none; coordinates have the numbers of the bodies: x1, y1, …"),
    ),
    key(
        "body",
        "mass",
        "Its mass, positive, or 0 of bodies that come last: these are attracted by the others and attract nothing, and their momenta are velocities.",
        "\"1/1047.35\"",
        None,
    ),
    key("body", "q", "Its position.", "[1, 0, 0]", Some("0 for the first body; otherwise elements are given instead")),
    key("body", "v", "Its velocity.", "[0, 1, 0]", Some("0 for the first body; otherwise elements are given instead")),
    key(
        "body",
        "a",
        "The semi-major axis of its orbit about the first body, or about what `elements` of [problem] has; negative of a hyperbola.",
        "5.2",
        Some("none; q and v are given instead"),
    ),
    key(
        "body",
        "horizons",
        "A table of vectors of JPL's Horizons in CSV, whose first row has its position and velocity; its path is relative to the scene's folder. Requires `units`; \
         all tables need the same centre, frame and time. The first body may have none if it is their centre, the Sun or the body of its name.",
        "\"earth.txt\"",
        Some("none; q and v or elements are given instead"),
    ),
    key("body", "e", "The eccentricity.", "0.05", Some("0")),
    key("body", "i", "The inclination.", "1.3", Some("0")),
    key("body", "node", "The longitude Ω of the ascending node.", "100.5", Some("0")),
    key("body", "pericentre", "The argument ω of the pericentre.", "-86", Some("0")),
    key("body", "M", "The mean anomaly.", "20", Some("0")),
    key("body", "lambda", "The mean longitude Ω + ω + M, in place of M.", "34.4", Some("none; M is used")),
    key(
        "initial",
        "q",
        "Positions, one for each coordinate. With `pair`: also a list for each body, [[0, 0, 0], [1, 0, 0]]; in one \
         dimension also a formula for all bodies, \"sin(i*pi/33)\", in the number i of the body and its properties.",
        "[\"1 - 0.6\", 0]",
        Some("those of the shipped problem; otherwise required"),
    ),
    key(
        "initial",
        "p",
        "Momenta, in the same form as q.",
        "[0, \"sqrt((1 + 0.6)/(1 - 0.6))\"]",
        Some("those of the shipped problem; otherwise `p` or `v` is required"),
    ),
    key(
        "initial",
        "v",
        "Velocities in place of momenta, p_i = m_i v_i; not with `kinetic`.",
        "[0, 2]",
        Some("none; momenta are given instead"),
    ),
    key(
        "time",
        "transform",
        "\"logarithmic\": f = ln, dt/ds = 1/(-U); on an ellipse with the semi-major axis a about a mass M, s is m sqrt(G M a) times the \
         eccentric anomaly. Or \"power\": f(x) = x^exponent/exponent, dt/ds = (-U)^(exponent - 1).",
        "\"logarithmic\"",
        None,
    ),
    key(
        "time",
        "exponent",
        "For \"power\": not 0, a fraction with a numerator and denominator of at most 32. With -1/2 steps are proportional to the time \
         of free fall near a centre.",
        "\"-1/2\"",
        Some("none; required for \"power\""),
    ),
    key(
        "run",
        "scheme",
        "A shipped scheme, or the file of a table; its path is relative to the scene's folder. `shadowstep schemes` lists \
         the shipped schemes.",
        "\"yoshida4\"",
        None,
    ),
    key(
        "run",
        "gradient_kicks",
        "How gradient kicks are made: \"exact\", from second derivatives, or \"displaced\", by a force at displaced positions, which is not \
         exactly symplectic.",
        "\"displaced\"",
        Some("\"exact\""),
    ),
    key("run", "first", "What a step begins with: \"kick\" or \"drift\".", "\"drift\"", Some("that of the table")),
    key(
        "run",
        "step",
        "The step size h, nonzero; negative to go back in time. With [time] it is a step of s.",
        "\"1/20\"",
        None,
    ),
    key(
        "run",
        "until",
        "The time at which the run ends. If it is not a multiple of h, the run ends at the last multiple before it. With [time] it is a \
         physical time, and the run ends there by a last step of the exact remainder: a row more, which is always written.",
        "100",
        Some("none; `steps` are given instead"),
    ),
    key(
        "run",
        "end",
        "A condition that ends the run at the first state after t = 0 that meets it: one comparison of formulas in the coordinates, momenta and \
         parameters, t and the energy E. `until` or `steps` is the end if it is not met.",
        "\"x^2 + y^2 > 100\"",
        Some("none; the run ends with `until` or `steps`"),
    ),
    key("run", "steps", "The number of steps, in place of `until`.", "2000", Some("none; `until` is given instead")),
    key(
        "run",
        "digits",
        "The decimal digits of all numbers, or \"double\" for double precision, or \"compensated\" for double precision in which \
         positions and momenta are sums with remainders: less round-off in long runs, for up to half more time; or \
         \"double-double\" for sums of two doubles, about 32 digits, for 4 to 9 times the time of double precision.",
        "120",
        Some("\"double\""),
    ),
    key(
        "run",
        "mpfr",
        "MPFR's numbers, also for up to 307 digits, for which numbers of some limbs of 64 bits take less time. Requires a number of `digits`.",
        "true",
        Some("false"),
    ),
    key(
        "output",
        "file",
        "The file for the rows; its path is relative to the scene's folder. A .csv file begins with lines of metadata \
         that start with #, as in pandas.read_csv(file, comment=\"#\"); a .jsonl file has JSON lines, one a row, as in \
         pandas.read_json(file, lines=True), and the file with .metadata.json after its name has the metadata and the \
         summary. So it has beside a .npy file, an array of NumPy in double precision with fields n, t, energy, …, q and p, as in \
         numpy.load(file, mmap_mode=\"r\"). The file gets its name when it is complete. An existing file is replaced only if it is from this \
         unchanged scene, or with --force.",
        "\"kepler.csv\"",
        Some("none; rows go to stdout"),
    ),
    key(
        "output",
        "format",
        "\"csv\", \"jsonl\" or \"npy\", independent of the file's name.",
        "\"jsonl\"",
        Some("from the file's name; \"csv\" on stdout"),
    ),
    key("output", "energy", "Writes H as a column `energy`: true, or a table.", "{ every = 10 }", Some("false")),
    key(
        "output",
        "modified_energy",
        "Writes the modified energy as columns `modified_energy`, `estimate` (its estimated error, also near close \
         encounters; empty for order = 1, which gives no reliable estimate) and `order` (the m or k used): true, or a \
         table.",
        "{ order = \"auto\", max_order = 100 }",
        Some("false"),
    ),
    key(
        "output",
        "trajectory",
        "Writes positions and momenta as columns x, y, …, px, py, …: true, or a table.",
        "{ every = 100 }",
        Some("false"),
    ),
    key(
        "output",
        "values",
        "Writes formulas in the coordinates, momenta, parameters, t and E as columns of these names, all of them at every n that is a multiple of `every`. A formula \
         can have `kinetic`, the kinetic energy T(p), and `virial`, -q U_q, in a periodic box of the nearest images; distance(sun, earth), and an element of a body's orbit about the first body or another one, the bodies before, or all: e(earth), a(moon, earth), \
         i(earth, jacobi), M(earth, barycentre), with the names of [[body]].",
        "{ r = \"sqrt(x^2 + y^2)\", every = 10 }",
        Some("none"),
    ),
    key(
        "output",
        "elements",
        "Writes the elements of the osculating orbits of all bodies but the first as columns a_earth, e_earth, i_earth, node_earth, pericentre_earth, \
         M_earth, …, with angles in degrees: true, or a table. They are heliocentric, about the first body; `centre` has others, such as REBOUND's default \"jacobi\".",
        "{ every = 100, centre = \"jacobi\" }",
        Some("false"),
    ),
    key(
        "output",
        "modified_hamiltonian",
        "Writes H + h^2 H_3 + …, the series of the modified Hamiltonian up to this power of h, derived as a formula, as the column \
         `modified_hamiltonian_4`: the power, a list of several, or a table. It requires T(p) + U(q) by formulas, or parts that are formulas.",
        "{ grade = [2, 4, 6], every = 10 }",
        Some("none"),
    ),
    key(
        "output",
        "extremes",
        "Adds the least and the greatest values of formulas over all states to the summary; the formulas are those of `values`.",
        "{ closest = \"distance(earth, moon)\" }",
        Some("none"),
    ),
    key(
        "output",
        "chaos",
        "Writes indicators of chaos as columns `lyapunov`, `megno`, `mean_megno` and `sali`, of two tangent vectors from t = 0: true, or a table. \
         See docs/chaos.md.",
        "{ every = 100 }",
        Some("false"),
    ),
    key(
        "output",
        "checkpoint",
        "How often the run saves a checkpoint: a time in s, min or h, or a number of steps. If a run is stopped, running \
         the scene again resumes it from the last checkpoint, and the file gets the same bytes. A changed scene, even if \
         only a comment is different, cannot be resumed. The last checkpoint stays beside the complete file: with a later `until` \
         or more `steps`, and nothing else changed, the run goes on from there. Requires `file`.",
        "\"1 min\"",
        Some("none; a run that is stopped leaves no file"),
    ),
    key(
        "output",
        "summary",
        "Whether a summary of the run is made, with its verdict. With hundreds of digits and more it may take longer than the steps.",
        "false",
        Some("true"),
    ),
    key(
        "output",
        "windows",
        "In about how many windows of 17 states the summary compares modified energies, spread over the run. More windows exclude smaller changes \
         where H varies like noise from window to window, and cost more; an undecided verdict is more often decided by a longer run.",
        "2000",
        Some("256"),
    ),
    key(
        "output",
        "plot",
        "The file for a chart of the energies; its path is relative to the scene's folder. Or a table, for other charts. Charts \
         are drawn from the rows of `file` when it is complete, and are replaced as `file` is.",
        "\"kepler.svg\"",
        Some("none"),
    ),
    key("output.energy", "every", "It is written at every n that is a multiple of this.", "10", Some("1")),
    key("output.modified_hamiltonian", "grade", "The highest power of h, at most 10, or a list of such.", "4", None),
    key(
        "output.modified_hamiltonian",
        "every",
        "It is written at every n that is a multiple of this.",
        "10",
        Some("1"),
    ),
    key("output.modified_energy", "every", "It is written at every n that is a multiple of this.", "10", Some("1")),
    key(
        "output.modified_energy",
        "estimator",
        "\"bilinear\" for products of k + 1 states in pairs, or \"central\" for central differences D_m of 2m + 1 states, the \
         estimator of Moan and Niesen, which needs more states for the same error.",
        "\"central\"",
        Some("\"bilinear\""),
    ),
    key(
        "output.modified_energy",
        "order",
        "The k of the bilinear estimator, which must be even and at most 256, or the m of D_m, at most 1000; or \"auto\" for the \
         best one of each state.",
        "40",
        Some("\"auto\""),
    ),
    key(
        "output.modified_energy",
        "max_order",
        "The largest k or m that \"auto\" tries.",
        "100",
        Some("64 for the bilinear estimator, 200 for central differences"),
    ),
    key(
        "output.modified_energy",
        "stop",
        "For estimator = \"central\": where \"auto\" stops trying m: \"full\" at the largest m; \"early\" at the first m >= 13 whose term is larger than the eleven \
         before it, which is the rule of Moan and Niesen with < where they print <=; \"printed\" with <=, at the first ripple.",
        "\"early\"",
        Some("\"full\""),
    ),
    key(
        "output.modified_energy",
        "rule",
        "For estimator = \"central\": which m \"auto\" uses: \"least\" minimises the term |T_m - T_(m-1)|; \"robust\" minimises the maximum of ten \
         neighbouring terms, so that no single term can be small by chance.",
        "\"robust\"",
        Some("\"least\""),
    ),
    key(
        "output.modified_energy",
        "accuracy",
        "Of the bilinear estimator: a target error; \"auto\" uses the least k of 2, 4, 8, 16, … and max_order that meets it, or the \
         best of them if none does. The column `estimate` has the estimated errors.",
        "1e-20",
        Some("none; the best k of each state"),
    ),
    key("output.trajectory", "every", "They are written at every n that is a multiple of this.", "100", Some("1")),
    key(
        "output.trajectory",
        "section",
        "A formula in positions and momenta, in place of `every`: they are written where it becomes 0 between two states, at the end of a step of a part of \
         h from the state before (M. Hénon, Physica D 5 (1982) 412). Its row has the n of the state before.",
        "\"x\"",
        Some("none; `every` says when"),
    ),
    key(
        "output.trajectory",
        "direction",
        "How the formula of `section` goes through 0, in the order of the steps: \"up\", \"down\" or \"both\".",
        "\"both\"",
        Some("\"up\""),
    ),
    key("output.elements", "every", "They are written at every n that is a multiple of this.", "100", Some("1")),
    key(
        "output.elements",
        "centre",
        "What orbits are about: \"heliocentric\" for the first body, with the masses of the two; \"jacobi\", REBOUND's default, for the centre of mass of the bodies \
         before, with their mass and the body's own; \"barycentric\" for the centre of mass of all bodies, with their mass, where the first body has an orbit, too.",
        "\"jacobi\"",
        Some("\"heliocentric\""),
    ),
    key("output.chaos", "every", "They are written at every n that is a multiple of this.", "100", Some("1")),
    key(
        "output.plot",
        "file",
        "The file of the first chart; the others have their names in addition: kepler-orbit-x-y.svg.",
        "\"kepler.svg\"",
        None,
    ),
    key(
        "output.plot",
        "of",
        "The charts. \"energies\": |H - H(0)| and |H̄ - H̄*|, H̄* the H̄ with the least estimated error, with that error, in time; requires `energy` or \
         `modified_energy`. \"orbit=x:y\": one coordinate or momentum against another; where there are bodies with \
         coordinates such as x1, y1 or x_sun, y_sun, also x:y for all of them. \"distance\": of every two bodies in time, or \
         without bodies from the origin; \"distance=1\" of body 1 from the others; \"distance=1:2\" of two. Orbits and \
         distances require `trajectory`.",
        "[\"energies\", \"orbit=x:y\", \"distance\"]",
        Some("[\"energies\"]"),
    ),
];

/// Trajectories of one scene.
pub(crate) const ENSEMBLE: Section = section(
    "ensemble",
    "[ensemble]",
    "Makes many trajectories of the scene, which differ in initial values and parameters. `shadowstep run` computes them in vectors of the \
     processor and on all cores, and writes a row for each: its state at the end, the largest |H - H(0)|/|H(0)|, and max - min of the \
     modified energy, if [output] has `modified_energy`.",
);

/// The keys of \[ensemble\].
pub(crate) const ENSEMBLE_KEYS: [Key; 2] = [
    key(
        "ensemble",
        "columns",
        "Names, each with a list of one number for each trajectory. All numbers and formulas of [problem] and [initial] can \
         contain the names.",
        "{ x0 = [1, 1.1, \"3/2\"] }",
        Some("none; a `file` is given instead"),
    ),
    key(
        "ensemble",
        "file",
        "A file of CSV in place of `columns`: a line of names, then a line of numbers for each trajectory. Its path is relative to the \
         scene's folder.",
        "\"starts.csv\"",
        Some("none; `columns` are given instead"),
    ),
];

/// A section.
pub const fn section(name: &'static str, heading: &'static str, meaning: &'static str) -> Section {
    Section { name, heading, meaning }
}

/// A key.
pub const fn key(
    section: &'static str,
    name: &'static str,
    meaning: &'static str,
    example: &'static str,
    default: Option<&'static str>,
) -> Key {
    Key { section, name, meaning, example, default }
}

/// The keys of a section.
pub fn of(section: &str) -> impl Iterator<Item = &'static Key> + Clone {
    KEYS.iter().filter(move |key| key.section == section)
}

/// A key of a section.
pub(crate) fn find(section: &str, name: &str) -> Option<&'static Key> {
    of(section).find(|key| key.name == name)
}

/// The heading of the section that has a key of this name: `[run]`.
pub(crate) fn section_with(name: &str) -> Option<&'static str> {
    let key = KEYS.iter().chain(&ENSEMBLE_KEYS).find(|key| key.name == name)?;
    SECTIONS.iter().chain([&ENSEMBLE]).find(|section| section.name == key.section).map(|section| section.heading)
}
