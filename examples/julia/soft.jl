# Soft spheres from random points to an energy minimum, its moduli, and down to jamming, checked by a crunch.
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
