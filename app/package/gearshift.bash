# bash completion for gearshift: verbs, their options, and the names of lessons, cars, gates and presets. The program's own
# help is the list, so this file never lags behind.
_gearshift_names() { # takes a kind: lessons, cars, gates or presets
    local program folder
    program=$(readlink -f "$(command -v "${COMP_WORDS[0]}")") || return
    for folder in "${program%/*}/../share/gearshift/assets/$1" "${program%/*}/../../../assets/$1"; do
        [ -d "$folder" ] && (cd "$folder" && printf '%s\n' *.toml | sed 's/\.toml$//')
    done
}
_gearshift() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]} words=
    if [ "$COMP_CWORD" -eq 1 ] || { [ "$COMP_CWORD" -eq 2 ] && [ "$verb" = help ]; }; then
        words="help $("${COMP_WORDS[0]}" --help 2>/dev/null | sed -n '/^Verbs:/,$s/^  \([a-z][a-z]*\) .*/\1/p')"
    else
        case $before in
        --lesson | lesson) words=$(_gearshift_names lessons) ;;
        --car) words="none $(_gearshift_names cars)" ;;
        --gate | gate) words=$(_gearshift_names gates) ;;
        --preset | parameters) words=$(_gearshift_names presets) ;;
        esac
        [[ $current == -* ]] && words=$("${COMP_WORDS[0]}" "$verb" --help 2>/dev/null | grep -o -- '--[a-z][a-z-]*')
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current" | sort -u)
}
complete -o default -F _gearshift gearshift
