#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From a clean checkout on Debian 12 to a result: ./bootstrap.sh deps|build|demo|python|test
set -euo pipefail

readonly packages=(
    build-essential cmake ninja-build git ca-certificates
    libeigen3-dev libboost-dev libcgal-dev libassimp-dev catch2 libhwy-dev libtomlplusplus-dev
    libcli11-dev libmeshoptimizer-dev libpolyclipping-dev libfmt-dev libspdlog-dev libhdf5-dev
    libssl-dev nlohmann-json3-dev zlib1g-dev python3 python3-h5py help2man librsvg2-bin)

# only the tests use these: the report in a browser, its page built again, run.h5 in xarray,
# fuzzing, the documents as a site
readonly test_packages=(chromium chromium-driver python3-selenium python3-pil python3-xarray
    python3-h5netcdf python3-jsonschema python3-sphinx python3-myst-parser lintian snakemake
    clang-14 clang-format-14 clang-tidy-14 libclang-rt-14-dev libomp-14-dev)

# import icesolve, and its module that steps a scene
readonly python_packages=(pybind11-dev python3-dev python3-h5py python3-h5netcdf python3-jsonschema
    python3-matplotlib python3-numpy python3-scipy python3-tomli-w python3-xarray)

usage() {
    cat <<'END'
usage: ./bootstrap.sh COMMAND
  deps   installs the Debian packages that are missing (as root or with sudo)
  build  deps, then the programs: build/release/bin/{spherize,icefield,iceflow,icesolve,icepost}
  demo   deps, the programs it runs (spherize, icesolve, icepost), then the paper's 3D case at three
         speeds: resistance curve and report
  python build, then what `import icesolve` needs, and its tutorial: a resistance curve from Python
  test   build with the tests, then the whole test suite (CI=true: compiler warnings are errors)
  sanitize [PROGRAM]...  tests with the address and undefined-behaviour sanitizers: of the test
         programs PROGRAM (solver_tests, common_tests, ...), or of all
  sanitize-threads       a few steps of each bench scene with the thread sanitizer
  tidy   clang-tidy over every source; the tests run it over a sample of them
END
}

fail() {
    echo "bootstrap.sh: $*" >&2
    exit 1
}

install_packages() {
    local missing=() package state
    for package in "$@"; do
        state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
        [[ $state == installed ]] || missing+=("$package")
    done
    [[ ${#missing[@]} -eq 0 ]] && return
    echo "installing ${missing[*]}" >&2
    command -v apt-get >/dev/null ||
        fail "no apt-get here; install these packages (Debian names): ${missing[*]}"

    local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -qq)
    if [[ $(id -u) -ne 0 ]]; then
        command -v sudo >/dev/null ||
            fail "neither root nor sudo; as root, install: ${missing[*]}"
        apt=(sudo "${apt[@]}")
    fi
    "${apt[@]}" update
    "${apt[@]}" install --yes --no-install-recommends "${missing[@]}"
}

# one job per processor, and per 2 GB of memory: the CGAL files need up to 1.5 GB each
job_count() {
    local gigabyte=$((1024 * 1024 * 1024)) memory limit jobs
    memory=$(($(awk '/^MemTotal:/ { print $2 }' /proc/meminfo) * 1024))
    limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || echo max) # a container's own bound
    [[ $limit =~ ^[0-9]{1,18}$ ]] && ((limit < memory)) && memory=$limit
    jobs=$(nproc)
    # half a gigabyte is forgiven, because "4 GB" machines report a little less
    local fitting=$(((memory + gigabyte / 2) / (2 * gigabyte)))
    ((fitting < jobs)) && jobs=$fitting
    echo $((jobs > 1 ? jobs : 1))
}

preset() {
    [[ ${CI:-} == true ]] && echo ci || echo release
}

# $1: ON with the tests and benches, which take longer to compile than the programs; $2: ON with the
# Python module; then the programs to build, all where none is named
build_programs() {
    local tests=$1 module=$2
    shift 2
    # small sources compile together in less time: with the tests as well, so that they see what
    # `demo` and `build` compile; a build by hand compiles each by itself and shows missing includes
    cmake --preset "$(preset)" -DICE_TESTS="$tests" -DICE_PYTHON_MODULE="$module" \
        -DICE_UNITED_SOURCES=ON -DICE_PRECOMPILED_HEADERS=ON
    cmake --build --preset "$(preset)" --parallel "$(job_count)" --target "${@:-all}"
}

# $1: preset, $2: its build folder, then further options of ctest
run_tests() {
    local log=$2/ctest.log status=0
    ctest --preset "$1" --parallel "$(nproc)" --no-tests=error "${@:3}" 2>&1 | tee "$log" ||
        status=$?

    # "98% tests passed, 2 tests failed out of 120": count what ran, from ctest's own words
    local total failed skipped
    total=$(sed -nE 's/.*tests passed, .* out of ([0-9]+)$/\1/p' "$log")
    failed=$(sed -nE 's/.*tests passed, ([0-9]+) tests? failed out of .*/\1/p' "$log")
    skipped=$(grep -cF '***Skipped' "$log" || true)
    if [[ -z $total ]] || ((total <= skipped)); then fail "no test ran; see $log"; fi
    echo "tests: $((total - failed - skipped)) passed, $failed failed, $skipped skipped"
    return "$status"
}

# The programs whose tests `sanitize` runs.
readonly sanitized=(common_tests preprocess_tests field_tests flow_tests solver_tests
    postprocess_tests)

# Tests of these programs with the sanitizers; preconditions are alive here, too. Precompiled
# headers and united sources take two thirds off the compile time.
run_sanitized() {
    local names
    names=$(IFS='|' && echo "$*")
    local name
    for name in "$@"; do
        [[ " ${sanitized[*]} " == *" $name "* ]] ||
            fail "sanitize: $name is none of ${sanitized[*]}"
    done
    install_packages "${packages[@]}" "${test_packages[@]}"
    cmake --preset asan-ubsan -DICE_TESTS=ON -DICE_PRECOMPILED_HEADERS=ON -DICE_UNITED_SOURCES=ON
    cmake --build --preset asan-ubsan --parallel "$(job_count)" --target "$@"
    run_tests asan-ubsan build/asan-ubsan --label-regex "^($names)$"
}

cd "$(dirname "${BASH_SOURCE[0]}")"
[[ $# -eq 1 || ${1:-} == sanitize ]] || { usage >&2; exit 2; }
# one command a line: in "a && b" a failure inside a would not stop the script
case $1 in
    deps)
        install_packages "${packages[@]}"
        ;;
    build)
        install_packages "${packages[@]}"
        build_programs OFF OFF
        ;;
    demo)
        install_packages "${packages[@]}"
        build_programs OFF OFF spherize icesolve icepost
        cases/demo.sh
        echo "next     ./bootstrap.sh build: icefield and iceflow as well"
        ;;
    python)
        install_packages "${packages[@]}" "${python_packages[@]}"
        build_programs OFF ON
        PYTHONPATH=$PWD/python /usr/bin/python3 python/tutorial.py results/python-tutorial
        echo "curve    results/python-tutorial/resistance.pdf"
        echo "next     export PYTHONPATH=$PWD/python; python/README.md"
        ;;
    test)
        # another source's Node has its own npm, which Debian's package would replace
        if command -v npm >/dev/null; then node=(); else node=(nodejs npm); fi
        install_packages "${packages[@]}" "${test_packages[@]}" "${python_packages[@]}" "${node[@]}"
        build_programs ON ON
        run_tests "$(preset)" build/release
        ;;
    sanitize)
        if [[ $# -eq 1 ]]; then run_sanitized "${sanitized[@]}"; else run_sanitized "${@:2}"; fi
        ;;
    sanitize-threads)
        install_packages "${packages[@]}" "${test_packages[@]}" clang-14 libclang-rt-14-dev \
            libomp-14-dev
        cmake --preset tsan -DICE_TESTS=ON -DICE_PRECOMPILED_HEADERS=ON -DICE_UNITED_SOURCES=ON
        cmake --build --preset tsan --parallel "$(job_count)" --target icebench
        run_tests tsan build/tsan -R "^icebench: every scene"
        ;;
    tidy)
        install_packages "${packages[@]}" clang-14 clang-tidy-14 libomp-14-dev
        python3 -B tests/architecture/tidy.py --all --jobs "$(job_count)" . build/tidy
        ;;
    -h | --help | help) usage ;;
    *) usage >&2; exit 2 ;;
esac
