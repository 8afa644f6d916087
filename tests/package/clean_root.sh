#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# clean_root.sh BUILD [ROOT]: the package in a Debian 12 that has nothing else: install, mesh to
# result, a program against the libraries, remove. As root, with debootstrap and a network; ROOT is
# an empty root to use instead of making one (debootstrap --variant=minbase bookworm ROOT).
set -euo pipefail
build=$(realpath "$1") root=${2:-} made=

fail() {
    echo "clean_root.sh: $*" >&2
    exit 1
}

[[ $(id -u) -eq 0 ]] || { echo "skipped: not root" >&2; exit 0; }
if [[ -z $root ]]; then
    command -v debootstrap >/dev/null || { echo "skipped: no debootstrap" >&2; exit 0; }
    made=$(mktemp -d)
    root=$made
    debootstrap --variant=minbase bookworm "$root" >"$build/debootstrap.log" ||
        { echo "skipped: debootstrap failed, $build/debootstrap.log says why" >&2; exit 0; }
fi
# the programs find each other by /proc
mount -t proc proc "$root/proc" || { echo "skipped: /proc cannot be mounted in $root" >&2; exit 0; }
trap 'umount "$root/proc"; [[ -z $made ]] || rm -rf --one-file-system "$made"' EXIT

cpack --config "$build/CPackConfig.cmake" -G DEB -B "$build/packages" >/dev/null
cp "$build"/packages/icesolve_*.deb "$root/tmp/icesolve.deb"
[[ -e $root/dev/null && -c $root/dev/null ]] || fail "$root has no /dev/null"
within() {
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive \
        HOME=/root "$@"
}
within apt-get -qq update
echo "== install" >&2
within apt-get -qq install --yes --no-install-recommends /tmp/icesolve.deb >/dev/null
echo "== mesh to result" >&2
within bash -euc '
    mkdir /tmp/trial
    cp -r /usr/share/icesolve/. /tmp/trial
    cd /tmp/trial
    cases/prepare.sh cases/paper-2d-u0.5
    icesolve cases/paper-2d-u0.5/case.cfg --out run -q --set simulation.duration=5 \
        --set output.average_from=2
    icepost table run
    test -s run/report.html'
if [[ -z ${ICE_WITHOUT_LIBRARY:-} ]]; then
    echo "== a program against the libraries" >&2
    within bash -euc "
        apt-get -qq install --yes --no-install-recommends \
            \$(dpkg-query -W -f '\${Recommends}' icesolve | tr -d ,) make >/dev/null
        cmake -S /usr/share/doc/icesolve/examples/library -B /tmp/trial/two_floes >/dev/null
        cmake --build /tmp/trial/two_floes >/dev/null
        /tmp/trial/two_floes/two_floes"
fi
echo "== remove" >&2
within apt-get -qq purge --yes icesolve >/dev/null
within rm -rf /tmp/trial /tmp/icesolve.deb
left=$(within find / -xdev \( -name '*icesolve*' -o -name '*spherize*' -o -name '*icepost*' \
    -o -name '*icefield*' -o -name '*iceflow*' \) \
    -not -path '/var/log/*' -not -path '/proc/*')
[[ -z $left ]] || fail "left behind: $left"
echo "installed, ran and removed in a clean root: nothing is left" >&2
