# Watching a long call and stopping it: the state reached stays valid.
using Jam

s = System(n = 500, dim = 3, seed = 1)
steps = Ref(0)
crunch!(s; progress = p -> begin
    println("  phi ", p.packing_fraction, ", gain ", p.gain)
    (steps[] += 1) >= 3  # true stops
end)
println("stopped with status ", s.status, " (", Jam.JAM_CANCELLED, " is cancelled), phi = ", info(s).packing_fraction)

try
    crunch!(s; progress = p -> error("from the callback"))
catch e
    println("an exception in the function comes out of the call: ", e)
end

cancel(s)  # from any thread; without a running call it stops the next one
crunch!(s)
println("cancelled: ", s.status == Jam.JAM_CANCELLED)
