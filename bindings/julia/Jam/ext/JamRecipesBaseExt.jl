# `plot(s)` of a packing, once Plots or another user of RecipesBase is loaded (Julia 1.9 and later).
module JamRecipesBaseExt

using Jam, RecipesBase

RecipesBase.@recipe function f(s::Jam.System; forces = true)
    d = Jam.info(s).dim
    d in (2, 3) || throw(ArgumentError("plots are of d = 2 or d = 3, this packing has d = $d"))
    legend --> false
    aspect_ratio --> :equal
    classes = Jam.by_class(s)
    for (colour, spheres) in classes
        isempty(spheres) && continue
        @series begin
            if d == 2
                seriestype := :shape
                fillcolor := colour
                linewidth := 0
                Jam.outlines(s, spheres)
            else
                seriestype := :scatter3d
                markercolor := colour
                markerstrokewidth := 0
                markersize --> 3
                Tuple(Jam.positions(s)[c, spheres] for c in 1:3)
            end
        end
    end
    if forces && Jam.network_of(s) !== nothing
        @series begin
            seriestype := (d == 2 ? :path : :path3d)
            linecolor := "#222222"
            linewidth --> 0.5
            Jam.bonds(s)
        end
    end
end

end # module
