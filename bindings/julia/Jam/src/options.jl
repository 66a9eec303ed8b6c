# Options of calls from keywords: words for enums; wrong names get the nearest right ones.

# Parameters of CALiPPSO.jl; bindings/docs/coming_from.md has the whole table.
const CALIPPSO = Dict(
    :l0 => "neighbour_radius, over the mean diameter", :ℓ0 => "neighbour_radius, over the mean diameter",
    :sbound => "step_bound = sbound / 2, in mean diameters", :max_iters => "max_lps",
    :tol_Gamma_convergence => "gain_tolerance", :tol_Γ_convergence => "gain_tolerance",
    :tol_S_convergence => "step_tolerance, over the mean diameter",
    :optimizer => "lp_solver = :ipm or :clp", :solver => "lp_solver = :ipm or :clp",
    :solver_attributes => "lp_tolerance", :solver_args => "lp_tolerance",
    :tol_mechanical_equilibrium => "polish; force_residual of the report gives the balance that was reached",
    :tol_overlap => "has no counterpart: no step can create an overlap; max_overlap of the report gives the largest",
    :zero_force => "has no counterpart: min_force of the report gives the smallest force",
    :verbose => "progress = true", :monitor_step => "progress = true", :initial_monitor => "progress = true",
    :sqrGamma0 => "has no counterpart: the first stage is chosen by itself", :sqrΓ0 => "has no counterpart: the first stage is chosen by itself",
    :thresholds_bounds => "has no counterpart: radius and bound follow the density",
    :ratio_sl_update => "has no counterpart: distances are exact at every step", :ratio_sℓ_update => "has no counterpart: distances are exact at every step",
    :non_iso_break => "has no counterpart: column excess of history(s) gives it for each LP",
    :interval_overlaps_check => "has no counterpart: every step tests for overlaps",
    :initial_overlaps_check => "has no counterpart: every step tests for overlaps",
    :add_bridges => "has no counterpart: there is no modelling layer", :L => "box", :R => "radii", :Rs => "radii",
)
# Those that calippso! takes under their own names and in their own units.
const STAGED = (:l0, :ℓ0, :sbound, :sqrGamma0, :sqrΓ0, :thresholds_bounds, :max_iters, :tol_Gamma_convergence, :tol_Γ_convergence,
                :tol_S_convergence)

"Letters to change, add or leave out between two words."
function distance(a::AbstractString, b::AbstractString)
    row = collect(0:length(b))
    for (i, x) in enumerate(a)
        before, row[1] = row[1], i
        for (j, y) in enumerate(b)
            before, row[j+1] = row[j+1], min(row[j] + 1, row[j+1] + 1, before + (x != y))
        end
    end
    return row[end]
end

# Other words of the field for what has one name here.
const OTHER_WORDS = Dict("N" => "n", "d" => "dim", "phi" => "packing_fraction", "ϕ" => "packing_fraction", "φ" => "packing_fraction",
    "density" => "packing_fraction", "rate" => "growth_rate", "tol" => "gain_tolerance", "tolerance" => "gain_tolerance",
    "timeout" => "wall_time", "side" => "box")

"Our word for another word of the field, the nearest of the known names, or all of them."
function suggestion(name::AbstractString, known)
    word = get(OTHER_WORDS, name, "")
    word in known && return "; did you mean $word?"
    near = sort([(distance(name, k), k) for k in known if distance(name, k) <= max(2, length(name) ÷ 3)])
    isempty(near) || return "; did you mean $(near[1][2])?"
    return "; there are $(join(known, ", "))"
end

"What to say of a keyword that does not exist."
function unknown_option(name::Symbol, value, known)
    text = "unknown option $name"
    haskey(CALIPPSO, name) || return text * suggestion(string(name), string.(known))
    text = "$name of CALiPPSO " * (startswith(CALIPPSO[name], "has no") ? CALIPPSO[name] : "is $(CALIPPSO[name]) here")
    return name in STAGED ? text * ". calippso!(s; $name = $value) takes it as it is, and solves their stages one by one" : text
end

"The number of an enum's value, given by its word or its number."
function number(enum::Symbol, value, name)
    value isa Integer && return Int32(value)
    (value isa Symbol || value isa AbstractString) || throw(ArgumentError("$name must be a word, one of $(words(enum)), not $(repr(value))"))
    key = Symbol(lowercase(string(value)))
    haskey(WORDS[enum], key) || throw(ArgumentError("$name = $(repr(value)) is none of $(words(enum))" *
                                                    nearest(string(key), string.(keys(WORDS[enum])))))
    return Int32(WORDS[enum][key])
end
words(enum::Symbol) = join((":$k" for k in keys(WORDS[enum])), ", ")
function nearest(name, known)
    near = sort([(distance(name, k), k) for k in known])
    return near[1][1] <= 2 ? "; did you mean :$(near[1][2])?" : ""
end

"A value as a member of a struct holds it."
function member(::Type{T}, name::Symbol, value) where {T}
    kind, field = get(kinds(T), name, :number), fieldtype(T, name)
    kind in (:number, :bool) || return number(kind, value, name)
    try
        return convert(field, value)
    catch
        wanted = kind === :bool ? "true or false" :
                 field <: Integer ? "a whole number from $(typemin(field)) to $(typemax(field))" : "a number"
        throw(ArgumentError("$name must be $wanted, not $(repr(value))"))
    end
end

"An option struct of the library's defaults, changed by the keywords. `nothing` keeps a default."
function options(::Type{T}, given) where {T}
    o = T()
    check(defaults(T)(o, sizeof(T)))
    for (name, value) in pairs(given)
        name in members(T) || throw(ArgumentError(unknown_option(name, value, members(T))))
        value === nothing || setfield!(o, name, member(T, name, value))
    end
    return o
end

"packing_fraction from porosity, the void fraction: only one of them may be given."
function with_density(given, porosity)
    porosity === nothing && return given
    haskey(given, :packing_fraction) && throw(ArgumentError("give packing_fraction or porosity"))
    0 < porosity < 1 || throw(ArgumentError("porosity is $porosity, it must be above 0 and below 1"))
    return (; given..., packing_fraction = 1 - porosity)
end

# Options of another way to make a system, which would be without effect.
function refuse(given, names, why)
    for name in names
        haskey(given, name) && throw(ArgumentError("$name = $(given[name]) would be without effect: $why"))
    end
end

dense(x) = convert(Array{Cdouble}, collect(x))
