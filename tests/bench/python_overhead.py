"""Time that the Python layer adds: import, views, arrays in and out, a crunch beside jam-pack. Not in ctest: timings.

usage: PYTHONPATH=build/python python3 tests/bench/python_overhead.py [--pack build/jam-pack] [--file PACKING] [--repeat 5]
Prints JSON; all times in seconds, medians. The same work through the C ABI (ctypes, raw pointers) is the baseline for arrays.
"""
import argparse
import ctypes
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402

import jam  # noqa: E402


def median(f, repeat=15):
    times = []
    for _ in range(repeat):
        began = time.perf_counter()
        f()
        times.append(time.perf_counter() - began)
    return statistics.median(times)


def import_seconds(repeat):
    """Wall and processor time of a fresh import; the second says more on a busy machine."""
    code = (
        "import time; t, c = time.perf_counter(), time.process_time(); import {}; "
        "print(time.perf_counter() - t, time.process_time() - c)"
    )

    def run(name):
        done = subprocess.run([sys.executable, "-c", code.format(name)], capture_output=True, text=True, check=True)
        return [float(x) for x in done.stdout.split()]

    run("jam")
    times = [(*run("jam"), *run("numpy")) for _ in range(repeat)]
    names = ("import_jam", "import_jam_processor", "import_numpy", "import_numpy_processor")
    return {name: statistics.median(t[k] for t in times) for k, name in enumerate(names)}


def arrays():
    """1e6 doubles (n = 333334 spheres in d = 3, or 500000 in d = 2) in and out."""
    n = 500_000
    x = np.random.default_rng(1).random((n, 2))
    s = jam.System.from_arrays(x, 1e-9)
    v = np.random.default_rng(2).normal(size=(n, 2))
    library = ctypes.CDLL(os.path.join(os.path.dirname(jam.raw._raw.__file__), "..", "..", "libjam.so"))
    library.jam_set_velocities.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t]
    pointer = ctypes.c_void_p(int(s.handle.this))
    out = np.empty_like(v)

    def in_and_out():
        s.velocities = v
        np.copyto(out, s.velocities)

    def baseline():
        library.jam_set_velocities(pointer, v.ctypes.data, v.size)
        np.copyto(out, s.velocities)

    result = {"doubles": v.size, "velocities_in_and_out": median(in_and_out), "same_by_raw_pointers": median(baseline)}
    assert (out == v).all()
    result["view_positions"] = median(lambda: s.positions, 200)
    result["view_is_library_memory"] = s.positions.ctypes.data == jam.raw.jam_view(s.handle, jam.raw.JAM_VIEW_POSITIONS)[1][0]
    wide = np.zeros((n, 4), np.float32)
    wide[:, ::2] = v
    result["strided_float32_in"] = median(lambda: setattr(s, "velocities", wide[:, ::2]))
    result["info"] = median(lambda: s.info, 200)
    return result


def crunch(pack, path, repeat):
    """The same file through System.crunch and jam-pack: the library's own seconds and the wall time of the whole program."""
    python, program, python_wall, program_wall = [], [], [], []
    for _ in range(repeat):
        began = time.perf_counter()
        python.append(jam.System.read(path).crunch().seconds)
        python_wall.append(time.perf_counter() - began)
        with tempfile.TemporaryDirectory() as folder:
            report = os.path.join(folder, "report.json")
            began = time.perf_counter()
            subprocess.run([pack, "--input", path, "--report", report, "--quiet"], check=True)
            program_wall.append(time.perf_counter() - began)
            with open(report) as file:
                program.append(json.load(file)["seconds_crunch"])
    ratio = [a / b for a, b in zip(python, program)]
    return {
        "crunch_python": statistics.median(python),
        "crunch_jam_pack": statistics.median(program),
        "crunch_ratio": statistics.median(ratio),
        "crunch_ratio_of_best": min(python) / min(program),
        "wall_python": statistics.median(python_wall),
        "wall_jam_pack": statistics.median(program_wall),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pack")
    parser.add_argument("--file")
    parser.add_argument("--repeat", type=int, default=5)
    o = parser.parse_args()
    result = {"version": jam.__version__, **import_seconds(o.repeat), **arrays()}
    if o.pack and o.file:
        result.update(crunch(o.pack, o.file, o.repeat))
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    main()
