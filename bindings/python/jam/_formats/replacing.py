"""Where files are written that appear whole or not at all: one way for every file that Python writes.

A file is written under a name that nobody else has, in the folder of the target or in one of the caller's, and renamed
at the end. Its writer holds a lock on it. What can be locked has lost its writer and may be removed: locks end with
their process, whatever its number, its container or its machine.
"""
from __future__ import annotations

import contextlib
import errno
import fcntl
import hashlib
import os
import re
import stat
import uuid
from typing import IO, Iterator

from ..errors import JamError, StoreError

#: What to do after an error in writing
MENDED = "Nothing that was finished is lost: correct this and run again"
_OPEN = re.compile(r"/dev/(stdin|stdout|stderr|fd/\d+)|/proc/(self|thread-self|\d+)/fd/\d+")
_PART = re.compile(r"\.jam-[0-9a-f]{16}-[0-9a-f]{32}\.part")


def replaceable(path: str | os.PathLike[str]) -> str:
    """The regular file that a rename onto path may replace; links are followed, so that they stay. A rename would put a file in
    the place of devices, pipes, folders and what the shell has opened, and pass over the protection of files."""
    if _OPEN.fullmatch(os.fsdecode(path)):
        raise OSError(errno.EINVAL, "it is an open descriptor, give the name of a file", os.fspath(path))
    real = os.path.realpath(os.fspath(path))
    if os.path.exists(real):
        if not os.path.isfile(real):
            raise OSError(errno.EINVAL, "it is no regular file", os.fspath(path))
        if not os.access(real, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), os.fspath(path))
    return real


def require_ending(path: str | os.PathLike[str], endings: tuple[str, ...], why: str) -> None:
    """Other programs, and jam.read, go by a file's ending: a name that says another format is refused before any work."""
    if not os.fsdecode(path).lower().endswith(endings):
        raise ValueError(f"{os.fsdecode(path)} must end in {' or '.join(endings)}: {why}")


def open_regular(path: str | os.PathLike[str]) -> IO[bytes]:
    """A file to read that has a length and a beginning to go back to. A pipe without a writer would wait without end."""
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise OSError(errno.EINVAL, "it is no regular file", os.fspath(path))
    return os.fdopen(descriptor, "rb")


def _locked(folder: str, begin: str) -> IO[bytes]:
    """A new file under a lock."""
    while True:
        file = open(os.path.join(folder, f"{begin}{uuid.uuid4().hex}.part"), "x+b")
        with contextlib.suppress(OSError):  # a file system without locks
            fcntl.flock(file, fcntl.LOCK_EX)  # waits for who takes it for abandoned, and removes it
        if os.fstat(file.fileno()).st_nlink > 0:
            return file
        file.close()


def remove_abandoned(folder: str | os.PathLike[str], begin: str = "") -> None:
    """Removes the unfinished files of a folder whose writer is gone. What fails here is no error."""
    with contextlib.suppress(OSError):
        for name in (name for name in os.listdir(folder) if _PART.fullmatch(name) and name.startswith(begin)):
            path = os.path.join(folder, name)
            with contextlib.suppress(OSError), open(os.open(path, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK), "rb", 0) as file:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                os.unlink(path)


def _take_permissions(descriptor: int, old: os.stat_result) -> None:
    """The new file gets the mode of the old one, and its owner and group where this process may give a file away. Where the
    group stays another, that group gets nothing. Bits that lend the owner's rights to whoever runs a file are never taken.
    """
    mode = old.st_mode & 0o777
    for owner, group in ((old.st_uid, old.st_gid), (-1, old.st_gid)):
        with contextlib.suppress(OSError):
            os.fchown(descriptor, owner, group)
            break
    if os.fstat(descriptor).st_gid != old.st_gid:
        mode &= ~0o070
    os.fchmod(descriptor, mode)


@contextlib.contextmanager
def writing(path: str | os.PathLike[str]) -> Iterator[None]:
    """What the system refuses inside is a StoreError that names path."""
    try:
        yield
    except OSError as error:
        if isinstance(error, (JamError, StoreError)):
            raise
        raise StoreError(error.errno or 5, f"{path} cannot be written: {error.strerror or error}. {MENDED}") from error


@contextlib.contextmanager
def replacing(path: str | os.PathLike[str], parts: str | os.PathLike[str] | None = None) -> Iterator[IO[bytes]]:
    """A file that takes the place of path when the block ends without an exception: flushed to the disk, then renamed. What the
    system refuses is a StoreError.

    parts: folder of the unfinished file, on the same file system; default that of path, where those that killed writers of
    path left are removed first.
    """
    with writing(path):
        target = replaceable(path)
        folder, name = os.path.split(target)
        folder = os.fspath(parts or folder)
        begin = f".jam-{hashlib.sha256(os.fsencode(name)).hexdigest()[:16]}-"  # of one length, however long the name is
        if parts is None:
            remove_abandoned(folder, begin)
        with _locked(folder, begin) as file:
            try:
                if os.path.exists(target):
                    _take_permissions(file.fileno(), os.stat(target))
                yield file
                file.flush()
                os.fsync(file.fileno())
                os.replace(file.name, target)  # the lock holds until the file has its name
            except BaseException:
                with contextlib.suppress(OSError):
                    os.unlink(file.name)
                raise
    with contextlib.suppress(OSError):  # makes the rename outlive a crash; the file is whole either way
        place = os.open(os.path.dirname(target), os.O_RDONLY)
        try:
            os.fsync(place)
        finally:
            os.close(place)
