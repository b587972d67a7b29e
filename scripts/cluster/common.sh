# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# What the scripts of this folder share: the plan of a run, and where its parts lie. docs/scale.md describes the folder of a run.

program=$(basename -- "$0")
cluster=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")" && pwd)

fail() {
    echo "$program: error: $*" >&2
    exit 1
}

# Prints the comment at the top of a script as its help text.
print_help() {
    sed -n '3,/^[^#]/{s/^# \{0,1\}//p}' "$1"
    exit 0
}

# whole NAME WORD LOW HIGH: checks a number of the command line.
whole() {
    if [[ $2 =~ ^(0|[1-9][0-9]{0,6})$ ]] && (($2 >= $3 && $2 <= $4)); then return; fi
    fail "$1: '$2' is not valid; give a whole number from $3 to $4"
}

# Sets tool, shards, attempts, bin, out and options from the command line, and what is left to `others`:
# plan_options NAME... -- "$@", where NAME are options of the script itself, which have one value each.
plan_options() {
    tool="" shards="" attempts=3 bin="" out=""
    options=()
    declare -gA others=()
    local own=()
    while [[ $1 != -- ]]; do own+=("$1") && shift; done
    shift
    while (($#)); do
        case $1 in
        --help | -h) print_help "$0" ;;
        --) options=("${@:2}") && return ;;
        esac
        (($# > 1)) || fail "$1 needs a value; $program --help lists the options"
        case $1 in
        --tool) tool=$2 ;;
        --shards) shards=$2 ;;
        --attempts) attempts=$2 ;;
        --bin) bin=$2 ;;
        --out) out=$2 ;;
        *)
            [[ " ${own[*]} " == *" $1 "* ]] || fail "'$1' is no option; $program --help lists them"
            # shellcheck disable=SC2034 # of the script
            others[${1#--}]=$2
            ;;
        esac
        shift 2
    done
}

check_plan() {
    case $tool in
    conformance | accuracy | reference | bake) ;;
    *) fail "--tool: '$tool' is not valid; give conformance, accuracy, reference or bake" ;;
    esac
    whole --shards "$shards" 1 10000
    whole --attempts "$attempts" 1 100
    if [[ -z $bin ]]; then bin=$(readlink -f -- "$cluster/../..")/build/release/bin; fi
    [[ -x $bin/filament-$tool ]] || fail "--bin: there is no program '$bin/filament-$tool'; give the folder of the programs"
    bin=$(realpath -- "$bin")
}

# Writes the plan into the folder of the run, or checks that it is the one that is there.
write_plan() {
    check_plan
    mkdir -p -- "$out"/{shards,attempts,failed,logs} || fail "--out: '$out' cannot be written; give another folder"
    local new
    new=$(mktemp -- "$out/plan.XXXXXX")
    {
        printf '%s\0' "$tool" "$shards" "$attempts" "$bin"
        ((${#options[@]} == 0)) || printf '%s\0' "${options[@]}"
    } >"$new"
    if ! ln -- "$new" "$out/plan" 2>/dev/null && ! cmp -s -- "$new" "$out/plan"; then
        rm -f -- "$new"
        fail "--out: '$out' has the shards of another run; give its options, or another folder"
    fi
    rm -f -- "$new"
}

read_plan() {
    [[ -n $out ]] || fail "--out: give the folder of the run"
    [[ -f $out/plan ]] || fail "--out: '$out' has no plan; begin with submit, or give --tool and --shards"
    mapfile -d '' -t options <"$out/plan"
    ((${#options[@]} >= 4)) || fail "'$out/plan' is damaged; give another folder"
    tool=${options[0]} shards=${options[1]} attempts=${options[2]} bin=${options[3]}
    options=("${options[@]:4}")
    check_plan
}

# The file without which a shard is not complete.
shard_file() {
    case $tool in
    reference) echo part.film ;;
    bake) echo bake.part ;;
    *) echo results.json ;;
    esac
}

# attempts_of SHARD: how often it was begun.
attempts_of() {
    local count=0
    if [[ -f $out/attempts/$1 ]]; then count=$(wc -l <"$out/attempts/$1"); fi
    echo "$count"
}
