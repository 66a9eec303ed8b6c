# Soft spheres from random points to an energy minimum, its moduli, down to jamming, checked by a crunch, and 1 % up again.
using Jam

sizes = repeat([1.0, 1.4], 50)  # so few equal spheres would order
s = System(n = 100, packing_fraction = 0.72, diameters = sizes, overlap = :allow)  # uniform points

minimum = relax!(s)  # harmonic; alpha = 2.5, minimiser = :fire, ... are options
println("energy ", minimum.energy, ", pressure ", minimum.pressure, ", residual ", minimum.force_residual)
@assert minimum.converged

k = moduli(s; stiffness = :soft, prestress = 1.0)  # of the energy that was minimised
println("bulk modulus ", k.bulk, ", shear modulus ", k.shear)

down = decompress!(s)
println("phi_J ", down.jammed_fraction, " from above, ", down.crunch_fraction, " by crunch")
for row in soft_history(s)
    println("  distance ", row.distance, "  pressure ", row.pressure, "  z ", row.coordination)
end
@assert down.same_network == 1 && report(s).jammed

scale_diameters!(s, 1.01^(1 / 3))  # a packing fraction 1 % above phi_J
above = relax!(s)
lowest = modes(s, 10; stiffness = :soft, prestress = 1.0)
println("1 % above phi_J: pressure ", above.pressure, ", ", above.coordination, " contacts a sphere")
println("lowest frequency ", lowest.frequencies[1], ", largest force ", maximum(forces(s)), " of the mean")
@assert above.converged && above.coordination > 6 && lowest.values[1] > 0
