# Run with: JAM_LIBRARY=/path/libjam.so julia --project=build/julia/Jam -e 'using Pkg; Pkg.test()'
using Jam, Libdl, LinearAlgebra, Logging, SparseArrays, Test

"What a failing call says; \"\" when it does not fail."
failure(f) = try f(); "" catch e; sprint(showerror, e) end
"A small jammed packing of disks."
disks(n = 60) = (s = System(n = n, dim = 2, seed = 3, diameters = repeat([1.4, 1.0], n ÷ 2)); crunch!(s); s)

# Each part has a module of its own, so that none sees names of another.
function run_part(name)
    part = Module(Symbol(name))
    Core.eval(part, :(using Jam, Libdl, LinearAlgebra, Logging, SparseArrays, Test; using Main: failure, disks))
    Core.eval(part, :(include(path) = Base.include($part, path)))
    Base.include(part, joinpath(@__DIR__, name * ".jl"))
end

@testset "Jam" begin
    for name in ("layout", "start", "state", "crunch", "network", "dynamics", "soft", "near_jamming", "files", "words", "doctests")
        @testset "$name" begin run_part(name) end
    end
end
