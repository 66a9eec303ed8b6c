# What the arguments of System mean. Mistakes that look like valid input are refused by name.

"One diameter or n of them, from diameters or radii."
function sizes_of(diameters, radii, n)
    (diameters === nothing) == (radii === nothing) && throw(ArgumentError("give either diameters or radii"))
    name, value = radii === nothing ? ("diameters", diameters) : ("radii", radii)
    x = value isa Number ? [Cdouble(value)] : vec(dense(value))
    length(x) in (1, n) || throw(ArgumentError("$name must be one number or $n of them, not $(length(x))"))
    return radii === nothing ? x : 2 .* x
end

"Positions as a d-by-n matrix, from a matrix or a vector of points."
function positions_of(x::AbstractVector)
    isempty(x) && throw(ArgumentError("positions have no sphere"))
    first(x) isa Number && throw(ArgumentError("positions must be a d-by-n matrix or a vector of points, not a vector of numbers"))
    all(p -> length(p) == length(first(x)), x) || throw(ArgumentError("the points have different numbers of coordinates"))
    return Cdouble[p[k] for k in 1:length(first(x)), p in x]
end
positions_of(x::AbstractMatrix) = dense(x)

# Wrapped positions reach out of [0, 1] by this much where they were computed in single precision.
const ROUNDING = 1e-6

"Refuses a transposed matrix, a last row of sizes, and positions of another box than the default."
function check_positions(x, count, sizes, given)
    d, n = size(x)
    if (d > JAM_MAX_DIM && 2 <= n <= JAM_MAX_DIM) || (count != 1 && count != n && count == d)
        throw(ArgumentError("positions must be a d-by-n matrix, not $d-by-$n: transposed? Pass permutedims(positions)"))
    end
    2 <= d <= JAM_MAX_DIM ||
        throw(ArgumentError("positions are $d-by-$n, a column for each sphere: the dimension $d is not in 2 to $JAM_MAX_DIM"))
    for (name, value) in ((:dim, d), (:n, n))
        get(given, name, value) == value || throw(ArgumentError("$name is $(given[name]), and positions are $d-by-$n"))
    end
    if d > 2 && n > 1 && count in (1, n) && !haskey(given, :dim) && any(f -> all(x[d, :] .== f .* sizes), (0.5, 1.0, 2.0))
        throw(ArgumentError("the last row of positions contains the sizes of the spheres: pass positions[1:$(d - 1), :]. " *
                            "If it is a coordinate, pass dim = $d"))
    end
    (haskey(given, :box) || haskey(given, :cell)) && return nothing
    k = findfirst(v -> isfinite(v) && !(-ROUNDING <= v <= 1 + ROUNDING), x)
    k === nothing || throw(ArgumentError("positions[$(k[1]), $(k[2])] is $(x[k]), outside of the default box of side 1: pass box " *
                                         "or cell; box = 1 wraps the positions into that box"))
    return nothing
end

"(side of a cube or nothing, cell vectors or nothing) from box, one side or d of them, and cell, vectors in columns or d sides."
function cell_of(box, cell, dim)
    box === nothing && cell === nothing && return nothing, nothing
    box === nothing || cell === nothing || throw(ArgumentError("box and cell both name the periodic cell: give one of them"))
    box isa Number && return box, nothing
    x, name = box === nothing ? (cell, "cell") : (box, "box")
    x isa AbstractVector && length(x) == dim && return nothing, Cdouble[i == j ? x[i] : 0 for i in 1:dim, j in 1:dim]
    x isa AbstractMatrix && size(x) == (dim, dim) && name == "cell" && return nothing, dense(x)
    wanted = name == "box" ? "one side or $dim sides" : "$dim vectors, the columns of a $dim-by-$dim matrix, or $dim sides"
    hint = x isa AbstractMatrix && name == "box" ? ": give vectors by cell" : x isa Number ? ": for a cube give box" : ""
    throw(ArgumentError("$name must be $wanted, not $(x isa Number ? "one number" : "an array of size $(size(x))")$hint"))
end

"Axes with flat walls as C's number, from letters such as \"xz\" or a truth value an axis."
function walls_of(walls, dim)
    walls === nothing && return 0
    letters = "xyz"[1:min(dim, 3)]
    if walls isa AbstractString
        all(c -> count(==(c), walls) == 1 && c in letters, walls) ||
            throw(ArgumentError("walls must name axes of $(repr(letters)) once each, not $(repr(walls))"))
        return sum(Int[1 << (findfirst(==(c), letters) - 1) for c in walls])
    end
    length(walls) == dim && all(w -> w isa Bool, walls) ||
        throw(ArgumentError("walls must be letters such as \"x\" or $dim truth values, not $(repr(walls))"))
    return sum(Int[1 << (c - 1) for (c, wall) in enumerate(walls) if wall])
end

"Makes the C system; positions, sizes and cell may be nothing."
function create(given, x, sizes; progress = nothing)
    box, vectors = cell_of(get(given, :box, nothing), get(given, :cell, nothing), get(given, :dim, 3))
    own = (:box, :cell, :walls)
    o = options(jam_create_options, (; (k => v for (k, v) in pairs(given) if !(k in own))..., box = box,
                                     walls = walls_of(get(given, :walls, nothing), get(given, :dim, 3))))
    out, start = Ref{Ptr{Cvoid}}(C_NULL), jam_start()
    watch, done = watcher(progress)
    w = Watcher(watch, nothing)
    GC.@preserve x sizes vectors w begin
        x === nothing || ((start.positions, start.positions_len) = (pointer(x), length(x)))
        sizes === nothing || ((start.diameters, start.diameters_len) = (pointer(sizes), length(sizes)))
        vectors === nothing || ((start.cell, start.cell_len) = (pointer(vectors), length(vectors)))
        if watch !== nothing
            start.progress = @cfunction(progress_c, Int32, (Ptr{jam_progress}, Ptr{Cvoid}))
            start.user = pointer_from_objref(w)
        end
        status = jam_create(o, start, out)
        done()
        w.thrown === nothing || throw(w.thrown)
        written(status)
    end
    return System(out[])
end
