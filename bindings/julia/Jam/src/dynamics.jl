# Verbs that move the spheres by molecular dynamics, and what is recorded of it.

"Runs f(handle), which fills the report `made`, watched by progress."
function verb(f, s::System, made, progress)
    failing(() -> note!(s, watched(() -> f(handle(s)), handle(s), progress)), s)
    return Report(made, s.status, s.why)
end

"""
    run!(s; collisions_per_particle, time, wall_time, resume, progress)

Event-driven NVE dynamics; returns a Report. `report.status` says whether it stopped early.

`progress`: `true` shows a line, `:log` sends messages that ProgressLogging and TerminalLoggers show as a bar, a function gets
a Report and stops the call by returning `true`.
"""
function run!(s::System; progress = nothing, given...)
    o, made = options(s, jam_run_options, given), jam_md_report()
    return verb(h -> jam_run(h, o, made), s, made, progress)
end

"""
    compress!(s; growth_rate, pressure, packing_fraction, porosity, collisions_per_particle, wall_time, stages, progress, ...)

Lubachevsky-Stillinger growth; without options the two-stage protocol. With packing_fraction, or porosity = 1 minus it, it
ends at exactly this density. `stages`: pairs of growth rate and pressure, one stage after the other. Returns a Report.

```jldoctest
julia> s = System(n = 64, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 32));

julia> compress!(s; packing_fraction = 0.6).stop_reason
:packing_fraction

julia> compress!(s; stages = [(3e-2, 100), (1e-2, 1000)]).stop_reason
:pressure
```
"""
function compress!(s::System; progress = nothing, porosity = nothing, stages = nothing, given...)
    if stages !== nothing
        failing(() -> refuse(given, (:growth_rate, :pressure), "stages give it"), s)
        local made
        for (rate, pressure) in stages
            made = compress!(s; progress = progress, growth_rate = rate, pressure = pressure, porosity = porosity, given...)
            made.status === :ok || made.stop_reason === :pressure || break  # a later stage may reach the density
        end
        return made
    end
    given = with_density((; given...), porosity)
    o, made = isempty(given) ? nothing : options(s, jam_compress_options, given), jam_md_report()
    return verb(h -> jam_compress(h, o, made), s, made, progress)
end

"Stops the call that runs on s in another thread; without one, the next call."
cancel(s::System) = (check(jam_cancel(handle(s))); nothing)

"""
    Observed(s)

What a system has recorded since `observe!`. `series`, `gaps` and `correlation` are tables; `spheres` and `pairs` NamedTuples; `stress` a matrix.
"""
struct Observed
    system::System
end
Base.propertynames(::Observed, private::Bool = false) = (:series, :stress, :spheres, :pairs, :gaps, :correlation)
function Base.getproperty(o::Observed, name::Symbol)
    name in propertynames(o) && return getfield(Jam, Symbol(:observed_, name))(getfield(o, :system))
    throw(ArgumentError("nothing observed is named $name" * suggestion(string(name), string.(propertynames(o)))))
end
Base.show(io::IO, o::Observed) = print(io, "Observed(", join(propertynames(o), ", "), ")")

"""
    observing(f, s; sample_every, collisions, gap_bins, r_bins, ...)

Records what `run!` and `compress!` do inside `f()`, a `do` block. Takes the options of `observe!`.

```jldoctest
julia> s = System(n = 64, dim = 3, seed = 1);

julia> seen = observing(s; sample_every = 5) do
           run!(s; collisions_per_particle = 20)
       end;

julia> propertynames(seen.series)
(:time, :collisions, :fraction, :pressure, :error, :msd)
```
"""
function observing(f, s::System; given...)
    observe!(s; given...)
    try
        f()
    finally
        stop_observing!(s)
    end
    return Observed(s)
end
