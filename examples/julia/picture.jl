# Pictures of a packing, and files for ParaView and OVITO.  usage: picture.jl [PICTURE.svg]
using Jam

s = System(n = 300, dim = 2, seed = 2, diameters = [fill(1.0, 150); fill(1.4, 150)])
compress!(s; growth_rate = 3e-2, pressure = 1e4)
crunch!(s)

picture(isempty(ARGS) ? "picture.svg" : ARGS[1], s)  # rattlers grey, bucklers orange, forces by width
page("picture.html", s; values = (contacts = coordination(s),))  # for a browser, in three dimensions too
write("picture.xyz", s)  # OVITO, ASE
write("picture.vtp", s)  # ParaView: filter Glyph, sphere, scale by diameter
write_contacts("picture-forces.vtp", s)  # filter Tube, vary radius by force
write_contacts("picture-contacts.csv", s)  # spreadsheets
println(info(s).n, " disks, ", length(forces(s)), " forces, ", count(rattlers(s)), " rattlers")
