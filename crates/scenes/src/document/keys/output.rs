//! The keys of what a run writes.

use shadowstep::shadow::{EstimatorSettings, HIGHEST_ORDER, SelectionRule, StoppingRule, Verdict};
use shadowstep_analysis::modified::HIGHEST_GRADE;

use crate::document::schema::{FORMULA, Kind, PATH, POSITIVE, Section};
use crate::rows;
use crate::run::steps::MOST_STEPS;

const EVERY: Kind = Kind::Whole(1, MOST_STEPS);
const GRADE: Kind = Kind::Whole(1, HIGHEST_GRADE as u64);

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
