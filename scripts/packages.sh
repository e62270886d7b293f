# shellcheck shell=bash
# What ptbench needs from apt, and functions that install what is missing and build. Sourced by bench.sh and test.sh. The names
# are those of Debian 12 and 13 and of Ubuntu 22.04 and 24.04. One package a line: name, then what it is for. One that ends
# with a question mark not all of them have: its tests are skipped there, with the reason.

PACKAGES_TO_BUILD='
g++                     C++20 compiler
cmake                   configures the build
ninja-build             runs the build
pkg-config              finds libraries
ocl-icd-opencl-dev      OpenCL loader
opencl-c-headers        OpenCL headers
opencl-clhpp-headers    OpenCL C++ bindings
pocl-opencl-icd         OpenCL on the CPU
libfmt-dev              text
nlohmann-json3-dev      JSON
libcli11-dev            command line
libboost-dev            processes, quantiles
libboost-filesystem-dev needed by Boost.Process
libopenexr-dev          EXR images
libpng-dev              PNG images
libassimp-dev           meshes
libwebp-dev             small pictures in reports
zlib1g-dev              small data in reports
libjs-chart.js          charts in reports
'

# shellcheck disable=SC2034 # used by test.sh
PACKAGES_TO_BUILD_TESTS="$PACKAGES_TO_BUILD
git                     the revision that results name
libbenchmark-dev        micro-benchmarks
libfftw3-dev            pictures of gradients by cosine transforms, in tests
libgtest-dev            test framework
libgmock-dev            test framework
locales                 a locale whose numbers have commas
python3                 tests of the command line
clang                   sanitizers; lint: compiles every kernel
libclang-rt-dev?        sanitizers; part of clang where there is none
"

# shellcheck disable=SC2034
PACKAGES_TO_RUN_TESTS="
python3-jsonschema      tests of the schemas
chromium                tests of reports
libbenchmark-tools      a reader of reports: compare.py
python3-scipy           needed by compare.py
python3-pandas          a reader of reports
python3-junitparser     a reader of reports
oclgrind?               races and bad accesses in kernels
mesa-opencl-icd         a second OpenCL driver
clang-tidy              lint: C++
clang-format-14?        lint: layout, which other versions see otherwise
shellcheck              lint: scripts
slurmctld               a cluster of virtual nodes: tests of fleets
slurmd                  its nodes
slurm-client            what starts and ends jobs there
munge                   needed by slurmctld
groff-base              tests of the man page
zsh                     tests of its completions
lintian                 tests of the packages
"

is_installed() {
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# as_root COMMAND...: everything it says goes to stderr, since stdout is the program's.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then "$@" >&2; else sudo "$@" >&2; fi
}

# starting_nothing COMMAND...: as_root, while services of packages that it installs are not started.
starting_nothing() {
    local policy=/usr/sbin/policy-rc.d code=0
    if [ -e "$policy" ]; then
        as_root "$@"
        return
    fi
    as_root sh -c "printf '#!/bin/sh\nexit 101\n' >$policy && chmod +x $policy"
    as_root "$@" || code=$?
    as_root rm -f "$policy"
    return "$code"
}

# missing_of LIST: names of the packages of LIST that are not installed; says which, and what for.
missing_of() {
    local name why
    while read -r name why; do
        if [ -z "$name" ] || is_installed "${name%\?}"; then continue; fi
        printf 'missing: %-24s %s\n' "${name%\?}" "$why" >&2
        echo "$name"
    done <<<"$1"
}

# offered NAME...: the names, less those with a question mark that apt does not have.
offered() {
    local name
    for name in "$@"; do
        if [ "$name" = "${name%\?}" ] || apt-cache show "${name%\?}" >/dev/null 2>&1; then
            echo "${name%\?}"
        else
            echo "note: this release has no ${name%\?}; what needs it is left out" >&2
        fi
    done
}

# install_missing LIST: installs the packages of LIST that are not there; no apt and no network when all are.
install_missing() {
    local missing names
    if ! command -v dpkg-query >/dev/null; then
        echo "note: no dpkg here; this system's own packages must bring: $(awk '{ printf "%s ", $1 }' <<<"$1")" >&2
        return
    fi
    mapfile -t missing < <(missing_of "$1")
    if [ ${#missing[@]} -eq 0 ]; then return; fi
    if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
        echo "error: neither root nor sudo; as root, run: apt-get install ${missing[*]%\?}" >&2
        return 1
    fi
    if ! compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null; then as_root apt-get update || true; fi
    mapfile -t names < <(offered "${missing[@]}")
    if [ ${#names[@]} -eq 0 ]; then return; fi
    if ! { as_root apt-get update &&
        starting_nothing env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "${names[@]}"; }; then
        echo "error: apt-get failed; as root, run: apt-get install ${names[*]}" >&2
        return 1
    fi
}

# quietly COMMAND...: shows what the command said only when it fails.
quietly() {
    local log
    log=$(mktemp)
    if "$@" >"$log" 2>&1; then
        rm -f "$log"
    else
        local code=$?
        cat "$log" >&2
        rm -f "$log"
        return "$code"
    fi
}

# build_ptbench TREE: in build/release of a tree; one that is configured already is used as it is.
build_ptbench() {
    if [ ! -f "$1/build/release/build.ninja" ]; then
        echo "Configuring ..." >&2
        (cd "$1" && quietly cmake --preset release -DPTBENCH_TESTS=OFF -DPTBENCH_MICRO=OFF)
    fi
    if [ ! -x "$1/build/release/bin/ptbench" ]; then echo "Building ptbench (a minute or two, once) ..." >&2; fi
    quietly cmake --build "$1/build/release" --target ptbench
}
