"""Builds all contestants into evidence/rivals/build. The virtual environment is made by run.sh."""

import json
import os
import subprocess
from pathlib import Path

from contestants import BUILD, HERE, SCHEMES
from problems import PROBLEMS


RUST = HERE / "rust" / "Cargo.toml"


def run(*command, **environment):
    subprocess.run(list(map(str, command)), check=True, env=os.environ | environment)


def output(path, *command):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(subprocess.check_output(list(map(str, command)), text=True))


GCC = ["gcc", "-O3", "-march=native", "-Wall", "-Wextra"]


def crates():
    run("cargo", "build", "--release", "--locked", "--manifest-path", RUST, CARGO_TARGET_DIR=str(BUILD / "cargo"), RUSTFLAGS="-C target-cpu=native")


def c_and_odeint():
    run(*GCC, "-o", BUILD / "by_hand", HERE / "c" / "by_hand.c", "-lm")
    run("g++", "-O3", "-march=native", "-o", BUILD / "odeint_rival", HERE / "odeint" / "odeint_rival.cpp")


def mpfr():
    """With Debian's MPFR, and with the one that Shadowstep is linked with."""
    source = HERE / "mpfr" / "mpfr_rival.c"
    run(*GCC, "-o", BUILD / "mpfr_debian", source, "-lmpfr", "-lgmp")
    library = next((BUILD / "cargo").glob("release/build/gmp-mpfr-sys-*/out/lib/libmpfr.a"))
    include = library.parent.parent / "include"
    run(*GCC, f"-I{include}", "-o", BUILD / "mpfr_ours", source, library, library.with_name("libgmp.a"))


def sundials():
    """From the source that a crate of crates.io contains, as Debian 12 has a version before SPRKStep."""
    metadata = json.loads(subprocess.check_output(["cargo", "metadata", "--locked", "--format-version", "1", "--manifest-path", RUST]))
    crate = next(package for package in metadata["packages"] if package["name"] == "sundials-sys")
    source, made = Path(crate["manifest_path"]).parent / "vendor", BUILD / "sundials"
    others = [f"-DBUILD_{part}=OFF" for part in ("CVODE", "CVODES", "IDA", "IDAS", "KINSOL", "SHARED_LIBS")]
    run("cmake", "-S", source, "-B", made, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_C_FLAGS=-O3 -march=native", *others,
        "-DEXAMPLES_ENABLE_C=OFF", "-DEXAMPLES_INSTALL=OFF", "-DSUNDIALS_LOGGING_LEVEL=0")
    run("make", "-C", made, "-j2", "--silent")
    libraries = ["arkode/libsundials_arkode.a", "nvector/serial/libsundials_nvecserial.a", "sundials/libsundials_core.a"]
    run(*GCC, f"-I{source / 'include'}", f"-I{made / 'include'}", "-o", BUILD / "sundials_rival",
        HERE / "sundials" / "sundials_rival.c", *(made / "src" / library for library in libraries), "-lm")


def initial_states_and_weights():
    ours = BUILD / "cargo" / "release" / "ours"
    for system in {problem.initial for problem in PROBLEMS}:
        output(BUILD / "initial" / f"{system}.txt", ours, "initial", system)
    for method in SCHEMES:
        output(BUILD / "schemes" / f"{method.name}.txt", ours, "weights", method.name)


def build():
    BUILD.mkdir(exist_ok=True)
    crates()
    c_and_odeint()
    mpfr()
    sundials()
    initial_states_and_weights()
