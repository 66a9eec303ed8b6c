"""Other programs' readers open our files: VTK's own (ParaView's) and ASE's. Skipped where neither is installed: they are large.

usage: readers.py FOLDER   writes the files there unless they are there already (so that another machine may read them).
"""
import importlib
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
    jam.files.write_vtk(s, folder / "s.vtp")
    jam.files.write_vtk_network(s, folder / "f.vtp")
    np.savez(folder / "want.npz", x=s.positions, sigma=s.diameters, z=s.coordination, forces=s.forces)


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
    assert (vtk_to_numpy(lines.GetCellData().GetArray("force")) == np.tile(want["forces"], 2)).all()
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
    distance = atoms.get_all_distances(
        mic=True
    )  # with the box that the file names: each sphere has the contacts listed
    near = np.abs(distance / np.add.outer(radius, radius) - 1) < 1e-9
    stable = want["z"] > 0
    assert (near[stable][:, stable].sum(1) == want["z"][stable]).all()


def main():
    folder = Path(sys.argv[1])
    if not (folder / "want.npz").exists():
        write(folder)
    want, vtk, ase = np.load(folder / "want.npz"), available("vtk"), available("ase")
    if vtk:
        check_vtk(vtk, folder, want)
    if ase:
        check_ase(folder, want)
    print(
        f"VTK: {'reads both files' if vtk else 'not installed'}; ASE: {'reads extended XYZ' if ase else 'not installed'}"
    )
    sys.exit(0 if vtk or ase else 77)


if __name__ == "__main__":
    main()
