# SPDX-License-Identifier: MIT
# Bash completion: commands, and after them scenes, claims, renderers and formats.
_threefold() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words=
    # The indented first words under a heading of `threefold list`.
    _threefold_names() { threefold list 2> /dev/null | awk -v heading="$1" '/^[A-Z]/ { on = $1 == heading } on && /^  / { print $1 }'; }
    if [ "$COMP_CWORD" -eq 1 ]; then
        words="$(threefold --help 2> /dev/null | awk '/^[A-Z]/ { on = /^Subcommands/ } on && /^  [a-z]/ { print $1 }') --help --version"
    else
        case $before in
        --with) words="tracer povray cycles" ;;
        --to) words="blender povray glb obj mitsuba stmap" ;;
        --preset) words="text published" ;;
        --precision) words="float double" ;;
        --transport) words="tree roulette" ;;
        -o | --output | --json | --junit | --keep | --mitsuba | --markdown) COMPREPLY=($(compgen -f -- "$word")); return ;;
        *)
            case $word in
            -*) words=$(threefold "$command" --help 2> /dev/null | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+') ;;
            *)
                case $command in
                show | render | export) words=$(_threefold_names Scenes) ;;
                check) words=$(_threefold_names Claims) ;;
                *) COMPREPLY=($(compgen -f -- "$word")); return ;;
                esac
                ;;
            esac
            ;;
        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _threefold threefold
