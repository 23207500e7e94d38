//! The keys of a scene: a row for each, from which all else is made.

use shadowstep::shadow::{EstimatorSettings, HIGHEST_ORDER, SelectionRule, StoppingRule, Verdict};
use shadowstep::systems::pairs::MOST_DERIVATIVES;
use shadowstep_analysis::modified::HIGHEST_GRADE;

use crate::arithmetic::MOST_DIGITS;
use crate::rows;
use crate::schema::{CONDITION, FORMULA, Kind, NAME, NAMES, NONZERO, NUMBER, NUMBERS, PATH, POSITIVE, Section};
use crate::steps::MOST_STEPS;

/// The sections that describe a system.
pub(crate) const OF_SYSTEM: [&Section; 4] = [&PROBLEM, &BODY, &INITIAL, &TIME];
/// The sections of a scene, in the order of the explanation.
pub const SECTIONS: [&Section; 7] = [&PROBLEM, &BODY, &INITIAL, &TIME, &RUN, &OUTPUT, &ENSEMBLE];

/// The most bodies: with more, a step takes too long.
const MOST_BODIES: u64 = 1_000_000;

/// More substeps of a step would take a step's time each.
const MOST_SUBSTEPS: u64 = 1_000_000;

const FORMULAS: Kind = Kind::List(&FORMULA);
const NUMBERS_OR_FORMULA: Kind = Kind::Any(&[NUMBERS, FORMULA]);
/// A number for each coordinate, a list of these for each body, or a formula for all.
const STATE: Kind = Kind::Any(&[Kind::List(&Kind::Any(&[NUMBER, NUMBERS])), FORMULA]);
const EVERY: Kind = Kind::Whole(1, MOST_STEPS);
const GRADE: Kind = Kind::Whole(1, HIGHEST_GRADE as u64);

/// \[problem\]
pub const PROBLEM: Section = Section::new(
    "[problem]",
    "The system H = T(p) + U(q). U is that of a shipped problem, a formula in the coordinates, or a sum over pairs of bodies.",
    rows! {
        name: Kind::Text("name of a problem") => "\"kepler\"",
            "A shipped problem; `shadowstep problems` lists them.",
            else "none; a `potential` or a `pair` is given instead", excludes ["[[body]]"];
        potential: FORMULA => "\"-1/sqrt(x^2 + y^2)\"",
            "U(q), or U(q, t) with the time t, a smooth formula in the coordinates and parameters. The gradient is \
             derived from it. With t, H is H(q, p, t) + pt, where pt is the momentum of t.",
            else "none; a `name` or a `pair` is given instead",
            needs ["coordinates", "initial.q", "initial.p|initial.v"],
            excludes ["name", "[[body]]"];
        pair: FORMULA => "\"-g*m_i*m_j/sqrt(r2)\"",
            "The energy of two bodies i and j; U is its sum over all pairs. A smooth formula in `r2`, the square of \
             their distance, or in one dimension in `d` = q_j - q_i, in the parameters, and in properties of both \
             bodies. The coordinates are x1, y1, z1, x2, …, the momenta px1, py1, …; in one dimension q1, q2, … and \
             p1, p2, ….",
            else "none; a `name` or a `potential` is given instead",
            needs ["bodies", "initial.q", "initial.p|initial.v"],
            excludes ["name", "potential", "[[body]]"];
        slow: FORMULA => "\"-g/sqrt(r2)\"",
            "The slow part of U, a formula beside the `potential` or `pair`, which are then the fast part: H has \
             three parts, slow forces, fast forces and T, for schemes with multiple time steps such as r-respa-4. \
             Beside a `potential` it is a formula in the same names. Beside a `pair` it is one in r2 or d, whose sum \
             is over all pairs of bodies whatever `neighbours` and `cutoff` are, or one in the coordinates x1, y1, ….",
            else "none", needs ["potential|pair"], excludes ["vector_potential", "parts"];
        bodies: Kind::Any(&[Kind::Whole(1, MOST_BODIES), Kind::Table(&BODIES)]) => "{ m = [1, \"1/1000\", 2] }",
            "For `pair`: the number of bodies, `bodies = 32`, or a table of their properties, each with a list of one \
             value for each body. The property m is `m_i` and `m_j` in the formula. A formula in quotes can replace \
             the list: its values are those at i = 1, 2, …, and it can use the properties before it. If all \
             properties are formulas, `count` gives the number of bodies: { count = 32, m = \"1 + i/32\" }.",
            else "none; required with `pair`", needs ["pair"];
        dimensions: Kind::Whole(1, 3) => "3",
            "For `pair`: the number of dimensions, 1, 2 or 3.",
            else "1 for a formula in `d`; required for one in `r2`", needs ["pair"];
        neighbours: Kind::Word(&["free", "fixed", "periodic"]) => "\"fixed\"",
            "Makes the bodies a chain: each forms a pair with the next one only. Its ends are \"free\", \"fixed\" \
             (the first and the last body form pairs with walls at rest at 0; bodies have no properties), or \
             \"periodic\" (a ring: the last body forms a pair with the first).",
            else "none; all pairs of bodies interact", needs ["pair"];
        cutoff: Kind::Any(&[POSITIVE, Kind::Table(&CUTOFF)]) => "{ at = \"5/2\", from = 2, derivatives = 3 }",
            "For `pair` in r2: bodies interact up to this distance, and a step takes a time that grows as their \
             number. The energy of a pair jumps there, so that no scheme conserves it, unless a table makes its end \
             smooth.",
            else "none; all pairs of bodies interact", needs ["pair"], excludes ["neighbours"];
        box: Kind::Any(&[POSITIVE, Kind::List(&POSITIVE)]) => "[10, 10, 12]",
            "With `cutoff`: the side of a periodic box, or a list of its sides, each at least twice the cutoff. \
             Forces are those of the nearest images; coordinates are not wrapped.",
            else "none; open space", needs ["cutoff"];
        coordinates: NAMES => "[\"x\", \"y\"]",
            "The names of q_1, q_2, … for `potential`.",
            else "none; a shipped problem has its own, `pair` has fixed names", needs ["potential|hamiltonian|parts[]"];
        parameters: Kind::Names(&NUMBER) => "{ depth = 2, width = \"depth/3\" }",
            "Names and values, for formulas or of the shipped problem. Each can use those before it. Masses, initial \
             state, step and times can use all of them. None may have the name of something else in a formula of \
             [output] or `end` that contains it, such as E, the energy.",
            else "those of the shipped problem; otherwise none";
        masses: NUMBERS_OR_FORMULA => "[1, \"1/1000\"]",
            "The m_i of T = p_1^2/(2 m_1) + p_2^2/(2 m_2) + …, one for each coordinate. With `pair`: one for each \
             body, or a formula for all of them as in `bodies`; masses = \"m\" uses the property m.",
            else "all are 1", needs ["potential|pair"], excludes ["kinetic"];
        kinetic: FORMULA => "\"sqrt(1 + px^2 + py^2)\"",
            "T(p), a smooth formula in the momenta and parameters, in place of `masses`. If its degree in p is above \
             2, the scheme must be valid for every T(p); with the time t in it, for three parts and more.",
            else "p_1^2/(2 m_1) + p_2^2/(2 m_2) + …", needs ["potential|pair"];
        hamiltonian: FORMULA => "\"(x^2 + 1)*(px^2 + 1)/2\"",
            "H(q, p), a smooth formula in the coordinates, momenta and parameters that has no parts with known flows. \
             The steps are in M. Tao's extended phase space, with copies x_2, px_2 of each x, px: H(x, px_2) + H(x_2, \
             px) + coupling/2 |differences|^2, whose parts they solve. The scheme must be valid for three parts and \
             more; the energy is that sum.",
            else "none; a `potential` or another of these is given instead",
            needs ["coordinates", "coupling", "initial.q", "initial.p|initial.v"],
            excludes ["name", "potential", "pair", "parts", "[[body]]"];
        coupling: POSITIVE => "20",
            "For `hamiltonian`: the rate that holds the copies together. Too small, they part; large, it asks for \
                small steps.",
            else "none; required with `hamiltonian`", needs ["hamiltonian"];
        vector_potential: FORMULAS => "[\"-b*y/2\", \"b*x/2\"]",
            "For `potential`: the components of A, times the charge, of a magnetic field, one for each of the \
             `coordinates`. H is the sum of (p_i - A_i)^2/(2*m_i) and U. A constant field is a part with an exact \
             flow; in another one no A_i may depend on its own coordinate. The scheme must be valid for three parts \
             and more. Velocities `v` of [initial] give p = m v + A.",
            else "none; no magnetic field", needs ["potential"], excludes ["kinetic", "parts"];
        momenta: NAMES => "[\"px\", \"py\"]",
            "The names of p_1, p_2, … for `kinetic` and the output, one for each of the `coordinates`.",
            else "`p` and the coordinate: px for x", needs ["potential|hamiltonian|parts[]"];
        parts: Kind::Any(&[
            Kind::Word(&["kinetic-potential", "wisdom-holman", "wisdom-holman-heliocentric", "linear"]),
            FORMULAS,
        ]) => "\"wisdom-holman\"",
            "How H is split into a part for drifts and one for kicks: \"kinetic-potential\", T(p) and U(q); of \
             [[body]] or a shipped problem of bodies \"wisdom-holman\", the Kepler orbits of the planets in Jacobi \
             coordinates and their interactions, for schemes such as abah864; or \"wisdom-holman-heliocentric\", the \
             same in democratic heliocentric coordinates, for schemes for every T(p), with states written in inertial \
             coordinates; \"linear\", for any U that has second derivatives at q = 0, T(p) + qᵀKq/2 with K = U_qq(0) \
             and what is left of U: the oscillations are solved exactly. Or, in place of a name, a potential or a \
             pair, a list of formulas in the coordinates, momenta and parameters, whose sum is H and each of which \
             has a known flow, also with t: [\"(px^2 + py^2)/2\", \"y*px - x*py\", \"cos(x) + cos(y)\"].",
            else "\"kinetic-potential\"",
            needs ["coordinates", "initial.q", "initial.p|initial.v"],
            excludes ["name", "potential", "pair", "hamiltonian", "[[body]]"],
            if_list true;
        encounters: Kind::Table(&ENCOUNTERS) => "{ within = 0.3, substeps = 4 }",
            "With parts = \"wisdom-holman-heliocentric\": planets that are nearer than `within` attract each other in \
             the drifts, whose substeps become shorter as they meet.",
            else "none; all attraction between planets is in kicks", needs ["parts"];
        units: Kind::Table(&UNITS) => "{ length = \"AU\", time = \"day\", mass = \"solar\" }",
            "For [[body]]: the units of length (AU, km, m), time (day, year of 365.25 days, s) and mass (solar, \
             earth, jupiter, kg), from which the gravitational constant follows.",
            else "none; a parameter g is given instead", needs ["[[body]]"];
        elements: Kind::Word(&["heliocentric", "jacobi"]) => "\"jacobi\"",
            "For [[body]]: what orbital elements are relative to: \"heliocentric\", the first body, with the masses \
             of the two; or \"jacobi\", the centre of mass of the bodies before, with their mass and the body's own, \
             which is REBOUND's default.",
            else "\"heliocentric\"", needs ["[[body]]"];
        barycentric: Kind::Truth => "true",
            "For [[body]]: moves the centre of mass to the origin, and to rest.",
            else "false", needs ["[[body]]"];
        central: FORMULA => "\"-3*(g*m0)^2*m/(c^2*r^2)\"",
            "For [[body]]: an energy of each body but the first beside the attraction, a smooth formula in its \
             position x, y, z relative to the first body, in its distance r, its mass m, the mass m0 of the first \
             body, g and the parameters; by kicks, also with parts = \"wisdom-holman\". The example turns pericentres \
             as general relativity does.",
            else "none; bodies attract each other only", needs ["[[body]]"];
        external: FORMULA => "\"m*tide*z^2/2\"",
            "For [[body]]: an energy of each body, the first too, in the same names; x, y, z and r are those of the \
                inertial frame.",
            else "none; there are no other forces", needs ["[[body]]"];
        particles: PATH => "\"asteroids.csv\"",
            "For [[body]]: a file of CSV with bodies of mass 0, a line each, which the bodies attract; its path is \
             relative to the scene's folder. The first line has the names of the columns: x, y, z, vx, vy, vz or the \
             elements a, e, i, node, pericentre, and M or lambda; name gives them names.",
            else "none; a [[body]] of mass 0 is a particle, too", needs ["[[body]]"];
    },
)
.one_of("name|potential|pair|hamiltonian|parts[]|[[body]]");

const BODIES: Section = Section::new(
    "[problem.bodies]",
    "A table of properties, each with a list of one value for each body or a formula.",
    rows! {
        count: Kind::Whole(1, MOST_BODIES) => "32", "The number of bodies.", else "the number of values in the first list";
    },
)
.with_names(&NUMBERS_OR_FORMULA);

const CUTOFF: Section = Section::new(
    "[problem.cutoff]",
    "A smooth end in place of `cutoff = 2.5`. Between the two distances the energy of a pair is multiplied with a \
     polynomial in r2 that falls from 1 to 0.",
    rows! {
        at: POSITIVE => "\"5/2\"",
            "The distance at which the energy is 0.";
        from: NUMBER => "2",
            "The distance from which on it falls.";
        derivatives: Kind::Whole(1, MOST_DERIVATIVES as u64) => "3",
            "How many derivatives of the energy are continuous, 1 to 8. A scheme of high order needs more of them.";
    },
);

const ENCOUNTERS: Section = Section::new(
    "[problem.encounters]",
    "The table `encounters`.",
    rows! {
        within: POSITIVE => "\"3/10\"",
            "The distance below which planets are near, some 3 Hill radii or more.";
        substeps: Kind::Whole(1, MOST_SUBSTEPS) => "8",
            "How many substeps a step has, at least, while planets are near. Each time that their distance halves \
                there are three times as many.",
            else "4";
    },
);

const UNITS: Section = Section::new(
    "[problem.units]",
    "The table `units`.",
    rows! {
        length: Kind::Word(&["AU", "km", "m"]) => "\"AU\"",
            "\"AU\", \"km\" or \"m\".";
        time: Kind::Word(&["day", "year", "s"]) => "\"day\"",
            "\"day\", \"year\" or \"s\".";
        mass: Kind::Word(&["solar", "earth", "jupiter", "kg"]) => "\"solar\"",
            "\"solar\", \"earth\", \"jupiter\" or \"kg\".";
    },
);

pub(crate) const BODY: Section = Section::new(
    "[[body]]",
    "A body of a planetary system, in place of a name, a potential or a pair: a section for each, the central body \
     first. A planet has either q and v, in an inertial frame, or orbital elements, with angles in degrees.",
    rows! {
        name: NAME => "\"sun\"",
            "Its name, with which its coordinates are x_sun, y_sun, z_sun, px_sun, …",
            else "none; coordinates have the numbers of the bodies: x1, y1, …";
        mass: NUMBER => "\"1/1047.35\"",
            "Its mass, positive, or 0 of bodies that come last: these are attracted by the others and attract \
             nothing, and their momenta are velocities.";
        q: NUMBERS => "[1, 0, 0]",
            "Its position.",
            else "0 for the first body; otherwise elements are given instead",
            needs ["v"],
            excludes ["a", "e", "i", "node", "pericentre", "M", "lambda"];
        v: NUMBERS => "[0, 1, 0]",
            "Its velocity.",
            else "0 for the first body; otherwise elements are given instead", needs ["q"];
        a: NUMBER => "5.2",
            "The semi-major axis of its orbit about the first body, or about what `elements` of [problem] has; \
                negative of a hyperbola.",
            else "none; q and v are given instead";
        horizons: PATH => "\"earth.txt\"",
            "A table of vectors of JPL's Horizons in CSV, whose first row has its position and velocity; its path is \
             relative to the scene's folder. Requires `units`; all tables need the same centre, frame and time. The \
             first body may have none if it is their centre, the Sun or the body of its name.",
            else "none; q and v or elements are given instead",
            needs ["problem.units"],
            excludes ["q", "v", "a", "e", "i", "node", "pericentre", "M", "lambda"];
        e: NUMBER => "0.05",
            "The eccentricity.",
            else "0", needs ["a"];
        i: NUMBER => "1.3",
            "The inclination.",
            else "0", needs ["a"];
        node: NUMBER => "100.5",
            "The longitude Ω of the ascending node.",
            else "0", needs ["a"];
        pericentre: NUMBER => "-86",
            "The argument ω of the pericentre.",
            else "0", needs ["a"];
        M: NUMBER => "20",
            "The mean anomaly.",
            else "0", needs ["a"];
        lambda: NUMBER => "34.4",
            "The mean longitude Ω + ω + M, in place of M.",
            else "none; M is used", needs ["a"], excludes ["M"];
    },
);

pub(crate) const INITIAL: Section = Section::new(
    "[initial]",
    "The state at t = 0.",
    rows! {
        q: STATE => "[\"1 - 0.6\", 0]",
            "Positions, one for each coordinate. With `pair`: also a list for each body, [[0, 0, 0], [1, 0, 0]]; in \
             one dimension also a formula for all bodies, \"sin(i*pi/33)\", in the number i of the body and its \
             properties.",
            else "those of the shipped problem; otherwise required", excludes ["[[body]]"];
        p: STATE => "[0, \"sqrt((1 + 0.6)/(1 - 0.6))\"]",
            "Momenta, in the same form as q.",
            else "those of the shipped problem; otherwise `p` or `v` is required", excludes ["[[body]]"];
        v: STATE => "[0, 2]",
            "Velocities in place of momenta, p_i = m_i v_i; not with `kinetic`.",
            else "none; momenta are given instead", excludes ["p", "[[body]]"];
    },
);

pub(crate) const TIME: Section = Section::new(
    "[time]",
    "Transforms time, so that steps become short in close encounters: the steps have equal lengths in a fictitious \
     time s, and t is a coordinate. It requires U < 0 on the whole orbit, and a scheme for every T(p); `first = \
     \"drift\"` is best. The modified energy is that of H' = f(T + p_t) - f(-U), which is 0; `energy` is H.",
    rows! {
        transform: Kind::Word(&["logarithmic", "power"]) => "\"logarithmic\"",
            "\"logarithmic\": f = ln, dt/ds = 1/(-U); on an ellipse with the semi-major axis a about a mass M, s is m \
             sqrt(G M a) times the eccentric anomaly. Or \"power\": f(x) = x^exponent/exponent, dt/ds = \
             (-U)^(exponent - 1).";
        exponent: NONZERO => "\"-1/2\"",
            "For \"power\": not 0, a fraction with a numerator and denominator of at most 32. With -1/2 steps are \
             proportional to the time of free fall near a centre.",
            else "none; required for \"power\"";
    },
);

pub(crate) const RUN: Section = Section::new(
    "[run]",
    "The scheme, its steps, and the number type.",
    rows! {
        scheme: Kind::Text("scheme") => "\"yoshida4\"",
            "A shipped scheme, or the file of a table; its path is relative to the scene's folder. `shadowstep \
                schemes` lists the shipped schemes.";
        gradient_kicks: Kind::Word(&["exact", "displaced"]) => "\"displaced\"",
            "How gradient kicks are made: \"exact\", from second derivatives, or \"displaced\", by a force at \
             displaced positions, which is not exactly symplectic.",
            else "\"exact\"";
        first: Kind::Word(&["kick", "drift"]) => "\"drift\"",
            "What a step begins with: \"kick\" or \"drift\".",
            else "that of the table";
        step: NONZERO => "\"1/20\"",
            "The step size h, nonzero; negative to go back in time. With [time] it is a step of s.";
        until: NUMBER => "100",
            "The time at which the run ends. If it is not a multiple of h, the run ends at the last multiple before \
             it. With [time] it is a physical time, and the run ends there by a last step of the exact remainder: a \
             row more, which is always written.",
            else "none; `steps` are given instead";
        end: CONDITION => "\"x^2 + y^2 > 100\"",
            "A condition that ends the run at the first state after t = 0 that meets it: one comparison of formulas \
             in the coordinates, momenta and parameters, t and the energy E. `until` or `steps` is the end if it is \
             not met.",
            else "none; the run ends with `until` or `steps`";
        steps: EVERY => "2000",
            "The number of steps, in place of `until`.",
            else "none; `until` is given instead", excludes ["until"];
        digits: Kind::Any(&[Kind::Whole(1, MOST_DIGITS as u64), Kind::Word(&["double", "compensated", "double-double"])]) => "120",
            "The decimal digits of all numbers, or \"double\" for double precision, or \"compensated\" for double \
             precision in which positions and momenta are sums with remainders: less round-off in long runs, for up \
             to half more time; or \"double-double\" for sums of two doubles, about 32 digits, for 4 to 9 times the \
             time of double precision.",
            else "\"double\"";
        mpfr: Kind::Truth => "true",
            "MPFR's numbers, also for up to 307 digits, for which numbers of some limbs of 64 bits take less time. \
                Requires a number of `digits`.",
            else "false";
    },
)
.one_of("until|steps");

pub(crate) const OUTPUT: Section = Section::new(
    "[output]",
    "What is written, and where. Nothing else is computed.",
    rows! {
        file: PATH => "\"kepler.csv\"",
            "The file for the rows; its path is relative to the scene's folder. A .csv file begins with lines of \
             metadata that start with #, as in pandas.read_csv(file, comment=\"#\"); a .jsonl file has JSON lines, \
             one a row, as in pandas.read_json(file, lines=True), and the file with .metadata.json after its name has \
             the metadata and the summary. So it has beside a .npy file, an array of NumPy in double precision with \
             fields n, t, energy, …, q and p, as in numpy.load(file, mmap_mode=\"r\"). The file gets its name when it \
             is complete. An existing file is replaced only if it is from this unchanged scene, or with --force.",
            else "none; rows go to stdout";
        format: Kind::Word(&["csv", "jsonl", "npy"]) => "\"jsonl\"",
            "\"csv\", \"jsonl\" or \"npy\", independent of the file's name.",
            else "from the file's name; \"csv\" on stdout";
        energy: Kind::Any(&[Kind::Truth, Kind::Table(&ENERGY)]) => "{ every = 10 }",
            "Writes H as a column `energy`: true, or a table.",
            else "false";
        modified_energy: Kind::Any(&[Kind::Truth, Kind::Table(&MODIFIED_ENERGY)]) => "{ order = \"auto\", max_order = 100 }",
            "Writes the modified energy as columns `modified_energy`, `estimate` (its estimated error, also near \
             close encounters; empty for order = 1, which gives no reliable estimate) and `order` (the m or k used): \
             true, or a table.",
            else "false";
        trajectory: Kind::Any(&[Kind::Truth, Kind::Table(&TRAJECTORY)]) => "{ every = 100 }",
            "Writes positions and momenta as columns x, y, …, px, py, …: true, or a table.",
            else "false";
        values: Kind::Table(&VALUES) => "{ r = \"sqrt(x^2 + y^2)\", every = 10 }",
            "Writes formulas in the coordinates, momenta, parameters, t and E as columns of these names, all of them \
             at every n that is a multiple of `every`. A formula can have quantities of bodies, which `shadowstep \
             scene --explain` lists at its end.",
            else "none";
        elements: Kind::Any(&[Kind::Truth, Kind::Table(&ELEMENTS)]) => "{ every = 100, centre = \"jacobi\" }",
            "Writes the elements of the osculating orbits of all bodies but the first as columns a_earth, e_earth, \
             i_earth, node_earth, pericentre_earth, M_earth, …, with angles in degrees: true, or a table. They are \
             heliocentric, about the first body; `centre` has others, such as REBOUND's default \"jacobi\".",
            else "false";
        modified_hamiltonian: Kind::Any(&[GRADE, Kind::List(&GRADE), Kind::Table(&MODIFIED_HAMILTONIAN)]) => "{ grade \
            = [2, 4, 6], every = 10 }",
            "Writes H + h^2 H_3 + …, the series of the modified Hamiltonian up to this power of h, derived as a \
             formula, as the column `modified_hamiltonian_4`: the power, a list of several, or a table. It requires \
             T(p) + U(q) by formulas, or parts that are formulas.",
            else "none";
        extremes: Kind::Names(&FORMULA) => "{ closest = \"distance(earth, moon)\" }",
            "Adds the least and the greatest values of formulas over all states to the summary; the formulas are \
                those of `values`.",
            else "none";
        chaos: Kind::Any(&[Kind::Truth, Kind::Table(&CHAOS)]) => "{ every = 100 }",
            "Writes indicators of chaos as columns `lyapunov`, `megno`, `mean_megno` and `sali`, of two tangent \
             vectors from t = 0: true, or a table. See docs/chaos.md.",
            else "false";
        checkpoint: Kind::Any(&[EVERY, Kind::Text("time")]) => "\"1 min\"",
            "How often the run saves a checkpoint: a time in s, min or h, or a number of steps. If a run is stopped, \
             running the scene again resumes it from the last checkpoint, and the file gets the same bytes. A changed \
             scene, even if only a comment is different, cannot be resumed. The last checkpoint stays beside the \
             complete file: with a later `until` or more `steps`, and nothing else changed, the run goes on from \
             there. Requires `file`.",
            else "none; a run that is stopped leaves no file", needs ["file"];
        summary: Kind::Truth => "false",
            "Whether a summary of the run is made, with its verdict. With hundreds of digits and more it may take \
                longer than the steps.",
            else "true";
        windows: Kind::Whole(Verdict::LEAST_WINDOWS, MOST_STEPS) => "2000",
            "In about how many windows of 17 states the summary compares modified energies, spread over the run. More \
             windows exclude smaller changes where H varies like noise from window to window, and cost more; an \
             undecided verdict is more often decided by a longer run.",
            else "256";
        plot: Kind::Any(&[PATH, Kind::Table(&PLOT)]) => "\"kepler.svg\"",
            "The file for a chart of the energies; its path is relative to the scene's folder. Or a table, for other \
             charts. Charts are drawn from the rows of `file` when it is complete, and are replaced as `file` is.",
            else "none", needs ["file"];
    },
);

const ENERGY: Section = Section::new(
    "[output.energy]",
    "A table in place of `energy = true`.",
    rows! {
        every: EVERY => "10",
            "It is written at every n that is a multiple of this.",
            else "1";
    },
);

const MODIFIED_ENERGY: Section = Section::new(
    "[output.modified_energy]",
    "A table in place of `modified_energy = true`.",
    rows! {
        every: EVERY => "10",
            "It is written at every n that is a multiple of this.",
            else "1";
        estimator: Kind::Word(EstimatorSettings::NAMES) => "\"central\"",
            "\"bilinear\" for products of k + 1 states in pairs, or \"central\" for central differences D_m of 2m + 1 \
             states, the estimator of Moan and Niesen, which needs more states for the same error.",
            else "\"bilinear\"";
        order: Kind::Any(&[Kind::Whole(1, HIGHEST_ORDER as u64), Kind::Word(&["auto"])]) => "40",
            "The k of the bilinear estimator, which must be even and at most 256, or the m of D_m, at most 1000; or \
             \"auto\" for the best one of each state.",
            else "\"auto\"";
        max_order: Kind::Whole(2, HIGHEST_ORDER as u64) => "100",
            "The largest k or m that \"auto\" tries.",
            else "64 for the bilinear estimator, 200 for central differences";
        stop: Kind::Word(StoppingRule::NAMES) => "\"early\"",
            "For estimator = \"central\": where \"auto\" stops trying m: \"full\" at the largest m; \"early\" at the \
             first m >= 13 whose term is larger than the eleven before it, which is the rule of Moan and Niesen with \
             < where they print <=; \"printed\" with <=, at the first ripple.",
            else "\"full\"";
        rule: Kind::Word(SelectionRule::NAMES) => "\"robust\"",
            "For estimator = \"central\": which m \"auto\" uses: \"least\" minimises the term |T_m - T_(m-1)|; \
             \"robust\" minimises the maximum of ten neighbouring terms, so that no single term can be small by \
             chance.",
            else "\"least\"";
        accuracy: POSITIVE => "1e-20",
            "Of the bilinear estimator: a target error; \"auto\" uses the least k of 2, 4, 8, 16, … and max_order \
             that meets it, or the best of them if none does. The column `estimate` has the estimated errors.",
            else "none; the best k of each state";
    },
);

const TRAJECTORY: Section = Section::new(
    "[output.trajectory]",
    "A table in place of `trajectory = true`.",
    rows! {
        every: EVERY => "100",
            "They are written at every n that is a multiple of this.",
            else "1";
        section: FORMULA => "\"x\"",
            "A formula in positions and momenta, in place of `every`: they are written where it becomes 0 between two \
             states, at the end of a step of a part of h from the state before (M. Hénon, Physica D 5 (1982) 412). \
             Its row has the n of the state before.",
            else "none; `every` says when", excludes ["every", "output.modified_energy"];
        direction: Kind::Word(&["up", "down", "both"]) => "\"both\"",
            "How the formula of `section` goes through 0, in the order of the steps: \"up\", \"down\" or \"both\".",
            else "\"up\"", needs ["section"];
    },
);

const VALUES: Section = Section::new(
    "[output.values]",
    "Names, each with a formula.",
    rows! { every: EVERY => "10", "They are written at every n that is a multiple of this.", else "1"; },
)
.with_names(&FORMULA);

const ELEMENTS: Section = Section::new(
    "[output.elements]",
    "A table in place of `elements = true`.",
    rows! {
        every: EVERY => "100",
            "They are written at every n that is a multiple of this.",
            else "1";
        centre: Kind::Word(&["heliocentric", "jacobi", "barycentric"]) => "\"jacobi\"",
            "What orbits are about: \"heliocentric\" for the first body, with the masses of the two; \"jacobi\", \
             REBOUND's default, for the centre of mass of the bodies before, with their mass and the body's own; \
             \"barycentric\" for the centre of mass of all bodies, with their mass, where the first body has an \
             orbit, too.",
            else "\"heliocentric\"";
    },
);

const MODIFIED_HAMILTONIAN: Section = Section::new(
    "[output.modified_hamiltonian]",
    "A table in place of `modified_hamiltonian = 4`.",
    rows! {
        grade: Kind::Any(&[GRADE, Kind::List(&GRADE)]) => "4",
            "The highest power of h, at most 10, or a list of such.";
        every: EVERY => "10",
            "It is written at every n that is a multiple of this.",
            else "1";
    },
);

const CHAOS: Section = Section::new(
    "[output.chaos]",
    "A table in place of `chaos = true`.",
    rows! {
        every: EVERY => "100",
            "They are written at every n that is a multiple of this.",
            else "1";
    },
);

const PLOT: Section = Section::new(
    "[output.plot]",
    "A table in place of `plot = \"kepler.svg\"`.",
    rows! {
        file: PATH => "\"kepler.svg\"",
            "The file of the first chart; the others have their names in addition: kepler-orbit-x-y.svg.";
        of: Kind::List(&Kind::Text("chart")) => "[\"energies\", \"orbit=x:y\", \"distance\"]",
            "The charts. \"energies\": |H - H(0)| and |H̄ - H̄*|, H̄* the H̄ with the least estimated error, with \
             that error, in time; requires `energy` or `modified_energy`. \"orbit=x:y\": one coordinate or momentum \
             against another; where there are bodies with coordinates such as x1, y1 or x_sun, y_sun, also x:y for \
             all of them. \"distance\": of every two bodies in time, or without bodies from the origin; \
             \"distance=1\" of body 1 from the others; \"distance=1:2\" of two. Orbits and distances require \
             `trajectory`.",
            else "[\"energies\"]";
    },
);

pub(crate) const ENSEMBLE: Section = Section::new(
    "[ensemble]",
    "Makes many trajectories of the scene, which differ in initial values and parameters. `shadowstep run` computes \
     them in vectors of the processor and on all cores, and writes a row for each: its state at the end, the largest \
     |H - H(0)|/|H(0)|, and max - min of the modified energy, if [output] has `modified_energy`.",
    rows! {
        columns: Kind::Names(&Kind::List(&NUMBER)) => "{ x0 = [1, 1.1, \"3/2\"] }",
            "Names, each with a list of one number for each trajectory. All numbers and formulas of [problem] and \
                [initial] can contain the names.",
            else "none; a `file` is given instead";
        file: PATH => "\"starts.csv\"",
            "A file of CSV in place of `columns`: a line of names, then a line of numbers for each trajectory. Its \
             path is relative to the scene's folder.",
            else "none; `columns` are given instead", excludes ["columns"];
    },
)
.one_of("columns|file");

/// The heading of the section that has a key of this name: `[run]`.
pub fn section_with(name: &str) -> Option<&'static str> {
    let all = SECTIONS.into_iter().flat_map(|section| [section].into_iter().chain(section.tables()));
    all.filter(|section| section.find(name).is_some()).map(|section| section.heading).next()
}
