# From any valid packing to its jamming point, and what the way there was.

"""
    crunch!(s; method, lp_solver, max_lps, gain_tolerance, neighbour_radius, step_bound, wall_time, strain, prove, ..., progress,
            on_step)

Iterated linear programming down to the jamming point; returns a Report with the certificate. `method`: `:barrier_path` or
`:sequential_lp`, the published sequence of LPs. All options: `@doc Jam.jam_crunch_options`.

`on_step`: a function of a NamedTuple `(displacements, pairs, vectors, duals)`, called after each step; the linear network has
entries for LP steps only. `progress` as of `run!`. Each may return `true` to stop: the state stays valid.

```jldoctest
julia> s = System(n = 64, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 32));

julia> r = crunch!(s; method = :sequential_lp);

julia> r.jammed, r.stop_reason, r.max_overlap < 1e-12
(true, :converged, true)
```
"""
function crunch!(s::System; progress = nothing, on_step = nothing, given...)
    given = on_step === nothing ? given : (; given..., steps = true)
    o, made = options(s, jam_crunch_options, given), jam_crunch_report()
    on_step === nothing && return verb(h -> jam_crunch(h, o, made), s, made, progress)
    watch, done = watcher(progress)
    function each(p)
        stop = watch === nothing ? false : watch(p) === true
        step = step_of(s)
        return (step !== nothing && on_step(step) === true) || stop
    end
    try
        return verb(h -> jam_crunch(h, o, made), s, made, each)
    finally
        done()
    end
end

"The step that has just ended; `nothing` during a step."
function step_of(s)
    try
        step = crunch_step(s)
        return (displacements = step.displacement, pairs = step.pair, vectors = step.vector, duals = step.dual)
    catch e
        e isa JamError && e.status === :state && return nothing
        rethrow()
    end
end

"""
    report(s)

Report of the last crunch, with its certificate.
"""
function report(s::System)
    made = jam_crunch_report()
    check(jam_get_crunch_report(handle(s), made))
    return Report(made, word(:status_code, made.status), "")
end

"""
    history(s)

Steps of the last crunch as a table: phase, gain, phi, step_max, contacts, pairs, bound, ...
"""
function history(s::System)
    rows = columns(call(s, :jam_crunch_history, ()))
    return Table(merge(rows, (phase = [word(:step_phase, Int(x)) for x in rows.phase],)))
end

"""
    judge(s; crunch, prove, wall_time, progress)

Tests the packing as it is and moves nothing. Returns a Report that prints as its paragraph, `report.text`. `report.status` is
`:ok` when jammed, `:not_jammed`, or `:ambiguous` when undecided.
"""
function judge(s::System; progress = nothing, given...)
    o, made = options(s, jam_check_options, given), jam_check_report()
    r = verb(h -> jam_check_packing(h, o, made), s, made, progress)
    r.status in (:cancelled, :limit) && throw(JamError(r.status, r.status_text))
    return Report(made, r.status, r.status_text, in_julia(unsafe_string(jam_check_text(made))))
end
