# Runs from one configuration: means are those of the runs that were kept.
s = disks()
runs = isoconf(s, [1, 4]; runs = 20, density_ratio = 0.995, kept = 1:2)
@test runs.report.runs == 20 && size(runs.displacement) == (2, 60, 2) && size(runs.propensity) == (60, 2)
kept = isoconf_kept(s, 2)
@test size(kept) == (2, 60, 20)
@test sum(kept; dims = 3)[:, :, 1] ./ 20 ≈ runs.displacement[:, :, 2]
@test sum(sum(abs2, kept; dims = 1); dims = 3)[1, :, 1] ./ 20 ≈ runs.propensity[:, 2]
@test sum(runs.propensity[:, 2]) / 60 ≈ runs.msd[2]
p = predictors(s)
@test size(p.c) == (2, 60) && sum(p.force_sum) ≈ 2 * length(forces(s))
k = correlations(runs, p; rattlers = false)
@test length(k.c) == 2 && all(x -> -1 <= x <= 1, k.s)
mc = isoconf(s, [2, 5]; runs = 4, density_ratio = 0.99, monte_carlo = (step = 0.01,))
@test 0 < mc.report.acceptance <= 1
@test spearman([1, 2, 3], [3, 2, 1]) == -1 && spearman([1, 1, 2], [5, 5, 9]) ≈ 1
