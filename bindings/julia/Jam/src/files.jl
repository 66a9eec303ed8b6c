# Files: packings, networks, checkpoints, pages.

"""
    Jam.read(path; options...)

The packing in a file, as `System(path; options...)` and `read(path, System)` do. It is not exported: `read` alone is Julia's.
"""
read(path::AbstractString; given...) = System(path; given...)
Base.read(path::AbstractString, ::Type{System}; given...) = System(path; given...)

"""
    write(path, s::System; format)

Writes the packing with 17 digits. `format`: `:auto` goes by the ending, `:plain`, `:xyz`, `:lammps` or `:vtp`. A name that ends
in .gz is compressed.
"""
function Base.write(path::AbstractString, s::System; format = :auto)
    written(jam_write(handle(s), path, number(:format, format, :format)))
    return nothing
end

"""
    write_contacts(path, s; format)

Writes the contact network: .csv, .dump (LAMMPS) or .vtp (ParaView), by the ending or by `format`.
"""
function write_contacts(path::AbstractString, s::System; format = :auto)
    written(jam_write_contacts(handle(s), path, number(:contact_format, format, :format)))
    return nothing
end

"""
    page(path, s; title, small, values, modes)

Writes one HTML file that shows the packing in a browser without a network. `values`: a NamedTuple of vectors, a number a
sphere, to colour spheres by, and of d-by-n matrices, displacements that are animated. `modes`: vibrational modes to animate,
as from `modes(s)`. `small = true`: the picture alone.
"""
function page(path::AbstractString, s::System; title = "", small = false, values = (;), modes = nothing)
    n, d = Int(info(s).n), Int(info(s).dim)
    names, rows = String[], Vector{Cdouble}[]  # a name that ends in [] has d rows
    for (name, x) in pairs(values)
        moves = ndims(x) == 2 && size(x) == (d, n)
        moves || length(x) == n || throw(ArgumentError("values of $name are $(length(x)), and there are $n spheres"))
        push!(names, moves ? "$name[]" : "$name")
        push!(rows, moves ? vec(permutedims(x)) : dense(x))
    end
    for k in axes(modes === nothing ? zeros(0, 0) : modes.vectors, 2)
        whole = zeros(n, d)
        whole[modes.spheres, :] = permutedims(reshape(modes.vectors[:, k], d, :))
        push!(names, @sprintf("mode %d, omega %.4g[]", k, modes.frequencies[k]))
        push!(rows, vec(whole))
    end
    table = reduce(vcat, rows; init = Cdouble[])
    data = isempty(table) ? nothing : table
    written(jam_write_page(handle(s), path, title, small, join(names, "\n"), data, length(table)))
    return nothing
end

"""
    checkpoint(s, path)

Writes all that the dynamics depend on; `from_checkpoint(path)` continues to the same bits.
"""
checkpoint(s::System, path::AbstractString) = (written(jam_write_checkpoint(handle(s), path)); nothing)

"""
    from_checkpoint(path)

Makes a system from a file of `checkpoint`.
"""
function from_checkpoint(path::AbstractString)
    out = Ref{Ptr{Cvoid}}(C_NULL)
    written(jam_read_checkpoint(path, nothing, nothing, out))
    return System(out[])
end
