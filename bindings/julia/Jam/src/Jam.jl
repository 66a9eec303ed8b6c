"""
    Jam

Jammed packings of hard spheres, made and analysed by libjam.

    using Jam
    s = System(n = 1024, dim = 3, seed = 1)
    compress!(s)
    report = crunch!(s)
    forces(s)

Arrays are d-by-n matrices: the bytes of C's (n, d). Indices are 1-based here, 0-based in `Jam.raw`-level calls (jam_*).
The library is found as libjam.so.0, or by the environment variable JAM_LIBRARY when the package is precompiled.
"""
module Jam

const libjam = get(ENV, "JAM_LIBRARY", "libjam.so.0")

include("raw.jl")

export System, JamError, run!, compress!, crunch!, cancel, info, report, positions, diameters, velocities,
       set_positions!, set_velocities!, scale_diameters!, contacts, contact_vectors, contact_gaps, forces,
       coordination, judge, sizes, size_report, hessian_rows, modes, call_array, checkpoint, from_checkpoint

"A call failed; the system is as it was before. `status` is the code, `text` the library's."
struct JamError <: Exception
    status::Int32
    text::String
end
Base.showerror(io::IO, e::JamError) = print(io, "JamError ", e.status, ": ", e.text)

"Throws for a status below zero, else returns it (> 0: stopped early, the state is valid)."
function check(status::Integer)
    status >= 0 && return Int32(status)
    text = unsafe_string(jam_last_error())
    isempty(text) && (text = unsafe_string(jam_status_string(status)))
    throw(JamError(status, text))
end

"The same for a call that returns what it found: one that was cancelled has written nothing, and throws."
function written(status::Integer)
    status == JAM_CANCELLED && throw(JamError(status, unsafe_string(jam_last_error())))
    return check(status)
end

"n numbers for a call to fill: NaN, or -1, where it writes nothing."
unknown(::Type{T}, n...) where {T} = fill(T <: AbstractFloat ? T(NaN) : T(-1), n...)

"N spheres in a periodic cube; owns the C handle, which a finalizer frees."
mutable struct System
    handle::Ptr{Cvoid}
    status::Int32                 # of the last call
    why::String                   # a sentence, where the status is not 0
    callback::Any                 # of the running call
    thrown::Any                   # by the callback
    function System(handle::Ptr{Cvoid})
        s = new(handle, JAM_OK, "", nothing, nothing)
        finalizer(close, s)
        return s
    end
end

"Frees the system; any other use is then an error. Views of it must not be used any more."
function Base.close(s::System)
    s.handle == C_NULL && return nothing
    jam_destroy(s.handle)
    s.handle = C_NULL
    return nothing
end

function handle(s::System)
    s.handle == C_NULL && throw(ArgumentError("the system is closed"))
    return s.handle
end

"An option struct of the library's defaults, changed by the keywords."
function options(::Type{T}, init, given) where {T}
    o = T()
    check(init(o, sizeof(T)))
    for (name, value) in pairs(given)
        hasfield(T, name) || throw(ArgumentError("unknown option $name; there are $(join(fieldnames(T)[2:end], ", "))"))
        field = fieldtype(T, name)
        try
            setfield!(o, name, convert(field, value))
        catch
            wanted = field <: Integer ? "a whole number from $(typemin(field)) to $(typemax(field))" : "a number"
            throw(ArgumentError("$name must be $wanted, not $value"))
        end
    end
    return o
end

# Options of another way to make a system, which would be without effect.
function refuse(given, names, why)
    for name in names
        haskey(given, name) && throw(ArgumentError("$name = $(given[name]) would be without effect: $why"))
    end
end

# Mistakes that look like valid input: a transposed matrix, a last row of sizes, positions of another box.
function check_positions(x, diameters, given)
    d, n = size(x)
    sizes = diameters isa Number ? fill(diameters, n) : vec(collect(diameters))
    if (d > JAM_MAX_DIM && 2 <= n <= JAM_MAX_DIM) || (length(sizes) != n && length(sizes) == d)
        throw(ArgumentError("positions must be a d-by-n matrix, not $d-by-$n: transposed? Pass permutedims(positions)"))
    end
    for (name, value) in ((:dim, d), (:n, n))
        get(given, name, value) == value || throw(ArgumentError("$name is $(given[name]), and positions are $d-by-$n"))
    end
    if d > 2 && n > 1 && !haskey(given, :dim) && any(f -> x[d, :] == f .* sizes, (0.5, 1.0, 2.0))
        throw(ArgumentError("the last row of positions holds the sizes of the spheres: pass positions[1:$(d - 1), :]. " *
                            "If it is a coordinate, pass dim = $d"))
    end
    haskey(given, :box) && return nothing
    for value in x  # wrapped positions reach out of [0, 1] by rounding only
        isfinite(value) && !(-1e-6 <= value <= 1 + 1e-6) &&
            throw(ArgumentError("a position is $value, outside of the default box of side 1: pass box; box = 1 wraps"))
    end
end

function create(given, x, sizes)
    o = options(jam_create_options, jam_create_options_init, given)
    out = Ref{Ptr{Cvoid}}(C_NULL)
    start = jam_start()
    GC.@preserve x sizes begin
        if x !== nothing
            start.positions, start.positions_len = pointer(x), length(x)
        end
        if sizes !== nothing
            start.diameters, start.diameters_len = pointer(sizes), length(sizes)
        end
        check(jam_create(o, start, out))
    end
    return System(out[])
end

dense(x) = convert(Array{Cdouble}, collect(x))

"""
    System(; n, dim, seed, packing_fraction, diameters, box, model, mk_zeta)

Random sequential start; of `diameters` only the ratios count.
"""
System(; diameters = nothing, given...) = create(given, nothing, diameters === nothing ? nothing : dense(diameters))

"""
    System(positions, diameters; box, overlap, seed, model, mk_zeta)

From a d-by-n matrix of positions and n diameters (or one). Positions are wrapped into `box`; without it they must lie
in [0, 1]. A last row that equals the sizes is refused unless `dim` confirms that it is a coordinate.
"""
function System(x::AbstractMatrix, diameters; given...)
    refuse(given, (:packing_fraction,), "the diameters are given")
    check_positions(x, diameters, given)
    return create((; n = size(x, 2), dim = size(x, 1), given...), dense(x), diameters isa Number ? [Cdouble(diameters)] : dense(diameters))
end

"""
    System(path; box, frame, overlap, shrink_min, seed)

From a file of any format that `jam_read` knows; `notes` has what was changed or assumed.
"""
function System(path::AbstractString; given...)
    refuse(given, (:packing_fraction,), "the file holds it")
    o = options(jam_create_options, jam_create_options_init, given)
    out = Ref{Ptr{Cvoid}}(C_NULL)
    check(jam_read(path, o, nothing, nothing, out))
    return System(out[])
end

"""
    sizes(law; n, curve, packing_fraction, porosity, cell_volume, dim, seed, draw, mean, deviation, ...)

Diameters of a law given by text: its name and what it takes, as in `"lognormal:deviation=0.3"` or `"sieve:grading.csv"`.
Keywords of `jam_diameters_options` may give fields instead, and `curve` the rows of a list or a sieve curve, a 2-by-rows
matrix. Without `n` it follows from `cell_volume` and `packing_fraction`, or `porosity`, the void fraction.
"""
function sizes(law::AbstractString; curve = nothing, porosity = nothing, given...)
    parsed, needed = options(jam_diameters_options, jam_diameters_options_init, (;)), Ref{Csize_t}(0)
    check(jam_parse_diameters(law, parsed, nothing, 0, needed))
    rows = Vector{Cdouble}(undef, needed[])
    isempty(rows) || check(jam_parse_diameters(law, parsed, rows, length(rows), needed))
    if curve !== nothing
        isempty(rows) || throw(ArgumentError("the law's text and curve both give rows"))
        size(curve, 1) == 2 || throw(ArgumentError("curve must be a 2-by-rows matrix, not $(size(curve))"))
        rows = vec(dense(curve))
    end
    if porosity !== nothing
        haskey(given, :packing_fraction) && throw(ArgumentError("give packing_fraction or porosity"))
        0 < porosity < 1 || throw(ArgumentError("porosity is $porosity, it must be above 0 and below 1"))
        given = (; given..., packing_fraction = 1 - porosity)
    end
    named = options(jam_diameters_options, jam_diameters_options_init, given)
    for name in keys(given)
        setfield!(parsed, name, getfield(named, name))
    end
    x = isempty(rows) ? nothing : rows
    check(jam_diameters(parsed, x, length(rows), nothing, 0, needed))
    out = Vector{Cdouble}(undef, needed[])
    check(jam_diameters(parsed, x, length(rows), out, length(out), needed))
    return out
end

"What diameters are: a jam_size_report with moments, d10, d50, d90 by volume, and the densities in reach."
function size_report(diameters; dim = 3)
    made, x = jam_size_report(), vec(dense(diameters))
    check(jam_get_size_report(dim, x, length(x), made))
    return made
end

"What was changed or assumed when the system was made, a sentence a line."
notes(s::System) = unsafe_string(jam_notes(handle(s)))

"Makes a system from a file of `checkpoint(s, path)`: dynamics go on to the same bits."
function from_checkpoint(path::AbstractString)
    out = Ref{Ptr{Cvoid}}(C_NULL)
    check(jam_read_checkpoint(path, nothing, nothing, out))
    return System(out[])
end

"Writes all that the dynamics depend on."
checkpoint(s::System, path::AbstractString) = (check(jam_write_checkpoint(handle(s), path)); nothing)

function Base.copy(s::System)
    out = Ref{Ptr{Cvoid}}(C_NULL)
    check(jam_copy(handle(s), out))
    return System(out[])
end

"Writes the packing, 17 digits; format: one of JAM_FORMAT_AUTO, JAM_FORMAT_PLAIN, JAM_FORMAT_XYZ."
Base.write(path::AbstractString, s::System; format = JAM_FORMAT_AUTO) = (check(jam_write(handle(s), path, format)); nothing)

function info(s::System)
    made = jam_info()
    check(jam_get_info(handle(s), made))
    return made
end

function Base.show(io::IO, s::System)
    s.handle == C_NULL && return print(io, "System(closed)")
    i = info(s)
    print(io, "System(n = ", i.n, ", dim = ", i.dim, ", packing_fraction = ", i.packing_fraction, ", box = ", i.box, ")")
end

function view_of(s::System, f)
    p, count = Ref{Ptr{Cdouble}}(C_NULL), Ref{Csize_t}(0)
    check(f(handle(s), p, count))
    return unsafe_wrap(Array, p[], Int(count[]))
end

"d-by-n copy of the positions in [0, box)."
positions(s::System) = reshape(copy(view_of(s, jam_view_positions)), Int(info(s).dim), :)
"d-by-n copy of the velocities, kT/m = 1."
velocities(s::System) = reshape(copy(view_of(s, jam_view_velocities)), Int(info(s).dim), :)
"Copy of the n diameters."
diameters(s::System) = copy(view_of(s, jam_view_diameters))

function check_shape(s::System, x, name)
    wanted = (Int(info(s).dim), Int(info(s).n))
    size(x) == wanted || throw(ArgumentError("$name must be a matrix of $wanted, not $(size(x))"))
    return dense(x)
end

function set_positions!(s::System, x::AbstractMatrix)
    y = check_shape(s, x, "positions")
    check(jam_set_positions(handle(s), y, length(y)))
    return s
end
function set_velocities!(s::System, v::AbstractMatrix)
    y = check_shape(s, v, "velocities")
    check(jam_set_velocities(handle(s), y, length(y)))
    return s
end
scale_diameters!(s::System, factor) = (check(jam_scale_diameters(handle(s), factor)); s)

# Called by C on the calling task's thread. Nothing may be thrown across C: it is kept and thrown again behind it.
function progress_c(p::Ptr{jam_progress}, user::Ptr{Cvoid})::Int32
    s = unsafe_pointer_to_objref(user)::System
    s.thrown === nothing || return Int32(1)
    try
        return Int32(s.callback(copy_struct(p)) === true)
    catch e
        s.thrown = (e, catch_backtrace())
        return Int32(1)
    end
end

function copy_struct(p::Ptr{T}) where {T}
    made = T()
    GC.@preserve made unsafe_copyto!(Ptr{UInt8}(pointer_from_objref(made)), Ptr{UInt8}(p), sizeof(T))
    return made
end

# Keeps the status of a call that has just returned, and why it is not 0.
function note!(s::System, status::Integer)
    s.status = check(status)
    s.why = status > 0 ? unsafe_string(jam_last_error()) : ""
    return s.status
end

# What progress = true shows: one line on stderr that is rewritten, with the part that is done and the time left.
function progress_line(p)
    isnan(p.fraction) && return false
    number(x) = string(round(x; sigdigits = 2))
    text = string(floor(Int, 100 * p.fraction), " %")
    if !isnan(p.seconds_left)
        low, high = p.seconds_left / p.seconds_left_spread, p.seconds_left * p.seconds_left_spread
        text = string(text, ", ", number(p.seconds_left), " s left (", number(low), " to ", number(high), ")")
    end
    print(stderr, "\r", rpad(text, 60))
    return false
end

# Runs f(handle) with the callback set; progress(p) returns true to stop. true: progress_line.
function verb(f, s::System, progress)
    h = handle(s)
    progress === true && (progress = progress_line)
    if progress === nothing
        note!(s, GC.@preserve s f(h))
        return nothing
    end
    s.callback, s.thrown = progress, nothing
    trampoline = @cfunction(progress_c, Int32, (Ptr{jam_progress}, Ptr{Cvoid}))
    GC.@preserve s begin
        check(jam_set_progress(h, trampoline, pointer_from_objref(s)))
        status = f(h)
        jam_set_progress(h, nothing, nothing)
    end
    s.callback = nothing
    if s.thrown !== nothing
        e, s.thrown = s.thrown, nothing
        throw(e[1])
    end
    note!(s, status)
    return nothing
end

"""
    run!(s; collisions_per_particle, wall_time, progress)

Event-driven NVE dynamics; returns a jam_md_report. `s.status > 0` says that it stopped early.
"""
function run!(s::System; progress = nothing, given...)
    o, made = options(jam_run_options, jam_run_options_init, given), jam_md_report()
    verb(h -> jam_run(h, o, made), s, progress)
    return made
end

"""
    compress!(s; growth_rate, pressure, packing_fraction, porosity, collisions_per_particle, wall_time, progress)

Lubachevsky-Stillinger growth; without options the two-stage protocol. With packing_fraction, or porosity = 1 minus it, it
ends at exactly this density. Returns a jam_md_report.
"""
function compress!(s::System; progress = nothing, porosity = nothing, given...)
    if porosity !== nothing
        haskey(given, :packing_fraction) && throw(ArgumentError("give packing_fraction or porosity"))
        given = (; given..., packing_fraction = 1 - porosity)
    end
    o = isempty(given) ? nothing : options(jam_compress_options, jam_compress_options_init, given)
    made = jam_md_report()
    verb(h -> jam_compress(h, o, made), s, progress)
    return made
end

"""
    crunch!(s; max_lps, gain_tolerance, ..., progress)

Iterated linear programming down to the jamming point; returns the jam_crunch_report with the certificate.
"""
function crunch!(s::System; progress = nothing, given...)
    o, made = options(jam_crunch_options, jam_crunch_options_init, given), jam_crunch_report()
    verb(h -> jam_crunch(h, o, made), s, progress)
    return made
end

"Stops the call that runs on s in another thread; without one, the next call."
cancel(s::System) = (check(jam_cancel(handle(s))); nothing)

function Base.show(io::IO, r::jam_crunch_report)
    print(io, "jam_crunch_report(", r.jammed == 1 ? "jammed" : "not jammed", ", ", unsafe_string(jam_stop_string(r.stop_reason)),
          ", phi ", r.packing_fraction_start, " -> ", r.packing_fraction, ", moved by up to ", r.displacement_max,
          " diameters (rms ", r.displacement_rms, "), ", r.contacts_kept, " of ", r.contacts_start, " contacts kept, ", r.contacts,
          " contacts, excess ", r.excess_contacts, ", ", r.rattlers, " rattlers)")
end

"Report of the last crunch."
function report(s::System)
    made = jam_crunch_report()
    check(jam_get_crunch_report(handle(s), made))
    return made
end

"""
    call_array(T, f, s, args...)

Any C function that fills one array: asks for the size, then fills. `call_array(Cdouble, Jam.jam_forces, s)`.
"""
function call_array(::Type{T}, f, s::System, args...) where {T}
    needed = Ref{Csize_t}(0)
    written(f(handle(s), args..., nothing, 0, needed))
    out = unknown(T, Int(needed[]))
    note!(s, written(f(handle(s), args..., out, length(out), needed)))
    return out
end

"""
    judge(s; crunch, prove, wall_time, progress) -> (report, text)

Judges the packing as it is and moves nothing: a jam_check_report, and its paragraph. `s.status` is JAM_OK when jammed,
JAM_NOT_JAMMED, or JAM_AMBIGUOUS when undecided.
"""
function judge(s::System; progress = nothing, given...)
    o, made = options(jam_check_options, jam_check_options_init, given), jam_check_report()
    verb(h -> jam_check_packing(h, o, made), s, progress)
    written(s.status)
    return made, unsafe_string(jam_check_text(made))
end

"2-by-contacts matrix of sphere indices, from 1."
contacts(s::System) = reshape(call_array(Int32, jam_contacts, s), 2, :) .+ Int32(1)
"d-by-contacts matrix of unit vectors, from the second to the first sphere."
contact_vectors(s::System) = reshape(call_array(Cdouble, jam_contact_vectors, s), Int(info(s).dim), :)
contact_gaps(s::System) = call_array(Cdouble, jam_contact_gaps, s)
"Contact forces, mean 1."
forces(s::System) = call_array(Cdouble, jam_forces, s)
"Contacts of each sphere, 0 for rattlers."
coordination(s::System) = call_array(Int32, jam_coordination, s)

"""
    hessian_rows(s; stiffness, alpha, prestress) -> (row_start, column, value)

Compressed rows, 1-based; symmetric, so `SparseMatrixCSC(m, m, row_start, column, value)` is the Hessian.
"""
function hessian_rows(s::System; given...)
    o = options(jam_hessian_options, jam_hessian_options_init, given)
    needed = Ref{Csize_t}(0)
    written(jam_hessian(handle(s), o, nothing, 0, nothing, 0, nothing, 0, needed))
    rows = Int(info(s).dim) * length(call_array(Int32, jam_hessian_map, s)) + 1
    start, column, value = unknown(Int32, rows), unknown(Int32, needed[]), unknown(Cdouble, needed[])
    written(jam_hessian(handle(s), o, start, length(start), column, length(column), value, length(value), needed))
    return start .+ Int32(1), column .+ Int32(1), value
end

"""
    modes(s, k; which, frequency, progress) -> (values, vectors)

The k modes asked for: omega^2 ascending, and a (d N')-by-k matrix.
"""
function modes(s::System, k::Integer; progress = nothing, given...)
    h = options(jam_hessian_options, jam_hessian_options_init, (;))
    o = options(jam_modes_options, jam_modes_options_init, (; count = k, given...))
    m = Int(info(s).dim) * length(call_array(Int32, jam_hessian_map, s))
    count = o.which == JAM_MODES_ALL ? m : min(k, m)
    values, vectors, needed = unknown(Cdouble, count), unknown(Cdouble, m, count), Ref{Csize_t}(0)
    verb(c -> jam_modes(c, h, o, values, length(values), vectors, length(vectors), nothing, 0, needed), s, progress)
    written(s.status)
    return values[1:needed[]], vectors[:, 1:needed[]]
end

end # module
