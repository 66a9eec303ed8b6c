"""Other programs' readers open our files: VTK's own (ParaView's), ASE's, HOOMD's GSD, MDAnalysis and LAMMPS. Those that
are not installed are named and left out, for they are large; without any of them the test is skipped.

usage: readers.py FOLDER   writes the files there unless they are there already (so that another machine may read them).
"""
import importlib
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np


def available(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def write(folder):
    import jam

    folder.mkdir(parents=True, exist_ok=True)
    s = jam.System.random(n=60, dim=2, seed=3, diameters=[1.0, 1.4] * 30)
    s.crunch()
    s.write(folder / "s.xyz")
    s.write(folder / "s.data")
    s.write(folder / "s.vtp")
    s.write_contacts(folder / "f.vtp")
    s.write_contacts(folder / "f.dump")
    np.savez(folder / "want.npz", x=s.positions, sigma=s.diameters, z=s.coordination, forces=s.forces, pairs=s.contacts.pairs)


def check_vtk(vtk, folder, want):
    from vtk.util.numpy_support import vtk_to_numpy

    def read(name):
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(folder / name))
        reader.Update()
        assert reader.GetErrorCode() == 0, name
        return reader.GetOutput()

    spheres, lines = read("s.vtp"), read("f.vtp")
    n, m = len(want["sigma"]), len(want["forces"])
    assert (spheres.GetNumberOfPoints(), spheres.GetNumberOfVerts(), lines.GetNumberOfLines()) == (n, n, 2 * m)
    assert (vtk_to_numpy(spheres.GetPoints().GetData())[:, :2] == want["x"]).all()
    assert (vtk_to_numpy(spheres.GetPointData().GetArray("diameter")) == want["sigma"]).all()
    assert (vtk_to_numpy(spheres.GetPointData().GetArray("contacts")) == want["z"]).all()
    assert ((vtk_to_numpy(spheres.GetPointData().GetArray("kind")) == 0) == (want["z"] == 0)).all()
    assert (vtk_to_numpy(lines.GetCellData().GetArray("force")) == np.tile(want["forces"], 2)).all()
    ends = vtk_to_numpy(lines.GetPoints().GetData()).reshape(2 * m, 2, 3)  # half a contact from each of its spheres
    half = want["sigma"][want["pairs"]].mean(1) / 2
    assert np.allclose(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1), np.tile(half, 2), rtol=1e-9)
    glyph = vtk.vtkGlyph3D()  # the filter that users are told to use
    glyph.SetInputData(spheres)
    source = vtk.vtkSphereSource()
    glyph.SetSourceConnection(source.GetOutputPort())
    glyph.SetInputArrayToProcess(0, 0, 0, 0, "diameter")
    glyph.SetScaleModeToScaleByScalar()
    glyph.Update()
    assert glyph.GetOutput().GetNumberOfPoints() >= 20 * n


def check_ase(folder, want):
    import ase.io

    atoms = ase.io.read(folder / "s.xyz")
    radius = atoms.arrays["radius"]
    assert (atoms.positions[:, :2] == want["x"]).all() and (2 * radius == want["sigma"]).all()
    assert list(atoms.pbc) == [True, True, False] and (atoms.arrays["contacts"] == want["z"]).all()
    distance = atoms.get_all_distances(mic=True)  # with the box that the file names: each sphere has the contacts listed
    near = np.abs(distance / np.add.outer(radius, radius) - 1) < 1e-9
    stable = want["z"] > 0
    assert (near[stable][:, stable].sum(1) == want["z"][stable]).all()


def check_gsd(gsd, folder, want):
    import jam

    for s in (jam.System.read(folder / "s.xyz"), tilted(2), tilted(3)):
        s.write(folder / "s.gsd")
        back = jam.System.read(folder / "s.gsd")
        assert (back.positions == s.positions).all() and (back.diameters == s.diameters).all()
        assert np.array_equal(back.cell, s.cell)
        with gsd.open(str(folder / "s.gsd"), "rb") as file:
            frame = file[0]
        assert frame.configuration.dimensions == s.dim
        lx, ly, lz, xy, xz, yz = frame.configuration.box
        theirs = np.array([[lx, 0, 0], [xy * ly, ly, 0], [xz * lz, yz * lz, lz]])[: s.dim, : s.dim]
        assert np.allclose(theirs, s.cell, rtol=1e-6)
        shift = np.linalg.solve(np.array(s.cell).T, (frame.particles.position[:, : s.dim] - s.positions).T).T - 0.5
        assert np.abs(shift - np.round(shift)).max() < 1e-6  # they lie in the cell around the origin
    # a file of another program, in float32 alone
    frame.log = {}
    with gsd.open(str(folder / "theirs.gsd"), "wb") as file:
        file.append(frame)
    back = jam.System.read(folder / "theirs.gsd", overlap="shrink")
    assert np.abs(back.diameters / s.diameters - 1).max() < 1e-5


def tilted(dim):
    import jam

    cell = np.eye(dim) + 0.3 * np.tri(dim, k=-1)
    return jam.System.random(n=60, dim=dim, seed=3, cell=cell, packing_fraction=0.3)


LAMMPS = """units lj
dimension {dim}
atom_style sphere
read_data {name}
pair_style zero 0.3
pair_coeff * *
compute near all property/local patom1 patom2
compute far all pair/local dist
dump near all local 1 {out} index c_near[1] c_near[2] c_far
dump_modify near format line "%d %.0f %.0f %.15g"
run 0
write_data again.data
"""


def check_lammps(program, folder, want):
    """LAMMPS takes the box, finds the spheres where we have them, and writes data that we read."""
    import jam

    for s in (jam.System.read(folder / "s.xyz"), tilted(2), tilted(3)):
        s.write(folder / "l.data")
        script = LAMMPS.format(dim=s.dim, name="l.data", out="near.dump")
        made = subprocess.run([program, "-log", "none"], input=script, text=True, capture_output=True, cwd=folder)
        assert made.returncode == 0, made.stdout[-2000:]
        back = jam.System.read(folder / "again.data", overlap="shrink")
        shift = np.linalg.solve(np.array(s.cell).T, (back.positions - s.positions).T).T
        assert np.abs(shift - np.round(shift)).max() < 1e-12 and np.allclose(back.cell, s.cell, rtol=1e-14)
        rows = np.loadtxt(folder / "near.dump", skiprows=9, ndmin=2)
        assert len(rows) > s.n
        i, j = rows[:, 1].astype(int) - 1, rows[:, 2].astype(int) - 1
        step = np.linalg.solve(np.array(s.cell).T, (s.positions[i] - s.positions[j]).T).T
        around = np.array(list(np.ndindex(*[3] * s.dim))) - 1
        distance = np.linalg.norm((step - np.round(step))[:, None] @ s.cell + around @ s.cell, axis=2).min(1)
        assert np.allclose(rows[:, 3], distance, rtol=1e-12)


def check_ase_both_ways(folder):
    """What ASE writes, we read by ASE; a file without radii needs diameters."""
    import ase.io

    import jam

    s = tilted(3)
    s.write(folder / "t.xyz")
    atoms = ase.io.read(folder / "t.xyz")
    ase.io.write(folder / "POSCAR", atoms, format="vasp")
    back = jam.files.read_ase(folder / "POSCAR", diameters=s.diameters[0], overlap="shrink")
    assert np.abs(back.positions - s.positions).max() < 1e-8
    try:
        jam.files.read_ase(folder / "POSCAR")
    except ValueError as error:
        assert "give diameters=" in str(error)
    else:
        raise AssertionError("no diameters were asked for")


def check_mdanalysis(mda, folder):
    """MDAnalysis keeps positions in single precision, and the cell as lengths and angles."""
    s = tilted(3)
    s.save(folder / "m.h5")
    s.write(folder / "m.data")
    s.write(folder / "m.gsd")
    s.write(folder / "m.xyz")
    h5md = mda.Universe.empty(s.n, trajectory=True)
    h5md.load_new(str(folder / "m.h5"), format="H5MD", convert_units=False)
    columns = "id type diameter density x y z"
    data = mda.Universe(str(folder / "m.data"), topology_format="DATA", format="DATA", atom_style=columns)
    gsd, xyz = mda.Universe(str(folder / "m.gsd")), mda.Universe(str(folder / "m.xyz"))
    for atoms in (u.atoms for u in (h5md, data, gsd, xyz)):
        assert len(atoms) == s.n
        shift = np.linalg.solve(np.array(s.cell).T, (atoms.positions - s.positions).T).T
        shift -= shift[0]  # GSD: the cell lies around the origin
        assert np.abs(shift - np.round(shift)).max() < 1e-6
    for atoms in (h5md.atoms, data.atoms):  # of GSD it takes tilt factors for angles, of xyz it takes no cell
        theirs = mda.lib.mdamath.triclinic_vectors(atoms.dimensions)
        assert np.allclose(theirs, s.cell, atol=1e-6)


def main():
    folder = Path(sys.argv[1])
    if not (folder / "want.npz").exists():
        write(folder)
    want, told = np.load(folder / "want.npz"), []
    for name, found, check in (
        ("VTK", available("vtk"), lambda vtk: check_vtk(vtk, folder, want)),
        ("ASE", available("ase"), lambda ase: (check_ase(folder, want), check_ase_both_ways(folder))),
        ("GSD", available("gsd.hoomd"), lambda gsd: check_gsd(gsd, folder, want)),
        ("MDAnalysis", available("MDAnalysis"), lambda mda: check_mdanalysis(mda, folder)),
        ("LAMMPS", shutil.which("lmp"), lambda lmp: check_lammps(lmp, folder, want)),
    ):
        if found:
            check(found)
        told.append((name, bool(found)))
    print("; ".join(f"{name}: {'agrees' if found else 'not installed'}" for name, found in told))
    sys.exit(0 if any(found for _, found in told) else 77)


if __name__ == "__main__":
    main()
