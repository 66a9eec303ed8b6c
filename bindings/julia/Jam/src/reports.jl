# Structs of the library as Julia shows them: words for enums, true and false, a table.

"""
    Report

What a call reports. Its members are those of the C struct, with words for the values of enums: `r.stop_reason == :converged`.
`r.status` is `:ok`, or says that the call stopped early or found no certain answer, and `r.status_text` why. It prints as a
table. `NamedTuple(r)` is a row of a table: `DataFrame(NamedTuple.(reports))`.
"""
struct Report{T}
    data::T
    status::Symbol
    status_text::String
    text::String  # a paragraph that says it all, where a call has one
end
Report(data, status = :ok, status_text = "") = Report(data, status, status_text, "")

raw(r::Report) = getfield(r, :data)
members(::Type{T}) where {T} = filter(m -> !(m in (:struct_size, :reserved, :reserved_end, :status)), fieldnames(T))
Base.propertynames(::Report{T}, private::Bool = false) where {T} = (:status, :status_text, members(T)...)

function Base.getproperty(r::Report{T}, name::Symbol) where {T}
    name in (:status, :status_text, :text) && return getfield(r, name)
    hasfield(T, name) || throw(ArgumentError("$(title(T)) has no $name" * suggestion(string(name), string.(members(T)))))
    value = getfield(raw(r), name)
    kind = get(kinds(T), name, :number)
    return kind === :number ? value : kind === :bool ? value == 1 : word(kind, value)
end

Base.NamedTuple(r::Report) = (names = propertynames(r); NamedTuple{names}(Tuple(getproperty(r, n) for n in names)))
Base.pairs(r::Report) = pairs(NamedTuple(r))

title(::Type{T}) where {T} = join(uppercasefirst.(split(replace(string(nameof(T)), r"^jam_" => ""), "_")))

figure(x::AbstractFloat) = @sprintf("%.12g", x)
figure(x) = string(x)

function Base.show(io::IO, r::Report{T}) where {T}
    get(io, :compact, false) && return print(io, title(T), "(", r.status, ", ", length(members(T)), " members)")
    print(io, title(T), "(", join(("$m = $(figure(getproperty(r, m)))" for m in (:status, members(T)...)), ", "), ")")
end

function Base.show(io::IO, ::MIME"text/plain", r::Report{T}) where {T}
    isempty(r.text) || return print(io, r.text)
    print(io, title(T), r.status === :ok ? "" : " ($(r.status))", isempty(r.status_text) ? "" : ": " * r.status_text)
    width = maximum(length(string(m)) for m in members(T))
    for m in members(T)
        print(io, "\n  ", rpad(m, width), "  ", figure(getproperty(r, m)))
    end
end

"""
    Results(; name = value, ...)

Several results of one call: `m.values`, or in their order, `gap, pair = gaps(s)`. It prints the sizes of arrays, not their elements.
`NamedTuple(m)` has the same members.
"""
struct Results{N<:NamedTuple}
    data::N
end
Results(; given...) = Results((; given...))
Base.NamedTuple(m::Results) = getfield(m, :data)
Base.getproperty(m::Results, name::Symbol) = getproperty(NamedTuple(m), name)
Base.propertynames(m::Results, private::Bool = false) = keys(m)
for f in (:keys, :values, :pairs, :length, :iterate, :getindex)
    @eval Base.$f(m::Results, at...) = $f(NamedTuple(m), at...)
end
Base.:(==)(a::Results, b::Results) = NamedTuple(a) == NamedTuple(b)
Base.show(io::IO, m::Results) = print(io, "Results(", join(keys(m), ", "), ")")
function Base.show(io::IO, ::MIME"text/plain", m::Results)
    width = maximum(length(string(name)) for name in keys(m))
    for (k, (name, value)) in enumerate(pairs(m))
        print(io, k == 1 ? "" : "\n", rpad(name, width), "  ", value isa AbstractArray ? summary(value) : sprint(show, value; context = :compact => true))
    end
end

"""
    Table(columns)

A vector of rows, each a NamedTuple, whose columns are at hand: `t.force` is a column, `t[3]` a row, `columns(t)` the NamedTuple
of vectors. Both are tables of Tables.jl, so that `DataFrame(t)` and `CSV.write("contacts.csv", t)` take it.
"""
struct Table{R<:NamedTuple,C<:NamedTuple} <: AbstractVector{R}
    columns::C
end
Table(c::NamedTuple{names}) where {names} = Table{NamedTuple{names, Tuple{map(eltype, values(c))...}}, typeof(c)}(c)

"The columns of a table as a NamedTuple of vectors."
columns(t::Table) = getfield(t, :columns)
Base.size(t::Table) = size(first(columns(t)))
Base.getindex(t::Table, k::Int) = map(c -> c[k], columns(t))
Base.getindex(t::Table, name::Symbol) = columns(t)[name]
Base.propertynames(t::Table, private::Bool = false) = keys(columns(t))
function Base.getproperty(t::Table, name::Symbol)
    haskey(columns(t), name) && return columns(t)[name]
    known = string.(keys(columns(t)))
    throw(ArgumentError("the table has no column $name" * suggestion(string(name), known)))
end
Base.show(io::IO, t::Table) = print(io, "Table(", length(t), " rows: ", join(keys(columns(t)), ", "), ")")

function Base.show(io::IO, ::MIME"text/plain", t::Table)
    shown = length(t) <= 12 ? collect(1:length(t)) : [1:5; length(t)-4:length(t)]
    cells = [[string(name); [cell_text(c[k]) for k in shown]] for (name, c) in pairs(columns(t))]
    widths = [maximum(length, c) + 2 for c in cells]
    fit = max(1, something(findlast(w -> w <= displaysize(io)[2], cumsum(widths)), 1))
    print(io, length(t), " rows", fit == length(cells) ? "" : ", $(length(cells) - fit) more columns: $(join(keys(columns(t))[fit+1:end], ", "))")
    for row in 1:length(shown)+1
        print(io, "\n", join(lpad(cells[k][row], widths[k]) for k in 1:fit))
        row == 6 && length(t) > 12 && print(io, "\n  ...")
    end
end
cell_text(x::AbstractFloat) = @sprintf("%.6g", x)
cell_text(x) = string(x)
