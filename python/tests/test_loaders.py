"""The readers of files in docs/recorded-trajectories.md, as they are written there."""

from pathlib import Path

import numpy as np
import pytest

import shadowstep

PAGE = Path(__file__).parents[2] / "docs" / "recorded-trajectories.md"
H = 0.002
MASSES = np.array([39.948, 39.948, 20.18])


def block(beginning):
    """The code of the page that has these words."""
    code = [part.split("```")[0] for part in PAGE.read_text().split("```python\n")[1:]]
    return next(part for part in code if beginning in part)


def orbit(unit, h, steps=80):
    """Three particles on springs by velocity Verlet: q, v, U and the forces, in Å, with energies in units of `unit` of mass Å²/time²."""
    m, k = (MASSES * unit)[:, None], 20.0
    q, v = np.arange(9.0).reshape(3, 3) % 2, np.sin(np.arange(9.0)).reshape(3, 3)
    energy = lambda q: k / 2 * (q**2).sum() + 0.1 * (q**4).sum()  # noqa: E731
    force = lambda q: -k * q - 0.4 * q**3  # noqa: E731
    rows = []
    for _ in range(steps):
        rows.append((q.copy(), v.copy(), energy(q), force(q)))
        half = v + h / 2 * force(q) / m
        q = q + h * half
        v = half + h / 2 * force(q) / m
    return (np.array(of) for of in zip(*rows))


def run(code, capsys, **names):
    exec(code, {"np": np, "shadowstep": shadowstep, **names})  # noqa: S102
    return capsys.readouterr().out


def test_lammps(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    q, v, U, forces = orbit(1.036427e-4, H)
    random = np.random.default_rng(1)
    with open("run.dump", "w") as dump:
        for n in range(len(q)):
            dump.write(f"ITEM: TIMESTEP\n{n}\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ATOMS id xu yu zu vx vy vz fx fy fz\n")
            for i in random.permutation(3):
                dump.write(" ".join([str(i + 1), *(repr(float(x)) for of in (q, v, forces) for x in of[n, i])]) + "\n")
    assert run(block("def lammps"), capsys, U=U, h=H, masses=MASSES).startswith("nothing moves the energy")


def test_extended_xyz(tmp_path, monkeypatch, capsys):
    ase = pytest.importorskip("ase")
    calculator = pytest.importorskip("ase.calculators.singlepoint")
    from ase import io, units

    monkeypatch.chdir(tmp_path)
    dt = 1.0
    q, v, U, forces = orbit(1.0, dt * units.fs)
    frames = []
    for n in range(len(q)):
        atoms = ase.Atoms("Ar2Ne", positions=q[n], masses=MASSES, momenta=MASSES[:, None] * v[n])
        atoms.calc = calculator.SinglePointCalculator(atoms, energy=U[n], forces=forces[n])
        frames.append(atoms)
    io.write("run.extxyz", frames, columns=["symbols", "positions", "momenta", "masses", "forces"])
    assert run(block("run.extxyz"), capsys, dt=dt).startswith("nothing moves the energy")


def test_mdanalysis(capsys):
    analysis = pytest.importorskip("MDAnalysis")
    memory = pytest.importorskip("MDAnalysis.coordinates.memory")
    # masses in 0.01 u, so that energies are in kJ/mol
    q, v, U, forces = orbit(0.01, H)
    universe = analysis.Universe.empty(3, trajectory=True, velocities=True, forces=True)
    universe.add_TopologyAttr("masses", MASSES)
    box = np.array([90.0, 90.0, 90.0, 90.0, 90.0, 90.0])
    settings = {"velocities": v.astype("f4"), "forces": forces.astype("f4"), "dimensions": box, "dt": H}
    universe.load_new(q.astype("f4"), format=memory.MemoryReader, **settings)
    code = block("import MDAnalysis").replace("universe = MDAnalysis.Universe(*files)\n", "")
    assert run(code, capsys, universe=universe, U=U).startswith("nothing moves the energy")
