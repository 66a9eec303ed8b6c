#!/usr/bin/env python3
"""Damaged and crafted files of packings: packings.py [attempts = 200] [seed = 1]. Exit status 1 when one did harm.

Each attempt changes a good file in each way of WAYS and hands it to jam.load in a process of its own, which may live
ten seconds and take 2 GiB. A changed file gives the values that were written, or a StoreError that names it. Where the
checksums were made to fit the change, as an attacker can, other values may come, but no other error, and no harm.
"""
import collections
import dataclasses
import hashlib
import json
import os
import random
import re
import resource
import signal
import sys
import tempfile

import jam
from jam._formats import seal

SECONDS, MEMORY = 10, 2 << 30


def values(system):
    """All that a file gives, as text."""
    c = system.contacts
    arrays = (system.positions, system.diameters, system.velocities, c.pairs, c.vectors, c.gaps, c.forces)
    parts = [a.tobytes() + str(a.dtype).encode() for a in (*arrays, system.coordination, system.history)]
    parts.append(repr((dataclasses.asdict(system.report), system.calls)).encode())
    return [hashlib.sha256(p).hexdigest() for p in parts]


def flip(data, draw):
    at = draw.randrange(8 * len(data))
    data[at >> 3] ^= 1 << (at & 7)
    return data


def cut(data, draw):
    return data[: draw.randrange(len(data))]


def append(data, draw):
    return data + draw.randbytes(draw.randrange(1, 2000))


def blank(data, draw):
    at = draw.randrange(len(data))
    data[at : at + 512] = bytes(len(data[at : at + 512]))
    return data


def index_of(data):
    """Place and size of the index."""
    found = re.search(rb"index (\d{20}) (\d{20})", data)
    return int(found[1]), int(found[2])


def sealed_again(data):
    """Makes all checksums fit what the bytes say now."""
    at, size = index_of(data)
    try:
        index = json.loads(bytes(data[at : at + size]))
        for entry in index["data"].values():
            kind = seal.type_of(entry[2])
            entry[3] = hashlib.sha256(data[entry[0] : entry[0] + seal.size_of(entry[1], kind)]).hexdigest()
        text = json.dumps(index).encode()
        data[at : at + size] = text[:size].ljust(size)
    except Exception:
        pass  # the flip hit the index: only its own checksum can fit
    digest = hashlib.sha256(data[at : at + size]).hexdigest()
    whole = hashlib.sha256(data[seal.USER_BLOCK :]).hexdigest()
    data[: seal.USER_BLOCK] = seal.head_of(len(data), [at, size, digest], whole)
    return data


def craft(data, draw):
    """A flip behind the seal, one in three in the index, with checksums that fit."""
    first, size = index_of(data) if draw.random() < 0.3 else (seal.USER_BLOCK, len(data) - seal.USER_BLOCK)
    data[first + draw.randrange(size)] ^= 1 << draw.randrange(8)
    return sealed_again(data)


WAYS = {"flip": flip, "cut": cut, "append": append, "blank": blank, "craft": craft}


def attempt(data, expected):
    """What jam.load makes of the bytes in a process of its own."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.close(reader)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
            signal.alarm(SECONDS)
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            with open("changed.h5", "wb") as file:
                file.write(data)
            try:
                answer = "same" if values(jam.load("changed.h5")) == expected else "OTHER VALUES"
            except jam.store.StoreError as error:
                answer = "StoreError" if "changed.h5" in str(error) else "UNNAMED " + str(error)
            except BaseException as error:
                answer = f"{type(error).__name__}: {error}"
            os.write(writer, answer.encode()[:300])
        finally:
            os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as file:
        answer = file.read().decode()
    status = os.waitpid(child, 0)[1]
    return f"KILLED BY SIGNAL {status & 127}" if status else answer


def main():
    attempts, seed = (list(map(int, sys.argv[1:])) + [200, 1][len(sys.argv) - 1 :])[:2]
    draw = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        disks = jam.System.random(n=32, dim=2, seed=1, diameters=[1.0] * 16 + [1.4] * 16)
        disks.crunch()
        disks.save("good.h5")
        with open("good.h5", "rb") as file:
            good = file.read()
        expected = values(jam.load("good.h5"))
        assert attempt(good, expected) == "same" and attempt(sealed_again(bytearray(good)), expected) == "same"
        harm = 0
        for way, change in WAYS.items():
            count = collections.Counter(attempt(change(bytearray(good), draw), expected) for _ in range(attempts))
            allowed = {"same", "StoreError"} | ({"OTHER VALUES"} if way == "craft" else set())
            harm += sum(v for k, v in count.items() if k not in allowed)
            print(way, dict(count), flush=True)
        os.chdir("/")
    print(f"{harm} of {attempts * len(WAYS)} did harm")
    return harm != 0


if __name__ == "__main__":
    sys.exit(main())
