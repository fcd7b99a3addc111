#!/usr/bin/env zsh
# SPDX-License-Identifier: Apache-2.0
# zsh_completion.zsh PROGRAM: reads the completion that the program prints into an interactive zsh, presses the tab key
# behind several lines, and compares what zsh offers.
emulate -L zsh
zmodload zsh/zpty || exit 1

program=${1:A}
work=$(mktemp -d)
trap 'rm -rf $work' EXIT
mkdir $work/functions $work/files $work/files/folder
touch $work/files/garden.ply $work/files/design.yaml
$program help --zsh-completion >$work/functions/_degs || exit 1
zsh -n $work/functions/_degs || exit 1

# The shell that is watched: every match goes to a file, and "done" when all have been offered.
cat >$work/setup.zsh <<SETUP
PS1= fpath=($work/functions \$fpath)
autoload -Uz compinit
compinit -u -d $work/dump
cd $work/files
offered() { print done >>$work/offered; }
comppostfuncs=(offered)
zstyle ':completion:*' completer _complete
compadd() {
    if [[ \${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
        builtin compadd "\$@"
        return
    fi
    local -a matches
    builtin compadd -A matches "\$@"
    print -rl -- \$matches >>$work/offered
    builtin compadd "\$@"
}
setopt no_beep no_always_last_prompt
bindkey '^I' list-choices
print -r -- ready >$work/ready
SETUP

# offers LINE: the sorted matches behind it.
offers() {
    rm -f $work/offered $work/ready
    zpty shell TERM=dumb zsh -f -i
    zpty -w shell "source $work/setup.zsh"
    local i
    for ((i = 0; i < 200; i++)); do
        [[ -e $work/ready ]] && break
        sleep 0.05
    done
    zpty -n -w shell "$1"$'\t'
    for ((i = 0; i < 200; i++)); do
        [[ -e $work/offered ]] && grep -q '^done$' $work/offered && break
        zpty -r -t shell >/dev/null
        sleep 0.05
    done
    zpty -d shell
    grep -v -e '^done$' -e '^$' $work/offered | sort -u | tr '\n' ' '
}

failed=0
expect() {
    local got=$(offers $1)
    [[ $got == "$2 " ]] || { print -r -- "'$1' was completed to '$got' instead of '$2'"; failed=1; }
}

expect 'degs re' 'registers render'
expect 'degs co' 'compare config'
expect 'degs scene ' 'cameras convert generate info tile'
expect 'degs run --came' '--camera --camera-file --cameras'
expect 'degs run --fidelity ' 'analytic exact strict'
expect 'degs scene info x.ply --wi' '--width'
expect 'degs help me' 'memory'
expect 'degs run --views 0,1 --came' '--camera-file'
expect 'degs run --trace t --fidelity ' 'exact strict'
expect 'degs run --fidelity sampled:1% --m' '--memory'
expect 'degs run --frames 1 --wit' '--within'
expect 'degs run --scene synthetic:ob' 'synthetic:object'
expect 'degs run --scene gar' 'garden.ply'
expect 'degs run des' 'design.yaml'
expect 'degs run --out ' 'folder'
exit $failed
