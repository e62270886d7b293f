# shellcheck shell=bash
# What ptbench needs from apt, and functions that install what is missing and build. Sourced by bench.sh and test.sh. The names
# are those of Debian 12 and of Ubuntu 22.04 and 24.04. One package a line: name, then what it is for.

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
libwebp-dev             small pictures in reports
zlib1g-dev              small data in reports
libjs-chart.js          charts in reports
'

# shellcheck disable=SC2034 # used by test.sh
PACKAGES_TO_BUILD_TESTS="$PACKAGES_TO_BUILD
git                     the revision that results name
libbenchmark-dev        micro-benchmarks
libgtest-dev            test framework
libgmock-dev            test framework
locales                 a locale whose numbers have commas
python3                 tests of the command line
clang-14                sanitizers; lint: compiles every kernel
"

# shellcheck disable=SC2034
PACKAGES_TO_RUN_TESTS="
python3-jsonschema      tests of the schemas
chromium                tests of reports
libbenchmark-tools      a reader of reports: compare.py
python3-scipy           needed by compare.py
python3-pandas          a reader of reports
python3-junitparser     a reader of reports
oclgrind                races and bad accesses in kernels
mesa-opencl-icd         a second OpenCL driver
clang-tidy-14           lint: C++
clang-format-14         lint: layout
shellcheck              lint: scripts
groff-base              tests of the man page
zsh                     tests of its completions
lintian                 tests of the packages
"

is_installed() {
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# install_missing LIST: installs the packages of LIST that are not there; no apt and no network when all are.
install_missing() {
    local name why missing=() as_root=()
    if ! command -v dpkg-query >/dev/null; then
        echo "note: no dpkg here; this system's own packages must bring: $(awk '{ printf "%s ", $1 }' <<<"$1")" >&2
        return
    fi
    while read -r name why; do
        if [ -z "$name" ] || is_installed "$name"; then continue; fi
        printf 'missing: %-24s %s\n' "$name" "$why" >&2
        missing+=("$name")
    done <<<"$1"
    if [ ${#missing[@]} -eq 0 ]; then return; fi
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "error: neither root nor sudo; as root, run: apt-get install ${missing[*]}" >&2
            return 1
        fi
        as_root=(sudo)
    fi
    # Everything apt says goes to stderr: stdout is the program's.
    if ! { ${as_root[@]+"${as_root[@]}"} apt-get update &&
        ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive \
            apt-get install --yes --no-install-recommends "${missing[@]}"; } >&2; then
        echo "error: apt-get failed; as root, run: apt-get install ${missing[*]}" >&2
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
