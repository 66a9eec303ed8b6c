# Soft spheres: forces balance at the minimum, and the way down ends where a crunch does.
s = System(n = 60, dim = 2, packing_fraction = 0.95, overlap = :allow, diameters = repeat([1.0, 1.4], 30))
r = relax!(s; minimiser = :newton)
@test r.converged && r.minimiser === :newton && r.force_residual < 1e-12
h = hessian(s; stiffness = :soft, prestress = 1.0)
@test eigmin(Symmetric(Matrix(h))) > -1e-10  # a minimum
down = decompress!(s)
@test down.same_network == 1
@test down.jammed_fraction ≈ down.crunch_fraction rtol = 1e-6
@test issorted(soft_history(s).distance; rev = true)
@test occursin("overlap = :allow", failure(() -> relax!(System(n = 8, dim = 2))))

@test sizes("list:1=0.5,1.4=0.5"; n = 4) == [1, 1, 1.4, 1.4]
@test sizes(:list; curve = [1 1.4; 0.5 0.5], n = 4) == [1, 1, 1.4, 1.4]
@test size_report([1.0, 3.0]).mean == 2 && size_report([1.0, 1.4]; dim = 2).source === :measured
@test occursin("2-by-rows", failure(() -> sizes(:list; curve = [1 0.5; 1.4 0.5; 2 0], n = 4)))
