#!/usr/bin/env python3
"""What `shadowstep emit` writes, run where it belongs: each file by its own self-test, and with a wrong digit, which must fail.

`make test-emit` calls this. What is not installed is skipped, with the reason, unless REQUIRED="fortran python …" names it. Python's packages are
installed from PyPI, and SUNDIALS is built from the source that the crate sundials-sys contains, both into `target/emit`, once. `test.py fortran jax` makes
only these tests; SHADOWSTEP=PROGRAM tests another program than target/debug/shadowstep. The C is tested by `cargo test -p shadowstep-studies emit`.
"""

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import sundials
from commands import Failed, Missing, found, pkg_config, python_packages, run

ROOT = Path(__file__).parents[2]
BUILT = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
PROGRAM = os.environ.get("SHADOWSTEP", BUILT / "debug/shadowstep")

# kick first and drift first, at both ends and at one; gradient kicks inside and at both ends; processed; for H = A + εB; long
EVERY_KIND = ["stormer-verlet", "symplectic-euler", "yoshida4", "blanes-moan-srkn6b", "chin-4a", "omelyan-4mn3f3gv", "wisdom-kernel-3",
              "blanes6-7", "aba864", "sofroniou-spaletta10-35"]
WITHOUT_GRADIENT_KICKS = ["stormer-verlet", "symplectic-euler", "yoshida4", "blanes-moan-srkn6b", "aba864", "sofroniou-spaletta10-35"]
SYMMETRIC = ["stormer-verlet", "bcss3", "yoshida4", "blanes-moan-srkn6b", "aba864", "omelyan-4mn5fp", "sofroniou-spaletta10-35"]
FOR_EVERY_KINETIC = ["stormer-verlet", "symplectic-euler", "ruth3", "yoshida4", "aba864", "sofroniou-spaletta10-35"]

# the farthest a run may end from Shadowstep's, where the package may round otherwise
ROUND_OFF = 1e-12


def python(folder, file):
    return [python_packages("numpy"), file]


def jax(folder, file):
    return [python_packages("jax"), file]


def openmm(folder, file):
    return [python_packages("openmm"), file]


def blackjax(folder, file):
    return [python_packages("blackjax"), file]


def mici(folder, file):
    return [python_packages("mici"), file]


def julia(folder, file):
    return [found("julia"), file]


def fortran(folder, file):
    program = folder / "program"
    run([found("gfortran"), "-DSELF_TEST", "-O2", "-ffp-contract=off", "-std=f2018", "-Wall", "-Wextra", "-Werror", "-o", program, file], folder)
    return [program]


def arkode(folder, file):
    program = folder / "program"
    run(["cc", "-DSELF_TEST", "-O2", "-Wall", "-ffp-contract=off", "-x", "c", file, "-x", "none", *sundials.options(), "-lm", "-o", program], folder)
    return [program]


def petsc(folder, file):
    program = folder / "program"
    run([found("mpicc"), "-DSELF_TEST", "-O2", "-Wall", "-x", "c", file, "-x", "none", *pkg_config("petsc", "PETSc"), "-lm", "-o", program], folder)
    return [program]


def latex(folder, file):
    text = "\\documentclass{article}\\usepackage{booktabs}\\begin{document}\\input{%s}\\end{document}\n" % file.name
    (folder / "paper.tex").write_text(text)
    run([found("pdflatex"), "-halt-on-error", "-interaction=nonstopmode", "paper.tex"], folder)
    return None


# name: target, ending, how the program is made, schemes, whether the bits must be those of Shadowstep
TESTS = {
    "python": ("python", "py", python, EVERY_KIND, True),
    "jax": ("jax", "py", jax, EVERY_KIND, False),
    "fortran": ("fortran", "F90", fortran, EVERY_KIND, True),
    "julia": ("julia", "jl", julia, EVERY_KIND, True),
    "openmm": ("openmm", "py", openmm, WITHOUT_GRADIENT_KICKS, False),
    "blackjax": ("blackjax", "py", blackjax, SYMMETRIC, False),
    "mici": ("mici", "py", mici, SYMMETRIC, False),
    "sundials": ("sundials", "h", arkode, FOR_EVERY_KINETIC, True),
    "petsc": ("petsc", "h", petsc, FOR_EVERY_KINETIC, False),
    "latex": ("latex", "tex", latex, EVERY_KIND, False),
}


def emitted(folder, scheme, target, ending):
    """The file, named as it says itself."""
    file = folder / f"{scheme.replace('-', '_')}.{ending}"
    run([PROGRAM, "emit", scheme, "--to", target, "--output", file], folder)
    return file


def outcome(command, folder):
    done = subprocess.run(list(map(str, command)), cwd=folder, capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout, done.stderr


def check(scheme, target, ending, make, bits, folder):
    """Runs the self-test. The distance from Shadowstep that it reports."""
    command = make(folder, emitted(folder, scheme, target, ending))
    if command is None:
        return 0
    code, output, errors = outcome(command, folder)
    first = output.partition("\n")[0]
    if code != 0 or not first.startswith(f"{scheme}: 1000 steps of 1/64:"):
        raise Failed(f"the self-test of {scheme}: {output}{errors}")
    if first.endswith("the bits of Shadowstep"):
        return 0
    distance = float(re.search(r"(\S+) from Shadowstep", first)[1])
    if bits or distance > ROUND_OFF:
        raise Failed(f"{scheme}: {first}")
    return distance


def check_that_it_can_fail(target, ending, make, folder):
    """A wrong digit of a weight, the sixth."""
    file = emitted(folder, "yoshida4", target, ending)
    text = file.read_text()
    code = text.index("import ") if ending == "py" else 0
    weight = re.compile(r"\d\.\d{10,}").search(text, code)
    digit = weight.start() + 7
    file.write_text(text[:digit] + str((int(text[digit]) + 5) % 10) + text[digit + 1:])
    command = make(folder, file)
    code, output, _ = outcome(command, folder)
    if code == 0:
        raise Failed(f"yoshida4 with {weight[0]} changed in its sixth digit passes: {output}")


def check_acceptance(scheme, acceptance):
    """BlackJAX samples a Gaussian of dimension 100 with the acceptance that `shadowstep sampling` computes."""
    with tempfile.TemporaryDirectory(prefix="shadowstep-emit-") as folder:
        file = emitted(Path(folder), scheme, "blackjax", "py")
        code, output, errors = outcome([PROGRAM, "sampling", scheme, "--json", "--acceptance", acceptance], folder)
        if code == 0:
            script = Path(__file__).with_name("sampling.py")
            code, output, errors = outcome([python_packages("blackjax"), script, folder, file.stem, output], folder)
        if code != 0:
            raise Failed(f"the acceptance of {scheme}: {output}{errors}")


def test(name):
    target, ending, make, schemes, bits = TESTS[name]
    farthest = 0
    for scheme in schemes:
        with tempfile.TemporaryDirectory(prefix="shadowstep-emit-") as folder:
            farthest = max(farthest, check(scheme, target, ending, make, bits, Path(folder)))
    if name == "blackjax":
        for scheme, acceptance in [("stormer-verlet", "0.65"), ("bcss3", "0.7"), ("omelyan-4mn5fp", "0.9")]:
            check_acceptance(scheme, acceptance)
    if name == "latex":
        return f"{len(schemes)} schemes compile"
    with tempfile.TemporaryDirectory(prefix="shadowstep-emit-") as folder:
        check_that_it_can_fail(target, ending, make, Path(folder))
    agreement = "the bits of Shadowstep" if farthest == 0 else f"at most {farthest:.1e} from Shadowstep"
    return f"{len(schemes)} schemes: {agreement}; a wrong digit fails"


def main(chosen):
    required = os.environ.get("REQUIRED", "").split()
    if unknown := set(chosen + required) - set(TESTS):
        raise Failed(f"no tests {', '.join(unknown)}: there are {', '.join(TESTS)}")
    skipped = []
    for name in chosen or TESTS:
        begin = time.monotonic()
        try:
            print(f"{name}: {test(name)}, {time.monotonic() - begin:.0f} s", flush=True)
        except Missing as missing:
            if name in required:
                raise Failed(f"{name} is required: {missing}") from missing
            skipped.append(name)
            print(f"{name}: skipped, {missing}", flush=True)
    print(f"Passed; skipped: {', '.join(skipped)}. On Debian .ci/install-emit installs what there is." if skipped else "Passed.")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except Failed as failure:
        sys.exit(f"FAILED: {failure}")
