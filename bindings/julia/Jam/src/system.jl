# The system of spheres: how one is made, copied and freed; its state.

"""
    System

N spheres in a periodic cube, or in any periodic cell.

`compress!` and `crunch!` move the spheres; `report`, `contacts`, `forces`, `gaps`, `hessian` and `modes` describe the jammed
network. Arrays are d-by-n matrices, a column for each sphere. Lengths are in the unit of `box`, sizes are diameters, kT/m = 1.
After a call `s.status` is `:ok`, or says that it stopped early or found no certain answer, and `s.why` gives the reason.
Only one call at a time may run on a system.

    System(; n, dim, seed, packing_fraction, porosity, diameters, radii, box, cell, model, mk_zeta, masses, non_additivity,
           wall_time, memory_limit, progress)

Random sequential start; of `diameters` only the ratios count. With `overlap = :allow` spheres are independent points.

    System(positions, diameters; box, cell, dim, overlap, seed, model, mk_zeta, masses, non_additivity)
    System(positions; radii, ...)

From a d-by-n matrix, or a vector of points, and n diameters or one. Positions are wrapped into the cube of side `box`, or the
cell whose vectors are the columns of `cell`; d sides make a brick. Without both, positions must lie in [0, 1]. A last row that
equals the sizes is refused unless `dim` confirms that it is a coordinate. `overlap`: `:refuse`, `:shrink` or `:allow`.

Both ways take `walls`, axes with flat walls as letters (`"z"`) or truth values, and `container`: `:cylinder` (d = 3, about z) or
`:ball`, whose diameter is the edge of the cell. Nothing repeats across a wall.

    System(path; box, walls, container, frame, overlap, shrink_min, seed, model, mk_zeta)

From a file: plain text, extended XYZ, LAMMPS data and dumps, tables, each also compressed. `notes` has what was changed or
assumed. `walls` and `container` name the walls where the file does not.

```jldoctest
julia> System(n = 100, dim = 2, seed = 7)
System(n = 100, dim = 2, packing_fraction = 0.2, box = 1, seed = 7)

julia> diameters(System([1.0 3.0; 1.0 3.0]; radii = 0.5, box = 4))
2-element Vector{Float64}:
 1.0
 1.0
```
"""
mutable struct System
    handle::Ptr{Cvoid}  # of C; the finalizer frees it
    status::Symbol      # of the last call, also of one that threw
    why::String         # a sentence, where the status is not :ok
    function System(handle::Ptr{Cvoid})
        s = new(handle, :ok, "")
        finalizer(close, s)
        return s
    end
end

function System(; diameters = nothing, radii = nothing, porosity = nothing, progress = nothing, given...)
    diameters === nothing || radii === nothing || throw(ArgumentError("give either diameters or radii"))
    sizes = diameters === nothing ? radii : diameters  # of a random start only ratios count
    sizes isa AbstractMatrix && throw(ArgumentError("diameters must be a vector, not a $(join(size(sizes), "x")) matrix"))
    sizes = sizes === nothing ? nothing : vec(dense(sizes))
    count = sizes === nothing ? 1024 : length(sizes)
    return create((; n = count, with_density((; given...), porosity)...), nothing, sizes; progress = progress)
end

function System(positions::Union{AbstractMatrix, AbstractVector}, diameters = nothing; radii = nothing, progress = nothing, given...)
    refuse(given, (:packing_fraction, :porosity), "the diameters are given")
    x = positions_of(positions)
    sizes, count = radii === nothing ? diameters : radii, length(something(diameters, radii, 0.0))
    sizes === nothing && throw(ArgumentError("give either diameters or radii" *
        (size(x, 1) > 2 ? ". If the last row contains radii, pass positions[1:$(size(x, 1) - 1), :]; radii = positions[end, :]" : "")))
    check_positions(x, count, sizes isa Number ? sizes : vec(collect(sizes)), given)
    return create((; n = size(x, 2), dim = size(x, 1), given...), x, sizes_of(diameters, radii, size(x, 2)); progress = progress)
end

function System(path::AbstractString; given...)
    refuse(given, (:packing_fraction, :porosity), "the file gives it")
    refuse(given, (:diameters, :radii), "files give sizes")
    walls, out = get(given, :walls, nothing), Ref{Ptr{Cvoid}}(C_NULL)
    words = String[]
    for name in (:cell, :origin, :columns)
        value = get(given, name, nothing)
        value === nothing || push!(words, "$name=" * (value isa AbstractString ? value : join(value, ",")))
    end
    given = Base.structdiff(values(given), NamedTuple{(:cell, :origin, :columns)})
    own = (; given..., walls = walls_of(walls, walls isa AbstractString || walls === nothing ? 3 : length(walls)))
    written(jam_read_as(path, join(words, " "), options(jam_create_options, own), nothing, nothing, out))
    made = System(out[])
    walls === nothing || walls isa AbstractString || length(walls) == info(made).dim ||
        throw(ArgumentError("walls must have $(info(made).dim) truth values for this file, not $(length(walls))"))
    return made
end

"Frees the system; any other use is then an error."
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

# Keeps the status of a call that has just returned, and why it is not :ok.
function note!(s::System, status::Integer)
    s.status, s.why = word(:status_code, check(status)), status > 0 ? last_text() : ""
    return s.status
end

"f(), a call on s: where it throws, its status and its text are those of s."
function failing(f, s)
    s isa System || return f()
    jam_set_error("")
    try
        return f()
    catch e
        text = last_text()
        if e isa JamError
            s.status, s.why = e.status, e.text
        elseif isempty(text)  # the library was not called
            s.status, s.why = :argument, e isa ArgumentError ? e.msg : sprint(showerror, e)
        else  # a function that watches has thrown, which stopped the call
            s.status, s.why = :cancelled, text
        end
        rethrow()
    end
end

"Options of a call on s, whose status a wrong one becomes."
options(s::System, T, given) = failing(() -> options(T, given), s)

"Deep copy with results. It has the same seed: set velocities to make its dynamics differ."
function Base.copy(s::System)
    out = Ref{Ptr{Cvoid}}(C_NULL)
    check(jam_copy(handle(s), out))
    return System(out[])
end

"""
    tile(s, count)

An exact supercell: `count[c]` copies side by side along each cell vector, with velocities, contacts and forces. A packing that is
jammed in one cell may not be jammed here: `rigidity` tests it. Sphere i of copy (k1, k2, ...), counted from 0, is number
`i + n * (k1 + count[1] * (k2 + count[2] * ...))`.

```jldoctest
julia> s = System(n = 16, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 8)); crunch!(s);

julia> t = tile(s, (3, 2)); length(forces(t)) == 6 * length(forces(s))
true
```
"""
function tile(s::System, count)
    out, copies = Ref{Ptr{Cvoid}}(C_NULL), collect(Int32, count)
    check(jam_tile(handle(s), copies, length(copies), out))
    return System(out[])
end

"""
    info(s)

What the system is now: n, dim, box, packing_fraction, pressure, ...
"""
function info(s::System)
    made = jam_info()
    check(jam_get_info(handle(s), made))
    return Report(made)
end

"Packing fraction: the sum of the volumes of the spheres over that of the cell."
packing_fraction(s::System) = info(s).packing_fraction

"What was changed or assumed when the system was made, a sentence a line."
notes(s::System) = unsafe_string(jam_notes(handle(s)))

function Base.show(io::IO, s::System)
    s.handle == C_NULL && return print(io, "System(closed)")
    i = info(s)
    print(io, "System(n = ", i.n, ", dim = ", i.dim, ", packing_fraction = ", @sprintf("%.8g", i.packing_fraction), ", box = ",
          @sprintf("%g", i.box), ", seed = ", i.seed, ")")
end

# ---- state

function view_of(s::System, array)
    p, count = Ref{Ptr{Cdouble}}(C_NULL), Ref{Csize_t}(0)
    check(jam_view(handle(s), array, p, count))
    return GC.@preserve s copy(unsafe_wrap(Array, p[], Int(count[])))
end

"d-by-n copy of the positions, in [0, box) of a cube, in other cells in the brick of the cell's diagonal."
positions(s::System) = reshape(view_of(s, JAM_VIEW_POSITIONS), Int(info(s).dim), :)
"d-by-n copy of the velocities, kT/m = 1; zero until a first run draws them."
velocities(s::System) = reshape(view_of(s, JAM_VIEW_VELOCITIES), Int(info(s).dim), :)
"Copy of the n diameters."
diameters(s::System) = view_of(s, JAM_VIEW_DIAMETERS)
"Copy of the n radii."
radii(s::System) = diameters(s) ./ 2

function check_shape(s::System, x, name)
    wanted = (Int(info(s).dim), Int(info(s).n))
    size(x) == wanted && return dense(x)
    turned = size(x) == reverse(wanted) ? ": transposed? Pass permutedims($name)" : ""
    throw(ArgumentError("$name must be a $(wanted[1])-by-$(wanted[2]) matrix, not $(join(size(x), "-by-"))$turned"))
end

"""
    set_positions!(s, x)

Replaces the positions, wrapped into the cell; results of a crunch are dropped.
"""
function set_positions!(s::System, x::AbstractMatrix)
    y = check_shape(s, x, "positions")
    written(jam_set_positions(handle(s), y, length(y)))
    return s
end

"""
    set_velocities!(s, v)

Replaces the velocities; results of a crunch are kept.
"""
function set_velocities!(s::System, v::AbstractMatrix)
    y = check_shape(s, v, "velocities")
    written(jam_set_velocities(handle(s), y, length(y)))
    return s
end

"""
    scale_diameters!(s, factor)

Multiplies all diameters by `factor`; results of a crunch are dropped.
"""
scale_diameters!(s::System, factor) = (written(jam_scale_diameters(handle(s), factor)); s)
