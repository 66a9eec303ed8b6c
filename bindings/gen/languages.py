"""Each call of the header is in each language exactly once: its generator makes it, or it is in the list of those that are
written by hand. Anything else ends the build."""
import emit_fortran_packing
import emit_js
import emit_julia_calls
import emit_methods
import emit_octave
from annotations import HeaderError

# Texts, and what makes, frees, shows and watches a packing: each language has its own ways.
OWN = frozenset("""jam_version jam_commit jam_abi_version jam_blas_kernel jam_status_string jam_stop_string jam_last_error jam_set_error
    jam_formats jam_notes jam_check_text jam_proof_text jam_create jam_copy jam_tile jam_read jam_read_as jam_read_checkpoint jam_destroy
    jam_view jam_set_progress jam_set_log""".split())


def _languages(api):
    """{language: (names of the calls that are generated, of those by hand)}"""
    free = {f.name for f in api.calls if not f.on_system}  # in Fortran those of the module jam serve
    return {
        "Python": ({c.f.name for c in emit_methods.calls(api)}, OWN | emit_methods.SKIP),
        "Julia": ({f.name for f in emit_julia_calls.calls(api)}, OWN | emit_julia_calls.BY_HAND),
        "Fortran": ({f.name for f, _ in emit_fortran_packing.calls(api)} | free, OWN | emit_fortran_packing.BY_HAND),
        "JavaScript": ({f.name for f in emit_js.calls(api)}, OWN),
        "Octave": ({f.name for f, _ in emit_octave.calls(api)}, emit_octave.BY_HAND),
    }


def check(api):
    known = {f.name for f in api.functions} - set(api.inits.values())
    for language, (made, by_hand) in _languages(api).items():
        for wrong, why in ((known - made - by_hand, "no rule makes it, and no list says that it is written by hand"),
                           (made & by_hand, "it is generated, and listed as written by hand"),
                           (by_hand - known, "it is listed as written by hand, and the header does not have it")):
            if wrong:
                raise HeaderError(f"{language}, {', '.join(sorted(wrong))}: {why}")
