#!/usr/bin/env bash
# All steps of continuous integration in order, up to the first failure (durations:
# docs/develop/testing.md).  --full adds the slow ones: clang-tidy over all files and with its analyzer, the
# tests that are labelled "long", threads outside the library's core, longer fuzzing.
#   tools/check.sh                      every step
#   tools/check.sh format tidy          these steps
#   tools/check.sh --full [STEPS]
set -euo pipefail

cd "$(dirname "$0")/.."

all_steps=(test slow page format layers scripts bench tidy docs asan tsan fuzz release)

jobs=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)

our_sources() {
    find . -path ./build -prune -o \( -name '*.h' -o -name '*.cpp' \) -print | sort
}

first_of() {
    local name
    for name in "$@"; do
        if command -v "$name" >/dev/null; then
            echo "$name"
            return
        fi
    done
    echo "none of $* is installed (./dev setup check)" >&2
    return 1
}

step_format() {
    local clang_format
    clang_format=$(first_of clang-format-14 clang-format)
    our_sources | xargs "$clang_format" --dry-run -Werror
}

step_layers() {
    tools/check_layers.py
    tools/count_words.py
}

step_scripts() {
    shellcheck dev tools/check.sh tools/try_on.sh .ci/run
    python3 -m unittest discover -s tools -p '*_test.py'
}

# Whether the benchmarks compile; ./dev bench runs them.
step_bench() {
    cmake --preset release -B build/bench -DQUASIMC_BUILD_TESTS=OFF -DQUASIMC_BUILD_BENCH=ON >/dev/null
    cd build/bench
    ninja -t commands | grep -e ' -o bench/.*\.o -c ' | sed 's/$/ -O0 -fsyntax-only/' |
        xargs -d '\n' -I '{}' -P "$jobs" sh -c '{}'
}

# One of them builds another project against the installed package.
step_test() {
    if [[ -n $full ]]; then
        ./dev test --full
    else
        ./dev test
    fi
}

# Mainly statistics: estimates against closed forms, and coverage of intervals. ./dev test --full includes
# it.
step_slow() {
    [[ -n $full ]] || ./dev test -L '^slow$'
}

# The page in a browser, if one is installed; ./dev test --full includes it.
step_page() {
    [[ -n $full ]] || ./dev test -L web
}

# New members by tools/new.py, one of every family, build and pass their tests.
step_members() {
    tools/new_build.py -j "$jobs"
}

# The shipped sources. Tests would double the time; tools/tidy.py checks them too.
step_tidy() {
    cmake --preset dev >/dev/null
    if [[ -n $full ]]; then
        tools/tidy.py --build build/dev --quick src bench
        tools/tidy.py --build build/dev apps
        cmake --preset release >/dev/null
        tools/analyze.py --build build/release
    else
        tools/tidy.py --build build/dev --changed src apps bench
    fi
}

step_docs() {
    ./dev docs
}

# Builds a group of tests (tests/CMakeLists.txt) under a preset and runs those that ctest's options
# choose: every fourth case, at each commit others, or all with --full.
sanitized() {
    local preset=$1 group=$2 commit
    shift 2
    cmake --preset "$preset" >/dev/null
    cmake --build "build/$preset" --target "quasimc_tests_$group"
    if [[ -z $full ]]; then
        commit=$(git rev-parse --short=8 HEAD 2>/dev/null || echo 0)
        export GTEST_TOTAL_SHARDS=4 GTEST_SHARD_INDEX=$((16#${commit:0:8} % 4))
    fi
    ctest --test-dir "build/$preset" --output-on-failure --no-tests=error -j "$jobs" \
        -L '^whole$' "$@"
}

# Slow tests are statistics, and show no more under a sanitizer than the quick ones. The tests of modules
# cover the programs within one process.
step_asan() {
    sanitized asan quick -LE '^(slow|processes)$'
    [[ -z $full ]] || sanitized asan processes -L '^processes$'
}

step_tsan() {
    sanitized tsan threads -L '^threads$'
    [[ -z $full ]] || sanitized tsan coupled_threads -L '^coupled_threads$'
}

# A short run of a fuzzer; its corpus is replayed by the ordinary tests as well.
fuzz_one() {
    local fuzzer=$1
    local name=${fuzzer##*/quasimc_fuzz_}
    local seeds=tests/fuzz/corpus/$name
    [[ -d $seeds ]] || seeds=tests/fuzz/corpus
    mkdir -p "build/asan/corpus/$name"
    "$fuzzer" -max_total_time="${QUASIMC_FUZZ_SECONDS:-2}" -timeout=10 -rss_limit_mb=2048 \
        -print_final_stats=0 -verbosity=0 \
        "build/asan/corpus/$name" "$seeds"
}

# One fuzzer per processor at a time.
step_fuzz() {
    cmake --preset asan >/dev/null
    cmake --build build/asan --target quasimc_fuzzers
    export -f fuzz_one
    # shellcheck disable=SC2016  # expanded by the inner shell
    printf '%s\0' build/asan/bin/quasimc_fuzz_* |
        xargs -0 -n 1 -P "$jobs" bash -euo pipefail -c 'fuzz_one "$1"' fuzz_one
}

# The current stable release of Debian, whose compiler and libraries are newer than those of the other steps:
# the README's first command there, with --full both. Only root can install a release.
step_release() {
    if [[ $(id -u) -ne 0 ]]; then
        echo "left out: only root can install another release (sudo tools/check.sh release)"
    elif [[ -n $full ]]; then
        tools/try_on.sh trixie
    else
        tools/try_on.sh trixie './dev run examples/01-leaves/leaves.toml'
    fi
}

# Random scenes by all methods, for some minutes (for hours: docs/develop/testing.md). Each commit tests
# another part of the scenes.
step_stress() {
    cmake --preset release >/dev/null
    cmake --build build/release --target quasimc_stress
    local commits
    commits=$(git rev-list --count HEAD 2>/dev/null || echo 1)
    build/release/bin/quasimc_stress --seed "$((commits * 100000))" --scenes 100000 \
        --seconds "${QUASIMC_STRESS_SECONDS:-300}" --coverage-every 200 --out build/stress
}

full=
if [[ ${1:-} == --full ]]; then
    full=yes
    shift
    export QUASIMC_FUZZ_SECONDS=${QUASIMC_FUZZ_SECONDS:-10}
fi
selected=("$@")
if [[ $# -eq 0 ]]; then
    selected=("${all_steps[@]}")
    [[ -z $full ]] || selected+=(members stress)
fi
for step in "${selected[@]}"; do
    if ! declare -F "step_$step" >/dev/null; then
        echo "tools/check.sh: no such step: $step (${all_steps[*]})" >&2
        exit 2
    fi
done

for step in "${selected[@]}"; do
    printf '\n=== %s\n' "$step"
    start=$SECONDS
    status=0
    # A fresh shell: "set -e" is not in force in a function called from a condition.
    (
        set -euo pipefail
        "step_$step"
    ) &
    wait $! || status=$?
    printf '=== %s: %d s\n' "$step" $((SECONDS - start))
    if [[ $status -ne 0 ]]; then
        printf '\ntools/check.sh: step "%s" failed (status %d). Again: tools/check.sh %s%s\n' \
            "$step" "$status" "${full:+--full }" "$step" >&2
        exit 1
    fi
done
printf '\nAll passed%s: %s\n' "${full:+ (--full)}" "${selected[*]}"
