# Completion of jam-pack for bash: made by bindings/gen/generate.py from bindings/gen/options.py; do not edit.
_jam_pack() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} takes='--n --dim --phi0 --diameters-ratio --sizes --least-distance --non-additivity --model --zeta --plant --seed --input --frame --box --cell --origin --columns --tile --walls --container --shrink --shrink-min --nve --growth --pressure --packing-fraction --porosity --no-md --checkpoint --checkpoint-every --resume --method --strain --lp --duality-gap --threads --radii --no-crunch --to --mode --stress --step --resolution --until --alpha --rows --output --scale --density --page --page-steps --contacts --spectrum --modes --gaps --structure --prove --proof --strict-proof --strict --report --log --vtk --json --quiet --stl --stl-edge --stl-shrink --stl-bridge --stl-bridge-gap --stl-walls --voxels --voxel-size --voxel-lines --profile --profile-bins --pores --pore-points --pore-seed --near-coordination --contact-gap --near-gap --wall-time --help --version'
  COMPREPLY=()
  case $before in
    --model) COMPREPLY=($(compgen -W 'euclid mk' -- "$word")); return ;;
    --walls) COMPREPLY=($(compgen -W 'none x y xy z xz yz xyz' -- "$word")); return ;;
    --container) COMPREPLY=($(compgen -W 'brick cylinder ball cone' -- "$word")); return ;;
    --method) COMPREPLY=($(compgen -W 'barrier sequential-lp' -- "$word")); return ;;
    --strain) COMPREPLY=($(compgen -W 'none edges tilts free' -- "$word")); return ;;
    --lp) COMPREPLY=($(compgen -W 'ipm clp' -- "$word")); return ;;
    --until) COMPREPLY=($(compgen -W 'strain event jammed unjammed' -- "$word")); return ;;
    --sizes|--input|--checkpoint|--resume|--rows|--output|--page|--contacts|--spectrum|--gaps|--structure|--proof|--strict-proof|--report|--log|--stl|--stl-walls|--voxels|--profile|--pores|--near-coordination) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --n|--dim|--phi0|--diameters-ratio|--least-distance|--non-additivity|--zeta|--plant|--seed|--frame|--box|--cell|--origin|--columns|--tile|--shrink-min|--nve|--growth|--pressure|--packing-fraction|--porosity|--checkpoint-every|--duality-gap|--threads|--radii|--to|--mode|--stress|--step|--resolution|--alpha|--scale|--density|--page-steps|--modes|--vtk|--stl-edge|--stl-shrink|--stl-bridge|--stl-bridge-gap|--voxel-size|--voxel-lines|--profile-bins|--pore-points|--pore-seed|--contact-gap|--near-gap|--wall-time) return ;;
  esac
  case ${COMP_WORDS[1]} in
    compress) takes='--n --dim --phi0 --diameters-ratio --sizes --least-distance --non-additivity --model --zeta --plant --seed --input --frame --box --cell --origin --columns --tile --walls --container --shrink --shrink-min --nve --growth --pressure --packing-fraction --porosity --checkpoint --checkpoint-every --resume --output --page --report --log --json --quiet --wall-time --help --version' ;;
    crunch) takes='--non-additivity --model --zeta --seed --input --frame --box --cell --origin --columns --tile --walls --container --shrink --shrink-min --checkpoint --checkpoint-every --resume --method --strain --lp --duality-gap --threads --radii --output --page --page-steps --contacts --spectrum --modes --gaps --structure --prove --proof --strict-proof --report --log --vtk --json --quiet --wall-time --help --version' ;;
    shear) takes='--non-additivity --input --frame --box --cell --origin --columns --tile --walls --container --shrink --shrink-min --checkpoint --checkpoint-every --resume --to --mode --stress --step --resolution --until --alpha --rows --output --page --contacts --report --log --json --quiet --wall-time --help --version' ;;
    check) takes='--non-additivity --input --frame --box --cell --origin --columns --tile --walls --container --prove --proof --strict-proof --strict --json --quiet --wall-time --help --version' ;;
    info) takes='--non-additivity --input --frame --box --cell --origin --columns --tile --walls --container --json --quiet --wall-time --help --version' ;;
    export) takes='--non-additivity --input --frame --box --cell --origin --columns --tile --walls --container --output --scale --density --contacts --spectrum --modes --gaps --structure --vtk --json --quiet --stl --stl-edge --stl-shrink --stl-bridge --stl-bridge-gap --stl-walls --voxels --voxel-size --voxel-lines --profile --profile-bins --pores --pore-points --pore-seed --near-coordination --contact-gap --near-gap --wall-time --help --version' ;;
    page) takes='--non-additivity --input --frame --box --cell --origin --columns --tile --walls --container --page --json --quiet --contact-gap --wall-time --help --version' ;;
    ensemble) takes='--help --version' ;;
    search) takes='--help --version' ;;
  esac
  if [ "$COMP_CWORD" = 1 ]; then takes="pack compress crunch shear check info export page ensemble search $takes"; fi
  case $word in
    -*) COMPREPLY=($(compgen -W "$takes" -- "$word")) ;;
    *) COMPREPLY=($(compgen -W "$takes" -- "$word") $(compgen -f -- "$word")) ;;
  esac
}
complete -o filenames -F _jam_pack jam-pack
