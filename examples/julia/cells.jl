# Cells that are no cubes: a tilted start, a sheared packing, a crunch with a free cell that ends strictly jammed.
using Jam, LinearAlgebra

s = System(n = 60, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 30), cell = [1.0 0.3; 0.0 1.0])  # vectors in columns
compress!(s; growth_rate = 3e-2, pressure = 1e3)
r = crunch!(s; strain = :free)  # the cell deforms at fixed volume after the optimum of the fixed one
println("phi_J ", r.packing_fraction, ", strictly jammed: ", rigidity(s, :strict).jammed)
println("cell ", cell(s), ", volume ", det(cell(s)))
@assert rigidity(s, :strict).jammed === :yes

scale_diameters!(s, 0.99)
strain!(s, [0 0.002; 0 0])  # simple shear
println("sheared: ", cell(s))
