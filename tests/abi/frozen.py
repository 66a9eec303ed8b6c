#!/usr/bin/env python3
"""frozen.py BUILD: from JAM_ABI 1 on `abi.py update` records additions and refuses what breaks old programs."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
HEADER, RECORD = "include/jam/jam.h", "tests/abi/recorded/jam/jam.h"
# what changes, where, and whether that may be recorded under the same number
CHANGES = [
    ("nothing", HEADER, "", "", True),
    ("the value of a constant", HEADER, "JAM_OVERLAP_SHRINK = 1", "JAM_OVERLAP_SHRINK = 3", False),
    ("a function goes", RECORD, "JAM_API int32_t jam_abi_version", "JAM_API int32_t jam_gone(void);\nJAM_API int32_t jam_abi_version", False),
    ("a member goes", HEADER, "\n  int64_t isostatic_contacts;", "\n", False),
    ("a member of another type", HEADER, "  int64_t excess_contacts;", "  int32_t excess_contacts;", False),
    ("a member in the middle", HEADER, "  double min_gap;", "  double more, min_gap;", False),
    ("a member at the end", HEADER, "  double proof_value, proof_bound;", "  double proof_value, proof_bound, more;", True),
    ("a reserved member is used", HEADER, "  int32_t reserved;\n} jam_crunch_options;", "  int32_t used;\n} jam_crunch_options;", True),
    ("another argument", HEADER, "jam_compress(jam_system *sys, const", "jam_compress(const jam_system *sys, const", False),
    ("a column behind the last", HEADER, "HISTORY_TOTAL_MSD_STABLE = 19 ", "HISTORY_TOTAL_MSD_STABLE = 19, JAM_HISTORY_NEW = 20 ", True),
    ("two columns of one number", HEADER, "HISTORY_TOTAL_MSD_STABLE = 19 ", "HISTORY_TOTAL_MSD_STABLE = 19, JAM_HISTORY_NEW = 3 ", False),
    ("a column goes", HEADER, "  JAM_DOS_CUMULATIVE_ERROR = 5", "", False),
    ("a column is renamed", HEADER, "JAM_DOS_CUMULATIVE_ERROR = 5", "JAM_DOS_SHARE = 5", False),
    ("columns change places", HEADER, "JAM_PORE_X = 0", "JAM_PORE_X = 1", False),
    ("another callback", HEADER, "(*jam_log_fn)(int32_t level", "(*jam_log_fn)(int64_t level", False),
]

wrong = 0
for what, file, before, after, allowed in CHANGES:
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder)
        shutil.copytree(root / "include", tree / "include")
        shutil.copytree(root / "tests/abi", tree / "tests/abi")
        for numbered in (HEADER, RECORD):
            text = (tree / numbered).read_text()
            (tree / numbered).write_text(re.sub(r"#define JAM_ABI \d+", "#define JAM_ABI 1", text))
        text = (tree / file).read_text()
        if before not in text:
            sys.exit(f"{file} has no {before.strip()}: this test is broken")
        (tree / file).write_text(text.replace(before, after, 1))
        done = subprocess.run(
            [sys.executable, tree / "tests/abi/abi.py", "update", sys.argv[1]], capture_output=True, text=True
        )
        if (done.returncode == 0) != allowed:
            print(f"{what}: {'refused' if allowed else 'recorded'}\n{done.stdout}{done.stderr}")
            wrong += 1
sys.exit(wrong)
