#!/usr/bin/env python3
"""Charts of molecular dynamics.

    md_charts.py speed MD_SPEED.json OUT.png     collisions a second against N, and against the packing fraction for
        lists and for cells alone
    md_charts.py accuracy LIBJAM.so|TABLE.json OUT.png [SECONDS]
        phi_J by crunch against processor time for growth rates and target pressures, N = 256, one seed a point; and the
        deviation from the slowest run. Prints the table as JSON.
    md_charts.py precision OUT.png               pressure at which growth ends for want of digits, against d and size ratio; needs
        the Python package `jam`. 128 spheres, half of them larger, G = 1e-2. Prints a table.
"""
import ctypes
import json
import sys
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def speed(source, target):
    table = json.load(open(source))
    rows = table["nve"]
    _, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2))
    for fraction in sorted({r["packing_fraction"] for r in rows}):
        line = [r for r in rows if r["packing_fraction"] == fraction]
        n, rate = [r["n"] for r in line], [r["collisions_per_second"] / 1e6 for r in line]
        low = [r["collisions_per_second"] / 1e6 - r["spread"][0] / 1e6 for r in line]
        high = [r["spread"][1] / 1e6 - r["collisions_per_second"] / 1e6 for r in line]
        left.errorbar(n, rate, yerr=[low, high], marker="o", capsize=3, label=f"packing fraction {fraction}")
    left.set_xscale("log")
    left.set_xlabel("spheres")
    left.set_ylabel("million collisions a second (processor time)")
    for k, n in enumerate(sorted({r["n"] for r in table["engines"]})):
        line = [r for r in table["engines"] if r["n"] == n]
        phi = [r["packing_fraction"] for r in line]
        right.plot(phi, [r["lists"] / 1e6 for r in line], "o-", color=f"C{k}", label=f"lists, N = {n}")
        right.plot(phi, [r["cells"] / 1e6 for r in line], "s--", color=f"C{k}", label=f"cells alone, N = {n}")
        taken = [(r["packing_fraction"], r[r["choice"]] / 1e6) for r in line]
        right.plot(*zip(*taken), "o", color="k", mfc="none", ms=11, label="chosen by the engine" if k else None)
    right.set_xlabel("packing fraction")
    for axes in (left, right):
        axes.set_ylim(bottom=0)
        axes.legend(fontsize=8)
    plt.tight_layout()
    plt.savefig(target, dpi=110)


class CreateOptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("dim", ctypes.c_int32),
        ("n", ctypes.c_int64),
        ("seed", ctypes.c_int64),
        ("box", ctypes.c_double),
        ("packing_fraction", ctypes.c_double),
        ("overlap", ctypes.c_int32),
        ("model", ctypes.c_int32),
        ("mk_zeta", ctypes.c_double),
    ]


class CompressOptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("reserved", ctypes.c_int32),
        ("growth_rate", ctypes.c_double),
        ("pressure", ctypes.c_double),
        ("packing_fraction", ctypes.c_double),
        ("collisions_per_particle", ctypes.c_double),
        ("wall_time", ctypes.c_double),
    ]


class Info(ctypes.Structure):
    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("dim", ctypes.c_int32),
        ("n", ctypes.c_int64),
        ("seed", ctypes.c_int64),
        ("box", ctypes.c_double),
        ("packing_fraction", ctypes.c_double),
        ("diameter_mean", ctypes.c_double),
        ("pressure", ctypes.c_double),
        ("model", ctypes.c_int32),
        ("monodisperse", ctypes.c_int32),
    ]


def accuracy(source, target, budget=60.0):
    if source.endswith(".json"):  # the table of an earlier run
        draw_accuracy(json.load(open(source)), target)
        return
    rows = measure_accuracy(source, budget)
    print(json.dumps(rows, indent=1))
    draw_accuracy(rows, target)


def measure_accuracy(library, budget):
    jam = ctypes.CDLL(library)
    jam.jam_last_error.restype = ctypes.c_char_p
    begin, rows = time.process_time(), []
    for growth in (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5):
        system, o, c = ctypes.c_void_p(), CreateOptions(), CompressOptions()
        jam.jam_create_options_init(ctypes.byref(o), ctypes.c_size_t(ctypes.sizeof(o)))
        o.n = 256
        jam.jam_create(ctypes.byref(o), None, ctypes.byref(system))
        jam.jam_compress_options_init(ctypes.byref(c), ctypes.c_size_t(ctypes.sizeof(c)))
        start = time.process_time()
        jam.jam_compress(system, ctypes.byref(c), None)
        c.growth_rate = growth
        spent = time.process_time() - start
        for pressure in (1e3, 1e5, 1e7, 1e9, 1e11):
            if time.process_time() - begin > budget:
                break
            c.pressure = pressure
            start = time.process_time()
            jam.jam_compress(system, ctypes.byref(c), None)
            spent += time.process_time() - start
            copy, info = ctypes.c_void_p(), Info()
            jam.jam_copy(system, ctypes.byref(copy))
            start = time.process_time()
            status = jam.jam_crunch(copy, None, None)
            crunch = time.process_time() - start
            info.struct_size = ctypes.sizeof(info)
            jam.jam_get_info(copy, ctypes.byref(info))
            jam.jam_destroy(copy)
            rows.append(
                {
                    "growth_rate": growth,
                    "pressure": pressure,
                    "seconds_md": round(spent, 3),
                    "seconds_crunch": round(crunch, 3),
                    "status": status,
                    "packing_fraction": info.packing_fraction,
                }
            )
        jam.jam_destroy(system)
    return rows


def draw_accuracy(rows, target):
    slowest = rows[-1]["packing_fraction"]
    figure, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 7))
    for growth in sorted({r["growth_rate"] for r in rows}, reverse=True):
        line = [r for r in rows if r["growth_rate"] == growth]
        seconds = [r["seconds_md"] + r["seconds_crunch"] for r in line]
        top.plot(seconds, [r["packing_fraction"] for r in line], "o-", label=f"G = {growth:g}")
        other = [(t, abs(r["packing_fraction"] - slowest) + 1e-16) for t, r in zip(seconds, line) if r is not rows[-1]]
        bottom.plot([t for t, _ in other], [x for _, x in other], "o-")
    best, route = np.inf, []
    for t, x in sorted(
        (r["seconds_md"] + r["seconds_crunch"], abs(r["packing_fraction"] - slowest) + 1e-16) for r in rows[:-1]
    ):
        if x < best:
            best = x
            route.append((t, x))
    bottom.step(*np.array(route).T, "k--", where="post", lw=1, label="fastest route to a deviation")
    bottom.legend(fontsize=8)
    top.set_ylabel("phi_J after crunch")
    top.legend(fontsize=8)
    bottom.set_yscale("log")
    bottom.set_ylabel("deviation from the slowest run")
    bottom.set_xscale("log")
    bottom.set_xlabel("processor seconds, crunch included (points: p = 1e3 ... 1e11)")
    figure.tight_layout()
    figure.savefig(target, dpi=120)


def precision(target):
    import jam

    ratios = (1.0, 1.4, 3.0, 10.0)
    print(
        "| d | ratio | p where it ends | why | deviation of p (1 - phi/phi_J) / d from 1 at p = 1e12 | largest overlap | s |"
    )
    print("|---|---|---|---|---|---|---|")
    for d in range(2, 7):
        ends = []
        for ratio in ratios:
            begin = time.process_time()
            start = 0.2 * 0.5 ** max(0, d - 3)
            with jam.System.random(128, d, packing_fraction=start, diameters=[1.0, ratio] * 64) as packing:
                packing.compress([(1e-2, 1e12)])
                middle = packing.run(100)  # at constant density, so that the pressure is sharp
                last = packing.compress([(1e-2, 1e60)], wall_time=60)
                # phi_J from the end, where 1 - phi / phi_J is beyond notice; rattlers do not share the pressure
                free = (1 - middle.packing_fraction / last.packing_fraction) * middle.pressure / d
            ends.append(last.pressure)
            print(
                f"| {d} | {ratio:g} | {last.pressure:.2e} | {jam.raw.jam_stop_string(last.stop_reason)} | {free - 1:+.3f} | {last.max_overlap:.1e} | "
                f"{time.process_time() - begin:.1f} |",
                flush=True,
            )
        plt.semilogy(ratios, ends, "o-", label=f"d = {d}")
    plt.xscale("log")
    plt.xlabel("ratio of diameters")
    plt.ylabel("reduced pressure where growth ends")
    plt.legend(fontsize=8)
    plt.tight_layout()
    plt.savefig(target, dpi=110)


if __name__ == "__main__":
    if (
        len(sys.argv) < 3
        or sys.argv[1] not in ("speed", "accuracy", "precision")
        or (sys.argv[1] != "precision" and len(sys.argv) < 4)
    ):
        sys.exit(__doc__)
    if sys.argv[1] == "precision":
        precision(sys.argv[2])
    elif sys.argv[1] == "speed":
        speed(sys.argv[2], sys.argv[3])
    else:
        accuracy(sys.argv[2], sys.argv[3], *map(float, sys.argv[4:5]))
