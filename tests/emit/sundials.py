"""SUNDIALS with SPRKStep, which Debian 12 does not have: built from the source that the crate sundials-sys contains."""

import functools
import json
import subprocess
from pathlib import Path

from commands import BUILT, Failed, Missing, found

RIVALS = Path(__file__).parents[2] / "evidence/rivals/rust/Cargo.toml"
LIBRARIES = ["arkode/libsundials_arkode.a", "nvector/serial/libsundials_nvecserial.a", "sundials/libsundials_core.a"]


def source():
    """Where cargo has unpacked the crate."""
    metadata = ["cargo", "metadata", "--locked", "--format-version", "1", "--manifest-path", RIVALS]
    done = subprocess.run(metadata, capture_output=True, text=True)
    if done.returncode != 0:
        raise Missing(f"the crate sundials-sys cannot be fetched: {done.stderr.strip().splitlines()[-1]}")
    crate = next(package for package in json.loads(done.stdout)["packages"] if package["name"] == "sundials-sys")
    return Path(crate["manifest_path"]).parent / "vendor"


@functools.cache
def options():
    """What the C compiler needs."""
    crate, made = source(), BUILT / "sundials"
    libraries = [made / "src" / library for library in LIBRARIES]
    if not all(library.exists() for library in libraries):
        others = [f"-DBUILD_{part}=OFF" for part in ("CVODE", "CVODES", "IDA", "IDAS", "KINSOL", "SHARED_LIBS")]
        configure = [found("cmake"), "-S", crate, "-B", made, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_C_FLAGS=-O1 -ffp-contract=off",
                     *others, "-DEXAMPLES_ENABLE_C=OFF", "-DEXAMPLES_INSTALL=OFF", "-DSUNDIALS_LOGGING_LEVEL=0"]
        targets = ["sundials_arkode_static", "sundials_nvecserial_static", "sundials_core_static"]
        for command in configure, ["cmake", "--build", made, "-j2", "--target", *targets]:
            done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
            if done.returncode != 0:
                raise Failed(f"SUNDIALS cannot be built: {done.stderr}")
    return [f"-I{crate / 'include'}", f"-I{made / 'include'}", *libraries]
