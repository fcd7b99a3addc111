#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Plants one mistake after the other in an otherwise clean little site: site_check.sh, documents.py
# and facts.py must accept the clean one and must name each mistake.
set -euo pipefail

here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

clean_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree"/{docs,scripts,src,configs,tests/docs}
    cp "$here/../../scripts/site_hook.py" "$tree/scripts/"
    cp "$here/documents.py" "$tree/tests/docs/"
    echo 'int a;' >"$tree/src/a.cpp"
    printf '%s\n' '# Front' '' '[page](docs/page.md#part), `run` and [source](src/a.cpp)' >"$tree/README.md"
    printf '%s\n' '# All pages' '' '* **Start**: [all](pages.md), [page](page.md), [changes](../CHANGELOG.md).' \
        >"$tree/docs/pages.md"
    echo '# Changes' >"$tree/CHANGELOG.md"
    printf '# Page\n\n## Part\n\n[source](../src/a.cpp) [folder](../src) [front](../README.md)\n' >"$tree/docs/page.md"
    printf '%s\n' 'site_name: test' 'use_directory_urls: false' 'hooks: [scripts/site_hook.py]' \
        'theme: {name: material, font: false}' >"$tree/mkdocs.yml"
}

# finds FILE TEXT REASON: after TEXT is appended to FILE, the check must fail and say REASON.
finds() {
    local file=$1 text=$2 reason=$3 output
    clean_tree
    printf '%s\n' "$text" >>"$tree/$file"
    if output=$("$here/site_check.sh" "$tree" 2>&1) || ! grep -qF "$reason" <<<"$output"; then
        echo "site_check.sh missed '$text' in $file; it said: $output"
        failures=$((failures + 1))
    fi
}

# A program with one command and one option that prints two lines.
program() {
    cat >"$tree/degs" <<'END'
#!/usr/bin/env bash
case "$*" in
    --help) printf 'Subcommands:\n  run    runs\n' ;;
    'run --help') printf '  --set TEXT  sets\n' ;;
    run*) printf 'one\nhost 3 s\n' ;;
    *) exit 2 ;;
esac
END
    chmod +x "$tree/degs"
}

# finds_command REASON LINES...: a page of LINES must fail and say REASON; without REASON it must
# pass.
finds_command() {
    local reason=$1 output
    shift
    clean_tree
    program
    printf '%s\n' "$@" >"$tree/docs/page.md"
    if output=$(/usr/bin/python3 "$tree/tests/docs/documents.py" "$tree/degs" 2>&1); then
        [[ -n $reason ]] || return 0
    elif [[ -n $reason ]] && grep -qF "$reason" <<<"$output"; then
        return 0
    fi
    echo "documents.py: expected '${reason:-no mistake}' for '$*'; it said: $output"
    failures=$((failures + 1))
}

clean_tree
"$here/site_check.sh" "$tree" || { echo "the clean site was rejected"; exit 1; }
finds docs/page.md '[gone](gone.md)' gone.md
finds docs/page.md '[gone](../src/gone.cpp)' gone.cpp
finds README.md '[gone](docs/page.md#gone)' 'names an anchor that does not exist'
finds docs/page.md '![far](https://example.org/a.png)' 'from another host'
finds docs/alone.md '# Alone' 'the navigation does not reach it'

# A page that only a sentence links is not in the list from which the navigation is made.
clean_tree
echo '# Alone' >"$tree/docs/alone.md"
sed -i '3s|$|, [alone](docs/alone.md)|' "$tree/README.md"
if output=$("$here/site_check.sh" "$tree" 2>&1) || ! grep -qF 'the navigation does not reach it' <<<"$output"; then
    echo "site_check.sh missed a page that README.md links outside of its list; it said: $output"
    failures=$((failures + 1))
fi
clean_tree
sed -i '/Start/d' "$tree/docs/pages.md"
if output=$("$here/site_check.sh" "$tree" 2>&1) || ! grep -qF 'docs/pages.md needs groups of pages' <<<"$output"; then
    echo "site_check.sh missed a docs/pages.md without a list of pages; it said: $output"
    failures=$((failures + 1))
fi

finds_command '' '```console' '$ degs run' one 'host 5 s' '```' 'and `degs run --set a=b`'
finds_command '' '<!-- slow -->' '```sh' 'degs gone' '```'
finds_command '' '<!-- with NAME=run -->' '```sh' 'degs NAME' '```'
finds_command '' '<!-- file a.txt -->' '```text' hello '```' '' '```console' '$ cat a.txt' hello '```'
finds_command '' '<!-- output of: degs run -->' '' one 'host 7 s' '' more
finds_command 'exit code 2' '```sh' 'degs gone' '```'
finds_command 'page.md:2: the page shows other output' '```console' '$ degs run' two '```'
finds_command 'page.md:2: the page shows other output' '<!-- output of: degs run -->' '' two ''
finds_command "no command 'degs walk'" '`degs walk`'
finds_command 'no option --get' '`degs run a.yaml --get b`'
finds_command 'needs a fence' '    degs run'
finds_command '121 characters, 120 are allowed' "$(printf 'x%.0s' {1..121})"
finds_command '' "| $(printf 'x%.0s' {1..121}) |"
clean_tree
program
sed -i 's/`run` and //' "$tree/README.md"
if output=$(/usr/bin/python3 "$tree/tests/docs/documents.py" "$tree/degs" 2>&1) ||
    ! grep -qF 'README.md:1: the list of commands has no `run`' <<<"$output"; then
    echo "documents.py missed a command that README.md does not name; it said: $output"
    failures=$((failures + 1))
fi

# A repository of three baselines whose pages say what there is.
facts_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree"/{docs,sim/run,src/baselines/{gbu,gcc,gscore},tests/baselines}
    touch "$tree"/src/baselines/{gbu,gcc,gscore}/cost.cpp
    printf '%s\n' '# Front' '' 'GSCore, GBU and GCC.' >"$tree/README.md"
    printf '%s\n' '# Rooms' '' '`src/baselines`, `tests`, `docs`, and `run` of `sim`.' >"$tree/docs/architecture.md"
    printf '`degs config %s --keys own`\n' gbu gcc gscore >"$tree/docs/keys.md"
}

# finds_fact REASON TEXT [FILE]: after TEXT is appended to FILE, facts.py must fail and say REASON;
# without REASON it must pass.
finds_fact() {
    local reason=$1 text=$2 output
    facts_tree
    printf '\n%s\n' "$text" >>"$tree/${3:-docs/page.md}"
    check_facts "$reason" "$text"
}

check_facts() {
    local output
    if output=$(/usr/bin/python3 "$here/facts.py" "$tree" 2>&1); then
        [[ -n $1 ]] || return 0
    elif [[ -n $1 ]] && grep -qF "$1" <<<"$output"; then
        return 0
    fi
    echo "facts.py: expected '${1:-no mistake}' for '$2'; it said: $output"
    failures=$((failures + 1))
}

finds_fact '' 'GBU and GCC beside GSCore, two accelerators, and 100 random designs.'
finds_fact "a number that nobody counts again: 'Three published accelerators'" 'Three published accelerators'
finds_fact "a number that nobody counts again: '1 700 tests'" '1 700 tests'
finds_fact "a number that nobody counts again: 'all 20 designs'" 'all 20 designs'
finds_fact "it is modelled: 'GCC is not modelled'" 'a,GCC is not modelled' docs/published.csv
finds_fact "it is modelled: 'Energy and power are not modelled'" 'Energy and power are not modelled.'
finds_fact 'page.md:2: there is no src/modules/gone' 'See `src/modules/gone`.'
finds_fact "page.md:2: a page begins with a sentence that says what it answers: 'Source: a file'" 'Source: a file'
finds_fact "page.md:2: a page begins with a sentence" '| a | table |'
finds_fact '' 'A sentence, and then a table.

| a | table |'
finds_fact '' 'The test `docs/figures` and `src/baselines/*/cost.cpp`.'
finds_fact 'links cost.cpp of gbu, gcc, but not of gscore' \
    '[GBU](../src/baselines/gbu/cost.cpp), [GCC](../src/baselines/gcc/cost.cpp)'
facts_tree
mkdir -p "$tree"/src/baselines/orange "$tree/sim/walk" "$tree/src/gone" "$tree/more"
echo 'ORANGE is new.' >>"$tree/README.md"
check_facts 'README.md:3: a list of accelerators without ORANGE' 'a new accelerator'
check_facts 'keys.md:1: there is no table of orange' 'a new accelerator'
check_facts 'architecture.md:1: the table of rooms has no `walk` of sim' 'a new folder of sim'
check_facts 'architecture.md:1: the table of rooms has no `src/gone`' 'a new room'
check_facts 'architecture.md:1: the table of rooms has no `more`' 'a new folder'
check_facts 'architecture.md:1: tests has no folder for src/gone' 'a room without tests'
facts_tree
mkdir -p "$tree/src/baselines/orange"
printf '%s\n' '`degs config orange --keys own`' >>"$tree/docs/keys.md"
printf '\nORANGE is new.\n\n<!-- without ORANGE: not in Table I -->\n\nGSCore, GBU and GCC.\n' >>"$tree/README.md"
sed -i '3s/GSCore, GBU and GCC/GSCore, GBU, GCC and ORANGE/' "$tree/README.md"
check_facts '' 'a list with a reason'
[[ $failures -eq 0 ]] || exit 1
echo "documents self-test: every planted mistake was found"
