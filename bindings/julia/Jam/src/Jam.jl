"""
    Jam

Jammed packings of hard spheres, made and analysed by libjam.

    using Jam
    s = System(n = 1024, dim = 3, seed = 1)
    compress!(s; progress = true)
    report = crunch!(s)
    forces(s)

Arrays are d-by-n matrices, a column for each sphere: the bytes of C's (n, d). Indices count from 1, except in the functions of
C, `Jam.jam_...`, which are all there too. Options are keywords under their C names, enums are given as words:
`crunch!(s; method = :sequential_lp)`. `using Jam` loads libjam.so.1, or the file that the environment variable JAM_LIBRARY
names in that session.
"""
module Jam

using Libdl, Logging, Printf, SparseArrays

# Opened when the package is loaded, not when it is precompiled: a later session may name another library.
const library = Ref{Ptr{Cvoid}}(C_NULL)
symbol(name) = dlsym(library[], name)

function __init__()
    named = get(ENV, "JAM_LIBRARY", "")
    library[] = dlopen(isempty(named) ? "libjam.so.1" : named)
end

# one a concept; each takes from those above it
include("raw.jl")           # C's functions and structs, generated
include("calls.jl")         # the conventions of the header
include("tables.jl")        # words and calls, generated
include("errors.jl")
include("reports.jl")
include("options.jl")
include("progress.jl")
include("start.jl")
include("system.jl")
include("methods.jl")       # a method for each call on a system, generated
include("cell.jl")
include("dynamics.jl")
include("crunch.jl")
include("calippso.jl")
include("network.jl")
include("soft.jl")
include("sizes.jl")
include("near_jamming.jl")
include("files.jl")
include("picture.jl")
include("plotted.jl")

export System, JamError, Report, Table, columns, info, packing_fraction, notes, positions, velocities, diameters, radii,
       set_positions!, set_velocities!, scale_diameters!, cell, set_cell!, strain!, run!, compress!, crunch!, calippso!, cancel,
       observing, report, history, judge, contacts, forces, coordination, rattlers, bucklers, contact_table, sphere_table, hessian,
       modes, prove, write_proof, floppy_modes, floppy_mode, tile, bloch_modes, bloch_rigidity, pair_correlation, relax!, shear!, shear_history, decompress!, soft_history, sizes, size_report,
       isoconf, predictors, spearman, correlations, write_contacts, page, checkpoint, from_checkpoint, picture

end # module
