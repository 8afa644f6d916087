#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# unpacked_test.sh SOURCE BUILD WORK: packs BUILD as a .deb, unpacks it into WORK and uses it there.
set -euo pipefail
source=$1 build=$2 work=$3
root=$work/root

fail() {
    echo "unpacked_test.sh: $*" >&2
    exit 1
}

rm -rf "$work"
mkdir -p "$work"
cd "$work"
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work/packed" >cpack.log ||
    fail "$(cat cpack.log)"
package=$(ls packed/icesolve_*.deb)
python_package=$(ls packed/python3-icesolve_*.deb)
dpkg-deb -x "$package" "$root"

# what Debian's policy asks of any package
field() { dpkg-deb -f "$package" "$1"; }
for name in Package Version Architecture Maintainer Depends Description Section; do
    [[ -n $(field $name) ]] || fail "no $name in the control file"
done
[[ $(field Depends) == *libhdf5-103*libspdlog* ]] ||
    fail "dependencies lack libraries: $(field Depends)"
[[ $(field Depends) != *-dev* ]] || fail "the programs should not depend on development packages"
doc=$root/usr/share/doc/icesolve
[[ -f $doc/copyright ]] || fail "no copyright"
gzip -t "$doc/changelog.gz" "$doc/changelog.Debian.gz"
[[ $(field Maintainer) == *" <"*@*">" ]] || fail "no address in $(field Maintainer)"
[[ $(field Maintainer) != *example* ]] ||
    fail "a placeholder maintains the package: $(field Maintainer)"
if command -v lintian >/dev/null; then
    complaints=$(lintian --allow-root "$package" "$python_package" 2>/dev/null || true)
    [[ -z $complaints ]] || fail "lintian: $complaints"
fi
# the Python package: its own files only, and it needs the programs
[[ $(dpkg-deb -f "$python_package" Depends) == *"icesolve (="*python3-xarray* ]] ||
    fail "python3-icesolve lacks dependencies"
dpkg-deb -c "$python_package" |
    grep -F ./usr/lib/python3/dist-packages/icesolve/runs.py >/dev/null ||
    fail "python3-icesolve has no package"
if grep -q '^ICE_PYTHON_MODULE:BOOL=ON' "$build/CMakeCache.txt"; then
    dpkg-deb -c "$python_package" | grep -F /icesolve/_world. >/dev/null ||
        fail "python3-icesolve has no module"
fi
dpkg-deb -c "$package" | grep -F dist-packages >/dev/null &&
    fail "icesolve holds Python's package, too"
# what the documents link to, and the READMEs that they name, are beside them
while IFS=: read -r file link; do
    [[ -e $(dirname "$file")/$link ]] || fail "$file links to $link, which is not there"
done < <(cd "$doc" && grep -oE '\]\([^)#:]+\)' -r --include=*.md . |
    sed -E 's/\]\((.*)\)/\1/; s|^|'"$doc"'/|')
for name in $(grep -oE '`[a-z/]+/README.md`' "$doc/README.md" | tr -d '`'); do
    [[ $name == tests/* || -f $doc/$name ]] || fail "README.md names $name, which is not there"
done
[[ -z $(find "$root" -perm /o+w -not -type l) ]] || fail "files that anyone may write"
[[ -z $(find "$root" -name '*.spheres.h5' -o -name node_modules) ]] || fail "built files are packed"
grep -rqF "$build" "$root/usr/lib/"*/icesolve "$root/usr/lib/cmake" 2>/dev/null &&
    fail "the CMake configuration names the build folder"

# every page has examples and tells where to go on; what they name exists; nothing is ill-formed
for page in "$root"/usr/share/man/man?/*.gz; do
    [[ -z $(zcat "$page" | man --warnings -E UTF-8 -l -Tutf8 -Z - 2>&1 >/dev/null) ]] ||
        fail "$page is ill-formed"
    for part in NAME EXAMPLES 'SEE ALSO'; do
        [[ -n $(zcat "$page" | grep -E "^\.SH \"?$part") ]] || fail "$page has no $part"
    done
    for other in $(zcat "$page" |
        sed -nE 's/^\.BR ((ice|spherize)[a-z-]*) \(([15])\).*/\1.\3/p'); do
        [[ -f $root/usr/share/man/man${other##*.}/$other.gz ]] ||
            fail "$page names $other, which is not there"
    done
done
[[ $(find "$root"/usr/share/man -name '*.gz' | wc -l) -ge 14 ]] || fail "pages are missing"
for key in average_from crushing_pressure concentration breaking_length; do
    [[ -n $(zcat "$root"/usr/share/man/man5/*.gz | grep "^\.B $key") ]] ||
        fail "no page explains $key"
done

for program in spherize icefield iceflow icesolve icepost; do
    [[ -x $root/usr/bin/$program ]] || fail "no $program"
    [[ $("$root/usr/bin/$program" --version) == "$program "* ]] || fail "$program has no version"
    [[ $(file -b "$root/usr/bin/$program") == *", stripped"* ]] || fail "$program is not stripped"
    page=$root/usr/share/man/man1/$program.1.gz
    zcat "$page" | grep '^\.SH NAME' >/dev/null || fail "no man page of $program"
    # every long option that --help knows stands in the man page and in the three completions
    for option in $("$root/usr/bin/$program" --help | grep -oE '^  (-.,)?--[a-z-]+' |
        grep -oE -- '--[a-z-]+'); do
        # not grep -q: it would leave before the whole page is through the pipe, which is a failure
        zcat "$page" | sed 's/\\-/-/g' | grep -F -- "$option" >/dev/null ||
            fail "$program.1 lacks $option"
        for file in bash-completion/completions/$program zsh/vendor-completions/_$program; do
            grep -qF -- "$option" "$root/usr/share/$file" || fail "$file lacks $option"
        done
        grep -qF -- "-l ${option#--}" "$root/usr/share/fish/vendor_completions.d/$program.fish" ||
            fail "$program.fish lacks $option"
    done
done

# complete WORD...: what bash proposes for the last word
complete_words() {
    local program=$1
    # shellcheck source=/dev/null
    . "$root/usr/share/bash-completion/completions/$program"
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
    "_$program"
    echo "${COMPREPLY[*]}"
}
expect() {
    local want=$1
    shift
    [[ $(complete_words "$@") == "$want" ]] ||
        fail "'$*' completes to '$(complete_words "$@")', not '$want'"
}
expect "conforming lattice" spherize --arrangement ""
expect "--radius --repair" spherize --r
expect "view" icepost v
expect "--every" icepost paraview run --e
expect "mm m" spherize --units m
expect "contact.restitution" icesolve --explain contact.rest
expect "environment environment.gravity environment.water_density" icesolve --explain env
expect "hull.position=" icesolve --set hull.posi
expect "floes.jitter=" icefield --set floes.j
touch "a mesh.obj"
expect "a mesh.obj" spherize "a m"

# mesh to result with what the package brings
cp -r "$root/usr/share/icesolve/." .
export PATH=$root/usr/bin:$PATH
cases/prepare.sh cases/paper-2d-u0.5 >prepare.log 2>&1 || fail "$(cat prepare.log)"
icesolve cases/paper-2d-u0.5/case.cfg --out run -q --set simulation.duration=2 \
    --set output.average_from=1
[[ -f run/report.html ]] || fail "the run has no report"

# a sweep with the workflow that the package brings, of a case that lies elsewhere
if command -v snakemake >/dev/null; then
    printf '%s\n' 'case = "cases/paper-2d-u0.5/case.cfg"' 'report = false' '[set]' \
        'simulation.duration = 2.0' 'output.average_from = 1.0' '[axes]' \
        'hull.speed = [0.5, 1.0]' >own.toml
    snakemake -s "$root/usr/share/icesolve/workflow/Snakefile" \
        --profile "$root/usr/share/icesolve/workflow/local" --cores 1 \
        --config sweep=own.toml >sweep.log 2>&1 ||
        fail "$(cat sweep.log)"
    [[ -f results/own/sweep.html ]] || fail "the sweep has no page"
    [[ -z $(find "$root/usr/share" -name __pycache__) ]] ||
        fail "the workflow leaves files where it is installed"
fi

# a program of one's own against the package
cmake -S "$doc/examples/library" -B two_floes -G Ninja -DCMAKE_PREFIX_PATH="$root/usr" \
    -DCMAKE_BUILD_TYPE=Release >own.log && cmake --build two_floes >>own.log ||
        fail "$(cat own.log)"
python3 -B "$source/tests/library/example_test.py" two_floes/two_floes "$doc/docs/library.md"

# the headers that docs/library.md names are there and compile
mkdir headers
sed -n 's/^| \(`.*`\) |.*/\1/p' "$doc/docs/library.md" | grep -oE '[a-z0-9_/]+\.hpp' >names
[[ $(wc -l <names) -ge 20 ]] || fail "docs/library.md names few headers"
folder=
while read -r name; do # "a/b.hpp, c.hpp": the second lies beside the first
    [[ $name == */* ]] && folder=${name%/*}
    echo "#include \"$folder/${name##*/}\"" >>headers/all.cpp
    [[ -f $root/usr/include/icesolve/$folder/${name##*/} ]] || fail "no header $folder/$name"
done <names
g++ -std=c++20 -fopenmp -fsyntax-only -Wall -Wextra -I "$root/usr/include/icesolve" \
    -isystem /usr/include/eigen3 headers/all.cpp || fail "the headers do not compile"
