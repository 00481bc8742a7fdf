# SPDX-License-Identifier: GPL-3.0-or-later
# bash completion for trueflank
_trueflank() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "check fix make new search shifts loop compare help --help --version" -- "$word")
    return
  fi
  case $before in
    --kind) mapfile -t COMPREPLY < <(compgen -W "3k stepped simple two-stage pair gear" -- "$word"); return ;;
    --gear | --part)
      mapfile -t COMPREPLY < <(compgen -W "sun planet planet1 ring1 planet2 ring2 ring pinion wheel gear carrier carrier_top carrier_pin" -- "$word")
      return ;;
    --formats)
      # a list with commas: the last of it is completed
      local head=""
      [[ $word == *,* ]] && head="${word%,*},"
      mapfile -t COMPREPLY < <(compgen -P "$head" -W "stl 3mf obj ply glb step dxf svg scad pdf png apng" -- "${word##*,}")
      return ;;
    --step-schema) mapfile -t COMPREPLY < <(compgen -W "ap214 ap242" -- "$word"); return ;;
    help) mapfile -t COMPREPLY < <(compgen -W "check fix make new search shifts loop compare" -- "$word"); return ;;
    -o | --output) mapfile -t COMPREPLY < <(compgen -d -- "$word"); return ;;
  esac
  if [[ $word == -* ]]; then
    local options="--help --quiet"
    case $command in
      check) options+=" --json --html --tolerance --material --materials --process --pictures --verbose" ;;
      make) options+=" -o --output --formats --tolerance-um --step-schema --part --correct --materials --process --compensate --kerf-mm --allow-failing --verbose" ;;
      fix) options+=" -o --output --warnings" ;;
      new) options="--help --kind --ratio --input --output --motor --process --material --tools --bed --outer-diameter" ;;
      search) options+=" -o --output --threads --materials --resume --shard --merge" ;;
      shifts) options+=" --teeth -o --output --points" ;;
      loop) options+=" -o --output --gear --aligned --effects" ;;
      compare) options+=" --tolerance-um --json --picture" ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
    return
  fi
  [[ $command == new ]] || mapfile -t COMPREPLY < <(compgen -f -- "$word")
}
complete -o filenames -F _trueflank trueflank
