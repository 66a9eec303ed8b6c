"""Soft spheres from random points to an energy minimum, its moduli, down to jamming, checked by a crunch, and 1 % up again."""
import jam

sizes = [1.0, 1.4] * 50  # so few equal spheres would order
packing = jam.System.random(n=100, packing_fraction=0.72, diameters=sizes, overlap="allow")  # uniform points

minimum = packing.relax()  # harmonic; alpha=2.5, minimiser="fire", ... are options
print(f"energy {minimum.energy:.6g}, pressure {minimum.pressure:.6g}, residual {minimum.force_residual:.1e}")
assert minimum.converged

moduli = packing.moduli(stiffness="soft", prestress=1.0)  # of the energy that was minimised
print(f"bulk modulus {moduli.bulk:.4g}, shear modulus {moduli.shear:.4g}")

down = packing.decompress()
print(f"phi_J {down.jammed_fraction:.9f} from above, {down.crunch_fraction:.9f} by crunch")
for row in packing.soft_history:
    print(f"  distance {row['distance']:.2e}  pressure {row['pressure']:.3e}  z {row['coordination']:.4f}")
assert down.same_network == 1 and packing.report.jammed

packing.scale_diameters(1.01 ** (1 / 3))  # a packing fraction 1 % above phi_J
above = packing.relax()
modes = packing.modes(10, stiffness="soft", prestress=1.0)
print(f"1 % above phi_J: pressure {above.pressure:.4g}, {above.coordination:.3f} contacts a sphere")
print(f"lowest frequency {modes.frequencies[0]:.4g}, largest force {packing.forces.max():.3f} of the mean")
assert above.converged and above.coordination > 6 and modes.values[0] > 0
