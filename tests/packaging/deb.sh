#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# deb.sh BUILD: makes the packages of Debian from a build and tries them as a user would who has
# nothing else: what they need is there, they share no file, and together they have all that the
# components of the build install; the program and the Python package run from their files alone.
set -euo pipefail

build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# quietly COMMAND...: shows what the command says only if it fails.
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; return 1; }; }

quietly cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work/made"
mkdir "$work/debs"
mv "$work"/made/*.deb "$work/debs"
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:[A-Z]*=//p' "$build/CMakeCache.txt")
names=(degs degs-common libdegs-dev libdegs-kit-dev python3-degs)
for name in "${names[@]}"; do
    deb=("$work/debs/${name}_${version}_"*.deb)
    [[ -f ${deb[0]} ]] || { echo "there is no package $name of version $version:"; ls "$work/debs"; exit 1; }
    dpkg-deb --fsys-tarfile "${deb[0]}" | tar -t | grep -v '/$' | sed 's,^\./,,' | sort >"$work/$name.files"
    grep -qx "usr/share/doc/$name/copyright" "$work/$name.files" || { echo "$name has no copyright"; exit 1; }
    quietly dpkg-deb -x "${deb[0]}" "$work/root"
done
[[ $(find "$work/debs" -name '*.deb' | wc -l) == "${#names[@]}" ]] || { ls "$work/debs"; exit 1; }

# All that they need is known, and what the program is linked with is among it.
quietly apt-get -s install --no-install-recommends "$work"/debs/*.deb
for name in "${names[@]}"; do
    grep -q "^Inst $name (" "$work/log" || { echo "$name would not be installed:"; cat "$work/log"; exit 1; }
done
field() { dpkg-deb -f "$work/debs/$1"_*.deb "$2"; }
for library in libc6 libhwy1 libjemalloc2 libsystemc libopenexr-3 libtinygltf libyaml-cpp0; do
    [[ $(field degs Depends) == *"$library"* ]] || { echo "degs does not depend on $library: $(field degs Depends)"; exit 1; }
done
# The libraries ask for what the CMake package of the build looks for, indented for the component.
# looked_for INDENT: the names.
looked_for() {
    sed -n "s/^$1find_dependency(\([A-Za-z_-]*\).*/\1/p; s/^$1foreach(library \(.*\))/\1/p" "$build/degsConfig.cmake" |
        tr ' ' '\n' | tr '[:upper:]' '[:lower:]' | grep -v threads
}
# depends PACKAGE: whether it depends on what is read.
depends() {
    while read -r needed; do
        [[ $(field "$1" Depends | tr -d -) == *"${needed//[-_]/}"* ]] || { echo "$1 does not depend on $needed"; exit 1; }
    done
}
{ looked_for '' && printf '%s\n' systemc glm; } | depends libdegs-dev
[[ $(looked_for '        ' | wc -l) -ge 3 ]] || { echo "degsConfig.cmake looks for nothing more for the component kit"; exit 1; }
looked_for '        ' | depends libdegs-kit-dev
[[ $(field libdegs-kit-dev Depends) == *"libdegs-dev (= $version)"* ]]
[[ $(field python3-degs Recommends) == python3-tqdm ]]

# Every file is in one package, and those that the components install are all there.
twice=$(sort "$work"/*.files | uniq -d)
[[ ! $twice ]] || { echo "in several packages:" "$twice"; exit 1; }
for component in degs kit program python; do
    quietly cmake --install "$build" --prefix "$work/prefix/usr" --component "$component"
done
(cd "$work/prefix" && find usr ! -type d) | sed 's,^usr/share/degs/python/,usr/lib/python3/dist-packages/,' | sort >"$work/installed"
missing=$(sort "$work"/*.files | grep -v '^usr/share/doc/' | comm -3 - "$work/installed")
[[ ! $missing ]] || { echo "only in the packages, or only in an installation:" "$missing"; exit 1; }
rm -r "$work/prefix"

# The scene of the quickstart, and a run from Python.
cd "$work"
configs=$work/root/usr/share/degs/configs
alone=(env -i PATH=/usr/bin:/bin HOME="$work" DEGS_CACHE=)
quietly "${alone[@]}" root/usr/bin/degs run "$configs/degs-64.yaml" --scene synthetic:lighthouse --out quick
for file in image.png image.exr report.json; do
    [[ -s quick/$file ]] || { echo "the run left no $file"; exit 1; }
done
"${alone[@]}" PYTHONPATH="$work/root/usr/lib/python3/dist-packages" /usr/bin/python3 - "$work/root/usr" <<'END'
import sys
import degs

assert degs.__file__.startswith(sys.argv[1]), degs.__file__
result = degs.run("degs-64", scene="synthetic:object,gaussians=500", camera=1, width=160)
assert result.cycles > 0, result
END
