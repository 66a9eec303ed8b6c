# Any C function of the header by its conventions: options by keyword, arrays as Julia has them, count then fill.

struct Argument
    name::Symbol
    role::Symbol
    type::DataType
    extents::Vector{String}  # in C's order
    word::Symbol             # the enum of its values or columns, or :none
    index::Bool              # counts from 0 in C, from 1 here
end

struct Call
    f::Any
    on_system::Bool
    fixed::Bool  # the system is const: no callback is set
    arguments::Vector{Argument}
end

const PLAIN_ROLES = (:scalar, :string, :array_in, :handle)

"Length of an extent such as \"d N' + 1\"; nothing where one of its factors is not known before the call."
function extent(text::AbstractString, known)
    more = endswith(text, " + 1")
    product = 1
    for factor in split(more ? text[1:end-4] : text)
        size = tryparse(Int, factor)
        size === nothing && (size = known(factor))
        size === nothing && return nothing
        product *= size
    end
    return product + more
end

"What is known of a system before a call, by the header's letters."
function letters(s, inputs)
    return function (letter)
        s === nothing && return nothing
        letter == "d" && return Int(info(s).dim)
        letter == "n" && return Int(info(s).n)
        letter == "N'" && return count_of(s, :jam_hessian_map)
        letter in ("n_c", "contacts") && return count_of(s, :jam_contact_gaps)
        return nothing
    end
end

function count_of(s, name)
    needed = Ref{Csize_t}(0)
    check(CALLS[name].f(handle(s), nothing, 0, needed))
    return Int(needed[])
end

"""
C's shape of an array that a call fills, with one extent that the call gave: m is *rows; or *needed, the elements of a single
array, and of several n for each value of that extent.
"""
function shape_of(a::Argument, known, counted::Symbol, m::Int, alone::Bool)
    if a.word !== :none && a.name === :table
        columns = length(WORDS[a.word])
        return (counted === :rows ? m : m ÷ columns, columns)
    end
    sizes = [extent(e, known) for e in a.extents]
    open = count(isnothing, sizes)
    open > 1 && return (m,)
    others = prod(Int[x for x in sizes if x !== nothing])
    given = counted === :rows ? m : alone ? (others == 0 ? 0 : m ÷ others) : m ÷ max(1, something(known("n"), 1))
    return Tuple(x === nothing ? given + (given > 0 && endswith(e, "+ 1")) : x for (x, e) in zip(sizes, a.extents))
end

"n numbers for a call to fill: NaN, or -1, where it writes nothing."
unknown(::Type{T}, n...) where {T} = fill(T <: AbstractFloat ? T(NaN) : T(-1), n...)

"""
Refuses an array that has not the header's shape, reversed as everywhere in Julia, nor is a vector: C checks its length.
A transposed array of as many rows as columns cannot be seen.
"""
function check_shape(a::Argument, x::AbstractArray, known)
    ndims(x) == 1 && length(a.extents) > 1 && return nothing
    wanted = Any[extent(e, known) for e in reverse(a.extents)]
    fits = ndims(x) == length(wanted) && all(w === nothing || w == k for (w, k) in zip(wanted, size(x)))
    fits && return nothing
    spelled = join([something(w, e) for (w, e) in zip(wanted, reverse(a.extents))], ", ")
    throw(ArgumentError("$(a.name) must have the size ($spelled), not $(size(x))"))
end

"An input as C takes it; known: extents by letter."
function taken(a::Argument, value, known)
    a.role === :handle && return handle(value)
    a.role === :string && return string(value)
    if a.role === :array_in
        value === nothing && return nothing
        x = collect(value)
        check_shape(a, x, known)
        return convert(Vector{a.type}, vec(x)) .- a.type(a.index)
    end
    a.word !== :none && return number(a.word, value, a.name)
    try
        return convert(a.type, value) - a.type(a.index)
    catch
        throw(ArgumentError("$(a.name) must be $(a.type <: Integer ? "a whole number" : "a number"), not $(repr(value))"))
    end
end

"An output as Julia has it: reversed extents, indices from 1, a table of named columns."
function given_back(a::Argument, x, shape)
    if a.word !== :none && a.name === :table
        rows = reshape(x, shape[2], shape[1])
        names = keys(WORDS[a.word])
        return Table(NamedTuple{names}(Tuple(rows[k, :] for k in 1:length(names))))
    end
    made = length(shape) == 1 ? x : reshape(x, reverse(shape))
    return a.index ? map(k -> k < 0 ? k : k + one(k), made) : made  # below 0: a wall
end

"""
    call(s, :jam_name, inputs; progress, options...)

Calls a function of the C header: `inputs` in its order, members of its option structs as keywords. Returns its output, or
`Results` of several. The size of arrays is queried first. `s` is `nothing` for functions without a system.
"""
call(s, name::Symbol, inputs::Tuple; given...) = failing(() -> called(s, name, inputs; given...), s)
function called(s, name::Symbol, inputs::Tuple; progress = nothing, given...)
    c = CALLS[name]
    left = Any[inputs...]
    passed, outputs = Any[], Dict{Symbol, Any}()
    structs = [a.type for a in c.arguments if a.role === :struct_in]
    made = split_options(structs, given)
    for a in c.arguments
        if a.role in PLAIN_ROLES
            push!(passed, taken(a, popfirst!(left), letters(s, inputs)))
        elseif a.role === :struct_in
            push!(passed, popfirst!(made))
        elseif a.role === :struct_out
            outputs[a.name] = a.type()
            push!(passed, outputs[a.name])
        elseif a.role === :array_out
            push!(passed, nothing)
        elseif a.role === :columns
            push!(passed, length(WORDS[a.word]))
        elseif a.role === :len
            push!(passed, length(something(passed[end], ())))
        elseif a.role === :scalar_out
            push!(passed, Ref{a.type}(0))
        end
    end
    run(x) = (h = c.on_system ? (handle(s),) : (); c.f(h..., x...))
    watching(x) = c.on_system && !c.fixed ? watched(() -> run(x), handle(s), progress) : run(x)
    fills = [k for (k, a) in enumerate(c.arguments) if a.role === :array_out]
    counter = findfirst(a -> a.role === :scalar_out && a.name in (:needed, :rows), c.arguments)
    shapes = Dict{Int, Any}()
    status = isempty(fills) || counter === nothing ? watching(passed) : run(passed)
    reports = [a for a in c.arguments if a.role === :struct_out]
    stops = any(a -> hasfield(a.type, :stop_reason), reports)
    if !isempty(fills) && counter !== nothing
        stops || written(status)
        known, m = letters(s, inputs), Int(passed[counter][])
        for k in fills
            a = c.arguments[k]
            shapes[k] = shape_of(a, known, c.arguments[counter].name, m, length(fills) == 1)
            passed[k] = unknown(a.type, prod(shapes[k]))
            passed[k+1] = length(passed[k])
        end
        status = watching(passed)
    end
    stops ? check(status) : written(status)
    c.on_system && note!(s, status)
    why = status > 0 ? last_text() : ""
    for (k, a) in enumerate(c.arguments)
        if a.role === :array_out
            outputs[a.name] = haskey(shapes, k) ? given_back(a, passed[k], shapes[k]) : nothing
        elseif a.role === :struct_out
            outputs[a.name] = Report(outputs[a.name], word(:status_code, status), why)
        elseif a.role === :scalar_out && k !== counter
            outputs[a.name] = passed[k][]
        end
    end
    order = [a.name for a in c.arguments if haskey(outputs, a.name)]
    length(order) > 1 && return Results(NamedTuple{Tuple(order)}(Tuple(outputs[n] for n in order)))
    return isempty(order) ? nothing : outputs[order[1]]
end

"The keywords of a call, each to the option struct that has it."
function split_options(structs, given)
    shares = [Dict{Symbol, Any}() for _ in structs]
    for (name, value) in pairs(given)
        k = findfirst(T -> name in members(T), structs)
        k === nothing && throw(ArgumentError(unknown_option(name, value, reduce((x, y) -> (x..., y...), members.(structs); init = ()))))
        shares[k][name] = value
    end
    return Any[options(T, share) for (T, share) in zip(structs, shares)]
end
