"""A user's program under mypy --strict (mypy.sh): what calls return is known to the type checker. It is not run."""
from typing import assert_type

import numpy as np

import jam

packing = jam.System.random(n=64, dim=2, seed=1)
assert_type(packing, jam.System)
assert_type(packing.compress(), jam.MdReport)
report = packing.crunch()
assert_type(report, jam.CrunchReport)
assert_type(report.packing_fraction, float)
assert_type(report.jammed, bool)
assert_type(report.status > jam.StatusCode.OK, bool)
assert_type(report.stop_reason, jam.StopReason)
assert_type(packing.rigidity("strict").jammed, jam.Verdict)
assert_type(packing.contacts, jam.Contacts)
assert_type(packing.modes(3), jam.Modes)
assert_type(jam.load("packing.h5"), jam.System)
assert_type(jam.advise(100), jam.Advice)
assert_type(packing.check().text, str)
for array in (packing.positions, packing.forces, packing.gaps(1.0, True).gap, packing.history, jam.sizes("equal", 3)):
    assert isinstance(array, np.ndarray)
ensemble = jam.ensemble.Ensemble("packings", dict(n=64, dim=2))
assert_type(ensemble, jam.ensemble.Ensemble)
assert_type(ensemble.run(range(3)), jam.ensemble.Status)
for entry in ensemble:
    assert_type(entry, jam.ensemble.Entry)
    assert_type(entry.system(), jam.System)
