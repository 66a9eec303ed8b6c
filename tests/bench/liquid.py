"""Pressure of the liquid in d = 2 to 8: event-driven dynamics beside the equations of state of jam.eos.

usage: liquid.py [N [COLLISIONS]]    JSON; N spheres (2000), collisions a sphere (2000)
"""
import json
import sys

import jam

# Two densities each, up to 0.85 to 0.9 of freezing (J. A. van Meel et al., Phys. Rev. E 80, 061110 (2009)); d = 7, 8: not known.
DENSITIES = {2: (0.4, 0.6), 3: (0.25, 0.44), 4: (0.15, 0.25), 5: (0.08, 0.15), 6: (0.05, 0.09), 7: (0.025, 0.045), 8: (0.015, 0.03)}
CLOSED = {2: "henderson", 3: "carnahan_starling"}


def measured(n, dim, fraction, collisions):
    liquid = jam.System.random(n, dim, 1, packing_fraction=0.5 * fraction)
    liquid.compress(growth_rate=0.03, pressure=1e12, packing_fraction=fraction)
    liquid.run(collisions_per_particle=200)
    found = liquid.run(collisions_per_particle=collisions)
    row = {"dim": dim, "fraction": fraction, "pressure": found.pressure, "error": found.pressure_error}
    return dict(row, **{form: jam.eos(form, dim, fraction, 0) for form in ("pade", CLOSED.get(dim)) if form})


if __name__ == "__main__":
    n, collisions = (int(x) for x in (sys.argv[1:] + ["2000", "2000"][len(sys.argv) - 1 :])[:2])
    json.dump([measured(n, dim, phi, collisions) for dim, pair in DENSITIES.items() for phi in pair], sys.stdout, indent=1)
