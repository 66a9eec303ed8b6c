# The jammed network: contacts, forces, stiffness, modes.

"Which spheres are rattlers: no contact with a force touches them."
rattlers(s::System) = coordination(s) .== 0
"Which spheres are bucklers, with exactly d + 1 contacts."
bucklers(s::System) = coordination(s) .== info(s).dim + 1

"""
    contact_table(s)

The contacts as a table: i, j, force, gap, and the unit vector from j to i (x, y, ...).

```jldoctest
julia> s = System(n = 64, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 32)); crunch!(s);

julia> t = contact_table(s); length(t) == report(s).contacts
true

julia> propertynames(t)
(:i, :j, :force, :gap, :x, :y)
```
"""
function contact_table(s::System)
    pairs, v = contacts(s), contact_vectors(s)
    return Table(merge((i = pairs[1, :], j = pairs[2, :], force = forces(s), gap = contact_gaps(s)), axes_of(v)))
end

"""
    sphere_table(s)

The spheres as a table: position (x, y, ...), diameter and, after a crunch, contacts.
"""
function sphere_table(s::System)
    t = merge(axes_of(positions(s)), (diameter = diameters(s),))
    known = try
        (contacts = coordination(s),)
    catch e
        e isa JamError && e.status === :state || rethrow()
        (;)
    end
    return Table(merge(t, known))
end

function axes_of(x)
    names = size(x, 1) <= 3 ? (:x, :y, :z)[1:size(x, 1)] : Tuple(Symbol("x", k) for k in 1:size(x, 1))
    return NamedTuple{names}(Tuple(x[k, :] for k in 1:size(x, 1)))
end

"""
    hessian(s; stiffness, alpha, prestress)

The Hessian of the network, a sparse symmetric matrix of size d N': rows d (k - 1) + 1 to d k belong to sphere
`hessian_map(s)[k]`. `stiffness`: `:harmonic`, `:power` (with `alpha`), `:hard` or `:soft`.

```jldoctest
julia> using LinearAlgebra

julia> s = System(n = 64, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 32)); crunch!(s);

julia> h = hessian(s); issymmetric(h)
true

julia> m = modes(s, 3); u = m.vectors[:, 1]; isapprox(u' * h * u, m.values[1]; rtol = 1e-8)
true
```
"""
function hessian(s::System; given...)
    made = call(s, :jam_hessian, (); given...)
    start = Int.(made.row_start)
    m = length(start) - 1
    # compressed rows of a symmetric matrix are its compressed columns
    return SparseMatrixCSC(m, m, start, Int.(made.column), made.value)
end

"""
    modes(s, k = 10; which, frequency, stiffness, alpha, prestress, tolerance, memory_limit, progress)

Vibrational modes: `Results` with `values` (omega^2, ascending), `vectors` (one column per mode, of unit length), `participation`
(inverse ratio: 1 / N of a uniform mode), `frequencies` (negative where the value is) and `spheres`, those that move. `which`: `:lowest`, `:highest`, `:near` (a
`frequency`) or `:all`. `reshape(m.vectors[:, 1], d, :)` has a column for each of the `spheres`.
"""
function modes(s::System, k::Integer = 10; progress = nothing, given...)
    made = call(s, :jam_modes, (); progress = progress, count = k, given...)
    omega(x) = x < 0 ? -sqrt(-x) : sqrt(x)
    found = columns(made.table)
    vectors = reshape(made.vector, :, length(found.lambda))
    return Results(values = found.lambda, vectors = vectors, participation = found.participation,
                   frequencies = omega.(found.lambda), spheres = hessian_map(s))
end

"""
    bloch_modes(s, wave; stiffness, alpha, prestress, progress)

All modes at a wave vector, in units of the reciprocal cell vectors: as `modes`, with complex `vectors`. The copy of a sphere s cells
away moves by exp(2 pi i wave . s) times its own displacement. The modes of `tile(s, count)` are those of all wave = q ./ count.
"""
function bloch_modes(s::System, wave; progress = nothing, given...)
    made = call(s, :jam_bloch_modes, (collect(Float64, wave),); progress = progress, given...)
    found = columns(made.table)
    parts = reshape(made.vector, 2, :, length(found.lambda))
    return Results(values = found.lambda, vectors = complex.(parts[1, :, :], parts[2, :, :]), participation = found.participation,
                   spheres = hessian_map(s))
end

"""
    bloch_rigidity(s, count; progress) -> (wave, flexes, margin)

Tests from one cell whether `count[c]` copies along each cell vector are collectively jammed; `status(s)` has the answer. A column of
`wave` for each wave vector of the copies, the complex motions there that keep all contacts with force closed, and the least other
eigenvalue of S'S.
"""
function bloch_rigidity(s::System, count; progress = nothing)
    made = call(s, :jam_bloch_rigidity, (collect(Int32, count),); progress = progress)
    found = columns(made.table)
    return Results(wave = made.wave, flexes = Int.(found.flexes), margin = found.margin)
end

"""
    prove(s, ratio = nothing; strict = false)

Proves, despite rounding, that the packing is jammed; `theorem` of the report is `:none`, `:trapped` or `:exact`. `ratio`: the exact
ratios of the diameters, in any unit. `strict`: the cell deforms too, with the diameters as they are.
"""
prove(s::System, ratio = nothing; strict = false) = call(s, :jam_prove, (strict ? :strict : :collective, ratio))

"""
    write_proof(s, path, ratio = nothing; strict = false)

Writes the exact numbers of the proof, which `jamproof.py` checks with integers alone.
"""
write_proof(s::System, path, ratio = nothing; strict = false) =
    call(s, :jam_write_proof, (path, strict ? :strict : :collective, ratio))

"Table and vectors (d N' for each mode) of the floppy modes of contacts, from 1, or of all; vectors only where they are wanted."
function floppy(s::System, contact, moved, progress)
    m = contact === nothing ? count_of(s, :jam_contact_gaps) : length(contact)
    names = keys(WORDS.floppy_column)
    table = unknown(Cdouble, m * length(names))
    vector = unknown(Cdouble, moved ? m * count_of(s, :jam_hessian_map) * Int(info(s).dim) : 0)
    chosen = contact === nothing ? nothing : Int64.(contact) .- 1
    status = watched(handle(s), progress) do
        jam_floppy_modes(handle(s), chosen, contact === nothing ? 0 : m, length(names), table, length(table),
                         moved ? vector : nothing, length(vector), Ref{Csize_t}(0))
    end
    written(status)
    note!(s, status)
    rows = reshape(table, length(names), m)
    return Table(NamedTuple{names}(Tuple(rows[k, :] for k in 1:length(names)))), vector
end

"""
    floppy_modes(s; progress)

The floppy mode of every contact, measured: a table of `median`, `weight`, `s_plus`, `s_star`, `stability`, `s_return`. Needs a
single state of self-stress.
"""
floppy_modes(s::System; progress = nothing) = first(floppy(s, nothing, false, progress))

"""
    floppy_mode(s, contact; progress)

Displacement over s, d-by-N', of the stable spheres when one contact opens by s and all others stay closed to first order.
"""
floppy_mode(s::System, contact::Integer; progress = nothing) =
    reshape(last(floppy(s, [contact], true, progress)), Int(info(s).dim), :)

"""
    pair_correlation(s, r_max = 4, bins = 200; labels, a, b) -> (r, g)

g(r) in equal bins up to `r_max` mean diameters; with `labels`, a whole number a sphere, that of spheres `a` around `b`.
"""
function pair_correlation(s::System, r_max = 4.0, bins = 200; labels = nothing, a = -1, b = -1)
    g = call(s, :jam_pair_correlation, (labels,); a = a, b = b, r_max = r_max, bins = bins)
    return Results(r = (collect(1:bins) .- 0.5) .* (r_max / bins), g = g)
end
