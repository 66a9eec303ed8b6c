# Watching and stopping a long call: a function, another task, a limit. The state stays valid each time.
using Jam

s = System(n = 500, dim = 3, seed = 1)
steps = Ref(0)
r = crunch!(s; progress = p -> begin
    println("  ", p.phase, ": phi ", p.packing_fraction, " after ", p.seconds, " s")
    (steps[] += 1) >= 3  # true stops
end)
println("stopped by the function: ", r.status, ", phi = ", packing_fraction(s))

try
    crunch!(s; progress = p -> error("from the callback"))
catch e
    println("an exception in the function comes out of the call: ", e)
end

cancel(s)  # from any thread; without a running call it stops the next one
println("stopped by cancel: ", crunch!(s).status)

r = crunch!(s; method = :sequential_lp, max_lps = 1)  # limits are no errors either
println("stopped by a limit: ", r.status, " (", r.status_text, "), and another call continues from there")
println("then: ", crunch!(s; progress = :log).status)  # a bar, with TerminalLoggers or in Pluto and VS Code
