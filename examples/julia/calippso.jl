# The linear programs of CALiPPSO.jl and ours, side by side from one file.  usage: calippso.jl START.dat [THEIRS.txt [L0]]
#
# START.dat: d, N and the diameter in the first three lines, then one line of coordinates per sphere (both programs read this).
# THEIRS.txt: a line for each LP with sqrt(Gamma), the largest displacement and whether it was isostatic, which CALiPPSO
# returns. It is made where CALiPPSO.jl (https://github.com/rdhr/CALiPPSO.jl) is installed:
#
#     using CALiPPSO, DelimitedFiles
#     sigma = readdlm("START.dat", skipstart = 2)[1, 1]
#     X = Matrix(readdlm("START.dat", skipstart = 3)')
#     _, _, gamma, smax, isostatic = produce_jammed_configuration!(X, sigma / 2, 1.0; ℓ0 = L0)
#     writedlm("THEIRS.txt", [gamma smax isostatic])
#
# Without THEIRS.txt the columns stay empty. L0 is their radius of influence, 2 diameters by default, as there.
using DelimitedFiles, Jam, Printf

isempty(ARGS) && error("usage: calippso.jl START.dat [THEIRS.txt [L0]]")
theirs = length(ARGS) > 1 ? readdlm(ARGS[2]) : zeros(0, 3)
staged = Jam.read(ARGS[1])  # their stages, solved by libjam
l0 = length(ARGS) > 2 ? parse(Float64, ARGS[3]) : 2 * info(staged).diameter_mean
ours = calippso!(staged; l0 = l0)

println("                 CALiPPSO                           libjam, the same stages")
println("  LP   sqrt(G)-1   max |s|  isostatic   sqrt(G)-1   max |s|  excess   pairs         phi")
for k in 1:max(size(theirs, 1), length(ours))
    left = k > size(theirs, 1) ? " "^32 : @sprintf("%10.2e %9.2e %9s", theirs[k, 1] - 1, theirs[k, 2], theirs[k, 3])
    right = k > length(ours) ? "" :
            @sprintf("%10.2e %9.2e %7d %7d %.12f", ours[k].gain, ours[k].step_max, ours[k].excess, ours[k].pairs, ours[k].phi)
    @printf("%4d  %s  %s\n", k, rpad(left, 32), right)
end
# Their max |s| is that of one component, ours of the whole displacement: up to sqrt(d) times as large.

end_of_stages = crunch!(staged)  # contacts, forces and the certificate
path = Jam.read(ARGS[1])
default = crunch!(path)
for (name, r, s) in (("their stages", end_of_stages, staged), ("barrier path", default, path))
    println(name, ": phi_J ", r.packing_fraction, ", jammed ", r.jammed, ", ", r.contacts, " contacts, excess ", r.excess_contacts,
            ", force imbalance ", r.force_residual)
end
both = compare(staged, path)
println("contacts in common: ", both.comparison.common_contacts, " of ", both.comparison.contacts_a, " and ", both.comparison.contacts_b)
