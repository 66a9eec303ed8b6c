# What long calls show, and how a function watches and stops them.

copy_struct(p::Ptr{T}) where {T} = (made = T(); GC.@preserve made unsafe_copyto!(Ptr{UInt8}(pointer_from_objref(made)), Ptr{UInt8}(p), sizeof(T)); made)

"Holds the function of the running call. C has its address, so it must not move."
mutable struct Watcher
    watch::Any
    thrown::Any
end

# Called by C on the calling task's thread. Nothing may be thrown across C: it is kept and thrown again behind it.
function progress_c(p::Ptr{jam_progress}, user::Ptr{Cvoid})::Int32
    w = unsafe_pointer_to_objref(user)::Watcher
    w.thrown === nothing || return Int32(1)
    try
        return Int32(w.watch(Report(copy_struct(p))) === true)
    catch e
        w.thrown = e
        return Int32(1)
    end
end

short(x) = string(round(x; sigdigits = 2))

"The part that is done and the time left, e.g. \"42 %, 3.1 s left (1.6 to 6.0)\"; \"\" before the first estimate."
function time_left(p)
    isnan(p.fraction) && return ""
    part = string(floor(Int, 100 * p.fraction), " %")
    isnan(p.seconds_left) && return part
    low, high = p.seconds_left / p.seconds_left_spread, p.seconds_left * p.seconds_left_spread
    return string(part, ", ", short(p.seconds_left), " s left (", short(low), " to ", short(high), ")")
end

function progress_text(p)
    parts = [rpad(p.phase, 8)]
    isnan(p.packing_fraction) || push!(parts, @sprintf("phi %.8f", p.packing_fraction))
    if p.phase in (:run, :compress)
        isnan(p.pressure) || push!(parts, @sprintf("p %.4g", p.pressure))
        push!(parts, "$(p.collisions) collisions")
    else
        push!(parts, "step $(p.steps)")
        p.gain > 0 && push!(parts, @sprintf("gain %.1e", p.gain))
    end
    left = time_left(p)
    isempty(left) || push!(parts, left)
    return join(parts, "  ")
end

# progress = true: one line on stderr that is rewritten.
function progress_line(p)
    print(stderr, "\r", rpad(progress_text(p), 100))
    return false
end

# progress = :log: messages that ProgressLogging, TerminalLoggers, Pluto and VS Code show as a bar. Level and keys are theirs.
const PROGRESS_LEVEL = Logging.LogLevel(-1)
function progress_logger()
    id = gensym(:jam)
    send(p) = (@logmsg PROGRESS_LEVEL progress_text(p) progress = (isnan(p.fraction) ? nothing : p.fraction) _id = id; false)
    return send, () -> @logmsg PROGRESS_LEVEL "done" progress = "done" _id = id
end

"(the function that watches, what to do behind the call) of a keyword progress: nothing, true, :log or a function."
function watcher(progress)
    (progress === nothing || progress === false) && return nothing, () -> nothing
    progress === true && return progress_line, () -> println(stderr)
    progress === :log && return progress_logger()
    applicable(progress, Report(jam_progress())) ||
        throw(ArgumentError("progress must be true, :log or a function of one argument, not $(repr(progress))"))
    return progress, () -> nothing
end

"Runs f() with the callback of the handle set. A function that returns true stops the call."
function watched(f, handle, progress)
    watch, done = watcher(progress)
    watch === nothing && return f()
    w = Watcher(watch, nothing)
    status = GC.@preserve w begin
        check(jam_set_progress(handle, @cfunction(progress_c, Int32, (Ptr{jam_progress}, Ptr{Cvoid})), pointer_from_objref(w)))
        try
            f()
        finally
            jam_set_progress(handle, nothing, nothing)
            done()
        end
    end
    w.thrown === nothing || throw(w.thrown)
    return status
end
