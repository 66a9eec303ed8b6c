#!/usr/bin/env python3
"""converters.py SECONDS [SEED]: odd objects into the Python layer's converters and verbs.

Every call ends with a result or with one of the documented exceptions, and the systems stay valid. A crash ends the
interpreter, and with it the test.
"""
import copy
import os
import pickle
import random
import re
import socket
import stat
import sys
import tempfile
import time

import numpy as np

import jam

ALLOWED = (jam.JamError, TypeError, ValueError, OverflowError, OSError, MemoryError)


class Odd:
    """Answers every conversion with something of its own."""

    def __init__(self, answer):
        self.answer = answer

    def __float__(self):
        return self.answer

    def __index__(self):
        return self.answer

    def __len__(self):
        return self.answer

    def __getitem__(self, at):
        if at > 3:  # or it has no end
            raise IndexError
        return self.answer

    def __array__(self, dtype=None):
        return np.array([self.answer] * 3)


def scalar(dice):
    return dice.choice(
        [
            dice.randrange(-1, 10),
            dice.choice([1, -1]) * 2 ** dice.choice([31, 63, 64]),
            10**400,
            0.5,
            0.1,
            -0.0,
            1e300,
            5e-324,
            float("nan"),
            float("inf"),
            True,
            None,
            "",
            "mk",
            "crunch",
            "\0",
            "ï",
            b"x",
            1j,
            [],
            {},
            (),
            object(),
            Odd(1.5),
            Odd("x"),
            np.float32(0.3),
            np.int8(-3),
            np.uint64(2**63),
            np.array(0.2),
            np.datetime64(1, "s"),
            len,
        ]
    )


def array(dice, n=6, dim=3):
    rng = np.random.default_rng(dice.randrange(10**6))
    good = rng.random((n, dim))
    odd = good.copy()
    odd[dice.randrange(n), dice.randrange(dim)] = dice.choice([np.nan, np.inf, -np.inf, 1e308, -1e-320])
    return dice.choice(
        [
            good,
            good[::-1],
            good.T,
            np.asfortranarray(good),
            good[:, :2],
            good.astype("f4"),
            good.astype(">f8"),
            good.astype(complex),
            good.astype(object),
            good.astype(str),
            good.tolist(),
            good.ravel(),
            good[None],
            good[:0],
            np.zeros((0, dim)),
            np.zeros((n, 0)),
            np.lib.stride_tricks.as_strided(good, (n, dim), (0, 8)),
            odd,
            memoryview(good),
            good * 1e200,
            np.broadcast_to(0.5, (n, dim)),
            np.ma.array(good, mask=good > 0.5),
            [[0.1], [0.2, 0.3]],
            "positions",
            range(9),
            Odd(0.5),
            scalar(dice),
        ]
    )


def path(dice, folder):
    return dice.choice(
        [
            os.path.join(folder, "a.dat"),
            os.path.join(folder, "a.xyz").encode(),
            os.path.join(folder, "a\0b"),
            folder,
            "",
            b"",
            os.path.join(folder, "\udcff.dat"),
            os.path.join(folder, "x" * 300),
            7,
            None,
            Odd("x"),
            object(),
            os.path.join(folder, "socket"),
            os.path.join(folder, "link"),
            os.path.join(folder, "none", "b.dat"),
        ]
    )


def some_options(dice, struct):
    """Up to three members of an option struct, `struct_size` and `reserved` among them, or a name that is none."""
    setters = [name.split("_options_")[1] for name in dir(jam._raw) if re.fullmatch(rf"jam_{struct}_options_\w+_set", name)]
    names = [name.removesuffix("_set") for name in setters] + ["unknown"]
    return {name: scalar(dice) for name in dice.sample(names, dice.randrange(4))}


def start(dice):
    dim = dice.choice([2, 3])
    return jam.System.random(n=6, dim=dim, seed=dice.randrange(99), packing_fraction=0.1)


def one(dice, folder, system):
    """One odd call; returns a system to go on with, or None."""
    kind = dice.randrange(14)
    if kind == 0:
        return jam.System.from_arrays(array(dice), array(dice) if dice.random() < 0.3 else 0.01, **some_options(dice, "create"))
    if kind == 1:
        options = some_options(dice, "create")
        options.update(n=dice.choice([5, 5.0, "5", 5.5, -5, None]), wall_time=0.2)
        return jam.System.random(**options)
    if kind == 2:
        system.positions = array(dice)
    elif kind == 3:
        system.velocities = array(dice)
    elif kind == 4:
        system.scale_diameters(scalar(dice))
    elif kind == 5:
        dice.choice([system.strain, lambda m: setattr(system, "cell", m)])(array(dice, 3, 3))
    elif kind == 6:
        system.write(path(dice, folder), dice.choice(["auto", "xyz", "plain", scalar(dice)]))
    elif kind == 7:
        dice.choice([jam.System.read, jam.System.from_checkpoint])(path(dice, folder))
    elif kind == 8:
        system.save(path(dice, folder))
    elif kind == 9:
        verb = dice.choice([system.run, system.compress, system.crunch, system.relax, system.decompress])
        options = some_options(dice, verb.__name__)
        options["wall_time"] = 0.05
        verb(**options)
    elif kind == 10:
        state = bytearray(pickle.dumps(system))
        for _ in range(dice.randrange(3)):  # only inside the checkpoint: a pickle is a program of its own
            at = state.find(b"jamstat")
            state[dice.randrange(at + 8, at + 300)] = dice.randrange(256)
        return pickle.loads(bytes(state))
    elif kind == 11:
        return copy.deepcopy(system)
    elif kind == 12:
        getattr(system, dice.choice(["contacts", "forces", "rattlers", "history", "report", "info", "cell"]))
    else:
        verb = dice.choice([system.modes, system.pair_correlation, system.rigidity, system.hessian])
        verb(scalar(dice))
    return None


def check(system):
    if system._handle is None:
        return
    x, sigma = system.positions, system.diameters
    assert np.isfinite(x).all() and (x >= 0).all() and (x < np.diag(system.cell)).all(), x
    assert np.isfinite(sigma).all() and (sigma > 0).all(), sigma


def main():
    seconds, seed = float(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
    dice, refused, calls, end = random.Random(seed), 0, 0, time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as folder:
        with socket.socket(socket.AF_UNIX) as there:
            there.bind(os.path.join(folder, "socket"))
        os.symlink("socket", os.path.join(folder, "link"))
        system = start(dice)
        while time.monotonic() < end:
            calls += 1
            try:
                system = one(dice, folder, system) or system
            except ALLOWED:
                refused += 1
            check(system)
            assert stat.S_ISSOCK(os.stat(os.path.join(folder, "link")).st_mode)  # no device is renamed over
            if calls % 50 == 0 or len(system) > 50:
                system = start(dice)
    print(f"{calls} calls, {refused} refused")
    assert 0.1 * calls < refused < 0.95 * calls


if __name__ == "__main__":
    main()
