//! The keys of the sections that describe a system.

use shadowstep::systems::pairs::MOST_DERIVATIVES;

use crate::document::schema::{FORMULA, Kind, NAME, NAMES, NONZERO, NUMBER, NUMBERS, PATH, POSITIVE, Section};
use crate::rows;

/// The most bodies: with more, a step takes too long.
const MOST_BODIES: u64 = 1_000_000;

/// More substeps of a step would take a step's time each.
const MOST_SUBSTEPS: u64 = 1_000_000;

const FORMULAS: Kind = Kind::List(&FORMULA);
const NUMBERS_OR_FORMULA: Kind = Kind::Any(&[NUMBERS, FORMULA]);
/// A number for each coordinate, a list of these for each body, or a formula for all.
const STATE: Kind = Kind::Any(&[Kind::List(&Kind::Any(&[NUMBER, NUMBERS])), FORMULA]);

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
