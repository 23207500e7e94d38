"""The contestants: their programs, and for each problem their methods with the steps or tolerances that are swept."""

from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).parent
BUILD = HERE / "build"
PYTHON = BUILD / "venv" / "bin" / "python"


@dataclass(frozen=True)
class Method:
    """A method of a rival; `scheme` is the shipped scheme that it is, or its twin with kicks and drifts exchanged."""

    name: str
    # Force evaluations a step; none for methods that choose their steps by a tolerance.
    forces: int | None = None
    scheme: str | None = None
    # The systems that it is used for; none for all.
    systems: tuple[str, ...] | None = None
    # Why it is fast where it is the fastest, if that is not the reason of its rival.
    why: str | None = None

    def takes_part(self, system):
        return self.systems is None or system in self.systems


@dataclass(frozen=True)
class Rival:
    name: str
    # How it is made and used, for the page.
    how: str
    # Why it is fast where it is the fastest.
    why: str
    command: list
    methods: list[Method]
    systems: tuple[str, ...]
    # Whether its time is for one trajectory of many at once.
    many: bool = False
    tolerances: list[float] = field(default_factory=list)

    # The problems that would take it minutes.
    too_slow_for: tuple[str, ...] = ()

    def takes_part(self, problem):
        return problem.system in self.systems and problem.key not in self.too_slow_for

    def sweep(self, problem, method):
        """The steps or tolerances of a problem."""
        if method.forces is None:
            return [f"{tolerance:.2g}" for tolerance in self.tolerances]
        fewest, most, factor = problem.evaluations
        parameters, evaluations = [], fewest
        while evaluations <= most * 1.001:
            samples = round(evaluations / method.forces / problem.samples)
            if samples > 0:
                parameters.append(str(problem.samples * samples))
            evaluations *= factor
        return list(dict.fromkeys(parameters))


SMALL = ("kepler", "henon-heiles", "outer-solar-system", "fput-alpha")
ALL = (*SMALL, "argon")
DIGITS = ("kepler-120",)
GRAVITY = ("kepler", "outer-solar-system")
PLANETS = ("outer-solar-system",)

SCHEMES = [
    Method("stormer-verlet", 1, "stormer-verlet"),
    Method("yoshida4", 3, "yoshida4"),
    Method("mclachlan-sb3a5", 5, "mclachlan-sb3a5"),
    Method("omelyan-4mn5fv", 5, "omelyan-4mn5fv"),
    Method("blanes-moan-srkn6b", 6, "blanes-moan-srkn6b"),
    Method("blanes-moan-srkn11b", 11, "blanes-moan-srkn11b"),
    Method("blanes-moan-srkn14a", 14, "blanes-moan-srkn14a"),
    Method("bce-rkn8-17", 17, "bce-rkn8-17"),
    Method("sofroniou-spaletta10-35", 35, "sofroniou-spaletta10-35"),
]

# In numbers with fused products, and with compensated sums as well.
FUSED = [
    Method(f"{numbers}/{scheme.name}", scheme.forces, scheme.name if numbers == "fused" else None, SMALL)
    for numbers, least in (("fused", 5), ("fused-compensated", 14))
    for scheme in SCHEMES
    if scheme.forces >= least
]

KEPLER_SPLIT = (
    "WHFast, SABA and EOS split off the Kepler orbits around the Sun, so that only the small attractions of the planets are left to "
    "the splitting"
)


def decades(first, last):
    return [10.0**-n for n in range(first, last + 1)]


RIVALS = [
    Rival(
        "Shadowstep",
        "generated steps and potentials, `-C target-cpu=native`, LTO; in `f64`, in `Fused` numbers (fused/…), and these with compensated sums "
        "(fused-compensated/…)",
        "the schemes of order 6 to 10 need few evaluations, and their steps are unrolled into the potential",
        [BUILD / "cargo" / "release" / "ours"],
        SCHEMES + FUSED,
        (*ALL, *DIGITS),
    ),
    Rival(
        "Shadowstep, lanes",
        "64 trajectories, all alike, in four systems of 16 lanes (lanes/…), on one core; the time is for one of them",
        "it computes several trajectories in one vector",
        [BUILD / "cargo" / "release" / "ours"],
        [Method(f"lanes/{scheme.name}", scheme.forces) for scheme in SCHEMES if scheme.forces >= 5],
        ("kepler", "henon-heiles", "outer-solar-system"),
        many=True,
        too_slow_for=("outer-10000000",),
    ),
    Rival(
        "Shadowstep, planets",
        "the same, with the Kepler orbits of the planets and their interactions as parts, in Jacobi coordinates",
        "it splits off the Kepler orbits around the Sun, so that only the small attractions of the planets are left to the splitting",
        [BUILD / "cargo" / "release" / "ours"],
        [
            Method(f"wisdom-holman/{name}", kicks)
            for name, kicks in (
                ("drift-kick-drift", 1),
                ("saba2", 2),
                ("saba4", 4),
                ("abah864", 8),
                ("abah1064", 9),
                ("aba1064", 8),
            )
        ],
        PLANETS,
    ),
    Rival(
        "Shadowstep, logarithmic time",
        "the same in logarithmic time (logarithmic/…), with fused products and compensated sums as well (logarithmic-compensated/…), with drifts "
        "first; the last step ends at the physical time",
        "its steps become short at the pericentre, and keep the orbit: only the time along it has an error",
        [BUILD / "cargo" / "release" / "ours"],
        [
            Method(f"{kind}/{name}", drifts)
            for kind in ("logarithmic", "logarithmic-compensated")
            for name, drifts in (
                ("suzuki4", 5),
                ("sofroniou-spaletta6-13", 13),
                ("sofroniou-spaletta8-21", 21),
                ("sofroniou-spaletta10-35", 35),
            )
        ],
        ("kepler",),
    ),
    Rival(
        "C by hand",
        "gcc -O3 -march=native, the potentials and loops written for each problem, merged kicks",
        "it merges the kicks at the ends of neighbouring steps, and gcc fuses multiplications and additions and makes vector "
        "instructions for the pairs of argon and the springs of the chain; rustc keeps every operation as it is written",
        [BUILD / "by_hand"],
        SCHEMES,
        ALL,
    ),
    Rival(
        "REBOUND",
        "its Python package, one call of its C library for each run; safe_mode = 0",
        "its C code is written for gravity",
        [PYTHON, HERE / "python" / "rebound_rival.py"],
        [
            Method("leapfrog-2", 1, "stormer-verlet"),
            Method("leapfrog-4", 3, "yoshida4"),
            Method("leapfrog-8", 17),
            Method("ias15", why="IAS15 has order 15, adapts its steps and compensates its sums"),
            Method("eos-LF4-LF4-2", 3, systems=GRAVITY),
            Method("eos-PMLF6-LF8-4", 5, systems=PLANETS, why=KEPLER_SPLIT),
            Method("whfast", 1, systems=PLANETS, why=KEPLER_SPLIT),
            Method("whfast-17", 1, systems=PLANETS, why=KEPLER_SPLIT),
            Method("saba-4", 4, systems=PLANETS, why=KEPLER_SPLIT),
            Method("saba-10_6_4", 8, systems=PLANETS, why=KEPLER_SPLIT),
            Method("saba-H_10_6_4", 9, systems=PLANETS, why=KEPLER_SPLIT),
        ],
        GRAVITY,
        tolerances=[1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11],
    ),
    Rival(
        "heyoka",
        "its Python package; Taylor series, compiled for each problem and tolerance before the time is taken",
        "Taylor series of high order with steps chosen along the orbit, compiled for the very equations",
        [PYTHON, HERE / "python" / "heyoka_rival.py"],
        [Method("taylor")],
        SMALL,
        tolerances=decades(4, 16),
    ),
    Rival(
        "heyoka, batch",
        "the same for as many trajectories at once as the vectors hold; the time is for one of them",
        "it computes several trajectories in one vector",
        [PYTHON, HERE / "python" / "heyoka_rival.py"],
        [Method("batch")],
        SMALL,
        many=True,
        tolerances=decades(4, 16),
    ),
    Rival(
        "odeint",
        "Boost 1.74, g++ -O3 -march=native, `std::array`, the forces of the C program",
        "it is compiled as the C program is",
        [BUILD / "odeint_rival"],
        [
            Method("velocity_verlet", 1, "stormer-verlet"),
            Method("symplectic_rkn_sb3a_m4_mclachlan", 4),
            Method("symplectic_rkn_sb3a_mclachlan", 5, "mclachlan-sb3a5"),
            Method("runge_kutta_fehlberg78", why="its method of order 8 adapts the steps"),
        ],
        ALL,
        tolerances=decades(4, 14),
    ),
    Rival(
        "SUNDIALS",
        "SPRKStep of ARKODE 7.1.1, from the source in the crate sundials-sys 0.6.2, gcc -O3 -march=native",
        "its schemes of order 8 and 10 need few evaluations",
        [BUILD / "sundials_rival"],
        [
            Method("LEAPFROG_2_2", 2, "stormer-verlet"),
            Method("MCLACHLAN_4_4", 4),
            Method("SUZUKI_UMENO_8_16", 16),
            Method("SOFRONIOU_10_36", 36, "sofroniou-spaletta10-35"),
        ],
        SMALL,
    ),
    Rival(
        "Rust crates",
        "utsuroi 0.2.0, ode_solvers 0.6.2, differential-equations 0.7.0, LTO, `-C target-cpu=native`, the forces written by hand",
        "DOP853 of order 8 adapts its steps",
        [BUILD / "cargo" / "release" / "crates"],
        [
            Method("utsuroi/StormerVerlet", 2, "stormer-verlet"),
            Method("utsuroi/Yoshida4", 6, "yoshida4"),
            Method("utsuroi/Yoshida8", 30),
            Method("utsuroi/Dop853"),
            Method("ode_solvers/Dop853"),
            Method("differential-equations/velocity_verlet", 1, "stormer-verlet"),
            Method("differential-equations/ruth_forest", 3, "yoshida4"),
            Method("differential-equations/dop853"),
        ],
        SMALL,
        tolerances=decades(4, 14),
    ),
    Rival(
        "scipy",
        "`solve_ivp`, DOP853, the forces in Python or numpy",
        "its method of order 8 adapts the steps",
        [PYTHON, HERE / "python" / "scipy_rival.py"],
        [Method("DOP853")],
        ALL,
        tolerances=[1e-5, 1e-7, 1e-9, 1e-11, 1e-13],
        too_slow_for=("outer-10000000",),
    ),
    Rival(
        "pyhamsys",
        "`solve_ivp_symp`, the package's maps for H = T + U, the forces in Python or numpy",
        "its schemes of order 6 need few evaluations",
        [PYTHON, HERE / "python" / "pyhamsys_rival.py"],
        [Method("Verlet", 1, "stormer-verlet"), Method("RKN6b", 11, "blanes-moan-srkn11b")],
        ALL,
        too_slow_for=("outer-10000000",),
    ),
    Rival(
        "C with MPFR",
        "Debian's MPFR 4.2.0 and GMP 6.2.1, gcc -O3 -march=native",
        "neighbouring kicks are merged, and no operation is needless",
        [BUILD / "mpfr_debian"],
        [Method("stormer-verlet", 1, "stormer-verlet"), Method("yoshida4", 3, "yoshida4")],
        DIGITS,
    ),
    Rival(
        "C with our MPFR",
        "the same program with the MPFR and GMP that Shadowstep is linked with",
        "neighbouring kicks are merged, and no operation is needless",
        [BUILD / "mpfr_ours"],
        [Method("stormer-verlet", 1, "stormer-verlet"), Method("yoshida4", 3, "yoshida4")],
        DIGITS,
    ),
]
