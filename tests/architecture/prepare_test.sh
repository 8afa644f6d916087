#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# prepare_test.sh PREPARE: runs cases/prepare.sh with a program that only writes its arguments down.
set -euo pipefail

prepare=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir case

cat >program <<'END'
#!/usr/bin/env bash
echo "$*" >>../calls
while [[ $1 != -o ]]; do shift; done
touch "$2"
END
chmod +x program
printf '# hull and floe\n\n%s\n%s' '../h.obj -r 0.1 -o h.h5' \
    '../f.obj -r 0.05 --slice y=0 -o f.h5' >case/spheres.txt
touch h.obj f.obj
touch -d '1 hour ago' program h.obj f.obj case/spheres.txt

# expect TEXT: prepare.sh makes exactly these calls
expect() {
    : >calls
    SPHERIZE=./program "$prepare" case 2>/dev/null
    [[ $(cat calls) == "$1" ]] || { echo "expected calls: $1; got: $(cat calls)"; exit 1; }
}

# refuse WORDS: prepare.sh ends with exit code 2 and these words
refuse() {
    local status=0
    SPHERIZE=${program:-./program} "$prepare" case >/dev/null 2>message || status=$?
    [[ $status -eq 2 ]] && grep -qF "$1" message && return
    echo "expected exit code 2 and '$1'; got $status and '$(cat message)'"
    exit 1
}

hull="../h.obj -r 0.1 -o h.h5"
floe="../f.obj -r 0.05 --slice y=0 -o f.h5"
both=$hull$'\n'$floe
expect "$both"
expect ""
touch -d 'now + 1 minute' f.obj
expect "$floe"
touch -d '1 hour ago' f.obj
touch -d 'now + 1 minute' program
expect "$both"
touch -d '1 hour ago' program
touch -d 'now + 1 minute' case/spheres.txt
expect "$both"

program=./none refuse "no program"

# a specification goes to the other program
sed 's/calls/field-calls/' program >field-program
chmod +x field-program
echo "channel.toml --seed 3 -o field.h5" >case/spheres.txt
touch case/channel.toml
: >calls
: >field-calls
SPHERIZE=./none ICEFIELD=./field-program "$prepare" case 2>/dev/null
[[ ! -s calls && $(cat field-calls) == "channel.toml --seed 3 -o field.h5" ]] ||
    { echo "icefield was not called: $(cat calls field-calls)"; exit 1; }
rm case/channel.toml
ICEFIELD=./field-program refuse "no specification channel.toml"

echo "../h.obj -r 0.1" >case/spheres.txt
refuse "names no output; add -o FILE"
for options in "-o ../h.h5" "-o /tmp/h.h5" "-o h.h5 --json=/tmp/h.json"; do
    echo "../h.obj -r 0.1 $options" >case/spheres.txt
    refuse "leads out of the case folder"
done
echo "../other.obj -o h.h5" >case/spheres.txt
refuse "no mesh ../other.obj"
rm case/spheres.txt
refuse "no file case/spheres.txt"
