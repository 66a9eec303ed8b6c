"""The page for users of other programs names each of their parameters, and names of ours that the header really has."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CALIPPSO = """Xs R Rs L l0 sqrGamma0 thresholds_bounds sbound tol_Gamma_convergence tol_S_convergence max_iters non_iso_break
    tol_mechanical_equilibrium zero_force tol_overlap ratio_sl_update interval_overlaps_check initial_overlaps_check monitor_step
    initial_monitor verbose non_iso_warn optimizer solver_attributes add_bridges threads""".split()
SKOGE = """eventspercycle N initialpf maxpf temp growthrate maxpressure maxcollisionrate bidispersityratio bidispersityfraction massratio
    hardwallBC readfile writefile datafile""".split()
OTHER = {"new", "ipm", "clp"}  # values, not names


def main():
    text = (ROOT / "bindings/docs/coming_from.md").read_text()
    header = (ROOT / "include/jam/jam.h").read_text()
    first, second = text.split("## The code of Skoge")
    bad = []
    for part, names in ((first, CALIPPSO), (second, SKOGE)):
        rows = [
            [c.strip() for c in line.strip("|\n").split(" | ")] for line in part.splitlines() if line.startswith("| ")
        ]
        theirs = {name for row in rows for name in re.findall(r"`([\w!]+)`", row[0])}
        bad += [f"{name} is not in the table" for name in names if name not in theirs]
        for row in rows[1:]:
            if len(row) != 3 or not row[1]:
                bad.append(f"no equivalent and no 'none' for {row[0]}")
            for name in re.findall(r"`(\w+)`", row[1]):
                if name not in OTHER and not re.search(rf"\b({name}|JAM_HISTORY_{name.upper()})\b", header):
                    bad.append(f"{name} is not in jam.h")
    print("\n".join(bad) or f"{len(CALIPPSO) + len(SKOGE)} parameters named")
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
