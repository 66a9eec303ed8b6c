#!/bin/sh
# The studies of the thesis at its size, one after the other: sh campaign.sh FOLDER [PARTICLES]. Packings and runs stay
# in FOLDER (about 3 GB), so a campaign that was stopped goes on where it was. Each study writes its results into
# FOLDER/out; with --update in place of --out they go into the checkout. Processor hours are those of one core.
# PARTICLES (default 2.2e6) is the number of spheres of each size in the ensembles.
set -eu
folder=${1:?usage: campaign.sh FOLDER [PARTICLES]}
particles=${2:-2.2e6}
cd "$(dirname "$0")"
study() { nice -n 19 python3 "$@" --folder "$folder" --out "$folder/out"; }
study motion_md.py --runs 5000 --long-runs 1000      # 3.4 to 3.10, 3.15, 3.16, 3.21, 3.22: 0.3 h, and 7 h of long runs
study motion_mc.py --large                           # 3.11 to 3.14, 3.17: 0.4 h
study network_products.py --large                    # 3.3: 0.3 h
study motion_packings.py --large                     # 3.14
study growth_panels.py --slow                        # 2.6, 2.8 to 2.11, 2.13, 2.15: 1 h; --large 10 h
study path_to_jamming.py --large                     # 2.8, 2.9, 2.14, 2.16: 5 h
study lp_noise.py --large                            # 2.9, 2.14: a minute
sizes="256 512 1024 2048 4096"
for model in euclid mk; do                           # 4.1 to 4.19: 10 h and 9 h
  # shellcheck disable=SC2086
  for script in finite_size.py finite_size_panels.py; do
    study $script --model $model --large --particles "$particles" --sizes $sizes
  done
done
