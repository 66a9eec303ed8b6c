#!/bin/sh
# The studies of the thesis at its size, one after the other: sh campaign.sh FOLDER [PARTICLES]. Packings and runs stay
# in FOLDER (about 3 GB), so a campaign that was stopped goes on where it was. Each study writes its results into
# FOLDER/out; with --update in place of --out they go into the checkout. Processor hours are those of one core.
# PARTICLES (default 2.2e6) is the number of spheres of each size in the ensembles.
set -eu
folder=${1:?usage: campaign.sh FOLDER [PARTICLES]}
particles=${2:-2.2e6}
mkdir -p "$folder/out"
folder=$(cd "$folder" && pwd)
cd "$(dirname "$0")"
study() {
  case $1 in
    ../*) nice -n 19 python3 "$@" ;;
    *) nice -n 19 python3 "$@" --folder "$folder" --out "$folder/out" ;;
  esac
}
study mk_glass.py --large                            # 2.6: 0.05 h
study fit_error.py --large                           # 2.11, 2.12: 0.15 h
study density_by_size.py --large                     # 2.8: 0.1 h
study lp_noise.py --large                            # 2.9, 2.14: a minute
study motion_mc.py --large                           # 3.11 to 3.15, 3.17: 0.3 h
study network_products.py --large                    # 3.3: 0.3 h
study ../gap_plateau.py "$folder/out/gap_plateau.png" --large \
  --result "$folder/out/results.json#gap_plateau"    # 2.7: 0.4 h
study final_network.py --large                       # the pressure of the final network: 0.2 h, to N = 1024
study localised_modes.py --large                     # its modes, and near-crystals: 0.1 h
study thermodynamics.py --large                      # the crystal, entropy near jamming: a minute
study correlated_motion.py --large                   # chi_4, G_4: 0.3 h
study duals_below.py --large                         # duals below jamming: 0.2 h
study motion_md.py --runs 5000 --long-runs 1000      # 3.4 to 3.10, 3.15, 3.16, 3.21, 3.22: 0.3 h, and 7 h of long runs
study motion_packings.py --large                     # 3.14
study growth_panels.py --slow                        # 2.8 to 2.10, 2.13, 2.15: 1 h; --large 10 h
study path_to_jamming.py --large                     # 2.8, 2.9, 2.14, 2.16: 5 h
sizes="256 512 1024 2048 4096"
for model in euclid mk; do                           # 4.1 to 4.19: 10 h and 9 h
  # shellcheck disable=SC2086
  for script in finite_size.py finite_size_panels.py; do
    study $script --model $model --large --particles "$particles" --sizes $sizes
  done
done
