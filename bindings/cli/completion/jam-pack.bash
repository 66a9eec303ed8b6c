# Completion of jam-pack for bash: made by bindings/gen/generate.py from bindings/gen/options.py; do not edit.
_jam_pack() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  case $before in
    --model) COMPREPLY=($(compgen -W 'euclid mk' -- "$word")); return ;;
    --walls) COMPREPLY=($(compgen -W 'none x y xy z xz yz xyz' -- "$word")); return ;;
    --container) COMPREPLY=($(compgen -W 'brick cylinder ball' -- "$word")); return ;;
    --method) COMPREPLY=($(compgen -W 'barrier sequential-lp' -- "$word")); return ;;
    --strain) COMPREPLY=($(compgen -W 'none edges tilts free' -- "$word")); return ;;
    --lp) COMPREPLY=($(compgen -W 'ipm clp' -- "$word")); return ;;
    --sizes|--input|--checkpoint|--resume|--output|--page|--contacts|--spectrum|--gaps|--structure|--proof|--report|--log) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --n|--dim|--phi0|--diameters-ratio|--non-additivity|--zeta|--plant|--seed|--frame|--box|--cell|--shrink-min|--nve|--growth|--pressure|--packing-fraction|--porosity|--checkpoint-every|--duality-gap|--threads|--page-steps|--modes|--vtk|--wall-time) return ;;
  esac
  COMPREPLY=($(compgen -W '--n --dim --phi0 --diameters-ratio --sizes --non-additivity --model --zeta --plant --seed --input --frame --box --cell --walls --container --shrink --shrink-min --nve --growth --pressure --packing-fraction --porosity --no-md --checkpoint --checkpoint-every --resume --method --strain --lp --duality-gap --threads --no-crunch --output --page --page-steps --contacts --spectrum --modes --gaps --structure --prove --proof --report --log --vtk --quiet --wall-time --help --version' -- "$word"))
}
complete -o filenames -F _jam_pack jam-pack
